//! Every mistake in a file ends in a message with the file, the place, what is wrong and what would be right.

use crate::road::try_family;
use corridor_scenarios::{Family, ScenarioError};
use std::path::Path;

/// The message for a file of which `try_family` writes the first line.
fn message(text: &str) -> String {
    match try_family(text) {
        Ok(_) => panic!("accepted: {text}"),
        Err(error) => error.to_string(),
    }
}

/// Checks the place, counted in `text` (its first line is line 2 of the file), and parts of the message.
fn expect(text: &str, place: &str, parts: &[&str]) {
    let message = message(text);
    let wanted = format!("test.toml:{place}: ");
    assert!(message.starts_with(&wanted), "wanted {wanted} but got {message}");
    for part in parts {
        assert!(message.contains(part), "wanted `{part}` in {message}");
    }
}

#[test]
fn the_whole_message_of_a_negative_speed() {
    let text = "map='street'\n[[moving]]\nahead=20\nspeed = -3";
    let expected = "test.toml:5:9: `-3` does not fit: expected a speed in m/s from 0 to 70\n  \
                    |\n5 | speed = -3\n  |         ^^";
    assert_eq!(message(text), expected);
}

#[test]
fn unknown_keys_name_the_known_ones() {
    expect(
        "map='street'\n[ego]\nspede=3",
        "4:1",
        &["unknown field `spede`", "`speed`", "`heading`"],
    );
    expect(
        "map='street'\n[[parked]]\nahed=3",
        "4:1",
        &["unknown field `ahed`", "`ahead`", "`spacing`"],
    );
    expect(
        "map='street'\n[[boats]]\nahead=3",
        "3:3",
        &["unknown field `boats`", "`parked`", "`pedestrian`"],
    );
    expect(
        "map='street'\ncruise_speed={ gauss=[1,2] }",
        "3:14",
        &["unknown field `gauss`", "`uniform`", "`normal`"],
    );
}

#[test]
fn wrong_types_and_missing_keys_say_what_is_expected() {
    expect(
        "map='street'\ncruise_speed='fast'",
        "3:14",
        &["string \"fast\"", "expected a speed in m/s or a law"],
    );
    expect(
        "map='street'\ncruise_speed=true",
        "3:14",
        &["boolean `true`", "expected a speed"],
    );
    expect("map='street'\n[[parked]]\nl=3", "3:1", &["missing field `ahead`"]);
    expect(
        "map='street'\n[[parked]]\nahead=3\nkind='tank'",
        "5:6",
        &["unknown variant `tank`", "`truck`"],
    );
    expect(
        "map='street'\n[command]\nkind='fly'",
        "4:6",
        &["unknown variant `fly`", "`pull_over`"],
    );
    let empty = Family::parse("", "empty.toml", Path::new(""))
        .unwrap_err()
        .to_string();
    assert!(
        empty.starts_with("empty.toml:1:1: missing field `description`"),
        "{empty}"
    );
}

#[test]
fn numbers_out_of_range_are_pointed_at() {
    for (value, place) in [
        ("nan", "5:8"),
        ("inf", "5:8"),
        ("-inf", "5:8"),
        ("0", "5:8"),
        ("-2.5", "5:8"),
        ("1e9", "5:8"),
    ] {
        let text = format!("map='street'\n[[parked]]\nahead=30\nlength={value}");
        expect(
            &text,
            place,
            &["does not fit: expected a size in metres from 0.05 to 50"],
        );
    }
    expect(
        "map='street'\n[[parked]]\nahead=30\ncount=2.5",
        "5:7",
        &["`2.5`", "a whole number from 1 to 200"],
    );
    expect(
        "map='street'\n[[parked]]\nahead={uniform=[1,inf]}",
        "4:19",
        &["`inf`", "metres"],
    );
    expect(
        "map='street'\ntimeout=4000",
        "3:9",
        &["`4000`", "a time in s from 0 to 3600"],
    );
}

#[test]
fn laws_must_be_whole_and_ascending() {
    expect(
        "map='street'\ncruise_speed={uniform=[9,2]}",
        "3:23",
        &["`9` to `2` is no range", "smaller one first"],
    );
    expect("map='street'\ncruise_speed={uniform=[9]}", "3:23", &["length 1"]);
    expect(
        "map='street'\ncruise_speed={normal=[8,1]}",
        "3:14",
        &["`clamp = [2, 8]`"],
    );
    expect(
        "map='street'\ncruise_speed={normal=[8,-1],clamp=[1,9]}",
        "3:22",
        &["the second not negative"],
    );
    expect(
        "map='street'\ncruise_speed={normal=[8,1],clamp=[-1,9]}",
        "3:35",
        &["`-1`"],
    );
    expect(
        "map='street'\ncruise_speed={choice=[]}",
        "3:22",
        &["at least one number"],
    );
    expect(
        "map='street'\ncruise_speed={uniform=[1,2],choice=[3]}",
        "3:14",
        &["one law only"],
    );
    expect("map='street'\ncruise_speed={}", "3:14", &["a law is missing"]);
}

#[test]
fn keys_that_do_not_go_together_are_refused() {
    expect(
        "map='street'\n[command]\nkind='pull_over'",
        "3:1",
        &["`pull_over` needs `ahead`"],
    );
    expect(
        "map='street'\n[command]\nkind='change_lane'",
        "3:1",
        &["`change_lane` needs `side"],
    );
    expect(
        "map='street'\n[command]\nkind='cruise'\nahead=3",
        "3:1",
        &["`ahead` belongs to `pull_over`"],
    );
    expect(
        "map='street'\n[expect]\noutcome='refusal'\ndistance=3",
        "3:1",
        &["`distance` belongs to"],
    );
    expect(
        "map='street'\n[[parked]]\nahead=9\npolygon=[[0,0],[1,1]]",
        "5:9",
        &["span no area"],
    );
    expect(
        "map='street'\n[[parked]]\nahead=9\npolygon=[[0,0],[2,0],[1,0.5],[2,2]]",
        "5:9",
        &["not convex"],
    );
}

#[test]
fn maps_and_lanes_that_are_not_there_are_named() {
    expect("map='atlantis'", "2:5", &["no map `atlantis`", "`.xodr`"]);
    expect(
        "map='no/such.xodr'",
        "2:5",
        &["`no/such.xodr` does not exist", "relative to the scenario file"],
    );
    expect(
        "map='street'\n[ego]\nlane='own_x'",
        "4:6",
        &["no lane `own_x`", "`own_a`", "`oncoming_c`"],
    );
    expect(
        "map='street'\n[ego]\nlane='bays'",
        "4:6",
        &["`bays` is not for driving"],
    );
    expect(
        "map='street'\nroute=['own_a','own_c']",
        "3:16",
        &["does not follow `own_a`: expected `own_b`"],
    );
    expect(
        "map='street'\nroute=['own_a']\n[ego]\nlane='own_b'",
        "5:6",
        &["does not start in the ego's lane"],
    );
    assert!(matches!(
        try_family("map='atlantis'"),
        Err(ScenarioError::MapNotFound { .. })
    ));
}

#[test]
fn text_that_is_no_toml_and_files_that_are_not_there() {
    expect("map=", "2:5", &["expected"]);
    expect("map='street'\nname='a'\nname='b'", "4:1", &["duplicate key"]);
    let missing = Family::load(Path::new("no/such/file.toml"))
        .unwrap_err()
        .to_string();
    assert!(
        missing.starts_with("cannot read scenario `no/such/file.toml`: "),
        "{missing}"
    );
}

/// Whatever bytes a file holds, reading it ends with a value or a message, never with a panic.
#[test]
fn broken_copies_of_a_good_file_never_panic() {
    let good = "map='street'\ncruise_speed={normal=[8,1],clamp=[1,9]}\n[command]\nkind='pull_over'\nahead=80\n\
                [[parked]]\nahead=50\ncount={uniform=[1,3]}\npolygon=[[-1,-1],[1,-1],[0,1]]\n# äöü\n";
    for at in 0..good.len() {
        if !good.is_char_boundary(at) {
            continue;
        }
        let _ = try_family(&good[..at]).map_err(|e| e.to_string());
        for put in ["", "ß", "[", "-", "9", "{", "'"] {
            let next = at + good[at..].chars().next().map_or(0, char::len_utf8);
            let _ = try_family(&format!("{}{put}{}", &good[..at], &good[next..])).map_err(|e| e.to_string());
        }
    }
}
