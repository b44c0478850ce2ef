//! A straight two-lane road, an ego that is put anywhere, and obstacles that do as told.
//!
//! The ego's lane runs east, its centre line is `y = 0`, it reaches from `y = -1.75` to `1.75`; the oncoming lane lies
//! left of it, up to `y = 5.25`. Both are 200 m long. Speed limit 10 m/s.

use crate::monitor::{Monitor, Motion, StepView, Traffic};
use crate::verdict::{Ending, Metric, Verdict};
use corridor_decider::decision::{Assessment, Candidate, Decision, Outcome, TrajectoryPoint};
use corridor_decider::frame::{Command, EgoState, Frame, FrameLine, ObstacleId, ObstacleKind};
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2};
use corridor_decider::reference_line::ReferenceLine;
use corridor_decider::road::{Lane, LaneId, LaneKind, LanePoint, RoadMap};
use corridor_decider::tasks::path_bounds::{Borrow, BoundPoint, EdgeCause, Label, LaneType, PathBound};
use corridor_decider::vehicle::VehicleParams;
use corridor_scenarios::Scenario;
use corridor_scenarios::scenario::{Behaviour, EgoStart, Expectation, Obstacle};
use std::f64::consts::PI;
use std::sync::Arc;

/// Physics step, s.
pub(super) const DT: f64 = 0.01;

/// The label of driving in one's own lane.
pub(super) const OWN: Label = Label::Regular {
    borrow: Borrow::None,
    lane: LaneType::Own,
};

fn lane(name: &str, y: f64, eastward: bool) -> Lane {
    let point = |k: u32| {
        let s = f64::from(k) * 0.5;
        LanePoint {
            s,
            x: if eastward { s } else { 200.0 - s },
            y,
            theta: if eastward { 0.0 } else { PI },
            kappa: 0.0,
            left: 1.75,
            right: 1.75,
            road_left: 5.25,
            road_right: 1.75,
            speed_limit: 10.0,
        }
    };
    Lane {
        name: name.to_owned(),
        kind: LaneKind::Driving,
        road: "road".to_owned(),
        junction: None,
        points: (0..=400).map(point).collect(),
        left_marks: Vec::new(),
        right_marks: Vec::new(),
        neighbours: [None; 4],
        predecessors: Vec::new(),
        successors: Vec::new(),
    }
}

/// A scenario on the road with cars at the given poses; the ego starts at `x = 10`.
pub(super) fn scenario(cars: &[Pose], expect: Expectation) -> Scenario {
    let lanes = vec![lane("own", 0.0, true), lane("oncoming", 3.5, false)];
    let map = Arc::new(RoadMap::new(lanes, Vec::new()).unwrap());
    let line = Arc::new(ReferenceLine::along(&map, &[LaneId(0)]).unwrap());
    let obstacles = (0..).zip(cars).map(|(id, pose)| Obstacle {
        id: ObstacleId(id),
        name: format!("car_{id}"),
        kind: ObstacleKind::Car,
        shape: ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), 2.25, 2.25, 0.9),
        behaviour: Behaviour::Parked(*pose),
    });
    Scenario {
        name: "straight".to_owned(),
        description: String::new(),
        seed: 1,
        route: vec![LaneId(0)],
        provider: None,
        target_line: Some(Arc::clone(&line)),
        line,
        ego: EgoStart {
            pose: Pose::new(10.0, 0.0, 0.0),
            speed: 8.0,
        },
        command: Command::Cruise,
        command_time: 0.0,
        cruise_speed: 8.0,
        obstacles: obstacles.collect(),
        vehicle: VehicleParams::default(),
        timeout: 60.0,
        expect,
        map,
    }
}

/// Obstacles with poses and velocities.
pub(super) struct Cars(pub(super) Vec<Motion>);

impl Traffic for Cars {
    fn motion(&self, id: ObstacleId) -> Motion {
        self.0[id.0 as usize]
    }
}

pub(super) fn motion(x: f64, y: f64, theta: f64, v: f64) -> Motion {
    let pose = Pose::new(x, y, theta);
    Motion {
        pose,
        velocity: pose.forward() * v,
    }
}

pub(super) fn ego(x: f64, y: f64, theta: f64, v: f64) -> EgoState {
    EgoState {
        pose: Pose::new(x, y, theta),
        v,
        a: 0.0,
        yaw_rate: 0.0,
        steer: 0.0,
    }
}

/// A monitor and what it is shown.
pub(super) struct Run {
    pub(super) scenario: Scenario,
    pub(super) monitor: Monitor,
    pub(super) time: f64,
}

impl Run {
    pub(super) fn new(scenario: Scenario) -> Self {
        Self {
            monitor: Monitor::new(&scenario),
            scenario,
            time: 0.0,
        }
    }

    /// One physics step that ends with the ego and the cars as given.
    pub(super) fn step(&mut self, ego: EgoState, cars: Vec<Motion>) {
        self.time += DT;
        let footprint = self.scenario.vehicle.footprint(ego.pose);
        let bodies: Vec<(ObstacleId, ConvexPolygon)> = self
            .scenario
            .obstacles
            .iter()
            .zip(&cars)
            .map(|(o, motion)| (o.id, o.shape.at(motion.pose)))
            .collect();
        let overlapping: Vec<ObstacleId> = bodies
            .iter()
            .filter(|(_, body)| body.overlaps(&footprint))
            .map(|(id, _)| *id)
            .collect();
        let clearance = bodies
            .iter()
            .map(|(id, body)| (body.distance(&footprint), *id))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        self.monitor.step(&StepView {
            time: self.time,
            ego: &ego,
            footprint: &footprint,
            clearance,
            overlapping: &overlapping,
            traffic: &Cars(cars),
        });
    }

    /// Steps until `end`, the ego and the cars as functions of time.
    pub(super) fn drive(
        &mut self,
        end: f64,
        ego: impl Fn(f64) -> EgoState,
        cars: impl Fn(f64) -> Vec<Motion>,
    ) {
        while self.time < end - DT / 2.0 && self.monitor.is_over().is_none() {
            let t = self.time + DT;
            self.step(ego(t), cars(t));
        }
    }

    pub(super) fn tick(&mut self, decision: &Decision) {
        let frame = self.frame();
        self.monitor.tick(&frame, decision);
    }

    pub(super) fn frame(&self) -> Frame {
        let line = Arc::clone(&self.scenario.line);
        Frame {
            tick: 0,
            time: self.time,
            ego: ego(0.0, 0.0, 0.0, 0.0),
            command: self.scenario.command,
            cruise_speed: 8.0,
            lines: vec![FrameLine {
                line,
                is_change_lane: false,
            }],
            obstacles: Vec::new(),
        }
    }

    pub(super) fn verdict(&self) -> Verdict {
        self.monitor.verdict()
    }

    pub(super) fn metric(&self, name: &str) -> Metric {
        let metrics = self.verdict().metrics;
        let found = metrics.into_iter().find(|m| m.name == name);
        found.unwrap_or_else(|| panic!("no metric `{name}`"))
    }

    /// Value of a metric that was measured.
    pub(super) fn value(&self, name: &str) -> f64 {
        self.metric(name).value.unwrap()
    }

    pub(super) fn ending(&self) -> Option<Ending> {
        self.monitor.is_over()
    }
}

/// A bound from `s = 0` to 100 with the same limits everywhere.
pub(super) fn bound(label: Label, l_min: f64, l_max: f64) -> PathBound {
    let point = |k: u32| BoundPoint {
        s: f64::from(k) * 0.5,
        l_min,
        l_max,
        right: EdgeCause::LaneLine,
        left: EdgeCause::LaneLine,
    };
    PathBound {
        label,
        delta_s: 0.5,
        points: (0..=200).map(point).collect(),
        blocked_by: None,
        padding: 0,
    }
}

/// A decision for one bound, with a straight trajectory along `y = 0` at 8 m/s from `x`.
pub(super) fn decision(bound: PathBound, x: f64) -> Decision {
    let point = |k: u32| {
        let t = f64::from(k) * 0.1;
        TrajectoryPoint {
            t,
            distance: 8.0 * t,
            pose: Pose::new(x + 8.0 * t, 0.0, 0.0),
            kappa: 0.0,
            v: 8.0,
            a: 0.0,
        }
    };
    Decision {
        line: 0,
        candidates: vec![Candidate {
            bound,
            assessment: Assessment::Chosen,
        }],
        chosen: Some(0),
        path: Vec::new(),
        trajectory: (0..30).map(point).collect(),
        stop: None,
        outcome: Outcome::Normal,
        fallback: None,
        tasks: Vec::new(),
        pull_over: None,
    }
}

/// The same situation seen in a mirror along the ego's lane: `y` and headings change sign.
pub(super) fn mirrored(motion: Motion) -> Motion {
    Motion {
        pose: Pose::new(motion.pose.x, -motion.pose.y, -motion.pose.theta),
        velocity: Vec2::new(motion.velocity.x, -motion.velocity.y),
    }
}
