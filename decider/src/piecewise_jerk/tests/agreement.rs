//! A thousand random problems: our solver and Clarabel find the same, or both find that there is nothing.

use super::{by_clarabel, cold, differences, random};

/// Values, m.
const VALUE: f64 = 1e-4;

#[test]
fn both_solvers_agree_on_a_thousand_random_problems() {
    let mut counts = [[0; 2]; 3];
    for seed in 0..1000_u64 {
        let problem = random::any(seed);
        let kind = usize::try_from(seed % 3).unwrap();
        match (cold(&problem), by_clarabel(&problem)) {
            (Ok(ours), Ok(theirs)) => {
                counts[kind][0] += 1;
                let [x, dx, ddx] = differences(&ours, &theirs);
                assert!(
                    x < VALUE && dx < VALUE && ddx < 5.0 * VALUE,
                    "{seed}: {x:e} {dx:e} {ddx:e}"
                );
                let dearer = (ours.cost - theirs.cost) / theirs.cost.max(1.0);
                assert!(dearer < 1e-7, "{seed}: dearer by {dearer:e}");
                assert!(problem.violation(&ours) < 1e-9, "{seed}");
            }
            (Err(ours), Err(theirs)) => {
                counts[kind][1] += 1;
                assert!(
                    ours.is_infeasible() && theirs.is_infeasible(),
                    "{seed}: {ours}, {theirs}"
                );
            }
            (ours, theirs) => panic!("{seed}: {:?}, {:?}", ours.map(|s| s.cost), theirs.map(|s| s.cost)),
        }
    }
    // Enough of each, or the test says little.
    for [solved, infeasible] in counts {
        assert!(solved > 200 && infeasible > 5, "{counts:?}");
    }
}

/// Limits that coincide leave no interior.
#[test]
fn a_knot_may_be_prescribed() {
    for seed in (0..60).filter(|seed| seed % 3 == 0) {
        let mut problem = random::any(seed);
        let Ok(free) = cold(&problem) else { continue };
        let knot = problem.knots() / 2;
        let value = free.x[knot] + 0.01 * (problem.x[knot].1 - free.x[knot]);
        problem.x[knot] = (value, value);
        let (Ok(ours), Ok(theirs)) = (cold(&problem), by_clarabel(&problem)) else {
            panic!("{seed}: a hundredth of the room to the left");
        };
        assert!((ours.x[knot] - value).abs() < 1e-9, "{seed}");
        assert!(differences(&ours, &theirs)[0] < 1e-5, "{seed}");
    }
}
