//! Out of the lane and back: whether a path through a neighbouring lane leads on, and whether traffic leaves
//! time for it.

use crate::decision::PathPoint;
use crate::frame::ObstacleId;
use crate::reference_line::LineQuery;
use crate::tasks::path::Path;
use crate::tasks::scene::{Scene, TimedBox};

/// Time that must be left between the ego's way back and an oncoming car, s.
const ONCOMING_MARGIN: f64 = 2.0;

/// A car that closes in on the ego's place in a borrowed lane within this time has it, s.
const OVERTAKING_MARGIN: f64 = 4.0;

/// Acceleration and speed with which the ego is expected to pass, m/s² and m/s.
const PASSING: (f64, f64) = (1.2, 7.0);

/// Once the body is this far over the own lane's line, turning back is no safer than going on, m.
pub(super) const COMMITTED: f64 = 0.5;

/// The stretch of a path on which the body is outside the own lane.
struct Outing {
    start_s: f64,
    end_s: f64,
    length: f64,
    l_min: f64,
    l_max: f64,
}

impl Outing {
    fn of(scene: &Scene, path: &Path) -> Option<Self> {
        let half_width = scene.vehicle.half_width();
        let first = first_outside(scene, path)?;
        let last = path.points.iter().rposition(|p| is_outside(scene, p))?;
        let out = &path.points[first..=last];
        Some(Self {
            start_s: out[0].s,
            end_s: out[out.len() - 1].s,
            length: out[out.len() - 1].distance,
            l_min: out.iter().map(|p| p.l).fold(f64::MAX, f64::min) - half_width,
            l_max: out.iter().map(|p| p.l).fold(-f64::MAX, f64::max) + half_width,
        })
    }

    /// Time until the ego is back in its lane.
    fn duration(&self, v: f64) -> f64 {
        let (a, v_end) = (PASSING.0, PASSING.1.max(v));
        let speeding_up = (v_end - v) / a;
        let run_up = f64::midpoint(v, v_end) * speeding_up;
        if self.length <= run_up {
            return ((v * v + 2.0 * a * self.length).sqrt() - v) / a;
        }
        speeding_up + (self.length - run_up) / v_end
    }
}

/// Place of the first point of a path at which the body is outside the own lane.
fn first_outside(scene: &Scene, path: &Path) -> Option<usize> {
    path.points.iter().position(|point| is_outside(scene, point))
}

fn is_outside(scene: &Scene, point: &PathPoint) -> bool {
    let half_width = scene.vehicle.half_width();
    let (left, right) = scene.line.lane_width(point.s).unwrap_or((0.0, 0.0));
    point.l + half_width > left || point.l - half_width < -right
}

/// The obstacle whose traffic leaves no time to go out of the own lane and back.
pub(super) fn occupant(scene: &Scene, path: &Path) -> Option<ObstacleId> {
    let outing = Outing::of(scene, path)?;
    if overhang(scene) > COMMITTED {
        return None;
    }
    let duration = outing.duration(scene.start.v);
    let conflicts = |there: &TimedBox| conflicts(scene, &outing, duration, there);
    scene
        .moving
        .iter()
        .find(|moving| conflicts(&moving.boxes[0]))
        .map(|moving| moving.id)
}

/// How far the body is over a line of its own lane, m; negative inside.
pub(super) fn overhang(scene: &Scene) -> f64 {
    let half_width = scene.vehicle.half_width();
    let (left, right) = scene.line.lane_width(scene.ego.s).unwrap_or((f64::MAX, f64::MAX));
    (scene.ego.l + half_width - left).max(-(scene.ego.l - half_width) - right)
}

/// Whether a path is not blocked, or ends in the own lane: nobody goes out to stand on the wrong side.
pub(super) fn leads_back(scene: &Scene, path: &Path) -> bool {
    let is_inside = |end: &PathPoint| !is_outside(scene, end);
    path.blocked_by.is_none() || path.points.last().is_some_and(is_inside)
}

/// Whether an obstacle at constant speed meets the ego while that is out of its lane.
fn conflicts(scene: &Scene, outing: &Outing, duration: f64, there: &TimedBox) -> bool {
    let beside = there.at.l - there.half_width > outing.l_max || there.at.l + there.half_width < outing.l_min;
    let own_lane = scene.line.lane_width(scene.ego.s).unwrap_or((0.0, 0.0));
    let in_own_lane = there.at.l < own_lane.0 && there.at.l > -own_lane.1 && there.s_dot >= 0.0;
    if beside || in_own_lane {
        return false;
    }
    let (rear, front) = (there.at.s - there.half_length, there.at.s + there.half_length);
    let ego_rear = scene.ego.s - scene.vehicle.back_edge_to_center;
    let exit_s = outing.end_s + scene.vehicle.front_edge_to_center;
    if there.s_dot < 0.0 {
        let passed = front < ego_rear;
        return !passed && rear + there.s_dot * (duration + ONCOMING_MARGIN) < exit_s;
    }
    if front >= ego_rear {
        // Beside us or ahead in the stretch, and not leaving it before we come.
        return rear < exit_s
            && rear + there.s_dot * duration < exit_s
            && front > outing.start_s.min(ego_rear);
    }
    front + (there.s_dot - scene.start.v) * OVERTAKING_MARGIN > ego_rear
}
