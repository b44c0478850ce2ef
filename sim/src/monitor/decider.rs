//! `decider_ok`, `pull_over_retargets`: whether the answers are sound.
//!
//! A sound answer holds finite numbers only, bounds with `l_min <= l_max` and increasing stations, a trajectory that does
//! not step back, at least two points in what is driven, and indices that exist. Whatever else an answer is counts under
//! the name of its breakdown, not under its own outcome.

use super::measure::{Extreme, Measure};
use super::plan::Plan;
use crate::decider::NoAnswer;
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

/// What is no answer, and what is one only by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Breakdown {
    /// It panicked.
    Panicked,
    /// It took more steps than an answer may take.
    StepLimit,
    /// A number is not finite.
    NotFinite,
    /// Limits, stations or times are out of order.
    Unordered,
    /// There is nothing in what is to be driven.
    Empty,
    /// It names a line or a candidate that does not exist.
    Dangling,
}

/// All of them in the order of the verdict, with their names.
const BREAKDOWNS: [(Breakdown, &str); 6] = [
    (Breakdown::Panicked, "panicked"),
    (Breakdown::StepLimit, "step_limit"),
    (Breakdown::NotFinite, "not_finite"),
    (Breakdown::Unordered, "unordered"),
    (Breakdown::Empty, "empty"),
    (Breakdown::Dangling, "dangling"),
];

/// What is wrong with an answer, and what to say of it.
type Fault = (Breakdown, String);

/// Watches the decider's answers.
#[derive(Clone, Debug, Default)]
pub(super) struct DeciderWatch {
    violations: u32,
    first: Option<(f64, String)>,
    counts: [u32; OUTCOMES.len()],
    breakdowns: [u32; BREAKDOWNS.len()],
    target: Option<PullOverTarget>,
    retargets: u32,
    last_retarget: Extreme,
}

impl DeciderWatch {
    pub(super) fn tick(&mut self, frame: &Frame, decision: &Decision, plan: &Plan) {
        match fault(frame, decision) {
            Some(fault) => self.fail(frame.time, fault),
            None => {
                for (count, (outcome, _)) in self.counts.iter_mut().zip(OUTCOMES) {
                    *count += u32::from(outcome == plan.outcome);
                }
            }
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

    /// Notes that there was no answer.
    pub(super) fn no_answer(&mut self, time: f64, why: &NoAnswer) {
        let breakdown = match why {
            NoAnswer::Panicked(_) => Breakdown::Panicked,
            NoAnswer::StepLimit => Breakdown::StepLimit,
        };
        self.fail(time, (breakdown, why.to_string()));
    }

    /// Notes that there was no sound answer.
    fn fail(&mut self, time: f64, (breakdown, fault): Fault) {
        self.violations += 1;
        for (count, (other, _)) in self.breakdowns.iter_mut().zip(BREAKDOWNS) {
            *count += u32::from(other == breakdown);
        }
        self.first.get_or_insert((time, fault));
    }

    /// When and how the first answer was unsound.
    pub(super) fn first_fault(&self) -> Option<&(f64, String)> {
        self.first.as_ref()
    }

    /// Ticks per outcome and per breakdown, those that happened.
    pub(super) fn outcomes(&self) -> Vec<(String, u32)> {
        let outcomes = self.counts.iter().zip(OUTCOMES.map(|(_, name)| name));
        let breakdowns = self.breakdowns.iter().zip(BREAKDOWNS.map(|(_, name)| name));
        let happened = outcomes.chain(breakdowns).filter(|(count, _)| **count > 0);
        happened.map(|(count, name)| (name.to_owned(), *count)).collect()
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
fn fault(frame: &Frame, decision: &Decision) -> Option<Fault> {
    // Where there is no line, none can be named.
    if decision.line >= frame.lines.len().max(1) {
        let text = format!("plans along line {} of {}", decision.line, frame.lines.len());
        return Some((Breakdown::Dangling, text));
    }
    if decision.chosen.is_some_and(|k| k >= decision.candidates.len()) {
        let text = "chose a candidate that does not exist".to_owned();
        return Some((Breakdown::Dangling, text));
    }
    for (k, Candidate { bound, .. }) in decision.candidates.iter().enumerate() {
        let least = if decision.chosen == Some(k) { 2 } else { 0 };
        if let Some((breakdown, fault)) = bound_fault(bound, least) {
            return Some((breakdown, format!("bound `{}` {fault}", bound.label)));
        }
    }
    path_fault(decision).map(|(breakdown, fault)| (breakdown, fault.to_owned()))
}

fn bound_fault(bound: &PathBound, least_points: usize) -> Option<Fault> {
    let points = &bound.points;
    if points.len() < least_points {
        let text = format!("is driven and has {} points", points.len());
        return Some((Breakdown::Empty, text));
    }
    for point in points {
        if !(point.s.is_finite() && point.l_min.is_finite() && point.l_max.is_finite()) {
            let text = "holds a number that is not finite".to_owned();
            return Some((Breakdown::NotFinite, text));
        }
        if point.l_min > point.l_max {
            let text = format!(
                "is unordered at s = {:.2}: {:.3} > {:.3}",
                point.s, point.l_min, point.l_max
            );
            return Some((Breakdown::Unordered, text));
        }
    }
    let back = points.windows(2).find(|pair| pair[1].s <= pair[0].s)?;
    let text = format!("steps back from s = {:.3} to {:.3}", back[0].s, back[1].s);
    Some((Breakdown::Unordered, text))
}

fn path_fault(decision: &Decision) -> Option<(Breakdown, &'static str)> {
    let Decision { path, trajectory, .. } = decision;
    let sound = |pose: &Pose| pose.x.is_finite() && pose.y.is_finite() && pose.theta.is_finite();
    let is_finite = |numbers: &[f64]| numbers.iter().all(|number| number.is_finite());
    let mut on_path = path.iter();
    if !on_path.all(|p| sound(&p.pose) && is_finite(&[p.distance, p.s, p.l, p.kappa])) {
        return Some((Breakdown::NotFinite, "path holds a number that is not finite"));
    }
    let mut driven = trajectory.iter();
    if !driven.all(|p| sound(&p.pose) && is_finite(&[p.t, p.distance, p.kappa, p.v, p.a])) {
        return Some((
            Breakdown::NotFinite,
            "trajectory holds a number that is not finite",
        ));
    }
    if decision.outcome.is_planned() && trajectory.len() < 2 {
        return Some((Breakdown::Empty, "trajectory has fewer than two points"));
    }
    if trajectory.windows(2).any(|pair| pair[1].t <= pair[0].t) {
        return Some((Breakdown::Unordered, "trajectory steps back in time"));
    }
    let target = decision.pull_over.as_ref();
    let target_is_finite = target.is_none_or(|t| t.position.norm().is_finite() && t.theta.is_finite());
    (!target_is_finite).then_some((Breakdown::NotFinite, "pull-over target is not finite"))
}
