//! Scenes of other formats, run as they are.

use crate::program::Folder;

/// A straight road, a parked car beside it, and a place to be after three seconds.
const SCENE: &str = r#"<?xml version='1.0'?>
<commonRoad commonRoadVersion="2020a" benchmarkID="ZAM_Cli-1_1_T-1" timeStepSize="0.1">
  <lanelet id="1">
    <leftBound><point><x>0</x><y>1.75</y></point><point><x>200</x><y>1.75</y></point></leftBound>
    <rightBound><point><x>0</x><y>-1.75</y></point><point><x>200</x><y>-1.75</y></point></rightBound>
  </lanelet>
  <planningProblem id="100">
    <initialState><position><point><x>20</x><y>0</y></point></position><orientation><exact>0</exact></orientation>
      <time><exact>0</exact></time><velocity><exact>10</exact></velocity></initialState>
    <goalState><position><lanelet ref="1"/></position>
      <time><intervalStart>30</intervalStart><intervalEnd>40</intervalEnd></time></goalState>
  </planningProblem>
</commonRoad>"#;

#[test]
fn a_commonroad_scene_is_run_replayed_and_exported() {
    let folder = Folder::new("commonroad");
    folder.put("scene.xml", SCENE);
    let run = folder.run(&[
        "run",
        "scene.xml",
        "--trace",
        "scene.trace",
        "--solution",
        "out.xml",
        "--with-ego",
        "more.xml",
    ]);
    assert_eq!(run.code, Some(0), "{run:?}");
    assert!(
        run.out.starts_with("PASS passed: reached the goal at 3.0 s"),
        "{}",
        run.out
    );
    assert!(
        run.err.contains("note: the file's road ends on the ego's way"),
        "{}",
        run.err
    );
    let replay = folder.run(&["replay", "scene.trace"]);
    assert!(replay.out.starts_with("same: all 30 ticks"), "{replay:?}");
    let text = |name: &str| std::fs::read_to_string(folder.path(name)).unwrap();
    assert!(text("out.xml").contains("benchmark_id=\"KS2:SM1:ZAM_Cli-1_1_T-1:2020a\""));
    assert_eq!(text("out.xml").matches("<ksState>").count(), 31);
    // The scene with its own recording: the car knows itself and leaves it out.
    let again = folder.run(&["run", "more.xml"]);
    assert!(again.err.contains("starts as the ego itself"), "{again:?}");
    assert_eq!(again.code, Some(0), "{again:?}");
}

#[test]
fn what_is_no_scene_or_cannot_be_exported_says_so() {
    let folder = Folder::new("no-commonroad");
    folder.put("broken.xml", SCENE.replace("<y>-1.75</y>", "<y>low</y>"));
    folder.refuses(
        &["run", "broken.xml"],
        &["broken.xml:5:", "<y> is `low`; expected a number"],
    );
    folder.refuses(
        &["run", "pull_over_between_parked", "--solution", "out.xml"],
        &["is no CommonRoad scenario"],
    );
}

/// Each planning problem is a task of its own; they are chosen by their numbers.
#[test]
fn a_planning_problem_is_chosen_by_its_number() {
    let folder = Folder::new("problems");
    let (from, to) = (
        SCENE.find("  <planningProblem").unwrap(),
        SCENE.find("</commonRoad>").unwrap(),
    );
    let second = SCENE[from..to]
        .replace("\"100\"", "\"-7\"")
        .replace("<x>20</x>", "<x>60</x>");
    folder.put(
        "scene.xml",
        SCENE.replace("</commonRoad>", &format!("{second}</commonRoad>")),
    );
    let run = |arguments: &[&str]| {
        let all: Vec<&str> = ["run", "scene.xml"].iter().chain(arguments).copied().collect();
        let run = folder.run(&all);
        assert_eq!(run.code, Some(0), "{run:?}");
        run.out.lines().last().unwrap().to_owned()
    };
    let (first, second) = (run(&["--problem", "100"]), run(&["--problem=-7"]));
    assert_ne!(first, second);
    assert_eq!((first, second), (run(&["--seed", "1"]), run(&["--seed", "2"])));
    folder.refuses(
        &["run", "scene.xml", "--problem", "5"],
        &["no planning problem `5`: expected `100`, `-7`"],
    );
    folder.refuses(
        &["run", "pull_over_between_parked", "--problem", "5"],
        &["is no CommonRoad scenario"],
    );
    folder.refuses(
        &["run", "scene.xml", "--problem", "100", "--seed", "2"],
        &["cannot be used with"],
    );
}
