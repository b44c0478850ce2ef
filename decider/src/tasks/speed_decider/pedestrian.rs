//! Stopping for people on foot, and driving on when they only stand there.

use super::{Object, Question};
use crate::frame::ObstacleId;
use crate::st_graph::StBoundary;
use std::collections::BTreeMap;

/// Within this distance along the path one waits for who stands, m.
const TIMED_DISTANCE: f64 = 10.0;

/// Slower than this one stands, m/s.
const STANDING: f64 = 0.3;

/// For so long one waits for who stands, s.
const PATIENCE: f64 = 4.0;

/// Since when the ego waits for whom.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PedestrianTimers {
    /// Time of the first tick in which someone near stood, s.
    pub since: BTreeMap<ObstacleId, f64>,
}

impl PedestrianTimers {
    /// Whether one stops for an object on the path because it is someone on foot. Keeps the time.
    pub(super) fn must_stop(&mut self, question: &Question, object: &Object, boundary: &StBoundary) -> bool {
        if !object.is_pedestrian || object.station.1 < question.ego_start_s {
            return false;
        }
        if boundary.min_s() >= TIMED_DISTANCE {
            return true;
        }
        if object.velocity.norm() > STANDING {
            self.since.remove(&object.id);
            return true;
        }
        let since = *self.since.entry(object.id).or_insert(question.now);
        question.now - since < PATIENCE
    }

    /// Forgets whom nobody sees any more.
    pub fn keep_only(&mut self, is_there: impl Fn(ObstacleId) -> bool) {
        self.since.retain(|id, _| is_there(*id));
    }
}
