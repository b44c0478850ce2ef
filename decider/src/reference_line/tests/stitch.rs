//! Lines that grow and are cut: what was there stays, and all of it is smooth.

use crate::geometry::{Vec2, angle};
use crate::hd_map::LaneSegment;
use crate::reference_line::{LineQuery, ReferenceLine, StitchedLine};
use crate::road::{Lane, LaneId, LaneKind, LanePoint, RoadMap};
use crate::vehicle::VehicleParams;
use proptest::prelude::*;

/// Lanes of given lengths and curvatures that follow each other with a kink of `kink` between them.
fn road(lanes: &[(f64, f64)], kink: f64) -> RoadMap {
    let (mut position, mut theta) = (Vec2::new(4e5, 5e6), 0.4);
    let count = u32::try_from(lanes.len()).unwrap();
    let lane = |(k, (length, kappa)): (u32, &(f64, f64))| {
        let mut points = Vec::new();
        let step = length / (length / 0.5).ceil();
        for j in (0_i32..).take_while(|j| f64::from(*j) * step < length + step / 2.0) {
            points.push(LanePoint {
                s: f64::from(j) * step,
                x: position.x,
                y: position.y,
                theta: angle::wrap(theta),
                kappa: *kappa,
                left: 1.75,
                right: 1.75,
                road_left: 5.0,
                road_right: 2.0,
                speed_limit: 10.0,
            });
            if f64::from(j) * step < length - step / 2.0 {
                let (sin, cos) = angle::sin_cos(theta + kappa * step / 2.0);
                position += Vec2::new(cos, sin) * step;
                theta += kappa * step;
            }
        }
        theta += kink;
        Lane {
            name: format!("{k}"),
            kind: LaneKind::Driving,
            road: "r".to_owned(),
            junction: None,
            points,
            left_marks: Vec::new(),
            right_marks: Vec::new(),
            neighbours: [None; 4],
            predecessors: k.checked_sub(1).map(LaneId).into_iter().collect(),
            successors: (k + 1 < count).then_some(LaneId(k + 1)).into_iter().collect(),
        }
    };
    RoadMap::new((0..).zip(lanes).map(lane).collect(), Vec::new()).unwrap()
}

/// The stretch from `from` to `to` metres of the lanes of a map in a row.
fn window(map: &RoadMap, from: f64, to: f64) -> Vec<LaneSegment> {
    let mut before = 0.0;
    let mut chain = Vec::new();
    for (id, lane) in (0..).map(LaneId).zip(map.lanes()) {
        let (start_s, end_s) = ((from - before).max(0.0), (to - before).min(lane.length()));
        if end_s > start_s {
            chain.push(LaneSegment::new(id, start_s, end_s));
        }
        before += lane.length();
    }
    chain
}

/// Drives along a line that grows and is cut; gives every line on the way.
fn drive(map: &RoadMap, length: f64) -> Vec<StitchedLine> {
    let vehicle = VehicleParams::default();
    let mut line = StitchedLine::new(map, window(map, 0.0, 120.0), &vehicle).unwrap();
    let mut lines = vec![line.clone()];
    let mut here = 0.0;
    while here + 180.0 < length {
        here += 35.0;
        let wanted = window(map, (here - 50.0_f64).max(0.0), here + 180.0);
        if line.covers(&wanted) {
            continue;
        }
        line = line
            .led_on(map, &wanted, &vehicle)
            .unwrap()
            .unwrap()
            .cut_behind(here, 75.0);
        assert!(line.covers(&wanted), "{here}");
        lines.push(line.clone());
    }
    lines
}

/// Largest jump of curvature per metre and of heading against it.
fn roughness(line: &ReferenceLine) -> (f64, f64) {
    let jumps = line.samples().windows(2).map(|pair| {
        let ds = pair[1].s - pair[0].s;
        let turned = angle::difference(pair[1].point.theta, pair[0].point.theta);
        let mean = f64::midpoint(pair[0].point.kappa, pair[1].point.kappa);
        (
            (pair[1].point.kappa - pair[0].point.kappa).abs() / ds,
            (turned - mean * ds).abs(),
        )
    });
    jumps.fold((0.0, 0.0), |a, b| (f64::max(a.0, b.0), f64::max(a.1, b.1)))
}

#[test]
fn what_was_there_stays_when_the_line_grows() {
    let map = road(
        &[
            (90.0, 0.0),
            (80.0, 0.02),
            (70.0, -0.03),
            (150.0, 0.0),
            (200.0, 0.004),
        ],
        0.03,
    );
    let lines = drive(&map, 590.0);
    assert!(lines.len() > 10);
    for pair in lines.windows(2) {
        let (old, new) = (pair[0].line(), pair[1].line());
        let common = new.start().max(old.start());
        let end = old.length() - 25.0;
        let mut s = common;
        while s < end {
            let (a, b) = (old.point(s), new.point(s));
            assert!(
                (a.x, a.y, a.theta, a.kappa) == (b.x, b.y, b.theta, b.kappa),
                "{s}"
            );
            s += 0.7;
        }
        // And in the stretch that may move it moves little.
        while s < old.length() - 3.0 {
            let at = old.to_frenet(Vec2::new(new.point(s).x, new.point(s).y));
            assert!(at.l.abs() < 0.3 && (at.s - s).abs() < 0.05, "{s} {at:?}");
            s += 0.7;
        }
    }
}

#[test]
fn a_chain_from_elsewhere_is_refused_and_a_branch_is_followed() {
    let map = road(&[(90.0, 0.0), (80.0, 0.01), (70.0, 0.0)], 0.0);
    let vehicle = VehicleParams::default();
    let line = StitchedLine::new(&map, window(&map, 0.0, 60.0), &vehicle).unwrap();
    assert!(line.led_on(&map, &window(&map, 100.0, 150.0), &vehicle).is_none());
    assert!(line.covers(&window(&map, 10.0, 50.0)) && !line.covers(&window(&map, 10.0, 80.0)));
    assert!(StitchedLine::new(&map, Vec::new(), &vehicle).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn heading_and_curvature_are_continuous_on_every_line_of_a_drive(
        bends in prop::collection::vec((40.0..120.0f64, -0.05..0.05f64), 4..6),
        kink in -0.05..0.05f64,
    ) {
        let map = road(&bends, kink);
        let length: f64 = bends.iter().map(|(length, _)| length).sum();
        for line in drive(&map, length) {
            let (curvature, heading) = roughness(line.line());
            prop_assert!(curvature < 0.02 && heading < 2e-3, "{curvature} {heading}");
        }
    }
}
