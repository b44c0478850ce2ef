//! Bins against worked numbers, and their sums against the runs.

use super::*;
use crate::testing::scenario;
use corridor_decider::geometry::Pose;
use corridor_scenarios::{MapCache, catalog};

fn situation(gap: Option<f64>, speed: f64) -> Situation {
    Situation {
        gap,
        offset: gap,
        speed,
        curvature: 0.01,
    }
}

fn count(bins: &Bins, name: &str) -> u64 {
    let found = bins.counts().iter().find(|(bin, _)| bin == name);
    found.unwrap_or_else(|| panic!("no bin {name} in {bins:?}")).1
}

fn bins<'a>(coverage: &'a Coverage, name: &str) -> &'a Bins {
    coverage
        .situations()
        .into_iter()
        .find(|(of, _)| of.starts_with(name))
        .unwrap()
        .1
}

#[test]
fn values_fall_between_their_edges() {
    let mut coverage = Coverage::default();
    for (gap, speed) in [(Some(0.0), 3.9), (Some(2.2), 4.0), (Some(9.0), 30.0), (None, 0.0)] {
        coverage.add("f", &[], &situation(gap, speed), &Decided::default());
    }
    let gaps = bins(&coverage, "gap");
    assert_eq!(gaps.counts().iter().map(|(_, count)| count).sum::<u64>(), 4);
    assert_eq!(
        ["0 to 1.5", "2.11 to 2.5", "from 5", "none", "3 to 3.5"].map(|name| count(gaps, name)),
        [1, 1, 1, 1, 0]
    );
    let speeds = bins(&coverage, "speed");
    assert_eq!(
        ["0 to 4", "4 to 6", "from 17"].map(|name| count(speeds, name)),
        [2, 1, 1]
    );
    let offsets = bins(&coverage, "its lateral");
    assert_eq!(
        ["-0.3 to 0.3", "from 2", "none", "below -3"].map(|name| count(offsets, name)),
        [1, 2, 1, 0]
    );
    let mut lower = Coverage::default();
    lower.add("f", &[], &situation(Some(-5.0), 1.0), &Decided::default());
    assert_eq!(count(bins(&lower, "its lateral"), "below -3"), 1);
    assert_eq!(count(bins(&coverage, "sharpest"), "0.0083 to 0.0167"), 4);
}

#[test]
fn numbers_fill_the_bins_of_their_laws_and_what_is_empty_is_named() {
    let family = catalog::find("parked_row")
        .unwrap()
        .load(&MapCache::new())
        .unwrap();
    let mut whole = Coverage::default();
    let mut halves = [Coverage::default(), Coverage::default()];
    for seed in 0..200 {
        let drawn = family.draw(seed).unwrap();
        let at = Situation::of(&drawn.scenario);
        whole.add("row", &drawn.parameters, &at, &Decided::default());
        halves[usize::from(seed % 2 == 0)].add("row", &drawn.parameters, &at, &Decided::default());
    }
    let of = |coverage: &Coverage, key: &str| {
        coverage
            .parameters()
            .find(|(_, k, _)| *k == key)
            .unwrap()
            .2
            .clone()
    };
    let speed = of(&whole, "cruise_speed");
    assert_eq!((speed.counts().len(), speed.empty().count()), (10, 0));
    assert!(
        speed.counts().iter().all(|(_, count)| (6..40).contains(count)),
        "{speed:?}"
    );
    // Five to twelve cars in a row: a bin for each number of them; and all members of the row in one line.
    assert_eq!(of(&whole, "parked[0].count").counts().len(), 8);
    assert!(
        of(&whole, "parked[0].l")
            .counts()
            .iter()
            .all(|(_, count)| *count > 100)
    );
    assert!(!whole.parameters().any(|(_, key, _)| key.contains("l[")));
    let [mut sum, other] = halves;
    sum.merge(&other);
    assert_eq!(sum, whole);

    let mut one = Coverage::default();
    let drawn = family.draw(1).unwrap();
    one.add(
        "row",
        &drawn.parameters,
        &Situation::of(&drawn.scenario),
        &Decided::default(),
    );
    let table = one.to_table();
    assert!(
        table.contains("coverage of 1 runs") && table.contains("EMPTY"),
        "{table}"
    );
    assert_eq!(of(&one, "cruise_speed").empty().count(), 9);
    assert!(
        table
            .lines()
            .any(|line| line.starts_with("row cruise_speed") && line.contains("% to")),
        "{table}"
    );
}

#[test]
fn the_gap_is_the_wider_way_past_the_narrowest_body() {
    // The road of these scenarios reaches 5.25 m to the left and 1.75 m to the right; a body is 4.6 m by 1.9 m.
    let parked = |x, y| Behaviour::Parked(Pose::new(x, y, 0.0));
    let scene = scenario(
        Pose::new(20.0, 0.0, 0.0),
        5.0,
        vec![
            parked(60.0, -1.5),
            parked(100.0, 1.75),
            parked(500.0, 1.0),
            parked(5.0, 1.0),
        ],
    );
    let at = Situation::of(&scene);
    assert!((at.gap.unwrap() - (5.25 - 1.75 - 0.95)).abs() < 0.06, "{at:?}");
    assert!((at.offset.unwrap() - 1.75).abs() < 1e-6 && at.curvature < 1e-12);
    assert_eq!(
        Situation::of(&scenario(Pose::new(20.0, 0.0, 0.0), 5.0, Vec::new())).gap,
        None
    );
}

#[test]
fn labels_and_rungs_that_never_came_are_empty() {
    let mut coverage = Coverage::default();
    let decided = Decided {
        labels: BTreeMap::from([
            ("regular/self/".to_owned(), 90),
            ("of another planner".to_owned(), 1),
        ]),
        rungs: BTreeMap::from([("normal".to_owned(), 91)]),
    };
    coverage.add("f", &[], &situation(None, 5.0), &decided);
    let labels = bins(&coverage, "label");
    assert_eq!(
        (
            count(labels, "regular/self/"),
            count(labels, "of another planner")
        ),
        (90, 1)
    );
    assert!(labels.empty().any(|label| label == "regular/pullover") && labels.empty().count() == 7);
    assert_eq!(bins(&coverage, "rung").empty().count(), 6);
}
