//! `[ego]`, `[command]` and `[expect]`: who drives, what for, and how it should end.

use super::number::{Angle, Length, Metres, Number, Seconds, Speed};
use corridor_decider::road::Side;
use serde::Deserialize;
use toml::Spanned;

/// Where and how the ego starts.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ego {
    /// Name of its lane; the map's first one when absent.
    pub lane: Option<Spanned<String>>,
    /// Station of the rear axle along that lane, m.
    pub s: Option<Number<Length>>,
    /// Lateral offset from the lane's centre, m, left positive.
    pub l: Option<Number<Metres>>,
    /// Heading relative to the lane, rad.
    pub heading: Option<Number<Angle>>,
    /// Speed, m/s; the cruise speed when absent.
    pub speed: Option<Number<Speed>>,
}

/// A place that a route leads to.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RoutePlace {
    /// Name of its lane.
    pub lane: Spanned<String>,
    /// Station on that lane, m; its end when absent.
    pub s: Option<f64>,
}

/// What the ego is asked to do, and when.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "RawCommand")]
pub struct Command {
    /// What.
    pub task: Task,
    /// When, s since the start of the run.
    pub at: Option<Number<Seconds>>,
}

/// What the ego is asked to do.
#[derive(Clone, Debug)]
pub enum Task {
    /// Follow the lane, borrow another where needed.
    Cruise,
    /// Change to the neighbouring lane.
    ChangeLane(Side),
    /// Stop at the edge of the road, this far ahead of the rear axle's place at the start, m along the route.
    PullOver(Number<Length>),
    /// Stop at the edge of the road as soon as possible.
    EmergencyPullOver,
}

impl Default for Command {
    fn default() -> Self {
        Self {
            task: Task::Cruise,
            at: None,
        }
    }
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
enum TaskKind {
    Cruise,
    ChangeLane,
    PullOver,
    EmergencyPullOver,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCommand {
    kind: TaskKind,
    at: Option<Number<Seconds>>,
    side: Option<Side>,
    ahead: Option<Number<Length>>,
}

impl TryFrom<RawCommand> for Command {
    type Error = &'static str;

    fn try_from(raw: RawCommand) -> Result<Self, &'static str> {
        let task = match (raw.kind, raw.side, raw.ahead) {
            (TaskKind::Cruise, None, None) => Task::Cruise,
            (TaskKind::EmergencyPullOver, None, None) => Task::EmergencyPullOver,
            (TaskKind::ChangeLane, Some(side), None) => Task::ChangeLane(side),
            (TaskKind::PullOver, None, Some(ahead)) => Task::PullOver(ahead),
            (TaskKind::ChangeLane, None, _) => {
                return Err("`change_lane` needs `side = \"left\"` or `\"right\"`");
            }
            (TaskKind::PullOver, _, None) => {
                return Err("`pull_over` needs `ahead`, the metres from the ego to the destination");
            }
            (_, Some(_), _) => return Err("`side` belongs to `change_lane` only"),
            (_, _, Some(_)) => return Err("`ahead` belongs to `pull_over` only"),
        };
        Ok(Self { task, at: raw.at })
    }
}

/// How the run should end.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "RawExpect")]
pub enum Expect {
    /// Reach a goal this far along the route from the start, m; absent: a share of what cruising reaches.
    Progress(Option<Number<Length>>),
    /// Progress, standstill, or either, by the widest way past what stands.
    ProgressByGap(Option<Number<Length>>),
    /// Stand at the road's edge.
    PulledOver,
    /// Pulled over, refusal, or either, by the longest gap at the road's edge.
    PulledOverByGap,
    /// Be in the target lane.
    LaneChanged,
    /// Refuse the command, and come to no harm.
    Refusal,
    /// Stand behind something that cannot be passed.
    Standstill,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
enum OutcomeKind {
    Progress,
    ProgressByGap,
    PulledOver,
    PulledOverByGap,
    LaneChanged,
    Refusal,
    Standstill,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawExpect {
    outcome: OutcomeKind,
    distance: Option<Number<Length>>,
}

impl TryFrom<RawExpect> for Expect {
    type Error = &'static str;

    fn try_from(raw: RawExpect) -> Result<Self, &'static str> {
        let expect = match raw.outcome {
            OutcomeKind::Progress => return Ok(Self::Progress(raw.distance)),
            OutcomeKind::ProgressByGap => return Ok(Self::ProgressByGap(raw.distance)),
            OutcomeKind::PulledOver => Self::PulledOver,
            OutcomeKind::PulledOverByGap => Self::PulledOverByGap,
            OutcomeKind::LaneChanged => Self::LaneChanged,
            OutcomeKind::Refusal => Self::Refusal,
            OutcomeKind::Standstill => Self::Standstill,
        };
        if raw.distance.is_some() {
            return Err("`distance` belongs to `progress` and `progress_by_gap` only");
        }
        Ok(expect)
    }
}
