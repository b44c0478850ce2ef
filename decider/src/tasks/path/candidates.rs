//! `PIECEWISE_JERK_PATH_OPTIMIZER`: a path in each bound that may be driven, in the order of preference.

use super::{Goal, LineTable, Method, Path, best, finish, reuse};
use crate::context::{Context, LastPath};
use crate::decision::Rejection;
use crate::planner::{LinePlan, TaskError};
use crate::reference_line::LineQuery;
use crate::tasks::path_assessment::{in_order, is_borrowed, is_own_lane};
use crate::tasks::path_bounds::{Label, PathBound};
use crate::tasks::scene::Scene;

/// Looks for a path in one bound after the other, up to the first whose path will be driven whatever else there is.
///
/// # Errors
/// None: that there is no path at all is for the assessment to say.
pub fn run(plan: &mut LinePlan, context: &mut Context) -> Result<(), TaskError> {
    find_all(plan, context, |context, label| {
        Method::Optimised(context.path_solver(label))
    });
    Ok(())
}

/// The same with sampled paths.
///
/// # Errors
/// None, as above.
pub fn run_sampled(plan: &mut LinePlan, context: &mut Context) -> Result<(), TaskError> {
    find_all(plan, context, |_, _| Method::Sampled);
    Ok(())
}

fn find_all(
    plan: &mut LinePlan,
    context: &mut Context,
    method: impl for<'a> Fn(&'a mut Context, Label) -> Method<'a>,
) {
    let scene = &plan.scene;
    let bounds = &plan.bounds.bounds;
    let end_s = bounds.iter().map(PathBound::end_s).fold(scene.ego.s, f64::max);
    let table = LineTable::new(scene.line, scene.ego.s, end_s);
    plan.candidates = vec![None; bounds.len()];
    for place in in_order(scene, bounds, context) {
        let bound = &bounds[place];
        let has_own = || plan.candidates.iter().zip(bounds).any(is_good_enough);
        if bound.label == Label::Fallback && has_own() {
            break;
        }
        let last = plan.last_path.as_ref().filter(|last| last.label == bound.label);
        let goal = goal(scene, context, bound.label);
        let candidate = find(scene, &table, bound, goal, last, method(context, bound.label));
        let settles = candidate.as_ref().is_ok_and(|path| settles(bound.label, path));
        plan.candidates[place] = Some(candidate);
        if settles {
            break;
        }
    }
}

/// Whether a candidate will be driven before the fallback.
fn is_good_enough((candidate, bound): (&Option<Result<Path, Rejection>>, &PathBound)) -> bool {
    is_own_lane(bound.label) && matches!(candidate, Some(Ok(_)))
}

/// Whether the others need not be looked at. Traffic may yet forbid a borrowed lane.
fn settles(label: Label, path: &Path) -> bool {
    match label {
        Label::PullOver => path.leads_to_goal,
        label if is_borrowed(label) => false,
        label if is_own_lane(label) => path.blocked_by.is_none(),
        _ => true,
    }
}

/// A path inside a bound: a new one, or the last one where the new one does not lead on.
fn find(
    scene: &Scene,
    table: &LineTable,
    bound: &PathBound,
    goal: Goal,
    last: Option<&LastPath>,
    method: Method,
) -> Result<Path, Rejection> {
    let on = last.filter(|last| super::is_on(scene, &last.points));
    let new = best(scene, table, bound, goal, on.map(|last| &last.points[..]), method);
    if new.as_ref().is_ok_and(|path| path.serves(goal)) {
        return new.map(|path| path.leading_to(goal));
    }
    let old = last
        .and_then(|last| reuse(scene, &last.points))
        .map(|path| finish(path, bound))
        .filter(|path| path.serves(goal));
    old.map_or(new, Ok).map(|path| path.leading_to(goal))
}

/// Along the line, or to the place at the road's edge.
fn goal(scene: &Scene, context: &Context, label: Label) -> Goal {
    let place = context
        .bounds
        .pull_over
        .place
        .filter(|_| label == Label::PullOver);
    place.map_or(Goal::default(), |place| {
        let at = scene.line.to_frenet(place.position);
        Goal {
            l: at.l,
            stop_s: Some(at.s),
        }
    })
}
