//! The corridor of a path: a bound at the path's stations, and what draws the path where inside it.

use super::Goal;
use super::table::{LineTable, Row, STEP};
use crate::decision::PathPoint;
use crate::tasks::path_bounds::{BoundPoint, EdgeCause, Label, PathBound};
use crate::tasks::scene::Scene;

/// How far behind the ego's place the corridor may exclude it, and over which length that may last, m: a
/// car that has strayed over its bound must be allowed back.
const RETURN_LENGTH: f64 = 12.0;

/// Stations without which there is no path to speak of.
const LEAST_STATIONS: usize = 4;

/// How far a path leads beyond the place where the car stops, m.
const BEYOND_STOP: f64 = 1.0;

/// How far before its stop a car has to be in place, m: it stops straight.
const STRAIGHTEN: f64 = 2.0;

/// How far from its place across the line it may stop, m.
const ARRIVAL_TOLERANCE: f64 = 0.1;

/// Travel time, s, and least distance, m, before a stop at the road's edge in which a car goes there: nobody
/// drives along in the parking lane.
const PULL_IN: (f64, f64) = (4.0, 22.0);

/// Room beyond the buffer that a path would like to have to an obstacle, m.
const WANTED_ROOM: f64 = 0.5;

/// How much more the wish for room weighs than the wish to be in the middle of the lane, where there is as much as
/// wanted; with less it grows as the square of what lacks.
const ROOM_WEIGHT: f64 = 4.0;

/// What is left of the wanted room at least, as a share: the weight stays finite in a gap as wide as the car.
const LEAST_SHARE: f64 = 0.3;

/// How much the way of the tick before weighs against the middle of the lane.
const STAY_WEIGHT: f64 = 1.0;

/// Where a station would like the path to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pull {
    /// Offset, m.
    pub l: f64,
    /// How much that counts.
    pub weight: f64,
}

impl Pull {
    /// Adds a second wish: the sum of two squares is a square around their weighted mean, but for a constant.
    fn share_with(&mut self, l: f64, weight: f64) {
        let sum = self.weight + weight;
        self.l = (self.l * self.weight + l * weight) / sum;
        self.weight = sum;
    }
}

/// A bound at the stations of the path.
#[derive(Clone, Debug)]
pub(super) struct Corridor {
    /// Limits per station: right, left.
    pub limits: Vec<(f64, f64)>,
    /// What draws the path, per station.
    pub pulls: Vec<Pull>,
    /// `l`, `l'`, `l''` at the first station.
    pub start: [f64; 3],
    /// Length over which deviations are smoothed, m.
    pub smoothing_length: f64,
    /// Allowed overshoot per station, m.
    pub tolerance: Vec<f64>,
    /// How far a corner of the body may stand over the road's edge, m.
    pub road_tolerance: f64,
    /// Curvature of the line that the path should even out, per station: none where the line is fit to be driven.
    pub bends: Vec<f64>,
    /// The way of the tick before along these stations, as far as it leads.
    pub last: Option<Vec<f64>>,
}

/// How far a corner may stand over the road's edge, m: half of what counts as off the road; and in the bound after which
/// there is none: a street may be too tight for the car's corners, and to stand there for good helps nobody.
const ROAD_TOLERANCE: f64 = 0.15;
const LAST_ROAD_TOLERANCE: f64 = 0.25;

impl Corridor {
    /// The bound at every metre, each the narrowest of the stations around it. `None` if it is too short.
    pub(super) fn new(
        scene: &Scene,
        table: &LineTable,
        bound: &PathBound,
        goal: Goal,
        last: Option<&[PathPoint]>,
    ) -> Option<Self> {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small whole number"
        )]
        let stride = (STEP / bound.delta_s).round() as usize;
        let count = (bound.points.len().saturating_sub(1) / stride + 1).min(table.rows.len());
        if count < LEAST_STATIONS {
            return None;
        }
        // What lies beyond a stop does not concern the way there.
        let needed = goal.stop_s.map_or(count, |s| {
            table.rows.partition_point(|row| row.s < s + BEYOND_STOP)
        });
        let count = count.min(needed.max(LEAST_STATIONS));
        let mut limits: Vec<(f64, f64)> = (0..count)
            .map(|k| limits_near(&bound.points, k, stride))
            .collect();
        let mut pulls: Vec<Pull> = limits
            .iter()
            .enumerate()
            .map(|(k, limits)| pull(*limits, &bound.points[k * stride]))
            .collect();
        if let Some(stop_s) = goal.stop_s {
            arrive(scene, table, goal.l, stop_s, &mut limits, &mut pulls);
        }
        let last = last.map(|last| along(last, &table.rows[..count]));
        if let Some(last) = &last {
            for (pull, l) in pulls.iter_mut().zip(last) {
                pull.share_with(*l, STAY_WEIGHT);
            }
        }
        let config = &scene.config.path;
        let start = scene.lateral.l;
        let outside = (limits[0].0 - start[0]).max(start[0] - limits[0].1).max(0.0);
        let fade = |k: usize| (1.0 - k as f64 * STEP / RETURN_LENGTH).max(0.0);
        let tolerance = (0..count)
            .map(|k| config.bound_tolerance + outside * fade(k))
            .collect();
        let smoothing_length = (scene.start.v * config.smoothing_time).max(config.least_smoothing_length);
        Some(Self {
            limits,
            pulls,
            start,
            smoothing_length,
            tolerance,
            road_tolerance: if bound.label == Label::Fallback {
                LAST_ROAD_TOLERANCE
            } else {
                ROAD_TOLERANCE
            },
            bends: vec![0.0; count],
            last,
        })
    }

    /// The corridor for a path that was inside it a tick ago: as wide as the widest of a station and its neighbours.
    /// Stations move on with the car, so the same edge of the same obstacle comes and goes by one of them.
    pub(super) fn widened(&self) -> Self {
        let near = |k: usize| &self.limits[k.saturating_sub(1)..(k + 2).min(self.limits.len())];
        let widest = |(lo, hi): (f64, f64), limits: &(f64, f64)| (lo.min(limits.0), hi.max(limits.1));
        let limits = (0..self.limits.len())
            .map(|k| near(k).iter().fold((f64::MAX, -f64::MAX), widest))
            .collect();
        Self {
            limits,
            ..self.clone()
        }
    }

    /// The corridor for a path that rounds the bends of its line instead of keeping beside it.
    pub(super) fn rounding(&self, table: &LineTable) -> Self {
        Self {
            bends: table.rows[..self.len()].iter().map(|row| row.kappa).collect(),
            ..self.clone()
        }
    }

    /// Number of stations.
    pub(super) fn len(&self) -> usize {
        self.limits.len()
    }
}

/// What the stations around number `k` of the path have in common.
fn limits_near(points: &[BoundPoint], k: usize, stride: usize) -> (f64, f64) {
    let (first, last) = ((k * stride).saturating_sub(stride - 1), k * stride + stride - 1);
    let near = &points[first..=last.min(points.len() - 1)];
    let (lo, hi) = near.iter().fold((-f64::MAX, f64::MAX), |(lo, hi), p| {
        (lo.max(p.l_min), hi.min(p.l_max))
    });
    let here = &points[k * stride];
    // Where the corridor jumps aside between two stations they need not have anything in common.
    if lo <= hi {
        (lo, hi)
    } else {
        (here.l_min, here.l_max)
    }
}

/// The line where it is free; beside an obstacle with some room to it, shared where there is one on either side.
fn pull((lo, hi): (f64, f64), point: &BoundPoint) -> Pull {
    let room = |cause| {
        if matches!(cause, EdgeCause::Obstacle(_)) {
            WANTED_ROOM
        } else {
            0.0
        }
    };
    let (right, left) = (room(point.right), room(point.left));
    let (lowest, highest) = (lo + right, hi - left);
    let (l, share) = if lowest <= highest {
        (0.0_f64.clamp(lowest, highest), 1.0)
    } else {
        let share = (hi - lo) / (right + left);
        (lo + right * share, share.max(LEAST_SHARE))
    };
    let weight = if right + left > 0.0 {
        ROOM_WEIGHT / (share * share)
    } else {
        1.0
    };
    Pull {
        l: l.clamp(lo, hi),
        weight,
    }
}

/// Offsets of an old path at these stations, ending where it ends.
fn along(old: &[PathPoint], rows: &[Row]) -> Vec<f64> {
    let offset = |row: &Row| {
        let above = old.partition_point(|p| p.s <= row.s);
        let (a, b) = (old.get(above.checked_sub(1)?)?, old.get(above)?);
        Some(a.l + (b.l - a.l) * (row.s - a.s) / (b.s - a.s))
    };
    rows.iter().map_while(offset).collect()
}

/// Draws the end of the path to a place at the road's edge and has it arrive there straight.
fn arrive(
    scene: &Scene,
    table: &LineTable,
    l: f64,
    stop_s: f64,
    limits: &mut [(f64, f64)],
    pulls: &mut [Pull],
) {
    let pull_in = (scene.start.v * PULL_IN.0).max(PULL_IN.1);
    for ((limits, pull), row) in limits.iter_mut().zip(pulls).zip(&table.rows) {
        let (lo, hi) = *limits;
        let place = l.clamp(lo, hi);
        if row.s >= stop_s - pull_in {
            pull.l = place;
        }
        if row.s >= stop_s - STRAIGHTEN {
            *limits = (
                lo.max(place - ARRIVAL_TOLERANCE),
                hi.min(place + ARRIVAL_TOLERANCE),
            );
        }
    }
}
