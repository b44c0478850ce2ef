//! The named scenarios that come with the program, part of it: no path to look up, the same text everywhere.

use crate::error::ScenarioError;
use crate::family::Family;
use crate::map_source::MapCache;
use std::path::Path;

/// One scenario file of the catalog.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Its name, that of the file.
    pub name: &'static str,
    /// The text of the file.
    pub text: &'static str,
    /// Whether its map is one of the shared ones, which need not be on this machine.
    pub needs_shared_maps: bool,
}

macro_rules! own {
    ($name:literal) => {
        Entry {
            name: $name,
            text: include_str!(concat!("../catalog/", $name, ".toml")),
            needs_shared_maps: false,
        }
    };
}

macro_rules! real {
    ($name:literal) => {
        Entry {
            name: $name,
            text: include_str!(concat!("../catalog/real/", $name, ".toml")),
            needs_shared_maps: true,
        }
    };
}

/// All entries: first those on own maps, then those on shared ones, each by name.
pub const ENTRIES: &[Entry] = &[
    own!("blocked_borrow"),
    own!("blocked_both_lanes"),
    own!("blocked_sweep"),
    own!("bollard_between_walls"),
    own!("bollards_askew"),
    own!("borrow_with_column"),
    own!("borrow_with_oncoming"),
    own!("cone_gate"),
    own!("cone_in_lane"),
    own!("cone_taper"),
    own!("curve_cyclist"),
    own!("curve_empty"),
    own!("curve_parked_car"),
    own!("cut_in"),
    own!("double_parked"),
    own!("emergency_pull_over"),
    own!("emergency_pull_over_parked"),
    own!("empty_road"),
    own!("hard_braking_leader"),
    own!("jaywalker"),
    own!("jaywalker_from_left"),
    own!("lane_change_gap_sweep"),
    own!("lane_change_left"),
    own!("lane_change_left_occupied"),
    own!("lane_change_past_breakdown"),
    own!("lane_change_right"),
    own!("lane_change_right_occupied"),
    own!("leader_sweep"),
    own!("narrowing_parked"),
    own!("narrowing_street"),
    own!("nudge_parked_car"),
    own!("nudge_several"),
    own!("nudge_sweep"),
    own!("off_centre_beside_parked"),
    own!("off_centre_start"),
    own!("parked_row"),
    own!("parked_row_with_oncoming"),
    own!("pull_over_between_parked"),
    own!("pull_over_destination_sweep"),
    own!("pull_over_empty_kerb"),
    own!("pull_over_gap_sweep"),
    own!("pull_over_late_command"),
    own!("pull_over_near_junction"),
    own!("pull_over_no_gap"),
    own!("pull_over_shoulder"),
    own!("pull_over_too_far"),
    own!("pull_over_too_near"),
    own!("slow_leader"),
    own!("stopped_leader"),
    own!("two_cones"),
    real!("curves_stopped_car"),
    real!("e6_cut_in"),
    real!("e6_lane_change"),
    real!("e6_pull_over"),
    real!("fabriksgatan_straight_on"),
    real!("fabriksgatan_turn"),
    real!("parking_demo_nudge"),
    real!("straight_blocked"),
    real!("two_plus_one_slow_leader"),
];

/// The entry of this name.
pub fn find(name: &str) -> Option<&'static Entry> {
    ENTRIES.iter().find(|entry| entry.name == name)
}

impl Entry {
    /// The family; its map from `maps`, where it stays.
    ///
    /// # Errors
    /// [`ScenarioError::SharedMapsAbsent`] where a shared map is not on this machine: such a scenario is skipped.
    pub fn load(&self, maps: &MapCache) -> Result<Family, ScenarioError> {
        let folder = if self.needs_shared_maps {
            "catalog/real"
        } else {
            "catalog"
        };
        Family::parse_with(
            self.text,
            &format!("{folder}/{}.toml", self.name),
            Path::new(""),
            maps,
        )
    }
}
