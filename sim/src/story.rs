//! The story of a run: what happened, in a few lines for people.

use crate::monitor::summary::ending_words;
use crate::trace::{Event, EventKind};
use crate::verdict::Ending;
use corridor_decider::decision::{Decision, Outcome, PullOverTarget};
use corridor_decider::frame::{Frame, ObstacleId};
use corridor_decider::reference_line::ProviderError;
use corridor_scenarios::Scenario;

/// A place to pull over that moves by more than this is another one, m.
const SAME_PLACE: f64 = 0.5;

/// Tells ticks apart by what changed since the last one.
#[derive(Clone, Debug)]
pub(crate) struct Story {
    names: Vec<String>,
    label: Option<String>,
    outcome: Outcome,
    target: Option<PullOverTarget>,
    is_lost: bool,
    is_over: bool,
}

impl Story {
    pub(crate) fn new(scenario: &Scenario) -> Self {
        Self {
            names: scenario
                .obstacles
                .iter()
                .map(|obstacle| obstacle.name.clone())
                .collect(),
            label: None,
            outcome: Outcome::Normal,
            target: None,
            is_lost: false,
            is_over: false,
        }
    }

    /// The events of one tick.
    pub(crate) fn of(
        &mut self,
        frame: &Frame,
        decision: &Decision,
        lost: Option<&ProviderError>,
        ending: Option<Ending>,
        overlaps: impl Iterator<Item = ObstacleId>,
    ) -> Vec<Event> {
        let mut texts = Vec::new();
        if let Some(error) = lost.filter(|_| !self.is_lost) {
            texts.push((
                EventKind::Note,
                format!("the route gives no lines, the last ones serve on: {error}"),
            ));
        }
        self.is_lost = lost.is_some();
        let label = decision
            .chosen
            .and_then(|place| decision.candidates.get(place))
            .map(|candidate| candidate.bound.label.to_string());
        if label != self.label {
            let text = match &label {
                Some(label) => format!("drives `{label}`"),
                None => "drives no bound".to_owned(),
            };
            texts.push((EventKind::LabelChanged, text));
            self.label = label;
        }
        if decision.outcome != self.outcome && !decision.outcome.is_planned() {
            texts.push((EventKind::Fallback, fallen_back(decision.outcome).to_owned()));
        }
        self.outcome = decision.outcome;
        texts.extend(
            self.target_moved(decision)
                .map(|text| (EventKind::PullOverTarget, text)),
        );
        for id in overlaps {
            let name = self.names.get(id.0 as usize).map_or("?", String::as_str);
            texts.push((EventKind::Collision, format!("touches `{name}`")));
        }
        if let Some(ending) = ending.filter(|_| !self.is_over) {
            self.is_over = true;
            let kind = match ending {
                Ending::PulledOverBadly | Ending::Collision | Ending::Timeout | Ending::DeciderFailed => {
                    EventKind::Note
                }
                _ => EventKind::Arrived,
            };
            texts.push((kind, format!("the run is over: {}", ending_words(ending))));
        }
        texts
            .into_iter()
            .map(|(kind, text)| Event {
                time: frame.time,
                kind,
                text,
            })
            .collect()
    }

    fn target_moved(&mut self, decision: &Decision) -> Option<String> {
        let before = self.target;
        self.target = decision.pull_over.or(before);
        let (place, text) = match (before, decision.pull_over) {
            (None, Some(place)) => (place, "chooses a place to pull over"),
            (Some(old), Some(place)) if (old.position - place.position).norm() > SAME_PLACE => {
                (place, "moves its place to pull over")
            }
            _ => return None,
        };
        Some(format!(
            "{text} at ({:.1}, {:.1})",
            place.position.x, place.position.y
        ))
    }
}

/// What is driven instead of a plan.
fn fallen_back(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Normal | Outcome::PathReused => "not at all",
        Outcome::SpeedFallback => "stops on its path",
        Outcome::PathFallback => "stops on another path",
        Outcome::BlindStop => "stops along the trajectory of the tick before",
        Outcome::Hold => "stays where it is",
        Outcome::EmergencyStop => "brakes fully, the wheels as they are",
    }
}
