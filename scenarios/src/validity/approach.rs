//! Whether the ego, driving straight on, can brake for everything that is or comes in its way.
//!
//! The ego keeps its lateral place and speeds up to the cruise speed. Each obstacle is followed in steps of a
//! planning period until it first covers ground in the ego's strip. It must then be farther ahead than
//! `(v − u)² / 2|a| + v · reaction + margin`, with `u` its own speed along the road; one beside the ego must not
//! come into the strip at all, and one behind must be slower or able to brake. What keeps a timetable may slow down
//! later: full braking from that moment on must keep the ego clear of it until it stands.

use super::course::Course;
use super::footprint::FrenetBox;
use super::{Rejection, Scene};
use crate::scenario::Behaviour;
use corridor_decider::reference_line::SlPoint;

/// Time step, s: a planning period.
pub(super) const STEP: f64 = 0.1;

/// How far ahead in time things are followed, s: what comes later meets an ego that has long reacted.
const HORIZON: f64 = 30.0;

/// From the first sight to full braking, s: a planning period and the lag of the brakes.
const REACTION: f64 = 0.3;

/// Distance that should be left, m.
const MARGIN: f64 = 1.0;

/// From a standing bumper to what can be steered around, m: a lane sideways at the smallest turning radius, and clearance.
const STEERING_ROOM: f64 = 12.0;

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

/// Whether the ego, stopping before what stands in its way, may come to stand too near to steer around it: it needs to have
/// been seen from as far as hard braking takes, and the length of a car and some metres more.
pub(crate) fn may_stop_too_near(scene: &Scene<'_>) -> bool {
    let vehicle = &scene.draft.vehicle;
    let (half, l) = (vehicle.half_width() - TOUCH, scene.draft.ego_l);
    let speed = scene.draft.ego.speed;
    let braking = speed * speed / (2.0 * vehicle.max_deceleration.abs()) + speed * REACTION;
    let room = braking + MARGIN + STEERING_ROOM;
    scene.standing().any(|body| {
        let gap = body.s.0 - scene.front();
        body.meets_offsets(l - half, l + half) && (0.0..room).contains(&gap)
    })
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
            let along = course.speed_along(last, &body);
            return judge(scene, k, &ego, &body, along).or_else(|| brake(scene, k, course, ego, &body));
        }
        if course.stands() && !body.meets_offsets(strip.0, strip.1) {
            return None;
        }
        last = Some(body);
        ego.advance();
    }
    None
}

/// Judges the moment at which `body` is first in the ego's strip, at a speed along the line.
fn judge(scene: &Scene<'_>, k: usize, ego: &Ego<'_>, body: &FrenetBox, along: f64) -> Option<Rejection> {
    let obstacle = &scene.draft.obstacles[k];
    let name = || obstacle.name.clone();
    let (front, rear) = (ego.front(), ego.rear());
    if body.meets_stations(rear, front) {
        return Some(Rejection::HitFromTheSide {
            obstacle: name(),
            time: ego.time,
        });
    }
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

/// Brakes from the moment at which what keeps a timetable is first in the ego's strip, as `first`.
fn brake<'a>(
    scene: &'a Scene<'a>,
    k: usize,
    mut course: Course<'a>,
    mut ego: Ego<'a>,
    first: &FrenetBox,
) -> Option<Rejection> {
    if !course.keeps_a_timetable() || first.s.1 <= ego.rear() {
        return None;
    }
    let gap = first.s.0 - ego.front();
    let seen = ego.time;
    while ego.speed > 0.0 {
        ego.brake(ego.time - seen >= REACTION);
        let body = course.at(ego.time, &ego);
        if ego.meets(&body) {
            return Some(Rejection::TooNearToBrake {
                obstacle: scene.draft.obstacles[k].name.clone(),
                gap,
                needed: gap + ego.front() - body.s.0,
            });
        }
    }
    None
}

/// The ego on its way, were the road free.
pub(super) struct Ego<'a> {
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

    /// A step in which it brakes as hard as it can, if it has begun to.
    fn brake(&mut self, has_begun: bool) {
        if has_begun {
            self.speed = (self.speed + self.scene.draft.vehicle.max_deceleration * STEP).max(0.0);
        }
        self.travelled += self.speed * STEP;
        self.time += STEP;
    }

    /// Whether `body` is where it is.
    fn meets(&self, body: &FrenetBox) -> bool {
        let half = self.scene.draft.vehicle.half_width() - TOUCH;
        let l = self.scene.draft.ego_l;
        body.meets_offsets(l - half, l + half) && body.meets_stations(self.rear(), self.front())
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

    pub(super) fn place(&self) -> SlPoint {
        SlPoint {
            s: self.scene.draft.ego_s + self.travelled,
            l: self.scene.draft.ego_l,
        }
    }
}
