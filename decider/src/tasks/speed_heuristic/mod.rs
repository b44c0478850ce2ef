//! `PATH_TIME_HEURISTIC_OPTIMIZER`: a first speed profile, by dynamic programming over a grid in the ST graph.
//!
//! `s` is metres along the path, `t` seconds from the planning start, and the columns are a second apart. What comes
//! out is coarse: it says before or after which obstacle the car passes, and what to smooth. Defects of the original
//! that are gone: the limit of an edge no longer depends on the predecessors tried before it, nor the cost of an
//! acceleration on those met before it; the last point of a profile has a speed.

mod config;
mod cost;
mod grid;
mod search;
mod task;
#[cfg(test)]
mod tests;

pub use config::SpeedHeuristicConfig;
pub use cost::{Costs, ObstaclesAt, differences};
pub use grid::Grid;
pub use task::run;

use crate::st_graph::{BoundaryType, SpeedData, SpeedPoint, StBoundary, StGraphData, StPoint};
use crate::vehicle::VehicleParams;
use search::Sweep;

/// A boundary whose first moment and nearest place are both nearer than this to the origin has the car in it.
const AT_START: f64 = 1e-2;

/// Added to each time between two points when their speed is taken, s.
const SPEED_TIME: f64 = 1e-3;

/// A node of the profile found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Cost of nearness to obstacles.
    pub obstacle: f64,
    /// Cost of the path that is left.
    pub spatial: f64,
    /// All costs up to here.
    pub total: f64,
    /// Speed here if every step had constant acceleration, m/s.
    pub v: f64,
}

/// What the search found.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The profile, one point a column; it may end early, at the end of the path.
    pub speed: SpeedData,
    /// Its nodes; none if the car is in an obstacle and stays where it is.
    pub nodes: Vec<Node>,
    /// How many nodes of each column could be reached.
    pub reached: Vec<usize>,
}

/// Why there is no profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SpeedHeuristicError {
    /// Lengths or steps that make no grid.
    #[error("path length, horizon or grid steps make no grid")]
    NoGrid,
    /// Every profile touches an obstacle or asks for too much braking.
    #[error("no speed profile keeps clear of the obstacles within the limits of acceleration")]
    NoProfile,
}

/// Searches the best profile through a graph.
///
/// # Errors
///
/// When no profile is possible, or the numbers given make no grid.
pub fn search(
    config: &SpeedHeuristicConfig,
    vehicle: &VehicleParams,
    graph: &StGraphData,
) -> Result<Found, SpeedHeuristicError> {
    let grid = Grid::new(config, graph.path_length, graph.total_time)?;
    if is_inside(graph) {
        return Ok(standing(&grid));
    }
    let mut sweep = Sweep::new(config, graph, vehicle, &grid);
    sweep.run();
    let end = sweep.best_end().ok_or(SpeedHeuristicError::NoProfile)?;
    let path = sweep.path_to(end);
    Ok(Found {
        speed: profile(&grid, path.iter().map(|reached| reached.row), graph.init_v),
        nodes: path.iter().map(|reached| reached.node).collect(),
        reached: sweep.columns.iter().map(Vec::len).collect(),
    })
}

/// Whether the car starts in an obstacle, or in what will be one.
fn is_inside(graph: &StGraphData) -> bool {
    let holds_start = |boundary: &StBoundary| {
        let begins_here = boundary.min_t().abs() < AT_START && boundary.min_s().abs() < AT_START;
        begins_here || boundary.contains(StPoint::new(0.0, 0.0))
    };
    let boundaries = graph.obstacles.iter().map(|obstacle| &obstacle.boundary);
    boundaries
        .filter(|boundary| boundary.kind != BoundaryType::KeepClear)
        .any(holds_start)
}

fn standing(grid: &Grid) -> Found {
    let points = grid.columns.iter().map(|t| SpeedPoint {
        t: *t,
        ..SpeedPoint::default()
    });
    Found {
        speed: SpeedData::new(points.collect()),
        nodes: Vec::new(),
        reached: Vec::new(),
    }
}

/// The points of one row a column. Each has the mean speed up to the next one, the last that up to itself.
fn profile(grid: &Grid, rows: impl Iterator<Item = usize>, init_v: f64) -> SpeedData {
    let places = rows.zip(&grid.columns);
    let mut points: Vec<SpeedPoint> = places
        .map(|(row, t)| SpeedPoint {
            t: *t,
            s: grid.rows[row],
            ..SpeedPoint::default()
        })
        .collect();
    let mut v = init_v;
    for k in 0..points.len() {
        if let Some(next) = points.get(k + 1) {
            v = (next.s - points[k].s) / (next.t - points[k].t + SPEED_TIME);
        }
        points[k].v = v;
    }
    SpeedData::new(points)
}
