//! `no_collision`, `no_at_fault_collision`, `min_clearance`: who touched whom, and who is to blame.
//!
//! Classes and blame by nuPlan's rule (`no_ego_at_fault_collisions`): the speeds just before the contact, the
//! geometry at the contact. World frame, SI units.

use super::avoidance::History;
use super::impact;
use super::measure::{Extreme, Measure, name_of};
use super::road::OFF_ROAD_TOLERANCE;
use super::view::{Motion, StepView};
use crate::verdict::{Collision, CollisionClass};
use corridor_decider::frame::{EgoState, ObstacleId, ObstacleKind};
use corridor_decider::geometry::{ConvexPolygon, Vec2};
use corridor_decider::road::RoadMap;
use corridor_decider::vehicle::VehicleParams;
use corridor_scenarios::Scenario;

/// At or below this speed a body stands, m/s (nuPlan).
const STOPPED_SPEED: f64 = 0.05;

/// Cosine of 150°: whatever lies farther round than this from the ego's heading is behind it (nuPlan).
pub(super) const COS_BEHIND: f64 = -0.866_025_403_784_438_6;

/// Clearance below which people begin to wonder, m: the nominal lateral buffer of the bounds.
pub(super) const CLEARANCE_WARNING: f64 = 0.4;

/// Good number of contacts.
pub(super) const NONE: f64 = 0.0;

/// All first contacts of a run.
#[derive(Clone, Debug, Default)]
pub(super) struct CollisionJudge {
    touched: Vec<ObstacleId>,
    collisions: Vec<Collision>,
    clearance: Extreme,
    /// The ego before the step: physics may already have pushed it in the step that finds the contact.
    before: Option<EgoState>,
}

impl CollisionJudge {
    pub(super) fn step(&mut self, scenario: &Scenario, view: &StepView, history: &History) {
        if let Some((distance, id)) = view.clearance {
            self.clearance.lower(distance, view.time, Some(id));
        }
        for id in view.overlapping {
            if !self.touched.contains(id) {
                self.touched.push(*id);
                let collision = self.judge(scenario, view, *id, history);
                self.collisions.push(collision);
            }
        }
        self.before = Some(*view.ego);
    }

    pub(super) fn collisions(&self) -> &[Collision] {
        &self.collisions
    }

    fn judge(&self, scenario: &Scenario, view: &StepView, id: ObstacleId, history: &History) -> Collision {
        let before = self.before.unwrap_or(*view.ego);
        let motion = view.traffic.motion(id);
        let shape = scenario
            .obstacles
            .get(id.0 as usize)
            .map(|o| o.shape.at(motion.pose));
        let class = classify(&before, view.ego, &scenario.vehicle, &motion, shape.as_ref());
        let at_fault = match class {
            CollisionClass::StoppedTrack | CollisionClass::ActiveFront => true,
            CollisionClass::ActiveLateral => is_out_of_lane(&scenario.map, view.footprint),
            CollisionClass::StoppedEgo | CollisionClass::ActiveRear => false,
        };
        let names: Vec<String> = scenario.obstacles.iter().map(|o| o.name.clone()).collect();
        Collision {
            time: view.time,
            obstacle: name_of(&names, id),
            class,
            at_fault,
            delta_v: (before.pose.forward() * before.v - motion.velocity).norm(),
            avoidable: !matches!(class, CollisionClass::StoppedEgo | CollisionClass::ActiveRear)
                && history.braking_would_have_avoided(scenario, id, view.time, motion),
        }
    }

    /// nuPlan's multiplier: 0 after any contact with people or vehicles for which the ego is to blame, a half after one
    /// with a mere thing.
    pub(super) fn multiplier(&self, scenario: &Scenario) -> f64 {
        let (mut things, mut others) = (0, 0);
        for (collision, id) in self.collisions.iter().zip(&self.touched) {
            let obstacle = scenario.obstacles.get(id.0 as usize);
            let is_thing =
                obstacle.is_some_and(|o| matches!(o.kind, ObstacleKind::Cone | ObstacleKind::Other));
            match (collision.at_fault, is_thing) {
                (true, true) => things += 1,
                (true, false) => others += 1,
                (false, _) => (),
            }
        }
        match (things, others) {
            (0, 0) => 1.0,
            (1, 0) => 0.5,
            _ => 0.0,
        }
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        let first = self.collisions.first();
        let count = |wanted: &dyn Fn(&Collision) -> bool| {
            Some(self.collisions.iter().filter(|c| wanted(c)).count() as f64)
        };
        let named = |name, value| {
            let measure = Measure::new(name, value).at(first.map(|c| c.time));
            measure.with(self.touched.first().copied())
        };
        let mut measures = vec![
            named("no_collision", count(&|_| true)),
            named("no_at_fault_collision", count(&|c| c.at_fault)),
            named("avoidable_collisions", count(&|c| c.avoidable)),
            self.clearance.measure("min_clearance"),
        ];
        measures.extend(impact::measures(&self.collisions, &self.touched));
        measures
    }
}

/// The class of a contact: the first of these that fits.
fn classify(
    before: &EgoState,
    now: &EgoState,
    vehicle: &VehicleParams,
    other: &Motion,
    shape: Option<&ConvexPolygon>,
) -> CollisionClass {
    if before.v.abs() <= STOPPED_SPEED {
        CollisionClass::StoppedEgo
    } else if other.velocity.norm() <= STOPPED_SPEED {
        CollisionClass::StoppedTrack
    } else if is_behind(now, other.pose.position()) {
        CollisionClass::ActiveRear
    } else if shape.is_some_and(|shape| bumper_meets(now, vehicle, shape)) {
        CollisionClass::ActiveFront
    } else {
        CollisionClass::ActiveLateral
    }
}

/// Whether `point` lies behind the ego: seen from the rear axle, more than 150° off its heading.
pub(super) fn is_behind(ego: &EgoState, point: Vec2) -> bool {
    let to = point - ego.pose.position();
    to.dot(&ego.pose.forward()) < COS_BEHIND * to.norm()
}

/// Whether the ego's front edge passes through `shape`.
fn bumper_meets(ego: &EgoState, vehicle: &VehicleParams, shape: &ConvexPolygon) -> bool {
    let corner = |side: f64| {
        let local = Vec2::new(vehicle.front_edge_to_center, side * vehicle.half_width());
        ego.pose.to_world(local)
    };
    let (from, to) = (corner(-1.0), corner(1.0));
    // Clip the edge against the half planes of the polygon; what is left lies inside.
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    for (a, b) in shape.edges() {
        let inside = |p: Vec2| corridor_decider::geometry::cross(b - a, p - a);
        let (start, end) = (inside(from), inside(to));
        if start < 0.0 && end < 0.0 {
            return false;
        }
        if start < 0.0 {
            low = low.max(start / (start - end));
        } else if end < 0.0 {
            high = high.min(start / (start - end));
        }
    }
    low <= high
}

/// Whether the ego is to blame for a contact side by side: it is off the road, or no single lane holds all of it
/// while its corners lie in several.
fn is_out_of_lane(map: &RoadMap, footprint: &ConvexPolygon) -> bool {
    let corners = footprint.vertices();
    if corners
        .iter()
        .any(|c| map.distance_off_road(*c) > OFF_ROAD_TOLERANCE)
    {
        return true;
    }
    is_in_several_lanes(map, footprint)
}

/// Whether the corners lie in several lanes of which none holds them all.
pub(super) fn is_in_several_lanes(map: &RoadMap, footprint: &ConvexPolygon) -> bool {
    let corners = footprint.vertices();
    let mut lanes: Vec<_> = corners
        .iter()
        .flat_map(|c| map.lanes_at(*c))
        .map(|(id, _)| id)
        .collect();
    lanes.sort_unstable();
    let most = lanes.chunk_by(|a, b| a == b).map(<[_]>::len).max();
    lanes.dedup();
    lanes.len() > 1 && most.is_some_and(|held| held < corners.len())
}
