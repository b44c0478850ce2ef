//! The path-time graph, lateral bounds, and what they are made with.

use super::scene::{self, Body, Entry, Mover, Start};
use super::{LatticeCase, all_near, same};
use corridor_decider::geometry::Vec2;
use corridor_decider::lattice::{LineTable, PathTimeGraph, StaticBox, lateral_bounds, projected_speed};
use corridor_decider::st_graph::StPoint;
use corridor_decider::vehicle::VehicleParams;
use serde::Deserialize;
use serde_json::{Value, json};

const TOLERANCE: f64 = 1e-7;
const MATCHING: f64 = 1e-8;
const BOUNDS: f64 = 1e-9;

/// Beside an obstacle by less than this the original, too, would limit a station, m.
const FAR: f64 = 8.0;

#[derive(Deserialize)]
struct Input {
    reference_line: Vec<[f64; 6]>,
    lane_width: Option<(f64, f64)>,
    obstacles: Vec<Body>,
    times: Vec<f64>,
}

/// The graph of bodies along a line.
pub(super) fn of(bodies: &[Body], line: &LineTable, s: f64, lane_width: Option<(f64, f64)>) -> PathTimeGraph {
    let obstacles: Vec<_> = bodies
        .iter()
        .enumerate()
        .map(|(k, body)| body.obstacle(k))
        .collect();
    PathTimeGraph::new(&obstacles, s, line, &|_| lane_width, &|point, _| {
        line.frenet(point)
    })
}

pub(super) fn graph(case: &LatticeCase) -> Result<(), String> {
    let (input, start): (Input, Start) = (case.input()?, case.input()?);
    let line = scene::line(&input.reference_line, scene::full)?;
    let graph = of(&input.obstacles, &line, start.init_s[0], input.lane_width);
    let wanted: Vec<Entry> =
        Vec::deserialize(&case.expected["st_obstacles"]).map_err(|error| error.to_string())?;
    same("number of entries", &wanted.len(), &graph.entries.len())?;
    for wanted in &wanted {
        let place = input
            .obstacles
            .iter()
            .position(|body| body.id == wanted.id)
            .ok_or("an unknown obstacle")?;
        let found = graph.entries.iter().find(|entry| entry.id == scene::id(place));
        let got = found.ok_or_else(|| format!("`{}` is not in the graph", wanted.id))?;
        let should = wanted.entry(place);
        for (name, wanted, got) in [
            ("enters", should.enters, got.enters),
            ("leaves", should.leaves, got.leaves),
        ] {
            let numbers = |pair: corridor_decider::st_graph::StPair| json!([pair.t, pair.lower, pair.upper]);
            all_near(name, &numbers(wanted), &numbers(got), TOLERANCE)?;
        }
        beside(case, &wanted.id, got)?;
    }
    let standing: Vec<_> = graph
        .standing
        .iter()
        .map(|there| [there.s.0, there.s.1, there.l.0, there.l.1])
        .collect();
    all_near(
        "static_sl_boundaries",
        &case.expected["static_sl_boundaries"],
        &json!(standing),
        TOLERANCE,
    )?;
    for (wanted, t) in case.expected["blocking_intervals"]
        .as_array()
        .into_iter()
        .flatten()
        .zip(&input.times)
    {
        let mut wanted: Vec<(f64, f64)> = Vec::deserialize(wanted).map_err(|error| error.to_string())?;
        let mut got: Vec<(f64, f64)> = graph.blocked_at(*t).collect();
        wanted.sort_by(|a, b| a.0.total_cmp(&b.0));
        got.sort_by(|a, b| a.0.total_cmp(&b.0));
        all_near(&format!("blocked at {t}"), &json!(wanted), &json!(got), TOLERANCE)?;
    }
    Ok(())
}

fn beside(
    case: &LatticeCase,
    name: &str,
    entry: &corridor_decider::lattice::PathTimeEntry,
) -> Result<(), String> {
    let points = |distance: f64| -> Value {
        let row = |point: StPoint| [point.t, point.s];
        json!(
            entry
                .points_beside(distance)
                .into_iter()
                .map(row)
                .collect::<Vec<_>>()
        )
    };
    let lists = case.expected["surrounding_points"]
        .as_array()
        .into_iter()
        .flatten();
    for wanted in lists.filter(|wanted| wanted["id"] == name) {
        all_near("below", &wanted["below"], &points(-1e-6), TOLERANCE)?;
        all_near("above", &wanted["above"], &points(1e-6), TOLERANCE)?;
    }
    Ok(())
}

#[derive(Deserialize)]
struct Bounds {
    lane_width: Option<(f64, f64)>,
    static_sl_boundaries: Vec<[f64; 4]>,
}

pub(super) fn bounds(case: &LatticeCase) -> Result<(), String> {
    let (input, start): (Bounds, Start) = (case.input()?, case.input()?);
    let (s, l) = (start.init_s[0], start.init_d[0]);
    let standing = input
        .static_sl_boundaries
        .iter()
        .map(|[from, to, right, left]| StaticBox {
            id: scene::id(0),
            s: (*from, *to),
            l: (*right, *left),
        });
    let standing: Vec<_> = standing.collect();
    let vehicle = VehicleParams::default();
    let got = lateral_bounds(s, l, &standing, &|_| input.lane_width, &vehicle);
    let wanted: Vec<(f64, f64)> =
        Vec::deserialize(&case.expected["bounds"]).map_err(|error| error.to_string())?;
    if !case.is_defect() {
        same("number of stations", &wanted.len(), &got.len())?;
    }
    for (k, (wanted, got)) in wanted.iter().zip(&got).enumerate() {
        let at = s + k as f64;
        let is_near = |there: &&StaticBox| at + FAR > there.s.0 && at - FAR < there.s.1;
        if let Some(there) = standing.iter().find(is_near) {
            beside_standing(k, at, *got, there, &vehicle)?;
        } else {
            all_near(&format!("bounds[{k}]"), &json!(wanted), &json!(got), BOUNDS)?;
        }
    }
    Ok(())
}

/// A body beside what stands keeps clear of it, or has nowhere to be.
fn beside_standing(
    k: usize,
    at: f64,
    got: (f64, f64),
    there: &StaticBox,
    ego: &VehicleParams,
) -> Result<(), String> {
    let overlaps = at + ego.front_edge_to_center > there.s.0 && at - ego.back_edge_to_center < there.s.1;
    let clear = got.0 - ego.half_width() >= there.l.1 || got.1 + ego.half_width() <= there.l.0;
    let nowhere = got.0.abs() + got.1.abs() < 1e-9;
    let ordered = got.0 <= got.1;
    same(
        &format!("clear at station {k}"),
        &true,
        &(ordered && (!overlaps || clear || nowhere)),
    )
}

#[derive(Deserialize)]
struct Matched {
    reference_line: Vec<[f64; 6]>,
    s: Vec<f64>,
    xy: Vec<(f64, f64)>,
}

pub(super) fn matcher(case: &LatticeCase) -> Result<(), String> {
    let input: Matched = case.input()?;
    let line = scene::line(&input.reference_line, scene::full)?;
    let row = |foot: corridor_decider::geometry::frenet::Foot| {
        json!([
            foot.s,
            foot.pose.x,
            foot.pose.y,
            foot.pose.theta,
            foot.kappa,
            foot.dkappa
        ])
    };
    let by_s: Vec<Value> = input.s.iter().map(|s| row(line.at(*s))).collect();
    let by_xy: Vec<Value> = input
        .xy
        .iter()
        .map(|(x, y)| row(line.nearest(Vec2::new(*x, *y))))
        .collect();
    let sl = |(x, y): &(f64, f64)| {
        let at = line.frenet(Vec2::new(*x, *y));
        [at.s, at.l]
    };
    let sl: Vec<_> = input.xy.iter().map(sl).collect();
    all_near("match_by_s", &case.expected["match_by_s"], &json!(by_s), MATCHING)?;
    all_near(
        "match_by_xy",
        &case.expected["match_by_xy"],
        &json!(by_xy),
        MATCHING,
    )?;
    all_near("frenet_sl", &case.expected["frenet_sl"], &json!(sl), MATCHING)
}

#[derive(Deserialize)]
struct Speeds {
    reference_line_s_theta: Vec<[f64; 2]>,
    obstacles: Vec<Mover>,
    queries_id_s_t: Vec<(String, f64, f64)>,
}

pub(super) fn speeds(case: &LatticeCase) -> Result<(), String> {
    let input: Speeds = case.input()?;
    let line = scene::line(&input.reference_line_s_theta, scene::directions)?;
    let speed = |(name, s, t): &(String, f64, f64)| {
        projected_speed(
            &scene::motions(&input.obstacles, name),
            line.at(*s).pose.theta,
            *t,
        )
    };
    let got: Vec<f64> = input.queries_id_s_t.iter().map(speed).collect();
    all_near("speed", &case.expected["speed"], &json!(got), BOUNDS)
}
