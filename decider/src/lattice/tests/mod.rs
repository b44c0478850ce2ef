//! Worked numbers of the specification, and what must hold of every plan.

mod numbers;
mod plans;
mod scene;
