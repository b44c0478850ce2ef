//! Tests of the path bounds, by subject.
#![expect(
    clippy::float_cmp,
    reason = "bounds are exact: what does not move does not change by a bit"
)]

mod causes;
mod examples;
mod gaps_against_all_sides;
mod holes;
mod metamorphic;
mod pull_over;
mod quirks_around_obstacles;
mod quirks_of_the_road;
mod random;
mod rigid_move;
mod setup;
mod wild;
