//! A scenario file on its road: `(family, seed)` is one scenario.

mod fixed;
mod recorded;
mod way;

use crate::error::{DrawError, NoProblem, Place, ScenarioError};
use crate::expectation;
use crate::import::commonroad;
use crate::map_format;
use crate::map_source::{self, LoadedMap, MapCache};
use crate::parameter::{Parameter, Told};
use crate::resolve::Draft;
use crate::resolve::sampler::Sampler;
use crate::route::Road;
use crate::scenario::Scenario;
use crate::schema::ScenarioFile;
use crate::schema::task::Expect;
use crate::validity::{self, Rejection, Scene};
use corridor_decider::reference_line::LineQuery;
use corridor_decider::road::RoadMap;
use std::collections::BTreeMap;
use std::io;
use std::path::Path;
use std::sync::Arc;
use toml::Spanned;

/// How often one seed is tried. A family of which one draw in ten is possible fails one seed in 38,000.
const ATTEMPTS: u32 = 100;

/// A scenario file with its map read and its route found.
#[derive(Debug)]
pub struct Family {
    name: String,
    description: String,
    source: Arc<str>,
    map: LoadedMap,
    fixed: bool,
    origin: Origin,
}

/// Where the scenarios of a family come from.
#[derive(Debug)]
enum Origin {
    /// A file of this project: seeds draw its numbers.
    Drawn(Box<Template>),
    /// A recorded scene: one scenario for each task in it, by turns.
    Recorded {
        /// One for each problem, or for a file without any.
        scenarios: Vec<Scenario>,
        /// The numbers of the problems.
        problems: Vec<i64>,
    },
}

/// A scenario file on its road.
#[derive(Debug)]
struct Template {
    name: String,
    file: ScenarioFile,
    /// Where its map is, seen from anywhere.
    map: String,
    expect: Expect,
    road: Road,
}

/// A scenario with what was rejected before it.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The scenario.
    pub scenario: Scenario,
    /// Why earlier attempts at this seed were not run.
    pub rejected: Vec<Rejection>,
    /// The numbers of the scenario that came from laws, in the order of the file's tables.
    pub parameters: Vec<Parameter>,
}

impl Family {
    /// Reads a scenario file and its map.
    ///
    /// # Errors
    /// [`ScenarioError`] with the place of the first mistake.
    pub fn load(path: &Path) -> Result<Self, ScenarioError> {
        Self::load_with(path, &MapCache::new())
    }

    /// Reads a scenario file; its map from `maps`, where it stays.
    ///
    /// # Errors
    /// [`ScenarioError`] with the place of the first mistake.
    pub fn load_with(path: &Path, maps: &MapCache) -> Result<Self, ScenarioError> {
        let text = read_text(path).map_err(|source| ScenarioError::Read {
            path: path.to_owned(),
            source,
        })?;
        let base = path.parent().unwrap_or(Path::new(""));
        Self::parse_with(&text, &path.display().to_string(), base, maps)
    }

    /// Reads the text of a scenario file called `file`, which lies in `base`.
    ///
    /// # Errors
    /// [`ScenarioError`] with the place of the first mistake.
    pub fn parse(text: &str, file: &str, base: &Path) -> Result<Self, ScenarioError> {
        Self::parse_with(text, file, base, &MapCache::new())
    }

    /// Reads the text of a scenario file; its map from `maps`, where it stays.
    ///
    /// # Errors
    /// [`ScenarioError`] with the place of the first mistake.
    pub fn parse_with(text: &str, file: &str, base: &Path, maps: &MapCache) -> Result<Self, ScenarioError> {
        let stem = Path::new(file).file_stem().unwrap_or_default().to_string_lossy();
        if commonroad::is_commonroad(text) {
            return recorded::family(text, file, &stem);
        }
        let content = ScenarioFile::parse(text, file)?;
        let place = |of: &Spanned<String>| Place::of(text, file, of.span());
        let map = maps.get(content.map.get_ref(), base, &place(&content.map))?;
        let template = Template {
            name: content.name.clone().unwrap_or_else(|| stem.into_owned()),
            map: map_source::name_from_anywhere(content.map.get_ref(), base),
            expect: content
                .expect
                .clone()
                .unwrap_or_else(|| expectation::usual(&content.command.task)),
            road: way::road(&content, &map.map, &place)?.with_objects(content.map_objects, &map.objects),
            file: content,
        };
        let first = Sampler::new(0, 0);
        // What the first attempt comes to does not matter here, only whether it took a random number.
        let _ = template.attempt(0, &first);
        Ok(Self {
            name: template.name.clone(),
            description: template.file.description.clone(),
            source: text.into(),
            map,
            fixed: !first.was_random(),
            origin: Origin::Drawn(Box::new(template)),
        })
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// One sentence for people.
    pub fn description(&self) -> &str {
        &self.description
    }

    /// The text of its file.
    pub fn source(&self) -> &Arc<str> {
        &self.source
    }

    /// The text of its map's file.
    pub fn map_text(&self) -> &Arc<str> {
        &self.map.text
    }

    /// The road it is on.
    pub fn map(&self) -> &Arc<RoadMap> {
        &self.map.map
    }

    /// What the map's reader had to leave out or repair.
    pub fn map_warnings(&self) -> &[String] {
        &self.map.warnings
    }

    /// Whether it is a scene that others recorded.
    pub fn is_recorded(&self) -> bool {
        matches!(self.origin, Origin::Recorded { .. })
    }

    /// Whether every seed gives the same scenario.
    pub fn is_fixed(&self) -> bool {
        self.fixed
    }

    /// The seed with which a recorded scene is that of one of its planning problems, by its number in the file.
    ///
    /// # Errors
    /// [`NoProblem`] when it is no recorded scene, or has no such problem.
    pub fn seed_of_problem(&self, id: i64) -> Result<u64, NoProblem> {
        match &self.origin {
            Origin::Recorded { problems, .. } if !problems.is_empty() => recorded::seed_of(problems, id),
            Origin::Recorded { .. } => Err(NoProblem::None),
            Origin::Drawn(_) => Err(NoProblem::NotRecorded(self.name.clone())),
        }
    }

    /// The scenario of one seed: the first attempt that is possible.
    ///
    /// # Errors
    /// [`DrawError`] when none is.
    pub fn draw(&self, seed: u64) -> Result<Drawn, DrawError> {
        let template = match &self.origin {
            Origin::Drawn(template) => template,
            Origin::Recorded { scenarios, .. } => return Ok(recorded::draw(scenarios, seed)),
        };
        let mut rejected = Vec::new();
        for attempt in 0..ATTEMPTS {
            let sampler = Sampler::new(seed, attempt);
            match template.attempt(seed, &sampler) {
                Ok(scenario) => {
                    return Ok(Drawn {
                        scenario,
                        rejected,
                        parameters: sampler.into_drawn(),
                    });
                }
                Err(reason) if self.fixed => return Err(self.impossible(reason)),
                Err(reason) => rejected.push(reason),
            }
        }
        Err(DrawError::Exhausted {
            family: self.name.clone(),
            seed,
            rejected,
        })
    }

    /// The scenario of one seed, but with these numbers at these quantiles of their laws, by the keys of [`Parameter`].
    /// A key of a row member that this draw does not have is passed over.
    ///
    /// # Errors
    /// [`DrawError`] when the seed gives no scenario, when it is impossible with these numbers, or when there is no such
    /// number or quantile.
    pub fn draw_at(&self, seed: u64, quantiles: &BTreeMap<String, f64>) -> Result<Drawn, DrawError> {
        let wrong = quantiles
            .iter()
            .find(|(_, quantile)| !(0.0..=1.0).contains(*quantile));
        if let Some((key, quantile)) = wrong {
            return Err(DrawError::Told {
                family: self.name.clone(),
                key: key.clone(),
                problem: format!("{quantile} is no quantile: expected a number from 0 to 1"),
            });
        }
        self.draw_told(seed, Told::Quantiles(quantiles.clone()))
    }

    /// The scenario of one seed, but with these numbers, by the keys of [`Parameter`]; they need not be ones that the
    /// laws give. A key of a row member that this draw does not have is passed over.
    ///
    /// # Errors
    /// [`DrawError`] when the seed gives no scenario, when it is impossible with these numbers, or when one of them does
    /// not exist or does not fit its place.
    pub fn draw_fixed(&self, seed: u64, values: &BTreeMap<String, f64>) -> Result<Drawn, DrawError> {
        self.draw_told(seed, Told::Values(values.clone()))
    }

    fn draw_told(&self, seed: u64, told: Told) -> Result<Drawn, DrawError> {
        let usual = self.draw(seed)?;
        let mut sampler = Sampler::with(seed, attempt_of(&usual), told);
        let scenario = match &self.origin {
            Origin::Drawn(template) => template.attempt(seed, &sampler),
            Origin::Recorded { .. } => Ok(usual.scenario),
        };
        if let Some((key, problem)) = sampler.mistake() {
            return Err(DrawError::Told {
                family: self.name.clone(),
                key,
                problem,
            });
        }
        Ok(Drawn {
            scenario: scenario.map_err(|reason| self.impossible(reason))?,
            rejected: usual.rejected,
            parameters: sampler.into_drawn(),
        })
    }

    fn impossible(&self, reason: Rejection) -> DrawError {
        DrawError::Impossible {
            family: self.name.clone(),
            reason,
        }
    }
}

/// The attempt that gave a scenario: the one after all that were rejected.
fn attempt_of(drawn: &Drawn) -> u32 {
    u32::try_from(drawn.rejected.len()).expect("there are few attempts")
}

/// The text of a file. Scenes of other programs may be in other encodings than scenario files are.
fn read_text(path: &Path) -> io::Result<String> {
    let bytes = std::fs::read(path)?;
    String::from_utf8(bytes).or_else(|error| {
        let text = map_format::as_text(error.as_bytes());
        if commonroad::is_commonroad(&text) {
            return Ok(text);
        }
        Err(io::Error::new(
            io::ErrorKind::InvalidData,
            "the text is not UTF-8",
        ))
    })
}

impl Template {
    fn attempt(&self, seed: u64, sampler: &Sampler) -> Result<Scenario, Rejection> {
        let distance = match &self.expect {
            Expect::Progress(distance) | Expect::ProgressByGap(distance) => distance.as_ref(),
            _ => None,
        };
        let distance = distance.map(|d| sampler.table(format_args!("expect.")).number("distance", d));
        let draft = Draft::new(&self.file, &self.road, sampler)?;
        // A destination at the end of the map is not driven up to: the end of the road slows the ego down.
        let reachable = self.road.line.length() - expectation::BEYOND_GOAL;
        let to_destination = self.road.goal_s.map(|goal| goal.min(reachable) - draft.ego_s);
        let distance = distance.or(to_destination);
        let scene = Scene::new(&draft, &self.road);
        validity::check(&scene)?;
        let expect = expectation::expectation(&scene, &self.file.command.task, &self.expect, distance)?;
        Ok(Scenario {
            name: self.name.clone(),
            description: self.file.description.clone(),
            seed,
            map: Arc::clone(&self.road.map),
            route: self.road.route.clone(),
            provider: self
                .road
                .provider
                .clone()
                .map(|provider| provider.with_vehicle(draft.vehicle)),
            line: Arc::clone(&self.road.line),
            target_line: self.road.target_line.clone(),
            ego: draft.ego,
            command: draft.command,
            command_time: draft.command_time,
            cruise_speed: draft.cruise_speed,
            obstacles: draft.obstacles,
            vehicle: draft.vehicle,
            timeout: draft.timeout,
            expect,
        })
    }
}
