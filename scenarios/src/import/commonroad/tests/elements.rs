//! Each element as it is written, in either version.

use super::{PLAIN, imported, plain_and, plain_but};
use crate::import::commonroad::data::{Interval, Position, Prediction, Role, Shape};
use corridor_decider::geometry::Vec2;

#[test]
fn the_plain_file_is_read_as_written() {
    let file = imported(PLAIN).file;
    assert_eq!(
        (file.version.as_str(), file.benchmark.as_str()),
        ("2020a", "ZAM_Plain-1_1_T-1")
    );
    assert_eq!(
        (file.lanelets.len(), file.obstacles.len(), file.problems.len()),
        (2, 1, 1)
    );
    let problem = &file.problems[0];
    assert_eq!(
        problem.initial.position,
        Some(Position::Point(Vec2::new(20.0, 0.0)))
    );
    assert_eq!(
        problem.goals[0].time,
        Interval {
            low: 30.0,
            high: 40.0
        }
    );
    assert_eq!(problem.goals[0].position, Some(Position::Lanelets(vec![1])));
    assert_eq!(problem.goals[0].velocity, None);
}

#[test]
fn obstacles_of_2018b_name_their_role() {
    let old = PLAIN
        .replace(
            "<staticObstacle id=\"7\">",
            "<obstacle id=\"7\"><role>static</role>",
        )
        .replace("</staticObstacle>", "</obstacle>")
        .replace("2020a", "2018b");
    let read = imported(&old);
    assert_eq!(read.file.obstacles, imported(PLAIN).file.obstacles);
    assert!(read.warnings.is_empty(), "{:?}", read.warnings);
    let message = super::read(&old.replace("static<", "still<"))
        .unwrap_err()
        .to_string();
    assert!(
        message.starts_with("13:20: <role> is `still`; expected static, dynamic, environment or phantom"),
        "{message}"
    );
}

#[test]
fn a_shape_is_a_union_of_rectangles_circles_and_polygons() {
    let shapes = "<rectangle><length>4</length><width>2</width><orientation>0.5</orientation><center><x>1</x><y>2</y>\
        </center></rectangle><circle><radius>3</radius></circle><polygon><point><x>0</x><y>0</y></point><point><x>1</x>\
        <y>0</y></point><point><x>0</x><y>1</y></point></polygon>";
    let text = plain_but(
        "<rectangle><length>4.5</length><width>1.8</width></rectangle>",
        shapes,
    );
    let shape = &imported(&text).file.obstacles[0].shape;
    assert_eq!(
        shape[..2],
        [
            Shape::Rectangle {
                length: 4.0,
                width: 2.0,
                orientation: 0.5,
                center: Vec2::new(1.0, 2.0)
            },
            Shape::Circle {
                radius: 3.0,
                center: Vec2::zeros()
            }
        ]
    );
    assert!(matches!(&shape[2], Shape::Polygon(corners) if corners.len() == 3));
}

#[test]
fn numbers_may_be_intervals_and_stay_so() {
    let uncertain = "<velocity><intervalStart>9</intervalStart><intervalEnd>12</intervalEnd></velocity>";
    let file = imported(&plain_but("<velocity><exact>10</exact></velocity>", uncertain)).file;
    let velocity = file.problems[0].initial.velocity.unwrap();
    assert_eq!(velocity, Interval { low: 9.0, high: 12.0 });
    assert!((velocity.middle() - 10.5).abs() < 1e-12 && !velocity.is_exact());
}

#[test]
fn all_roles_and_predictions_are_known() {
    let text = plain_and(
        "<environmentObstacle id=\"8\"><type>building</type><shape><circle><radius>1</radius></circle></shape>\
         </environmentObstacle><phantomObstacle id=\"9\"><occupancySet><occupancy><shape><circle><radius>1</radius>\
         </circle></shape><time><exact>2</exact></time></occupancy></occupancySet></phantomObstacle>",
    );
    let obstacles = imported(&text).file.obstacles;
    let roles: Vec<Role> = obstacles.iter().map(|o| o.role).collect();
    assert_eq!(roles, [Role::Static, Role::Environment, Role::Phantom]);
    assert_eq!(obstacles[1].prediction, Prediction::None);
    assert!(matches!(&obstacles[2].prediction, Prediction::Occupancy(sets) if sets.len() == 1));
}

#[test]
fn lights_and_intersections_are_read_in_old_and_new_words() {
    let text = plain_and(
        "<trafficLight id=\"20\"><cycle><cycleElement><duration>30</duration><color>red</color></cycleElement>\
         <cycleElement><duration>50</duration><color>green</color></cycleElement><timeOffset>10</timeOffset></cycle>\
         <active>true</active></trafficLight><intersection id=\"30\"><incoming id=\"31\"><incomingLanelet ref=\"1\"/>\
         <successorLeft ref=\"2\"/></incoming></intersection><intersection id=\"40\"><incoming id=\"41\">\
         <incomingLanelet ref=\"1\"/><successorsStraight ref=\"2\"/></incoming></intersection>",
    );
    let file = imported(&text).file;
    let light = &file.lights[0];
    assert_eq!(
        light.cycle,
        [("red".to_owned(), 30.0), ("green".to_owned(), 50.0)]
    );
    assert!(light.active && (light.offset - 10.0).abs() < 1e-12);
    for intersection in &file.intersections {
        assert_eq!(
            (&intersection.incoming, &intersection.through),
            (&vec![1], &vec![2])
        );
    }
}

#[test]
fn a_file_is_known_by_its_first_element() {
    use crate::import::commonroad::is_commonroad;
    assert!(is_commonroad(PLAIN));
    assert!(is_commonroad("\u{feff}\n<!-- <osm> --><!DOCTYPE x><commonRoad/>"));
    for other in [
        "",
        "<",
        "<!--",
        "<osm><commonRoad/></osm>",
        "# <commonRoad",
        "<!-- <commonRoad> --><osm/>",
    ] {
        assert!(!is_commonroad(other), "{other}");
    }
}
