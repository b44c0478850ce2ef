//! `--planner` and `--compare`.

use crate::program::{Folder, GOOD};

/// A street that leads nowhere in time, whoever drives.
fn late() -> String {
    GOOD.replace("distance = 20.0", "distance = 400.0")
        .replace("[ego]", "timeout = 2.0\n[ego]")
}

#[test]
fn every_planner_drives() {
    let folder = Folder::new("planner");
    folder.put("good.toml", GOOD);
    let digest = |arguments: &[&str]| {
        let run = folder.run(arguments);
        assert_eq!(run.code, Some(0), "{run:?}");
        let digest = run.out.lines().find(|line| line.starts_with("digest "));
        digest.map_or_else(|| panic!("{run:?}"), str::to_owned)
    };
    for verb in ["run", "sweep"] {
        let usual = digest(&[verb, "good.toml"]);
        let lattice = digest(&[verb, "good.toml", "--planner", "lattice"]);
        assert_eq!(digest(&[verb, "good.toml", "--planner", "lane_follow"]), usual);
        assert_eq!(
            digest(&[verb, "good.toml", "--set", "decider.planner=lattice"]),
            lattice
        );
        assert_ne!(usual, lattice, "{verb}");
    }
    for baseline in ["blind", "idm", "pdm_closed"] {
        let chosen = digest(&["run", "good.toml", "--planner", baseline]);
        let setting = format!("decider.planner={baseline}");
        assert_eq!(digest(&["run", "good.toml", "--set", &setting]), chosen);
    }
    for verb in ["run", "sweep"] {
        folder.refuses(
            &[verb, "good.toml", "--planner", "bezier"],
            &["bezier", "lane_follow", "lattice"],
        );
    }
}

#[test]
fn times_are_told_beside_the_result_and_change_nothing_of_it() {
    let folder = Folder::new("times");
    folder.put("good.toml", GOOD);
    let usual = folder.run(&["run", "good.toml"]);
    let timed = folder.run(&["run", "good.toml", "--times"]);
    let rest = timed.out.strip_prefix(&usual.out).expect("the same, and more");
    let of = |planner| {
        folder
            .run(&["run", "good.toml", "--times", "--planner", planner])
            .out
    };
    assert!(
        rest.contains("whole answer") && rest.contains("path_bounds"),
        "{rest}"
    );
    let lattice = of("lattice");
    assert!(
        lattice.contains("whole answer") && !lattice.contains("path_bounds"),
        "{lattice}"
    );
}

#[test]
fn a_trace_of_the_lattice_planner_replays_and_is_explained() {
    let folder = Folder::new("lattice-trace");
    folder.put("good.toml", GOOD);
    let run = folder.run(&["run", "good.toml", "--planner", "lattice", "--trace", "x.zst"]);
    assert_eq!(run.code, Some(0), "{run:?}");
    assert_eq!(folder.run(&["replay", "x.zst"]).code, Some(0));
    assert_eq!(folder.run(&["explain", "x.zst", "--at", "1"]).code, Some(0));
    assert_eq!(folder.run(&["view", "x.zst"]).code, Some(0));
}

#[test]
fn a_comparison_wants_two_planners() {
    let folder = Folder::new("compare-use");
    folder.put("good.toml", GOOD);
    let cases: [(&str, &[&str]); 7] = [
        ("lattice", &["two planners are wanted", "`lane_follow,lattice`"]),
        ("lane_follow,lattice,lattice", &["two planners are wanted"]),
        ("lattice,lattice", &["`lattice` is named twice"]),
        (
            "lane_follow,bezier",
            &["`bezier`: no such planner", "`lattice`", "`pdm_closed`"],
        ),
        ("Lattice,lane_follow", &["`Lattice`: no such planner"]),
        ("lane_follow,", &["``: no such planner"]),
        ("", &["--compare"]),
    ];
    for (planners, parts) in cases {
        folder.refuses(&["sweep", "good.toml", "--compare", planners], parts);
    }
    let compare = |more: &[&'static str]| {
        let mut arguments = vec!["sweep", "good.toml", "--compare", "lane_follow,lattice"];
        arguments.extend(more);
        arguments
    };
    folder.refuses(
        &compare(&["--planner", "lattice"]),
        &["--compare", "--planner", "cannot be used with"],
    );
    folder.refuses(
        &compare(&["--set", "decider.planner=lattice"]),
        &["`--set decider.planner=lattice`", "leave one of them out"],
    );
    folder.refuses(
        &compare(&["--junit", "x.xml"]),
        &["`--junit`", "`--out DIR` writes results and reports per planner"],
    );
    folder.refuses(&compare(&["--count", "0"]), &["--count"]);
    folder.refuses(&compare(&["--json", "no/such/x"]), &["`no/such/x`"]);
    folder.refuses(&compare(&["--out", "good.toml"]), &["`good.toml`"]);
    folder.refuses(
        &["run", "good.toml", "--compare", "lane_follow,lattice"],
        &["--compare"],
    );
}

#[test]
fn a_comparison_is_the_same_for_any_number_of_threads() {
    let folder = Folder::new("compare");
    let compare = |jobs: &str, file: &str| {
        let run = folder.run(&[
            "sweep",
            "cut_in",
            "parked_row",
            "nudge_sweep",
            "--compare",
            "lane_follow,lattice",
            "--count",
            "9",
            "--jobs",
            jobs,
            "--json",
            file,
        ]);
        assert!(matches!(run.code, Some(0 | 1)), "{run:?}");
        let is_time = |line: &&str| line.starts_with("planning cycle of ");
        assert_eq!(run.out.lines().filter(is_time).count(), 2, "{}", run.out);
        let table: Vec<String> = run
            .out
            .lines()
            .filter(|line| !is_time(line))
            .map(str::to_owned)
            .collect();
        (table, std::fs::read_to_string(folder.path(file)).unwrap())
    };
    let one = compare("1", "1.json");
    assert_eq!(compare("2", "2.json"), one);
    let (table, json) = one;
    assert!(table[0].starts_with("lane_follow and lattice on the same 9 seeds of 3 scenarios"));
    for part in [
        "only lane_follow",
        "only lattice",
        "p Holm",
        "progress",
        "digest lattice ",
    ] {
        assert!(table.iter().any(|line| line.contains(part)), "{part}: {table:#?}");
    }
    assert!(!json.contains("timing") && json.contains("\"difference\""));
}

/// The digests of a comparison are those of the two sweeps, and each folder holds what the sweep would have left.
#[test]
fn a_comparison_leaves_both_sweeps_and_itself() {
    let folder = Folder::new("compare-out");
    folder.put("good.toml", GOOD);
    folder.put("late.toml", late());
    let scenarios = ["sweep", "good.toml", "late.toml"];
    let run = folder.run(
        &[
            &scenarios[..],
            &["--compare", "lane_follow,lattice", "--out", "a"],
        ]
        .concat(),
    );
    // Nobody arrives on `late`: that is no gate of a comparison.
    assert_eq!(run.code, Some(0), "{run:?}");
    let text = std::fs::read_to_string(folder.path("a/comparison.txt")).unwrap();
    assert!(run.out.starts_with(&text), "{text}\n{}", run.out);
    let json = std::fs::read_to_string(folder.path("a/comparison.json")).unwrap();
    for planner in ["lane_follow", "lattice"] {
        let report = std::fs::read_to_string(folder.path("a").join(planner).join("report.json")).unwrap();
        assert!(
            report.contains("\"p99\""),
            "{planner}: no times of planning cycles"
        );
        for file in ["report.json", "report.xml", "report.txt", "late-1.trace.zst"] {
            assert!(
                folder.path("a").join(planner).join(file).is_file(),
                "{planner}/{file}"
            );
        }
        let trace = format!("a/{planner}/late-1.trace.zst");
        assert_eq!(folder.run(&["replay", &trace]).code, Some(0));
        let alone = folder.run(&[&scenarios[..], &["--planner", planner]].concat());
        assert_eq!(alone.code, Some(1));
        let digest = alone.out.lines().find_map(|line| line.strip_prefix("digest "));
        let digest = digest.unwrap();
        assert!(
            run.out.contains(&format!("\ndigest {planner} {digest}\n")),
            "{}",
            run.out
        );
        assert!(json.contains(digest));
    }
}

#[test]
fn a_decider_that_fails_fails_the_comparison() {
    let folder = Folder::new("compare-unsafe");
    folder.put("good.toml", GOOD);
    let run = folder.run(&[
        "sweep",
        "good.toml",
        "--compare",
        "lattice,lane_follow",
        "--set",
        "fault=nan",
    ]);
    assert_eq!(run.code, Some(1), "{run:?}");
    assert!(
        run.out
            .contains("lattice: collisions at fault 0, failed deciders 1, runs that could not be made 0"),
        "{}",
        run.out
    );
}
