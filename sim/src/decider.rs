//! The decider as the loop sees it: a planner with its memory, behind a fault if one is planted, and fenced so
//! that neither a panic nor an answer that takes for ever is the end of the sweep: both are outcomes of the run.
//!
//! What takes for ever is known by a count of steps, never by a clock: see [`corridor_decider::steps`]. That fences
//! planners that count. One that does not would need a thread of its own, and would no longer be bit-exact.

use crate::closed_loop::Sink;
use crate::faults::{self, Failure, Part, Planted};
use crate::settings::Settings;
use corridor_decider::baseline::Baseline;
use corridor_decider::config::PlannerKind;
use corridor_decider::context::Context;
use corridor_decider::decision::Decision;
use corridor_decider::frame::Frame;
use corridor_decider::planner::{
    self, BaselinePlanner, LatticePlanner, LatticeSurvey, LinePlan, Planner, Probe, TaskName,
};
use corridor_decider::steps;
use corridor_decider::vehicle::VehicleParams;
use std::any::Any;
use std::borrow::Cow;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Steps that an answer may take: more than twenty times as many as any sound one was seen to, which a test holds, and so
/// few that to go on for ever takes less than a second.
const STEP_LIMIT: u64 = 1_000_000;

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoAnswer {
    /// It panicked, and said this.
    #[error("{0}")]
    Panicked(String),
    /// It took more steps than an answer may take.
    #[error("no answer within {STEP_LIMIT} steps")]
    StepLimit,
}

/// One of the planners.
enum AnyPlanner {
    LaneFollow(Planner),
    Lattice(LatticePlanner),
    Baseline(BaselinePlanner),
}

impl AnyPlanner {
    fn new(vehicle: VehicleParams, settings: &Settings) -> Self {
        let planted = Planted::new(settings.fault);
        let config = planted.config(&settings.decider).into_owned();
        let vehicle = planted.car(vehicle);
        let baseline = |baseline, config| Self::Baseline(BaselinePlanner::new(baseline, config, vehicle));
        match config.planner {
            PlannerKind::Blind => baseline(Baseline::Blind, config),
            PlannerKind::Idm => baseline(Baseline::Idm, config),
            PlannerKind::PdmClosed => baseline(Baseline::PdmClosed, config),
            PlannerKind::LaneFollow => Self::LaneFollow(Planner::new(config, vehicle)),
            PlannerKind::Lattice => Self::Lattice(LatticePlanner::new(config, vehicle)),
        }
    }

    /// Decides under a probe. Only lane following has parts that it could look at.
    fn decide(&self, frame: &Frame, context: &mut Context, probe: &mut dyn Probe) -> Decision {
        match self {
            Self::LaneFollow(planner) => planner.decide_under(frame, context, probe),
            Self::Lattice(planner) => planner.decide(frame, context),
            Self::Baseline(planner) => planner.decide(frame, context),
        }
    }
}

/// A planner of which parts fail, whose tasks are heard of, and what they hand on is meddled with.
struct Watched<'a> {
    failing: Vec<Part>,
    planted: &'a mut Planted,
    sink: &'a mut dyn Sink,
}

impl Probe for Watched<'_> {
    fn fails(&self, part: planner::Part) -> bool {
        self.failing.iter().any(|failing| failing.is(part))
    }

    fn begins(&mut self, task: TaskName) {
        self.sink.begins(task);
    }

    fn ended(&mut self, task: TaskName) {
        self.sink.ended(task);
    }

    fn hands_on(&mut self, task: TaskName, plan: &mut LinePlan) {
        self.planted.hands_on(task, plan);
    }
}

/// A planner and its memory.
pub(crate) struct Decider {
    planner: AnyPlanner,
    context: Context,
    planted: Planted,
    failures: Vec<Failure>,
}

impl Decider {
    pub(crate) fn new(vehicle: VehicleParams, settings: &Settings) -> Self {
        Self {
            planner: AnyPlanner::new(vehicle, settings),
            context: Context::default(),
            planted: Planted::new(settings.fault),
            failures: settings.failures.clone(),
        }
    }

    /// Decides one frame.
    ///
    /// # Errors
    /// [`NoAnswer`] when that did not come to an end.
    pub(crate) fn decide(&mut self, frame: &Frame, sink: &mut dyn Sink) -> Result<Decision, NoAnswer> {
        let decide = || steps::within(STEP_LIMIT, || self.decide_unfenced(frame, sink)).0;
        catch_unwind(AssertUnwindSafe(decide)).map_err(|panic| {
            if panic.is::<steps::OutOfSteps>() {
                NoAnswer::StepLimit
            } else {
                NoAnswer::Panicked(said(&*panic).to_owned())
            }
        })
    }

    /// All that is going to be weighed when this frame is decided; the lattice planner only.
    pub(crate) fn survey(&self, frame: &Frame) -> Option<LatticeSurvey> {
        let survey = || match &self.planner {
            AnyPlanner::LaneFollow(_) | AnyPlanner::Baseline(_) => None,
            AnyPlanner::Lattice(planner) => {
                let seen = self.planted.clone().seen(frame);
                planner.survey(&self.failing(seen), self.context.last.as_ref())
            }
        };
        catch_unwind(AssertUnwindSafe(survey)).ok().flatten()
    }

    /// Decides behind the fault, with the parts failing that are to fail now.
    fn decide_unfenced(&mut self, frame: &Frame, sink: &mut dyn Sink) -> Decision {
        let seen = self.planted.seen(frame);
        let seen = self.failing(seen);
        let failing = faults::failing(&self.failures, frame.time).collect();
        self.planted.answers(frame);
        self.planted.remembered(&mut self.context);
        let mut watched = Watched {
            failing,
            planted: &mut self.planted,
            sink,
        };
        let decision = self.planner.decide(&seen, &mut self.context, &mut watched);
        self.planted.decided(decision)
    }

    /// The frame without what fails now.
    fn failing<'a>(&self, seen: Cow<'a, Frame>) -> Cow<'a, Frame> {
        let time = seen.time;
        faults::failing(&self.failures, time).fold(seen, |frame, part| {
            Cow::Owned(faults::without(frame.into_owned(), part))
        })
    }
}

/// What a panic said.
pub(crate) fn said(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or(panic.downcast_ref::<&str>().copied())
        .unwrap_or("no message")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closed_loop::NoSink;
    use crate::faults::Fault;
    use crate::run::{run, run_recorded};
    use crate::verdict::Ending;
    use corridor_scenarios::{MapCache, catalog};

    /// The most steps that a planner takes for an answer in a run.
    fn most_steps(scenario: &str, planner: PlannerKind) -> u64 {
        let family = catalog::find(scenario).unwrap().load(&MapCache::new()).unwrap();
        let scenario = family.draw(1).unwrap().scenario;
        let mut settings = Settings::default();
        settings.decider.planner = planner;
        let trace = run_recorded(&family, &scenario, &[], &settings);
        let mut decider = Decider::new(scenario.vehicle, &settings);
        let steps = trace.ticks.iter().map(|tick| {
            let decide = || decider.decide_unfenced(&tick.frame, &mut NoSink);
            steps::within(u64::MAX, decide).1
        });
        steps.max().unwrap()
    }

    #[test]
    fn no_sound_answer_comes_near_the_step_limit() {
        for planner in [PlannerKind::LaneFollow, PlannerKind::Lattice] {
            for scenario in ["bollards_askew", "parked_row_with_oncoming", "curve_cyclist"] {
                let most = most_steps(scenario, planner);
                let wanted = 10..STEP_LIMIT / 20;
                assert!(wanted.contains(&most), "{planner:?} on {scenario}: {most} steps");
            }
        }
    }

    #[test]
    fn an_answer_that_takes_for_ever_costs_one_run_and_no_more() {
        let settings = Settings {
            fault: Fault::named("answers_never").unwrap(),
            ..Settings::default()
        };
        let scenario = crate::testing::scenario(
            corridor_decider::geometry::Pose::new(20.0, 0.0, 0.0),
            8.0,
            Vec::new(),
        );
        let verdict = run(&scenario, &settings);
        assert_eq!(verdict.ending, Ending::DeciderFailed);
        assert!(
            verdict.outcomes.contains(&("step_limit".to_owned(), 1)),
            "{:?}",
            verdict.outcomes
        );
        assert!(verdict.summary.contains("steps"), "{}", verdict.summary);
        assert!(
            run(&scenario, &Settings::default())
                .outcomes
                .iter()
                .all(|(name, _)| name != "step_limit")
        );
    }
}
