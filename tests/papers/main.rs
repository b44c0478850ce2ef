//! The papers tell the truth: what ARCHITECTURE.md names exists, packages import in one direction only, and what
//! README.md shows works, and sim/METRICS.md has every metric.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod metrics;

use corridor_scenarios::{Family, MapCache};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn read(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// What stands between backticks in running text.
fn literals(text: &str) -> Vec<&str> {
    let prose = text.split("```").step_by(2);
    prose
        .flat_map(|part| part.split('`').skip(1).step_by(2))
        .collect()
}

/// The text between the first fence of this language and its end.
fn block<'a>(text: &'a str, language: &str) -> &'a str {
    let (_, rest) = text.split_once(&format!("```{language}\n")).unwrap();
    rest.split_once("```").unwrap().0
}

#[test]
fn every_path_in_the_papers_exists() {
    for (paper, least) in [("ARCHITECTURE.md", 30), ("CONTRIBUTING.md", 8), ("README.md", 1)] {
        let text = read(paper);
        let paths = literals(&text).into_iter().filter(|literal| {
            let first = literal.split('/').next().unwrap_or_default();
            literal.contains('/')
                && ["decider", "scenarios", "sim", "tests", "benches", ".ci"].contains(&first)
        });
        let mut checked = 0;
        for path in paths {
            assert!(root().join(path).exists(), "{paper} names `{path}`");
            checked += 1;
        }
        assert!(checked >= least, "{paper} names {checked} paths");
    }
}

#[test]
fn architecture_has_a_heading_for_every_package() {
    let text = read("ARCHITECTURE.md");
    let headings: BTreeSet<&str> = text.lines().filter_map(|line| line.strip_prefix("## ")).collect();
    let manifest = read("Cargo.toml");
    let members = manifest
        .lines()
        .find(|line| line.starts_with("members = "))
        .unwrap();
    let members: BTreeSet<&str> = members.split('"').skip(1).step_by(2).collect();
    assert_eq!(headings, members);
}

/// Own packages in the tables of a manifest, and everything else there.
fn dependencies(package: &str) -> (BTreeSet<String>, BTreeSet<String>) {
    dependencies_under(package, |heading| heading.contains("dependencies"))
}

/// The same, of the tables whose headings are `wanted`.
fn dependencies_under(package: &str, wanted: impl Fn(&str) -> bool) -> (BTreeSet<String>, BTreeSet<String>) {
    let manifest = read(&format!("{package}/Cargo.toml"));
    let mut inside = false;
    let mut names = Vec::new();
    for line in manifest.lines() {
        if line.starts_with('[') {
            inside = wanted(line);
        } else if let Some((name, _)) = line.split_once('=').filter(|_| inside) {
            names.push(name.trim().trim_end_matches(".workspace").to_owned());
        }
    }
    let own = |name: &String| name.starts_with("corridor-");
    let (own, others): (Vec<_>, Vec<_>) = names.into_iter().partition(own);
    (
        own.into_iter()
            .map(|name| name["corridor-".len()..].to_owned())
            .collect(),
        others.into_iter().collect(),
    )
}

#[test]
fn packages_import_in_one_direction() {
    let allowed: [(&str, &[&str]); 5] = [
        ("decider", &[]),
        ("scenarios", &["decider"]),
        ("sim", &["decider", "scenarios"]),
        ("tests", &["decider", "scenarios", "sim"]),
        ("benches", &["decider", "scenarios", "sim"]),
    ];
    for (package, allowed) in allowed {
        let (own, others) = dependencies(package);
        assert_eq!(
            own,
            allowed.iter().map(|name| (*name).to_owned()).collect(),
            "{package}"
        );
        assert!(!others.is_empty(), "{package}: no table was found");
        let physics = others.iter().any(|name| name.starts_with("rapier"));
        assert!(!physics || package == "sim", "{package} knows the physics engine");
    }
    // What its tests use does not make the decider know files.
    let (_, decider) = dependencies_under("decider", |heading| heading == "[dependencies]");
    assert!(decider.contains("libm"), "no table was found");
    let impure = ["parry2d", "rand", "rand_pcg", "rayon", "toml", "serde_json"];
    assert!(impure.iter().all(|name| !decider.contains(*name)), "{decider:?}");
}

/// Rust files below a folder.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files
}

#[test]
fn the_physics_engine_is_known_in_one_place_and_the_decider_is_pure() {
    let world = root().join("sim/src/world");
    for file in sources(&root().join("sim/src")) {
        let knows = std::fs::read_to_string(&file).unwrap().contains("rapier2d");
        assert!(!knows || file.starts_with(&world), "{}", file.display());
    }
    for file in sources(&root().join("decider/src")) {
        let text = std::fs::read_to_string(&file).unwrap();
        for impure in [
            "std::fs",
            "std::io",
            "std::thread",
            "std::time",
            "std::env",
            "println!",
        ] {
            assert!(!text.contains(impure), "{}: {impure}", file.display());
        }
    }
}

#[test]
fn the_readme_tells_two_commands_and_a_scenario_that_works() {
    let text = read("README.md");
    let commands: Vec<&str> = block(&text, "sh").lines().collect();
    let [run, test] = commands[..] else {
        panic!("{commands:?}")
    };
    assert!(run.starts_with("cargo run --release -- run --view "), "{run}");
    assert_eq!(test, "cargo test --workspace");

    let family =
        Family::parse_with(block(&text, "toml"), "README.md", Path::new(""), &MapCache::new()).unwrap();
    for seed in 0..20 {
        family.draw(seed).unwrap();
    }
}

#[test]
fn the_changelog_knows_this_version() {
    let heading = format!("## {}", env!("CARGO_PKG_VERSION"));
    assert!(
        read("CHANGELOG.md")
            .lines()
            .any(|line| line.starts_with(&heading))
    );
    for folder in ["scenarios/catalog", "scenarios/catalog/real"] {
        assert!(root().join(folder).is_dir());
    }
}
