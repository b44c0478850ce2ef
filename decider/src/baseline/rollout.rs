//! A drive, simulated forward: to an offset beside the line, at a share of the desired speed, behind what is in the path.

use super::Scene;
use super::idm::{IdmLaw, Leader};
use super::traffic::Traffic;
use crate::decision::TrajectoryPoint;
use crate::frame::ObstacleId;
use crate::geometry::Polynomial;
use crate::geometry::frenet::FrenetMotion;
use crate::lattice::Curve;

/// Time between two states, s.
pub const STEP: f64 = 0.1;

/// Number of steps: eight seconds.
pub const STEPS: usize = 80;

/// The offset is reached in this time, s, and on a way between these, m.
const APPROACH: f64 = 3.0;
const APPROACH_WAY: (f64, f64) = (12.0, 60.0);

/// How a drive is meant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proposal {
    /// Where it ends beside the line, m, left positive.
    pub offset: f64,
    /// Share of the desired speed.
    pub share: f64,
}

/// Where the car is along the line at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Station, m.
    pub s: f64,
    /// Speed along the line, m/s.
    pub v: f64,
    /// Acceleration until the next state, m/s².
    pub a: f64,
}

/// A simulated drive.
#[derive(Clone, Debug, PartialEq)]
pub struct Rollout {
    /// How it is meant.
    pub proposal: Proposal,
    /// Its way across the line.
    pub lateral: Curve,
    /// The states, [`STEP`] apart.
    pub states: Vec<State>,
    /// What is followed at its end.
    pub follows: Option<ObstacleId>,
    /// The same in the plane, as far as the line leads.
    pub points: Vec<TrajectoryPoint>,
}

impl Rollout {
    /// Simulates a proposal.
    pub fn new(scene: &Scene, traffic: &Traffic, proposal: Proposal) -> Self {
        let (law, lateral) = (IdmLaw::default(), approach(scene, proposal.offset));
        let [start, ..] = scene.initial.s;
        let offset_at = |s: f64| lateral.at(s - start)[0];
        let mut follows = None;
        let states = simulated(scene, |step, s, v| {
            let leader = traffic.leader(scene, step, s, offset_at);
            let desired = (scene.speed_limit)(s).min(scene.target.cruise_speed) * proposal.share;
            let behind = law.acceleration(v, desired, leader.map(|(_, leader)| leader));
            let before = law.acceleration(v, desired, stop_point(scene, &law, s));
            follows = leader.map(|(id, _)| id).filter(|_| behind <= before);
            behind.min(before)
        });
        Self {
            proposal,
            points: in_the_plane(scene, &lateral, &states),
            lateral,
            states,
            follows,
        }
    }

    /// The same way with the brakes full on.
    #[must_use]
    pub fn braking_hardest(&self, scene: &Scene) -> Self {
        let states = simulated(scene, |_, _, _| scene.vehicle.max_deceleration);
        Self {
            points: in_the_plane(scene, &self.lateral, &states),
            states,
            ..self.clone()
        }
    }
}

/// The point where the car has to stop, as something that stands the least gap beyond it.
fn stop_point(scene: &Scene, law: &IdmLaw, s: f64) -> Option<Leader> {
    scene.target.stop_s.map(|stop_s| Leader {
        gap: stop_s - s + law.least_gap,
        speed: 0.0,
    })
}

/// The curve from where the car is to an offset.
fn approach(scene: &Scene, offset: f64) -> Curve {
    let [_, v, _] = scene.initial.s;
    let way = (v * APPROACH).clamp(APPROACH_WAY.0, APPROACH_WAY.1);
    Polynomial::quintic(scene.initial.l, [offset, 0.0, 0.0], way)
        .expect("the way has a length")
        .into()
}

/// States under an acceleration that is told for a step, a station and a speed.
fn simulated(scene: &Scene, mut acceleration: impl FnMut(usize, f64, f64) -> f64) -> Vec<State> {
    let [mut s, v, _] = scene.initial.s;
    let mut v = v.max(0.0);
    let mut states = Vec::with_capacity(STEPS + 1);
    for step in 0..=STEPS {
        let wished = acceleration(step, s, v);
        let wished = wished.clamp(scene.vehicle.max_deceleration, scene.vehicle.max_acceleration);
        let next = (v + wished * STEP).max(0.0);
        let a = (next - v) / STEP;
        states.push(State { s, v, a });
        s += f64::midpoint(v, next) * STEP;
        v = next;
    }
    states
}

/// States as points in the plane, up to the end of the line or where the offset leads beyond the centre of a bend.
fn in_the_plane(scene: &Scene, lateral: &Curve, states: &[State]) -> Vec<TrajectoryPoint> {
    let [start, ..] = scene.initial.s;
    let mut points: Vec<TrajectoryPoint> = Vec::with_capacity(states.len());
    for (k, state) in states.iter().enumerate() {
        let [l, dl, ddl, _] = lateral.at(state.s - start);
        let motion = FrenetMotion {
            s: [state.s, state.v, state.a],
            l: [l, dl, ddl],
        };
        let Some(at) = scene.line.at(state.s).to_plane(&motion) else {
            break;
        };
        let moved =
            |last: &TrajectoryPoint| last.distance + (at.pose.position() - last.pose.position()).norm();
        points.push(TrajectoryPoint {
            t: k as f64 * STEP,
            distance: points.last().map_or(0.0, moved),
            pose: at.pose,
            kappa: at.kappa,
            v: at.v,
            a: at.a,
        });
    }
    points
}
