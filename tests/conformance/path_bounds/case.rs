//! A case as its file writes it.

use crate::stub_world::StubWorld;
use serde::Deserialize;

/// One case of its file.
#[derive(Deserialize)]
pub(crate) struct PathBoundsCase {
    pub(crate) name: String,
    pub(super) input: Input,
    pub(super) expected: Expected,
}

#[derive(Deserialize)]
pub(super) struct Input {
    #[serde(flatten)]
    pub(super) world: StubWorld,
    pub(super) obstacles: Vec<Obstacle>,
    pub(super) ego: Ego,
    pub(super) adc_sl_boundary: SlBox,
    pub(super) vehicle: Vehicle,
    pub(super) config: serde_json::Map<String, serde_json::Value>,
    pub(super) flags: serde_json::Map<String, serde_json::Value>,
    pub(super) reference_line_info: LineInfo,
    pub(super) status: Status,
    pub(super) routing_end: Place,
}

#[derive(Deserialize)]
pub(super) struct Obstacle {
    pub(super) id: String,
    pub(super) start_s: f64,
    pub(super) end_s: f64,
    pub(super) start_l: f64,
    pub(super) end_l: f64,
    pub(super) is_static: bool,
    pub(super) is_virtual: bool,
    pub(super) speed: f64,
    pub(super) lon_decision: ObstacleDecision,
    pub(super) lat_decision: ObstacleDecision,
}

#[derive(Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
pub(super) enum ObstacleDecision {
    None,
    Ignore,
    Other,
}

#[derive(Deserialize)]
pub(super) struct Ego {
    pub(super) s: f64,
    pub(super) s_dot: f64,
    pub(super) l: f64,
    pub(super) l_prime: f64,
}

#[derive(Deserialize)]
pub(super) struct SlBox {
    pub(super) end_s: f64,
}

#[derive(Deserialize)]
pub(super) struct Vehicle {
    pub(super) length: f64,
    pub(super) width: f64,
    pub(super) front_edge_to_center: f64,
    pub(super) back_edge_to_center: f64,
    pub(super) min_turn_radius: f64,
    pub(super) wheel_base: f64,
}

#[derive(Deserialize)]
pub(super) struct LineInfo {
    pub(super) path_reusable: bool,
    pub(super) is_change_lane_path: bool,
    pub(super) is_path_lane_borrow: bool,
    pub(super) cruise_speed: f64,
}

#[derive(Deserialize)]
pub(super) struct Place {
    pub(super) x: f64,
    pub(super) y: f64,
}

#[derive(Deserialize)]
pub(super) struct Status {
    pub(super) pull_over: PullOver,
    pub(super) change_lane: ChangeLane,
    #[serde(default)]
    pub(super) path_decider: PathDecider,
}

#[derive(Deserialize, Default)]
pub(super) struct PathDecider {
    pub(super) decided_side_pass_direction: Vec<String>,
}

#[derive(Deserialize)]
pub(super) struct PullOver {
    pub(super) plan_pull_over_path: bool,
    #[serde(rename = "pull_over_type")]
    pub(super) kind: String,
    pub(super) position: Option<Place>,
    pub(super) theta: f64,
    pub(super) length_front: f64,
    pub(super) length_back: f64,
    pub(super) width_left: f64,
    pub(super) width_right: f64,
}

#[derive(Deserialize)]
pub(super) struct ChangeLane {
    #[serde(rename = "is_clear_to_change_lane")]
    pub(super) is_clear: bool,
    pub(super) exist_lane_change_start_position: bool,
    pub(super) lane_change_start_position: Option<Place>,
}

#[derive(Deserialize)]
pub(super) struct Expected {
    pub(super) result: String,
    pub(super) candidate_path_boundaries: Vec<Boundary>,
    pub(super) pull_over: Option<PullOver>,
    pub(super) change_lane: Option<ChangeLane>,
}

#[derive(Deserialize)]
pub(super) struct Boundary {
    pub(super) label: String,
    pub(super) start_s: f64,
    pub(super) delta_s: f64,
    pub(super) blocking_obstacle_id: String,
    #[serde(rename = "boundary")]
    pub(super) points: Vec<(f64, f64)>,
    pub(super) blocking_candidates: Vec<String>,
}
