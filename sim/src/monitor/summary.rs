//! The sentence that says why a run passed or failed.

use crate::verdict::{Collision, CollisionClass, Ending, Metric};

/// One clear sentence.
pub(super) fn sentence(
    pass: bool,
    ending: Ending,
    time: f64,
    collisions: &[Collision],
    fault: Option<&(f64, String)>,
    metrics: &[Metric],
) -> String {
    if pass {
        return format!("passed: {} at {time:.1} s", ending_words(ending));
    }
    if let Some((at, fault)) = fault {
        return format!("failed: the decider's answer at {at:.1} s is unsound: {fault}");
    }
    if let Some(collision) = collisions.first() {
        return format!("failed: {}", collision_words(collision));
    }
    let is_failed = |m: &&Metric| m.gate && !m.pass && m.name != "scenario_completed";
    match metrics.iter().find(is_failed) {
        Some(metric) => format!("failed: {}", metric_words(metric)),
        None => format!(
            "failed: {} at {time:.1} s, which was not expected",
            ending_words(ending)
        ),
    }
}

/// An ending as the end of a sentence.
pub(crate) fn ending_words(ending: Ending) -> &'static str {
    match ending {
        Ending::GoalReached => "reached the goal",
        Ending::PulledOver => "stood at the road's edge",
        Ending::PulledOverBadly => {
            "had stood at the road's edge too long outside the tolerances of its place"
        }
        Ending::LaneChanged => "had changed lanes",
        Ending::Refused => "had refused the command and come to no harm",
        Ending::StoodStill => "stood behind what cannot be passed",
        Ending::Collision => "collided",
        Ending::Timeout => "ran out of time",
        Ending::DeciderFailed => "the decider failed",
    }
}

fn collision_words(collision: &Collision) -> String {
    let how = match collision.class {
        CollisionClass::StoppedEgo => "was hit while standing by",
        CollisionClass::StoppedTrack => "hit the standing",
        CollisionClass::ActiveFront => "drove its front into",
        CollisionClass::ActiveRear => "was hit from behind by",
        CollisionClass::ActiveLateral => "touched side by side",
    };
    let blame = if collision.at_fault {
        "at fault"
    } else {
        "not at fault"
    };
    format!(
        "{how} `{}` at {:.2} s with {:.1} m/s, {blame}",
        collision.obstacle, collision.time, collision.delta_v
    )
}

fn metric_words(metric: &Metric) -> String {
    let number = |value: Option<f64>| value.map_or("-".to_owned(), |v| format!("{v:.2}"));
    let (value, limit) = (number(metric.value), number(metric.threshold));
    let when = metric.worst_t.map_or(String::new(), |t| format!(" at {t:.1} s"));
    let what = metric.worst_obstacle.as_ref();
    let what = what.map_or(String::new(), |name| format!(" with `{name}`"));
    format!(
        "`{}` is {value} against a limit of {limit}{when}{what}",
        metric.name
    )
}
