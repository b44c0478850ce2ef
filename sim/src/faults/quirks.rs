//! The original's defects, each as a fault of its own, and the car that the planner believes in.

use super::failure::Part;
use super::spec::{Plant, Spec, Stage};
use corridor_decider::config::Config;
use corridor_decider::planner::TaskName;

/// There is no line for two seconds.
const BLIND: &[(Part, f64, f64)] = &[(Part::ReferenceLine, 4.0, 6.0)];

/// No bound for three seconds.
const NO_PATH: &[(Part, f64, f64)] = &[(Part::Task(TaskName::PathBounds), 9.0, 12.0)];

/// No speed for three seconds.
pub(super) const NO_SPEED: &[(Part, f64, f64)] = &[(Part::Task(TaskName::PiecewiseJerkSpeed), 4.0, 7.0)];

const fn quirk(name: &'static str, what: &'static str, stage: Stage, change: fn(&mut Config)) -> Spec {
    Spec::new(name, what, stage, Plant::Config(change))
}

/// A switch of the path bounds.
macro_rules! of_bounds {
    ($name:ident, $what:literal) => {
        quirk(stringify!($name), $what, Stage::Bound, |config| {
            config.path_bounds.quirks.$name = true
        })
    };
}

/// A switch of the pipeline and its fallbacks.
macro_rules! of_pipeline {
    ($name:ident, $stage:ident, $what:literal) => {
        quirk(stringify!($name), $what, Stage::$stage, |config| {
            config.quirks.$name = true
        })
    };
}

/// A switch of route following.
macro_rules! of_route {
    ($name:ident, $what:literal) => {
        quirk(stringify!($name), $what, Stage::Scenario, |config| {
            config.lane_follow.quirks.$name = true
        })
    };
}

pub(super) const FAULTS: &[Spec] = &[
    of_bounds!(
        arbitrary_blocker,
        "The blocker named is any obstacle being passed, not the one that closed the corridor."
    ),
    of_bounds!(
        greedy_sides,
        "Each obstacle is passed on the side of its centre, whether or not there is room."
    ),
    of_bounds!(
        forgets_beside_overhang,
        "An obstacle beside the rear overhang is forgotten."
    ),
    of_bounds!(
        pad_through_blocker,
        "A blocked bound is extended through its blocker."
    ),
    of_bounds!(
        silent_blocker,
        "Pull-over and lane-change bounds do not name their blocker."
    ),
    of_bounds!(
        lane_change_discards_fallback,
        "Without a lane-change bound the fallback is thrown away too."
    ),
    of_bounds!(
        asserts_ego_inside,
        "A bound that does not hold the ego is an error of the whole task."
    ),
    of_bounds!(
        pull_over_stands_alone,
        "Beside a pull-over bound there is only the fallback, whatever becomes of its path."
    ),
    of_bounds!(
        pull_over_overhang,
        "Beside the lane line a pull-over leaves no room for half the car."
    ),
    of_bounds!(
        road_edge_at_axle,
        "The road's edge is looked up at the rear axle only, not under the whole body."
    ),
    of_bounds!(
        unreachable_place,
        "A place to pull over may be one that the car cannot turn in to."
    ),
    of_bounds!(
        unsigned_road_edge,
        "The distance to the road edge is taken from the size of `l`, whatever its sign."
    ),
    of_bounds!(
        junction_at_anchor_only,
        "Only the first station of a place to pull over is checked for junctions."
    ),
    of_bounds!(
        unchecked_road_width,
        "A missing road width counts as near enough to the edge."
    ),
    of_bounds!(
        unchecked_short_window,
        "A car so short that its window has no length may pull over anywhere, unchecked."
    ),
    of_bounds!(crosses_double_yellow, "A double yellow line may be crossed."),
    of_bounds!(borrows_phantom_lane, "A lane is borrowed where there is none."),
    of_bounds!(
        zone_without_lane,
        "Without a lane width the lane-change zone's edge is the line's offset."
    ),
    of_bounds!(
        endless_ego_extension,
        "A bound widened for the ego stays so over its whole length."
    ),
    of_bounds!(
        fallback_ignores_obstacles,
        "The fallback bound ignores obstacles."
    ),
    of_pipeline!(
        diagonal_jerk_hessian,
        Path,
        "The jerk enters the optimisers' cost without the product of neighbours."
    ),
    of_pipeline!(
        fallback_discards_fresh_path,
        Path,
        "Where only the speed failed, the path of the tick before takes the place of the fresh one."
    )
    .when(NO_SPEED),
    of_pipeline!(
        fallback_forgets_last_path,
        Path,
        "Where only the path failed, none but the offset path is tried."
    )
    .when(NO_PATH),
    of_pipeline!(
        frozen_pose,
        Decider,
        "A tick that cannot be planned publishes the car's own pose, thirty times over."
    )
    .when(BLIND),
    of_route!(
        lost_waypoint_hides_later_ones,
        "A waypoint that is not on the route hides all later ones."
    ),
    of_route!(
        destination_stays_next,
        "Once the destination is next to pass it stays so, even for a car that rolls back."
    ),
    of_route!(
        first_entry_precedes_nothing,
        "The first lane segment of the route is not preferred among those that lead to another."
    ),
    quirk(
        "corner_collision_check",
        "Only the corners of the footprint are checked, and not on the last 10.5 m.",
        Stage::Path,
        |config| {
            config.path.corner_collision_check = true;
        },
    ),
    quirk(
        "fallback_over_corners",
        "The fallback bound ignores obstacles, and only the corners of the footprint are checked.",
        Stage::Bound,
        |config| {
            config.path_bounds.quirks.fallback_ignores_obstacles = true;
            config.path.corner_collision_check = true;
        },
    ),
    quirk(
        "apollo",
        "All defects of the original at once.",
        Stage::Decider,
        |config| {
            *config = Config {
                planner: config.planner,
                ..Config::apollo()
            };
        },
    ),
    Spec::new(
        "planner_knows_half_a_car",
        "The planner takes the whole width of the car for half of it.",
        Stage::Path,
        Plant::Car(|car| {
            car.width *= 0.5;
        }),
    ),
    Spec::new(
        "planner_measures_from_the_front_axle",
        "The planner measures the car's ends from its front axle.",
        Stage::Path,
        Plant::Car(|car| {
            car.front_edge_to_center -= car.wheel_base;
            car.back_edge_to_center += car.wheel_base;
        }),
    ),
    Spec::new(
        "planner_knows_a_longer_wheel_base",
        "The planner takes the wheelbase for the turning radius: it believes in less steering than there is.",
        Stage::Path,
        Plant::Car(|car| {
            car.wheel_base *= 4.0;
        }),
    ),
    Spec::new(
        "planner_believes_in_better_brakes",
        "The planner believes that the car brakes at 12 m/s².",
        Stage::Speed,
        Plant::Car(|car| {
            car.max_deceleration = -12.0;
        }),
    ),
];
