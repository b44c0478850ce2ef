//! The ticks of a trace decided again, for what was weighed in them: a trace holds what came of it only.
//!
//! A decision is a pure function of the frames up to it, and a trace holds every frame exactly. So the ticks are decided
//! from the first one on, each with the memory of those before it; the rounded decisions of the trace are only held
//! against what comes out.

use crate::closed_loop::NoSink;
use crate::decider::Decider;
use crate::settings::Settings;
use crate::trace::Trace;
use corridor_decider::config::PlannerKind;
use corridor_decider::decision::{Decision, TrajectoryPoint};
use corridor_decider::planner::LatticeSurvey;

/// What a number may differ by and be the same: a trace has four decimals.
const SAME: f64 = 1e-3;

/// The lattice planner on its way through a trace.
pub(super) struct Again<'a> {
    trace: &'a Trace,
    decider: Decider,
    /// Place of the first tick that came out differently.
    differs_from: Option<usize>,
}

impl<'a> Again<'a> {
    /// `None` for a run of another planner, or with settings that this build does not know.
    pub(super) fn new(trace: &'a Trace) -> Option<Self> {
        let settings = Settings::with(&trace.header.overrides).ok()?;
        (settings.decider.planner == PlannerKind::Lattice).then(|| Self {
            trace,
            decider: Decider::new(trace.header.vehicle, &settings),
            differs_from: None,
        })
    }

    /// Place of the first tick that did not come out as it was recorded: another build wrote the trace, and nobody knows
    /// what was weighed then and later.
    pub(super) fn differs_from(&self) -> Option<usize> {
        self.differs_from
    }

    /// What was weighed in the tick at place `k`. To be asked for every tick in order.
    pub(super) fn survey(&mut self, k: usize) -> Option<LatticeSurvey> {
        if self.differs_from.is_some() {
            return None;
        }
        let frame = self.trace.frame(k)?;
        let survey = self.decider.survey(&frame);
        let decision = self.decider.decide(&frame, &mut NoSink);
        if decision.is_ok_and(|decision| is_same(&decision, &self.trace.ticks[k].decision)) {
            return survey;
        }
        self.differs_from = Some(k);
        None
    }
}

fn is_same(now: &Decision, then: &Decision) -> bool {
    let rung = |decision: &Decision| (decision.line, decision.outcome, decision.fallback);
    let mut points = now.trajectory.iter().zip(&then.trajectory);
    rung(now) == rung(then)
        && now.trajectory.len() == then.trajectory.len()
        && points.all(|(a, b)| is_near(a, b))
}

fn is_near(a: &TrajectoryPoint, b: &TrajectoryPoint) -> bool {
    let numbers = |p: &TrajectoryPoint| [p.t, p.pose.x, p.pose.y, p.v, p.a];
    let apart = |(a, b): (f64, f64)| (a - b).abs() > SAME;
    !numbers(a).into_iter().zip(numbers(b)).any(apart)
}
