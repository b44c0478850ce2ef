//! Small scenes: a straight road, a car, a few bodies.

use crate::agents::Agents;
use crate::blame::car::{CarState, Limits};
use crate::blame::tracks::Surroundings;
use crate::testing;
use corridor_decider::geometry::Pose;
use corridor_scenarios::Scenario;
use corridor_scenarios::scenario::{Behaviour, Waypoint};

/// Time between two samples, s.
pub(super) const DT: f64 = 0.02;

/// Numbers that look random and are the same everywhere.
pub(super) struct Stir(pub(super) u64);

impl Stir {
    pub(super) fn next(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }
}

/// Someone who moves from one pose to another within three seconds.
pub(super) fn mover(from: Pose, to: Pose) -> Behaviour {
    let at = |t, pose| Waypoint { t, pose };
    Behaviour::Waypoints(vec![at(0.0, from), at(3.0, to)])
}

/// The scenario with everybody's tracks for some seconds.
pub(super) fn surroundings(scenario: &Scenario, seconds: f64) -> Surroundings {
    let mut surroundings = Surroundings::new(scenario, DT);
    let mut agents = Agents::new(scenario);
    let mut t = 0.0;
    while t < seconds {
        agents.go_on_alone(DT);
        for body in agents.moving() {
            surroundings.tracks[body.id.0 as usize].push(body.pose);
        }
        t += DT;
    }
    surroundings
}

/// The ego at the scenario's start.
pub(super) fn start(scenario: &Scenario) -> (CarState, Limits) {
    let limits = Limits::of(&scenario.vehicle, scenario.ego.speed, scenario.cruise_speed);
    let car = CarState {
        place: scenario.ego.pose.position(),
        forward: scenario.ego.pose.forward(),
        v: scenario.ego.speed,
        kappa: 0.0,
    };
    (car, limits)
}

/// A scene around a car at 30 m on a straight lane: up to four bodies that stand or move at random, near enough to
/// matter within two seconds.
pub(super) fn random(stir: &mut Stir) -> Scenario {
    let speed = stir.next(2.0, 14.0);
    let count = stir.next(1.0, 5.0);
    let mut behaviours = Vec::new();
    while (behaviours.len() as f64) < count.floor() {
        let from = Pose::new(
            30.0 + stir.next(-14.0, 26.0),
            stir.next(-2.5, 2.5),
            stir.next(-0.3, 0.3),
        );
        let to = Pose::new(from.x + stir.next(-25.0, 35.0), stir.next(-2.5, 2.5), from.theta);
        behaviours.push(if stir.next(0.0, 1.0) < 0.5 {
            Behaviour::Parked(from)
        } else {
            mover(from, to)
        });
    }
    testing::scenario(Pose::new(30.0, 0.0, 0.0), speed, behaviours)
}
