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
    /// Whether it is one of the hard families: whoever keeps his lane and his speed fails there.
    pub is_hard: bool,
    /// Whether it is a run that failed once and shall not again.
    pub is_regression: bool,
}

macro_rules! own {
    ($name:literal) => {
        Entry {
            name: $name,
            text: include_str!(concat!("../catalog/", $name, ".toml")),
            needs_shared_maps: false,
            is_hard: false,
            is_regression: false,
        }
    };
}

macro_rules! real {
    ($name:literal) => {
        Entry {
            name: $name,
            text: include_str!(concat!("../catalog/real/", $name, ".toml")),
            needs_shared_maps: true,
            is_hard: false,
            is_regression: false,
        }
    };
}

macro_rules! hard {
    ($name:literal) => {
        Entry {
            name: $name,
            text: include_str!(concat!("../catalog/hard/", $name, ".toml")),
            needs_shared_maps: false,
            is_hard: true,
            is_regression: false,
        }
    };
}

macro_rules! hard_real {
    ($name:literal) => {
        Entry {
            name: $name,
            text: include_str!(concat!("../catalog/hard/real/", $name, ".toml")),
            needs_shared_maps: true,
            is_hard: true,
            is_regression: false,
        }
    };
}

macro_rules! regression {
    ($name:literal) => {
        Entry {
            name: $name,
            text: include_str!(concat!("../regressions/", $name, ".toml")),
            needs_shared_maps: false,
            is_hard: false,
            is_regression: true,
        }
    };
}

/// Runs that failed once, with fixed numbers: they come before all else in every sweep of the catalog, and stay.
pub const REGRESSIONS: &[Entry] = &[
    regression!("lane_change_gap_sweep_92"),
    regression!("leader_sweep_16"),
    regression!("pull_over_gap_sweep_41"),
];

/// All entries: first those on own maps, then those on shared ones, then the hard ones in the same order, each by name.
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
    hard!("accident"),
    hard!("accident_with_helper"),
    hard!("blocker_chain"),
    hard!("busy_two_lanes"),
    hard!("car_noses_out"),
    hard!("car_pulls_out"),
    hard!("child_from_row"),
    hard!("construction_channel"),
    hard!("construction_in_bend"),
    hard!("construction_zone"),
    hard!("convoy_oncoming"),
    hard!("curve_blocker_chain"),
    hard!("curve_nudge"),
    hard!("curve_overtake_oncoming"),
    hard!("cut_in_and_brake"),
    hard!("cut_in_behind_queue"),
    hard!("deep_nudge"),
    hard!("door_opens"),
    hard!("doors_of_a_row"),
    hard!("double_parked_both"),
    hard!("double_parked_row"),
    hard!("late_sight"),
    hard!("leader_stops_and_goes"),
    hard!("long_lorry_oncoming"),
    hard!("merge_before_works"),
    hard!("merge_column"),
    hard!("merging_from_the_right"),
    hard!("motorway_accident"),
    hard!("narrow_gap"),
    hard!("narrowing_gap"),
    hard!("pull_over_before_junction"),
    hard!("pull_over_past_blocker"),
    hard!("pull_over_tight"),
    hard!("ragged_row"),
    hard!("slalom"),
    hard!("staggered_gap"),
    hard!("walker_behind_van"),
    hard!("walker_stops_in_lane"),
    hard!("walkers_from_both_sides"),
    hard_real!("curves_overtake_oncoming"),
    hard_real!("e6_accident"),
    hard_real!("e6_busy"),
    hard_real!("fabriksgatan_double_parked"),
    hard_real!("fabriksgatan_walker"),
    hard_real!("parking_demo_door"),
    hard_real!("straight_works"),
];

/// The entry of this name.
pub fn find(name: &str) -> Option<&'static Entry> {
    let mut all = ENTRIES.iter().chain(REGRESSIONS);
    all.find(|entry| entry.name == name)
}

impl Entry {
    /// The family; its map from `maps`, where it stays.
    ///
    /// # Errors
    /// [`ScenarioError::SharedMapsAbsent`] where a shared map is not on this machine: such a scenario is skipped.
    pub fn load(&self, maps: &MapCache) -> Result<Family, ScenarioError> {
        let file = format!("{}/{}.toml", self.folder(), self.name);
        Family::parse_with(self.text, &file, Path::new(""), maps)
    }

    /// The folder that holds its file.
    pub fn folder(&self) -> &'static str {
        if self.is_regression {
            return "regressions";
        }
        match (self.is_hard, self.needs_shared_maps) {
            (false, false) => "catalog",
            (false, true) => "catalog/real",
            (true, false) => "catalog/hard",
            (true, true) => "catalog/hard/real",
        }
    }
}
