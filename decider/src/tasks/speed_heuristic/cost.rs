//! What a step through the ST graph costs (the original's `DpStCost`).
//!
//! Costs of acceleration and jerk are computed for each value; the original remembers the first value that it meets
//! in each bin of 0.1, so that the answer depends on the order of the search.

use super::SpeedHeuristicConfig;
use crate::st_graph::{BoundaryType, S_HORIZON, SRange, StBoundary, StObstacle, StPair, StPoint, cross};

/// Width of the bins by which the original looks up costs, in m/s² and m/s³. Of them only the ends are left: values
/// beyond its tables are infinitely expensive.
const BIN: f64 = 0.1;

/// Bins to either side of 0 for accelerations.
const ACCELERATION_BINS: f64 = 100.0;

/// Bins to either side of 0 for jerks.
const JERK_BINS: f64 = 200.0;

/// Farther than this outside an obstacle nobody needs to ask whether he is inside, m.
const CLEARLY_OUTSIDE: f64 = 1.0;

/// The costs of one graph.
#[derive(Clone, Debug)]
pub struct Costs<'a> {
    config: &'a SpeedHeuristicConfig,
    obstacles: &'a [StObstacle],
    keep_clear: Vec<(f64, f64)>,
    /// Below this speed the car counts as standing, m/s.
    stopped_speed: f64,
}

/// The obstacles that repel at one time.
#[derive(Clone, Debug)]
pub struct ObstaclesAt<'a> {
    config: &'a SpeedHeuristicConfig,
    t: f64,
    near: Vec<Near>,
}

#[derive(Clone, Copy, Debug)]
struct Near {
    /// The pairs around the time, where it is not an end of the boundary.
    around: Option<(StPair, StPair)>,
    edges: SRange,
    range: SRange,
}

impl<'a> Costs<'a> {
    /// For these obstacles. A car slower than `stopped_speed` counts as standing.
    pub fn new(config: &'a SpeedHeuristicConfig, obstacles: &'a [StObstacle], stopped_speed: f64) -> Self {
        Self {
            config,
            obstacles,
            keep_clear: keep_clear_ranges(obstacles),
            stopped_speed,
        }
    }

    /// The stretches of the path on which one must not stand, ascending and apart from each other, m.
    pub fn keep_clear(&self) -> &[(f64, f64)] {
        &self.keep_clear
    }

    /// What repels at time `t`.
    pub fn obstacles_at(&self, t: f64) -> ObstaclesAt<'a> {
        let near = self.obstacles.iter().filter(|obstacle| obstacle.repels);
        let near = near.map(|obstacle| &obstacle.boundary);
        let near = near.filter(|boundary| boundary.min_s() <= S_HORIZON);
        ObstaclesAt {
            config: self.config,
            t,
            near: near.filter_map(|boundary| Near::of(boundary, t)).collect(),
        }
    }

    /// Of being no farther than `s` on a path of this length.
    pub fn spatial(&self, path_length: f64, s: f64) -> f64 {
        (path_length - s) * self.config.spatial_potential_penalty
    }

    /// Of driving from `from` to `to` in one column, where `limit` is allowed and `cruise` asked for.
    pub fn speed(&self, from: f64, to: f64, limit: f64, cruise: f64) -> f64 {
        let config = self.config;
        let unit = config.default_speed_cost;
        let v = (to - from) / config.unit_t;
        if v < 0.0 {
            return f64::INFINITY;
        }
        let mut cost = 0.0;
        if v < self.stopped_speed && self.is_keep_clear(to) {
            cost += config.keep_clear_low_speed_penalty * config.unit_t * unit;
        }
        let excess = (v - limit) / limit;
        if excess > 0.0 {
            cost += config.exceed_speed_penalty * unit * (excess * excess) * config.unit_t;
        } else if excess < 0.0 {
            cost += config.low_speed_penalty * unit * -excess * config.unit_t;
        }
        cost + config.reference_speed_penalty * unit * (v - cruise).abs() * config.unit_t
    }

    fn is_keep_clear(&self, s: f64) -> bool {
        self.keep_clear.iter().any(|zone| zone.0 <= s && s <= zone.1)
    }

    /// Of an acceleration: quadratic, with as much again where it passes a limit.
    pub fn acceleration(&self, a: f64) -> f64 {
        if !is_in_bins(a, ACCELERATION_BINS) {
            return f64::INFINITY;
        }
        let config = self.config;
        let square = a * a;
        let penalty = if a > 0.0 {
            config.accel_penalty
        } else {
            config.decel_penalty
        };
        let (dec, acc) = (config.decel_penalty, config.accel_penalty);
        let braking = square * dec * dec / (1.0 + libm::exp(a - config.max_deceleration));
        let driving = square * acc * acc / (1.0 + libm::exp(config.max_acceleration - a));
        (penalty * square + (braking + driving)) * config.unit_t
    }

    /// Of a jerk: quadratic.
    pub fn jerk(&self, jerk: f64) -> f64 {
        if !is_in_bins(jerk, JERK_BINS) {
            return f64::INFINITY;
        }
        let config = self.config;
        let coefficient = if jerk > 0.0 {
            config.positive_jerk_coeff
        } else {
            config.negative_jerk_coeff
        };
        coefficient * (jerk * jerk) * config.unit_t
    }
}

/// The extents of all zones to keep clear, with those that meet as one.
fn keep_clear_ranges(obstacles: &[StObstacle]) -> Vec<(f64, f64)> {
    let boundaries = obstacles.iter().map(|obstacle| &obstacle.boundary);
    let zones = boundaries.filter(|boundary| boundary.kind == BoundaryType::KeepClear);
    let mut zones: Vec<(f64, f64)> = zones.map(|zone| (zone.min_s(), zone.max_s())).collect();
    zones.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut merged: Vec<(f64, f64)> = Vec::with_capacity(zones.len());
    for zone in zones {
        match merged.last_mut() {
            Some(last) if last.1 >= zone.0 => last.1 = last.1.max(zone.1),
            _ => merged.push(zone),
        }
    }
    merged
}

/// Whether a value lies in a table with so many bins to either side of 0.
fn is_in_bins(value: f64, bins: f64) -> bool {
    let place = value / BIN + 0.5 + bins;
    // A place is rounded towards 0, so that the first bin is twice as wide.
    place > -1.0 && place < 2.0 * bins
}

impl Near {
    fn of(boundary: &StBoundary, t: f64) -> Option<Self> {
        let (edges, range) = (boundary.edges_at(t)?, boundary.range(t)?);
        let inner = t > boundary.min_t() && t < boundary.max_t();
        Some(Self {
            around: inner.then(|| {
                let right = boundary.pairs().partition_point(|pair| pair.t < t);
                (boundary.pairs()[right - 1], boundary.pairs()[right])
            }),
            edges,
            range,
        })
    }

    /// Whether a point at this time lies strictly inside.
    fn contains(&self, point: StPoint) -> bool {
        let Some((a, b)) = self.around else { return false };
        let beyond =
            point.s < self.edges.lower - CLEARLY_OUTSIDE || point.s > self.edges.upper + CLEARLY_OUTSIDE;
        let at = |s: fn(&StPair) -> f64| cross(point, StPoint::new(a.t, s(&a)), StPoint::new(b.t, s(&b)));
        !beyond && at(|pair| pair.upper) * at(|pair| pair.lower) < 0.0
    }
}

impl ObstaclesAt<'_> {
    /// Cost of being at `s` at this time: infinite inside an obstacle.
    pub fn cost(&self, s: f64) -> f64 {
        let config = self.config;
        let mut cost = 0.0;
        for near in &self.near {
            if near.contains(StPoint::new(self.t, s)) {
                return f64::INFINITY;
            }
            let (lower, upper) = (near.range.lower, near.range.upper);
            let (behind, ahead) = (config.safe_distance, config.safe_overtaking_gap);
            let lacking = if s < lower && s + behind >= lower {
                behind - lower + s
            } else if s >= lower && s > upper && s <= upper + ahead {
                ahead + upper - s
            } else {
                continue;
            };
            cost += config.obstacle_weight * config.default_obstacle_cost * lacking * lacking;
        }
        cost * config.unit_t
    }
}

/// Derivatives by finite differences of the places at successive columns, `dt` apart.
pub mod differences {
    /// Acceleration from the speed at the first of two places.
    pub fn acceleration_from(v: f64, s: [f64; 2], dt: f64) -> f64 {
        ((s[1] - s[0]) / dt - v) / dt
    }

    /// Acceleration over three places.
    pub fn acceleration(s: [f64; 3], dt: f64) -> f64 {
        (s[0] + s[2] - 2.0 * s[1]) / (dt * dt)
    }

    /// Jerk from speed and acceleration at the first of two places.
    pub fn jerk_from(v: f64, a: f64, s: [f64; 2], dt: f64) -> f64 {
        (acceleration_from(v, s, dt) - a) / dt
    }

    /// Jerk from the speed at the first of three places.
    pub fn jerk_from_speed(v: f64, s: [f64; 3], dt: f64) -> f64 {
        let (before, now) = ((s[1] - s[0]) / dt, (s[2] - s[1]) / dt);
        ((now - before) / dt - (before - v) / dt) / dt
    }

    /// Jerk over four places.
    pub fn jerk(s: [f64; 4], dt: f64) -> f64 {
        (s[3] - 3.0 * s[2] + 3.0 * s[1] - s[0]) / (dt * dt * dt)
    }
}
