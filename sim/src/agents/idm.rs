//! Car following by the Intelligent Driver Model (Treiber, Hennecke, Helbing, "Congested traffic states in
//! empirical observations and microscopic simulations", 2000).

use super::Moment;
use super::along_line::LineFollower;
use super::lateral_move::Manoeuvre;
use super::leader::{Body, Leader, leader_of};
use super::mobil::LaneChooser;
use corridor_scenarios::scenario::{AlongLine, IdmParams, LateralMove};

/// Hardest braking of any driver, m/s²: dry road.
const HARDEST_BRAKING: f64 = 8.0;

/// Smallest gap that enters the model, m: at contact its law has a pole.
const SMALLEST_GAP: f64 = 0.1;

/// A driver on a line behind whatever is ahead.
#[derive(Clone, Debug)]
pub(super) struct IdmDriver {
    pub(super) follower: LineFollower,
    params: IdmParams,
    manoeuvre: Option<Manoeuvre>,
    /// How it chooses among lanes, if it does.
    chooser: Option<LaneChooser>,
    /// Acceleration until the next look ahead, m/s².
    acceleration: f64,
}

impl IdmDriver {
    pub(super) fn new(
        start: &AlongLine,
        params: IdmParams,
        lane_change: Option<LateralMove>,
        chooser: Option<LaneChooser>,
    ) -> Self {
        Self {
            follower: LineFollower::new(start),
            params,
            manoeuvre: lane_change.map(Manoeuvre::new),
            chooser,
            acceleration: 0.0,
        }
    }

    /// Looks at all bodies, its own at `place` left out, and chooses an acceleration, and perhaps a lane.
    pub(super) fn look(&mut self, place: usize, bodies: &[Body], time: f64) {
        self.choose_lane(place, bodies, time);
        let target = self.manoeuvre.as_ref().and_then(Manoeuvre::target);
        let l = self.follower.l;
        let to = target.unwrap_or(l);
        let others = bodies
            .iter()
            .enumerate()
            .filter(|(k, _)| *k != place)
            .map(|(_, body)| body);
        let leader = leader_of(&self.follower, &bodies[place], (l.min(to), l.max(to)), others);
        self.acceleration = acceleration(&self.params, self.follower.speed, leader);
    }

    /// Where it is going, sideways: a lane that it has chosen, m from its line.
    pub(super) fn signal(&self) -> Option<f64> {
        self.chooser.as_ref()?;
        self.manoeuvre.as_ref().map(Manoeuvre::end)
    }

    fn choose_lane(&mut self, place: usize, bodies: &[Body], time: f64) {
        let Some(chooser) = &mut self.chooser else {
            return;
        };
        if self.manoeuvre.as_ref().is_some_and(Manoeuvre::is_over) {
            self.manoeuvre = None;
            chooser.rest(time);
        }
        // Who was held up at the first moment of a change looks again.
        if self.manoeuvre.as_ref().is_none_or(|m| m.target().is_none()) {
            let change = chooser.look(&self.follower, &self.params, (place, bodies), time);
            self.manoeuvre = change.map(Manoeuvre::new);
        }
    }

    /// Drives on at the speed of now until the next look ahead.
    pub(super) fn keep_speed(&mut self) {
        self.acceleration = 0.0;
    }

    pub(super) fn advance(&mut self, moment: &Moment, dt: f64) {
        if let Some(manoeuvre) = &mut self.manoeuvre {
            manoeuvre.steer(&mut self.follower, moment, dt);
        }
        let (v, a) = (self.follower.speed, self.acceleration);
        let next = v + a * dt;
        let distance = if next >= 0.0 {
            f64::midpoint(v, next) * dt
        } else {
            v * v / (-2.0 * a)
        };
        self.follower.speed = next.max(0.0);
        self.follower.advance_by(distance, dt);
    }
}

/// The model's law: `a·(1 − (v/v₀)⁴ − (s*/s)²)` with `s* = s₀ + max(0, vT + vΔv/(2√(ab)))`.
pub(super) fn acceleration(params: &IdmParams, v: f64, leader: Option<Leader>) -> f64 {
    let a = params.max_acceleration;
    let ratio = v / params.desired_speed;
    let free = 1.0 - ratio * ratio * ratio * ratio;
    let pressed = leader.map_or(0.0, |leader| {
        let brake = 2.0 * (a * params.comfortable_braking).sqrt();
        let dynamic = v * params.time_gap + v * (v - leader.speed) / brake;
        let wanted = params.min_gap + dynamic.max(0.0);
        let part = wanted / leader.gap.max(SMALLEST_GAP);
        part * part
    });
    let wished = a * (free - pressed);
    if wished.is_finite() {
        wished.max(-HARDEST_BRAKING)
    } else {
        -HARDEST_BRAKING
    }
}
