//! Passing through poses at given times, on straight legs at constant speed.

use super::Moment;
use corridor_decider::geometry::{Pose, Vec2, angle};
use corridor_scenarios::scenario::{Trigger, Waypoint};

/// A timed sequence of poses, and where on it one is. Before the first and after the last one stands.
#[derive(Clone, Debug)]
pub(super) struct Track {
    points: Vec<Waypoint>,
    /// What its time begins with; nothing once it has begun.
    waits_for: Option<Trigger>,
    /// When its time began, s.
    since: f64,
    /// Place of the last point passed.
    passed: usize,
    pose: Pose,
    velocity: Vec2,
}

impl Track {
    /// The track at time 0, which begins with `trigger`, if there is one. Points out of order are put in order; without
    /// any, one stands at the origin.
    pub(super) fn new(points: &[Waypoint], trigger: Option<Trigger>) -> Self {
        let mut points = points.to_vec();
        points.sort_by(|a, b| a.t.total_cmp(&b.t));
        let mut track = Self {
            pose: points.first().map_or(Pose::new(0.0, 0.0, 0.0), |p| p.pose),
            points,
            waits_for: trigger,
            since: 0.0,
            passed: 0,
            velocity: Vec2::zeros(),
        };
        track.go_to(0.0);
        track
    }

    /// Goes on to where one is at this moment, if it has begun.
    pub(super) fn advance(&mut self, moment: &Moment) {
        if let Some(trigger) = self.waits_for {
            if !moment.sets_off(trigger, self.pose.position()) {
                return;
            }
            (self.waits_for, self.since) = (None, moment.time);
        }
        self.go_to(moment.time - self.since);
    }

    /// Goes to where one is at `time` of the track, which never runs backwards.
    fn go_to(&mut self, time: f64) {
        while self
            .points
            .get(self.passed + 1)
            .is_some_and(|next| next.t <= time)
        {
            self.passed += 1;
        }
        let Some(from) = self.points.get(self.passed) else {
            return;
        };
        let leg = self.points.get(self.passed + 1).filter(|_| from.t <= time);
        let Some(to) = leg else {
            (self.pose, self.velocity) = (from.pose, Vec2::zeros());
            return;
        };
        // The next point is later than `time` and this one is not, so the leg has a duration.
        let duration = to.t - from.t;
        let part = (time - from.t) / duration;
        let way = to.pose.position() - from.pose.position();
        let turn = angle::difference(to.pose.theta, from.pose.theta);
        self.pose = Pose::new(
            from.pose.x + way.x * part,
            from.pose.y + way.y * part,
            angle::wrap(from.pose.theta + turn * part),
        );
        self.velocity = way / duration;
    }

    pub(super) fn motion(&self) -> (Pose, Vec2) {
        (self.pose, self.velocity)
    }
}
