//! A scenario of a family written down by itself.

use crate::program::{Folder, GOOD};

/// The last line of a run names the digest of its ticks.
fn digest(folder: &Folder, args: &[&str]) -> String {
    let run = folder.run(args);
    run.out.lines().last().unwrap().to_owned()
}

#[test]
fn a_scenario_written_down_is_the_same_run_for_every_seed() {
    let folder = Folder::new("fix");
    let drawn = digest(
        &folder,
        &["run", "parked_row", "--seed", "5", "--fix", "fixed.toml"],
    );
    assert!(drawn.starts_with("digest "), "{drawn}");
    assert_eq!(digest(&folder, &["run", "fixed.toml", "--seed", "8"]), drawn);
    let text = std::fs::read_to_string(folder.path("fixed.toml")).unwrap();
    assert!(
        !text.contains("uniform") && text.contains("name = \"parked_row\""),
        "{text}"
    );
    folder.put("good.toml", GOOD);
    folder.refuses(&["run", "good.toml", "--fix", "no/such/x"], &["`no/such/x`"]);
}

#[test]
fn it_finds_its_map_from_anywhere() {
    let folder = Folder::new("fix-map");
    let map = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios/maps/urban_parking.xodr");
    std::fs::create_dir_all(folder.path("maps")).unwrap();
    std::fs::copy(map, folder.path("maps/street.xodr")).unwrap();
    folder.put(
        "good.toml",
        GOOD.replace("\"urban_parking\"", "\"maps/street.xodr\""),
    );
    let there = digest(&folder, &["run", "good.toml", "--fix", "maps/fixed.toml"]);
    assert_eq!(digest(&folder, &["run", "maps/fixed.toml"]), there);
}
