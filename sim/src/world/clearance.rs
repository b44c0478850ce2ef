//! How near the ego is to each obstacle: exact distances and overlaps of the outlines.
//!
//! Distances are parry's (GJK). The contacts of the physics engine are speculative, up to centimetres early,
//! and judge nothing here.

use super::bodies::{bounding_circle, polygon_of, to_rapier};
use corridor_decider::frame::ObstacleId;
use corridor_decider::geometry::{ConvexPolygon, Pose};
use parry2d::math::{Pose as ParryPose, Vector};
use parry2d::query::details::distance_support_map_support_map;
use parry2d::shape::ConvexPolygon as ParryPolygon;

/// Distances beyond this are not worth computing, m: nobody drives differently for them.
pub const CLEARANCE_HORIZON: f64 = 10.0;

/// Where GJK's answer is not trusted any more, m: it calls a search that did not converge 0. Nearer than this
/// the separating-axis test decides.
const DOUBT: f64 = 1e-6;

/// An outline with the circle around it, at a place.
#[derive(Clone)]
pub(super) struct Outline {
    shape: ParryPolygon,
    polygon: ConvexPolygon,
    pose: Pose,
    placed: ParryPose,
    center: Vector,
    radius: f64,
    /// Middle of the circle in the world.
    middle: Vector,
}

impl Outline {
    pub(super) fn new(polygon: &ConvexPolygon, pose: Pose) -> Self {
        let (center, radius) = bounding_circle(polygon);
        let mut outline = Self {
            shape: polygon_of(polygon),
            polygon: polygon.clone(),
            pose,
            placed: ParryPose::IDENTITY,
            center: Vector::new(center.x, center.y),
            radius,
            middle: Vector::ZERO,
        };
        outline.move_to(pose, to_rapier(pose));
        outline
    }

    /// Puts it at `pose`, given in both notations so that nobody computes a sine twice.
    pub(super) fn move_to(&mut self, pose: Pose, placed: ParryPose) {
        self.pose = pose;
        self.placed = placed;
        self.middle = placed.transform_point(self.center);
    }

    /// Where it is, in the engine's notation.
    pub(super) fn placed(&self) -> ParryPose {
        self.placed
    }

    /// Whether the distance to `other` certainly exceeds `limit`.
    pub(super) fn is_beyond(&self, other: &Self, limit: f64) -> bool {
        let reach = limit + self.radius + other.radius;
        (self.middle - other.middle).length_squared() > reach * reach
    }

    /// Distance to `other`, m; 0 in contact.
    fn distance(&self, other: &Self) -> f64 {
        let relative = self.placed.inv_mul(&other.placed);
        let distance = distance_support_map_support_map(&relative, &self.shape, &other.shape);
        if distance > DOUBT {
            return distance;
        }
        self.footprint().distance(&other.footprint())
    }

    fn footprint(&self) -> ConvexPolygon {
        self.polygon.at(self.pose)
    }
}

/// What is near the ego at one moment.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Proximity {
    /// The nearest obstacle within the horizon, and its distance.
    pub(super) nearest: Option<(f64, ObstacleId)>,
    /// Obstacles whose interiors meet the ego's, in ascending order.
    pub(super) overlaps: Vec<ObstacleId>,
}

impl Proximity {
    /// Looks around anew. Equally near obstacles: the one with the smallest identity counts.
    pub(super) fn update(&mut self, ego: &Outline, obstacles: &[Outline]) {
        // The nearest of the last step is most likely the nearest still; whatever is beyond it is skipped.
        let known = self.nearest.and_then(|(_, id)| {
            let obstacle = obstacles.get(id.0 as usize)?;
            Some((id, ego.distance(obstacle)))
        });
        let mut horizon = known.map_or(CLEARANCE_HORIZON, |(_, distance)| distance.min(CLEARANCE_HORIZON));
        self.nearest = None;
        self.overlaps.clear();
        for (id, obstacle) in (0_u32..).map(ObstacleId).zip(obstacles) {
            if ego.is_beyond(obstacle, horizon) {
                continue;
            }
            let distance = match known {
                Some((same, distance)) if same == id => distance,
                _ => ego.distance(obstacle),
            };
            if distance <= 0.0 && ego.footprint().overlaps(&obstacle.footprint()) {
                self.overlaps.push(id);
            }
            if distance <= CLEARANCE_HORIZON && self.nearest.is_none_or(|(best, _)| distance < best) {
                self.nearest = Some((distance, id));
                horizon = horizon.min(distance);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use corridor_decider::geometry::Vec2;

    /// Numbers that look random and are the same everywhere.
    struct Stir(u64);

    impl Stir {
        fn next(&mut self, low: f64, high: f64) -> f64 {
            self.0 = self
                .0
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            low + (high - low) * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
        }

        fn polygon(&mut self) -> ConvexPolygon {
            loop {
                let points: Vec<Vec2> = (0..7)
                    .map(|_| Vec2::new(self.next(-3.0, 3.0), self.next(-1.0, 1.0)))
                    .collect();
                if let Some(hull) = ConvexPolygon::hull(&points) {
                    return hull;
                }
            }
        }

        fn pose(&mut self, around: f64) -> Pose {
            Pose::new(
                4.0e5 + self.next(-around, around),
                -2.0e5 + self.next(-around, around),
                self.next(-3.1, 3.1),
            )
        }
    }

    /// The oracle looks at every pair of edges; far from the origin, where rounding would show.
    #[test]
    fn the_nearest_and_the_overlapping_are_those_of_a_search_over_all_edges() {
        let mut stir = Stir(7);
        let (mut touching, mut alone) = (0, 0);
        for _ in 0..3000 {
            let ego = Outline::new(&stir.polygon(), stir.pose(3.0));
            let others: Vec<Outline> = (0..4)
                .map(|_| Outline::new(&stir.polygon(), stir.pose(14.0)))
                .collect();
            let mut proximity = Proximity::default();
            proximity.update(&ego, &others);
            proximity.update(&ego, &others);
            let distances: Vec<f64> = others
                .iter()
                .map(|o| ego.footprint().distance(&o.footprint()))
                .collect();
            let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
            match proximity.nearest {
                Some((distance, id)) => {
                    assert!((distance - least).abs() < 1e-8, "{distance} is not {least}");
                    assert!((distances[id.0 as usize] - least).abs() < 1e-8);
                }
                None => assert!(least > CLEARANCE_HORIZON),
            }
            let meets = |o: &Outline| ego.footprint().overlaps(&o.footprint());
            let ids: Vec<ObstacleId> = (0_u32..)
                .zip(&others)
                .filter(|(_, o)| meets(o))
                .map(|(k, _)| ObstacleId(k))
                .collect();
            assert_eq!(proximity.overlaps, ids);
            touching += ids.len();
            alone += usize::from(proximity.nearest.is_none());
        }
        assert!(
            touching > 300 && alone > 30,
            "{touching} overlaps, {alone} times nobody near"
        );
    }

    #[test]
    fn a_polygon_too_thin_for_the_library_is_too_large_rather_than_absent() {
        let needle = ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), 1.0, 1.0, 0.0);
        let here = Outline::new(&needle, Pose::new(0.0, 0.0, 0.0));
        let car = ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), 2.0, 2.0, 1.0);
        let beside = Outline::new(&car, Pose::new(0.0, 3.0, 0.0));
        assert!(here.distance(&beside) <= 2.0);
    }
}
