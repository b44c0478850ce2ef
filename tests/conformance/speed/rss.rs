//! `rss.execute`: the gap to the nearest obstacle ahead.

use super::SpeedCase;
use corridor_decider::tasks::rss::{AccelerationRange, RssBox, RssObstacle, assess, is_on_lane};
use serde::Deserialize;
use serde_json::{Value, json};

#[derive(Deserialize)]
struct Asked {
    ego_linear_velocity: f64,
    adc_sl: Extent,
    lane_left_width: f64,
    lane_right_width: f64,
    path_empty: bool,
    speed_empty: bool,
    obstacles: Vec<Obstacle>,
}

#[derive(Deserialize)]
struct Obstacle {
    is_virtual: bool,
    speed: f64,
    sl: Extent,
}

#[derive(Clone, Copy, Deserialize)]
struct Extent {
    start_s: f64,
    end_s: f64,
    start_l: f64,
    end_l: f64,
}

impl Extent {
    fn place(self) -> RssBox {
        RssBox {
            station: (self.start_s, self.end_s),
            offset: (self.start_l, self.end_l),
        }
    }
}

pub(super) fn check(case: &SpeedCase) -> Result<(), String> {
    let asked: Asked = case.input()?;
    if asked.path_empty || asked.speed_empty {
        // Without a plan there is nothing to judge; the stage asks only with one.
        return case.expect(&json!({ "status": "error" }));
    }
    let bodies = asked.obstacles.iter().filter(|obstacle| !obstacle.is_virtual);
    let obstacles: Vec<RssObstacle> = bodies
        .map(|obstacle| RssObstacle {
            place: obstacle.sl.place(),
            speed: obstacle.speed,
            is_on_lane: is_on_lane(
                obstacle.sl.place().offset,
                asked.lane_left_width,
                asked.lane_right_width,
            ),
        })
        .collect();
    let state = assess(asked.adc_sl.place(), asked.ego_linear_velocity, &obstacles);
    let range = |range: AccelerationRange| json!([range.min, range.max]);
    let answer = json!({
        "status": "ok",
        "is_rss_safe": state.is_safe,
        "cur_dist_lon": state.gap,
        "rss_safe_dist_lon": state.safe_distance,
        "acc_lon_range": range(state.longitudinal),
        "acc_lat_left_range": range(state.left),
        "acc_lat_right_range": range(state.right),
        "speed_cleared": false,
    });
    super::compare::compare(&case.repaired_rss(&asked), &answer)
}

impl SpeedCase {
    fn repaired_rss(&self, asked: &Asked) -> Value {
        let mut expected = self.expected_fixed.as_ref().unwrap_or(&self.expected).clone();
        if self.is_defect("negative ego speed") || self.is_defect("straddling") {
            return by_formula(asked);
        }
        if self.is_defect("mirrored") {
            let left = expected["acc_lat_left_range"].take();
            expected["acc_lat_left_range"] = expected["acc_lat_right_range"].take();
            expected["acc_lat_right_range"] = left;
        }
        expected
    }
}

/// Gap and safe distance to the nearest obstacle ahead of which anything is in the lane, written out.
fn by_formula(asked: &Asked) -> Value {
    let mut nearest: Option<(f64, f64)> = None;
    for obstacle in asked.obstacles.iter().filter(|obstacle| !obstacle.is_virtual) {
        let gap = obstacle.sl.start_s - asked.adc_sl.end_s;
        let beside =
            obstacle.sl.start_l >= asked.lane_left_width || obstacle.sl.end_l <= -asked.lane_right_width;
        if !beside && gap > 0.0 && nearest.is_none_or(|nearest| gap < nearest.0) {
            nearest = Some((gap, obstacle.speed));
        }
    }
    let Some((gap, front)) = nearest else {
        return json!({ "status": "ok", "is_rss_safe": true, "cur_dist_lon": 3000.0, "rss_safe_dist_lon": 3000.0 });
    };
    let rear = asked.ego_linear_velocity.max(0.0);
    let safe = rear + 1.75 + (rear + 3.5) * (rear + 3.5) / 8.0 - front * front / 16.0;
    json!({
        "status": "ok",
        "is_rss_safe": gap > safe.max(0.0),
        "cur_dist_lon": gap,
        "rss_safe_dist_lon": safe.max(0.0),
    })
}
