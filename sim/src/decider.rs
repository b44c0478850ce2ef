//! The decider as the loop sees it: a planner with its memory, behind a fault if one is planted, and fenced so
//! that a panic is an outcome of the run and not the end of the sweep.

use crate::closed_loop::Sink;
use crate::faults::{self, Failure, Fault, Part, SUDDEN, mirrored, not_a_number};
use crate::settings::Settings;
use corridor_decider::baseline::Baseline;
use corridor_decider::config::PlannerKind;
use corridor_decider::context::Context;
use corridor_decider::decision::Decision;
use corridor_decider::frame::Frame;
use corridor_decider::planner::{
    self, BaselinePlanner, LatticePlanner, LatticeSurvey, Planner, Probe, TaskName,
};
use corridor_decider::vehicle::VehicleParams;
use std::any::Any;
use std::borrow::Cow;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// One of the planners.
enum AnyPlanner {
    LaneFollow(Planner),
    Lattice(LatticePlanner),
    Baseline(BaselinePlanner),
}

impl AnyPlanner {
    fn new(vehicle: VehicleParams, settings: &Settings) -> Self {
        let config = settings.decider.clone();
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

/// A planner of which parts fail and whose tasks are heard of.
struct Watched<'a> {
    failing: Vec<Part>,
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
}

/// A planner and its memory.
pub(crate) struct Decider {
    planner: AnyPlanner,
    context: Context,
    fault: Fault,
    failures: Vec<Failure>,
}

impl Decider {
    pub(crate) fn new(vehicle: VehicleParams, settings: &Settings) -> Self {
        Self {
            planner: AnyPlanner::new(vehicle, settings),
            context: Context::default(),
            fault: settings.fault,
            failures: settings.failures.clone(),
        }
    }

    /// Decides one frame; the error is what a panic said.
    pub(crate) fn decide(&mut self, frame: &Frame, sink: &mut dyn Sink) -> Result<Decision, String> {
        let fault = self.fault;
        let decide = || match fault {
            Fault::Panic if frame.tick == SUDDEN => panic!("a planted fault"),
            Fault::Nan if frame.tick >= SUDDEN => not_a_number(self.decide_failing(frame, sink)),
            Fault::None | Fault::Mirrored | Fault::Panic | Fault::Nan => self.decide_failing(frame, sink),
        };
        catch_unwind(AssertUnwindSafe(decide)).map_err(|panic| said(&*panic).to_owned())
    }

    /// All that is going to be weighed when this frame is decided; the lattice planner only.
    pub(crate) fn survey(&self, frame: &Frame) -> Option<LatticeSurvey> {
        let survey = || match &self.planner {
            AnyPlanner::LaneFollow(_) | AnyPlanner::Baseline(_) => None,
            AnyPlanner::Lattice(planner) => planner.survey(&self.seen(frame), self.context.last.as_ref()),
        };
        catch_unwind(AssertUnwindSafe(survey)).ok().flatten()
    }

    /// Decides with the parts failing that are to fail now.
    fn decide_failing(&mut self, frame: &Frame, sink: &mut dyn Sink) -> Decision {
        let seen = self.seen(frame);
        let failing = faults::failing(&self.failures, frame.time).collect();
        self.planner
            .decide(&seen, &mut self.context, &mut Watched { failing, sink })
    }

    /// The frame as the planner sees it, behind the fault and the failures.
    fn seen<'a>(&self, frame: &'a Frame) -> Cow<'a, Frame> {
        let seen = match self.fault {
            Fault::Mirrored => Cow::Owned(mirrored(frame)),
            Fault::None | Fault::Panic | Fault::Nan => Cow::Borrowed(frame),
        };
        faults::failing(&self.failures, frame.time).fold(seen, |frame, part| {
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
