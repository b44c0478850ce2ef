//! Everything about a run that is not the scenario: the decider, the physics, the period, a planted fault.

use crate::faults::{Failure, Fault};
use crate::monitor::RssProfile;
use crate::world::PhysicsConfig;
use corridor_decider::config::Config;
use serde::{Deserialize, Serialize};

/// Settings of a run. `--set key=value` changes one by its dotted name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// The decider.
    pub decider: Config,
    /// The physics.
    pub physics: PhysicsConfig,
    /// Planning period, s; a whole number of physics steps.
    pub tick: f64,
    /// A fault planted on purpose, by its name.
    pub fault: Fault,
    /// Parts that fail for a while.
    pub failures: Vec<Failure>,
    /// The safe distances that the monitor holds a run against.
    pub rss: RssProfile,
    /// How the ego follows what was decided.
    pub tracker: Tracking,
    /// What the decider is told of the others' future.
    pub prediction: Prediction,
}

/// How the ego follows a trajectory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Tracking {
    /// By feedback, as a car does.
    #[default]
    Feedback,
    /// Perfectly: it is put where the trajectory has it at each physics step. Contacts are judged all the same.
    Perfect,
}

/// What the decider is told of the others' future.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Prediction {
    /// What an observer expects: on along the line, on along the record, straight on.
    #[default]
    Expected,
    /// What they are going to do if the ego goes straight on as it does. Exact for who does not react to it.
    TrueFuture,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            decider: Config::default(),
            physics: PhysicsConfig::default(),
            tick: 0.1,
            fault: Fault::NONE,
            failures: Vec::new(),
            rss: RssProfile::default(),
            tracker: Tracking::default(),
            prediction: Prediction::default(),
        }
    }
}

/// Largest number that a setting may be: above every stiffness and inertia of a car. None is negative.
const LARGEST: f64 = 1e6;

/// Shortest and longest physics step, s: below, a run takes a day; above, the car outruns its tyres' lag.
const STEPS: (f64, f64) = (1e-4, 0.05);

/// Most physics steps of a planning tick: at the usual step, one decision a second.
const MOST_STEPS: f64 = 100.0;

/// Why a setting cannot be made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SettingError {
    /// Not of the form `key=value`.
    #[error("`{0}`: a setting has the form `key=value`, as in `decider.path_bounds.obstacle_lat_buffer=0.3`")]
    Form(String),
    /// No setting of this name.
    #[error("`{key}`: no such setting; `{parent}` has: {known}")]
    Unknown {
        /// The key as given.
        key: String,
        /// The part of it that exists.
        parent: String,
        /// What that part has.
        known: String,
    },
    /// A value that the setting cannot have.
    #[error("`{key}={value}`: {problem}")]
    Value {
        /// The key.
        key: String,
        /// The value as given.
        value: String,
        /// What is wrong with it.
        problem: String,
    },
}

impl Settings {
    /// The defaults with some settings made, in order. `profile=apollo` starts from the original as shipped.
    ///
    /// # Errors
    /// [`SettingError`] for the first one that cannot be made.
    pub fn with(overrides: &[String]) -> Result<Self, SettingError> {
        let mut settings = Self::default();
        for text in overrides {
            let (key, value) = text
                .split_once('=')
                .ok_or_else(|| SettingError::Form(text.clone()))?;
            settings = settings.set(key.trim(), value.trim())?;
        }
        settings.check()?;
        Ok(settings)
    }

    fn set(self, key: &str, value: &str) -> Result<Self, SettingError> {
        let wrong = |problem: String| SettingError::Value {
            key: key.to_owned(),
            value: value.to_owned(),
            problem,
        };
        if key == "profile" {
            return match value {
                "apollo" => Ok(Self {
                    decider: Config::apollo(),
                    ..self
                }),
                "default" => Ok(Self {
                    decider: Config::default(),
                    ..self
                }),
                _ => Err(wrong("profiles are `default` and `apollo`".to_owned())),
            };
        }
        let mut tree = serde_json::to_value(&self).map_err(|error| wrong(error.to_string()))?;
        let place = find(&mut tree, key)?;
        *place = parse(place, value).map_err(wrong)?;
        serde_json::from_value(tree).map_err(|error| wrong(error.to_string()))
    }

    /// What no single setting can tell.
    fn check(&self) -> Result<(), SettingError> {
        let (shortest, longest) = STEPS;
        if !(shortest..=longest).contains(&self.physics.dt) {
            return Err(SettingError::Value {
                key: "physics.dt".to_owned(),
                value: self.physics.dt.to_string(),
                problem: format!("must be {shortest} to {longest} s"),
            });
        }
        if !self.rss.is_sound() {
            return Err(SettingError::Value {
                key: "rss".to_owned(),
                value: "…braking=0".to_owned(),
                problem: "nobody can be without brakes: each braking must be above 0".to_owned(),
            });
        }
        let ratio = self.tick / self.physics.dt;
        let whole = ratio.is_finite() && (1.0..=MOST_STEPS).contains(&ratio.round());
        if !whole || (ratio - ratio.round()).abs() > 1e-9 {
            return Err(SettingError::Value {
                key: "tick".to_owned(),
                value: self.tick.to_string(),
                problem: format!(
                    "must be 1 to {MOST_STEPS} whole physics steps of {} s",
                    self.physics.dt
                ),
            });
        }
        Ok(())
    }
}

/// The value as the kind of thing that `place` holds.
fn parse(place: &serde_json::Value, value: &str) -> Result<serde_json::Value, String> {
    let given = serde_json::from_str(value).unwrap_or_else(|_| serde_json::Value::from(value));
    match place {
        serde_json::Value::Object(_) => Err("is a group of settings, not one".to_owned()),
        serde_json::Value::Number(_) => match given.as_f64() {
            Some(number) if (0.0..=LARGEST).contains(&number) => Ok(given),
            _ => Err(format!("must be a number from 0 to {LARGEST}")),
        },
        _ => Ok(given),
    }
}

/// The value at a dotted key.
fn find<'a>(tree: &'a mut serde_json::Value, key: &str) -> Result<&'a mut serde_json::Value, SettingError> {
    let mut place = tree;
    let mut walked = String::from("settings");
    for part in key.split('.') {
        let known: Vec<String> = place
            .as_object()
            .map(|map| map.keys().cloned().collect())
            .unwrap_or_default();
        match place.get_mut(part) {
            Some(next) => place = next,
            None => {
                return Err(SettingError::Unknown {
                    key: key.to_owned(),
                    parent: walked,
                    known: if known.is_empty() {
                        "nothing below it".to_owned()
                    } else {
                        known.join(", ")
                    },
                });
            }
        }
        walked = if walked == "settings" {
            part.to_owned()
        } else {
            format!("{walked}.{part}")
        };
    }
    Ok(place)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(text: &str) -> Result<Settings, SettingError> {
        Settings::with(&[text.to_owned()])
    }

    #[test]
    fn a_setting_is_made_by_its_dotted_name() {
        let settings = set("decider.path_bounds.obstacle_lat_buffer=0.25").unwrap();
        assert!((settings.decider.path_bounds.obstacle_lat_buffer - 0.25).abs() < 1e-15);
        assert!(set("decider.path_bounds.quirks.pad_through_blocker=true").is_ok());
        assert!(
            set("profile=apollo")
                .unwrap()
                .decider
                .path_bounds
                .quirks
                .greedy_sides
        );
        assert_eq!(
            set("fault=mirrored").unwrap().fault,
            Fault::named("mirrored").unwrap()
        );
        assert!((set("rss.response_time=0.5").unwrap().rss.response_time - 0.5).abs() < 1e-15);
    }

    #[test]
    fn what_cannot_be_set_says_what_can() {
        let message = |text| set(text).unwrap_err().to_string();
        assert!(message("decider.path_bounds.lat=1").contains("obstacle_lat_buffer"));
        assert!(message("nothing").contains("key=value"));
        assert!(message("tick=fast").contains("must be a number"));
        assert!(message("tick=0.015").contains("whole physics steps"));
        assert!(message("decider.path=3").contains("group"));
        assert!(message("rss.min_braking=0").contains("brakes"));
        assert!(message("rss.braking=4").contains("lateral_braking"));
        assert!(message("tick.x=3").contains("nothing below it"));
        let unknown = message("fault=mirored");
        assert!(
            unknown.contains("`mirored`") && unknown.contains("none, ") && unknown.contains(", mirrored, "),
            "{unknown}"
        );
    }
}
