//! Road users against worked numbers: circles, following distances, stops, cut-ins, crossings.
#![expect(clippy::float_cmp, reason = "waiting and arriving are exact")]

use super::leader::Leader;
use super::*;
use crate::testing::{along, line, road, scenario};
use corridor_decider::geometry::angle;
use corridor_decider::reference_line::{LineQuery, ReferenceLine};
use corridor_scenarios::scenario::{IdmParams, LateralMove, Mobil, Waypoint};
use std::sync::Arc;

const DT: f64 = 0.01;

fn straight() -> Arc<ReferenceLine> {
    line(&road(Pose::new(0.0, 0.0, 0.0), 0.0, 600.0))
}

fn ego_at(x: f64, y: f64, v: f64) -> EgoState {
    EgoState {
        pose: Pose::new(x, y, 0.0),
        v,
        a: 0.0,
        yaw_rate: 0.0,
        steer: 0.0,
    }
}

/// Far from everyone.
fn nowhere() -> EgoState {
    ego_at(-500.0, 300.0, 0.0)
}

fn agents(behaviours: Vec<Behaviour>) -> Agents {
    Agents::new(&scenario(nowhere().pose, 0.0, behaviours))
}

fn idm(line: &Arc<ReferenceLine>, s: f64, l: f64, speed: f64) -> Behaviour {
    Behaviour::Idm {
        start: along(line, s, l, speed),
        params: IdmParams::default(),
        lane_change: None,
        mobil: None,
    }
}

fn cut_in(line: &Arc<ReferenceLine>, speed: f64, trigger: Trigger) -> Behaviour {
    Behaviour::Idm {
        start: along(line, 20.0, 3.5, speed),
        params: IdmParams {
            desired_speed: speed.max(0.1),
            ..IdmParams::default()
        },
        lane_change: Some(LateralMove {
            trigger,
            to_l: 0.0,
            duration: 4.0,
        }),
        mobil: None,
    }
}

fn run(agents: &mut Agents, ego: &EgoState, seconds: f64) -> Vec<Vec<BodyPose>> {
    let mut history = Vec::new();
    let mut k = 0;
    while f64::from(k) * DT < seconds - 1e-9 {
        history.push(agents.advance(ego, DT).to_vec());
        k += 1;
    }
    history
}

fn last(agents: &mut Agents, ego: &EgoState, seconds: f64) -> Vec<BodyPose> {
    run(agents, ego, seconds).pop().unwrap()
}

#[test]
fn in_a_bend_it_keeps_its_offset_its_speed_and_points_ahead() {
    let kappa = 0.02;
    let bend = line(&road(Pose::new(10.0, 5.0, 0.3), kappa, 300.0));
    for l in [3.0, -2.0] {
        let mut agents = agents(vec![Behaviour::ConstantSpeed(along(&bend, 20.0, l, 9.0))]);
        let end = last(&mut agents, &nowhere(), 20.0)[0];
        let radius = 1.0 / kappa - l;
        let center = Pose::new(10.0, 5.0, 0.3).to_world(Vec2::new(0.0, 1.0 / kappa));
        assert!(((end.pose.position() - center).norm() - radius).abs() < 1e-3);
        let turned = 20.0 * kappa + 9.0 * 20.0 / radius;
        let heading = angle::wrap(0.3 + turned);
        assert!(
            angle::difference(end.pose.theta, heading).abs() < 2e-3,
            "{} is not {heading}",
            end.pose.theta
        );
        assert!((end.velocity.norm() - 9.0).abs() < 1e-9);
        assert!((end.velocity.normalize() - end.pose.forward()).norm() < 1e-9);
    }
}

#[test]
fn beyond_its_line_it_drives_straight_on() {
    let short = line(&road(Pose::new(0.0, 0.0, 0.5), 0.0, 50.0));
    let mut agents = agents(vec![Behaviour::ConstantSpeed(along(&short, 40.0, 1.0, 10.0))]);
    let end = last(&mut agents, &nowhere(), 6.0)[0];
    let expected = Pose::new(0.0, 0.0, 0.5).to_world(Vec2::new(100.0, 1.0));
    assert!((end.pose.position() - expected).norm() < 1e-9);
}

#[test]
fn a_follower_settles_at_the_models_distance() {
    let line = straight();
    let mut agents = agents(vec![
        Behaviour::ConstantSpeed(along(&line, 60.0, 0.2, 8.0)),
        idm(&line, 10.0, 0.0, 12.0),
    ]);
    let end = last(&mut agents, &nowhere(), 60.0);
    let gap = end[0].pose.x - end[1].pose.x - 4.6;
    let params = IdmParams::default();
    let free: f64 = 8.0 / params.desired_speed;
    let expected = (params.min_gap + 8.0 * params.time_gap) / (1.0 - free * free * free * free).sqrt();
    assert!((gap - expected).abs() < 0.05, "gap {gap}, theory {expected}");
    assert!((end[1].velocity.x - 8.0).abs() < 0.01);
}

#[test]
fn on_a_free_road_the_law_gives_its_limits() {
    let params = IdmParams::default();
    assert!((idm::acceleration(&params, 0.0, None) - 1.4).abs() < 1e-12);
    assert!(idm::acceleration(&params, params.desired_speed, None).abs() < 1e-12);
    let contact = Some(Leader {
        gap: -1.0,
        speed: 0.0,
    });
    assert!((idm::acceleration(&params, 10.0, contact) + 8.0).abs() < 1e-12);
    // By hand: s* = 2 + 10·1.5 + 10·10/(2·√2.8) = 46.88; (s*/50)² = 0.8791; (10/13.9)⁴ = 0.2679.
    let wall = Some(Leader {
        gap: 50.0,
        speed: 0.0,
    });
    assert!((idm::acceleration(&params, 10.0, wall) - 1.4 * (1.0 - 0.2679 - 0.8791)).abs() < 1e-3);
}

#[test]
fn drivers_stop_behind_a_parked_car_and_behind_the_ego_but_pass_what_leaves_room() {
    let line = straight();
    let mut blocked = agents(vec![
        Behaviour::Parked(Pose::new(120.0, 0.8, 0.3)),
        idm(&line, 10.0, 0.0, 13.0),
    ]);
    let end = last(&mut blocked, &nowhere(), 40.0)[0];
    let tail = 120.0 - 2.3 * libm::cos(0.3) - 0.95 * libm::sin(0.3);
    let gap = tail - (end.pose.x + 2.3);
    assert!(
        end.velocity.norm() < 0.05 && (1.0..3.5).contains(&gap),
        "gap {gap}, {}",
        end.velocity
    );

    let mut behind_ego = agents(vec![idm(&line, 10.0, 0.0, 13.0)]);
    let end = last(&mut behind_ego, &ego_at(100.0, 0.0, 0.0), 40.0)[0];
    let gap = 100.0 - 1.043 - (end.pose.x + 2.3);
    assert!(
        end.velocity.norm() < 0.05 && (1.0..3.5).contains(&gap),
        "gap {gap}"
    );

    let mut passing = agents(vec![
        Behaviour::Parked(Pose::new(60.0, -2.4, 0.0)),
        idm(&line, 10.0, 0.0, 13.0),
    ]);
    assert!(
        last(&mut passing, &nowhere(), 20.0)[0].pose.x > 150.0,
        "there is room beside it"
    );
}

#[test]
fn a_leader_in_a_bend_is_seen_around_it() {
    let bend = line(&road(Pose::new(0.0, 0.0, 0.0), 0.025, 150.0));
    let at = bend.point(100.0);
    let mut agents = agents(vec![
        Behaviour::Parked(Pose::new(at.x, at.y, at.theta)),
        idm(&bend, 10.0, 0.0, 10.0),
    ]);
    let end = last(&mut agents, &nowhere(), 40.0)[0];
    let s = bend.to_frenet(end.pose.position()).s;
    let gap = 100.0 - 2.3 - (s + 2.3);
    assert!(
        end.velocity.norm() < 0.05 && (1.0..3.5).contains(&gap),
        "gap {gap}"
    );
}

#[test]
fn the_order_of_the_obstacles_plays_no_role() {
    let line = straight();
    let mut there = vec![
        idm(&line, 10.0, 0.0, 12.0),
        idm(&line, 30.0, 0.0, 6.0),
        idm(&line, 55.0, 0.0, 9.0),
        Behaviour::Parked(Pose::new(200.0, 0.0, 0.0)),
    ];
    let forth = last(&mut agents(there.clone()), &nowhere(), 15.0);
    there.reverse();
    let mut back = last(&mut agents(there), &nowhere(), 15.0);
    back.reverse();
    for (a, b) in forth.iter().zip(&back) {
        assert_eq!((a.pose, a.velocity), (b.pose, b.velocity));
    }
}

#[test]
fn a_cut_in_is_smooth_complete_and_takes_its_time() {
    let line = straight();
    let mut agents = agents(vec![cut_in(&line, 10.0, Trigger::EgoWithin(15.0))]);
    let before = run(&mut agents, &nowhere(), 1.0);
    assert!(before.iter().all(|all| all[0].pose.y == 3.5), "nobody is near");
    let history = run(&mut agents, &ego_at(25.0, -6.5, 10.0), 6.0);
    let offsets: Vec<f64> = history.iter().map(|all| all[0].pose.y).collect();
    assert!(
        offsets
            .windows(2)
            .all(|w| w[1] <= w[0] + 1e-12 && w[0] - w[1] < 0.02),
        "monotonous, no jump"
    );
    // Half of the quintic after half of the time, all of it after all.
    assert!(
        (offsets[199] - 1.75).abs() < 0.02 && offsets[400].abs() < 1e-9,
        "{}",
        offsets[400]
    );
    let steepest = history
        .iter()
        .map(|all| all[0].pose.theta.abs())
        .fold(0.0, f64::max);
    let peak = libm::atan(3.5 * 1.875 / 4.0 / 10.0);
    assert!(
        (steepest - peak).abs() < 0.01,
        "heading {steepest}, theory {peak}"
    );
    assert_eq!(history.last().unwrap()[0].pose.theta, 0.0);
}

#[test]
fn a_standing_car_does_not_slide_sideways() {
    let line = straight();
    let wall = Behaviour::Parked(Pose::new(25.5, 3.5, 0.0));
    let mut agents = agents(vec![cut_in(&line, 0.0, Trigger::Time(0.5)), wall]);
    let end = last(&mut agents, &nowhere(), 10.0)[0];
    assert!((end.pose.y - 3.5).abs() < 1e-6, "{}", end.pose.y);
}

#[test]
fn a_pedestrian_waits_for_its_trigger_crosses_and_stands() {
    let walker = |trigger| Behaviour::Pedestrian {
        from: Vec2::new(50.0, -4.0),
        to: Vec2::new(50.0, 4.0),
        speed: 1.6,
        trigger,
    };
    let mut timed = agents(vec![walker(Trigger::Time(2.0))]);
    let history = run(&mut timed, &nowhere(), 10.0);
    assert_eq!(history[197][0].pose.y, -4.0);
    assert!((history[399][0].pose.y - (-4.0 + 1.6 * 2.01)).abs() < 1e-9);
    assert_eq!(history[399][0].velocity, Vec2::new(0.0, 1.6));
    let end = history.last().unwrap()[0];
    assert!((end.pose.y - 4.0).abs() < 1e-9 && end.velocity == Vec2::zeros());

    let mut watching = agents(vec![walker(Trigger::EgoWithin(20.0))]);
    assert_eq!(last(&mut watching, &ego_at(29.0, 0.0, 0.0), 3.0)[0].pose.y, -4.0);
    assert!(last(&mut watching, &ego_at(31.0, -1.0, 0.0), 3.0)[0].pose.y > 0.0);
}

#[test]
fn waypoints_are_passed_at_their_times() {
    let at = |t, x, theta| Waypoint {
        t,
        pose: Pose::new(x, 0.0, theta),
    };
    let points = vec![
        at(1.0, 0.0, 3.0),
        at(3.0, 10.0, -3.0),
        at(3.0, 20.0, 0.0),
        at(5.0, 20.0, 0.0),
    ];
    let mut agents = agents(vec![Behaviour::Waypoints(points)]);
    let history = run(&mut agents, &nowhere(), 7.0);
    assert_eq!(history[50][0].pose, Pose::new(0.0, 0.0, 3.0));
    let midway = history[199][0];
    assert!((midway.pose.x - 5.0).abs() < 1e-9 && (midway.velocity.x - 5.0).abs() < 1e-9);
    assert!(
        (midway.pose.theta.abs() - std::f64::consts::PI).abs() < 1e-9,
        "the short way round"
    );
    assert_eq!(history[350][0].pose.x, 20.0);
    assert_eq!(history[650][0].velocity, Vec2::zeros());

    let empty = agents_start(Behaviour::Waypoints(Vec::new()));
    assert_eq!(empty.pose, Pose::new(0.0, 0.0, 0.0));
}

fn agents_start(behaviour: Behaviour) -> BodyPose {
    start_of(&crate::testing::car(0, behaviour))
}

#[test]
fn predictions_go_on_along_the_line_and_see_no_intentions() {
    let bend = line(&road(Pose::new(0.0, 0.0, 0.0), 0.02, 400.0));
    let id = ObstacleId(0);
    let mut steady = agents(vec![Behaviour::ConstantSpeed(along(&bend, 20.0, 2.0, 9.0))]);
    run(&mut steady, &nowhere(), 1.0);
    let expected = steady.predict(id);
    assert_eq!(expected.len(), 17);
    assert_eq!((expected[0].t, expected[16].t), (0.0, 8.0));
    let future = last(&mut steady, &nowhere(), 8.0)[0];
    assert!((future.pose.position() - expected[16].pose.position()).norm() < 0.01);

    let mut cutting = agents(vec![cut_in(&straight(), 10.0, Trigger::Time(0.0))]);
    let now = last(&mut cutting, &nowhere(), 2.0)[0];
    assert!(now.pose.theta < -0.1, "it is in the middle of its move");
    assert!(
        cutting
            .predict(id)
            .iter()
            .skip(1)
            .all(|p| (p.pose.y - now.pose.y).abs() < 1e-9)
    );
}

#[test]
fn who_waits_is_predicted_to_wait_and_who_is_parked_not_at_all() {
    let waiting = Behaviour::Pedestrian {
        from: Vec2::new(50.0, -4.0),
        to: Vec2::new(50.0, 4.0),
        speed: 1.6,
        trigger: Trigger::Time(5.0),
    };
    let agents = agents(vec![waiting, Behaviour::Parked(Pose::new(9.0, 9.0, 0.0))]);
    assert!(
        agents
            .predict(ObstacleId(0))
            .iter()
            .all(|p| (p.pose.x, p.pose.y) == (50.0, -4.0))
    );
    assert!(agents.moves(ObstacleId(0)) && !agents.moves(ObstacleId(1)));
    assert!(agents.predict(ObstacleId(1)).is_empty() && agents.predict(ObstacleId(7)).is_empty());
}

/// A driver who wants 14 m/s and may choose among these lanes.
fn choosy(line: &Arc<ReferenceLine>, s: f64, l: f64, speed: f64, lanes: &[f64]) -> Behaviour {
    Behaviour::Idm {
        start: along(line, s, l, speed),
        params: IdmParams::default(),
        lane_change: None,
        mobil: Some(Mobil {
            lanes: lanes.to_vec(),
            ..Mobil::default()
        }),
    }
}

#[test]
fn a_slow_leader_is_overtaken_where_there_is_a_free_lane() {
    let line = straight();
    let slow = || Behaviour::ConstantSpeed(along(&line, 60.0, 0.0, 5.0));
    let mut free = agents(vec![slow(), choosy(&line, 10.0, 0.0, 12.0, &[0.0, 3.5])]);
    let history = run(&mut free, &nowhere(), 25.0);
    let end = history.last().unwrap();
    assert!(end[1].pose.x > end[0].pose.x + 10.0, "it has passed: {end:?}");
    assert!(
        history
            .iter()
            .all(|all| all[1].pose.y <= 3.5 + 1e-9 && all[1].velocity.x > 4.0)
    );
    assert!(
        history.iter().any(|all| (all[1].pose.y - 3.5).abs() < 1e-9),
        "in the middle of the lane"
    );

    // Where another column fills that lane it stays behind.
    let column = |k: f64| Behaviour::ConstantSpeed(along(&line, 12.0 * k - 100.0, 3.5, 5.0));
    let mut there = vec![slow(), choosy(&line, 10.0, 0.0, 12.0, &[0.0, 3.5])];
    there.extend((0..25_u8).map(|k| column(f64::from(k))));
    let end = last(&mut agents(there), &nowhere(), 20.0);
    assert!(
        end[1].pose.y.abs() < 1e-9 && end[1].pose.x < end[0].pose.x,
        "{:?}",
        end[1]
    );
    assert!((end[1].velocity.x - 5.0).abs() < 0.5);
}

#[test]
fn nobody_changes_into_the_way_of_the_ego() {
    let line = straight();
    let slow = Behaviour::ConstantSpeed(along(&line, 60.0, 0.0, 5.0));
    let mut agents = agents(vec![slow, choosy(&line, 20.0, 0.0, 12.0, &[0.0, 3.5])]);
    // The ego comes up fast from behind in the other lane, and passes.
    let mut crossed = None;
    for k in 0..1200 {
        let x = -10.0 + 20.0 * f64::from(k) * DT;
        let now = agents.advance(&ego_at(x, 3.5, 20.0), DT)[1];
        if crossed.is_none() && now.pose.y > 0.9 {
            crossed = Some((x, now.pose.x));
        }
    }
    let (ego, car) = crossed.expect("it changes in the end");
    assert!(ego > car + 3.0, "behind the ego: {ego} {car}");
}

#[test]
fn two_who_want_the_same_gap_do_not_take_it_together() {
    let line = straight();
    let slow = |l| Behaviour::ConstantSpeed(along(&line, 60.0, l, 5.0));
    for offset in [0.0, 1.5, 3.0, -3.0] {
        let lanes = [3.5, 0.0, -3.5];
        let mut agents = agents(vec![
            slow(3.5),
            slow(-3.5),
            choosy(&line, 10.0, 3.5, 12.0, &lanes),
            choosy(&line, 10.0 + offset, -3.5, 12.0, &lanes),
        ]);
        let mut reached = 0;
        for all in run(&mut agents, &nowhere(), 15.0) {
            let (a, b) = (all[2].pose, all[3].pose);
            let apart = (a.x - b.x).abs() > 4.6 || (a.y - b.y).abs() > 1.9;
            assert!(apart, "{a:?} {b:?}");
            reached += usize::from(a.y.abs() < 0.5 || b.y.abs() < 0.5);
        }
        assert!(reached > 0, "one of them changes");
    }
}

#[test]
fn a_triggered_track_begins_when_it_is_set_off() {
    let at = |t, x| Waypoint {
        t,
        pose: Pose::new(x, 3.0, 0.0),
    };
    let mut agents = agents(vec![Behaviour::Triggered {
        trigger: Trigger::EgoWithin(20.0),
        waypoints: vec![at(0.0, 50.0), at(2.0, 54.0)],
    }]);
    assert_eq!(last(&mut agents, &nowhere(), 5.0)[0].pose.x, 50.0);
    let history = run(&mut agents, &ego_at(31.0, 0.0, 8.0), 3.0);
    assert!((history[100][0].pose.x - 52.0).abs() < 1e-9 && (history[100][0].velocity.x - 2.0).abs() < 1e-9);
    let end = history.last().unwrap()[0];
    assert!(end.pose.x == 54.0 && end.velocity == Vec2::zeros());
}
