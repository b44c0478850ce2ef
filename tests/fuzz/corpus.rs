//! Files to be damaged: small ones of every format, own maps and scenarios, and real maps where the folder is.

use corridor_scenarios::Family;
use corridor_sim::run;
use corridor_sim::settings::Settings;
use std::path::{Path, PathBuf};

/// Largest file that is damaged, bytes: large ones cost much time and hold nothing that smaller ones do not.
const LARGEST: u64 = 80_000;

/// A name for messages, and bytes.
pub(crate) type File = (String, Vec<u8>);

/// The files of a target. Never empty; every one of them can be read.
pub(crate) fn corpus(target: &str) -> Vec<File> {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR"));
    let scenarios = tests.join("../scenarios");
    let mut files = in_folder(&tests.join("fuzz/corpus"), own_ending(target));
    match target {
        "opendrive" => {
            files.extend(in_folder(&scenarios.join("maps"), ".xodr"));
            files.extend(real("opendrive", ".xodr"));
        }
        "lanelet2" => files.extend(real("lanelet2", ".osm")),
        "commonroad" => files.extend(real("commonroad", ".xml")),
        "apollo_routing" => files.extend(real("apollo", "_routing.pb.txt")),
        "scenario" => files.extend(in_folder(&scenarios.join("catalog"), ".toml")),
        "trace" => files.push(("a run".to_owned(), recorded())),
        "trace_lines" => {
            let lines = zstd::decode_all(&recorded()[..]).expect("an own trace");
            files.push(("a run".to_owned(), lines));
        }
        _ => {}
    }
    assert!(!files.is_empty(), "no files for {target}");
    files
}

/// How the names of the files that are made for a target end.
fn own_ending(target: &str) -> &'static str {
    match target {
        "opendrive" => ".xodr",
        "lanelet2" => ".osm",
        "commonroad" => ".xml",
        "apollo_binary" => ".apollo.bin",
        "apollo_text" => ".apollo.txt",
        "apollo_routing" => ".routing.txt",
        "scenario" | "planted_panic" | "planted_loop" | "planted_hunger" => ".toml",
        _ => ".trace",
    }
}

/// The files of a folder by name, without the large ones.
fn in_folder(folder: &Path, ending: &str) -> Vec<File> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let paths = entries.map(|entry| entry.expect("a folder that can be read").path());
    let mut paths: Vec<PathBuf> = paths
        .filter(|path| path.to_string_lossy().ends_with(ending))
        .filter(|path| path.metadata().is_ok_and(|data| data.len() <= LARGEST))
        .collect();
    paths.sort();
    let read = |path: PathBuf| {
        let bytes = std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        (path.display().to_string(), bytes)
    };
    paths.into_iter().map(read).collect()
}

/// Files of the folder of real maps, if there is one: the own files are enough.
fn real(format: &str, ending: &str) -> Vec<File> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/maps");
    let folder = std::env::var_os("CORRIDOR_MAPS").map_or(beside, PathBuf::from);
    if folder.is_dir() {
        in_folder(&folder.join(format), ending)
    } else {
        Vec::new()
    }
}

/// The trace of a run of a second.
fn recorded() -> Vec<u8> {
    let text = include_str!("corpus/short.toml");
    let family = Family::parse(text, "short.toml", Path::new("")).expect("an own scenario");
    let drawn = family.draw(0).expect("an own scenario");
    // Targets are at work side by side when tests are.
    let file = std::env::temp_dir().join(format!(
        "corridor-fuzz-{}-{:?}.trace",
        std::process::id(),
        std::thread::current().id()
    ));
    let written = run::run_traced(&family, &drawn.scenario, &[], &Settings::default(), &file);
    written.expect("the folder for temporary files can be written to");
    let bytes = std::fs::read(&file).expect("was written");
    let _ = std::fs::remove_file(&file);
    bytes
}
