//! Files as other programs write them: other versions, other words, parts left out or broken that the scene does not need.

use super::{PLAIN, imported, plain_and, plain_but, scene};
use crate::import::commonroad::data::Role;

/// Everything that other versions and programs add around the same road and task.
#[test]
fn what_other_programs_add_changes_nothing() {
    let (plain, _) = scene(PLAIN);
    let version = |from: &str| plain_but("commonRoadVersion=\"2020a\"", from);
    let texts = [
        version(
            "commonRoadVersion=\"2018b\" author=\"a\" affiliation=\"b\" source=\"c\" tags=\"urban\" date=\"2020-01-01\"",
        ),
        version("xmlns=\"http://www.commonroad.in.tum.de\" commonRoadVersion=\"2020a\""),
        version("commonRoadVersion=\"2017a\""),
        format!("\u{feff}{PLAIN}"),
        PLAIN.replace("<y>1.75</y>", "<y>\n 1.75 </y><z>0.3</z>"),
        PLAIN.replace(">200<", ">2e2<").replace(">0<", ">-0.0<"),
        plain_but(
            "<lanelet id=\"1\">",
            "<location><geoNameId>-999</geoNameId><gpsLatitude>999</gpsLatitude><gpsLongitude>999</gpsLongitude>\
             <environment><time>08:00</time><weather>sunny</weather></environment></location>\
             <scenarioTags><urban/><two_lane/></scenarioTags><lanelet id=\"1\">",
        ),
        plain_but(
            "<adjacentLeft ref=\"2\" drivingDir=\"same\"/>",
            "<adjacentLeft ref=\"2\" drivingDir=\"same\"/><stopLine><point><x>9</x><y>1</y></point><point><x>9</x>\
             <y>-1</y></point><lineMarking>solid</lineMarking><trafficSignRef ref=\"8\"/></stopLine>",
        ),
    ];
    for text in texts {
        let (other, _) = scene(&text);
        assert_eq!(other.map.lanes(), plain.map.lanes(), "{text}");
        assert_eq!(other.ego.pose, plain.ego.pose, "{text}");
        assert_eq!(other.obstacles.len(), plain.obstacles.len(), "{text}");
    }
}

/// A sign or a light that is broken costs itself and no more.
#[test]
fn broken_signs_lights_and_surroundings_are_left_out() {
    let texts = [
        "<trafficLight id=\"9\"><cycle><cycleElement><duration>10</duration></cycleElement></cycle></trafficLight>",
        "<trafficLight><cycle/></trafficLight>",
        "<trafficSign id=\"x\"><trafficSignElement/></trafficSign>",
        "<environmentObstacle id=\"7\"><type>building</type></environmentObstacle>",
    ];
    for text in texts {
        let read = imported(&plain_and(text));
        assert!(
            read.file.lights.is_empty() && read.file.signs.is_empty(),
            "{text}"
        );
        assert!(
            read.warnings.iter().any(|warning| warning.contains("left out")),
            "{:?}",
            read.warnings
        );
    }
}

/// In 2018b a role is a word, and files exist that use those of 2020a.
#[test]
fn surroundings_may_be_named_by_their_role() {
    let text = plain_and(
        "<obstacle id=\"8\"><role>environment</role><type>building</type><shape><circle><radius>2</radius></circle>\
         <polygon><point><x>9</x><y>9</y></point><point><x>12</x><y>9</y></point><point><x>9</x><y>12</y></point>\
         </polygon></shape></obstacle>",
    );
    let read = imported(&text);
    let last = read.file.obstacles.last().expect("an obstacle");
    assert_eq!((last.role, last.shape.len()), (Role::Environment, 2));
    assert_eq!(scene(&text).0.obstacles.len(), 3);
}

/// Starts and goals as intervals and shapes, and predictions without anything in them.
#[test]
fn uncertain_starts_and_empty_predictions_are_read() {
    let text = plain_but(
        "<initialState><position><point><x>20</x><y>0</y></point></position><orientation>",
        "<initialState><position><circle><radius>1</radius><center><x>20</x><y>0</y></center></circle></position>\
         <yawRate><exact>0</exact></yawRate><orientation>",
    );
    let (certain, uncertain) = (scene(PLAIN).0, scene(&text).0);
    assert!((certain.ego.pose.position() - uncertain.ego.pose.position()).norm() < 1e-9);
    for prediction in ["<trajectory/>", "<occupancySet/>", ""] {
        let text = plain_and(&format!(
            "<dynamicObstacle id=\"8\"><type>car</type><shape><rectangle><length>4</length><width>2</width></rectangle>\
             </shape><initialState><position><point><x>90</x><y>0</y></point></position><time><exact>0</exact></time>\
             </initialState><initialSignalState><time><exact>0</exact></time></initialSignalState>{prediction}\
             <signalSeries/></dynamicObstacle>"
        ));
        assert_eq!(scene(&text).0.obstacles.len(), 2, "{prediction}");
    }
}
