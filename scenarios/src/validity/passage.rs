//! How wide the way is past everything that stands.
//!
//! The ground that may be used is the ego's lane and a neighbouring lane of either direction where the line
//! between them may be crossed. Two widths are measured, each at its tightest place. The *strict* one is the
//! widest gap at a single station: a car wider than that cannot pass. The *roomy* one takes obstacles that are
//! close behind each other together and takes off what a careful planner keeps clear of each: a car narrower
//! than that must pass.

use super::{FrenetBox, Scene};
use corridor_decider::reference_line::LineSample;
use corridor_decider::road::{BoundaryType, Neighbour, Side};

/// What a careful planner keeps clear of an obstacle, m: the original's `obstacle_lat_buffer`.
const SIDE_BUFFER: f64 = 0.4;

/// Obstacles nearer behind each other than this are taken together, m: too near to weave between them.
const WEAVING: f64 = 25.0;

/// Width that a path sampled and tracked with centimetres of error needs beside the car's, m.
const TRACKING: f64 = 0.2;

/// The way past what stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Passage {
    /// Below the car's width: closed.
    pub(crate) strict: f64,
    /// At least the car's width and a little: open.
    pub(crate) roomy: f64,
}

impl Passage {
    /// Measures from the ego's front bumper on for `distance` metres.
    pub(crate) fn measure(scene: &Scene<'_>, distance: f64) -> Self {
        let (from, to) = (scene.front(), scene.front() + distance);
        let bodies: Vec<FrenetBox> = scene.standing().filter(|b| b.meets_stations(from, to)).collect();
        let mut passage = Self {
            strict: f64::MAX,
            roomy: f64::MAX,
        };
        for body in &bodies {
            let sample = scene.road.line.sample_at(body.s.0);
            let ground = usable(sample);
            let here = bodies.iter().filter(|b| b.s.0 <= body.s.0 && b.s.1 >= body.s.0);
            passage.strict = passage.strict.min(widest(ground, here, 0.0));
            let near = bodies
                .iter()
                .filter(|b| b.meets_stations(body.s.0 - WEAVING, body.s.1 + WEAVING));
            passage.roomy = passage.roomy.min(widest(ground, near, SIDE_BUFFER));
        }
        passage
    }

    /// Whether a car of this width must pass.
    pub(crate) fn is_open(&self, width: f64) -> bool {
        self.roomy >= width + TRACKING
    }

    /// Whether a car of this width cannot pass.
    pub(crate) fn is_closed(&self, width: f64) -> bool {
        self.strict < width
    }
}

/// Offsets that may be driven at one station: (rightmost, leftmost).
fn usable(sample: &LineSample) -> (f64, f64) {
    let beside = |side, mark| {
        let widths = [false, true].map(|reverse| sample.neighbours[Neighbour { side, reverse }.index()]);
        let width = widths.into_iter().flatten().fold(0.0, f64::max);
        if may_cross(mark) { width } else { 0.0 }
    };
    let (left, right) = sample.lane_width;
    (
        -right - beside(Side::Right, sample.marks.1),
        left + beside(Side::Left, sample.marks.0),
    )
}

/// Whether a lane may be left over this line; the original's rule for borrowing.
fn may_cross(mark: BoundaryType) -> bool {
    !matches!(mark, BoundaryType::SolidYellow | BoundaryType::SolidWhite)
}

/// The widest gap that `bodies`, each widened by `buffer`, leave of `ground`.
fn widest<'a>(ground: (f64, f64), bodies: impl Iterator<Item = &'a FrenetBox>, buffer: f64) -> f64 {
    let mut blocked: Vec<(f64, f64)> = bodies.map(|b| (b.l.0 - buffer, b.l.1 + buffer)).collect();
    blocked.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut free_from, mut best) = (ground.0, 0.0_f64);
    for (right, left) in blocked {
        best = best.max(right.min(ground.1) - free_from);
        free_from = free_from.max(left);
    }
    best.max(ground.1 - free_from)
}
