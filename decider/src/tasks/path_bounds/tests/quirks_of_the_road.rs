//! One test per quirk that is about lanes, lines and edges: what the defect does, and that it is gone without it.

use super::setup::{LEFT_FORWARD, OWN, PLAIN, Section, Setup, assert_limits, at, forward_lane};
use crate::reference_line::LineQuery;
use crate::road::{BoundaryType, Side};
use crate::tasks::path_bounds::{Borrow, Label, PullOverRefusal};

/// Beside the lane line the car overhangs it by half its width, and the line's offset is added in the wrong
/// direction.
#[test]
fn pull_over_overhang() {
    let scene = Setup::fixed()
        .with(|setup| setup.road.sections[0].offset = Some(0.3))
        .pulling_over(Some(120.0));
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.pull_over_overhang = true);
    assert_limits(&off.bound(Label::PullOver), 50.0, 100.0, (-1.945, 1.75 - 1.055));
    assert_limits(&on.bound(Label::PullOver), 50.0, 100.0, (-1.945, 1.75 + 0.3));
}

/// It overwrites the road's edge where the lane is wider than the road.
#[test]
fn pull_over_overhang_reopens_the_road() {
    let scene = Setup::fixed()
        .with(|setup| setup.road.sections[0].road = Some((1.5, 3.0)))
        .pulling_over(Some(120.0));
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.pull_over_overhang = true);
    assert_limits(&off.bound(Label::PullOver), 50.0, 100.0, (-1.945, 1.5 - 1.055));
    assert_limits(&on.bound(Label::PullOver), 50.0, 100.0, (-1.945, 1.75));
}

/// The window's first station is clear of the junction, the rest of it is not.
#[test]
fn junction_at_anchor_only() {
    let junction = Section {
        from: 117.0,
        junction: true,
        ..PLAIN
    };
    let behind = Section { from: 118.6, ..PLAIN };
    let scene = Setup::fixed()
        .with(|setup| setup.road.sections.extend([junction, behind]))
        .pulling_over(Some(120.0));
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.junction_at_anchor_only = true);
    let place_of = |setup: &mut Setup| {
        setup.bound(Label::PullOver);
        let place = setup.memory.pull_over.place.unwrap();
        setup.road.to_frenet(place.position).s
    };
    let (clear, in_junction) = (place_of(&mut off), place_of(&mut on));
    assert!((117.0..118.6).contains(&in_junction), "{in_junction}");
    assert!(clear < 116.0 && clear > 112.0, "{clear}");
}

#[test]
fn unchecked_road_width() {
    let hole = Section {
        from: 52.0,
        road: None,
        ..PLAIN
    };
    // Carried on from before the hole, the road is 3 m wide to the right; nobody knows whether it is.
    let scene = Setup::fixed()
        .with(|setup| setup.road.sections.push(hole))
        .pulling_over(Some(120.0));
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.unchecked_road_width = true);
    let answer = off.decide().unwrap();
    assert_eq!(answer.refusal, Some(PullOverRefusal::NoPlace));
    assert_eq!(off.memory.pull_over.place, None);
    assert!(off.memory.pull_over.is_requested);
    assert!(on.decide().unwrap().refusal.is_none());
    assert!(on.memory.pull_over.place.is_some());
}

/// A car shorter than the obstacles' buffers still needs a kerb and room where it stands.
#[test]
fn unchecked_short_window() {
    let scene = Setup::fixed()
        .parked(1, (52.5, 150.0), (-3.0, -1.8))
        .pulling_over(Some(120.0))
        .with(|setup| {
            setup.vehicle.length = 2.7;
            setup.vehicle.front_edge_to_center = 2.2;
            setup.vehicle.back_edge_to_center = 0.5;
        });
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.unchecked_short_window = true);
    assert_eq!(off.decide().unwrap().refusal, Some(PullOverRefusal::NoPlace));
    let bound = on.bound(Label::PullOver);
    assert_limits(&bound, 50.0, 120.0, (-0.345, 0.695));
    let kerb = on.road.to_frenet(on.memory.pull_over.place.unwrap().position).l - 1.055 + 3.0;
    assert!(kerb > 1.5, "the original stands {kerb:.2} m from the kerb");
}

#[test]
fn crosses_double_yellow() {
    let scene = Setup::fixed().with(|setup| {
        setup.borrow = vec![Borrow::Left];
        setup.road.sections[0].neighbours = forward_lane(Side::Left, 3.5);
        setup.road.sections.push(Section {
            from: 90.0,
            marks: Some((BoundaryType::DoubleYellow, BoundaryType::DottedWhite)),
            ..setup.road.sections[0]
        });
    });
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.crosses_double_yellow = true);
    assert_limits(&off.bound(LEFT_FORWARD), 50.0, 89.5, (-0.695, 4.195));
    assert_limits(&off.bound(LEFT_FORWARD), 90.0, 149.5, (-0.695, 0.695));
    assert_limits(&on.bound(LEFT_FORWARD), 50.0, 149.5, (-0.695, 4.195));
}

/// Solid single lines are never crossed, dotted ones, kerbs and unknown ones are: either side, quirk or not.
#[test]
fn lines_that_may_be_crossed() {
    use BoundaryType as B;
    let kinds = [
        (B::Unknown, true),
        (B::DottedYellow, true),
        (B::DottedWhite, true),
        (B::SolidYellow, false),
        (B::SolidWhite, false),
        (B::Curb, true),
    ];
    for (kind, may) in kinds {
        for (borrow, side) in [(Borrow::Left, Side::Left), (Borrow::Right, Side::Right)] {
            let marks = match side {
                Side::Left => (kind, B::SolidWhite),
                Side::Right => (B::SolidYellow, kind),
            };
            let mut setup = Setup::fixed().with(|setup| {
                setup.borrow = vec![borrow];
                setup.road.sections[0].neighbours = forward_lane(side, 3.5);
                setup.road.sections[0].marks = Some(marks);
            });
            let labels = |setup: &mut Setup| setup.decide().unwrap().bounds.len();
            assert_eq!(labels(&mut setup) == 3, may, "{kind:?} {side:?}");
        }
    }
}

#[test]
fn borrows_phantom_lane() {
    let scene = Setup::fixed().with(|setup| setup.borrow = vec![Borrow::Left]);
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.borrows_phantom_lane = true);
    let labels = |setup: &mut Setup| -> Vec<Label> {
        let bounds = setup.decide().unwrap().bounds;
        bounds.iter().map(|bound| bound.label).collect()
    };
    assert_eq!(labels(&mut off), [Label::Fallback, OWN]);
    assert_eq!(labels(&mut on), [Label::Fallback, OWN, LEFT_FORWARD]);
    assert_eq!(on.bound(LEFT_FORWARD).points, on.bound(OWN).points);
}

/// Without a lane width the zone's edges would be the line's own offset: the ego is left of a target lane that
/// nobody knows.
#[test]
fn zone_without_lane() {
    let hole = Section {
        from: 80.0,
        lane: None,
        ..PLAIN
    };
    let scene = Setup::fixed().with(|setup| {
        setup.is_change_lane = true;
        setup.ego.l = 1.0;
        setup.config.quirks.endless_ego_extension = true;
        setup.road.sections.push(hole);
    });
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.zone_without_lane = true);
    // The ego is still inside the target lane: nothing keeps it out where its edges are known.
    assert_limits(&off.bound(Label::LaneChange), 50.0, 149.5, (-0.695, 1.1));
    let bound = on.bound(Label::LaneChange);
    assert_limits(&bound, 50.0, 79.5, (-0.695, 1.1));
    assert_limits(&bound, 80.0, 110.0, (0.9, 1.1));
    assert_limits(&bound, 110.5, 149.5, (-0.695, 1.1));
}

/// At 10 m/s the bound holds the ego for a second and fades for three more.
#[test]
fn endless_ego_extension() {
    let scene = Setup::fixed().with(|setup| (setup.ego.l, setup.ego.s_dot) = (-2.0, 10.0));
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.endless_ego_extension = true);
    let bound = off.bound(OWN);
    assert_limits(&bound, 50.0, 60.0, (-2.1, 0.695));
    assert_limits(&bound, 90.0, 149.5, (-0.695, 0.695));
    let fading: Vec<f64> = (60..=90).map(|s| at(&bound, f64::from(s)).0).collect();
    assert!(fading.windows(2).all(|pair| pair[0] < pair[1]), "{fading:?}");
    assert_limits(&on.bound(OWN), 50.0, 149.5, (-2.1, 0.695));
}

/// `adc_buffer_coeff` scales half the width beside a pure lane line, not where that is the edge of the road,
/// and not on the other side.
#[test]
fn the_buffer_coefficient_counts_beside_lane_lines_only() {
    let mut setup = Setup::fixed().with(|setup| {
        setup.config.adc_buffer_coeff = 0.5;
        setup.road.sections[0].road = Some((1.79, 3.0));
        setup.road.sections.push(Section {
            from: 100.0,
            road: Some((1.81, 1.75)),
            ..PLAIN
        });
    });
    let bound = setup.bound(OWN);
    assert_limits(&bound, 50.0, 99.5, (-1.75 + 0.5275, 0.695));
    assert_limits(&bound, 100.0, 149.5, (-0.695, 1.75 - 0.5275));
}

/// With an offset the lane lies beside the line, not around it.
#[test]
fn an_offset_cancels_between_the_frames() {
    for offset in [-0.4, 0.0, 0.7] {
        let mut setup = Setup::fixed().with(|setup| setup.road.sections[0].offset = Some(offset));
        // Widths are measured from the line already; the offset leads into the lane's frame and back.
        assert_limits(&setup.bound(OWN), 50.0, 149.5, (-0.695, 0.695));
    }
}
