//! A smooth lateral move: a cut-in or a lane change, once its trigger has gone off.

use super::Moment;
use super::along_line::LineFollower;
use corridor_decider::geometry::Quintic;
use corridor_scenarios::scenario::LateralMove;

/// Steepest angle to the line, as drift over speed: about 20°. A slower car takes longer instead of sliding
/// sideways, and one that stands does not move at all.
const STEEPEST: f64 = 0.36;

/// Where the ego's rear axle is, ahead of the driver's centre, while the two are side by side, m: the length of both
/// cars and a metre or two. Even who cuts in looks over the shoulder: running into a car beside is no test of it.
const BESIDE: (f64, f64) = (-8.0, 5.0);

/// Who will be beside within this time is seen in the mirror, s.
const SHOULDER_TIME: f64 = 1.5;

/// How far aside the ego is then at most, m.
const NEXT_LANE: f64 = 6.0;

/// A move that waits, is under way or is over.
#[derive(Clone, Debug)]
pub(super) struct Manoeuvre {
    plan: LateralMove,
    /// The offset over its own time, and that time, s; once it has begun.
    under_way: Option<(Quintic, f64)>,
}

impl Manoeuvre {
    pub(super) fn new(plan: LateralMove) -> Self {
        Self {
            plan,
            under_way: None,
        }
    }

    /// Offset at its end, begun or not.
    pub(super) fn end(&self) -> f64 {
        self.plan.to_l
    }

    /// Offset that it leads to, once it has begun.
    pub(super) fn target(&self) -> Option<f64> {
        self.under_way.map(|_| self.plan.to_l)
    }

    /// Whether it is done.
    pub(super) fn is_over(&self) -> bool {
        self.under_way
            .is_some_and(|(_, clock)| clock >= self.plan.duration)
    }

    /// Sets the drift of `follower` for the coming step.
    pub(super) fn steer(&mut self, follower: &mut LineFollower, moment: &Moment, dt: f64) {
        if self.under_way.is_none() {
            let pose = follower.motion().0;
            let ego = pose.to_local(moment.ego);
            let closing = (moment.ego_v - follower.speed).max(0.0);
            let is_beside =
                ego.x > BESIDE.0 - closing * SHOULDER_TIME && ego.x < BESIDE.1 && ego.y.abs() < NEXT_LANE;
            if is_beside || !moment.sets_off(self.plan.trigger, pose.position()) {
                return;
            }
            let length = self.plan.duration.max(dt);
            let curve = Quintic::between([follower.l, 0.0, 0.0], [self.plan.to_l, 0.0, 0.0], length);
            self.under_way = Some((curve, 0.0));
        }
        if let Some((curve, clock)) = &mut self.under_way {
            if *clock >= self.plan.duration {
                (follower.l, follower.drift) = (self.plan.to_l, 0.0);
                return;
            }
            let next = curve.evaluate(*clock + dt)[0];
            let drift = (next - follower.l) / dt;
            let possible = STEEPEST * follower.speed.abs();
            if drift.abs() <= possible {
                *clock += dt;
                follower.drift = drift;
            } else {
                let slowed = possible / drift.abs();
                *clock += dt * slowed;
                follower.drift = drift * slowed;
            }
        }
    }
}
