//! The monitor: judges a run from physics and geometry alone, metric by metric.
//!
//! It reads the world and the decisions and changes neither. Every physics step it looks for contacts; everything
//! else is sampled at 10 Hz, the rate for which the field's thresholds are made. World frame, SI units; names and
//! thresholds are those of nuPlan, of Apollo's pull-over check and of this project's metric set.
//!
//! Of one moment, the step is shown first and the tick after it: the driving is held against the decision under
//! which it happened.

mod avoidance;
mod blocks;
mod bound_clearance;
mod bounds;
mod collision;
mod consistency;
mod decider;
mod ending;
mod fallbacks;
mod following;
mod impact;
mod labels;
mod measure;
pub mod metrics;
mod motion;
mod path_clearance;
mod pet;
mod plan;
mod progress;
mod pull_over;
mod reference_search;
mod road;
mod rss;
mod savitzky_golay;
mod score;
mod silhouette;
mod standstill;
pub(crate) mod summary;
mod surroundings;
#[cfg(test)]
mod tests;
mod tr1;
mod tracking;
mod ttc;
mod view;

pub use rss::RssProfile;
pub use view::{Motion, StepView, Traffic};

use crate::decider::NoAnswer;
use crate::signature::Signature;
use crate::verdict::{Ending, Metric, Verdict};
use corridor_decider::decision::Decision;
use corridor_decider::frame::Frame;
use corridor_decider::reference_line::LineQuery;
use corridor_scenarios::Scenario;
use measure::Measure;
use plan::Plan;
use std::sync::Arc;
use view::Sample;

/// Time between two samples, s.
const SAMPLE_PERIOD: f64 = 0.1;

/// How early a step may come and still be the one of the sample, s: far above the error of adding up steps, far below
/// a step.
const TIME_TOLERANCE: f64 = 1e-6;

/// Judges one run.
#[derive(Clone, Debug)]
pub struct Monitor {
    scenario: Scenario,
    names: Vec<String>,
    plan: Option<Plan>,
    now: f64,
    samples: u32,
    /// Where along the scenario's line the ego was at the last sample, m.
    station: Option<f64>,
    history: avoidance::History,
    surroundings: surroundings::Surroundings,
    collision: collision::CollisionJudge,
    road: road::RoadWatch,
    progress: progress::ProgressWatch,
    standstill: standstill::StandstillWatch,
    decider: decider::DeciderWatch,
    fallbacks: fallbacks::FallbackWatch,
    ttc: ttc::TtcWatch,
    motion: motion::MotionWatch,
    consistency: consistency::ConsistencyWatch,
    silhouettes: silhouette::Silhouettes,
    bounds: bounds::BoundWatch,
    bound_clearance: bound_clearance::BoundClearanceWatch,
    path_clearance: path_clearance::PathClearanceWatch,
    blocks: blocks::BlockWatch,
    labels: labels::LabelWatch,
    pull_over: pull_over::PullOverWatch,
    tracking: tracking::TrackingWatch,
    rss: rss::RssWatch,
    following: following::FollowingWatch,
    pet: pet::PetWatch,
    tr1: tr1::Tr1Watch,
    ending: ending::EndingWatch,
}

impl Monitor {
    /// A monitor for one run of `scenario`.
    pub fn new(scenario: &Scenario) -> Self {
        Self {
            names: scenario.obstacles.iter().map(|o| o.name.clone()).collect(),
            plan: None,
            now: 0.0,
            samples: 0,
            station: None,
            history: avoidance::History::default(),
            surroundings: surroundings::Surroundings::default(),
            collision: collision::CollisionJudge::default(),
            road: road::RoadWatch::default(),
            progress: progress::ProgressWatch::new(scenario),
            standstill: standstill::StandstillWatch::default(),
            decider: decider::DeciderWatch::default(),
            fallbacks: fallbacks::FallbackWatch::default(),
            ttc: ttc::TtcWatch::new(scenario),
            motion: motion::MotionWatch::default(),
            consistency: consistency::ConsistencyWatch::default(),
            silhouettes: silhouette::Silhouettes::default(),
            bounds: bounds::BoundWatch::default(),
            bound_clearance: bound_clearance::BoundClearanceWatch::default(),
            path_clearance: path_clearance::PathClearanceWatch::default(),
            blocks: blocks::BlockWatch::default(),
            labels: labels::LabelWatch::default(),
            pull_over: pull_over::PullOverWatch::default(),
            tracking: tracking::TrackingWatch::default(),
            rss: rss::RssWatch::default(),
            following: following::FollowingWatch::default(),
            pet: pet::PetWatch::default(),
            tr1: tr1::Tr1Watch::default(),
            ending: ending::EndingWatch::default(),
            scenario: scenario.clone(),
        }
    }

    /// The same with other safe distances.
    #[must_use]
    pub fn with_rss(self, profile: RssProfile) -> Self {
        Self {
            rss: rss::RssWatch::new(profile),
            ..self
        }
    }

    /// Takes in the world after one physics step.
    pub fn step(&mut self, view: &StepView) {
        self.now = view.time;
        self.collision.step(&self.scenario, view, &self.history);
        if !self.collision.collisions().is_empty() {
            self.ending.end(Ending::Collision);
        }
        self.ending.step(&self.scenario, view);
        let next_sample = f64::from(self.samples + 1) * SAMPLE_PERIOD;
        if view.time >= next_sample - TIME_TOLERANCE {
            self.samples += 1;
            self.sample(view);
        }
    }

    /// Takes in a frame and what was decided on it.
    pub fn tick(&mut self, frame: &Frame, decision: &Decision) {
        let plan = Plan::new(frame, decision);
        self.decider.tick(frame, decision, &plan);
        self.fallbacks.tick(frame, decision);
        self.bounds.tick(frame, self.plan.as_ref(), &plan);
        self.consistency.tick(self.plan.as_ref(), &plan);
        self.obstacles(frame, decision, &plan);
        self.labels.tick(frame, &plan);
        self.ending.tick(&self.scenario, &plan);
        if self.decider.first_fault().is_some() {
            self.ending.end(Ending::DeciderFailed);
        }
        self.plan = Some(plan);
    }

    /// Holds a decision against what stands.
    fn obstacles(&mut self, frame: &Frame, decision: &Decision, plan: &Plan) {
        let vehicle = &self.scenario.vehicle;
        if let Some(line) = &plan.line {
            let standing = self.silhouettes.of(frame, line);
            self.bound_clearance
                .tick(frame, plan, &standing, vehicle.half_width());
            self.blocks.tick(frame, plan, &standing, vehicle);
        }
        self.path_clearance.tick(frame, decision, vehicle);
    }

    /// Takes in that the decider gave no answer at all.
    pub fn decider_failed(&mut self, time: f64, why: &NoAnswer) {
        self.now = time;
        self.decider.no_answer(time, why);
        self.ending.end(Ending::DeciderFailed);
    }

    /// How the run ended, once it has.
    pub fn is_over(&self) -> Option<Ending> {
        self.ending.ending()
    }

    fn sample(&mut self, view: &StepView) {
        let (line, position) = (&self.scenario.line, view.ego.pose.position());
        // Where a route crosses itself the ego is on the pass on which it was.
        let at = self.station.map_or_else(
            || line.to_frenet(position),
            |before| line.to_frenet_near(position, before),
        );
        self.station = Some(at.s);
        let planned = self.plan.as_ref().and_then(|plan| plan.line.as_ref());
        let planned = planned.filter(|planned| !Arc::ptr_eq(planned, line));
        let sample = Sample {
            view: *view,
            scenario: &self.scenario,
            at,
            planned: planned.map_or(at, |planned| planned.to_frenet(position)),
            plan: self.plan.as_ref(),
        };
        self.history.sample(&sample);
        self.road.sample(&sample);
        self.progress.sample(&sample);
        self.standstill.sample(&sample);
        self.ttc.sample(&sample);
        self.motion.sample(&sample);
        self.bounds.sample(&sample);
        self.pull_over.sample(&sample);
        self.tracking.sample(&sample);
        self.surroundings.look(&sample);
        self.rss.sample(&sample, &self.surroundings);
        self.following.sample(view.time, &self.surroundings);
        self.pet.sample(&sample);
        self.tr1.sample(&sample, &self.surroundings);
        self.ending.sample(&sample, &self.progress, &self.pull_over);
    }

    /// The judgement. Its digest is left empty: whoever keeps the hashes fills it in. A run that was stopped before
    /// its end counts as out of time.
    pub fn verdict(&self) -> Verdict {
        let ending = self.is_over().unwrap_or(Ending::Timeout);
        let is_expected = ending::is_expected(&self.scenario, ending);
        let metrics = self.metrics(is_expected);
        let pass = is_expected && metrics.iter().all(|m| m.pass || !m.gate);
        let collisions = self.collision.collisions().to_vec();
        let fault = self.decider.first_fault();
        let driven = self.plan.as_ref();
        let driven = (driven.and_then(Plan::label), driven.map(|plan| plan.outcome));
        let signature = (!pass).then(|| Signature::of(&self.scenario, ending, &metrics, &collisions, driven));
        Verdict {
            pass,
            ending,
            summary: summary::sentence(pass, ending, self.now, &collisions, fault, &metrics),
            duration: self.now,
            metrics,
            collisions,
            outcomes: self.decider.outcomes(),
            fallbacks: self.fallbacks.counts(),
            signature,
            digest: String::new(),
        }
    }

    /// Every metric of the list, in its order, but gates first.
    fn metrics(&self, is_expected: bool) -> Vec<Metric> {
        let completed = Measure::new("scenario_completed", Some(f64::from(u8::from(is_expected))));
        let mut measures = self.collision.measures();
        measures.extend(self.road.measures());
        measures.extend(self.progress.measures());
        measures.extend(self.standstill.measures());
        measures.push(completed);
        measures.extend(self.decider.measures());
        measures.extend(self.fallbacks.measures());
        measures.extend(self.ttc.measures());
        measures.extend(self.motion.measures());
        measures.extend(self.consistency.measures());
        measures.extend(self.bounds.measures());
        measures.extend(self.bound_clearance.measures());
        measures.extend(self.path_clearance.measures());
        measures.extend(self.blocks.measures());
        measures.extend(self.labels.measures());
        measures.extend(self.pull_over.measures(&self.scenario));
        measures.extend(self.tracking.measures());
        measures.extend(self.rss.measures());
        measures.extend(self.following.measures());
        measures.extend(self.pet.measures());
        measures.extend(self.tr1.measures());
        let named = measures.into_iter().map(|m| m.into_metric(&self.names));
        let mut metrics: Vec<Metric> = named.collect();
        let scores = score::scores(&metrics, self.collision.multiplier(&self.scenario));
        metrics.extend(scores.map(|score| score.into_metric(&self.names)));
        metrics.sort_by_key(|metric| {
            let place = metrics::definitions().position(|definition| definition.name == metric.name);
            (!metric.gate, place)
        });
        metrics
    }
}
