//! Where the car can be, and how fast, by when.

/// Hardest braking and acceleration that the region allows, m/s² (`longitudinal_acceleration_lower_bound`, `_upper_`).
const ACCELERATION: (f64, f64) = (-6.0, 4.0);

/// What lies between hardest braking and hardest acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeasibleRegion {
    s: f64,
    v: f64,
}

impl FeasibleRegion {
    /// From station `s` with speed `v` along the line; a negative speed, which braking may leave behind, counts as 0.
    pub fn new(s: f64, v: f64) -> Self {
        Self { s, v: v.max(0.0) }
    }

    /// The nearest station at a time, m.
    pub fn s_lower(&self, t: f64) -> f64 {
        let t = t.min(self.v / -ACCELERATION.0);
        self.s + self.v * t + 0.5 * ACCELERATION.0 * t * t
    }

    /// The farthest station at a time, m.
    pub fn s_upper(&self, t: f64) -> f64 {
        self.s + self.v * t + 0.5 * ACCELERATION.1 * t * t
    }

    /// The lowest speed at a time, m/s.
    pub fn v_lower(&self, t: f64) -> f64 {
        (self.v + ACCELERATION.0 * t).max(0.0)
    }

    /// The highest speed at a time, m/s.
    pub fn v_upper(&self, t: f64) -> f64 {
        self.v + ACCELERATION.1 * t
    }

    /// The earliest time at a station ahead, s.
    pub fn t_lower(&self, s: f64) -> f64 {
        let square = self.v * self.v + 2.0 * ACCELERATION.1 * (s - self.s);
        (square.max(0.0).sqrt() - self.v) / ACCELERATION.1
    }
}
