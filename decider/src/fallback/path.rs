//! The chain of paths for a tick whose own path failed: each source with its gate, best first.
//!
//! The order is the one that users of the original proposed: the path of the tick before, which a tenth of a second
//! later is as good as new; this tick's path in the own lane; beside the reference line; on as the wheels are set. A
//! source passes its gate if the car can stop on what it gives.

use super::held_arc;
use crate::context::LastPath;
use crate::decision::{PathPoint, PathRung};
use crate::geometry::{Quintic, angle};
use crate::planner::{LinePlan, Part};
use crate::reference_line::LineQuery;
use crate::tasks::path::{self, LineTable, Path, Profile};
use crate::tasks::path_bounds::{Borrow, Label};
use crate::tasks::scene::Scene;

/// Length that is left beyond the place where the hardest braking stops, m.
const MARGIN: f64 = 5.0;

/// An older path is not driven, s.
const MAX_AGE: f64 = 0.5;

/// A car farther than this from the line is not driving along it, m (the original's bound on fallback paths).
const LARGEST_OFFSET: f64 = 20.0;

/// Heading error above which a car is first turned along the line, rad.
const ALIGNED: f64 = 0.05;

/// Time and least distance in which it is turned, s and m.
const TURN_IN: (f64, f64) = (2.0, 10.0);

/// A parallel curve nearer to the line's centre of curvature than this share of its radius is none.
const LEAST_STRETCH: f64 = 0.1;

/// Distance between the points of the held arc, m.
const STEP: f64 = 1.0;

/// The first source that passes its gate, `None` if none does.
pub(super) fn find(
    plan: &LinePlan,
    last: Option<&LastPath>,
    fails: &dyn Fn(Part) -> bool,
) -> Option<(PathRung, Path)> {
    let scene = &plan.scene;
    let passes = |path: &Path| path.length() >= least_length(scene);
    let recent = last.filter(|last| scene.frame.time - last.time <= MAX_AGE);
    let last = || recent.and_then(|last| path::reuse(scene, &last.points));
    let own = || self_lane(plan);
    let sources: [(PathRung, &dyn Fn() -> Option<Path>); 4] = [
        (PathRung::LastPath, &last),
        (PathRung::SelfLane, &own),
        (PathRung::OffsetLine, &|| offset_line(scene)),
        (PathRung::HeldArc, &|| arc(scene)),
    ];
    let forgets = scene.config.quirks.fallback_forgets_last_path && plan.path().is_none();
    let is_forgotten = |rung| forgets && matches!(rung, PathRung::LastPath | PathRung::SelfLane);
    sources
        .into_iter()
        .filter(|(rung, _)| !fails(Part::Path(*rung)) && !is_forgotten(*rung))
        .find_map(|(rung, source)| Some((rung, source().filter(passes)?)))
}

/// What a path needs to be stopped on, m.
fn least_length(scene: &Scene) -> f64 {
    let v = scene.start.v;
    v * v / (2.0 * -scene.vehicle.max_deceleration) + MARGIN
}

/// This tick's candidate in the own lane.
fn self_lane(plan: &LinePlan) -> Option<Path> {
    let is_own = |label| {
        matches!(
            label,
            Label::Regular {
                borrow: Borrow::None,
                ..
            }
        )
    };
    let place = plan.bounds.bounds.iter().position(|bound| is_own(bound.label))?;
    plan.candidates.get(place)?.as_ref()?.as_ref().ok().cloned()
}

/// At the car's own distance from the line all along it: a parallel curve, not a copy shifted aside.
fn offset_line(scene: &Scene) -> Option<Path> {
    let along = scene.line.start() - LARGEST_OFFSET..=scene.line.length();
    let is_on_line = along.contains(&scene.ego.s) && scene.ego.l.abs() <= LARGEST_OFFSET;
    if !is_on_line {
        return None;
    }
    let reach = least_length(scene) + scene.start.v * TURN_IN.0 + TURN_IN.1;
    let table = LineTable::new(scene.line, scene.ego.s, scene.ego.s + reach);
    let start = scene.lateral.l;
    let turn = angle::difference(scene.start.pose.theta, scene.line.point(scene.ego.s).theta);
    let blend = (turn.abs() > ALIGNED).then(|| {
        let length = (scene.start.v * TURN_IN.0).max(TURN_IN.1);
        Quintic::between(start, [start[0], 0.0, 0.0], length)
    });
    let offset = |k: usize| {
        let parallel = [start[0], 0.0, 0.0, 0.0];
        blend.map_or(parallel, |curve| curve.evaluate(k as f64 * path::STEP))
    };
    let profile = Profile {
        l: (0..table.len()).map(offset).collect(),
    };
    if table.least_stretch(&profile) <= LEAST_STRETCH {
        return None;
    }
    let mut points = path::to_points(&table, &profile);
    go_on_straight(&mut points, reach);
    (points.len() >= 2).then(|| path::until_contact(scene, points).ok())?
}

/// Adds what is missing to a length along the last heading.
pub(super) fn go_on_straight(points: &mut Vec<PathPoint>, length: f64) {
    while let Some(last) = points.last().copied().filter(|last| last.distance < length) {
        points.push(PathPoint {
            distance: last.distance + STEP,
            s: last.s + STEP,
            pose: last.pose.advanced(STEP),
            kappa: 0.0,
            ..last
        });
    }
}

/// On as the wheels are set.
fn arc(scene: &Scene) -> Option<Path> {
    let mut points = Vec::new();
    let mut distance = 0.0;
    while distance < least_length(scene) + STEP {
        let pose = held_arc::pose(&scene.start, distance);
        let at = scene.line.to_frenet_near(pose.position(), scene.ego.s + distance);
        points.push(PathPoint {
            distance,
            s: scene.ego.s + distance,
            l: at.l,
            pose,
            kappa: scene.start.kappa,
        });
        distance += STEP;
    }
    path::until_contact(scene, points).ok()
}
