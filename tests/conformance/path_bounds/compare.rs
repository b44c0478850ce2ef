//! What a case expects against what the decider answered.

use super::case::{Boundary, Expected, PathBoundsCase, Place};
use crate::stub_world::StubWorld;
use corridor_decider::geometry::{Vec2, angle};
use corridor_decider::reference_line::LineQuery;
use corridor_decider::tasks::path_bounds as bounds;

/// Largest difference of a bound, m.
const BOUND_TOLERANCE: f64 = 1e-9;

/// Largest difference of a place to pull over, m and rad.
const PLACE_TOLERANCE: f64 = 1e-7;

pub(super) fn compare(
    case: &PathBoundsCase,
    answer: Result<bounds::PathBounds, bounds::PathBoundsError>,
    memory: &bounds::Memory,
    names: &[String],
) -> Result<(), String> {
    use bounds::PathBoundsError as E;
    let expected = &case.expected;
    let result = match &answer {
        Ok(_) => "ok",
        Err(E::EgoOutside(_)) => "check_failed",
        Err(_) => "error",
    };
    // Undefined behaviour of the original has a defined answer here, but none to compare with.
    if expected.result == "undefined_behavior" {
        return answer
            .map(|_| ())
            .map_err(|error| format!("undefined in the original, here {error}"));
    }
    if result != expected.result {
        return Err(format!(
            "result: expected {}, got {result} ({:?})",
            expected.result,
            answer.err()
        ));
    }
    if let Ok(answer) = &answer {
        compare_bounds(&expected.candidate_path_boundaries, &answer.bounds, names)?;
    }
    compare_memory(&case.input.world, expected, memory)
}

fn compare_bounds(expected: &[Boundary], got: &[bounds::PathBound], names: &[String]) -> Result<(), String> {
    let wanted: Vec<&str> = expected.iter().map(|b| b.label.as_str()).collect();
    let labels: Vec<String> = got.iter().map(|b| b.label.to_string()).collect();
    if wanted != labels {
        return Err(format!("labels: expected {wanted:?}, got {labels:?}"));
    }
    expected
        .iter()
        .zip(got)
        .try_for_each(|(expected, got)| compare_bound(expected, got, names))
}

fn compare_bound(expected: &Boundary, got: &bounds::PathBound, names: &[String]) -> Result<(), String> {
    let label = &expected.label;
    if expected.points.len() != got.points.len() {
        let (wanted, have) = (expected.points.len(), got.points.len());
        return Err(format!("{label}: expected {wanted} points, got {have}"));
    }
    let off_start = (expected.start_s - got.start_s()).abs();
    if off_start > BOUND_TOLERANCE || (expected.delta_s - got.delta_s).abs() > 0.0 {
        return Err(format!(
            "{label}: starts at {} instead of {}",
            got.start_s(),
            expected.start_s
        ));
    }
    for (i, ((l_min, l_max), point)) in expected.points.iter().zip(&got.points).enumerate() {
        // Written so that a bound that is no number is off.
        let is_right = |have: f64, wanted: f64| (have - wanted).abs() <= BOUND_TOLERANCE;
        if !is_right(point.l_min, *l_min) || !is_right(point.l_max, *l_max) {
            let have = (point.l_min, point.l_max);
            return Err(format!(
                "{label}: point {i} is {have:?}, expected {:?}",
                (l_min, l_max)
            ));
        }
    }
    compare_blocker(expected, got, names)
}

/// Any member of the blocking candidates is right: the original takes the first of an unordered set.
fn compare_blocker(expected: &Boundary, got: &bounds::PathBound, names: &[String]) -> Result<(), String> {
    let got_name = got.blocked_by.map_or("", |id| names[id.0 as usize].as_str());
    let wanted = &expected.blocking_obstacle_id;
    let right = match wanted.as_str() {
        "" => got_name.is_empty(),
        _ => expected.blocking_candidates.iter().any(|name| name == got_name),
    };
    if right {
        Ok(())
    } else {
        Err(format!(
            "{}: blocked by `{got_name}`, expected `{wanted}`",
            expected.label
        ))
    }
}

fn compare_memory(world: &StubWorld, expected: &Expected, memory: &bounds::Memory) -> Result<(), String> {
    if let Some(wanted) = &expected.pull_over {
        if wanted.plan_pull_over_path != memory.pull_over.is_requested {
            return Err("pull-over request differs".to_owned());
        }
        compare_place(
            "pull-over position",
            world,
            wanted.position.as_ref(),
            place(memory),
        )?;
        if let Some(have) = memory.pull_over.place {
            let off = angle::difference(have.theta, wanted.theta).abs();
            let room = [
                (have.length_front, wanted.length_front),
                (have.length_back, wanted.length_back),
                (have.width_left, wanted.width_left),
                (have.width_right, wanted.width_right),
            ];
            let fits = room.iter().all(|(a, b)| (a - b).abs() <= PLACE_TOLERANCE);
            if off.is_nan() || off > PLACE_TOLERANCE || !fits {
                return Err(format!(
                    "pull-over place is {have:?}, expected heading {}",
                    wanted.theta
                ));
            }
        }
    }
    if let Some(wanted) = &expected.change_lane {
        let start = wanted
            .lane_change_start_position
            .as_ref()
            .filter(|_| wanted.exist_lane_change_start_position);
        compare_place("lane-change start", world, start, memory.change_lane.start)?;
    }
    Ok(())
}

fn place(memory: &bounds::Memory) -> Option<Vec2> {
    memory.pull_over.place.map(|place| place.position)
}

fn compare_place(
    what: &str,
    world: &StubWorld,
    wanted: Option<&Place>,
    have: Option<Vec2>,
) -> Result<(), String> {
    let wanted = wanted.map(|place| Vec2::new(place.x, place.y));
    match (wanted, have) {
        (None, None) => Ok(()),
        (Some(wanted), Some(have)) if (wanted - have).norm() <= PLACE_TOLERANCE => Ok(()),
        _ => {
            let sl = |place: Option<Vec2>| place.map(|place| world.to_frenet(place));
            Err(format!("{what}: expected {:?}, got {:?}", sl(wanted), sl(have)))
        }
    }
}
