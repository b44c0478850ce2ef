//! A scenario file on its road: `(family, seed)` is one scenario.

mod recorded;

use crate::error::{DrawError, NoProblem, Place, ScenarioError};
use crate::expectation;
use crate::import::commonroad;
use crate::map_format;
use crate::map_source::{LoadedMap, MapCache};
use crate::resolve::Draft;
use crate::resolve::sampler::Sampler;
use crate::route::{self, Road};
use crate::scenario::Scenario;
use crate::schema::ScenarioFile;
use crate::schema::task::{Expect, RoutePlace, Task};
use crate::validity::{self, Rejection, Scene};
use corridor_decider::reference_line::LineQuery;
use corridor_decider::road::{LaneId, RoadMap};
use corridor_decider::routing::{BlackList, LaneGraph, Position, RoutingConfig, WayPoint};
use std::io;
use std::path::Path;
use std::sync::Arc;
use toml::Spanned;

/// How often one seed is tried. A family of which one draw in ten is possible fails one seed in 38,000.
const ATTEMPTS: u32 = 100;

/// Length of route beyond the ego's first lane, m, where a run is too short to ask for more.
const LEAST_ROUTE: f64 = 400.0;

/// Longest route, m: what an ego can drive in a minute at 180 km/h. Longer runs end with the route.
const LONGEST_ROUTE: f64 = 3000.0;

/// Length of route beyond what cruising reaches, m: what one plans ahead.
const PLANNED_AHEAD: f64 = 150.0;

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
            expect: content
                .expect
                .clone()
                .unwrap_or_else(|| expectation::usual(&content.command.task)),
            road: road(&content, &map.map, &place)?.with_objects(content.map_objects, &map.objects),
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
            match template.attempt(seed, &Sampler::new(seed, attempt)) {
                Ok(scenario) => return Ok(Drawn { scenario, rejected }),
                Err(reason) if self.fixed => {
                    return Err(DrawError::Impossible {
                        family: self.name.clone(),
                        reason,
                    });
                }
                Err(reason) => rejected.push(reason),
            }
        }
        Err(DrawError::Exhausted {
            family: self.name.clone(),
            seed,
            rejected,
        })
    }
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

/// Finds the route and the lines along and beside it.
fn road(
    file: &ScenarioFile,
    map: &Arc<RoadMap>,
    place: &dyn Fn(&Spanned<String>) -> Place,
) -> Result<Road, ScenarioError> {
    let longest_run = file.cruise_speed.upper_end() * file.timeout.upper_end() + PLANNED_AHEAD;
    let length = longest_run.clamp(LEAST_ROUTE, LONGEST_ROUTE);
    if let Some(destination) = &file.destination {
        return routed(file, destination, map, place, length);
    }
    let route = if file.route.is_empty() {
        let start = match &file.ego.lane {
            Some(name) => find(map, name, place)?,
            None => route::first_lane(map).ok_or_else(|| ScenarioError::Route {
                place: Box::new(place(&file.map)),
                problem: "the map has no drivable lane outside junctions: name one as `lane` in `[ego]`"
                    .to_owned(),
            })?,
        };
        route::straight_on(map, start, length)
    } else {
        named_route(file, map, place)?
    };
    let side = match file.command.task {
        Task::ChangeLane(side) => Some(side),
        _ => None,
    };
    Road::new(Arc::clone(map), route, side, length).map_err(|error| ScenarioError::Route {
        place: Box::new(place(
            file.route.first().or(file.ego.lane.as_ref()).unwrap_or(&file.map),
        )),
        problem: error.to_string(),
    })
}

/// The road that the router finds from the ego's lane to the destination.
fn routed(
    file: &ScenarioFile,
    destination: &RoutePlace,
    map: &Arc<RoadMap>,
    place: &dyn Fn(&Spanned<String>) -> Place,
    reach: f64,
) -> Result<Road, ScenarioError> {
    let error = |at: &Spanned<String>, problem: String| ScenarioError::Route {
        place: Box::new(place(at)),
        problem,
    };
    let Some(start) = &file.ego.lane else {
        let problem = "a route needs to know where it begins: name the `lane` in `[ego]`";
        return Err(error(&destination.lane, problem.to_owned()));
    };
    let mut way_points = vec![WayPoint::OnLane(Position {
        lane: find(map, start, place)?,
        s: 0.0,
    })];
    for at in file.via.iter().chain([destination]) {
        let lane = find(map, &at.lane, place)?;
        let s = at.s.unwrap_or(map.lane(lane).length());
        way_points.push(WayPoint::OnLane(Position { lane, s }));
    }
    let graph = LaneGraph::new(map, RoutingConfig::default());
    let response = graph
        .route(map, &way_points, &BlackList::default())
        .map_err(|problem| error(&destination.lane, problem.to_string()))?;
    Road::routed(Arc::clone(map), response, reach).map_err(|problem| error(&destination.lane, problem))
}

/// The lanes that the file names, checked to follow each other.
fn named_route(
    file: &ScenarioFile,
    map: &RoadMap,
    place: &dyn Fn(&Spanned<String>) -> Place,
) -> Result<Vec<LaneId>, ScenarioError> {
    let mut route: Vec<LaneId> = Vec::new();
    for name in &file.route {
        let lane = find(map, name, place)?;
        if let Some(last) = route
            .last()
            .map(|id| map.lane(*id))
            .filter(|last| !last.successors.contains(&lane))
        {
            let next: Vec<&str> = last
                .successors
                .iter()
                .map(|id| map.lane(*id).name.as_str())
                .collect();
            return Err(ScenarioError::Route {
                place: Box::new(place(name)),
                problem: format!(
                    "lane `{}` does not follow `{}`: expected {}",
                    name.get_ref(),
                    last.name,
                    list(&next)
                ),
            });
        }
        route.push(lane);
    }
    match &file.ego.lane {
        Some(lane) if file.route.first().map(Spanned::get_ref) != Some(lane.get_ref()) => {
            Err(ScenarioError::Route {
                place: Box::new(place(lane)),
                problem: format!("the route does not start in the ego's lane `{}`", lane.get_ref()),
            })
        }
        _ => Ok(route),
    }
}

fn find(
    map: &RoadMap,
    name: &Spanned<String>,
    place: &dyn Fn(&Spanned<String>) -> Place,
) -> Result<LaneId, ScenarioError> {
    let error = |problem| ScenarioError::Route {
        place: Box::new(place(name)),
        problem,
    };
    let found = map.find(name.get_ref()).ok_or_else(|| {
        let lanes = map.lanes().iter().filter(|lane| lane.kind.is_drivable());
        let names: Vec<&str> = lanes.map(|lane| lane.name.as_str()).collect();
        error(format!(
            "the map has no lane `{}`: expected {}",
            name.get_ref(),
            list(&names)
        ))
    })?;
    if !map.lane(found).kind.is_drivable() {
        return Err(error(format!("lane `{}` is not for driving", name.get_ref())));
    }
    Ok(found)
}

/// Names for a message: the first dozen.
fn list(names: &[&str]) -> String {
    const SHOWN: usize = 12;
    if names.is_empty() {
        return "nothing, the map ends there".to_owned();
    }
    let shown: Vec<String> = names.iter().take(SHOWN).map(|name| format!("`{name}`")).collect();
    let more = names.len().saturating_sub(SHOWN);
    let tail = if more > 0 {
        format!(" and {more} more")
    } else {
        String::new()
    };
    format!("{}{tail}", shown.join(", "))
}
