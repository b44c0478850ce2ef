//! The exact optima of piecewise-jerk problems, and that a wrong answer would be noticed.

use super::{add, code, conformance, file, last_line};
use serde_json::Value;
use std::io::Read;

/// The vectors: JSON lines, gzipped.
const VECTORS: &[u8] = include_bytes!("../data/qp.jsonl.gz");

fn case(name: &str) -> Value {
    let mut text = String::new();
    flate2::read::GzDecoder::new(VECTORS)
        .read_to_string(&mut text)
        .unwrap();
    let cases = text.lines().map(|line| serde_json::from_str(line).unwrap());
    cases
        .into_iter()
        .find(|case: &Value| case["name"] == name)
        .unwrap()
}

fn verdict(name: &str, case: &Value) -> (i32, String) {
    let output = conformance(&[&file(name, case.to_string().as_bytes())]);
    (code(&output), last_line(&output))
}

#[test]
fn all_optima_are_found_and_all_infeasible_problems_recognised() {
    let output = conformance(&[&file("qp.jsonl.gz", VECTORS)]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(
        (code(&output), last_line(&output).as_str()),
        (0, "147 passed, 0 failed"),
        "{said}"
    );
}

#[test]
fn an_optimum_that_is_off_is_reported() {
    let kinds = [
        "path_qp_045",
        "path_qp_diagonal_005",
        "speed_qp_001",
        "fallback_speed_qp_011",
    ];
    for name in kinds {
        for (list, amount) in [("x", 2e-7), ("dx", 2e-7), ("ddx", 2e-5)] {
            let mut wrong = case(name);
            add(&mut wrong["expected"][list][9], amount);
            let found = verdict(&format!("{name}-{list}.jsonl"), &wrong);
            assert_eq!(found, (1, "0 passed, 1 failed".to_owned()), "{name} {list}");
        }
        let mut wrong = case(name);
        let cost = wrong["expected"]["cost"].as_f64().unwrap();
        wrong["expected"]["cost"] = (cost * (1.0 + 1e-8)).into();
        assert_eq!(verdict(&format!("{name}-cost.jsonl"), &wrong).0, 1, "{name} cost");
    }
}

#[test]
fn a_wrong_status_is_reported() {
    let mut solved = case("speed_qp_001");
    solved["expected"] = serde_json::json!({"status": "infeasible"});
    assert_eq!(verdict("solved.jsonl", &solved).0, 1);
    let mut infeasible = case("fallback_speed_qp_inf_000");
    infeasible["expected"] = case("fallback_speed_qp_011")["expected"].clone();
    assert_eq!(verdict("infeasible.jsonl", &infeasible).0, 1);
}

/// The weights of one kind must not pass for those of the other.
#[test]
fn the_diagonal_hessian_is_another_problem() {
    let mut other = case("path_qp_diagonal_011");
    other["function"] = "path_qp".into();
    assert_eq!(verdict("coupled.jsonl", &other).0, 1);
}
