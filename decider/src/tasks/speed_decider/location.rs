//! On which side of a boundary a speed profile passes.

use crate::st_graph::{BoundaryType, SpeedData, SpeedPoint, StBoundary, StPoint, cross};

/// Whoever is slower than this at the end of his profile may not get out of a zone, m/s.
const SLOW: f64 = 2.5;

/// Where a profile is, seen from a boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Location {
    /// Before it on the path: it goes first.
    Below,
    /// Beyond it: the ego goes first.
    Above,
    /// In it.
    Cross,
}

/// Where a profile of two or more points is, seen from a boundary. Through a zone to keep clear it may go if it comes
/// out of it; else the ego stays before it.
pub fn location(profile: &SpeedData, boundary: &StBoundary) -> Location {
    let (begin, end) = (boundary.min_t(), boundary.max_t());
    let mut side = None;
    for pair in profile.points.windows(2) {
        let (from, to) = (place(pair[0]), place(pair[1]));
        if from.t < begin && to.t < begin {
            continue;
        }
        if from.t > end {
            break;
        }
        if boundary.meets_segment(from, to) {
            let stays = boundary.kind == BoundaryType::KeepClear && !comes_out(profile, boundary);
            return if stays { Location::Below } else { Location::Cross };
        }
        if side.is_none() && begin < to.t && from.t < end {
            let corner = boundary.first();
            let turn = cross(StPoint::new(corner.t, corner.upper), from, to);
            side = Some(if turn < 0.0 {
                Location::Above
            } else {
                Location::Below
            });
        }
    }
    side.unwrap_or(Location::Below)
}

fn place(point: SpeedPoint) -> StPoint {
    StPoint::new(point.t, point.s)
}

/// Whether a profile ends behind a zone, or is fast enough to get there.
fn comes_out(profile: &SpeedData, zone: &StBoundary) -> bool {
    profile
        .points
        .last()
        .is_some_and(|last| last.s > zone.max_s() || last.v >= SLOW)
}
