//! Problems without a solution are recognised, soon, and by both.

use super::{by_clarabel, cold, random};
use crate::piecewise_jerk::{FallbackSpeedProblem, Problem, SolveError};

fn assert_infeasible(what: &str, problem: &Problem) {
    assert_eq!(cold(problem), Err(SolveError::Infeasible), "{what}");
    assert_eq!(by_clarabel(problem), Err(SolveError::Infeasible), "{what}");
}

/// The list of the specification.
#[test]
fn a_car_that_cannot_stop_as_it_should() {
    let cases = [
        (1.0, -3.0),
        (2.0, -3.0),
        (0.2, -1.0),
        (3.0, -4.0),
        (10.0, -7.0),
        (10.0, 2.5),
        (-0.01, 0.5),
    ];
    for (v, a) in cases {
        let problem = FallbackSpeedProblem::shortest_stop(v, a).to_problem();
        assert_infeasible(&format!("{v} {a}"), &problem);
    }
    // Releasing the brake takes a²/4.
    for (v, a) in [(0.25, -1.0), (2.25, -3.0), (4.0, -4.0)] {
        let mut stop = FallbackSpeedProblem::shortest_stop(v + 1e-3, a);
        assert!(cold(&stop.to_problem()).is_ok(), "{v} {a}");
        stop.initial.dx = v - 1e-3;
        assert_infeasible(&format!("{v} {a}"), &stop.to_problem());
    }
}

#[test]
fn a_speed_above_the_limit_now() {
    let mut draw = random::Draw(3);
    let mut profile = random::speed(&mut draw);
    profile.initial.dx = 10.0;
    profile.v.fill((0.0, 8.0));
    assert_infeasible("v0 above the limit", &profile.to_problem());
    let mut admitted = profile.to_problem();
    admitted.admit_initial_state();
    // Only knot 0 is excused: the next is too soon.
    assert_infeasible("limit a tenth of a second later", &admitted);
}

/// A wall across the lane: the left bound is right of the right one a metre later.
#[test]
fn a_chicane_that_is_too_narrow() {
    let mut draw = random::Draw(1);
    let mut path = random::path(&mut draw);
    path.l.fill((-2.0, 2.0));
    path.initial.x = 0.0;
    path.l[10] = (1.0, 2.0);
    assert_infeasible("a metre aside in 5 m", &path.to_problem());
}

/// Neither by the cap on iterations nor by giving up: by proof.
#[test]
fn every_refusal_is_a_proof() {
    let refusals = (0..3000).filter_map(|seed| cold(&random::any(seed)).err());
    let mut count = 0;
    for error in refusals {
        count += 1;
        assert_eq!(error, SolveError::Infeasible);
    }
    assert!(count > 200, "{count}");
}
