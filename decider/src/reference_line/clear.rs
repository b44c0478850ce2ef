//! Keeps a line clear of itself: no two parts of it come so near to each other that it is not plain which of them a
//! point belongs to.
//!
//! A ramp leads under the road that it leaves, a small roundabout back along the street it was entered from. Whoever asks such
//! a line for the station of an obstacle, or of the car, gets that of the nearer pass, and that may be the wrong one.
//! So the line ends where it would come near its earlier part (the original ends it where the heading has turned by
//! 150°), and the earlier part is given up once it lies behind the car, which opens the way on.

use super::line::LineSample;
use super::stitch::StitchedLine;
use crate::geometry::Vec2;
use crate::lane_follow_map::RouteSegments;

/// Two parts of a line keep this distance, m: the line may have a car on either side of it.
const CLEARANCE: f64 = 5.0;

/// Parts nearer to each other along the line are one, m: the way around the tightest bend that a car drives, three
/// quarters of a circle.
const ONE_PART: f64 = 25.0;

/// How much of a line stays behind the car in any case, m: the car, and what it needs to be seen from.
const LEAST_BEHIND: f64 = 10.0;

/// How far behind the last cross-section that is given up the line is cut, m: less than the next one is away.
const PAST: f64 = 0.1;

/// Length by which a line has to gain when it is made anew, m: it is not worth less.
const LEAST_GAIN: f64 = 5.0;

/// A line that was cut for its own sake.
#[derive(Clone, Debug)]
pub(super) struct Cleared {
    pub(super) line: StitchedLine,
    /// The line can go on once the car has passed this station, m; `None`: it was not cut ahead.
    pub(super) until: Option<f64>,
}

impl Cleared {
    /// Whether a line that was cut is still as long as it can be along `window`.
    pub(super) fn serves(&self, window: &RouteSegments) -> bool {
        let (Some(until), Some(car)) = (self.until, &window.car) else {
            return false;
        };
        self.line.agrees(&window.segments, car) && self.line.station_of(car).is_some_and(|here| here < until)
    }
}

/// A line, as much of it around the station `here` as is clear of itself.
pub(super) fn cleared(line: StitchedLine, here: f64) -> Cleared {
    let passes = passes(line.line().samples());
    let behind = here - LEAST_BEHIND;
    let given_up = passes
        .iter()
        .map(|(first, _)| *first)
        .filter(|first| *first < behind);
    let line = match given_up.reduce(f64::max) {
        Some(first) => line.cut_behind(here, here - first - PAST),
        None => line,
    };
    let ahead = passes.iter().filter(|(first, _)| *first >= behind);
    match ahead.min_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((first, second)) => Cleared {
            line: line.cut_ahead(*second),
            until: Some(first + LEAST_BEHIND + LEAST_GAIN),
        },
        None => Cleared { line, until: None },
    }
}

/// For each cross-section that comes near an earlier part: the last one of that part, and itself, as stations.
fn passes(samples: &[LineSample]) -> Vec<(f64, f64)> {
    let places: Vec<(f64, Vec2)> = samples
        .iter()
        .map(|sample| (sample.s, Vec2::new(sample.point.x, sample.point.y)))
        .collect();
    let mut passes = Vec::new();
    for (k, (second, place)) in places.iter().enumerate() {
        let earlier = places[..k]
            .iter()
            .take_while(|(first, _)| second - first >= ONE_PART);
        let near = earlier.filter(|(_, other)| (other - place).norm_squared() < CLEARANCE * CLEARANCE);
        passes.extend(near.last().map(|(first, _)| (*first, *second)));
    }
    passes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference_line::testing;
    use std::f64::consts::TAU;

    const RADIUS: f64 = 15.0;

    /// Straight on through the start of a loop of three quarters of a circle.
    #[test]
    fn a_loop_passes_itself_where_it_crosses() {
        let bend = TAU * RADIUS * 0.75;
        let line = testing::line(60.0 + bend + 60.0, move |s| {
            if (60.0..60.0 + bend).contains(&s) {
                1.0 / RADIUS
            } else {
                0.0
            }
        });
        let passes = passes(line.samples());
        // The crossing lies a radius before the bend and a radius behind it.
        let (first, second) = (60.0 - RADIUS, 60.0 + bend + RADIUS);
        assert!(!passes.is_empty());
        for (a, b) in passes {
            assert!(
                (a - first).abs() < CLEARANCE + 0.1 && (b - second).abs() < CLEARANCE + 0.1,
                "{a} {b}"
            );
        }
        assert!(super::passes(testing::s_curve().samples()).is_empty());
    }
}
