//! What the router tells the decider: the command of the moment and the lines to plan along.

use corridor_decider::frame::{Command, EgoState, FrameLine};
use corridor_decider::lane_follow_map::{LaneFollowConfig, VehicleState};
use corridor_decider::reference_line::{LineProvider, LineQuery, ProviderError, ReferenceLine, RouteLine};
use corridor_scenarios::Scenario;
use std::sync::Arc;

/// A scenario's route while it is driven.
#[derive(Clone, Debug)]
pub(crate) struct Route {
    guide: Guide,
    command: Command,
    command_time: f64,
    cruise_speed: f64,
    /// All lines that frames have held, in the order that [`Route::places`] refers to.
    known: Vec<Arc<ReferenceLine>>,
}

/// Where the lines come from.
#[derive(Clone, Debug)]
enum Guide {
    /// Lines along lanes that the scenario names, for the whole drive.
    Fixed {
        line: Arc<ReferenceLine>,
        target: Option<Arc<ReferenceLine>>,
        /// Whether the ego has reached the lane to change to; it is its own lane from then on.
        changed: bool,
    },
    /// Lines of the passages of a route, which grow as it is driven.
    Routed {
        provider: Box<LineProvider>,
        /// Those of the last tick: an ego that has strayed off its route finds back along them.
        last: Vec<FrameLine>,
        /// Why there are none for this tick.
        lost: Option<ProviderError>,
    },
}

impl Route {
    pub(crate) fn new(scenario: &Scenario, follow: &LaneFollowConfig) -> Self {
        let (guide, known) = match &scenario.provider {
            Some(provider) => (
                Guide::Routed {
                    provider: Box::new(configured(provider, follow)),
                    last: Vec::new(),
                    lost: None,
                },
                Vec::new(),
            ),
            None => (
                Guide::Fixed {
                    line: Arc::clone(&scenario.line),
                    target: scenario.target_line.clone(),
                    changed: false,
                },
                std::iter::once(&scenario.line)
                    .chain(&scenario.target_line)
                    .cloned()
                    .collect(),
            ),
        };
        Self {
            guide,
            command: scenario.command,
            command_time: scenario.command_time,
            cruise_speed: scenario.cruise_speed,
            known,
        }
    }

    /// The lines that are known from the start; others come as the route is driven.
    pub(crate) fn first_lines(&self) -> &[Arc<ReferenceLine>] {
        &self.known
    }

    pub(crate) fn cruise_speed(&self) -> f64 {
        self.cruise_speed
    }

    /// The command, once it has been given.
    pub(crate) fn command(&self, time: f64) -> Command {
        let is_done = matches!(self.guide, Guide::Fixed { changed: true, .. });
        if time >= self.command_time && !is_done {
            self.command
        } else {
            Command::Cruise
        }
    }

    /// The ego's line and, while a change of lane is wanted and not done, the one to change to.
    pub(crate) fn lines(&mut self, ego: &EgoState, time: f64) -> Vec<FrameLine> {
        let is_asked = time >= self.command_time && matches!(self.command, Command::ChangeLane(_));
        match &mut self.guide {
            Guide::Fixed {
                line,
                target,
                changed,
            } => fixed(line, target.as_ref(), changed, ego, is_asked),
            Guide::Routed { provider, last, lost } => {
                let state = VehicleState {
                    position: ego.pose.position(),
                    heading: ego.pose.theta,
                    speed: ego.v,
                };
                match provider.lines(&state) {
                    Ok(lines) => {
                        *lost = None;
                        *last = lines.into_iter().take(2).map(offered).collect();
                    }
                    Err(error) => *lost = Some(error),
                }
                last.clone()
            }
        }
    }

    /// Why the lines of this tick are those of an earlier one, if they are.
    pub(crate) fn lost(&self) -> Option<&ProviderError> {
        match &self.guide {
            Guide::Routed { lost, .. } => lost.as_ref(),
            Guide::Fixed { .. } => None,
        }
    }

    /// Places of a frame's lines among all lines, each with whether it is a change of lane, and the lines among them
    /// that no frame before has held.
    pub(crate) fn places(&mut self, lines: &[FrameLine]) -> (Vec<(usize, bool)>, Vec<Arc<ReferenceLine>>) {
        let known_before = self.known.len();
        let mut places = Vec::with_capacity(lines.len());
        for FrameLine { line, is_change_lane } in lines {
            let found = self.known.iter().position(|known| Arc::ptr_eq(known, line));
            places.push((found.unwrap_or(self.known.len()), *is_change_lane));
            if found.is_none() {
                self.known.push(Arc::clone(line));
            }
        }
        (places, self.known[known_before..].to_vec())
    }
}

/// The provider with other knobs; the route was followed once already, so it can be again.
fn configured(provider: &LineProvider, follow: &LaneFollowConfig) -> LineProvider {
    let usual = || provider.clone();
    usual().with_config(follow.clone()).unwrap_or_else(|_| usual())
}

fn offered(line: RouteLine) -> FrameLine {
    FrameLine {
        is_change_lane: !line.segments.is_on_segment,
        line: line.line,
    }
}

/// The lines of a drive along lanes that are named.
fn fixed(
    line: &Arc<ReferenceLine>,
    target: Option<&Arc<ReferenceLine>>,
    changed: &mut bool,
    ego: &EgoState,
    is_asked: bool,
) -> Vec<FrameLine> {
    let along = |line: &Arc<ReferenceLine>, is_change_lane| FrameLine {
        line: Arc::clone(line),
        is_change_lane,
    };
    let Some(target) = target else {
        return vec![along(line, false)];
    };
    *changed |= is_in_lane(target, ego);
    if *changed {
        vec![along(target, false)]
    } else if is_asked {
        vec![along(line, false), along(target, true)]
    } else {
        vec![along(line, false)]
    }
}

/// Whether the ego's reference point is in the lane of a line.
fn is_in_lane(line: &ReferenceLine, ego: &EgoState) -> bool {
    let at = line.to_frenet(ego.pose.position());
    line.lane_width(at.s)
        .is_some_and(|(left, right)| at.l <= left && at.l >= -right)
}
