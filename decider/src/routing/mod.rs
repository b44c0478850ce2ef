//! Routes over the lane graph of a map, in the shape of the original's routing module.
//!
//! [`LaneGraph::route`] finds a cheapest way from way-point to way-point by A* and answers with roads, passages and
//! lane segments. Costs are the original's (`topo_creator`): length weighed by the speed limit, turns, changes.

mod config;
mod cuts;
mod graph;
mod passages;
mod request;
mod response;
mod search;
#[cfg(test)]
pub(crate) mod tests;

pub use config::RoutingConfig;
pub use graph::LaneGraph;
pub use request::{BlackList, Position, RoutingError, WayPoint};
pub use response::{ChangeLaneType, LaneSegment, LaneWaypoint, Passage, RoadSegment, RoutingResponse};

use crate::road::{RoadMap, Side};
use cuts::Cuts;
use passages::{Chain, Piece, Stage};
use search::{Leg, Move};

impl LaneGraph {
    /// The cheapest route through `way_points` in their order, around what is black-listed. A place where lanes cross
    /// is passed on whichever of them serves best.
    ///
    /// # Errors
    /// [`RoutingError`] that names the way-points between which there is no route, and why.
    pub fn route(
        &self,
        map: &RoadMap,
        way_points: &[WayPoint],
        black: &BlackList,
    ) -> Result<RoutingResponse, RoutingError> {
        if way_points.len() < 2 {
            return Err(RoutingError::TooFewWayPoints(way_points.len()));
        }
        let mut ways = Vec::new();
        for (index, at) in way_points.iter().enumerate() {
            let candidates = request::candidates(map, index, *at)?;
            ways = self.lead_to(map, black, &ways, index, candidates)?;
        }
        Ok(response(self, map, black, &cheapest(ways)))
    }

    /// The best way to each candidate of a way-point, from the ways to the one before.
    fn lead_to(
        &self,
        map: &RoadMap,
        black: &BlackList,
        before: &[Way],
        index: usize,
        candidates: Vec<Position>,
    ) -> Result<Vec<Way>, RoutingError> {
        if index == 0 {
            return Ok(candidates.into_iter().map(Way::starting).collect());
        }
        let (mut ways, mut reached) = (Vec::new(), 0);
        for to in candidates {
            let mut best: Option<Way> = None;
            for way in before {
                match way.and(self, map, black, to) {
                    Ok(longer) if best.as_ref().is_none_or(|best| longer.cost < best.cost) => {
                        best = Some(longer);
                    }
                    Ok(_) => {}
                    Err(count) => reached = reached.max(count),
                }
            }
            ways.extend(best);
        }
        if ways.is_empty() {
            return Err(RoutingError::NoRoute {
                from: index - 1,
                to: index,
                why: dead_end(reached),
            });
        }
        Ok(ways)
    }
}

fn cheapest(ways: Vec<Way>) -> Way {
    let best = ways.into_iter().min_by(|a, b| a.cost.total_cmp(&b.cost));
    best.expect("every way-point has at least one way that leads there")
}

fn dead_end(reached: usize) -> String {
    match reached {
        0 => "one of them lies on what is black-listed".to_owned(),
        1 => "nothing leads on from the lane it starts on".to_owned(),
        count => format!("all {count} stretches of lane that can be reached lead elsewhere"),
    }
}

/// A way through the first way-points.
#[derive(Clone, Debug)]
struct Way {
    cost: f64,
    /// The way-points it passes.
    passed: Vec<Position>,
    steps: Vec<(Piece, Move)>,
}

impl Way {
    fn starting(at: Position) -> Self {
        Self {
            cost: 0.0,
            passed: vec![at],
            steps: Vec::new(),
        }
    }

    /// This way and a leg to `to`; the error tells how many stretches can be reached.
    fn and(&self, graph: &LaneGraph, map: &RoadMap, black: &BlackList, to: Position) -> Result<Self, usize> {
        let from = *self.passed.last().expect("a way starts somewhere");
        let cuts = Cuts::new(map, graph, black, from, to);
        let Leg { steps, cost } = search::search(graph, &cuts, from, to)?;
        let mut way = self.clone();
        way.cost += cost;
        way.passed.push(to);
        let last = steps.len() - 1;
        way.steps.extend(steps.iter().enumerate().map(|(k, step)| {
            let stretch = cuts.stretches[step.stretch];
            let piece = Piece {
                lane: stretch.lane,
                start: if k == 0 { from.s } else { stretch.start },
                end: if k == last { to.s } else { stretch.end },
            };
            (piece, step.by)
        }));
        Ok(way)
    }
}

fn response(graph: &LaneGraph, map: &RoadMap, black: &BlackList, way: &Way) -> RoutingResponse {
    let stages = passages::stages(graph, black, &way.steps);
    let waypoint = |position: &Position| {
        let lane = map.lane(position.lane);
        let at = lane.at(position.s);
        LaneWaypoint {
            lane: Some(lane.name.clone()),
            s: Some(position.s),
            position: Some(at.offset(0.0)),
            heading: Some(at.theta),
        }
    };
    RoutingResponse {
        roads: stages.iter().map(|stage| road(map, stage)).collect(),
        waypoints: way.passed.iter().map(waypoint).collect(),
    }
}

fn road(map: &RoadMap, stage: &Stage) -> RoadSegment {
    let first = stage.chains.first().and_then(|chain| chain.pieces.first());
    let last = stage.chains.len() - 1;
    let passage = |(k, chain): (usize, &Chain)| Passage {
        segments: chain.pieces.iter().map(|piece| segment(map, piece)).collect(),
        can_exit: k == last,
        change_lane_type: match chain.leaves_to {
            None => ChangeLaneType::Forward,
            Some(Side::Left) => ChangeLaneType::Left,
            Some(Side::Right) => ChangeLaneType::Right,
        },
    };
    RoadSegment {
        id: first.map_or(String::new(), |piece| map.lane(piece.lane).road.clone()),
        passages: stage.chains.iter().enumerate().map(passage).collect(),
    }
}

fn segment(map: &RoadMap, piece: &Piece) -> LaneSegment {
    LaneSegment {
        lane: map.lane(piece.lane).name.clone(),
        start_s: piece.start,
        end_s: piece.end,
    }
}
