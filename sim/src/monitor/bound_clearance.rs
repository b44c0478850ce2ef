//! `bound_obstacle_clearance`: room that the decided bound itself leaves to what stands, m.
//!
//! A bound answers where the car may be. Swept by the car's width it must not cover a standing obstacle of the frame,
//! whatever a path or a speed makes of it later; padding that leads through a blocker is part of the answer. Judged
//! in the Frenet plane of the line planned along, on the true outlines and not on the decider's boxes.

use super::measure::{Extreme, Measure};
use super::plan::Plan;
use super::silhouette::Silhouette;
use corridor_decider::frame::Frame;
use corridor_decider::reference_line::LineQuery;
use corridor_decider::tasks::path_bounds::{BoundPoint, Label};

/// Least room that a bound has to leave, m: the tracking tolerance, by which a car may be beside its path. With a
/// limit of 0 rounding would decide about a decider that keeps no buffer.
pub(super) const LEAST_ROOM: f64 = 0.1;

/// Watches the driven bounds.
#[derive(Clone, Debug, Default)]
pub(super) struct BoundClearanceWatch {
    least: Extreme,
}

impl BoundClearanceWatch {
    pub(super) fn tick(&mut self, frame: &Frame, plan: &Plan, standing: &[&Silhouette], half_width: f64) {
        let points = answered(plan);
        for obstacle in standing {
            if let Some(gap) = clearance(points, half_width, obstacle) {
                self.least.lower(gap, frame.time, Some(obstacle.id));
            }
        }
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        vec![self.least.measure("bound_obstacle_clearance")]
    }
}

/// The points of the driven bound. One to pull over ends, for its judge, at the place where the car will stand:
/// what it says beyond is never driven.
fn answered(plan: &Plan) -> &[BoundPoint] {
    let Some(bound) = &plan.bound else { return &[] };
    let place = plan.target.zip(plan.line.as_ref());
    let place = place.filter(|_| bound.label == Label::PullOver);
    let count = place.map_or(bound.points.len(), |(target, line)| {
        let s = line.to_frenet(target.position).s;
        bound.points.partition_point(|p| p.s <= s)
    });
    &bound.points[..count]
}

/// Least distance across the line between the swept bound and an obstacle; negative by how deep they overlap.
/// `None` where the bound is not beside it. Between two stations the bound is the wider of both.
fn clearance(points: &[BoundPoint], half_width: f64, obstacle: &Silhouette) -> Option<f64> {
    let first = points.partition_point(|p| p.s < obstacle.start).saturating_sub(1);
    let beside = points[first..]
        .windows(2)
        .take_while(|pair| pair[0].s <= obstacle.end);
    beside
        .filter_map(|pair| {
            let covered = obstacle.between(pair[0].s, pair[1].s)?;
            let right = pair[0].l_min.min(pair[1].l_min) - half_width;
            let left = pair[0].l_max.max(pair[1].l_max) + half_width;
            Some((covered.right - left).max(right - covered.left))
        })
        .reduce(f64::min)
}
