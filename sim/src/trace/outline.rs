//! The road as a trace keeps it: edges and marks of the lanes that can be seen from the route.
//!
//! World frame, metres.

use super::LaneOutline;
use corridor_decider::geometry::Vec2;
use corridor_decider::reference_line::ReferenceLine;
use corridor_decider::road::{BoundaryType, Lane, Mark};
use std::sync::Arc;

/// Cross-sections of a lane that are left out between two kept ones: two metres apart is as fine as a page shows.
const STRIDE: usize = 4;

/// Lanes further from every line than this are left out, m: beyond the sensors, and beyond what a page shows at
/// first.
const IN_SIGHT: f64 = 120.0;

/// Distance between the places of a line from which lanes are looked for, m: small against [`IN_SIGHT`].
const LOOKOUT_SPACING: f64 = 20.0;

/// The outlines of the lanes near `lines`, in the order of `lanes`.
pub(crate) fn near(lanes: &[Lane], lines: &[Arc<ReferenceLine>]) -> Vec<LaneOutline> {
    let lookouts: Vec<Vec2> = lines.iter().flat_map(|line| lookouts(line)).collect();
    lanes
        .iter()
        .filter(|lane| is_in_sight(lane, &lookouts))
        .map(outline)
        .collect()
}

/// Places along a line from which its surroundings are seen.
fn lookouts(line: &ReferenceLine) -> Vec<Vec2> {
    let mut next = f64::NEG_INFINITY;
    let samples = line.samples();
    let last = samples.len().saturating_sub(1);
    let mut places = Vec::new();
    for (k, sample) in samples.iter().enumerate() {
        if sample.s >= next || k == last {
            next = sample.s + LOOKOUT_SPACING;
            places.push(Vec2::new(sample.point.x, sample.point.y));
        }
    }
    places
}

fn is_in_sight(lane: &Lane, lookouts: &[Vec2]) -> bool {
    let centres = lane.points.iter().step_by(STRIDE).chain(lane.points.last());
    let mut centres = centres.map(|p| Vec2::new(p.x, p.y));
    centres.any(|p| {
        lookouts
            .iter()
            .any(|from| (p - from).norm_squared() <= IN_SIGHT * IN_SIGHT)
    })
}

/// Edges and marks of one lane.
pub(crate) fn outline(lane: &Lane) -> LaneOutline {
    outline_by(lane, STRIDE)
}

/// Edges and marks of one lane, of one cross-section in `stride`.
pub(crate) fn outline_by(lane: &Lane, stride: usize) -> LaneOutline {
    let last = lane.points.len() - 1;
    let kept: Vec<usize> = (0..=last).filter(|k| k % stride == 0 || *k == last).collect();
    let edge = |side: &dyn Fn(usize) -> Vec2| kept.iter().map(|k| side(*k)).collect();
    let points = &lane.points;
    let stations: Vec<f64> = kept.iter().map(|k| points[*k].s).collect();
    LaneOutline {
        name: lane.name.clone(),
        kind: lane.kind,
        left: edge(&|k| points[k].offset(points[k].left)),
        right: edge(&|k| points[k].offset(-points[k].right)),
        left_marks: places(&lane.left_marks, &stations),
        right_marks: places(&lane.right_marks, &stations),
        in_junction: lane.junction.is_some(),
    }
}

/// Where marks begin among the kept cross-sections; the last of those that begin at one.
fn places(marks: &[Mark], stations: &[f64]) -> Vec<(usize, BoundaryType)> {
    let mut placed: Vec<(usize, BoundaryType)> = Vec::new();
    for mark in marks {
        let place = stations.partition_point(|s| *s < mark.s);
        if place + 1 >= stations.len() && !placed.is_empty() {
            break;
        }
        placed.retain(|(at, _)| *at != place);
        placed.push((place, mark.kind));
    }
    placed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::synthetic;
    use corridor_decider::road::{LaneId, RoadMap};

    fn mark(s: f64, kind: BoundaryType) -> Mark {
        Mark { s, kind }
    }

    #[test]
    fn marks_begin_at_the_first_section_behind_them() {
        let stations = [0.0, 2.0, 4.0, 6.0];
        let (dotted, solid) = (BoundaryType::DottedWhite, BoundaryType::SolidWhite);
        assert_eq!(
            places(&[mark(0.0, dotted), mark(2.0, solid)], &stations),
            [(0, dotted), (1, solid)]
        );
        assert_eq!(
            places(
                &[mark(0.0, dotted), mark(2.5, solid), mark(3.0, dotted)],
                &stations
            ),
            [(0, dotted), (2, dotted)],
            "the later of two at one section"
        );
        assert_eq!(
            places(&[mark(0.0, dotted), mark(6.0, solid)], &stations),
            [(0, dotted)],
            "nothing is left of the second"
        );
        assert!(places(&[], &stations).is_empty());
    }

    #[test]
    fn what_is_out_of_sight_is_left_out() {
        let mut lanes = synthetic::lanes();
        let mut far = lanes[0].clone();
        far.name = "far".to_owned();
        for point in &mut far.points {
            point.y += 400.0;
        }
        lanes.push(far);
        let map = RoadMap::new(lanes.clone(), Vec::new()).unwrap();
        let line = Arc::new(ReferenceLine::along(&map, &[LaneId(0)]).unwrap());
        let outlines = near(&lanes, &[line]);
        assert_eq!(outlines.len(), lanes.len() - 1);
        for (outline, lane) in outlines.iter().zip(&lanes) {
            assert_eq!(outline.left.len(), outline.right.len());
            let width = (outline.left[7] - outline.right[7]).norm();
            assert!((width - lane.points[28].left - lane.points[28].right).abs() < 1e-9);
        }
    }
}
