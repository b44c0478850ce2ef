//! The reader on small files written for one question each.

mod elements;
mod hostile;
mod roads;
mod scenes;
mod variants;

use super::{CommonRoad, read};
use crate::scenario::Scenario;

/// A straight road of two lanes, 3.5 m wide and 200 m long, a parked car, and a task.
pub(super) const PLAIN: &str = r#"<?xml version='1.0' encoding='UTF-8'?>
<commonRoad commonRoadVersion="2020a" benchmarkID="ZAM_Plain-1_1_T-1" timeStepSize="0.1">
  <lanelet id="1">
    <leftBound><point><x>0</x><y>1.75</y></point><point><x>200</x><y>1.75</y></point></leftBound>
    <rightBound><point><x>0</x><y>-1.75</y></point><point><x>200</x><y>-1.75</y></point></rightBound>
    <adjacentLeft ref="2" drivingDir="same"/>
  </lanelet>
  <lanelet id="2">
    <leftBound><point><x>0</x><y>5.25</y></point><point><x>200</x><y>5.25</y></point></leftBound>
    <rightBound><point><x>0</x><y>1.75</y></point><point><x>200</x><y>1.75</y></point></rightBound>
    <adjacentRight ref="1" drivingDir="same"/>
  </lanelet>
  <staticObstacle id="7"><type>parkedVehicle</type>
    <shape><rectangle><length>4.5</length><width>1.8</width></rectangle></shape>
    <initialState><position><point><x>150</x><y>3.5</y></point></position>
      <orientation><exact>0</exact></orientation><time><exact>0</exact></time></initialState>
  </staticObstacle>
  <planningProblem id="100">
    <initialState><position><point><x>20</x><y>0</y></point></position><orientation><exact>0</exact></orientation>
      <time><exact>0</exact></time><velocity><exact>10</exact></velocity></initialState>
    <goalState><position><lanelet ref="1"/></position>
      <time><intervalStart>30</intervalStart><intervalEnd>40</intervalEnd></time></goalState>
  </planningProblem>
</commonRoad>"#;

/// The plain file with `this` replaced by `that`.
fn plain_but(this: &str, that: &str) -> String {
    assert!(PLAIN.contains(this), "`{this}` is not in the file");
    PLAIN.replacen(this, that, 1)
}

/// The plain file with more elements.
fn plain_and(elements: &str) -> String {
    plain_but("<planningProblem", &format!("{elements}<planningProblem"))
}

fn imported(text: &str) -> CommonRoad {
    read(text).unwrap_or_else(|error| panic!("{error}"))
}

fn scene(text: &str) -> (Scenario, Vec<String>) {
    super::scenario(text, None).unwrap_or_else(|error| panic!("{error}"))
}

/// A moving obstacle on states `(step, x, y)` that start at step 0.
fn moving(id: u32, states: &[(u32, f64, f64)]) -> String {
    let state = |name: &str, (step, x, y): &(u32, f64, f64)| {
        format!(
            "<{name}><position><point><x>{x}</x><y>{y}</y></point></position><orientation><exact>0</exact>\
             </orientation><time><exact>{step}</exact></time><velocity><exact>10</exact></velocity></{name}>"
        )
    };
    let rest: String = states[1..].iter().map(|s| state("state", s)).collect();
    format!(
        "<dynamicObstacle id=\"{id}\"><type>car</type><shape><rectangle><length>4</length><width>2</width></rectangle>\
         </shape>{}<trajectory>{rest}</trajectory></dynamicObstacle>",
        state("initialState", &states[0])
    )
}
