//! `drivable_area`, `driving_direction`, `lane_keep`: whether the ego stays where cars may be.
//!
//! nuPlan's rules; the lane's middle is the line planned along. Distances in metres; lanes are those of the map, not those a decider names.

use super::SAMPLE_PERIOD;
use super::measure::{Extreme, LongestSpan, Measure};
use super::plan::Plan;
use super::view::Sample;
use std::collections::VecDeque;

/// How far a corner of the ego may stick out of the road, m (nuPlan).
pub(super) const OFF_ROAD_TOLERANCE: f64 = 0.3;

/// Distance against the lane's direction within the window that fails a run, m (nuPlan's score is 0 from here on).
pub(super) const AGAINST_FAILS: f64 = 6.0;

/// Length of that window, s.
const AGAINST_WINDOW: f64 = 1.0;

/// How long after a borrow ends the way back is still part of it, s: two lane widths
/// at a gentle 1 m/s sideways, and some.
const RETURN_GRACE: f64 = 5.0;

/// Offset from the line that counts as out of the lane's middle, m (NAVSIM v2).
const KEEP_OFFSET: f64 = 0.5;

/// How long that may last, s (NAVSIM v2).
pub(super) const KEEP_LIMIT: f64 = 2.0;

/// Grace after a wanted departure from the lane before it counts, s (NAVSIM v2).
const KEEP_GRACE: f64 = 1.0;

/// Watches the ego's place on the road.
#[derive(Clone, Debug, Default)]
pub(super) struct RoadWatch {
    off_road: Extreme,
    against: Extreme,
    /// Metres against the direction in each sample of the window.
    window: VecDeque<f64>,
    /// When a label last allowed leaving the lane.
    allowed: Option<f64>,
    /// When a label last allowed borrowing another one.
    borrowed: Option<f64>,
    /// Whether the ego has been in a lane of its direction since.
    returned: bool,
    off_centre: LongestSpan,
}

impl RoadWatch {
    pub(super) fn sample(&mut self, sample: &Sample) {
        let map = &sample.scenario.map;
        for corner in sample.view.footprint.vertices() {
            self.off_road
                .raise(map.distance_off_road(*corner), sample.time(), None);
        }
        if sample.plan.is_some_and(Plan::leaves_lane) {
            self.allowed = Some(sample.time());
        }
        if sample.plan.is_some_and(Plan::borrows) {
            self.borrowed = Some(sample.time());
            self.returned = false;
        }
        self.direction(sample);
        let excused = self.allowed.is_some_and(|t| sample.time() - t <= KEEP_GRACE);
        let off_centre = sample.planned.l.abs() > KEEP_OFFSET && !excused;
        self.off_centre.sample(off_centre, sample.time());
    }

    fn direction(&mut self, sample: &Sample) {
        let against = distance_against(sample);
        if against <= 0.0 {
            self.returned = true;
        }
        let excused = !self.returned && self.borrowed.is_some_and(|t| sample.time() - t <= RETURN_GRACE);
        self.window.push_back(if excused { 0.0 } else { against });
        if self.window.len() as f64 * SAMPLE_PERIOD > AGAINST_WINDOW + SAMPLE_PERIOD / 2.0 {
            self.window.pop_front();
        }
        self.against.raise(self.window.iter().sum(), sample.time(), None);
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        vec![
            self.off_road.measure("drivable_area"),
            self.against.measure("driving_direction"),
            self.off_centre.measure("lane_keep"),
        ]
    }
}

/// Metres driven against the direction of every lane under the ego's centre since the last sample.
fn distance_against(sample: &Sample) -> f64 {
    let ego = sample.ego();
    let centre = sample.scenario.vehicle.center(ego.pose);
    let motion = ego.pose.forward() * ego.v * SAMPLE_PERIOD;
    let along = |theta: f64| {
        let (sin, cos) = corridor_decider::geometry::angle::sin_cos(theta);
        motion.x * cos + motion.y * sin
    };
    let lanes = sample.scenario.map.lanes_at(centre.position());
    let best = lanes.iter().map(|(_, theta)| along(*theta)).reduce(f64::max);
    best.map_or(0.0, |along| (-along).max(0.0))
}
