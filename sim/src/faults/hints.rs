//! Where each fault was found, and which no gate has seen, and why that may be: so that a hunt is quick, and honest.
//!
//! A hint is no more than that: a fault that does not show there any more is hunted everywhere.

use super::spec::Hint;

/// Scenarios with a seed that have shown faults, and which.
const SHOWN: &[(Hint, &[&str])] = &[
    (
        ("blocked_borrow", 1),
        &[
            "cruise_speed_in_ms",
            "line_beside_its_lane",
            "neighbours_unknown",
            "mirrored",
            "obstacles_unseen",
            "half_of_the_obstacles",
            "last_obstacle_dropped",
            "nearest_obstacle_dropped",
            "short_sighted",
            "flickering_obstacles",
            "points_for_bodies",
            "bodies_of_half_size",
            "rear_bumper_for_centre",
            "headings_swapped",
            "static_as_moving",
            "phantom_ahead",
            "ego_speed_in_kmh",
            "panic",
            "answers_never",
            "nan",
            "empty_answer",
            "trajectory_from_back_to_front",
            "memory_lost",
            "label_flips_each_tick",
            "bound_mirrored",
            "bound_sides_swapped",
            "bound_stations_unordered",
            "bound_a_car_length_late",
            "bound_a_car_length_early",
            "bound_without_half_width",
            "bound_with_half_width_twice",
            "bound_in_feet",
            "bound_without_obstacles",
            "bound_ten_metres_long",
            "fallback_bound_only",
            "obstacle_buffers_zeroed",
            "obstacle_lat_buffer_zeroed",
            "obstacle_lon_buffers_negative",
            "path_mirrored",
            "path_scaled",
            "path_along_the_line",
            "path_through_what_ends_it",
            "trajectory_mirrored",
            "curvature_sign",
            "headings_of_the_path_in_degrees",
            "speeds_in_ms_for_kmh",
            "feedback_too_eager",
            "steering_sign",
            "steering_ratio_forgotten",
            "steering_in_degrees",
            "greedy_sides",
            "pad_through_blocker",
            "apollo",
            "planner_knows_half_a_car",
        ],
    ),
    (
        ("blocked_both_lanes", 1),
        &[
            "road_sides_swapped",
            "bodies_of_double_size",
            "ego_at_front_axle",
            "front_axle_for_rear_axle",
            "stop_a_car_length_late",
            "stop_a_car_length_early",
            "speeds_in_kmh",
            "acceleration_sign",
            "never_stops",
            "brakes_lost",
            "drive_and_brakes_swapped",
        ],
    ),
    (("blocked_sweep", 1), &["small_unseen", "ego_to_the_right"]),
    (
        ("bollard_between_walls", 1),
        &[
            "ego_heading_off",
            "fallback_ignores_obstacles",
            "fallback_over_corners",
        ],
    ),
    (("bollards_askew", 1), &["planner_measures_from_the_front_axle"]),
    (("bollards_askew", 17), &["corner_collision_check"]),
    (
        ("borrow_with_column", 1),
        &[
            "moving_as_static",
            "ego_stands",
            "last_trajectory_lost",
            "stop_distance_short",
            "feedback_lost",
            "controls_late",
            "planner_knows_a_longer_wheel_base",
        ],
    ),
    (("borrow_with_column", 2), &["prediction_ignored"]),
    (
        ("cone_gate", 1),
        &[
            "headings_in_degrees",
            "obstacle_lat_buffer_doubled",
            "trajectory_beside",
        ],
    ),
    (("cone_taper", 1), &["lanes_too_wide"]),
    (
        ("curve_cyclist", 1),
        &["frozen_obstacles", "ego_heading_in_degrees"],
    ),
    (("curve_parked_car", 1), &["panic_one_in_a_thousand"]),
    (("e6_lane_change", 1), &["prediction_backwards"]),
    (
        ("emergency_pull_over", 1),
        &[
            "command_forgotten",
            "cruise_speed_in_kmh",
            "answers_rarely",
            "path_smoothed_too_long",
            "speed_limit_ignored",
            "pull_over_stops_late",
            "tracker_wheel_base_short",
            "trajectory_taken_in_rarely",
            "diagonal_jerk_hessian",
        ],
    ),
    (
        ("emergency_pull_over_parked", 1),
        &["brakes_at_the_last_moment", "steering_off_middle"],
    ),
    (("empty_road", 1), &["chosen_beside_the_list"]),
    (("fabriksgatan_turn", 1), &["lanes_too_narrow"]),
    (("hard_braking_leader", 1), &["moving_ones_ignored"]),
    (
        ("jaywalker_from_left", 1),
        &["vulnerable_unseen", "prediction_in_kmh", "moving_ones_are_narrow"],
    ),
    (("jaywalker_from_left", 4), &["brakes_capped"]),
    (
        ("lane_change_gap_sweep", 1),
        &["target_lane_forgotten", "answers_the_frame_before"],
    ),
    (
        ("pull_over_between_parked", 1),
        &["command_heard_late", "fallback_forgets_last_path"],
    ),
    (("pull_over_destination_sweep", 4), &["unreachable_place"]),
    (("pull_over_near_junction", 1), &["road_edge_at_axle"]),
    (("pull_over_too_near", 1), &["destination_ahead"]),
    (("stopped_leader", 1), &["emergency_brake_ignored"]),
];

/// Faults that no gate saw in a round through the whole catalog and in seeds that were chosen for them, and the likely
/// reason. They are holes in the net that are known, not faults that are harmless.
const UNSEEN: &[(&str, &str)] = &[
    (
        "marks_unread",
        "No scenario of the catalog has a line that may not be crossed beside a lane worth borrowing.",
    ),
    (
        "junctions_unknown",
        "The places to pull over of the catalog end before their junctions.",
    ),
    (
        "swapped_ids",
        "Identities steer hysteresis and names, nothing that a gate measures.",
    ),
    (
        "stale_obstacles",
        "Standing ones are where they were, and the gaps kept to moving ones are longer than half a second.",
    ),
    (
        "stale_frame",
        "Planning starts from the last trajectory while the car seems near it; the gaps are longer than 0.3 s.",
    ),
    (
        "prediction_late",
        "Decided anew ten times a second, a second's delay shows only to who is met within one; the gaps kept cover it.",
    ),
    (
        "bound_one_station_late",
        "Half a metre is within the buffers along the line, 3 m before and 2 m behind.",
    ),
    (
        "bound_one_station_early",
        "Half a metre is within the buffers along the line, 3 m before and 2 m behind.",
    ),
    (
        "bound_one_tick_old",
        "Bounds are made of the road and of what stands: at the same stations, those of the tick before are those of now.",
    ),
    (
        "curvature_unbounded",
        "The speed falls with the curvature, and the smoothest path bends least; the limit is not what keeps paths drivable.",
    ),
    (
        "bound_tolerance_of_a_metre",
        "The optimiser keeps the bound itself; the tolerance is only that of the check behind it.",
    ),
    (
        "bends_ignored",
        "No bend of the catalog asks for more than the tyres hold at its cruise speed; `comfort` is measured and is no gate.",
    ),
    (
        "no_gap_to_a_leader",
        "Braking is planned by the leader's prediction all the same; a short gap is measured by `ttc`, which is no gate.",
    ),
    (
        "no_time_between_crossings",
        "A crossing without a margin touches nothing while predictions hold; `min_clearance` is no gate.",
    ),
    (
        "planned_for_two_seconds",
        "Stops for what stands are planned by the path, not by the time that is looked ahead.",
    ),
    (
        "only_the_first_on_the_path",
        "No scenario of the catalog has two on the path of which the first of the list is the farther.",
    ),
    (
        "yield_taken_for_overtake",
        "The profile yields after all to whomever it would meet.",
    ),
    (
        "follow_taken_for_overtake",
        "The profile yields after all to whomever it would meet, and so stays behind him.",
    ),
    (
        "trajectory_one_tick_late",
        "A tick is less than the margins; `tracking_error` is measured and is no gate.",
    ),
    (
        "trajectory_one_tick_early",
        "A tick is less than the margins; `tracking_error` is measured and is no gate.",
    ),
    (
        "trajectory_one_second_late",
        "The next plan starts from where the car is and corrects what it has not done; `tracking_error` is no gate.",
    ),
    (
        "trajectory_in_half_seconds",
        "Of each trajectory the first tenth of a second is driven, and the next plan starts from where the car is.",
    ),
    (
        "tracker_wheel_base_long",
        "The feedback takes back what is steered too much.",
    ),
    (
        "arbitrary_blocker",
        "The name of the blocker is for people: what is driven depends on where the bound ends.",
    ),
    (
        "forgets_beside_overhang",
        "Before the overhang swings out to it, the obstacle is known again to the path's own check of the body.",
    ),
    ("silent_blocker", "The path's own check names what ends it."),
    (
        "lane_change_discards_fallback",
        "The plan along the own line, made next, has a fallback of its own.",
    ),
    (
        "asserts_ego_inside",
        "A bound is widened to hold the ego before that is asked.",
    ),
    (
        "pull_over_stands_alone",
        "No pull-over bound of the catalog has no path.",
    ),
    (
        "pull_over_overhang",
        "The places of the catalog are at the road's edge, the other side of the lane line.",
    ),
    (
        "unsigned_road_edge",
        "No road of the catalog has its edge left of the line.",
    ),
    (
        "junction_at_anchor_only",
        "No gap of the catalog reaches into a junction from before it.",
    ),
    (
        "unchecked_road_width",
        "No map of the catalog lacks a road width.",
    ),
    ("unchecked_short_window", "The catalog drives the usual car."),
    (
        "crosses_double_yellow",
        "The lane-borrow decider asks for a line that may be crossed itself.",
    ),
    (
        "borrows_phantom_lane",
        "The road edge limits the bound where there is no lane.",
    ),
    ("zone_without_lane", "No map of the catalog lacks a lane width."),
    (
        "endless_ego_extension",
        "The car comes back to the middle of its lane for its own sake.",
    ),
    (
        "fallback_discards_fresh_path",
        "The path of the tick before is nearly the fresh one, and both are stopped on.",
    ),
    (
        "frozen_pose",
        "A trajectory that stays where the car is brakes it, at the full force of the tracker.",
    ),
    (
        "lost_waypoint_hides_later_ones",
        "Only a routing answer with several waypoints shows it, and no scenario of the catalog has one; the golden vectors of the map do.",
    ),
    (
        "destination_stays_next",
        "Only a routing answer with several waypoints shows it, and no scenario of the catalog has one; the golden vectors of the map do.",
    ),
    (
        "first_entry_precedes_nothing",
        "Only a routing answer with several waypoints shows it, and no scenario of the catalog has one; the golden vectors of the map do.",
    ),
    (
        "planner_believes_in_better_brakes",
        "Comfortable braking is planned; the hardest is a fallback's, which no sound run of the catalog comes to.",
    ),
];

/// Where a fault is likely to show.
pub(super) fn shows_in(name: &str) -> Vec<Hint> {
    let shown = SHOWN.iter().filter(|(_, names)| names.contains(&name));
    shown.map(|(hint, _)| *hint).collect()
}

/// Why no gate sees a fault, where that is known.
pub(super) fn unseen(name: &str) -> Option<&'static str> {
    UNSEEN
        .iter()
        .find(|(of, _)| *of == name)
        .map(|(_, reason)| *reason)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::faults::all;
    use corridor_scenarios::catalog;

    #[test]
    fn every_hint_is_about_a_fault_and_a_scenario_that_exist() {
        let is_fault = |name: &str| all().any(|spec| spec.name == name);
        for ((scenario, _), names) in SHOWN {
            assert!(catalog::find(scenario).is_some(), "{scenario}");
            assert!(names.iter().all(|name| is_fault(name)), "{names:?}");
        }
        for (name, reason) in UNSEEN {
            assert!(is_fault(name) && reason.ends_with('.'), "{name}");
            assert!(shows_in(name).is_empty(), "{name} is seen");
        }
    }
}
