//! Two straight roads made by hand, 600 m each, and shorthand for scenarios on them.
//!
//! `street`: one lane each way, 3.5 m, a parking strip of 2.5 m to the right. `dual`: two lanes our way, an oncoming
//! one behind a solid line, a stopping lane of 3 m to the right. Both have a junction from 500 to 520 m.

use corridor_decider::road::{
    BoundaryType, Junction, JunctionId, Lane, LaneId, LaneKind, LanePoint, Mark, Neighbour, RoadMap, Side,
};
use corridor_scenarios::{Family, LoadedMap, MapCache, Rejection, Scenario, ScenarioError};
use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;

const WIDTH: f64 = 3.5;
const JUNCTION: (f64, f64) = (500.0, 520.0);
const END: f64 = 600.0;

/// One lane on `[from, to]` of the axis, centred at `y`; `ahead` tells its direction.
fn lane(name: &str, (from, to): (f64, f64), y: f64, ahead: bool, road: (f64, f64)) -> Lane {
    let length = to - from;
    let point = |k: u32| {
        let s = f64::from(k) * 0.5;
        LanePoint {
            s,
            x: if ahead { from + s } else { to - s },
            y,
            theta: if ahead { 0.0 } else { PI },
            kappa: 0.0,
            left: WIDTH / 2.0,
            right: WIDTH / 2.0,
            road_left: if ahead { road.1 - y } else { y - road.0 },
            road_right: if ahead { y - road.0 } else { road.1 - y },
            speed_limit: f64::INFINITY,
        }
    };
    let mark = |kind| vec![Mark { s: 0.0, kind }];
    Lane {
        name: name.to_owned(),
        kind: LaneKind::Driving,
        road: "road".to_owned(),
        junction: None,
        points: (0..=1200)
            .take_while(|k| f64::from(*k) * 0.5 <= length)
            .map(point)
            .collect(),
        left_marks: mark(BoundaryType::DottedWhite),
        right_marks: mark(BoundaryType::SolidWhite),
        neighbours: [None; 4],
        predecessors: Vec::new(),
        successors: Vec::new(),
    }
}

fn strip(name: &str, y: f64, width: f64, kind: LaneKind) -> Lane {
    let mut strip = lane(name, (0.0, END), y, true, (0.0, 0.0));
    strip.kind = kind;
    for point in &mut strip.points {
        (point.left, point.right) = (width / 2.0, width / 2.0);
    }
    strip
}

/// Three lanes in a row, through the junction; the first is `{name}a`.
fn chain(lanes: &mut Vec<Lane>, name: &str, y: f64, ahead: bool, road: (f64, f64)) -> u32 {
    let first = u32::try_from(lanes.len()).unwrap();
    let mut stretches = [(0.0, JUNCTION.0), JUNCTION, (JUNCTION.1, END)];
    if !ahead {
        stretches.reverse();
    }
    for (k, stretch) in (0..).zip(stretches) {
        let suffix = char::from(b'a' + k);
        let mut next = lane(&format!("{name}{suffix}"), stretch, y, ahead, road);
        let id = first + u32::from(k);
        next.junction = (k == 1).then_some(JunctionId(0));
        next.predecessors = if k > 0 { vec![LaneId(id - 1)] } else { Vec::new() };
        next.successors = if k < 2 { vec![LaneId(id + 1)] } else { Vec::new() };
        lanes.push(next);
    }
    first
}

fn neighbours(lanes: &mut [Lane], of: u32, side: Side, reverse: bool, other: u32) {
    for k in 0..3 {
        let kind = Neighbour { side, reverse };
        let there = if reverse { other + 2 - k } else { other + k };
        lanes[(of + k) as usize].neighbours[kind.index()] = Some(LaneId(there));
    }
}

pub(crate) fn street() -> RoadMap {
    let road = (-WIDTH / 2.0 - 2.5, WIDTH * 1.5);
    let mut lanes = Vec::new();
    let own = chain(&mut lanes, "own_", 0.0, true, road);
    let oncoming = chain(&mut lanes, "oncoming_", WIDTH, false, road);
    neighbours(&mut lanes, own, Side::Left, true, oncoming);
    neighbours(&mut lanes, oncoming, Side::Left, true, own);
    lanes.push(strip("bays", -WIDTH / 2.0 - 1.25, 2.5, LaneKind::Parking));
    RoadMap::new(lanes, vec![Junction { name: "j".to_owned() }]).unwrap()
}

pub(crate) fn dual() -> RoadMap {
    let road = (-WIDTH / 2.0 - 3.0, WIDTH * 2.5);
    let mut lanes = Vec::new();
    let right = chain(&mut lanes, "right_", 0.0, true, road);
    let left = chain(&mut lanes, "left_", WIDTH, true, road);
    let oncoming = chain(&mut lanes, "oncoming_", 2.0 * WIDTH, false, road);
    neighbours(&mut lanes, right, Side::Left, false, left);
    neighbours(&mut lanes, left, Side::Right, false, right);
    neighbours(&mut lanes, left, Side::Left, true, oncoming);
    for lane in &mut lanes[left as usize..oncoming as usize] {
        lane.left_marks[0].kind = BoundaryType::SolidWhite;
        lane.right_marks[0].kind = BoundaryType::DottedWhite;
    }
    lanes.push(strip("stopping", -WIDTH / 2.0 - 1.5, 3.0, LaneKind::Stop));
    RoadMap::new(lanes, vec![Junction { name: "j".to_owned() }]).unwrap()
}

/// Both roads by name.
pub(crate) fn maps() -> MapCache {
    let maps = MapCache::new();
    for (name, map) in [("street", street()), ("dual", dual())] {
        let map = LoadedMap {
            map: Arc::new(map),
            text: "".into(),
            warnings: Arc::new([]),
            objects: Arc::new([]),
        };
        maps.insert(name, map);
    }
    maps
}

/// A family on one of the two roads; `text` lacks the description only.
pub(crate) fn family(text: &str) -> Family {
    try_family(text).unwrap_or_else(|e| panic!("{e}"))
}

pub(crate) fn try_family(text: &str) -> Result<Family, ScenarioError> {
    let text = format!("description = 'test'\n{text}");
    Family::parse_with(&text, "test.toml", Path::new(""), &maps())
}

/// The scenario of seed 0.
pub(crate) fn scenario(text: &str) -> Scenario {
    family(text).draw(0).unwrap_or_else(|e| panic!("{e}")).scenario
}

/// Why a fixed scenario is impossible.
pub(crate) fn rejection(text: &str) -> Rejection {
    let family = family(text);
    assert!(family.is_fixed());
    match family.draw(0) {
        Err(corridor_scenarios::DrawError::Impossible { reason, .. }) => reason,
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("possible: {text}"),
    }
}
