//! The reference values of the specification, by both solvers.

use super::{by_clarabel, cold};
use crate::piecewise_jerk::{
    FallbackSpeedProblem, JerkCoupling, Problem, Solution, SpeedProblem, SpeedWeights, State,
};

fn assert_near(what: &str, problem: &Problem, knot: usize, wanted: &[f64]) {
    for solution in [cold(problem).unwrap(), by_clarabel(problem).unwrap()] {
        let Solution { x, dx, ddx, .. } = &solution;
        for (got, wanted) in [x[knot], dx[knot], ddx[knot]].iter().zip(wanted) {
            assert!(
                (got - wanted).abs() < 1.1e-4,
                "{what} at {knot}: {got}, not {wanted}"
            );
        }
    }
}

/// 7 s at 10 Hz from 10 m/s, cruise at 40 km/h.
fn profile(v_limit: f64, s_limit: f64, s_ref: impl Fn(f64) -> f64) -> SpeedProblem {
    let n = 71;
    SpeedProblem {
        delta_t: 0.1,
        initial: State {
            x: 0.0,
            dx: 10.0,
            ddx: 0.0,
        },
        s: vec![(0.0, s_limit); n],
        v: vec![(0.0, v_limit); n],
        a: (-6.0, 2.0),
        jerk: (-4.0, 2.0),
        weights: SpeedWeights::default(),
        s_ref: (0..n).map(|i| s_ref(0.1 * i as f64)).collect(),
        v_ref: 11.18,
        kappa: vec![0.0; n],
        coupling: JerkCoupling::Symmetric,
    }
}

/// Rolls up to a stop line, known at whole seconds.
fn stop_profile(t: f64) -> f64 {
    let at: [f64; 8] = [0.0, 10.0, 18.0, 23.0, 26.0, 27.0, 27.0, 27.0];
    let pieces = at.windows(2).zip(0..);
    pieces.fold(0.0, |s, (ends, second)| {
        s + (t - f64::from(second)).clamp(0.0, 1.0) * (ends[1] - ends[0])
    })
}

#[test]
fn a_free_road() {
    let mut free = profile(15.0, 100.0, |t| 11.0 * t);
    let problem = free.to_problem();
    assert_near("free", &problem, 10, &[10.2900, 10.7537, 0.9870]);
    assert_near("free", &problem, 40, &[43.9572, 11.1113]);
    assert_near("free", &problem, 70, &[77.1576, 11.1218]);
    free.coupling = JerkCoupling::Diagonal;
    assert_near(
        "free, as the original solves it",
        &free.to_problem(),
        70,
        &[76.0081, 11.1566],
    );
}

#[test]
fn a_stop_ahead() {
    let mut stop = profile(15.0, 30.0, stop_profile);
    let problem = stop.to_problem();
    assert_near("stop", &problem, 10, &[9.3868, 8.3188, -2.6216]);
    assert_near("stop", &problem, 40, &[24.3435, 2.4022]);
    assert_near("stop", &problem, 70, &[30.0, 2.7661]);
    stop.coupling = JerkCoupling::Diagonal;
    assert_near(
        "stop, as the original solves it",
        &stop.to_problem(),
        40,
        &[25.0005, 2.8082],
    );
}

#[test]
fn the_shortest_stops() {
    let table = [
        (
            (2.0, 0.0),
            [[1.4106, 0.5387, -1.4696], [1.5419, 0.0, 0.0], [1.5419, 0.0, 0.0]],
        ),
        (
            (5.0, 0.0),
            [
                [4.3342, 3.0260, -3.4800],
                [5.9535, 0.5460, -1.4800],
                [6.0873, 0.0, 0.0],
            ],
        ),
        (
            (10.0, 0.0),
            [
                [9.3333, 8.0, -4.0],
                [14.9237, 3.2061, -4.2061],
                [16.3601, 0.0, -2.2061],
            ],
        ),
        (
            (10.0, -3.0),
            [
                [7.8900, 5.4383, -4.7191],
                [11.3020, 1.7191, -2.7191],
                [11.9950, 0.0, -0.7191],
            ],
        ),
        (
            (10.0, 1.0),
            [
                [9.8333, 9.0, -3.0],
                [16.6919, 4.2560, -5.2560],
                [18.6532, 0.0, -3.2560],
            ],
        ),
        (
            (15.0, 0.0),
            [[14.3333, 13.0, -4.0], [24.75, 7.5, -6.0], [29.25, 1.5, -6.0]],
        ),
        (
            (20.0, 0.0),
            [[19.3333, 18.0, -4.0], [34.75, 12.5, -6.0], [44.25, 6.5, -6.0]],
        ),
    ];
    for ((v, a), states) in table {
        let problem = FallbackSpeedProblem::shortest_stop(v, a).to_problem();
        for (k, wanted) in states.iter().enumerate() {
            // At standstill the acceleration ripples.
            let compared = if wanted[1] > 0.05 { 3 } else { 2 };
            assert_near(&format!("{v} {a}"), &problem, 10 * (k + 1), &wanted[..compared]);
        }
    }
}
