//! The plan along one line: bundles, queue, checks, and braking where nothing passes them.

use super::PlanningTarget;
use super::backup::{BackupPair, backup_order, straightest};
use super::bundle::{Longitudinal, lateral_bundle, longitudinal_bundle};
use super::collision::{CollisionEnvironment, Footprint, Near};
use super::combine::{LongitudinalTrack, Motions, Point, combine};
use super::config::LatticeConfig;
use super::constraints::{Violation, is_steerable};
use super::cost::{Blocked, LateralProfile, Sampled};
use super::curve::{ConstantDeceleration, Curve};
use super::end_conditions;
use super::evaluator::{Evaluator, Pair, STOP_BUFFER, Surroundings};
use super::feasible_region::FeasibleRegion;
use super::grid::{HORIZON, SAMPLES};
use super::guide::guide_speeds;
use super::lateral_bounds::lateral_bounds;
use super::lateral_optimum::lateral_optimum;
use super::line_table::LineTable;
use super::path_time_graph::{LaneWidth, PathTimeGraph, Project};
use super::prediction::{motions_of, projected_speed};
use crate::frame::{Obstacle, ObstacleId};
use crate::geometry::Vec2;
use crate::geometry::frenet::FrenetMotion;
use crate::piecewise_jerk::Riccati;
use crate::steps;
use crate::vehicle::VehicleParams;

/// How far before the stop point stop curves end, m: what the stop filter asks for, and a little more.
const STOP_MARGIN: f64 = STOP_BUFFER + 0.01;

/// A car that is this near to its stop point has arrived, m.
const ARRIVED: f64 = 0.1;

/// Who goes on by less than this within the horizon stands, m.
const STANDS: f64 = 0.05;

/// Beside the line by less than this, what is behind the car in its lane is left to look out for itself, m.
const LANE_HALF_WIDTH: f64 = 2.0;

/// What a lateral curve may be farther from the line between two metres than at them, m.
const BETWEEN_METRES: f64 = 0.3;

/// What a plan along a line is made from.
#[derive(Clone, Copy)]
pub struct LineTask<'a> {
    /// The line.
    pub line: &'a LineTable,
    /// Where the plan starts.
    pub initial: FrenetMotion,
    /// Everything in the way or near it.
    pub obstacles: &'a [Obstacle],
    /// What the plan is for.
    pub target: PlanningTarget,
    /// The ego.
    pub vehicle: &'a VehicleParams,
    /// Settings.
    pub config: &'a LatticeConfig,
    /// Half-widths of the lane.
    pub lane_width: LaneWidth<'a>,
    /// Frenet coordinates of points.
    pub project: Project<'a>,
}

/// Why a pair may not be driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rejection {
    /// The line ends first, or the offset leads beyond the centre of one of its bends.
    LeavesLine,
    /// It does what it may not.
    Violates(Violation),
    /// It touches this obstacle.
    Touches(ObstacleId),
}

/// How the search along a line ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// With a pair that may be driven.
    Found(Pair),
    /// With braking that touches nothing.
    Backup(BackupPair),
    /// With the hardest braking, and even that is against something.
    LastResort(BackupPair, Rejection),
}

/// How much there was to search.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sizes {
    /// Longitudinal curves.
    pub longitudinal: usize,
    /// Those of them that keep their limits.
    pub candidates: usize,
    /// Lateral curves.
    pub lateral: usize,
    /// Pairs that were looked at.
    pub looked_at: usize,
}

/// What is driven along a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    /// How the search ended.
    pub outcome: Outcome,
    /// The trajectory.
    pub points: Vec<Point>,
    /// Its way across the line.
    pub lateral: Curve,
    /// How much there was to search.
    pub sizes: Sizes,
}

/// A longitudinal curve laid on the line, with what it comes near to.
#[derive(Clone, Debug, Default)]
pub(super) struct Laid {
    track: LongitudinalTrack,
    near: Near,
}

/// Everything that is known of one line before the search.
pub struct Lattice<'a> {
    pub(super) task: LineTask<'a>,
    pub(super) longitudinal: Vec<Longitudinal>,
    pub(super) laterals: Vec<LateralProfile>,
    guide: [f64; SAMPLES],
    blocked: Blocked,
    environment: CollisionEnvironment,
    ego: Footprint,
    /// What is nearer to the car already than the room that is kept.
    met_now: Vec<usize>,
    largest_offset: f64,
    /// What the path-time graph holds.
    pub graph: PathTimeGraph,
}

impl<'a> Lattice<'a> {
    /// Samples the curves of a task and looks at its obstacles.
    pub fn new(task: LineTask<'a>) -> Self {
        let [s, v, _] = task.initial.s;
        let graph = PathTimeGraph::new(task.obstacles, s, task.line, task.lane_width, task.project);
        let laterals = laterals(&task, &graph);
        let largest = laterals.iter().map(|lateral| lateral.largest).fold(0.0, f64::max);
        let (environment, ego) = (environment(&task), Footprint::of(task.vehicle));
        Self {
            longitudinal: longitudinal(&task, &graph),
            guide: guide_speeds(&task.target, s, v),
            blocked: graph.blocked(),
            met_now: environment.met_now(&ego, place_of(&task)),
            environment,
            ego,
            largest_offset: largest + BETWEEN_METRES,
            laterals,
            graph,
            task,
        }
    }

    /// The pairs of the curves that keep their limits, cheapest first.
    pub fn pairs(&self) -> Evaluator<'_> {
        let around = Surroundings {
            stop_s: self.task.target.stop_s,
            guide: &self.guide,
            blocked: &self.blocked,
            line: self.task.line,
        };
        let curves = self.longitudinal.iter().map(|longitudinal| &longitudinal.curve);
        Evaluator::new(curves, &self.laterals, &around, self.task.config.weights)
    }

    pub(super) fn lay(&self, curve: &Sampled, laid: &mut Laid) {
        laid.track.lay(curve, self.task.line);
        self.environment
            .find_near(&laid.track, self.largest_offset, &self.ego, &mut laid.near);
        if laid.track.way() < STANDS {
            // Too near is too near, but who waits there makes it no worse.
            laid.near.leave_out(&self.met_now);
        }
    }

    /// What is wrong with a pair, if anything is; how it moves is left in `motions`.
    pub(super) fn rejection(&self, laid: &Laid, lateral: usize, motions: &mut Motions) -> Option<Rejection> {
        motions.find(&laid.track, &self.laterals[lateral].curve);
        if motions.len() < SAMPLES {
            return Some(Rejection::LeavesLine);
        }
        let place = |k| motions.place(&laid.track, k);
        let touched = || {
            self.environment
                .touched_at(&laid.near, motions.len(), &self.ego, place)
        };
        motions
            .violation()
            .map(Rejection::Violates)
            .or_else(|| touched().map(Rejection::Touches))
    }

    /// The cheapest pair that may be driven, else braking; `None` where there is nothing to drive on.
    pub fn plan(&self) -> Option<Planned> {
        let mut motions = Motions::default();
        let mut queue = self.pairs();
        let mut sizes = Sizes {
            longitudinal: self.longitudinal.len(),
            candidates: queue.survivors().count(),
            lateral: self.laterals.len(),
            looked_at: 0,
        };
        let mut laid: Vec<Option<Laid>> = vec![None; self.longitudinal.len()];
        while let Some(pair) = queue.next() {
            sizes.looked_at += 1;
            steps::count();
            let Some(sampled) = queue.sampled(pair.longitudinal) else {
                continue;
            };
            let laid = laid[pair.longitudinal].get_or_insert_with(|| {
                let mut laid = Laid::default();
                self.lay(sampled, &mut laid);
                laid
            });
            if self.rejection(laid, pair.lateral, &mut motions).is_none() {
                return Some(Planned {
                    outcome: Outcome::Found(pair),
                    points: motions.points(&laid.track).collect(),
                    lateral: self.laterals[pair.lateral].curve.clone(),
                    sizes,
                });
            }
        }
        self.backup(sizes)
    }

    /// The gentlest constant braking that touches nothing and stays before the stop point, or passes it least; else the
    /// hardest.
    fn backup(&self, sizes: Sizes) -> Option<Planned> {
        let [s, v, _] = self.task.initial.s;
        let curves: Vec<Curve> = self
            .laterals
            .iter()
            .map(|lateral| lateral.curve.clone())
            .collect();
        let planned = |outcome, points, lateral: usize| Planned {
            outcome,
            points,
            lateral: curves[lateral].clone(),
            sizes,
        };
        let mut order = backup_order(s, v, &curves);
        order.sort_by(|a, b| self.beyond_stop(a).total_cmp(&self.beyond_stop(b)));
        for pair in order {
            let Some((points, rejection)) = self.braking(pair) else {
                continue;
            };
            if rejection.is_none() {
                return Some(planned(Outcome::Backup(pair), points, pair.lateral));
            }
        }
        let deceleration = self.task.vehicle.max_deceleration;
        let pair = BackupPair {
            deceleration,
            lateral: straightest(&curves, v * v / (-2.0 * deceleration))?,
            end_speed: 0.0,
        };
        let (points, rejection) = self.braking(pair)?;
        let outcome = match rejection {
            None => Outcome::Backup(pair),
            Some(rejection) => Outcome::LastResort(pair, rejection),
        };
        Some(planned(outcome, points, pair.lateral))
    }

    /// How far braking leads beyond the stop point within the horizon, m.
    fn beyond_stop(&self, pair: &BackupPair) -> f64 {
        let [s, v, _] = self.task.initial.s;
        let end = ConstantDeceleration::new(s, v, pair.deceleration).map_or(s, |curve| curve.at(HORIZON)[0]);
        let stop_s = self.task.target.stop_s.unwrap_or(f64::MAX);
        (end - stop_s.max(s)).max(0.0)
    }

    /// Constant braking as a trajectory, and what is wrong with it. Nobody asks it to be comfortable.
    fn braking(&self, pair: BackupPair) -> Option<(Vec<Point>, Option<Rejection>)> {
        let [s, v, _] = self.task.initial.s;
        let curve = ConstantDeceleration::new(s, v, pair.deceleration)?;
        let mut laid = Laid::default();
        self.lay(&Sampled::new(&curve.into()), &mut laid);
        let mut points = Vec::with_capacity(SAMPLES);
        combine(&laid.track, &self.laterals[pair.lateral].curve, &mut points);
        if points.len() < 2 {
            return None;
        }
        let bends = points.iter().any(|point| !is_steerable(point.kappa));
        let bends = bends.then_some(Rejection::Violates(Violation::Curvature));
        let rejection = bends.or_else(|| {
            self.environment
                .touched(&laid.near, &points, &self.ego)
                .map(Rejection::Touches)
        });
        Some((points, rejection))
    }
}

fn longitudinal(task: &LineTask, graph: &PathTimeGraph) -> Vec<Longitudinal> {
    let [s, v, _] = task.initial.s;
    let region = FeasibleRegion::new(s, v);
    if task.target.stop_s.is_some_and(|stop_s| s >= stop_s - ARRIVED) {
        // The stop filter lets everything pass that is beyond the stop point; nothing but standing is wanted there.
        return longitudinal_bundle(task.initial.s, &end_conditions::cruise(&region, 0.0), &[], &[]);
    }
    let mut beside = Vec::new();
    for entry in &graph.entries {
        let motions = task
            .obstacles
            .iter()
            .find(|obstacle| obstacle.id == entry.id)
            .map(motions_of);
        let motions = motions.unwrap_or_default();
        beside.extend(end_conditions::path_time(entry, &region, task.vehicle, |point| {
            projected_speed(&motions, task.line.at(point.s).pose.theta, point.t)
        }));
    }
    let stop = task
        .target
        .stop_s
        .map(|stop_s| end_conditions::stop(s, stop_s - STOP_MARGIN));
    let cruise = end_conditions::cruise(&region, task.target.cruise_speed);
    longitudinal_bundle(task.initial.s, &cruise, &beside, &stop.unwrap_or_default())
}

fn laterals(task: &LineTask, graph: &PathTimeGraph) -> Vec<LateralProfile> {
    let mut curves: Vec<Curve> = lateral_bundle(&task.initial)
        .into_iter()
        .map(Curve::from)
        .collect();
    if task.config.lateral_optimization {
        let (s, l) = (task.initial.s[0], task.initial.l[0]);
        let bounds = lateral_bounds(s, l, &graph.standing, task.lane_width, task.vehicle);
        curves.extend(lateral_optimum(task.initial.l, &bounds, &mut Riccati::new()));
    }
    curves.into_iter().map(LateralProfile::new).collect()
}

/// Place of the rear axle and heading at the start.
fn place_of(task: &LineTask) -> (Vec2, Vec2) {
    let foot = task.line.at(task.initial.s[0]);
    let [l, dl, _] = task.initial.l;
    let forward = foot.pose.forward();
    let left = Vec2::new(-forward.y, forward.x);
    let heading = (forward * (1.0 - foot.kappa * l) + left * dl).normalize();
    (foot.pose.position() + left * l, heading)
}

/// What the car has to keep clear of: all but what is behind it in its lane.
fn environment(task: &LineTask) -> CollisionEnvironment {
    let (s, l) = (task.initial.s[0], task.initial.l[0]);
    let (left, right) = (task.lane_width)(s).unwrap_or((LANE_HALF_WIDTH, LANE_HALF_WIDTH));
    let in_lane = -right < l && l < left;
    let is_behind = |obstacle: &Obstacle| {
        let at = (task.project)(obstacle.pose.position(), s);
        at.s < s && at.l.abs() < LANE_HALF_WIDTH
    };
    CollisionEnvironment::new(task.obstacles, 0.0, |obstacle| in_lane && is_behind(obstacle))
}
