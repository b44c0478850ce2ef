//! Where the obstacles go, whatever the ego does: the ground that each covers at a time.

use super::Scene;
use super::approach::{Ego, STEP};
use super::footprint::{FrenetBox, project_near};
use crate::scenario::{AlongLine, Behaviour, IdmParams, Trigger, Waypoint};
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2, angle};
use corridor_decider::reference_line::{ReferenceLine, SlPoint};
use std::sync::Arc;

/// Hardest braking of any driver, m/s²: dry road.
const HARDEST_BRAKING: f64 = 8.0;

/// Where an obstacle goes, in the frame of the route's line.
pub(super) struct Course<'a> {
    start: FrenetBox,
    centre: SlPoint,
    motion: Motion<'a>,
    /// When it was set off.
    since: Option<f64>,
    /// How far it has driven until when, m and s.
    driven: (f64, f64),
}

enum Motion<'a> {
    Stands,
    /// Along the line from this speed; then perhaps across, to an offset, in a time.
    Drives {
        speed: f64,
        /// Who brings it to another speed on a free road.
        driver: Option<&'a IdmParams>,
        across: Option<(&'a Trigger, f64, f64)>,
    },
    /// On straight legs: (time, place).
    Legs(Vec<(f64, SlPoint)>),
    /// Through poses, turning on the way, from when it is set off.
    Turns {
        trigger: &'a Trigger,
        points: &'a [Waypoint],
        shape: &'a ConvexPolygon,
        line: &'a ReferenceLine,
    },
    /// On foot, to a place, at a speed.
    Walks {
        trigger: &'a Trigger,
        to: SlPoint,
        speed: f64,
    },
}

impl<'a> Course<'a> {
    pub(super) fn new(scene: &'a Scene<'a>, k: usize) -> Self {
        let (obstacle, spot, line) = (&scene.draft.obstacles[k], scene.draft.spots[k], &scene.road.line);
        let place = |point: Vec2| project_near(line, point, spot.s);
        // Oncoming traffic is on a line of its own, which runs against the route's.
        let along = |start: &AlongLine| {
            if Arc::ptr_eq(&start.line, line) {
                start.speed
            } else {
                -start.speed
            }
        };
        let motion = match &obstacle.behaviour {
            Behaviour::Parked(_) => Motion::Stands,
            Behaviour::ConstantSpeed(start) => Motion::Drives {
                speed: along(start),
                driver: None,
                across: None,
            },
            Behaviour::Idm {
                start,
                params,
                lane_change,
                ..
            } => Motion::Drives {
                speed: along(start),
                driver: Some(params).filter(|params| (params.desired_speed - start.speed).abs() > 0.0),
                across: lane_change.as_ref().map(|m| {
                    let sign = if along(start) < 0.0 { -1.0 } else { 1.0 };
                    (&m.trigger, sign * (m.to_l - start.l), m.duration)
                }),
            },
            Behaviour::Waypoints(points) => {
                Motion::Legs(points.iter().map(|p| (p.t, place(p.pose.position()))).collect())
            }
            Behaviour::Triggered { trigger, waypoints } => Motion::Turns {
                trigger,
                points: waypoints,
                shape: &obstacle.shape,
                line,
            },
            Behaviour::Recorded { states, .. } => {
                Motion::Legs(states.iter().map(|p| (p.t, place(p.pose.position()))).collect())
            }
            Behaviour::Pedestrian {
                to, speed, trigger, ..
            } => Motion::Walks {
                trigger,
                to: place(*to),
                speed: *speed,
            },
        };
        Self {
            start: scene.boxes[k],
            centre: SlPoint { s: spot.s, l: spot.l },
            motion,
            since: None,
            driven: (0.0, 0.0),
        }
    }

    pub(super) fn stands(&self) -> bool {
        matches!(self.motion, Motion::Stands)
    }

    /// Whether its times are given, whatever is in its way.
    pub(super) fn keeps_a_timetable(&self) -> bool {
        matches!(self.motion, Motion::Legs(_) | Motion::Turns { .. })
    }

    /// Speed along the line in the step that led to `now`; at the start, that of the motion.
    pub(super) fn speed_along(&self, before: Option<FrenetBox>, now: &FrenetBox) -> f64 {
        match (&self.motion, before) {
            (Motion::Drives { speed, .. }, _) => *speed,
            (_, Some(before)) => (now.s.0 - before.s.0) / STEP,
            (_, None) => 0.0,
        }
    }

    /// The ground covered at `time`, with the ego where it then is.
    pub(super) fn at(&mut self, time: f64, ego: &Ego<'_>) -> FrenetBox {
        if self.since.is_none() && self.sets_off(time, ego) {
            self.since = Some(time);
        }
        self.drive(time);
        let under_way = self.since.map_or(0.0, |since| time - since);
        let centre = self.centre;
        let (ds, dl) = match &self.motion {
            Motion::Stands => (0.0, 0.0),
            Motion::Drives { across, .. } => {
                let share = |duration: f64| (under_way / duration).clamp(0.0, 1.0);
                (
                    self.driven.0,
                    across.map_or(0.0, |(_, to, duration)| to * share(duration)),
                )
            }
            Motion::Legs(points) => {
                let now = on_legs(points, time);
                (now.s - centre.s, now.l - centre.l)
            }
            Motion::Turns {
                points, shape, line, ..
            } => {
                return pose_at(points, under_way).map_or(self.start, |pose| {
                    FrenetBox::of(line, &shape.at(pose), self.centre.s)
                });
            }
            Motion::Walks { to, speed, .. } => {
                let (ds, dl) = (to.s - centre.s, to.l - centre.l);
                let length = (ds * ds + dl * dl).sqrt().max(f64::MIN_POSITIVE);
                let share = (under_way * speed / length).clamp(0.0, 1.0);
                (ds * share, dl * share)
            }
        };
        self.start.moved(ds, dl)
    }

    /// Drives on until `time`, towards the speed that its driver wants where nobody is ahead.
    fn drive(&mut self, time: f64) {
        let Motion::Drives { speed, driver, .. } = &mut self.motion else {
            return;
        };
        let step = time - self.driven.1;
        if let Some(driver) = driver.filter(|_| step > 0.0) {
            let ratio = speed.abs() / driver.desired_speed;
            let wished = driver.max_acceleration * (1.0 - ratio * ratio * ratio * ratio);
            let gain = wished.max(-HARDEST_BRAKING) * step;
            let next = (speed.abs() + gain.max(-speed.abs())).copysign(*speed);
            self.driven = (self.driven.0 + f64::midpoint(*speed, next) * step, time);
            *speed = next;
        } else if driver.is_none() {
            self.driven = (*speed * time, time);
        }
    }

    /// Whether what the obstacle waits for is there.
    fn sets_off(&self, time: f64, ego: &Ego<'_>) -> bool {
        match &self.motion {
            Motion::Stands | Motion::Legs(_) | Motion::Drives { across: None, .. } => false,
            Motion::Walks { trigger, .. } | Motion::Turns { trigger, .. } => {
                fires(trigger, time, self.centre, ego)
            }
            Motion::Drives {
                across: Some((trigger, ..)),
                ..
            } => {
                let s = self.centre.s + self.driven.0;
                fires(trigger, time, SlPoint { s, ..self.centre }, ego)
            }
        }
    }
}

/// Whether `trigger` fires now for something at `place`.
fn fires(trigger: &Trigger, time: f64, place: SlPoint, ego: &Ego<'_>) -> bool {
    match trigger {
        Trigger::Time(at) => time >= *at,
        Trigger::EgoWithin(distance) => {
            let (ds, dl) = (place.s - ego.place().s, place.l - ego.place().l);
            (ds * ds + dl * dl).sqrt() <= *distance
        }
    }
}

/// The place at `time` on straight legs; before the first and after the last it stands.
fn on_legs(points: &[(f64, SlPoint)], time: f64) -> SlPoint {
    let after = points.partition_point(|(t, _)| *t <= time);
    let (Some(a), Some(b)) = (points.get(after.wrapping_sub(1)), points.get(after)) else {
        let end = if after == 0 { points.first() } else { points.last() };
        return end.map_or(SlPoint { s: 0.0, l: 0.0 }, |(_, place)| *place);
    };
    let share = (time - a.0) / (b.0 - a.0);
    SlPoint {
        s: a.1.s + (b.1.s - a.1.s) * share,
        l: a.1.l + (b.1.l - a.1.l) * share,
    }
}

/// The pose at `time` on straight legs; before the first and after the last it stands.
fn pose_at(points: &[Waypoint], time: f64) -> Option<Pose> {
    let after = points.partition_point(|point| point.t <= time);
    let (Some(a), Some(b)) = (points.get(after.wrapping_sub(1)), points.get(after)) else {
        let end = if after == 0 { points.first() } else { points.last() };
        return end.map(|point| point.pose);
    };
    let share = (time - a.t) / (b.t - a.t);
    let turn = angle::difference(b.pose.theta, a.pose.theta);
    let at = a.pose.position() + (b.pose.position() - a.pose.position()) * share;
    Some(Pose::new(at.x, at.y, angle::wrap(a.pose.theta + turn * share)))
}
