//! `corridor map` and `corridor import`.

use crate::program::Folder;
use std::path::PathBuf;

/// An own map of the project.
const MAP: &str = include_str!("../../scenarios/maps/urban_parking.xodr");

/// A scene with one lanelet, which is its map.
const SCENE: &str = r#"<?xml version='1.0'?>
<commonRoad commonRoadVersion="2020a" benchmarkID="ZAM_Cli-1_1_T-1" timeStepSize="0.1">
  <lanelet id="1">
    <leftBound><point><x>0</x><y>1.75</y></point><point><x>200</x><y>1.75</y></point></leftBound>
    <rightBound><point><x>0</x><y>-1.75</y></point><point><x>200</x><y>-1.75</y></point></rightBound>
  </lanelet>
</commonRoad>"#;

/// The folder of shared maps, if it is on this machine.
fn shared_maps() -> Option<PathBuf> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..");
    let folder = std::env::var_os("CORRIDOR_MAPS").map_or(root.join("../shared/maps"), PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    assert!(
        std::env::var_os("CORRIDOR_REQUIRE_MAPS").is_none(),
        "no maps in {}",
        folder.display()
    );
    eprintln!("skipped: no maps");
    None
}

/// Names of what is in a folder of the folder.
fn names(folder: &Folder, inner: &str) -> Vec<String> {
    let entries = std::fs::read_dir(folder.path(inner)).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn a_map_is_told_and_drawn() {
    let folder = Folder::new("map");
    folder.put("street.xodr", MAP);
    let told = folder.run(&["map", "street.xodr"]);
    assert_eq!(told.code, Some(0), "{told:?}");
    assert!(
        told.out.starts_with("street.xodr: OpenDRIVE\nextent "),
        "{}",
        told.out
    );
    assert_eq!(folder.content().len(), 1);
    folder.put("street.svg", "an older drawing");
    let drawn = folder.run(&["map", "street.xodr", "--svg", "street.svg"]);
    assert_eq!(drawn.out, format!("{}drawing    street.svg\n", told.out));
    let svg = std::fs::read_to_string(folder.path("street.svg")).unwrap();
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    assert_eq!(folder.content().len(), 2);
}

#[test]
fn an_imported_map_is_run() {
    let folder = Folder::new("import");
    std::fs::create_dir(folder.path("maps")).unwrap();
    folder.put("maps/my street.xodr", MAP);
    let imported = folder.run(&["import", "maps/my street.xodr", "-o", "new/scenes"]);
    assert_eq!(imported.code, Some(0), "{imported:?}");
    let written = ["my street.map.txt", "my street.svg", "my street.toml"];
    assert_eq!(names(&folder, "new/scenes"), written);
    let scenario = std::fs::read_to_string(folder.path("new/scenes/my street.toml")).unwrap();
    assert!(
        scenario.contains("map = \"../../maps/my street.xodr\""),
        "{scenario}"
    );
    let report = std::fs::read_to_string(folder.path("new/scenes/my street.map.txt")).unwrap();
    assert_eq!(report, folder.run(&["map", "maps/my street.xodr"]).out);
    assert_eq!(folder.run(&["run", "new/scenes/my street.toml"]).code, Some(0));
    // Again, and beside the map itself: what is there is replaced, the map is not.
    for place in ["new/scenes", "maps"] {
        let again = folder.run(&["import", "maps/my street.xodr", "-o", place]);
        assert_eq!(again.code, Some(0), "{again:?}");
    }
    assert_eq!(names(&folder, "new/scenes"), written);
    assert_eq!(
        std::fs::read_to_string(folder.path("maps/my street.xodr")).unwrap(),
        MAP
    );
    let beside = std::fs::read_to_string(folder.path("maps/my street.toml")).unwrap();
    assert!(beside.contains("map = \"./my street.xodr\""), "{beside}");
}

#[test]
fn an_imported_scene_is_a_copy_of_itself() {
    let folder = Folder::new("import-scene");
    folder.put("scene.xml", SCENE);
    let imported = folder.run(&["import", "scene.xml", "-o", "scenes"]);
    assert_eq!(imported.code, Some(0), "{imported:?}");
    assert!(imported.err.contains("a scenario itself"), "{}", imported.err);
    assert_eq!(
        names(&folder, "scenes"),
        ["scene.map.txt", "scene.svg", "scene.xml"]
    );
    assert_eq!(
        std::fs::read_to_string(folder.path("scenes/scene.xml")).unwrap(),
        SCENE
    );
    assert_eq!(folder.run(&["run", "scenes/scene.xml"]).code, Some(0));
    let beside = folder.run(&["import", "scene.xml", "-o", "."]);
    assert_eq!(beside.out, "./scene.map.txt\n./scene.svg\n", "{beside:?}");
}

#[test]
fn what_is_no_map_says_so_and_writes_nothing() {
    let folder = Folder::new("no-map");
    let undrivable = MAP.replace("type=\"driving\"", "type=\"sidewalk\"");
    std::fs::create_dir(folder.path("folder")).unwrap();
    let files: [(&str, &[u8], &[&str]); 9] = [
        (
            "empty.xodr",
            b"",
            &["empty.xodr:1:1: the file is empty", "OpenDRIVE, Lanelet2"],
        ),
        ("blank.osm", b" \n\t\n", &["blank.osm:1:1: the file is empty"]),
        (
            "half.xodr",
            &MAP.as_bytes()[..MAP.len() / 2],
            &["half.xodr:", "not well-formed XML"],
        ),
        (
            "half.xml",
            &SCENE.as_bytes()[..SCENE.len() / 2],
            &["half.xml:", "not well-formed XML"],
        ),
        (
            "garbage.bin",
            &[0xff, 0xfe, 0, 0x9f, 0x92, 0x96, 0xc3],
            &["garbage.bin: byte 0: "],
        ),
        ("garbage.txt", b"lorem ipsum dolor", &["garbage.txt:1:"]),
        ("page.html", b"<html></html>", &["page.html:1:1: ", "OpenDRIVE"]),
        (
            "undrivable.xodr",
            undrivable.as_bytes(),
            &["undrivable.xodr: the map has no drivable lane"],
        ),
        (
            "empty.osm",
            b"<osm></osm>",
            &["empty.osm: the map has no drivable lane"],
        ),
    ];
    for (name, content, parts) in files {
        folder.put(name, content);
        folder.refuses(&["map", name, "--svg", "x.svg"], parts);
        folder.refuses(&["import", name, "-o", "new"], parts);
    }
    for (name, parts) in [
        ("no/such.xodr", ["no/such.xodr: cannot be read", "No such file"]),
        ("folder", ["`folder` is a folder", "a map file is wanted"]),
    ] {
        folder.refuses(&["map", name], &parts);
        folder.refuses(&["import", name, "-o", "new"], &parts);
    }
}

#[test]
fn places_that_cannot_be_written_are_refused() {
    let folder = Folder::new("map-places");
    folder.put("street.xodr", MAP);
    folder.put("street.svg", MAP);
    std::fs::create_dir_all(folder.path("folder/street.svg")).unwrap();
    folder.refuses(
        &["map", "street.xodr", "--svg", "./street.xodr"],
        &["`./street.xodr`", "the map that is to be read"],
    );
    folder.refuses(
        &["import", "street.svg", "-o", "."],
        &["street.svg`", "the map that is to be read"],
    );
    for place in ["no/such/x.svg", "folder", "street.xodr/x"] {
        folder.refuses(&["map", "street.xodr", "--svg", place], &[&format!("`{place}`")]);
    }
    folder.refuses(
        &["import", "street.xodr", "-o", "street.svg"],
        &["cannot make the folder `street.svg`"],
    );
    // One of the three cannot be written: none is.
    folder.refuses(
        &["import", "street.xodr", "-o", "folder"],
        &["`folder/street.svg`", "it is a folder"],
    );
    assert_eq!(names(&folder, "folder"), ["street.svg"]);
}

#[test]
fn a_device_without_end_is_no_map() {
    let folder = Folder::new("endless");
    folder.refuses(&["map", "/dev/zero"], &["/dev/zero", "larger than the 256 MB"]);
}

/// One of each format, a small one.
#[test]
fn shared_maps_of_every_format_are_told_drawn_and_imported() {
    let Some(maps) = shared_maps() else { return };
    let folder = Folder::new("formats");
    for (file, format) in [
        ("opendrive/e6mini.xodr", "OpenDRIVE"),
        ("lanelet2/autoware_vm_03_right_hand.osm", "Lanelet2"),
        ("apollo/borregas_ave.base_map.bin", "Apollo"),
        ("commonroad/ZAM_Over-1_1.xml", "CommonRoad"),
    ] {
        let path = maps.join(file).display().to_string();
        let told = folder.run(&["map", &path, "--svg", "x.svg"]);
        assert_eq!(told.code, Some(0), "{told:?}");
        assert!(
            told.out.starts_with(&format!("{path}: {format}\n")),
            "{}",
            told.out
        );
        assert!(
            folder.path("x.svg").metadata().unwrap().len() < 3_000_000,
            "{file}"
        );
        let imported = folder.run(&["import", &path, "-o", "scenes"]);
        assert_eq!(imported.code, Some(0), "{imported:?}");
        let scenario = imported.out.lines().next().unwrap();
        let good = folder.run(&["validate", scenario]);
        assert_eq!(good.code, Some(0), "{good:?}");
    }
}
