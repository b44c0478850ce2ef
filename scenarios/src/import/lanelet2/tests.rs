//! Small files, written by hand: what their tags and shared ways become, and what is survived.

mod hostile;
mod tags;
mod topology;

use super::{Lanelet2Import, read};
use corridor_decider::road::{Lane, RoadMap};
use std::fmt::Write;

/// Text of a file, element by element.
#[derive(Clone, Default)]
struct Osm {
    elements: Vec<String>,
}

fn tags(list: &[(&str, &str)]) -> String {
    list.iter().fold(String::new(), |mut text, (key, value)| {
        write!(text, "<tag k='{key}' v='{value}'/>").unwrap();
        text
    })
}

impl Osm {
    /// A node with coordinates of the file's own.
    fn node(mut self, id: i64, x: f64, y: f64) -> Self {
        let tags = tags(&[("local_x", &x.to_string()), ("local_y", &y.to_string())]);
        self.elements
            .push(format!("<node id='{id}' lat='' lon=''>{tags}</node>"));
        self
    }

    fn way(mut self, id: i64, nodes: &[i64], list: &[(&str, &str)]) -> Self {
        let refs = nodes.iter().fold(String::new(), |mut text, node| {
            write!(text, "<nd ref='{node}'/>").unwrap();
            text
        });
        self.elements
            .push(format!("<way id='{id}'>{refs}{}</way>", tags(list)));
        self
    }

    /// A lanelet with more tags than its type.
    fn lanelet(self, id: i64, left: i64, right: i64, list: &[(&str, &str)]) -> Self {
        let list = [&[("type", "lanelet")], list].concat();
        self.relation(id, &[("way", left, "left"), ("way", right, "right")], &list)
    }

    fn relation(mut self, id: i64, members: &[(&str, i64, &str)], list: &[(&str, &str)]) -> Self {
        let members = members.iter().fold(String::new(), |mut text, (kind, id, role)| {
            write!(text, "<member type='{kind}' ref='{id}' role='{role}'/>").unwrap();
            text
        });
        self.elements
            .push(format!("<relation id='{id}'>{members}{}</relation>", tags(list)));
        self
    }

    fn text(&self) -> String {
        format!(
            "<?xml version='1.0'?>\n<osm>\n{}\n</osm>",
            self.elements.join("\n")
        )
    }

    fn read(&self) -> Lanelet2Import {
        read(&self.text()).unwrap()
    }
}

/// Four lines along x, 40 m long: ways 1 to 4 at y = 9, 6, 3 and 0, each with nodes 10 k to 10 k + 2 at x = 0, 20 and
/// 40. Way 3 is drawn against x.
fn lines() -> Osm {
    let mut osm = Osm::default();
    for (way, y) in [(1, 9.0), (2, 6.0), (3, 3.0), (4, 0.0)] {
        for (k, x) in [(0, 0.0), (1, 20.0), (2, 40.0)] {
            osm = osm.node(10 * way + k, x, y);
        }
        let mut nodes = [10 * way, 10 * way + 1, 10 * way + 2];
        if way == 3 {
            nodes.reverse();
        }
        osm = osm.way(way, &nodes, &[]);
    }
    osm
}

fn lane<'a>(map: &'a RoadMap, name: &str) -> &'a Lane {
    map.lane(map.find(name).unwrap_or_else(|| panic!("no lane `{name}`")))
}

/// Names of lanes by handle.
fn names<'a>(
    map: &'a RoadMap,
    ids: impl IntoIterator<Item = &'a corridor_decider::road::LaneId>,
) -> Vec<&'a str> {
    ids.into_iter().map(|id| map.lane(*id).name.as_str()).collect()
}
