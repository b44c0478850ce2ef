//! The metrics that fail a run, and those that are weighed in its score.

use super::Definition;
use super::Limit::{Above, AtLeast, AtMost, Below};
use crate::monitor::{
    blocks, bound_clearance, collision, consistency, decider, labels, motion, path_clearance, progress, road,
    standstill, ttc,
};

const fn metric(
    name: &'static str,
    unit: &'static str,
    formula: &'static str,
    source: &'static str,
) -> Definition {
    Definition::new(name, unit, formula, source)
}

/// What a run must not do.
pub(super) const GATES: [Definition; 12] = [
    metric(
        "no_collision",
        "",
        "obstacles whose footprint has met the ego's",
        "CommonRoad validity",
    )
    .limit(AtMost(collision::NONE))
    .gate(),
    metric(
        "no_at_fault_collision",
        "",
        "contacts for which the ego is to blame: with what stands, with its front, or side by side while in several \
         lanes or off the road; in the scores one with a cone or the like counts half, any other is a 0",
        "nuPlan",
    )
    .limit(AtMost(collision::NONE))
    .gate(),
    metric(
        "drivable_area",
        "m",
        "farthest that a corner of the ego was off the road",
        "nuPlan",
    )
    .limit(AtMost(road::OFF_ROAD_TOLERANCE))
    .gate(),
    metric(
        "driving_direction",
        "m",
        "longest way against the lane's direction within 1 s, without the time of a borrow and up to 5 s on the way \
         back from it; in the scores a factor: 1 up to 2 m, 0.5 up to 6 m, 0 beyond",
        "nuPlan; the exclusion NAVSIM and interPlan",
    )
    .limit(AtMost(road::AGAINST_FAILS))
    .gate(),
    metric(
        "progress_min",
        "",
        "`progress`, as a gate",
        "nuPlan",
    )
    .limit(AtLeast(progress::MINIMUM))
    .gate()
    .only("where a distance has to be made"),
    metric(
        "standstill",
        "s",
        "longest time below 0.01 m/s without a reason that the world bears out",
        "random_test_runner of scenario_simulator_v2",
    )
    .limit(Below(standstill::LIMIT))
    .gate(),
    metric(
        "scenario_completed",
        "",
        "1 where the run ended as expected: goal within 3 m, pulled over, lane changed, refused or stood, before the \
         time was out",
        "random_test_runner of scenario_simulator_v2",
    )
    .limit(AtLeast(1.0))
    .gate(),
    metric(
        "decider_ok",
        "",
        "answers that were none: a panic, a number that is not finite, a bound out of order, with stations that do \
         not increase or with fewer than two points",
        "Corridor",
    )
    .limit(AtMost(decider::NO_VIOLATION))
    .gate(),
    metric(
        "bound_obstacle_clearance",
        "m",
        "least distance across the line between the driven bound, swept by the ego's width, and what stands",
        "Corridor; nominal 0.4 m, Apollo's lateral buffer",
    )
    .limit(AtLeast(bound_clearance::LEAST_ROOM))
    .gate(),
    metric(
        "path_obstacle_clearance",
        "m",
        "least distance between the footprint on the decided path and what stands, up to 0.5 m",
        "Corridor",
    )
    .limit(Above(path_clearance::TOUCHING))
    .gate(),
    metric(
        "missed_block",
        "",
        "1 where a bound was open and no way existed even for the bare car",
        "Corridor",
    )
    .limit(AtMost(blocks::NEVER))
    .gate(),
    metric(
        "side_flips",
        "",
        "most changes of the side on which one obstacle is passed",
        "Corridor",
    )
    .limit(AtMost(labels::SIDE_LIMIT))
    .gate(),
];

/// What a run is scored by, and the parts.
pub(super) const SCORE: [Definition; 21] = [
    metric(
        "nuplan_cls",
        "",
        "mean of `progress`, `ttc`, `speed_limit` and `comfort` by their weights, times `no_at_fault_collision`, \
         `drivable_area`, `driving_direction` and `progress_min`; what was not measured counts as good",
        "nuPlan",
    ),
    metric(
        "ext_cls",
        "",
        "mean of all six weighted metrics, times the multipliers of `nuplan_cls` and `no_collision`, `standstill`, \
         `scenario_completed` and `decider_ok`",
        "nuPlan, NAVSIM v2 and Autoware (EPDMS)",
    ),
    metric(
        "progress",
        "",
        "metres made along the line over those wanted (to the goal or the place to pull over at), both at least \
         0.1 m, at most 1; not measured where no place is given",
        "nuPlan",
    )
    .weight(5.0),
    metric(
        "ttc",
        "s",
        "least time to a contact if all went straight on at their velocities, in steps of 0.1 s up to 3 s; what is \
         behind never counts, what is beside only while the ego is in several lanes",
        "nuPlan",
    )
    .limit(AtLeast(ttc::LIMIT))
    .weight(5.0),
    metric(
        "speed_limit",
        "",
        "1 − ∫ overspeed dt over 2.23 m/s times the duration, at least 0",
        "nuPlan",
    )
    .weight(4.0),
    metric(
        "comfort",
        "",
        "largest of the seven quantities below over its bound",
        "nuPlan",
    )
    .limit(AtMost(1.0))
    .weight(2.0),
    metric(
        "lane_keep",
        "s",
        "longest time more than 0.5 m beside the line planned along, without a borrow, a pull-over or a lane change \
         and 1 s after it",
        "NAVSIM v2, Autoware",
    )
    .limit(AtMost(road::KEEP_LIMIT))
    .weight(2.0),
    metric(
        "consistency",
        "",
        "share of consecutive plans that agree, in each of the four quantities below, over the time they share",
        "Autoware (EPDMS), NAVSIM v2",
    )
    .limit(AtLeast(consistency::SHARE_LIMIT))
    .weight(2.0),
    metric("braking", "m/s²", "hardest braking, smoothed", "nuPlan").limit(AtMost(motion::MAX_BRAKING)),
    metric("acceleration", "m/s²", "strongest acceleration, smoothed", "nuPlan")
        .limit(AtMost(motion::MAX_ACCELERATION)),
    metric(
        "lateral_acceleration",
        "m/s²",
        "largest acceleration to the side, smoothed",
        "nuPlan",
    )
    .limit(AtMost(motion::MAX_LATERAL)),
    metric("yaw_rate", "rad/s", "largest yaw rate, smoothed", "nuPlan").limit(AtMost(motion::MAX_YAW_RATE)),
    metric(
        "yaw_acceleration",
        "rad/s²",
        "largest yaw acceleration, smoothed",
        "nuPlan",
    )
    .limit(AtMost(motion::MAX_YAW_ACCELERATION)),
    metric("lon_jerk", "m/s³", "largest jerk along the car, smoothed", "nuPlan")
        .limit(AtMost(motion::MAX_LON_JERK)),
    metric("jerk", "m/s³", "largest change of the whole acceleration, smoothed", "nuPlan")
        .limit(AtMost(motion::MAX_JERK)),
    metric("overspeed", "m/s", "largest speed above the limit", "nuPlan")
        .limit(AtMost(motion::OVERSPEED_VIOLATION)),
    metric("distance", "m", "metres made along the line", "Corridor"),
    metric(
        "consistency_acceleration",
        "m/s²",
        "largest root mean square of the difference of two consecutive plans: acceleration",
        "Autoware (EPDMS)",
    )
    .limit(AtMost(consistency::MAX_ACCELERATION)),
    metric("consistency_jerk", "m/s³", "the same: jerk", "Autoware (EPDMS)")
        .limit(AtMost(consistency::MAX_JERK)),
    metric("consistency_yaw_rate", "rad/s", "the same: yaw rate", "Autoware (EPDMS)")
        .limit(AtMost(consistency::MAX_YAW_RATE)),
    metric(
        "consistency_yaw_acceleration",
        "rad/s²",
        "the same: yaw acceleration",
        "Autoware (EPDMS)",
    )
    .limit(AtMost(consistency::MAX_YAW_ACCELERATION)),
];
