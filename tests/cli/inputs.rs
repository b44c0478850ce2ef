//! Wrong scenarios and maps.

use crate::program::{Folder, GOOD};

/// Bytes that are no text in any encoding a file should have.
const GARBAGE: [u8; 7] = [0xff, 0xfe, 0x00, 0x9f, 0x92, 0x96, 0xc3];

/// An own map of the project, to be spoilt.
const MAP: &str = include_str!("../../scenarios/maps/urban_parking.xodr");

#[test]
fn what_is_no_scenario_says_so() {
    let folder = Folder::new("no-scenario");
    folder.put("empty.toml", "");
    folder.put("garbage.toml", GARBAGE);
    folder.put("half.toml", &GOOD[..GOOD.len() - 9]);
    std::fs::create_dir(folder.path("folder")).unwrap();
    let cases: [(&str, &[&str]); 6] = [
        ("no/such.toml", &["`no/such.toml`", "catalog", "`corridor list`"]),
        ("parked_rows", &["`parked_rows`", "`corridor list`"]),
        ("folder", &["`folder` is a folder", "`corridor sweep folder`"]),
        ("empty.toml", &["empty.toml:1:1: missing field `description`"]),
        ("garbage.toml", &["`garbage.toml`", "UTF-8"]),
        ("half.toml", &["half.toml:10:"]),
    ];
    for (name, parts) in cases {
        folder.refuses(&["run", name], parts);
    }
    folder.refuses(&["sweep", "folder"], &["`folder`: no scenario file (`*.toml`)"]);
    folder.refuses(
        &["sweep", "parked_row", "parked_row"],
        &["two scenarios", "`parked_row`", "`name`"],
    );
}

#[test]
fn a_mistake_in_a_scenario_is_pointed_at() {
    let folder = Folder::new("mistakes");
    let cases: [(&str, &str, &[&str]); 5] = [
        (
            "s = 30.0",
            "speeed = 3",
            &["x.toml:6:1: unknown field `speeed`", "`speed`"],
        ),
        (
            "s = 30.0",
            "s = nan",
            &["x.toml:6:5: `NaN` does not fit: expected a number of metres"],
        ),
        ("30.0", "-30.0", &["x.toml:6:5: `-30` does not fit", "from 0 to"]),
        (
            "1_0_-1",
            "1_0_-9",
            &["x.toml:5:8: the map has no lane `1_0_-9`: expected `1_0_"],
        ),
        (
            "urban_parking",
            "urban_park",
            &["x.toml:2:7: no map `urban_park`", "`urban_parking`"],
        ),
    ];
    for (good, bad, parts) in cases {
        folder.put("x.toml", GOOD.replace(good, bad));
        folder.refuses(&["run", "x.toml"], parts);
        folder.refuses(&["sweep", "x.toml"], parts);
    }
}

#[test]
fn a_wrong_map_names_scenario_and_map() {
    let folder = Folder::new("maps");
    folder.put("x.toml", GOOD.replace("urban_parking", "x.xodr"));
    folder.refuses(
        &["run", "x.toml"],
        &["x.toml:2:7: no map `x.xodr`", "relative to the scenario file"],
    );
    let not_a_number = MAP.replacen("length=\"", "length=\"NaN\" was=\"", 1);
    let cases: [(&[u8], &[&str]); 5] = [
        (b"", &["not well-formed XML"]),
        (&GARBAGE, &["byte 0: ", "Apollo"]),
        (&MAP.as_bytes()[..MAP.len() / 2], &["not well-formed XML"]),
        (b"<html></html>", &["OpenDRIVE"]),
        (
            not_a_number.as_bytes(),
            &["length=\"NaN\"", "expected a finite number"],
        ),
    ];
    for (map, parts) in cases {
        folder.put("x.xodr", map);
        folder.refuses(&["run", "x.toml"], &["x.toml:2:7: ", "`x.xodr`"]);
        folder.refuses(&["run", "x.toml"], parts);
    }
}

#[test]
fn a_scenario_that_nobody_could_pass_says_why() {
    let folder = Folder::new("impossible");
    folder.put(
        "x.toml",
        format!("{GOOD}[[parked]]\nname = \"wall\"\nahead = 0.0\n"),
    );
    folder.refuses(&["run", "x.toml"], &["`x` is impossible", "`wall`", "overlap"]);
}

#[test]
fn validate_tells_the_mistakes_of_all_files() {
    let folder = Folder::new("validate");
    folder.put("a.toml", GOOD.replace("30.0", "nan"));
    folder.put("b.toml", GOOD);
    folder.put("c.toml", GOOD.replace("urban_parking", "atlantis"));
    folder.put("d.toml", GARBAGE);
    let before = folder.content();
    let run = folder.run(&["validate", "a.toml", "b.toml", "c.toml", "d.toml", "e.toml"]);
    assert_eq!(run.code, Some(2));
    assert_eq!(run.out.lines().count(), 1, "{}", run.out);
    assert!(run.out.starts_with("b.toml: good"), "{}", run.out);
    for part in [
        "a.toml:6:5: ",
        "c.toml:2:7: no map `atlantis`",
        "`d.toml`",
        "`e.toml`",
        "4 of the files",
    ] {
        assert!(run.err.contains(part), "no `{part}` in {}", run.err);
    }
    assert_eq!(folder.content(), before);
    let whole = folder.run(&["validate", "."]);
    assert_eq!((whole.code, whole.out.lines().count()), (Some(2), 1), "{whole:?}");
    assert_eq!(folder.run(&["validate", "b.toml"]).code, Some(0));
}

/// Only the whole folder of shared maps may be absent; a name that is wrong in it is a mistake.
#[test]
fn absent_shared_maps_are_skipped_and_told() {
    let folder = Folder::new("shared");
    folder.put("x.toml", GOOD.replace("urban_parking", "$MAPS/opendrive/x.xodr"));
    folder.put("good.toml", GOOD);
    let absent = folder.path("absent");
    let skipped = folder
        .command(&["sweep", "."])
        .env("CORRIDOR_MAPS", &absent)
        .output()
        .unwrap();
    let told = String::from_utf8(skipped.stderr).unwrap();
    assert_eq!(skipped.status.code(), Some(0), "{told}");
    assert!(
        told.contains("skipped") && told.contains("CORRIDOR_MAPS"),
        "{told}"
    );
    let here = folder
        .command(&["sweep", "."])
        .env("CORRIDOR_MAPS", folder.path("."))
        .output()
        .unwrap();
    let told = String::from_utf8(here.stderr).unwrap();
    assert_eq!(here.status.code(), Some(2), "{told}");
    assert!(told.contains("no map `$MAPS/opendrive/x.xodr`"), "{told}");
}
