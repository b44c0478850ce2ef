//! Lane geometry, uses, marks, speeds, neighbours and the road surface.

use super::{imported, lane, named, road, section, straight};
use corridor_decider::geometry::angle;
use corridor_decider::road::{BoundaryType as B, Lane, LaneKind, Neighbour, Side};

const LEFT_FORWARD: Neighbour = Neighbour {
    side: Side::Left,
    reverse: false,
};
const LEFT_REVERSE: Neighbour = Neighbour {
    side: Side::Left,
    reverse: true,
};
const RIGHT_FORWARD: Neighbour = Neighbour {
    side: Side::Right,
    reverse: false,
};
const RIGHT_REVERSE: Neighbour = Neighbour {
    side: Side::Right,
    reverse: true,
};

/// Heading and curvature against differences of positions and headings.
fn assert_derivatives(lane: &Lane) {
    for three in lane.points.windows(3) {
        let (a, at, b) = (&three[0], &three[1], &three[2]);
        let step = b.s - a.s;
        let heading = libm::atan2(b.y - a.y, b.x - a.x);
        let off = angle::difference(heading, at.theta).abs();
        // Central differences over 2 h err by h² / 6 times the third derivative, and uneven steps by more.
        assert!(off < 2e-3, "lane {} at {}: heading off by {off}", lane.name, at.s);
        let kappa = angle::difference(b.theta, a.theta) / step;
        assert!(
            (kappa - at.kappa).abs() < 3e-3,
            "lane {} at {}: {kappa} {}",
            lane.name,
            at.s,
            at.kappa
        );
    }
}

/// A spiral, a moving lane 0 and lanes that widen, all at once.
#[test]
fn centre_lines_have_their_true_heading_and_curvature() {
    let spiral = r#"<geometry s="0" x="5" y="7" hdg="1" length="100"><spiral curvStart="0.02" curvEnd="-0.03"/></geometry>"#;
    let widening =
        r#"<lane id="ID" type="driving"><width sOffset="0" a="3" b="0.02" c="0.0006" d="-0.000006"/></lane>"#;
    let lanes = format!(
        r#"<laneOffset s="0" a="0.5" b="-0.01" c="0.0004" d="0"/>{}"#,
        section(
            0.0,
            &widening.replace("ID", "1"),
            "",
            &(widening.replace("ID", "-1") + &lane(-2, "driving", 4.0, ""))
        )
    );
    let map = imported(&road(r#"id="1""#, "", spiral, &lanes)).map;
    for name in ["1_0_1", "1_0_-1", "1_0_-2"] {
        assert_derivatives(named(&map, name));
    }
    // Against s the same line is seen turned round.
    let oncoming = named(&map, "1_0_1");
    let (first, last) = (oncoming.points[0], oncoming.points[oncoming.points.len() - 1]);
    assert!(
        libm::hypot(last.x - 5.0, last.y - 7.0) < 5.0,
        "ends where the road starts"
    );
    assert!(
        first.kappa > 0.02 && last.kappa < -0.015,
        "{} {}",
        first.kappa,
        last.kappa
    );
}

#[test]
fn borders_give_the_outer_edge_from_lane_0() {
    let right = r#"<lane id="-1" type="driving"><border sOffset="0" a="-3" b="0" c="0" d="0"/></lane>
        <lane id="-2" type="stop"><border sOffset="0" a="-5.5" b="0" c="0" d="0"/></lane>"#;
    let lanes = format!(
        r#"<laneOffset s="0" a="1" b="0" c="0" d="0"/>{}"#,
        section(0.0, "", "", right)
    );
    let map = imported(&straight(r#"id="1""#, "", &lanes)).map;
    let at = named(&map, "1_0_-2").at(50.0);
    assert!((at.y - (1.0 - 4.25)).abs() < 1e-12 && (at.left - 1.25).abs() < 1e-12);
}

#[test]
fn neighbours_follow_the_driving_direction() {
    let right = lane(-1, "driving", 3.0, "") + &lane(-2, "exit", 3.0, "") + &lane(-3, "stop", 3.0, "");
    let lanes = section(0.0, &lane(1, "driving", 3.0, ""), "", &right);
    let keeps_right = imported(&straight(r#"id="1""#, "", &lanes)).map;
    let keeps_left = imported(&straight(r#"id="1" rule="LHT""#, "", &lanes)).map;
    let neighbour = |map: &corridor_decider::road::RoadMap, name: &str, kind| {
        named(map, name)
            .neighbour(kind)
            .map(|id| map.lane(id).name.clone())
    };
    let some = |name: &str| Some(name.to_owned());
    assert_eq!(neighbour(&keeps_right, "1_0_-1", LEFT_REVERSE), some("1_0_1"));
    assert_eq!(neighbour(&keeps_right, "1_0_1", LEFT_REVERSE), some("1_0_-1"));
    assert_eq!(neighbour(&keeps_right, "1_0_-1", RIGHT_FORWARD), some("1_0_-2"));
    assert_eq!(neighbour(&keeps_right, "1_0_-2", LEFT_FORWARD), some("1_0_-1"));
    assert_eq!(
        neighbour(&keeps_right, "1_0_-2", RIGHT_FORWARD),
        None,
        "a shoulder is no neighbour"
    );
    // The same road driven on the other side: everything is mirrored.
    assert_eq!(neighbour(&keeps_left, "1_0_-1", RIGHT_REVERSE), some("1_0_1"));
    assert_eq!(neighbour(&keeps_left, "1_0_-1", LEFT_FORWARD), some("1_0_-2"));
    assert_eq!(neighbour(&keeps_left, "1_0_-1", LEFT_REVERSE), None);
    let first = named(&keeps_left, "1_0_-1").points[0];
    assert!((first.x - 100.0).abs() < 1e-12, "right lanes run against s");
    assert!((first.road_left - 7.5).abs() < 1e-12 && (first.road_right - 4.5).abs() < 1e-12);
}

#[test]
fn a_strip_between_the_carriageways_ends_the_surface() {
    for (strip, separated) in [("border", true), ("median", true), ("driving", false)] {
        let left = lane(1, strip, 0.5, "") + &lane(2, "driving", 3.0, "");
        let lanes = section(0.0, &left, "", &lane(-1, "driving", 3.0, ""));
        let map = imported(&straight(r#"id="1""#, "", &lanes)).map;
        let ego = named(&map, "1_0_-1");
        let expected = if separated { 1.5 } else { 5.0 };
        assert!((ego.at(50.0).road_left - expected).abs() < 1e-12, "{strip}");
        assert!(!separated || ego.neighbour(LEFT_REVERSE).is_none(), "{strip}");
    }
}

#[test]
fn a_narrow_border_before_a_shoulder_is_stepped_over() {
    // Width of the border, the lane beyond, and how far the surface goes from the lane's centre.
    for (border, beyond, road_right) in [
        (0.3, "shoulder", 1.5 + 0.3 + 2.0),
        (0.3, "sidewalk", 1.5),
        (1.2, "shoulder", 1.5),
        (0.0, "parking", 1.5 + 2.0),
    ] {
        let right =
            lane(-1, "driving", 3.0, "") + &lane(-2, "border", border, "") + &lane(-3, beyond, 2.0, "");
        let map = imported(&straight(r#"id="1""#, "", &section(0.0, "", "", &right))).map;
        let at = named(&map, "1_0_-1").at(50.0);
        assert!(
            (at.road_right - road_right).abs() < 1e-12,
            "{border} {beyond}: {}",
            at.road_right
        );
        if beyond == "shoulder" && border < 1.0 {
            let shoulder = named(&map, "1_0_-3").at(50.0);
            assert!(
                (shoulder.road_left - 4.3).abs() < 1e-12,
                "seen from the shoulder too"
            );
        }
    }
}

#[test]
fn marks_are_seen_from_the_lane_and_along_it() {
    let mark = |s: f64, kind: &str, color: &str| {
        format!(r#"<roadMark sOffset="{s}" type="{kind}" color="{color}"/>"#)
    };
    let centre = mark(20.0, "solid broken", "yellow") + &mark(70.0, "solid solid", "standard");
    let left = lane(1, "driving", 3.0, &mark(0.0, "curb", "white"));
    let right = lane(-1, "driving", 3.0, &mark(0.0, "broken solid", "white")) + &lane(-2, "driving", 3.0, "");
    let map = imported(&straight(r#"id="1""#, "", &section(0.0, &left, &centre, &right))).map;
    let (ego, oncoming, outer) = (named(&map, "1_0_-1"), named(&map, "1_0_1"), named(&map, "1_0_-2"));
    // On lane 0 the pair is listed from left to right: the broken line is ours.
    let seen = [10.0, 30.0, 80.0].map(|s| ego.mark(Side::Left, s));
    assert_eq!(seen, [B::Unknown, B::DottedYellow, B::DoubleYellow]);
    let seen = [10.0, 50.0, 90.0].map(|s| oncoming.mark(Side::Left, s));
    assert_eq!(seen, [B::DoubleYellow, B::SolidYellow, B::Unknown]);
    assert_eq!(oncoming.mark(Side::Right, 0.0), B::Curb);
    // Elsewhere from lane 0 outward: broken for the inner lane, solid for the outer one.
    assert_eq!(ego.mark(Side::Right, 50.0), B::DottedWhite);
    assert_eq!(outer.mark(Side::Left, 50.0), B::SolidWhite);
    assert_eq!(outer.mark(Side::Right, 50.0), B::Unknown);
}

#[test]
fn lane_speeds_rule_over_road_speeds() {
    let slow = r#"<speed sOffset="40" max="20" unit="mph"/><speed sOffset="60" max="no limit"/>"#;
    let lanes = section(
        0.0,
        &lane(1, "driving", 3.0, slow),
        "",
        &lane(-1, "driving", 3.0, slow),
    );
    let kind = r#"<type s="10" type="town"><speed max="72" unit="km/h"/></type>"#;
    let import = imported(&straight(r#"id="1""#, kind, &lanes));
    assert_eq!(import.warnings, Vec::<String>::new());
    let speed = |name: &str, s: f64| named(&import.map, name).at(s).speed_limit;
    let mph = 20.0 * 0.447_04;
    for (s, limit) in [
        (5.0, f64::INFINITY),
        (30.0, 20.0),
        (50.0, mph),
        (70.0, f64::INFINITY),
    ] {
        for (name, s) in [("1_0_-1", s), ("1_0_1", 100.0 - s)] {
            let is = speed(name, s);
            assert!(
                is.total_cmp(&limit).is_eq() || (is - limit).abs() < 1e-12,
                "{name} at {s}: {is}"
            );
        }
    }
}

#[test]
fn bays_are_told_from_tapers() {
    let records = |widths: &[(f64, f64, f64)]| {
        let record =
            |(s, a, b): &(f64, f64, f64)| format!(r#"<width sOffset="{s}" a="{a}" b="{b}" c="0" d="0"/>"#);
        let widths: String = widths.iter().map(record).collect();
        let right =
            lane(-1, "driving", 3.0, "") + &format!(r#"<lane id="-2" type="driving">{widths}</lane>"#);
        let map = imported(&straight(r#"id="1""#, "", &section(0.0, "", "", &right))).map;
        named(&map, "1_0_-2").kind
    };
    let bays = [
        (0.0, 0.0, 0.0),
        (20.0, 0.0, 0.5),
        (30.0, 5.0, 0.0),
        (60.0, 5.0, -0.5),
        (70.0, 0.0, 0.0),
    ];
    assert_eq!(records(&bays), LaneKind::Parking);
    assert_eq!(
        records(&[(0.0, 1.8, 0.0)]),
        LaneKind::Parking,
        "a narrow strip that nothing leads to"
    );
    assert_eq!(
        records(&[(0.0, 3.5, 0.0)]),
        LaneKind::Driving,
        "an unlinked lane of full width"
    );
    let taper = [(0.0, 0.0, 0.0), (20.0, 0.0, 0.5), (27.0, 3.5, 0.0)];
    assert_eq!(records(&taper), LaneKind::Driving, "a lane that opens");
}

#[test]
fn cross_sections_are_close_and_lie_on_record_boundaries() {
    let bend = r#"<geometry s="0" x="0" y="0" hdg="0" length="33.3"><line/></geometry>
        <geometry s="33.3" x="33.3" y="0" hdg="0" length="66.7"><arc curvature="0.3"/></geometry>"#;
    let map = imported(&road(
        r#"id="1""#,
        "",
        bend,
        &section(0.0, "", "", &lane(-1, "driving", 2.0, "")),
    ))
    .map;
    let lane = named(&map, "1_0_-1");
    assert!(
        lane.points.iter().any(|p| (p.x - 33.3).abs() < 1e-9),
        "one at the start of the bend"
    );
    for pair in lane.points.windows(2) {
        let step = pair[1].s - pair[0].s;
        assert!(step <= 0.5 + 1e-9);
        let (a, b) = (pair[0].kappa.abs(), pair[1].kappa.abs());
        // A cubic with the right tangents leaves a circle by h⁴ κ³ / 384.
        let error = step * step * step * step * a.min(b) * a.min(b) * a.min(b) / 384.0;
        assert!(step * a.min(b) < 0.051 && error < 1e-7, "{step} {error}");
    }
}

/// At a boundary the record that ends rules the section that ends, and a limit holds from where it is met.
#[test]
fn boundaries_belong_to_the_side_they_are_seen_from() {
    let kink = r#"<laneOffset s="0" a="0" b="0" c="0" d="0"/><laneOffset s="50" a="0" b="0.1" c="0" d="0"/>"#;
    let slow = r#"<speed sOffset="25" max="10"/>"#;
    let lanes = section(
        0.0,
        &lane(1, "driving", 3.0, slow),
        "",
        &lane(-1, "driving", 3.0, slow),
    ) + &section(50.0, "", "", &lane(-1, "driving", 3.0, ""));
    let map = imported(&straight(r#"id="1""#, "", &(kink.to_owned() + &lanes))).map;
    let (before, after) = (named(&map, "1_0_-1"), named(&map, "1_1_-1"));
    assert!(
        before.points[before.points.len() - 1].theta.abs() < 1e-12,
        "straight to its end"
    );
    assert!(
        (after.points[0].theta - libm::atan(0.1)).abs() < 1e-12,
        "aslant from its start"
    );
    let boundary = |lane: &Lane| {
        lane.points
            .iter()
            .find(|p| (p.x - 25.0).abs() < 1e-9)
            .map(|p| p.speed_limit)
    };
    assert_eq!(boundary(before), Some(10.0), "the limit begins here");
    assert_eq!(
        boundary(named(&map, "1_0_1")),
        Some(f64::INFINITY),
        "the limit ends here"
    );
}
