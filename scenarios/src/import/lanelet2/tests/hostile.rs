//! Bad input: an answer in time, with a place.

use super::{Osm, lines};
use crate::import::ImportError;
use crate::import::lanelet2::read;
use proptest::prelude::*;

fn refused(text: &str) -> String {
    read(text).unwrap_err().to_string()
}

#[test]
fn what_is_no_map_is_refused_with_its_place() {
    assert_eq!(refused("<osm/>"), "the map has no drivable lane");
    assert!(refused("").contains("not well-formed XML"));
    assert!(refused("<OpenDRIVE/>").contains("expected <osm>"));
    let message = refused("<osm>\n <node id='1.5'/></osm>");
    assert_eq!(
        message,
        "2:2: <node> has id=\"1.5\"; expected a whole number of at most 64 bits"
    );
    assert!(refused("<osm><way id='1'><nd/></way></osm>").contains("<nd> has no `ref`"));
    assert!(refused("<osm><way id='99999999999999999999'/></osm>").contains("at most 64 bits"));
}

#[test]
fn a_continent_is_too_large() {
    let osm = [(1, 0.0, 0.0), (2, 9e6, 0.0), (3, 0.0, -3.0), (4, 9e6, -3.0)]
        .iter()
        .fold(Osm::default(), |osm, (id, x, y)| osm.node(*id, *x, *y));
    let osm = osm
        .way(1, &[1, 2], &[])
        .way(2, &[3, 4], &[])
        .lanelet(5, 1, 2, &[]);
    assert!(matches!(read(&osm.text()), Err(ImportError::TooLarge { .. })));
}

#[test]
fn many_lanelets_between_the_same_nodes_have_few_links() {
    // A ring of two lanelets, drawn a thousand times.
    let osm = [
        (1, 0.0, 9.0),
        (2, 0.0, 6.0),
        (3, 0.0, -9.0),
        (4, 0.0, -6.0),
        (5, 9.0, 0.0),
        (6, 6.0, 0.0),
    ]
    .iter()
    .fold(Osm::default(), |osm, (id, x, y)| osm.node(*id, *x, *y));
    let mut osm = osm
        .way(1, &[2, 6, 4], &[])
        .way(2, &[1, 5, 3], &[])
        .way(3, &[4, 2], &[])
        .way(4, &[3, 1], &[]);
    for k in 0..1000 {
        osm = osm
            .lanelet(100 + 2 * k, 2, 1, &[])
            .lanelet(101 + 2 * k, 4, 3, &[]);
    }
    let map = osm.read().map;
    assert!(map.lanes().iter().all(|lane| lane.successors.len() <= 16));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Any numbers of nodes and any references: an answer.
    #[test]
    fn any_references_give_an_answer(
        nodes in prop::collection::vec((-50.0..50.0, -50.0..50.0), 1..8),
        ways in prop::collection::vec(prop::collection::vec(0i64..9, 0..5), 1..6),
        lanelets in prop::collection::vec((0i64..7, 0i64..7, any::<bool>()), 1..8),
    ) {
        let mut osm = Osm::default();
        for (id, (x, y)) in (0..).zip(&nodes) {
            osm = osm.node(id, *x, *y);
        }
        for (id, way) in (0..).zip(&ways) {
            osm = osm.way(id, way, &[]);
        }
        for (id, (left, right, both)) in (0..).zip(&lanelets) {
            osm = osm.lanelet(id, *left, *right, &[("one_way", if *both { "no" } else { "yes" })]);
        }
        let _ = read(&osm.text());
    }

    /// Any damage to a file: an answer.
    #[test]
    fn any_damage_gives_an_answer(from in 0usize..900, length in 0usize..40, put in "[<>='/a-z0-9 ]{0,12}") {
        let text = lines().lanelet(100, 1, 2, &[("speed_limit", "50")]).text();
        let (start, end) = (from.min(text.len()), (from + length).min(text.len()));
        let _ = read(&format!("{}{put}{}", &text[..start], &text[end..]));
    }
}
