//! Hand-made situations, one group of metrics a file.

mod answers;
mod collisions;
mod criticality;
mod decisions;
mod driving;
mod endings;
mod fixture;
mod plans;
