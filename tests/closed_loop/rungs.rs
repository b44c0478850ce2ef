//! Every rung of the chain of fallbacks, reached by the failure that leads to it, in a drive that ends well all the same.

use crate::support::scenario;
use corridor_decider::decision::{ContextFailure, FallbackCause, Outcome, PathRung, SpeedRung};
use corridor_decider::planner::TaskName;
use corridor_decider::quirks::Quirks;
use corridor_sim::faults::{Failure, Part};
use corridor_sim::run::run;
use corridor_sim::settings::Settings;
use corridor_sim::verdict::{FallbackCount, Verdict};

/// A drive past a parked car with parts that fail for a while.
fn drive(failures: &[(Part, f64, f64)]) -> Verdict {
    drive_with(Quirks::default(), failures)
}

/// The same with defects of the original.
fn drive_with(quirks: Quirks, failures: &[(Part, f64, f64)]) -> Verdict {
    let failures = failures.iter().map(|(of, from, until)| Failure {
        of: *of,
        from: *from,
        until: *until,
    });
    let mut settings = Settings {
        failures: failures.collect(),
        ..Settings::default()
    };
    settings.decider.quirks = quirks;
    run(&scenario("nudge_parked_car"), &settings)
}

/// What the drive counts for one outcome; it must have ended well and planned again.
fn counted(failures: &[(Part, f64, f64)], outcome: Outcome) -> FallbackCount {
    let verdict = drive(failures);
    assert!(verdict.pass, "{outcome:?}: {}", verdict.summary);
    let count = verdict.fallbacks.iter().find(|count| count.outcome == outcome);
    let count = *count.unwrap_or_else(|| panic!("no {outcome:?} in {:?}", verdict.fallbacks));
    assert!(count.recovered, "{count:?}");
    count
}

const BOUNDS: Part = Part::Task(TaskName::PathBounds);
const SPEED: Part = Part::Task(TaskName::PiecewiseJerkSpeed);

#[test]
fn without_failures_nothing_falls_back() {
    let verdict = drive(&[]);
    assert!(
        verdict.pass && verdict.fallbacks.is_empty(),
        "{:?}",
        verdict.fallbacks
    );
}

#[test]
fn a_failed_speed_keeps_the_fresh_path_and_stops_on_it() {
    let count = counted(&[(SPEED, 3.0, 3.5)], Outcome::SpeedFallback);
    assert_eq!(
        count.fallback.cause,
        FallbackCause::Task(TaskName::PiecewiseJerkSpeed)
    );
    assert_eq!(
        (count.fallback.path, count.fallback.speed),
        (None, Some(SpeedRung::Optimised))
    );
    assert_eq!(count.ticks, 5);
    assert!(
        (count.first - 3.0).abs() < 1e-9 && (count.longest - 0.4).abs() < 1e-9,
        "{count:?}"
    );
}

#[test]
fn every_task_may_fail() {
    for task in corridor_decider::planner::LANE_FOLLOW {
        let verdict = drive(&[(Part::Task(task), 2.0, 4.0)]);
        let counted: u32 = verdict.fallbacks.iter().map(|count| count.ticks).sum();
        assert!(
            verdict.pass && counted == 20,
            "{task}: {} {:?}",
            verdict.summary,
            verdict.fallbacks
        );
    }
}

#[test]
fn each_rung_of_the_speed_is_reached_when_those_before_it_fail() {
    let rungs = [
        SpeedRung::Optimised,
        SpeedRung::EmergencyJerk,
        SpeedRung::Ramp,
        SpeedRung::ConstantDeceleration,
    ];
    for k in 0..rungs.len() {
        let mut failures = vec![(SPEED, 3.0, 4.0)];
        failures.extend(rungs[..k].iter().map(|rung| (Part::Speed(*rung), 0.0, 9.0)));
        let count = counted(&failures, Outcome::SpeedFallback);
        assert_eq!(count.fallback.speed, Some(rungs[k]));
    }
}

#[test]
fn each_rung_of_the_path_is_reached_when_those_before_it_fail() {
    // The assessment fails: the bounds have paths, but none is chosen.
    let assessment = Part::Task(TaskName::PathAssessment);
    let rungs = [
        PathRung::LastPath,
        PathRung::SelfLane,
        PathRung::OffsetLine,
        PathRung::HeldArc,
    ];
    for k in 0..rungs.len() {
        let mut failures = vec![(assessment, 3.0, 3.4)];
        failures.extend(rungs[..k].iter().map(|rung| (Part::Path(*rung), 0.0, 9.0)));
        let count = counted(&failures, Outcome::PathFallback);
        assert_eq!(count.fallback.path, Some(rungs[k]));
        assert_eq!(
            count.fallback.cause,
            FallbackCause::Task(TaskName::PathAssessment)
        );
    }
}

#[test]
fn an_old_path_is_not_driven_for_ever() {
    let verdict = drive(&[(BOUNDS, 3.0, 6.0)]);
    assert!(verdict.pass, "{}", verdict.summary);
    let on = |rung| {
        verdict
            .fallbacks
            .iter()
            .filter(move |count| count.fallback.path == Some(rung))
    };
    assert_eq!(on(PathRung::LastPath).map(|count| count.ticks).sum::<u32>(), 5);
    assert_eq!(on(PathRung::OffsetLine).map(|count| count.ticks).sum::<u32>(), 25);
}

#[test]
fn without_any_path_the_car_brakes_with_its_wheels_as_they_are() {
    let mut failures = vec![(BOUNDS, 3.0, 3.6)];
    let all = [
        PathRung::LastPath,
        PathRung::SelfLane,
        PathRung::OffsetLine,
        PathRung::HeldArc,
    ];
    failures.extend(all.map(|rung| (Part::Path(rung), 0.0, 9.0)));
    let count = counted(&failures, Outcome::EmergencyStop);
    assert_eq!((count.fallback.path, count.fallback.speed), (None, None));
}

#[test]
fn a_blind_car_stops_along_its_last_trajectory_and_then_brakes_hardest() {
    for (part, failure) in [
        (Part::Localisation, ContextFailure::NoLocalisation),
        (Part::ReferenceLine, ContextFailure::NoReferenceLine),
    ] {
        let count = counted(&[(part, 3.0, 3.5)], Outcome::BlindStop);
        assert_eq!(count.fallback.cause, FallbackCause::Context(failure));
        assert_eq!(count.ticks, 5);
        let long = drive(&[(part, 3.0, 5.5)]);
        assert!(long.pass, "{}", long.summary);
        let ended_in = |outcome| long.fallbacks.iter().any(|count| count.outcome == outcome);
        assert!(ended_in(Outcome::BlindStop), "{:?}", long.fallbacks);
        assert!(
            ended_in(Outcome::EmergencyStop) || ended_in(Outcome::Hold),
            "{:?}",
            long.fallbacks
        );
    }
}

#[test]
fn a_car_that_stands_and_sees_nothing_stays_where_it_is() {
    let count = counted(&[(Part::ReferenceLine, 3.0, 8.0)], Outcome::Hold);
    assert_eq!(
        count.fallback.cause,
        FallbackCause::Context(ContextFailure::NoReferenceLine)
    );
}

#[test]
fn a_failure_of_the_last_tick_is_no_source_of_paths() {
    // Two failures in a row: the second must not find an empty path of the first.
    let verdict = drive(&[(BOUNDS, 3.0, 3.1), (SPEED, 3.1, 3.2), (BOUNDS, 3.2, 3.3)]);
    assert!(verdict.pass, "{}", verdict.summary);
    let ticks: u32 = verdict.fallbacks.iter().map(|count| count.ticks).sum();
    assert_eq!(ticks, 3, "{:?}", verdict.fallbacks);
}

#[test]
fn the_original_throws_a_fresh_path_away() {
    let quirks = Quirks {
        fallback_discards_fresh_path: true,
        ..Quirks::default()
    };
    let verdict = drive_with(quirks, &[(SPEED, 3.0, 3.5)]);
    assert_eq!(verdict.fallbacks[0].outcome, Outcome::PathFallback);
    assert_eq!(verdict.fallbacks[0].fallback.path, Some(PathRung::LastPath));
}

#[test]
fn the_original_forgets_the_last_path_when_it_is_needed() {
    let quirks = Quirks {
        fallback_forgets_last_path: true,
        ..Quirks::default()
    };
    let verdict = drive_with(quirks, &[(BOUNDS, 3.0, 3.4)]);
    assert_eq!(verdict.fallbacks[0].fallback.path, Some(PathRung::OffsetLine));
}

#[test]
fn a_frozen_pose_makes_a_blind_car_brake_as_hard_as_it_can() {
    let quirks = Quirks {
        frozen_pose: true,
        ..Quirks::default()
    };
    let blind = [(Part::ReferenceLine, 3.0, 3.3)];
    let braking = |verdict: &Verdict| {
        let metric = verdict
            .metrics
            .iter()
            .find(|metric| metric.name == "lon_jerk")
            .unwrap();
        metric.value.unwrap()
    };
    let (right, wrong) = (drive(&blind), drive_with(quirks, &blind));
    assert_eq!(wrong.fallbacks[0].outcome, Outcome::Hold);
    assert!(
        braking(&wrong) > braking(&right) + 2.0,
        "{} {}",
        braking(&wrong),
        braking(&right)
    );
}
