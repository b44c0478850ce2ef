//! How fast the car may be at each point of a path: by the map, by the bend, and beside what it nudges.

use super::SpeedBoundsConfig;
use crate::decision::PathPoint;
use crate::st_graph::{SpeedLimit, SpeedLimitError};
use crate::vehicle::VehicleParams;

/// Curvatures below this limit nothing, 1/m.
const STRAIGHT: f64 = 1e-5;

/// Something that the path passes at a distance on purpose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nudge {
    /// Whether the ego passes it on its left.
    pub is_left: bool,
    /// Whether it stands.
    pub is_static: bool,
    /// First and last station, m.
    pub station: (f64, f64),
    /// Right and left edge, m.
    pub offset: (f64, f64),
}

/// The limit along a path, up to the end of its reference line. `map_limit` is that of the map at a station, infinite
/// where there is none.
///
/// # Errors
///
/// When fewer than two points of the path lie on the line.
pub fn speed_limit(
    config: &SpeedBoundsConfig,
    vehicle: &VehicleParams,
    path: &[PathPoint],
    line_length: f64,
    map_limit: impl Fn(f64) -> f64,
    nudges: &[Nudge],
) -> Result<SpeedLimit, SpeedLimitError> {
    let on_line = path.iter().take_while(|point| point.s <= line_length);
    let entries = on_line.map(|point| {
        let map = map_limit(point.s);
        let bend = (config.max_centric_acceleration_limit / point.kappa.abs().max(STRAIGHT)).sqrt();
        let passing = nudges
            .iter()
            .find(|nudge| is_close(config, vehicle, point, nudge));
        let beside = match passing {
            Some(nudge) if config.enable_nudge_slowdown => map * ratio(config, nudge),
            _ => f64::INFINITY,
        };
        (point.distance, map.min(bend).min(beside).max(config.lowest_speed))
    });
    SpeedLimit::new(entries.collect())
}

fn ratio(config: &SpeedBoundsConfig, nudge: &Nudge) -> f64 {
    if nudge.is_static {
        config.static_obs_nudge_speed_ratio
    } else {
        config.dynamic_obs_nudge_speed_ratio
    }
}

/// Whether the body is beside something with less room than is comfortable.
fn is_close(config: &SpeedBoundsConfig, vehicle: &VehicleParams, point: &PathPoint, nudge: &Nudge) -> bool {
    let (back, front) = (
        point.s - vehicle.back_edge_to_center,
        point.s + vehicle.front_edge_to_center,
    );
    if back > nudge.station.1 || front < nudge.station.0 {
        return false;
    }
    let reach = vehicle.half_width() + config.collision_safety_range;
    if nudge.is_left {
        point.l - reach < nudge.offset.1
    } else {
        nudge.offset.0 < point.l + reach
    }
}
