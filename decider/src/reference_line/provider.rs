//! The reference lines of a tick: those of the passages that the route lets the car use from where it is (the
//! original's `ReferenceLineProvider`).
//!
//! Where the original smooths on a thread of its own and takes what is ready, here a line grows when the car needs more
//! of it, at the same place in every run.

use super::clear::{Cleared, cleared};
use super::line::LineError;
use super::query::LineQuery;
use super::stitch::StitchedLine;
use crate::hd_map::{HdMap, HdMapError};
use crate::lane_follow_map::{
    FollowError, LaneFollowConfig, LaneFollowMap, RouteError, RouteSegments, VehicleState,
};
use crate::reference_line::ReferenceLine;
use crate::road::RoadMap;
use crate::routing::RoutingResponse;
use crate::vehicle::VehicleParams;
use std::sync::Arc;

/// How much farther than it is needed a line is made, m (the original's `look_forward_extend_distance`): it grows once
/// in a few seconds, and not in every tick.
const EXTENSION: f64 = 50.0;

/// A line is cut when more than this lies behind the car, m.
const LONGEST_BEHIND: f64 = 150.0;

/// How much of it stays then, m (half as much again as the lane-follow map looks back).
const KEPT_BEHIND: f64 = 75.0;

/// Why there is no line to plan along.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProviderError {
    /// The map cannot be followed.
    #[error(transparent)]
    Map(#[from] HdMapError),
    /// The route cannot be followed on the map.
    #[error(transparent)]
    Route(#[from] RouteError),
    /// The car is not on the route.
    #[error(transparent)]
    Follow(#[from] FollowError),
    /// The lanes of the car's own passage give no line.
    #[error(transparent)]
    Line(#[from] LineError),
}

/// A line to plan along, with what the route says about its lanes.
#[derive(Clone, Debug)]
pub struct RouteLine {
    /// The line; the same one until it has to grow.
    pub line: Arc<ReferenceLine>,
    /// The lanes of this tick's window, and what they are for.
    pub segments: RouteSegments,
}

/// Follows a route with smooth lines.
#[derive(Clone, Debug)]
pub struct LineProvider {
    roads: Arc<RoadMap>,
    follow: LaneFollowMap,
    vehicle: VehicleParams,
    lines: Vec<Cleared>,
}

impl LineProvider {
    /// Begins to follow a route.
    ///
    /// # Errors
    /// [`ProviderError`] when the map or the route cannot be followed.
    pub fn new(
        roads: Arc<RoadMap>,
        hd_map: Arc<HdMap>,
        route: RoutingResponse,
    ) -> Result<Self, ProviderError> {
        let mut follow = LaneFollowMap::new(hd_map, LaneFollowConfig::default());
        follow.update_route(route)?;
        Ok(Self {
            roads,
            follow,
            vehicle: VehicleParams::default(),
            lines: Vec::new(),
        })
    }

    /// The same for a given car: its lines keep it inside its lane.
    #[must_use]
    pub fn with_vehicle(self, vehicle: VehicleParams) -> Self {
        Self { vehicle, ..self }
    }

    /// The same with other knobs of the lane-follow map.
    ///
    /// # Errors
    /// [`ProviderError`] when the route cannot be followed with them.
    pub fn with_config(self, config: LaneFollowConfig) -> Result<Self, ProviderError> {
        Ok(Self {
            follow: self.follow.with_config(config)?,
            lines: Vec::new(),
            ..self
        })
    }

    /// What is known of the route and the car on it.
    pub fn lane_follow_map(&self) -> &LaneFollowMap {
        &self.follow
    }

    /// The lines for a car in this state: that of its own passage first, then those that it can change to. A passage
    /// beside the own one that gives no line is left out.
    ///
    /// # Errors
    /// [`ProviderError`] when the car is not on the route, or its own lanes give no line.
    pub fn lines(&mut self, state: &VehicleState) -> Result<Vec<RouteLine>, ProviderError> {
        let mut windows = self.follow.route_segments(state)?;
        windows.sort_by_key(|window| !window.is_on_segment);
        let mut kept = Vec::with_capacity(windows.len());
        let mut lines = Vec::with_capacity(windows.len());
        for window in windows {
            match self.line_for(state, &window) {
                Ok(line) => {
                    lines.push(RouteLine {
                        line: Arc::clone(line.line.line()),
                        segments: window,
                    });
                    kept.push(line);
                }
                Err(error) if window.is_on_segment => return Err(error),
                Err(_) => {}
            }
        }
        self.lines = kept;
        Ok(lines)
    }

    /// A line that holds a window: one of the last tick's, grown if it has to be, else a new one.
    fn line_for(&mut self, state: &VehicleState, window: &RouteSegments) -> Result<Cleared, ProviderError> {
        let mut known = self.lines.iter();
        if let Some(known) = known.find(|known| known.line.covers(&window.segments) || known.serves(window)) {
            return Ok(known.clone());
        }
        let longer = self.follow.extend(window, 0.0, window.length() + EXTENSION);
        let chain = longer.as_ref().unwrap_or(window).segments.clone();
        let led_on = |known: &Cleared| known.line.led_on(&self.roads, &chain, &self.vehicle);
        let line = match self.lines.iter().find_map(led_on) {
            Some(longer) => longer?,
            None => StitchedLine::new(&self.roads, chain, &self.vehicle)?,
        };
        let car = window.car.and_then(|car| line.station_of(&car));
        let here = car.unwrap_or_else(|| line.line().to_frenet(state.position).s);
        let line = if here - line.line().start() > LONGEST_BEHIND {
            line.cut_behind(here, KEPT_BEHIND)
        } else {
            line
        };
        Ok(cleared(line, here))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vec2;
    use crate::road::LaneId;
    use crate::routing::tests::motorway;
    use crate::routing::{BlackList, LaneGraph, Position, RoutingConfig, WayPoint};

    /// From the left lane of a motorway of five times 100 m to the right one.
    fn provider() -> LineProvider {
        let roads = Arc::new(RoadMap::new(motorway(5), Vec::new()).unwrap());
        let at = |lane, s| {
            WayPoint::OnLane(Position {
                lane: LaneId(lane),
                s,
            })
        };
        let graph = LaneGraph::new(&roads, RoutingConfig::default());
        let route = graph
            .route(&roads, &[at(0, 0.0), at(14, 90.0)], &BlackList::default())
            .unwrap();
        let hd_map = Arc::new(HdMap::of_roads(&roads).unwrap());
        LineProvider::new(roads, hd_map, route).unwrap()
    }

    fn car(x: f64, y: f64) -> VehicleState {
        VehicleState {
            position: Vec2::new(x, y),
            heading: 0.0,
            speed: 10.0,
        }
    }

    #[test]
    fn each_lane_on_the_way_is_offered_in_its_turn() {
        let mut provider = provider();
        for (y, beside) in [(0.0, Some(-3.5)), (-3.5, Some(-7.0)), (-7.0, None)] {
            for x in [20.0, 22.0, 24.0] {
                let lines = provider.lines(&car(x, y + 0.2)).unwrap();
                let offsets: Vec<f64> = lines.iter().map(|line| line.line.point(x).y).collect();
                let wanted: Vec<f64> = [y].into_iter().chain(beside).collect();
                assert_eq!(offsets.len(), wanted.len(), "{x} {y}: {offsets:?}");
                for (have, want) in offsets.iter().zip(wanted) {
                    assert!((have - want).abs() < 1e-9, "{x} {y}: {offsets:?}");
                }
                assert!(lines[0].segments.is_on_segment);
            }
        }
    }
}
