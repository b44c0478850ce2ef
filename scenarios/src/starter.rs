//! A first scenario on a map that has none: the ego cruises on an empty road, for as long as the map allows.
//!
//! The lane to start in is the one with the longest way ahead, straight on; the first in the map's order among
//! equals. What the scenario says is tried as a run would read it, so that what is written can be run.

use crate::family::Family;
use crate::map_source::{LoadedMap, MapCache};
use crate::route;
use crate::{DrawError, ScenarioError};
use corridor_decider::road::{Lane, LaneId, RoadMap};
use std::fmt::Write as _;
use std::path::Path;

/// Ways longer than this are equally good, m: a minute at 60 km/h.
const LONG_ENOUGH: f64 = 1000.0;

/// Lanes that are tried before the map is given up. The first is nearly always good; a lane may be too narrow for the
/// car, or broken where its successor begins.
const ATTEMPTS: usize = 50;

/// Fastest cruise, m/s: 50 km/h, at which bends of unknown roads can be driven. The map's limits hold below it.
const FASTEST: f64 = 13.89;

/// Why a map carries no scenario.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StarterError {
    /// All lanes are in junctions or too short.
    #[error("the map has no drivable lane that a car could start in: each is shorter than {least} m")]
    NoLane {
        /// The length that is needed, m.
        least: f64,
    },
    /// The lane with the best way ahead cannot be driven in.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The car does not fit into any lane.
    #[error("no lane of the map carries a car: {0}")]
    Draw(#[from] DrawError),
}

/// The text of a scenario called `name` on `map`, which lies at `map_path` seen from the scenario file.
///
/// # Errors
/// [`StarterError`] when no lane can be started in, with what is wrong with the best one.
pub fn starter(name: &str, map: &LoadedMap, map_path: &str) -> Result<String, StarterError> {
    let maps = MapCache::new();
    maps.insert(map_path, map.clone());
    let mut first_problem = None;
    for (lane, s) in candidates(&map.map) {
        let text = text(name, map, map_path, lane, s);
        let problem = match Family::parse_with(&text, name, Path::new(""), &maps) {
            Ok(family) => match family.draw(1) {
                Ok(_) => return Ok(text),
                Err(error) => StarterError::Draw(error),
            },
            Err(error) => StarterError::Scenario(error),
        };
        first_problem.get_or_insert(problem);
    }
    Err(first_problem.unwrap_or(StarterError::NoLane { least: LEAST_WAY }))
}

/// Length of way that is worth a run, m: the car, and some metres to drive.
const LEAST_WAY: f64 = 20.0;

/// Station to start at, m: room for the car's tail and for someone behind; less where the way is short.
const START: f64 = 20.0;

/// The lanes to try, the best one first, each with the station to start at.
fn candidates(map: &RoadMap) -> Vec<(&Lane, f64)> {
    let outside = |lane: &Lane| lane.kind.is_drivable() && lane.junction.is_none();
    let mut ways: Vec<(&Lane, f64)> = (0u32..)
        .zip(map.lanes())
        .filter(|(_, lane)| outside(lane))
        .map(|(k, lane)| (lane, way(map, LaneId(k))))
        .filter(|(_, way)| *way >= LEAST_WAY)
        .collect();
    ways.sort_by(|a, b| b.1.total_cmp(&a.1));
    ways.truncate(ATTEMPTS);
    ways.iter()
        .map(|(lane, way)| (*lane, START.min(way / 4.0)))
        .collect()
}

/// Length of the way straight on from the start of a lane, m, as far as it matters.
fn way(map: &RoadMap, lane: LaneId) -> f64 {
    let lanes = route::straight_on(map, lane, LONG_ENOUGH);
    let lengths = lanes.iter().map(|id| map.lane(*id).length());
    lengths.sum::<f64>().min(LONG_ENOUGH)
}

fn text(name: &str, map: &LoadedMap, map_path: &str, lane: &Lane, s: f64) -> String {
    let limit = lane.at(s).speed_limit;
    let mut text = format!(
        "description = \"An empty road of a map read from {}.\"\n",
        map.format()
    );
    let _ = write!(
        text,
        "name = {}\nmap = {}\ncruise_speed = {:.2}\n\n[ego]\nlane = {}\ns = {s:.1}\n",
        quoted(name),
        quoted(map_path),
        // Not so slow that nothing happens, wherever a map says 0.
        limit.clamp(1.0, FASTEST),
        quoted(&lane.name),
    );
    text
}

/// A string as TOML writes it.
fn quoted(text: &str) -> String {
    let mut quoted = String::from('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => {
                let _ = write!(quoted, "\\u{:04X}", u32::from(c));
            }
            c => quoted.push(c),
        }
    }
    quoted + "\""
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    fn own(name: &str) -> LoadedMap {
        let text = crate::maps::embedded(name).unwrap();
        LoadedMap {
            map: crate::map_format::read(text).unwrap().map,
            text: text.into(),
            warnings: Arc::new([]),
            objects: Arc::new([]),
        }
    }

    #[test]
    fn every_own_map_gives_a_scenario_on_its_longest_way() {
        for name in crate::maps::names() {
            let map = own(name);
            let odd = "odd \"name\"\\\u{7f}.xodr";
            let text = starter(odd, &map, odd).unwrap();
            let maps = MapCache::new();
            maps.insert(odd, map.clone());
            let family = Family::parse_with(&text, "x.toml", Path::new(""), &maps).unwrap();
            assert_eq!(family.name(), odd);
            let scenario = family.draw(1).unwrap().scenario;
            let longest = (0u32..)
                .zip(map.map.lanes())
                .filter(|(_, lane)| lane.kind.is_drivable() && lane.junction.is_none())
                .map(|(k, _)| way(&map.map, LaneId(k)))
                .fold(0.0, f64::max);
            assert!(
                (way(&map.map, scenario.route[0]) - longest).abs() < 1e-9,
                "{text}"
            );
        }
    }

    #[test]
    fn lanes_too_narrow_or_too_short_are_no_place_to_start() {
        let map = own("urban_parking");
        let changed = |change: &dyn Fn(&mut Lane)| {
            let mut lanes = map.map.lanes().to_vec();
            lanes.iter_mut().for_each(change);
            let junctions = map.map.junctions().to_vec();
            LoadedMap {
                map: Arc::new(RoadMap::new(lanes, junctions).unwrap()),
                ..map.clone()
            }
        };
        let narrow = changed(&|lane| {
            for p in &mut lane.points {
                (p.left, p.right) = (0.1, 0.1);
            }
        });
        let problem = starter("x", &narrow, "x.xodr").unwrap_err().to_string();
        assert!(
            problem.starts_with("no lane of the map carries a car: "),
            "{problem}"
        );
        let short = changed(&|lane| {
            lane.points.truncate(3);
            lane.successors.clear();
        });
        let problem = starter("x", &short, "x.xodr").unwrap_err().to_string();
        assert!(problem.contains("shorter than 20 m"), "{problem}");
    }
}
