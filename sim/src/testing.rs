//! Small roads and scenarios for tests.

use corridor_decider::frame::{Command, ObstacleId, ObstacleKind};
use corridor_decider::geometry::{ConvexPolygon, Pose};
use corridor_decider::reference_line::ReferenceLine;
use corridor_decider::road::{Lane, LaneId, LaneKind, LanePoint, RoadMap};
use corridor_decider::vehicle::VehicleParams;
use corridor_scenarios::Scenario;
use corridor_scenarios::scenario::{AlongLine, Behaviour, EgoStart, Expectation, Obstacle};
use std::sync::Arc;

/// A single lane of constant curvature from `start`, half a metre between samples.
pub(crate) fn road(start: Pose, kappa: f64, length: f64) -> Arc<RoadMap> {
    let count = (length / 0.5).round();
    let point = |k: f64| {
        let s = 0.5 * k;
        let turn = kappa * s;
        let (x, y) = if kappa == 0.0 {
            (s, 0.0)
        } else {
            (libm::sin(turn) / kappa, (1.0 - libm::cos(turn)) / kappa)
        };
        let at = start.to_world(corridor_decider::geometry::Vec2::new(x, y));
        LanePoint {
            s,
            x: at.x,
            y: at.y,
            theta: corridor_decider::geometry::angle::wrap(start.theta + turn),
            kappa,
            left: 1.75,
            right: 1.75,
            road_left: 5.25,
            road_right: 1.75,
            speed_limit: 14.0,
        }
    };
    let mut points = Vec::new();
    let mut k = 0.0;
    while k <= count {
        points.push(point(k));
        k += 1.0;
    }
    let lane = Lane {
        name: "lane".to_owned(),
        kind: LaneKind::Driving,
        road: "road".to_owned(),
        junction: None,
        points,
        left_marks: Vec::new(),
        right_marks: Vec::new(),
        neighbours: [None; 4],
        predecessors: Vec::new(),
        successors: Vec::new(),
    };
    Arc::new(RoadMap::new(vec![lane], Vec::new()).unwrap())
}

pub(crate) fn line(map: &RoadMap) -> Arc<ReferenceLine> {
    Arc::new(ReferenceLine::along(map, &[LaneId(0)]).unwrap())
}

/// A straight road of 600 m with the ego at `pose` and these obstacles.
pub(crate) fn scenario(pose: Pose, speed: f64, behaviours: Vec<Behaviour>) -> Scenario {
    let map = road(Pose::new(0.0, 0.0, 0.0), 0.0, 600.0);
    let line = line(&map);
    Scenario {
        name: "test".to_owned(),
        description: String::new(),
        seed: 0,
        map,
        route: vec![LaneId(0)],
        provider: None,
        line,
        target_line: None,
        ego: EgoStart { pose, speed },
        command: Command::Cruise,
        command_time: 0.0,
        cruise_speed: 10.0,
        obstacles: (0_u32..)
            .zip(behaviours)
            .map(|(id, behaviour)| car(id, behaviour))
            .collect(),
        vehicle: VehicleParams::default(),
        timeout: 60.0,
        expect: Expectation::Progress(100.0),
    }
}

/// A car of 4.6 m by 1.9 m.
pub(crate) fn car(id: u32, behaviour: Behaviour) -> Obstacle {
    Obstacle {
        id: ObstacleId(id),
        name: format!("car {id}"),
        kind: ObstacleKind::Car,
        shape: ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), 2.3, 2.3, 0.95),
        behaviour,
    }
}

pub(crate) fn along(line: &Arc<ReferenceLine>, s: f64, l: f64, speed: f64) -> AlongLine {
    AlongLine {
        line: Arc::clone(line),
        s,
        l,
        speed,
    }
}
