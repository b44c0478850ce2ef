//! The sweep over the columns of the grid (the original's `GriddedPathTimeGraph`).
//!
//! Each node remembers its best predecessor. Where the original takes as the limit of an edge the least one that the
//! scan over the predecessors has met so far, here it is the lesser of the two ends.

use super::cost::{Costs, differences};
use super::grid::Grid;
use super::{Node, SpeedHeuristicConfig};
use crate::st_graph::{BoundaryType, StBoundary, StGraphData, StPoint};
use crate::steps;
use crate::vehicle::VehicleParams;

/// How much faster than the upper limit of speed a predecessor may come, as a factor.
const SPEED_RANGE: f64 = 1.2;

/// Speeds below this are backwards, m/s.
const BACKWARDS: f64 = -1e-6;

/// What rounding may do to a bound on speeds, m.
const SLACK: f64 = 1e-6;

/// A node that can be reached.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reached {
    pub row: usize,
    /// Row of the predecessor.
    from: usize,
    /// Place of the predecessor and of the one before it, m.
    before: [f64; 2],
    pub node: Node,
}

/// The reachable nodes of all columns, by ascending row.
pub(super) struct Sweep<'a> {
    config: &'a SpeedHeuristicConfig,
    graph: &'a StGraphData,
    costs: Costs<'a>,
    grid: &'a Grid,
    limits: Vec<f64>,
    cruise: f64,
    /// Hardest braking and largest acceleration, m/s².
    accelerations: (f64, f64),
    pub columns: Vec<Vec<Reached>>,
}

/// A boundary that lasts between two columns, with the extent that it has there.
struct Between<'a> {
    boundary: &'a StBoundary,
    lower: f64,
    upper: f64,
}

/// The step between two columns.
struct Step<'a> {
    column: usize,
    barriers: Vec<Between<'a>>,
    before: &'a [Reached],
    /// Slowest and fastest speed in the column before, m/s.
    speeds: (f64, f64),
}

impl<'a> Sweep<'a> {
    pub(super) fn new(
        config: &'a SpeedHeuristicConfig,
        graph: &'a StGraphData,
        vehicle: &VehicleParams,
        grid: &'a Grid,
    ) -> Self {
        Self {
            config,
            graph,
            costs: Costs::new(config, &graph.obstacles, vehicle.max_abs_speed_when_stopped),
            limits: grid.rows.iter().map(|s| graph.speed_limit.at(*s)).collect(),
            cruise: graph.cruise_speed(),
            accelerations: config.acceleration_range(vehicle),
            grid,
            columns: Vec::with_capacity(grid.columns.len()),
        }
    }

    /// Reaches as much of the grid as can be reached.
    pub(super) fn run(&mut self) {
        let root = self.root();
        let mut range = self.rows_after(&root);
        self.columns.push(root);
        for column in 1..self.grid.columns.len() {
            steps::count();
            let reached = self.column(column, range);
            range = self.rows_after(&reached);
            self.columns.push(reached);
        }
    }

    /// The start, unless an obstacle is on it.
    fn root(&self) -> Vec<Reached> {
        let obstacle = self.costs.obstacles_at(0.0).cost(0.0);
        let node = Node {
            obstacle,
            spatial: self.costs.spatial(self.graph.path_length, 0.0),
            total: 0.0,
            v: self.graph.init_v,
        };
        let root = Reached {
            row: 0,
            from: 0,
            before: [0.0; 2],
            node,
        };
        if obstacle.is_finite() {
            vec![root]
        } else {
            Vec::new()
        }
    }

    /// First and last row that the motion from some node of a column can lead to; nothing from nowhere.
    fn rows_after(&self, column: &[Reached]) -> Option<(usize, usize)> {
        let dt = self.config.unit_t;
        let (braking, driving) = self.accelerations;
        let ends = column.iter().map(|from| {
            let (s, v) = (self.grid.rows[from.row], from.node.v);
            let least = (v * dt + 0.5 * braking * (dt * dt)).max(0.0) + s;
            let most = v * dt + 0.5 * driving * (dt * dt) + s;
            (self.grid.row_from(least), self.grid.row_from(most))
        });
        ends.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    }

    fn column(&self, column: usize, range: Option<(usize, usize)>) -> Vec<Reached> {
        let Some((low, high)) = range else {
            return Vec::new();
        };
        let before = &self.columns[column - 1];
        let speeds = before.iter().map(|from| from.node.v);
        let step = Step {
            column,
            barriers: self.barriers(column),
            before,
            speeds: speeds.fold((f64::MAX, -f64::MAX), |(a, b), v| (a.min(v), b.max(v))),
        };
        let obstacles = self.costs.obstacles_at(self.grid.columns[column]);
        let mut reached = Vec::with_capacity((high + 1).saturating_sub(low));
        for row in low..=high {
            let obstacle = obstacles.cost(self.grid.rows[row]);
            if obstacle.is_finite() {
                reached.extend(self.reach(&step, row, obstacle));
            }
        }
        reached
    }

    /// The boundaries that an edge into a column may not touch.
    fn barriers(&self, column: usize) -> Vec<Between<'a>> {
        let (from, to) = (self.grid.columns[column - 1], self.grid.columns[column]);
        let boundaries = self.graph.obstacles.iter().map(|obstacle| &obstacle.boundary);
        let solid = boundaries.filter(|boundary| boundary.kind != BoundaryType::KeepClear);
        let lasting = solid.filter(|boundary| boundary.min_t() <= to && boundary.max_t() >= from);
        let extent = |boundary: &'a StBoundary| {
            let inner = boundary
                .pairs()
                .iter()
                .filter(|pair| pair.t >= from && pair.t <= to);
            let inner = inner.map(|pair| (pair.lower, pair.upper));
            let ends = [from, to].into_iter().filter_map(|t| boundary.edges_at(t));
            let all = inner.chain(ends.map(|edges| (edges.lower, edges.upper)));
            let (lower, upper) = all.fold((f64::MAX, -f64::MAX), |(low, high), pair| {
                (low.min(pair.0), high.max(pair.1))
            });
            Between {
                boundary,
                lower: lower - SLACK,
                upper: upper + SLACK,
            }
        };
        lasting.map(extent).collect()
    }

    /// The node at a row with its best predecessor, if it has one. Of equally good ones the farthest.
    fn reach(&self, step: &Step, row: usize, obstacle: f64) -> Option<Reached> {
        let (s, dt) = (self.grid.rows[row], self.config.unit_t);
        let spatial = self.costs.spatial(self.graph.path_length, s);
        let (braking, driving) = self.accelerations;
        let nearest = match step.column {
            1 => 0,
            _ => self
                .grid
                .row_from(s - self.config.upper_speed_limit * SPEED_RANGE * dt),
        };
        // Whoever is farther back would have to accelerate, whoever is nearer to brake, beyond all limits.
        let least = s - step.speeds.1 * dt - 0.5 * driving * (dt * dt) - SLACK;
        let most = s - step.speeds.0 * dt - 0.5 * braking * (dt * dt) + SLACK;
        let end = step
            .before
            .partition_point(|from| from.row <= row && self.grid.rows[from.row] <= most);
        let mut best: Option<Reached> = None;
        let mut least_total = f64::INFINITY;
        for from in step.before[..end].iter().rev() {
            let s_from = self.grid.rows[from.row];
            if from.row < nearest || s_from < least {
                break;
            }
            let Some(v) = self.speed_after(from, s_from, s) else {
                continue;
            };
            let limit = self.limit(step.column, from.row, row);
            let speed_cost = self.costs.speed(s_from, s, limit, self.cruise);
            let so_far = obstacle + spatial + from.node.total;
            // Costs of acceleration and jerk are not negative, and an edge that is too dear need not be free.
            if so_far + speed_cost >= least_total || self.is_barred(step, s_from, s) {
                continue;
            }
            let total = so_far
                + (speed_cost
                    + self.acceleration_cost(step.column, from, s)
                    + self.jerk_cost(step.column, from, s));
            if total < least_total {
                least_total = total;
                best = Some(Reached {
                    row,
                    from: from.row,
                    before: [s_from, from.before[0]],
                    node: Node {
                        obstacle,
                        spatial,
                        total,
                        v,
                    },
                });
            }
        }
        best
    }

    /// The limit of an edge: the lesser of those at its ends. At the start the car is as fast as it is.
    fn limit(&self, column: usize, from: usize, to: usize) -> f64 {
        match column {
            1 => self.limits[to],
            _ => self.limits[to].min(self.limits[from]),
        }
    }

    /// Speed at the end of the constant acceleration from a node to `s`, if that is within the limits.
    fn speed_after(&self, from: &Reached, s_from: f64, s: f64) -> Option<f64> {
        let dt = self.config.unit_t;
        let a = 2.0 * ((s - s_from) / dt - from.node.v) / dt;
        let v = from.node.v + a * dt;
        let (braking, driving) = self.accelerations;
        // Near the start a column is too coarse for the constant acceleration to tell a stop from backing up.
        #[expect(clippy::cast_precision_loss, reason = "few columns")]
        let blurred = self.config.dense_unit_s * self.grid.columns.len() as f64;
        let is_possible = a >= braking && a <= driving && !(v < BACKWARDS && s > blurred);
        is_possible.then_some(v)
    }

    fn is_barred(&self, step: &Step, s_from: f64, s: f64) -> bool {
        let [t_from, t] = [step.column - 1, step.column].map(|column| self.grid.columns[column]);
        step.barriers.iter().any(|between| {
            s >= between.lower
                && s_from <= between.upper
                && between
                    .boundary
                    .meets_segment(StPoint::new(t, s), StPoint::new(t_from, s_from))
        })
    }

    fn acceleration_cost(&self, column: usize, from: &Reached, s: f64) -> f64 {
        let (dt, s_from) = (self.config.unit_t, self.grid.rows[from.row]);
        self.costs.acceleration(match column {
            1 => differences::acceleration_from(self.graph.init_v, [s_from, s], dt),
            _ => differences::acceleration([from.before[0], s_from, s], dt),
        })
    }

    fn jerk_cost(&self, column: usize, from: &Reached, s: f64) -> f64 {
        let (dt, s_from) = (self.config.unit_t, self.grid.rows[from.row]);
        let (v, a) = (self.graph.init_v, self.graph.init_a);
        let [one, two] = from.before;
        self.costs.jerk(match column {
            1 => differences::jerk_from(v, a, [s_from, s], dt),
            2 => differences::jerk_from_speed(v, [one, s_from, s], dt),
            _ => differences::jerk([two, one, s_from, s], dt),
        })
    }

    /// The best node to end at: anywhere at the end of the time, or at the end of the path at any time.
    pub(super) fn best_end(&self) -> Option<(usize, Reached)> {
        let last = self.columns.len() - 1;
        let top = self.grid.rows.len() - 1;
        let at_last = self.columns[last].iter().map(|reached| (last, *reached));
        let at_top = self.columns.iter().enumerate().filter_map(|(column, reached)| {
            reached
                .last()
                .filter(|reached| reached.row == top)
                .map(|reached| (column, *reached))
        });
        let mut best: Option<(usize, Reached)> = None;
        for end in at_last.chain(at_top) {
            if best.is_none_or(|best| end.1.node.total < best.1.node.total) {
                best = Some(end);
            }
        }
        best
    }

    /// The nodes from the start to `end`.
    pub(super) fn path_to(&self, (column, end): (usize, Reached)) -> Vec<Reached> {
        let mut path = vec![end];
        for column in (0..column).rev() {
            let from = path[path.len() - 1].from;
            let reached = &self.columns[column];
            let place = reached.partition_point(|reached| reached.row < from);
            path.push(reached[place]);
        }
        path.reverse();
        path
    }
}
