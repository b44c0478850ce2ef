//! Road marks of a section, told along each lane in driving direction.

use super::lane_build::CentreLine;
use super::record::{MarkRecord, Road, Section};
use corridor_decider::road::{BoundaryType, Mark};

/// Lines on the left and the right edge of the `lane`-th lane from the left.
pub(super) fn marks(
    section: &Section,
    lane: usize,
    line: &CentreLine,
    forward: bool,
) -> (Vec<Mark>, Vec<Mark>) {
    // The lane lies right of its upper edge and left of its lower one.
    let upper = along(edge_marks(section, lane), line, forward, |mark| mark.from_right);
    let lower = along(edge_marks(section, lane + 1), line, forward, |mark| {
        mark.from_left
    });
    if forward { (upper, lower) } else { (lower, upper) }
}

/// Makes broken lines solid on the side from which `laneChange` forbids to cross them.
pub(super) fn trust_lane_change(roads: &mut [Road]) {
    let sections = roads.iter_mut().flat_map(|road| &mut road.sections);
    let records = sections.flat_map(|section| {
        let lanes = section.lanes.iter_mut().flat_map(|lane| &mut lane.marks);
        lanes.chain(&mut section.centre_marks)
    });
    for record in records {
        let [left, right] = record.change;
        for (allowed, kind) in [(left, &mut record.from_left), (right, &mut record.from_right)] {
            *kind = match *kind {
                BoundaryType::DottedWhite if !allowed => BoundaryType::SolidWhite,
                BoundaryType::DottedYellow if !allowed => BoundaryType::SolidYellow,
                other => other,
            };
        }
    }
}

/// The records of the `edge`-th lane edge from the left. Files give them to the lane inside the edge.
fn edge_marks(section: &Section, edge: usize) -> &[MarkRecord] {
    let centre = section.left_count();
    match edge.cmp(&centre) {
        std::cmp::Ordering::Less => &section.lanes[edge].marks,
        std::cmp::Ordering::Equal => &section.centre_marks,
        std::cmp::Ordering::Greater => &section.lanes[edge - 1].marks,
    }
}

/// Records by road station as marks by lane station, without repetitions; empty when nothing is known.
fn along(
    records: &[MarkRecord],
    line: &CentreLine,
    forward: bool,
    kind: impl Fn(&MarkRecord) -> BoundaryType,
) -> Vec<Mark> {
    let (first, last) = (line.road_s[0], line.road_s[line.road_s.len() - 1]);
    let (low, high) = (first.min(last), first.max(last));
    let mut marks: Vec<Mark> = Vec::new();
    let mut add = |from: f64, to: f64, kind: BoundaryType| {
        let (from, to) = (from.max(low), to.min(high));
        let repeated = marks.last().is_some_and(|mark| mark.kind == kind);
        if from < to && !repeated {
            marks.push(Mark {
                s: lane_station(line, forward, if forward { from } else { to }),
                kind,
            });
        }
    };
    // Each record holds up to the next; before the first one nothing is known.
    let starts = || records.iter().map(|record| record.s);
    let unknown = (
        f64::NEG_INFINITY,
        starts().next().unwrap_or(f64::INFINITY),
        BoundaryType::Unknown,
    );
    let ends = starts().skip(1).chain([f64::INFINITY]);
    let known = records
        .iter()
        .zip(ends)
        .map(|(record, end)| (record.s, end, kind(record)));
    let mut stretches: Vec<_> = [unknown].into_iter().chain(known).collect();
    if !forward {
        stretches.reverse();
    }
    for (from, to, kind) in stretches {
        add(from, to, kind);
    }
    if marks.iter().all(|mark| mark.kind == BoundaryType::Unknown) {
        marks.clear();
    }
    marks
}

/// The lane's station at a road station.
fn lane_station(line: &CentreLine, forward: bool, s: f64) -> f64 {
    let road_s = &line.road_s;
    let past = road_s.partition_point(|at| if forward { *at <= s } else { *at >= s });
    let k = past.clamp(1, road_s.len() - 1);
    let t = ((s - road_s[k - 1]) / (road_s[k] - road_s[k - 1])).clamp(0.0, 1.0);
    line.points[k - 1].s + (line.points[k].s - line.points[k - 1].s) * t
}
