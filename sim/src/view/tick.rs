//! One tick as the page draws it.

use super::bundle::BundleData;
use super::intern::Pool;
use super::line::flat;
use super::thin;
use crate::explain::words;
use crate::trace::{TickRecord, Trace};
use corridor_decider::decision::{Candidate, Fallback, PathPoint, TaskReport, TrajectoryPoint};
use corridor_decider::frame::{Command, Obstacle};
use corridor_decider::geometry::{Pose, Vec2};
use corridor_decider::planner::LatticeSurvey;
use corridor_decider::reference_line::{LineQuery, ReferenceLine};
use corridor_decider::tasks::path_bounds::{BoundPoint, EdgeCause, PathBound};
use serde::Serialize;

/// Time between the points of a plan or a prediction that the page gets, s.
const PLAN_SPACING: f64 = 0.5;

/// What is written once and referred to by place.
#[derive(Default)]
pub(super) struct Pools {
    pub(super) texts: Pool,
    pub(super) labels: Pool,
    /// Obstacles as JSON: a parked car is the same in every tick.
    pub(super) obstacles: Pool,
    /// Reports of tasks as JSON: many say in every tick the same.
    pub(super) tasks: Pool,
    /// Sampled curves in letters.
    pub(super) curves: Pool,
}

/// One tick. Short names where thousands of them are written.
#[derive(Serialize)]
pub(super) struct TickData {
    t: f64,
    n: u32,
    /// `x, y, theta, steer, yaw rate`
    ego: [f64; 5],
    sl: [f64; 2],
    /// Place of the line in the page's lines.
    line: usize,
    command: usize,
    obstacles: Vec<usize>,
    candidates: Vec<CandidateData>,
    chosen: Option<usize>,
    /// `s, l, x, y, …`
    path: Vec<f64>,
    /// `t, x, y, theta, v, …`
    plan: Vec<f64>,
    /// What it slows down for.
    stop: Option<usize>,
    /// The rear axle there: arc length along the path, then `s, l, x, y, theta`.
    stop_at: Option<[f64; 6]>,
    outcome: usize,
    normal: bool,
    /// What failed, and where the path and the speed come from instead.
    #[serde(skip_serializing_if = "Option::is_none")]
    fallback: Option<[Option<usize>; 3]>,
    /// In the order in which they ran.
    tasks: Vec<usize>,
    /// What the lattice planner weighed.
    #[serde(skip_serializing_if = "Option::is_none")]
    bundle: Option<BundleData>,
    /// `x, y, theta`
    pull_over: Option<[f64; 3]>,
    /// Where the command asks to stop, `x, y`.
    destination: Option<[f64; 2]>,
    hash: String,
}

#[derive(Serialize)]
struct CandidateData {
    label: usize,
    text: usize,
    /// Name of what closes it.
    blocked: Option<usize>,
    /// First and last station.
    span: [f64; 2],
    /// Station, right and left limit at the narrowest place.
    narrow: Option<[f64; 3]>,
    right: EdgeData,
    left: EdgeData,
}

#[derive(Serialize)]
struct EdgeData {
    /// `s, l, s, l, …`
    at: Vec<f64>,
    /// `cause, first station, cause, first station, …`; the cause is a place in the texts.
    causes: Vec<f64>,
    /// Class of each cause, for its colour.
    classes: Vec<&'static str>,
}

#[derive(Serialize)]
struct ObstacleData {
    id: u32,
    kind: corridor_decider::frame::ObstacleKind,
    fixed: bool,
    at: [f64; 3],
    speed: [f64; 2],
    /// Footprint, `x, y, …` and `s, l, …`
    xy: Vec<f64>,
    sl: Vec<f64>,
    /// Prediction, `t, x, y, theta, s, l, …`
    prediction: Vec<f64>,
}

impl TickData {
    pub(super) fn new(
        trace: &Trace,
        tick: &TickRecord,
        survey: Option<&LatticeSurvey>,
        origin: Vec2,
        pools: &mut Pools,
    ) -> Self {
        let (line, decision, frame) = (trace.line(tick), &tick.decision, &tick.frame);
        let at = line.to_frenet(frame.ego.pose.position());
        let [x, y, theta] = pose(frame.ego.pose, origin);
        let stop = decision.stop.filter(|stop| stop.distance.is_finite());
        Self {
            t: thin::milli(frame.time),
            n: frame.tick,
            ego: [x, y, theta, fine(frame.ego.steer), fine(frame.ego.yaw_rate)],
            sl: [thin::milli(at.s), thin::offset(at.l)],
            line: tick.lines[decision.line].0,
            command: pools.texts.place(words::command(frame.command)),
            obstacles: (frame.obstacles.iter())
                .map(|o| pools.obstacles.place(obstacle(line, o, origin)))
                .collect(),
            candidates: (decision.candidates.iter())
                .map(|c| candidate(trace, c, pools))
                .collect(),
            chosen: decision.chosen,
            path: path(&decision.path, origin),
            plan: plan(&decision.trajectory, origin),
            stop: decision
                .stop
                .map(|stop| pools.texts.place(words::stop_cause(trace, stop.cause))),
            stop_at: stop.and_then(|stop| along(&decision.path, stop.distance, origin)),
            outcome: pools.texts.place(words::outcome(decision.outcome).to_owned()),
            normal: decision.outcome.is_planned(),
            fallback: decision.fallback.map(|fallen| fallback(trace, fallen, pools)),
            tasks: (decision.tasks.iter())
                .map(|report| pools.tasks.place(task(report)))
                .collect(),
            bundle: survey.map(|survey| BundleData::new(trace, survey, pools)),
            pull_over: decision.pull_over.map(|target| {
                pose(
                    Pose::new(target.position.x, target.position.y, target.theta),
                    origin,
                )
            }),
            destination: match frame.command {
                Command::PullOver(at) => Some([thin::milli(at.x - origin.x), thin::milli(at.y - origin.y)]),
                _ => None,
            },
            hash: tick.hash.clone(),
        }
    }
}

fn fallback(trace: &Trace, fallback: Fallback, pools: &mut Pools) -> [Option<usize>; 3] {
    let path = fallback.path.map(words::path_rung);
    let speed = fallback.speed.map(words::speed_rung);
    [
        Some(words::fallback_cause(trace, fallback.cause)),
        path.map(str::to_owned),
        speed.map(str::to_owned),
    ]
    .map(|text| text.map(|text| pools.texts.place(text)))
}

/// `task, input, output`, and why it failed if it did.
fn task(report: &TaskReport) -> String {
    let name = report.task.to_string();
    let mut words = vec![&name, &report.input, &report.output];
    words.extend(&report.error);
    serde_json::to_string(&words).expect("plain data always serialise")
}

/// Angles and curvatures.
fn fine(value: f64) -> f64 {
    (value * 1e4).round() / 1e4 + 0.0
}

pub(super) fn pose(pose: Pose, origin: Vec2) -> [f64; 3] {
    [
        thin::milli(pose.x - origin.x),
        thin::milli(pose.y - origin.y),
        fine(pose.theta),
    ]
}

fn candidate(trace: &Trace, candidate: &Candidate, pools: &mut Pools) -> CandidateData {
    let bound = &candidate.bound;
    CandidateData {
        label: pools.labels.place(bound.label.to_string()),
        text: pools.texts.place(words::assessment(trace, candidate.assessment)),
        blocked: bound.blocked_by.map(|id| pools.texts.place(trace.obstacle(id))),
        span: [thin::milli(bound.start_s()), thin::milli(bound.end_s())],
        narrow: words::narrowest(bound)
            .map(|p| [thin::milli(p.s), thin::offset(p.l_min), thin::offset(p.l_max)]),
        right: edge(trace, bound, pools, |p| (p.right, p.l_min)),
        left: edge(trace, bound, pools, |p| (p.left, p.l_max)),
    }
}

fn edge(
    trace: &Trace,
    bound: &PathBound,
    pools: &mut Pools,
    side: impl Fn(&BoundPoint) -> (EdgeCause, f64),
) -> EdgeData {
    let points: Vec<Vec2> = (bound.points.iter())
        .map(|p| Vec2::new(p.s, thin::offset(side(p).1)))
        .collect();
    let differs = |a: usize, b: usize| side(&bound.points[a]).0 != side(&bound.points[b]).0;
    let kept = thin::keep(&points, |k| differs(k, k - 1) || differs(k, k + 1));
    let starts: Vec<&BoundPoint> = (bound.points.chunk_by(|a, b| side(a).0 == side(b).0))
        .map(|run| &run[0])
        .collect();
    let places = (starts.iter())
        .flat_map(|p| {
            let place = pools.texts.place(words::cause(trace, side(p).0));
            [place as f64, thin::milli(p.s)]
        })
        .collect();
    EdgeData {
        at: (points.iter().zip(kept))
            .filter(|(_, kept)| *kept)
            .flat_map(|(p, _)| [thin::milli(p.x), p.y])
            .collect(),
        causes: places,
        classes: starts.iter().map(|p| class(side(p).0)).collect(),
    }
}

/// The class of a cause: obstacles share one, whichever they are.
fn class(cause: EdgeCause) -> &'static str {
    match cause {
        EdgeCause::Unbounded => "unbounded",
        EdgeCause::LaneLine => "lane_line",
        EdgeCause::BorrowedLane => "borrowed_lane",
        EdgeCause::RoadEdge => "road_edge",
        EdgeCause::Ego => "ego",
        EdgeCause::Obstacle(_) => "obstacle",
        EdgeCause::LaneChangeZone => "lane_change_zone",
        EdgeCause::PullOverTarget => "pull_over_target",
    }
}

fn path(points: &[PathPoint], origin: Vec2) -> Vec<f64> {
    let in_world: Vec<Vec2> = points.iter().map(|p| p.pose.position()).collect();
    let on_line: Vec<Vec2> = points.iter().map(|p| Vec2::new(p.s, p.l)).collect();
    // A straight path beside a bend is a curve over the line, and the other way round: both must look right.
    let (world, line) = (thin::keep(&in_world, |_| false), thin::keep(&on_line, |_| false));
    (0..points.len())
        .filter(|k| world[*k] || line[*k])
        .flat_map(|k| {
            let [x, y, _] = pose(points[k].pose, origin);
            [thin::milli(points[k].s), thin::offset(points[k].l), x, y]
        })
        .collect()
}

/// A place on the path: `distance, s, l, x, y, theta`. Before its start and beyond its end it goes on straight.
fn along(path: &[PathPoint], distance: f64, origin: Vec2) -> Option<[f64; 6]> {
    let above = path.partition_point(|p| p.distance <= distance);
    let above = above.min(path.len().saturating_sub(1)).max(1);
    let (a, b) = (path.get(above - 1)?, path.get(above)?);
    let share = (distance - a.distance) / (b.distance - a.distance);
    let mix = |from: f64, to: f64| thin::milli(from + (to - from) * share);
    Some([
        thin::milli(distance),
        mix(a.s, b.s),
        thin::offset(mix(a.l, b.l)),
        mix(a.pose.x - origin.x, b.pose.x - origin.x),
        mix(a.pose.y - origin.y, b.pose.y - origin.y),
        fine(a.pose.theta),
    ])
}

fn plan(points: &[TrajectoryPoint], origin: Vec2) -> Vec<f64> {
    every(points, |p| p.t)
        .flat_map(|p| {
            let [x, y, theta] = pose(p.pose, origin);
            [thin::milli(p.t), x, y, theta, thin::centi(p.v)]
        })
        .collect()
}

/// The points at least [`PLAN_SPACING`] apart in time, with the first and the last.
fn every<T>(points: &[T], time: impl Fn(&T) -> f64) -> impl Iterator<Item = &T> {
    let mut next = f64::NEG_INFINITY;
    let last = points.len().saturating_sub(1);
    points.iter().enumerate().filter_map(move |(k, p)| {
        let due = time(p) >= next - 1e-6;
        if due {
            next = time(p) + PLAN_SPACING;
        }
        (due || k == last).then_some(p)
    })
}

fn obstacle(line: &ReferenceLine, obstacle: &Obstacle, origin: Vec2) -> String {
    let footprint = obstacle.footprint();
    let on_line = |p: Vec2| {
        let at = line.to_frenet(p);
        [thin::milli(at.s), thin::offset(at.l)]
    };
    let data = ObstacleData {
        id: obstacle.id.0,
        kind: obstacle.kind,
        fixed: obstacle.is_static,
        at: pose(obstacle.pose, origin),
        speed: [thin::centi(obstacle.velocity.x), thin::centi(obstacle.velocity.y)],
        xy: flat(footprint.vertices().iter().copied(), origin),
        sl: footprint.vertices().iter().flat_map(|p| on_line(*p)).collect(),
        prediction: every(&obstacle.prediction, |p| p.t)
            .flat_map(|p| {
                let ([x, y, theta], [s, l]) = (pose(p.pose, origin), on_line(p.pose.position()));
                [thin::centi(p.t), x, y, theta, s, l]
            })
            .collect(),
    };
    serde_json::to_string(&data).expect("plain data always serialise")
}
