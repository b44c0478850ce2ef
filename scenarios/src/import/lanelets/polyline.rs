//! Polylines by arc length, and where a normal of the lane meets them. World frame, metres.

use corridor_decider::geometry::Vec2;

/// Points closer than this are one, m.
const SAME_POINT: f64 = 1e-6;

/// How far along a bound, before and behind where it should be, a normal looks for it, m: enough for ends that are
/// cut askew in a junction of 20 m, too little for the way back of a hairpin.
const WINDOW: f64 = 20.0;

/// A crossing this little on the wrong side is on the centre line, m.
const ON_LINE: f64 = 1e-9;

/// Points with the way to each of them. At least one point; no two in a row are the same.
#[derive(Clone, Debug)]
pub(super) struct Polyline {
    points: Vec<Vec2>,
    stations: Vec<f64>,
}

/// What a normal found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing {
    /// Distance along the normal, never below what was asked for.
    pub(super) distance: f64,
    /// Segments looked at: what the search cost.
    pub(super) looked_at: usize,
}

impl Polyline {
    /// The points without repeated ones and without what is no number; `None` when nothing is left.
    pub(super) fn new(points: &[Vec2]) -> Option<Self> {
        let mut kept: Vec<Vec2> = Vec::with_capacity(points.len());
        let mut stations = Vec::with_capacity(points.len());
        let mut length = 0.0;
        for point in points.iter().filter(|p| p.x.is_finite() && p.y.is_finite()) {
            if let Some(last) = kept.last() {
                let step = (point - last).norm();
                if step < SAME_POINT {
                    continue;
                }
                length += step;
            }
            kept.push(*point);
            stations.push(length);
        }
        (!kept.is_empty()).then_some(Self {
            points: kept,
            stations,
        })
    }

    pub(super) fn points(&self) -> &[Vec2] {
        &self.points
    }

    pub(super) fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    pub(super) fn first(&self) -> Vec2 {
        self.points[0]
    }

    pub(super) fn last(&self) -> Vec2 {
        self.points[self.points.len() - 1]
    }

    /// The point at a station, which is clamped to the line.
    pub(super) fn at(&self, s: f64) -> Vec2 {
        let above = self.stations.partition_point(|station| *station <= s);
        if above == 0 || above == self.points.len() {
            return self.points[above.saturating_sub(1)];
        }
        let (a, b) = (self.stations[above - 1], self.stations[above]);
        let t = (s - a) / (b - a);
        self.points[above - 1] * (1.0 - t) + self.points[above] * t
    }

    /// `steps + 1` points at even distances along the line.
    pub(super) fn resampled(&self, steps: usize) -> Vec<Vec2> {
        let step = self.length() / steps as f64;
        let mut points: Vec<Vec2> = (0..steps).map(|k| self.at(step * k as f64)).collect();
        points.push(self.last());
        points
    }

    /// How far along `normal`, at least `least`, the line is from `origin`; looked for around the share `share` of
    /// its length.
    ///
    /// Of several crossings the nearest counts. Where there is none, the line ends before the normal or begins
    /// behind it, and goes on beside the lane as far off as its end is.
    pub(super) fn crossing(&self, origin: Vec2, normal: Vec2, share: f64, least: f64) -> Crossing {
        let tangent = Vec2::new(normal.y, -normal.x);
        let near = share * self.length();
        let from = self
            .stations
            .partition_point(|s| *s < near - WINDOW)
            .saturating_sub(1);
        let to = self
            .stations
            .partition_point(|s| *s <= near + WINDOW)
            .max(from + 1);
        let window = &self.points[from..(to + 1).min(self.points.len())];
        // (beyond `least` or not, how far) of crossings, and (how far along the lane, how far off) of points.
        let (mut best, mut beside) = ((true, f64::MAX), (f64::MAX, 0.0));
        let mut before: Option<(f64, f64)> = None;
        for point in window {
            let here = ((point - origin).dot(&tangent), (point - origin).dot(&normal));
            if here.0.abs() < beside.0 {
                beside = (here.0.abs(), here.1);
            }
            if let Some(lateral) = before.and_then(|before| lateral_at_zero(before, here)) {
                let found = (lateral < least - ON_LINE, (lateral - least).abs());
                if found < best {
                    best = found;
                }
            }
            before = Some(here);
        }
        let distance = match best {
            (false, beyond) => least + beyond,
            (true, short) if short < f64::MAX => least,
            _ => beside.1.max(least),
        };
        Crossing {
            distance,
            looked_at: window.len(),
        }
    }
}

/// Where a segment between two (along, lateral) positions passes along = 0.
fn lateral_at_zero(a: (f64, f64), b: (f64, f64)) -> Option<f64> {
    if (a.0 > 0.0) == (b.0 > 0.0) && a.0 != 0.0 && b.0 != 0.0 {
        return None;
    }
    let along = a.0 - b.0;
    if along == 0.0 {
        return Some(if a.1.abs() < b.1.abs() { a.1 } else { b.1 });
    }
    Some(a.1 + (b.1 - a.1) * (a.0 / along))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(points: &[(f64, f64)]) -> Polyline {
        let points: Vec<Vec2> = points.iter().map(|(x, y)| Vec2::new(*x, *y)).collect();
        Polyline::new(&points).unwrap()
    }

    const UP: Vec2 = Vec2::new(0.0, 1.0);

    #[test]
    fn repeated_points_and_what_is_no_number_are_left_out() {
        let line = line(&[(0.0, 0.0), (5e-7, 0.0), (f64::NAN, 1.0), (3.0, 4.0), (3.0, 4.0)]);
        assert_eq!(line.points().len(), 2);
        assert!((line.length() - 5.0).abs() < 1e-12);
        assert!(Polyline::new(&[Vec2::new(f64::INFINITY, 0.0)]).is_none());
    }

    #[test]
    fn the_nearest_crossing_beyond_the_least_distance_counts() {
        let bound = line(&[(-5.0, 2.0), (5.0, 2.0), (5.0, 6.0), (-5.0, 4.0)]);
        let at = |least| bound.crossing(Vec2::zeros(), UP, 0.3, least).distance;
        assert!((at(0.0) - 2.0).abs() < 1e-12);
        assert!((at(2.5) - 5.0).abs() < 1e-12);
        // Nothing lies farther off than that.
        assert!((at(5.5) - 5.5).abs() < 1e-12);
    }

    #[test]
    fn a_line_that_begins_behind_the_normal_goes_on_beside_the_lane() {
        let bound = line(&[(1.0, 1.7), (9.0, 3.0)]);
        assert!((bound.crossing(Vec2::zeros(), UP, 0.0, 0.0).distance - 1.7).abs() < 1e-12);
        let point = line(&[(0.1, 0.4)]);
        assert!((point.crossing(Vec2::zeros(), UP, 0.5, 0.0).distance - 0.4).abs() < 1e-12);
    }

    #[test]
    fn the_way_back_of_a_long_hairpin_is_not_seen() {
        let bound = line(&[(0.0, 9.0), (200.0, 9.0), (200.0, 2.0), (0.0, 2.0)]);
        let found = bound.crossing(Vec2::new(100.0, 0.0), UP, 100.0 / 407.0, 0.0);
        assert!((found.distance - 9.0).abs() < 1e-12);
    }
}
