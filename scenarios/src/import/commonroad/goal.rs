//! The goal states of a planning problem as regions of the plane, in seconds from its start.

use super::data::{File, Id, Interval, Lanelet, Position, Problem, State};
use super::remarks::Remarks;
use super::shapes;
use crate::goal::{GoalArea, GoalRegion, GoalState};
use corridor_decider::geometry::Vec2;

/// How near a goal that is a mere point must be met, m.
const AT_POINT: f64 = 1.0;

/// The goals of a problem.
pub(super) fn region(file: &File, problem: &Problem, remarks: &mut Remarks) -> GoalRegion {
    let first = problem.initial.time.middle();
    let mut goal = |state: &State| GoalState {
        time: seconds(state.time, first, file.time_step),
        areas: state
            .position
            .as_ref()
            .map_or(Vec::new(), |position| areas(file, position, problem.id, remarks)),
        heading: state.orientation.map(|range| (range.low, range.high)),
        speed: state.velocity.map(|range| (range.low, range.high)),
    };
    GoalRegion {
        time_step: file.time_step,
        alternatives: problem.goals.iter().map(&mut goal).collect(),
    }
}

fn seconds(time: Interval, first: f64, step: f64) -> (f64, f64) {
    ((time.low - first) * step, (time.high - first) * step)
}

fn areas(file: &File, position: &Position, problem: Id, remarks: &mut Remarks) -> Vec<GoalArea> {
    match position {
        Position::Point(center) => {
            remarks.add("has a point for a goal: within a metre of it will do", problem);
            vec![GoalArea::Circle {
                center: *center,
                radius: AT_POINT,
            }]
        }
        Position::Shapes(shapes) => shapes.iter().map(area).collect(),
        Position::Lanelets(ids) => {
            let named = |id: &Id| file.lanelets.iter().find(|lanelet| lanelet.id == *id);
            if ids.iter().any(|id| named(id).is_none()) {
                remarks.add("has a goal in a lanelet that does not exist", problem);
            }
            let mut areas: Vec<GoalArea> = ids.iter().filter_map(named).map(surface).collect();
            if areas.is_empty() {
                // No place at all must not become any place.
                areas.push(GoalArea::Polygon(Vec::new()));
            }
            areas
        }
    }
}

fn area(shape: &super::data::Shape) -> GoalArea {
    match shape {
        super::data::Shape::Circle { radius, center } => GoalArea::Circle {
            center: *center,
            radius: *radius,
        },
        other => GoalArea::Polygon(shapes::corners(other)),
    }
}

/// Everything between the bounds of a lanelet.
fn surface(lanelet: &Lanelet) -> GoalArea {
    let [left, right] = &lanelet.bounds;
    let around: Vec<Vec2> = left
        .points
        .iter()
        .chain(right.points.iter().rev())
        .copied()
        .collect();
    GoalArea::Polygon(around)
}
