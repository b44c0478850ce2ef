//! What must hold for every map, whatever format it came from.

use crate::support::map_file;
use corridor_decider::geometry::{Vec2, angle};
use corridor_decider::reference_line::{LineError, ReferenceLine};
use corridor_decider::road::{Lane, LaneId, LanePoint, Neighbour, RoadMap};
use corridor_scenarios::import::{apollo, commonroad, lanelet2, opendrive};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What a format and its files promise.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerance {
    /// From the end of a drivable lane to the start of the next, m.
    pub(crate) gap: f64,
    /// Between the headings there, rad.
    pub(crate) turn: f64,
    /// Between the direction of a step along a drivable lane and the mean of the headings at its ends, rad.
    pub(crate) heading: f64,
}

/// Formats whose centre lines the program draws itself: they join exactly.
pub(crate) const DRAWN: Tolerance = Tolerance {
    gap: 0.01,
    turn: 1e-9,
    heading: 0.05,
};

/// Formats whose roads are drawn one by one: they join as well as their author made them.
pub(crate) const GIVEN: Tolerance = Tolerance {
    gap: 0.1,
    turn: 0.05,
    heading: 0.05,
};

/// Shortest step that has a direction worth comparing, m: a rounding of 1e-6 m turns it by a milliradian.
const LEAST_STEP: f64 = 1e-3;

/// How far a length may differ from the sum of its steps, as a share: an arc is longer than its chords.
const STATION_ERROR: f64 = 0.02;

/// Every lane of a map, by itself and beside and behind others.
pub(crate) fn assert_sound(map: &RoadMap, within: Tolerance) {
    for (number, lane) in (0u32..).zip(map.lanes()) {
        let id = LaneId(number);
        assert_neighbours(map, id, lane);
        assert_links(map, id, lane, within);
        assert_widths(lane);
        assert_steps(lane, within);
    }
}

/// The kind of neighbour that one is to one's neighbour: whoever comes towards us has us on the same side.
fn back(kind: Neighbour) -> Neighbour {
    let side = if kind.reverse {
        kind.side
    } else {
        kind.side.opposite()
    };
    Neighbour { side, ..kind }
}

fn assert_neighbours(map: &RoadMap, id: LaneId, lane: &Lane) {
    for kind in Neighbour::ALL {
        if let Some(other) = lane.neighbour(kind) {
            assert!(other != id, "{} is beside itself", lane.name);
            let known = map.neighbour(other, back(kind));
            assert_eq!(known, Some(id), "{} and its neighbour {kind:?}", lane.name);
        }
    }
}

/// Links are known at both ends; drivable lanes meet there and can be followed.
fn assert_links(map: &RoadMap, id: LaneId, lane: &Lane, within: Tolerance) {
    for before in &lane.predecessors {
        assert!(
            map.lane(*before).successors.contains(&id),
            "{} is not known ahead",
            lane.name
        );
    }
    for next in &lane.successors {
        let ahead = map.lane(*next);
        assert!(
            ahead.predecessors.contains(&id),
            "{} is not known behind",
            lane.name
        );
        if !(lane.kind.is_drivable() && ahead.kind.is_drivable()) {
            continue;
        }
        let (end, start) = (lane.points[lane.points.len() - 1], ahead.points[0]);
        let (gap, turn) = (
            apart(&end, &start),
            angle::difference(start.theta, end.theta).abs(),
        );
        assert!(
            gap <= within.gap && turn <= within.turn,
            "{} and {} meet within {gap} m and {turn} rad",
            lane.name,
            ahead.name
        );
        // Two dust lanes in a row meet, but are too short for a line.
        let followed = ReferenceLine::along(map, &[id, *next]);
        assert!(
            matches!(followed, Ok(_) | Err(LineError::TooShort { .. })),
            "{}: {followed:?}",
            lane.name
        );
    }
}

fn apart(a: &LanePoint, b: &LanePoint) -> f64 {
    (b.x - a.x).hypot(b.y - a.y)
}

/// No width is negative, the left edge is left of the right one, and the road is as wide as its lane.
fn assert_widths(lane: &Lane) {
    for p in &lane.points {
        assert!(p.left >= 0.0 && p.right >= 0.0, "{}: {p:?}", lane.name);
        assert!(
            p.road_left >= p.left - 1e-9 && p.road_right >= p.right - 1e-9,
            "{}: {p:?}",
            lane.name
        );
        // By the edges' own places: seen along the heading, the left one is to the left.
        let across = p.offset(p.left) - p.offset(-p.right);
        let (sin, cos) = angle::sin_cos(p.theta);
        let leftward = across.dot(&Vec2::new(-sin, cos));
        assert!(leftward >= -1e-9, "{}: the edges are swapped at {p:?}", lane.name);
    }
}

/// Stations increase as the points do, steps are as fine as promised, and headings are those of the line.
fn assert_steps(lane: &Lane, within: Tolerance) {
    assert!(
        lane.points[0].s.abs() < 1e-12,
        "{} does not begin at 0",
        lane.name
    );
    for pair in lane.points.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        let (step, way, width) = (b.s - a.s, apart(a, b), a.left + a.right);
        assert!(step > 0.0, "{}: stations do not increase at {}", lane.name, a.s);
        // Outer lanes of a bend are sampled as often as its middle.
        assert!(
            step < 0.5 + 0.05 * 20.0 + width,
            "{}: a step of {step}",
            lane.name
        );
        // Lanes beside the traffic, of bays set at an angle, have corners.
        if lane.kind.is_drivable() && way > LEAST_STEP {
            assert!(
                (step - way).abs() <= STATION_ERROR * step,
                "{}: {way} m in a step of {step} at {}",
                lane.name,
                a.s
            );
            let turn = angle::difference(b.theta, a.theta);
            let chord = (b.y - a.y).atan2(b.x - a.x);
            let off = angle::difference(chord, a.theta + turn / 2.0).abs();
            assert!(
                off <= within.heading,
                "{}: heads {off} rad off its line at {}",
                lane.name,
                a.s
            );
        }
    }
}

/// The maps of one ending in a folder, by name.
fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let paths = entries.map(|entry| entry.expect("a folder that can be read").path());
    let mut paths: Vec<PathBuf> = paths
        .filter(|path| path.to_string_lossy().ends_with(ending))
        .collect();
    paths.sort();
    assert!(!paths.is_empty(), "no {ending} in {}", folder.display());
    paths
}

/// Reads one map of any format.
fn read(path: &Path) -> (Arc<RoadMap>, Tolerance) {
    let failed = |error| -> ! { panic!("{}: {error}", path.display()) };
    let name = path.to_string_lossy();
    if name.ends_with(".xodr") {
        let read = opendrive::read_file(path).unwrap_or_else(|error| failed(error));
        return (Arc::new(read.map), GIVEN);
    }
    if name.ends_with(".osm") {
        let read = lanelet2::read_file(path).unwrap_or_else(|error| failed(error));
        return (Arc::new(read.map), DRAWN);
    }
    if name.ends_with(".xml") {
        let read = commonroad::read_file(path).unwrap_or_else(|error| failed(error));
        return (read.map, DRAWN);
    }
    let bytes = std::fs::read(path).expect("a file that was listed");
    let read = apollo::read_map(&bytes).and_then(|data| apollo::to_road_map(&data));
    (Arc::new(read.unwrap_or_else(|error| failed(error)).0), DRAWN)
}

fn assert_all_sound(folder: &Path, ending: &str) {
    for path in files(folder, ending) {
        // Told by the test runner where a check fails.
        let (map, within) = read(&path);
        let checked = std::panic::catch_unwind(|| assert_sound(&map, within));
        assert!(checked.is_ok(), "{} is not sound", path.display());
    }
}

#[test]
fn the_own_maps_are_sound() {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR"));
    assert_all_sound(&tests.join("../scenarios/maps"), ".xodr");
    for ending in [".xodr", ".osm", ".xml", ".apollo.txt", ".apollo.bin"] {
        assert_all_sound(&tests.join("fuzz/corpus"), ending);
    }
}

#[test]
fn the_real_maps_are_sound() {
    for (format, ending) in [
        ("opendrive", ".xodr"),
        ("lanelet2", ".osm"),
        ("commonroad", ".xml"),
        ("apollo", ".base_map.bin"),
        ("apollo", ".base_map.txt"),
    ] {
        let Some(folder) = map_file(format) else { return };
        assert_all_sound(&folder, ending);
    }
}
