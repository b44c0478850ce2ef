//! Limits from the lane, a borrowed lane and the ego itself (`GetBoundaryFromLanesAndADC`).

use super::bound::{Borrow, BoundPoint, EdgeCause, LaneType};
use super::edges::{Limit, between};
use super::input::Input;
use super::stations::Station;
use crate::road::{BoundaryType, Neighbour, Side};

/// Width of the ego's lane when the map does not tell, m (the original's `kDefaultLaneWidth`).
const DEFAULT_LANE_WIDTH: f64 = 5.0;

/// Lane and road edges nearer than this are one edge, m.
const SAME_EDGE: f64 = 0.05;

/// Deceleration that ends the ego's lateral motion, m/s².
const LATERAL_DECELERATION: f64 = 1.5;

/// Shortest distance over which the ego's extension is held, and over which it fades, m. At walking pace
/// travel time alone would leave less than the car needs to turn in.
const LEAST_EXTENSION: (f64, f64) = (5.0, 10.0);

/// How the lane bound of one candidate is made.
#[derive(Clone, Copy, Debug)]
pub(super) struct LaneRules {
    /// Which neighbouring lane belongs to it.
    pub borrow: Borrow,
    /// Room beside the ego, m.
    pub buffer: f64,
    /// Whether it holds the ego whatever the configuration says.
    pub force_extend: bool,
    /// Station up to which it holds the ego in full, however far away: there the ego may not yet leave its lane.
    pub hold_until: Option<f64>,
}

/// The bound that the lanes leave, up to where nothing is left, and whose lane is borrowed: `None` when there is
/// none to borrow.
pub(super) fn bound(
    lane: &[OwnLane],
    stations: &[Station],
    input: &Input,
    rules: LaneRules,
) -> (Vec<BoundPoint>, Option<LaneType>) {
    let extension = (input.config.is_extend_lane_bounds_to_include_adc || rules.force_extend)
        .then(|| Extension::new(input, stations[0].offset, rules));
    let mut borrowed = None;
    let mut bound = Vec::with_capacity(stations.len());

    for (own, station) in lane.iter().zip(stations) {
        let neighbour = borrowed_width(station, input, rules.borrow);
        if let Some((_, reverse)) = neighbour {
            borrowed = Some(borrowed.unwrap_or(false) || reverse);
        }
        let (mut left, mut right) = own.with_neighbour(rules.borrow, neighbour.map(|(width, _)| width));
        if let Some(extension) = &extension {
            (left, right) = extension.widen(left, right, own.s - input.ego.s);
        }
        left.l = (left.l - own.offset) - own.beside_left;
        right.l = (right.l - own.offset) + own.beside_right;
        let Some(point) = between(own.s, right, left) else {
            break;
        };
        bound.push(point);
    }
    let lane = lane_type(rules.borrow, borrowed, input.config.quirks.borrows_phantom_lane);
    (bound, lane)
}

fn lane_type(borrow: Borrow, borrowed: Option<bool>, phantom: bool) -> Option<LaneType> {
    match (borrow, borrowed) {
        (Borrow::None, _) => Some(LaneType::Own),
        (_, Some(true)) => Some(LaneType::Reverse),
        (_, Some(false)) => Some(LaneType::Forward),
        (_, None) => phantom.then_some(LaneType::Forward),
    }
}

/// The own lane at one station, in the frame of its centre line: the same for all candidates of a call.
#[derive(Clone, Copy, Debug)]
pub(super) struct OwnLane {
    s: f64,
    /// Lateral position of the reference line.
    offset: f64,
    /// Distances to its edges.
    left: f64,
    right: f64,
    /// Room that the car's body needs beside each edge.
    beside_left: f64,
    beside_right: f64,
}

/// The own lane at every station; what the map does not tell is carried on.
pub(super) fn own(stations: &[Station], input: &Input) -> Vec<OwnLane> {
    let half_width = input.vehicle.half_width();
    let beside_line = input.config.adc_buffer_coeff * half_width;
    let half_lane = stations
        .first()
        .and_then(|here| here.lane)
        .map_or(DEFAULT_LANE_WIDTH, |(left, right)| left + right)
        / 2.0;
    let (mut left, mut right) = (half_lane, half_lane);
    let (mut beside_left, mut beside_right) = (beside_line, beside_line);
    let at = |station: &Station| {
        if let Some(lane) = station.lane {
            if let Some(road) = station.road {
                let room = |lane: f64, road: f64| {
                    if (road - lane).abs() > SAME_EDGE {
                        beside_line
                    } else {
                        half_width
                    }
                };
                (beside_left, beside_right) = (room(lane.0, road.0), room(lane.1, road.1));
            }
            (left, right) = (lane.0 + station.offset, lane.1 - station.offset);
        }
        OwnLane {
            s: station.s,
            offset: station.offset,
            left,
            right,
            beside_left,
            beside_right,
        }
    };
    stations.iter().map(at).collect()
}

impl OwnLane {
    /// Left and right limit, with a borrowed lane's width on its side.
    fn with_neighbour(&self, borrow: Borrow, width: Option<f64>) -> (Limit, Limit) {
        let own = |side: f64| Limit {
            l: side,
            cause: EdgeCause::LaneLine,
        };
        let beyond = |side: f64| Limit {
            l: side,
            cause: EdgeCause::BorrowedLane,
        };
        match (borrow, width) {
            (Borrow::Left, Some(width)) => (beyond(self.left + width), own(-self.right)),
            (Borrow::Right, Some(width)) => (own(self.left), beyond(-self.right - width)),
            _ => (own(self.left), own(-self.right)),
        }
    }
}

/// Width of the lane to borrow at a station, and whether its traffic comes towards us.
fn borrowed_width(station: &Station, input: &Input, borrow: Borrow) -> Option<(f64, bool)> {
    let side = match borrow {
        Borrow::None => return None,
        Borrow::Left => Side::Left,
        Borrow::Right => Side::Right,
    };
    if !may_cross(station, side, input.config.quirks.crosses_double_yellow) {
        return None;
    }
    let width = |reverse| station.neighbours[Neighbour { side, reverse }.index()];
    width(false)
        .map(|width| (width, false))
        .or_else(|| width(true).map(|width| (width, true)))
}

/// Whether the lane line on a side may be crossed (`CheckLaneBoundaryType`). Unknown lines and kerbs may:
/// what lies behind them is a question of the neighbour.
fn may_cross(station: &Station, side: Side, crosses_double_yellow: bool) -> bool {
    let Some((left, right)) = station.marks else {
        return false;
    };
    match if side == Side::Left { left } else { right } {
        BoundaryType::SolidYellow | BoundaryType::SolidWhite => false,
        BoundaryType::DoubleYellow => crosses_double_yellow,
        _ => true,
    }
}

/// The stretch beside the lane centre that holds the ego and where its lateral motion leads it.
struct Extension {
    left: f64,
    right: f64,
    /// Where it starts and ends to give way to the lane's edges, m ahead; `None`: nowhere.
    fade: Option<(f64, f64)>,
}

impl Extension {
    fn new(input: &Input, offset: f64, rules: LaneRules) -> Self {
        let config = input.config;
        let center = input.ego.l + offset;
        let l_dot = input.ego.l_dot;
        let overshoot = l_dot * l_dot / (2.0 * LATERAL_DECELERATION);
        let overshoot = if l_dot > 0.0 { overshoot } else { -overshoot };
        let half_width = input.vehicle.half_width();
        let hold = (input.ego.s_dot * config.ego_extension_hold_time).max(LEAST_EXTENSION.0);
        let zone = rules.hold_until.map_or(0.0, |s| s - input.ego.s);
        let hold = hold.max(zone);
        let fade = (input.ego.s_dot * config.ego_extension_fade_time).max(LEAST_EXTENSION.1);
        Self {
            left: center.max(center + overshoot) + half_width + rules.buffer,
            right: center.min(center + overshoot) - half_width - rules.buffer,
            fade: (!config.quirks.endless_ego_extension).then_some((hold, hold + fade)),
        }
    }

    fn widen(&self, left: Limit, right: Limit, ahead: f64) -> (Limit, Limit) {
        let (beyond_left, beyond_right) = (self.left > left.l, self.right < right.l);
        if !beyond_left && !beyond_right {
            return (left, right);
        }
        let share = match self.fade {
            None => 1.0,
            Some((from, to)) => ((to - ahead) / (to - from)).clamp(0.0, 1.0),
        };
        let widened = |lane: Limit, ego: f64, outside: bool| {
            if !outside || share <= 0.0 {
                return lane;
            }
            let l = if share >= 1.0 {
                ego
            } else {
                lane.l + (ego - lane.l) * share
            };
            Limit {
                l,
                cause: EdgeCause::Ego,
            }
        };
        (
            widened(left, self.left, beyond_left),
            widened(right, self.right, beyond_right),
        )
    }
}
