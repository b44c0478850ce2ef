//! Scenes for tests: an ego at station 20 of a straight line, and what stands on it.

use super::path::Path;
use super::scene::Scene;
use super::start_point::start_point;
use crate::config::Config;
use crate::decision::PathPoint;
use crate::frame::{Command, EgoState, Frame, FrameLine, Obstacle, ObstacleId, ObstacleKind};
use crate::geometry::{ConvexPolygon, Pose, Vec2};
use crate::reference_line::{ReferenceLine, testing};
use crate::vehicle::VehicleParams;
use std::sync::Arc;

/// Station of the ego.
pub(crate) const EGO_S: f64 = 20.0;

/// What a scene is seen from.
pub(crate) struct Stage {
    pub(crate) frame: Frame,
    pub(crate) config: Config,
    pub(crate) vehicle: VehicleParams,
}

impl Stage {
    /// A line of this length that is in a junction from a station on.
    pub(crate) fn new(length: f64, junction_from: f64) -> Self {
        let mut samples = testing::line(length, |_| 0.0).samples().to_vec();
        for sample in &mut samples {
            sample.in_junction = sample.s >= junction_from;
        }
        let line = FrameLine {
            line: Arc::new(ReferenceLine::from(samples)),
            is_change_lane: false,
        };
        let ego = EgoState {
            pose: Pose::new(EGO_S, 0.0, 0.0),
            v: 3.0,
            a: 0.0,
            yaw_rate: 0.0,
            steer: 0.0,
        };
        let frame = Frame {
            tick: 0,
            time: 0.0,
            ego,
            command: Command::Cruise,
            cruise_speed: 10.0,
            lines: vec![line],
            obstacles: Vec::new(),
        };
        Self {
            frame,
            config: Config::default(),
            vehicle: VehicleParams::default(),
        }
    }

    /// Puts a car of 4 m with its middle at this station on the line.
    pub(crate) fn park(&mut self, s: f64) -> ObstacleId {
        let id = ObstacleId(u32::try_from(self.frame.obstacles.len()).expect("a scene is small"));
        self.frame.obstacles.push(Obstacle {
            id,
            kind: ObstacleKind::Car,
            pose: Pose::new(s, 0.0, 0.0),
            shape: ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), 2.0, 2.0, 0.9),
            velocity: Vec2::zeros(),
            is_static: true,
            prediction: Vec::new(),
        });
        id
    }

    /// The scene along the first line.
    pub(crate) fn scene(&self) -> Scene<'_> {
        let start = start_point(&self.frame, None);
        Scene::new(&self.frame, 0, &self.vehicle, &self.config, start)
    }
}

/// A path straight on from the ego, with a point for every metre.
pub(crate) fn straight_path(length: u32) -> Path {
    let point = |k: u32| PathPoint {
        s: EGO_S + f64::from(k),
        l: 0.0,
        distance: f64::from(k),
        pose: Pose::new(EGO_S + f64::from(k), 0.0, 0.0),
        kappa: 0.0,
    };
    Path {
        points: (0..=length).map(point).collect(),
        blocked_by: None,
        leads_to_goal: true,
        is_reused: false,
    }
}
