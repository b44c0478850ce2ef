//! The lanes of a map as a graph: what leads where, and what that costs (the original's `topo_creator`).
//!
//! Costs are in metres of driving at the base speed. A fast lane costs less than its length, a turn in a junction
//! and a change of lane cost extra.

use super::config::RoutingConfig;
use crate::geometry::{Vec2, angle};
use crate::road::{BoundaryType, Lane, LaneId, Neighbour, RoadMap, Side};

/// What the search has to know of one lane.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub length: f64,
    /// Cost per metre.
    pub rate: f64,
    /// Cost of turning off here, once per lane.
    pub turn: f64,
    /// Drivable lanes that follow.
    pub successors: Vec<LaneId>,
    /// The lane to the left and to the right that may be changed to, with the cost of the change.
    pub changes: [Option<(LaneId, f64)>; 2],
    /// Where it starts.
    pub start: Vec2,
}

/// The graph of a map; made once, asked for every route.
#[derive(Clone, Debug)]
pub struct LaneGraph {
    /// By [`LaneId`]; `None` where no car drives.
    nodes: Vec<Option<Node>>,
    /// The least cost per metre of any lane.
    pub(super) least_rate: f64,
    pub(super) config: RoutingConfig,
}

impl LaneGraph {
    /// The graph of all drivable lanes.
    pub fn new(map: &RoadMap, config: RoutingConfig) -> Self {
        let nodes: Vec<Option<Node>> = (0u32..)
            .zip(map.lanes())
            .map(|(id, lane)| {
                lane.kind
                    .is_drivable()
                    .then(|| node(map, LaneId(id), lane, &config))
            })
            .collect();
        let least_rate = nodes.iter().flatten().map(|node| node.rate).fold(1.0, f64::min);
        Self {
            nodes,
            least_rate,
            config,
        }
    }

    /// A drivable lane.
    pub(super) fn node(&self, lane: LaneId) -> Option<&Node> {
        self.nodes.get(lane.0 as usize)?.as_ref()
    }

    /// The lane to change to on a side.
    pub(super) fn beside(&self, lane: LaneId, side: Side) -> Option<LaneId> {
        self.node(lane)?.changes[place(side)].map(|(to, _)| to)
    }

    /// The station beside `s` of another lane that runs parallel: the same share of its length.
    pub(super) fn station_beside(&self, from: LaneId, s: f64, to: LaneId) -> f64 {
        match (self.node(from), self.node(to)) {
            (Some(from), Some(to)) => s / from.length * to.length,
            _ => s,
        }
    }
}

/// Place of a side in [`Node::changes`].
pub(super) fn place(side: Side) -> usize {
    usize::from(side == Side::Right)
}

fn node(map: &RoadMap, id: LaneId, lane: &Lane, config: &RoutingConfig) -> Node {
    let drivable = |to: &LaneId| map.lane(*to).kind.is_drivable();
    let [first, ..] = &lane.points[..] else {
        unreachable!("a map's lanes have at least two cross-sections");
    };
    let change = |side| {
        let to = map
            .neighbour(id, Neighbour { side, reverse: false })
            .filter(drivable)?;
        let crossable = crossable_length(lane, side);
        (crossable >= config.min_length_for_lane_change).then(|| (to, config.change_cost(crossable)))
    };
    Node {
        length: lane.length(),
        rate: config.rate(first.speed_limit),
        turn: turn_penalty(lane, config),
        successors: lane.successors.iter().copied().filter(drivable).collect(),
        changes: [change(Side::Left), change(Side::Right)],
        start: first.offset(0.0),
    }
}

/// How much of a lane's edge may be crossed, m. The original wants all of it painted as a broken line; a map that
/// does not tell what is painted does not forbid it here, and a stretch of solid line does not forbid the rest.
fn crossable_length(lane: &Lane, side: Side) -> f64 {
    let marks = match side {
        Side::Left => &lane.left_marks,
        Side::Right => &lane.right_marks,
    };
    let is_crossable = |kind: BoundaryType| {
        matches!(
            kind,
            BoundaryType::Unknown | BoundaryType::DottedWhite | BoundaryType::DottedYellow
        )
    };
    if marks.is_empty() {
        return lane.length();
    }
    let ends = marks.iter().skip(1).map(|mark| mark.s).chain([lane.length()]);
    let stretches = marks.iter().zip(ends).filter(|(mark, _)| is_crossable(mark.kind));
    stretches.map(|(mark, end)| (end - mark.s).max(0.0)).sum()
}

/// Cost of a turn: only lanes through junctions turn, others follow their road.
fn turn_penalty(lane: &Lane, config: &RoutingConfig) -> f64 {
    if lane.junction.is_none() {
        return 0.0;
    }
    let turned: f64 = lane
        .points
        .windows(2)
        .map(|pair| angle::difference(pair[1].theta, pair[0].theta))
        .sum();
    config.turn_penalty(turned)
}
