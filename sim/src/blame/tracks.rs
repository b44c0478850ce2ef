//! Where everybody else was during a run, and where they go on to after its end: what the search holds a motion
//! against, and the ground on which the car may be. World axes, SI units.

use super::car::CarState;
use corridor_decider::frame::ObstacleId;
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2, angle, cross};
use corridor_scenarios::Scenario;
use std::sync::Arc;

/// How far a corner may stick out of the road, m: what the monitor allows.
pub const OFF_ROAD: f64 = 0.3;

/// A pose with its sine and cosine, so that nobody computes them again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Centre of the obstacle.
    pub place: Vec2,
    /// Unit vector along its heading.
    pub forward: Vec2,
}

impl Placed {
    /// A pose as tracks keep it.
    pub fn at(pose: Pose) -> Self {
        let (sin, cos) = angle::sin_cos(pose.theta);
        Self {
            place: pose.position(),
            forward: Vec2::new(cos, sin),
        }
    }
}

/// One obstacle over time.
#[derive(Clone, Debug)]
pub struct Track {
    /// Its outline in its own frame.
    outline: Vec<Vec2>,
    /// Farthest vertex from its centre, m.
    reach: f64,
    /// Where it is at each sample; one pose for who never moves.
    poses: Vec<Placed>,
}

impl Track {
    /// The pose at sample `k`; the last one goes on.
    pub fn pose(&self, k: usize) -> &Placed {
        &self.poses[k.min(self.poses.len() - 1)]
    }

    pub(super) fn push(&mut self, pose: Pose) {
        self.poses.push(Placed::at(pose));
    }

    /// A circle around all of it between two samples.
    fn circle(&self, from: usize, to: usize) -> (Vec2, f64) {
        let centre = (self.pose(from).place + self.pose(to).place) / 2.0;
        let last = to.min(self.poses.len() - 1);
        let far = |p: &Placed| (p.place - centre).norm();
        let samples = &self.poses[from.min(last)..=last];
        (centre, samples.iter().map(far).fold(0.0, f64::max) + self.reach)
    }
}

/// The ego's rectangle around its rear axle, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// Rear axle to front bumper.
    pub front: f64,
    /// Rear axle to rear bumper.
    pub back: f64,
    /// Half the width.
    pub half_width: f64,
}

impl Rectangle {
    /// The same, drawn in on all sides.
    #[must_use]
    pub fn drawn_in(self, by: f64) -> Self {
        Self {
            front: self.front - by,
            back: self.back - by,
            half_width: self.half_width - by,
        }
    }

    fn corners(&self) -> [Vec2; 4] {
        [
            Vec2::new(-self.back, -self.half_width),
            Vec2::new(self.front, -self.half_width),
            Vec2::new(self.front, self.half_width),
            Vec2::new(-self.back, self.half_width),
        ]
    }

    /// Its middle ahead of the rear axle, and the farthest corner from there.
    fn circle(&self) -> (f64, f64) {
        let ahead = (self.front - self.back) / 2.0;
        (ahead, Vec2::new(self.front - ahead, self.half_width).norm())
    }

    /// Whether the interiors of this rectangle at `car` and of an outline at `other` meet.
    fn meets(&self, car: &CarState, outline: &[Vec2], other: &Placed) -> bool {
        let local = |v: Vec2| {
            let f = other.forward;
            let d = other.place + Vec2::new(f.x * v.x - f.y * v.y, f.y * v.x + f.x * v.y) - car.place;
            Vec2::new(car.forward.dot(&d), cross(car.forward, d))
        };
        let (mut low, mut high) = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
        for vertex in outline {
            let p = local(*vertex);
            (low, high) = (low.inf(&p), high.sup(&p));
        }
        if low.x >= self.front
            || high.x <= -self.back
            || low.y >= self.half_width
            || high.y <= -self.half_width
        {
            return false;
        }
        let corners = self.corners();
        let next = outline.iter().cycle().skip(1);
        outline.iter().zip(next).all(|(a, b)| {
            let (a, b) = (local(*a), local(*b));
            corners.iter().any(|c| cross(b - a, *c - a) > 0.0)
        })
    }
}

/// Everything that a motion of the car must keep clear of.
#[derive(Clone, Debug)]
pub struct Surroundings {
    /// The road and its name-giver.
    pub scenario: Arc<Scenario>,
    /// Everybody else, by [`corridor_decider::frame::ObstacleId`].
    pub tracks: Vec<Track>,
    /// Time between two samples of the tracks, s.
    pub dt: f64,
    /// How far off the road a corner may be, m: more where the run begins off it.
    pub off_road: f64,
}

/// Who is near enough to matter during a part of a motion.
#[derive(Debug, Default)]
pub(super) struct Near(Vec<usize>);

impl Surroundings {
    /// All obstacles of a scenario at their starts.
    pub fn new(scenario: &Scenario, dt: f64) -> Self {
        let track = |obstacle: &corridor_scenarios::scenario::Obstacle| Track {
            outline: obstacle.shape.vertices().to_vec(),
            reach: obstacle
                .shape
                .vertices()
                .iter()
                .map(Vec2::norm)
                .fold(0.0, f64::max),
            poses: vec![Placed::at(crate::agents::start_of(obstacle).pose)],
        };
        let start = scenario.vehicle.footprint(scenario.ego.pose);
        let off = |corner: &Vec2| scenario.map.distance_off_road(*corner);
        Self {
            tracks: scenario.obstacles.iter().map(track).collect(),
            dt,
            off_road: start.vertices().iter().map(off).fold(OFF_ROAD, f64::max),
            scenario: Arc::new(scenario.clone()),
        }
    }

    /// The car's rectangle.
    pub fn body(&self) -> Rectangle {
        let vehicle = &self.scenario.vehicle;
        Rectangle {
            front: vehicle.front_edge_to_center,
            back: vehicle.back_edge_to_center,
            half_width: vehicle.half_width(),
        }
    }

    /// Who may come near the car between two samples, when it goes from one place to another in that time.
    pub(super) fn near(
        &self,
        body: &Rectangle,
        car: &CarState,
        way: f64,
        samples: (usize, usize),
        near: &mut Near,
    ) {
        let (ahead, radius) = body.circle();
        let centre = car.place + car.forward * ahead;
        near.0.clear();
        for (k, track) in self.tracks.iter().enumerate() {
            let (other, reach) = track.circle(samples.0, samples.1);
            let apart = radius + way + reach;
            if (other - centre).norm_squared() < apart * apart {
                near.0.push(k);
            }
        }
    }

    /// Whether the car overlaps none of those that are near, at sample `k`.
    pub(super) fn is_clear(&self, body: &Rectangle, car: &CarState, k: usize, near: &Near) -> bool {
        let (ahead, radius) = body.circle();
        let centre = car.place + car.forward * ahead;
        near.0.iter().map(|of| &self.tracks[*of]).all(|track| {
            let other = track.pose(k);
            let apart = radius + track.reach;
            (other.place - centre).norm_squared() >= apart * apart || !body.meets(car, &track.outline, other)
        })
    }

    /// The outline of an obstacle at sample `k`.
    ///
    /// # Panics
    /// When there is no such obstacle.
    pub fn outline(&self, id: ObstacleId, k: usize) -> ConvexPolygon {
        let at = self.tracks[id.0 as usize].pose(k);
        let theta = libm::atan2(at.forward.y, at.forward.x);
        let pose = Pose::new(at.place.x, at.place.y, theta);
        self.scenario.obstacles[id.0 as usize].shape.at(pose)
    }

    /// Whether no corner of the car is farther than this off the road.
    pub fn is_on_road_within(&self, car: &CarState, tolerance: f64) -> bool {
        self.keeps_to_road(&self.body(), car, tolerance)
    }

    /// Whether all corners are on the road, within the tolerance.
    pub(super) fn is_on_road(&self, body: &Rectangle, car: &CarState) -> bool {
        self.keeps_to_road(body, car, self.off_road)
    }

    fn keeps_to_road(&self, body: &Rectangle, car: &CarState, tolerance: f64) -> bool {
        let left = Vec2::new(-car.forward.y, car.forward.x);
        body.corners().iter().all(|corner| {
            let at = car.place + car.forward * corner.x + left * corner.y;
            self.scenario.map.distance_off_road(at) <= tolerance
        })
    }
}
