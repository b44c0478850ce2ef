//! What each task is given and what it finds, in a few words.

use super::plan::LinePlan;
use super::task::TaskName;
use crate::decision::StopCause;
use crate::st_graph::SpeedData;
use crate::tasks::object_decision::Longitudinal;
use crate::tasks::path_bounds::PathBound;
use crate::tasks::speed_bounds::OnPath;
use std::fmt::Write;

impl TaskName {
    /// What the task is given.
    pub(super) fn input(self, plan: &LinePlan) -> String {
        let scene = &plan.scene;
        match self {
            Self::LaneChange | Self::LaneBorrow => counted(scene.moving.len(), "moving obstacle"),
            Self::PathReuse => String::from("the last path"),
            Self::PathBounds => {
                let obstacles = counted(scene.obstacles.len(), "obstacle");
                format!("{obstacles}, {}", counted(plan.borrow.len(), "side"))
            }
            Self::PiecewiseJerkPath | Self::SampledPath => counted(plan.bounds.bounds.len(), "bound"),
            Self::PathAssessment => counted(plan.candidates.iter().flatten().count(), "path"),
            Self::Rss => counted(scene.obstacles.len(), "obstacle"),
            Self::PathDecider => counted(scene.bodies.len(), "standing obstacle"),
            Self::SpeedHeuristic
            | Self::SpeedDecider
            | Self::SpeedBoundsFinal
            | Self::PiecewiseJerkSpeed
            | Self::PiecewiseJerkNonlinearSpeed => counted(plan.on_path.len(), "obstacle") + " on the path",
            Self::RuleBasedStop | Self::SpeedBoundsPriori => plan.path().map_or_else(
                || String::from("no path"),
                |path| format!("a path of {:.1} m", path.length()),
            ),
        }
    }

    /// What the task found.
    pub(super) fn output(self, plan: &LinePlan) -> String {
        match self {
            Self::LaneChange => format!("cruises at {:.1} m/s", plan.scene.cruise_speed),
            Self::PathReuse => String::from(if plan.last_path.is_some() {
                "offered"
            } else {
                "none"
            }),
            Self::LaneBorrow => counted(plan.borrow.len(), "side"),
            Self::PathBounds => list(plan.bounds.bounds.iter().map(|bound: &PathBound| bound.label)),
            Self::PiecewiseJerkPath | Self::SampledPath => {
                let found = plan.candidates.iter().flatten().filter(|found| found.is_ok());
                counted(found.count(), "path")
            }
            Self::PathAssessment => list(plan.label()),
            Self::PathDecider => plan.stop_before_blocker.map_or_else(
                || String::from("nothing blocks"),
                |distance| format!("a stop at {distance:.1} m"),
            ),
            Self::RuleBasedStop => plan.wall.map_or_else(String::new, |wall| {
                format!("a wall at {:.1} m, {}", wall.distance, purpose(wall.cause))
            }),
            Self::SpeedBoundsPriori => counted(plan.on_path.len(), "obstacle") + " on the path",
            Self::SpeedHeuristic => way(plan.heuristic.as_ref()),
            Self::SpeedDecider | Self::SpeedBoundsFinal => decided(plan),
            Self::PiecewiseJerkSpeed | Self::PiecewiseJerkNonlinearSpeed => way(plan.speed.as_ref()),
            Self::Rss => plan.rss.map_or_else(String::new, |rss| {
                let verdict = if rss.is_safe { "safe" } else { "unsafe" };
                format!("{verdict}: {:.1} m, {:.1} m wanted", rss.gap, rss.safe_distance)
            }),
        }
    }
}

/// What a wall is for.
fn purpose(cause: StopCause) -> &'static str {
    match cause {
        StopCause::Blocked(_) => "before what blocks the path",
        StopCause::Follow(_) | StopCause::Yield(_) => "for traffic",
        StopCause::SidePass => "to look before going out",
        StopCause::LaneChangeUrgency => "to wait for the other lane",
        StopCause::PullOver => "to pull over",
        StopCause::Destination => "the end of the route",
        StopCause::PathEnd => "the end of the path",
    }
}

fn counted(count: usize, what: &str) -> String {
    match count {
        0 => format!("no {what}s"),
        1 => format!("1 {what}"),
        _ => format!("{count} {what}s"),
    }
}

/// How far a profile leads, and for how long.
fn way(profile: Option<&SpeedData>) -> String {
    let last = profile.and_then(|profile| profile.points.last());
    last.map_or_else(String::new, |last| format!("{:.1} m in {:.1} s", last.s, last.t))
}

/// What is decided about the obstacles on the path.
fn decided(plan: &LinePlan) -> String {
    let name = |decision: Longitudinal| match decision {
        Longitudinal::Ignore => "ignore",
        Longitudinal::Overtake(_) => "overtake",
        Longitudinal::Follow(_) => "follow",
        Longitudinal::Yield(_) => "yield",
        Longitudinal::Stop(_) => "stop",
    };
    let one = |there: &OnPath| {
        let decision = plan.decision(there.id).and_then(|decision| decision.longitudinal);
        format!("{} {}", decision.map_or("undecided", name), there.id.0)
    };
    list(plan.on_path.iter().map(one))
}

fn list<T: std::fmt::Display>(items: impl IntoIterator<Item = T>) -> String {
    items.into_iter().fold(String::new(), |mut text, item| {
        let separator = if text.is_empty() { "" } else { ", " };
        write!(text, "{separator}{item}").expect("writing into a text does not fail");
        text
    })
}
