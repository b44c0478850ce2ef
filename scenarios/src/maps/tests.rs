//! Every map of the project loads without a warning, and its routes are smooth.

use super::{embedded, names};
use crate::import::opendrive;
use corridor_decider::geometry::angle;
use corridor_decider::reference_line::{LineQuery, ReferenceLine};
use corridor_decider::road::{BoundaryType, Lane, LaneId, LaneKind, Neighbour, RoadMap, Side};

/// Largest jump of heading from one sample to the next beyond what the curvature explains, rad.
const HEADING_JUMP: f64 = 1e-3;

fn map(name: &str) -> RoadMap {
    let import = opendrive::read(embedded(name).unwrap()).unwrap();
    assert_eq!(import.warnings, Vec::<String>::new(), "{name}");
    import.map
}

fn lane<'a>(map: &'a RoadMap, name: &str) -> &'a Lane {
    map.lane(map.find(name).unwrap_or_else(|| panic!("no lane `{name}`")))
}

/// Every sequence of drivable lanes from one that nothing leads to, to one that leads nowhere.
fn routes(map: &RoadMap) -> Vec<Vec<LaneId>> {
    let ids = (0u32..)
        .zip(map.lanes())
        .filter(|(_, lane)| lane.kind.is_drivable());
    let mut open: Vec<Vec<LaneId>> = ids
        .filter(|(_, lane)| lane.predecessors.is_empty())
        .map(|(id, _)| vec![LaneId(id)])
        .collect();
    let mut routes = Vec::new();
    while let Some(route) = open.pop() {
        let successors = &map.lane(route[route.len() - 1]).successors;
        if successors.is_empty() {
            routes.push(route);
            continue;
        }
        for &next in successors {
            assert!(!route.contains(&next), "the map has a loop");
            open.push(route.iter().copied().chain([next]).collect());
        }
    }
    routes
}

fn assert_smooth(line: &ReferenceLine, what: &str) {
    for pair in line.samples().windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        let step = b.s - a.s;
        assert!(step > 0.0 && step < 0.6, "{what}: step of {step} at {}", a.s);
        let turn = angle::difference(b.point.theta, a.point.theta);
        let explained = 0.5 * step * (a.point.kappa + b.point.kappa);
        assert!(
            (turn - explained).abs() < HEADING_JUMP,
            "{what}: heading jumps {turn} at {}",
            a.s
        );
        let chord = libm::atan2(b.point.y - a.point.y, b.point.x - a.point.x);
        let off = angle::difference(chord, a.point.theta + 0.5 * turn);
        assert!(
            off.abs() < HEADING_JUMP,
            "{what}: the line leaves its heading by {off} at {}",
            a.s
        );
    }
}

#[test]
fn all_routes_of_all_maps_are_smooth() {
    for (name, count) in names().zip([3, 12, 2, 2]) {
        let map = map(name);
        let routes = routes(&map);
        assert_eq!(routes.len(), count, "{name}");
        for route in routes {
            let line = ReferenceLine::along(&map, &route).unwrap();
            assert_smooth(&line, &format!("{name} from {}", map.lane(route[0]).name));
        }
    }
}

#[test]
fn the_urban_street_has_kerbside_parking_and_an_oncoming_lane() {
    let map = map("urban_parking");
    let ego = lane(&map, "1_0_-1");
    assert!((ego.length() - 600.0).abs() < 1e-6);
    let at = ego.at(300.0);
    assert!((at.left - 1.75).abs() < 1e-9 && (at.right - 1.75).abs() < 1e-9);
    assert!((at.road_right - (1.75 + 2.5)).abs() < 1e-9, "up to the kerb");
    assert!(
        (at.road_left - (1.75 + 3.5 + 2.5)).abs() < 1e-9,
        "to the other kerb"
    );
    assert!((at.speed_limit - 50.0 / 3.6).abs() < 1e-9);
    let oncoming = ego.neighbour(Neighbour {
        side: Side::Left,
        reverse: true,
    });
    assert_eq!(oncoming, map.find("1_0_1"));
    assert_eq!(ego.neighbours.iter().flatten().count(), 1);
    assert_eq!(ego.mark(Side::Left, 10.0), BoundaryType::DottedWhite);
    assert_eq!(lane(&map, "1_0_-2").kind, LaneKind::Parking);
    assert_eq!(lane(&map, "1_0_-2").mark(Side::Right, 10.0), BoundaryType::Curb);
}

#[test]
fn the_motorway_keeps_to_its_carriageway() {
    let map = map("highway_shoulder");
    let (left, middle, right) = (lane(&map, "1_0_-1"), lane(&map, "1_0_-2"), lane(&map, "1_0_-3"));
    assert!(
        left.neighbour(Neighbour {
            side: Side::Left,
            reverse: true
        })
        .is_none()
    );
    assert_eq!(
        middle.neighbour(Neighbour {
            side: Side::Left,
            reverse: false
        }),
        map.find("1_0_-1")
    );
    assert_eq!(
        middle.neighbour(Neighbour {
            side: Side::Right,
            reverse: false
        }),
        map.find("1_0_-3")
    );
    let at = right.at(600.0);
    assert!(
        (at.road_right - (1.875 + 3.0)).abs() < 1e-9,
        "the hard shoulder belongs to the surface"
    );
    assert!(
        (left.at(600.0).road_left - 1.875).abs() < 1e-9,
        "the inner border does not"
    );
    assert_eq!(right.mark(Side::Right, 600.0), BoundaryType::SolidWhite);
    // The lane outside of the left bend of 1200 m, 1.875 + 3.75 m out.
    assert!((middle.at(450.0).kappa - 1.0 / (1200.0 + 5.625)).abs() < 1e-9);
}

#[test]
fn the_country_road_bends_as_its_comment_says() {
    let map = map("rural_curves");
    let sharpest = |lane: &Lane, sign: f64| lane.points.iter().map(|p| sign * p.kappa).fold(0.0, f64::max);
    let (right, left) = (lane(&map, "1_0_-1"), lane(&map, "1_0_1"));
    assert!((sharpest(right, 1.0) - 1.0 / 81.75).abs() < 1e-9);
    assert!((sharpest(right, -1.0) - 1.0 / 118.25).abs() < 1e-9);
    assert!(
        (sharpest(left, -1.0) - 1.0 / 78.25).abs() < 1e-9,
        "oncoming traffic sees the bends mirrored"
    );
    let shoulder = right
        .points
        .iter()
        .map(|p| p.road_right - p.right)
        .fold(0.0, f64::max);
    assert!(shoulder <= 0.75);
}

#[test]
fn the_street_narrows_to_the_crossing_and_widens_behind_it() {
    let map = map("narrowing_street");
    let (west, east) = (lane(&map, "1_0_-1"), lane(&map, "2_0_-1"));
    let width = |lane: &Lane, s: f64| lane.at(s).left + lane.at(s).right;
    assert!((width(west, 40.0) - 3.5).abs() < 1e-9 && (width(west, 180.0) - 2.75).abs() < 1e-9);
    assert!(
        (width(west, 110.0) - 3.125).abs() < 1e-3,
        "half way down the taper"
    );
    assert!((width(east, 10.0) - 2.75).abs() < 1e-9 && (width(east, 180.0) - 3.5).abs() < 1e-9);
    assert!((west.at(40.0).road_right - (1.75 + 2.2)).abs() < 1e-9);
    assert!(
        (west.at(180.0).road_right - 1.375).abs() < 1e-9,
        "the parking strip has closed"
    );
    assert!((west.at(40.0).speed_limit - 50.0 / 3.6).abs() < 1e-9);
    assert!((west.at(100.0).speed_limit - 30.0 / 3.6).abs() < 1e-9);
    let ways: Vec<&str> = west
        .successors
        .iter()
        .map(|id| map.lane(*id).name.as_str())
        .collect();
    assert_eq!(
        ways,
        ["10_0_-1", "12_0_-1", "13_0_-1"],
        "straight on, right, left"
    );
    assert!(west.successors.iter().all(|id| map.lane(*id).junction.is_some()) && west.junction.is_none());
    assert_eq!(west.mark(Side::Left, 100.0), BoundaryType::DottedWhite);
    assert_eq!(west.mark(Side::Left, 170.0), BoundaryType::SolidWhite);
    // The oncoming lane meets the same lines in the opposite order.
    let oncoming = lane(&map, "1_0_1");
    assert_eq!(oncoming.mark(Side::Left, 10.0), BoundaryType::SolidWhite);
    assert_eq!(oncoming.mark(Side::Left, 30.0), BoundaryType::DottedWhite);
    assert!((oncoming.at(oncoming.length() - 40.0).speed_limit - 50.0 / 3.6).abs() < 1e-9);
    assert!((oncoming.at(40.0).speed_limit - 30.0 / 3.6).abs() < 1e-9);
}

#[test]
fn stations_and_the_line_agree_across_the_crossing() {
    let map = map("narrowing_street");
    let route = ["1_0_-1", "10_0_-1", "2_0_-1"].map(|name| map.find(name).unwrap());
    let line = ReferenceLine::along(&map, &route).unwrap();
    assert!(line.near_junction(200.0, 1.0) && !line.near_junction(100.0, 10.0));
    // West to east 400 m; the tapers add some hundredths of a millimetre.
    assert!((line.length() - 400.0).abs() < 0.01);
}
