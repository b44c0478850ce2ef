//! A made-up run to test with: along a bending road past a parked van, behind which somebody waits, with
//! oncoming traffic. Nothing is decided or simulated here; everything is a formula of time.

use super::record::{Controls, Event, EventKind, Header, TickRecord};
use super::{FORMAT, Trace};
use crate::verdict::{Ending, Metric, Verdict};
use corridor_decider::decision::{
    Assessment, Candidate, Decision, Outcome, PathPoint, PullOverTarget, Rejection, Stop, StopCause,
    TrajectoryPoint,
};
use corridor_decider::frame::{Command, EgoState, Frame, Obstacle, ObstacleId, ObstacleKind, PredictedPose};
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2};
use corridor_decider::reference_line::{LineQuery, ReferenceLine, SlPoint};
use corridor_decider::road::{BoundaryType, Lane, LaneId, LaneKind, LanePoint, Mark, RoadMap};
use corridor_decider::tasks::path_bounds::{Borrow, BoundPoint, EdgeCause, Label, LaneType, PathBound};
use corridor_decider::vehicle::VehicleParams;
use std::sync::Arc;

const TICK: f64 = 0.1;
const LENGTH: f64 = 300.0;
const VAN: ObstacleId = ObstacleId(0);
const ONCOMING: ObstacleId = ObstacleId(1);
const VAN_S: f64 = 70.0;
/// Left side of the van plus half the car and the buffer.
const BESIDE_VAN: f64 = 0.7;
/// Where the run's path keeps to at the van.
const PASSING_L: f64 = 1.1;
const STOP_S: f64 = 170.0;

/// A trace of `ticks` ticks with `obstacles` obstacles, at least three.
pub(crate) fn trace(ticks: u32, obstacles: u32) -> Trace {
    let lanes = lanes();
    let outlines = lanes.iter().map(super::outline::outline).collect();
    let map = RoadMap::new(lanes, Vec::new()).unwrap();
    let line = Arc::new(ReferenceLine::along(&map, &[LaneId(0)]).unwrap());
    let names = ["van", "oncoming", "someone </script> on foot"].map(str::to_owned);
    let more = (3..obstacles).map(|k| format!("parked_{k}"));
    let header = Header {
        format: FORMAT,
        build: "0.1.0-test".to_owned(),
        scenario: "synthetic <b>& </script><script>alert(1)</script>".to_owned(),
        source: "# past a van\n[[parked]]\nname = \"van\" # </script> <!-- & -->\n".to_owned(),
        map: "no map".to_owned(),
        seed: 7,
        overrides: vec!["config.max_deceleration=-4".to_owned()],
        vehicle: VehicleParams::default(),
        obstacle_names: names.into_iter().chain(more).collect(),
        lines: vec![line.clone()],
        lanes: outlines,
        tick: TICK,
    };
    let ticks = (0..ticks).map(|k| tick(&line, k, obstacles)).collect();
    Trace {
        header,
        ticks,
        verdict: Some(verdict()),
        truncated: false,
    }
}

/// The road: ours, the oncoming lane, parking bays on the right, sidewalks.
pub(crate) fn lanes() -> Vec<Lane> {
    let lane = |name: &str, kind, l: f64, width: f64, reverse: bool| {
        let point = |k: u32| {
            let s = f64::from(k) * 0.5;
            let along = if reverse { LENGTH - s } else { s };
            let pose = road(along, l);
            LanePoint {
                s,
                x: pose.x,
                y: pose.y,
                theta: if reverse {
                    pose.theta - std::f64::consts::PI
                } else {
                    pose.theta
                },
                kappa: 0.0,
                left: width / 2.0,
                right: width / 2.0,
                road_left: 5.25,
                road_right: 4.05,
                speed_limit: 13.9,
            }
        };
        Lane {
            name: name.to_owned(),
            kind,
            road: "1".to_owned(),
            junction: None,
            points: (0..=600).map(point).collect(),
            left_marks: vec![
                Mark {
                    s: 0.0,
                    kind: BoundaryType::DottedYellow,
                },
                Mark {
                    s: 120.0,
                    kind: BoundaryType::DoubleYellow,
                },
            ],
            right_marks: vec![Mark {
                s: 0.0,
                kind: BoundaryType::SolidWhite,
            }],
            neighbours: [None; 4],
            predecessors: Vec::new(),
            successors: Vec::new(),
        }
    };
    vec![
        lane("1_0_-1", LaneKind::Driving, 0.0, 3.5, false),
        lane("1_0_1", LaneKind::Driving, 3.5, 3.5, true),
        lane("1_0_-2", LaneKind::Parking, -2.9, 2.3, false),
        lane("1_0_-3", LaneKind::Sidewalk, -5.05, 2.0, false),
        lane("1_0_2", LaneKind::Sidewalk, 6.25, 2.0, true),
    ]
}

/// A gentle bend: heading is a sine of the station, integrated in closed form to first order.
fn road(s: f64, l: f64) -> Pose {
    let (sin, cos) = libm::sincos(s / 60.0);
    let theta = 0.25 * sin;
    let (st, ct) = libm::sincos(theta);
    let (x, y) = (1000.0 + s, 500.0 + 15.0 * (1.0 - cos));
    Pose::new(x - l * st, y + l * ct, theta)
}

/// Station and speed of the ego at time `t`: 9 m/s, then braking to a stop at [`STOP_S`].
fn motion(t: f64) -> (f64, f64, f64) {
    let (v, braking) = (9.0, 1.5);
    let brake_at = (STOP_S - 20.0 - v * v / (2.0 * braking)) / v;
    let braked = (t - brake_at).clamp(0.0, v / braking);
    let s = 20.0 + v * t.min(brake_at) + v * braked - 0.5 * braking * braked * braked;
    let a = if braked > 0.0 && braked < v / braking {
        -braking
    } else {
        0.0
    };
    (s, v - braking * braked, a)
}

/// Offset of the path at station `s`: around the van, then to the edge.
fn offset(s: f64) -> f64 {
    let step = |x: f64| {
        let t = x.clamp(0.0, 1.0);
        t * t * t * (10.0 - 15.0 * t + 6.0 * t * t)
    };
    PASSING_L * (step((s - 38.0) / 25.0) - step((s - 80.0) / 25.0)) - 2.4 * step((s - 130.0) / 35.0)
}

fn pose_at(line: &ReferenceLine, s: f64) -> Pose {
    let position = line.to_cartesian(SlPoint { s, l: offset(s) });
    let slope = libm::atan((offset(s + 0.05) - offset(s - 0.05)) / 0.1);
    Pose::new(position.x, position.y, line.point(s).theta + slope)
}

fn tick(line: &ReferenceLine, k: u32, obstacles: u32) -> TickRecord {
    let time = f64::from(k) * TICK;
    let ego = |t: f64| {
        let (s, v, a) = motion(t);
        let pose = pose_at(line, s);
        EgoState {
            pose,
            v,
            a,
            yaw_rate: 0.0,
            steer: 0.0,
        }
    };
    let frame = Frame {
        tick: k,
        time,
        ego: ego(time),
        command: if time < 8.0 {
            Command::Cruise
        } else {
            Command::PullOver(line.to_cartesian(SlPoint { s: STOP_S, l: -2.4 }))
        },
        cruise_speed: 10.0,
        lines: Vec::new(),
        obstacles: (0..obstacles).map(|id| obstacle(line, id, time)).collect(),
    };
    let (s, v, _) = motion(time);
    TickRecord {
        decision: decision(line, s, v, time),
        lines: vec![(0, false)],
        new_lines: Vec::new(),
        controls: Controls {
            steer: 0.01,
            acceleration: frame.ego.a,
        },
        ego: ego(time + TICK),
        hash: format!("{:016x}", u64::from(k).wrapping_mul(0x9e37_79b9_7f4a_7c15)),
        clearance: Some(((VAN_S - s).abs().max(0.3), VAN)),
        events: events(k),
        frame,
    }
}

fn events(k: u32) -> Vec<Event> {
    let event = |kind, text: &str| {
        vec![Event {
            time: f64::from(k) * TICK,
            kind,
            text: text.to_owned(),
        }]
    };
    match k {
        0 => event(EventKind::LabelChanged, "regular/self/"),
        12 => event(
            EventKind::LabelChanged,
            "regular/self/ -> regular/left/reverse around `van`",
        ),
        80 => event(EventKind::PullOverTarget, "pull over at s 170.0 </script>"),
        _ => Vec::new(),
    }
}

fn obstacle(line: &ReferenceLine, id: u32, time: f64) -> Obstacle {
    let place = |s: f64, l: f64, turn: f64| {
        let p = line.to_cartesian(SlPoint { s, l });
        Pose::new(p.x, p.y, line.point(s).theta + turn)
    };
    let body = |front: f64, half: f64| ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), front, front, half);
    let standing = |kind, pose, shape| Obstacle {
        id: ObstacleId(id),
        kind,
        pose,
        shape,
        velocity: Vec2::new(0.0, 0.0),
        is_static: true,
        prediction: Vec::new(),
    };
    match id {
        0 => standing(ObstacleKind::Truck, place(VAN_S, -1.7, 0.0), body(3.0, 1.0)),
        1 => {
            let turn = std::f64::consts::PI;
            let at = |t: f64| place(260.0 - 12.0 * t, 3.5, turn);
            let pose = at(time);
            Obstacle {
                velocity: pose.forward() * 12.0,
                is_static: false,
                prediction: (0..=40)
                    .map(|k| f64::from(k) * 0.2)
                    .map(|t| PredictedPose {
                        t,
                        pose: at(time + t),
                    })
                    .collect(),
                ..standing(ObstacleKind::Car, pose, body(2.3, 0.9))
            }
        }
        2 => standing(ObstacleKind::Pedestrian, place(82.0, -4.9, 1.2), body(0.3, 0.3)),
        _ => standing(
            ObstacleKind::Car,
            place(
                95.0 + 6.0 * f64::from(id),
                if id.is_multiple_of(2) { -3.0 } else { 6.5 },
                0.02,
            ),
            body(2.2, 0.9),
        ),
    }
}

fn bound(label: Label, s: f64, edges: impl Fn(f64) -> BoundPoint) -> PathBound {
    PathBound {
        label,
        delta_s: 0.5,
        points: (0..200).map(|k| edges(s + f64::from(k) * 0.5)).collect(),
        blocked_by: None,
        padding: 0,
    }
}

fn decision(line: &ReferenceLine, s: f64, v: f64, time: f64) -> Decision {
    let beside_van = |x: f64| (x - VAN_S).abs() < 5.0;
    let edges = |s: f64, right: f64, left: f64, cause: EdgeCause| BoundPoint {
        s,
        l_min: if beside_van(s) { BESIDE_VAN } else { right },
        l_max: left,
        right: if beside_van(s) {
            EdgeCause::Obstacle(VAN)
        } else {
            EdgeCause::LaneLine
        },
        left: cause,
    };
    let own = Label::Regular {
        borrow: Borrow::None,
        lane: LaneType::Own,
    };
    let reverse = Label::Regular {
        borrow: Borrow::Left,
        lane: LaneType::Reverse,
    };
    let fallback = bound(Label::Fallback, s, |s| BoundPoint {
        s,
        l_min: -3.0,
        l_max: 4.2,
        right: EdgeCause::RoadEdge,
        left: if s < 40.0 {
            EdgeCause::Ego
        } else {
            EdgeCause::RoadEdge
        },
    });
    let mut narrow = bound(own, s, |s| edges(s, -0.695, 0.695, EdgeCause::LaneLine));
    let last = narrow.points.iter().position(|p| p.l_min > p.l_max);
    if let Some(last) = last {
        narrow.points.truncate(last);
        narrow.blocked_by = Some(VAN);
    }
    let wide = bound(reverse, s, |s| edges(s, -0.695, 4.1, EdgeCause::BorrowedLane));
    let pull_over = bound(Label::PullOver, s, |s| {
        edges(s, -2.95, 0.695, EdgeCause::LaneLine)
    });
    let (chosen, narrow_verdict) = match last {
        Some(0) => (2, Assessment::NoPath(Rejection::TooShort)),
        Some(_) => (2, Assessment::NoPath(Rejection::Touches(VAN))),
        None if time >= 8.0 => (3, Assessment::Drivable { reach: 99.5 }),
        None => (1, Assessment::Chosen),
    };
    let assess = |k: usize, other| if k == chosen { Assessment::Chosen } else { other };
    let mut candidates = vec![
        Candidate {
            bound: fallback,
            assessment: Assessment::NotTried,
        },
        Candidate {
            bound: narrow,
            assessment: narrow_verdict,
        },
        Candidate {
            bound: wide,
            assessment: assess(2, Assessment::Occupied(ONCOMING)),
        },
    ];
    if time >= 8.0 {
        candidates.push(Candidate {
            bound: pull_over,
            assessment: assess(3, Assessment::NotTried),
        });
    }
    let path = path(line, s);
    Decision {
        line: 0,
        chosen: Some(chosen),
        candidates,
        trajectory: trajectory(&path, v, time),
        path,
        stop: (time >= 8.0).then_some(Stop {
            distance: STOP_S - s,
            cause: StopCause::PullOver,
        }),
        outcome: Outcome::Normal,
        fallback: None,
        tasks: Vec::new(),
        pull_over: (time >= 8.0).then(|| PullOverTarget {
            position: line.to_cartesian(SlPoint { s: STOP_S, l: -2.4 }),
            theta: line.point(STOP_S).theta,
        }),
    }
}

fn path(line: &ReferenceLine, from: f64) -> Vec<PathPoint> {
    let point = |k: u32| {
        let s = from + f64::from(k) * 0.5;
        let pose = pose_at(line, s);
        PathPoint {
            distance: s - from,
            s,
            l: offset(s),
            pose,
            kappa: line.point(s).kappa,
        }
    };
    (0..200).map(point).collect()
}

fn trajectory(path: &[PathPoint], v: f64, time: f64) -> Vec<TrajectoryPoint> {
    let start = motion(time).0;
    let point = |k: u32| {
        let t = f64::from(k) * 0.1;
        let (s, speed, a) = motion(time + t);
        let at = path
            .partition_point(|p| p.distance < s - start)
            .min(path.len() - 1);
        TrajectoryPoint {
            t,
            distance: s - start,
            pose: path[at].pose,
            kappa: path[at].kappa,
            v: if k == 0 { v } else { speed },
            a,
        }
    };
    (0..=80).map(point).collect()
}

fn verdict() -> Verdict {
    let metric = |name: &str, value: Option<f64>, threshold: Option<f64>, pass, gate| Metric {
        name: name.to_owned(),
        value,
        threshold,
        pass,
        gate,
        worst_t: value.map(|_| 5.5),
        worst_obstacle: (name.contains("cl")).then(|| "van".to_owned()),
    };
    Verdict {
        pass: false,
        ending: Ending::PulledOver,
        summary: "stands at the road's edge, but came too near to `van` </script>".to_owned(),
        duration: 21.0,
        metrics: vec![
            metric("no_collision", Some(0.0), Some(0.0), true, true),
            metric("drivable_area", Some(0.12), Some(0.3), true, true),
            metric("min_clearance", Some(0.31), Some(0.4), false, false),
            metric("ttc", None, Some(0.95), true, false),
            metric("progress", Some(0.97), None, true, false),
        ],
        collisions: Vec::new(),
        outcomes: vec![("normal".to_owned(), 210)],
        fallbacks: Vec::new(),
        signature: None,
        digest: "0123456789abcdef".to_owned(),
    }
}
