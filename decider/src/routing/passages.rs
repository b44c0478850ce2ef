//! From a chain of stretches to a routing response: roads of passages side by side (the original's
//! `result_generator`).
//!
//! A passage is driven without a change of lane. Where a change is due it may be made anywhere along the stretch on
//! which both passages run side by side, so each is led on as long as the other can be reached from it.

use super::graph::LaneGraph;
use super::request::BlackList;
use super::search::Move;
use crate::road::{LaneId, Side};

/// A stretch of a lane in a passage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub lane: LaneId,
    pub start: f64,
    pub end: f64,
}

/// Stretches that follow each other, and the side to which they are left.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Chain {
    pub pieces: Vec<Piece>,
    pub leaves_to: Option<Side>,
}

impl Chain {
    fn of(piece: Piece) -> Self {
        Self {
            pieces: vec![piece],
            leaves_to: None,
        }
    }
}

/// A stretch of road on which the same passages serve.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Stage {
    pub chains: Vec<Chain>,
}

/// The stages of a whole route. `steps` are its pieces, each with how it was reached.
pub(super) fn stages(graph: &LaneGraph, black: &BlackList, steps: &[(Piece, Move)]) -> Vec<Stage> {
    let mut chains = split(graph, steps);
    for k in 0..chains.len() {
        lead_on(graph, black, &mut chains, k);
        lead_back(graph, black, &mut chains, k);
    }
    for k in (0..chains.len()).rev() {
        lead_on(graph, black, &mut chains, k);
        lead_back(graph, black, &mut chains, k);
    }
    group(graph, &chains)
}

/// Splits the route at its changes of lane; both sides of a change start and end beside each other.
fn split(graph: &LaneGraph, steps: &[(Piece, Move)]) -> Vec<Chain> {
    let mut chains: Vec<Chain> = Vec::new();
    for (piece, by) in steps {
        let Some(chain) = chains.last_mut() else {
            chains.push(Chain::of(*piece));
            continue;
        };
        match (by, chain.pieces.last_mut()) {
            (Move::Forward, Some(last)) if last.lane == piece.lane && last.end >= piece.start => {
                last.end = piece.end;
            }
            (Move::Forward, _) => chain.pieces.push(*piece),
            (Move::Change(side), from) => {
                chain.leaves_to = Some(*side);
                let beside = |from: &mut Piece| graph.station_beside(from.lane, from.start, piece.lane);
                let start = from.map_or(0.0, beside).max(piece.start);
                chains.push(Chain::of(Piece { start, ..*piece }));
            }
        }
    }
    for k in (1..chains.len()).rev() {
        let target = chains[k].pieces[0];
        if let Some(from) = chains[k - 1].pieces.last_mut() {
            from.end = from
                .end
                .min(graph.station_beside(target.lane, target.end, from.lane));
        }
    }
    chains
}

/// The piece of a chain beside a lane on a side, if it can be changed to.
fn beside<'a>(graph: &LaneGraph, lane: LaneId, side: Side, chain: &'a Chain) -> Option<&'a Piece> {
    let to = graph.beside(lane, side)?;
    chain.pieces.iter().find(|piece| piece.lane == to)
}

/// Leads a chain on along successors from which the next one can still be reached: the longest way.
fn lead_on(graph: &LaneGraph, black: &BlackList, chains: &mut [Chain], k: usize) {
    let Some(side) = chains[k].leaves_to.filter(|_| k + 1 < chains.len()) else {
        return;
    };
    while let Some(last) = chains[k].pieces.last().copied() {
        let Some(node) = graph.node(last.lane) else { return };
        if last.end < node.length {
            return;
        }
        let next = node.successors.iter().filter_map(|lane| {
            let target = beside(graph, *lane, side, &chains[k + 1])?;
            let mut stretch = mirrored(graph, target, *lane);
            let closed = black.closed(*lane).filter(|(_, to)| *to > stretch.start);
            stretch.end = closed.fold(stretch.end, |end, (from, _)| end.min(from));
            (stretch.start <= 0.0 && stretch.end > 0.0 && !holds(&chains[k], *lane)).then_some(stretch)
        });
        let Some(longest) = next.max_by(|a, b| a.end.total_cmp(&b.end).then(b.lane.cmp(&a.lane))) else {
            return;
        };
        chains[k].pieces.push(longest);
    }
}

/// Leads a chain back along predecessors that can be reached from the one before.
fn lead_back(graph: &LaneGraph, black: &BlackList, chains: &mut [Chain], k: usize) {
    let Some(side) = k.checked_sub(1).and_then(|before| chains[before].leaves_to) else {
        return;
    };
    while let Some(first) = chains[k].pieces.first().copied() {
        if first.start > 0.0 {
            return;
        }
        let found = chains[k - 1].pieces.iter().find_map(|from| {
            let lane = graph.beside(from.lane, side)?;
            let node = graph.node(lane)?;
            let mut stretch = mirrored(graph, from, lane);
            let closed = black.closed(lane).filter(|(from, _)| *from < stretch.end);
            stretch.start = closed.fold(stretch.start, |start, (_, to)| start.max(to));
            let leads_here = node.successors.contains(&first.lane)
                && stretch.end >= node.length
                && stretch.start < node.length;
            (leads_here && !holds(&chains[k], lane)).then_some(stretch)
        });
        let Some(stretch) = found else { return };
        chains[k].pieces.insert(0, stretch);
    }
}

fn holds(chain: &Chain, lane: LaneId) -> bool {
    chain.pieces.iter().any(|piece| piece.lane == lane)
}

/// The stretch of `lane` beside a piece; whole where the piece is.
fn mirrored(graph: &LaneGraph, piece: &Piece, lane: LaneId) -> Piece {
    Piece {
        lane,
        start: graph.station_beside(piece.lane, piece.start, lane),
        end: graph.station_beside(piece.lane, piece.end, lane),
    }
}

/// Groups what lies side by side into stages; every other piece is a stage of its own.
fn group(graph: &LaneGraph, chains: &[Chain]) -> Vec<Stage> {
    let mut stages: Vec<Stage> = Vec::new();
    let mut side_by_side: Vec<Chain> = Vec::new();
    for (k, chain) in chains.iter().enumerate() {
        let mut is_new = true;
        for piece in &chain.pieces {
            if !serves_a_change(graph, chains, k, piece.lane) {
                close(&mut stages, &mut side_by_side);
                stages.push(Stage {
                    chains: vec![Chain::of(*piece)],
                });
                is_new = true;
                continue;
            }
            if is_new || side_by_side.is_empty() {
                side_by_side.push(Chain {
                    pieces: Vec::new(),
                    leaves_to: chain.leaves_to,
                });
                is_new = false;
            }
            if let Some(last) = side_by_side.last_mut() {
                last.pieces.push(*piece);
            }
        }
    }
    close(&mut stages, &mut side_by_side);
    stages
}

/// Whether a lane of chain `k` can be left for the next chain or reached from the one before.
fn serves_a_change(graph: &LaneGraph, chains: &[Chain], k: usize, lane: LaneId) -> bool {
    let leaves = || {
        let side = chains[k].leaves_to?;
        beside(graph, lane, side, chains.get(k + 1)?)
    };
    let enters = || {
        let from = &chains[k.checked_sub(1)?];
        let side = from.leaves_to?;
        let reaches = |piece: &&Piece| graph.beside(piece.lane, side) == Some(lane);
        from.pieces.iter().find(reaches)
    };
    leaves().is_some() || enters().is_some()
}

fn close(stages: &mut Vec<Stage>, side_by_side: &mut Vec<Chain>) {
    if side_by_side.is_empty() {
        return;
    }
    let mut chains = std::mem::take(side_by_side);
    if let Some(last) = chains.last_mut() {
        last.leaves_to = None;
    }
    stages.push(Stage { chains });
}
