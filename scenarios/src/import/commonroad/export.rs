//! A finished run for CommonRoad's own tools: as a solution of the benchmark, and as one more obstacle of the
//! scenario.
//!
//! Both hold one state per time step of the file, of the middle of the body, written with [`DECIMALS`] decimals. A
//! drive that ends between two steps is carried on to the next one at the speed and yaw rate of its end, so that a
//! contact between the steps shows.
//! The solution is one of the kinematic single-track model: place, heading, speed and road-wheel angle.

use super::data::{Id, Problem};
use super::scenario::to_middle;
use super::{CommonRoad, VEHICLE_TYPE};
use corridor_decider::frame::EgoState;
use corridor_decider::geometry::{Pose, angle};
use corridor_decider::vehicle::VehicleParams;
use std::fmt::Write;

/// Decimals of every number: a hundredth of a millimetre.
const DECIMALS: usize = 5;

/// The benchmark's cost function that the solution names: the one that counts time and comfort.
const COST: &str = "SM1";

/// How far beyond all known ids a new one is taken: ways into an intersection are numbered too, and not read.
const BEYOND_PARTS: Id = 1000;

/// The ego at a time, at its rear axle.
#[derive(Clone, Copy, Debug)]
pub struct DrivenState {
    /// Seconds since the start of the run.
    pub t: f64,
    /// Its motion.
    pub ego: EgoState,
}

/// One state of the middle of the body.
struct Row {
    step: i64,
    pose: Pose,
    speed: f64,
    acceleration: f64,
    yaw_rate: f64,
    steer: f64,
}

impl CommonRoad {
    /// The drive as a solution file of one planning problem.
    pub fn solution(&self, problem: &Problem, drive: &[DrivenState], vehicle: &VehicleParams) -> String {
        let version = if self.file.version.is_empty() {
            "2020a"
        } else {
            &self.file.version
        };
        let benchmark = escaped(&format!(
            "KS{VEHICLE_TYPE}:{COST}:{}:{version}",
            self.file.benchmark
        ));
        let mut text = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<CommonRoadSolution benchmark_id=\"{benchmark}\">\n  \
             <ksTrajectory planningProblem=\"{}\">\n",
            problem.id
        );
        for row in self.rows(problem, drive, vehicle) {
            text += "    <ksState>\n";
            tag(&mut text, "x", row.pose.x);
            tag(&mut text, "y", row.pose.y);
            tag(&mut text, "steeringAngle", row.steer);
            tag(&mut text, "velocity", row.speed);
            tag(&mut text, "orientation", row.pose.theta);
            let _ = writeln!(text, "      <time>{}</time>\n    </ksState>", row.step);
        }
        text + "  </ksTrajectory>\n</CommonRoadSolution>\n"
    }

    /// The text of this file, `original`, with the drive as one more moving obstacle; also its id.
    pub fn with_ego(
        &self,
        original: &str,
        problem: &Problem,
        drive: &[DrivenState],
        vehicle: &VehicleParams,
    ) -> (String, Id) {
        let id = self.free_id();
        let rows = self.rows(problem, drive, vehicle);
        let obstacle = self.obstacle(id, &rows, vehicle);
        // Obstacles stand before the planning problems.
        let place = original
            .find("<planningProblem")
            .or_else(|| original.rfind("</commonRoad"));
        let place = place.unwrap_or(original.len());
        let text = format!("{}{obstacle}\n  {}", &original[..place], &original[place..]);
        (text, id)
    }

    fn free_id(&self) -> Id {
        let file = &self.file;
        let ids = file.lanelets.iter().map(|l| l.id);
        let ids = ids
            .chain(file.signs.iter().map(|s| s.id))
            .chain(file.lights.iter().map(|l| l.id));
        let ids = ids.chain(file.intersections.iter().map(|i| i.id));
        let ids = ids
            .chain(file.obstacles.iter().map(|o| o.id))
            .chain(file.problems.iter().map(|p| p.id));
        ids.max().unwrap_or(0).saturating_add(BEYOND_PARTS)
    }

    fn obstacle(&self, id: Id, rows: &[Row], vehicle: &VehicleParams) -> String {
        let (tag_name, role) = if self.file.version == "2018b" {
            ("obstacle", "<role>dynamic</role>")
        } else {
            ("dynamicObstacle", "")
        };
        let mut text = format!(
            "<{tag_name} id=\"{id}\">{role}<type>car</type>\n    <shape><rectangle><length>{}</length><width>{}\
             </width></rectangle></shape>\n",
            vehicle.length, vehicle.width
        );
        if let Some((first, rest)) = rows.split_first() {
            text += &state("initialState", first);
            text += "    <trajectory>\n";
            text.extend(rest.iter().map(|row| state("state", row)));
            text += "    </trajectory>\n";
        }
        text + &format!("  </{tag_name}>")
    }

    /// One row per time step of the file that the drive covers.
    fn rows(&self, problem: &Problem, drive: &[DrivenState], vehicle: &VehicleParams) -> Vec<Row> {
        let dt = self.file.time_step;
        let first = problem.initial.time.middle();
        let (Some(start), Some(end)) = (drive.first(), drive.last()) else {
            return Vec::new();
        };
        let mut rows = Vec::new();
        let mut after = 0;
        for step in 0_u32.. {
            let t = f64::from(step) * dt;
            #[expect(
                clippy::cast_possible_truncation,
                reason = "times of files are small whole numbers"
            )]
            let number = i64::from(step) + first.round() as i64;
            if t > end.t + ON_TIME {
                if t - dt < end.t - ON_TIME {
                    rows.push(row(number, &carried_on(&end.ego, t - end.t), vehicle));
                }
                break;
            }
            while drive.get(after).is_some_and(|state| state.t < t - ON_TIME) {
                after += 1;
            }
            let to = drive.get(after).unwrap_or(end);
            let from = drive.get(after.wrapping_sub(1)).unwrap_or(start);
            rows.push(row(number, &between(from, to, t), vehicle));
        }
        rows
    }
}

/// Times nearer than this are the same, s.
const ON_TIME: f64 = 1e-6;

/// The state at `t` on the straight from one to the other.
fn between(from: &DrivenState, to: &DrivenState, t: f64) -> EgoState {
    let part = if to.t - from.t > ON_TIME {
        ((t - from.t) / (to.t - from.t)).clamp(0.0, 1.0)
    } else {
        1.0
    };
    let mix = |a: f64, b: f64| a + (b - a) * part;
    let (a, b) = (&from.ego, &to.ego);
    let turn = angle::difference(b.pose.theta, a.pose.theta);
    EgoState {
        pose: Pose::new(
            mix(a.pose.x, b.pose.x),
            mix(a.pose.y, b.pose.y),
            angle::wrap(a.pose.theta + turn * part),
        ),
        v: mix(a.v, b.v),
        a: mix(a.a, b.a),
        yaw_rate: mix(a.yaw_rate, b.yaw_rate),
        steer: mix(a.steer, b.steer),
    }
}

/// The state after `duration` more seconds at constant speed and yaw rate.
fn carried_on(ego: &EgoState, duration: f64) -> EgoState {
    let turn = ego.yaw_rate * duration;
    let halfway = Pose::new(ego.pose.x, ego.pose.y, angle::wrap(ego.pose.theta + turn / 2.0));
    let there = halfway.advanced(ego.v * duration);
    EgoState {
        pose: Pose::new(there.x, there.y, angle::wrap(ego.pose.theta + turn)),
        ..*ego
    }
}

fn row(step: i64, ego: &EgoState, vehicle: &VehicleParams) -> Row {
    Row {
        step,
        pose: ego.pose.advanced(to_middle(vehicle)),
        speed: ego.v,
        acceleration: ego.a,
        yaw_rate: ego.yaw_rate,
        steer: ego.steer,
    }
}

fn tag(text: &mut String, name: &str, value: f64) {
    let _ = writeln!(text, "      <{name}>{value:.DECIMALS$}</{name}>");
}

/// A state of a trajectory, its children in the order of the format's schema.
fn state(name: &str, row: &Row) -> String {
    let exact = |name: &str, value: f64| format!("<{name}><exact>{value:.DECIMALS$}</exact></{name}>");
    let (x, y) = (row.pose.x, row.pose.y);
    format!(
        "      <{name}><position><point><x>{x:.DECIMALS$}</x><y>{y:.DECIMALS$}</y></point></position>{}\
         <time><exact>{}</exact></time>{}{}{}{}</{name}>\n",
        exact("orientation", row.pose.theta),
        row.step,
        exact("velocity", row.speed),
        exact("acceleration", row.acceleration),
        exact("yawRate", row.yaw_rate),
        exact("slipAngle", 0.0),
    )
}

/// Text as the value of an attribute.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::super::{read, tests::PLAIN, vehicle};
    use super::*;

    fn drive() -> Vec<DrivenState> {
        let state = |k: u32| DrivenState {
            t: f64::from(k) * 0.15,
            ego: EgoState {
                pose: Pose::new(f64::from(k), 0.0, 0.0),
                v: 6.0,
                a: 0.0,
                yaw_rate: 0.0,
                steer: 0.02,
            },
        };
        (0..5).map(state).collect()
    }

    #[test]
    fn a_solution_has_a_state_per_step_at_the_middle() {
        let read = read(PLAIN).unwrap();
        let text = read.solution(&read.file.problems[0], &drive(), &vehicle());
        assert!(text.contains("benchmark_id=\"KS2:SM1:ZAM_Plain-1_1_T-1:2020a\""));
        // 0.6 s of driving at steps of 0.1 s: places grow by 1 m in 0.15 s.
        let places: Vec<f64> = text
            .split("<x>")
            .skip(1)
            .map(|rest| rest.split('<').next().unwrap().parse().unwrap())
            .collect();
        assert_eq!(places.len(), 7);
        for (step, place) in (0_u32..).zip(places) {
            assert!(
                (place - 1.42272 - f64::from(step) / 1.5).abs() < 2e-5,
                "{step}: {place}"
            );
        }
    }

    #[test]
    fn the_scenario_with_the_ego_reads_back() {
        let original = read(PLAIN).unwrap();
        let (text, id) = original.with_ego(PLAIN, &original.file.problems[0], &drive(), &vehicle());
        let back = read(&text).unwrap();
        assert_eq!(back.file.obstacles.len(), original.file.obstacles.len() + 1);
        let ego = back.file.obstacles.iter().find(|o| o.id == id).unwrap();
        let super::super::data::Prediction::Trajectory(states) = &ego.prediction else {
            panic!("no trajectory")
        };
        assert_eq!(states.len(), 6);
        assert!(original.file.obstacles.iter().all(|o| o.id != id));
    }
}
