//! Drives to a destination: over junctions, over changes of lane, on a map of each format.

use crate::evenness::Evenness;
use corridor_scenarios::{Family, MapCache, ScenarioError};
use corridor_sim::run::run_recorded;
use corridor_sim::settings::Settings;
use corridor_sim::trace::Trace;
use std::path::Path;

/// A run of a scenario written here; `None`, said on the way, where its map is not at hand.
fn drive(text: &str) -> Option<Trace> {
    let family = match Family::parse_with(text, "routed.toml", Path::new("."), &MapCache::new()) {
        Ok(family) => family,
        Err(ScenarioError::SharedMapsAbsent { .. })
            if std::env::var_os("CORRIDOR_REQUIRE_MAPS").is_none() =>
        {
            return None;
        }
        Err(error) => panic!("{error}"),
    };
    let drawn = family.draw(1).unwrap_or_else(|error| panic!("{error}"));
    Some(run_recorded(&family, &drawn.scenario, &[], &Settings::default()))
}

/// A drive from one lane to another; to the end of it, as far as the road goes on behind it.
fn scenario(map: &str, from: &str, to: &str, speed: f64) -> String {
    format!(
        "name = \"{from} to {to}\"\ndescription = \"To a destination.\"\nmap = \"{map}\"\ncruise_speed = {speed:.1}\ntimeout = 240.0\n\
         [ego]\nlane = \"{from}\"\ns = 5.0\n[destination]\nlane = \"{to}\"\n"
    )
}

/// The destination is reached without a fault, and every line on the way is smooth.
fn arrives(trace: &Trace, least: f64) {
    let verdict = trace.verdict.as_ref().unwrap();
    assert!(verdict.pass, "{}", verdict.summary);
    let metric = |name: &str| {
        verdict
            .metrics
            .iter()
            .find(|m| m.name == name)
            .and_then(|m| m.value)
    };
    assert!(metric("distance").unwrap() >= least, "{:?}", metric("distance"));
    let even = Evenness::of(trace);
    tell(&format!("{}: {even}", trace.header.scenario));
    assert!(even.heading < 0.015 && even.curvature < 0.2, "{even}");
    // What has been planned on stays where it is.
    assert!(even.s_jump < 1e-6 && even.l_jump < 1e-6, "{even}");
    assert!(even.heading_jump < 1e-6 && even.curvature_jump < 1e-6, "{even}");
}

#[expect(
    clippy::print_stdout,
    reason = "whoever looks for the figures finds them here"
)]
fn tell(what: &str) {
    println!("{what}");
}

#[test]
fn two_lanes_are_changed_to_reach_the_right_one() {
    let trace = drive(&scenario("highway_shoulder", "1_0_-1", "1_0_-3", 20.0)).unwrap();
    arrives(&trace, 1000.0);
    let offered = trace
        .ticks
        .iter()
        .map(|tick| tick.lines.len())
        .collect::<Vec<_>>();
    assert_eq!((offered[0], offered[offered.len() - 1]), (2, 1));
}

/// Lines are added as they come up, and a replay of what was written finds the same ones.
#[test]
fn a_line_grows_while_it_is_driven() {
    let trace = drive(&scenario("highway_shoulder", "1_0_-2", "1_0_-2", 20.0)).unwrap();
    arrives(&trace, 1000.0);
    let places: Vec<usize> = trace.ticks.iter().map(|tick| tick.lines[0].0).collect();
    assert!(trace.header.lines.len() > 8, "{}", trace.header.lines.len());
    assert!(
        places.windows(2).all(|pair| pair[0] <= pair[1]),
        "no line comes back"
    );
}

#[test]
fn a_town_is_crossed() {
    let map = "$MAPS/opendrive/carla_Town07_libOpenDRIVE_test.xodr";
    if let Some(trace) = drive(&scenario(map, "62_0_1", "58_0_-1", 8.0)) {
        arrives(&trace, 300.0);
    }
}

#[test]
fn borregas_avenue_is_driven() {
    let map = "$MAPS/apollo/borregas_ave.base_map.bin";
    if let Some(trace) = drive(&scenario(map, "lane_19", "lane_9", 10.0)) {
        arrives(&trace, 280.0);
    }
}

/// A residential street with lanelets of a few metres, in which a lanelet serves both directions.
#[test]
fn forty_eight_lanelets_of_a_town_are_driven() {
    let map = "$MAPS/lanelet2/mapping_example.osm";
    if let Some(trace) = drive(&scenario(map, "45572", "45262_back", 8.0)) {
        arrives(&trace, 360.0);
    }
}

/// The longest way on this map: to a roundabout of 3 m radius at the end of the street and back on the same lanelets.
/// A line that lies on itself would have the car on the wrong half of it.
#[test]
fn a_street_is_driven_to_its_end_and_back() {
    let map = "$MAPS/lanelet2/mapping_example.osm";
    if let Some(trace) = drive(&scenario(map, "45572", "45566", 8.0)) {
        arrives(&trace, 500.0);
    }
}

/// Over two changes of lane to a ramp that leads under the road that it has left.
#[test]
fn a_ramp_under_its_own_road_is_driven() {
    let map = "$MAPS/lanelet2/mapping_example.osm";
    if let Some(trace) = drive(&scenario(map, "1234379034591142988", "9037740909199276460", 8.0)) {
        arrives(&trace, 280.0);
    }
}

#[test]
fn a_lane_is_changed_between_lanelets_of_a_town() {
    let map = "$MAPS/lanelet2/mapping_example.osm";
    if let Some(trace) = drive(&scenario(map, "45216", "45154", 10.0)) {
        arrives(&trace, 295.0);
    }
}

/// The longest way on this map: three changes of lane before and behind a junction.
#[test]
fn three_lanes_are_changed_around_a_junction() {
    let map = "$MAPS/lanelet2/autoware_vm_03_right_hand.osm";
    if let Some(trace) = drive(&scenario(map, "2249", "2242", 8.0)) {
        arrives(&trace, 155.0);
    }
}

/// The longest way of all the `CommonRoad` maps: to the left where three roads meet.
#[test]
fn a_junction_of_three_roads_is_crossed() {
    let map = "$MAPS/commonroad/ZAM_Tjunction-1_42_T-1.xml";
    for (from, to) in [("50195", "50203"), ("50205", "50197")] {
        if let Some(trace) = drive(&scenario(map, from, to, 8.0)) {
            arrives(&trace, 300.0);
        }
    }
}

/// From the outermost lane of a motorway to the innermost one: five changes within 200 m.
#[test]
fn five_lanes_are_changed_to_leave_a_motorway() {
    let map = "$MAPS/commonroad/USA_US101-3_3_T-1.xml";
    if let Some(trace) = drive(&scenario(map, "31", "22", 12.0)) {
        arrives(&trace, 155.0);
    }
}
