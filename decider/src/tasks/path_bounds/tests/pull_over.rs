//! The place to pull over: inside the bound, at the kerb, out of junctions, with room for the car.

use super::random;
use super::setup::{PLAIN, Section, Setup, at, parked};
use crate::geometry::Vec2;
use crate::reference_line::{LineQuery, SlPoint};
use crate::tasks::path_bounds::{Label, PathBounds, PullOverRefusal};
use proptest::prelude::*;

fn place(setup: &Setup) -> SlPoint {
    setup
        .road
        .to_frenet(setup.memory.pull_over.place.unwrap().position)
}

fn pull_over_bound(answer: &PathBounds) -> Option<usize> {
    answer
        .bounds
        .iter()
        .position(|bound| bound.label == Label::PullOver)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    /// Whatever stands on the road and wherever its junctions are: a place that is offered is good.
    #[test]
    fn a_place_is_free_at_the_kerb_and_out_of_junctions(
        obstacles in random::obstacles(54.0, 5),
        destination in prop::option::of(70.0..150.0_f64),
        junction in (60.0..140.0_f64, 0.5..30.0_f64),
        kerb in (2.5..4.0_f64, 2.5..4.0_f64, 60.0..140.0_f64),
        ego_l in -1.0..0.5_f64,
    ) {
        let (near, far, change) = kerb;
        let mut sections = vec![
            Section { road: Some((5.0, near)), ..PLAIN },
            Section { from: change, road: Some((5.0, far)), ..PLAIN },
            Section { from: junction.0, junction: true, ..PLAIN },
            Section { from: junction.0 + junction.1, ..PLAIN },
        ];
        for section in &mut sections[1..] {
            section.road = Some((5.0, if section.from < change { near } else { far }));
        }
        sections[1..].sort_by(|a, b| a.from.total_cmp(&b.from));
        // The section of the kerb's change may lie inside the junction.
        for section in &mut sections {
            section.junction = section.from >= junction.0 && section.from < junction.0 + junction.1;
        }
        let mut setup = Setup::fixed().with(|setup| {
            setup.road.sections = sections;
            setup.ego.l = ego_l;
            setup.obstacles = obstacles;
        }).pulling_over(destination);
        let answer = setup.decide().unwrap();
        let Some(k) = pull_over_bound(&answer) else {
            prop_assert!(answer.refusal.is_some());
            return Ok(());
        };
        prop_assert!(answer.refusal.is_none());
        let (bound, target) = (&answer.bounds[k], place(&setup));
        // At a station of the bound, inside it, and the bound goes straight on from there.
        let station = bound.points.iter().find(|point| (point.s - target.s).abs() < 1e-6).unwrap();
        prop_assert!(station.l_min <= target.l && target.l <= station.l_max);
        prop_assert!(bound.points.last().unwrap().s <= target.s + 10.0 + 1e-6);
        for point in bound.points.iter().filter(|point| point.s > target.s) {
            prop_assert_eq!((point.l_min, point.l_max), (station.l_min, station.l_max));
        }
        // Near the kerb, from half a car length behind to half a car length ahead of what the window needs.
        let kerb = setup.road.road_width(target.s).unwrap().1;
        prop_assert!(target.l - 1.055 + kerb <= 0.15 + 0.5275 / 2.0 + 1e-9, "{target:?} at a kerb at {kerb}");
        prop_assert!(!setup.road.near_junction(target.s, 1.0));
        // The car fits with 3 m ahead and 2 m behind what stands: the bound's own buffers.
        for obstacle in &setup.obstacles {
            let apart_s = obstacle.start_s - 3.0 >= target.s - 1e-9 || obstacle.end_s + 2.0 < target.s;
            let apart_l = obstacle.start_l - 1.455 >= target.l - 1e-9 || obstacle.end_l + 1.455 <= target.l + 1e-9;
            prop_assert!(apart_s || apart_l, "{target:?} runs into {obstacle:?}");
        }
        // Asked again, it stays.
        let again = setup.decide().unwrap();
        prop_assert_eq!(again, answer);
        prop_assert_eq!(place(&setup), target);
    }
}

/// The whole window is checked: a cone inside it, a narrow spot, a kerb that springs back.
#[test]
fn the_window_fits_over_its_whole_length() {
    let mut free = Setup::fixed().pulling_over(Some(120.0));
    free.bound(Label::PullOver);
    let free = place(&free).s;
    assert!((free - 118.0).abs() < 1e-9, "{free}");

    let spring = |from: f64, road| Section {
        from,
        road: Some(road),
        ..PLAIN
    };
    // The kerb is 0.3 m farther away between the stations 118 and 118.5: only a check of every station sees it.
    let mut setup = Setup::fixed()
        .with(|setup| {
            setup.road.sections.push(spring(118.2, (5.25, 3.3)));
            setup.road.sections.push(spring(118.7, (5.25, 3.0)));
        })
        .pulling_over(Some(120.0));
    setup.config.pull_over_road_edge_buffer = -0.01;
    let answer = setup.decide().unwrap();
    assert_eq!(
        answer.refusal,
        Some(PullOverRefusal::NoPlace),
        "no kerb is that near"
    );
    setup.config.pull_over_road_edge_buffer = 0.15;
    setup.config.quirks.road_edge_at_axle = true;
    setup.bound(Label::PullOver);
    assert!(
        (place(&setup).s - 118.0).abs() < 1e-9,
        "the bound follows the kerb"
    );
    // Under the whole body the kerb counts where it is nearest; where it springs back it is too far away.
    setup.config.quirks.road_edge_at_axle = false;
    setup.memory.pull_over.place = None;
    setup.bound(Label::PullOver);
    assert!(place(&setup).s < 118.0, "the bound follows the body");

    // A corridor narrower than a quarter of the car's width beyond the car.
    let wall = |l: f64| {
        Setup::fixed()
            .parked(1, (121.1, 121.2), (l, l + 0.3))
            .pulling_over(Some(120.0))
    };
    let mut wide = wall(-3.0 + 2.11 + 0.5275 + 0.4 + 0.01);
    wide.bound(Label::PullOver);
    assert!((place(&wide).s - 118.0).abs() < 1e-9);
    let mut narrow = wall(-3.0 + 2.11 + 0.5275 + 0.4 - 0.01);
    narrow.bound(Label::PullOver);
    assert!((place(&narrow).s - 116.0).abs() < 1e-9, "{:?}", place(&narrow));
}

#[test]
fn refusals_say_why() {
    let refusal = |setup: Setup| setup.clone().decide().unwrap().refusal.unwrap();
    let at_s = |s: f64| Setup::fixed().pulling_over(Some(s));
    // Ego's front bumper at 53.89; the last station at 149.5.
    assert_eq!(refusal(at_s(78.8)), PullOverRefusal::DestinationTooNear);
    assert!(at_s(79.0).decide().unwrap().refusal.is_none());
    assert_eq!(refusal(at_s(145.5)), PullOverRefusal::DestinationTooFar);
    assert!(at_s(145.4).decide().unwrap().refusal.is_none());
    let nowhere = at_s(100.0).with(|setup| setup.destination = None);
    assert_eq!(refusal(nowhere), PullOverRefusal::NoDestination);
    let outside = at_s(100.0).with(|setup| setup.ego.l = -2.0);
    assert_eq!(refusal(outside), PullOverRefusal::OutsideRoad);
    let narrow = at_s(100.0).with(|setup| setup.road.sections[0].road = Some((1.0, 1.0)));
    assert_eq!(refusal(narrow), PullOverRefusal::RoadTooNarrow);
    let junction = at_s(100.0).with(|setup| setup.road.sections[0].junction = true);
    assert_eq!(refusal(junction), PullOverRefusal::NoPlace);
}

/// A refusal forgets the old place but not the wish, and the regular bounds are there instead.
#[test]
fn after_a_refusal_the_regular_bounds_serve() {
    let mut setup = Setup::fixed().pulling_over(Some(120.0));
    setup.bound(Label::PullOver);
    setup.obstacles = vec![parked(1, (53.5, 150.0), (-3.0, -1.8))];
    let answer = setup.decide().unwrap();
    assert_eq!(answer.refusal, Some(PullOverRefusal::NoPlace));
    assert_eq!(answer.bounds.len(), 2);
    assert!(setup.memory.pull_over.is_requested && setup.memory.pull_over.place.is_none());
}

/// A place is kept while it lies inside the bound, even one that a search would not choose, and sought anew when
/// something is parked on it.
#[test]
fn a_place_is_kept_until_it_is_taken() {
    let mut setup = Setup::fixed().pulling_over(Some(120.0));
    setup.bound(Label::PullOver);
    let mut kept = setup.memory.pull_over.place.unwrap();
    kept.position = Vec2::new(100.2, -0.3);
    setup.memory.pull_over.place = Some(kept);
    let bound = setup.bound(Label::PullOver);
    assert_eq!(setup.memory.pull_over.place, Some(kept));
    assert_eq!(
        bound.points.last().unwrap().s,
        110.5,
        "20 stations behind that of the place"
    );

    let mut taken = setup.clone().parked(1, (101.0, 104.0), (-3.0, -1.5));
    taken.bound(Label::PullOver);
    assert!((place(&taken).s - 118.0).abs() < 1e-9, "a new place");

    // Up to a metre behind the first station it still counts; farther behind it is passed.
    for (s, counts) in [(49.2, true), (48.9, false)] {
        let mut behind = setup.clone();
        kept.position = Vec2::new(s, -0.3);
        behind.memory.pull_over.place = Some(kept);
        behind.bound(Label::PullOver);
        assert_eq!(place(&behind).s < 50.0, counts, "{s}");
    }
}

/// Left of its lane's line the ego may come back over time; the bound holds it and goes no farther left.
#[test]
fn an_ego_over_the_line_may_come_back() {
    let mut setup = Setup::fixed()
        .pulling_over(Some(120.0))
        .with(|setup| setup.ego.l = 1.2);
    let bound = setup.bound(Label::PullOver);
    assert_eq!(at(&bound, 50.0).1, 1.2);
    assert!(bound.points.iter().all(|point| point.l_max <= 1.2));
}
