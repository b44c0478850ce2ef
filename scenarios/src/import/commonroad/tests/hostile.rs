//! Input that is wrong on purpose: a clear error, never a panic, never a hang.

use super::{PLAIN, moving, plain_and, plain_but};
use crate::import::ImportError;
use crate::import::commonroad;
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

fn message(text: &str) -> String {
    commonroad::scenario(text, None)
        .expect_err("is wrong")
        .to_string()
}

#[test]
fn what_is_not_a_scene_says_so() {
    assert!(matches!(commonroad::read(""), Err(ImportError::Xml { .. })));
    assert!(message("<OpenDRIVE/>").contains("is the root of the file; expected <commonRoad>"));
    assert!(message("<commonRoad/>").contains("<commonRoad> has no `timeStepSize`"));
    assert!(message("<commonRoad timeStepSize='0.1'/>").contains("has no <lanelet>"));
    assert!(message(&plain_but("\"0.1\"", "\"0\"")).contains("has timeStepSize=\"0\"; expected seconds"));
}

/// What is replaced, by what, and what the message must say.
#[test]
fn wrong_values_are_named_with_their_place() {
    let cases = [
        ("<x>20</x>", "<x>NaN</x>", "<x> is `NaN`; expected a number"),
        ("<x>20</x>", "<x>1e300</x>", "<x> is `1e300`"),
        ("<x>20</x>", "", "<point> has no <x> inside"),
        (
            "<lanelet id=\"2\">",
            "<lanelet id=\"1\">",
            "<lanelet> is the second of id `1`",
        ),
        (
            "<lanelet id=\"2\">",
            "<lanelet id=\"two\">",
            "has id=\"two\"; expected a whole number",
        ),
        ("<lanelet id=\"2\">", "<lanelet>", "<lanelet> has no `id`"),
        (
            "drivingDir=\"same\"",
            "drivingDir=\"up\"",
            "has drivingDir=\"up\"; expected same or opposite",
        ),
        (
            "<length>4.5</length>",
            "<length>-1</length>",
            "<length> is `-1`; expected a positive number",
        ),
        (
            "<intervalStart>30<",
            "<intervalStart>50<",
            "<time> goes from 50 to 40",
        ),
        (
            "<time><exact>0</exact></time><velocity>",
            "<velocity>",
            "<initialState> has no <time> inside",
        ),
        ("<goalState>", "<noGoal>", "not well-formed XML"),
        (
            "<position><lanelet ref=\"1\"/></position>",
            "<position/>",
            "<position> has no shape inside",
        ),
    ];
    for (this, that, expected) in cases {
        let message = message(&plain_but(this, that));
        assert!(message.contains(expected), "{this} -> {that}: {message}");
        let place = message.split(':').next().unwrap_or_default();
        assert!(place.parse::<u32>().is_ok(), "no place: {message}");
    }
}

#[test]
fn extreme_but_lawful_values_come_to_an_end() {
    let huge = plain_but("<intervalEnd>40</intervalEnd>", "<intervalEnd>1e8</intervalEnd>");
    let (scenario, warnings) = commonroad::scenario(&huge, None).unwrap();
    assert!(
        scenario.timeout <= 600.0 && warnings.iter().any(|w| w.contains("cut off")),
        "{warnings:?}"
    );
    let long = plain_but("<x>200</x><y>1.75</y>", "<x>1e8</x><y>1.75</y>");
    // Either refused as too large or read; what counts is that it ends.
    let _ = commonroad::scenario(&long, None);
    let far = plain_and(&moving(9, &[(0, 1e8, -1e8), (1, -1e8, 1e8)]));
    assert!(commonroad::scenario(&far, None).is_ok());
    let ring = plain_but(
        "<adjacentRight",
        "<successor ref=\"2\"/><predecessor ref=\"2\"/><adjacentRight",
    );
    assert!(commonroad::scenario(&ring, None).is_ok());
}

#[test]
fn a_goal_that_cannot_be_reached_is_told_and_driven_straight_on() {
    let (scenario, warnings) =
        commonroad::scenario(&plain_but("<lanelet ref=\"1\"/>", "<lanelet ref=\"9\"/>"), None).unwrap();
    assert!(
        warnings.iter().any(|w| w.contains("no way leads to the goal")),
        "{warnings:?}"
    );
    assert!(
        warnings
            .iter()
            .any(|w| w.contains("a lanelet that does not exist")),
        "{warnings:?}"
    );
    let region = scenario.expect.goal_region().unwrap();
    assert!(
        !region.is_met(3.5, scenario.ego.pose, 10.0),
        "nowhere is not anywhere"
    );
}

/// Bytes changed, cut and doubled at random: any answer will do, as long as there is one.
#[test]
fn broken_files_never_panic() {
    let whole = plain_and(&moving(9, &[(0, 50.0, 3.5), (1, 51.0, 3.5)]));
    let mut random = Pcg64Mcg::seed_from_u64(20);
    let mut readable = 0;
    for _ in 0..600 {
        let mut bytes = whole.clone().into_bytes();
        for _ in 0..=random.next_u32() % 4 {
            let at = random.next_u32() as usize % bytes.len();
            match random.next_u32() % 4 {
                0 => bytes[at] = b"0123456789-<>/e."[random.next_u32() as usize % 16],
                1 => bytes.truncate(at.max(1)),
                2 => drop(bytes.remove(at)),
                _ => bytes.insert(at, b"0189-.e<"[random.next_u32() as usize % 8]),
            }
        }
        let text = String::from_utf8_lossy(&bytes);
        readable += u32::from(commonroad::scenario(&text, None).is_ok());
    }
    assert!(
        readable > 10,
        "only {readable} were readable: the damage is too great to test anything"
    );
    assert!(commonroad::scenario(PLAIN, None).is_ok());
}
