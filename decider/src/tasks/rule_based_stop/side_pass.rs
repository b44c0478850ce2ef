//! A stop and a look before the car goes out into the lane of oncoming traffic (`StopOnSidePass`).
//!
//! Only where something hides that lane; then until the car has stood where its path leaves the own lane. Whether
//! traffic leaves time is asked with the path, so a path into that lane is there only when it does.

use crate::context::Context;
use crate::decision::{PathPoint, Stop, StopCause};
use crate::frame::Obstacle;
use crate::planner::LinePlan;
use crate::reference_line::LineQuery;
use crate::tasks::lane_change::perception;
use crate::tasks::path::Path;
use crate::tasks::path_bounds::{Label, LaneType};
use crate::tasks::scene::Scene;

/// Who would have to brake harder than this does not stop any more, m/s²: half out of the lane is no place to stand.
const BRAKING: f64 = 3.0;

/// The car stops this far inside its lane, m: traffic is not to stop for it.
const INSIDE: f64 = 0.3;

/// Where to stop and look; that it has looked is remembered until the car is done with the other lane.
pub(super) fn stop(plan: &LinePlan, path: &Path, context: &mut Context) -> Option<Stop> {
    let is_stopping = context.stop.is_some_and(|stop| stop.cause == StopCause::SidePass);
    let has_looked = &mut context.has_looked;
    let scene = &plan.scene;
    let config = &scene.config.rule_based_stop;
    let is_oncoming = matches!(
        plan.label(),
        Some(Label::Regular {
            lane: LaneType::Reverse,
            ..
        })
    );
    if !config.enable_side_pass_stop || !is_oncoming {
        *has_looked = false;
        return None;
    }
    let distance = path.points.iter().find(|point| leaves(scene, point))?.distance;
    let is_too_late = scene.start.v * scene.start.v / (2.0 * BRAKING) > distance;
    if *has_looked || is_too_late && !is_stopping || !is_hidden(scene) {
        return None;
    }
    *has_looked = scene.start.v <= config.max_adc_stop_speed && distance <= config.max_valid_stop_distance;
    (!*has_looked).then_some(Stop {
        distance,
        cause: StopCause::SidePass,
    })
}

/// Whether the body is about to leave its lane.
fn leaves(scene: &Scene, point: &PathPoint) -> bool {
    let half_width = scene.vehicle.half_width();
    let (left, right) = scene.line.lane_width(point.s).unwrap_or((0.0, 0.0));
    (left - point.l).min(point.l + right) < half_width + INSIDE
}

fn is_hidden(scene: &Scene) -> bool {
    let bodies: Vec<_> = scene.frame.obstacles.iter().map(Obstacle::footprint).collect();
    perception::is_blocked(scene.start.pose, &scene.config.rule_based_stop.fan(), &bodies)
}
