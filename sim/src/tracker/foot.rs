//! Where on a trajectory the car is: by the clock ([`Moment`]) and by the place ([`Foot`]).

use corridor_decider::decision::TrajectoryPoint;
use corridor_decider::geometry::{Pose, Vec2, angle, cross};

/// Points nearer together than this are one place, m: a trajectory at rest repeats its pose.
const SAME_PLACE: f64 = 1e-3;

/// How far a trajectory's end goes on bent, m: the car may be a little behind its first point or past its last.
const END_ARC: f64 = 1.0;

/// A trajectory at one time, linear between its points, held before the first and after the last.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment {
    /// Place of the last point not after the time.
    pub(super) index: usize,
    /// Arc length, m.
    pub(super) distance: f64,
    /// Speed, m/s.
    pub(super) v: f64,
    /// Acceleration, m/s².
    pub(super) a: f64,
}

impl Moment {
    /// The trajectory, which has points, at time `t`.
    pub(super) fn at(trajectory: &[TrajectoryPoint], t: f64) -> Self {
        let index = trajectory.partition_point(|p| p.t <= t).saturating_sub(1);
        let from = &trajectory[index];
        let to = trajectory.get(index + 1).unwrap_or(from);
        let span = to.t - from.t;
        let part = if span > 0.0 {
            ((t - from.t) / span).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let mix = |a: f64, b: f64| a + (b - a) * part;
        Self {
            index,
            distance: mix(from.distance, to.distance),
            v: mix(from.v, to.v),
            a: mix(from.a, to.a),
        }
    }
}

/// The point of the path beside the car.
#[derive(Clone, Copy, Debug)]
pub(super) struct Foot {
    /// The chord it lies on, by its first point.
    chord: usize,
    /// Arc length, m.
    pub(super) distance: f64,
    /// How far left of the path the car is, m.
    pub(super) l: f64,
    /// The path's heading, rad.
    pub(super) theta: f64,
    /// The path's curvature, 1/m.
    pub(super) kappa: f64,
}

impl Foot {
    /// The foot of `pose` on the trajectory, which has points, searched around point `near`.
    pub(super) fn of(trajectory: &[TrajectoryPoint], pose: Pose, near: usize) -> Self {
        let place = pose.position();
        let Some((k, part)) = find_chord(trajectory, place, near) else {
            return Self::beside(&trajectory[near], near, place);
        };
        let (from, to) = (&trajectory[k], &trajectory[k + 1]);
        if part <= 0.0 {
            return Self::beside(from, k, place);
        }
        if part >= 1.0 {
            return Self::beside(to, k, place);
        }
        let chord = to.pose.position() - from.pose.position();
        let length = chord.norm();
        let kappa = from.kappa + (to.kappa - from.kappa) * part;
        // The arc over the chord bulges to the outside of the bend.
        let bulge = kappa * part * (1.0 - part) * length * length / 2.0;
        Self {
            chord: k,
            distance: from.distance + (to.distance - from.distance) * part,
            l: cross(chord, place - from.pose.position()) / length + bulge,
            theta: from.pose.theta + angle::difference(to.pose.theta, from.pose.theta) * part,
            kappa,
        }
    }

    /// The foot near an end of the trajectory, which goes on there with the end's curvature, and farther off
    /// straight.
    fn beside(point: &TrajectoryPoint, chord: usize, place: Vec2) -> Self {
        let local = point.pose.to_local(place);
        let bent = local.x.clamp(-END_ARC, END_ARC);
        let turn = point.kappa * bent;
        Self {
            chord,
            distance: point.distance + local.x,
            l: local.y - turn * (local.x - bent / 2.0),
            theta: angle::wrap(point.pose.theta + turn),
            kappa: point.kappa,
        }
    }

    /// The trajectory's speed and acceleration at this place; acceleration is constant between two points.
    pub(super) fn motion(&self, trajectory: &[TrajectoryPoint]) -> (f64, f64) {
        let from = &trajectory[self.chord];
        let Some(to) = trajectory.get(self.chord + 1) else {
            return (from.v, from.a);
        };
        let span = to.distance - from.distance;
        let part = if span > 0.0 {
            ((self.distance - from.distance) / span).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let square = from.v * from.v + (to.v * to.v - from.v * from.v) * part;
        (square.max(0.0).sqrt(), to.a)
    }

    /// Curvature `ahead` metres further on; beyond the end that of the last point.
    pub(super) fn kappa_ahead(&self, trajectory: &[TrajectoryPoint], ahead: f64) -> f64 {
        let goal = self.distance + ahead;
        let rest = &trajectory[self.chord..];
        let Some(k) = rest.windows(2).position(|pair| pair[1].distance >= goal) else {
            return rest.last().map_or(self.kappa, |p| p.kappa);
        };
        let (from, to) = (&rest[k], &rest[k + 1]);
        let span = to.distance - from.distance;
        let part = if span > 0.0 {
            ((goal - from.distance) / span).clamp(0.0, 1.0)
        } else {
            0.0
        };
        from.kappa + (to.kappa - from.kappa) * part
    }
}

/// The chord beside `place`, going back and then forth from point `near`, and the fraction of the way along it;
/// outside `[0, 1]` only beyond the ends. `None` when all points are one place.
fn find_chord(trajectory: &[TrajectoryPoint], place: Vec2, near: usize) -> Option<(usize, f64)> {
    let part = |k: usize| {
        let from = trajectory[k].pose.position();
        let chord = trajectory[k + 1].pose.position() - from;
        let square = chord.norm_squared();
        (square >= SAME_PLACE * SAME_PLACE).then(|| (place - from).dot(&chord) / square)
    };
    let chords = trajectory.len() - 1;
    let mut best = None;
    for k in (0..=near.min(chords.checked_sub(1)?)).rev() {
        if let Some(t) = part(k) {
            best = Some((k, t));
            if t >= 0.0 {
                break;
            }
        }
    }
    let on = best.map_or(near, |(k, _)| k + 1);
    if best.is_some_and(|(_, t)| t <= 1.0) {
        return best;
    }
    for k in on..chords {
        if let Some(t) = part(k) {
            best = Some(if t < 0.0 { best.unwrap_or((k, t)) } else { (k, t) });
            if t <= 1.0 {
                break;
            }
        }
    }
    best
}
