//! Cases of the path-bounds decider: from their JSON to a call, and from its answer to a verdict.

use crate::stub_world::StubWorld;
use corridor_decider::frame::ObstacleId;
use corridor_decider::geometry::{Vec2, angle};
use corridor_decider::reference_line::{LineQuery, SlPoint};
use corridor_decider::tasks::path_bounds as bounds;
use corridor_decider::vehicle::VehicleParams;
use serde::Deserialize;

/// Largest difference of a bound, m.
const BOUND_TOLERANCE: f64 = 1e-9;

/// Largest difference of a place to pull over, m and rad.
const PLACE_TOLERANCE: f64 = 1e-7;

/// One case of its file.
#[derive(Deserialize)]
pub(crate) struct PathBoundsCase {
    pub(crate) name: String,
    input: Input,
    expected: Expected,
}

#[derive(Deserialize)]
struct Input {
    #[serde(flatten)]
    world: StubWorld,
    obstacles: Vec<Obstacle>,
    ego: Ego,
    adc_sl_boundary: SlBox,
    vehicle: Vehicle,
    config: serde_json::Map<String, serde_json::Value>,
    flags: serde_json::Map<String, serde_json::Value>,
    reference_line_info: LineInfo,
    status: Status,
    routing_end: Place,
}

#[derive(Deserialize)]
struct Obstacle {
    id: String,
    start_s: f64,
    end_s: f64,
    start_l: f64,
    end_l: f64,
    is_static: bool,
    is_virtual: bool,
    speed: f64,
    lon_decision: ObstacleDecision,
    lat_decision: ObstacleDecision,
}

#[derive(Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
enum ObstacleDecision {
    None,
    Ignore,
    Other,
}

#[derive(Deserialize)]
struct Ego {
    s: f64,
    s_dot: f64,
    l: f64,
    l_prime: f64,
}

#[derive(Deserialize)]
struct SlBox {
    end_s: f64,
}

#[derive(Deserialize)]
struct Vehicle {
    length: f64,
    width: f64,
    front_edge_to_center: f64,
    back_edge_to_center: f64,
    min_turn_radius: f64,
    wheel_base: f64,
}

#[derive(Deserialize)]
struct LineInfo {
    path_reusable: bool,
    is_change_lane_path: bool,
    is_path_lane_borrow: bool,
    cruise_speed: f64,
}

#[derive(Deserialize)]
struct Place {
    x: f64,
    y: f64,
}

#[derive(Deserialize)]
struct Status {
    pull_over: PullOver,
    change_lane: ChangeLane,
    #[serde(default)]
    path_decider: PathDecider,
}

#[derive(Deserialize, Default)]
struct PathDecider {
    decided_side_pass_direction: Vec<String>,
}

#[derive(Deserialize)]
struct PullOver {
    plan_pull_over_path: bool,
    #[serde(rename = "pull_over_type")]
    kind: String,
    position: Option<Place>,
    theta: f64,
    length_front: f64,
    length_back: f64,
    width_left: f64,
    width_right: f64,
}

#[derive(Deserialize)]
struct ChangeLane {
    #[serde(rename = "is_clear_to_change_lane")]
    is_clear: bool,
    exist_lane_change_start_position: bool,
    lane_change_start_position: Option<Place>,
}

#[derive(Deserialize)]
struct Expected {
    result: String,
    candidate_path_boundaries: Vec<Boundary>,
    pull_over: Option<PullOver>,
    change_lane: Option<ChangeLane>,
}

#[derive(Deserialize)]
struct Boundary {
    label: String,
    start_s: f64,
    delta_s: f64,
    blocking_obstacle_id: String,
    #[serde(rename = "boundary")]
    points: Vec<(f64, f64)>,
    blocking_candidates: Vec<String>,
}

/// Runs a case with the original's defects and compares everything that it names.
pub(crate) fn check(case: &PathBoundsCase) -> Result<(), String> {
    let input = &case.input;
    let config = config(input)?;
    let vehicle = vehicle(&input.vehicle);
    let (obstacles, names) = obstacles(&input.obstacles);
    let mut memory = memory(&input.status);
    let borrow = borrow(input);
    let call = bounds::Input {
        ego: ego(input, &config, &vehicle),
        ego_end_s: input.adc_sl_boundary.end_s,
        obstacles: &obstacles,
        config: &config,
        vehicle: &vehicle,
        cruise_speed: input.reference_line_info.cruise_speed,
        is_change_lane: input.reference_line_info.is_change_lane_path,
        path_reusable: input.reference_line_info.path_reusable,
        borrow: &borrow,
        destination: Some(Vec2::new(input.routing_end.x, input.routing_end.y)),
    };
    let answer = bounds::decide(&input.world, &call, &mut memory);
    compare(case, answer, &memory, &names)
}

fn config(input: &Input) -> Result<bounds::PathBoundsConfig, String> {
    let mut all = input.config.clone();
    all.extend(input.flags.clone());
    let mut config: bounds::PathBoundsConfig =
        serde_json::from_value(all.into()).map_err(|error| format!("configuration: {error}"))?;
    config.quirks = bounds::Quirks::apollo();
    Ok(config)
}

fn vehicle(given: &Vehicle) -> VehicleParams {
    VehicleParams {
        length: given.length,
        width: given.width,
        front_edge_to_center: given.front_edge_to_center,
        back_edge_to_center: given.back_edge_to_center,
        min_turn_radius: given.min_turn_radius,
        wheel_base: given.wheel_base,
        ..VehicleParams::default()
    }
}

/// The obstacles in list order; a repeated name overwrites the earlier one in its place.
fn obstacles(given: &[Obstacle]) -> (Vec<bounds::ObstacleSl>, Vec<String>) {
    let mut names: Vec<String> = Vec::new();
    let mut list: Vec<bounds::ObstacleSl> = Vec::new();
    for obstacle in given {
        let place = names
            .iter()
            .position(|name| *name == obstacle.id)
            .unwrap_or(names.len());
        let ignored = |decision: &ObstacleDecision| *decision == ObstacleDecision::Ignore;
        let converted = bounds::ObstacleSl {
            id: if obstacle.id.is_empty() {
                ObstacleId::ANONYMOUS
            } else {
                id(place)
            },
            start_s: obstacle.start_s,
            end_s: obstacle.end_s,
            start_l: obstacle.start_l,
            end_l: obstacle.end_l,
            speed: obstacle.speed,
            is_static: obstacle.is_static,
            is_virtual: obstacle.is_virtual,
            is_ignored: ignored(&obstacle.lon_decision) && ignored(&obstacle.lat_decision),
        };
        if place == names.len() {
            names.push(obstacle.id.clone());
            list.push(converted);
        } else {
            list[place] = converted;
        }
    }
    (list, names)
}

fn id(place: usize) -> ObstacleId {
    ObstacleId(u32::try_from(place).expect("a case has few obstacles"))
}

fn memory(status: &Status) -> bounds::Memory {
    let given = &status.pull_over;
    let place = given.position.as_ref().map(|position| bounds::PullOverPlace {
        position: Vec2::new(position.x, position.y),
        theta: given.theta,
        length_front: given.length_front,
        length_back: given.length_back,
        width_left: given.width_left,
        width_right: given.width_right,
    });
    let kind = match given.kind.as_str() {
        "EMERGENCY_PULL_OVER" => bounds::PullOverKind::Emergency,
        _ => bounds::PullOverKind::Destination,
    };
    let change = &status.change_lane;
    let start = change
        .lane_change_start_position
        .as_ref()
        .filter(|_| change.exist_lane_change_start_position);
    bounds::Memory {
        change_lane: bounds::ChangeLane {
            is_clear: change.is_clear,
            start: start.map(|start| Vec2::new(start.x, start.y)),
        },
        pull_over: bounds::PullOver {
            is_requested: given.plan_pull_over_path,
            kind,
            place,
        },
        passed: Vec::new(),
    }
}

fn borrow(input: &Input) -> Vec<bounds::Borrow> {
    if !input.reference_line_info.is_path_lane_borrow {
        return Vec::new();
    }
    let directions = &input.status.path_decider.decided_side_pass_direction;
    let side = |name: &String| {
        if name == "LEFT_BORROW" {
            bounds::Borrow::Left
        } else {
            bounds::Borrow::Right
        }
    };
    directions.iter().map(side).collect()
}

/// The ego's Frenet state; with the front-axle flag that of the point one wheel base ahead.
fn ego(input: &Input, config: &bounds::PathBoundsConfig, vehicle: &VehicleParams) -> bounds::EgoFrenet {
    let given = &input.ego;
    let plain = bounds::EgoFrenet {
        s: given.s,
        s_dot: given.s_dot,
        l: given.l,
        l_dot: given.l_prime * given.s_dot,
    };
    if !config.use_front_axe_center_in_path_planning {
        return plain;
    }
    let line = input.world.point(given.s);
    let stretch = 1.0 - line.kappa * given.l;
    let theta = line.theta + given.l_prime.atan2(stretch);
    let v = given.s_dot * stretch / angle::sin_cos(theta - line.theta).1;
    let rear = input.world.to_cartesian(SlPoint {
        s: given.s,
        l: given.l,
    });
    let pose = corridor_decider::geometry::Pose::new(rear.x, rear.y, theta);
    bounds::EgoFrenet::at(&input.world, pose.advanced(vehicle.wheel_base), v)
}

fn compare(
    case: &PathBoundsCase,
    answer: Result<bounds::PathBounds, bounds::PathBoundsError>,
    memory: &bounds::Memory,
    names: &[String],
) -> Result<(), String> {
    use bounds::PathBoundsError as E;
    let expected = &case.expected;
    let result = match &answer {
        Ok(_) => "ok",
        Err(E::EgoOutside(_)) => "check_failed",
        Err(_) => "error",
    };
    // Undefined behaviour of the original has a defined answer here, but none to compare with.
    if expected.result == "undefined_behavior" {
        return answer
            .map(|_| ())
            .map_err(|error| format!("undefined in the original, here {error}"));
    }
    if result != expected.result {
        return Err(format!(
            "result: expected {}, got {result} ({:?})",
            expected.result,
            answer.err()
        ));
    }
    if let Ok(answer) = &answer {
        compare_bounds(&expected.candidate_path_boundaries, &answer.bounds, names)?;
    }
    compare_memory(&case.input.world, expected, memory)
}

fn compare_bounds(expected: &[Boundary], got: &[bounds::PathBound], names: &[String]) -> Result<(), String> {
    let wanted: Vec<&str> = expected.iter().map(|b| b.label.as_str()).collect();
    let labels: Vec<String> = got.iter().map(|b| b.label.to_string()).collect();
    if wanted != labels {
        return Err(format!("labels: expected {wanted:?}, got {labels:?}"));
    }
    expected
        .iter()
        .zip(got)
        .try_for_each(|(expected, got)| compare_bound(expected, got, names))
}

fn compare_bound(expected: &Boundary, got: &bounds::PathBound, names: &[String]) -> Result<(), String> {
    let label = &expected.label;
    if expected.points.len() != got.points.len() {
        let (wanted, have) = (expected.points.len(), got.points.len());
        return Err(format!("{label}: expected {wanted} points, got {have}"));
    }
    let off_start = (expected.start_s - got.start_s()).abs();
    if off_start > BOUND_TOLERANCE || (expected.delta_s - got.delta_s).abs() > 0.0 {
        return Err(format!(
            "{label}: starts at {} instead of {}",
            got.start_s(),
            expected.start_s
        ));
    }
    for (i, ((l_min, l_max), point)) in expected.points.iter().zip(&got.points).enumerate() {
        // Written so that a bound that is no number is off.
        let is_right = |have: f64, wanted: f64| (have - wanted).abs() <= BOUND_TOLERANCE;
        if !is_right(point.l_min, *l_min) || !is_right(point.l_max, *l_max) {
            let have = (point.l_min, point.l_max);
            return Err(format!(
                "{label}: point {i} is {have:?}, expected {:?}",
                (l_min, l_max)
            ));
        }
    }
    compare_blocker(expected, got, names)
}

/// Any member of the blocking candidates is right: the original takes the first of an unordered set.
fn compare_blocker(expected: &Boundary, got: &bounds::PathBound, names: &[String]) -> Result<(), String> {
    let got_name = got.blocked_by.map_or("", |id| names[id.0 as usize].as_str());
    let wanted = &expected.blocking_obstacle_id;
    let right = match wanted.as_str() {
        "" => got_name.is_empty(),
        _ => expected.blocking_candidates.iter().any(|name| name == got_name),
    };
    if right {
        Ok(())
    } else {
        Err(format!(
            "{}: blocked by `{got_name}`, expected `{wanted}`",
            expected.label
        ))
    }
}

fn compare_memory(world: &StubWorld, expected: &Expected, memory: &bounds::Memory) -> Result<(), String> {
    if let Some(wanted) = &expected.pull_over {
        if wanted.plan_pull_over_path != memory.pull_over.is_requested {
            return Err("pull-over request differs".to_owned());
        }
        compare_place(
            "pull-over position",
            world,
            wanted.position.as_ref(),
            place(memory),
        )?;
        if let Some(have) = memory.pull_over.place {
            let off = angle::difference(have.theta, wanted.theta).abs();
            let room = [
                (have.length_front, wanted.length_front),
                (have.length_back, wanted.length_back),
                (have.width_left, wanted.width_left),
                (have.width_right, wanted.width_right),
            ];
            let fits = room.iter().all(|(a, b)| (a - b).abs() <= PLACE_TOLERANCE);
            if off.is_nan() || off > PLACE_TOLERANCE || !fits {
                return Err(format!(
                    "pull-over place is {have:?}, expected heading {}",
                    wanted.theta
                ));
            }
        }
    }
    if let Some(wanted) = &expected.change_lane {
        let start = wanted
            .lane_change_start_position
            .as_ref()
            .filter(|_| wanted.exist_lane_change_start_position);
        compare_place("lane-change start", world, start, memory.change_lane.start)?;
    }
    Ok(())
}

fn place(memory: &bounds::Memory) -> Option<Vec2> {
    memory.pull_over.place.map(|place| place.position)
}

fn compare_place(
    what: &str,
    world: &StubWorld,
    wanted: Option<&Place>,
    have: Option<Vec2>,
) -> Result<(), String> {
    let wanted = wanted.map(|place| Vec2::new(place.x, place.y));
    match (wanted, have) {
        (None, None) => Ok(()),
        (Some(wanted), Some(have)) if (wanted - have).norm() <= PLACE_TOLERANCE => Ok(()),
        _ => {
            let sl = |place: Option<Vec2>| place.map(|place| world.to_frenet(place));
            Err(format!("{what}: expected {:?}, got {:?}", sl(wanted), sl(have)))
        }
    }
}
