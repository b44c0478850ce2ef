//! When a run is over, and how it ended. Judged at the sampling rate, except for collisions.

use super::TIME_TOLERANCE;
use super::measure::LongestSpan;
use super::plan::Plan;
use super::progress::ProgressWatch;
use super::pull_over::{PullOverWatch, is_pull_over};
use super::view::{Sample, StepView};
use crate::verdict::Ending;
use corridor_decider::frame::Command;
use corridor_decider::geometry::{ConvexPolygon, Vec2, angle};
use corridor_decider::reference_line::LineQuery;
use corridor_decider::tasks::path_bounds::Label;
use corridor_scenarios::Scenario;
use corridor_scenarios::scenario::Expectation;

/// Largest offset from the target lane's middle that counts as in the lane, m.
const LANE_OFFSET: f64 = 0.5;
/// Largest angle to the target lane that counts as along it, rad: half the original's pull-over tolerance.
const LANE_HEADING: f64 = 0.1;
/// How long the ego must stay so, s.
const LANE_SETTLED: f64 = 1.0;

/// How long a command must stay refused to count as refused, s: a bound reaches 100 m, which takes 20 s at the
/// original's slowest approach, 5 m/s.
const REFUSAL_TIME: f64 = 20.0;

/// Below this speed the ego stands behind a blocker, m/s.
const STANDS: f64 = 0.05;
/// How long it must stand, s.
const STANDS_FOR: f64 = 3.0;
/// Smallest and largest distance from the front bumper to the blocker, m: it neither touches nor gives up early.
const BLOCKER_GAP: (f64, f64) = (1.0, 10.0);
/// Distance that shows that the ego tried, m: one car length.
const APPROACHED: f64 = 5.0;
/// Room that a passing car wants on either side, m: the original's lateral buffer. Whatever leaves less blocks.
const PASSING_BUFFER: f64 = 0.4;

/// Watches for the end of a run.
#[derive(Clone, Debug, Default)]
pub(super) struct EndingWatch {
    in_target_lane: LongestSpan,
    standing: LongestSpan,
    accepted: bool,
    asked_since: Option<f64>,
    ending: Option<Ending>,
}

impl EndingWatch {
    /// How the run ended, once it has.
    pub(super) fn ending(&self) -> Option<Ending> {
        self.ending
    }

    /// Ends the run, unless it has ended before.
    pub(super) fn end(&mut self, ending: Ending) {
        self.ending.get_or_insert(ending);
    }

    /// The first ending that applies at this moment.
    pub(super) fn sample(&mut self, sample: &Sample, progress: &ProgressWatch, pull_over: &PullOverWatch) {
        let in_lane = self
            .in_target_lane
            .sample(is_in_target_lane(sample), sample.time());
        let standing = self.standing.sample(sample.ego().v.abs() < STANDS, sample.time());
        let expect = &sample.scenario.expect;
        let is_blocked =
            || progress.made() >= APPROACHED && gaps_ahead(sample).any(|gap| is_within(gap, BLOCKER_GAP));
        let ending = if expect.goal_region().is_some() {
            // Only time ends this search for a goal: who stands may go on.
            match (is_out_of_time(sample), standing > 0.0) {
                (false, _) => return,
                (true, true) => Ending::StoodStill,
                (true, false) => Ending::Timeout,
            }
        } else if progress.is_at_goal() {
            Ending::GoalReached
        } else if pull_over.is_done() {
            Ending::PulledOver
        } else if pull_over.is_botched() {
            Ending::PulledOverBadly
        } else if in_lane >= LANE_SETTLED && matches!(sample.scenario.command, Command::ChangeLane(_)) {
            Ending::LaneChanged
        } else if expect.allows_standstill() && standing >= STANDS_FOR && is_blocked() {
            Ending::StoodStill
        } else if expect.allows_refusal() && self.is_refused(sample) {
            Ending::Refused
        } else if is_out_of_time(sample) {
            Ending::Timeout
        } else {
            return;
        };
        self.end(ending);
    }

    /// Looks for a goal that is given as a region; such a one may be there for a single step.
    pub(super) fn step(&mut self, scenario: &Scenario, view: &StepView) {
        let Some(region) = scenario.expect.goal_region() else {
            return;
        };
        let center = scenario.vehicle.center(view.ego.pose);
        if region.is_met(view.time, center, view.ego.v) {
            self.end(Ending::GoalReached);
        }
    }

    /// Remembers whether the command was ever taken up.
    pub(super) fn tick(&mut self, scenario: &Scenario, plan: &Plan) {
        if plan.command != scenario.command || plan.command == Command::Cruise {
            return;
        }
        self.asked_since.get_or_insert(plan.time);
        self.accepted |= match plan.command {
            Command::ChangeLane(_) => plan.label() == Some(Label::LaneChange),
            _ => plan.target.is_some() || plan.label() == Some(Label::PullOver),
        };
    }

    /// Whether the command has been refused for good: long enough, past its place, or to the end of the run.
    fn is_refused(&self, sample: &Sample) -> bool {
        let Some(since) = self.asked_since.filter(|_| !self.accepted) else {
            return false;
        };
        let is_past = match sample.scenario.command {
            Command::PullOver(place) => sample.scenario.line.to_frenet(place).s < sample.at.s,
            _ => false,
        };
        is_past || sample.time() - since >= REFUSAL_TIME || is_out_of_time(sample)
    }
}

fn is_out_of_time(sample: &Sample) -> bool {
    sample.time() >= sample.scenario.timeout - TIME_TOLERANCE
}

/// Whether `ending` is what the scenario expects.
pub(super) fn is_expected(scenario: &Scenario, ending: Ending) -> bool {
    let expect = &scenario.expect;
    match ending {
        Ending::GoalReached => expect.goal().is_some() || expect.goal_region().is_some(),
        Ending::PulledOver => expect.allows_pull_over(),
        Ending::LaneChanged => *expect == Expectation::LaneChanged,
        Ending::Refused => expect.allows_refusal(),
        Ending::StoodStill => expect.allows_standstill(),
        Ending::PulledOverBadly | Ending::Collision | Ending::Timeout | Ending::DeciderFailed => false,
    }
}

fn is_within(value: f64, (low, high): (f64, f64)) -> bool {
    value >= low && value <= high
}

/// Whether the ego drives in the middle of the lane it was asked to change to.
fn is_in_target_lane(sample: &Sample) -> bool {
    let is_asked = sample.time() >= sample.scenario.command_time && !is_pull_over(sample.scenario.command);
    let Some(line) = sample.scenario.target_line.as_ref().filter(|_| is_asked) else {
        return false;
    };
    let pose = sample.ego().pose;
    let at = line.to_frenet(pose.position());
    let off = angle::difference(pose.theta, line.point(at.s).theta);
    at.l.abs() <= LANE_OFFSET && off.abs() <= LANE_HEADING
}

/// Distances from the front bumper to the obstacles in the strip that the ego needs to go on straight, m. One that could be
/// passed may stand before the one that blocks.
fn gaps_ahead<'a>(sample: &'a Sample) -> impl Iterator<Item = f64> + 'a {
    let vehicle = &sample.scenario.vehicle;
    let reach = vehicle.half_width() + PASSING_BUFFER;
    let pose = sample.ego().pose;
    let ahead = move |outline: &ConvexPolygon| {
        let local = |v: Vec2| pose.to_local(v);
        let parts = outline
            .edges()
            .filter_map(|(a, b)| nearest_in_strip(local(a), local(b), reach));
        let near = parts.reduce(f64::min)? - vehicle.front_edge_to_center;
        (near >= 0.0).then_some(near)
    };
    sample
        .scenario
        .obstacles
        .iter()
        .filter_map(move |o| ahead(&sample.outline(o.id)?))
}

/// The least `x` of the part of a segment that lies within `reach` of the `x` axis. A long wall that comes into the
/// strip far ahead is as far away as it is there.
fn nearest_in_strip(a: Vec2, b: Vec2, reach: f64) -> Option<f64> {
    let (low, high) = if a.y <= b.y { (a, b) } else { (b, a) };
    if low.y > reach || high.y < -reach {
        return None;
    }
    let at = |y: f64| {
        let rise = high.y - low.y;
        let share = if rise > 0.0 {
            ((y - low.y) / rise).clamp(0.0, 1.0)
        } else {
            0.0
        };
        low.x + (high.x - low.x) * share
    };
    let ends = if high.y > low.y {
        [at(-reach), at(reach)]
    } else {
        [low.x, high.x]
    };
    Some(ends[0].min(ends[1]))
}
