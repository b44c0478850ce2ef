//! Junctions of every type: ids that flip, several links of one lane, direct and virtual ones.

use super::{imported, lane, named, road, section, successors};
use corridor_decider::road::RoadMap;

fn linked(id: i32, before: i32, after: i32) -> String {
    let link = format!(r#"<link><predecessor id="{before}"/><successor id="{after}"/></link>"#);
    lane(id, "driving", 3.0, &link)
}

/// A road of lanes 1 and -1 from `x`, `y` on at a heading.
fn at(id: &str, (x, y, hdg): (f64, f64, f64), link: &str, junction: &str) -> String {
    let line = format!(r#"<geometry s="0" x="{x}" y="{y}" hdg="{hdg}" length="100"><line/></geometry>"#);
    let lanes = section(0.0, &linked(1, 1, 1), "", &linked(-1, -1, -1));
    road(
        &format!(r#"id="{id}" junction="{junction}""#),
        link,
        &line,
        &lanes,
    )
}

fn link(kind: &str, element: &str, id: &str, contact: &str) -> String {
    format!(r#"<link><{kind} elementType="{element}" elementId="{id}" {contact}/></link>"#)
}

fn predecessors<'a>(map: &'a RoadMap, name: &str) -> Vec<&'a str> {
    let ids = &named(map, name).predecessors;
    ids.iter().map(|id| map.lane(*id).name.as_str()).collect()
}

const ROUND: f64 = std::f64::consts::PI;

/// The connecting road `t` runs from x = 200 back to 100, so that its end touches `a`, whose lane -1 goes on as 1.
#[test]
fn ids_flip_where_the_end_of_the_connecting_road_touches() {
    let a = at(
        "a",
        (0.0, 0.0, 0.0),
        &link("successor", "junction", "j", ""),
        "-1",
    );
    let to_b = link("predecessor", "road", "b", r#"contactPoint="start""#);
    let through = at("t", (200.0, 0.0, ROUND), &to_b, "j");
    let through = through.replacen(r#"<predecessor id="1"/>"#, r#"<predecessor id="-1"/>"#, 1);
    let b = at(
        "b",
        (200.0, 0.0, 0.0),
        &link("predecessor", "junction", "j", ""),
        "-1",
    );
    let junction = r#"<junction id="j"><connection id="0" incomingRoad="a" connectingRoad="t" contactPoint="end">
        <laneLink from="-1" to="1"/></connection></junction>"#;
    let map = imported(&(a + &through + &b + junction)).map;
    assert_eq!(successors(&map, "a_0_-1"), ["t_0_1"]);
    assert_eq!(successors(&map, "t_0_1"), ["b_0_-1"]);
}

/// Two roads lead on from one lane, and a laneLink that names a pavement does no harm.
#[test]
fn one_lane_may_have_several_links() {
    let a = at(
        "a",
        (0.0, 0.0, 0.0),
        &link("successor", "junction", "j", ""),
        "-1",
    );
    let ways = at("t", (100.0, 0.0, 0.0), "", "j") + &at("u", (100.0, 0.0, 0.2), "", "j");
    let connection = |to: &str| {
        format!(
            r#"<connection incomingRoad="a" connectingRoad="{to}" contactPoint="start"><laneLink from="-1" to="-1"/>
            <laneLink from="-2" to="-2"/></connection>"#
        )
    };
    let junction = format!(
        r#"<junction id="j">{}{}</junction>"#,
        connection("t"),
        connection("u")
    );
    let map = imported(&(a + &ways + &junction)).map;
    assert_eq!(successors(&map, "a_0_-1"), ["t_0_-1", "u_0_-1"]);
    assert_eq!(predecessors(&map, "u_0_-1"), ["a_0_-1"]);
}

/// An exit: the through road and the ramp are both successors, as far as they overlap.
#[test]
fn direct_junctions_fork_and_flip() {
    let a = at(
        "a",
        (0.0, 0.0, 0.0),
        &link("successor", "junction", "j", ""),
        "-1",
    );
    let on = at(
        "b",
        (100.0, 0.0, 0.0),
        &link("predecessor", "junction", "j", ""),
        "-1",
    );
    // The ramp was drawn from its far end.
    let far = (
        100.0 + 100.0 * libm::cos(0.1),
        100.0 * libm::sin(0.1),
        ROUND + 0.1,
    );
    let ramp = at("r", far, &link("successor", "junction", "j", ""), "-1");
    let junction = r#"<junction id="j" type="direct"><connection incomingRoad="a" linkedRoad="b" contactPoint="start">
        <laneLink from="-1" to="-1" overlapZone="30"/></connection><connection incomingRoad="a" linkedRoad="r"
        contactPoint="end"><laneLink from="-1" to="1" overlapZone="30"/></connection></junction>"#;
    let map = imported(&(a + &on + &ramp + junction)).map;
    assert_eq!(successors(&map, "a_0_-1"), ["b_0_-1", "r_0_1"]);
    assert!(
        map.lanes().iter().all(|lane| lane.junction.is_none()),
        "no road lies inside"
    );
}

/// A drive that leaves the main road at station 40 and one that joins it at 60.
fn virtual_junction(lane_links: bool) -> String {
    let main = at("m", (0.0, 0.0, 0.0), "", "-1");
    let middle = |kind: &str, s: f64| link(kind, "road", "m", &format!(r#"elementS="{s}" elementDir="+""#));
    let one = |id: &str, place: (f64, f64, f64), link: &str| {
        let line = format!(
            r#"<geometry s="0" x="{}" y="{}" hdg="{}" length="100"><line/></geometry>"#,
            place.0, place.1, place.2
        );
        let lane = if lane_links {
            linked(-1, -1, -1)
        } else {
            lane(-1, "driving", 3.0, "")
        };
        road(
            &format!(r#"id="{id}" junction="j""#),
            link,
            &line,
            &section(0.0, "", "", &lane),
        )
    };
    // At a small angle about the end of the lane's centre, 1.5 m to the right.
    let (sin, cos) = (libm::sin(-0.3), libm::cos(-0.3));
    let off = one(
        "off",
        (40.0 - 1.5 * sin, -1.5 + 1.5 * cos, -0.3),
        &middle("predecessor", 40.0),
    );
    let (sin, cos) = (libm::sin(0.3), libm::cos(0.3));
    let start = (
        60.0 - 100.0 * cos - 1.5 * sin,
        -1.5 - 100.0 * sin + 1.5 * cos,
        0.3,
    );
    let onto = one("on", start, &middle("successor", 60.0));
    let junction = r#"<junction id="j" type="virtual" mainRoad="m" sStart="40" sEnd="60" orientation="+"><connection
        incomingRoad="m" connectingRoad="off" contactPoint="start"><laneLink from="-1" to="-1"/></connection>
        <connection incomingRoad="m" connectingRoad="on" contactPoint="end"><laneLink from="-1" to="-1"/></connection>
        </junction>"#;
    main + &off + &onto + junction
}

#[test]
fn virtual_junctions_leave_and_join_a_road_in_its_middle() {
    for lane_links in [true, false] {
        let import = imported(&virtual_junction(lane_links));
        let map = &import.map;
        assert_eq!(
            successors(map, "m_0_-1"),
            ["m_1_-1", "off_0_-1"],
            "{:?}",
            import.warnings
        );
        assert_eq!(successors(map, "m_1_-1"), ["m_2_-1"]);
        assert_eq!(predecessors(map, "m_2_-1"), ["m_1_-1", "on_0_-1"]);
        assert_eq!(
            successors(map, "m_2_1"),
            ["m_1_1"],
            "traffic the other way passes"
        );
        assert!((named(map, "m_1_1").length() - 20.0).abs() < 1e-9);
        let gaps = import.warnings.iter().filter(|w| w.contains("not joined"));
        assert_eq!(gaps.count(), 0, "{:?}", import.warnings);
    }
}

#[test]
fn stations_beyond_the_road_join_nothing() {
    for station in ["-5", "1e300", "0.0000001", "100"] {
        let text = virtual_junction(true).replace(r#"elementS="40""#, &format!(r#"elementS="{station}""#));
        let map = imported(&text).map;
        assert_eq!(successors(&map, "m_0_-1"), ["m_1_-1"], "{station}");
        assert!(predecessors(&map, "off_0_-1").is_empty());
    }
}

#[test]
fn many_branches_from_a_wide_road_end() {
    let wide: String = (1..=2000).map(|k| lane(-k, "sidewalk", 0.01, "")).collect();
    let lanes = section(0.0, &lane(1, "driving", 3.0, ""), "", &wide);
    let line = r#"<geometry s="0" x="0" y="0" hdg="0" length="100"><line/></geometry>"#;
    let mut text = road(r#"id="m""#, "", line, &lanes);
    for k in 0..200 {
        let to = link(
            "predecessor",
            "road",
            "m",
            &format!(r#"elementS="{}""#, 0.4 * f64::from(k)),
        );
        text.push_str(&at(&k.to_string(), (0.0, 50.0 + f64::from(k), 0.0), &to, "-1"));
    }
    let import = imported(&text);
    assert!(
        import.warnings.iter().any(|w| w.contains("too wide a road")),
        "{:?}",
        import.warnings
    );
}
