//! `label_flips`, `side_flips`: whether the decider makes up its mind.

use super::measure::{Extreme, Measure};
use super::plan::Plan;
use corridor_decider::frame::{Frame, ObstacleId};
use corridor_decider::road::Side;
use corridor_decider::tasks::path_bounds::{EdgeCause, Label};
use std::collections::BTreeMap;

/// Good number of changes of the driven label in a minute.
pub(super) const LABEL_LIMIT: f64 = 6.0;

/// Good number of changes of the side on which one obstacle is passed.
pub(super) const SIDE_LIMIT: f64 = 1.0;

/// Least time over which changes are counted, s: in a run of 10 s one borrow, out and back, would be twelve a minute.
const SHORTEST: f64 = 60.0;

/// The side on which an obstacle is passed, and how often that changed.
#[derive(Clone, Copy, Debug)]
struct Pass {
    side: Side,
    flips: u32,
}

/// Watches labels and sides.
#[derive(Clone, Debug, Default)]
pub(super) struct LabelWatch {
    last: Option<Label>,
    flips: u32,
    last_flip: Option<f64>,
    begin: Option<f64>,
    end: f64,
    passes: BTreeMap<ObstacleId, Pass>,
    sides: Extreme,
}

impl LabelWatch {
    pub(super) fn tick(&mut self, frame: &Frame, plan: &Plan) {
        self.begin.get_or_insert(frame.time);
        self.end = frame.time;
        let Some(bound) = &plan.bound else { return };
        if self.last.is_some_and(|last| last != bound.label) {
            self.flips += 1;
            self.last_flip = Some(frame.time);
        }
        self.last = Some(bound.label);
        for point in &bound.points[..bound.points.len().saturating_sub(bound.padding)] {
            // What limits the left edge is passed on its right.
            if let EdgeCause::Obstacle(id) = point.left {
                self.pass(id, Side::Right, frame.time);
            }
            if let EdgeCause::Obstacle(id) = point.right {
                self.pass(id, Side::Left, frame.time);
            }
        }
    }

    fn pass(&mut self, id: ObstacleId, side: Side, time: f64) {
        let pass = self.passes.entry(id).or_insert(Pass { side, flips: 0 });
        if pass.side != side {
            pass.side = side;
            pass.flips += 1;
        }
        self.sides.raise(f64::from(pass.flips), time, Some(id));
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        let minutes = self.begin.map(|begin| (self.end - begin).max(SHORTEST) / 60.0);
        let rate = minutes.map(|m| f64::from(self.flips) / m);
        vec![
            Measure::new("label_flips", rate).at(self.last_flip),
            self.sides.measure("side_flips"),
        ]
    }
}
