//! The simple planners: one tick from frame to decision along the line of the car's own lane.
//!
//! They decide no bounds, as the lattice planner does not: nothing that they drive is inside one.

use super::ground::{self, Ground, OWN_LANE, STOPPED};
use crate::baseline::{Baseline, Driven, Scene};
use crate::config::Config;
use crate::context::{Context, LastPath, LastTrajectory};
use crate::decision::{Decision, Fallback, FallbackCause, Outcome, SpeedRung, Stop};
use crate::fallback;
use crate::frame::Frame;
use crate::lattice;
use crate::reference_line::LineQuery;
use crate::tasks::start_point::{StartPoint, start_point};
use crate::vehicle::VehicleParams;

/// Decides tick after tick by one of the simple planners; what changes is in the [`Context`].
#[derive(Clone, Debug)]
pub struct BaselinePlanner {
    baseline: Baseline,
    config: Config,
    vehicle: VehicleParams,
}

impl BaselinePlanner {
    /// A planner for one vehicle.
    pub fn new(baseline: Baseline, config: Config, vehicle: VehicleParams) -> Self {
        Self {
            baseline,
            config,
            vehicle,
        }
    }

    /// Decides one tick. Never fails: what goes wrong is an [`Outcome`].
    pub fn decide(&self, frame: &Frame, context: &mut Context) -> Decision {
        let start = start_point(frame, context.last.as_ref());
        let decision = match fallback::context_failure(frame, &start, &self.vehicle) {
            Some(failure) => {
                fallback::without_context(frame, failure, context, &self.vehicle, &self.config.quirks)
            }
            None => self.plan(frame, &start, context),
        };
        context.last = (!decision.trajectory.is_empty()).then(|| LastTrajectory {
            time: frame.time,
            points: decision.trajectory.clone(),
        });
        decision
    }

    fn plan(&self, frame: &Frame, start: &StartPoint, context: &mut Context) -> Decision {
        context.blind_since = None;
        let ground = Ground::of(frame, 0, start, &self.vehicle);
        let driven = ground.map(|ground| {
            let driven = self.drive(frame, &ground);
            (ground, driven)
        });
        let decision = match driven {
            Some((ground, driven)) if driven.rollout.points.len() >= 2 => conclude(frame, &ground, driven),
            _ => Decision::without_path(
                Outcome::EmergencyStop,
                FallbackCause::NoSampledTrajectory,
                None,
                fallback::brake_on_arc(start, &self.vehicle),
            ),
        };
        context.stop = decision.stop;
        context.path = (!decision.path.is_empty()).then(|| LastPath {
            time: frame.time,
            label: OWN_LANE,
            points: decision.path.clone(),
        });
        decision
    }

    fn drive(&self, frame: &Frame, ground: &Ground) -> Driven {
        let line = &*frame.lines[0].line;
        self.baseline.drive(&Scene {
            line: &ground.table,
            initial: ground.initial,
            target: ground.target,
            speed_limit: &ground::speed_limits(line, ground.initial.s[0]),
            road_width: &|s| line.road_width(s),
            obstacles: &frame.obstacles,
            project: &lattice::projection(line),
            vehicle: &self.vehicle,
        })
    }
}

fn conclude(frame: &Frame, ground: &Ground, driven: Driven) -> Decision {
    let Driven {
        rollout,
        is_emergency,
    } = driven;
    let [start, ..] = ground.initial.s;
    let last = rollout.states[rollout.points.len() - 1];
    let cause = rollout.follows.map_or_else(
        || ground::end_of_drive(frame),
        |id| ground::stop_behind(frame, id),
    );
    let stop = Stop {
        distance: last.s - start,
        cause,
    };
    let fallback = Fallback {
        cause: FallbackCause::NoSampledTrajectory,
        path: None,
        speed: Some(SpeedRung::ConstantDeceleration),
    };
    Decision {
        line: 0,
        candidates: Vec::new(),
        chosen: None,
        path: ground::path(&ground.table, &rollout.lateral, start, last.s),
        trajectory: rollout.points,
        stop: (last.v < STOPPED).then_some(stop),
        outcome: if is_emergency {
            Outcome::SpeedFallback
        } else {
            Outcome::Normal
        },
        fallback: is_emergency.then_some(fallback),
        pull_over: None,
        tasks: Vec::new(),
    }
}
