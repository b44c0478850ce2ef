//! The header: an offset of the whole file, and the text about the earth.

use super::{imported, lane, named, road, section};
use corridor_decider::geometry::Pose;

const PIECE: &str =
    r#"<geometry s="0" x="10" y="-20" hdg="0.5" length="100"><arc curvature="0.01"/></geometry>"#;

fn body(header: &str) -> String {
    let lanes = section(
        0.0,
        &lane(1, "driving", 3.0, ""),
        "",
        &lane(-1, "driving", 3.0, ""),
    );
    let objects = r#"<objects><object id="7" type="pole" s="20" t="4"/></objects></road>"#;
    header.to_owned() + &road(r#"id="1""#, "", PIECE, &lanes).replace("</road>", objects)
}

#[test]
fn an_offset_moves_lanes_and_objects_as_one() {
    let plain = imported(&body(""));
    let offset = r#"<header><offset x="1000" y="-500" z="7" hdg="0.3"/></header>"#;
    let moved = imported(&body(offset));
    let by = Pose::new(1000.0, -500.0, 0.3);
    for name in ["1_0_1", "1_0_-1"] {
        for (a, b) in named(&plain.map, name)
            .points
            .iter()
            .zip(&named(&moved.map, name).points)
        {
            let expected = by.to_world(corridor_decider::geometry::Vec2::new(a.x, a.y));
            assert!((b.x - expected.x).abs() < 1e-9 && (b.y - expected.y).abs() < 1e-9);
            assert!((b.theta - a.theta - 0.3).abs() < 1e-9 || (b.theta - a.theta - 0.3).abs() > 6.0);
            assert!((b.kappa - a.kappa).abs() < 1e-12 && (b.s - a.s).abs() < 1e-9);
        }
    }
    let expected = by.to_world(plain.objects[0].pose.position());
    assert!((moved.objects[0].pose.position() - expected).norm() < 1e-9);
}

#[test]
fn the_reference_to_the_earth_is_kept_as_text() {
    let header = "<header><geoReference>\n <![CDATA[\n +proj=utm +zone=32 ]]></geoReference></header>";
    assert_eq!(
        imported(&body(header)).geo_reference.as_deref(),
        Some("+proj=utm +zone=32")
    );
    assert_eq!(imported(&body("<header/>")).geo_reference, None);
    assert_eq!(imported(&body("")).geo_reference, None);
}
