//! Whether a trajectory would touch anything: whole footprints against predicted ones, at the times of the grid (the
//! original's `CollisionChecker`).
//!
//! Every obstacle is a box at each time, made once. Which boxes a longitudinal curve comes near to at all, and when, is
//! found once for all its pairs; only those are held against the footprints, circles first.

use super::combine::{LongitudinalTrack, Point};
use super::grid::{SAMPLES, Series, TIMES};
use super::prediction::pose_at;
use crate::frame::{Obstacle, ObstacleId};
use crate::geometry::{Pose, Vec2, cross};
use crate::vehicle::VehicleParams;

/// Room before and behind an obstacle, m, and to its sides (`lon_collision_buffer`, `lat_collision_buffer`).
const LENGTHWISE: f64 = 2.0;
const SIDEWAYS: f64 = 0.1;

/// The box around an obstacle's outline, with the room that is kept, as it moves.
#[derive(Clone, Debug, PartialEq)]
struct MovingBox {
    id: ObstacleId,
    /// Half its length and width, m.
    half: (f64, f64),
    /// Radius of the circle around it, m.
    radius: f64,
    /// Its middle and its direction at the times of the grid.
    x: Series,
    y: Series,
    forward: [Vec2; SAMPLES],
}

impl MovingBox {
    /// Of an obstacle, `delay` seconds later than the times of the grid.
    fn of(obstacle: &Obstacle, delay: f64) -> Self {
        let (mut low, mut high) = (Vec2::repeat(f64::MAX), Vec2::repeat(-f64::MAX));
        for vertex in obstacle.shape.vertices() {
            (low, high) = (low.inf(vertex), high.sup(vertex));
        }
        let (middle, half) = ((low + high) / 2.0, (high - low) / 2.0);
        let half = (half.x + LENGTHWISE, half.y + SIDEWAYS);
        let mut moving = Self {
            id: obstacle.id,
            half,
            radius: Vec2::new(half.0, half.1).norm(),
            x: [0.0; SAMPLES],
            y: [0.0; SAMPLES],
            forward: [Vec2::x(); SAMPLES],
        };
        let mut place = 0;
        for (k, t) in TIMES.iter().enumerate() {
            let pose = pose_at(&obstacle.prediction, t + delay, &mut place).unwrap_or(obstacle.pose);
            moving.put(k, pose, middle);
        }
        moving
    }

    fn put(&mut self, k: usize, pose: Pose, middle: Vec2) {
        let forward = pose.forward();
        let left = Vec2::new(-forward.y, forward.x);
        let center = pose.position() + forward * middle.x + left * middle.y;
        (self.x[k], self.y[k], self.forward[k]) = (center.x, center.y, forward);
    }
}

/// The ego's footprint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// From the rear axle to the middle, m.
    ahead: f64,
    half: (f64, f64),
    radius: f64,
}

impl Footprint {
    /// Of a vehicle.
    pub fn of(vehicle: &VehicleParams) -> Self {
        let half = (vehicle.length / 2.0, vehicle.half_width());
        Self {
            ahead: vehicle.length / 2.0 - vehicle.back_edge_to_center,
            half,
            radius: Vec2::new(half.0, half.1).norm(),
        }
    }

    /// Whether it meets a box at a time of the grid with the rear axle at `position`; touching counts.
    #[inline]
    fn meets(&self, (position, forward): (Vec2, Vec2), other: &MovingBox, k: usize) -> bool {
        let d = Vec2::new(other.x[k], other.y[k]) - position - forward * self.ahead;
        let reach = self.radius + other.radius;
        d.norm_squared() <= reach * reach && self.overlaps(forward, d, other.forward[k], other.half)
    }

    /// Whether it overlaps a box whose middle is `d` away from its own: no axis of either keeps them apart. That across
    /// the own direction is tried first, because most boxes near a car are beside it.
    fn overlaps(&self, forward: Vec2, d: Vec2, other: Vec2, half: (f64, f64)) -> bool {
        let cos = forward.dot(&other).abs();
        let sin = cross(forward, other).abs();
        cross(forward, d).abs() <= self.half.1 + half.0 * sin + half.1 * cos
            && forward.dot(&d).abs() <= self.half.0 + half.0 * cos + half.1 * sin
            && other.dot(&d).abs() <= half.0 + self.half.0 * cos + self.half.1 * sin
            && cross(other, d).abs() <= half.1 + self.half.0 * sin + self.half.1 * cos
    }
}

/// Every obstacle at every time of the grid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CollisionEnvironment {
    boxes: Vec<MovingBox>,
}

/// The boxes that a longitudinal curve comes near to: their places, and the first and the last time at which it does.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Near {
    boxes: Vec<(usize, (usize, usize))>,
}

impl Near {
    /// Leaves out the boxes at these places.
    pub(super) fn leave_out(&mut self, places: &[usize]) {
        self.boxes.retain(|(place, _)| !places.contains(place));
    }
}

impl CollisionEnvironment {
    /// The obstacles that are not ignored, `delay` seconds later than the times of the grid.
    pub fn new(obstacles: &[Obstacle], delay: f64, ignored: impl Fn(&Obstacle) -> bool) -> Self {
        let kept = obstacles.iter().filter(|obstacle| !ignored(obstacle));
        Self {
            boxes: kept.map(|obstacle| MovingBox::of(obstacle, delay)).collect(),
        }
    }

    /// The boxes that a car may touch whose offset from the line is at most `largest_offset`, in place of those of
    /// `near`.
    pub fn find_near(
        &self,
        track: &LongitudinalTrack,
        largest_offset: f64,
        ego: &Footprint,
        near: &mut Near,
    ) {
        near.boxes.clear();
        let (xs, ys) = track.positions();
        let mut is_near = [false; SAMPLES];
        let is_near = &mut is_near[..xs.len()];
        for (place, other) in self.boxes.iter().enumerate() {
            let reach = largest_offset + ego.ahead + ego.radius + other.radius;
            let mut is_ever = false;
            for (k, is_near) in is_near.iter_mut().enumerate() {
                let (dx, dy) = (other.x[k] - xs[k], other.y[k] - ys[k]);
                *is_near = dx * dx + dy * dy <= reach * reach;
                is_ever |= *is_near;
            }
            if !is_ever {
                continue;
            }
            let first = is_near.iter().position(|is_near| *is_near);
            let last = is_near.iter().rposition(|is_near| *is_near);
            near.boxes.extend(first.zip(last).map(|times| (place, times)));
        }
    }

    /// Places of the boxes that the ego meets now.
    pub(super) fn met_now(&self, ego: &Footprint, place: (Vec2, Vec2)) -> Vec<usize> {
        let boxes = self.boxes.iter().enumerate();
        let met = boxes.filter(|(_, other)| ego.meets(place, other, 0));
        met.map(|(k, _)| k).collect()
    }

    /// The obstacle that a trajectory touches first, of those that it comes near to.
    pub fn touched(&self, near: &Near, points: &[Point], ego: &Footprint) -> Option<ObstacleId> {
        self.touched_at(near, points.len(), ego, |k| {
            (points[k].position, points[k].forward)
        })
    }

    /// The same for a trajectory of so many points that tells place and heading of those that matter.
    pub(super) fn touched_at(
        &self,
        near: &Near,
        points: usize,
        ego: &Footprint,
        place: impl Fn(usize) -> (Vec2, Vec2),
    ) -> Option<ObstacleId> {
        let (mut until, mut touched) = (points, None);
        for (other, (first, last)) in &near.boxes {
            let other = &self.boxes[*other];
            let mut times = *first..until.min(last + 1);
            if let Some(k) = times.find(|k| ego.meets(place(*k), other, *k)) {
                (until, touched) = (k, Some(other.id));
            }
        }
        touched
    }
}
