//! The plan along one line while the tasks work on it (the original's `ReferenceLineInfo`).

use crate::context::LastPath;
use crate::decision::{Assessment, Rejection, Stop, TaskReport};
use crate::frame::ObstacleId;
use crate::st_graph::SpeedData;
use crate::tasks::object_decision::ObjectDecision;
use crate::tasks::path::Path;
use crate::tasks::path_bounds::{Borrow, Label, PathBounds};
use crate::tasks::rss::RssState;
use crate::tasks::scene::Scene;
use crate::tasks::speed_bounds::{Envelope, OnPath};

/// What the tasks have found so far. Each field is written by the task named beside it.
#[derive(Debug)]
pub struct LinePlan<'a> {
    /// The frame seen along the line.
    pub scene: Scene<'a>,
    /// The way of the tick before, if it may still be driven (path reuse).
    pub last_path: Option<LastPath>,
    /// Sides that may be borrowed (lane borrow).
    pub borrow: Vec<Borrow>,
    /// The bounds (path bounds).
    pub bounds: PathBounds,
    /// Per bound its path; `None` where none was looked for (piecewise-jerk path).
    pub candidates: Vec<Option<Result<Path, Rejection>>>,
    /// Per bound what became of it (path assessment).
    pub assessments: Vec<Assessment>,
    /// The path that is driven, and the place of its bound (path assessment).
    pub chosen: Option<(usize, Path)>,
    /// Whether a borrowed lane leads past what blocks the own one, be it free or not, if that was looked at (path
    /// assessment).
    pub borrow_leads_on: Option<bool>,
    /// What is decided about each of the scene's obstacles (path decider, speed decider).
    pub decisions: Vec<ObjectDecision>,
    /// Where the car would stand before what blocks the chosen path, m along it (path decider).
    pub stop_before_blocker: Option<f64>,
    /// Where the car would stand on the chosen path (rule-based stop).
    pub wall: Option<Stop>,
    /// What moving obstacles will occupy of the chosen path (speed bounds).
    pub on_path: Vec<OnPath>,
    /// How fast the road allows to drive along it (speed bounds).
    pub envelope: Option<Envelope>,
    /// A first profile, coarse (speed heuristic).
    pub heuristic: Option<SpeedData>,
    /// Why the car slows down (speed).
    pub stop: Option<Stop>,
    /// Speed along the chosen path (speed).
    pub speed: Option<SpeedData>,
    /// Whether the gap ahead is safe (RSS).
    pub rss: Option<RssState>,
    /// What each task that ran had to say.
    pub reports: Vec<TaskReport>,
}

impl<'a> LinePlan<'a> {
    /// A plan that nothing has worked on yet.
    pub fn new(scene: Scene<'a>) -> Self {
        Self {
            decisions: vec![ObjectDecision::default(); scene.obstacles.len()],
            scene,
            last_path: None,
            stop_before_blocker: None,
            on_path: Vec::new(),
            envelope: None,
            heuristic: None,
            borrow: Vec::new(),
            bounds: PathBounds::default(),
            candidates: Vec::new(),
            assessments: Vec::new(),
            chosen: None,
            borrow_leads_on: None,
            wall: None,
            stop: None,
            speed: None,
            rss: None,
            reports: Vec::new(),
        }
    }

    /// Label of the bound whose path is driven.
    pub fn label(&self) -> Option<Label> {
        self.chosen
            .as_ref()
            .map(|(place, _)| self.bounds.bounds[*place].label)
    }

    /// The path that is driven.
    pub fn path(&self) -> Option<&Path> {
        self.chosen.as_ref().map(|(_, path)| path)
    }

    /// What is decided about an obstacle of the scene.
    pub fn decision(&self, id: ObstacleId) -> Option<&ObjectDecision> {
        let place = self
            .scene
            .obstacles
            .iter()
            .position(|obstacle| obstacle.id == id)?;
        self.decisions.get(place)
    }
}
