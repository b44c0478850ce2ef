//! `PATH_BOUNDS_DECIDER`: how far left and right the rear axle may be at each station ahead.
//!
//! Rebuilt from the behaviour of Apollo 8.0's task of that name. What is right there is reproduced to the bit;
//! what is a defect is put right and kept as a switch in [`Quirks`]. All bounds are in the Frenet frame of one
//! reference line, metres, with half the car's width already taken off.

mod bound;
mod columns;
mod config;
mod edges;
mod forbidden;
mod gaps;
mod greedy;
mod input;
mod lane_change;
mod lanes;
mod obstacles;
mod pull_over;
mod road;
mod search;
mod stations;
mod task;
#[cfg(test)]
mod tests;

pub use bound::{Borrow, BoundPoint, EdgeCause, Label, LaneType, PathBound};
pub use config::{PathBoundsConfig, Quirks};
pub use input::{ChangeLane, EgoFrenet, Input, Memory, ObstacleSl, PullOver, PullOverKind, PullOverPlace};
pub use pull_over::PullOverRefusal;
pub use stations::Station;
pub(crate) use stations::station;
pub use task::run;

use crate::frame::ObstacleId;
use crate::reference_line::LineQuery;
use crate::road::Side;
use forbidden::Forbidden;
use lanes::{LaneRules, OwnLane};
use obstacles::{Beside, Passage, Widening};

/// Room beside the ego in the fallback bound, m.
const FALLBACK_EGO_BUFFER: f64 = 0.5;

/// Room beside the ego in regular and lane-change bounds, m.
const EGO_BUFFER: f64 = 0.1;

/// Stations that the original adds behind a block (`kNumExtraTailBoundPoint`).
const PADDING: usize = 20;

/// Why a call gives no bounds at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PathBoundsError {
    /// The ego is at or beyond the end of the line.
    #[error("the ego is at or beyond the end of the reference line")]
    NoStations,
    /// Not even the fallback leaves room for the car.
    #[error("the fallback bound is empty")]
    EmptyFallback,
    /// The lane-change bound leaves no room for the car.
    #[error("the lane-change bound is empty")]
    EmptyLaneChange,
    /// The ego is outside a bound's first station; the original aborts the process then. Only with the quirk
    /// `asserts_ego_inside`.
    #[error("the ego is outside the first station of its `{0}` bound")]
    EgoOutside(Label),
}

/// The candidate bounds of one tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PathBounds {
    /// The bounds in the original's order: the fallback first.
    pub bounds: Vec<PathBound>,
    /// Per bound, on which side it passes each obstacle.
    pub passed: Vec<Vec<(ObstacleId, Side)>>,
    /// Why a wanted pull-over got no bound.
    pub refusal: Option<PullOverRefusal>,
}

impl PathBounds {
    fn push(&mut self, label: Label, made: Made, blocked_by: Option<ObstacleId>) {
        self.bounds.push(PathBound {
            label,
            delta_s: stations::RESOLUTION,
            points: made.points,
            blocked_by,
            padding: made.padding,
        });
        self.passed.push(made.passage.passed);
    }
}

/// What all candidates of a call share.
struct Survey {
    stations: Vec<Station>,
    lane: Vec<OwnLane>,
    beside: Vec<Beside>,
    /// What obstacles forbid all candidates but the fallback.
    forbidden: Vec<Forbidden>,
}

impl Survey {
    fn lane_bound(&self, input: &Input, rules: LaneRules) -> (Vec<BoundPoint>, Option<LaneType>) {
        lanes::bound(&self.lane, &self.stations, input, rules)
    }
}

/// A bound before it gets its label.
struct Made {
    points: Vec<BoundPoint>,
    padding: usize,
    passage: Passage,
}

/// Decides the bounds of one tick along one line (the original's `Process`).
///
/// # Errors
/// [`PathBoundsError`] when there is no bound to give, not even a fallback.
pub fn decide<L: LineQuery + ?Sized>(
    line: &L,
    input: &Input,
    memory: &mut Memory,
) -> Result<PathBounds, PathBoundsError> {
    let mut result = PathBounds::default();
    if input.config.enable_skip_path_tasks && input.path_reusable {
        return Ok(result);
    }
    let stations = stations::sample(line, input);
    if stations.is_empty() {
        return Err(PathBoundsError::NoStations);
    }
    let beside = obstacles::beside(&stations, input, &memory.passed);
    let survey = Survey {
        lane: lanes::own(&stations, input),
        forbidden: forbidden::intervals(input, &beside, Widening::regular(input.config)),
        beside,
        stations,
    };
    let fallback = fallback(&survey, input);
    if fallback.points.is_empty() {
        return Err(PathBoundsError::EmptyFallback);
    }
    check_ego_inside(&fallback.points, input, Label::Fallback)?;
    let blocker = fallback.passage.blocked_by;
    result.push(Label::Fallback, fallback, blocker);

    if memory.pull_over.is_requested {
        match pull_over::bound(&survey.stations, &survey.forbidden, line, input, memory) {
            Ok((points, passage)) => {
                check_ego_inside(&points, input, Label::PullOver)?;
                let blocker = passage.blocked_by.filter(|_| !input.config.quirks.silent_blocker);
                result.push(
                    Label::PullOver,
                    Made {
                        points,
                        padding: 0,
                        passage,
                    },
                    blocker,
                );
                if input.config.quirks.pull_over_stands_alone {
                    return Ok(result);
                }
            }
            Err(refusal) => result.refusal = Some(refusal),
        }
    }
    if input.is_change_lane && input.config.enable_smarter_lane_change {
        lane_change(&mut result, &survey, line, input, memory)?;
    } else {
        regular(&mut result, &survey, input)?;
    }
    Ok(result)
}

/// The bound in which some path practically always exists.
fn fallback(survey: &Survey, input: &Input) -> Made {
    let rules = LaneRules {
        borrow: Borrow::None,
        buffer: FALLBACK_EGO_BUFFER,
        force_extend: true,
        hold_until: None,
    };
    let (mut points, _) = survey.lane_bound(input, rules);
    let mut passage = Passage::default();
    if !input.config.quirks.fallback_ignores_obstacles {
        let forbidden = forbidden::intervals(input, &survey.beside, Widening::fallback(input.config));
        passage = obstacles::limit(&mut points, input, &forbidden);
        // An ego that already touches a widened obstacle still needs a bound to brake in.
        if points.is_empty() {
            (points, _) = survey.lane_bound(input, rules);
        }
    }
    Made {
        points,
        padding: 0,
        passage,
    }
}

/// Into the target lane, once the zone before it allows.
fn lane_change<L: LineQuery + ?Sized>(
    result: &mut PathBounds,
    survey: &Survey,
    line: &L,
    input: &Input,
    memory: &mut Memory,
) -> Result<(), PathBoundsError> {
    let zone_end = lane_change::zone_end(line, input, &mut memory.change_lane);
    let rules = LaneRules {
        borrow: Borrow::None,
        buffer: EGO_BUFFER,
        force_extend: true,
        hold_until: zone_end,
    };
    let (mut points, _) = survey.lane_bound(input, rules);
    if let Some(end) = zone_end {
        lane_change::keep_out(&mut points, &survey.stations, input, end);
    }
    let made = around_obstacles(points, input, &survey.forbidden);
    if made.points.is_empty() {
        if input.config.quirks.lane_change_discards_fallback {
            return Err(PathBoundsError::EmptyLaneChange);
        }
        return Ok(());
    }
    if input.config.is_extend_lane_bounds_to_include_adc {
        check_ego_inside(&made.points, input, Label::LaneChange)?;
    }
    let blocker = made
        .passage
        .blocked_by
        .filter(|_| !input.config.quirks.silent_blocker);
    result.push(Label::LaneChange, made, blocker);
    Ok(())
}

/// Along the own lane, then with each lane that may be borrowed.
fn regular(result: &mut PathBounds, survey: &Survey, input: &Input) -> Result<(), PathBoundsError> {
    for borrow in [Borrow::None].iter().chain(input.borrow) {
        let rules = LaneRules {
            borrow: *borrow,
            buffer: EGO_BUFFER,
            force_extend: false,
            hold_until: None,
        };
        let (points, Some(lane)) = survey.lane_bound(input, rules) else {
            continue;
        };
        let made = around_obstacles(points, input, &survey.forbidden);
        if made.points.is_empty() {
            continue;
        }
        let label = Label::Regular {
            borrow: *borrow,
            lane,
        };
        if input.config.is_extend_lane_bounds_to_include_adc {
            check_ego_inside(&made.points, input, label)?;
        }
        let blocker = made.passage.blocked_by;
        result.push(label, made, blocker);
    }
    Ok(())
}

/// Narrows a lane bound to a way around static obstacles.
fn around_obstacles(mut points: Vec<BoundPoint>, input: &Input, forbidden: &[Forbidden]) -> Made {
    let pads = input.config.quirks.pad_through_blocker;
    let open = if pads { points.clone() } else { Vec::new() };
    let passage = obstacles::limit(&mut points, input, forbidden);
    let mut padding = 0;
    if passage.blocked_by.is_some() && pads {
        let tail = open.iter().skip(points.len()).take(PADDING);
        let before = points.len();
        points.extend(tail);
        padding = points.len() - before;
    }
    Made {
        points,
        padding,
        passage,
    }
}

/// The original's assertion that the ego is inside a bound's first station.
fn check_ego_inside(points: &[BoundPoint], input: &Input, label: Label) -> Result<(), PathBoundsError> {
    let inside = |point: &BoundPoint| point.l_min <= input.ego.l && input.ego.l <= point.l_max;
    if input.config.quirks.asserts_ego_inside && !points.first().is_some_and(inside) {
        return Err(PathBoundsError::EgoOutside(label));
    }
    Ok(())
}
