//! Numbers of a file end up where they say, on roads whose coordinates are known by hand.

use crate::road::{dual, scenario};
use corridor_decider::frame::{Command, ObstacleKind};
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2};
use corridor_decider::reference_line::LineQuery;
use corridor_scenarios::scenario::{Behaviour, Expectation, Obstacle, Trigger};
use corridor_scenarios::{Family, MapCache};
use std::path::Path;

fn parked(obstacle: &Obstacle) -> Pose {
    match obstacle.behaviour {
        Behaviour::Parked(pose) => pose,
        ref other => panic!("{other:?}"),
    }
}

fn ground(obstacle: &Obstacle) -> ConvexPolygon {
    obstacle.shape.at(parked(obstacle))
}

fn span(body: &ConvexPolygon, axis: usize) -> (f64, f64) {
    let values = body.vertices().iter().map(|v| v[axis]);
    values.fold((f64::MAX, f64::MIN), |(a, b), v| (a.min(v), b.max(v)))
}

fn close(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-9, "{a} is not {b}");
}

#[test]
fn the_ego_starts_where_the_file_says() {
    let s = scenario("map='street'\n[ego]\nlane='own_a'\ns=30\nl=-0.2\nheading=0.1\nspeed=5");
    close(s.ego.pose.x, 30.0);
    close(s.ego.pose.y, -0.2);
    close(s.ego.pose.theta, 0.1);
    close(s.ego.speed, 5.0);
    let usual = scenario("map='street'\ncruise_speed=7");
    close(usual.ego.pose.x, 20.0);
    close(usual.ego.speed, 7.0);
}

#[test]
fn every_datum_measures_what_it_names() {
    let one = |keys: &str| {
        let s = scenario(&format!(
            "map='street'\n[expect]\noutcome='progress_by_gap'\n[[parked]]\nahead=60\nlength=4\nwidth=2\n{keys}"
        ));
        let (x, y) = (
            span(&ground(&s.obstacles[0]), 0),
            span(&ground(&s.obstacles[0]), 1),
        );
        (x, y)
    };
    let centre = one("l=0.5");
    close(centre.0.0, 78.0);
    close(centre.0.1, 82.0);
    close(centre.1.0, -0.5);
    close(one("from='right_edge'\nl=0.3").1.0, -4.25 + 0.3);
    close(one("from='left_edge'\nl=0.3").1.1, 5.25 - 0.3);
    close(one("from='right_lane_line'\nl=0.4").1.1, -1.75 + 0.4);
    close(one("from='left_lane_line'\nl=0.4").1.0, 1.75 - 0.4);
    close(one("lane='oncoming'\nl=0.1").1.0, 3.5 + 0.1 - 1.0);
    close(
        one("lane='oncoming'\nfrom='left_lane_line'\nl=1.0").1.0,
        5.25 - 1.0,
    );
    // Turned across, the body is four metres wide.
    close(
        one("from='right_edge'\nl=0.0\nheading=1.5707963267948966").1.1,
        -0.25,
    );
}

#[test]
fn a_row_keeps_its_spacing_and_its_order() {
    let s = scenario(
        "map='street'\n[[parked]]\nname='row'\nahead=40\nfrom='right_edge'\nl=0.2\ncount=4\nspacing=1.5",
    );
    let spans: Vec<(f64, f64)> = s.obstacles.iter().map(|o| span(&ground(o), 0)).collect();
    for pair in spans.windows(2) {
        close(pair[1].0 - pair[0].1, 1.5);
    }
    let names: Vec<&str> = s.obstacles.iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["row.0", "row.1", "row.2", "row.3"]);
    let ids: Vec<u32> = s.obstacles.iter().map(|o| o.id.0).collect();
    assert_eq!(ids, [0, 1, 2, 3]);
}

#[test]
fn an_outline_replaces_the_size_and_kinds_have_theirs() {
    let s = scenario(
        "map='street'\n[[parked]]\nahead=60\nfrom='right_edge'\npolygon=[[-1,-0.5],[1,-0.5],[0,0.8]]\n\
         [[cone]]\nahead=90\nl=-1.5\n[[parked]]\nkind='truck'\nahead=120\nfrom='right_edge'",
    );
    close(s.obstacles[0].shape.area(), 1.3);
    close(s.obstacles[1].shape.area(), 25.0);
    close(s.obstacles[2].shape.area(), 0.16);
    assert_eq!(s.obstacles[2].kind, ObstacleKind::Cone);
}

#[test]
fn oncoming_traffic_drives_on_its_own_line_towards_us() {
    let s = scenario("map='street'\n[[moving]]\nlane='oncoming'\nahead=150\nspeed=8");
    let Behaviour::ConstantSpeed(start) = &s.obstacles[0].behaviour else {
        panic!("{:?}", s.obstacles[0]);
    };
    let at = start.line.point(start.s);
    close(at.x, 170.0);
    close(at.y, 3.5);
    assert!(start.line.point(start.s + 50.0).x < 121.0);
    close(start.l, 0.0);
}

#[test]
fn traffic_of_our_direction_shares_the_routes_line() {
    let s = scenario(
        "map='dual'\n[[idm]]\nlane='left'\nahead=40\nspeed=8\nlane_change={ to=0.0, duration=3, when={ within=45 } }",
    );
    let Behaviour::Idm {
        start,
        lane_change,
        params,
        mobil: None,
    } = &s.obstacles[0].behaviour
    else {
        panic!("{:?}", s.obstacles[0]);
    };
    close(start.s, 60.0);
    close(start.l, 3.5);
    close(params.desired_speed, 8.0);
    let change = lane_change.unwrap();
    close(change.to_l, 0.0);
    assert_eq!(change.trigger, Trigger::EgoWithin(45.0));
}

#[test]
fn waypoints_and_walks_are_in_world_coordinates() {
    let s = scenario(
        "map='street'\ncruise_speed=5\n[[scripted]]\nahead=60\nfrom='right_edge'\n\
         waypoints=[{after=2,ahead=60,l=-2.9},{after=4,ahead=80,l=-2.9}]\n\
         [[pedestrian]]\nahead=90\nfrom='right_edge'\nl=0.2\nto=5\nspeed=1.4\nwhen={at=60}",
    );
    let Behaviour::Waypoints(points) = &s.obstacles[0].behaviour else {
        panic!("{:?}", s.obstacles[0]);
    };
    let times: Vec<f64> = points.iter().map(|p| p.t).collect();
    assert_eq!(times, [0.0, 2.0, 6.0]);
    close(points[2].pose.x, 100.0);
    close(points[2].pose.theta, 0.0);
    let Behaviour::Pedestrian { from, to, .. } = s.obstacles[1].behaviour else {
        panic!("{:?}", s.obstacles[1]);
    };
    assert!(
        (from - Vec2::new(110.0, -4.25 + 0.2 + 0.3)).norm() < 1e-9,
        "{from}"
    );
    assert!((to - Vec2::new(110.0, 5.0)).norm() < 1e-9, "{to}");
}

#[test]
fn commands_have_their_place_and_their_usual_end() {
    let s = scenario("map='street'\n[command]\nkind='pull_over'\nahead=80\nat=0.5");
    assert_eq!(s.command, Command::PullOver(Vec2::new(100.0, 0.0)));
    assert_eq!(s.expect, Expectation::PulledOver);
    close(s.command_time, 0.5);
    let s = scenario("map='dual'\n[ego]\nlane='right_a'\n[command]\nkind='change_lane'\nside='left'");
    assert_eq!(s.expect, Expectation::LaneChanged);
    let target = s.target_line.unwrap();
    close(target.point(40.0).y, 3.5);
    close(target.length(), 600.0);
    let s = scenario("map='street'\ncruise_speed=5\ntimeout=40");
    assert_eq!(s.expect, Expectation::Progress(0.6 * 5.0 * 40.0));
}

#[test]
fn the_route_goes_straight_on_to_the_end_of_the_map() {
    let s = scenario("map='dual'\n[ego]\nlane='left_a'");
    let map = dual();
    let names: Vec<&str> = s.route.iter().map(|id| map.lane(*id).name.as_str()).collect();
    assert_eq!(names, ["left_a", "left_b", "left_c"]);
    close(s.line.length(), 600.0);
}

/// A barrier across the lane, a post beside the road, paint, and a gantry above.
#[test]
fn what_the_map_puts_on_a_lane_is_there_if_it_is_asked_for() {
    let objects = r#"<objects>
        <object id="7" type="barrier" s="100" t="-1.5" hdg="0.1" length="1" width="3"/>
        <object id="8" type="pole" s="100" t="-60" radius="0.1"/>
        <object id="9" type="crosswalk" s="90" t="0" length="3" width="6"/>
        <object id="10" type="gantry" s="80" t="0" length="1" width="12"/>
        <object id="11" type="obstacle" s="120" t="-1.5" length="1" width="1"><repeat s="120" length="4" distance="2"/></object>
        </objects></road>"#;
    let map = corridor_scenarios::maps::embedded("urban_parking").unwrap();
    let maps = MapCache::holding(&map.replacen("</road>", objects, 1)).unwrap();
    let scenario = |keys: &str| {
        let text = format!(
            "description='x'\nmap='urban_parking'\n{keys}\n[ego]\nlane='1_0_-1'\n[expect]\noutcome='progress_by_gap'\n"
        );
        let family =
            Family::parse_with(&text, "x.toml", Path::new(""), &maps).unwrap_or_else(|e| panic!("{e}"));
        family.draw(1).unwrap_or_else(|e| panic!("{e}")).scenario
    };
    assert_eq!(scenario("").obstacles.len(), 0);
    assert_eq!(scenario("map_objects=false").obstacles.len(), 0);
    let there = scenario("map_objects=true").obstacles;
    let names: Vec<&str> = there.iter().map(|obstacle| obstacle.name.as_str()).collect();
    let expected = [
        "map object 1_7",
        "map object 1_11",
        "map object 1_11 #2",
        "map object 1_11 #3",
    ];
    assert_eq!(names, expected);
    let ground = ground(&there[0]);
    close(ground.area(), 3.0);
    assert!(ground.contains(Vec2::new(100.0, -1.5)), "{ground:?}");
    close(parked(&there[0]).theta, 0.1);
    assert!(
        there
            .iter()
            .enumerate()
            .all(|(k, obstacle)| obstacle.id.0 as usize == k)
    );
}

#[test]
fn a_driver_chooses_among_the_lanes_that_there_are() {
    let lanes = |keys: &str| {
        let s = scenario(&format!(
            "map='dual'\n[[idm]]\nlane='left'\nahead=40\nspeed=8\nmobil={{{keys}}}\n"
        ));
        match &s.obstacles[0].behaviour {
            Behaviour::Idm {
                mobil: Some(mobil), ..
            } => mobil.clone(),
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(lanes("").lanes, [0.0, 3.5]);
    assert_eq!(lanes("lanes=['left','right']").lanes, [3.5]);
    let wishes = lanes("politeness=0.4,threshold=0.3,safe_braking=2,duration=3");
    close(wishes.politeness, 0.4);
    close(wishes.threshold, 0.3);
    close(wishes.safe_braking, 2.0);
    close(wishes.duration, 3.0);
}

#[test]
fn a_door_is_a_body_at_the_side_of_its_car_and_a_timetable_may_wait() {
    let s = scenario(
        "map='street'\ncruise_speed=5\n[[parked]]\nname='car'\nahead=60\nwidth=1.8\nl=-3\ncount=2\nspacing=1\n\
         door={side='left',angle=1.0,duration=1,stays=4,when={within=20}}\n\
         [[scripted]]\nahead=90\nl=-3\nwhen={within=30}\nwaypoints=[{after=2,ahead=95,l=-3}]\n",
    );
    let names: Vec<&str> = s.obstacles.iter().map(|o| o.name.as_str()).collect();
    assert_eq!(
        names,
        ["car.0", "car.0, door", "car.1", "car.1, door", "scripted[0]"]
    );
    let Behaviour::Triggered { trigger, waypoints } = &s.obstacles[1].behaviour else {
        panic!("{:?}", s.obstacles[1]);
    };
    assert_eq!(*trigger, Trigger::EgoWithin(20.0));
    // The hinge is 0.8 m ahead of the car's centre, the door 1.1 m long and 0.04 m beside it.
    close(waypoints[0].pose.x, 80.0 + 0.8 - 0.55);
    close(waypoints[0].pose.y, -3.0 + 0.9 + 0.04);
    close(waypoints.last().unwrap().t, 6.0);
    assert!(matches!(
        s.obstacles[4].behaviour,
        Behaviour::Triggered { trigger: Trigger::EgoWithin(d), .. } if (d - 30.0).abs() < 1e-12
    ));
}
