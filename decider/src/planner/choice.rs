//! Which bound is driven: the field's order, by what is drivable and not just by label.
//!
//! Pull-over, lane change, the own lane if nothing blocks it, a borrowed lane if that leads farther and traffic
//! leaves time for it, the own lane up to its blocker, and last the fallback.

use super::lane_follow::rejected;
use super::passing;
use crate::context::Context;
use crate::decision::{Assessment, Rejection};
use crate::reference_line::LineQuery;
use crate::tasks::lane_borrow;
use crate::tasks::path::{self, Goal, LineTable, Path};
use crate::tasks::path_bounds::{Borrow, Label, PathBound, PathBounds};
use crate::tasks::scene::Scene;

/// A borrowed lane must lead this much farther than the own one, m.
const WORTH_BORROWING: f64 = 5.0;

/// Overhang from which a car counts as out of its lane, m.
const OUT_OF_LANE: f64 = 0.2;

/// The choice of one tick.
#[derive(Debug)]
pub(super) struct Choice {
    /// Place of the bound that is driven, and its path.
    pub path: Option<(usize, Path)>,
    /// Per bound what became of it.
    pub assessments: Vec<Assessment>,
    /// Whether the own lane alone would not do, if that was looked at.
    pub own_lane_is_blocked: Option<bool>,
    /// Whether traffic leaves time to go out of the lane, if that was asked.
    pub is_free_to_borrow: Option<bool>,
    /// Whether a borrowed lane leads past what blocks the own one, be it free or not, if that was looked at.
    pub borrow_leads_on: Option<bool>,
}

/// Looks at the bounds in order of preference until one is good.
pub(super) fn choose(scene: &Scene, table: &LineTable, bounds: &PathBounds, context: &Context) -> Choice {
    let mut choice = Choice {
        path: None,
        assessments: vec![Assessment::NotTried; bounds.bounds.len()],
        own_lane_is_blocked: None,
        is_free_to_borrow: None,
        borrow_leads_on: None,
    };
    let mut blocked_own: Option<(usize, Path)> = None;
    let is_out = passing::overhang(scene) > OUT_OF_LANE && !context.borrow.sides.is_empty();
    for place in in_order(&bounds.bounds, is_out) {
        let bound = &bounds.bounds[place];
        let path = match find_path(scene, table, bound, context) {
            Ok(path) => path,
            Err(rejection) => {
                if is_own_lane(bound.label) {
                    choice.own_lane_is_blocked = Some(true);
                } else if is_borrowed(bound.label) {
                    choice.borrow_leads_on.get_or_insert(false);
                }
                choice.assessments[place] = rejected(rejection);
                continue;
            }
        };
        choice.assessments[place] = Assessment::Drivable { reach: path.length() };
        if is_own_lane(bound.label) {
            choice.own_lane_is_blocked = Some(path.blocked_by.is_some());
        }
        if bound.label == Label::Fallback && blocked_own.is_some() {
            break;
        }
        if is_borrowed(bound.label) {
            let leads_on = leads_on(scene, &path, blocked_own.as_ref());
            choice.borrow_leads_on = Some(leads_on || choice.borrow_leads_on == Some(true));
        }
        match verdict(scene, context, bound, &path, blocked_own.as_ref()) {
            Verdict::Take => {
                choice.path = Some((place, path));
                break;
            }
            Verdict::Keep => {
                blocked_own = Some((place, path));
            }
            Verdict::Leave(assessment) => {
                let is_occupied = matches!(assessment, Assessment::Occupied(_));
                choice.is_free_to_borrow = Some(choice.is_free_to_borrow.unwrap_or(false) || !is_occupied);
                choice.assessments[place] = assessment;
            }
        }
    }
    choice.path = choice.path.or(blocked_own);
    if let Some((place, _)) = &choice.path {
        choice.assessments[*place] = Assessment::Chosen;
    }
    choice
}

/// A path inside a bound: a new one, or the last one where the new one does not lead on.
fn find_path(
    scene: &Scene,
    table: &LineTable,
    bound: &PathBound,
    context: &Context,
) -> Result<Path, Rejection> {
    let goal = goal(scene, context, bound.label);
    let last = context.path.as_ref().filter(|last| last.label == bound.label);
    let on = last.filter(|last| path::is_on(scene, &last.points));
    let new = path::plan(scene, table, bound, goal, on.map(|last| &last.points[..]));
    if new.as_ref().is_ok_and(|path| path.serves(goal)) {
        return new;
    }
    let old = last.and_then(|last| path::reuse(scene, &last.points));
    match old
        .map(|path| path::finish(path, bound))
        .filter(|path| path.serves(goal))
    {
        Some(old) => Ok(old),
        None => new,
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

fn verdict(
    scene: &Scene,
    context: &Context,
    bound: &PathBound,
    path: &Path,
    blocked_own: Option<&(usize, Path)>,
) -> Verdict {
    match bound.label {
        Label::PullOver => match path.blocked_by {
            Some(id) if !path.serves(goal(scene, context, bound.label)) => {
                Verdict::Leave(Assessment::NoPath(Rejection::Touches(id)))
            }
            _ => Verdict::Take,
        },
        Label::Regular {
            borrow: Borrow::None, ..
        } if path.blocked_by.is_some() => Verdict::Keep,
        Label::Regular {
            borrow: Borrow::Left | Borrow::Right,
            ..
        } => {
            if !leads_on(scene, path, blocked_own) && passing::overhang(scene) <= passing::COMMITTED {
                return Verdict::Leave(Assessment::Drivable { reach: path.length() });
            }
            match passing::occupant(scene, path) {
                Some(id) => Verdict::Leave(Assessment::Occupied(id)),
                None if is_sure(scene, context) => Verdict::Take,
                None => Verdict::Leave(Assessment::Drivable { reach: path.length() }),
            }
        }
        _ => Verdict::Take,
    }
}

/// Whether a path through a borrowed lane is worth going out for.
fn leads_on(scene: &Scene, path: &Path, blocked_own: Option<&(usize, Path)>) -> bool {
    let own_reach = blocked_own.map_or(0.0, |(_, own)| own.length());
    path.length() >= own_reach + WORTH_BORROWING && passing::leads_back(scene, path)
}

/// Whether a gap in the traffic has been there for long enough, or there is no traffic, or the car is on its way.
fn is_sure(scene: &Scene, context: &Context) -> bool {
    let on_the_way = context.path.as_ref().is_some_and(|last| is_borrowed(last.label));
    on_the_way || scene.moving.is_empty() || context.borrow.free_cycles >= lane_borrow::FREE_CYCLES
}

/// Places of the bounds by preference. A car that is out of its lane comes back inside the borrowed bound,
/// which holds both lanes.
fn in_order(bounds: &[PathBound], is_out: bool) -> Vec<usize> {
    let rank = |label: Label| match label {
        Label::PullOver => 0,
        Label::LaneChange => 1,
        Label::Regular {
            borrow: Borrow::None, ..
        } if is_out => 4,
        Label::Regular {
            borrow: Borrow::None, ..
        } => 2,
        Label::Regular { .. } => 3,
        Label::Fallback => 5,
    };
    let mut places: Vec<usize> = (0..bounds.len()).collect();
    places.sort_by_key(|place| rank(bounds[*place].label));
    places
}

fn is_borrowed(label: Label) -> bool {
    matches!(
        label,
        Label::Regular {
            borrow: Borrow::Left | Borrow::Right,
            ..
        }
    )
}

fn is_own_lane(label: Label) -> bool {
    matches!(
        label,
        Label::Regular {
            borrow: Borrow::None,
            ..
        }
    )
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
