//! The six costs of a pair of curves (the original's `TrajectoryEvaluator`), each as the specification defines it.
//!
//! Four belong to the longitudinal curve alone; the offset from the line is added up once for every lateral curve, so
//! that only the lateral acceleration is left to be found for each pair.

use super::curve::Curve;
use super::grid::{SAMPLES, Series, TIMES, largest_size};
use super::line_table::LineTable;

/// Keeps sums that are divided by from 0.
const EPSILON: f64 = 1e-6;

/// Jerk that costs 1, m/s³ (the upper limit).
const JERK_SCALE: f64 = 2.0;

/// Weights of speed and of way (`weight_target_speed`, `weight_dist_travelled`).
const SPEED_AND_WAY: (f64, f64) = (1.0, 10.0);

/// Room kept along the line: behind an obstacle and before one, m, and the width of the slope beyond, m.
const YIELD_ROOM: f64 = 1.0;
const OVERTAKE_ROOM: f64 = 5.0;
const SLOPE: f64 = 0.5;

/// Farther away than this many widths of the slope an obstacle costs nothing that a sum could show.
const NO_MORE: f64 = 9.0;

/// Offset that costs 1, m, and how much more it costs on the other side of the line.
const OFFSET_SCALE: f64 = 3.0;
const OTHER_SIDE: f64 = 10.0;

/// The offset counts at every metre, as far as this.
const FARTHEST: usize = 200;

/// A soft maximum: the mean of the sizes, each weighted with itself.
fn soft_maximum(values: impl Iterator<Item = f64>) -> f64 {
    let (squares, sizes) = values.fold((0.0, 0.0), |(squares, sizes), x| {
        (squares + x * x, sizes + x.abs())
    });
    squares / (sizes + EPSILON)
}

/// A longitudinal curve at the times of the grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled {
    /// Station, m.
    pub(super) s: Series,
    /// Its first, second and third derivative by time.
    pub(super) v: Series,
    pub(super) a: Series,
    pub(super) jerk: Series,
    /// Way since the start, m. Where the curve goes back the car stands.
    pub(super) ways: Series,
    /// Whether it goes back anywhere.
    goes_back: bool,
    /// Way to the end of the curve, m.
    pub way: f64,
}

impl Sampled {
    /// Samples a curve.
    pub fn new(curve: &Curve) -> Self {
        let [mut s, mut v, mut a, mut jerk, mut ways] = [[0.0; SAMPLES]; 5];
        let (mut farthest, mut goes_back) = (0.0_f64, false);
        for (k, t) in TIMES.iter().enumerate() {
            [s[k], v[k], a[k], jerk[k]] = curve.at(*t);
            goes_back |= s[k] - s[0] < farthest;
            farthest = farthest.max(s[k] - s[0]);
            ways[k] = farthest;
        }
        Self {
            way: curve.end() - s[0],
            s,
            v,
            a,
            jerk,
            ways,
            goes_back,
        }
    }
}

/// What a longitudinal curve costs, unweighted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LongitudinalCosts {
    /// Departing from the guide speed, and not getting on.
    pub objective: f64,
    /// Jerk.
    pub jerk: f64,
    /// Nearness to what the path-time graph holds.
    pub collision: f64,
    /// Acceleration in the line's bends.
    pub centripetal: f64,
}

impl LongitudinalCosts {
    /// The costs of a curve. `blocked` is what the path-time graph holds at the times of the grid.
    pub fn new(curve: &Sampled, guide: &[f64; SAMPLES], blocked: &Blocked, line: &LineTable) -> Self {
        let mut place = 0;
        let centripetal = |(s, v): (&f64, &f64)| v * v * line.kappa(*s, &mut place);
        Self {
            objective: objective(curve, guide),
            jerk: soft_maximum(curve.jerk.iter().map(|jerk| jerk / JERK_SCALE)),
            collision: collision(curve, blocked),
            centripetal: soft_maximum(curve.s.iter().zip(&curve.v).map(centripetal)),
        }
    }
}

fn objective(curve: &Sampled, guide: &[f64; SAMPLES]) -> f64 {
    let (mut off, mut weights) = (0.0, 0.0);
    for ((t, v), wanted) in TIMES.iter().zip(&curve.v).zip(guide) {
        off += t * t * (wanted - v).abs();
        weights += t * t;
    }
    let (speed, way) = (off / (weights + EPSILON), 1.0 / (1.0 + curve.way));
    (SPEED_AND_WAY.0 * speed + SPEED_AND_WAY.1 * way) / (SPEED_AND_WAY.0 + SPEED_AND_WAY.1)
}

/// What lies in the way along the line, obstacle by obstacle, at the times of the grid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Blocked {
    /// Per obstacle from and to where, m; infinitely far away while it is not there.
    rows: Vec<[Series; 2]>,
}

impl Blocked {
    /// Of the obstacles whose intervals are told, each by time of the grid; `None` while it is not there.
    pub fn new<I: Iterator<Item = Option<(f64, f64)>>>(obstacles: impl Iterator<Item = I>) -> Self {
        let row = |intervals: I| {
            let mut row = [[f64::INFINITY; SAMPLES]; 2];
            for (k, interval) in intervals.take(SAMPLES).enumerate() {
                (row[0][k], row[1][k]) = interval.unwrap_or((f64::INFINITY, f64::INFINITY));
            }
            row
        };
        Self {
            rows: obstacles.map(row).collect(),
        }
    }
}

/// Obstacle by obstacle: most of them come nowhere near to the curve, which is seen without a branch.
fn collision(curve: &Sampled, blocked: &Blocked) -> f64 {
    let (mut squares, mut sizes) = (0.0, 0.0);
    let mut apart = [0.0; SAMPLES];
    for [low, high] in &blocked.rows {
        let mut comes_near = false;
        for k in 0..SAMPLES {
            let (before, beyond) = (
                low[k] - YIELD_ROOM - curve.s[k],
                curve.s[k] - (high[k] + OVERTAKE_ROOM),
            );
            apart[k] = if before > beyond { before } else { beyond };
            comes_near |= apart[k] <= NO_MORE * SLOPE;
        }
        if !comes_near {
            continue;
        }
        for apart in apart.iter().filter(|apart| **apart <= NO_MORE * SLOPE) {
            let cost = if *apart <= 0.0 {
                1.0
            } else {
                libm::exp(-apart * apart / (2.0 * SLOPE * SLOPE))
            };
            squares += cost * cost;
            sizes += cost;
        }
    }
    squares / (sizes + EPSILON)
}

/// A lateral curve with the cost of its offset, added up metre by metre.
#[derive(Clone, Debug, PartialEq)]
pub struct LateralProfile {
    /// The curve.
    pub curve: Curve,
    /// Sums of weighted squares and sizes over the first so many metres.
    sums: Vec<(f64, f64)>,
    /// Largest offset to either side, m.
    pub largest: f64,
}

impl LateralProfile {
    /// Adds up.
    pub fn new(curve: Curve) -> Self {
        let start = curve.at(0.0)[0];
        let mut sums = Vec::with_capacity(FARTHEST + 1);
        let (mut squares, mut sizes, mut largest) = (0.0, 0.0, 0.0_f64);
        sums.push((squares, sizes));
        for k in 0..FARTHEST {
            let [l, ..] = curve.at(k as f64);
            largest = largest.max(l.abs());
            let cost = l / OFFSET_SCALE;
            let weight = if l * start < 0.0 { OTHER_SIDE } else { 1.0 };
            squares += cost * cost * weight;
            sizes += cost.abs() * weight;
            sums.push((squares, sizes));
        }
        Self { curve, sums, largest }
    }

    /// What the offset costs over a way in metres. The original mistakes the station at its end for the way.
    pub fn offset_cost(&self, way: f64) -> f64 {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "saturates"
        )]
        let metres = (way.ceil().max(0.0) as usize).min(FARTHEST);
        let (squares, sizes) = self.sums[metres];
        squares / (sizes + EPSILON)
    }
}

/// The largest acceleration across the line of a pair, m/s².
pub fn lateral_comfort(longitudinal: &Sampled, lateral: &Curve) -> f64 {
    let mut across = [[0.0; SAMPLES]; 3];
    lateral.sample(&longitudinal.s.map(|s| s - longitudinal.s[0]), &mut across);
    comfort_of(longitudinal, &across)
}

/// The same for a lateral curve of which samples at the ways of the longitudinal one are known. These are other ways
/// only where the car stands instead of going back.
pub(super) fn comfort_sampled(longitudinal: &Sampled, lateral: &Curve, samples: &[Series; 3]) -> f64 {
    if longitudinal.goes_back {
        lateral_comfort(longitudinal, lateral)
    } else {
        comfort_of(longitudinal, samples)
    }
}

fn comfort_of(longitudinal: &Sampled, [_, slopes, bends]: &[Series; 3]) -> f64 {
    let Sampled { v, a, .. } = longitudinal;
    let mut across = [0.0; SAMPLES];
    for k in 0..SAMPLES {
        across[k] = bends[k] * v[k] * v[k] + slopes[k] * a[k];
    }
    largest_size(&across)
}
