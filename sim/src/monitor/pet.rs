//! `pet`: the post-encroachment time, between one leaving a place and the other taking it, s.
//!
//! The place is whatever both footprints cover at their times, so the smallest of all times is that of their conflict
//! area. Courses must differ by more than 30°: the gap to who goes ahead the same way is not an encroachment but a
//! distance. From samples of the true motion, so up to two sampling periods late. World frame.

use super::measure::{Extreme, Measure};
use super::view::Sample;
use corridor_decider::geometry::{ConvexPolygon, Vec2};
use std::collections::VecDeque;

/// Smallest good time, s (SUMO SSM).
pub(super) const LIMIT: f64 = 2.0;

/// Longest time that is measured, s: SUMO's time after an encounter.
const WINDOW: f64 = 5.0;

/// Slower than this nobody has a course, m/s (nuPlan's standing).
const STANDS: f64 = 0.05;

/// Cosine of 30°.
const COS_SAME_COURSE: f64 = 0.866_025_403_784_438_6;

/// What a body covered at one time.
#[derive(Clone, Debug)]
struct Place {
    time: f64,
    center: Vec2,
    /// Direction of motion.
    course: Vec2,
    outline: ConvexPolygon,
}

/// The last seconds of a body, and the radius of the circle around its centre that holds it.
#[derive(Clone, Debug, Default)]
struct Track {
    places: VecDeque<Place>,
    radius: f64,
}

impl Track {
    fn push(&mut self, place: Place) {
        let oldest = place.time - WINDOW;
        while self.places.front().is_some_and(|first| first.time < oldest) {
            self.places.pop_front();
        }
        if self.radius <= 0.0 {
            let corners = place.outline.vertices().iter();
            self.radius = corners.map(|p| (p - place.center).norm()).fold(0.0, f64::max);
        }
        self.places.push_back(place);
    }

    /// How long ago this body, of another course, last covered something of what `other` covers now; less than `best`.
    fn left_before(&self, other: &Place, radius: f64, best: f64) -> Option<f64> {
        let reach = (self.radius + radius) * (self.radius + radius);
        let recent = self.places.iter().rev();
        recent
            .map(|place| (other.time - place.time, place))
            .take_while(|(ago, _)| *ago < best)
            .find(|(_, place)| {
                (place.center - other.center).norm_squared() <= reach
                    && place.course.dot(&other.course) < COS_SAME_COURSE
                    && place.outline.overlaps(&other.outline)
            })
            .map(|(ago, _)| ago)
    }
}

/// Watches who comes where the other was.
#[derive(Clone, Debug, Default)]
pub(super) struct PetWatch {
    ego: Track,
    others: Vec<Track>,
    least: Extreme,
}

impl PetWatch {
    pub(super) fn sample(&mut self, sample: &Sample) {
        let (scenario, ego) = (sample.scenario, sample.ego());
        let place = |center, velocity: Vec2, outline| Place {
            time: sample.time(),
            center,
            course: velocity.normalize(),
            outline,
        };
        if ego.v.abs() > STANDS {
            let center = scenario.vehicle.center(ego.pose).position();
            let velocity = ego.pose.forward() * ego.v;
            self.ego
                .push(place(center, velocity, sample.view.footprint.clone()));
        }
        self.others.resize_with(scenario.obstacles.len(), Track::default);
        for (obstacle, track) in scenario.obstacles.iter().zip(&mut self.others) {
            let motion = sample.view.traffic.motion(obstacle.id);
            if motion.velocity.norm() > STANDS {
                let outline = obstacle.shape.at(motion.pose);
                track.push(place(motion.pose.position(), motion.velocity, outline));
            }
            let best = self.least.value.unwrap_or(WINDOW);
            if let Some(time) = encroachment(&self.ego, track, sample.time(), best) {
                self.least.lower(time, sample.time(), Some(obstacle.id));
            }
        }
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        vec![self.least.measure("pet")]
    }
}

/// The time between two of which one, now, takes what the other had.
fn encroachment(a: &Track, b: &Track, now: f64, best: f64) -> Option<f64> {
    let one_way = |first: &Track, second: &Track| {
        let place = second.places.back().filter(|place| place.time >= now)?;
        first.left_before(place, second.radius, best)
    };
    let times = [one_way(a, b), one_way(b, a)];
    times.into_iter().flatten().reduce(f64::min)
}
