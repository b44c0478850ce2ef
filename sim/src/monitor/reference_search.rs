//! A corridor found by brute force: the oracle against which a decider's blocks are held.
//!
//! The offsets at every station are cut into a fine grid and flooded station by station from the ego: what is free
//! and touches what was reached before is reached. Nothing of the decider's gaps, costs or sides is in it. Frenet
//! plane of one line, metres, for the rear axle.

use super::silhouette::Silhouette;
use corridor_decider::frame::ObstacleId;

/// Distance between two stations of the flood, m: that of a bound.
pub(super) const STEP: f64 = 0.5;

/// Distance between two offsets, m: an eighth of the lateral buffer.
pub(super) const GRID: f64 = 0.05;

/// Half the number of offsets: to 15 m on either side, wider than any road surface of one direction and its opposite.
const HALF_COUNT: usize = 300;

/// How much of the road each obstacle takes from the axle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Body {
    /// Half the car's width and what it keeps beside, m.
    pub(super) beside: f64,
    /// How far before an obstacle's nearest station the axle is held to pass it, m, and how far behind its farthest.
    pub(super) before: f64,
    pub(super) behind: f64,
}

/// How far the flood came.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Flood {
    /// The first station that could not be entered; `None`: all could.
    pub(super) closed_at: Option<f64>,
    /// The obstacles that stand, there, before what had been reached.
    pub(super) closed_by: Vec<ObstacleId>,
}

impl Flood {
    const OPEN: Self = Self {
        closed_at: None,
        closed_by: Vec::new(),
    };
}

/// Floods from the ego at `(s, l)` to station `end`. `edges` are the (right, left) limits of the axle at a station.
/// `None` where the ego itself stands on nothing free: then the question has no answer.
pub(super) fn flood(
    standing: &[&Silhouette],
    (s, l): (f64, f64),
    end: f64,
    body: Body,
    edges: impl Fn(f64) -> (f64, f64),
) -> Option<Flood> {
    let standing: Vec<&Silhouette> = standing
        .iter()
        .copied()
        .filter(|o| o.start - body.before <= end && o.end + body.behind >= s)
        .collect();
    if standing.is_empty() {
        return Some(Flood::OPEN);
    }
    let mut reached = vec![false; 2 * HALF_COUNT + 1];
    *reached.get_mut(index(l)?)? = true;
    let mut free = vec![true; reached.len()];
    let mut station = s;
    while station <= end {
        let taken = taken(&standing, station, body);
        let (right, left) = edges(station);
        for (k, free) in free.iter_mut().enumerate() {
            let l = offset(k);
            *free = l >= right && l <= left && taken.iter().all(|(_, lo, hi)| l <= *lo || l >= *hi);
        }
        let before = reached.clone();
        spread(&mut reached, &free);
        if !reached.contains(&true) {
            let in_the_way = |(_, lo, hi): &&(ObstacleId, f64, f64)| {
                (0..before.len()).any(|k| before[k] && offset(k) > *lo && offset(k) < *hi)
            };
            let closed_by = taken.iter().filter(in_the_way).map(|(id, ..)| *id).collect();
            return (station > s).then_some(Flood {
                closed_at: Some(station),
                closed_by,
            });
        }
        station += STEP;
    }
    Some(Flood::OPEN)
}

/// What each obstacle beside a station takes from the axle.
fn taken(standing: &[&Silhouette], station: f64, body: Body) -> Vec<(ObstacleId, f64, f64)> {
    let beside = |obstacle: &&Silhouette| {
        let covered = obstacle.between(station - body.behind, station + body.before)?;
        Some((
            obstacle.id,
            covered.right - body.beside,
            covered.left + body.beside,
        ))
    };
    standing.iter().filter_map(beside).collect()
}

/// Keeps what is free of what was reached, and reaches all that is free and hangs together with it.
fn spread(reached: &mut [bool], free: &[bool]) {
    let mut first = 0;
    while first < free.len() {
        let run = free[first..].iter().take_while(|free| **free).count();
        let past = first + run;
        let any = reached[first..past].contains(&true);
        reached[first..past].fill(any);
        if past < free.len() {
            reached[past] = false;
        }
        first = past + 1;
    }
}

fn offset(k: usize) -> f64 {
    (k as f64 - HALF_COUNT as f64) * GRID
}

/// The grid's nearest offset; `None` beside the grid.
fn index(l: f64) -> Option<usize> {
    let k = (l / GRID).round() + HALF_COUNT as f64;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "checked to be in range"
    )]
    let index = (0.0..=2.0 * HALF_COUNT as f64).contains(&k).then_some(k as usize);
    index
}
