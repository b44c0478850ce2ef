//! The metrics of what is decided, of how it is kept, and of pulling over.

use super::Definition;
use super::Limit::{AtLeast, AtMost};
use crate::monitor::{blocks, bounds, collision, decider, fallbacks, labels, pull_over, tracking};

const fn metric(
    name: &'static str,
    unit: &'static str,
    formula: &'static str,
    source: &'static str,
) -> Definition {
    Definition::new(name, unit, formula, source)
}

/// The decider's answers, and the driving held against them.
pub(super) const DECISIONS: [Definition; 13] = [
    metric(
        "bound_containment",
        "",
        "share of samples in which the rear axle is inside the driven bound, its padding left out",
        "Corridor",
    )
    .limit(AtLeast(bounds::CONTAINMENT_LIMIT)),
    metric("bound_excess", "m", "farthest that the rear axle was outside it", "Corridor")
        .limit(AtMost(bounds::EXCESS_LIMIT)),
    metric(
        "min_clearance",
        "m",
        "least distance between the ego's footprint and an obstacle's",
        "Apollo's lateral buffer",
    )
    .limit(AtLeast(collision::CLEARANCE_WARNING)),
    metric(
        "min_bound_width",
        "m",
        "narrowest place of a driven bound; 0 is blocked",
        "Corridor",
    ),
    metric(
        "label_flips",
        "1/min",
        "changes of the driven label in a minute, a run counted as a minute at least",
        "Corridor",
    )
    .limit(AtMost(labels::LABEL_LIMIT)),
    metric(
        "bound_jitter",
        "m",
        "95th percentile over ticks of the largest change of a limit between two bounds, while nothing else moves",
        "Corridor",
    )
    .limit(AtMost(bounds::JITTER_LIMIT)),
    metric(
        "fallback_ratio",
        "",
        "share of ticks that were not planned or drive the fallback bound",
        "Corridor",
    )
    .limit(AtMost(fallbacks::FALLBACK_LIMIT)),
    metric("fallback_longest", "s", "longest time of such ticks in a row", "Corridor"),
    metric(
        "false_block",
        "",
        "1 where the decider saw no way and the reference search found one as wide as the car and 0.4 m on either side",
        "Corridor",
    )
    .limit(AtMost(blocks::NEVER)),
    metric(
        "blocker_id_correct",
        "",
        "share of blocks that name an obstacle which closes the way where the reference search finds it closed first",
        "Corridor",
    )
    .limit(AtLeast(1.0)),
    metric(
        "pull_over_retargets",
        "",
        "changes of the place to pull over at after it was first chosen",
        "Corridor",
    )
    .limit(AtMost(decider::RETARGET_LIMIT)),
    metric(
        "tracking_error",
        "m",
        "95th percentile of the distance beside the trajectory",
        "Corridor",
    )
    .limit(AtMost(tracking::P95_LIMIT)),
    metric("tracking_error_max", "m", "largest distance beside it", "Corridor").limit(AtMost(tracking::MAX_LIMIT)),
];

/// Where the car stands at the end of a pull-over.
pub(super) const PULL_OVER: [Definition; 7] = [
    metric(
        "pull_over_success",
        "",
        "1 where the ego stood (at most 0.2 m/s, for 0.5 s) with its axle 0 to 0.5 m before the place, at most 1 m beside \
         it and 0.2 rad askew; its front 15 m past it: missed",
        "Apollo (CheckADCPullOver)",
    )
    .limit(AtLeast(1.0))
    .only("where a pull-over is the one right end"),
    metric("pull_over_s_error", "m", "rest of the way to the place, at the stop", "Apollo"),
    metric("pull_over_l_error", "m", "distance beside it, at the stop", "Apollo")
        .limit(AtMost(pull_over::MAX_L_ERROR)),
    metric("pull_over_theta_error", "rad", "angle to it, at the stop", "Apollo")
        .limit(AtMost(pull_over::MAX_THETA_ERROR)),
    metric(
        "pull_over_distance",
        "m",
        "distance from it, at the stop: the strict profile of the original's retry",
        "Apollo (open space)",
    )
    .limit(AtMost(pull_over::STRICT_DISTANCE)),
    metric(
        "pull_over_edge_gap",
        "m",
        "distance from the right side to the road's edge, at the stop; nominal 0.15 m",
        "Apollo",
    )
    .limit(AtMost(pull_over::EDGE_GAP_LIMIT)),
    metric("pull_over_in_junction", "", "1 where it stands in a junction", "Apollo").limit(AtMost(0.0)),
];
