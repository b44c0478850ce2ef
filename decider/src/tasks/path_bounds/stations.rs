//! The road at every station of the horizon, asked once per tick.

use super::input::Input;
use crate::reference_line::LineQuery;
use crate::road::{BoundaryType, Neighbour};

/// Longitudinal horizon at low speed, m (the original's `kPathBoundsDeciderHorizon`).
const HORIZON: f64 = 100.0;

/// Longest horizon whatever the cruise speed, m: farther than anything is seen, and 4,000 stations.
const LONGEST_HORIZON: f64 = 2000.0;

/// Distance between stations, m (the original's `kPathBoundsDeciderResolution`).
pub(super) const RESOLUTION: f64 = 0.5;

/// Stations farther than this from the line's start are not sampled, m: no road is that long, and near 2^52 m half
/// a metre is lost in rounding.
const FARTHEST: f64 = 1e9;

/// What the line knows at one station.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Where, m.
    pub s: f64,
    /// Distances to the (left, right) lane edges.
    pub lane: Option<(f64, f64)>,
    /// Distances to the (left, right) road edges.
    pub road: Option<(f64, f64)>,
    /// Lateral position of the line in its lane; 0 where unknown.
    pub offset: f64,
    /// Types of the (left, right) lane lines.
    pub marks: Option<(BoundaryType, BoundaryType)>,
    /// Widths of the adjacent lanes, indexed by [`Neighbour::index`].
    pub neighbours: [Option<f64>; 4],
}

/// Samples the line from the ego to the end of the horizon. Empty when the ego is at or past the line's end, or
/// nowhere near the line.
pub(super) fn sample<L: LineQuery + ?Sized>(line: &L, input: &Input) -> Vec<Station> {
    let cruise = if input.cruise_speed > 0.0 {
        input.cruise_speed
    } else {
        input.config.default_cruise_speed
    };
    let reach = HORIZON
        .max(cruise * input.config.trajectory_time_length)
        .min(LONGEST_HORIZON);
    if input.ego.s.is_nan() || input.ego.s.abs() > FARTHEST {
        return Vec::new();
    }
    let end = (input.ego.s + reach).min(line.length());
    let mut stations = Vec::with_capacity(256);
    line.sample(input.ego.s, RESOLUTION, end, &mut stations);
    stations
}

/// How many stations lie at or before `s`.
pub(super) fn count_until(stations: &[Station], s: f64) -> usize {
    let first = stations.first().map_or(0.0, |station| station.s);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "saturates, and is only where the count begins"
    )]
    let guess = ((s - first) / RESOLUTION) as usize;
    let mut count = guess.min(stations.len());
    while count > 0 && stations[count - 1].s > s {
        count -= 1;
    }
    while count < stations.len() && stations[count].s <= s {
        count += 1;
    }
    count
}

/// One station by single queries: what [`LineQuery::sample`] does unless a line knows a faster way.
pub(crate) fn station<L: LineQuery + ?Sized>(line: &L, s: f64) -> Station {
    Station {
        s,
        lane: line.lane_width(s),
        road: line.road_width(s),
        offset: line.offset_to_map(s).unwrap_or(0.0),
        marks: line.boundary_types(s),
        neighbours: Neighbour::ALL.map(|kind| line.neighbour_width(kind, s)),
    }
}
