//! The golden vectors of the lattice planner, and that a wrong answer would be noticed.

use super::{add, code, conformance, file, last_line};
use serde_json::Value;
use std::io::Read;

/// The vectors: JSON lines, gzipped.
const VECTORS: &[u8] = include_bytes!("../data/lattice.jsonl.gz");

/// The first sound case of a function.
fn case(function: &str) -> Value {
    let mut text = String::new();
    flate2::read::GzDecoder::new(VECTORS)
        .read_to_string(&mut text)
        .unwrap();
    let mut cases = text
        .lines()
        .map(|line| serde_json::from_str::<Value>(line).unwrap());
    let is_wanted = |case: &Value| {
        case["function"] == function
            && case.get("defect").is_none()
            && case["expected"].get("result").is_none()
    };
    cases.find(is_wanted).unwrap()
}

#[test]
fn all_golden_vectors_of_the_lattice_planner_pass() {
    let output = conformance(&[&file("lattice.jsonl.gz", VECTORS)]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(
        (code(&output), last_line(&output).as_str()),
        (0, "902 passed, 0 failed"),
        "{said}"
    );
}

#[test]
fn a_number_that_is_off_is_reported() {
    let places = [
        ("cartesian_to_frenet", "/d/2"),
        ("frenet_to_cartesian", "/theta"),
        ("cubic", "/coef/3"),
        ("lattice_trajectory1d", "/values/3/1"),
        ("sample_lon_cruising", "/end_conditions/7/1"),
        ("sample_lon_path_time_points", "/end_conditions/3/0"),
        ("trajectory_bundles", "/lon/7/coef/3"),
        ("guide_velocity", "/guide_velocity/9"),
        ("trajectory_evaluator_run", "/cheapest_10/3/cost"),
        ("trajectory_combiner", "/points/20/4"),
        ("path_time_graph", "/st_obstacles/0/upper_right/1"),
        ("lateral_bounds", "/bounds/7/0"),
        ("path_matcher", "/match_by_xy/1/3"),
        ("prediction_querier", "/speed/0"),
        ("backup_trajectory", "/pairs/20/end_speed"),
    ];
    for (function, place) in places {
        let mut wrong = case(function);
        add(wrong["expected"].pointer_mut(place).unwrap(), 1e-3);
        let output = conformance(&[&file(
            &format!("off-{function}.jsonl"),
            wrong.to_string().as_bytes(),
        )]);
        assert_eq!(last_line(&output), "0 passed, 1 failed", "{function}");
    }
}

#[test]
fn a_wrong_flag_is_reported() {
    let places = [
        ("constraint_checker1d_longitudinal", "/valid"),
        ("trajectory_evaluator_costs", "/lon/0/passes_1d_check"),
        ("backup_trajectory", "/pairs/7/in_collision"),
    ];
    for (function, place) in places {
        let mut wrong = case(function);
        let flag = wrong["expected"].pointer_mut(place).unwrap();
        *flag = (!flag.as_bool().unwrap()).into();
        let output = conformance(&[&file(
            &format!("flag-{function}.jsonl"),
            wrong.to_string().as_bytes(),
        )]);
        assert_eq!(last_line(&output), "0 passed, 1 failed", "{function}");
    }
}
