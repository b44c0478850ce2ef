//! Boundaries against what can be said about them by looking at every point.

use super::*;
use proptest::prelude::*;

fn boundary(pairs: &[(f64, f64, f64)]) -> StBoundary {
    let pairs = pairs.iter().map(|p| StPair::new(p.0, p.1, p.2)).collect();
    StBoundary::new(pairs).unwrap()
}

/// A strip whose edges go up and down, as pairs.
fn strips() -> impl Strategy<Value = Vec<StPair>> {
    let step = (0.1..2.0, -5.0..40.0, 0.2..15.0);
    (-1.0..1.0, prop::collection::vec(step, 2..12)).prop_map(|(from, steps)| {
        let mut t = from;
        let pair = |(dt, lower, height): (f64, f64, f64)| {
            t += dt;
            StPair::new(t, lower, lower + height)
        };
        steps.into_iter().map(pair).collect()
    })
}

#[test]
fn what_aborts_the_original_is_an_error() {
    use StBoundaryError as Error;
    let make = |pairs: &[(f64, f64, f64)]| {
        StBoundary::new(pairs.iter().map(|p| StPair::new(p.0, p.1, p.2)).collect()).unwrap_err()
    };
    assert_eq!(make(&[(0.0, 1.0, 2.0)]), Error::TooFew(1));
    assert_eq!(make(&[(0.0, 1.0, 2.0), (1.0, 3.0, 2.0)]), Error::UpsideDown(1));
    assert_eq!(make(&[(0.0, 1.0, 2.0), (1e-7, 1.0, 2.0)]), Error::NotLater(1));
    assert_eq!(make(&[(0.0, 1.0, 1.0), (1.0, 1.0, 1.0)]), Error::NoArea);
    assert_eq!(
        make(&[(0.0, f64::NAN, 1.0), (1.0, 1.0, 1.0)]),
        Error::NotFinite(0)
    );
}

#[test]
fn a_strip_at_constant_speed_is_reduced_to_its_ends() {
    let pairs = (0..=70).map(|k| {
        let t = f64::from(k) * 0.1;
        StPair::new(t, 10.0 + 3.0 * t, 14.0 + 3.0 * t)
    });
    let reduced = StBoundary::reduced(pairs.collect()).unwrap();
    assert_eq!(reduced.pairs().len(), 2);
    assert!((reduced.area() - 28.0).abs() < 1e-9);
}

#[test]
fn decisions_free_one_side() {
    let free = |kind, t| {
        let strip = boundary(&[(1.0, 10.0, 14.0), (3.0, 20.0, 24.0)]).with_kind(kind);
        strip.unblocked_range(t).map(|range| (range.lower, range.upper))
    };
    for kind in [BoundaryType::Stop, BoundaryType::Yield, BoundaryType::Follow] {
        assert_eq!(free(kind, 2.0), Some((0.0, 15.0)));
    }
    assert_eq!(free(BoundaryType::Overtake, 2.0), Some((19.0, S_HORIZON)));
    assert_eq!(free(BoundaryType::Unknown, 2.0), None);
    assert_eq!(free(BoundaryType::KeepClear, 0.9), Some((0.0, S_HORIZON)));
}

#[test]
fn touching_a_strip_is_meeting_it() {
    let strip = boundary(&[(1.0, 10.0, 14.0), (3.0, 10.0, 14.0)]);
    let meets = |a: (f64, f64), b: (f64, f64)| {
        let (a, b) = (StPoint::new(a.0, a.1), StPoint::new(b.0, b.1));
        assert_eq!(strip.meets_segment(a, b), strip.meets_segment(b, a));
        strip.meets_segment(a, b)
    };
    assert!(meets((0.0, 10.0), (5.0, 10.0)), "along its lower edge");
    assert!(meets((0.0, 0.0), (1.0, 10.0)), "at its corner");
    assert!(meets((2.0, 0.0), (2.0, 30.0)), "straight up through it");
    assert!(meets((2.0, 12.0), (2.5, 12.0)), "inside");
    assert!(!meets((0.0, 9.9), (5.0, 9.9)));
    assert!(!meets((0.0, 10.0), (0.99, 12.0)), "before it");
    assert!(!meets((0.0, 5.0), (2.0, 9.99)));
}

#[test]
fn a_speed_limit_is_that_of_the_next_entry() {
    let limit = SpeedLimit::new(vec![(0.0, 5.0), (10.0, 6.0), (10.0, 9.0), (20.0, 7.0)]).unwrap();
    let got = [-1.0, 0.0, 0.1, 10.0, 10.1, 25.0].map(|s| limit.at(s));
    let wanted = [5.0, 5.0, 6.0, 6.0, 7.0, 7.0];
    assert!(
        got.iter()
            .zip(wanted)
            .all(|(got, wanted)| (got - wanted).abs() < 1e-12)
    );
    assert!(SpeedLimit::new(vec![(0.0, 5.0)]).is_err());
    assert!(SpeedLimit::new(vec![(1.0, 5.0), (0.0, 5.0)]).is_err());
}

#[test]
fn a_profile_is_read_between_its_points_only() {
    let point = |t: f64| SpeedPoint {
        t,
        s: t * 2.0,
        v: t,
        ..SpeedPoint::default()
    };
    let profile = SpeedData::new(vec![point(1.0), point(2.0), point(4.0)]);
    assert_eq!(profile.at_time(3.0), Some(point(3.0)));
    assert_eq!(profile.at_distance(3.0), Some(point(1.5)));
    assert_eq!(profile.at_time(0.999_999_5), Some(point(1.0)));
    assert_eq!(profile.at_time(0.9), None);
    assert_eq!(profile.at_time(4.1), None);
    assert_eq!(SpeedData::new(vec![point(1.0)]).at_time(1.0), None);
}

proptest! {
    #[test]
    fn inside_is_between_the_edges(pairs in strips(), t in -1.0..20.0, s in -6.0..60.0) {
        let strip = StBoundary::new(pairs).unwrap();
        let inside = strip.edges_at(t).is_some_and(|edges| edges.lower < s && s < edges.upper);
        let close = strip.edges_at(t).is_some_and(|edges| {
            (edges.lower - s).abs() < 1e-9 || (edges.upper - s).abs() < 1e-9
        });
        prop_assert!(close || strip.contains(StPoint::new(t, s)) == inside);
    }

    /// Against many points of the segment: one inside means that they meet; and where they meet, some point is
    /// inside or nearly so.
    #[test]
    fn a_segment_meets_what_its_points_meet(
        pairs in strips(), t in (-2.0..20.0, -2.0..20.0), s in (-10.0..60.0, -10.0..60.0),
    ) {
        let strip = StBoundary::new(pairs).unwrap();
        let (from, to) = (StPoint::new(t.0, s.0), StPoint::new(t.1, s.1));
        let gap = (0..=20_000).map(|k| {
            let share = f64::from(k) / 20_000.0;
            let at = StPoint::new(t.0 + (t.1 - t.0) * share, s.0 + (s.1 - s.0) * share);
            strip.edges_at(at.t).map_or(f64::MAX, |edges| (edges.lower - at.s).max(at.s - edges.upper))
        });
        let gap = gap.fold(f64::MAX, f64::min);
        // A step of the samples moves the segment by at most 4 mm, the edges by at most 0.6 m in 1 ms.
        if strip.meets_segment(from, to) {
            prop_assert!(gap < 1.0, "a gap of {gap}");
        } else {
            prop_assert!(gap > 0.0, "a gap of {gap}");
        }
    }

    /// Dropping pairs moves the edges by little, and never the ends.
    #[test]
    fn a_reduced_strip_is_much_the_same(pairs in strips()) {
        let (full, reduced) = (StBoundary::new(pairs.clone()).unwrap(), StBoundary::reduced(pairs).unwrap());
        prop_assert_eq!(full.first(), reduced.first());
        prop_assert_eq!(full.last(), reduced.last());
        for pair in reduced.pairs() {
            prop_assert!(full.pairs().contains(pair));
        }
    }

    #[test]
    fn expanding_keeps_what_was_inside(pairs in strips(), by in 0.0..5.0) {
        let strip = StBoundary::new(pairs).unwrap();
        let higher = strip.expanded_by_s(by).unwrap();
        let longer = strip.expanded_by_t(by.max(1e-3)).unwrap();
        prop_assert!((higher.min_s() - strip.min_s() + by).abs() <= 0.1 + 1e-9);
        prop_assert!((longer.min_t() - strip.min_t() + by.max(1e-3)).abs() < 1e-9);
        prop_assert!((longer.max_t() - strip.max_t() - by.max(1e-3)).abs() < 1e-9);
    }
}
