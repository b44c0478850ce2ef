//! Moving as recorded, whatever happens around it: straight legs between states, speed and heading in between.
//!
//! Who is not in the scene, before the first state or after the last, waits where nobody sees or meets him.

use corridor_decider::frame::PredictedPose;
use corridor_decider::geometry::{Pose, Vec2, angle};
use corridor_scenarios::scenario::{AfterRecord, RecordedState};
use std::sync::Arc;

/// Where those wait who are not in the scene, m: beyond every map's edge and every sensor's range of it.
const OFFSTAGE: Pose = Pose::new(-4e8, -4e8, 0.0);

/// A record, and where on it one is.
#[derive(Clone, Debug)]
pub(super) struct Recording {
    states: Arc<[RecordedState]>,
    after: AfterRecord,
    time: f64,
    /// Number of states that are not later than `time`.
    passed: usize,
    pose: Pose,
    velocity: Vec2,
}

impl Recording {
    /// The record at time 0.
    pub(super) fn new(states: &Arc<[RecordedState]>, after: AfterRecord) -> Self {
        let mut recording = Self {
            states: Arc::clone(states),
            after,
            time: 0.0,
            passed: 0,
            pose: OFFSTAGE,
            velocity: Vec2::zeros(),
        };
        recording.advance(0.0);
        recording
    }

    /// Goes to where one is at `time`, which never runs backwards.
    pub(super) fn advance(&mut self, time: f64) {
        self.time = time;
        while self.states.get(self.passed).is_some_and(|next| next.t <= time) {
            self.passed += 1;
        }
        (self.pose, self.velocity) = self.at(self.passed, time).unwrap_or((OFFSTAGE, Vec2::zeros()));
    }

    pub(super) fn motion(&self) -> (Pose, Vec2) {
        (self.pose, self.velocity)
    }

    /// Poses from now on at these times: in a recorded scene observers expect what the record says, and beyond its
    /// end that one goes on as before, since nobody expects another to vanish. Nothing of who is not there.
    pub(super) fn predict(&self, times: impl Iterator<Item = f64>) -> Vec<PredictedPose> {
        let Some(last) = self
            .states
            .last()
            .filter(|_| self.at(self.passed, self.time).is_some())
        else {
            return Vec::new();
        };
        let mut passed = self.passed;
        let mut expected = |t: f64| {
            let time = self.time + t;
            while self.states.get(passed).is_some_and(|next| next.t <= time) {
                passed += 1;
            }
            match self.at(passed, time) {
                Some((pose, _)) => pose,
                None => last.pose.advanced(last.speed * (time - last.t)),
            }
        };
        times.map(|t| PredictedPose { t, pose: expected(t) }).collect()
    }

    /// Pose and velocity at `time`, before which are `passed` states; `None`: not in the scene.
    fn at(&self, passed: usize, time: f64) -> Option<(Pose, Vec2)> {
        let from = self.states.get(passed.checked_sub(1)?)?;
        let Some(to) = self.states.get(passed) else {
            // The last state still counts, with its speed.
            let is_now = from.t >= time;
            let speed = if is_now { from.speed } else { 0.0 };
            let is_there = is_now || self.after == AfterRecord::Holds;
            return is_there.then_some((from.pose, from.pose.forward() * speed));
        };
        // The next state is later than `time` and this one is not, so the leg has a duration.
        let part = (time - from.t) / (to.t - from.t);
        let way = to.pose.position() - from.pose.position();
        let turn = angle::difference(to.pose.theta, from.pose.theta);
        let pose = Pose::new(
            from.pose.x + way.x * part,
            from.pose.y + way.y * part,
            angle::wrap(from.pose.theta + turn * part),
        );
        let speed = from.speed + (to.speed - from.speed) * part;
        Some((pose, pose.forward() * speed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn states() -> Arc<[RecordedState]> {
        let state = |t, x, theta, speed| RecordedState {
            t,
            pose: Pose::new(x, 0.0, theta),
            speed,
        };
        Arc::from([
            state(0.5, 0.0, 3.0, 4.0),
            state(1.5, 5.0, -3.0, 6.0),
            state(2.0, 8.0, -3.0, 6.0),
        ])
    }

    fn at(after: AfterRecord, time: f64) -> (Pose, Vec2) {
        let mut recording = Recording::new(&states(), after);
        recording.advance(time);
        recording.motion()
    }

    #[test]
    fn between_states_it_moves_and_turns_the_short_way() {
        let (pose, velocity) = at(AfterRecord::Leaves, 1.0);
        assert!((pose.x - 2.5).abs() < 1e-12);
        assert!(angle::difference(pose.theta, std::f64::consts::PI).abs() < 1e-12);
        assert!((velocity.norm() - 5.0).abs() < 1e-12);
        let (pose, velocity) = at(AfterRecord::Leaves, 1.75);
        assert!((pose.x - 6.5).abs() < 1e-12 && (velocity - pose.forward() * 6.0).norm() < 1e-12);
    }

    #[test]
    fn who_has_no_state_is_not_there_unless_he_holds() {
        for after in [AfterRecord::Leaves, AfterRecord::Holds] {
            assert_eq!(at(after, 0.4).0, OFFSTAGE, "before its time");
            assert!((at(after, 2.0).0.x - 8.0).abs() < 1e-12, "the last moment");
        }
        assert_eq!(at(AfterRecord::Leaves, 2.01), (OFFSTAGE, Vec2::zeros()));
        let (pose, velocity) = at(AfterRecord::Holds, 9.0);
        assert!((pose.x - 8.0).abs() < 1e-12 && velocity == Vec2::zeros());
    }

    #[test]
    fn what_is_expected_is_what_comes() {
        let mut recording = Recording::new(&states(), AfterRecord::Leaves);
        assert!(
            recording.predict([0.0, 0.5].into_iter()).is_empty(),
            "nobody sees who is not there"
        );
        recording.advance(0.5);
        let expected = recording.predict((0..17_u32).map(|k| f64::from(k) * 0.5));
        assert_eq!(expected.len(), 17);
        for pose in &expected[..4] {
            recording.advance(0.5 + pose.t);
            assert_eq!(recording.motion().0, pose.pose);
        }
        let (last, later) = (expected[3].pose, expected[5].pose);
        assert_eq!(
            later,
            last.advanced(6.0),
            "a second beyond the record, at its last speed"
        );
    }
}
