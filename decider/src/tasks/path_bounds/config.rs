//! Settings of the path-bounds decider: the original's names and defaults, and switches for its defects.

use serde::{Deserialize, Serialize};

/// Task configuration and planning flags that path bounds read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "the original's flags, under its names"
)]
pub struct PathBoundsConfig {
    /// Nearest destination to pull over at, ahead of the front bumper, m.
    pub pull_over_destination_to_adc_buffer: f64,
    /// How far before the end of the bound a destination must lie, m.
    pub pull_over_destination_to_pathend_buffer: f64,
    /// Largest distance from the car's right side to the road edge at the place to pull over, m.
    pub pull_over_road_edge_buffer: f64,
    /// Emergency pull-over: how far to look ahead, in turning diameters.
    pub pull_over_approach_lon_distance_adjust_factor: f64,
    /// Scales half the car's width where the edge is a pure lane line.
    pub adc_buffer_coeff: f64,
    /// Whether regular bounds are widened to hold the ego.
    pub is_extend_lane_bounds_to_include_adc: bool,
    /// Widening of an obstacle to each side, m.
    pub obstacle_lat_buffer: f64,
    /// Lengthening of an obstacle towards the ego, m.
    pub obstacle_lon_start_buffer: f64,
    /// Lengthening of an obstacle away from the ego, m.
    pub obstacle_lon_end_buffer: f64,
    /// Faster obstacles are not static, m/s.
    pub static_obstacle_speed_threshold: f64,
    /// Where a change of lane starts, ahead of the ego, m.
    pub lane_change_prepare_length: f64,
    /// Planning horizon in time, s.
    pub trajectory_time_length: f64,
    /// Cruise speed where the frame names none, m/s.
    pub default_cruise_speed: f64,
    /// Whether change-lane lines get bounds of their own kind.
    pub enable_smarter_lane_change: bool,
    /// Whether a reusable path skips this task.
    pub enable_skip_path_tasks: bool,
    /// Whether the front axle is planned for instead of the rear one.
    pub use_front_axe_center_in_path_planning: bool,
    /// Widening of an obstacle to each side in the fallback bound, m. Not in the original, whose fallback
    /// ignores obstacles. Just more than the tracker strays.
    pub fallback_obstacle_lat_buffer: f64,
    /// Least widening of an obstacle that the ego is already beside, m: the buffer gives way down to this
    /// where the ego could not keep it any more.
    pub hard_obstacle_lat_buffer: f64,
    /// How long, in travel time, a bound stays widened to hold the ego, s; then it narrows again.
    pub ego_extension_hold_time: f64,
    /// How long, in travel time, that narrowing takes, s.
    pub ego_extension_fade_time: f64,
    /// Defects of the original to reproduce.
    pub quirks: Quirks,
}

impl Default for PathBoundsConfig {
    fn default() -> Self {
        Self {
            pull_over_destination_to_adc_buffer: 25.0,
            pull_over_destination_to_pathend_buffer: 4.0,
            pull_over_road_edge_buffer: 0.15,
            pull_over_approach_lon_distance_adjust_factor: 1.6,
            adc_buffer_coeff: 1.0,
            is_extend_lane_bounds_to_include_adc: true,
            obstacle_lat_buffer: 0.4,
            obstacle_lon_start_buffer: 3.0,
            obstacle_lon_end_buffer: 2.0,
            static_obstacle_speed_threshold: 0.5,
            lane_change_prepare_length: 60.0,
            trajectory_time_length: 8.0,
            default_cruise_speed: 11.18,
            enable_smarter_lane_change: true,
            enable_skip_path_tasks: false,
            use_front_axe_center_in_path_planning: false,
            fallback_obstacle_lat_buffer: 0.15,
            hard_obstacle_lat_buffer: 0.1,
            ego_extension_hold_time: 1.0,
            ego_extension_fade_time: 3.0,
            quirks: Quirks::default(),
        }
    }
}

/// The original's defects, each a switch, all off by default. Numbers are those of the list of known
/// defects in the original's specification.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[expect(clippy::struct_excessive_bools, reason = "each is an independent switch")]
pub struct Quirks {
    /// 1: the blocker named is any obstacle being passed, not the one that closed the corridor.
    pub arbitrary_blocker: bool,
    /// 2, 3, 4, 5: each obstacle is passed on the side of its centre, seen from the corridor's middle,
    /// whether or not there is room; the ego's first station is not constrained.
    pub greedy_sides: bool,
    /// 9: an obstacle beside the rear overhang is forgotten.
    pub forgets_beside_overhang: bool,
    /// 10: a blocked bound is extended through its blocker.
    pub pad_through_blocker: bool,
    /// 11: pull-over and lane-change bounds do not name their blocker.
    pub silent_blocker: bool,
    /// 12: without a lane-change bound the fallback is thrown away too.
    pub lane_change_discards_fallback: bool,
    /// 13: a bound that does not hold the ego is an error of the whole task.
    pub asserts_ego_inside: bool,
    /// Not in the list: beside a pull-over bound there is only the fallback, whatever becomes of its path.
    pub pull_over_stands_alone: bool,
    /// 15: beside the lane line a pull-over leaves no room for half the car, and its side shifts with the
    /// line's offset.
    pub pull_over_overhang: bool,
    /// Not in the list: the road's edge is looked up at the rear axle only, not under the whole body.
    pub road_edge_at_axle: bool,
    /// Not in the list: a place to pull over may be one that the car cannot turn in to.
    pub unreachable_place: bool,
    /// 16: the distance to the road edge is taken from the size of `l`, whatever its sign.
    pub unsigned_road_edge: bool,
    /// 17: only the first station of a place to pull over is checked for junctions.
    pub junction_at_anchor_only: bool,
    /// 18: a missing road width counts as near enough to the edge.
    pub unchecked_road_width: bool,
    /// Not in that list: a car so short that its window has no length may pull over anywhere, unchecked.
    pub unchecked_short_window: bool,
    /// 20: a double yellow line may be crossed.
    pub crosses_double_yellow: bool,
    /// 22: a lane is borrowed where there is none.
    pub borrows_phantom_lane: bool,
    /// 23: without a lane width the lane-change zone's edge is the line's offset.
    pub zone_without_lane: bool,
    /// 25: a bound widened for the ego stays so over its whole length.
    pub endless_ego_extension: bool,
    /// 27: the fallback bound ignores obstacles.
    pub fallback_ignores_obstacles: bool,
}

impl Quirks {
    /// All defects that the original shows.
    pub const fn apollo() -> Self {
        Self {
            arbitrary_blocker: true,
            greedy_sides: true,
            forgets_beside_overhang: true,
            pad_through_blocker: true,
            silent_blocker: true,
            lane_change_discards_fallback: true,
            asserts_ego_inside: true,
            pull_over_stands_alone: true,
            pull_over_overhang: true,
            road_edge_at_axle: true,
            unreachable_place: true,
            unsigned_road_edge: true,
            junction_at_anchor_only: true,
            unchecked_road_width: true,
            unchecked_short_window: true,
            crosses_double_yellow: true,
            borrows_phantom_lane: true,
            zone_without_lane: true,
            endless_ego_extension: true,
            fallback_ignores_obstacles: true,
        }
    }
}

impl PathBoundsConfig {
    /// The original as shipped, defects included.
    pub fn apollo() -> Self {
        Self {
            is_extend_lane_bounds_to_include_adc: false,
            quirks: Quirks::apollo(),
            ..Self::default()
        }
    }
}
