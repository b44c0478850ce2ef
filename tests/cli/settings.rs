//! `--set`.

use crate::program::Folder;

#[test]
fn a_wrong_setting_says_what_can_be_set() {
    let folder = Folder::new("settings");
    let cases: [(&str, &[&str]); 10] = [
        ("lateral", &["`lateral`", "`key=value`"]),
        ("decider.lat=1", &["`decider.lat`", "path_bounds"]),
        (
            "decider.path_bounds.quirks.none=true",
            &["`decider.path_bounds.quirks` has", "greedy_sides"],
        ),
        ("decider.path_bounds=1", &["group of settings"]),
        (
            "decider.path_bounds.obstacle_lat_buffer=wide",
            &["must be a number from 0 to"],
        ),
        (
            "decider.path_bounds.obstacle_lat_buffer=nan",
            &["must be a number from 0 to"],
        ),
        (
            "decider.path_bounds.obstacle_lat_buffer=-1",
            &["must be a number from 0 to"],
        ),
        (
            "decider.path_bounds.quirks.greedy_sides=1",
            &["greedy_sides=1`", "expected a boolean"],
        ),
        ("fault=gremlin", &["no fault is called `gremlin`", " mirrored,"]),
        ("tick=0.015", &["`tick=0.015`", "whole physics steps"]),
    ];
    for (setting, parts) in cases {
        folder.refuses(&["run", "--set", setting], parts);
        folder.refuses(&["sweep", "parked_row", "--set", setting], parts);
    }
    folder.refuses(
        &["run", "--set", "physics.dt=0"],
        &["`physics.dt=0`", "must be 0.0001 to"],
    );
    folder.refuses(
        &["run", "--set", "decider.lane_follow.look_ahead=9"],
        &["`decider.lane_follow` has", "look_ahead_short"],
    );
    folder.refuses(&["run", "--set", "profile=waymo"], &["`default` and `apollo`"]);
}
