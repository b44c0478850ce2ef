//! `speed_decider.*`: decisions about obstacles, and the gaps behind them.

use super::boundary::pairs;
use super::{Number, SpeedCase};
use corridor_decider::frame::ObstacleId;
use corridor_decider::geometry::Vec2;
use corridor_decider::st_graph::{BoundaryType, SpeedData, SpeedPoint, StBoundary};
use corridor_decider::tasks::object_decision::{Fence, Lateral, Longitudinal, ObjectDecision};
use corridor_decider::tasks::speed_decider::{
    Location, Object, PedestrianTimers, Question, Reason, decide, following_gap, location, overtaking_gap,
    yielding_gap,
};
use corridor_decider::vehicle::VehicleParams;
use serde::Deserialize;
use serde_json::{Map, Value, json};

/// The original's safe gap before whom one passes, m; the search has it as a setting.
const SAFE_OVERTAKING_GAP: f64 = 20.0;

#[derive(Deserialize)]
struct Asked {
    init_v: f64,
    init_theta: f64,
    now: f64,
    adc_sl: Extent,
    main_stop_s: Number,
    speed_profile_tsv: Vec<(f64, f64, Option<f64>)>,
    obstacles: Vec<Obstacle>,
}

#[derive(Deserialize)]
struct Extent {
    start_s: f64,
    end_s: f64,
    #[serde(default)]
    start_l: f64,
    #[serde(default)]
    end_l: f64,
}

#[derive(Deserialize)]
struct Obstacle {
    id: String,
    boundary_type: BoundaryType,
    pairs: Vec<[f64; 3]>,
    is_virtual: bool,
    is_blocking: bool,
    perception_type: String,
    speed: f64,
    velocity_xy: [f64; 2],
    sl: Extent,
    center_on_lane: bool,
    longitudinal_before: String,
    lateral_before: String,
    pedestrian_timer_start: Option<f64>,
}

pub(super) fn check(case: &SpeedCase, function: &str) -> Result<(), String> {
    match function {
        "gaps" => gaps(case),
        "execute" => execute(case),
        _ => Err(case.unknown()),
    }
}

fn gaps(case: &SpeedCase) -> Result<(), String> {
    #[derive(Deserialize)]
    struct Gaps {
        queries_vobs_vego: Vec<[f64; 2]>,
    }
    let asked: Gaps = case.input()?;
    let rows = asked.queries_vobs_vego.iter().map(|[v, ego]| {
        json!([
            overtaking_gap(*v, *ego),
            following_gap(*ego),
            yielding_gap(),
            SAFE_OVERTAKING_GAP
        ])
    });
    case.expect(&json!({ "overtake_follow_yield_safe_overtake": rows.collect::<Value>() }))
}

fn execute(case: &SpeedCase) -> Result<(), String> {
    let asked: Asked = case.input()?;
    let profile = profile(&asked.speed_profile_tsv);
    let boundaries: Vec<Option<StBoundary>> = asked
        .obstacles
        .iter()
        .map(Obstacle::boundary)
        .collect::<Result<_, String>>()?;
    let objects = asked.obstacles.iter().zip(&boundaries).zip(0..);
    let mut objects: Vec<Object> = objects
        .map(|((obstacle, boundary), id)| obstacle.object(ObstacleId(id), boundary.as_ref()))
        .collect();
    let mut timers = PedestrianTimers::default();
    for (obstacle, object) in asked.obstacles.iter().zip(&objects) {
        timers
            .since
            .extend(obstacle.pedestrian_timer_start.map(|since| (object.id, since)));
    }
    let question = Question {
        profile: &profile,
        init_v: asked.init_v,
        init_theta: asked.init_theta,
        ego_start_s: asked.adc_sl.start_s,
        ego_length: VehicleParams::default().length,
        main_stop_s: asked.main_stop_s.value(),
        now: asked.now,
        front_station: &|s| asked.adc_sl.end_s + s,
    };
    let status = if decide(&question, &mut objects, &mut timers).is_ok() {
        "ok"
    } else {
        "error"
    };
    let decisions = asked.obstacles.iter().zip(&objects);
    let answer = json!({
        "status": status,
        "decisions": decisions.map(|(obstacle, object)| describe(obstacle, object, &profile)).collect::<Value>(),
        "pedestrian_timers": timers
            .since
            .iter()
            .map(|(id, since)| (asked.obstacles[id.0 as usize].id.clone(), json!(since)))
            .collect::<Map<_, _>>(),
    });
    strict(&case.repaired(&asked), &answer)
}

/// Nothing decided is something to compare here, unlike elsewhere.
fn strict(expected: &Value, got: &Value) -> Result<(), String> {
    let pairs = expected["decisions"].as_array().into_iter().flatten();
    let got_pairs = got["decisions"].as_array().into_iter().flatten();
    for (wanted, have) in pairs.zip(got_pairs) {
        for key in ["raw_st_location", "longitudinal", "lateral"] {
            if wanted[key].is_null() != have[key].is_null() {
                return Err(format!(
                    "{}: {key}: expected {}, got {}",
                    wanted["id"], wanted[key], have[key]
                ));
            }
        }
    }
    let count = |value: &Value| value["pedestrian_timers"].as_object().map(Map::len);
    if count(expected) != count(got) {
        return Err(format!(
            "timers: expected {}, got {}",
            expected["pedestrian_timers"], got["pedestrian_timers"]
        ));
    }
    super::compare::compare(expected, got)
}

impl SpeedCase {
    /// The expectation with pedestrians ignored that the original forgets.
    fn repaired(&self, asked: &Asked) -> Value {
        let mut expected = self.expected_fixed.as_ref().unwrap_or(&self.expected).clone();
        for decision in expected["decisions"].as_array_mut().into_iter().flatten() {
            let unset = if decision["tag"] == "pre" {
                &["reason", "distance_s", "fence_s"][..]
            } else {
                &["reason"]
            };
            for key in unset {
                if decision["longitudinal"].is_object() {
                    decision["longitudinal"][key] = Value::Null;
                }
            }
        }
        if !self.is_defect("left without any decision") {
            return expected;
        }
        let decisions = expected["decisions"].as_array_mut().into_iter().flatten();
        let mut failed = false;
        for (decision, obstacle) in decisions.zip(&asked.obstacles) {
            let is_forgotten = decision["longitudinal"].is_null() && obstacle.perception_type == "PEDESTRIAN";
            if is_forgotten && !failed && !obstacle.is_virtual {
                decision["longitudinal"] = json!({ "type": "IGNORE" });
                if decision["lateral"].is_null() {
                    decision["lateral"] = json!({ "type": "IGNORE" });
                }
                decision["tag"] = json!("dp_st_graph");
            }
            failed |= decision["tag"] == "dp_st_graph/cross";
        }
        expected
    }
}

/// Points without a speed have that of the way to them.
fn profile(rows: &[(f64, f64, Option<f64>)]) -> SpeedData {
    let mut points: Vec<SpeedPoint> = Vec::with_capacity(rows.len());
    for (t, s, v) in rows {
        let mean = points
            .last()
            .map_or(0.0, |before| (s - before.s) / (t - before.t));
        points.push(SpeedPoint {
            t: *t,
            s: *s,
            v: v.unwrap_or(mean),
            ..SpeedPoint::default()
        });
    }
    SpeedData::new(points)
}

impl Obstacle {
    fn boundary(&self) -> Result<Option<StBoundary>, String> {
        if self.pairs.is_empty() {
            return Ok(None);
        }
        let boundary = StBoundary::new(pairs(&self.pairs)).map_err(|error| error.to_string())?;
        Ok(Some(boundary.with_kind(self.boundary_type)))
    }

    fn object<'a>(&self, id: ObstacleId, boundary: Option<&'a StBoundary>) -> Object<'a> {
        let before = Fence {
            distance: -1.0,
            s: 0.0,
        };
        Object {
            id,
            boundary,
            is_virtual: self.is_virtual,
            is_pedestrian: self.perception_type == "PEDESTRIAN",
            is_blocking: self.is_blocking,
            is_on_lane: self.center_on_lane,
            speed: self.speed,
            velocity: Vec2::new(self.velocity_xy[0], self.velocity_xy[1]),
            station: (self.sl.start_s, self.sl.end_s),
            offset: (self.sl.start_l, self.sl.end_l),
            decision: ObjectDecision {
                longitudinal: match self.longitudinal_before.as_str() {
                    "STOP" => Some(Longitudinal::Stop(before)),
                    "IGNORE" => Some(Longitudinal::Ignore),
                    _ => None,
                },
                lateral: match self.lateral_before.as_str() {
                    "NUDGE" => Some(Lateral::Nudge(0.3)),
                    "IGNORE" => Some(Lateral::Ignore),
                    _ => None,
                },
            },
            reason: None,
        }
    }
}

fn describe(obstacle: &Obstacle, object: &Object, profile: &SpeedData) -> Value {
    let was_decided = obstacle.longitudinal_before != "none";
    let place = object.boundary.filter(|_| profile.points.len() > 1);
    let place = place.map(|boundary| match location(profile, boundary) {
        Location::Below => "BELOW",
        Location::Above => "ABOVE",
        Location::Cross => "CROSS",
    });
    let tag = match object.reason {
        _ if was_decided => "pre",
        None => "",
        Some(Reason::Profile) => "dp_st_graph",
        Some(Reason::Overtake) => "dp_st_graph/overtake",
        Some(Reason::Pedestrian) => "dp_st_graph/pedestrian",
        Some(Reason::KeepClear) => "dp_st_graph/keep_clear",
        Some(Reason::TooClose) => "dp_st_graph/too_close",
        Some(Reason::Cross) => "dp_st_graph/cross",
    };
    json!({
        "id": obstacle.id,
        "raw_st_location": place,
        "longitudinal": object.decision.longitudinal.map(|decision| longitudinal(decision, was_decided)),
        "lateral": object.decision.lateral.map(|decision| match decision {
            Lateral::Ignore => json!({ "type": "IGNORE" }),
            Lateral::Nudge(_) => json!({ "type": "NUDGE" }),
        }),
        "tag": tag,
    })
}

fn longitudinal(decision: Longitudinal, was_decided: bool) -> Value {
    let kind = match decision {
        Longitudinal::Ignore => "IGNORE",
        Longitudinal::Overtake(_) => "OVERTAKE",
        Longitudinal::Follow(_) => "FOLLOW",
        Longitudinal::Yield(_) => "YIELD",
        Longitudinal::Stop(_) => "STOP",
    };
    let mut written = json!({ "type": kind });
    if let Some(fence) = decision.fence().filter(|_| !was_decided) {
        written["distance_s"] = json!(fence.distance);
        written["fence_s"] = json!(fence.s);
    }
    written
}
