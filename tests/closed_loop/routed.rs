//! Drives to a destination: over junctions, over changes of lane, on a map of each format.

use corridor_decider::geometry::angle;
use corridor_decider::reference_line::ReferenceLine;
use corridor_scenarios::{Family, MapCache, ScenarioError};
use corridor_sim::run::run_recorded;
use corridor_sim::settings::Settings;
use corridor_sim::trace::Trace;
use std::path::Path;
use std::sync::Arc;

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

fn scenario(map: &str, from: &str, to: &str, speed: f64) -> String {
    format!(
        "description = \"To a destination.\"\nmap = \"{map}\"\ncruise_speed = {speed:.1}\ntimeout = 240.0\n\
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
    for line in &trace.header.lines {
        let (heading, curvature) = roughness(line);
        assert!(
            heading < 0.015,
            "a heading jumps by {heading} rad against its curvature"
        );
        assert!(
            curvature < 0.2,
            "a curvature changes by {curvature} 1/m in a metre"
        );
    }
}

/// Largest step of the heading beyond what the curvature makes it turn, rad, and of the curvature per metre, 1/m².
fn roughness(line: &Arc<ReferenceLine>) -> (f64, f64) {
    let steps = line.samples().windows(2).map(|pair| {
        let (a, b) = (pair[0].point, pair[1].point);
        let ds = pair[1].s - pair[0].s;
        let turned = angle::difference(b.theta, a.theta) - f64::midpoint(a.kappa, b.kappa) * ds;
        (turned.abs(), (b.kappa - a.kappa).abs() / ds)
    });
    steps.fold((0.0, 0.0), |x, y| (f64::max(x.0, y.0), f64::max(x.1, y.1)))
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
