//! What must hold of the simple planners, on a straight road and a bend.

use super::*;
use crate::frame::{ObstacleId, ObstacleKind};
use crate::geometry::{ConvexPolygon, Pose, Vec2, angle};
use crate::lattice::projection;
use crate::reference_line::{LineQuery, ReferenceLine, SlPoint, testing};

const CRUISE: f64 = 10.0;

fn road(kappa: f64) -> ReferenceLine {
    testing::line(400.0, |s| kappa * angle::sin_cos(s / 40.0).0)
}

/// A car's box at a place beside the line that drives along it.
fn car(line: &ReferenceLine, id: u32, (s, l): (f64, f64), speed: f64) -> Obstacle {
    let at = line.to_cartesian(SlPoint { s, l });
    let pose = Pose::new(at.x, at.y, line.point(s).theta);
    Obstacle {
        id: ObstacleId(id),
        kind: ObstacleKind::Car,
        pose,
        shape: ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), 2.2, 2.2, 0.9),
        velocity: pose.forward() * speed,
        is_static: speed == 0.0,
        prediction: Vec::new(),
    }
}

fn driven(baseline: Baseline, line: &ReferenceLine, v: f64, l: f64, obstacles: &[Obstacle]) -> Driven {
    let table = LineTable::sampled(line, 0.0, 400.0).unwrap();
    // Two metres of road beside the lane on either side, so that mirrored roads are mirrored.
    baseline.drive(&Scene {
        line: &table,
        initial: FrenetMotion {
            s: [30.0, v, 0.0],
            l: [l, 0.0, 0.0],
        },
        target: PlanningTarget {
            cruise_speed: CRUISE,
            stop_s: Some(390.0),
        },
        speed_limit: &|_| f64::MAX,
        road_width: &|_| Some((3.75, 3.75)),
        obstacles,
        project: &projection(line),
        vehicle: &VehicleParams::default(),
    })
}

fn way(driven: &Driven) -> f64 {
    let states = &driven.rollout.states;
    states[states.len() - 1].s - states[0].s
}

#[test]
fn the_blind_one_drives_on_whatever_is_ahead() {
    let line = road(0.0);
    let wall = [car(&line, 1, (50.0, 0.0), 0.0)];
    let free = driven(Baseline::Blind, &line, CRUISE, 0.3, &[]);
    assert_eq!(driven(Baseline::Blind, &line, CRUISE, 0.3, &wall), free);
    // The end of the road is felt from afar.
    assert!((way(&free) - 8.0 * CRUISE).abs() < 1.0);
}

#[test]
fn idm_stops_behind_what_stands_and_follows_what_drives() {
    let line = road(0.0);
    let front = VehicleParams::default().front_edge_to_center;
    let standing = [car(&line, 1, (80.0, 0.5), 0.0)];
    let stopped = driven(Baseline::Idm, &line, CRUISE, 0.0, &standing);
    let gap = 80.0 - 2.2 - front - 30.0 - way(&stopped);
    assert!((1.0..6.0).contains(&gap), "{gap}");
    assert_eq!(stopped.rollout.follows, Some(ObstacleId(1)));
    // In equilibrium it stays there.
    let v = 6.0;
    let ratio: f64 = v / CRUISE;
    let gap = (2.0 + 1.5 * v) / (1.0 - ratio * ratio * ratio * ratio).sqrt();
    let leader = [car(&line, 1, (30.0 + front + gap + 2.2, 0.0), v)];
    let following = driven(Baseline::Idm, &line, v, 0.0, &leader);
    assert!((way(&following) - 8.0 * v).abs() < 1e-6, "{}", way(&following));
}

#[test]
fn idm_does_not_heed_what_is_beside_its_path_or_behind() {
    let line = road(0.0);
    let beside = [
        car(&line, 1, (60.0, 3.5), 0.0),
        car(&line, 2, (60.0, -2.2), 0.0),
        car(&line, 3, (22.0, 0.0), 12.0),
    ];
    let free = driven(Baseline::Idm, &line, CRUISE, 0.0, &[]);
    assert!((way(&driven(Baseline::Idm, &line, CRUISE, 0.0, &beside)) - way(&free)).abs() < 1e-12);
    let protruding = [car(&line, 2, (60.0, -1.9), 0.0)];
    assert!(way(&driven(Baseline::Idm, &line, CRUISE, 0.0, &protruding)) < way(&free) - 20.0);
}

#[test]
fn pdm_closed_drives_around_what_protrudes_and_stops_behind_what_blocks() {
    let line = road(0.0);
    for side in [1.0, -1.0] {
        let parked = [car(&line, 1, (70.0, side * 1.9), 0.0)];
        let chosen = driven(Baseline::PdmClosed, &line, CRUISE, 0.0, &parked);
        assert!(
            (chosen.rollout.proposal.offset + side).abs() < 1e-12,
            "{:?}",
            chosen.rollout.proposal
        );
        assert!(way(&chosen) > 70.0 && !chosen.is_emergency);
        let ego = VehicleParams::default();
        let outline = parked[0].footprint();
        assert!(
            chosen
                .rollout
                .points
                .iter()
                .all(|p| !ego.footprint(p.pose).overlaps(&outline))
        );
    }
    let wall = [car(&line, 1, (80.0, 1.2), 0.0), car(&line, 2, (80.0, -1.2), 0.0)];
    let stopped = driven(Baseline::PdmClosed, &line, CRUISE, 0.0, &wall);
    assert!(way(&stopped) < 44.0 && !stopped.is_emergency);
}

#[test]
fn pdm_closed_brakes_as_hard_as_it_can_where_nothing_else_is_left() {
    let line = road(0.0);
    let wall = [car(&line, 1, (43.0, 0.0), 0.0)];
    let braking = driven(Baseline::PdmClosed, &line, CRUISE, 0.0, &wall);
    assert!(braking.is_emergency);
    assert!((braking.rollout.states[0].a - VehicleParams::default().max_deceleration).abs() < 1e-12);
}

fn scene(line: &ReferenceLine, side: f64) -> Vec<Obstacle> {
    vec![
        car(line, 4, (75.0, side * 1.9), 0.0),
        car(line, 9, (150.0, side * -1.6), 0.0),
        car(line, 2, (110.0, side * 0.3), 7.0),
        car(line, 7, (50.0, side * 3.6), 12.0),
    ]
}

#[test]
fn a_mirrored_scene_gives_the_mirrored_drive() {
    let (left, right) = (road(0.01), road(-0.01));
    for baseline in [Baseline::Blind, Baseline::Idm, Baseline::PdmClosed] {
        let one = driven(baseline, &left, 8.0, 0.3, &scene(&left, 1.0));
        let other = driven(baseline, &right, 8.0, -0.3, &scene(&right, -1.0));
        assert_eq!(one.rollout.points.len(), other.rollout.points.len());
        for (a, b) in one.rollout.points.iter().zip(&other.rollout.points) {
            let apart = Vec2::new(a.pose.x - b.pose.x, a.pose.y + b.pose.y).norm();
            assert!(
                apart < 1e-6 && (a.kappa + b.kappa).abs() < 1e-6,
                "{baseline:?} {a:?} {b:?}"
            );
            assert!((a.v - b.v).abs() < 1e-6, "{baseline:?} {a:?} {b:?}");
        }
    }
}

#[test]
fn the_order_of_obstacles_does_not_matter() {
    let line = road(0.01);
    for baseline in [Baseline::Idm, Baseline::PdmClosed] {
        let mut obstacles = scene(&line, 1.0);
        let one = driven(baseline, &line, 8.0, 0.3, &obstacles);
        for _ in 0..obstacles.len() {
            obstacles.rotate_left(1);
            assert_eq!(driven(baseline, &line, 8.0, 0.3, &obstacles), one);
        }
    }
}

/// The car stands in the end, and nothing is worth anything but standing.
#[test]
fn all_stop_at_the_stop_point() {
    let line = road(0.0);
    let table = LineTable::sampled(&line, 0.0, 400.0).unwrap();
    for baseline in [Baseline::Blind, Baseline::Idm, Baseline::PdmClosed] {
        let driven = baseline.drive(&Scene {
            line: &table,
            initial: FrenetMotion {
                s: [30.0, 8.0, 0.0],
                l: [0.0; 3],
            },
            target: PlanningTarget {
                cruise_speed: CRUISE,
                stop_s: Some(60.0),
            },
            speed_limit: &|_| f64::MAX,
            road_width: &|_| None,
            obstacles: &[],
            project: &projection(&line),
            vehicle: &VehicleParams::default(),
        });
        let last = driven.rollout.states[STEPS];
        assert!(
            last.s <= 60.0 && last.s > 57.0 && last.v < 1.0,
            "{baseline:?} {last:?}"
        );
    }
}
