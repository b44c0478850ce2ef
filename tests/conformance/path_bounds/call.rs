//! From a case to a call of the decider, all defects of the original switched on.

use super::case::{Input, Obstacle, ObstacleDecision, Status, Vehicle};
use corridor_decider::frame::ObstacleId;
use corridor_decider::geometry::{Vec2, angle};
use corridor_decider::reference_line::{LineQuery, SlPoint};
use corridor_decider::tasks::path_bounds as bounds;
use corridor_decider::vehicle::VehicleParams;

pub(super) fn config(input: &Input) -> Result<bounds::PathBoundsConfig, String> {
    let mut all = input.config.clone();
    all.extend(input.flags.clone());
    let mut config: bounds::PathBoundsConfig =
        serde_json::from_value(all.into()).map_err(|error| format!("configuration: {error}"))?;
    config.quirks = bounds::Quirks::apollo();
    Ok(config)
}

pub(super) fn vehicle(given: &Vehicle) -> VehicleParams {
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
pub(super) fn obstacles(given: &[Obstacle]) -> (Vec<bounds::ObstacleSl>, Vec<String>) {
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

pub(super) fn memory(status: &Status) -> bounds::Memory {
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

pub(super) fn borrow(input: &Input) -> Vec<bounds::Borrow> {
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
pub(super) fn ego(
    input: &Input,
    config: &bounds::PathBoundsConfig,
    vehicle: &VehicleParams,
) -> bounds::EgoFrenet {
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
