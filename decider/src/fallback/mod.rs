//! What is driven when a task has failed: speed profiles that end at standstill.

mod braking;
mod speed_profile;
#[cfg(test)]
mod tests;

pub use braking::{BrakingLimits, braking_profile, ladder};
pub use speed_profile::{FALLBACK_STEP, FALLBACK_TIME, constant_deceleration, extract, standstill};
