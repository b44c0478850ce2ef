//! A speed profile: where on the path the car is when, and how it moves.

use serde::{Deserialize, Serialize};

/// How far beyond an end of a profile it is still read, s or m.
const END_TOLERANCE: f64 = 1e-6;

/// A moment of a profile.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SpeedPoint {
    /// Time, s.
    pub t: f64,
    /// Distance along the path, m.
    pub s: f64,
    /// Speed, m/s.
    pub v: f64,
    /// Acceleration, m/s².
    pub a: f64,
    /// Jerk, m/s³.
    pub da: f64,
}

/// A profile by ascending time. May be empty.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SpeedData {
    /// Its points.
    pub points: Vec<SpeedPoint>,
}

impl SpeedData {
    /// A profile of these points.
    pub fn new(points: Vec<SpeedPoint>) -> Self {
        Self { points }
    }

    /// Whether there is no point in it.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Time from its first to its last point, s.
    pub fn duration(&self) -> f64 {
        match self.points[..] {
            [first, .., last] => last.t - first.t,
            _ => 0.0,
        }
    }

    /// The motion at time `t`, linear between the points; `None` outside the profile or where it has fewer than two.
    pub fn at_time(&self, t: f64) -> Option<SpeedPoint> {
        let (a, b, share) = self.around(t, |point| point.t)?;
        Some(between(a, b, share))
    }

    /// The motion at the distance `s`, linear between the points; `None` outside the profile or where it has fewer
    /// than two. Where the car stands, the moment at which it comes to stand.
    pub fn at_distance(&self, s: f64) -> Option<SpeedPoint> {
        let (a, b, share) = self.around(s, |point| point.s)?;
        Some(between(a, b, share))
    }

    /// The points around a value of one of their ascending coordinates, and where between them it lies.
    fn around(&self, value: f64, of: impl Fn(&SpeedPoint) -> f64) -> Option<(SpeedPoint, SpeedPoint, f64)> {
        let [first, .., last] = self.points[..] else {
            return None;
        };
        if !(of(&first) < value + END_TOLERANCE && value - END_TOLERANCE < of(&last)) {
            return None;
        }
        let next = self.points.partition_point(|point| of(point) < value);
        if next == 0 || next == self.points.len() {
            let end = if next == 0 { first } else { last };
            return Some((end, end, 0.0));
        }
        let (a, b) = (self.points[next - 1], self.points[next]);
        Some((a, b, (value - of(&a)) / (of(&b) - of(&a))))
    }
}

fn between(a: SpeedPoint, b: SpeedPoint, share: f64) -> SpeedPoint {
    let mix = |x: f64, y: f64| x + (y - x) * share;
    SpeedPoint {
        t: mix(a.t, b.t),
        s: mix(a.s, b.s),
        v: mix(a.v, b.v),
        a: mix(a.a, b.a),
        da: mix(a.da, b.da),
    }
}
