//! What makes no sense is refused, and says why; what is merely extreme ends.

use super::{by_clarabel, cold, random};
use crate::piecewise_jerk::{Problem, ProblemError, SolveError, Term};

fn some() -> Problem {
    random::path(&mut random::Draw(5)).to_problem()
}

#[test]
fn nonsense_is_refused_by_both() {
    type Change = fn(&mut Problem);
    let changes: [(&str, Change); 13] = [
        ("no knots", |p| p.x.clear()),
        ("one knot", |p| p.x.truncate(1)),
        ("a list too short", |p| p.ddx.truncate(3)),
        ("a jerk too many", |p| p.dddx.push((-1.0, 1.0))),
        ("no spacing", |p| p.delta = 0.0),
        ("negative spacing", |p| p.delta = -0.5),
        ("spacing nan", |p| p.delta = f64::NAN),
        ("limits crossed", |p| p.x[7] = (1.0, 0.5)),
        ("limit nan", |p| p.dx[7].1 = f64::NAN),
        ("limit above all", |p| p.x[7] = (f64::INFINITY, f64::INFINITY)),
        ("negative weight", |p| p.cost.dx[3].weight = -1.0),
        ("reference nan", |p| p.cost.end[0] = Term::new(1.0, f64::NAN)),
        ("initial nan", |p| p.initial.ddx = f64::NAN),
    ];
    for (what, change) in changes {
        let mut problem = some();
        change(&mut problem);
        for answer in [cold(&problem), by_clarabel(&problem)] {
            assert!(
                matches!(answer, Err(SolveError::Invalid(_))),
                "{what}: {answer:?}"
            );
        }
    }
}

#[test]
fn the_message_names_the_place() {
    let mut problem = some();
    problem.x[7] = (1.0, 0.5);
    let error = problem.validate().unwrap_err();
    assert_eq!(error.to_string(), "`x` at 7: limits 1 to 0.5 are not a range");
    assert!(SolveError::from(error).is_infeasible());
    problem.x[7].1 = f64::NAN;
    assert!(!SolveError::from(problem.validate().unwrap_err()).is_infeasible());
    assert_eq!(
        ProblemError::TooFewKnots(1).to_string(),
        "a curve has at least 2 knots, not 1"
    );
}

/// No limits at all, none that bind, weights of any size: an answer within its limits or an error, soon.
#[test]
fn extremes_end() {
    for scale in [0.0, 1e-12, 1.0, 1e12, 1e300] {
        for limit in [1e-9, 1.0, 1e10, f64::MAX, f64::INFINITY] {
            let mut problem = some();
            for term in &mut problem.cost.x {
                term.weight *= scale;
            }
            problem.cost.dddx *= scale;
            problem.x.fill((-limit, limit));
            problem.ddx.fill((-limit, limit));
            problem.dddx.fill((-limit, limit));
            problem.admit_initial_state();
            if let Ok(curve) = cold(&problem) {
                assert!(problem.violation(&curve) < 1e-8, "{scale} {limit}");
                assert!(curve.x.iter().all(|x| x.is_finite()), "{scale} {limit}");
            }
        }
    }
}

#[test]
fn two_knots_are_enough() {
    let mut problem = some();
    for list in [&mut problem.x, &mut problem.dx, &mut problem.ddx] {
        list.truncate(2);
    }
    problem.dddx.truncate(1);
    for terms in [&mut problem.cost.x, &mut problem.cost.dx, &mut problem.cost.ddx] {
        terms.truncate(2);
    }
    let (ours, theirs) = (cold(&problem).unwrap(), by_clarabel(&problem).unwrap());
    assert!((ours.x[1] - theirs.x[1]).abs() < 1e-8);
}
