//! The closed loop. Start reading here: `ClosedLoop::tick` is what Corridor does.

use crate::agents::Agents;
use crate::clock::Clock;
use crate::decider::Decider;
use crate::faults::{Following, Planted};
use crate::monitor::{Monitor, Motion, StepView, Traffic};
use crate::perception;
use crate::route::Route;
use crate::settings::{Prediction, Settings, Tracking};
use crate::story::Story;
use crate::trace::{Controls, TickRecord, TraceError};
use crate::tracker::{self, TrackerConfig};
use crate::verdict::Verdict;
use crate::world::{Fnv, World};
use corridor_decider::decision::{Decision, TrajectoryPoint};
use corridor_decider::frame::{EgoState, Frame, ObstacleId};
use corridor_decider::planner::TaskName;
use corridor_decider::vehicle::VehicleParams;
use corridor_scenarios::Scenario;

/// Takes in each finished tick: a trace writer, a test, or nobody.
pub trait Sink {
    /// Takes in one tick.
    ///
    /// # Errors
    /// [`TraceError`] when it cannot be kept; the run stops then.
    fn tick(&mut self, tick: &TickRecord) -> Result<(), TraceError>;

    /// Hears where the ego is after a physics step.
    fn stepped(&mut self, _: &EgoState) {}

    /// Hears that the decider is about to be asked. The loop knows no clock; whoever times the decider does it here.
    fn deciding(&mut self) {}

    /// Hears that it has answered.
    fn decided(&mut self) {}

    /// Hears that the decider begins with a task.
    fn begins(&mut self, _: TaskName) {}

    /// Hears that the task that began last has ended.
    fn ended(&mut self, _: TaskName) {}
}

/// A sink that keeps nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoSink;

impl Sink for NoSink {
    fn tick(&mut self, _: &TickRecord) -> Result<(), TraceError> {
        Ok(())
    }
}

/// One run of one scenario.
pub struct ClosedLoop {
    clock: Clock,
    world: World,
    agents: Agents,
    route: Route,
    decider: Decider,
    tracker: Following,
    monitor: Monitor,
    story: Story,
    sensor_range: f64,
    tracking: Tracking,
    prediction: Prediction,
    vehicle: VehicleParams,
    digest: Fnv,
}

impl ClosedLoop {
    /// The loop at the start of `scenario`.
    pub fn new(scenario: &Scenario, settings: &Settings) -> Self {
        let tracking = TrackerConfig::for_car(&scenario.vehicle, &settings.physics.dynamics);
        let planted = Planted::new(settings.fault);
        let config = planted.config(&settings.decider);
        Self {
            clock: Clock::new(settings.tick, settings.physics.dt),
            world: World::new(scenario, &settings.physics),
            agents: Agents::new(scenario),
            route: Route::new(scenario, &config.lane_follow),
            decider: Decider::new(scenario.vehicle, settings),
            tracker: Following::new(scenario.vehicle, tracking, settings.fault),
            monitor: Monitor::new(scenario).with_rss(settings.rss),
            story: Story::new(scenario),
            sensor_range: perception::SENSOR_RANGE,
            tracking: settings.tracker,
            prediction: settings.prediction,
            vehicle: scenario.vehicle,
            digest: Fnv::new(),
        }
    }

    /// Runs to the end and judges. Every tick goes to `sink`.
    ///
    /// # Errors
    /// [`TraceError`] of the sink.
    pub fn run(mut self, sink: &mut dyn Sink) -> Result<Verdict, TraceError> {
        while self.monitor.is_over().is_none() {
            let Some(tick) = self.tick(sink) else { break };
            sink.tick(&tick)?;
        }
        let digest = format!("{:016x}", self.digest.finish());
        Ok(Verdict {
            digest,
            ..self.monitor.verdict()
        })
    }

    /// Advances the loop by one planning period. `None`: the decider gave no answer.
    fn tick(&mut self, sink: &mut dyn Sink) -> Option<TickRecord> {
        let frame = self.observe();
        sink.deciding();
        let answer = self.decider.decide(&frame, sink);
        sink.decided();
        let decision = match answer {
            Ok(decision) => decision,
            Err(reason) => {
                self.monitor.decider_failed(frame.time, &reason);
                return None;
            }
        };
        self.monitor.tick(&frame, &decision);
        let mut controls = Controls::default();
        for step in 0..self.clock.steps_per_tick() {
            controls = self.drive(&decision.trajectory, step, sink);
            if self.monitor.is_over().is_some() {
                break;
            }
        }
        self.clock.next_tick();
        Some(self.record(frame, decision, controls))
    }

    /// What the sensors and the router tell the decider now.
    fn observe(&mut self) -> Frame {
        let ego = perception::localise(&self.world);
        let time = self.clock.time();
        let mut obstacles = perception::observe(&self.world, &self.agents, self.sensor_range);
        if self.prediction == Prediction::TrueFuture {
            perception::foresee(&mut obstacles, &self.world, &self.agents);
        }
        Frame {
            tick: self.clock.tick(),
            time,
            ego,
            command: self.route.command(time),
            cruise_speed: self.route.cruise_speed(),
            lines: self.route.lines(&ego, time),
            obstacles,
        }
    }

    /// One physics step along the trajectory.
    fn drive(&mut self, trajectory: &[TrajectoryPoint], step: u32, sink: &mut dyn Sink) -> Controls {
        let ego = self.world.ego();
        let controls = self.tracker.track(&ego, trajectory, self.clock.since_tick(step));
        let moved = self.agents.advance(&ego, self.world.dt());
        match self.tracking {
            Tracking::Feedback => self.world.step(controls, moved),
            Tracking::Perfect => {
                let after = self.clock.since_tick(step + 1);
                let there = tracker::perfect(&ego, trajectory, after, &self.vehicle, self.world.dt());
                self.world.place(there, moved);
            }
        }
        sink.stepped(&self.world.ego());
        let footprint = self.world.ego_footprint();
        let overlapping: Vec<ObstacleId> = self.world.hits().collect();
        self.monitor.step(&StepView {
            time: self.clock.time() + self.clock.since_tick(step + 1),
            ego: &self.world.ego(),
            footprint: &footprint,
            clearance: self.world.clearance(),
            overlapping: &overlapping,
            traffic: &self.world,
        });
        controls
    }

    fn record(&mut self, frame: Frame, decision: Decision, controls: Controls) -> TickRecord {
        let hash = self.world.state_hash();
        self.digest.word(hash);
        let (lines, new_lines) = self.route.places(&frame.lines);
        TickRecord {
            events: self.story.of(
                &frame,
                &decision,
                self.route.lost(),
                self.monitor.is_over(),
                self.world.hits(),
            ),
            ego: self.world.ego(),
            clearance: self.world.clearance(),
            hash: format!("{hash:016x}"),
            frame,
            lines,
            new_lines,
            decision,
            controls,
        }
    }
}

impl Traffic for World {
    fn motion(&self, id: ObstacleId) -> Motion {
        let body = &self.obstacles()[id.0 as usize];
        Motion {
            pose: body.pose,
            velocity: body.velocity,
        }
    }
}
