//! What a map file holds, in words: lanes, links, limits, extent, and what its reader had to say.
//!
//! Metres in the map's own frame; limits in km/h, as signs have them.

use corridor_decider::geometry::Vec2;
use corridor_decider::road::{Lane, LaneId, LaneKind, Neighbour, RoadMap, Side};
use corridor_scenarios::LoadedMap;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// Distance between the end of a lane and the start of its successor that is worth telling, m: no route leads over it.
const GAP: f64 = 0.5;

/// Names listed before the rest is only counted.
const LISTED: usize = 12;

/// m/s of one km/h.
const KMH: f64 = 3.6;

/// The report on a map that was called `name`.
pub fn report(name: &str, map: &LoadedMap) -> String {
    let lanes = map.map.lanes();
    let roads: BTreeSet<&str> = lanes.iter().map(|lane| lane.road.as_str()).collect();
    let mut text = format!("{name}: {}\n", map.format());
    text += &extent(lanes);
    let junctions = map.map.junctions().len();
    let _ = writeln!(text, "roads      {}, {junctions} junctions", roads.len());
    text += &kinds(lanes);
    text += &links(&map.map);
    text += &neighbours(lanes);
    text += &limits(lanes);
    let _ = writeln!(text, "warnings   {}", map.warnings.len());
    for warning in map.warnings.iter() {
        let _ = writeln!(text, "  {warning}");
    }
    text
}

/// The corners of the box around all lanes, the lowest and the highest.
pub(crate) fn corners(lanes: &[Lane]) -> (Vec2, Vec2) {
    let sections = lanes.iter().flat_map(|lane| &lane.points);
    let edges = sections.flat_map(|p| [p.offset(p.left), p.offset(-p.right)]);
    let nothing = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
    edges.fold(nothing, |(low, high), p| (low.inf(&p), high.sup(&p)))
}

fn extent(lanes: &[Lane]) -> String {
    let (low, high) = corners(lanes);
    let size = high - low;
    format!(
        "extent     {:.1} m by {:.1} m; x {:.1} to {:.1}, y {:.1} to {:.1}\n",
        size.x, size.y, low.x, high.x, low.y, high.y
    )
}

/// Number and length of the lanes of each kind, those in junctions apart.
fn kinds(lanes: &[Lane]) -> String {
    let mut kinds: BTreeMap<LaneKind, (usize, f64, usize, f64)> = BTreeMap::new();
    for lane in lanes {
        let sum = kinds.entry(lane.kind).or_default();
        let (count, length) = match lane.junction {
            None => (&mut sum.0, &mut sum.1),
            Some(_) => (&mut sum.2, &mut sum.3),
        };
        *count += 1;
        *length += lane.length();
    }
    let mut text = format!("lanes      {}\n", lanes.len());
    for (kind, (count, length, inside, length_inside)) in kinds {
        let _ = write!(
            text,
            "  {:12} {:5} {:9.3} km",
            kind_name(kind),
            count + inside,
            (length + length_inside) / 1e3
        );
        if inside > 0 {
            let _ = write!(text, "; in junctions {inside}, {:.3} km", length_inside / 1e3);
        }
        text.push('\n');
    }
    text
}

/// The name of a kind of lane, for people and for style sheets.
pub(crate) fn kind_name(kind: LaneKind) -> &'static str {
    match kind {
        LaneKind::Driving => "driving",
        LaneKind::Ramp => "ramp",
        LaneKind::Stop => "stop",
        LaneKind::Shoulder => "shoulder",
        LaneKind::Parking => "parking",
        LaneKind::Border => "border",
        LaneKind::Curb => "curb",
        LaneKind::Median => "median",
        LaneKind::Restricted => "restricted",
        LaneKind::Biking => "biking",
        LaneKind::Sidewalk => "sidewalk",
        LaneKind::Rail => "rail",
        LaneKind::Other => "other",
    }
}

/// Which drivable lanes lead where, and which joints do not meet.
fn links(map: &RoadMap) -> String {
    let drivable = || map.lanes().iter().filter(|lane| lane.kind.is_drivable());
    let successors: usize = drivable().map(|lane| lane.successors.len()).sum();
    let forks = drivable().filter(|lane| lane.successors.len() > 1).count();
    let ends: Vec<&str> = drivable()
        .filter(|lane| lane.successors.is_empty())
        .map(|lane| lane.name.as_str())
        .collect();
    let starts: Vec<&str> = drivable()
        .filter(|lane| lane.predecessors.is_empty())
        .map(|lane| lane.name.as_str())
        .collect();
    let mut text = format!(
        "links      {successors} successors of {} drivable lanes, {forks} forks\n",
        drivable().count()
    );
    let _ = writeln!(text, "  without successor    {}", listed(&ends));
    let _ = writeln!(text, "  without predecessor  {}", listed(&starts));
    let gaps: Vec<String> = drivable().flat_map(|lane| gaps(map, lane)).collect();
    if !gaps.is_empty() {
        let gaps: Vec<&str> = gaps.iter().map(String::as_str).collect();
        let _ = writeln!(text, "  more than {GAP} m apart {}", listed(&gaps));
    }
    text
}

/// The links of a lane whose ends do not meet.
fn gaps<'a>(map: &'a RoadMap, lane: &'a Lane) -> impl Iterator<Item = String> + 'a {
    let end = lane.at(lane.length()).offset(0.0);
    lane.successors.iter().filter_map(move |next: &LaneId| {
        let next = map.lane(*next);
        let apart = (next.at(0.0).offset(0.0) - end).norm();
        (apart > GAP).then(|| format!("{} to {} ({apart:.1} m)", lane.name, next.name))
    })
}

/// How many, and the names of the first ones.
fn listed(names: &[&str]) -> String {
    if names.is_empty() {
        return "0".to_owned();
    }
    let more = names.len().saturating_sub(LISTED);
    let tail = if more > 0 {
        format!(" and {more} more")
    } else {
        String::new()
    };
    let shown = &names[..names.len() - more];
    format!("{}: {}{tail}", names.len(), shown.join(", "))
}

/// How many drivable lanes have a neighbour of each kind.
fn neighbours(lanes: &[Lane]) -> String {
    let words = Neighbour::ALL.map(|kind| {
        let with = lanes
            .iter()
            .filter(|lane| lane.kind.is_drivable() && lane.neighbour(kind).is_some());
        let side = match kind.side {
            Side::Left => "left",
            Side::Right => "right",
        };
        let way = if kind.reverse { "oncoming" } else { "along" };
        format!("{} {side} {way}", with.count())
    });
    format!("neighbours {}\n", words.join(", "))
}

/// Kilometres of drivable lanes by speed limit.
fn limits(lanes: &[Lane]) -> String {
    let mut limits: BTreeMap<Option<u64>, f64> = BTreeMap::new();
    for lane in lanes.iter().filter(|lane| lane.kind.is_drivable()) {
        for pair in lane.points.windows(2) {
            *limits.entry(tenths(pair[0].speed_limit)).or_default() += pair[1].s - pair[0].s;
        }
    }
    let mut text = "limits\n".to_owned();
    for (limit, length) in limits {
        let name = match limit {
            Some(tenths) if tenths % 10 == 0 => format!("{} km/h", tenths / 10),
            Some(tenths) => format!("{}.{} km/h", tenths / 10, tenths % 10),
            None => "none".to_owned(),
        };
        let _ = writeln!(text, "  {name:12} {:15.3} km", length / 1e3);
    }
    text
}

/// A speed in tenths of km/h, `None` for no limit.
fn tenths(speed: f64) -> Option<u64> {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "saturates, and a limit is positive"
    )]
    speed.is_finite().then(|| (speed * KMH * 10.0).round() as u64)
}

/// The speed limit at the start of a lane, for people.
pub(crate) fn limit_name(lane: &Lane) -> String {
    match tenths(lane.points[0].speed_limit) {
        Some(tenths) => format!("{} km/h", (tenths + 5) / 10),
        None => "no limit".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    fn own() -> LoadedMap {
        let path =
            std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios/maps/urban_parking.xodr");
        LoadedMap::open(&path).unwrap()
    }

    #[test]
    fn lanes_are_counted_by_kind_and_limit() {
        let map = own();
        let text = report("urban", &map);
        let driving: Vec<&Lane> = map
            .map
            .lanes()
            .iter()
            .filter(|lane| lane.kind == LaneKind::Driving)
            .collect();
        let length: f64 = driving.iter().map(|lane| lane.length()).sum();
        let line = format!("  driving      {:5} {:9.3} km", driving.len(), length / 1e3);
        assert!(text.contains(&line), "no `{line}` in {text}");
        assert!(text.starts_with("urban: OpenDRIVE\nextent "), "{text}");
        assert!(text.ends_with("warnings   0\n"), "{text}");
    }

    #[test]
    fn a_joint_that_does_not_meet_is_told() {
        let map = own();
        let mut lanes = map.map.lanes().to_vec();
        let from = lanes.iter().position(|lane| lane.kind.is_drivable()).unwrap();
        lanes[from].successors = vec![LaneId(u32::try_from(from).unwrap())];
        let name = lanes[from].name.clone();
        let changed = LoadedMap {
            map: Arc::new(RoadMap::new(lanes, map.map.junctions().to_vec()).unwrap()),
            warnings: Arc::new(["odd".to_owned()]),
            ..map
        };
        let text = report("x", &changed);
        assert!(text.contains(&format!("apart 1: {name} to {name} (")), "{text}");
        assert!(text.ends_with("warnings   1\n  odd\n"), "{text}");
    }

    #[test]
    fn limits_are_those_of_signs() {
        assert_eq!(tenths(13.888_89), Some(500));
        assert_eq!(tenths(f64::INFINITY), None);
        assert_eq!(
            listed(&["a"; 14]),
            format!("14: {} and 2 more", ["a"; 12].join(", "))
        );
    }
}
