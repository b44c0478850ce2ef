//! Lanelets as lanes: kinds, lines, limits, neighbours, junctions.

use super::{PLAIN, imported, plain_and, plain_but};
use crate::import::commonroad::CommonRoad;
use corridor_decider::road::{BoundaryType, Lane, LaneKind, Neighbour, Side};

fn lane<'a>(read: &'a CommonRoad, name: &str) -> &'a Lane {
    read.map
        .lane(read.map.find(name).unwrap_or_else(|| panic!("no lane `{name}`")))
}

const LEFT: Neighbour = Neighbour {
    side: Side::Left,
    reverse: false,
};

#[test]
fn lanes_have_the_size_and_place_that_the_bounds_give() {
    let read = imported(PLAIN);
    let one = lane(&read, "1");
    assert!((one.length() - 200.0).abs() < 1e-6);
    for s in [0.0, 77.7, 200.0] {
        let at = one.at(s);
        assert!((at.x - s).abs() < 1e-6 && at.y.abs() < 1e-6 && at.theta.abs() < 1e-9);
        assert!((at.left - 1.75).abs() < 1e-6 && (at.right - 1.75).abs() < 1e-6);
        assert!((at.road_left - 5.25).abs() < 1e-6, "the lane beside is road");
    }
    assert_eq!(one.neighbour(LEFT), read.map.find("2"));
}

#[test]
fn what_one_side_says_of_being_beside_holds_for_both() {
    let read = imported(&plain_but("<adjacentLeft ref=\"2\" drivingDir=\"same\"/>", ""));
    assert_eq!(lane(&read, "1").neighbour(LEFT), read.map.find("2"));
}

#[test]
fn a_lanelet_is_what_the_strictest_of_its_words_says() {
    let kind = |inside: &str| {
        let text = plain_but("<adjacentRight", &format!("{inside}<adjacentRight"));
        lane(&imported(&text), "2").kind
    };
    let kind_of = |words: &[&str]| {
        let joined = words.join("</laneletType><laneletType>");
        kind(&format!("<laneletType>{joined}</laneletType>"))
    };
    assert_eq!(kind_of(&["interstate", "mainCarriageWay"]), LaneKind::Driving);
    assert_eq!(kind_of(&["urban", "busLane"]), LaneKind::Restricted);
    assert_eq!(kind_of(&["interstate", "accessRamp"]), LaneKind::Ramp);
    assert_eq!(kind_of(&["shoulder"]), LaneKind::Shoulder);
    assert_eq!(kind_of(&["urban", "crosswalk"]), LaneKind::Sidewalk);
    assert_eq!(kind("<userOneWay>bus</userOneWay>"), LaneKind::Restricted);
    assert_eq!(
        kind("<userOneWay>bus</userOneWay><userOneWay>car</userOneWay>"),
        LaneKind::Driving
    );
}

#[test]
fn limits_come_from_the_lanelet_or_from_its_signs() {
    let limit = |text: &str| lane(&imported(text), "1").at(5.0).speed_limit;
    assert!(limit(PLAIN).is_infinite());
    let old = plain_but("<adjacentLeft", "<speedLimit>8.5</speedLimit><adjacentLeft");
    assert!((limit(&old) - 8.5).abs() < 1e-12);
    for (number, posted) in [("274", true), ("R2-1", true), ("205", false)] {
        let sign = format!(
            "<trafficSign id=\"50\"><trafficSignElement><trafficSignID>{number}</trafficSignID><additionalValue>13.5\
             </additionalValue></trafficSignElement></trafficSign>"
        );
        let text = plain_and(&sign).replacen("<adjacentLeft", "<trafficSignRef ref=\"50\"/><adjacentLeft", 1);
        let found = limit(&text);
        assert!(
            if posted {
                (found - 13.5).abs() < 1e-12
            } else {
                found.is_infinite()
            },
            "{number}"
        );
    }
}

#[test]
fn lines_are_those_of_the_bounds() {
    let marked = |marking: &str| {
        let bound = "<point><x>200</x><y>1.75</y></point></leftBound>";
        let with = bound.replace(
            "</leftBound>",
            &format!("<lineMarking>{marking}</lineMarking></leftBound>"),
        );
        lane(&imported(&plain_but(bound, &with)), "1").mark(Side::Left, 50.0)
    };
    assert_eq!(marked("dashed"), BoundaryType::DottedWhite);
    assert_eq!(marked("broad_solid"), BoundaryType::SolidWhite);
    assert_eq!(marked("solid_solid"), BoundaryType::DoubleYellow);
    assert_eq!(marked("lowered_curb"), BoundaryType::Curb);
    assert_eq!(marked("unknown"), BoundaryType::Unknown);
}

#[test]
fn lanelets_through_an_intersection_lie_in_a_junction() {
    let text = plain_and(
        "<intersection id=\"30\"><incoming id=\"31\"><incomingLanelet ref=\"1\"/><successorsLeft ref=\"2\"/></incoming>\
         </intersection>",
    );
    let read = imported(&text);
    assert_eq!(read.map.junctions()[0].name, "30");
    assert!(lane(&read, "1").junction.is_none() && lane(&read, "2").junction.is_some());
    let by_type = plain_but(
        "<adjacentRight",
        "<laneletType>intersection</laneletType><adjacentRight",
    );
    assert!(lane(&imported(&by_type), "2").junction.is_some());
}

#[test]
fn references_to_nothing_are_told() {
    let read = imported(&plain_but(
        "<adjacentRight",
        "<successor ref=\"99\"/><adjacentRight",
    ));
    assert_eq!(read.warnings.len(), 1);
    assert!(read.warnings[0].contains("lanelet `99`: a reference to a lanelet that does not exist"));
    assert!(read.warnings[0].starts_with("8:3: "), "{}", read.warnings[0]);
}
