//! `path_obstacle_clearance`: room between the body on its decided path and what stands, m.
//!
//! The whole footprint, without any margin, is held against the true outlines at every point of the path up to where
//! the trajectory ends, and half way between the points. World frame.

use super::measure::{Extreme, Measure};
use corridor_decider::decision::{Decision, PathPoint};
use corridor_decider::frame::{Frame, Obstacle};
use corridor_decider::geometry::{Pose, angle};
use corridor_decider::vehicle::VehicleParams;

/// Distances beyond this are not measured, m: nobody asks whether a path is a metre or two from a wall.
const NEAR: f64 = 0.5;

/// Distance at which the body touches, m: it has to stay above.
pub(super) const TOUCHING: f64 = 0.0;

/// Watches the driven paths.
#[derive(Clone, Debug, Default)]
pub(super) struct PathClearanceWatch {
    least: Extreme,
}

impl PathClearanceWatch {
    pub(super) fn tick(&mut self, frame: &Frame, decision: &Decision, vehicle: &VehicleParams) {
        let driven = driven(decision);
        let (Some(first), Some(last)) = (driven.first(), driven.last()) else {
            return;
        };
        // A circle around all that the body passes over.
        let body = vehicle.front_edge_to_center + vehicle.half_width() + NEAR;
        let middle = (first.pose.position() + last.pose.position()) / 2.0;
        let reach = (last.distance - first.distance) / 2.0 + body;
        for obstacle in frame.obstacles.iter().filter(|o| o.is_static) {
            let extent = extent(obstacle);
            let within = |reach: f64| (reach + extent) * (reach + extent);
            if (obstacle.pose.position() - middle).norm_squared() > within(reach) {
                continue;
            }
            let outline = obstacle.footprint();
            for pose in densified(driven) {
                if (obstacle.pose.position() - pose.position()).norm_squared() <= within(body) {
                    let gap = vehicle.footprint(pose).distance(&outline);
                    if gap <= NEAR {
                        self.least.lower(gap, frame.time, Some(obstacle.id));
                    }
                }
            }
        }
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        vec![self.least.measure("path_obstacle_clearance")]
    }
}

/// The path as far as the trajectory drives it. Without a chosen bound there is none: what is driven then is no
/// decision but the end of the last one.
fn driven(decision: &Decision) -> &[PathPoint] {
    if decision.chosen.is_none() {
        return &[];
    }
    let end = decision.trajectory.last().map_or(0.0, |p| p.distance);
    let count = decision.path.partition_point(|p| p.distance <= end);
    &decision.path[..count]
}

/// The poses of a path with one more half way between two points.
fn densified(path: &[PathPoint]) -> impl Iterator<Item = Pose> + '_ {
    let between = |pair: &[PathPoint]| {
        let (a, b) = (pair[0].pose, pair[1].pose);
        let position = (a.position() + b.position()) / 2.0;
        let half_turn = angle::difference(b.theta, a.theta) / 2.0;
        Pose::new(position.x, position.y, a.theta + half_turn)
    };
    path.windows(2)
        .map(between)
        .chain(path.iter().map(|point| point.pose))
}

/// Radius of the circle around an obstacle's centre that holds it.
fn extent(obstacle: &Obstacle) -> f64 {
    let corners = obstacle.shape.vertices().iter();
    corners.map(nalgebra::Matrix::norm).fold(0.0, f64::max)
}
