//! Whether braking in time would have avoided a collision: a cheap estimate, not a proof.
//!
//! From each remembered moment the ego is projected straight ahead under full braking and held against the
//! obstacle's true track; after the contact the obstacle goes on at its last velocity. Swerving is not tried.

use super::SAMPLE_PERIOD;
use super::view::{Motion, Sample};
use corridor_decider::frame::{EgoState, ObstacleId};
use corridor_scenarios::Scenario;
use std::collections::VecDeque;

/// How far back a driver could have begun to brake, s.
const LOOK_BACK: f64 = 3.0;

/// Longest braking that is followed, s: from 200 km/h with the weakest sensible brakes. Ends the search for a car
/// without brakes.
const LONGEST_STOP: f64 = 20.0;

/// One remembered moment.
#[derive(Clone, Debug)]
struct Moment {
    time: f64,
    ego: EgoState,
    others: Vec<Motion>,
}

/// The last seconds of the ego and all obstacles.
#[derive(Clone, Debug, Default)]
pub(super) struct History {
    moments: VecDeque<Moment>,
}

impl History {
    pub(super) fn sample(&mut self, sample: &Sample) {
        let is_old = |moment: &Moment| moment.time < sample.time() - LOOK_BACK;
        let mut others = if self.moments.front().is_some_and(is_old) {
            self.moments.pop_front().map(|m| m.others).unwrap_or_default()
        } else {
            Vec::new()
        };
        others.clear();
        others.extend(
            sample
                .scenario
                .obstacles
                .iter()
                .map(|o| sample.view.traffic.motion(o.id)),
        );
        self.moments.push_back(Moment {
            time: sample.time(),
            ego: *sample.ego(),
            others,
        });
    }

    /// Whether the ego would stand, or be clear, when the obstacle arrives, had it braked at some moment.
    pub(super) fn braking_would_have_avoided(
        &self,
        scenario: &Scenario,
        id: ObstacleId,
        time: f64,
        contact: Motion,
    ) -> bool {
        (0..self.moments.len()).any(|from| self.braking_avoids(scenario, from, id, time, contact))
    }

    fn braking_avoids(
        &self,
        scenario: &Scenario,
        from: usize,
        id: ObstacleId,
        time: f64,
        contact: Motion,
    ) -> bool {
        let Some(obstacle) = scenario.obstacles.get(id.0 as usize) else {
            return false;
        };
        let start = &self.moments[from];
        let braking = scenario.vehicle.max_deceleration.abs();
        let stopping_time = (start.ego.v.max(0.0) / braking).min(LONGEST_STOP);
        let touches = |t: f64, other: Motion| {
            let elapsed = (t - start.time).min(stopping_time);
            let ahead = start.ego.v.max(0.0) * elapsed - 0.5 * braking * elapsed * elapsed;
            let ego = scenario.vehicle.footprint(start.ego.pose.advanced(ahead));
            ego.overlaps(&obstacle.shape.at(other.pose))
        };
        let track = self.moments.range(from..).map(|m| (m.time, &m.others));
        for (t, others) in track {
            if others.get(id.0 as usize).is_some_and(|other| touches(t, *other)) {
                return false;
            }
        }
        let mut now = (time, contact);
        while now.0 <= start.time + stopping_time {
            if touches(now.0, now.1) {
                return false;
            }
            now.0 += SAMPLE_PERIOD;
            now.1.pose.x += contact.velocity.x * SAMPLE_PERIOD;
            now.1.pose.y += contact.velocity.y * SAMPLE_PERIOD;
        }
        !touches(time, contact)
    }
}
