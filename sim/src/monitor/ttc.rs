//! `ttc`: the time to collision if everybody went straight on at the velocity of the moment.
//!
//! nuPlan's rule: footprints are moved, not turned, in steps of 0.1 s up to 3 s. What lies ahead counts always, what
//! lies behind never, what lies beside only where the ego is in several lanes. World frame, SI units.

use super::collision::{COS_BEHIND, is_in_several_lanes};
use super::measure::{Extreme, Measure};
use super::view::{Motion, Sample};
use corridor_decider::frame::ObstacleId;
use corridor_decider::geometry::Vec2;
use corridor_scenarios::Scenario;
use corridor_scenarios::scenario::Obstacle;

/// Step of the projection, s.
const STEP: f64 = 0.1;

/// Steps up to the horizon of 3 s.
const STEPS: u32 = 30;

/// The horizon, s.
const HORIZON: f64 = 3.0;

/// Smallest good value, s (nuPlan).
pub(super) const LIMIT: f64 = 0.95;

/// Slower than this the ego runs into nobody, m/s (NAVSIM).
const STANDS: f64 = 0.005;

/// Cosine of 30°: whatever lies within this of the heading is ahead (nuPlan).
const COS_AHEAD: f64 = 0.866_025_403_784_438_6;

/// Watches the time to collision.
#[derive(Clone, Debug)]
pub(super) struct TtcWatch {
    /// Distance of the farthest vertex of each obstacle from its centre, m.
    radii: Vec<f64>,
    ego_radius: f64,
    least: Extreme,
}

impl TtcWatch {
    pub(super) fn new(scenario: &Scenario) -> Self {
        let reach = |o: &Obstacle| o.shape.vertices().iter().map(Vec2::norm).fold(0.0, f64::max);
        let vehicle = &scenario.vehicle;
        Self {
            radii: scenario.obstacles.iter().map(reach).collect(),
            ego_radius: libm::hypot(vehicle.length / 2.0, vehicle.half_width()),
            least: Extreme::default(),
        }
    }

    pub(super) fn sample(&mut self, sample: &Sample) {
        let ego = sample.ego();
        if ego.v.abs() < STANDS {
            return;
        }
        let centre = sample.scenario.vehicle.center(ego.pose).position();
        let forward = ego.pose.forward();
        let mut several_lanes = None;
        for (obstacle, radius) in sample.scenario.obstacles.iter().zip(&self.radii) {
            let motion = sample.view.traffic.motion(obstacle.id);
            let relative = motion.velocity - forward * ego.v;
            let away = motion.pose.position() - centre;
            if !comes_within(away, relative, radius + self.ego_radius) {
                continue;
            }
            let round = (motion.pose.position() - ego.pose.position())
                .normalize()
                .dot(&forward);
            let beside_counts = || is_in_several_lanes(&sample.scenario.map, sample.view.footprint);
            let counts = round >= COS_AHEAD
                || (round >= COS_BEHIND && *several_lanes.get_or_insert_with(beside_counts));
            if let Some(ttc) = counts
                .then(|| time_to_contact(sample, obstacle.id, motion, relative))
                .flatten()
            {
                self.least.lower(ttc, sample.time(), Some(obstacle.id));
            }
        }
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        vec![self.least.measure("ttc")]
    }
}

/// Whether a point `away` that moves with `velocity` comes within `radius` of the origin before the horizon.
fn comes_within(away: Vec2, velocity: Vec2, radius: f64) -> bool {
    let speed_squared = velocity.norm_squared();
    let nearest = if speed_squared > 0.0 {
        (-away.dot(&velocity) / speed_squared).clamp(0.0, HORIZON)
    } else {
        0.0
    };
    (away + velocity * nearest).norm_squared() <= radius * radius
}

fn time_to_contact(sample: &Sample, id: ObstacleId, motion: Motion, relative: Vec2) -> Option<f64> {
    let obstacle = sample.scenario.obstacles.get(id.0 as usize)?;
    (1..=STEPS).map(|k| f64::from(k) * STEP).find(|t| {
        let mut pose = motion.pose;
        pose.x += relative.x * t;
        pose.y += relative.y * t;
        sample.view.footprint.overlaps(&obstacle.shape.at(pose))
    })
}
