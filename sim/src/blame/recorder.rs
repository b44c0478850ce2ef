//! What a run leaves for its inquest: the ego and everybody else at every sample, and each decision with its frame.
//!
//! After the end of the run everybody goes on where that does not hang on the ego, and at the last speed where it does.

use super::tracks::Surroundings;
use crate::agents::Agents;
use crate::closed_loop::Sink;
use crate::run::run_into;
use crate::settings::Settings;
use crate::trace::{TickRecord, TraceError};
use crate::verdict::Verdict;
use corridor_decider::decision::Decision;
use corridor_decider::frame::{EgoState, Frame};
use corridor_scenarios::Scenario;

/// Time between two samples, s, unless the physics is coarser.
const SAMPLE: f64 = 0.01;

/// How long everybody is followed after the end of the run, s: longer than any motion has to survive then.
const AFTER: f64 = 5.0;

/// A recorded run.
#[derive(Clone, Debug)]
pub struct Recording {
    /// Everybody else.
    pub surroundings: Surroundings,
    /// The ego at every sample, the start first.
    pub ego: Vec<EgoState>,
    /// Each frame and what was decided on it.
    pub ticks: Vec<(Frame, Decision)>,
    /// How it ended.
    pub verdict: Verdict,
}

impl Recording {
    /// Runs a scenario and records it.
    pub fn of(scenario: &Scenario, settings: &Settings) -> Self {
        let mut recorder = Recorder::new(scenario, settings);
        let Ok(verdict) = run_into(scenario, settings, &mut recorder) else {
            unreachable!("keeping in memory cannot fail");
        };
        recorder.finish(verdict)
    }

    /// The sample at a time.
    pub fn sample_at(&self, time: f64) -> usize {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the time of a run, which is short"
        )]
        let sample = (time / self.surroundings.dt).round().max(0.0) as usize;
        sample
    }

    /// The time of a sample, s.
    pub fn time_of(&self, sample: usize) -> f64 {
        sample as f64 * self.surroundings.dt
    }
}

struct Recorder {
    surroundings: Surroundings,
    ego: Vec<EgoState>,
    ticks: Vec<(Frame, Decision)>,
    /// Everybody else once more, step by step with the run's: the world does not tell who goes on how.
    agents: Agents,
    before: EgoState,
    /// Length of a physics step, s, and how many of them make a sample.
    dt: f64,
    stride: usize,
    steps: usize,
}

impl Recorder {
    fn new(scenario: &Scenario, settings: &Settings) -> Self {
        let dt = settings.physics.dt;
        let stride = super::search::samples_in(SAMPLE, dt);
        let start = EgoState {
            pose: scenario.ego.pose,
            v: scenario.ego.speed,
            a: 0.0,
            yaw_rate: 0.0,
            steer: 0.0,
        };
        Self {
            surroundings: Surroundings::new(scenario, stride as f64 * dt),
            ego: vec![start],
            ticks: Vec::new(),
            agents: Agents::new(scenario),
            before: start,
            dt,
            stride,
            steps: 0,
        }
    }

    /// Keeps where everybody is after one more physics step.
    fn keep(&mut self) -> bool {
        self.steps += 1;
        let is_sample = self.steps.is_multiple_of(self.stride);
        if is_sample {
            for body in self.agents.moving() {
                self.surroundings.tracks[body.id.0 as usize].push(body.pose);
            }
        }
        is_sample
    }

    fn finish(mut self, verdict: Verdict) -> Recording {
        let mut left = super::search::samples_in(AFTER, self.dt);
        while left > 0 {
            self.agents.go_on_alone(self.dt);
            self.keep();
            left -= 1;
        }
        Recording {
            surroundings: self.surroundings,
            ego: self.ego,
            ticks: self.ticks,
            verdict,
        }
    }
}

impl Sink for Recorder {
    fn tick(&mut self, tick: &TickRecord) -> Result<(), TraceError> {
        self.ticks.push((tick.frame.clone(), tick.decision.clone()));
        Ok(())
    }

    fn stepped(&mut self, ego: &EgoState) {
        self.agents.advance(&self.before, self.dt);
        self.before = *ego;
        if self.keep() {
            self.ego.push(*ego);
        }
    }
}
