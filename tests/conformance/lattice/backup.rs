//! Backup trajectories: which of them touch something, and in which order they are tried.

use super::scene::{self, Body, Start};
use super::{LatticeCase, graph, near, same};
use corridor_decider::frame::Obstacle;
use corridor_decider::lattice::{
    BACKUP_DECELERATIONS, CollisionEnvironment, ConstantDeceleration, Curve, Footprint, LineTable,
    LongitudinalTrack, Near, Sampled, backup_order, combine, lateral_bundle,
};
use corridor_decider::vehicle::VehicleParams;
use serde::Deserialize;
use serde_json::{Value, json};

const TOLERANCE: f64 = 1e-7;

/// Half the width of a lane that is not known, m.
const HALF_WIDTH: f64 = 2.0;

/// No lateral curve leads farther from the line, m.
const FARTHEST: f64 = 30.0;

#[derive(Deserialize)]
struct Input {
    reference_line: Vec<[f64; 6]>,
    lane_width: Option<(f64, f64)>,
    obstacles: Vec<Body>,
}

/// The world of a case. The original ignores what is behind the car in its lane, and what is not in the graph.
fn environment(input: &Input, line: &LineTable, start: &Start) -> CollisionEnvironment {
    let (s, l) = (start.init_s[0], start.init_d[0]);
    let graph = graph::of(&input.obstacles, line, s, input.lane_width);
    let (left, right) = input.lane_width.unwrap_or((HALF_WIDTH, HALF_WIDTH));
    let in_lane = -right < l && l < left;
    let ignored = |obstacle: &Obstacle| {
        let now = obstacle
            .prediction
            .first()
            .map_or(obstacle.pose, |first| first.pose);
        let at = line.frenet(now.position());
        let is_behind = at.s < s && at.l.abs() < HALF_WIDTH;
        in_lane && (is_behind || !graph.contains(obstacle.id))
    };
    let obstacles: Vec<_> = input
        .obstacles
        .iter()
        .enumerate()
        .map(|(k, body)| body.obstacle(k))
        .collect();
    // The original's frames begin when the frame does, not when the plan does.
    CollisionEnvironment::new(&obstacles, 0.0, ignored)
}

pub(super) fn backup(case: &LatticeCase) -> Result<(), String> {
    let (input, start): (Input, Start) = (case.input()?, case.input()?);
    let line = scene::line(&input.reference_line, scene::full)?;
    let environment = environment(&input, &line, &start);
    let laterals: Vec<Curve> = lateral_bundle(&start.motion())
        .into_iter()
        .map(Curve::from)
        .collect();
    let (s, v) = (start.init_s[0], start.init_s[1]);
    let ego = Footprint::of(&VehicleParams::default());
    let wanted = case.expected["pairs"].as_array().ok_or("expected: no pairs")?;
    same(
        "number of pairs",
        &wanted.len(),
        &(BACKUP_DECELERATIONS.len() * laterals.len()),
    )?;
    let (mut points, mut close) = (Vec::new(), Near::default());
    for (k, wanted) in wanted.iter().enumerate() {
        let (deceleration, lateral) = (
            BACKUP_DECELERATIONS[k / laterals.len()],
            &laterals[k % laterals.len()],
        );
        let lateral = laterals
            .iter()
            .find(|curve| is_named(wanted, curve))
            .unwrap_or(lateral);
        near("deceleration", &wanted["deceleration"], deceleration, TOLERANCE)?;
        let braking = ConstantDeceleration::new(s, v, deceleration).ok_or("no braking")?;
        let track = LongitudinalTrack::new(&Sampled::new(&braking.into()), &line);
        environment.find_near(&track, FARTHEST, &ego, &mut close);
        combine(&track, lateral, &mut points);
        let collides = environment.touched(&close, &points, &ego).is_some();
        same(
            &format!("collision of pair {k}"),
            &wanted["in_collision"],
            &json!(collides),
        )?;
        near("end_speed", &wanted["end_speed"], braking.at(8.0)[1], TOLERANCE)?;
    }
    order(case, s, v, &laterals)
}

fn is_named(wanted: &Value, curve: &Curve) -> bool {
    let agrees = |key: &str, got: f64| near(key, &wanted[key], got, TOLERANCE).is_ok();
    agrees("lat_end", curve.end()) && agrees("lat_length", curve.length())
}

/// The groups of equal end speed, fastest first, and the first of them in which something is free.
fn order(case: &LatticeCase, s: f64, v: f64, laterals: &[Curve]) -> Result<(), String> {
    let pairs = backup_order(s, v, laterals);
    let groups = case.expected["priority_groups"]
        .as_array()
        .ok_or("expected: no groups")?;
    let mut tried = pairs.iter();
    for group in groups {
        let decelerations = group["decelerations"].as_array().map_or(0, Vec::len);
        for pair in tried.by_ref().take(decelerations * laterals.len()) {
            near(
                "end speed of the group",
                &group["end_speed"],
                pair.end_speed,
                TOLERANCE,
            )?;
        }
    }
    same("pairs beyond the groups", &0, &tried.count())
}
