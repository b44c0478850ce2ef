//! The drawing of an own map: well-formed, complete, the right way up, and small.

use super::*;
use corridor_scenarios::LoadedMap;

fn own(name: &str) -> LoadedMap {
    let maps = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios/maps");
    LoadedMap::open(&maps.join(name)).unwrap()
}

/// Corners of the `k`-th arrow of a drawing, cm.
fn arrow(svg: &str, k: usize) -> Vec<(i64, i64)> {
    let data = svg.split("class=\"arrow\" d=\"").nth(1).unwrap();
    let data = data.split('"').next().unwrap();
    let arrow = data.split('z').nth(k).unwrap().trim_start_matches('M');
    let numbers: Vec<i64> = arrow.split([' ', 'l']).map(|n| n.parse().unwrap()).collect();
    let mut at = (0, 0);
    let steps = numbers.chunks_exact(2);
    steps
        .map(|step| {
            at = (at.0 + step[0], at.1 + step[1]);
            at
        })
        .collect()
}

#[test]
fn every_lane_is_drawn_once_with_its_name() {
    for name in ["urban_parking.xodr", "highway_shoulder.xodr"] {
        let map = own(name).map;
        let svg = svg("a <map>", &map);
        assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
        assert!(svg.contains("<title>a &lt;map&gt;</title>"));
        for lane in map.lanes() {
            let title = format!("<title>{}: ", lane.name);
            assert_eq!(svg.matches(&title).count(), 1, "{title}");
        }
        assert_eq!(svg.matches("class=\"lane ").count(), map.lanes().len());
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
    }
}

#[test]
fn arrows_point_where_their_lanes_lead_with_y_up() {
    let map = own("rural_curves.xodr").map;
    let (low, high) = corners(map.lanes());
    let svg = svg("x", &map);
    // Arrows stand in the order of the surfaces, whose first is that of the first drivable lane.
    let first = map.lanes().iter().find(|lane| lane.kind.is_drivable()).unwrap();
    let count = (first.length() / 20.0).ceil();
    let at = first.at(first.length() * 0.5 / count);
    let corners = arrow(&svg, 0);
    let (tip, notch) = (corners[0], corners[2]);
    #[expect(clippy::cast_precision_loss, reason = "centimetres of a small map")]
    let metres = |(x, y): (i64, i64)| Vec2::new(low.x + x as f64 / 100.0, high.y - y as f64 / 100.0);
    let ahead = (metres(tip) - metres(notch)).normalize();
    let left = at.offset(1.0) - at.offset(0.0);
    assert!((ahead - Vec2::new(left.y, -left.x)).norm() < 0.02, "{ahead}");
    assert!((metres(tip) - at.offset(0.0)).norm() < 2.0);
}

#[test]
fn a_straight_edge_needs_two_points() {
    let paper = Paper::new(Vec2::zeros(), Vec2::new(100.0, 10.0), 100.0);
    let line: Vec<Vec2> = (0..200).map(|k| Vec2::new(f64::from(k) / 2.0, 10.0)).collect();
    assert_eq!(paper.thinned(&line), [(0, 0), (9950, 0)]);
    assert_eq!(path::data(&[(1, 2), (4, 1), (4, 1)]), "M1 2l3 -1");
    assert_eq!(path::data(&[(1, 2)]), "M1 2l0 0");
}
