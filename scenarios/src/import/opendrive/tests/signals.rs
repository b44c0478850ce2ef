//! Speed limit signs, and what is told of the others.

use super::{imported, lane, named, section, straight};
use crate::import::opendrive::OpenDriveImport;

fn with(kind: &str, signals: &str, inside: &str) -> OpenDriveImport {
    let right = lane(-1, "driving", 3.0, "") + &lane(-2, "driving", 3.0, inside);
    let lanes = section(0.0, &lane(1, "driving", 3.0, ""), "", &right);
    let text = straight(r#"id="1""#, kind, &lanes);
    imported(&text.replace("</road>", &format!("<signals>{signals}</signals></road>")))
}

fn sign(s: f64, kind: &str, value: &str, more: &str) -> String {
    format!(r#"<signal id="1" s="{s}" t="-4" dynamic="no" country="DE" type="{kind}" {value} {more}/>"#)
}

fn assert_limit(import: &OpenDriveImport, lane: &str, s: f64, expected: f64) {
    let is = named(&import.map, lane).at(s).speed_limit;
    let same = is.total_cmp(&expected).is_eq() || (is - expected).abs() < 1e-9;
    assert!(same, "{lane} at {s}: {is} is not {expected}");
}

#[test]
fn a_sign_rules_from_where_traffic_meets_it() {
    let none = f64::INFINITY;
    let both = with(
        "",
        &sign(40.0, "274", r#"value="36""#, r#"orientation="none""#),
        "",
    );
    for (lane, s, limit) in [
        ("1_0_-1", 39.0, none),
        ("1_0_-1", 41.0, 10.0),
        ("1_0_1", 59.0, none),
        ("1_0_1", 61.0, 10.0),
    ] {
        assert_limit(&both, lane, s, limit);
    }
    assert_eq!(both.warnings, Vec::<String>::new(), "the road has a limit");
    let signs = sign(40.0, "274", r#"value="36" unit="km/h""#, r#"orientation="+""#)
        + &sign(70.0, "278", "", r#"orientation="+""#)
        + &sign(80.0, "274", r#"value="15" unit="m/s""#, r#"orientation="-""#);
    let import = with("", &signs, "");
    for (lane, s, limit) in [
        ("1_0_-1", 30.0, none),
        ("1_0_-1", 50.0, 10.0),
        ("1_0_-1", 90.0, none),
        ("1_0_1", 10.0, none),
        ("1_0_1", 30.0, 15.0),
        ("1_0_1", 95.0, 15.0),
    ] {
        assert_limit(&import, lane, s, limit);
    }
}

#[test]
fn records_rule_over_signs() {
    let signs = sign(0.0, "274", r#"value="36""#, "");
    let typed = r#"<type s="0" type="town"/><type s="50" type="town"><speed max="20"/></type>"#;
    let import = with(typed, &signs, r#"<speed sOffset="0" max="no limit"/>"#);
    assert_limit(&import, "1_0_-1", 25.0, 10.0);
    assert_limit(&import, "1_0_-1", 75.0, 20.0);
    assert_limit(&import, "1_0_-2", 25.0, f64::INFINITY);
}

#[test]
fn a_sign_is_for_the_lanes_that_it_names() {
    let sign = r#"<signal id="1" s="0" t="0" country="de" type="274" value="36"><validity fromLane="-1" toLane="-2"/>
        </signal>"#;
    let import = with("", sign, "");
    assert_limit(&import, "1_0_-1", 50.0, 10.0);
    assert_limit(&import, "1_0_-2", 50.0, 10.0);
    assert_limit(&import, "1_0_1", 50.0, f64::INFINITY);
}

#[test]
fn what_is_not_obeyed_is_counted() {
    let signs = sign(1.0, "206", "", "")
        + &sign(1.0, "274", r#"value="-1""#, "")
        + &sign(1.0, "274", r#"value="NaN""#, "")
        + &sign(1.0, "274", r#"value="50" unit="furlong""#, "")
        + &sign(1.0, "274", r#"value="50""#, "").replace("s=\"1\"", "s=\"inf\"")
        + &sign(1.0, "274", r#"value="50""#, "").replace("DE", "FR")
        + &sign(1.0, "1000001", "", "").replace(r#"dynamic="no""#, r#"dynamic="yes""#)
        + r#"<signalReference s="0" t="0" id="9" orientation="+"/>"#;
    let import = with("", &signs, "");
    assert_limit(&import, "1_0_-1", 50.0, f64::INFINITY);
    for told in [
        "type=\"206\": a sign that is not a readable speed limit is not obeyed (6 of this kind",
        "type=\"1000001\": a signal that changes, such as a traffic light, is not obeyed",
        "a reference to a signal of another road is not followed",
    ] {
        assert!(
            import.warnings.iter().any(|w| w.contains(told)),
            "{told}: {:?}",
            import.warnings
        );
    }
}
