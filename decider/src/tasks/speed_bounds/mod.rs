//! `SPEED_BOUNDS_PRIORI_DECIDER` and `SPEED_BOUNDS_FINAL_DECIDER`: what moving obstacles will occupy of the path, and how
//! fast the road allows to drive along it. First nothing is decided about them; the second time what is decided is
//! theirs.

mod contact;
mod limits;
mod on_path;
#[cfg(test)]
mod tests;
mod track;

pub use contact::Contact;
pub use limits::Envelope;
pub use on_path::OnPath;
pub use track::Track;

use super::object_decision::Longitudinal;
use crate::context::Context;
use crate::decision::StopCause;
use crate::frame::ObstacleId;
use crate::planner::{LinePlan, TaskError};
use crate::st_graph::{BoundaryType, StBoundary};

/// How much longer a crossing obstacle that was yielded to a tick ago is yielded to, s.
const YIELD_HYSTERESIS: f64 = 0.7;

/// Maps the moving obstacles onto the path.
///
/// # Errors
/// [`TaskError::NoPath`] without a path.
pub fn run_priori(plan: &mut LinePlan, context: &mut Context) -> Result<(), TaskError> {
    let path = plan.path().ok_or(TaskError::NoPath)?;
    let yielded_to = context.stop.and_then(|stop| match stop.cause {
        StopCause::Yield(id) => Some(id),
        _ => None,
    });
    let yield_time = plan.scene.config.speed.yield_time;
    let margin = |id: ObstacleId| {
        let held = yielded_to == Some(id);
        yield_time + if held { YIELD_HYSTERESIS } else { 0.0 }
    };
    let on_path = on_path::on_path(&plan.scene, path, margin);
    let envelope = Envelope::new(&plan.scene, path);
    plan.on_path = on_path;
    plan.envelope = Some(envelope);
    Ok(())
}

/// Gives each boundary the kind that its obstacle's decision calls for; the fence of a yield is its own.
///
/// # Errors
/// None.
pub fn run_final(plan: &mut LinePlan, _: &mut Context) -> Result<(), TaskError> {
    for k in 0..plan.on_path.len() {
        let decision = plan
            .decision(plan.on_path[k].id)
            .and_then(|decision| decision.longitudinal);
        let there = &mut plan.on_path[k];
        there.boundary.kind = kind(decision, &there.boundary);
    }
    Ok(())
}

fn kind(decision: Option<Longitudinal>, boundary: &StBoundary) -> BoundaryType {
    match decision {
        Some(Longitudinal::Stop(_)) => BoundaryType::Stop,
        Some(Longitudinal::Follow(_)) => BoundaryType::Follow,
        Some(Longitudinal::Yield(_)) => BoundaryType::Yield,
        Some(Longitudinal::Overtake(_) | Longitudinal::Ignore) => BoundaryType::Overtake,
        None => boundary.kind,
    }
}
