//! The scenario file: what may stand in it, read with exact places for mistakes.
//!
//! TOML. Every number may be a law to draw it from; see [`number`]. What is read here is well-formed and in
//! range, but nothing is placed on a road yet.

mod law;
pub mod number;
pub mod obstacle;
pub mod task;
pub mod vehicle;

pub use law::LawKind;

use crate::error::{Place, ScenarioError};
use number::{Number, Seconds, Speed};
use obstacle::{Idm, Moving, Parked, Pedestrian, Scripted};
use serde::Deserialize;
use task::{Command, Ego, Expect, RoutePlace};
use toml::Spanned;
use vehicle::Vehicle;

/// Speed to drive where the file names none, m/s: 30 km/h, for streets with parked cars.
const CRUISE_SPEED: f64 = 8.33;

/// How long a run may take where the file does not say, s; the original's test runner allows as much.
const TIMEOUT: f64 = 60.0;

/// One scenario file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScenarioFile {
    /// Name of the family; that of the file when absent.
    pub name: Option<String>,
    /// One sentence for people.
    pub description: String,
    /// Name of an own map, or path of a map file: relative to this one, or from `$MAPS/`.
    pub map: Spanned<String>,
    /// Names of the lanes to follow; straight on from the ego's lane when absent.
    #[serde(default)]
    pub route: Vec<Spanned<String>>,
    /// Where the drive leads: the router finds the way, lane changes included.
    pub destination: Option<RoutePlace>,
    /// Places to pass on the way there, in order.
    #[serde(default)]
    pub via: Vec<RoutePlace>,
    /// Length of the route to follow, m; what the run may need when absent.
    pub route_length: Option<f64>,
    /// Speed to drive where nothing limits it, m/s.
    #[serde(default = "default_cruise_speed")]
    pub cruise_speed: Number<Speed>,
    /// How long the run may take, s.
    #[serde(default = "default_timeout")]
    pub timeout: Number<Seconds>,
    /// Where and how the ego starts.
    #[serde(default)]
    pub ego: Ego,
    /// What it is asked to do.
    #[serde(default)]
    pub command: Command,
    /// How the run should end; what the command is for when absent.
    pub expect: Option<Expect>,
    /// The ego's body.
    #[serde(default)]
    pub vehicle: Vehicle,
    /// Whether what the map puts on its lanes is there: barriers, posts, islands.
    #[serde(default)]
    pub map_objects: bool,
    /// Standing obstacles.
    #[serde(default)]
    pub parked: Vec<Parked>,
    /// Traffic cones: standing obstacles of that class.
    #[serde(default)]
    pub cone: Vec<Parked>,
    /// Obstacles of constant speed.
    #[serde(default)]
    pub moving: Vec<Moving>,
    /// Drivers that follow their leaders.
    #[serde(default)]
    pub idm: Vec<Idm>,
    /// Obstacles on a timetable.
    #[serde(default)]
    pub scripted: Vec<Scripted>,
    /// People who cross.
    #[serde(default)]
    pub pedestrian: Vec<Pedestrian>,
}

fn default_cruise_speed() -> Number<Speed> {
    Number::fixed(CRUISE_SPEED)
}

fn default_timeout() -> Number<Seconds> {
    Number::fixed(TIMEOUT)
}

impl ScenarioFile {
    /// Reads the text of a file called `file`.
    ///
    /// # Errors
    /// [`ScenarioError::Schema`] with the place of the first mistake.
    pub fn parse(text: &str, file: &str) -> Result<Self, ScenarioError> {
        toml::from_str(text).map_err(|error| ScenarioError::Schema {
            place: Box::new(Place::of(text, file, error.span().unwrap_or(0..0))),
            problem: error.message().to_owned(),
        })
    }
}
