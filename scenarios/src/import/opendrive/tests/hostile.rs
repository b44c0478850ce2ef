//! Input that is wrong on purpose: a clear error, never a panic, never a hang.

use super::{file, lane, road, section, straight};
use crate::import::{ImportError, opendrive};
use crate::maps;
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

fn one_road() -> String {
    let driving = lane(-1, "driving", 3.0, "");
    file(&straight(r#"id="1""#, "", &section(0.0, "", "", &driving)))
}

fn message(text: &str) -> String {
    opendrive::read(text).expect_err("is wrong").to_string()
}

#[test]
fn what_is_not_a_map_says_so() {
    assert!(matches!(opendrive::read(""), Err(ImportError::Xml { .. })));
    assert!(message("<commonRoad/>").contains("<commonRoad> is the root of the file; expected <OpenDRIVE>"));
    assert!(message(&file("")).contains("<OpenDRIVE> has no <road>"));
    let pavement = file(&straight(
        r#"id="1""#,
        "",
        &section(0.0, "", "", &lane(-1, "sidewalk", 3.0, "")),
    ));
    assert!(message(&pavement).contains("no drivable lane"));
}

/// A road of which only the name is there costs itself and no more, its objects stay beside their own roads.
#[test]
fn hollow_roads_are_left_out_and_told() {
    let driving = lane(-1, "driving", 3.0, "");
    let whole = straight(
        r#"id="1""#,
        r#"<objects><object id="9" type="tree" s="5" t="9"/></objects>"#,
        &section(0.0, "", "", &driving),
    );
    for hollow in [
        r#"<road id="2" length="0" junction="-1"/>"#.to_owned(),
        straight(r#"id="2""#, "", ""),
        road(r#"id="2""#, "", "", &section(0.0, "", "", &driving)),
    ] {
        let read =
            opendrive::read(&file(&format!("{hollow}{whole}"))).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((read.map.lanes().len(), read.objects.len()), (1, 1), "{hollow}");
        assert!(
            read.warnings
                .iter()
                .any(|w| w.contains("without a course or without lanes")),
            "{:?}",
            read.warnings
        );
        assert!(message(&file(&hollow)).contains("expected"), "{hollow}");
    }
}

/// What is replaced, by what, and what the message must say.
#[test]
fn wrong_values_are_named_with_their_place() {
    let cases = [
        (
            r#"x="0""#,
            r#"x="NaN""#,
            r#"<geometry> has x="NaN"; expected a finite number"#,
        ),
        (r#"hdg="0""#, r#"hdg="inf""#, r#"has hdg="inf""#),
        (r#"hdg="0""#, "", "<geometry> has no `hdg`"),
        (r#"y="0""#, r#"y="1e300""#, "from the origin"),
        (
            r#"length="100""#,
            r#"length="-5""#,
            r#"has length="-5"; expected 0 to 100000 m"#,
        ),
        (r#"length="100""#, r#"length="1e12""#, "expected 0 to 100000 m"),
        ("<line/>", r#"<arc curvature="1e9"/>"#, "expected at most 100 1/m"),
        ("<line/>", "<arc/>", "<arc> has no `curvature`"),
        ("<line/>", "<wiggle/>", "<geometry> has no form"),
        (
            "<line/>",
            r#"<spiral curvStart="0" curvEnd="99"/>"#,
            "turns by 9900 rad",
        ),
        (
            r#"a="3""#,
            r#"a="wide""#,
            r#"<width> has a="wide"; expected a number"#,
        ),
        (r#"id="-1""#, r#"id="first""#, "expected a whole number"),
        (r#"id="-1""#, "", "<lane> has no `id`"),
        ("<road ", r#"<road rule="MIDDLE" "#, "expected RHT or LHT"),
        ("laneSection s", "laneSection t", "<laneSection> has no `s`"),
        (r#"a="3""#, r#"a="3e7""#, "larger than 5 million cross-sections"),
        (r#"a="3""#, r#"a="1e308""#, "larger than 5 million cross-sections"),
        ("</planView>", "</planView></road>", "not well-formed"),
    ];
    for (right, wrong, expected) in cases {
        let text = one_road();
        assert!(text.contains(right), "{right}");
        let message = message(&text.replace(right, wrong));
        assert!(message.contains(expected), "{wrong}: {message}");
        assert!(
            message.starts_with(|c: char| c.is_ascii_digit()),
            "has no place: {message}"
        );
    }
}

#[test]
fn a_torn_reference_line_is_refused_and_a_gap_is_told() {
    let torn = |y: f64| {
        let second =
            format!(r#"<geometry s="60" x="60" y="{y}" hdg="0" length="40"><line/></geometry></planView>"#);
        let text = one_road().replace("</planView>", &second);
        text.replacen(r#"hdg="0" length="100""#, r#"hdg="0" length="60""#, 1)
    };
    assert!(message(&torn(3.0)).contains("jumps by 3.00 m at s = 60.00; expected pieces that meet"));
    let warnings = opendrive::read(&torn(0.2)).unwrap().warnings;
    assert!(
        warnings.iter().any(|w| w.contains("gap in the reference line")),
        "{warnings:?}"
    );
}

#[test]
fn names_must_be_unique() {
    let text = one_road();
    let road = &text[text.find("<road").unwrap()..text.find("</OpenDRIVE>").unwrap()];
    assert!(message(&file(&road.repeat(2))).contains("is the second of id `1`"));
    let twice = section(0.0, "", "", &lane(-1, "driving", 3.0, "").repeat(2));
    assert!(message(&file(&straight(r#"id="1""#, "", &twice))).contains("two lanes of id -1"));
}

#[test]
fn spoilt_widths_are_survived() {
    let import = opendrive::read(&one_road().replace(r#"b="0""#, r#"b="NaN""#));
    assert!(
        matches!(import, Err(ImportError::Map(_))),
        "the only lane is left out"
    );
    let both =
        lane(-1, "driving", 3.0, "") + &lane(-2, "shoulder", 1.0, "").replace(r#"c="0""#, r#"c="-inf""#);
    let text = file(&straight(r#"id="1""#, "", &section(0.0, "", "", &both)));
    let warnings = opendrive::read(&text).unwrap().warnings;
    assert!(
        warnings.iter().any(|w| w.contains("not a number")),
        "{warnings:?}"
    );
}

/// Many long wide roads: each is believable, all together are not.
#[test]
fn a_map_too_large_for_the_memory_is_refused() {
    let long = |id: usize| {
        straight(
            &format!(r#"id="{id}""#),
            "",
            &section(0.0, "", "", &lane(-1, "driving", 3.0, "")),
        )
        .replace(r#"length="100""#, r#"length="100000""#)
    };
    let text: String = (0..40).map(long).collect();
    assert!(matches!(
        opendrive::read(&file(&text)),
        Err(ImportError::TooLarge { .. })
    ));
}

#[test]
fn element_soup_and_deep_nesting_are_no_trouble() {
    let depth = 20_000;
    let deep = file(&("<road>".repeat(depth) + &"</road>".repeat(depth)));
    assert!(message(&deep).contains("<road> has no `id`"));
    let soup = one_road().replace("<left>", "<left><road/><lane/><left/>");
    assert!(message(&soup).contains("<lane> has no `id`"));
}

#[test]
fn an_element_of_very_many_attributes_is_refused_at_once() {
    let attributes: Vec<String> = (0..100_000).map(|k| format!("a{k}='1'")).collect();
    let text = one_road().replace("<line/>", &format!("<line {}/>", attributes.join(" ")));
    assert!(message(&text).contains("more than 1000 attributes"));
}

#[test]
fn a_missing_file_is_named() {
    let error = opendrive::read_file("no/such.xodr".as_ref())
        .unwrap_err()
        .to_string();
    assert!(error.starts_with("no/such.xodr: cannot be read"), "{error}");
}

/// One road with an object of this text.
fn with_object(object: &str) -> String {
    one_road().replace("</road>", &format!("<objects>{object}</objects></road>"))
}

#[test]
fn objects_without_number_are_refused() {
    for repeat in [
        r#"s="0" length="100" distance="1e-9""#,
        r#"s="0" length="1e300" distance="1e-300""#,
        r#"s="0" length="100" distance="0.0003""#,
    ] {
        let object = format!(r#"<object id="1" type="tree" s="0" t="4"><repeat {repeat}/></object>"#);
        let refused = matches!(
            opendrive::read(&with_object(&object)),
            Err(ImportError::TooLarge { .. })
        );
        assert!(refused, "{repeat}");
    }
    // No length, so no copies but the first, however small the step.
    let object =
        r#"<object id="1" type="tree" s="0" t="4"><repeat s="5" length="0" distance="1e-300"/></object>"#;
    assert_eq!(opendrive::read(&with_object(object)).unwrap().objects.len(), 1);
}

#[test]
fn an_outline_of_a_million_corners_is_a_hull_and_copies_of_it_are_refused() {
    let corner = |k: u32| format!(r#"<cornerLocal u="{}" v="{}"/>"#, k % 1000, k / 1000);
    let corners: String = (0..1_000_000).map(corner).collect();
    let object = |repeat: &str| {
        with_object(&format!(
            r#"<object id="1" type="building" s="0" t="4">{repeat}<outline>{corners}</outline></object>"#
        ))
    };
    let objects = opendrive::read(&object("")).unwrap().objects;
    assert_eq!(objects[0].outline.vertices().len(), 4);
    let many = object(r#"<repeat s="0" length="100" distance="10"/>"#);
    assert!(matches!(
        opendrive::read(&many),
        Err(ImportError::TooLarge { .. })
    ));
}

/// Values that a number may be replaced by.
const EXTREMES: [&str; 10] = [
    "NaN", "-1", "1e9", "1e308", "0", "-0.0", "1e-9", "99999", "", "0x7",
];

/// A file cut short, with a digit changed, a piece written over another, or a value replaced.
fn damaged(original: &str, kind: usize, mut below: impl FnMut(usize) -> usize) -> Vec<u8> {
    const PATCH: usize = 20;
    let mut bytes = original.as_bytes().to_vec();
    match kind {
        0 => bytes.truncate(below(original.len())),
        1 => {
            let digits: Vec<usize> = (0..bytes.len()).filter(|&k| bytes[k].is_ascii_digit()).collect();
            bytes[digits[below(digits.len())]] = b"0123456789-.e"[below(13)];
        }
        2 => {
            let (from, to) = (below(bytes.len() - PATCH), below(bytes.len() - PATCH));
            bytes.copy_within(from..from + PATCH, to);
        }
        _ => {
            let values: Vec<usize> = original.match_indices("=\"").map(|(at, _)| at + 2).collect();
            let start = values[below(values.len())];
            let end = start + original[start..].find('"').unwrap_or(0);
            bytes.splice(start..end, EXTREMES[below(EXTREMES.len())].bytes());
        }
    }
    bytes
}

/// Our own maps, damaged. Whatever comes out, it comes out.
#[test]
fn damaged_maps_never_panic() {
    let mut random = Pcg64Mcg::seed_from_u64(20);
    let mut below = |limit: usize| usize::try_from(random.next_u64() % limit as u64).unwrap();
    let (mut read, mut refused) = (0, 0);
    for name in maps::names() {
        let original = maps::embedded(name).unwrap();
        for round in 0..100 {
            let bytes = damaged(original, round % 4, &mut below);
            match opendrive::read(&String::from_utf8_lossy(&bytes)) {
                Ok(_) => read += 1,
                Err(_) => refused += 1,
            }
        }
    }
    assert!(
        read > 100 && refused > 100,
        "the damage is not mixed: {read} read, {refused} refused"
    );
}
