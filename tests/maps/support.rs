//! Finding the maps, and questions that every map is asked.

use corridor_decider::geometry::angle;
use corridor_decider::reference_line::ReferenceLine;
use corridor_decider::road::{Lane, LaneId, LaneKind, RoadMap};
use std::path::{Path, PathBuf};

/// A file of the maps folder; `None`, said on the way, when there is no such folder.
pub(crate) fn map_file(name: &str) -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/maps");
    let folder = std::env::var_os("CORRIDOR_MAPS").map_or(beside, PathBuf::from);
    if folder.is_dir() {
        return Some(folder.join(name));
    }
    assert!(
        std::env::var_os("CORRIDOR_REQUIRE_MAPS").is_none(),
        "no maps in `{}`, but CORRIDOR_REQUIRE_MAPS is set",
        folder.display()
    );
    #[expect(
        clippy::print_stdout,
        reason = "whoever runs the tests must see that this one did nothing"
    )]
    {
        println!("skipped: no maps");
    }
    None
}

pub(crate) fn named<'a>(map: &'a RoadMap, name: &str) -> &'a Lane {
    map.lane(map.find(name).unwrap_or_else(|| panic!("no lane `{name}`")))
}

/// How many lanes of a kind there are, and their lengths together, m.
pub(crate) fn count(map: &RoadMap, kind: LaneKind) -> (usize, f64) {
    let lanes = map.lanes().iter().filter(|lane| lane.kind == kind);
    lanes.fold((0, 0.0), |(count, length), lane| {
        (count + 1, length + lane.length())
    })
}

/// Number of lane sections that have a lane.
pub(crate) fn sections(map: &RoadMap) -> usize {
    let mut names: Vec<&str> = map
        .lanes()
        .iter()
        .filter_map(|lane| Some(lane.name.rsplit_once('_')?.0))
        .collect();
    names.sort_unstable();
    names.dedup();
    names.len()
}

pub(crate) fn width(lane: &Lane, s: f64) -> f64 {
    let at = lane.at(s);
    at.left + at.right
}

/// Names of the lanes that follow.
pub(crate) fn successors<'a>(map: &'a RoadMap, name: &str) -> Vec<&'a str> {
    named(map, name)
        .successors
        .iter()
        .map(|id| map.lane(*id).name.as_str())
        .collect()
}

/// The line along lanes by name.
pub(crate) fn line(map: &RoadMap, names: &[&str]) -> ReferenceLine {
    along(map, &route(map, names))
}

fn along(map: &RoadMap, lanes: &[LaneId]) -> ReferenceLine {
    ReferenceLine::along(map, lanes).unwrap_or_else(|error| panic!("{error}"))
}

/// The first lane of a kind.
pub(crate) fn first(map: &RoadMap, kind: LaneKind) -> &Lane {
    let lane = map.lanes().iter().find(|lane| lane.kind == kind);
    lane.unwrap_or_else(|| panic!("no {kind:?} lane"))
}

/// Handles of lanes by name.
fn route(map: &RoadMap, names: &[&str]) -> Vec<LaneId> {
    names
        .iter()
        .map(|name| map.find(name).unwrap_or_else(|| panic!("no lane `{name}`")))
        .collect()
}

/// Largest (gap in m, turn in rad) from the end of a drivable lane to the start of a drivable successor.
pub(crate) fn worst_joint(map: &RoadMap) -> (f64, f64) {
    let mut worst: (f64, f64) = (0.0, 0.0);
    for lane in map.lanes().iter().filter(|lane| lane.kind.is_drivable()) {
        let end = lane.points[lane.points.len() - 1];
        for next in lane
            .successors
            .iter()
            .map(|id| map.lane(*id))
            .filter(|next| next.kind.is_drivable())
        {
            let start = next.points[0];
            let gap = (end.x - start.x).hypot(end.y - start.y);
            let turn = angle::difference(start.theta, end.theta).abs();
            worst = (worst.0.max(gap), worst.1.max(turn));
        }
    }
    worst
}
