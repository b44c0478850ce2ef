//! Whether a trajectory would touch anything: whole footprints against predicted ones, at the times of the grid (the
//! original's `CollisionChecker`).
//!
//! Every obstacle is a box at each time, made once. Which boxes a longitudinal curve comes near to at all is found once
//! for all its pairs; only those are held against the footprints, circles first.

use super::combine::{LongitudinalTrack, Point};
use super::grid::TIMES;
use super::prediction::pose_at;
use crate::frame::{Obstacle, ObstacleId};
use crate::geometry::{Pose, Vec2};
use crate::vehicle::VehicleParams;

/// Room before and behind an obstacle, m, and to its sides (`lon_collision_buffer`, `lat_collision_buffer`).
const LENGTHWISE: f64 = 2.0;
const SIDEWAYS: f64 = 0.1;

/// A rectangle with a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct GrownBox {
    center: Vec2,
    forward: Vec2,
    /// Half its length and width, m.
    half: (f64, f64),
    /// Radius of the circle around it, m.
    radius: f64,
    id: ObstacleId,
}

/// The box around an obstacle's outline in its own frame, with the room that is kept.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Outline {
    middle: Vec2,
    half: (f64, f64),
    id: ObstacleId,
}

impl Outline {
    fn of(obstacle: &Obstacle) -> Self {
        let (mut low, mut high) = (Vec2::repeat(f64::MAX), Vec2::repeat(-f64::MAX));
        for vertex in obstacle.shape.vertices() {
            (low, high) = (low.inf(vertex), high.sup(vertex));
        }
        let half = (high - low) / 2.0;
        Self {
            middle: (low + high) / 2.0,
            half: (half.x + LENGTHWISE, half.y + SIDEWAYS),
            id: obstacle.id,
        }
    }

    fn at(&self, pose: Pose) -> GrownBox {
        let forward = pose.forward();
        let left = Vec2::new(-forward.y, forward.x);
        GrownBox {
            center: pose.position() + forward * self.middle.x + left * self.middle.y,
            forward,
            half: self.half,
            radius: Vec2::new(self.half.0, self.half.1).norm(),
            id: self.id,
        }
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

    /// Whether it meets a box with the rear axle at `position`; touching counts.
    fn meets(&self, position: Vec2, forward: Vec2, other: &GrownBox) -> bool {
        let d = other.center - position - forward * self.ahead;
        let reach = self.radius + other.radius;
        if d.norm_squared() > reach * reach {
            return false;
        }
        let cos = forward.dot(&other.forward).abs();
        let sin = (forward.x * other.forward.y - forward.y * other.forward.x).abs();
        let along = |axis: Vec2| (axis.dot(&d).abs(), (axis.x * d.y - axis.y * d.x).abs());
        let (own, its) = (along(forward), along(other.forward));
        own.0 <= self.half.0 + other.half.0 * cos + other.half.1 * sin
            && own.1 <= self.half.1 + other.half.0 * sin + other.half.1 * cos
            && its.0 <= other.half.0 + self.half.0 * cos + self.half.1 * sin
            && its.1 <= other.half.1 + self.half.0 * sin + self.half.1 * cos
    }
}

/// Every obstacle at every time of the grid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CollisionEnvironment {
    /// Per time the boxes, each time as many.
    frames: Vec<Vec<GrownBox>>,
}

/// The boxes that a longitudinal curve comes near to, by time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Near {
    /// Per point of the curve where its boxes begin.
    starts: Vec<usize>,
    boxes: Vec<GrownBox>,
}

impl CollisionEnvironment {
    /// The obstacles that are not ignored, `delay` seconds later than the times of the grid.
    pub fn new(obstacles: &[Obstacle], delay: f64, ignored: impl Fn(&Obstacle) -> bool) -> Self {
        let kept: Vec<(&Obstacle, Outline)> = obstacles
            .iter()
            .filter(|obstacle| !ignored(obstacle))
            .map(|obstacle| (obstacle, Outline::of(obstacle)))
            .collect();
        let standing: Vec<GrownBox> = kept
            .iter()
            .map(|(obstacle, outline)| outline.at(obstacle.pose))
            .collect();
        let mut places = vec![0; kept.len()];
        let mut frame = |t: &f64| -> Vec<GrownBox> {
            let boxes = kept.iter().zip(&standing).zip(&mut places);
            boxes
                .map(|(((obstacle, outline), standing), place)| {
                    pose_at(&obstacle.prediction, t + delay, place).map_or(*standing, |pose| outline.at(pose))
                })
                .collect()
        };
        Self {
            frames: TIMES.iter().map(&mut frame).collect(),
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
        near.starts.clear();
        near.boxes.clear();
        let around = largest_offset + ego.ahead + ego.radius;
        for (position, frame) in track.positions().zip(&self.frames) {
            near.starts.push(near.boxes.len());
            let comes_near = |other: &&GrownBox| {
                let reach = around + other.radius;
                (other.center - position).norm_squared() <= reach * reach
            };
            near.boxes.extend(frame.iter().filter(comes_near));
        }
        near.starts.push(near.boxes.len());
    }
}

impl Near {
    /// The first obstacle that a trajectory touches.
    pub fn touched(&self, points: &[Point], ego: &Footprint) -> Option<ObstacleId> {
        self.touched_at(points.len(), ego, |k| (points[k].position, points[k].forward))
    }

    /// The same for a trajectory of so many points that tells place and heading of those that matter.
    pub(super) fn touched_at(
        &self,
        points: usize,
        ego: &Footprint,
        place: impl Fn(usize) -> (Vec2, Vec2),
    ) -> Option<ObstacleId> {
        let spans = self.starts.windows(2).take(points).enumerate();
        spans.filter(|(_, span)| span[0] < span[1]).find_map(|(k, span)| {
            let (position, forward) = place(k);
            let meets = |other: &&GrownBox| ego.meets(position, forward, other);
            let met = self.boxes[span[0]..span[1]].iter().find(meets);
            met.map(|other| other.id)
        })
    }
}
