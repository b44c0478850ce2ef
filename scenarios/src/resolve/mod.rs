//! From a file and a seed to one concrete scenario: draws the numbers, puts everything on the road.

mod door;
mod map_objects;
mod obstacles;
pub(crate) mod placement;
pub(crate) mod sampler;

use crate::route::Road;
use crate::scenario::{EgoStart, Obstacle};
use crate::schema::ScenarioFile;
use crate::schema::task::Task;
use crate::validity::Rejection;
use corridor_decider::frame::Command;
use corridor_decider::reference_line::{LineQuery, SlPoint};
use corridor_decider::vehicle::VehicleParams;
use placement::Spot;
use sampler::Sampler;

/// Station of the ego's rear axle along its lane where the file names none, m: room for its tail and for
/// someone behind.
const EGO_STATION: f64 = 20.0;

/// Everything of a scenario that is drawn; what all seeds share is in [`Road`].
#[derive(Debug)]
pub(crate) struct Draft<'a> {
    pub(crate) sampler: &'a Sampler,
    /// Station of the ego's rear axle on the route's line, m.
    pub(crate) ego_s: f64,
    /// Its lateral offset, m.
    pub(crate) ego_l: f64,
    pub(crate) ego: EgoStart,
    pub(crate) vehicle: VehicleParams,
    pub(crate) cruise_speed: f64,
    pub(crate) timeout: f64,
    pub(crate) command: Command,
    pub(crate) command_time: f64,
    /// Station of the place to pull over, m.
    pub(crate) destination: Option<f64>,
    pub(crate) obstacles: Vec<Obstacle>,
    /// Where each obstacle starts.
    pub(crate) spots: Vec<Spot>,
    /// Place in the list of the first obstacle that comes from the map; those are the last ones.
    pub(crate) first_of_map: usize,
}

impl<'a> Draft<'a> {
    /// One attempt: all numbers from `sampler`.
    ///
    /// # Errors
    /// [`Rejection`] where something has no place on the road.
    pub(crate) fn new(file: &ScenarioFile, road: &Road, sampler: &'a Sampler) -> Result<Self, Rejection> {
        let top = sampler.table(format_args!(""));
        let cruise_speed = top.number("cruise_speed", &file.cruise_speed);
        let numbers = sampler.table(format_args!("ego."));
        let start = Spot {
            s: numbers.number_or("s", file.ego.s.as_ref(), EGO_STATION),
            l: numbers.number_or("l", file.ego.l.as_ref(), 0.0),
            heading: numbers.number_or("heading", file.ego.heading.as_ref(), 0.0),
        };
        if start.s > road.line.length() {
            return Err(Rejection::OffMap {
                obstacle: "ego".to_owned(),
                s: start.s,
            });
        }
        let (command, destination) = command(file, road, sampler, start.s)?;
        let mut draft = Self {
            sampler,
            ego_s: start.s,
            ego_l: start.l,
            ego: EgoStart {
                pose: start.pose(road),
                speed: numbers.number_or("speed", file.ego.speed.as_ref(), cruise_speed),
            },
            vehicle: vehicle(file, sampler),
            cruise_speed,
            timeout: top.number("timeout", &file.timeout),
            command,
            command_time: sampler.table(format_args!("command.")).number_or(
                "at",
                file.command.at.as_ref(),
                0.0,
            ),
            destination,
            obstacles: Vec::new(),
            spots: Vec::new(),
            first_of_map: 0,
        };
        obstacles::place_all(&mut draft, road, file)?;
        draft.first_of_map = draft.obstacles.len();
        map_objects::place_all(&mut draft, road);
        Ok(draft)
    }
}

/// The command, and the station of its destination.
fn command(
    file: &ScenarioFile,
    road: &Road,
    sampler: &Sampler,
    ego_s: f64,
) -> Result<(Command, Option<f64>), Rejection> {
    Ok(match &file.command.task {
        Task::Cruise => (Command::Cruise, None),
        Task::ChangeLane(side) => (Command::ChangeLane(*side), None),
        Task::EmergencyPullOver => (Command::EmergencyPullOver, None),
        Task::PullOver(ahead) => {
            let s = ego_s + sampler.table(format_args!("command.")).number("ahead", ahead);
            if s > road.line.length() {
                return Err(Rejection::OffMap {
                    obstacle: "destination".to_owned(),
                    s,
                });
            }
            let place = road.line.to_cartesian(SlPoint { s, l: 0.0 });
            (Command::PullOver(place), Some(s))
        }
    })
}

/// The ego's body: the reference sedan, where the file does not say otherwise.
fn vehicle(file: &ScenarioFile, sampler: &Sampler) -> VehicleParams {
    let (numbers, asked, usual) = (
        sampler.table(format_args!("vehicle.")),
        &file.vehicle,
        VehicleParams::default(),
    );
    let size = |key, value: &Option<_>, default| numbers.number_or(key, value.as_ref(), default);
    let front = size(
        "front_edge_to_center",
        &asked.front_edge_to_center,
        usual.front_edge_to_center,
    );
    let back = size(
        "back_edge_to_center",
        &asked.back_edge_to_center,
        usual.back_edge_to_center,
    );
    let is_usual = asked.front_edge_to_center.is_none() && asked.back_edge_to_center.is_none();
    VehicleParams {
        length: if is_usual { usual.length } else { front + back },
        width: size("width", &asked.width, usual.width),
        front_edge_to_center: front,
        back_edge_to_center: back,
        wheel_base: size("wheel_base", &asked.wheel_base, usual.wheel_base),
        min_turn_radius: size("min_turn_radius", &asked.min_turn_radius, usual.min_turn_radius),
        max_acceleration: numbers.number_or(
            "max_acceleration",
            asked.max_acceleration.as_ref(),
            usual.max_acceleration,
        ),
        max_deceleration: numbers.number_or(
            "max_deceleration",
            asked.max_deceleration.as_ref(),
            usual.max_deceleration,
        ),
        ..usual
    }
}
