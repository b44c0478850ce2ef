//! A map in the mirror is the map of a country that drives on the other side.

use crate::import::opendrive;
use crate::maps;
use corridor_decider::geometry::angle;
use corridor_decider::road::{Lane, LaneId, Mark, Neighbour, RoadMap, Side};
use roxmltree::{Document, Node};
use std::fmt::Write as _;

/// The elements and attributes that change their sign when `y` does.
const NEGATED: [(&str, &[&str]); 9] = [
    ("geometry", &["y", "hdg"]),
    ("arc", &["curvature"]),
    ("spiral", &["curvStart", "curvEnd"]),
    ("paramPoly3", &["aV", "bV", "cV", "dV"]),
    ("laneOffset", &["a", "b", "c", "d"]),
    ("lane", &["id"]),
    ("laneLink", &["from", "to"]),
    ("predecessor", &["id"]),
    ("successor", &["id"]),
];

/// The file with `y` turned round, driven on the left.
fn mirrored(node: Node<'_, '_>, out: &mut String) {
    let name = match node.tag_name().name() {
        "left" => "right",
        "right" => "left",
        name => name,
    };
    let negated = NEGATED
        .iter()
        .find(|(element, _)| *element == name)
        .map_or(&[][..], |(_, list)| list);
    write!(out, "<{name}").unwrap();
    for attribute in node.attributes() {
        let value = attribute.value();
        let value = match attribute.name() {
            "rule" => "LHT".to_owned(),
            name if negated.contains(&name) => value
                .strip_prefix('-')
                .map_or_else(|| format!("-{value}"), str::to_owned),
            _ => value.to_owned(),
        };
        write!(out, " {}=\"{value}\"", attribute.name()).unwrap();
    }
    if name == "road" && node.attribute("rule").is_none() {
        out.push_str(" rule=\"LHT\"");
    }
    out.push('>');
    node.children()
        .filter(Node::is_element)
        .for_each(|child| mirrored(child, out));
    write!(out, "</{name}>").unwrap();
}

/// The name of a lane in the mirror.
fn name(lane: &str) -> String {
    let (section, id) = lane.rsplit_once('_').unwrap();
    format!("{section}_{}", -id.parse::<i32>().unwrap())
}

fn names(map: &RoadMap, lanes: impl IntoIterator<Item = LaneId>) -> Vec<String> {
    let mut names: Vec<String> = lanes.into_iter().map(|id| map.lane(id).name.clone()).collect();
    names.sort_unstable();
    names
}

fn assert_near(what: &str, is: f64, expected: f64) {
    let same = is.total_cmp(&expected).is_eq() || (is - expected).abs() < 1e-9;
    assert!(same, "{what}: {is} is not {expected}");
}

fn assert_same_marks(what: &str, a: &[Mark], b: &[Mark]) {
    assert_eq!(a.len(), b.len(), "{what}");
    for (a, b) in a.iter().zip(b) {
        assert_near(what, a.s, b.s);
        assert_eq!(a.kind, b.kind, "{what}");
    }
}

fn assert_mirrored(a: &Lane, b: &Lane) {
    assert_eq!((a.kind, a.points.len()), (b.kind, b.points.len()), "{}", a.name);
    for (p, q) in a.points.iter().zip(&b.points) {
        assert_near("theta", angle::wrap(q.theta + p.theta), 0.0);
        for (is, expected) in [
            (q.s, p.s),
            (q.x, p.x),
            (q.y, -p.y),
            (q.kappa, -p.kappa),
            (q.left, p.right),
            (q.right, p.left),
            (q.road_left, p.road_right),
            (q.road_right, p.road_left),
            (q.speed_limit, p.speed_limit),
        ] {
            assert_near(&a.name, is, expected);
        }
    }
    assert_same_marks(&a.name, &a.left_marks, &b.right_marks);
    assert_same_marks(&a.name, &a.right_marks, &b.left_marks);
}

#[test]
fn own_maps_in_the_mirror_are_driven_on_the_left() {
    for map_name in maps::names() {
        let text = maps::embedded(map_name).unwrap();
        let mut other = String::new();
        mirrored(Document::parse(text).unwrap().root_element(), &mut other);
        let original = opendrive::read(text).unwrap().map;
        let import = opendrive::read(&other).unwrap();
        assert_eq!(import.warnings, Vec::<String>::new(), "{map_name}");
        let mirror = import.map;
        assert_eq!(original.lanes().len(), mirror.lanes().len());
        for a in original.lanes() {
            let b = mirror.lane(mirror.find(&name(&a.name)).unwrap());
            assert_mirrored(a, b);
            let told = |lanes: &[LaneId]| -> Vec<String> {
                let mut names: Vec<String> = names(&original, lanes.iter().copied())
                    .iter()
                    .map(|n| name(n))
                    .collect();
                names.sort_unstable();
                names
            };
            assert_eq!(
                told(&a.successors),
                names(&mirror, b.successors.iter().copied()),
                "{}",
                a.name
            );
            assert_eq!(
                told(&a.predecessors),
                names(&mirror, b.predecessors.iter().copied()),
                "{}",
                a.name
            );
            for (side, reverse) in [Side::Left, Side::Right]
                .into_iter()
                .flat_map(|s| [(s, false), (s, true)])
            {
                let here = a.neighbour(Neighbour { side, reverse });
                let there = b.neighbour(Neighbour {
                    side: side.opposite(),
                    reverse,
                });
                assert_eq!(
                    here.map(|id| name(&original.lane(id).name)),
                    there.map(|id| mirror.lane(id).name.clone())
                );
            }
        }
    }
}
