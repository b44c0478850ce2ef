//! A planning problem with its traffic as a scenario: where the ego starts, which way it goes, how fast, for how
//! long and what for.

use super::data::{Id, Interval, Problem, State};
use super::lengthen::{self, End};
use super::remarks::Remarks;
use super::route::{self, Step};
use super::{CommonRoad, goal, obstacles, pace, vehicle};
use crate::goal::GoalRegion;
use crate::import::ImportError;
use crate::route::straight_on;
use crate::scenario::{EgoStart, Expectation, Obstacle, Scenario};
use corridor_decider::frame::Command;
use corridor_decider::geometry::{Pose, Vec2, angle};
use corridor_decider::reference_line::{LineError, ReferenceLine};
use corridor_decider::road::{LaneId, Neighbour, RoadMap, Side};
use corridor_decider::vehicle::VehicleParams;
use std::sync::Arc;

/// Length of road wanted beyond the goal, m.
const BEYOND_GOAL: f64 = lengthen::AHEAD;

/// Nearer to the start of its lane than this, m, the ego's line begins in a lane before.
const BEHIND: f64 = 20.0;

/// Time after the last moment of the goal, s: enough to see a car that brakes come to a stand.
const SLACK: f64 = 5.0;

/// Longest run, s. A file that asks for more is cut off there.
const LONGEST: f64 = 600.0;

impl CommonRoad {
    /// The scenario of one planning problem, of the first one unless named, with what had to be left out. Without
    /// any problem in the file: a cruise along its longest lane.
    ///
    /// # Errors
    /// [`ImportError`] when there is no such problem, or no way from its start.
    pub fn scenario(&self, problem: Option<Id>) -> Result<(Scenario, Vec<String>), ImportError> {
        let problems = &self.file.problems;
        let chosen = match problem {
            None => problems.first(),
            Some(id) => Some(problems.iter().find(|p| p.id == id).ok_or_else(|| {
                let known: Vec<String> = problems.iter().map(|p| format!("`{}`", p.id)).collect();
                ImportError::NoProblem {
                    id,
                    known: known.join(", "),
                }
            })?),
        };
        let mut remarks = Remarks::default();
        let mut warnings = Vec::new();
        let scenario = if let Some(problem) = chosen {
            self.solve(problem, &mut remarks, &mut warnings)?
        } else {
            warnings.push("no planning problem: cruises along the longest lane".to_owned());
            self.cruise(&mut remarks, &mut warnings)?
        };
        warnings.extend(remarks.into_warnings());
        Ok((scenario, warnings))
    }

    /// The planning problem that a seed stands for: they take turns, the first one with seed 1.
    pub fn problem_of_seed(&self, seed: u64) -> Option<&Problem> {
        let problems = &self.file.problems;
        let turn = seed.wrapping_sub(1).checked_rem(problems.len() as u64)?;
        problems.get(usize::try_from(turn).ok()?)
    }

    fn solve(
        &self,
        problem: &Problem,
        remarks: &mut Remarks,
        warnings: &mut Vec<String>,
    ) -> Result<Scenario, ImportError> {
        let vehicle = vehicle();
        let goal = goal::region(&self.file, problem, remarks);
        let center = self.start(&problem.initial);
        let ego = EgoStart {
            pose: center.advanced(-to_middle(&vehicle)),
            speed: problem.initial.velocity.map_or(0.0, Interval::middle).max(0.0),
        };
        let no_way = |why: String| ImportError::Element {
            place: problem.place,
            element: "planningProblem".to_owned(),
            problem: why,
            expected: "a start in or near a lane that cars may use".to_owned(),
        };
        let starts = route::lanes_of(&self.map, center);
        if starts.is_empty() {
            return Err(no_way(format!(
                "starts at ({:.1}, {:.1}), away from all lanes",
                center.x, center.y
            )));
        }
        let stretches = pace::stretches(&self.map, &goal);
        let ids: Vec<LaneId> = starts.iter().map(|(lane, _)| *lane).collect();
        let is_ahead = |lane: LaneId| match starts.iter().find(|(start, _)| *start == lane) {
            Some((_, s)) => stretches.get(&lane).is_some_and(|(_, end)| end >= s),
            None => stretches.contains_key(&lane),
        };
        let way = route::find(&self.map, &ids, is_ahead).unwrap_or_else(|| {
            if goal.has_place() {
                warnings.push(format!("`{}`: no way leads to the goal: straight on", problem.id));
            }
            vec![Step {
                lane: ids[0],
                change: None,
            }]
        });
        let changes = way.iter().filter(|step| step.change.is_some()).count();
        if changes > 1 {
            warnings.push(format!(
                "`{}`: the goal is {changes} lanes aside: the first change is asked for",
                problem.id
            ));
        }
        let map = self.lengthened(&way, center.position(), warnings)?;
        let road = Road::along(&map, &way, center.position()).map_err(|error| no_way(error.to_string()))?;
        let pace = pace::Pace {
            map: &map,
            way: &way,
            start: center.position(),
            stretch: way.last().and_then(|step| stretches.get(&step.lane).copied()),
            acceleration: vehicle.max_acceleration,
        };
        let cruise_speed = pace.cruise_speed(ego.speed, &goal);
        let latest = goal.latest();
        if latest > LONGEST {
            warnings.push(format!("`{}`: {latest} s are cut off at {LONGEST} s", problem.id));
        }
        let obstacles = obstacles::obstacles(&self.file, Some(&problem.initial), remarks);
        warn_of_overlaps(&vehicle, ego.pose, &obstacles, warnings);
        Ok(Scenario {
            name: self.file.benchmark.clone(),
            description: format!(
                "CommonRoad `{}`, planning problem {}.",
                self.file.benchmark, problem.id
            ),
            seed: 0,
            map,
            command: road.change.map_or(Command::Cruise, Command::ChangeLane),
            route: road.route,
            provider: None,
            line: road.line,
            target_line: road.target,
            ego,
            command_time: 0.0,
            cruise_speed,
            obstacles,
            vehicle,
            timeout: (latest + SLACK).min(LONGEST),
            expect: Expectation::Goal(goal),
        })
    }

    /// The map, going on straight where it ends on the way.
    pub(super) fn lengthened(
        &self,
        way: &[Step],
        start: Vec2,
        warnings: &mut Vec<String>,
    ) -> Result<Arc<RoadMap>, ImportError> {
        let parts = way
            .split(|step| step.change.is_some())
            .filter(|part| !part.is_empty());
        let mut ends = Vec::new();
        let after_changes = way
            .iter()
            .filter(|step| step.change.is_some())
            .map(|step| step.lane);
        let own = parts.map(|part| part[part.len() - 1].lane);
        for last in own.chain(after_changes) {
            let lanes = straight_on(&self.map, last, BEYOND_GOAL);
            let last = lanes[lanes.len() - 1];
            if self.map.lane(last).successors.is_empty() && !ends.contains(&(last, End::Ahead)) {
                ends.push((last, End::Ahead));
            }
        }
        let first = way[0].lane;
        if self.map.lane(first).predecessors.is_empty() && route::station(&self.map, first, start) < BEHIND {
            ends.push((first, End::Behind));
        }
        if ends.is_empty() {
            return Ok(Arc::clone(&self.map));
        }
        warnings.push("the file's road ends on the ego's way: it goes on straight there".to_owned());
        Ok(Arc::new(self.network.lengthened(&self.map, &ends)?))
    }

    /// Place and heading of the middle of the body; without a heading, along the lane.
    fn start(&self, state: &State) -> Pose {
        let point = obstacles::place(state.position.as_ref()).unwrap_or_else(Vec2::zeros);
        let theta = match state.orientation {
            Some(theta) => angle::wrap(theta.middle()),
            None => self.map.lanes_at(point).first().map_or(0.0, |(_, theta)| *theta),
        };
        Pose::new(point.x, point.y, theta)
    }
}

/// From the rear axle to the middle of the body, m.
pub(super) fn to_middle(vehicle: &VehicleParams) -> f64 {
    vehicle.center(Pose::new(0.0, 0.0, 0.0)).x
}

fn warn_of_overlaps(vehicle: &VehicleParams, ego: Pose, obstacles: &[Obstacle], warnings: &mut Vec<String>) {
    let footprint = vehicle.footprint(ego);
    for obstacle in obstacles {
        let is_hit = obstacle
            .start()
            .is_some_and(|pose| obstacle.shape.at(pose).overlaps(&footprint));
        if is_hit {
            warnings.push(format!("the ego starts inside of `{}`", obstacle.name));
        }
    }
}

/// Lines to drive along.
pub(super) struct Road {
    pub(super) route: Vec<LaneId>,
    pub(super) line: Arc<ReferenceLine>,
    change: Option<Side>,
    target: Option<Arc<ReferenceLine>>,
}

impl Road {
    /// The line of the lanes up to the first change and straight on, and the one of the lanes after it.
    pub(super) fn along(map: &RoadMap, way: &[Step], start: Vec2) -> Result<Self, LineError> {
        let first_change = way.iter().position(|step| step.change.is_some());
        let own: Vec<LaneId> = way[..first_change.unwrap_or(way.len())]
            .iter()
            .map(|step| step.lane)
            .collect();
        let route = extended(map, own.clone(), start);
        let line = Arc::new(ReferenceLine::along(map, &route)?);
        let Some((at, side)) = first_change.and_then(|at| Some((at, way[at].change?))) else {
            return Ok(Self {
                route,
                line,
                change: None,
                target: None,
            });
        };
        let until_next = way[at + 1..].iter().take_while(|step| step.change.is_none());
        let mut beside: Vec<LaneId> = vec![way[at].lane];
        beside.extend(until_next.map(|step| step.lane));
        // The lanes beside those before the change, as far back as they are linked.
        for own in own.iter().rev().skip(1) {
            let before = map.neighbour(*own, Neighbour { side, reverse: false });
            match before.filter(|before| map.lane(*before).successors.contains(&beside[0])) {
                Some(before) => beside.insert(0, before),
                None => break,
            }
        }
        let target = ReferenceLine::along(map, &extended(map, beside, start))?;
        Ok(Self {
            route,
            line,
            change: Some(side),
            target: Some(Arc::new(target)),
        })
    }
}

/// Lanes with what leads to them and on from them.
fn extended(map: &RoadMap, mut lanes: Vec<LaneId>, start: Vec2) -> Vec<LaneId> {
    let first = lanes[0];
    if route::station(map, first, start) < BEHIND {
        let behind = map.lane(first).predecessors.iter().copied();
        let drivable = |lane: &LaneId| {
            map.lane(*lane).kind.is_drivable()
                && !lanes.contains(lane)
                && crate::route::joins(map, *lane, first)
        };
        if let Some(before) = behind.filter(drivable).min() {
            lanes.insert(0, before);
        }
    }
    let last = lanes[lanes.len() - 1];
    for lane in straight_on(map, last, BEYOND_GOAL).into_iter().skip(1) {
        // A ring is driven once.
        if lanes.contains(&lane) {
            break;
        }
        lanes.push(lane);
    }
    lanes
}

impl GoalRegion {
    /// Whether there is a place to go to.
    pub(super) fn has_place(&self) -> bool {
        self.alternatives.iter().any(|goal| !goal.areas.is_empty())
    }
}
