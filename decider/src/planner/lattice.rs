//! The lattice planner: one tick from frame to decision. Every line is planned for itself; the cheapest one is driven.

use super::ground::{self, Ground, OWN_LANE, STANDS, STOPPED};
use crate::config::Config;
use crate::context::{Context, LastPath, LastTrajectory};
use crate::decision::{Decision, Fallback, FallbackCause, Outcome, SpeedRung, Stop};
use crate::fallback;
use crate::frame::{Command, Frame};
use crate::lattice::{self, Lattice, LineTask, Planned, PlanningTarget};
use crate::reference_line::LineQuery;
use crate::st_graph::StPair;
use crate::tasks::lane_change;
use crate::tasks::start_point::{StartPoint, start_point};
use crate::vehicle::VehicleParams;

/// What braking costs a line, and what it costs where even that is against something (`backup_trajectory_cost`).
const BACKUP_COST: f64 = 1e3;
const LAST_RESORT_COST: f64 = 1e6;

/// Decides tick after tick with fixed settings; what changes is in the [`Context`].
#[derive(Clone, Debug)]
pub struct LatticePlanner {
    config: Config,
    vehicle: VehicleParams,
}

/// What came of one line.
struct OfLine {
    place: usize,
    cost: LineCost,
    planned: Planned,
    ground: Ground,
    stop: Option<Stop>,
}

/// What driving along a line costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineCost {
    /// Place of the line in the frame.
    pub place: usize,
    /// Of the trajectory along it.
    pub trajectory: f64,
    /// For not being the line that is wanted.
    pub surcharge: f64,
}

impl LineCost {
    /// What lines are compared by.
    pub fn sum(&self) -> f64 {
        self.trajectory + self.surcharge
    }
}

/// Everything that was weighed in one tick.
#[derive(Clone, Debug, PartialEq)]
pub struct LatticeSurvey {
    /// What each line costs on which there is something to drive, in the order of the frame.
    pub lines: Vec<LineCost>,
    /// Place of the one that is driven.
    pub place: usize,
    /// What was weighed along it.
    pub survey: lattice::Survey,
}

impl LatticePlanner {
    /// A planner for one vehicle.
    pub fn new(config: Config, vehicle: VehicleParams) -> Self {
        Self { config, vehicle }
    }

    /// Decides one tick. Never fails: what goes wrong is an [`Outcome`].
    pub fn decide(&self, frame: &Frame, context: &mut Context) -> Decision {
        let start = start_point(frame, context.last.as_ref());
        let decision = match fallback::context_failure(frame, &start, &self.vehicle) {
            Some(failure) => {
                fallback::without_context(frame, failure, context, &self.vehicle, &self.config.quirks)
            }
            None => self.plan(frame, start, context),
        };
        context.last = (!decision.trajectory.is_empty()).then(|| LastTrajectory {
            time: frame.time,
            points: decision.trajectory.clone(),
        });
        decision
    }

    fn plan(&self, frame: &Frame, start: StartPoint, context: &mut Context) -> Decision {
        context.blind_since = None;
        let lines = self.plan_lines(frame, &start);
        let decision = match cheapest(&lines) {
            Some(best) => conclude(best, &start),
            None => Decision::without_path(
                Outcome::EmergencyStop,
                FallbackCause::NoSampledTrajectory,
                None,
                fallback::brake_on_arc(&start, &self.vehicle),
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

    /// All that is weighed in a tick, for people to look at. `last` is what the context holds before the tick; `None`
    /// where nothing is sampled.
    pub fn survey(&self, frame: &Frame, last: Option<&LastTrajectory>) -> Option<LatticeSurvey> {
        let start = start_point(frame, last);
        if fallback::context_failure(frame, &start, &self.vehicle).is_some() {
            return None;
        }
        let lines = self.plan_lines(frame, &start);
        let best = cheapest(&lines)?;
        self.with_lattice(frame, best.place, &best.ground, |lattice| {
            Some(LatticeSurvey {
                lines: lines.iter().map(|line| line.cost).collect(),
                place: best.place,
                survey: lattice.survey()?,
            })
        })
    }

    /// The plans along all lines that have one.
    fn plan_lines(&self, frame: &Frame, start: &StartPoint) -> Vec<OfLine> {
        let preferred = lane_change::target_line(frame).unwrap_or(0);
        (0..frame.lines.len())
            .filter_map(|place| self.plan_line(frame, place, place == preferred, start))
            .collect()
    }

    /// The plan along one line; `None` where the car's motion has no place on it.
    fn plan_line(
        &self,
        frame: &Frame,
        place: usize,
        is_preferred: bool,
        start: &StartPoint,
    ) -> Option<OfLine> {
        let ground = Ground::of(frame, place, start, &self.vehicle)?;
        let (planned, stop) = self.with_lattice(frame, place, &ground, |lattice| {
            let planned = lattice.plan()?;
            let stop = stop(lattice, &planned, frame, &ground.target);
            Some((planned, stop))
        })?;
        let cost = LineCost {
            place,
            trajectory: match planned.outcome {
                lattice::Outcome::Found(pair) => pair.cost,
                lattice::Outcome::Backup(_) => BACKUP_COST,
                lattice::Outcome::LastResort(..) => LAST_RESORT_COST,
            },
            surcharge: self.surcharge(frame, is_preferred),
        };
        Some(OfLine {
            place,
            cost,
            planned,
            ground,
            stop,
        })
    }

    /// What `then` makes of the lattice along a line.
    fn with_lattice<T>(
        &self,
        frame: &Frame,
        place: usize,
        ground: &Ground,
        then: impl FnOnce(&Lattice) -> T,
    ) -> T {
        let line = &*frame.lines[place].line;
        let lane_width = |s| line.lane_width(s);
        let project = lattice::projection(line);
        then(&Lattice::new(LineTask {
            line: &ground.table,
            initial: ground.initial,
            obstacles: &frame.obstacles,
            target: ground.target,
            vehicle: &self.vehicle,
            config: &self.config.lattice,
            lane_width: &lane_width,
            project: &project,
        }))
    }

    /// What a line costs for not being the one that is wanted.
    fn surcharge(&self, frame: &Frame, is_preferred: bool) -> f64 {
        let config = &self.config.lattice;
        match frame.command {
            _ if is_preferred => 0.0,
            Command::ChangeLane(_) => config.cost_unheeded_command,
            _ => config.cost_non_priority_reference_line,
        }
    }
}

/// The line that costs least; among equals the first.
fn cheapest(lines: &[OfLine]) -> Option<&OfLine> {
    lines.iter().min_by(|a, b| a.cost.sum().total_cmp(&b.cost.sum()))
}

/// Why the car stops, if it does.
fn stop(lattice: &Lattice, planned: &Planned, frame: &Frame, target: &PlanningTarget) -> Option<Stop> {
    let (first, last) = (planned.points.first()?, planned.points.last()?);
    if last.v > STOPPED {
        return None;
    }
    let begins = |entry: &&lattice::PathTimeEntry| {
        let StPair { lower, .. } = entry.leaves;
        (lower > last.s).then_some(lower)
    };
    let ahead = lattice
        .graph
        .entries
        .iter()
        .filter(|entry| begins(entry).is_some());
    let nearest = ahead.min_by(|a, b| a.leaves.lower.total_cmp(&b.leaves.lower));
    let before_stop =
        |entry: &&lattice::PathTimeEntry| target.stop_s.is_none_or(|stop_s| entry.leaves.lower < stop_s);
    let cause = match nearest.filter(before_stop) {
        Some(entry) => ground::stop_behind(frame, entry.id),
        None => ground::end_of_drive(frame),
    };
    Some(Stop {
        distance: last.s - first.s,
        cause,
    })
}

/// From what came of the cheapest line to a decision.
fn conclude(best: &OfLine, start: &StartPoint) -> Decision {
    let (outcome, speed) = match best.planned.outcome {
        lattice::Outcome::Found(_) => (Outcome::Normal, None),
        lattice::Outcome::Backup(_) => (Outcome::SpeedFallback, Some(SpeedRung::LatticeBackup)),
        lattice::Outcome::LastResort(..) if start.v < STANDS => {
            (Outcome::Hold, Some(SpeedRung::LatticeLastResort))
        }
        lattice::Outcome::LastResort(..) => (Outcome::EmergencyStop, Some(SpeedRung::LatticeLastResort)),
    };
    let fallback = speed.map(|speed| Fallback {
        cause: FallbackCause::NoSampledTrajectory,
        path: None,
        speed: Some(speed),
    });
    let [s, ..] = best.ground.initial.s;
    let end = best.planned.points.last().map_or(s, |last| last.s);
    Decision {
        line: best.place,
        candidates: Vec::new(),
        chosen: None,
        path: ground::path(&best.ground.table, &best.planned.lateral, s, end),
        trajectory: lattice::trajectory(&best.planned.points),
        stop: best.stop,
        outcome,
        fallback,
        pull_over: None,
        tasks: Vec::new(),
    }
}
