//! The ticks of a trace decided again, for what was weighed in them: a trace holds what came of it only.
//!
//! A decision is a pure function of the frames up to it, and a trace holds every frame exactly. So the ticks are decided
//! from the first one on, each with the memory of those before it; the rounded decisions of the trace are only held
//! against what comes out.

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
    /// Whether every tick so far came out as it was recorded.
    is_same: bool,
}

impl<'a> Again<'a> {
    /// `None` for a run of another planner, or with settings that this build does not know.
    pub(super) fn new(trace: &'a Trace) -> Option<Self> {
        let settings = Settings::with(&trace.header.overrides).ok()?;
        (settings.decider.planner == PlannerKind::Lattice).then(|| Self {
            trace,
            decider: Decider::new(trace.header.vehicle, &settings),
            is_same: true,
        })
    }

    /// Whether every tick so far came out as it was recorded. Where one does not (another build wrote the trace) nobody
    /// knows what was weighed then and later.
    pub(super) fn is_same(&self) -> bool {
        self.is_same
    }

    /// What was weighed in the tick at place `k`. To be asked for every tick in order.
    pub(super) fn survey(&mut self, k: usize) -> Option<LatticeSurvey> {
        if !self.is_same {
            return None;
        }
        let frame = self.trace.frame(k)?;
        let survey = self.decider.survey(&frame);
        let decision = self.decider.decide(&frame);
        self.is_same = decision.is_ok_and(|decision| is_same(&decision, &self.trace.ticks[k].decision));
        survey.filter(|_| self.is_same)
    }
}

fn is_same(now: &Decision, then: &Decision) -> bool {
    let has_same_rung =
        |a: &Decision, b: &Decision| (a.line, a.outcome, a.fallback) == (b.line, b.outcome, b.fallback);
    has_same_rung(now, then)
        && now.trajectory.len() == then.trajectory.len()
        && now
            .trajectory
            .iter()
            .zip(&then.trajectory)
            .all(|(a, b)| is_near(a, b))
}

fn is_near(a: &TrajectoryPoint, b: &TrajectoryPoint) -> bool {
    let numbers = |p: &TrajectoryPoint| [p.t, p.pose.x, p.pose.y, p.v, p.a];
    let apart = |(a, b): (f64, f64)| (a - b).abs() > SAME;
    !numbers(a).into_iter().zip(numbers(b)).any(apart)
}
