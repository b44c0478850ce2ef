//! Who drives ahead: the nearest body whose outline reaches into the strip that a follower is about to sweep. And who
//! comes behind in a strip.

use super::along_line::LineFollower;
use crate::world::BodyPose;
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2, angle};
use corridor_decider::reference_line::{LineSample, ReferenceLine};

/// How far ahead a driver looks, m: at 14 m/s the model begins to brake for a standing car at 80 m.
const LOOK_AHEAD: f64 = 100.0;

/// Room that a driver wants on each side of his own width, m. Whoever leaves it free is passed.
const SIDE_ROOM: f64 = 0.3;

/// How much longer than the line the way outside of it is in the tightest bend that counts.
const OUTSIDE_OF_BENDS: f64 = 1.5;

/// Samples that a first search along the line skips at a time: about four metres.
const STRIDE: usize = 8;

/// A body as others see it.
#[derive(Clone, Debug)]
pub(super) struct Body {
    pub(super) pose: Pose,
    pub(super) velocity: Vec2,
    /// Whether it can ever move.
    pub(super) moves: bool,
    /// Offset of the lane that it is about to change to, m from its line: its turn signal.
    pub(super) signal: Option<f64>,
    /// Its outline in its own frame.
    vertices: Vec<Vec2>,
    /// How far it reaches ahead of its centre and behind it, to either side of it, and anywhere, m.
    front: f64,
    back: f64,
    half_width: f64,
    reach: f64,
}

/// The one ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Leader {
    /// From bumper to bumper along the line, m.
    pub(super) gap: f64,
    /// Its speed along the line, m/s; negative when it comes closer.
    pub(super) speed: f64,
}

impl Body {
    pub(super) fn new(shape: &ConvexPolygon, at: BodyPose, moves: bool) -> Self {
        let largest = |of: fn(&Vec2) -> f64| shape.vertices().iter().map(of).fold(0.0, f64::max);
        Self {
            pose: at.pose,
            velocity: at.velocity,
            moves,
            signal: None,
            vertices: shape.vertices().to_vec(),
            front: largest(|v| v.x),
            back: largest(|v| -v.x),
            half_width: largest(|v| v.y.abs()),
            reach: largest(Vec2::norm),
        }
    }

    /// Length of its outline, m.
    pub(super) fn length(&self) -> f64 {
        self.front + self.back
    }

    pub(super) fn place(&mut self, pose: Pose, velocity: Vec2) {
        self.pose = pose;
        self.velocity = velocity;
    }
}

/// The nearest of `others` ahead of `follower`, whose body is `own` and which is between the offsets `strip` now
/// or soon.
pub(super) fn leader_of<'a>(
    follower: &LineFollower,
    own: &Body,
    strip: (f64, f64),
    others: impl Iterator<Item = &'a Body>,
) -> Option<Leader> {
    let room = own.half_width + SIDE_ROOM;
    let nose = follower.s + own.front;
    let mut nearest: Option<Leader> = None;
    for other in others {
        // Whoever cannot be nearer than the best so far is not looked at.
        let horizon = nearest.map_or(LOOK_AHEAD, |best| {
            LOOK_AHEAD.min(OUTSIDE_OF_BENDS * (best.gap.max(0.0) + own.front))
        });
        let reach = horizon + other.reach;
        if (other.pose.position() - own.pose.position()).norm_squared() > reach * reach {
            continue;
        }
        let Some(seen) = seen_from_line(&follower.line, follower.s, other) else {
            continue;
        };
        let inside = seen.left > strip.0 - room && seen.right < strip.1 + room;
        let gap = seen.tail - nose;
        if inside && nearest.is_none_or(|best| gap < best.gap) {
            let speed = seen.speed;
            nearest = Some(Leader { gap, speed });
        }
    }
    nearest
}

/// Who is before and behind a driver in a lane, both as `leader_of` measures them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Neighbours {
    pub(super) ahead: Option<Leader>,
    pub(super) behind: Option<Leader>,
}

/// The nearest of `others` before and behind `follower`, were it at the offset `l`. Whoever signals for there counts as
/// being there; what cannot move follows nobody, unless it is beside.
pub(super) fn neighbours_at<'a>(
    follower: &LineFollower,
    own: &Body,
    l: f64,
    others: impl Iterator<Item = &'a Body>,
) -> Neighbours {
    let room = own.half_width + SIDE_ROOM;
    let mut neighbours = Neighbours::default();
    for other in others {
        let reach = LOOK_AHEAD + other.reach;
        if (other.pose.position() - own.pose.position()).norm_squared() > reach * reach {
            continue;
        }
        let Some(seen) = seen_on_line(
            &follower.line,
            (follower.s - LOOK_AHEAD, follower.s + LOOK_AHEAD),
            other,
        ) else {
            continue;
        };
        let goes_to = other.signal.unwrap_or(f64::midpoint(seen.right, seen.left));
        let right = seen.right.min(goes_to - other.half_width);
        let left = seen.left.max(goes_to + other.half_width);
        if left <= l - room || right >= l + room {
            continue;
        }
        let is_ahead = seen.centre > follower.s;
        let gap = if is_ahead {
            seen.tail - (follower.s + own.front)
        } else {
            follower.s - own.back - seen.nose
        };
        let place = if is_ahead {
            &mut neighbours.ahead
        } else {
            &mut neighbours.behind
        };
        let follows = is_ahead || other.moves || gap < 0.0;
        if follows && place.is_none_or(|best| gap < best.gap) {
            *place = Some(Leader {
                gap,
                speed: seen.speed,
            });
        }
    }
    neighbours
}

/// A body in the Frenet frame of a line.
struct Seen {
    /// Station of its centre, m.
    centre: f64,
    /// Its largest and its smallest station, m.
    nose: f64,
    tail: f64,
    /// Its smallest and its largest offset, m.
    right: f64,
    left: f64,
    /// Speed along the line, m/s.
    speed: f64,
}

/// Projects `body` on the part of `line` within sight of `from`; `None` when it is behind or beside no part of it.
fn seen_from_line(line: &ReferenceLine, from: f64, body: &Body) -> Option<Seen> {
    seen_on_line(line, (from, from + LOOK_AHEAD), body).filter(|seen| seen.centre > from)
}

/// Projects `body` on the part of `line` between two stations.
fn seen_on_line(line: &ReferenceLine, (from, to): (f64, f64), body: &Body) -> Option<Seen> {
    let samples = line.samples();
    let first = samples.partition_point(|p| p.s < from).saturating_sub(1);
    let last = samples.partition_point(|p| p.s <= to);
    let near = nearest_sample(samples.get(first..last)?, body.pose.position())?;
    let (sin, cos) = angle::sin_cos(near.point.theta);
    let axis = Vec2::new(cos, sin);
    // Around the nearest sample the line is an arc: second order is exact to millimetres over a car's length.
    let frenet = |world: Vec2| {
        let d = world - Vec2::new(near.point.x, near.point.y);
        let (x, y) = (axis.dot(&d), cos * d.y - sin * d.x);
        let stretch = (1.0 - near.point.kappa * y).max(0.1);
        (near.s + x / stretch, y - near.point.kappa * x * x / 2.0)
    };
    let mut seen = Seen {
        centre: frenet(body.pose.position()).0,
        nose: f64::NEG_INFINITY,
        tail: f64::INFINITY,
        right: f64::INFINITY,
        left: f64::NEG_INFINITY,
        speed: axis.dot(&body.velocity),
    };
    for vertex in &body.vertices {
        let (s, l) = frenet(body.pose.to_world(*vertex));
        seen.nose = seen.nose.max(s);
        seen.tail = seen.tail.min(s);
        seen.right = seen.right.min(l);
        seen.left = seen.left.max(l);
    }
    Some(seen)
}

/// The sample nearest to `point`: every eighth first, then all around the best of those.
fn nearest_sample(samples: &[LineSample], point: Vec2) -> Option<&LineSample> {
    let best = |from: usize, to: usize, stride: usize| {
        let mut best = (f64::INFINITY, None);
        for k in (from..to).step_by(stride) {
            let at = &samples[k].point;
            let distance = (Vec2::new(at.x, at.y) - point).norm_squared();
            if distance < best.0 {
                best = (distance, Some(k));
            }
        }
        best.1
    };
    let coarse = best(0, samples.len(), STRIDE)?;
    let fine = best(
        coarse.saturating_sub(STRIDE),
        (coarse + STRIDE).min(samples.len()),
        1,
    )?;
    samples.get(fine)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{line, road};
    use corridor_decider::frame::ObstacleId;
    use corridor_decider::reference_line::{LineQuery, SlPoint};

    /// The oracle projects every corner by the line's own global search.
    #[test]
    fn a_body_in_a_bend_is_seen_where_the_line_sees_its_corners() {
        let line = line(&road(Pose::new(5.0, -3.0, 0.4), 0.04, 140.0));
        let shape = ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), 2.3, 2.3, 0.95);
        for (s, l, turn) in [(20.0, 0.0, 0.0), (70.3, 3.0, 0.3), (88.8, -4.0, 3.0)] {
            let place = line.to_cartesian(SlPoint { s, l });
            let pose = Pose::new(place.x, place.y, line.point(s).theta + turn);
            let at = BodyPose {
                id: ObstacleId(0),
                pose,
                velocity: pose.forward() * 5.0,
            };
            let seen = seen_from_line(&line, 3.0, &Body::new(&shape, at, true)).unwrap();
            let corners: Vec<SlPoint> = shape
                .at(pose)
                .vertices()
                .iter()
                .map(|v| line.to_frenet(*v))
                .collect();
            let least = |of: fn(&SlPoint) -> f64| corners.iter().map(of).fold(f64::INFINITY, f64::min);
            assert!((seen.tail - least(|c| c.s)).abs() < 0.02, "tail {}", seen.tail);
            assert!((seen.right - least(|c| c.l)).abs() < 0.02, "right {}", seen.right);
            assert!((seen.left + least(|c| -c.l)).abs() < 0.02, "left {}", seen.left);
            assert!((seen.speed - 5.0 * libm::cos(turn)).abs() < 0.1);
            assert!(
                seen_from_line(&line, s + 1.0, &Body::new(&shape, at, true)).is_none(),
                "behind"
            );
        }
    }
}
