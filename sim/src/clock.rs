//! Simulated time: a whole number of physics steps per planning tick.

/// Counts ticks; time is a product, never a sum, so it does not drift.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clock {
    tick: u32,
    steps_per_tick: u32,
    step: f64,
}

impl Clock {
    /// A clock whose planning period is the whole multiple of the step nearest to `period`.
    pub(crate) fn new(period: f64, step: f64) -> Self {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "saturates; settings check it"
        )]
        let steps_per_tick = (period / step).round().max(1.0) as u32;
        Self {
            tick: 0,
            steps_per_tick,
            step,
        }
    }

    /// Ticks begun before this one.
    pub(crate) fn tick(self) -> u32 {
        self.tick
    }

    /// Physics steps in a tick.
    pub(crate) fn steps_per_tick(self) -> u32 {
        self.steps_per_tick
    }

    /// Seconds since the start of the run, at the start of the tick.
    pub(crate) fn time(self) -> f64 {
        f64::from(self.tick) * f64::from(self.steps_per_tick) * self.step
    }

    /// Seconds since the start of the tick, before its physics step number `step`.
    pub(crate) fn since_tick(self, step: u32) -> f64 {
        f64::from(step) * self.step
    }

    pub(crate) fn next_tick(&mut self) {
        self.tick += 1;
    }
}
