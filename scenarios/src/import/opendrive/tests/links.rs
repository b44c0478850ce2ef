//! Successors: sections, roads, junctions, and files that lie about them.

use super::{imported, lane, named, road, section, straight, successors};

fn linked(id: i32, before: i32, after: i32) -> String {
    let link = format!(r#"<link><predecessor id="{before}"/><successor id="{after}"/></link>"#);
    lane(id, "driving", 3.0, &link)
}

/// A road along `+x` from `x` with lanes 1 and -1.
fn at(id: &str, x: f64, link: &str, junction: &str) -> String {
    let line = format!(r#"<geometry s="0" x="{x}" y="0" hdg="0" length="100"><line/></geometry>"#);
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

#[test]
fn links_follow_the_driving_direction() {
    let a = at(
        "a",
        0.0,
        &link("successor", "road", "b", r#"contactPoint="start""#),
        "-1",
    );
    let b = at(
        "b",
        100.0,
        &link("predecessor", "road", "a", r#"contactPoint="end""#),
        "-1",
    );
    let import = imported(&(a + &b));
    assert_eq!(successors(&import.map, "a_0_-1"), ["b_0_-1"]);
    assert_eq!(successors(&import.map, "b_0_1"), ["a_0_1"]);
    assert!(successors(&import.map, "b_0_-1").is_empty() && successors(&import.map, "a_0_1").is_empty());
    let predecessors = &named(&import.map, "b_0_-1").predecessors;
    assert_eq!(predecessors, &[import.map.find("a_0_-1").unwrap()]);
}

#[test]
fn ids_change_sign_where_two_ends_meet() {
    // `b` runs from x = 200 back to 100: both roads end at 100, and lane -1 goes on as lane 1.
    let a = at(
        "a",
        0.0,
        &link("successor", "road", "b", r#"contactPoint="end""#),
        "-1",
    );
    let back = r#"<geometry s="0" x="200" y="0" hdg="3.141592653589793" length="100"><line/></geometry>"#;
    let lanes = section(0.0, &linked(1, 9, -1), "", &linked(-1, 9, 1));
    let b = road(
        r#"id="b""#,
        &link("successor", "road", "a", r#"contactPoint="end""#),
        back,
        &lanes,
    );
    let a = a
        .replace(r#"<successor id="1"/>"#, r#"<successor id="-1"/>"#)
        .replacen(
            r#"<predecessor id="-1"/><successor id="-1"/>"#,
            r#"<predecessor id="-1"/><successor id="1"/>"#,
            1,
        );
    let import = imported(&(a + &b));
    assert_eq!(successors(&import.map, "a_0_-1"), ["b_0_1"]);
    assert_eq!(successors(&import.map, "b_0_-1"), ["a_0_1"]);
}

#[test]
fn lanes_that_end_on_each_other_are_not_joined() {
    let a = at(
        "a",
        0.0,
        &link("successor", "road", "b", r#"contactPoint="end""#),
        "-1",
    );
    let back = r#"<geometry s="0" x="200" y="0" hdg="3.141592653589793" length="100"><line/></geometry>"#;
    let lanes = section(0.0, "", "", &lane(-1, "driving", 3.0, ""));
    let import = imported(&(a + &road(r#"id="b""#, "", back, &lanes)));
    assert!(successors(&import.map, "a_0_-1").is_empty());
    let told = "`a_0_-1` and `b_0_-1`: linked lanes that lead against each other";
    assert!(
        import.warnings.iter().any(|w| w.contains(told)),
        "{:?}",
        import.warnings
    );
}

#[test]
fn dust_sections_are_bridged() {
    let lanes = section(0.0, "", "", &linked(-1, -1, -2))
        + &section(50.0, "", "", &(lane(-1, "none", 0.0, "") + &linked(-2, -1, -3)))
        + &section(
            50.000_000_000_1,
            "",
            "",
            &(lane(-1, "none", 0.0, "") + &lane(-2, "none", 0.0, "") + &linked(-3, -2, -3)),
        );
    let import = imported(&straight(r#"id="1""#, "", &lanes));
    assert_eq!(successors(&import.map, "1_0_-1"), ["1_2_-3"]);
    assert!(import.map.find("1_1_-2").is_none());
    assert!(
        import.warnings.iter().any(|w| w.contains("shorter than 1 mm")),
        "{:?}",
        import.warnings
    );
}

#[test]
fn junctions_lead_through_their_connecting_roads() {
    let a = at("a", 0.0, &link("successor", "junction", "j", ""), "-1");
    let through = at(
        "t",
        100.0,
        &link("successor", "road", "b", r#"contactPoint="start""#),
        "j",
    );
    let b = at("b", 200.0, &link("predecessor", "junction", "j", ""), "-1");
    let junction = r#"<junction id="j" name=""><connection id="0" incomingRoad="a" connectingRoad="t"
        contactPoint="start"><laneLink from="-1" to="-1"/><laneLink from="-7" to="-7"/></connection></junction>"#;
    let import = imported(&(a + &through + &b + junction));
    assert_eq!(successors(&import.map, "a_0_-1"), ["t_0_-1"]);
    assert_eq!(successors(&import.map, "t_0_-1"), ["b_0_-1"]);
    let junction = named(&import.map, "t_0_-1").junction.unwrap();
    assert_eq!(import.map.junctions()[junction.0 as usize].name, "j");
    assert!(named(&import.map, "a_0_-1").junction.is_none());
    assert!(
        import.warnings.iter().any(|w| w.contains("does not exist")),
        "lane -7: {:?}",
        import.warnings
    );
}

#[test]
fn direct_junctions_join_roads_without_one_between() {
    let a = at("a", 0.0, &link("successor", "junction", "j", ""), "-1");
    let b = at("b", 100.0, &link("predecessor", "junction", "j", ""), "-1");
    let junction = r#"<junction id="j" type="direct"><connection id="0" incomingRoad="a" linkedRoad="b"
        contactPoint="start"><laneLink from="-1" to="-1"/></connection></junction>"#;
    assert_eq!(
        successors(&imported(&(a + &b + junction)).map, "a_0_-1"),
        ["b_0_-1"]
    );
}

#[test]
fn links_that_do_not_meet_are_refused_and_told() {
    let a = at(
        "a",
        0.0,
        &link("successor", "road", "b", r#"contactPoint="start""#),
        "-1",
    );
    let import = imported(&(a + &at("b", 100.7, "", "-1")));
    assert!(successors(&import.map, "a_0_-1").is_empty());
    let told = "`a_0_-1` ends 0.70 m away from the start of `b_0_-1`";
    assert!(
        import.warnings.iter().any(|w| w.contains(told)),
        "{:?}",
        import.warnings
    );
}

#[test]
fn lanes_that_meet_without_a_link_are_joined_and_told() {
    let import = imported(&(at("a", 0.0, "", "-1") + &at("b", 100.1, "", "-1")));
    assert_eq!(successors(&import.map, "a_0_-1"), ["b_0_-1"]);
    assert_eq!(successors(&import.map, "b_0_1"), ["a_0_1"]);
    assert!(
        import.warnings.iter().any(|w| w.contains("not linked")),
        "{:?}",
        import.warnings
    );
}

#[test]
fn links_in_a_circle_end() {
    // A ring of dust: every section is bridged, and the links go round.
    let dust = |id: &str, next: &str| {
        let line = r#"<geometry s="0" x="100" y="0" hdg="0" length="1e-7"><line/></geometry>"#;
        let links = link("successor", "road", next, r#"contactPoint="start""#);
        let lanes = section(0.0, "", "", &linked(-1, -1, -1));
        road(&format!(r#"id="{id}""#), &links, line, &lanes).replace("length=\"100\"", "length=\"1e-7\"")
    };
    let a = at(
        "a",
        0.0,
        &link("successor", "road", "x", r#"contactPoint="start""#),
        "-1",
    );
    let import = imported(&(a + &dust("x", "y") + &dust("y", "x")));
    assert!(successors(&import.map, "a_0_-1").is_empty());
}
