//! Whether the ego, driving straight on, can brake for everything that is or comes in its way.
//!
//! The ego keeps its lateral place and speeds up to the cruise speed. Each obstacle is followed in steps of a
//! planning period until it first covers ground in the ego's strip. It must then be farther ahead than
//! `(v − u)² / 2|a| + v · reaction + margin`, with `u` its own speed along the road; one beside the ego must not
//! come into the strip at all, and one behind must be slower or able to brake.

use super::footprint::{FrenetBox, project_near};
use super::{Rejection, Scene};
use crate::scenario::{Behaviour, Trigger};
use corridor_decider::geometry::Vec2;
use corridor_decider::reference_line::SlPoint;
use std::sync::Arc;

/// Time step, s: a planning period.
const STEP: f64 = 0.1;

/// How far ahead in time things are followed, s: what comes later meets an ego that has long reacted.
const HORIZON: f64 = 30.0;

/// From the first sight to full braking, s: a planning period and the lag of the brakes.
const REACTION: f64 = 0.3;

/// Distance that should be left, m.
const MARGIN: f64 = 1.0;

/// Offset between ego and strip beyond which nothing is in the way, m: bodies that only touch pass.
const TOUCH: f64 = 0.02;

pub(super) fn check(scene: &Scene<'_>) -> Result<(), Rejection> {
    for k in 0..scene.boxes.len() {
        if let Some(rejection) = follow(scene, k) {
            return Err(rejection);
        }
    }
    Ok(())
}

/// Follows obstacle `k` until it is in the ego's strip, and judges that moment.
fn follow(scene: &Scene<'_>, k: usize) -> Option<Rejection> {
    let draft = scene.draft;
    let half = draft.vehicle.half_width() - TOUCH;
    let strip = (draft.ego_l - half, draft.ego_l + half);
    let mut course = Course::new(scene, k);
    let mut ego = Ego::new(scene);
    let mut last: Option<FrenetBox> = None;
    while ego.time <= draft.timeout.min(HORIZON) {
        let body = course.at(ego.time, &ego);
        if body.meets_offsets(strip.0, strip.1) && !ego.is_past(&body) {
            return judge(scene, k, &ego, &body, last);
        }
        if course.stands() && !body.meets_offsets(strip.0, strip.1) {
            return None;
        }
        last = Some(body);
        ego.advance();
    }
    None
}

/// Judges the moment at which `body` is first in the ego's strip; `before` is where it was a step earlier.
fn judge(
    scene: &Scene<'_>,
    k: usize,
    ego: &Ego<'_>,
    body: &FrenetBox,
    before: Option<FrenetBox>,
) -> Option<Rejection> {
    let obstacle = &scene.draft.obstacles[k];
    let name = || obstacle.name.clone();
    let (front, rear) = (ego.front(), ego.rear());
    if body.meets_stations(rear, front) {
        return Some(Rejection::HitFromTheSide {
            obstacle: name(),
            time: ego.time,
        });
    }
    let along = Course::new(scene, k).speed_along(before, body);
    if body.s.1 <= rear {
        let brakes = matches!(obstacle.behaviour, Behaviour::Idm { .. });
        let catches_up = along > ego.cruise && (rear - body.s.1) / (along - ego.cruise) < scene.draft.timeout;
        return (catches_up && !brakes).then(|| Rejection::HitFromBehind { obstacle: name() });
    }
    let closing = (ego.speed - along).max(0.0);
    let reaction = if closing > 0.0 {
        REACTION * closing + MARGIN
    } else {
        0.0
    };
    let needed = closing * closing / (2.0 * scene.draft.vehicle.max_deceleration.abs()) + reaction;
    let gap = body.s.0 - front;
    if gap >= needed {
        return None;
    }
    Some(if matches!(obstacle.behaviour, Behaviour::Parked(_)) {
        Rejection::TooNearToStop {
            obstacle: name(),
            gap,
            needed,
        }
    } else {
        Rejection::TooNearToBrake {
            obstacle: name(),
            gap,
            needed,
        }
    })
}

/// The ego on its way, were the road free.
struct Ego<'a> {
    scene: &'a Scene<'a>,
    time: f64,
    travelled: f64,
    speed: f64,
    cruise: f64,
}

impl<'a> Ego<'a> {
    fn new(scene: &'a Scene<'a>) -> Self {
        Self {
            scene,
            time: 0.0,
            travelled: 0.0,
            speed: scene.draft.ego.speed,
            cruise: scene.draft.cruise_speed,
        }
    }

    fn advance(&mut self) {
        self.travelled += self.speed * STEP;
        self.time += STEP;
        if self.speed < self.cruise {
            self.speed = (self.speed + self.scene.draft.vehicle.max_acceleration * STEP).min(self.cruise);
        }
    }

    fn front(&self) -> f64 {
        self.scene.front() + self.travelled
    }

    fn rear(&self) -> f64 {
        self.scene.rear() + self.travelled
    }

    /// Whether `body` is behind and cannot be meant: it stands or crosses where the ego has passed.
    fn is_past(&self, body: &FrenetBox) -> bool {
        self.time > 0.0 && body.s.1 <= self.rear()
    }

    fn place(&self) -> SlPoint {
        SlPoint {
            s: self.scene.draft.ego_s + self.travelled,
            l: self.scene.draft.ego_l,
        }
    }
}

/// Where an obstacle goes, in the frame of the route's line.
struct Course<'a> {
    start: FrenetBox,
    centre: SlPoint,
    motion: Motion<'a>,
    /// When it was set off.
    since: Option<f64>,
}

enum Motion<'a> {
    Stands,
    /// Along the line at this speed; then perhaps across, to an offset, in a time.
    Drives {
        speed: f64,
        across: Option<(&'a Trigger, f64, f64)>,
    },
    /// On straight legs: (time, place).
    Legs(Vec<(f64, SlPoint)>),
    /// On foot, to a place, at a speed.
    Walks {
        trigger: &'a Trigger,
        to: SlPoint,
        speed: f64,
    },
}

impl<'a> Course<'a> {
    fn new(scene: &'a Scene<'a>, k: usize) -> Self {
        let (obstacle, spot, line) = (&scene.draft.obstacles[k], scene.draft.spots[k], &scene.road.line);
        let place = |point: Vec2| project_near(line, point, spot.s);
        // Oncoming traffic is on a line of its own, which runs against the route's.
        let along = |start: &crate::scenario::AlongLine| {
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
                across: None,
            },
            Behaviour::Idm {
                start, lane_change, ..
            } => Motion::Drives {
                speed: along(start),
                across: lane_change.as_ref().map(|m| {
                    let sign = if along(start) < 0.0 { -1.0 } else { 1.0 };
                    (&m.trigger, sign * (m.to_l - start.l), m.duration)
                }),
            },
            Behaviour::Waypoints(points) => {
                Motion::Legs(points.iter().map(|p| (p.t, place(p.pose.position()))).collect())
            }
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
        }
    }

    fn stands(&self) -> bool {
        matches!(self.motion, Motion::Stands)
    }

    /// Speed along the line in the step that led to `now`; at the start, that of the motion.
    fn speed_along(&self, before: Option<FrenetBox>, now: &FrenetBox) -> f64 {
        match (&self.motion, before) {
            (Motion::Drives { speed, .. }, _) => *speed,
            (_, Some(before)) => (now.s.0 - before.s.0) / STEP,
            (_, None) => 0.0,
        }
    }

    /// The ground covered at `time`, with the ego where it then is.
    fn at(&mut self, time: f64, ego: &Ego<'_>) -> FrenetBox {
        if self.since.is_none() && self.sets_off(time, ego) {
            self.since = Some(time);
        }
        let under_way = self.since.map_or(0.0, |since| time - since);
        let centre = self.centre;
        let (ds, dl) = match &self.motion {
            Motion::Stands => (0.0, 0.0),
            Motion::Drives { speed, across } => {
                let share = |duration: f64| (under_way / duration).clamp(0.0, 1.0);
                (
                    speed * time,
                    across.map_or(0.0, |(_, to, duration)| to * share(duration)),
                )
            }
            Motion::Legs(points) => {
                let now = on_legs(points, time);
                (now.s - centre.s, now.l - centre.l)
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

    /// Whether what the obstacle waits for is there.
    fn sets_off(&self, time: f64, ego: &Ego<'_>) -> bool {
        match &self.motion {
            Motion::Stands | Motion::Legs(_) | Motion::Drives { across: None, .. } => false,
            Motion::Walks { trigger, .. } => fires(trigger, time, self.centre, ego),
            Motion::Drives {
                speed,
                across: Some((trigger, ..)),
            } => {
                let s = self.centre.s + speed * time;
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
