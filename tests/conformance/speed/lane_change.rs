//! `lane_change.*`: the gap, the view, and the state machine.

use super::SpeedCase;
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2};
use corridor_decider::tasks::lane_change::clear::{Changer, Neighbour, is_clear};
use corridor_decider::tasks::lane_change::perception::{Fan, is_blocked};
use corridor_decider::tasks::lane_change::state::{Line, Phase, StateConfig, Status, advance};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

pub(super) fn check(case: &SpeedCase, function: &str) -> Result<(), String> {
    match function {
        "is_clear" => clear(case),
        "is_perception_blocked" => blocked(case),
        "process" => process(case),
        _ => Err(case.unknown()),
    }
}

#[derive(Deserialize)]
struct Traffic {
    adc_sl: Stations,
    ego_linear_velocity: f64,
    ego_heading: f64,
    reverse_gear: bool,
    is_change_lane_path: bool,
    lane_left_width: f64,
    lane_right_width: f64,
    obstacles: Vec<Moving>,
}

#[derive(Deserialize)]
struct Stations {
    start_s: f64,
    end_s: f64,
}

#[derive(Deserialize)]
struct Moving {
    polygon_sl: Vec<[f64; 2]>,
    is_virtual: bool,
    is_static: bool,
    was_blocking: bool,
    speed: f64,
    first_trajectory_theta: Option<f64>,
}

impl Moving {
    fn neighbour(&self) -> Neighbour {
        let extent = |axis: usize| {
            let values = self.polygon_sl.iter().map(|point| point[axis]);
            values.fold((f64::MAX, -f64::MAX), |(low, high), value| {
                (low.min(value), high.max(value))
            })
        };
        Neighbour {
            station: extent(0),
            offset: extent(1),
            is_moving: !self.is_virtual && !self.is_static,
            speed: self.speed,
            heading: self.first_trajectory_theta,
            is_blocking: self.was_blocking,
        }
    }
}

fn clear(case: &SpeedCase) -> Result<(), String> {
    let asked: Traffic = case.input()?;
    let ego = Changer {
        station: (asked.adc_sl.start_s, asked.adc_sl.end_s),
        speed: asked.ego_linear_velocity.abs(),
        heading: asked.ego_heading,
        is_reversing: asked.reverse_gear,
    };
    let mut neighbours: Vec<Neighbour> = asked.obstacles.iter().map(Moving::neighbour).collect();
    let width = (asked.lane_left_width, asked.lane_right_width);
    let clear = is_clear(&ego, &mut neighbours, |_| {
        asked.is_change_lane_path.then_some(width)
    });
    let blocking: Vec<bool> = neighbours.iter().map(|neighbour| neighbour.is_blocking).collect();
    case.expect(&json!({ "clear": clear, "blocking_after": blocking }))
}

#[derive(Deserialize)]
struct View {
    ego_xyh: [f64; 3],
    beam_length: f64,
    beam_step: f64,
    range: f64,
    threshold: f64,
    obstacles: Vec<Body>,
}

#[derive(Deserialize)]
struct Body {
    polygon_xy: Vec<[f64; 2]>,
    is_virtual: bool,
}

fn blocked(case: &SpeedCase) -> Result<(), String> {
    let asked: View = case.input()?;
    let [x, y, theta] = asked.ego_xyh;
    let fan = Fan {
        length: asked.beam_length,
        step: asked.beam_step,
        range: asked.range,
        threshold: asked.threshold,
    };
    let mut bodies = Vec::new();
    for body in asked.obstacles.iter().filter(|body| !body.is_virtual) {
        let corners: Vec<Vec2> = body.polygon_xy.iter().map(|[x, y]| Vec2::new(*x, *y)).collect();
        bodies.push(ConvexPolygon::hull(&corners).ok_or("an obstacle without area")?);
    }
    case.expect(&json!(is_blocked(Pose::new(x, y, theta), &fan, &bodies)))
}

#[derive(Deserialize)]
struct Tick {
    now: f64,
    enable_prioritize_change_lane: bool,
    reckless_change_lane: bool,
    success_freeze_time: f64,
    fail_freeze_time: f64,
    lines: Vec<Offered>,
    status_before: Option<Written>,
}

#[derive(Deserialize)]
struct Offered {
    id: String,
    is_change_lane: bool,
}

#[derive(Deserialize, Serialize)]
struct Written {
    status: WrittenPhase,
    path_id: String,
    timestamp: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    last_succeed_timestamp: Option<f64>,
}

#[derive(Clone, Copy, Deserialize, Serialize)]
enum WrittenPhase {
    #[serde(rename = "IN_CHANGE_LANE")]
    Changing,
    #[serde(rename = "CHANGE_LANE_FAILED")]
    Failed,
    #[serde(rename = "CHANGE_LANE_FINISHED")]
    Finished,
}

fn process(case: &SpeedCase) -> Result<(), String> {
    let asked: Tick = case.input()?;
    let config = StateConfig {
        enable_prioritize_change_lane: asked.enable_prioritize_change_lane,
        reckless_change_lane: asked.reckless_change_lane,
        change_lane_success_freeze_time: asked.success_freeze_time,
        change_lane_fail_freeze_time: asked.fail_freeze_time,
    };
    let lines = asked.lines.iter().map(|line| Line {
        id: line.id.clone(),
        is_change_lane: line.is_change_lane,
    });
    let lines: Vec<Line<String>> = lines.collect();
    let mut status = asked.status_before.map(|before| Status {
        phase: match before.status {
            WrittenPhase::Changing => Phase::Changing,
            WrittenPhase::Failed => Phase::Failed,
            WrittenPhase::Finished => Phase::Finished,
        },
        line: Some(before.path_id),
        since: before.timestamp,
        last_success: before.last_succeed_timestamp,
    });
    let outcome = advance(&config, &mut status, &lines, asked.now);
    let mut order: Vec<&str> = asked.lines.iter().map(|line| line.id.as_str()).collect();
    if let Ok(Some(place)) = outcome {
        order[..=place].rotate_right(1);
    }
    let after = status.map(|status| Written {
        status: match status.phase {
            Phase::Changing => WrittenPhase::Changing,
            Phase::Failed => WrittenPhase::Failed,
            Phase::Finished => WrittenPhase::Finished,
        },
        path_id: status.line.unwrap_or_default(),
        timestamp: status.since,
        last_succeed_timestamp: status.last_success,
    });
    case.expect(&json!({
        "result": if outcome.is_ok() { "ok" } else { "error" },
        "line_order": order,
        "status_after": after,
        // Without obstacles a line into another lane is clear; the current line is the first one.
        "is_clear_to_change_lane": clear_of(&lines, config.reckless_change_lane),
    }))
}

fn clear_of(lines: &[Line<String>], reckless: bool) -> Value {
    match lines.first() {
        Some(_) if reckless => Value::Null,
        Some(line) => json!(line.is_change_lane),
        None => Value::Null,
    }
}
