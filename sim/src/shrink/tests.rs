//! The attempts of each step, on a document of a few lines.

use super::*;
use crate::verdict::Ending;

fn failing(text: &str) -> Failing {
    Failing {
        document: Document::parse(text),
        duration: 7.23,
        driven: 50.0,
    }
}

fn signature(ending: Ending) -> Signature {
    Signature {
        metric: "no_collision".to_owned(),
        ending,
        class: None,
        label: None,
        obstacle: None,
        rung: None,
    }
}

const ROW: &str = "description = \"x\"\nmap = \"rural_curves\"\ncruise_speed = 8.33\ntimeout = 60\n[ego]\nlane = \"1_0_-1\"\nl = 0.125\n\
                   [[parked]]\nahead = 40.0\n[[parked]]\nahead = 47.5\n[[parked]]\nahead = 55.0\n[[cone]]\nahead = 60.0\n";

fn attempts(step: Step, ending: Ending) -> Vec<String> {
    let (failing, signature) = (failing(ROW), signature(ending));
    let attempts = (0..).map_while(|number| step.attempt(&failing, &signature, number));
    attempts.map(|document| document.text()).collect()
}

#[test]
fn obstacles_go_all_then_by_halves_then_one_by_one() {
    let count = |text: &String| text.matches("[[").count();
    let counts: Vec<usize> = attempts(Step::FewerObstacles, Ending::Collision)
        .iter()
        .map(count)
        .collect();
    assert_eq!(counts, [0, 2, 2, 3, 3, 3, 3]);
}

#[test]
fn a_collision_may_come_sooner_but_who_waits_in_vain_waits_to_the_end() {
    assert!(attempts(Step::EndEarly, Ending::Collision)[0].contains("timeout = 7.8"));
    let nearer = attempts(Step::StartLate, Ending::Collision);
    assert_eq!(nearer.len(), 4);
    assert!(
        nearer[0].contains("ahead = -5.0") && nearer[2].contains("ahead = 22.5"),
        "{nearer:?}"
    );
    for step in [Step::EndEarly, Step::StartLate] {
        assert_eq!(attempts(step, Ending::Timeout), Vec::<String>::new());
    }
}

#[test]
fn a_plainer_map_takes_the_place_and_its_lane_with_it() {
    let plain = attempts(Step::PlainMap, Ending::Collision);
    assert_eq!(plain.len(), 2);
    assert!(
        plain[0].contains("\"urban_parking\"") && !plain[0].contains("lane"),
        "{plain:?}"
    );
}

#[test]
fn numbers_are_rounded_where_that_saves_digits() {
    let texts = attempts(Step::RounderNumbers, Ending::Collision);
    let has = |part: &str| texts.iter().any(|text| text.contains(part));
    assert!(has("cruise_speed = 10.0") && has("cruise_speed = 8.3\n") && has("l = 0.0") && has("l = 0.1\n"));
    assert!(
        has("ahead = 50.0") && has("ahead = 48.0") && !has("timeout = 100"),
        "{texts:#?}"
    );
}
