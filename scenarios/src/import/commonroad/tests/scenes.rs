//! Whole scenes: start, way, pace, goal, traffic.

use super::{PLAIN, moving, plain_and, plain_but, scene};
use crate::import::commonroad;
use crate::scenario::{AfterRecord, Behaviour, Expectation, Scenario};
use corridor_decider::frame::{Command, ObstacleKind};
use corridor_decider::geometry::{Pose, Vec2};
use corridor_decider::reference_line::LineQuery;
use corridor_decider::road::Side;

/// What is told of every scene on the plain road.
const CUT: &str = "the file's road ends on the ego's way: it goes on straight there";

fn lanes(scenario: &Scenario) -> Vec<&str> {
    scenario
        .route
        .iter()
        .map(|lane| scenario.map.lane(*lane).name.as_str())
        .collect()
}

#[test]
fn the_ego_starts_with_its_middle_at_the_problems_state() {
    let (scenario, warnings) = scene(PLAIN);
    assert_eq!(warnings, [CUT]);
    let center = scenario.vehicle.center(scenario.ego.pose);
    assert!((center.position() - Vec2::new(20.0, 0.0)).norm() < 1e-12);
    assert!((scenario.ego.pose.x - (20.0 - 1.422_717_093_6)).abs() < 1e-9);
    assert!((scenario.ego.speed - 10.0).abs() < 1e-12);
    assert_eq!(lanes(&scenario), ["1", "1.ahead"]);
    assert_eq!(scenario.command, Command::Cruise);
    assert!(
        (scenario.timeout - 9.0).abs() < 1e-12,
        "the goal's last moment and the slack"
    );
}

#[test]
fn the_road_goes_on_where_the_file_cuts_it() {
    let (scenario, _) = scene(&plain_but("<x>20</x>", "<x>1</x>"));
    assert_eq!(lanes(&scenario), ["1.behind", "1", "1.ahead"]);
    assert!(scenario.line.length() > 500.0);
    let rear = scenario.vehicle.footprint(scenario.ego.pose);
    for corner in rear.vertices() {
        assert!(
            scenario.map.distance_off_road(*corner) < 1e-9,
            "{corner} is off the road"
        );
    }
    for x in [-20.0, 100.0, 350.0] {
        assert!(
            scenario.line.to_frenet(Vec2::new(x, 0.0)).l.abs() < 1e-6,
            "straight on at {x}"
        );
    }
}

#[test]
fn goals_are_in_seconds_from_the_start_and_in_place() {
    let later = PLAIN.replace(
        "<time><exact>0</exact></time><velocity>",
        "<time><exact>10</exact></time><velocity>",
    );
    let (scenario, _) = scene(&later);
    let Expectation::Goal(region) = &scenario.expect else {
        panic!("{:?}", scenario.expect)
    };
    let met = |time, x, y| region.is_met(time, Pose::new(x, y, 0.0), 3.0);
    assert!(met(2.0, 50.0, 1.7) && met(3.0, 199.0, -1.7));
    assert!(
        !met(1.9, 50.0, 0.0) && !met(3.1, 50.0, 0.0),
        "too early, too late"
    );
    assert!(!met(2.5, 50.0, 1.8), "in the other lanelet");
}

#[test]
fn a_goal_one_lane_aside_asks_for_a_change_of_lane() {
    let (scenario, _) = scene(&plain_but("<lanelet ref=\"1\"/>", "<lanelet ref=\"2\"/>"));
    assert_eq!(scenario.command, Command::ChangeLane(Side::Left));
    let target = scenario.target_line.expect("a line to change to");
    assert!(target.to_frenet(Vec2::new(100.0, 3.5)).l.abs() < 1e-6);
    assert!(scenario.line.to_frenet(Vec2::new(100.0, 0.0)).l.abs() < 1e-6);
}

#[test]
fn the_pace_brings_the_ego_to_the_goal_in_time() {
    let rectangle = |x: f64| {
        format!(
            "<rectangle><length>10</length><width>3</width><center><x>{x}</x><y>0</y></center></rectangle>"
        )
    };
    let speed = |x: f64| {
        scene(&plain_but("<lanelet ref=\"1\"/>", &rectangle(x)))
            .0
            .cruise_speed
    };
    // From x = 20, with 3 to 4 s: at 10 m/s the car gets to between 50 and 60.
    assert!((speed(55.0) - 10.0).abs() < 1e-12, "as it drives already");
    let (fast, slow) = (speed(70.0), speed(40.0));
    assert!(
        fast > 14.0 && fast < 16.5,
        "{fast}: as fast as it gets in the time"
    );
    assert!(slow < 8.0 && slow > 5.0, "{slow}");
}

#[test]
fn a_moving_obstacle_replays_its_states_and_then_leaves() {
    // The first state of the trajectory repeats the initial one, as some files do.
    let car = moving(
        9,
        &[(0, 50.0, 3.5), (0, 50.0, 3.5), (1, 51.0, 3.5), (3, 53.0, 3.5)],
    );
    let (scenario, warnings) = scene(&plain_and(&car));
    assert_eq!(warnings, [CUT]);
    let car = &scenario.obstacles[1];
    assert_eq!((car.name.as_str(), car.kind), ("9", ObstacleKind::Car));
    let Behaviour::Recorded { states, after } = &car.behaviour else {
        panic!("{:?}", car.behaviour)
    };
    let times: Vec<f64> = states.iter().map(|s| s.t).collect();
    assert_eq!(times.len(), 3);
    assert!((times[2] - 0.3).abs() < 1e-12 && (states[2].pose.x - 53.0).abs() < 1e-12);
    assert_eq!(*after, AfterRecord::Leaves);
    assert!(
        matches!(scenario.obstacles[0].behaviour, Behaviour::Parked(pose) if (pose.x - 150.0).abs() < 1e-12)
    );
}

#[test]
fn states_out_of_order_are_put_in_order_and_told() {
    let (scenario, warnings) = scene(&plain_and(&moving(
        9,
        &[(0, 50.0, 3.5), (2, 52.0, 3.5), (1, 51.0, 3.5)],
    )));
    let Behaviour::Recorded { states, .. } = &scenario.obstacles[1].behaviour else {
        panic!()
    };
    assert!(states.is_sorted_by(|a, b| a.t < b.t && a.pose.x < b.pose.x));
    assert_eq!(warnings, [CUT, "`9` has states out of order: put in order"]);
}

#[test]
fn the_recording_of_the_ego_itself_is_left_out() {
    let (scenario, warnings) = scene(&plain_and(&moving(9, &[(0, 20.0, 0.0), (1, 21.0, 0.0)])));
    assert_eq!(scenario.obstacles.len(), 1);
    assert_eq!(
        warnings,
        [
            CUT,
            "`9` starts as the ego itself: taken for its recording and left out"
        ]
    );
    let (beside, _) = scene(&plain_and(&moving(9, &[(0, 20.0, 3.5), (1, 21.0, 3.5)])));
    assert_eq!(beside.obstacles.len(), 2);
}

#[test]
fn a_union_becomes_several_bodies_and_an_angle_its_hull() {
    let union = "<rectangle><length>4.5</length><width>1.8</width></rectangle><polygon><point><x>-6</x><y>-1</y></point>\
        <point><x>-3</x><y>-1</y></point><point><x>-4</x><y>0</y></point><point><x>-3</x><y>1</y></point><point><x>-6</x>\
        <y>1</y></point></polygon>";
    let (scenario, warnings) = scene(&plain_but(
        "<rectangle><length>4.5</length><width>1.8</width></rectangle>",
        union,
    ));
    let names: Vec<&str> = scenario.obstacles.iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["7", "7.2"]);
    assert!((scenario.obstacles[1].shape.area() - 6.0).abs() < 1e-9);
    assert_eq!(warnings.len(), 3, "{warnings:?}");
}

#[test]
fn without_a_problem_the_longest_lane_is_cruised() {
    let start = PLAIN.find("<planningProblem").unwrap();
    let (scenario, warnings) = scene(&format!("{}</commonRoad>", &PLAIN[..start]));
    assert!(warnings[0].contains("no planning problem"));
    assert!(matches!(scenario.expect, Expectation::ProgressOrStandstill(distance) if distance > 100.0));
}

#[test]
fn a_problem_is_chosen_by_its_id() {
    let start = PLAIN.find("<planningProblem").unwrap();
    let end = PLAIN.find("</commonRoad>").unwrap();
    let second = PLAIN[start..end]
        .replace("\"100\"", "\"200\"")
        .replace("<x>20</x>", "<x>60</x>");
    let text = format!("{}{second}</commonRoad>", &PLAIN[..end]);
    let start_of = |problem| {
        let (scenario, _) = commonroad::scenario(&text, problem).unwrap();
        scenario.vehicle.center(scenario.ego.pose).x
    };
    assert!((start_of(None) - 20.0).abs() < 1e-9 && (start_of(Some(200)) - 60.0).abs() < 1e-9);
    let message = commonroad::scenario(&text, Some(3)).unwrap_err().to_string();
    assert_eq!(message, "there is no planning problem `3`; expected `100`, `200`");
}

#[test]
fn a_start_far_from_all_lanes_is_refused_with_its_place() {
    let message = commonroad::scenario(&plain_but("<x>20</x><y>0</y>", "<x>20</x><y>-90</y>"), None);
    let message = message.unwrap_err().to_string();
    assert!(
        message.starts_with("18:3: <planningProblem> starts at (20.0, -90.0), away from all lanes"),
        "{message}"
    );
}
