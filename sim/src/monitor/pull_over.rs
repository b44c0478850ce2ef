//! `pull_over_success` and its parts: whether the ego stands where it chose to, by the original's numbers.
//!
//! Apollo's `CheckADCPullOver` with `pull_over_config.pb.txt`. Stations and offsets on the scenario's line, m; the ego
//! and the target are rear axles.

use super::measure::{LongestSpan, Measure};
use super::view::Sample;
use corridor_decider::decision::{PullOverTarget, StopCause};
use corridor_decider::frame::Command;
use corridor_decider::geometry::angle;
use corridor_decider::reference_line::LineQuery;
use corridor_scenarios::Scenario;
use corridor_scenarios::scenario::Expectation;

/// Front bumper to target, m: nearer than this the approach is over.
const APPROACH_ENDS: f64 = -3.0;
/// Largest rest to the target, m. Any overshoot fails.
const MAX_S_ERROR: f64 = 0.5;
/// Largest error to the side, m.
pub(super) const MAX_L_ERROR: f64 = 1.0;
/// Largest error of the heading, rad.
pub(super) const MAX_THETA_ERROR: f64 = 0.2;
/// Front bumper past the target by this much: the place is missed, m.
const PASS_DESTINATION: f64 = 15.0;
/// Distance that the original keeps between the car's side and the edge, and the tracking error allowed on top, m: 0.15 and 0.3.
pub(super) const EDGE_GAP_LIMIT: f64 = 0.45;
/// Largest distance from the target in the strict profile, m (the original's open-space retry).
pub(super) const STRICT_DISTANCE: f64 = 0.2;
/// How long the ego must stand well before it counts, s: rolling on at 0.2 m/s for so long leaves any margin below 0.1 m.
const SETTLING: f64 = 0.5;

/// How long it may stand otherwise, s: long enough for a decider to see its mistake and roll on, far below any run's
/// time.
const BOTCHED: f64 = 10.0;

/// Where a pull-over has come to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum PullOverStatus {
    /// No target yet.
    #[default]
    Unknown,
    /// Under way.
    Approaching,
    /// Stands as it should.
    Complete,
    /// Stands, but not as it should.
    Failed,
    /// Drove past the target.
    Passed,
}

/// The ego against its target.
#[derive(Clone, Copy, Debug)]
struct Rest {
    front_past: f64,
    s: f64,
    l: f64,
    theta: f64,
}

/// Watches the approach to the target.
#[derive(Clone, Debug, Default)]
pub(super) struct PullOverWatch {
    status: PullOverStatus,
    complete_since: Option<f64>,
    astray: LongestSpan,
    astray_for: f64,
    rest: Option<Rest>,
    edge_gap: Option<f64>,
    in_junction: bool,
    time: f64,
}

impl PullOverWatch {
    pub(super) fn sample(&mut self, sample: &Sample) {
        self.time = sample.time();
        let Some(target) = sample
            .plan
            .filter(|p| is_pull_over(p.command))
            .and_then(|p| p.target)
        else {
            self.status = PullOverStatus::Unknown;
            self.complete_since = None;
            self.astray_for = self.astray.sample(false, sample.time());
            return;
        };
        let rest = rest_to(sample, &target);
        let vehicle = &sample.scenario.vehicle;
        self.status = status(&rest, sample.ego().v, vehicle.max_abs_speed_when_stopped);
        self.rest = Some(rest);
        if self.status == PullOverStatus::Complete {
            self.complete_since.get_or_insert(sample.time());
        } else {
            self.complete_since = None;
        }
        let astray = self.status == PullOverStatus::Failed && !waits(sample);
        self.astray_for = self.astray.sample(astray, sample.time());
        if self.stands() {
            self.edge_gap = edge_gap(sample);
            self.in_junction = sample.scenario.line.sample_at(sample.at.s).in_junction;
        }
    }

    fn stands(&self) -> bool {
        matches!(self.status, PullOverStatus::Complete | PullOverStatus::Failed)
    }

    /// Whether the ego has stood at its target long enough.
    pub(super) fn is_done(&self) -> bool {
        self.complete_since
            .is_some_and(|since| self.time - since >= SETTLING)
    }

    /// Whether the ego has stood, not as it should, for too long to be on its way still.
    pub(super) fn is_botched(&self) -> bool {
        self.astray_for >= BOTCHED
    }

    pub(super) fn measures(&self, scenario: &Scenario) -> Vec<Measure> {
        let asked = is_pull_over(scenario.command);
        let expected = scenario.expect == Expectation::PulledOver;
        let success = asked.then(|| f64::from(u8::from(self.is_done())));
        let success = Measure::new("pull_over_success", success);
        let at_stop = |value: Option<f64>| value.filter(|_| self.stands());
        let rest = |part: fn(&Rest) -> f64| at_stop(self.rest.as_ref().map(part));
        let in_junction = at_stop(Some(f64::from(u8::from(self.in_junction))));
        vec![
            success.only_if(expected),
            Measure::new("pull_over_s_error", rest(|r| r.s)),
            Measure::new("pull_over_l_error", rest(|r| r.l.abs())),
            Measure::new("pull_over_theta_error", rest(|r| r.theta.abs())),
            Measure::new("pull_over_distance", rest(|r| libm::hypot(r.s, r.l))),
            Measure::new("pull_over_edge_gap", at_stop(self.edge_gap)),
            Measure::new("pull_over_in_junction", in_junction),
        ]
    }
}

/// Whether the command is one to stop at the edge of the road.
pub(super) fn is_pull_over(command: Command) -> bool {
    matches!(command, Command::PullOver(_) | Command::EmergencyPullOver)
}

/// Whether it is traffic that the ego stands for.
fn waits(sample: &Sample) -> bool {
    let stop = sample.plan.and_then(|plan| plan.stop);
    stop.is_some_and(|stop| matches!(stop.cause, StopCause::Follow(_) | StopCause::Yield(_)))
}

fn rest_to(sample: &Sample, target: &PullOverTarget) -> Rest {
    let goal = sample.scenario.line.to_frenet(target.position);
    Rest {
        front_past: sample.at.s + sample.scenario.vehicle.front_edge_to_center - goal.s,
        s: goal.s - sample.at.s,
        l: goal.l - sample.at.l,
        theta: angle::difference(target.theta, sample.ego().pose.theta),
    }
}

fn status(rest: &Rest, v: f64, stopped: f64) -> PullOverStatus {
    if rest.front_past >= PASS_DESTINATION {
        PullOverStatus::Passed
    } else if v.abs() > stopped || rest.front_past <= APPROACH_ENDS {
        PullOverStatus::Approaching
    } else if (0.0..=MAX_S_ERROR).contains(&rest.s)
        && rest.l.abs() <= MAX_L_ERROR
        && rest.theta.abs() <= MAX_THETA_ERROR
    {
        PullOverStatus::Complete
    } else {
        PullOverStatus::Failed
    }
}

/// Distance from the ego's right side to the right edge of the road, m; negative beyond it.
fn edge_gap(sample: &Sample) -> Option<f64> {
    let line = &sample.scenario.line;
    sample
        .view
        .footprint
        .vertices()
        .iter()
        .filter_map(|corner| {
            let at = line.to_frenet(*corner);
            Some(at.l + line.road_width(at.s)?.1)
        })
        .reduce(f64::min)
}
