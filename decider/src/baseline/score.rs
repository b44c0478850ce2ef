//! What a simulated drive is worth, in the manner of nuPlan's closed-loop score: factors that make it worthless, and
//! terms that are weighed.

use super::Scene;
use super::rollout::{Rollout, STEP};
use super::traffic::Traffic;
use crate::decision::TrajectoryPoint;
use crate::geometry::{Pose, angle};
use crate::lattice::Curve;

/// How far a drive is looked at: four seconds.
pub const SCORED_STEPS: usize = 40;

/// Weights of progress, time to collision and comfort (nuPlan's).
const WEIGHTS: [f64; 3] = [5.0, 5.0, 2.0];

/// Steps after which a car that went straight on may not touch anything: nuPlan asks for 0.95 s.
const AHEAD: [usize; 3] = [3, 6, 9];

/// Who drives more slowly than this stands, m/s: whoever drives into that is at fault.
const STANDS: f64 = 0.05;

/// Limits of comfort: longitudinal (from, to) and lateral acceleration, m/s² (nuPlan's).
const LONGITUDINAL: (f64, f64) = (-4.05, 2.40);
const LATERAL: f64 = 4.89;

/// Less progress than this is none for anybody, m.
const LEAST_PROGRESS: f64 = 0.1;

/// What there is to say about a drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assessment {
    /// When the car first touches something by its own fault, s.
    pub collision: Option<f64>,
    /// Whether it stays on the road.
    pub on_road: bool,
    /// How far it gets along the line, m.
    pub progress: f64,
    /// Whether it is nowhere about to touch something.
    pub keeps_time: bool,
    /// Whether its accelerations are comfortable.
    pub is_comfortable: bool,
}

impl Assessment {
    /// Whether it is worth anything.
    pub fn is_possible(&self) -> bool {
        self.collision.is_none() && self.on_road
    }

    /// Its score, from 0 to 1, where the best possible drive gets `farthest` metres.
    pub fn score(&self, farthest: f64) -> f64 {
        if !self.is_possible() {
            return 0.0;
        }
        let progress = if farthest > LEAST_PROGRESS {
            (self.progress / farthest).clamp(0.0, 1.0)
        } else {
            1.0
        };
        let of = |is: bool| f64::from(u8::from(is));
        let terms = [progress, of(self.keeps_time), of(self.is_comfortable)];
        let weighed = WEIGHTS.iter().zip(terms).map(|(weight, term)| weight * term);
        weighed.sum::<f64>() / WEIGHTS.iter().sum::<f64>()
    }
}

/// Judges a drive among obstacles.
pub fn assess(scene: &Scene, traffic: &Traffic, rollout: &Rollout) -> Assessment {
    let points = &rollout.points[..rollout.points.len().min(SCORED_STEPS + 1)];
    let states = &rollout.states[..points.len()];
    let [start, ..] = scene.initial.s;
    let touching = |k: &usize| touches(scene, traffic, &points[*k], points[*k].pose, *k);
    let about_to = |k: usize| {
        let point = &points[k];
        AHEAD.iter().any(|steps| {
            let pose = point.pose.advanced(point.v * *steps as f64 * STEP);
            touches(scene, traffic, point, pose, k + steps)
        })
    };
    let is_comfortable = |point: &TrajectoryPoint| {
        (LONGITUDINAL.0..=LONGITUDINAL.1).contains(&point.a)
            && (point.v * point.v * point.kappa).abs() <= LATERAL
    };
    Assessment {
        collision: (0..points.len()).find(touching).map(|k| k as f64 * STEP),
        on_road: states
            .iter()
            .all(|state| is_on_road(scene, &rollout.lateral, state.s)),
        progress: states.last().map_or(0.0, |state| state.s - start),
        // Every other step: a body is longer than what anybody drives in that time.
        keeps_time: !(0..points.len()).step_by(2).any(about_to),
        is_comfortable: points.iter().all(is_comfortable),
    }
}

/// Whether the car, moving as at a point, would at a pose touch something after so many steps by its own fault. Who
/// stands is never at fault, nor who is hit from behind.
fn touches(scene: &Scene, traffic: &Traffic, point: &TrajectoryPoint, pose: Pose, step: usize) -> bool {
    if point.v < STANDS {
        return false;
    }
    let vehicle = scene.vehicle;
    let middle = vehicle.center(pose).position();
    let reach = vehicle.length / 2.0 + vehicle.half_width();
    let mut footprint = None;
    traffic.bodies.iter().any(|body| {
        let there = body.at(step);
        let (near, d) = (reach + body.radius, there.center - middle);
        d.norm_squared() <= near * near
            && pose.to_local(there.center).x > -vehicle.back_edge_to_center
            && footprint
                .get_or_insert_with(|| vehicle.footprint(pose))
                .overlaps(&there.outline)
    })
}

/// Whether all corners of the body are on the road with the rear axle at a station. What is not known is road.
fn is_on_road(scene: &Scene, lateral: &Curve, s: f64) -> bool {
    let vehicle = scene.vehicle;
    let foot = scene.line.at(s);
    let [l, dl, ..] = lateral.at(s - scene.initial.s[0]);
    let (sin, cos) = angle::sin_cos(libm::atan2(dl, 1.0 - foot.kappa * l));
    let ends = [vehicle.front_edge_to_center, -vehicle.back_edge_to_center];
    let sides = [vehicle.half_width(), -vehicle.half_width()];
    ends.into_iter().all(|x| {
        sides.into_iter().all(|y| {
            // The line bends away from the body's axis.
            let across = l + x * sin + y * cos - foot.kappa * x * x / 2.0;
            (scene.road_width)(s + x * cos).is_none_or(|(left, right)| across <= left && across >= -right)
        })
    })
}
