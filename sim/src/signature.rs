//! What makes two failures the same failure: what was violated, how it ended, with what, and what was driven then.
//!
//! Seeds, places and speeds are not part of it: ten thousand runs come down to a handful of signatures, and a run that is
//! made smaller is still the same failure while its signature stays.

use crate::verdict::{Collision, CollisionClass, Ending, Metric};
use corridor_decider::decision::Outcome;
use corridor_decider::frame::ObstacleKind;
use corridor_decider::tasks::path_bounds::Label;
use corridor_scenarios::Scenario;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The signature of a failed run.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Signature {
    /// The first gate that failed.
    pub metric: String,
    /// How the run ended.
    pub ending: Ending,
    /// Class of the first collision.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub class: Option<CollisionClass>,
    /// The situation that was driven at the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<Label>,
    /// What was hit, or what the failed gate names.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub obstacle: Option<ObstacleKind>,
    /// How the last tick was planned: the rung of the fallbacks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rung: Option<Outcome>,
}

/// The gate that every unexpected ending fails; the signature names what is behind it, if a gate tells.
const COMPLETED: &str = "scenario_completed";

impl Signature {
    /// Of a run that did not pass; `driven` is the last decision's label and rung.
    pub(crate) fn of(
        scenario: &Scenario,
        ending: Ending,
        metrics: &[Metric],
        collisions: &[Collision],
        driven: (Option<Label>, Option<Outcome>),
    ) -> Self {
        let failed = |metric: &&Metric| metric.gate && !metric.pass;
        let mut gates = metrics.iter().filter(failed);
        let gate = gates.find(|metric| metric.name != COMPLETED);
        let collision = collisions.first();
        let named = match collision {
            Some(collision) => Some(&collision.obstacle),
            None => gate.and_then(|metric| metric.worst_obstacle.as_ref()),
        };
        let kind = |name: &String| {
            scenario
                .obstacles
                .iter()
                .find(|o| o.name == *name)
                .map(|o| o.kind)
        };
        Self {
            metric: gate.map_or(COMPLETED, |metric| &metric.name).to_owned(),
            ending,
            class: collision.map(|collision| collision.class),
            label: driven.0,
            obstacle: named.and_then(kind),
            rung: driven.1,
        }
    }
}

/// In one line: `no_collision, active_front with car, in regular/self/, normal`.
impl fmt::Display for Signature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.metric)?;
        match self.class {
            Some(class) => write!(f, ", {}", word(class))?,
            None => write!(f, ", {}", word(self.ending))?,
        }
        if let Some(kind) = self.obstacle {
            write!(f, " with {}", word(kind))?;
        }
        if let Some(label) = self.label {
            write!(f, ", in {label}")?;
        }
        match self.rung {
            Some(rung) => write!(f, ", {}", word(rung)),
            None => Ok(()),
        }
    }
}

/// The name under which a value stands in files.
fn word(value: impl Serialize) -> String {
    match serde_json::to_value(value) {
        Ok(serde_json::Value::String(word)) => word,
        _ => unreachable!("these are plain names"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_read_in_one_line_and_survives_a_file() {
        let signature = Signature {
            metric: "no_collision".to_owned(),
            ending: Ending::Collision,
            class: Some(CollisionClass::ActiveFront),
            label: Some(Label::PullOver),
            obstacle: Some(ObstacleKind::Pedestrian),
            rung: Some(Outcome::SpeedFallback),
        };
        assert_eq!(
            signature.to_string(),
            "no_collision, active_front with pedestrian, in regular/pullover, speed_fallback"
        );
        let text = serde_json::to_string(&signature).unwrap();
        assert_eq!(serde_json::from_str::<Signature>(&text).unwrap(), signature);
        let timeout = Signature {
            ending: Ending::Timeout,
            class: None,
            obstacle: None,
            ..signature
        };
        assert_eq!(
            timeout.to_string(),
            "no_collision, timeout, in regular/pullover, speed_fallback"
        );
    }
}
