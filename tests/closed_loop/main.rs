//! The closed loop from outside: runs repeat to the bit, traces hold all that a tick needs, and every fixed
//! scenario of the catalog ends as it should.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod alone;
mod baselines;
mod blame;
mod catalog;
mod deciders;
mod evenness;
mod failing;
mod lattice;
mod mirrored;
mod order;
mod repeat;
mod routed;
mod rungs;
mod shrink;
mod smoothness;
mod stages;
mod support;
