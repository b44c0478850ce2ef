//! A fault at work in one run, with what it remembers of it.

use super::{Fault, Plant, Spec};
use crate::trace::Controls;
use crate::tracker::TrackerConfig;
use corridor_decider::config::Config;
use corridor_decider::context::Context;
use corridor_decider::decision::{Decision, TrajectoryPoint};
use corridor_decider::frame::{Frame, Obstacle};
use corridor_decider::planner::{LinePlan, TaskName};
use corridor_decider::reference_line::{LineSample, ReferenceLine};
use corridor_decider::tasks::path_bounds::PathBounds;
use corridor_decider::vehicle::VehicleParams;
use std::borrow::Cow;
use std::collections::VecDeque;
use std::sync::Arc;

/// Frames that are remembered: a second at the usual rate.
const FRAMES: usize = 11;

/// Altered lines that are remembered: those of a tick and of the one before.
const LINES: usize = 4;

/// What a fault remembers of its run.
#[derive(Clone, Debug, Default)]
pub struct Past {
    /// Frames as they were, the present one last.
    frames: VecDeque<Frame>,
    /// Bounds of the tick before, along the own line and along the one to change to.
    pub(super) bounds: [Option<PathBounds>; 2],
    /// Obstacles as they were when they were first seen.
    pub(super) first_seen: Vec<Obstacle>,
    /// An earlier decision.
    pub(super) decision: Option<Decision>,
    /// Earlier trajectories, the latest last.
    pub(super) trajectories: VecDeque<Vec<TrajectoryPoint>>,
    /// Earlier controls, the latest last.
    pub(super) controls: VecDeque<Controls>,
    /// Lines with what a fault made of them.
    lines: Vec<(Arc<ReferenceLine>, Arc<ReferenceLine>)>,
}

impl Past {
    /// The frame so many ticks ago; the first one before there were as many.
    pub(super) fn frame_ago(&self, ticks: usize) -> Option<&Frame> {
        let last = self.frames.len().checked_sub(1)?;
        self.frames.get(last.saturating_sub(ticks))
    }

    /// Number of the present tick.
    pub(super) fn tick(&self) -> u32 {
        self.frames.back().map_or(0, |frame| frame.tick)
    }

    /// The line with every cross-section changed; the same one as long as the line is the same.
    pub(super) fn altered(
        &mut self,
        line: &Arc<ReferenceLine>,
        change: impl Fn(&mut LineSample),
    ) -> Arc<ReferenceLine> {
        if let Some((_, altered)) = self.lines.iter().find(|(known, _)| Arc::ptr_eq(known, line)) {
            return Arc::clone(altered);
        }
        let mut samples = line.samples().to_vec();
        samples.iter_mut().for_each(change);
        let altered = Arc::new(ReferenceLine::from(samples));
        if self.lines.len() == LINES {
            self.lines.remove(0);
        }
        self.lines.push((Arc::clone(line), Arc::clone(&altered)));
        altered
    }

    fn see(&mut self, frame: &Frame) {
        if self.frames.len() == FRAMES {
            self.frames.pop_front();
        }
        self.frames.push_back(frame.clone());
    }
}

/// A fault at work, or none. Every method leaves alone what its fault is not planted on.
#[derive(Clone, Debug)]
pub(crate) struct Planted {
    spec: Option<&'static Spec>,
    past: Past,
}

impl Planted {
    pub(crate) fn new(fault: Fault) -> Self {
        Self {
            spec: fault.spec(),
            past: Past::default(),
        }
    }

    fn plant(&self) -> Option<Plant> {
        self.spec.map(|spec| spec.plant)
    }

    /// The settings of the decider.
    pub(crate) fn config<'a>(&self, config: &'a Config) -> Cow<'a, Config> {
        let mut config = Cow::Borrowed(config);
        if let Some(Plant::Config(change)) = self.plant() {
            change(config.to_mut());
        }
        config
    }

    /// The car as the planner knows it.
    pub(crate) fn car(&self, mut vehicle: VehicleParams) -> VehicleParams {
        if let Some(Plant::Car(change)) = self.plant() {
            change(&mut vehicle);
        }
        vehicle
    }

    /// The frame as the decider sees it. To be asked for once a tick.
    pub(crate) fn seen<'a>(&mut self, frame: &'a Frame) -> Cow<'a, Frame> {
        let mut seen = Cow::Borrowed(frame);
        if self.spec.is_some() {
            self.past.see(frame);
        }
        if let Some(Plant::Frame(change)) = self.plant() {
            change(seen.to_mut(), &mut self.past);
        }
        seen
    }

    /// What the decider remembers.
    pub(crate) fn remembered(&self, context: &mut Context) {
        if let Some(Plant::Memory(change)) = self.plant() {
            change(context);
        }
    }

    /// The answer is to be made.
    pub(crate) fn answers(&self, frame: &Frame) {
        if let Some(Plant::Answer(fail)) = self.plant() {
            fail(frame);
        }
    }

    /// What a task hands on.
    pub(crate) fn hands_on(&mut self, task: TaskName, plan: &mut LinePlan) {
        if let Some(Plant::HandsOn(of, change)) = self.plant()
            && of == task
        {
            change(plan, &mut self.past);
        }
    }

    /// The decision as it is given out.
    pub(crate) fn decided(&mut self, mut decision: Decision) -> Decision {
        if let Some(Plant::Decision(change)) = self.plant() {
            change(&mut decision, &mut self.past);
        }
        decision
    }

    /// The trajectory as the tracker is given it; `None`: it is given the decided one.
    pub(super) fn followed(&mut self, trajectory: &[TrajectoryPoint]) -> Option<Vec<TrajectoryPoint>> {
        let Some(Plant::Trajectory(change)) = self.plant() else {
            return None;
        };
        let mut followed = trajectory.to_vec();
        change(&mut followed, &mut self.past);
        Some(followed)
    }

    /// The car and the gains as the tracker knows them.
    pub(super) fn tracker(&self, vehicle: &mut VehicleParams, config: &mut TrackerConfig) {
        if let Some(Plant::Tracker(change)) = self.plant() {
            change(vehicle, config);
        }
    }

    /// The controls as the car is given them.
    pub(super) fn controls(&mut self, mut controls: Controls) -> Controls {
        if let Some(Plant::Controls(change)) = self.plant() {
            change(&mut controls, &mut self.past);
        }
        controls
    }
}
