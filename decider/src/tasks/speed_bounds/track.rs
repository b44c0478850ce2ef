//! A path prepared for the question where along it the ego's body would touch something.

use super::contact::Contact;
use crate::decision::PathPoint;
use crate::frame::{Obstacle, PredictedPose};
use crate::geometry::{Vec2, angle};
use crate::st_graph::{StBoundary, StPair};
use crate::vehicle::VehicleParams;

/// Predictions before this are past, s.
const OLDEST: f64 = -1.0;

/// Share of the body's length between two anchors: less than 1, so that no contact slips through between two.
const ANCHOR_STEP: f64 = 0.75;

/// No path worth driving has more anchors: 3.7 km of them.
const MOST_ANCHORS: f64 = 1000.0;

/// A path with the body that is to move along it.
#[derive(Clone, Debug)]
pub struct Track {
    /// Path points with their directions.
    pub(super) points: Vec<Place>,
    /// Places along the path so near to each other that neighbouring bodies overlap.
    pub(super) anchors: Vec<Anchor>,
    /// Rear axle to the bumpers, m, and half the width with its buffer.
    pub(super) front: f64,
    pub(super) back: f64,
    pub(super) half_width: f64,
    /// Radius of a circle around the body, m.
    pub(super) radius: f64,
    front_edge: f64,
    total_time: f64,
}

/// A place of the rear axle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub distance: f64,
    pub position: Vec2,
    pub forward: Vec2,
}

/// A place with the middle of the body there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Anchor {
    pub place: Place,
    pub center: Vec2,
}

impl Track {
    /// For a path of two points or more; `None` otherwise. `buffer` is room beside the body that counts as the body, m;
    /// `total_time` is how long what stands is there, s.
    pub fn new(vehicle: &VehicleParams, path: &[PathPoint], buffer: f64, total_time: f64) -> Option<Self> {
        let [_, .., last] = path else { return None };
        let points: Vec<Place> = path.iter().map(Place::of).collect();
        let (front, back) = (vehicle.front_edge_to_center, vehicle.back_edge_to_center);
        let half_width = vehicle.half_width() + buffer;
        let half_length = f64::midpoint(front, back);
        let mut track = Self {
            points,
            anchors: Vec::new(),
            front,
            back,
            half_width,
            radius: Vec2::new(half_length, half_width).norm(),
            front_edge: front,
            total_time,
        };
        let step = ((front + back) * ANCHOR_STEP).max(last.distance / MOST_ANCHORS);
        let mut distance = 0.0;
        while step > 0.0 && distance < last.distance {
            track.add_anchor(distance);
            distance += step;
        }
        track.add_anchor(last.distance);
        Some(track)
    }

    fn add_anchor(&mut self, distance: f64) {
        let place = self.place_at(distance);
        let center = place.position + place.forward * f64::midpoint(self.front, -self.back);
        self.anchors.push(Anchor { place, center });
    }

    /// Length of the path, m.
    pub fn length(&self) -> f64 {
        self.points[self.points.len() - 1].distance
    }

    /// The place at a distance, which is clamped to the path.
    pub(super) fn place_at(&self, distance: f64) -> Place {
        let last = self.points.len() - 1;
        let above = self
            .points
            .partition_point(|point| point.distance <= distance)
            .clamp(1, last);
        let (a, b) = (&self.points[above - 1], &self.points[above]);
        let length = b.distance - a.distance;
        let share = if length > 0.0 {
            ((distance - a.distance) / length).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let forward = a.forward + (b.forward - a.forward) * share;
        let norm = forward.norm();
        Place {
            distance: a.distance + length * share,
            position: a.position + (b.position - a.position) * share,
            forward: if norm > 0.0 { forward / norm } else { a.forward },
        }
    }

    /// What an obstacle will occupy of the path; `None` if nothing.
    pub fn occupied(&self, obstacle: &Obstacle) -> Option<StBoundary> {
        let radius = obstacle
            .shape
            .vertices()
            .iter()
            .map(nalgebra::Matrix::norm)
            .fold(0.0, f64::max);
        if obstacle.prediction.is_empty() {
            let now = PredictedPose {
                t: 0.0,
                pose: obstacle.pose,
            };
            let contact = self.contact(obstacle, radius, &now, &mut Vec::new())?;
            return self.standing(obstacle, contact);
        }
        StBoundary::reduced(self.predicted(obstacle, radius)).ok()
    }

    /// One rectangle, from a car's overhang before the contact to the end of what stands there.
    fn standing(&self, obstacle: &Obstacle, contact: Contact) -> Option<StBoundary> {
        let along = obstacle.shape.vertices().iter().map(|vertex| vertex.x);
        let (tail, nose) = along.fold((f64::MAX, -f64::MAX), |(low, high), x| (low.min(x), high.max(x)));
        let lower = (contact.low - self.front_edge).max(0.0);
        let upper = contact.high.max(contact.low + nose - tail).min(self.length());
        let pair = |t| StPair::new(t, lower, upper);
        StBoundary::new(vec![pair(0.0), pair(self.total_time)]).ok()
    }

    /// A pair for each predicted time at which there is a contact.
    fn predicted(&self, obstacle: &Obstacle, radius: f64) -> Vec<StPair> {
        let mut pairs = Vec::with_capacity(obstacle.prediction.len());
        let mut corners = Vec::new();
        // How far the obstacle may still move before it could touch the path, and where it was then.
        let (mut clearance, mut from) = (0.0_f64, obstacle.pose.position());
        for predicted in obstacle
            .prediction
            .iter()
            .filter(|predicted| predicted.t >= OLDEST)
        {
            let center = predicted.pose.position();
            if clearance > 0.0 && (center - from).norm_squared() < clearance * clearance {
                continue;
            }
            (clearance, from) = (self.clearance(center, radius), center);
            if clearance > 0.0 {
                continue;
            }
            if let Some(contact) = self.contact(obstacle, radius, predicted, &mut corners) {
                pairs.push(StPair::new(predicted.t, contact.low, contact.high));
            }
        }
        pairs
    }

    fn contact(
        &self,
        obstacle: &Obstacle,
        radius: f64,
        at: &PredictedPose,
        corners: &mut Vec<Vec2>,
    ) -> Option<Contact> {
        let (sin, cos) = angle::sin_cos(at.pose.theta);
        corners.clear();
        corners.extend(obstacle.shape.vertices().iter().map(|v| {
            Vec2::new(
                at.pose.x + cos * v.x - sin * v.y,
                at.pose.y + sin * v.x + cos * v.y,
            )
        }));
        self.first_contact(corners, at.pose.position(), radius)
    }
}

impl Place {
    fn of(point: &PathPoint) -> Self {
        Self {
            distance: point.distance,
            position: point.pose.position(),
            forward: point.pose.forward(),
        }
    }
}
