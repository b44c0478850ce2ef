//! A tree of axis-aligned boxes: which of many things is nearest to a point, and which are near.
//!
//! Plane, metres. Built once, never changed. The boxes are split at the median of their longer extent until few are
//! left, so a query touches a logarithmic number of them, whatever their order was.

use crate::geometry::Vec2;

/// Boxes that a leaf holds: few enough that testing them all costs no more than another level.
const LEAF: usize = 4;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Aabb {
    low: Vec2,
    high: Vec2,
}

impl Aabb {
    /// The box around some points; `None` around none.
    pub(crate) fn around(points: impl IntoIterator<Item = Vec2>) -> Option<Self> {
        let mut points = points.into_iter();
        let first = points.next()?;
        let point = Self {
            low: first,
            high: first,
        };
        Some(points.fold(point, |all, p| Self {
            low: all.low.inf(&p),
            high: all.high.sup(&p),
        }))
    }

    fn union(self, other: Self) -> Self {
        Self {
            low: self.low.inf(&other.low),
            high: self.high.sup(&other.high),
        }
    }

    /// Squared distance from `point`, 0 inside: a lower bound for whatever the box holds.
    fn distance_squared(&self, point: Vec2) -> f64 {
        let x = (self.low.x - point.x).max(point.x - self.high.x).max(0.0);
        let y = (self.low.y - point.y).max(point.y - self.high.y).max(0.0);
        x * x + y * y
    }
}

#[derive(Clone, Debug)]
enum Content {
    /// Places in `items`.
    Leaf(std::ops::Range<usize>),
    /// The second child; the first one follows its parent.
    Inner(usize),
}

#[derive(Clone, Debug)]
struct Node {
    bounds: Aabb,
    content: Content,
}

/// Boxes, known by their place in the list that the tree was built from.
#[derive(Clone, Debug, Default)]
pub(crate) struct AabbTree {
    nodes: Vec<Node>,
    items: Vec<usize>,
}

impl AabbTree {
    pub(crate) fn new(boxes: &[Aabb]) -> Self {
        let mut tree = Self {
            nodes: Vec::new(),
            items: (0..boxes.len()).collect(),
        };
        if !boxes.is_empty() {
            tree.split(boxes, 0..boxes.len());
        }
        tree
    }

    fn split(&mut self, boxes: &[Aabb], range: std::ops::Range<usize>) {
        let items = &mut self.items[range.clone()];
        let bounds = items
            .iter()
            .map(|item| boxes[*item])
            .reduce(Aabb::union)
            .expect("a node holds something");
        let node = self.nodes.len();
        self.nodes.push(Node {
            bounds,
            content: Content::Leaf(range.clone()),
        });
        if items.len() <= LEAF {
            return;
        }
        let extent = bounds.high - bounds.low;
        let axis = usize::from(extent.y > extent.x);
        let centre = |item: usize| boxes[item].low[axis] + boxes[item].high[axis];
        items.sort_unstable_by(|a, b| centre(*a).total_cmp(&centre(*b)).then(a.cmp(b)));
        let middle = range.start + items.len() / 2;
        self.split(boxes, range.start..middle);
        self.nodes[node].content = Content::Inner(self.nodes.len());
        self.split(boxes, middle..range.end);
    }

    /// The item with the smallest `distance_squared`, and that distance; the first of several.
    /// `None` in an empty tree and for a point that is no number.
    pub(crate) fn nearest(
        &self,
        point: Vec2,
        distance_squared: impl Fn(usize) -> f64,
    ) -> Option<(usize, f64)> {
        let mut best: Option<(usize, f64)> = None;
        let mut limit = f64::INFINITY;
        self.visit(0, point, &mut limit, &mut |item, limit| {
            let distance = distance_squared(item);
            let closer = best.is_none_or(|(other, d)| distance < d || (distance <= d && item < other));
            if closer && distance <= *limit {
                best = Some((item, distance));
                *limit = distance;
            }
        });
        best
    }

    /// Every item whose box comes at least as near as `radius`, in ascending order.
    pub(crate) fn near(&self, point: Vec2, radius: f64) -> Vec<usize> {
        let mut found = Vec::new();
        self.visit(0, point, &mut (radius * radius), &mut |item, _| found.push(item));
        found.sort_unstable();
        found
    }

    /// Shows every item in a leaf that comes at least as near as the squared `limit`, the nearer child first.
    fn visit(&self, node: usize, point: Vec2, limit: &mut f64, show: &mut impl FnMut(usize, &mut f64)) {
        let Some(Node { bounds, content }) = self.nodes.get(node) else {
            return;
        };
        if bounds.distance_squared(point) > *limit {
            return;
        }
        match content {
            Content::Leaf(range) => {
                for item in &self.items[range.clone()] {
                    show(*item, limit);
                }
            }
            Content::Inner(second) => {
                let distance = |node: usize| self.nodes[node].bounds.distance_squared(point);
                let mut children = [node + 1, *second];
                if distance(children[1]) < distance(children[0]) {
                    children.swap(0, 1);
                }
                for child in children {
                    self.visit(child, point, limit, show);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_tree_finds_what_a_scan_finds(
            corners in prop::collection::vec(((-50.0..50.0), (-50.0..50.0)), 0..60),
            (x, y) in ((-80.0..80.0), (-80.0..80.0)),
            radius in 0.0..60.0,
        ) {
            let points: Vec<Vec2> = corners.iter().map(|(x, y): &(f64, f64)| Vec2::new(x.round(), y.round())).collect();
            let boxes: Vec<Aabb> = points.iter().filter_map(|p| Aabb::around([*p])).collect();
            let tree = AabbTree::new(&boxes);
            let (at, distance) = (Vec2::new(x, y), |k: usize| (points[k] - Vec2::new(x, y)).norm_squared());
            let scanned = (0..points.len()).min_by(|a, b| distance(*a).total_cmp(&distance(*b)));
            prop_assert_eq!(tree.nearest(at, distance).map(|(item, _)| item), scanned);
            let near: Vec<usize> = tree.near(at, radius).into_iter().filter(|k| distance(*k) <= radius * radius).collect();
            let all: Vec<usize> = (0..points.len()).filter(|k| distance(*k) <= radius * radius).collect();
            prop_assert_eq!(near, all);
        }
    }
}
