//! The place to pull over (`SearchPullOverPosition`): a window at the road's edge, long and wide enough.

use super::bound::BoundPoint;
use super::input::{Input, PullOverKind};
use super::pull_over::PullOverRefusal;
use super::stations::Station;
use crate::geometry::Vec2;
use crate::reference_line::{LineQuery, SlPoint};

/// Length of the window in car lengths, before the obstacles' own buffers are taken off (the original's
/// `kPulloverLonSearchCoeff`).
const LENGTH_COEFF: f64 = 1.5;

/// Width of the window beyond the car's, in car widths (`kPulloverLatSearchCoeff` − 1).
const EXTRA_WIDTH_COEFF: f64 = 0.25;

/// How far around a place no junction may be, m.
const JUNCTION_RADIUS: f64 = 1.0;

/// Share of the tightest turn that turning in to a place may take.
const TURN_IN_SHARE: f64 = 0.55;

/// How far before its place a car stands straight, m.
const STRAIGHTEN: f64 = 2.0;

/// Way before the place that is looked at for turning in, m: enough for any lane width.
const TURN_IN_LENGTH: f64 = 20.0;

/// Room to leave to what stands ahead where the middle of the window is too near to turn in to, m.
const LEAST_ROOM_AHEAD: f64 = 0.5;

/// A place that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Found {
    pub index: usize,
    pub position: Vec2,
    pub theta: f64,
}

/// Direction in which windows are tried.
#[derive(Clone, Copy, PartialEq)]
enum Direction {
    Forward,
    Backward,
}

/// The window that every place needs, m.
#[derive(Clone, Copy)]
struct Window {
    length: f64,
    width: f64,
}

/// The first place that fits, searched backward from the destination or, in an emergency, forward from the
/// ego.
pub(super) fn place<L: LineQuery + ?Sized>(
    bound: &[BoundPoint],
    stations: &[Station],
    line: &L,
    input: &Input,
    kind: PullOverKind,
) -> Result<Found, PullOverRefusal> {
    let (direction, target) = target(bound, line, input, kind)?;
    let config = input.config;
    let window = Window {
        length: LENGTH_COEFF * input.vehicle.length
            - config.obstacle_lon_start_buffer
            - config.obstacle_lon_end_buffer,
        width: EXTRA_WIDTH_COEFF * input.vehicle.width,
    };
    let (first_s, last_s) = (bound[0].s, bound[bound.len() - 1].s);
    let anchors: Box<dyn Iterator<Item = usize>> = match direction {
        Direction::Backward => {
            let start = bound.partition_point(|p| p.s <= target);
            Box::new(
                (0..start)
                    .rev()
                    .take_while(|i| bound[*i].s - first_s > window.length),
            )
        }
        Direction::Forward => {
            let start = bound.partition_point(|p| p.s < target);
            Box::new((start..bound.len()).take_while(|i| last_s - bound[*i].s > window.length))
        }
    };
    for anchor in anchors {
        if line.near_junction(bound[anchor].s, JUNCTION_RADIUS) {
            continue;
        }
        let Some(past) = window_end(bound, stations, input, anchor, direction, window) else {
            continue;
        };
        let (start, end) = if past < anchor {
            (past, anchor)
        } else {
            (anchor, past)
        };
        let Some(index) = reachable(bound, input, stop_index(input, start, end), end, window) else {
            continue;
        };
        let crosses_junction = || (start..=end).any(|k| line.near_junction(bound[k].s, JUNCTION_RADIUS));
        if !config.quirks.junction_at_anchor_only && crosses_junction() {
            continue;
        }
        return Ok(found(bound, line, index, window));
    }
    Err(PullOverRefusal::NoPlace)
}

/// Where the search begins, and which way it goes (`FindDestinationPullOverS`, `FindEmergencyPullOverS`).
fn target<L: LineQuery + ?Sized>(
    bound: &[BoundPoint],
    line: &L,
    input: &Input,
    kind: PullOverKind,
) -> Result<(Direction, f64), PullOverRefusal> {
    let config = input.config;
    match kind {
        PullOverKind::Emergency => {
            let turns = config.pull_over_approach_lon_distance_adjust_factor;
            Ok((
                Direction::Forward,
                input.ego_end_s + input.vehicle.min_turn_radius * 2.0 * turns,
            ))
        }
        PullOverKind::Destination => {
            let destination = input.destination.ok_or(PullOverRefusal::NoDestination)?;
            let s = line.to_frenet(destination).s;
            if s - input.ego_end_s < config.pull_over_destination_to_adc_buffer {
                return Err(PullOverRefusal::DestinationTooNear);
            }
            if s + config.pull_over_destination_to_pathend_buffer >= bound[bound.len() - 1].s {
                return Err(PullOverRefusal::DestinationTooFar);
            }
            Ok((Direction::Backward, s))
        }
    }
}

/// One step past the last station of a window that begins at `anchor`, or `None` where it does not fit.
fn window_end(
    bound: &[BoundPoint],
    stations: &[Station],
    input: &Input,
    anchor: usize,
    direction: Direction,
    window: Window,
) -> Option<usize> {
    // A window of no length still has a first station.
    let unchecked = window.length <= 0.0 && input.config.quirks.unchecked_short_window;
    if !unchecked && !fits(&bound[anchor], &stations[anchor], input, window) {
        return None;
    }
    let mut j = anchor;
    while (bound[anchor].s - bound[j].s).abs() < window.length {
        if !fits(&bound[j], &stations[j], input, window) {
            return None;
        }
        j = match direction {
            Direction::Backward => j.checked_sub(1)?,
            Direction::Forward if j + 1 < bound.len() => j + 1,
            Direction::Forward => return None,
        };
    }
    Some(j)
}

/// Whether the corridor at one station reaches the road's edge and is wide enough.
fn fits(point: &BoundPoint, station: &Station, input: &Input, window: Window) -> bool {
    let quirks = input.config.quirks;
    let half_width = input.vehicle.half_width();
    let road_right = match station.road {
        Some((_, right)) => right,
        None if quirks.unchecked_road_width => 0.0,
        None => return false,
    };
    let right_side = if quirks.unsigned_road_edge {
        point.l_min.abs() + half_width
    } else {
        half_width - point.l_min
    };
    road_right - right_side <= input.config.pull_over_road_edge_buffer
        && point.l_max - point.l_min >= window.width
}

/// The first station from the middle of the window on to which the car can turn in, and which leaves room ahead.
fn reachable(
    bound: &[BoundPoint],
    input: &Input,
    middle: usize,
    end: usize,
    window: Window,
) -> Option<usize> {
    if input.config.quirks.unreachable_place {
        return Some(middle);
    }
    let standing = bound[end].s + input.config.obstacle_lon_start_buffer;
    let leaves_room =
        |k: usize| bound[k].s + input.vehicle.front_edge_to_center + LEAST_ROOM_AHEAD <= standing;
    (middle..=end)
        .take_while(|k| *k == middle || leaves_room(*k))
        .find(|k| is_reachable(bound, input, *k, window))
}

/// Whether the car can turn in to the place: two arcs of opposite bend move it aside by `κ d² / 4` over a
/// distance `d`. So far right the corridor must reach all the way, and so near the ego must be.
fn is_reachable(bound: &[BoundPoint], input: &Input, index: usize, window: Window) -> bool {
    let kappa = TURN_IN_SHARE / input.vehicle.min_turn_radius;
    let place = bound[index].l_min + window.width / 2.0;
    let leftmost = |s: f64| {
        let d = (bound[index].s - s - STRAIGHTEN).max(0.0);
        place + kappa * d * d / 4.0
    };
    let near = |point: &&BoundPoint| bound[index].s - point.s <= TURN_IN_LENGTH;
    let mut before = bound[..index].iter().rev().take_while(near);
    input.ego.l <= leftmost(input.ego.s) && before.all(|point| point.l_min <= leftmost(point.s))
}

/// Where in the window the rear axle stands: the car is centred in it, by its length ahead and behind.
fn stop_index(input: &Input, start: usize, end: usize) -> usize {
    let vehicle = input.vehicle;
    let ratio = (0.5 * (LENGTH_COEFF - 1.0) * vehicle.length + vehicle.back_edge_to_center)
        / vehicle.length
        / LENGTH_COEFF;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a mean of two indices"
    )]
    let index = (ratio * end as f64 + (1.0 - ratio) * start as f64).floor() as usize;
    index.clamp(start, end)
}

fn found<L: LineQuery + ?Sized>(bound: &[BoundPoint], line: &L, index: usize, window: Window) -> Found {
    let s = bound[index].s;
    let position = line.to_cartesian(SlPoint {
        s,
        l: bound[index].l_min + window.width / 2.0,
    });
    let theta = line.point(s).theta;
    Found {
        index,
        position,
        theta: line.lane_heading(position, theta).unwrap_or(theta),
    }
}
