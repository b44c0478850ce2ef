//! Hand-made situations, one group of metrics a file.

mod answers;
mod collisions;
mod decisions;
mod driving;
mod endings;
mod fixture;
