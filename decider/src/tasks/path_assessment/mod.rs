//! `PATH_ASSESSMENT_DECIDER`: which bound is driven, by what its path leads to and not just by its label.
//!
//! The first in the order of preference that is good: the own lane if nothing blocks it, a borrowed lane if that leads
//! farther and traffic leaves time for it, the own lane up to its blocker, and last the fallback.

mod order;
mod passing;

pub use order::{in_order, is_borrowed, is_own_lane};

use crate::context::Context;
use crate::decision::{Assessment, Rejection};
use crate::planner::{LinePlan, TaskError};
use crate::tasks::lane_borrow::{self, OwnLane};
use crate::tasks::path::Path;
use crate::tasks::path_bounds::{Label, PathBound};
use crate::tasks::scene::Scene;

/// A borrowed lane must lead this much farther than the own one, m.
const WORTH_BORROWING: f64 = 5.0;

/// What the looks at one candidate after the other have shown.
#[derive(Debug, Default)]
struct Findings {
    /// Place of the one to drive.
    taken: Option<usize>,
    /// Place of the own lane's path, if something blocks it.
    blocked_own: Option<usize>,
    /// What the own lane alone is good for, if that was looked at.
    own_lane: Option<OwnLane>,
    /// Whether traffic leaves time to go out of the lane, if that was asked.
    is_free_to_borrow: Option<bool>,
}

/// Chooses among the candidates of a plan.
///
/// # Errors
/// [`TaskError::NoPath`] when none can be driven.
pub fn run(plan: &mut LinePlan, context: &mut Context) -> Result<(), TaskError> {
    plan.assessments = vec![Assessment::NotTried; plan.bounds.bounds.len()];
    let mut findings = Findings::default();
    for place in in_order(&plan.scene, &plan.bounds.bounds, context) {
        look_at(plan, context, place, &mut findings);
        if findings.taken.is_some() {
            break;
        }
    }
    lane_borrow::observe(&mut context.borrow, findings.own_lane);
    lane_borrow::observe_traffic(&mut context.borrow, findings.is_free_to_borrow);
    let place = findings.taken.or(findings.blocked_own).ok_or(TaskError::NoPath)?;
    let Some(Some(Ok(path))) = plan.candidates.get(place) else {
        return Err(TaskError::NoPath);
    };
    plan.chosen = Some((place, path.clone()));
    plan.assessments[place] = Assessment::Chosen;
    Ok(())
}

/// Assesses one candidate.
fn look_at(plan: &mut LinePlan, context: &Context, place: usize, findings: &mut Findings) {
    let bound = &plan.bounds.bounds[place];
    let path = match &plan.candidates[place] {
        None => return,
        Some(Ok(path)) => path,
        Some(Err(rejection)) => {
            if is_own_lane(bound.label) {
                findings.own_lane = Some(OwnLane::Blocked(rejection.obstacle()));
            } else if is_borrowed(bound.label) {
                plan.borrow_leads_on.get_or_insert(false);
            }
            plan.assessments[place] = Assessment::NoPath(*rejection);
            return;
        }
    };
    plan.assessments[place] = Assessment::Drivable { reach: path.length() };
    if is_own_lane(bound.label) {
        findings.own_lane = Some(match path.blocked_by {
            Some(blocker) => OwnLane::Blocked(Some(blocker)),
            None => OwnLane::Usable,
        });
    }
    if bound.label == Label::Fallback && findings.blocked_own.is_some() {
        return;
    }
    let own = findings
        .blocked_own
        .and_then(|own| plan.candidates[own].as_ref()?.as_ref().ok());
    if is_borrowed(bound.label) {
        let leads_on = leads_on(&plan.scene, path, own);
        plan.borrow_leads_on = Some(leads_on || plan.borrow_leads_on == Some(true));
    }
    match verdict(&plan.scene, context, bound, path, own) {
        Verdict::Take => findings.taken = Some(place),
        Verdict::Keep => findings.blocked_own = Some(place),
        Verdict::Leave(assessment) => {
            let is_occupied = matches!(assessment, Assessment::Occupied(_));
            findings.is_free_to_borrow = Some(findings.is_free_to_borrow.unwrap_or(false) || !is_occupied);
            plan.assessments[place] = assessment;
        }
    }
}

/// What to do with a drivable path.
enum Verdict {
    /// Drive it.
    Take,
    /// Drive it if nothing better comes.
    Keep,
    /// Do not drive it.
    Leave(Assessment),
}

fn verdict(scene: &Scene, context: &Context, bound: &PathBound, path: &Path, own: Option<&Path>) -> Verdict {
    let label = bound.label;
    if label == Label::PullOver {
        return match path.blocked_by {
            Some(id) if !path.leads_to_goal => Verdict::Leave(Assessment::NoPath(Rejection::Touches(id))),
            _ => Verdict::Take,
        };
    }
    if is_own_lane(label) && path.blocked_by.is_some() {
        return Verdict::Keep;
    }
    if !is_borrowed(label) {
        return Verdict::Take;
    }
    let drivable = Assessment::Drivable { reach: path.length() };
    if !leads_on(scene, path, own) && passing::overhang(scene) <= passing::COMMITTED {
        return Verdict::Leave(drivable);
    }
    match passing::occupant(scene, path) {
        Some(id) => Verdict::Leave(Assessment::Occupied(id)),
        None if is_sure(scene, context) => Verdict::Take,
        None => Verdict::Leave(drivable),
    }
}

/// Whether a path through a borrowed lane is worth going out for.
fn leads_on(scene: &Scene, path: &Path, own: Option<&Path>) -> bool {
    let own_reach = own.map_or(0.0, Path::length);
    path.length() >= own_reach + WORTH_BORROWING && passing::leads_back(scene, path)
}

/// Whether a gap in the traffic has been there for long enough, or there is no traffic, or the car is on its way.
fn is_sure(scene: &Scene, context: &Context) -> bool {
    let on_the_way = context.path.as_ref().is_some_and(|last| is_borrowed(last.label));
    on_the_way || scene.moving.is_empty() || context.borrow.free_cycles >= lane_borrow::FREE_CYCLES
}
