//! Scenario files on maps of every format, and what is told about a map when it is opened.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::support::map_file;
use corridor_scenarios::{Family, LoadedMap};
use std::path::Path;

/// A map of each format and ending, the start of a lane on it and what the scenario should drive.
const MAPS: [(&str, &str); 6] = [
    ("opendrive/curves.xodr", "1_0_-1"),
    ("lanelet2/mapping_example.osm", "45216"),
    ("lanelet2/autoware_vm_03_right_hand.osm", "2249"),
    ("commonroad/ZAM_Tjunction-1_42_T-1.xml", "50195"),
    ("apollo/borregas_ave.base_map.bin", "lane_19"),
    ("apollo/garage_map.base_map.txt", "1_-1"),
];

/// A scenario file may lie beside its map, whatever the map's format, and name it by its file name alone.
#[test]
fn a_scenario_names_a_map_of_any_format() {
    let Some(maps) = map_file("") else { return };
    for (map, lane) in MAPS {
        let beside = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("beside-{}", map.replace('/', "-")));
        std::fs::create_dir_all(&beside).unwrap();
        let name = Path::new(map).file_name().unwrap().to_str().unwrap();
        std::fs::copy(maps.join(map), beside.join(name)).unwrap();
        let text = format!(
            "description = \"beside\"\nmap = \"{name}\"\ncruise_speed = 5.0\n[ego]\nlane = \"{lane}\"\n"
        );
        let file = beside.join("drive.toml");
        std::fs::write(&file, text).unwrap();
        let family = Family::load(&file).unwrap_or_else(|error| panic!("{map}: {error}"));
        let scenario = family
            .draw(1)
            .unwrap_or_else(|error| panic!("{map}: {error}"))
            .scenario;
        assert_eq!(scenario.map.lane(scenario.route[0]).name, lane, "{map}");
        assert!(!family.is_recorded(), "{map}");
        std::fs::remove_dir_all(&beside).unwrap();
    }
}

/// In the Autoware map four lanes are drawn against the ones that should follow on them.
#[test]
fn lanes_that_meet_head_on_are_told() {
    let Some(maps) = map_file("") else { return };
    let told = |map: &str| {
        let map = LoadedMap::open(&maps.join(map)).unwrap();
        let all = map
            .warnings
            .iter()
            .find(|warning| warning.contains("meet head-on"));
        all.cloned()
    };
    let warning = told("lanelet2/autoware_vm_03_right_hand.osm").unwrap();
    assert!(
        warning.starts_with("4 pairs of lanes") && warning.contains("`2257` and `2253`"),
        "{warning}"
    );
    for map in [
        "lanelet2/mapping_example.osm",
        "opendrive/fabriksgatan.xodr",
        "apollo/borregas_ave.base_map.bin",
    ] {
        assert_eq!(told(map), None, "{map}");
    }
}
