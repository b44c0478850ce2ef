//! The lane-follow planner: one tick from frame to decision.

use super::plan::LinePlan;
use super::probe::Probe;
use super::stage;
use super::task::TaskName;
use crate::config::Config;
use crate::context::{Context, LastPath, LastTrajectory};
use crate::decision::{Candidate, Decision, FallbackCause, PullOverTarget};
use crate::fallback::{self, Driven};
use crate::frame::Frame;
use crate::tasks::lane_change;
use crate::tasks::path_bounds::Label;
use crate::tasks::scene::Scene;
use crate::tasks::start_point::{StartPoint, start_point};
use crate::trajectory;
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

    /// Decides one tick. Never fails: what goes wrong is an [`crate::decision::Outcome`].
    pub fn decide(&self, frame: &Frame, context: &mut Context) -> Decision {
        self.decide_under(frame, context, &mut ())
    }

    /// The same under a probe.
    pub fn decide_under(&self, frame: &Frame, context: &mut Context, probe: &mut dyn Probe) -> Decision {
        let start = start_point(frame, context.last.as_ref());
        let decision = match fallback::context_failure(frame, &start, &self.vehicle) {
            Some(failure) => {
                fallback::without_context(frame, failure, context, &self.vehicle, &self.config.quirks)
            }
            None => self.plan(frame, start, context, probe),
        };
        context.last = (!decision.trajectory.is_empty()).then(|| LastTrajectory {
            time: frame.time,
            points: decision.trajectory.clone(),
        });
        decision
    }

    /// Plans along one line after the other until one can be driven: the one to change to before the car's own. Only
    /// the last one has fallbacks, for the others it is one.
    fn plan(
        &self,
        frame: &Frame,
        start: StartPoint,
        context: &mut Context,
        probe: &mut dyn Probe,
    ) -> Decision {
        context.blind_since = None;
        let mut reports = Vec::new();
        if let Some(target) = lane_change::target_line(frame) {
            let mut plan = LinePlan::new(Scene::new(frame, target, &self.vehicle, &self.config, start));
            let mut memory = context.clone();
            match stage::run(&self.config.tasks, &mut plan, &mut memory, probe) {
                Ok(()) if trajectory::normal(&plan).is_ok() => {
                    *context = memory;
                    return conclude(plan, context, None, probe);
                }
                result => {
                    context.lane_change = memory.lane_change;
                    context.bounds.change_lane = memory.bounds.change_lane;
                    if !matches!(result, Err((TaskName::LaneChange, _))) {
                        lane_change::give_up(&mut context.lane_change, frame.time);
                    }
                    reports = plan.reports;
                }
            }
        }
        let mut plan = LinePlan::new(Scene::new(frame, 0, &self.vehicle, &self.config, start));
        plan.reports = reports;
        let result = stage::run(&self.config.tasks, &mut plan, context, probe);
        let failed = result.err().map(|(task, _)| FallbackCause::Task(task));
        conclude(plan, context, failed, probe)
    }
}

/// From a plan to a decision, with what the next tick has to know.
fn conclude(
    plan: LinePlan,
    context: &mut Context,
    failed: Option<FallbackCause>,
    probe: &dyn Probe,
) -> Decision {
    let planned = match failed {
        Some(cause) => Err(cause),
        None => trajectory::normal(&plan).map_err(FallbackCause::Trajectory),
    };
    let driven = match planned {
        Ok(trajectory) => Driven::planned(&plan, trajectory),
        Err(cause) => fallback::along_line(&plan, context.path.as_ref(), cause, &|part| probe.fails(part)),
    };
    remember(&plan, context);
    let label = plan.label();
    let place = context
        .bounds
        .pull_over
        .place
        .filter(|_| label == Some(Label::PullOver));
    let candidates = plan.bounds.bounds.into_iter().zip(plan.assessments);
    Decision {
        line: usize::from(plan.scene.is_change_lane),
        candidates: candidates
            .map(|(bound, assessment)| Candidate { bound, assessment })
            .collect(),
        chosen: plan.chosen.map(|(place, _)| place),
        path: driven.path,
        trajectory: driven.trajectory,
        stop: plan.stop,
        outcome: driven.outcome,
        fallback: driven.fallback,
        pull_over: place.map(|place| PullOverTarget {
            position: place.position,
            theta: place.theta,
        }),
        tasks: plan.reports,
    }
}

/// What the next tick has to know of this one.
fn remember(plan: &LinePlan, context: &mut Context) {
    context.stop = plan.stop;
    if let Some((place, path)) = &plan.chosen {
        context.bounds.passed.clone_from(&plan.bounds.passed[*place]);
        context.path = Some(LastPath {
            time: plan.scene.frame.time,
            label: plan.bounds.bounds[*place].label,
            points: path.points.clone(),
        });
    }
}
