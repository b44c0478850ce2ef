//! `corridor blame`.

use crate::program::{Folder, GOOD};

/// A car parked in the lane, seen on the other side of it.
const IN_THE_WAY: &str = "\n[[parked]]\nname = \"van\"\nahead = 40.0\nfrom = \"right_lane_line\"\nl = 0.6\n";

#[test]
fn a_pass_blames_nobody_and_a_failure_names_its_link() {
    let folder = Folder::new("blame");
    folder.put("good.toml", GOOD);
    let passed = folder.run(&["blame", "good.toml"]);
    assert_eq!(passed.code, Some(0), "{passed:?}");
    assert!(passed.out.contains("nothing to blame"), "{}", passed.out);

    folder.put(
        "van.toml",
        GOOD.replace("distance = 20.0", "distance = 80.0") + IN_THE_WAY,
    );
    let failed = folder.run(&["blame", "van.toml", "--set", "fault=mirrored"]);
    assert_eq!(failed.code, Some(1), "{failed:?}");
    for part in [
        "`van`, at fault",
        "avoidable until",
        "whose: bound",
        "with a perfect tracker",
    ] {
        assert!(failed.out.contains(part), "{part} is not in {}", failed.out);
    }
    let json = folder.run(&["blame", "van.toml", "--set", "fault=mirrored", "--json"]);
    assert!(json.out.contains("\"whose\": \"bound\""), "{}", json.out);
    folder.refuses(
        &["blame", "van.toml", "--set", "tracker=good"],
        &["unknown variant `good`"],
    );
}
