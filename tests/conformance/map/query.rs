//! Questions to the map as a whole.

use super::compare::compare;
use super::json::{name, names, point, sorted};
use super::{MapCase, SharedMap};
use corridor_decider::geometry::Vec2;
use corridor_decider::hd_map::{HdLane, HdMap, NearLane, ObjectKind};
use serde::Deserialize;
use serde_json::{Value, json};

/// How near a vertex the nearest point of a lane is one, m.
const CORNER: f64 = 1e-6;

#[derive(Deserialize)]
struct Asked {
    xy: [f64; 2],
    distance: f64,
    heading: f64,
    max_heading_difference: f64,
    radius: f64,
}

pub(super) fn query(case: &MapCase, map: &SharedMap) -> Result<(), String> {
    let asked: Asked = case.input()?;
    let at = point(asked.xy);
    let (distance, heading, tolerance) = (asked.distance, asked.heading, asked.max_heading_difference);
    let objects = |kind| sorted(map.objects_within(kind, at, asked.radius));
    let mut got = json!({
        "GetNearestLane": near(map, map.nearest_lane(at)),
        "GetNearestLaneWithHeading":
            near(map, map.nearest_lane_with_heading(at, distance, heading, tolerance)),
        "GetLanesWithHeading": names(map, &map.lanes_with_heading(at, distance, heading, tolerance)),
        "GetLanes": names(map, &map.lanes_within(at, distance)),
        "GetRoads": map.roads_within(at, distance),
        "GetJunctions": objects(ObjectKind::Junction),
        "GetCrosswalks": objects(ObjectKind::Crosswalk),
        "GetSignals": objects(ObjectKind::Signal),
        "GetStopSigns": objects(ObjectKind::StopSign),
        "GetClearAreas": objects(ObjectKind::ClearArea),
        "GetPNCJunctions": objects(ObjectKind::PncJunction),
    });
    let mut expected = case.expected.clone();
    for kind in ["GetNearestLane", "GetNearestLaneWithHeading"] {
        settle_ties(&mut expected[kind], &mut got[kind]);
    }
    settle_corners(map, at, &expected, &mut got);
    compare(&expected, &got)
}

/// Which way a lane runs is open where it is nearest at a corner; any answer is right there.
fn settle_corners(map: &HdMap, at: Vec2, expected: &Value, got: &mut Value) {
    let is_corner = |lane: &HdLane| {
        let (foot, stations) = (lane.foot(at).s, lane.stations());
        let mut inner = stations[1..stations.len() - 1].iter();
        inner.any(|station| (station - foot).abs() < CORNER)
    };
    let (list, nearest) = ("GetLanesWithHeading", "GetNearestLaneWithHeading");
    let differs = |lane: &&HdLane| holds(&expected[list], lane.name()) != holds(&got[list], lane.name());
    if map.lanes().iter().filter(differs).all(is_corner) {
        got[list] = expected[list].clone();
    }
    let (wanted, have) = (&expected[nearest]["lane"], &got[nearest]["lane"]);
    let named = [wanted, have].map(|name| map.find(name.as_str()?));
    let is_open = named.into_iter().flatten().any(|lane| is_corner(map.lane(lane)));
    if wanted != have && is_open {
        got[nearest] = expected[nearest].clone();
    }
}

fn holds(list: &Value, name: &str) -> bool {
    list.as_array()
        .is_some_and(|list| list.iter().any(|entry| entry == name))
}

fn near(map: &HdMap, near: Option<NearLane>) -> Value {
    match near {
        Some(near) => json!({ "rc": 0, "lane": name(map, near.lane), "s": near.s, "l": near.l }),
        None => json!({ "rc": -1 }),
    }
}

/// Of lanes equally near any is right, with its own station and offset; of pieces equally near, any offset.
fn settle_ties(expected: &mut Value, got: &mut Value) {
    let Some(wanted) = expected.as_object_mut() else {
        return;
    };
    let lanes = wanted.remove("lane_tie");
    let pieces = wanted.remove("segment_tie");
    let is_among = |lanes: &Value| lanes.as_array().is_some_and(|lanes| lanes.contains(&got["lane"]));
    if lanes.as_ref().is_some_and(is_among) && expected["lane"] != got["lane"] {
        *got = expected.clone();
    } else if pieces.is_some() {
        got["l"] = expected["l"].clone();
    }
}
