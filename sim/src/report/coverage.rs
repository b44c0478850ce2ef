//! What the runs of a sweep have tried, and what not one of them has: counts in bins, with the empty bins named.
//!
//! Two kinds of bins. Each number that a family draws is binned by its place in its law: ten bins of equal likelihood, or
//! one for each value where there are fewer. Over all families the situations are binned by what makes them hard, and the
//! decisions by what was chosen. Adding a run takes no memory beyond the bins, so that a sweep may feed a million.

use super::grid::Grid;
use crate::closed_loop::Sink;
use crate::trace::{TickRecord, TraceError};
use corridor_decider::decision::Outcome;
use corridor_decider::reference_line::LineQuery;
use corridor_decider::tasks::path_bounds::{Borrow, Label, LaneType};
use corridor_scenarios::scenario::Behaviour;
use corridor_scenarios::{Parameter, Scenario};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Bins of a number that is drawn.
const QUANTILE_BINS: usize = 10;

/// How far ahead of its start a run is looked at for its bends and its narrowest place, m: what most runs drive.
const AHEAD: f64 = 300.0;

/// Free width beside the narrowest obstacle, m: below a car, a car and hardly more, a lane, and more.
const GAPS: [f64; 7] = [0.0, 1.5, 2.11, 2.5, 3.0, 3.5, 5.0];

/// Lateral offset of that obstacle from the lane's centre, m.
const OFFSETS: [f64; 7] = [-3.0, -2.0, -1.0, -0.3, 0.3, 1.0, 2.0];

/// Speed that the ego drives where nothing limits it, m/s.
const SPEEDS: [f64; 7] = [0.0, 4.0, 6.0, 8.0, 10.0, 13.0, 17.0];

/// Sharpest bend on the way, 1/m: a straight road, radii of 500, 200, 120, 60 and 20 m.
const CURVATURES: [f64; 6] = [0.0, 0.002, 0.005, 0.0083, 0.0167, 0.05];

/// What the run of a scenario is like, before anybody drives.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Situation {
    /// Free width beside the narrowest obstacle, m; nothing where none stands beside the way.
    pub gap: Option<f64>,
    /// Lateral offset of its centre from the lane's, m.
    pub offset: Option<f64>,
    /// Speed to drive, m/s.
    pub speed: f64,
    /// Sharpest bend on the way, 1/m.
    pub curvature: f64,
}

impl Situation {
    /// The situation of a scenario. The gap is the wider of the two between an obstacle and the edges of the lane and its
    /// neighbour to the left, for the obstacle that stands where it is smallest.
    pub fn of(scenario: &Scenario) -> Self {
        let line = &scenario.line;
        let start = line.to_frenet(scenario.ego.pose.position()).s;
        let near = line
            .samples()
            .iter()
            .filter(|at| at.s >= start && at.s <= start + AHEAD);
        let curvature = near.map(|at| at.point.kappa.abs()).fold(0.0, f64::max);
        let standing = scenario
            .obstacles
            .iter()
            .filter_map(|obstacle| match obstacle.behaviour {
                Behaviour::Parked(pose) => Some(obstacle.shape.at(pose)),
                _ => None,
            });
        let mut narrowest: Option<(f64, f64)> = None;
        for body in standing {
            let corners: Vec<_> = body
                .vertices()
                .iter()
                .map(|corner| line.to_frenet(*corner))
                .collect();
            let s = corners.iter().map(|at| at.s).fold(f64::MAX, f64::min);
            let right = corners.iter().map(|at| at.l).fold(f64::MAX, f64::min);
            let left = corners.iter().map(|at| at.l).fold(f64::MIN, f64::max);
            let Some((road_left, road_right)) =
                line.road_width(s).filter(|_| s >= start && s <= start + AHEAD)
            else {
                continue;
            };
            let gap = (road_left - left).max(right + road_right).max(0.0);
            if narrowest.is_none_or(|(least, _)| gap < least) {
                narrowest = Some((gap, f64::midpoint(left, right)));
            }
        }
        Self {
            gap: narrowest.map(|(gap, _)| gap),
            offset: narrowest.map(|(_, offset)| offset),
            speed: scenario.cruise_speed,
            curvature,
        }
    }
}

/// What was decided in a run: ticks by the label driven and by rung. A sink to run beside others.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Decided {
    /// Ticks by the label of the bound that was driven.
    pub labels: BTreeMap<String, u64>,
    /// Ticks by rung of the chain of fallbacks, the first of which is no fallback.
    pub rungs: BTreeMap<String, u64>,
}

impl Sink for Decided {
    fn tick(&mut self, tick: &TickRecord) -> Result<(), TraceError> {
        let decision = &tick.decision;
        if let Some(candidate) = decision.chosen.and_then(|k| decision.candidates.get(k)) {
            *self.labels.entry(candidate.bound.label.to_string()).or_insert(0) += 1;
        }
        *self.rungs.entry(rung(decision.outcome).to_owned()).or_insert(0) += 1;
        Ok(())
    }
}

/// The name of a rung.
fn rung(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Normal => "normal",
        Outcome::PathReused => "path reused",
        Outcome::SpeedFallback => "speed fallback",
        Outcome::PathFallback => "path fallback",
        Outcome::BlindStop => "blind stop",
        Outcome::Hold => "hold",
        Outcome::EmergencyStop => "emergency stop",
    }
}

/// All rungs, in their order.
const RUNGS: [Outcome; 7] = [
    Outcome::Normal,
    Outcome::PathReused,
    Outcome::SpeedFallback,
    Outcome::PathFallback,
    Outcome::BlindStop,
    Outcome::Hold,
    Outcome::EmergencyStop,
];

/// The labels that a bound may have.
fn labels() -> Vec<String> {
    let regular = |borrow, lane| Label::Regular { borrow, lane };
    let labels = [
        regular(Borrow::None, LaneType::Own),
        regular(Borrow::Left, LaneType::Forward),
        regular(Borrow::Left, LaneType::Reverse),
        regular(Borrow::Right, LaneType::Forward),
        regular(Borrow::Right, LaneType::Reverse),
        Label::PullOver,
        Label::LaneChange,
        Label::Fallback,
    ];
    labels.map(|label| label.to_string()).to_vec()
}

/// Counts of one quantity by its named bins, in their order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Bins {
    counts: Vec<(String, u64)>,
}

impl Bins {
    fn named(names: impl IntoIterator<Item = String>) -> Self {
        Self {
            counts: names.into_iter().map(|name| (name, 0)).collect(),
        }
    }

    /// Bins from each of `edges` to the next and beyond the last, with one for what is not there.
    fn between(edges: &[f64], absent: bool) -> Self {
        let last = edges.last().map(|edge| format!("from {edge}"));
        let first = edges
            .first()
            .filter(|edge| **edge != 0.0)
            .map(|edge| format!("below {edge}"));
        let inner = edges.windows(2).map(|ends| format!("{} to {}", ends[0], ends[1]));
        let none = absent.then(|| "none".to_owned());
        Self::named(first.into_iter().chain(inner).chain(last).chain(none))
    }

    fn add(&mut self, bin: usize, count: u64) {
        if let Some((_, counted)) = self.counts.get_mut(bin) {
            *counted += count;
        }
    }

    /// Adds a value to the bin between its edges; nothing to the last one.
    fn add_between(&mut self, edges: &[f64], value: Option<f64>) {
        let below = usize::from(edges.first().is_some_and(|edge| *edge != 0.0));
        let bin = match value {
            Some(value) => (edges.partition_point(|edge| *edge <= value) + below).saturating_sub(1),
            None => self.counts.len() - 1,
        };
        self.add(bin, 1);
    }

    /// Adds under a name; a new one becomes a bin.
    fn add_named(&mut self, name: &str, count: u64) {
        match self.counts.iter_mut().find(|(bin, _)| bin == name) {
            Some((_, counted)) => *counted += count,
            None => self.counts.push((name.to_owned(), count)),
        }
    }

    /// Names and counts, in order.
    pub fn counts(&self) -> &[(String, u64)] {
        &self.counts
    }

    /// Names of the bins without anything in them.
    pub fn empty(&self) -> impl Iterator<Item = &str> {
        self.counts
            .iter()
            .filter(|(_, count)| *count == 0)
            .map(|(name, _)| name.as_str())
    }
}

/// What has been tried so far.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Coverage {
    runs: u64,
    /// By family and key of a number, members of rows together.
    parameters: BTreeMap<(String, String), Bins>,
    gap: Bins,
    offset: Bins,
    speed: Bins,
    curvature: Bins,
    labels: Bins,
    rungs: Bins,
}

impl Default for Coverage {
    fn default() -> Self {
        Self {
            runs: 0,
            parameters: BTreeMap::new(),
            gap: Bins::between(&GAPS, true),
            offset: Bins::between(&OFFSETS, true),
            speed: Bins::between(&SPEEDS, false),
            curvature: Bins::between(&CURVATURES, false),
            labels: Bins::named(labels()),
            rungs: Bins::named(RUNGS.map(|outcome| rung(outcome).to_owned())),
        }
    }
}

impl Coverage {
    /// Adds one run: what its family drew, what the situation is like, and what was decided.
    pub fn add(&mut self, family: &str, parameters: &[Parameter], situation: &Situation, decided: &Decided) {
        self.runs += 1;
        for parameter in parameters {
            self.add_parameter(family, parameter);
        }
        self.gap.add_between(&GAPS, situation.gap);
        self.offset.add_between(&OFFSETS, situation.offset);
        self.speed.add_between(&SPEEDS, Some(situation.speed));
        self.curvature.add_between(&CURVATURES, Some(situation.curvature));
        for (name, ticks) in &decided.labels {
            self.labels.add_named(name, *ticks);
        }
        for (name, ticks) in &decided.rungs {
            self.rungs.add_named(name, *ticks);
        }
    }

    fn add_parameter(&mut self, family: &str, parameter: &Parameter) {
        let count = parameter
            .steps
            .map_or(QUANTILE_BINS, |steps| steps.min(QUANTILE_BINS));
        // The members of a row draw from one law.
        let key = match parameter
            .key
            .strip_suffix(']')
            .and_then(|key| key.rsplit_once('['))
        {
            Some((row, _)) => row,
            None => &parameter.key,
        };
        let at = (family.to_owned(), key.to_owned());
        let bins = self
            .parameters
            .entry(at)
            .or_insert_with(|| quantile_bins(parameter, count));
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a share of at most ten; the cast saturates"
        )]
        let bin = (parameter.quantile * count as f64) as usize;
        bins.add(bin.min(count - 1), 1);
    }

    /// How many runs there were.
    pub fn runs(&self) -> u64 {
        self.runs
    }

    /// Bins of a family's numbers, by family and key.
    pub fn parameters(&self) -> impl Iterator<Item = (&str, &str, &Bins)> {
        let parameters = self.parameters.iter();
        parameters.map(|((family, key), bins)| (family.as_str(), key.as_str(), bins))
    }

    /// Bins over all families, by the name of what is binned.
    pub fn situations(&self) -> [(&'static str, &Bins); 6] {
        [
            ("gap beside the narrowest obstacle, m", &self.gap),
            ("its lateral offset, m", &self.offset),
            ("speed to drive, m/s", &self.speed),
            ("sharpest bend, 1/m", &self.curvature),
            ("label driven, ticks", &self.labels),
            ("rung, ticks", &self.rungs),
        ]
    }

    /// Adds the counts of another sweep, such as another thread's.
    pub fn merge(&mut self, other: &Self) {
        self.runs += other.runs;
        for (key, bins) in &other.parameters {
            match self.parameters.get_mut(key) {
                Some(mine) => mine.merge(bins),
                None => {
                    self.parameters.insert(key.clone(), bins.clone());
                }
            }
        }
        self.gap.merge(&other.gap);
        self.offset.merge(&other.offset);
        self.speed.merge(&other.speed);
        self.curvature.merge(&other.curvature);
        self.labels.merge(&other.labels);
        self.rungs.merge(&other.rungs);
    }

    /// The counts for people: each situation's bins, then of each number of a family how many bins are filled, and all
    /// that are empty by name.
    pub fn to_table(&self) -> String {
        let mut text = format!("coverage of {} runs\n", self.runs);
        for (name, bins) in self.situations() {
            let mut grid = Grid::new([name, "count"]);
            for (bin, count) in bins.counts() {
                let mark = if *count == 0 {
                    "EMPTY".to_owned()
                } else {
                    count.to_string()
                };
                grid.row([format!("  {bin}"), mark]);
            }
            text.extend(grid.lines().map(|line| line + "\n"));
        }
        let mut grid = Grid::new(["parameter", "bins", "filled", "empty"]);
        for (family, key, bins) in self.parameters() {
            let empty: Vec<&str> = bins.empty().collect();
            let all = bins.counts().len();
            let none = if empty.is_empty() {
                "-".to_owned()
            } else {
                empty.join("; ")
            };
            grid.row([
                format!("{family} {key}"),
                all.to_string(),
                (all - empty.len()).to_string(),
                none,
            ]);
        }
        text.extend(grid.lines().map(|line| line + "\n"));
        text
    }
}

impl Bins {
    fn merge(&mut self, other: &Self) {
        for (name, count) in &other.counts {
            self.add_named(name, *count);
        }
    }
}

/// The bins of a number, named by their quantiles, or by their place where there are but a few values.
fn quantile_bins(parameter: &Parameter, count: usize) -> Bins {
    let name = |k: usize| {
        if parameter.steps.is_some_and(|steps| steps == count) {
            return format!("value {} of {count}", k + 1);
        }
        format!("{} % to {} %", k * 100 / count, (k + 1) * 100 / count)
    };
    Bins::named((0..count).map(name))
}

#[cfg(test)]
mod tests;
