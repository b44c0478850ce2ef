//! `missed_block`, `false_block`, `blocker_id_correct`: whether the road is closed where the decider says so, and by
//! whom.
//!
//! The answer is the reference search's, over the standing obstacles of the frame. Asked when the decider's answer
//! changes, and once a second. A block that is missed fails the run: an open bound that is right holds a way for the
//! bare car itself. The other two are reported: boxes around askew cars close ways that their outlines leave.

use super::measure::{Extreme, Measure};
use super::plan::Plan;
use super::reference_search::{Body, Flood, GRID, flood};
use super::silhouette::Silhouette;
use corridor_decider::frame::{Frame, ObstacleId};
use corridor_decider::reference_line::{LineQuery, ReferenceLine, SlPoint};
use corridor_decider::road::{Neighbour, Side};
use corridor_decider::tasks::path_bounds::{Borrow, Label, LaneType, PathBound};
use corridor_decider::vehicle::VehicleParams;

/// Time between two questions about an answer that stays the same, s.
const PERIOD: f64 = 1.0;

/// Room that the original's bounds keep to an obstacle: beside, before and behind it, m (`obstacle_lat_buffer`,
/// `obstacle_lon_start_buffer`, `obstacle_lon_end_buffer`).
const BUFFERS: (f64, f64, f64) = (0.4, 3.0, 2.0);

/// Room beside the ego that every road offers it, m: the fallback's own, 0.5 m, and the cell it may lie in.
const EGO_ROOM: f64 = 0.6;

/// Good value of a block that is missed or false.
pub(super) const NEVER: f64 = 0.0;

/// What is asked again only when it changes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Answer {
    label: Label,
    blocked_by: Option<ObstacleId>,
}

/// Watches the blocks.
#[derive(Clone, Debug, Default)]
pub(super) struct BlockWatch {
    last: Option<(f64, Answer)>,
    missed: Extreme,
    false_blocks: Extreme,
    named: u32,
    right: u32,
    wrong: Extreme,
}

impl BlockWatch {
    pub(super) fn tick(
        &mut self,
        frame: &Frame,
        plan: &Plan,
        standing: &[&Silhouette],
        vehicle: &VehicleParams,
    ) {
        let (Some(bound), Some(line)) = (&plan.bound, &plan.line) else {
            return;
        };
        let answer = Answer {
            label: bound.label,
            blocked_by: bound.blocked_by,
        };
        let is_same = |(time, last): (f64, Answer)| last == answer && frame.time - time < PERIOD;
        if self.last.is_some_and(is_same) {
            return;
        }
        self.last = Some((frame.time, answer));
        let question = Question {
            line,
            ego: line.to_frenet(frame.ego.pose.position()),
            standing,
            vehicle,
        };
        match bound.blocked_by {
            None => self.is_open(frame.time, &question, bound),
            Some(id) => self.is_closed(frame.time, &question, bound, id),
        }
    }

    /// The decider sees a way to the end of its bound.
    fn is_open(&mut self, time: f64, question: &Question, bound: &PathBound) {
        if let Some(flood) = question.any_way(bound.end_s()) {
            let missed = f64::from(u8::from(flood.closed_at.is_some()));
            self.missed.raise(missed, time, flood.closed_by.first().copied());
        }
    }

    /// The decider sees none past `id`.
    fn is_closed(&mut self, time: f64, question: &Question, bound: &PathBound, id: ObstacleId) {
        let Some(blocker) = question.standing.iter().find(|o| o.id == id) else {
            return;
        };
        let half_lanes = |s| question.lanes(bound.label, s);
        let Some(edges) = half_lanes(question.ego.s).map(|_| |s| half_lanes(s).unwrap_or((0.0, 0.0))) else {
            return;
        };
        let past = blocker.end + BUFFERS.2 + question.vehicle.back_edge_to_center;
        if let Some(flood) = question.wide_way(past, &edges) {
            let is_false = f64::from(u8::from(flood.closed_at.is_none()));
            self.false_blocks.raise(is_false, time, Some(id));
        }
        if let Some(flood) = question
            .nominal_way(past, &edges)
            .filter(|f| f.closed_at.is_some())
        {
            self.named += 1;
            if flood.closed_by.contains(&id) {
                self.right += 1;
            } else {
                self.wrong.raise(1.0, time, Some(id));
            }
        }
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        let share = (self.named > 0).then(|| f64::from(self.right) / f64::from(self.named));
        let correct = self.wrong.measure("blocker_id_correct").value(share);
        vec![
            self.missed.measure("missed_block"),
            self.false_blocks.measure("false_block"),
            correct,
        ]
    }
}

/// One situation to be searched.
struct Question<'a> {
    line: &'a ReferenceLine,
    ego: SlPoint,
    standing: &'a [&'a Silhouette],
    vehicle: &'a VehicleParams,
}

impl Question<'_> {
    fn search(&self, end: f64, body: Body, edges: impl Fn(f64) -> (f64, f64)) -> Option<Flood> {
        flood(self.standing, (self.ego.s, self.ego.l), end, body, edges)
    }

    /// A way that the bare car could take anywhere on the road's surface, by the cell before it touches anything.
    fn any_way(&self, end: f64) -> Option<Flood> {
        let half_width = self.vehicle.half_width();
        let body = Body {
            beside: half_width - GRID,
            before: 0.0,
            behind: 0.0,
        };
        self.search(end, body, |s| {
            let (left, right) = self.line.road_width(s).unwrap_or((f64::MAX, f64::MAX));
            let reach = |room: f64| room - half_width + GRID;
            (
                (-reach(right)).min(self.ego.l - EGO_ROOM),
                reach(left).max(self.ego.l + EGO_ROOM),
            )
        })
    }

    /// A way past everything with the whole body and the lateral buffer on either side.
    fn wide_way(&self, end: f64, edges: &impl Fn(f64) -> (f64, f64)) -> Option<Flood> {
        let body = Body {
            beside: self.vehicle.half_width() + BUFFERS.0 + GRID,
            before: self.vehicle.front_edge_to_center.max(BUFFERS.1),
            behind: self.vehicle.back_edge_to_center.max(BUFFERS.2),
        };
        self.search(end, body, edges)
    }

    /// A way by the buffers of the original.
    fn nominal_way(&self, end: f64, edges: &impl Fn(f64) -> (f64, f64)) -> Option<Flood> {
        let body = Body {
            beside: self.vehicle.half_width() + BUFFERS.0,
            before: BUFFERS.1,
            behind: BUFFERS.2,
        };
        self.search(end, body, edges)
    }

    /// Limits of the axle in the lanes that a label speaks of; `None` for labels that end elsewhere.
    fn lanes(&self, label: Label, s: f64) -> Option<(f64, f64)> {
        let Label::Regular { borrow, lane } = label else {
            return None;
        };
        let (left, right) = self.line.lane_width(s)?;
        let half_width = self.vehicle.half_width();
        let beyond = |side: Side| {
            let reverse = lane == LaneType::Reverse;
            self.line
                .neighbour_width(Neighbour { side, reverse }, s)
                .unwrap_or(0.0)
        };
        let (left, right) = match borrow {
            Borrow::None => (left, right),
            Borrow::Left => (left + beyond(Side::Left), right),
            Borrow::Right => (left, right + beyond(Side::Right)),
        };
        Some((half_width - right, left - half_width))
    }
}
