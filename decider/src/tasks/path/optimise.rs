//! The smoothest offset profile inside a corridor, as a piecewise-jerk problem.
//!
//! Minimises `Σ w (l − l_wanted)² + λ² l'² + λ⁴ (l'' + κ)² + λ⁶ (l''' + κ')²`, κ being the line's curvature where the path
//! rounds its bends and none elsewhere. λ, the length over which the path is smooth, grows with the speed; the original
//! has fixed weights, which were tuned against a jerk term that its solver never saw. Knots are a metre apart, as the
//! points of paths are. The curvature stays within what the steering can hold, its change within how fast that turns.

use super::corridor::Corridor;
use super::profile::Profile;
use super::table::{LineTable, STEP};
use crate::decision::Rejection;
use crate::piecewise_jerk::{Cost, Limits, Problem, SolveError, Solver, State, Term};
use crate::tasks::scene::Scene;

/// Largest `l'` (the original's `lateral_derivative_bound_default`).
const LARGEST_SLOPE: f64 = 2.0;

/// Share of the steering's rate that a path may use (the original's, before its version 9).
const STEERING_SHARE: f64 = 0.5;

/// However slow the car, its path changes no faster than at this speed, m/s (the original's 1.0).
const SLOWEST: f64 = 1.0;

/// Room that is left around the only way that the car can go, m: limits that just touch leave no inside.
const ROOM: f64 = 1e-3;

/// The smoothest profile of a corridor.
///
/// # Errors
/// [`Rejection::Infeasible`] where there is none.
pub(super) fn solve(
    scene: &Scene,
    table: &LineTable,
    corridor: &Corridor,
    solver: &mut impl Solver,
) -> Result<Profile, Rejection> {
    let mut problem = problem(scene, table, corridor);
    admit_the_only_way(&mut problem);
    problem.admit_initial_state();
    let solution = solver.solve(&problem).map_err(|error| match error {
        SolveError::Infeasible => Rejection::Infeasible,
        _ => Rejection::NotSolved,
    })?;
    let dddx = |k: usize| solution.dddx.get(k).copied().unwrap_or(0.0);
    let l = (0..corridor.len()).map(|k| [solution.x[k], solution.dx[k], solution.ddx[k], dddx(k)]);
    Ok(Profile { l: l.collect() })
}

fn problem(scene: &Scene, table: &LineTable, corridor: &Corridor) -> Problem {
    let n = corridor.len();
    let [x, dx, ddx] = corridor.start;
    let square = corridor.smoothing_length * corridor.smoothing_length;
    let largest = scene.vehicle.max_kappa() * scene.config.path.curvature_share;
    let bend = |k: usize| {
        let (kappa, excess) = (table.rows[k].kappa, super::assess::start_excess(k as f64 * STEP));
        (-largest - excess - kappa, largest + excess - kappa)
    };
    Problem {
        delta: STEP,
        initial: State { x, dx, ddx },
        x: corridor.limits.clone(),
        dx: vec![(-LARGEST_SLOPE, LARGEST_SLOPE); n],
        ddx: (0..n).map(bend).collect(),
        dddx: (0..n - 1).map(|k| twist(scene, k)).collect(),
        cost: Cost {
            x: corridor
                .pulls
                .iter()
                .map(|pull| Term::new(pull.weight, pull.l))
                .collect(),
            dx: vec![Term::new(square, 0.0); n],
            ddx: bending_terms(&corridor.bends, square),
            dddx: square * square * square,
            coupling: scene.config.quirks.jerk_coupling(),
            end: [Term::default(); 3],
            constant: 0.0,
        },
    }
}

/// How fast the curvature may change after `k` metres: as fast as the steering turns at the speed to which the car can
/// have slowed down in comfort by then.
fn twist(scene: &Scene, k: usize) -> Limits {
    let vehicle = scene.vehicle;
    let rate = vehicle.max_steer_angle_rate / vehicle.steer_ratio * STEERING_SHARE / vehicle.wheel_base;
    let v = scene.start.v;
    let slowed = v * v - 2.0 * scene.config.speed.braking * k as f64 * STEP;
    let limit = rate / slowed.max(SLOWEST * SLOWEST).sqrt();
    (-limit, limit)
}

/// The terms of `λ⁴ (l'' + κ)² + λ⁶ (l''' + κ')²` that are not those of `l'''²`: the product of `l'''` and `κ'` is linear
/// in `l''`, which moves the reference of its square.
fn bending_terms(bends: &[f64], square: f64) -> Vec<Term> {
    let n = bends.len();
    let slope = |k: usize| (bends[k + 1] - bends[k]) / STEP;
    let term = |k: usize| {
        let before = if k > 0 { slope(k - 1) } else { 0.0 };
        let after = if k + 1 < n { slope(k) } else { 0.0 };
        Term::new(square * square, -bends[k] - square * (before - after) / STEP)
    };
    (0..n).map(term).collect()
}

/// A car that has strayed over its bound, or is about to, must be allowed back: the limits give way to what turning
/// back as hard as the steering can leads to.
fn admit_the_only_way(problem: &mut Problem) {
    let left = hardest_turn(problem, |limits| limits.1);
    let right = hardest_turn(problem, |limits| limits.0);
    for (k, (low, high)) in problem.x.iter_mut().enumerate() {
        *low = low.min(left[k] - ROOM);
        *high = high.max(right[k] + ROOM);
    }
}

/// Offsets of a car that turns to one side as hard as it may.
fn hardest_turn(problem: &Problem, side: impl Fn(Limits) -> f64) -> Vec<f64> {
    let State {
        mut x,
        mut dx,
        mut ddx,
    } = problem.initial;
    let mut offsets = vec![x];
    for k in 0..problem.x.len() - 1 {
        let limits = problem.ddx[k + 1];
        let wanted = (ddx + side(problem.dddx[k]) * STEP).clamp(limits.0.min(ddx), limits.1.max(ddx));
        let jerk = (wanted - ddx) / STEP;
        x += STEP * (dx + STEP * (ddx / 2.0 + STEP * jerk / 6.0));
        dx = (dx + STEP * (ddx + STEP * jerk / 2.0)).clamp(-LARGEST_SLOPE, LARGEST_SLOPE);
        ddx = wanted;
        offsets.push(x);
    }
    offsets
}
