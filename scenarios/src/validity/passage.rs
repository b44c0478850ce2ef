//! How wide the way is past everything that stands.
//!
//! The ground that may be used is the ego's lane and a neighbouring lane of either direction where the line
//! between them may be crossed. Two widths are measured, each at its tightest place. The *strict* one is the
//! widest gap at a single station: a car wider than that cannot pass. The *roomy* one takes obstacles that are
//! close behind each other together and takes off what a careful planner keeps clear of each: a car narrower
//! than that must pass.

use super::Scene;
use super::footprint::{FrenetBox, project_near};
use crate::scenario::Behaviour;
use corridor_decider::reference_line::{LineSample, SlPoint};
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
        let bodies: Vec<Body> = bodies(scene)
            .filter(|body| body.ground.meets_stations(from, to))
            .collect();
        let mut passage = Self {
            strict: f64::MAX,
            roomy: f64::MAX,
        };
        for body in &bodies {
            // Between corners all edges are straight, so the way is narrowest at one of them.
            for corner in &body.outline {
                let here = bodies.iter().filter_map(|b| b.across(corner.s));
                let ground = usable(scene.road.line.sample_at(corner.s));
                passage.strict = passage.strict.min(widest(ground, here));
            }
            let ground = usable(scene.road.line.sample_at(body.ground.s.0));
            let near = bodies.iter().map(|b| b.ground);
            let near =
                near.filter(|b| b.meets_stations(body.ground.s.0 - WEAVING, body.ground.s.1 + WEAVING));
            let kept_clear = near.map(|b| (b.l.0 - SIDE_BUFFER, b.l.1 + SIDE_BUFFER));
            passage.roomy = passage.roomy.min(widest(ground, kept_clear));
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

/// Something that stands: its corners in the frame of the route's line, and the box around them.
struct Body {
    outline: Vec<SlPoint>,
    ground: FrenetBox,
}

impl Body {
    /// Offsets that it covers at station `s`: (rightmost, leftmost).
    fn across(&self, s: f64) -> Option<(f64, f64)> {
        let next = self.outline.iter().cycle().skip(1);
        let mut span: Option<(f64, f64)> = None;
        for (a, b) in self.outline.iter().zip(next) {
            if (a.s - s) * (b.s - s) > 0.0 {
                continue;
            }
            // An edge along this very station counts with both its ends.
            let shares = if (b.s - a.s).abs() > 0.0 {
                [(s - a.s) / (b.s - a.s); 2]
            } else {
                [0.0, 1.0]
            };
            for share in shares {
                let l = a.l + (b.l - a.l) * share;
                let (low, high) = span.unwrap_or((l, l));
                span = Some((low.min(l), high.max(l)));
            }
        }
        span
    }
}

fn bodies<'a>(scene: &'a Scene<'_>) -> impl Iterator<Item = Body> + 'a {
    let draft = scene.draft;
    let obstacles = draft.obstacles.iter().zip(&draft.spots).zip(&scene.boxes);
    obstacles.filter_map(|((obstacle, spot), ground)| {
        let Behaviour::Parked(pose) = obstacle.behaviour else {
            return None;
        };
        let corners = obstacle.shape.at(pose);
        let outline = corners
            .vertices()
            .iter()
            .map(|v| project_near(&scene.road.line, *v, spot.s));
        Some(Body {
            outline: outline.collect(),
            ground: *ground,
        })
    })
}

/// The widest gap that what is blocked, as (rightmost, leftmost), leaves of `ground`.
fn widest(ground: (f64, f64), blocked: impl Iterator<Item = (f64, f64)>) -> f64 {
    let mut blocked: Vec<(f64, f64)> = blocked.collect();
    blocked.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut free_from, mut best) = (ground.0, 0.0_f64);
    for (right, left) in blocked {
        best = best.max(right.min(ground.1) - free_from);
        free_from = free_from.max(left);
    }
    best.max(ground.1 - free_from)
}
