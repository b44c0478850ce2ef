//! A path inside a bound: optimised along its middle way, or sampled, and checked by the whole footprint.
//!
//! The optimised path minimises offset and its first three derivatives inside the bound; the alternative, a task of its
//! own, is the best of a bundle of quintics (the lateral bundle of the original's lattice planner). A path ends
//! where the body would touch something: how far it leads is its *reach*. The way of the tick before is kept while
//! it is clear and nearly as good: a car that changes its mind ten times a second drives badly on any path.

mod assess;
mod bundle;
mod candidates;
mod corridor;
mod optimise;
mod profile;
mod reuse;
mod table;

pub(crate) use assess::{to_points, until_contact};
pub use candidates::{run, run_sampled};
pub(crate) use profile::Profile;
pub use reuse::{is_on, reuse};
pub use table::LineTable;
pub(crate) use table::STEP;

use super::path_bounds::PathBound;
use super::scene::Scene;
use crate::decision::{PathPoint, Rejection};
use crate::frame::ObstacleId;
use crate::piecewise_jerk::Riccati;
use corridor::Corridor;
use serde::{Deserialize, Serialize};

/// Settings of the path layer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PathConfig {
    /// Travel time over which the smoother looks, s: longer is gentler.
    pub smoothing_time: f64,
    /// Least length over which the smoother looks, m.
    pub least_smoothing_length: f64,
    /// Largest overshoot of a bound, m.
    pub bound_tolerance: f64,
    /// Room that the footprint keeps from static obstacles, m.
    pub clearance: f64,
    /// Share of the steering's curvature that a path may use.
    pub curvature_share: f64,
    /// Shortest path worth driving, m.
    pub least_reach: f64,
    /// Defect A3 of the original: only the corners of the footprint are checked, and not on the last 10.5 m.
    pub corner_collision_check: bool,
}

impl Default for PathConfig {
    fn default() -> Self {
        Self {
            smoothing_time: 0.6,
            least_smoothing_length: 4.0,
            bound_tolerance: 0.03,
            clearance: 0.1,
            curvature_share: 0.95,
            least_reach: 1.0,
            corner_collision_check: false,
        }
    }
}

/// A new way is taken when it costs less than this share of the way of the tick before, less this much: one
/// metre's stay at 0.45 m beside the middle.
const WORTH_A_CHANGE: (f64, f64) = (0.9, 0.2);

/// A drivable path.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Its points, a metre apart along the line. At least two.
    pub points: Vec<PathPoint>,
    /// What ends it, if something does before the bound's end.
    pub blocked_by: Option<ObstacleId>,
    /// Whether it leads to where the car is to stop, or else to the bound's end.
    pub leads_to_goal: bool,
    /// Whether it is what is left of the path of the tick before.
    pub is_reused: bool,
}

impl Path {
    /// Arc length, m.
    pub fn length(&self) -> f64 {
        self.points.last().map_or(0.0, |p| p.distance)
    }

    /// Whether it leads all the way, or at least to where the car stops.
    pub fn serves(&self, goal: Goal) -> bool {
        self.blocked_by.is_none() || goal.stop_s.is_some_and(|s| self.end_s() >= s)
    }

    /// The same path, knowing whether it serves its goal.
    fn leading_to(self, goal: Goal) -> Self {
        let leads_to_goal = self.serves(goal);
        Self {
            leads_to_goal,
            ..self
        }
    }

    /// Arc length at station `s`, going on straight beyond its ends.
    pub fn distance_at(&self, s: f64) -> f64 {
        let points = &self.points;
        let above = points.partition_point(|p| p.s <= s).clamp(1, points.len() - 1);
        let (a, b) = (&points[above - 1], &points[above]);
        a.distance + (s - a.s) / (b.s - a.s) * (b.distance - a.distance)
    }

    /// Station at arc length `distance`, going on straight beyond its ends.
    pub fn station_at(&self, distance: f64) -> f64 {
        let points = &self.points;
        let above = points
            .partition_point(|p| p.distance <= distance)
            .clamp(1, points.len() - 1);
        let (a, b) = (&points[above - 1], &points[above]);
        a.s + (distance - a.distance) / (b.distance - a.distance) * (b.s - a.s)
    }

    /// Station of its end, m.
    pub fn end_s(&self) -> f64 {
        self.points.last().map_or(0.0, |p| p.s)
    }
}

/// What a path is for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Goal {
    /// Offset that it is drawn to, m.
    pub l: f64,
    /// Station at which it has to be at that offset, along the line, because the car stops there.
    pub stop_s: Option<f64>,
}

/// How the best profile inside a corridor is found.
pub(super) enum Method<'a> {
    /// By the piecewise-jerk optimiser.
    Optimised(&'a mut Riccati),
    /// As the best of a bundle of quintics.
    Sampled,
}

/// The best path inside `bound`.
///
/// # Errors
/// [`Rejection`] of the most promising path when none can be driven.
fn best(
    scene: &Scene,
    table: &LineTable,
    bound: &PathBound,
    goal: Goal,
    last: Option<&[PathPoint]>,
    method: Method,
) -> Result<Path, Rejection> {
    let corridor = Corridor::new(scene, table, bound, goal, last).ok_or(Rejection::TooShort)?;
    let assess = |corridor: &Corridor, profile: Profile| {
        let cost = profile.cost(corridor);
        assess::assess(scene, table, corridor, &profile).map(|path| (cost, path))
    };
    let new = match method {
        Method::Optimised(solver) => {
            let whole = table.rows[corridor.len() - 1].s;
            let mut solve = |solved: &Corridor| {
                let profile = optimise::solve(scene, table, solved, solver)?;
                assess(&corridor, profile)
            };
            let smooth = solve(&corridor);
            if is_cut_short(&smooth, whole) {
                solve(&corridor.rounding(table)).or(smooth)
            } else {
                smooth
            }
        }
        Method::Sampled => best_of_bundle(&corridor, goal, |profile| assess(&corridor, profile)),
    };
    let kept = Profile::kept(&corridor).and_then(|old| assess(&corridor.widened(), old).ok());
    let path = match (new, kept) {
        (Ok(new), Some(kept)) if is_better(&new, &kept, goal) => Ok(new.1),
        (_, Some(kept)) => Ok(kept.1),
        (new, None) => new.map(|(_, path)| path),
    };
    path.map(|path| finish(path, bound))
}

/// Whether a path is missing or ends early because of its bends.
fn is_cut_short(path: &Result<(f64, Path), Rejection>, whole: f64) -> bool {
    match path {
        Ok((_, path)) => path.blocked_by.is_none() && path.end_s() < whole,
        Err(rejection) => *rejection == Rejection::Curvature,
    }
}

/// Whether a new way is so much better than the one that is being driven that it is worth to change.
fn is_better(new: &(f64, Path), kept: &(f64, Path), goal: Goal) -> bool {
    let serves = (new.1.serves(goal), kept.1.serves(goal));
    if serves != (true, true) {
        return serves.0 || (!serves.1 && new.1.end_s() + STEP >= kept.1.end_s());
    }
    let leads_farther = new.1.end_s() > kept.1.end_s() + STEP;
    leads_farther || new.0 < kept.0 * WORTH_A_CHANGE.0 - WORTH_A_CHANGE.1
}

/// The farthest-leading path of the bundle; among equals the one of least cost.
fn best_of_bundle(
    corridor: &Corridor,
    goal: Goal,
    assess: impl Fn(Profile) -> Result<(f64, Path), Rejection>,
) -> Result<(f64, Path), Rejection> {
    let mut profiles: Vec<(f64, Profile)> = bundle::sample(corridor)
        .into_iter()
        .map(|profile| (profile.cost(corridor), profile))
        .collect();
    profiles.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut best = Err(Rejection::LeavesBound);
    for (_, profile) in profiles {
        let path = match assess(profile) {
            Ok(path) => path,
            Err(rejection) => {
                best = best.map_err(|_: Rejection| rejection);
                continue;
            }
        };
        let serves = path.1.serves(goal);
        if best.as_ref().map_or(-1.0, |best: &(f64, Path)| best.1.end_s()) + STEP < path.1.end_s() {
            best = Ok(path);
        }
        if serves {
            break;
        }
    }
    best
}

/// A path that leads to the end of a blocked bound is blocked by what blocks the bound.
pub(crate) fn finish(mut path: Path, bound: &PathBound) -> Path {
    path.blocked_by = path.blocked_by.or(bound.blocked_by);
    path
}
