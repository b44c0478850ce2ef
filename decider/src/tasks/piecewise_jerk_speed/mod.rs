//! `PIECEWISE_JERK_SPEED_OPTIMIZER`: the smoothest speed profile near a guide, before what is stayed behind and after what
//! is passed before.
//!
//! Against the original: the guide is a profile that a driver could drive, not the nodes of the search; its speed is the
//! reference, not the cruise speed, which would pull the car into its stops; limits give way to what the car can still
//! do, so that a start above a limit makes nothing infeasible; the jerk enters the cost as it should.

mod bounds;
mod config;
mod guide;
mod nonlinear;
mod rules;

pub use config::SpeedConfig;
pub(crate) use rules::stop_before;

use crate::context::Context;
use crate::piecewise_jerk::{Problem, Riccati, Solution, SolveError, Solver, SpeedProblem, State, Term};
use crate::planner::{LinePlan, TaskError};
use crate::st_graph::{SpeedData, SpeedPoint};
use guide::STEP;

/// Slower than this at a knot the car stands, m/s.
const NOTHING: f64 = 2.0 * bounds::STANDING;

/// Finds the speed along the chosen path.
///
/// # Errors
/// [`TaskError::Unavoidable`] where even the guide meets an obstacle, [`TaskError::Infeasible`] or
/// [`TaskError::NotSolved`] where no profile is found.
pub fn run(plan: &mut LinePlan, context: &mut Context) -> Result<(), TaskError> {
    find(plan, context, |_, problem, solver| solve(problem, solver))
}

/// Finds it with the bends where the car will be and not where its guide is (the original's nonlinear optimiser).
///
/// # Errors
/// As [`run`].
pub fn run_nonlinear(plan: &mut LinePlan, context: &mut Context) -> Result<(), TaskError> {
    find(plan, context, nonlinear::solve)
}

fn find(
    plan: &mut LinePlan,
    context: &mut Context,
    solve: impl Fn(&LinePlan, &Problem, &mut Riccati) -> Result<Solution, TaskError>,
) -> Result<(), TaskError> {
    let wall = plan.wall.ok_or(TaskError::NoPath)?;
    let guide = guide::integrate(plan, wall)?;
    let speed = problem(plan, &guide.profile, wall.distance)?;
    let mut problem = speed.to_problem();
    for (k, point) in guide.profile.points.iter().enumerate() {
        problem.cost.dx[k].reference = point.v;
        problem.cost.ddx[k] = Term::new(speed.weights.acc, point.a);
    }
    problem.admit_initial_state();
    let solution = solve(plan, &problem, &mut context.speed_solver)?;
    plan.speed = Some(profile(&solution));
    plan.stop = guide.stop;
    Ok(())
}

fn solve(problem: &Problem, solver: &mut Riccati) -> Result<Solution, TaskError> {
    solver.solve(problem).map_err(|error| match error {
        SolveError::Infeasible => TaskError::Infeasible,
        _ => TaskError::NotSolved,
    })
}

/// The profile of a solution. Speeds are held above nothing only at the knots, so one that stands rolls back and forth
/// between them by less than a millimetre; a car does not.
fn profile(solution: &Solution) -> SpeedData {
    let mut farthest = 0.0_f64;
    let point = |k: usize| {
        farthest = farthest.max(solution.x[k]);
        let moves = solution.dx[k] > NOTHING;
        SpeedPoint {
            t: k as f64 * STEP,
            s: farthest,
            v: if moves { solution.dx[k] } else { 0.0 },
            a: solution.ddx[k],
            da: solution.dddx.get(k).copied().unwrap_or(0.0),
        }
    };
    SpeedData::new((0..solution.x.len()).map(point).collect())
}

fn problem(plan: &LinePlan, guide: &SpeedData, wall: f64) -> Result<SpeedProblem, TaskError> {
    let scene = &plan.scene;
    let config = &scene.config.speed;
    let vehicle = scene.vehicle;
    let limits = bounds::Reach {
        v: scene.start.v,
        a: scene.start.a,
        braking: vehicle.max_deceleration,
        jerk: config.planned_jerk,
    };
    let least = limits.least_profile(guide.points.len());
    let path = plan.path().ok_or(TaskError::NoPath)?;
    let kappa = |s: f64| crate::trajectory::at(&path.points, s).1;
    Ok(SpeedProblem {
        delta_t: STEP,
        initial: State {
            x: 0.0,
            dx: scene.start.v,
            ddx: scene.start.a,
        },
        s: bounds::stations(plan, guide, &least, wall)?,
        v: bounds::speeds(plan, guide, &least),
        a: (vehicle.max_deceleration, vehicle.max_acceleration),
        jerk: (-config.planned_jerk, config.planned_jerk),
        weights: config.weights,
        s_ref: guide.points.iter().map(|point| point.s).collect(),
        v_ref: 0.0,
        kappa: guide.points.iter().map(|point| kappa(point.s)).collect(),
        coupling: scene.config.quirks.jerk_coupling(),
    })
}
