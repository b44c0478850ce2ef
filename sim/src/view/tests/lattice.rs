//! What the page tells of the lattice planner is what that planner weighed, and the decision is what came of it.

use super::data;
use crate::explain::words;
use crate::run::run_recorded;
use crate::settings::Settings;
use crate::trace::{Trace, TraceWriter, synthetic};
use crate::view::again::Again;
use crate::view::letters::tests::numbers;
use crate::view::page;
use corridor_decider::decision::SpeedRung;
use corridor_decider::lattice::{self, Outcome, Rejection};
use corridor_scenarios::{MapCache, catalog};
use serde_json::Value;
use std::sync::OnceLock;

/// What a sum of six costs may be off by when each is rounded to a hundredth.
const ROUNDED: f64 = 0.06;

fn recorded(name: &str, overrides: &[&str]) -> Trace {
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    let family = catalog::find(name).unwrap().load(&MapCache::new()).unwrap();
    let drawn = family.draw(1).unwrap();
    run_recorded(
        &family,
        &drawn.scenario,
        &overrides,
        &Settings::with(&overrides).unwrap(),
    )
}

/// Cruises, brakes as a backup, follows, stops and drives on.
fn braking_leader() -> &'static Trace {
    static TRACE: OnceLock<Trace> = OnceLock::new();
    TRACE.get_or_init(|| recorded("hard_braking_leader", &["decider.planner=lattice"]))
}

fn array(value: &Value) -> &Vec<Value> {
    value.as_array().unwrap()
}

fn place(value: &Value) -> usize {
    usize::try_from(value.as_u64().unwrap()).unwrap()
}

fn read(value: &Value) -> Vec<i64> {
    numbers(value.as_str().unwrap())
}

fn sums(differences: &[i64]) -> Vec<i64> {
    let mut sum = 0;
    let add = |difference: &i64| {
        sum += difference;
        sum
    };
    differences.iter().map(add).collect()
}

#[test]
fn what_is_weighed_again_is_what_was_decided() {
    for trace in [
        braking_leader(),
        &recorded("lane_change_left_occupied", &["decider.planner=lattice"]),
    ] {
        let mut again = Again::new(trace).unwrap();
        let mut found = 0;
        for (k, tick) in trace.ticks.iter().enumerate() {
            let weighed = again.survey(k).unwrap();
            let (survey, decision) = (&weighed.survey, &tick.decision);
            assert_eq!(weighed.place, decision.line);
            let own = |line: &&corridor_decider::planner::LineCost| line.place == weighed.place;
            let own = weighed.lines.iter().find(own).unwrap().sum();
            assert!(weighed.lines.iter().all(|line| own <= line.sum()));
            assert_eq!(
                lattice::trajectory(&survey.planned.points),
                decision.trajectory,
                "tick {k}"
            );
            let free = survey.pairs.iter().filter(|(_, rejection)| rejection.is_none());
            let cheapest = free.map(|(pair, _)| pair.cost).fold(f64::MAX, f64::min);
            match survey.planned.outcome {
                Outcome::Found(pair) => {
                    found += 1;
                    assert!(survey.pairs.contains(&(pair, None)));
                    assert_eq!(pair.cost.to_bits(), cheapest.to_bits());
                }
                Outcome::Backup(_) | Outcome::LastResort(..) => {
                    assert_eq!(cheapest.to_bits(), f64::MAX.to_bits(), "nothing was free");
                    assert!(decision.fallback.unwrap().speed >= Some(SpeedRung::LatticeBackup));
                }
            }
            assert_eq!(survey.costs.len(), survey.pairs.len());
            for ((pair, _), costs) in survey.pairs.iter().zip(&survey.costs) {
                assert_eq!(pair.cost.to_bits(), costs.sum().to_bits());
            }
        }
        assert!(again.differs_from().is_none() && found > 50);
    }
}

#[test]
fn every_pair_has_a_reason_and_the_driven_one_is_the_cheapest_of_the_free() {
    let trace = braking_leader();
    let data = data(&page(trace));
    let mut brakes = 0;
    for tick in array(&data["ticks"]) {
        let bundle = &tick["bundle"];
        let (lateral, unfit) = (read(&bundle["lateral"]).len(), bundle["unfit"].as_str().unwrap());
        assert_eq!(unfit.len(), read(&bundle["longitudinal"]).len());
        let fit: Vec<usize> = (0..unfit.len()).filter(|k| &unfit[*k..=*k] == "-").collect();
        let (wrong, together, alone) = (
            read(&bundle["wrong"]),
            read(&bundle["together"]),
            read(&bundle["alone"]),
        );
        assert_eq!(
            (wrong.len(), together.len(), alone.len()),
            (fit.len() * lateral, 2 * wrong.len(), 4 * fit.len())
        );
        let faults: Vec<&str> = array(&bundle["faults"])
            .iter()
            .map(|fault| data["texts"][place(fault)].as_str().unwrap())
            .collect();
        let faults_of = i64::try_from(faults.len()).unwrap();
        assert!((1..=faults_of).all(|fault| wrong.contains(&fault)));
        assert!(wrong.iter().all(|fault| (0..=faults_of).contains(fault)));
        let cost = |k: usize| {
            let first = 4 * (k / lateral);
            let parts = alone[first..first + 4].iter().chain(&together[2 * k..2 * k + 2]);
            parts.sum::<i64>() as f64 / 100.0
        };
        let free = (0..wrong.len()).filter(|k| wrong[*k] == 0);
        let cheapest = free.map(cost).fold(f64::MAX, f64::min);
        if let Some(chosen) = bundle["chosen"].as_array() {
            let along = fit.iter().position(|k| *k == place(&chosen[0])).unwrap();
            let k = along * lateral + place(&chosen[1]);
            assert!(
                wrong[k] == 0 && cost(k) <= cheapest + ROUNDED,
                "{} above {cheapest}",
                cost(k)
            );
        } else {
            brakes += 1;
            assert!(!wrong.contains(&0) && bundle["braking"]["deceleration"].as_f64().unwrap() < 0.0);
            assert!(faults.contains(&"touches `leader`"), "{faults:?}");
        }
    }
    let fallen = trace
        .ticks
        .iter()
        .filter(|tick| tick.decision.fallback.is_some())
        .count();
    assert_eq!((brakes, fallen > 0), (fallen, true));
}

#[test]
fn curves_can_be_read_from_their_letters() {
    let trace = braking_leader();
    let data = data(&page(trace));
    let mut again = Again::new(trace).unwrap();
    for k in 0..40 {
        let survey = again.survey(k).unwrap().survey;
        let bundle = &data["ticks"][k]["bundle"];
        let [start, ..] = survey.initial.s;
        let curve = |place: i64| read(&data["curves"][usize::try_from(place).unwrap()]);
        for (place, (sampled, _)) in sums(&read(&bundle["longitudinal"]))
            .into_iter()
            .zip(&survey.longitudinal)
        {
            let ways = sums(&sums(&curve(place)));
            assert_eq!(ways.len(), 17, "every half second of eight");
            for (way, t) in ways.iter().zip(0..) {
                let wanted = sampled.curve.at(f64::from(t) * 0.5)[0] - start;
                assert!(
                    (*way as f64 / 10.0 - wanted).abs() < 0.051,
                    "{way} dm or {wanted} m"
                );
            }
        }
        for (place, lateral) in sums(&read(&bundle["lateral"])).into_iter().zip(&survey.lateral) {
            for point in curve(place).chunks(2) {
                assert!((point[1] as f64 / 100.0 - lateral.at(point[0] as f64)[0]).abs() < 0.0051);
            }
        }
        let boxes = array(&bundle["boxes"]);
        assert_eq!(boxes.len(), survey.entries.len());
    }
}

#[test]
fn a_trace_from_a_file_comes_out_the_same_until_it_is_another() {
    let mut trace = braking_leader().clone();
    trace.ticks.truncate(40);
    let file = std::env::temp_dir().join(format!("corridor-view-{}.trace", std::process::id()));
    let mut writer = TraceWriter::create(&file, &trace.header).unwrap();
    trace.ticks.iter().for_each(|tick| writer.tick(tick).unwrap());
    drop(writer);
    let mut trace = Trace::open(&file).unwrap();
    std::fs::remove_file(&file).unwrap();
    let same = data(&page(&trace));
    assert!(
        same["lattice"]["differs_from"].is_null(),
        "rounding is not a difference"
    );
    trace.ticks[25].decision.trajectory[10].v += 0.01;
    let data = data(&page(&trace));
    assert_eq!(data["lattice"]["differs_from"], 25);
    for (k, tick) in array(&data["ticks"]).iter().enumerate() {
        assert_eq!(tick.get("bundle").is_some(), k < 25, "tick {k}");
    }
}

#[test]
fn other_planners_and_unknown_settings_have_no_bundles() {
    for trace in [synthetic::trace(12, 5), recorded("empty_road", &["tick=0.5"])] {
        let data = data(&page(&trace));
        assert!(data["lattice"].is_null());
        assert!(
            array(&data["ticks"])
                .iter()
                .all(|tick| tick.get("bundle").is_none())
        );
    }
}

#[test]
fn tasks_are_told_in_their_order_up_to_the_one_that_failed() {
    let failure = r#"failures=[{"of":{"task":"path_bounds"},"from":1,"until":2}]"#;
    let trace = recorded("nudge_parked_car", &[failure]);
    let data = data(&page(&trace));
    let mut failed = 0;
    for (tick, record) in array(&data["ticks"]).iter().zip(&trace.ticks) {
        let told: Vec<&Value> = array(&tick["tasks"])
            .iter()
            .map(|k| &data["tasks"][place(k)])
            .collect();
        let names: Vec<&str> = told.iter().map(|task| task[0].as_str().unwrap()).collect();
        let ran: Vec<String> = (record.decision.tasks.iter())
            .map(|report| report.task.to_string())
            .collect();
        assert_eq!(names, ran);
        let Some(fallback) = tick["fallback"].as_array() else {
            assert!(names.len() == 14 && told.iter().all(|task| array(task).len() == 3));
            continue;
        };
        failed += 1;
        assert_eq!((names.last(), array(told[3]).len()), (Some(&"path_bounds"), 4));
        let rung = record
            .decision
            .fallback
            .and_then(|fallback| fallback.path)
            .unwrap();
        let told: Vec<&str> = fallback
            .iter()
            .map(|k| data["texts"][place(k)].as_str().unwrap())
            .collect();
        assert_eq!(
            told,
            [
                "the task `path_bounds` failed",
                words::path_rung(rung),
                "optimised stop"
            ]
        );
    }
    assert_eq!(failed, 10);
}

#[test]
fn every_kind_of_fault_has_words() {
    let trace = synthetic::trace(1, 3);
    let violations = [
        lattice::Violation::Speed,
        lattice::Violation::Acceleration,
        lattice::Violation::Curvature,
        lattice::Violation::Jerk,
        lattice::Violation::LateralAcceleration,
    ];
    let mut words: Vec<String> = violations
        .map(Rejection::Violates)
        .into_iter()
        .chain([Rejection::LeavesLine])
        .map(|fault| words::rejection(&trace, fault))
        .collect();
    words.sort();
    words.dedup();
    assert_eq!(words.len(), 6);
}
