//! Motion with accelerations that are constant for a while each.

/// How negative rounding may make a speed, m/s.
const BACKWARDS: f64 = 1e-6;

/// Why a motion is none.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PiecewiseError {
    /// It goes backwards.
    #[error("the speed would become {0} m/s")]
    Backwards(f64),
    /// It lasts for no time.
    #[error("a piece lasts for {0} s")]
    Duration(f64),
}

/// Place and speed where one acceleration ends and the next begins.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Knot {
    t: f64,
    s: f64,
    v: f64,
}

/// Accelerations one after the other, from a place and a speed.
#[derive(Clone, Debug, PartialEq)]
pub struct PiecewiseAcceleration {
    knots: Vec<Knot>,
    /// One less than knots.
    accelerations: Vec<f64>,
}

impl PiecewiseAcceleration {
    /// At `s` with speed `v`.
    pub fn from(s: f64, v: f64) -> Self {
        Self {
            knots: vec![Knot { t: 0.0, s, v }],
            accelerations: Vec::new(),
        }
    }

    /// Goes on with acceleration `a` for `duration` seconds.
    ///
    /// # Errors
    /// [`PiecewiseError`] if it would then go backwards, or the duration is none. Nothing is added then.
    pub fn push(&mut self, a: f64, duration: f64) -> Result<(), PiecewiseError> {
        let last = self.last();
        let v = last.v + a * duration;
        if duration.is_nan() || duration < 0.0 {
            return Err(PiecewiseError::Duration(duration));
        }
        if v.is_nan() || v < -BACKWARDS {
            return Err(PiecewiseError::Backwards(v));
        }
        self.knots.push(Knot {
            t: last.t + duration,
            s: last.s.max(last.s + (last.v + v) * 0.5 * duration),
            v,
        });
        self.accelerations.push(a);
        Ok(())
    }

    fn last(&self) -> Knot {
        self.knots[self.knots.len() - 1]
    }

    /// How long it lasts, s.
    pub fn length(&self) -> f64 {
        self.last().t
    }

    /// Time, place and speed of every knot.
    pub fn knots(&self) -> impl Iterator<Item = [f64; 3]> + '_ {
        self.knots.iter().map(|knot| [knot.t, knot.s, knot.v])
    }

    /// Each acceleration with how long it lasts.
    pub fn segments(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let durations = self.knots.windows(2).map(|pair| pair[1].t - pair[0].t);
        self.accelerations.iter().copied().zip(durations)
    }

    /// Place, speed and acceleration at a time; `None` before the start, beyond the end and without a piece. Where a
    /// piece ends it still counts.
    pub fn at(&self, t: f64) -> Option<[f64; 3]> {
        let inside = (0.0..=self.length()).contains(&t) && !self.accelerations.is_empty();
        if !inside {
            return None;
        }
        let place = self.knots[1..]
            .partition_point(|knot| knot.t < t)
            .min(self.accelerations.len() - 1);
        let (knot, a) = (self.knots[place], self.accelerations[place]);
        let dt = t - knot.t;
        Some([knot.s + knot.v * dt + 0.5 * a * dt * dt, knot.v + a * dt, a])
    }
}
