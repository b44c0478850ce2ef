//! `dp.*`: the search over the grid, and its costs one by one.

use super::boundary::pairs;
use super::compare::agree;
use super::{SpeedCase, number};
use corridor_decider::st_graph::{BoundaryType, SpeedLimit, StBoundary, StGraphData, StObstacle};
use corridor_decider::tasks::speed_heuristic::{
    Costs, Found, Grid, SpeedHeuristicConfig, SpeedHeuristicError, differences, search,
};
use corridor_decider::vehicle::VehicleParams;
use serde::Deserialize;
use serde_json::{Value, json};

/// The original keeps 0.2 m/s in 32 bits.
const STOPPED_SPEED: f64 = 0.200_000_002_98;

/// Largest difference of a place, m: the rows of the grid are sums.
const PLACE: f64 = 1e-6;

#[derive(Deserialize)]
struct Asked {
    #[serde(default)]
    config: String,
    #[serde(default)]
    obstacles: Vec<Obstacle>,
    #[serde(default)]
    path_length: f64,
    #[serde(default)]
    points_ts: Vec<[f64; 2]>,
    #[serde(default)]
    queries_s1_s2_limit_cruise: Vec<[f64; 4]>,
    #[serde(default)]
    accel: Vec<f64>,
    #[serde(default)]
    jerk: Vec<f64>,
    #[serde(default)]
    queries_s0_s1_s2_s3_prev_v_prev_a: Vec<[f64; 6]>,
}

#[derive(Deserialize)]
struct Obstacle {
    #[serde(rename = "type")]
    kind: BoundaryType,
    is_virtual: bool,
    has_stop_decision: bool,
    pairs: Vec<[f64; 3]>,
}

#[derive(Deserialize)]
struct Search {
    total_time: f64,
    path_length: f64,
    init_v: f64,
    init_a: f64,
    cruise_speed: f64,
    planning_upper_speed_limit: f64,
    speed_limit_sv: Vec<(f64, f64)>,
}

pub(super) fn check(case: &SpeedCase, function: &str) -> Result<(), String> {
    let asked: Asked = case.input()?;
    let config = config(&asked.config);
    let obstacles = asked
        .obstacles
        .iter()
        .filter(|obstacle| !obstacle.pairs.is_empty());
    let obstacles: Vec<StObstacle> = obstacles.map(Obstacle::build).collect::<Result<_, String>>()?;
    let costs = Costs::new(&config, &obstacles, STOPPED_SPEED);
    let all = |values: &[f64], cost: &dyn Fn(f64) -> f64| -> Value {
        values.iter().map(|value| number(cost(*value))).collect()
    };
    let accelerations = all(&asked.accel, &|a| costs.acceleration(a));
    let jerks = all(&asked.jerk, &|jerk| costs.jerk(jerk));
    case.expect(&match function {
        "search" => return find(case, config, obstacles),
        "configs" => {
            json!({ "default": SpeedHeuristicConfig::default(), "lane_change": SpeedHeuristicConfig::lane_change() })
        }
        "accel_cost" => accelerations,
        "jerk_cost" => jerks,
        "memoised_sequence" => json!({ "accel_cost": accelerations, "jerk_cost": jerks }),
        "obstacle_cost" => {
            let near = |[t, s]: &[f64; 2]| number(costs.obstacles_at(*t).cost(*s));
            let far = |[_, s]: &[f64; 2]| number(costs.spatial(asked.path_length, *s));
            json!({
                "obstacle_cost": asked.points_ts.iter().map(near).collect::<Value>(),
                "spatial_cost": asked.points_ts.iter().map(far).collect::<Value>(),
            })
        }
        "speed_cost" => {
            let queries = asked.queries_s1_s2_limit_cruise.iter();
            let cost = queries.map(|[from, to, limit, cruise]| number(costs.speed(*from, *to, *limit, *cruise)));
            json!({ "cost": cost.collect::<Value>(), "keep_clear_ranges": costs.keep_clear() })
        }
        "finite_difference_costs" => {
            let queries = asked.queries_s0_s1_s2_s3_prev_v_prev_a.iter();
            let rows = queries.map(|query| difference_costs(&costs, *query));
            json!({ "accel2_accel3_jerk2_jerk3_jerk4": rows.collect::<Value>() })
        }
        _ => return Err(case.unknown()),
    })
}

fn config(name: &str) -> SpeedHeuristicConfig {
    match name {
        "lane_change" => SpeedHeuristicConfig::lane_change(),
        _ => SpeedHeuristicConfig::default(),
    }
}

fn difference_costs(costs: &Costs, [s0, s1, s2, s3, v, a]: [f64; 6]) -> Value {
    json!([
        number(costs.acceleration(differences::acceleration_from(v, [s0, s1], 1.0))),
        number(costs.acceleration(differences::acceleration([s0, s1, s2], 1.0))),
        number(costs.jerk(differences::jerk_from(v, a, [s0, s1], 1.0))),
        number(costs.jerk(differences::jerk_from_speed(v, [s0, s1, s2], 1.0))),
        number(costs.jerk(differences::jerk([s0, s1, s2, s3], 1.0))),
    ])
}

impl Obstacle {
    fn build(&self) -> Result<StObstacle, String> {
        let boundary = StBoundary::new(pairs(&self.pairs)).map_err(|error| error.to_string())?;
        Ok(StObstacle {
            boundary: boundary.with_kind(self.kind),
            repels: !self.is_virtual && !self.has_stop_decision,
        })
    }
}

fn find(case: &SpeedCase, config: SpeedHeuristicConfig, obstacles: Vec<StObstacle>) -> Result<(), String> {
    let asked: Search = case.input()?;
    let config = SpeedHeuristicConfig {
        upper_speed_limit: asked.planning_upper_speed_limit,
        ..config
    };
    let vehicle = VehicleParams {
        max_abs_speed_when_stopped: STOPPED_SPEED,
        ..VehicleParams::default()
    };
    let Ok(speed_limit) = SpeedLimit::new(asked.speed_limit_sv) else {
        return case.expect(&json!({ "status": "check_failed" }));
    };
    let graph = StGraphData {
        obstacles,
        init_v: asked.init_v,
        init_a: asked.init_a,
        speed_limit,
        cruise_speed: asked.cruise_speed,
        path_length: asked.path_length,
        total_time: asked.total_time,
    };
    let found = search(&config, &vehicle, &graph);
    let grid = Grid::new(&config, graph.path_length, graph.total_time);
    let rows = grid.map_or(0, |grid| grid.rows.len());
    case.expect_found(&found, rows)
}

/// Nodes one by one. A defect that shows in no total may show in one of a node: totals count to a millionth.
fn expect_nodes(expected: &Value, found: &Found) -> Result<(), String> {
    const TOTAL: f64 = 1e-6;
    let wanted: Vec<[f64; 4]> =
        Deserialize::deserialize(expected).map_err(|error| format!("nodes: {error}"))?;
    let alike = wanted.len() == found.nodes.len()
        && wanted
            .iter()
            .zip(&found.nodes)
            .all(|([obstacle, spatial, total, v], node)| {
                let total_agrees = (total - node.total).abs() <= TOTAL * total.abs();
                agree(*obstacle, node.obstacle)
                    && agree(*spatial, node.spatial)
                    && total_agrees
                    && agree(*v, node.v)
            });
    if alike {
        Ok(())
    } else {
        Err(format!("nodes: expected {wanted:?}, got {:?}", found.nodes))
    }
}

impl SpeedCase {
    fn expect_found(&self, found: &Result<Found, SpeedHeuristicError>, rows: usize) -> Result<(), String> {
        let (expected, fixed) = (&self.expected, self.expected_fixed.as_ref());
        let status = if found.is_ok() { "ok" } else { "error" };
        if expected["status"] != status {
            return Err(format!("expected {}, got {status}", expected["status"]));
        }
        let Ok(found) = found else { return Ok(()) };
        let wanted = |key: &str| match fixed.map(|fixed| &fixed[key]) {
            Some(fixed) if !fixed.is_null() => fixed,
            _ => &expected[key],
        };
        let total = found.nodes.last().map(|node| node.total);
        match (wanted("total_cost").as_f64(), total) {
            (Some(wanted), Some(got)) if agree(wanted, got) => {}
            (Some(_), Some(_)) if self.fragile => return Ok(()),
            (None, None) => {}
            (wanted, got) => return Err(format!("total_cost: expected {wanted:?}, got {got:?}")),
        }
        self.expect_points(wanted("points_tsv"), found)?;
        if fixed.is_some() || found.nodes.is_empty() {
            return Ok(());
        }
        expect_nodes(&expected["nodes_obs_spatial_total_speed"], found)?;
        super::compare::compare(
            &json!({
                "finite_nodes_per_column": expected["finite_nodes_per_column"],
                "rows": expected["rows"],
            }),
            &json!({
                "finite_nodes_per_column": found.reached,
                "rows": rows,
            }),
        )
    }

    fn expect_points(&self, expected: &Value, found: &Found) -> Result<(), String> {
        let wanted: Vec<(f64, f64, Option<f64>)> =
            Deserialize::deserialize(expected).map_err(|error| format!("points_tsv: {error}"))?;
        let points = &found.speed.points;
        let near = |a: f64, b: f64| (a - b).abs() <= PLACE;
        let all = wanted.len() == points.len()
            && wanted.iter().zip(points).all(|((t, s, v), point)| {
                near(*t, point.t) && near(*s, point.s) && v.is_none_or(|v| near(v, point.v))
            });
        if all {
            Ok(())
        } else {
            let got: Vec<_> = points.iter().map(|point| [point.t, point.s, point.v]).collect();
            Err(format!("{}: expected {wanted:?}, got {got:?}", self.function))
        }
    }
}
