//! What to do in a file without a planning problem: cruise along its longest lane, and come to no harm.

use super::remarks::Remarks;
use super::route::Step;
use super::scenario::Road;
use super::{CommonRoad, obstacles, vehicle};
use crate::import::ImportError;
use crate::scenario::{EgoStart, Expectation, Scenario};
use corridor_decider::frame::Command;
use corridor_decider::geometry::Pose;
use corridor_decider::reference_line::LineQuery;
use corridor_decider::road::{Lane, LaneId, MapError};

/// How long to cruise, s.
const TIMEOUT: f64 = 40.0;

/// Speed where the road names none, m/s: 50 km/h.
const SPEED: f64 = 13.9;

/// Distance between places that are tried for the start, m.
const STEP: f64 = 5.0;

/// Room wanted around the ego at the start, m.
const ROOM: f64 = 5.0;

/// Length of lane that must be left beyond the end of the way, m.
const BEYOND: f64 = 30.0;

/// Share of what cruising reaches in the time that is asked for; the rest is for slowing down and waiting.
const SHARE: f64 = 0.5;

impl CommonRoad {
    pub(super) fn cruise(
        &self,
        remarks: &mut Remarks,
        warnings: &mut Vec<String>,
    ) -> Result<Scenario, ImportError> {
        let obstacles = obstacles::obstacles(&self.file, None, remarks);
        let vehicle = vehicle();
        let (id, lane) = self.longest_lane()?;
        let is_free = |pose: &Pose| {
            let footprint = vehicle.footprint(*pose);
            let outlines = obstacles.iter().filter_map(|o| Some(o.shape.at(o.start()?)));
            outlines
                .into_iter()
                .all(|outline| outline.distance(&footprint) >= ROOM)
        };
        let stations = (1_u32..)
            .map(|k| f64::from(k) * STEP)
            .take_while(|s| *s < lane.length() / 2.0);
        let mut places = stations
            .map(|s| (s, lane.at(s)))
            .map(|(s, at)| (s, Pose::new(at.x, at.y, at.theta)));
        let middle = lane.at(lane.length() / 2.0);
        let (s, pose) = places
            .find(|(_, pose)| is_free(pose))
            .unwrap_or((middle.s, Pose::new(middle.x, middle.y, middle.theta)));
        let way = [Step {
            lane: id,
            change: None,
        }];
        let map = self.lengthened(&way, pose.position(), warnings)?;
        let road = Road::along(&map, &way, pose.position())
            .map_err(|error| ImportError::NoWay(error.to_string()))?;
        let limit = lane.at(s).speed_limit;
        let speed = if limit.is_finite() {
            limit.min(SPEED)
        } else {
            SPEED
        };
        let start = road.line.to_frenet(pose.position()).s;
        let distance = (SHARE * speed * TIMEOUT)
            .min(road.line.length() - start - BEYOND)
            .max(0.0);
        Ok(Scenario {
            name: self.file.benchmark.clone(),
            description: format!("CommonRoad `{}`: no planning problem.", self.file.benchmark),
            seed: 0,
            map,
            route: road.route,
            line: road.line,
            provider: None,
            target_line: None,
            ego: EgoStart { pose, speed },
            command: Command::Cruise,
            command_time: 0.0,
            cruise_speed: speed,
            obstacles,
            vehicle,
            timeout: TIMEOUT,
            expect: Expectation::ProgressOrStandstill(distance),
        })
    }

    fn longest_lane(&self) -> Result<(LaneId, &Lane), ImportError> {
        let lanes = (0..).map(LaneId).zip(self.map.lanes());
        lanes
            .filter(|(_, lane)| lane.kind.is_drivable())
            .max_by(|(a, x), (b, y)| x.length().total_cmp(&y.length()).then(b.cmp(a)))
            .ok_or(ImportError::Map(MapError::NoDrivableLane))
    }
}
