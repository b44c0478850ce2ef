//! The numbers that a draw tells of, and draws that are told some of them.
#![expect(clippy::float_cmp, reason = "numbers are told exactly")]

use crate::road::family;
use corridor_scenarios::schema::LawKind;
use corridor_scenarios::{DrawError, Drawn, Family, Parameter};
use std::collections::BTreeMap;

const ROWS: &str = "map='street'\ncruise_speed={uniform=[4,9]}\ntimeout=50\n[ego]\nl={normal=[0,0.1],clamp=[-0.3,0.3]}\n\
    [[parked]]\nahead={uniform=[40,60]}\nfrom='right_edge'\nl={uniform=[0,0.4]}\ncount={uniform=[2,5]}\n\
    spacing={uniform=[1,3]}\n\
    [[idm]]\nlane='oncoming'\nahead=150\nspeed={choice=[5,8,8]}\n\
    lane_change={to=0.0,duration={uniform=[2,4]},when={at={uniform=[1,3]}}}\n\
    [[scripted]]\nahead=100\nl=-3\nwaypoints=[{after=3,ahead=120},{after={uniform=[1,2]},ahead=130}]\n";

/// A lane and a task, as others record them.
const SCENE: &str = r#"<?xml version='1.0' encoding='UTF-8'?>
<commonRoad commonRoadVersion="2020a" benchmarkID="ZAM_Plain-1_1_T-1" timeStepSize="0.1">
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

fn find<'a>(drawn: &'a Drawn, key: &str) -> &'a Parameter {
    let found = drawn.parameters.iter().find(|parameter| parameter.key == key);
    found.unwrap_or_else(|| panic!("no {key} in {:#?}", drawn.parameters))
}

fn told(drawn: &Drawn, of: impl Fn(&Parameter) -> f64) -> BTreeMap<String, f64> {
    let numbers = drawn.parameters.iter();
    numbers
        .map(|parameter| (parameter.key.clone(), of(parameter)))
        .collect()
}

/// A scenario in words, to compare.
fn text(drawn: &Drawn) -> String {
    format!("{:?} {:?}", drawn.scenario.ego, drawn.scenario.obstacles)
}

#[test]
fn every_number_that_came_from_a_law_is_told_under_its_key_path() {
    let rows = family(ROWS);
    for seed in 0..20 {
        let drawn = rows.draw(seed).unwrap();
        let keys: Vec<&str> = drawn.parameters.iter().map(|p| p.key.as_str()).collect();
        let count = find(&drawn, "parked[0].count");
        let mut expected = vec!["cruise_speed", "ego.l", "parked[0].count", "parked[0].ahead"];
        let members: Vec<[String; 2]> = (0..5)
            .map(|k| [format!("parked[0].spacing[{k}]"), format!("parked[0].l[{k}]")])
            .collect();
        let there = members
            .iter()
            .take((2..=5).find(|n| *n as f64 == count.value).unwrap());
        expected.extend(there.flatten().map(String::as_str).skip(1));
        expected.extend([
            "idm[0].speed",
            "idm[0].lane_change.when.at",
            "idm[0].lane_change.duration",
            "scripted[0].waypoints[1].after",
        ]);
        let sorted = |mut keys: Vec<String>| {
            keys.sort();
            keys
        };
        assert_eq!(
            sorted(keys.iter().map(|k| (*k).to_owned()).collect()),
            sorted(expected.iter().map(|k| (*k).to_owned()).collect())
        );
        assert_eq!(
            (count.law, count.low, count.high, count.steps),
            (LawKind::Uniform, 2.0, 5.0, Some(4))
        );
        let speed = find(&drawn, "cruise_speed");
        assert_eq!(speed.value, drawn.scenario.cruise_speed);
        assert!((speed.quantile - (speed.value - 4.0) / 5.0).abs() < 1e-15);
        let choice = find(&drawn, "idm[0].speed");
        assert_eq!((choice.law, choice.steps), (LawKind::Choice, Some(2)));
        assert!((choice.quantile - if choice.value == 5.0 { 1.0 / 6.0 } else { 2.0 / 3.0 }).abs() < 1e-15);
    }
    assert!(family("map='street'").draw(1).unwrap().parameters.is_empty());
}

#[test]
fn told_nothing_a_draw_is_that_of_its_seed_rejections_included() {
    // Three of four places are inside the ego.
    let text_of = "map='street'\ncruise_speed=1\n[ego]\nspeed=0\nl={uniform=[-0.2,0.2]}\n\
                   [expect]\noutcome='progress_by_gap'\n[[cone]]\nahead={uniform=[0,5.4]}\n";
    let cones = family(text_of);
    let mut later = 0;
    for seed in 0..50 {
        let drawn = cones.draw(seed).unwrap();
        later += usize::from(!drawn.rejected.is_empty());
        for again in [
            cones.draw_at(seed, &BTreeMap::new()).unwrap(),
            cones.draw_fixed(seed, &told(&drawn, |p| p.value)).unwrap(),
        ] {
            assert_eq!(text(&again), text(&drawn));
            assert_eq!(again.parameters, drawn.parameters);
        }
        // One number is told, the other stays that of the seed.
        let at = BTreeMap::from([("cone[0].ahead".to_owned(), 0.99)]);
        let moved = cones.draw_at(seed, &at).unwrap();
        assert_eq!(find(&moved, "ego.l"), find(&drawn, "ego.l"));
        assert!((find(&moved, "cone[0].ahead").value - 0.99 * 5.4).abs() < 1e-12);
        // And where it cannot be, no other attempt is made.
        let inside = BTreeMap::from([("cone[0].ahead".to_owned(), 0.1)]);
        let impossible = cones.draw_at(seed, &inside);
        assert!(
            matches!(impossible, Err(DrawError::Impossible { .. })),
            "{impossible:?}"
        );
    }
    assert!(later > 20, "{later}");
}

#[test]
fn the_quantiles_of_a_draw_lead_back_to_it() {
    let rows = family(ROWS);
    for seed in 0..30 {
        let drawn = rows.draw(seed).unwrap();
        // Another seed, told everything, gives the same scenario.
        let again = rows.draw_at(seed + 1000, &told(&drawn, |p| p.quantile)).unwrap();
        assert_eq!(again.parameters.len(), drawn.parameters.len());
        for (a, b) in again.parameters.iter().zip(&drawn.parameters) {
            assert_eq!(a.key, b.key);
            assert!((a.value - b.value).abs() < 1e-12, "{a:?} {b:?}");
        }
    }
}

#[test]
fn what_cannot_be_told_is_a_mistake_with_its_key() {
    let rows = family(ROWS);
    let message = |key: &str, value: f64, at: bool| {
        let told = BTreeMap::from([(key.to_owned(), value)]);
        let drawn = if at {
            rows.draw_at(1, &told)
        } else {
            rows.draw_fixed(1, &told)
        };
        drawn.unwrap_err().to_string()
    };
    assert_eq!(
        message("cruise_speed", 1.5, true),
        "family `test`: `cruise_speed`: 1.5 is no quantile: expected a number from 0 to 1"
    );
    assert!(message("cruise_speed", f64::NAN, true).contains("no quantile"));
    assert_eq!(
        message("timeout", 0.5, true),
        "family `test`: `timeout`: no law draws a number of this name"
    );
    let negative = message("cruise_speed", -1.0, false);
    assert!(
        negative.contains("`-1` does not fit: expected a speed in m/s"),
        "{negative}"
    );
    assert!(message("parked[0].count", 2.5, false).contains("a whole number"));
    let beyond = BTreeMap::from([
        ("parked[0].l[4]".to_owned(), 0.5),
        ("parked[0].count".to_owned(), 0.0),
    ]);
    assert_eq!(rows.draw_at(1, &beyond).unwrap().scenario.obstacles.len(), 2 + 2);
}

#[test]
fn a_recorded_scene_has_no_numbers() {
    let scene = Family::parse(SCENE, "scene.xml", std::path::Path::new("")).unwrap();
    assert!(scene.draw(1).unwrap().parameters.is_empty());
    assert!(scene.draw_at(1, &BTreeMap::new()).is_ok());
    let told = BTreeMap::from([("ego.l".to_owned(), 0.5)]);
    assert!(matches!(scene.draw_at(1, &told), Err(DrawError::Told { .. })));
    assert!(matches!(scene.fixed(1), Err(DrawError::Recorded { .. })));
}
