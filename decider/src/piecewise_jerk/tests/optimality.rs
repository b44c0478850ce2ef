//! What must hold of any optimum, without another solver.

use super::{apart, cold, random};
use crate::piecewise_jerk::{Problem, Solution, Term};

/// The gradient of the cost at a curve times the way to another one.
fn slope_towards(problem: &Problem, from: &Solution, to: &Solution) -> f64 {
    let along = |term: &Term, from: f64, to: f64| 2.0 * term.weight * (from - term.reference) * (to - from);
    let sum = |terms: &[Term], from: &[f64], to: &[f64]| -> f64 {
        let each = terms.iter().zip(from.iter().zip(to));
        each.map(|(term, (from, to))| along(term, *from, *to)).sum()
    };
    let cost = &problem.cost;
    let last = problem.knots() - 1;
    let ends = |s: &Solution| [s.x[last], s.dx[last], s.ddx[last]];
    let jerks = vec![Term::new(cost.dddx, 0.0); last];
    sum(&cost.x, &from.x, &to.x)
        + sum(&cost.dx, &from.dx, &to.dx)
        + sum(&cost.ddx, &from.ddx, &to.ddx)
        + sum(&jerks, &from.dddx, &to.dddx)
        + sum(&cost.end, &ends(from), &ends(to))
}

/// The variational inequality: towards no other curve within the limits does the cost fall. Other curves are the optima
/// of other costs.
#[test]
fn the_cost_falls_towards_no_other_curve_within_the_limits() {
    let mut compared = 0;
    for seed in 0..300 {
        let problem = random::any(seed);
        let Ok(best) = cold(&problem) else { continue };
        let mut draw = random::Draw(seed);
        for _ in 0..4 {
            let mut other = problem.clone();
            for terms in [&mut other.cost.x, &mut other.cost.dx, &mut other.cost.ddx] {
                let term = Term::new(draw.between(0.0, 100.0), draw.between(-5.0, 30.0));
                terms.fill(term);
            }
            let Ok(curve) = cold(&other) else { continue };
            compared += usize::from(apart(&curve.x, &best.x) > 0.01);
            let slope = slope_towards(&problem, &best, &curve);
            assert!(
                slope > -1e-6 * problem.cost_of_solution(&curve).max(1.0),
                "{seed}: {slope:e}"
            );
        }
    }
    assert!(compared > 300, "{compared}");
}

#[test]
fn the_curve_obeys_its_own_derivatives() {
    for seed in 0..150 {
        let problem = random::any(seed);
        let Ok(curve) = cold(&problem) else { continue };
        let d = problem.delta;
        assert_eq!(
            (curve.x[0], curve.dx[0]),
            (problem.initial.x, problem.initial.dx),
            "{seed}"
        );
        for i in 0..problem.knots() - 1 {
            let (x, v, a, j) = (curve.x[i], curve.dx[i], curve.ddx[i], curve.dddx[i]);
            let next = [
                x + d * v + d * d / 2.0 * a + d * d * d / 6.0 * j,
                v + d * a + d * d / 2.0 * j,
                a + d * j,
            ];
            let got = [curve.x[i + 1], curve.dx[i + 1], curve.ddx[i + 1]];
            assert!(apart(&next, &got) < 1e-9, "{seed} at {i}: {next:?} {got:?}");
        }
    }
}

#[test]
fn in_a_mirror_the_solution_is_mirrored() {
    for seed in 0..90 {
        let problem = random::any(seed);
        match (cold(&problem), cold(&problem.mirrored())) {
            (Ok(curve), Ok(mirrored)) => {
                let turned: Vec<f64> = mirrored.x.iter().map(|x| -x).collect();
                assert!(apart(&curve.x, &turned) < 1e-9, "{seed}");
                assert!(
                    (curve.cost - mirrored.cost).abs() < 1e-9 * curve.cost.max(1.0),
                    "{seed}"
                );
            }
            (curve, mirrored) => assert_eq!(curve, mirrored, "{seed}"),
        }
    }
}
