//! The reader of `CommonRoad` on files of the collection: what is in them, and every oddity they are known for.

use crate::sound::{DRAWN, assert_sound};
use crate::support::{map_file, named};
use corridor_decider::frame::{Command, ObstacleKind};
use corridor_decider::geometry::{Vec2, angle};
use corridor_decider::road::{BoundaryType, Lane, LaneKind, Neighbour, Side};
use corridor_scenarios::Scenario;
use corridor_scenarios::import::commonroad::data::{Prediction, Role};
use corridor_scenarios::import::commonroad::{CommonRoad, read_file};
use corridor_scenarios::scenario::{Behaviour, Expectation, RecordedState};

const LEFT_REVERSE: Neighbour = Neighbour {
    side: Side::Left,
    reverse: true,
};

const RIGHT: Neighbour = Neighbour {
    side: Side::Right,
    reverse: false,
};

fn assert_near(is: f64, expected: f64, tolerance: f64) {
    assert!(
        (is - expected).abs() <= tolerance,
        "{is} is not {expected} ± {tolerance}"
    );
}

fn load(name: &str) -> Option<CommonRoad> {
    let path = map_file(&format!("commonroad/{name}.xml"))?;
    Some(read_file(&path).unwrap_or_else(|error| panic!("{error}")))
}

fn scene(read: &CommonRoad) -> (Scenario, Vec<String>) {
    read.scenario(None).unwrap_or_else(|error| panic!("{error}"))
}

fn states<'a>(scenario: &'a Scenario, name: &str) -> &'a [RecordedState] {
    let obstacle = scenario.obstacles.iter().find(|o| o.name == name);
    match obstacle.map(|o| &o.behaviour) {
        Some(Behaviour::Recorded { states, .. }) => states,
        other => panic!("`{name}` is not recorded: {other:?}"),
    }
}

/// Name, version, lanelets and their length in m, obstacles (static, dynamic), problems.
type Known = (&'static str, &'static str, usize, f64, [usize; 2], usize);

const FILES: [Known; 10] = [
    ("ZAM_Tutorial-1_2_T-1", "2020a", 3, 597.0, [1, 2], 1),
    ("DEU_Test-1_1_T-1", "2020a", 4, 300.0, [1, 1], 1),
    ("Tut_compliance", "2018b", 2, 400.0, [1, 1], 0),
    ("ZAM_Urban-3_3_Repair", "2020a", 2, 418.0, [2, 1], 1),
    ("C-DEU_B471-1_3_T-1", "2020a", 2, 862.0, [1, 1], 1),
    ("test_reading_all", "2020a", 6, 12.0, [1, 2], 1),
    ("ZAM_Over-1_1", "2018b", 2, 400.0, [1, 0], 1),
    ("ZAM_Tjunction-1_42_T-1", "2020a", 12, 929.0, [0, 5], 1),
    ("ZAM-Ramp-1_1-T-1", "2020a", 11, 660.0, [0, 3], 1),
    ("USA_US101-3_3_T-1", "2018b", 12, 1181.0, [0, 12], 1),
];

#[test]
fn every_file_holds_what_is_known_of_it() {
    for (name, version, lanelets, length, [standing, moving], problems) in FILES {
        let Some(read) = load(name) else { return };
        let file = &read.file;
        let role = |role: Role| file.obstacles.iter().filter(|o| o.role == role).count();
        assert_eq!(file.version, version, "{name}");
        assert_eq!(file.lanelets.len(), lanelets, "{name}");
        assert_eq!(
            [role(Role::Static), role(Role::Dynamic)],
            [standing, moving],
            "{name}"
        );
        assert_eq!(file.problems.len(), problems, "{name}");
        assert_eq!(read.map.lanes().len(), lanelets, "{name}: {:?}", read.warnings);
        let all: f64 = read.map.lanes().iter().map(Lane::length).sum();
        assert!((all - length).abs() < 0.01 * length, "{name}: {all} m of lanes");
        assert_near(file.time_step, 0.1, 1e-12);
    }
}

#[test]
fn every_road_is_sound_and_every_scene_can_be_set_up() {
    for (name, ..) in FILES {
        let Some(read) = load(name) else { return };
        assert_sound(&read.map, DRAWN);
        let (scenario, _) = scene(&read);
        let center = scenario.vehicle.center(scenario.ego.pose).position();
        let off = scenario.map.distance_off_road(center);
        assert!(off < 1e-9, "{name}: starts {off} m off the road");
        assert!(scenario.timeout > 0.0 && scenario.timeout < 60.0, "{name}");
    }
}

#[test]
fn the_tutorial_drives_on_three_lanes() {
    let Some(read) = load("ZAM_Tutorial-1_2_T-1") else {
        return;
    };
    assert_eq!(
        read.file.benchmark, "ZAM_Tutorial-1_1_T-1",
        "not the name of the file"
    );
    let (scenario, _) = scene(&read);
    assert_near(scenario.ego.speed, 22.0, 1e-12);
    assert_near(scenario.cruise_speed, 22.0, 1e-12);
    assert_eq!(
        named(&read.map, "1").mark(Side::Left, 50.0),
        BoundaryType::Unknown
    );
    let goal = scenario.expect.goal_region().expect("a goal");
    assert_eq!(goal.alternatives.len(), 1);
    assert_near(goal.alternatives[0].time.0, 3.5, 1e-9);
    assert_near(goal.alternatives[0].time.1, 4.0, 1e-9);
    // Steps are tenths of seconds: 22 m/s are 2.2 m a step.
    let lead = states(&scenario, "44");
    assert_eq!(lead.len(), 41);
    assert_near(lead[40].t, 4.0, 1e-9);
    assert_near(lead[40].pose.x - lead[0].pose.x, 88.0, 0.5);
}

#[test]
fn a_limit_may_hang_on_a_sign_and_a_parked_car_stand_askew() {
    let Some(read) = load("DEU_Test-1_1_T-1") else {
        return;
    };
    assert_near(named(&read.map, "3").at(10.0).speed_limit, 16.67, 0.01);
    assert!(
        named(&read.map, "1").at(10.0).speed_limit.is_infinite(),
        "the sign stands before the next lanelet"
    );
    let (scenario, _) = scene(&read);
    let parked = scenario.obstacles.iter().find_map(|o| match o.behaviour {
        Behaviour::Parked(pose) => Some((pose, o.kind)),
        _ => None,
    });
    let (pose, kind) = parked.expect("a parked car");
    assert_eq!(kind, ObstacleKind::Car);
    assert_near(pose.theta, 0.3, 1e-9);
    assert_near(pose.x, 65.0, 1e-9);
}

#[test]
fn a_file_without_a_problem_is_cruised_through() {
    let Some(read) = load("Tut_compliance") else {
        return;
    };
    let (scenario, warnings) = scene(&read);
    assert!(warnings[0].contains("no planning problem"), "{warnings:?}");
    assert_eq!(
        scenario.obstacles.len(),
        2,
        "the recorded solution stays as traffic"
    );
    assert!(matches!(scenario.expect, Expectation::ProgressOrStandstill(_)));
    let moving = scenario
        .obstacles
        .iter()
        .find(|o| matches!(o.behaviour, Behaviour::Recorded { .. }));
    let recorded = states(&scenario, &moving.expect("a recorded car").name);
    assert!(
        recorded.is_sorted_by(|a, b| a.t < b.t),
        "time 0 comes twice in the file"
    );
    let wide = scenario
        .obstacles
        .iter()
        .find(|o| matches!(o.behaviour, Behaviour::Parked(_)))
        .expect("a blocker");
    assert_near(wide.shape.area(), 6.0 * 3.5, 1e-6);
}

#[test]
fn the_recorded_ego_is_no_obstacle() {
    let Some(read) = load("ZAM_Urban-3_3_Repair") else {
        return;
    };
    let (scenario, warnings) = scene(&read);
    assert!(
        warnings
            .iter()
            .any(|w| w.starts_with("`8` starts as the ego itself")),
        "{warnings:?}"
    );
    let names: Vec<&str> = scenario.obstacles.iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["6", "7"]);
    assert!(
        scenario
            .obstacles
            .iter()
            .all(|o| matches!(o.behaviour, Behaviour::Parked(_)))
    );
}

#[test]
fn a_car_may_drive_against_its_lanelet() {
    let Some(read) = load("C-DEU_B471-1_3_T-1") else {
        return;
    };
    let (scenario, _) = scene(&read);
    let lanes = read.map.lanes();
    assert!(lanes.iter().all(|lane| lane.neighbour(LEFT_REVERSE).is_some()));
    assert!(
        lanes
            .iter()
            .all(|lane| (lane.at(10.0).speed_limit - 28.0).abs() < 1e-9)
    );
    let moving = scenario
        .obstacles
        .iter()
        .find(|o| matches!(o.behaviour, Behaviour::Recorded { .. }));
    let recorded = states(&scenario, &moving.expect("a recorded car").name);
    assert_near(recorded[0].pose.theta, 0.64, 0.01);
    assert!(
        recorded[1..]
            .iter()
            .all(|state| (state.pose.theta - 0.40).abs() < 0.02)
    );
    let against = recorded.iter().filter(|state| {
        let here = read.map.lanes_at(state.pose.position());
        here.iter()
            .any(|(_, theta)| angle::difference(*theta, state.pose.theta).abs() > 2.5)
    });
    assert!(against.count() > 5, "it overtakes in the oncoming lane");
}

#[test]
fn every_kind_of_element_is_read() {
    let Some(read) = load("test_reading_all") else {
        return;
    };
    let role = |id: i64| read.file.obstacles.iter().find(|o| o.id == id).map(|o| o.role);
    assert_eq!(
        (role(1234), role(5678)),
        (Some(Role::Environment), Some(Role::Phantom))
    );
    let sets = read
        .file
        .obstacles
        .iter()
        .filter(|o| matches!(o.prediction, Prediction::Occupancy(_)));
    assert_eq!(sets.count(), 2);
    assert_eq!(named(&read.map, "101").kind, LaneKind::Restricted, "a bus lane");
    assert_near(named(&read.map, "100").at(1.0).speed_limit, 10.0, 1e-9);
    assert_eq!(
        named(&read.map, "100").mark(Side::Left, 1.0),
        BoundaryType::DottedWhite
    );
    let (scenario, warnings) = scene(&read);
    let goal = scenario.expect.goal_region().expect("a goal");
    assert_eq!(goal.alternatives.len(), 2);
    assert!(scenario.obstacles.iter().all(|o| o.name != "5678"), "a phantom");
    assert!(
        warnings.iter().any(|w| w.contains("the ego starts inside of")),
        "{warnings:?}"
    );
}

#[test]
fn the_opposite_lane_is_known_for_one() {
    let Some(read) = load("ZAM_Over-1_1") else { return };
    let (scenario, _) = scene(&read);
    let lane = read.map.lane(
        *scenario
            .route
            .iter()
            .find(|id| (id.0 as usize) < 2)
            .expect("a lane of the file"),
    );
    let other = lane.neighbour(LEFT_REVERSE).expect("the opposite lane");
    assert!(read.map.lane(other).neighbour(LEFT_REVERSE).is_some());
    assert_near(lane.at(30.0).speed_limit, 23.0, 1e-9);
    let center = scenario.vehicle.center(scenario.ego.pose).position();
    assert!(
        (center - Vec2::new(29.9948, -1.1501)).norm() < 1e-9,
        "children of a state in another order"
    );
    assert_near(scenario.ego.pose.theta, 0.03495, 1e-9);
}

#[test]
fn a_junction_has_forks_and_a_goal_across_it() {
    let Some(read) = load("ZAM_Tjunction-1_42_T-1") else {
        return;
    };
    assert_eq!(read.map.junctions().len(), 1);
    let lanes = read.map.lanes();
    assert_eq!(lanes.iter().filter(|lane| lane.junction.is_some()).count(), 6);
    assert_eq!(lanes.iter().filter(|lane| lane.successors.len() == 2).count(), 3);
    assert!(lanes.iter().all(|lane| lane.neighbour(LEFT_REVERSE).is_some()));
    let (scenario, _) = scene(&read);
    let names: Vec<&str> = scenario
        .route
        .iter()
        .map(|id| scenario.map.lane(*id).name.as_str())
        .collect();
    assert!(names.contains(&"50203"), "{names:?}");
    assert_eq!(scenario.command, Command::Cruise);
    // In the 14.6 s until it counts, the car gets into the goal's lanelet, and not out of it, at the speed it has.
    assert_near(scenario.cruise_speed, scenario.ego.speed, 1e-9);
    assert_eq!(states(&scenario, "1").len(), 148);
}

#[test]
fn a_ramp_is_a_ramp_and_the_start_is_on_the_road() {
    let Some(read) = load("ZAM-Ramp-1_1-T-1") else {
        return;
    };
    assert_eq!(read.file.benchmark, "ZAM-Ramp-1_1-T-1");
    assert!(read.file.lanelets.iter().all(|lanelet| lanelet.types.len() == 2));
    assert!(read.map.lanes().iter().any(|lane| lane.kind == LaneKind::Ramp));
    let (scenario, _) = scene(&read);
    assert_near(scenario.ego.speed, 0.0, 1e-12);
    assert!(
        scenario.cruise_speed > 5.0,
        "{} m/s do not cover 50 m in 10 s",
        scenario.cruise_speed
    );
    for corner in scenario.vehicle.footprint(scenario.ego.pose).vertices() {
        assert_near(scenario.map.distance_off_road(*corner), 0.0, 1e-6);
    }
}

#[test]
fn recorded_traffic_ends_and_neighbours_are_mutual() {
    let Some(read) = load("USA_US101-3_3_T-1") else {
        return;
    };
    assert_eq!(named(&read.map, "39").neighbour(RIGHT), read.map.find("23"));
    let left = Neighbour {
        side: Side::Left,
        ..RIGHT
    };
    assert_eq!(named(&read.map, "23").neighbour(left), read.map.find("39"));
    assert!(
        read.map
            .lanes()
            .iter()
            .all(|lane| lane.at(1.0).speed_limit.is_infinite())
    );
    let (scenario, _) = scene(&read);
    assert_eq!(scenario.obstacles.len(), 12);
    for obstacle in &scenario.obstacles {
        let recorded = states(&scenario, &obstacle.name);
        assert!(recorded.len() <= 32 && recorded[recorded.len() - 1].t < 3.2);
    }
    assert!(
        scenario.cruise_speed < 8.6007,
        "the goal asks for less than the start has"
    );
    let center = scenario.vehicle.center(scenario.ego.pose).position();
    assert!(center.norm() < 1e-9, "minus zero is zero");
}
