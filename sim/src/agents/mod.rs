//! The other road users: what each does, step by step.
//!
//! An agent's next state is a function of the states before and of nothing else. Poses are those of an
//! obstacle's own frame (its centre), in world axes.

mod along_line;
mod idm;
mod lateral_move;
mod leader;
mod mobil;
mod pedestrian;
mod recorded;
mod waypoints;

use crate::world::BodyPose;
use along_line::LineFollower;
use corridor_decider::frame::{EgoState, ObstacleId, PredictedPose};
use corridor_decider::geometry::{Pose, Vec2};
use corridor_decider::vehicle::VehicleParams;
use corridor_scenarios::Scenario;
use corridor_scenarios::scenario::{Behaviour, Obstacle, Trigger};
use idm::IdmDriver;
use leader::Body;
use mobil::LaneChooser;
use pedestrian::Walker;
use recorded::Recording;
use waypoints::Track;

/// How far predictions reach, s.
pub const PREDICTION_HORIZON: f64 = 8.0;
/// Time between two predicted poses, s.
pub const PREDICTION_STEP: f64 = 0.5;
/// Time between two looks at the traffic ahead, s: drivers do not react faster, and looking is what costs.
const REACTION_PERIOD: f64 = 0.1;

/// Where the ego is for those who go on without it, m: farther from all maps than anyone looks.
const NOWHERE: Vec2 = Vec2::new(4e8, 4e8);

/// All obstacles of a scenario as actors.
#[derive(Clone, Debug)]
pub struct Agents {
    actors: Vec<Actor>,
    /// Where everyone is and how large, by [`ObstacleId`]; the ego comes last.
    bodies: Vec<Body>,
    moving: Vec<BodyPose>,
    steps: u32,
}

#[derive(Clone, Debug)]
enum Actor {
    Parked(Pose),
    Along(LineFollower),
    Waypoints(Track),
    Idm(Box<IdmDriver>),
    Pedestrian(Walker),
    Recorded(Recording),
}

/// What an actor may react to in one step.
#[derive(Clone, Copy, Debug)]
struct Moment {
    /// Seconds since the run's start, at the end of the step.
    time: f64,
    /// The ego's reference point.
    ego: Vec2,
    /// The ego's speed, m/s.
    ego_v: f64,
}

impl Moment {
    /// Whether `trigger` has gone off for someone at `place`.
    fn sets_off(&self, trigger: Trigger, place: Vec2) -> bool {
        match trigger {
            Trigger::Time(time) => self.time >= time,
            Trigger::EgoWithin(distance) => (self.ego - place).norm_squared() <= distance * distance,
        }
    }
}

/// Where an obstacle is at the start of the run.
pub fn start_of(obstacle: &Obstacle) -> BodyPose {
    Actor::new(&obstacle.behaviour).body_pose(obstacle.id)
}

/// Whether an obstacle can ever move.
pub fn can_move(obstacle: &Obstacle) -> bool {
    match &obstacle.behaviour {
        Behaviour::Parked(_) => false,
        Behaviour::ConstantSpeed(along) => along.speed != 0.0,
        Behaviour::Waypoints(points)
        | Behaviour::Triggered {
            waypoints: points, ..
        } => points.windows(2).any(|pair| pair[0].pose != pair[1].pose),
        Behaviour::Pedestrian { from, to, speed, .. } => from != to && *speed > 0.0,
        Behaviour::Idm { .. } | Behaviour::Recorded { .. } => true,
    }
}

/// Whether an obstacle is predicted to do what it then does: it stands, or moves as recorded.
pub fn is_predicted_truly(obstacle: &Obstacle) -> bool {
    matches!(
        obstacle.behaviour,
        Behaviour::Parked(_) | Behaviour::Recorded { .. }
    )
}

impl Actor {
    fn new(behaviour: &Behaviour) -> Self {
        match behaviour {
            Behaviour::Parked(pose) => Self::Parked(*pose),
            Behaviour::ConstantSpeed(start) => Self::Along(LineFollower::new(start)),
            Behaviour::Waypoints(points) => Self::Waypoints(Track::new(points, None)),
            Behaviour::Triggered { trigger, waypoints } => {
                Self::Waypoints(Track::new(waypoints, Some(*trigger)))
            }
            Behaviour::Idm {
                start,
                params,
                lane_change,
                mobil,
            } => {
                let chooser = mobil.clone().map(LaneChooser::new);
                Self::Idm(Box::new(IdmDriver::new(start, *params, *lane_change, chooser)))
            }
            Behaviour::Pedestrian {
                from,
                to,
                speed,
                trigger,
            } => Self::Pedestrian(Walker::new(*from, *to, *speed, *trigger)),
            Behaviour::Recorded { states, after } => Self::Recorded(Recording::new(states, *after)),
        }
    }

    fn advance(&mut self, moment: &Moment, dt: f64) {
        match self {
            Self::Parked(_) => {}
            Self::Along(follower) => follower.advance(dt),
            Self::Waypoints(track) => track.advance(moment),
            Self::Idm(driver) => driver.advance(moment, dt),
            Self::Pedestrian(walker) => walker.advance(moment, dt),
            Self::Recorded(recording) => recording.advance(moment.time),
        }
    }

    fn body_pose(&self, id: ObstacleId) -> BodyPose {
        let (pose, velocity) = match self {
            Self::Parked(pose) => (*pose, Vec2::zeros()),
            Self::Along(follower) => follower.motion(),
            Self::Waypoints(track) => track.motion(),
            Self::Idm(driver) => driver.follower.motion(),
            Self::Pedestrian(walker) => walker.motion(),
            Self::Recorded(recording) => recording.motion(),
        };
        BodyPose { id, pose, velocity }
    }

    /// Who follows a line is expected to go on along it, at its speed and offset of now.
    fn line(&self) -> Option<&LineFollower> {
        match self {
            Self::Along(follower) => Some(follower),
            Self::Idm(driver) => Some(&driver.follower),
            Self::Parked(_) | Self::Waypoints(_) | Self::Pedestrian(_) | Self::Recorded(_) => None,
        }
    }
}

impl Agents {
    /// The scenario's obstacles at its start.
    pub fn new(scenario: &Scenario) -> Self {
        let body = |obstacle: &Obstacle| Body::new(&obstacle.shape, start_of(obstacle), can_move(obstacle));
        let mut bodies: Vec<Body> = scenario.obstacles.iter().map(body).collect();
        bodies.push(ego_body(&scenario.vehicle, scenario));
        Self {
            actors: scenario
                .obstacles
                .iter()
                .map(|obstacle| Actor::new(&obstacle.behaviour))
                .collect(),
            moving: scenario
                .obstacles
                .iter()
                .filter(|o| can_move(o))
                .map(start_of)
                .collect(),
            bodies,
            steps: 0,
        }
    }

    /// One step of everyone, seeing the ego where it was before the step. Returns the new poses of those that
    /// can move, in ascending order.
    pub fn advance(&mut self, ego: &EgoState, dt: f64) -> &[BodyPose] {
        if let Some(body) = self.bodies.last_mut() {
            body.place(ego.pose, ego.pose.forward() * ego.v);
        }
        if self.is_time_to_look(dt) {
            self.look_ahead(dt);
        }
        self.steps += 1;
        let moment = Moment {
            time: f64::from(self.steps) * dt,
            ego: ego.pose.position(),
            ego_v: ego.v,
        };
        self.move_all(&moment, dt, |_| {});
        &self.moving
    }

    /// Moves everyone who can move, after `prepare`.
    fn move_all(&mut self, moment: &Moment, dt: f64, prepare: impl Fn(&mut Actor)) {
        for moved in &mut self.moving {
            let place = moved.id.0 as usize;
            let actor = &mut self.actors[place];
            prepare(actor);
            actor.advance(moment, dt);
            *moved = actor.body_pose(moved.id);
            self.bodies[place].place(moved.pose, moved.velocity);
        }
    }

    /// Poses from now on, [`PREDICTION_STEP`] apart, that an observer expects: on along the line for who
    /// follows one, on along the record for who moves as recorded, straight on for all others. Empty for who
    /// cannot move.
    pub fn predict(&self, id: ObstacleId) -> Vec<PredictedPose> {
        let place = id.0 as usize;
        let Some(body) = self.bodies[..self.actors.len()]
            .get(place)
            .filter(|body| body.moves)
        else {
            return Vec::new();
        };
        let times = (0_u32..)
            .map(|k| f64::from(k) * PREDICTION_STEP)
            .take_while(|t| *t <= PREDICTION_HORIZON);
        if let Actor::Recorded(recording) = &self.actors[place] {
            return recording.predict(times);
        }
        if let Some(follower) = self.actors[place].line() {
            let mut ghost = follower.as_expected();
            return times
                .map(|t| {
                    if t > 0.0 {
                        ghost.advance(PREDICTION_STEP);
                    }
                    PredictedPose {
                        t,
                        pose: ghost.motion().0,
                    }
                })
                .collect();
        }
        let straight_on = |t| PredictedPose {
            t,
            pose: Pose {
                x: body.pose.x + body.velocity.x * t,
                y: body.pose.y + body.velocity.y * t,
                theta: body.pose.theta,
            },
        };
        times.map(straight_on).collect()
    }

    /// Those that can move, in ascending order.
    pub(crate) fn moving(&self) -> &[BodyPose] {
        &self.moving
    }

    /// One step of everyone without the ego: who waits for it goes on waiting, who drives behind others keeps his
    /// speed.
    pub(crate) fn go_on_alone(&mut self, dt: f64) {
        self.steps += 1;
        let moment = Moment {
            time: f64::from(self.steps) * dt,
            ego: NOWHERE,
            ego_v: 0.0,
        };
        self.move_all(&moment, dt, |actor| {
            if let Actor::Idm(driver) = actor {
                driver.keep_speed();
            }
        });
    }

    /// What everyone is going to do from now on if the ego goes straight on at its speed, by obstacle; as far and as
    /// finely as [`Agents::predict`]. The record of who moves as recorded is its prediction already.
    pub fn futures(&self, ego: &EgoState, dt: f64) -> Vec<Vec<PredictedPose>> {
        let ids = (0_u32..).map(ObstacleId).take(self.actors.len());
        let mut futures: Vec<Vec<PredictedPose>> = ids.map(|id| self.predict(id)).collect();
        let is_open = |moved: &&BodyPose| !matches!(self.actors[moved.id.0 as usize], Actor::Recorded(_));
        if !self.moving.iter().any(|moved| is_open(&moved)) {
            return futures;
        }
        let (mut ghost, mut ego) = (self.clone(), *ego);
        let mut t = 0.0;
        let longest = futures.iter().map(Vec::len).max().unwrap_or(0);
        for k in 1..longest {
            while t < k as f64 * PREDICTION_STEP - dt / 2.0 {
                ghost.advance(&ego, dt);
                ego.pose = ego.pose.advanced(ego.v * dt);
                t += dt;
            }
            for moved in ghost.moving.iter().filter(is_open) {
                if let Some(at) = futures[moved.id.0 as usize].get_mut(k) {
                    at.pose = moved.pose;
                }
            }
        }
        futures
    }

    /// Whether an obstacle can ever move.
    pub fn moves(&self, id: ObstacleId) -> bool {
        self.bodies.get(id.0 as usize).is_some_and(|body| body.moves)
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a small positive ratio"
    )]
    fn is_time_to_look(&self, dt: f64) -> bool {
        let period = (REACTION_PERIOD / dt).round().max(1.0) as u32;
        self.steps.is_multiple_of(period)
    }

    /// Lets every driver look at all bodies as they are before the step, so that their order plays no role.
    fn look_ahead(&mut self, dt: f64) {
        let time = f64::from(self.steps) * dt;
        for (place, actor) in self.actors.iter_mut().enumerate() {
            if let Actor::Idm(driver) = actor {
                driver.look(place, &self.bodies, time);
            }
        }
        // Whoever sets out for another lane tells so, and the others see it at their next look.
        for (actor, body) in self.actors.iter().zip(&mut self.bodies) {
            if let Actor::Idm(driver) = actor {
                body.signal = driver.signal();
            }
        }
    }
}

fn ego_body(vehicle: &VehicleParams, scenario: &Scenario) -> Body {
    let start = scenario.ego.pose;
    let at_start = BodyPose {
        id: ObstacleId(u32::MAX),
        pose: start,
        velocity: start.forward() * scenario.ego.speed,
    };
    Body::new(&vehicle.footprint(Pose::new(0.0, 0.0, 0.0)), at_start, true)
}

#[cfg(test)]
mod tests;
