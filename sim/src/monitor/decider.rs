//! `decider_ok`, `pull_over_retargets`: whether the answers are sound.
//!
//! A sound answer holds finite numbers only, bounds with `l_min <= l_max` and increasing stations, at least two
//! points in what is driven, and indices that exist.

use super::measure::{Extreme, Measure};
use super::plan::Plan;
use corridor_decider::decision::{Candidate, Decision, Outcome, PullOverTarget};
use corridor_decider::frame::Frame;
use corridor_decider::geometry::Pose;
use corridor_decider::tasks::path_bounds::PathBound;

/// Good number of unsound answers.
pub(super) const NO_VIOLATION: f64 = 0.0;

/// Changes of the target after its first choice that are good.
pub(super) const RETARGET_LIMIT: f64 = 1.0;

/// A target that moved less is the same, m: below it lies the noise of searching again from a moved ego.
const SAME_TARGET: f64 = 0.1;

/// The outcomes in the order of the verdict, with their names.
const OUTCOMES: [(Outcome, &str); 7] = [
    (Outcome::Normal, "normal"),
    (Outcome::PathReused, "path_reused"),
    (Outcome::SpeedFallback, "speed_fallback"),
    (Outcome::PathFallback, "path_fallback"),
    (Outcome::BlindStop, "blind_stop"),
    (Outcome::Hold, "hold"),
    (Outcome::EmergencyStop, "emergency_stop"),
];

/// Watches the decider's answers.
#[derive(Clone, Debug, Default)]
pub(super) struct DeciderWatch {
    violations: u32,
    first: Option<(f64, String)>,
    counts: [u32; OUTCOMES.len()],
    target: Option<PullOverTarget>,
    retargets: u32,
    last_retarget: Extreme,
}

impl DeciderWatch {
    pub(super) fn tick(&mut self, frame: &Frame, decision: &Decision, plan: &Plan) {
        if let Some(fault) = fault(frame, decision) {
            self.fail(frame.time, fault);
        }
        for (count, (outcome, _)) in self.counts.iter_mut().zip(OUTCOMES) {
            *count += u32::from(outcome == plan.outcome);
        }
        if let Some(target) = plan.target {
            let moved = |old: PullOverTarget| (old.position - target.position).norm() > SAME_TARGET;
            if self.target.is_some_and(moved) {
                self.retargets += 1;
                self.last_retarget
                    .raise(f64::from(self.retargets), frame.time, None);
            }
            self.target = Some(target);
        }
    }

    /// Notes that there was no sound answer.
    pub(super) fn fail(&mut self, time: f64, fault: String) {
        self.violations += 1;
        self.first.get_or_insert((time, fault));
    }

    /// When and how the first answer was unsound.
    pub(super) fn first_fault(&self) -> Option<&(f64, String)> {
        self.first.as_ref()
    }

    /// Ticks per outcome, those that happened.
    pub(super) fn outcomes(&self) -> Vec<(String, u32)> {
        let named = self.counts.iter().zip(OUTCOMES);
        let happened = named.filter(|(count, _)| **count > 0);
        happened
            .map(|(count, (_, name))| (name.to_owned(), *count))
            .collect()
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        let violations = Measure::new("decider_ok", Some(f64::from(self.violations)));
        let first = self.first.as_ref().map(|(time, _)| *time);
        let retargets = self.target.map(|_| f64::from(self.retargets));
        let retargets = self.last_retarget.measure("pull_over_retargets").value(retargets);
        vec![violations.at(first), retargets]
    }
}

/// The first thing wrong with an answer.
fn fault(frame: &Frame, decision: &Decision) -> Option<String> {
    // Where there is no line, none can be named.
    if decision.line >= frame.lines.len().max(1) {
        return Some(format!(
            "plans along line {} of {}",
            decision.line,
            frame.lines.len()
        ));
    }
    if decision.chosen.is_some_and(|k| k >= decision.candidates.len()) {
        return Some("chose a candidate that does not exist".to_owned());
    }
    for (k, Candidate { bound, .. }) in decision.candidates.iter().enumerate() {
        let least = if decision.chosen == Some(k) { 2 } else { 0 };
        if let Some(fault) = bound_fault(bound, least) {
            return Some(format!("bound `{}` {fault}", bound.label));
        }
    }
    path_fault(decision).map(str::to_owned)
}

fn bound_fault(bound: &PathBound, least_points: usize) -> Option<String> {
    let points = &bound.points;
    if points.len() < least_points {
        return Some(format!("is driven and has {} points", points.len()));
    }
    for point in points {
        if !(point.s.is_finite() && point.l_min.is_finite() && point.l_max.is_finite()) {
            return Some("holds a number that is not finite".to_owned());
        }
        if point.l_min > point.l_max {
            return Some(format!(
                "is unordered at s = {:.2}: {:.3} > {:.3}",
                point.s, point.l_min, point.l_max
            ));
        }
    }
    let back = points.windows(2).find(|pair| pair[1].s <= pair[0].s)?;
    Some(format!(
        "steps back from s = {:.3} to {:.3}",
        back[0].s, back[1].s
    ))
}

fn path_fault(decision: &Decision) -> Option<&'static str> {
    let sound = |pose: &Pose| pose.x.is_finite() && pose.y.is_finite() && pose.theta.is_finite();
    let path_is_finite = decision
        .path
        .iter()
        .all(|p| sound(&p.pose) && [p.distance, p.s, p.l, p.kappa].iter().all(|v| v.is_finite()));
    if !path_is_finite {
        return Some("path holds a number that is not finite");
    }
    let trajectory = &decision.trajectory;
    let trajectory_is_finite = trajectory
        .iter()
        .all(|p| sound(&p.pose) && [p.t, p.distance, p.kappa, p.v, p.a].iter().all(|v| v.is_finite()));
    if !trajectory_is_finite {
        return Some("trajectory holds a number that is not finite");
    }
    if trajectory.windows(2).any(|pair| pair[1].t <= pair[0].t) {
        return Some("trajectory steps back in time");
    }
    let target = decision.pull_over.as_ref();
    let target_is_finite = target.is_none_or(|t| t.position.norm().is_finite() && t.theta.is_finite());
    (!target_is_finite).then_some("pull-over target is not finite")
}
