//! The page stands alone, whatever a scenario is called.

mod lattice;

use super::{fill, page};
use crate::trace::synthetic;

/// The JSON in the page.
fn data(html: &str) -> serde_json::Value {
    let start = html
        .find("<script type=\"application/json\" id=\"data\">")
        .unwrap();
    let json = &html[start..];
    let json = &json[json.find('>').unwrap() + 1..json.find("</script>").unwrap()];
    serde_json::from_str(json).unwrap()
}

#[test]
fn the_page_stands_alone() {
    let html = page(&synthetic::trace(30, 5));
    for foreign in [
        "http://", "https://", "src=", "href=", "@import", "url(", "fetch(", "{{",
    ] {
        assert!(!html.contains(foreign), "the page contains `{foreign}`");
    }
    assert!(html.starts_with("<!doctype html>") && html.trim_end().ends_with("</html>"));
}

#[test]
fn no_text_of_a_run_can_break_out() {
    let trace = synthetic::trace(12, 5);
    assert!(trace.header.source.contains("</script>") && trace.header.scenario.contains("<script>"));
    let html = page(&trace);
    let scripts = html.matches("<script").count();
    assert_eq!(
        (scripts, html.matches("</script>").count()),
        (2, 2),
        "ours, and no more"
    );
    assert!(html.contains("<title>synthetic &lt;b&gt;&amp; &lt;/script&gt;"));
    let data = data(&html);
    assert_eq!(data["source"], trace.header.source);
    assert_eq!(data["names"][2], "someone </script> on foot");
    assert_eq!(data["verdict"]["summary"], trace.verdict.unwrap().summary);
}

#[test]
fn every_reference_in_the_data_leads_somewhere() {
    let data = data(&page(&synthetic::trace(120, 6)));
    let length = |name: &str| data[name].as_array().unwrap().len() as u64;
    let place = |value: &serde_json::Value| value.as_u64().unwrap();
    assert_eq!(length("ticks"), 120);
    for tick in data["ticks"].as_array().unwrap() {
        assert!(place(&tick["line"]) < length("lines"));
        assert!(place(&tick["command"]) < length("texts"));
        let obstacles = tick["obstacles"].as_array().unwrap();
        assert_eq!(obstacles.len(), 6);
        assert!(obstacles.iter().all(|o| place(o) < length("obstacles")));
        for candidate in tick["candidates"].as_array().unwrap() {
            assert!(place(&candidate["label"]) < length("labels"));
            assert!(place(&candidate["text"]) < length("texts"));
        }
    }
    for series in ["speed", "jerk", "clearance", "tracking", "speed_limit"] {
        assert_eq!(data["series"][series].as_array().unwrap().len(), 120, "{series}");
    }
}

#[test]
fn a_stop_lies_on_the_path() {
    let data = data(&page(&synthetic::trace(200, 4)));
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    let mut stops = 0;
    for tick in data["ticks"].as_array().unwrap() {
        let path: Vec<f64> = tick["path"].as_array().unwrap().iter().map(number).collect();
        let Some(stop) = tick["stop_at"].as_array() else {
            continue;
        };
        let [_, s, l, x, y, _] = [0, 1, 2, 3, 4, 5].map(|k| number(&stop[k]));
        let Some(k) = (4..path.len()).step_by(4).find(|k| path[*k] >= s) else {
            continue;
        };
        stops += 1;
        let share = (s - path[k - 4]) / (path[k] - path[k - 4]);
        for (row, value) in [(1, l), (2, x), (3, y)] {
            let on_path = path[k - 4 + row] + share * (path[k + row] - path[k - 4 + row]);
            // The page's path is thinned to four millimetres.
            assert!((on_path - value).abs() < 0.02, "row {row}: {on_path} or {value}");
        }
    }
    assert!(stops > 20, "{stops} stops seen");
}

#[test]
fn parked_cars_are_written_once() {
    let few = data(&page(&synthetic::trace(100, 20)));
    let obstacles = few["obstacles"].as_array().unwrap();
    assert_eq!(
        obstacles.len(),
        19 + 100,
        "19 that stand and one that moves in 100 ticks"
    );
}

#[test]
fn a_run_without_ticks_or_with_numbers_that_are_none_is_shown_too() {
    let mut trace = synthetic::trace(3, 3);
    trace.ticks[1].decision.path[3].l = f64::NAN;
    trace.ticks[1].decision.candidates[0].bound.points[3].l_max = f64::NAN;
    trace.ticks[1].decision.candidates[1].bound.points[3].l_min = f64::MIN;
    trace.ticks[2].decision.candidates[1].bound.points.clear();
    assert_eq!(data(&page(&trace))["ticks"].as_array().unwrap().len(), 3);
    trace.ticks.clear();
    trace.verdict = None;
    assert!(data(&page(&trace))["ticks"].as_array().unwrap().is_empty());
}

#[test]
fn what_is_filled_in_is_not_filled_again() {
    let filled = fill("a {{x}} b {{y}} {{x}}", &[("{{x}}", "{{y}}"), ("{{y}}", "2")]);
    assert_eq!(filled, "a {{y}} b 2 {{y}}");
}

/// Writes a page to look at, where `CORRIDOR_PAGE` says.
#[test]
#[ignore = "for looking at: set CORRIDOR_PAGE to a file name"]
fn a_page_to_look_at() {
    let path = std::env::var("CORRIDOR_PAGE").unwrap();
    std::fs::write(path, page(&synthetic::trace(230, 20))).unwrap();
}

/// Writes pages at the edge of what there is, where `CORRIDOR_PAGE` says.
#[test]
#[ignore = "for looking at: set CORRIDOR_PAGE to a file name"]
fn an_empty_page_to_look_at() {
    let mut trace = synthetic::trace(1, 3);
    let path = std::env::var("CORRIDOR_PAGE").unwrap();
    std::fs::write(format!("{path}.one.html"), page(&trace)).unwrap();
    trace.ticks.clear();
    trace.verdict = None;
    trace.truncated = true;
    std::fs::write(format!("{path}.none.html"), page(&trace)).unwrap();
}
