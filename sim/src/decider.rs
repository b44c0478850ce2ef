//! The decider as the loop sees it: a planner with its memory, behind a fault if one is planted, and fenced so
//! that a panic is an outcome of the run and not the end of the sweep.

use crate::faults::{self, Failure, Fault, Part, SUDDEN, mirrored, not_a_number};
use crate::settings::Settings;
use corridor_decider::config::PlannerKind;
use corridor_decider::context::Context;
use corridor_decider::decision::Decision;
use corridor_decider::frame::Frame;
use corridor_decider::planner::{self, LatticePlanner, Planner};
use corridor_scenarios::Scenario;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// One of the planners.
enum AnyPlanner {
    LaneFollow(Planner),
    Lattice(LatticePlanner),
}

impl AnyPlanner {
    fn new(scenario: &Scenario, settings: &Settings) -> Self {
        let (config, vehicle) = (settings.decider.clone(), scenario.vehicle);
        match config.planner {
            PlannerKind::LaneFollow => Self::LaneFollow(Planner::new(config, vehicle)),
            PlannerKind::Lattice => Self::Lattice(LatticePlanner::new(config, vehicle)),
        }
    }

    fn decide(&self, frame: &Frame, context: &mut Context) -> Decision {
        match self {
            Self::LaneFollow(planner) => planner.decide(frame, context),
            Self::Lattice(planner) => planner.decide(frame, context),
        }
    }

    /// The same under a probe. The lattice planner has no parts that it could look at.
    fn decide_under(&self, frame: &Frame, context: &mut Context, probe: &mut dyn Probe) -> Decision {
        match self {
            Self::LaneFollow(planner) => planner.decide_under(frame, context, probe),
            Self::Lattice(planner) => planner.decide(frame, context),
        }
    }
}

/// A planner and its memory.
pub(crate) struct Decider {
    planner: AnyPlanner,
    context: Context,
    fault: Fault,
    failures: Vec<Failure>,
}

impl Decider {
    pub(crate) fn new(scenario: &Scenario, settings: &Settings) -> Self {
        Self {
            planner: AnyPlanner::new(scenario, settings),
            context: Context::default(),
            fault: settings.fault,
            failures: settings.failures.clone(),
        }
    }

    /// Decides one frame; the error is what a panic said.
    pub(crate) fn decide(&mut self, frame: &Frame) -> Result<Decision, String> {
        let fault = self.fault;
        let decide = || match fault {
            Fault::Mirrored => self.decide_failing(&mirrored(frame)),
            Fault::Panic if frame.tick == SUDDEN => panic!("a planted fault"),
            Fault::Nan if frame.tick >= SUDDEN => not_a_number(self.decide_failing(frame)),
            Fault::None | Fault::Panic | Fault::Nan => self.decide_failing(frame),
        };
        catch_unwind(AssertUnwindSafe(decide)).map_err(|panic| said(&*panic).to_owned())
    }

    /// Decides with the parts failing that are to fail now.
    fn decide_failing(&mut self, frame: &Frame) -> Decision {
        let parts: Vec<Part> = faults::failing(&self.failures, frame.time).collect();
        if parts.is_empty() {
            return self.planner.decide(frame, &mut self.context);
        }
        let frame = parts
            .iter()
            .fold(frame.clone(), |frame, part| faults::without(frame, *part));
        let fails = |part| parts.iter().any(|failing| failing.is(part));
        self.planner
            .decide_with_failures(&frame, &mut self.context, &fails)
    }
}

/// What a panic said.
pub(crate) fn said(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or(panic.downcast_ref::<&str>().copied())
        .unwrap_or("no message")
}
