//! Who drives which way: left-hand traffic, reversed lanes, lanes for both directions, and who may change lanes.

use super::{file, imported, lane, named, section, straight, successors};
use crate::import::opendrive::{Settings, read, read_with};
use corridor_decider::road::{BoundaryType as B, Neighbour, RoadMap, Side};

fn neighbour<'a>(map: &'a RoadMap, name: &str, side: Side, reverse: bool) -> Option<&'a str> {
    let id = named(map, name).neighbour(Neighbour { side, reverse })?;
    Some(map.lane(id).name.as_str())
}

/// Two sections of one road; in the middle a lane of the given element.
fn with_middle(middle: &str) -> RoadMap {
    let linked = r#"<link><predecessor id="ID"/><successor id="ID"/></link>"#;
    let inside = |id: i32| linked.replace("ID", &id.to_string());
    let left = lane(1, "driving", 3.0, &inside(1));
    let middle = middle.replace("INSIDE", &inside(-1));
    let right = middle + &lane(-2, "driving", 3.0, &inside(-2));
    let sections = section(0.0, &left, "", &right) + &section(60.0, &left, "", &right);
    imported(&straight(r#"id="1""#, "", &sections)).map
}

fn middle(attributes: &str) -> String {
    format!(r#"<lane id="-1" {attributes}><width sOffset="0" a="3" b="0" c="0" d="0"/>INSIDE</lane>"#)
}

#[test]
fn a_lane_for_both_directions_is_two() {
    for attributes in [r#"type="bidirectional""#, r#"type="driving" direction="both""#] {
        let map = with_middle(&middle(attributes));
        assert_eq!(successors(&map, "1_0_-1"), ["1_1_-1"]);
        assert_eq!(successors(&map, "1_1_-1r"), ["1_0_-1r"]);
        assert!(successors(&map, "1_1_-1").is_empty() && successors(&map, "1_0_-1r").is_empty());
        let (there, back) = (named(&map, "1_0_-1"), named(&map, "1_0_-1r"));
        let first = back.points[0];
        assert!((first.x - 60.0).abs() < 1e-12 && (first.y + 1.5).abs() < 1e-12);
        assert!((there.length() - back.length()).abs() < 1e-12);
        assert!((first.road_left - there.points[0].road_right).abs() < 1e-12);
        assert_eq!(neighbour(&map, "1_0_-2", Side::Left, false), Some("1_0_-1"));
        assert_eq!(neighbour(&map, "1_0_-2", Side::Left, true), Some("1_0_-1r"));
        assert_eq!(neighbour(&map, "1_0_1", Side::Left, false), Some("1_0_-1r"));
        assert_eq!(neighbour(&map, "1_0_1", Side::Left, true), Some("1_0_-1"));
        assert_eq!(neighbour(&map, "1_0_-1r", Side::Left, true), Some("1_0_-2"));
    }
    assert!(
        with_middle(&middle(r#"type="shoulder" direction="both""#))
            .find("1_0_-1r")
            .is_none()
    );
}

#[test]
fn a_reversed_lane_runs_against_its_side() {
    let map = with_middle(&middle(r#"type="driving" direction="reversed""#));
    assert_eq!(successors(&map, "1_1_-1"), ["1_0_-1"]);
    assert_eq!(neighbour(&map, "1_0_-2", Side::Left, true), Some("1_0_-1"));
    assert_eq!(neighbour(&map, "1_0_1", Side::Left, false), Some("1_0_-1"));
}

#[test]
fn lanes_for_both_directions_lead_on_into_each_other_and_into_others() {
    let links = |before: i32, after: i32| {
        format!(r#"<link><predecessor id="{before}"/><successor id="{after}"/></link>"#)
    };
    // A narrow place of one lane: its other direction goes on in lane 1.
    let narrow = section(
        0.0,
        "",
        "",
        &middle(r#"type="bidirectional""#).replace("INSIDE", &links(-1, -1)),
    );
    let wide = section(
        60.0,
        &lane(1, "driving", 3.0, &links(-1, 1)),
        "",
        &lane(-1, "driving", 3.0, &links(-1, -1)),
    );
    let offset =
        r#"<laneOffset s="0" a="0" b="0" c="0" d="0"/><laneOffset s="60" a="-1.5" b="0" c="0" d="0"/>"#;
    let import = imported(&straight(r#"id="1""#, "", &(offset.to_owned() + &narrow + &wide)));
    // 1.5 m beside each other, they do not meet, but nobody says that they lead against each other.
    assert!(successors(&import.map, "1_1_1").is_empty());
    assert!(
        import.warnings.iter().all(|w| !w.contains("against each other")),
        "{:?}",
        import.warnings
    );
    let shared = straight(r#"id="1""#, "", &(narrow + &wide));
    assert_eq!(successors(&imported(&shared).map, "1_0_-1"), ["1_1_-1"]);
}

#[test]
fn left_hand_traffic_runs_through_links_the_other_way() {
    let linked = r#"<link><predecessor id="-1"/><successor id="-1"/></link>"#;
    let at = |id: &str, x: f64, rule: &str, link: &str| {
        let sections = section(0.0, "", "", &lane(-1, "driving", 3.0, linked));
        let text = straight(&format!(r#"id="{id}" {rule}"#), link, &sections);
        text.replace(r#"x="0""#, &format!(r#"x="{x}""#))
    };
    let to_b = r#"<link><successor elementType="road" elementId="b" contactPoint="start"/></link>"#;
    let roads = |rule| at("a", 0.0, rule, to_b) + &at("b", 100.0, rule, "");
    assert_eq!(successors(&imported(&roads("")).map, "a_0_-1"), ["b_0_-1"]);
    let left = imported(&roads(r#"rule="LHT""#)).map;
    assert_eq!(successors(&left, "b_0_-1"), ["a_0_-1"]);
    assert!(successors(&left, "a_0_-1").is_empty());
}

#[test]
fn a_lane_change_is_forbidden_only_when_the_file_is_trusted() {
    let mark = |kind: &str, change: &str| {
        let mark = format!(r#"<roadMark sOffset="0" type="{kind}" color="yellow" laneChange="{change}"/>"#);
        let right = lane(-1, "driving", 3.0, &mark) + &lane(-2, "driving", 3.0, "");
        let text = file(&straight(r#"id="1""#, "", &section(0.0, "", "", &right)));
        let trusting = Settings {
            trust_lane_change: true,
        };
        [read(&text).unwrap(), read_with(&text, trusting).unwrap()].map(|import| {
            let inner = named(&import.map, "1_0_-1").mark(Side::Right, 50.0);
            let outer = named(&import.map, "1_0_-2").mark(Side::Left, 50.0);
            (inner, outer)
        })
    };
    let (dotted, solid) = (B::DottedYellow, B::SolidYellow);
    for (change, inner, outer) in [
        ("both", dotted, dotted),
        ("none", solid, solid),
        ("increase", solid, dotted),
        ("decrease", dotted, solid),
    ] {
        assert_eq!(
            mark("broken", change),
            [(dotted, dotted), (inner, outer)],
            "{change}"
        );
    }
    assert_eq!(
        mark("solid", "both"),
        [(solid, solid); 2],
        "nothing is allowed that the type forbids"
    );
    assert_eq!(mark("curb", "none"), [(B::Curb, B::Curb); 2]);
}
