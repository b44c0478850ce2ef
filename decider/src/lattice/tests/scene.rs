//! Scenes along a bend, and their mirror images.

use crate::frame::{Obstacle, ObstacleId, ObstacleKind, PredictedPose};
use crate::geometry::frenet::FrenetMotion;
use crate::geometry::{ConvexPolygon, Pose, Vec2, angle};
use crate::lattice::*;
use crate::reference_line::{LineQuery, ReferenceLine, SlPoint, testing};
use crate::vehicle::VehicleParams;

/// A bend whose curvature comes and goes, to the left for a positive sign.
pub(super) fn bend(sign: f64) -> ReferenceLine {
    testing::line(400.0, |s| sign * 0.01 * angle::sin_cos(s / 40.0).0)
}

/// A box along the line; it moves along it at `speed`, or stands.
pub(super) fn body(line: &ReferenceLine, id: u32, (s, l): (f64, f64), speed: f64) -> Obstacle {
    let pose = |s: f64| {
        let at = line.to_cartesian(SlPoint { s, l });
        Pose::new(at.x, at.y, line.point(s).theta)
    };
    let predicted = |k: u32| {
        let t = f64::from(k) * 0.5;
        PredictedPose {
            t,
            pose: pose(s + speed * t),
        }
    };
    Obstacle {
        id: ObstacleId(id),
        kind: ObstacleKind::Car,
        pose: pose(s),
        shape: ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), 2.2, 2.2, 0.9),
        velocity: Vec2::zeros(),
        is_static: speed == 0.0,
        prediction: if speed == 0.0 {
            Vec::new()
        } else {
            (0..17).map(predicted).collect()
        },
    }
}

/// Plans along a line from station 30.
pub(super) fn planned(
    line: &ReferenceLine,
    l: [f64; 3],
    v: f64,
    obstacles: &[Obstacle],
    stop_s: f64,
) -> Planned {
    let initial = FrenetMotion { s: [30.0, v, 0.0], l };
    with_lattice(line, initial, obstacles, stop_s, |lattice| {
        lattice.plan().unwrap()
    })
}

pub(super) fn with_lattice<T>(
    line: &ReferenceLine,
    initial: FrenetMotion,
    obstacles: &[Obstacle],
    stop_s: f64,
    then: impl FnOnce(&Lattice) -> T,
) -> T {
    let table = LineTable::sampled(line, 0.0, 400.0).unwrap();
    let (vehicle, config) = (VehicleParams::default(), LatticeConfig::default());
    let lane_width = |s| line.lane_width(s);
    let project = projection(line);
    then(&Lattice::new(LineTask {
        line: &table,
        initial,
        obstacles,
        target: PlanningTarget {
            cruise_speed: 10.0,
            stop_s: Some(stop_s),
        },
        vehicle: &vehicle,
        config: &config,
        lane_width: &lane_width,
        project: &project,
    }))
}
