//! The lane-follow planner: one tick from frame to decision.

use super::braking;
use super::choice::{self, Choice};
use crate::config::Config;
use crate::context::{Context, LastPath, LastTrajectory};
use crate::decision::{Assessment, Candidate, Decision, Outcome, PullOverTarget, Rejection, Stop, StopCause};
use crate::frame::{Command, Frame};
use crate::tasks::path::{LineTable, Path};
use crate::tasks::path_bounds::{self, Input, Label, PathBound, PathBounds, PullOverKind};
use crate::tasks::scene::Scene;
use crate::tasks::start_point::{StartPoint, at_time, start_point};
use crate::tasks::{lane_borrow, lane_change, speed};
use crate::vehicle::VehicleParams;

/// Decides tick after tick with fixed settings; what changes is in the [`Context`].
#[derive(Clone, Debug)]
pub struct Planner {
    config: Config,
    vehicle: VehicleParams,
}

impl Planner {
    /// A planner for one vehicle.
    pub fn new(config: Config, vehicle: VehicleParams) -> Self {
        Self { config, vehicle }
    }

    /// Decides one tick. Never fails: what goes wrong is an [`Outcome`].
    pub fn decide(&self, frame: &Frame, context: &mut Context) -> Decision {
        let start = start_point(frame, context.last.as_ref());
        let decision = match self.choose_line(frame, start, context) {
            Some(scene) => decide_along(&scene, context),
            None => emergency_stop(frame, &start, context, &self.vehicle),
        };
        context.last = Some(LastTrajectory {
            time: frame.time,
            points: decision.trajectory.clone(),
        });
        decision
    }

    /// The target line while a change of lane is clear, else the ego's own.
    fn choose_line<'a>(
        &'a self,
        frame: &'a Frame,
        start: StartPoint,
        context: &mut Context,
    ) -> Option<Scene<'a>> {
        let scene = |place| Scene::new(frame, place, &self.vehicle, &self.config, start);
        let target = lane_change::target_line(frame).map(scene);
        if let Some(target) = target {
            context.bounds.change_lane.is_clear = lane_change::is_clear(&target, &mut context.lane_change);
            if context.bounds.change_lane.is_clear {
                return Some(target);
            }
        }
        let mut own = (!frame.lines.is_empty()).then(|| scene(0))?;
        if lane_change::target_line(frame).is_some() {
            // Who keeps the speed of the traffic beside him never meets another gap.
            own.cruise_speed *= self.config.speed.gap_seeking_share;
        }
        Some(own)
    }
}

/// One tick along one line: bounds, paths, choice, speed.
fn decide_along(scene: &Scene, context: &mut Context) -> Decision {
    request_pull_over(scene, context);
    let borrow = lane_borrow::decide(scene, &mut context.borrow);
    let input = Input {
        ego: scene.ego,
        ego_end_s: scene.ego_end_s(),
        obstacles: &scene.obstacles,
        config: &scene.config.path_bounds,
        vehicle: scene.vehicle,
        cruise_speed: scene.frame.cruise_speed,
        is_change_lane: scene.is_change_lane,
        path_reusable: false,
        borrow: &borrow,
        destination: destination(scene),
    };
    let Ok(bounds) = path_bounds::decide(scene.line, &input, &mut context.bounds) else {
        return emergency_stop(scene.frame, &scene.start, context, scene.vehicle);
    };
    let end_s = bounds
        .bounds
        .iter()
        .map(PathBound::end_s)
        .fold(scene.ego.s, f64::max);
    let table = LineTable::new(scene.line, scene.ego.s, end_s);
    let choice = choice::choose(scene, &table, &bounds, context);
    lane_borrow::observe(&mut context.borrow, choice.own_lane_is_blocked);
    lane_borrow::observe_traffic(&mut context.borrow, choice.is_free_to_borrow);
    drive(scene, context, bounds, choice)
}

/// Keeps the pull-over request in step with the command.
fn request_pull_over(scene: &Scene, context: &mut Context) {
    let kind = match scene.frame.command {
        Command::PullOver(_) => Some(PullOverKind::Destination),
        Command::EmergencyPullOver => Some(PullOverKind::Emergency),
        _ => None,
    };
    let state = &mut context.bounds.pull_over;
    match kind {
        Some(kind) if state.is_requested && state.kind == kind => {}
        Some(kind) => {
            *state = path_bounds::PullOver {
                is_requested: true,
                kind,
                place: None,
            }
        }
        None => *state = path_bounds::PullOver::default(),
    }
}

fn destination(scene: &Scene) -> Option<crate::geometry::Vec2> {
    match scene.frame.command {
        Command::PullOver(destination) => Some(destination),
        _ => None,
    }
}

/// Turns the choice into a trajectory and remembers what the next tick needs.
fn drive(scene: &Scene, context: &mut Context, bounds: PathBounds, choice: Choice) -> Decision {
    let Some((chosen, path)) = choice.path else {
        context.path = None;
        let mut decision = emergency_stop(scene.frame, &scene.start, context, scene.vehicle);
        decision.candidates = candidates(bounds, &choice.assessments);
        return decision;
    };
    let label = bounds.bounds[chosen].label;
    context.bounds.passed.clone_from(&bounds.passed[chosen]);
    context.path = Some(LastPath {
        label,
        points: path.points.clone(),
    });
    let purpose = speed::Purpose {
        stop_at: pull_over_stop(scene, context, label, &path),
        before: context.stop,
        may_pull_out: choice
            .borrow_leads_on
            .unwrap_or_else(|| lane_borrow::is_permitted(scene)),
    };
    let planned = speed::plan(scene, &path, purpose);
    context.stop = planned.stop;
    let place = context
        .bounds
        .pull_over
        .place
        .filter(|_| label == Label::PullOver);
    Decision {
        line: usize::from(scene.is_change_lane),
        candidates: candidates(bounds, &choice.assessments),
        chosen: Some(chosen),
        path: path.points,
        trajectory: planned.trajectory,
        stop: planned.stop,
        outcome: if label == Label::Fallback {
            Outcome::PathFallback
        } else {
            Outcome::Normal
        },
        pull_over: place.map(|place| PullOverTarget {
            position: place.position,
            theta: place.theta,
        }),
    }
}

fn candidates(bounds: PathBounds, assessments: &[Assessment]) -> Vec<Candidate> {
    let pair = |(bound, assessment): (_, &Assessment)| Candidate {
        bound,
        assessment: *assessment,
    };
    bounds.bounds.into_iter().zip(assessments).map(pair).collect()
}

/// The place to stand at the road's edge, as a stop on the path.
fn pull_over_stop(scene: &Scene, context: &Context, label: Label, path: &Path) -> Option<Stop> {
    use crate::reference_line::LineQuery;
    let place = context
        .bounds
        .pull_over
        .place
        .filter(|_| label == Label::PullOver)?;
    let s = scene.line.to_frenet(place.position).s - scene.config.speed.pull_over_early;
    Some(Stop {
        distance: speed::distance_at(path, s).max(0.0),
        cause: StopCause::PullOver,
    })
}

/// Nothing to plan along: full braking on the last path or straight ahead.
fn emergency_stop(frame: &Frame, start: &StartPoint, context: &Context, vehicle: &VehicleParams) -> Decision {
    let last = context.last.as_ref().and_then(|last| {
        let now = at_time(&last.points, frame.time - last.time)?;
        Some((last, now.distance))
    });
    Decision {
        line: 0,
        candidates: Vec::new(),
        chosen: None,
        path: Vec::new(),
        trajectory: braking::braking_trajectory(start, last, -vehicle.max_deceleration),
        stop: None,
        outcome: if last.is_some() {
            Outcome::LastPath
        } else {
            Outcome::EmergencyStop
        },
        pull_over: None,
    }
}

/// Why a bound offers nothing, for the record.
pub(super) fn rejected(rejection: Rejection) -> Assessment {
    Assessment::NoPath(rejection)
}
