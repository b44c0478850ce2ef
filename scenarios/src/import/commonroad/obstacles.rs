//! The obstacles of a file as those of a scenario: convex bodies that stand or move as recorded.
//!
//! A union of shapes becomes several bodies on one record. Times are seconds from the start of the planning
//! problem.

use super::data::{File, Id, Obstacle, Position, Prediction, Role, Shape, State};
use super::remarks::Remarks;
use super::shapes;
use crate::scenario::{self, AfterRecord, Behaviour, RecordedState};
use corridor_decider::frame::{ObstacleId, ObstacleKind};
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2, angle};

/// States nearer in time than this are one, s.
const SAME_TIME: f64 = 1e-9;

/// How near an obstacle must start to the ego's own state to be its recording: m, rad and m/s.
const SAME_STATE: (f64, f64, f64) = (0.1, 0.05, 0.5);

/// All obstacles that take part, seen from a vehicle that starts at `start`.
pub(super) fn obstacles(
    file: &File,
    start: Option<&State>,
    remarks: &mut Remarks,
) -> Vec<scenario::Obstacle> {
    let step = file.time_step;
    let first = start.map_or(0.0, |state| state.time.middle());
    let mut bodies = Vec::new();
    for obstacle in &file.obstacles {
        if obstacle.role == Role::Phantom {
            remarks.add(
                "may not be there at all: phantom obstacles are left out",
                obstacle.id,
            );
            continue;
        }
        if start.is_some_and(|start| is_recording_of(obstacle, start)) {
            remarks.add(
                "starts as the ego itself: taken for its recording and left out",
                obstacle.id,
            );
            continue;
        }
        let behaviour = behaviour(obstacle, first, step, remarks);
        for (number, shape) in pieces(obstacle, remarks).into_iter().enumerate() {
            bodies.push(scenario::Obstacle {
                id: ObstacleId(u32::try_from(bodies.len()).unwrap_or(u32::MAX)),
                name: name(obstacle.id, number),
                kind: kind(obstacle),
                shape,
                behaviour: behaviour.clone(),
            });
        }
    }
    bodies
}

/// The first body of an obstacle has its id, the others that and their number.
fn name(id: Id, piece: usize) -> String {
    match piece {
        0 => id.to_string(),
        _ => format!("{id}.{}", piece + 1),
    }
}

fn pieces(obstacle: &Obstacle, remarks: &mut Remarks) -> Vec<ConvexPolygon> {
    if obstacle.shape.len() > 1 {
        remarks.add(
            "has an outline of several shapes: each becomes a body",
            obstacle.id,
        );
    }
    let mut pieces = Vec::new();
    for shape in &obstacle.shape {
        let Some((piece, is_larger)) = shapes::convex(shape) else {
            remarks.add("has an outline that encloses nothing: left out", obstacle.id);
            continue;
        };
        if is_larger {
            remarks.add(
                "has an outline that is not convex: its hull is taken",
                obstacle.id,
            );
        }
        pieces.push(piece);
    }
    pieces
}

fn kind(obstacle: &Obstacle) -> ObstacleKind {
    match obstacle.kind.as_str() {
        "car" | "taxi" | "priorityVehicle" | "parkedVehicle" => ObstacleKind::Car,
        "truck" | "bus" | "train" => ObstacleKind::Truck,
        "bicycle" | "motorcycle" => ObstacleKind::Bicycle,
        "pedestrian" => ObstacleKind::Pedestrian,
        _ => ObstacleKind::Other,
    }
}

/// Whether a moving obstacle is the vehicle of the planning problem, as it was when the scene was recorded.
fn is_recording_of(obstacle: &Obstacle, start: &State) -> bool {
    let Some(initial) = obstacle
        .initial
        .as_ref()
        .filter(|_| obstacle.role == Role::Dynamic)
    else {
        return false;
    };
    let place = |state: &State| place(state.position.as_ref());
    let (Some(a), Some(b)) = (place(initial), place(start)) else {
        return false;
    };
    let value = |of: Option<super::data::Interval>| of.map_or(0.0, super::data::Interval::middle);
    let turn = angle::difference(
        angle::wrap(value(initial.orientation)),
        angle::wrap(value(start.orientation)),
    );
    let faster = value(initial.velocity) - value(start.velocity);
    let at_once = (initial.time.middle() - start.time.middle()).abs() < 0.5;
    at_once && (a - b).norm() <= SAME_STATE.0 && turn.abs() <= SAME_STATE.1 && faster.abs() <= SAME_STATE.2
}

fn behaviour(obstacle: &Obstacle, first: f64, step: f64, remarks: &mut Remarks) -> Behaviour {
    let id = obstacle.id;
    let Some(initial) = &obstacle.initial else {
        // Outlines of surroundings are given where they are.
        return Behaviour::Parked(Pose::new(0.0, 0.0, 0.0));
    };
    let mut draft: Vec<Draft> = draft(initial).into_iter().collect();
    match &obstacle.prediction {
        _ if obstacle.role == Role::Static => {}
        Prediction::None => {}
        Prediction::Trajectory(states) => draft.extend(states.iter().filter_map(self::draft)),
        Prediction::Occupancy(sets) => {
            remarks.add("has occupancy sets: it drives through their middles", id);
            draft.extend(sets.iter().map(|(time, shapes)| middle_of(time.middle(), shapes)));
        }
    }
    let states = record(draft, first, step, || {
        remarks.add("has states out of order: put in order", id);
    });
    match states[..] {
        [] => {
            remarks.add("has no state with a place: it stands at the origin", id);
            Behaviour::Parked(Pose::new(0.0, 0.0, 0.0))
        }
        [only] => Behaviour::Parked(only.pose),
        _ => Behaviour::Recorded {
            states: states.into(),
            after: AfterRecord::Leaves,
        },
    }
}

/// A state as far as the file gives it.
struct Draft {
    /// In steps.
    time: f64,
    place: Vec2,
    theta: Option<f64>,
    speed: Option<f64>,
}

fn draft(state: &State) -> Option<Draft> {
    Some(Draft {
        time: state.time.middle(),
        place: place(state.position.as_ref())?,
        theta: state.orientation.map(|theta| angle::wrap(theta.middle())),
        speed: state.velocity.map(super::data::Interval::middle),
    })
}

/// The place that a position means: the point, or the middle of what it may be in.
pub(super) fn place(position: Option<&Position>) -> Option<Vec2> {
    match position? {
        Position::Point(point) => Some(*point),
        Position::Shapes(shapes) => Some(centroid(shapes)),
        Position::Lanelets(_) => None,
    }
}

fn centroid(shapes: &[Shape]) -> Vec2 {
    let corners: Vec<Vec2> = shapes.iter().flat_map(shapes::corners).collect();
    corners.iter().sum::<Vec2>() / (corners.len().max(1) as f64)
}

fn middle_of(time: f64, shapes: &[Shape]) -> Draft {
    let theta = match shapes {
        [Shape::Rectangle { orientation, .. }] => Some(angle::wrap(*orientation)),
        _ => None,
    };
    Draft {
        time,
        place: centroid(shapes),
        theta,
        speed: None,
    }
}

/// States in order, with what the file left out made up for: headings and speeds from the way.
fn record(mut draft: Vec<Draft>, first: f64, step: f64, out_of_order: impl FnOnce()) -> Vec<RecordedState> {
    let is_in_order = draft.is_sorted_by(|a, b| a.time <= b.time);
    if !is_in_order {
        out_of_order();
        draft.sort_by(|a, b| a.time.total_cmp(&b.time));
    }
    // Trajectories may repeat the initial state.
    draft.dedup_by(|next, kept| (next.time - kept.time) * step < SAME_TIME);
    let way = |k: usize| {
        let (from, to) = match draft.get(k + 1) {
            Some(next) => (&draft[k], next),
            None => (&draft[k.checked_sub(1)?], &draft[k]),
        };
        Some((to.place - from.place, (to.time - from.time) * step))
    };
    let mut states: Vec<RecordedState> = Vec::with_capacity(draft.len());
    let mut theta = draft.iter().find_map(|state| state.theta).unwrap_or(0.0);
    for (k, state) in draft.iter().enumerate() {
        theta = state.theta.unwrap_or_else(|| match way(k) {
            Some((along, _)) if along.norm() > 1e-3 => libm::atan2(along.y, along.x),
            _ => theta,
        });
        let pose = Pose::new(state.place.x, state.place.y, theta);
        let speed = state.speed.unwrap_or_else(|| match way(k) {
            Some((along, duration)) => along.dot(&pose.forward()) / duration,
            None => 0.0,
        });
        states.push(RecordedState {
            t: (state.time - first) * step,
            pose,
            speed,
        });
    }
    states
}
