//! `PATH_REUSE_DECIDER`: whether the way of the tick before may still be driven.
//!
//! The original drives it on as it is, for as long as it is clear, and plans no other; here it is offered to the search
//! for a path, which keeps it while nothing is clearly better.

use crate::context::Context;
use crate::planner::{LinePlan, TaskError};

/// An older path is forgotten, s: the same few ticks for which an old trajectory serves.
const MAX_AGE: f64 = 0.5;

/// Offers the last path to this tick.
///
/// # Errors
/// None.
pub fn run(plan: &mut LinePlan, context: &mut Context) -> Result<(), TaskError> {
    let now = plan.scene.frame.time;
    plan.last_path = context.path.clone().filter(|last| now - last.time <= MAX_AGE);
    Ok(())
}
