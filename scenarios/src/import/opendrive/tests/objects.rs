//! Objects: where they are, how large, how many, and what is told of them.

use super::{imported, lane, road, section};
use crate::import::opendrive::{MapObject, ObjectKind as K, OpenDriveImport};
use corridor_decider::geometry::Vec2;
use std::f64::consts::FRAC_PI_2;

const STRAIGHT: &str = r#"<geometry s="0" x="0" y="0" hdg="0" length="100"><line/></geometry>"#;
const BEND: &str = r#"<geometry s="0" x="0" y="0" hdg="0" length="100"><arc curvature="0.02"/></geometry>"#;

/// A road of 100 m with objects beside one lane.
fn with(geometry: &str, objects: &str) -> OpenDriveImport {
    let lanes = section(0.0, "", "", &lane(-1, "driving", 3.0, ""));
    let text = road(r#"id="1""#, "", geometry, &lanes);
    imported(&text.replace("</road>", &format!("<objects>{objects}</objects></road>")))
}

fn objects(geometry: &str, elements: &str) -> Vec<MapObject> {
    with(geometry, elements).objects
}

fn assert_corners(object: &MapObject, expected: &[(f64, f64)]) {
    let vertices = object.outline.vertices();
    assert_eq!(vertices.len(), expected.len(), "{vertices:?}");
    for &(x, y) in expected {
        let near = |v: &Vec2| (v.x - x).abs() < 1e-9 && (v.y - y).abs() < 1e-9;
        assert!(vertices.iter().any(near), "({x}, {y}) is not in {vertices:?}");
    }
}

#[test]
fn a_box_is_centred_and_turned() {
    let found = objects(
        STRAIGHT,
        r#"<object id="7" type="obstacle" s="20" t="4" hdg="1.5707963267948966" length="3" width="1"/>"#,
    );
    assert_corners(&found[0], &[(19.5, 2.5), (20.5, 2.5), (20.5, 5.5), (19.5, 5.5)]);
    assert_eq!((found[0].name.as_str(), found[0].kind), ("1_7", K::Obstacle));
    assert!((found[0].pose.x - 20.0).abs() < 1e-12 && (found[0].pose.theta - FRAC_PI_2).abs() < 1e-9);
}

#[test]
fn a_circle_is_covered() {
    let tree = &objects(
        STRAIGHT,
        r#"<object id="7" type="tree" s="20" t="4" radius="2"/>"#,
    )[0];
    let area = std::f64::consts::PI * 4.0;
    assert!(tree.outline.area() > area && tree.outline.area() < 1.03 * area);
    for k in 0..100 {
        let angle = 0.0628 * f64::from(k);
        let on = Vec2::new(20.0 + 1.999 * libm::cos(angle), 4.0 + 1.999 * libm::sin(angle));
        assert!(tree.outline.contains(on));
    }
}

#[test]
fn a_thing_without_a_size_is_a_post_and_a_valid_length_is_one() {
    let found = objects(
        STRAIGHT,
        r#"<object id="7" type="pole" s="20" t="4"/><object id="8" type="barrier" s="20" t="4" validLength="6"/>"#,
    );
    assert!((found[0].outline.area() - 0.01).abs() < 1e-12);
    assert!((found[1].outline.area() - 0.6).abs() < 1e-12);
}

#[test]
fn the_lane_offset_does_not_move_objects() {
    let lanes = format!(
        r#"<laneOffset s="0" a="2" b="0" c="0" d="0"/>{}"#,
        section(0.0, "", "", &lane(-1, "driving", 3.0, ""))
    );
    let text = road(r#"id="1""#, "", STRAIGHT, &lanes);
    let object = r#"<objects><object id="7" type="pole" s="20" t="4"/></objects></road>"#;
    let found = imported(&text.replace("</road>", object)).objects;
    assert!((found[0].pose.y - 4.0).abs() < 1e-12);
}

/// The centre of this bend is 50 m to the left.
#[test]
fn corners_follow_the_road_or_the_object() {
    let corners = |first: (f64, f64), second: (f64, f64)| {
        [
            (first.0, first.1),
            (second.0, first.1),
            (second.0, second.1),
            (first.0, second.1),
        ]
    };
    let element = |name: &str, u: &str, v: &str, list: [(f64, f64); 4]| {
        let corner = |(a, b)| format!(r#"<{name} {u}="{a}" {v}="{b}"/>"#);
        let corners: String = list.into_iter().map(corner).collect();
        format!(r#"<outline id="0" closed="true">{corners}</outline>"#)
    };
    let on_road = element("cornerRoad", "s", "t", corners((30.0, 5.0), (40.0, 10.0)));
    let local = element("cornerLocal", "u", "v", corners((-1.0, 0.0), (4.0, 2.0)));
    let found = objects(
        BEND,
        &format!(
            r#"<object id="1" type="parkingSpace" s="0" t="0"><outlines>{on_road}</outlines></object>
            <object id="2" type="parkingSpace" s="30" t="5" hdg="0.1">{local}</object>"#
        ),
    );
    let at = |s: f64, t: f64| {
        let angle = s * 0.02;
        (
            (50.0 - t) * libm::sin(angle),
            50.0 - (50.0 - t) * libm::cos(angle),
        )
    };
    assert_corners(
        &found[0],
        &corners((30.0, 5.0), (40.0, 10.0)).map(|(s, t)| at(s, t)),
    );
    let (x, y) = at(30.0, 5.0);
    let (sin, cos) = (libm::sin(0.7), libm::cos(0.7));
    let turned = |(u, v): (f64, f64)| (x + cos * u - sin * v, y + sin * u + cos * v);
    assert_corners(&found[1], &corners((-1.0, 0.0), (4.0, 2.0)).map(turned));
}

#[test]
fn an_open_outline_is_a_wall_and_a_dented_one_is_told() {
    let outline = |closed: bool| {
        format!(
            r#"<object id="1" type="barrier" s="10" t="0"><outline closed="{closed}"><cornerLocal u="0" v="0"/>
            <cornerLocal u="10" v="0"/><cornerLocal u="0" v="10"/><cornerLocal u="2" v="2"/></outline></object>"#
        )
    };
    let wall = with(STRAIGHT, &outline(false));
    assert_eq!(wall.objects.len(), 3, "one box a side");
    assert!(
        (wall.objects[0].outline.area() - 1.0).abs() < 1e-9,
        "10 m of 0.1 m"
    );
    assert!(wall.warnings.iter().all(|w| !w.contains("hull")));
    let dented = with(STRAIGHT, &outline(true));
    assert_eq!(dented.objects.len(), 1);
    assert!(
        dented.warnings.iter().any(|w| w.contains("taken as its hull")),
        "{:?}",
        dented.warnings
    );
}

#[test]
fn copies_stand_in_steps_and_bring_their_own_values() {
    let found = objects(
        STRAIGHT,
        r#"<object id="1" type="tree" s="2.5" t="0" length="1" width="1"><repeat s="20" length="30" distance="10"
        tStart="4" tEnd="7" widthStart="1" widthEnd="4"/></object>"#,
    );
    let places: Vec<(f64, f64)> = found.iter().map(|o| (o.pose.x, o.pose.y)).collect();
    let expected = [(20.0, 4.0), (30.0, 5.0), (40.0, 6.0), (50.0, 7.0)];
    for ((x, y), (ex, ey)) in places.iter().zip(expected) {
        assert!((x - ex).abs() < 1e-9 && (y - ey).abs() < 1e-9, "{places:?}");
    }
    let areas: Vec<f64> = found.iter().map(|o| o.outline.area()).collect();
    assert!(
        areas
            .iter()
            .zip([1.0, 2.0, 3.0, 4.0])
            .all(|(a, b)| (a - b).abs() < 1e-9),
        "{areas:?}"
    );
    assert_eq!(found.len(), 4);
    assert!(found.iter().all(|o| o.name == "1_1"));
}

#[test]
fn corners_on_the_road_move_with_their_copies() {
    let found = objects(
        STRAIGHT,
        r#"<object id="1" type="parkingSpace" s="2.5" t="0"><repeat s="50" length="5" distance="5" tStart="4" tEnd="4"/>
        <outlines><outline><cornerRoad s="0" t="-1"/><cornerRoad s="5" t="-1"/><cornerRoad s="5" t="1"/>
        <cornerRoad s="0" t="1"/></outline></outlines></object>"#,
    );
    assert_corners(&found[0], &[(47.5, 3.0), (52.5, 3.0), (52.5, 5.0), (47.5, 5.0)]);
    assert_corners(&found[1], &[(52.5, 3.0), (57.5, 3.0), (57.5, 5.0), (52.5, 5.0)]);
}

#[test]
fn a_thing_without_gaps_follows_the_bend() {
    let found = objects(
        BEND,
        r#"<object id="1" type="railing" s="0" t="0" width="0.4"><repeat s="10" length="500" distance="0" tStart="5"
        tEnd="5"/></object>"#,
    );
    assert!(found.iter().all(|o| o.kind == K::Barrier));
    let centre = Vec2::new(0.0, 50.0);
    for part in &found {
        for vertex in part.outline.vertices() {
            let radius = (vertex - centre).norm();
            assert!(
                (radius - 45.2).abs() < 1e-6 || (radius - 44.8).abs() < 1e-6,
                "{radius}"
            );
        }
    }
    // Nothing is missing between its parts, and it ends with the road.
    let area: f64 = found.iter().map(|o| o.outline.area()).sum();
    assert!((area - 0.4 * 90.0 * 0.9).abs() < 0.05, "{area}");
}

#[test]
fn odd_types_are_kept_and_counted() {
    let import = with(
        STRAIGHT,
        r#"<object id="1" type="-1" s="1" t="4"/><object id="2" type="" s="2" t="4"/><object id="3" s="3" t="4"/>
        <object id="4" type="rail-pole" s="4" t="4"/><object id="5" type="crossWalk" s="5" t="4"/>"#,
    );
    let kinds: Vec<K> = import.objects.iter().map(|o| o.kind).collect();
    assert_eq!(kinds, [K::Other, K::Other, K::Other, K::Pole, K::Crosswalk]);
    assert!(kinds[4].is_flat() && !kinds[3].is_flat());
    let told = "not known is kept as it is (3 of this kind in the file)";
    assert!(
        import.warnings.iter().any(|w| w.contains(told)),
        "{:?}",
        import.warnings
    );
}

#[test]
fn what_is_not_there_is_told() {
    let import = with(
        STRAIGHT,
        r#"<object id="1" type="tree" s="NaN" t="4"/><object id="2" type="tree" s="2" t="1e300"/>
        <object id="3" type="tree" s="0" t="0"><repeat s="150" length="10" distance="1"/></object>
        <object id="4" type="tree" s="0" t="0"><repeat s="5" length="-10" distance="1"/></object>
        <bridge id="5" s="1" length="4" type="concrete"/>"#,
    );
    assert!(import.objects.is_empty());
    for told in [
        "cannot be read is left out (2 of this kind",
        "nothing is on the road's length is left out (2 of this kind",
        "<bridge>: a reference, a tunnel or a bridge",
    ] {
        assert!(
            import.warnings.iter().any(|w| w.contains(told)),
            "{told}: {:?}",
            import.warnings
        );
    }
}
