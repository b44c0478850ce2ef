//! What one tick sees and what it decides survive a file, bit for bit: only so can any tick of any trace be decided
//! again alone.

use corridor_decider::config::Config;
use corridor_decider::context::Context;
use corridor_decider::decision::{Decision, TrajectoryPoint};
use corridor_decider::frame::{
    Command, EgoState, Frame, FrameLine, Obstacle, ObstacleId, ObstacleKind, PredictedPose,
};
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2};
use corridor_decider::planner::Planner;
use corridor_decider::reference_line::{LinePoint, LineSample, ReferenceLine};
use corridor_decider::road::{BoundaryType, LaneId, Side};
use corridor_decider::vehicle::VehicleParams;
use proptest::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
use proptest::prelude::*;
use std::sync::Arc;

/// Any finite number, the smallest and both zeros included.
fn number() -> impl Strategy<Value = f64> {
    NORMAL | SUBNORMAL | ZERO | POSITIVE | NEGATIVE
}

fn pose() -> impl Strategy<Value = Pose> {
    (number(), number(), number()).prop_map(|(x, y, theta)| Pose::new(x, y, theta))
}

fn side() -> impl Strategy<Value = Side> {
    prop_oneof![Just(Side::Left), Just(Side::Right)]
}

fn command() -> impl Strategy<Value = Command> {
    prop_oneof![
        Just(Command::Cruise),
        side().prop_map(Command::ChangeLane),
        (number(), number()).prop_map(|(x, y)| Command::PullOver(Vec2::new(x, y))),
        Just(Command::EmergencyPullOver),
    ]
}

fn sample() -> impl Strategy<Value = (f64, LineSample)> {
    use BoundaryType as B;
    let mark = || prop::sample::select(vec![B::Unknown, B::DottedYellow, B::SolidWhite, B::Curb]);
    let point = (number(), number(), number(), number());
    let pair = || (number(), number());
    let neighbours = prop::array::uniform4(prop::option::of(number()));
    let rest = (any::<u32>(), any::<bool>(), prop::option::of(number()));
    (
        0.11..9.0_f64,
        point,
        pair(),
        pair(),
        number(),
        (mark(), mark()),
        neighbours,
        rest,
    )
        .prop_map(
            |(step, (x, y, theta, kappa), lane_width, road_width, offset, marks, neighbours, rest)| {
                let sample = LineSample {
                    s: 0.0,
                    point: LinePoint { x, y, theta, kappa },
                    lane: LaneId(rest.0),
                    offset,
                    lane_width,
                    road_width,
                    marks,
                    neighbours,
                    in_junction: rest.1,
                    speed_limit: rest.2,
                };
                (step, sample)
            },
        )
}

fn line() -> impl Strategy<Value = FrameLine> {
    (prop::collection::vec(sample(), 2..80), any::<bool>()).prop_map(|(steps, is_change_lane)| {
        let mut s = 0.0;
        let place = |(step, sample): (f64, LineSample)| {
            let here = s;
            s += step;
            LineSample { s: here, ..sample }
        };
        let samples: Vec<LineSample> = steps.into_iter().map(place).collect();
        FrameLine {
            line: Arc::new(ReferenceLine::from(samples)),
            is_change_lane,
        }
    })
}

fn obstacle() -> impl Strategy<Value = Obstacle> {
    let kind = prop::sample::select(vec![
        ObstacleKind::Car,
        ObstacleKind::Truck,
        ObstacleKind::Bicycle,
        ObstacleKind::Pedestrian,
        ObstacleKind::Cone,
        ObstacleKind::Other,
    ]);
    let shape = (0.1..9.0_f64, 0.1..9.0_f64, 0.1..3.0_f64).prop_map(|(front, back, half)| {
        ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.1), front, back, half)
    });
    let prediction = prop::collection::vec((number(), pose()), 0..5);
    let velocity = (number(), number());
    (
        any::<u32>(),
        kind,
        pose(),
        shape,
        velocity,
        any::<bool>(),
        prediction,
    )
        .prop_map(
            |(id, kind, pose, shape, (vx, vy), is_static, prediction)| Obstacle {
                id: ObstacleId(id),
                kind,
                pose,
                shape,
                velocity: Vec2::new(vx, vy),
                is_static,
                prediction: prediction
                    .into_iter()
                    .map(|(t, pose)| PredictedPose { t, pose })
                    .collect(),
            },
        )
}

fn frame() -> impl Strategy<Value = Frame> {
    let ego =
        (pose(), prop::array::uniform4(number())).prop_map(|(pose, [v, a, yaw_rate, steer])| EgoState {
            pose,
            v,
            a,
            yaw_rate,
            steer,
        });
    let lines = prop::collection::vec(line(), 0..3);
    let obstacles = prop::collection::vec(obstacle(), 0..5);
    (any::<u32>(), number(), ego, command(), number(), lines, obstacles).prop_map(
        |(tick, time, ego, command, cruise_speed, lines, obstacles)| Frame {
            tick,
            time,
            ego,
            command,
            cruise_speed,
            lines,
            obstacles,
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn a_frame_survives_a_file(frame in frame()) {
        let written = serde_json::to_string(&frame).unwrap();
        let read: Frame = serde_json::from_str(&written).unwrap();
        prop_assert_eq!(&read, &frame);
        // Equal is not yet the same bits: there are two zeros.
        prop_assert_eq!(serde_json::to_string(&read).unwrap(), written);
    }
}

/// A straight road of 200 m with an oncoming lane.
fn road() -> FrameLine {
    let sample = |k: u32| LineSample {
        s: f64::from(k) * 0.5,
        point: LinePoint {
            x: f64::from(k) * 0.5,
            y: 0.0,
            theta: 0.0,
            kappa: 0.0,
        },
        lane: LaneId(0),
        offset: 0.0,
        lane_width: (1.75, 1.75),
        road_width: (5.25, 2.25),
        marks: (BoundaryType::DottedWhite, BoundaryType::SolidWhite),
        neighbours: [None, Some(3.5), None, None],
        in_junction: false,
        speed_limit: None,
    };
    FrameLine {
        line: Arc::new(ReferenceLine::from((0..=400).map(sample).collect::<Vec<_>>())),
        is_change_lane: false,
    }
}

fn driving(command: Command, parked_at: f64) -> Frame {
    let car = Obstacle {
        id: ObstacleId(3),
        kind: ObstacleKind::Car,
        pose: Pose::new(parked_at, -0.9, 0.2),
        shape: ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), 2.4, 2.4, 0.95),
        velocity: Vec2::new(0.0, 0.0),
        is_static: true,
        prediction: Vec::new(),
    };
    Frame {
        tick: 0,
        time: 0.0,
        ego: EgoState {
            pose: Pose::new(30.0, 0.1, 0.01),
            v: 8.0,
            a: 0.0,
            yaw_rate: 0.0,
            steer: 0.0,
        },
        command,
        cruise_speed: 10.0,
        lines: vec![road()],
        obstacles: vec![car],
    }
}

/// A tick read back from a file is decided as it was, and the decision survives a file too.
#[test]
fn a_tick_is_decided_again_from_its_file() {
    let planner = Planner::new(Config::default(), VehicleParams::default());
    let commands = [
        Command::Cruise,
        Command::PullOver(Vec2::new(100.0, 0.0)),
        Command::EmergencyPullOver,
    ];
    for command in commands {
        for parked_at in [45.0, 60.0, 90.0, 400.0] {
            let frame = driving(command, parked_at);
            let written = serde_json::to_string(&frame).unwrap();
            let read: Frame = serde_json::from_str(&written).unwrap();
            let decide = |frame: &Frame| planner.decide(frame, &mut Context::default());
            let decision = decide(&frame);
            assert_eq!(decide(&read), decision);
            assert!(!decision.candidates.is_empty() && !decision.trajectory.is_empty());
            let written = serde_json::to_string(&decision).unwrap();
            let read: Decision = serde_json::from_str(&written).unwrap();
            assert_eq!(read, decision);
            assert_eq!(serde_json::to_string(&read).unwrap(), written);
        }
    }
}

/// A decision that went wrong can be written, too.
#[test]
fn numbers_that_are_none_survive_in_a_decision() {
    let planner = Planner::new(Config::default(), VehicleParams::default());
    let mut decision = planner.decide(&driving(Command::Cruise, 60.0), &mut Context::default());
    decision.trajectory.push(TrajectoryPoint {
        t: f64::NAN,
        distance: f64::INFINITY,
        pose: Pose::new(f64::NEG_INFINITY, 0.0, 0.0),
        kappa: f64::NAN,
        v: 1.0,
        a: -0.0,
    });
    decision.candidates[0].bound.points[0].l_min = f64::NAN;
    decision.candidates[0].bound.points[1].l_max = f64::INFINITY;
    let written = serde_json::to_string(&decision).unwrap();
    let read: Decision = serde_json::from_str(&written).unwrap();
    assert_eq!(serde_json::to_string(&read).unwrap(), written);
    let last = read.trajectory.last().unwrap();
    assert!(last.t.is_nan() && last.distance.is_infinite() && last.a.is_sign_negative());
    assert!(read.candidates[0].bound.points[0].l_min.is_nan());
}

/// A file that says something impossible is an error, not a panic later.
#[test]
fn broken_files_are_refused() {
    let written = serde_json::to_value(driving(Command::Cruise, 60.0)).unwrap();
    let refused = |change: &dyn Fn(&mut serde_json::Value)| {
        let mut value = written.clone();
        change(&mut value);
        serde_json::from_value::<Frame>(value).unwrap_err().to_string()
    };
    let no_line = refused(&|value| value["lines"][0]["line"] = serde_json::json!([]));
    assert!(no_line.contains("two points"), "{no_line}");
    let backwards = refused(&|value| value["lines"][0]["line"][7]["s"] = 3.0.into());
    assert!(backwards.contains("cross-section 7"), "{backwards}");
    let no_number = refused(&|value| value["lines"][0]["line"][7]["point"]["x"] = serde_json::Value::Null);
    assert!(no_number.contains("null"), "{no_number}");
    let no_body = refused(&|value| value["obstacles"][0]["shape"] = serde_json::json!([[0.0, 0.0]]));
    assert!(no_body.contains("outline of 1 points"), "{no_body}");
}

proptest! {
    /// Frames of wild numbers are decided, tick after tick, without a panic.
    #[test]
    fn wild_frames_are_decided(frames in prop::collection::vec(frame(), 3), good in any::<bool>()) {
        let planner = Planner::new(Config::default(), VehicleParams::default());
        let mut context = Context::default();
        for mut frame in frames {
            if good {
                // A proper road and ego among wild obstacles.
                let plain = driving(Command::Cruise, 60.0);
                frame.lines = plain.lines;
                (frame.ego, frame.time) = (plain.ego, plain.time);
            }
            let _ = planner.decide(&frame, &mut context);
        }
    }
}
