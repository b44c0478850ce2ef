//! Contacts against a search of every step of the path, and the worked numbers of the specification.

use super::*;
use crate::decision::PathPoint;
use crate::frame::{Obstacle, ObstacleId, ObstacleKind, PredictedPose};
use crate::geometry::{ConvexPolygon, Pose, Vec2, angle};
use crate::vehicle::VehicleParams;
use proptest::prelude::*;

/// A path of constant curvature from the origin, a point a metre.
fn path(length: u32, kappa: f64) -> Vec<PathPoint> {
    let point = |k: u32| {
        let distance = f64::from(k);
        let theta = kappa * distance;
        let (sin, cos) = angle::sin_cos(theta);
        let pose = if kappa.abs() < 1e-9 {
            Pose::new(distance, 0.0, 0.0)
        } else {
            Pose::new(sin / kappa, (1.0 - cos) / kappa, theta)
        };
        PathPoint {
            distance,
            s: distance,
            l: 0.0,
            pose,
            kappa,
        }
    };
    (0..=length).map(point).collect()
}

fn track(path: &[PathPoint]) -> Track {
    Track::new(&VehicleParams::default(), path, 0.4, 7.0).unwrap()
}

fn obstacle(pose: Pose, half: (f64, f64), prediction: Vec<PredictedPose>) -> Obstacle {
    Obstacle {
        id: ObstacleId(1),
        kind: ObstacleKind::Car,
        pose,
        shape: ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), half.0, half.0, half.1),
        velocity: Vec2::zeros(),
        is_static: prediction.is_empty(),
        prediction,
    }
}

/// Moves straight ahead at `v` for 8 s.
fn driving(from: Pose, v: f64) -> Obstacle {
    let pose = |k: i32| PredictedPose {
        t: f64::from(k) * 0.1,
        pose: from.advanced(f64::from(k) * 0.1 * v),
    };
    obstacle(from, (2.4, 1.0), (0..=80).map(pose).collect())
}

fn near(got: f64, wanted: f64) -> bool {
    (got - wanted).abs() < 0.11
}

#[test]
fn a_leader_is_met_with_the_front_bumper() {
    let path = path(120, 0.0);
    let boundary = track(&path)
        .occupied(&driving(Pose::new(30.0, 0.5, 0.0), 8.0))
        .unwrap();
    assert_eq!(boundary.pairs().len(), 2, "{boundary:?}");
    let (first, last) = (boundary.first(), boundary.last());
    assert!(
        near(first.lower, 30.0 - 2.4 - 3.89) && near(first.upper, 30.0 + 2.4 + 1.043),
        "{first:?}"
    );
    assert!(
        near(last.lower, first.lower + 64.0) && near(last.t, 8.0),
        "{last:?}"
    );
}

#[test]
fn who_stands_in_the_way_is_kept_clear_of_by_a_car_s_overhang() {
    let path = path(60, 0.0);
    let boundary = track(&path)
        .occupied(&obstacle(Pose::new(40.0, 0.0, 0.0), (2.4, 1.0), vec![]))
        .unwrap();
    let (first, last) = (boundary.first(), boundary.last());
    assert!(near(first.lower, 40.0 - 2.4 - 2.0 * 3.89) && near(first.upper, 40.0 + 2.4 + 1.043));
    assert!(near(first.lower, last.lower) && near(last.t, 7.0));
    let aside = obstacle(Pose::new(40.0, 2.5, 0.0), (2.4, 1.0), vec![]);
    assert!(track(&path).occupied(&aside).is_none(), "0.445 m beside the body");
    let nearer = obstacle(Pose::new(40.0, 2.4, 0.0), (2.4, 1.0), vec![]);
    assert!(track(&path).occupied(&nearer).is_some(), "0.345 m beside it");
}

#[test]
fn who_crosses_is_on_the_path_for_a_while() {
    let path = path(100, 0.0);
    let boundary = track(&path)
        .occupied(&driving(Pose::new(50.0, -20.0, std::f64::consts::FRAC_PI_2), 5.0))
        .unwrap();
    assert!(
        near(boundary.min_t(), (20.0 - 2.4 - 1.455) / 5.0),
        "{}",
        boundary.min_t()
    );
    assert!(
        near(boundary.max_t(), (20.0 + 2.4 + 1.455) / 5.0),
        "{}",
        boundary.max_t()
    );
    assert!(near(boundary.min_s(), 50.0 - 1.0 - 3.89) && near(boundary.max_s(), 50.0 + 1.0 + 1.043));
}

/// All of the path in steps of 2 cm: the stretches in which the outlines overlap. On a bend a body may be left and met
/// again.
fn by_brute_force(path: &[PathPoint], track: &Track, body: &ConvexPolygon) -> Vec<(f64, f64)> {
    let vehicle = VehicleParams::default();
    let touches = |k: u32| {
        let place = track.place_at(f64::from(k) * 0.02);
        let theta = libm::atan2(place.forward.y, place.forward.x);
        let pose = Pose::new(place.position.x, place.position.y, theta);
        let car = ConvexPolygon::rectangle(
            pose,
            vehicle.front_edge_to_center,
            vehicle.back_edge_to_center,
            vehicle.half_width() + 0.4,
        );
        car.overlaps(body)
    };
    let steps = 50 * u32::try_from(path.len() - 1).unwrap();
    let touching: Vec<u32> = (0..=steps).filter(|k| touches(*k)).collect();
    let at = |k: u32| f64::from(k) * 0.02;
    touching
        .chunk_by(|a, b| b - a == 1)
        .map(|stretch| (at(stretch[0]), at(stretch[stretch.len() - 1])))
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// The contact holds all of the true one, and little more; only grazing contacts may be missed.
    #[test]
    fn contacts_are_those_of_a_search(
        kappa in -0.06..0.06, at in 2.0..50.0, beside in -4.0..4.0, theta in -3.1..3.1,
        half in (0.3..4.0, 0.2..1.3),
    ) {
        let path = path(50, kappa);
        let track = track(&path);
        let place = track.place_at(at);
        let left = Vec2::new(-place.forward.y, place.forward.x);
        let center: Vec2 = place.position + left * beside;
        let body = obstacle(Pose::new(center.x, center.y, theta), half, vec![]);
        let outline = body.footprint();
        let radius = Vec2::new(half.0, half.1).norm();
        let got = track.first_contact(outline.vertices(), center, radius);
        let stretches = by_brute_force(&path, &track, &outline);
        let grazes = |stretch: &(f64, f64)| stretch.1 - stretch.0 < 4.0;
        match got {
            Some(got) if !stretches.is_empty() => {
                // Half of what an end is found to is what a corner that just grazes may hide.
                let begins = |stretch: &(f64, f64)| got.low <= stretch.0 + 0.05 && got.low >= stretch.0 - 0.15;
                let ends = |stretch: &(f64, f64)| got.high >= stretch.1 - 0.05 && got.high <= stretch.1 + 0.5;
                let first = stretches.iter().position(begins);
                prop_assert!(first.is_some(), "begins at {} not as {stretches:?}", got.low);
                let first = first.unwrap();
                prop_assert!(stretches[..first].iter().all(grazes), "missed one of {stretches:?}");
                prop_assert!(stretches[first..].iter().any(ends), "ends at {} not as {stretches:?}", got.high);
            }
            None => prop_assert!(stretches.iter().all(grazes), "missed one of {stretches:?}"),
            Some(got) => prop_assert!(got.high - got.low < 0.5, "{got:?} where there is none"),
        }
    }

    /// Skipping times at which nothing can touch loses none.
    #[test]
    fn skipping_loses_nothing(
        x in -20.0..120.0, y in -40.0..40.0, theta in -3.1..3.1, v in 0.0..25.0, kappa in -0.02..0.02,
    ) {
        let path = path(100, kappa);
        let track = track(&path);
        let car = driving(Pose::new(x, y, theta), v);
        let times = car.prediction.iter().filter(|predicted| {
            let outline = car.shape.at(predicted.pose);
            track.first_contact(outline.vertices(), predicted.pose.position(), 2.6).is_some()
        });
        let times: Vec<f64> = times.map(|predicted| predicted.t).collect();
        let boundary = track.occupied(&car);
        prop_assert_eq!(boundary.is_some(), times.len() > 1);
        if let Some(boundary) = boundary {
            prop_assert!((boundary.min_t() - times[0]).abs() < 1e-12);
            prop_assert!((boundary.max_t() - times[times.len() - 1]).abs() < 1e-12);
        }
    }

    /// The mirrored world has the same boundary.
    #[test]
    fn left_and_right_are_alike(x in 0.0..100.0, y in -10.0..10.0, theta in -3.1..3.1, v in 0.0..15.0, kappa in -0.02..0.02) {
        let (one, other) = (path(100, kappa), path(100, -kappa));
        let (a, b) = (driving(Pose::new(x, y, theta), v), driving(Pose::new(x, -y, -theta), v));
        match (track(&one).occupied(&a), track(&other).occupied(&b)) {
            (Some(a), Some(b)) => {
                prop_assert!((a.area() - b.area()).abs() < 1.0 && (a.min_s() - b.min_s()).abs() < 0.3);
            }
            (None, None) => {}
            (a, b) => {
                let only = a.or(b);
                prop_assert!(only.is_none_or(|strip| strip.max_t() - strip.min_t() < 0.15));
            }
        }
    }
}
