//! Lanes and the lines painted between them as the page draws them, in metres from the page's origin.

use super::line::flat;
use super::thin;
use crate::trace::LaneOutline;
use corridor_decider::geometry::Vec2;
use corridor_decider::road::{BoundaryType, LaneKind};
use serde::Serialize;

/// Lines nearer to each other than this are one line that both of its lanes know, m.
const SAME_LINE: f64 = 0.1;

/// One lane, a cross-section per place of `left` and `right`.
#[derive(Serialize)]
pub(super) struct LaneData {
    name: String,
    kind: LaneKind,
    in_junction: bool,
    /// `x, y, x, y, …`
    left: Vec<f64>,
    right: Vec<f64>,
}

/// A stretch of one kind of line on the ground.
#[derive(Serialize)]
pub(crate) struct MarkData {
    pub(crate) kind: BoundaryType,
    /// `x, y, x, y, …`
    pub(crate) at: Vec<f64>,
}

impl LaneData {
    pub(super) fn new(lane: &LaneOutline, origin: Vec2) -> Self {
        // What one edge needs stays on both, so that the sections stay sections.
        let (on_left, on_right) = (
            thin::keep(&lane.left, |_| false),
            thin::keep(&lane.right, |_| false),
        );
        let kept = |edge: &[Vec2]| {
            let points = edge.iter().enumerate();
            let needed = |k: usize| on_left.get(k) == Some(&true) || on_right.get(k) == Some(&true);
            flat(points.filter(|(k, _)| needed(*k)).map(|(_, p)| *p), origin)
        };
        Self {
            name: lane.name.clone(),
            kind: lane.kind,
            in_junction: lane.in_junction,
            left: kept(&lane.left),
            right: kept(&lane.right),
        }
    }
}

/// The lines painted on the edges of all lanes, each once.
pub(crate) fn marks(lanes: &[LaneOutline], origin: Vec2) -> Vec<MarkData> {
    let mut painted: Vec<Painted> = Vec::new();
    for lane in lanes {
        for (edge, marks) in [(&lane.left, &lane.left_marks), (&lane.right, &lane.right_marks)] {
            for (k, (from, kind)) in marks.iter().enumerate() {
                let to = marks.get(k + 1).map_or(edge.len(), |next| next.0 + 1);
                let Some(points) = edge.get(*from..to.min(edge.len())) else {
                    continue;
                };
                if *kind == BoundaryType::Unknown || points.len() < 2 {
                    continue;
                }
                let line = Painted::new(*kind, points);
                if !painted.iter().any(|other| other.is_under(&line)) {
                    painted.push(line);
                }
            }
        }
    }
    painted
        .into_iter()
        .map(|line| MarkData {
            kind: line.kind,
            at: flat(line.points, origin),
        })
        .collect()
}

/// A line on the ground and the box around it.
struct Painted {
    kind: BoundaryType,
    points: Vec<Vec2>,
    low: Vec2,
    high: Vec2,
}

impl Painted {
    fn new(kind: BoundaryType, points: &[Vec2]) -> Self {
        let kept = thin::keep(points, |_| false);
        let kept = points.iter().zip(kept).filter(|(_, kept)| *kept);
        Self {
            kind,
            points: kept.map(|(p, _)| *p).collect(),
            low: points.iter().fold(points[0], |low, p| low.inf(p)),
            high: points.iter().fold(points[0], |high, p| high.sup(p)),
        }
    }

    /// Whether `line` lies along this one: seen at its ends and in its middle.
    fn is_under(&self, line: &Self) -> bool {
        let ends = (line.points[0], line.points[line.points.len() - 1]);
        let middle = line.points.len() / 2;
        let middle = (line.points[middle] + line.points[middle - 1]) / 2.0;
        [ends.0, ends.1, middle].iter().all(|p| self.is_near(*p))
    }

    fn is_near(&self, point: Vec2) -> bool {
        let outside = (self.low - point).sup(&(point - self.high));
        outside.max() <= SAME_LINE
            && self
                .points
                .windows(2)
                .any(|pair| thin::from_chord(pair[0], pair[1], point) <= SAME_LINE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::{outline, synthetic};

    #[test]
    fn a_line_between_two_lanes_is_painted_once() {
        let lanes: Vec<LaneOutline> = synthetic::lanes().iter().map(outline::outline).collect();
        let marks = marks(&lanes[..2], Vec2::new(1000.0, 500.0));
        // Ours and the oncoming lane share their left edge, which changes its kind at 120 m of either: the other
        // way round for the one that comes towards us.
        let count = |kind| marks.iter().filter(|m| m.kind == kind).count();
        assert_eq!(count(BoundaryType::SolidWhite), 2, "the outer edges");
        assert!((1..=2).contains(&count(BoundaryType::DottedYellow)));
        assert!((1..=2).contains(&count(BoundaryType::DoubleYellow)));
        let same = [lanes[0].clone(), lanes[0].clone()];
        assert_eq!(super::marks(&same, Vec2::zeros()).len(), 3);
    }

    #[test]
    fn marks_that_lead_nowhere_are_left_out() {
        let mut lane = outline::outline(&synthetic::lanes()[0]);
        lane.left_marks = vec![
            (7, BoundaryType::SolidWhite),
            (3, BoundaryType::Curb),
            (9999, BoundaryType::Curb),
        ];
        lane.right_marks = vec![(0, BoundaryType::Unknown)];
        assert!(marks(&[lane], Vec2::zeros()).len() <= 1);
    }

    #[test]
    fn both_edges_keep_the_same_sections() {
        for lane in synthetic::lanes() {
            let data = LaneData::new(&outline::outline(&lane), Vec2::zeros());
            assert_eq!(data.left.len(), data.right.len());
            assert!(data.left.len() >= 4);
        }
    }
}
