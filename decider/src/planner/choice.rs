//! Which bound is driven: the field's order, by what is drivable and not just by label.
//!
//! Pull-over, lane change, the own lane if nothing blocks it, a borrowed lane if that leads farther and traffic
//! leaves time for it, the own lane up to its blocker, and last the fallback.

use super::lane_follow::rejected;
use crate::context::{Context, LastTrajectory};
use crate::decision::{Assessment, PathPoint, Rejection, TrajectoryPoint};
use crate::frame::ObstacleId;
use crate::geometry::Pose;
use crate::reference_line::LineQuery;
use crate::tasks::path::{self, Goal, LineTable, Path};
use crate::tasks::path_bounds::{Borrow, Label, PathBound, PathBounds};
use crate::tasks::scene::{Scene, TimedBox};
use crate::tasks::start_point::StartPoint;

/// A borrowed lane must lead this much farther than the own one, m.
const WORTH_BORROWING: f64 = 5.0;

/// Time that must be left between the ego's way back and an oncoming car, s.
const ONCOMING_MARGIN: f64 = 2.0;

/// A car that closes in on the ego's place in a borrowed lane within this time has it, s.
const OVERTAKING_MARGIN: f64 = 4.0;

/// Acceleration and speed with which the ego is expected to pass, m/s² and m/s.
const PASSING: (f64, f64) = (1.2, 7.0);

/// Once the body is this far over the own lane's line, turning back is no safer than going on, m.
const COMMITTED: f64 = 0.5;

/// Overhang from which a car counts as out of its lane, m.
const OUT_OF_LANE: f64 = 0.2;

/// The choice of one tick.
#[derive(Debug)]
pub(super) struct Choice {
    /// Place of the bound that is driven, and its path.
    pub path: Option<(usize, Path)>,
    /// Per bound what became of it.
    pub assessments: Vec<Assessment>,
    /// Whether the own lane alone would not do, if that was looked at.
    pub own_lane_is_blocked: Option<bool>,
}

/// Looks at the bounds in order of preference until one is good.
pub(super) fn choose(scene: &Scene, table: &LineTable, bounds: &PathBounds, context: &Context) -> Choice {
    let mut choice = Choice {
        path: None,
        assessments: vec![Assessment::NotTried; bounds.bounds.len()],
        own_lane_is_blocked: None,
    };
    let mut blocked_own: Option<(usize, Path)> = None;
    let is_out = overhang(scene) > OUT_OF_LANE && !context.borrow.sides.is_empty();
    for place in in_order(&bounds.bounds, is_out) {
        let bound = &bounds.bounds[place];
        let path = match find_path(scene, table, bound, context) {
            Ok(path) => path,
            Err(rejection) => {
                if is_own_lane(bound.label) {
                    choice.own_lane_is_blocked = Some(true);
                }
                choice.assessments[place] = rejected(rejection);
                continue;
            }
        };
        choice.assessments[place] = Assessment::Drivable { reach: path.length() };
        if is_own_lane(bound.label) {
            choice.own_lane_is_blocked = Some(path.blocked_by.is_some());
        }
        if bound.label == Label::Fallback && blocked_own.is_some() {
            break;
        }
        match verdict(scene, context, bound, &path, blocked_own.as_ref()) {
            Verdict::Take => {
                choice.path = Some((place, path));
                break;
            }
            Verdict::Keep => {
                blocked_own = Some((place, path));
            }
            Verdict::Leave(assessment) => choice.assessments[place] = assessment,
        }
    }
    choice.path = choice.path.or(blocked_own);
    if let Some((place, _)) = &choice.path {
        choice.assessments[*place] = Assessment::Chosen;
    }
    choice
}

/// A path inside a bound: a new one, or the last one where the new one does not lead on.
fn find_path(
    scene: &Scene,
    table: &LineTable,
    bound: &PathBound,
    context: &Context,
) -> Result<Path, Rejection> {
    let goal = goal(scene, context, bound.label);
    let new = path::plan(scene, table, bound, goal);
    if new.as_ref().is_ok_and(|path| path.serves(goal)) {
        return new;
    }
    let last = context.path.as_ref().filter(|last| last.label == bound.label);
    let old = last.and_then(|last| path::reuse(scene, &last.points));
    match old
        .map(|path| path::finish(path, bound))
        .filter(|path| path.serves(goal))
    {
        Some(old) => Ok(old),
        None => new,
    }
}

/// What to do with a drivable path.
enum Verdict {
    /// Drive it.
    Take,
    /// Drive it if nothing better comes.
    Keep,
    /// Do not drive it.
    Leave(Assessment),
}

fn verdict(
    scene: &Scene,
    context: &Context,
    bound: &PathBound,
    path: &Path,
    blocked_own: Option<&(usize, Path)>,
) -> Verdict {
    match bound.label {
        Label::PullOver => match path.blocked_by {
            Some(id) if !path.serves(goal(scene, context, bound.label)) => {
                Verdict::Leave(Assessment::NoPath(Rejection::Touches(id)))
            }
            _ => Verdict::Take,
        },
        Label::Regular {
            borrow: Borrow::None, ..
        } if path.blocked_by.is_some() => Verdict::Keep,
        Label::Regular {
            borrow: Borrow::Left | Borrow::Right,
            ..
        } => {
            let own_reach = blocked_own.map_or(0.0, |(_, own)| own.length());
            let leads_on = path.length() >= own_reach + WORTH_BORROWING && leads_back(scene, path);
            if !leads_on && overhang(scene) <= COMMITTED {
                return Verdict::Leave(Assessment::Drivable { reach: path.length() });
            }
            match occupant(scene, path) {
                Some(id) => Verdict::Leave(Assessment::Occupied(id)),
                None => Verdict::Take,
            }
        }
        _ => Verdict::Take,
    }
}

/// Places of the bounds by preference. A car that is out of its lane comes back inside the borrowed bound,
/// which holds both lanes.
fn in_order(bounds: &[PathBound], is_out: bool) -> Vec<usize> {
    let rank = |label: Label| match label {
        Label::PullOver => 0,
        Label::LaneChange => 1,
        Label::Regular {
            borrow: Borrow::None, ..
        } if is_out => 4,
        Label::Regular {
            borrow: Borrow::None, ..
        } => 2,
        Label::Regular { .. } => 3,
        Label::Fallback => 5,
    };
    let mut places: Vec<usize> = (0..bounds.len()).collect();
    places.sort_by_key(|place| rank(bounds[*place].label));
    places
}

fn is_own_lane(label: Label) -> bool {
    matches!(
        label,
        Label::Regular {
            borrow: Borrow::None,
            ..
        }
    )
}

/// Along the line, or to the place at the road's edge.
fn goal(scene: &Scene, context: &Context, label: Label) -> Goal {
    let place = context
        .bounds
        .pull_over
        .place
        .filter(|_| label == Label::PullOver);
    place.map_or(Goal::default(), |place| {
        let at = scene.line.to_frenet(place.position);
        Goal {
            l: at.l,
            stop_s: Some(at.s),
        }
    })
}

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
        let is_out = |l: f64, s: f64| {
            let (left, right) = scene.line.lane_width(s).unwrap_or((0.0, 0.0));
            l + half_width > left || l - half_width < -right
        };
        let first = path.points.iter().position(|p| is_out(p.l, p.s))?;
        let last = path.points.iter().rposition(|p| is_out(p.l, p.s))?;
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

/// The obstacle whose traffic leaves no time to go out of the own lane and back.
fn occupant(scene: &Scene, path: &Path) -> Option<ObstacleId> {
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
fn overhang(scene: &Scene) -> f64 {
    let half_width = scene.vehicle.half_width();
    let (left, right) = scene.line.lane_width(scene.ego.s).unwrap_or((f64::MAX, f64::MAX));
    (scene.ego.l + half_width - left).max(-(scene.ego.l - half_width) - right)
}

/// Whether a path is not blocked, or ends in the own lane: nobody goes out to stand on the wrong side.
fn leads_back(scene: &Scene, path: &Path) -> bool {
    let half_width = scene.vehicle.half_width();
    let is_inside = |end: &PathPoint| {
        let (left, right) = scene.line.lane_width(end.s).unwrap_or((0.0, 0.0));
        end.l + half_width <= left && end.l - half_width >= -right
    };
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

/// Full braking along the last trajectory, or straight on with the wheel held where there is none.
pub(super) fn braking_trajectory(
    start: &StartPoint,
    last: Option<(&LastTrajectory, f64)>,
    deceleration: f64,
) -> Vec<TrajectoryPoint> {
    (0..=80_u32)
        .map(|k| {
            let t = f64::from(k) * 0.1;
            let stop_time = start.v / deceleration;
            let moving = t.min(stop_time);
            let distance = start.v * moving - deceleration * moving * moving / 2.0;
            let (pose, kappa) = last
                .and_then(|(last, now)| along(last, now + distance))
                .unwrap_or_else(|| (on_arc(start, distance), start.kappa));
            let (v, a) = if t < stop_time {
                (start.v - deceleration * t, -deceleration)
            } else {
                (0.0, 0.0)
            };
            TrajectoryPoint {
                t,
                distance,
                pose,
                kappa,
                v,
                a,
            }
        })
        .collect()
}

/// The last trajectory's pose at a distance, if it leads that far.
fn along(last: &LastTrajectory, distance: f64) -> Option<(Pose, f64)> {
    let above = last.points.partition_point(|p| p.distance <= distance);
    let (a, b) = (last.points.get(above.checked_sub(1)?)?, last.points.get(above)?);
    let share = (distance - a.distance) / (b.distance - a.distance);
    let turn = crate::geometry::angle::difference(b.pose.theta, a.pose.theta);
    let at = a.pose.position() + (b.pose.position() - a.pose.position()) * share;
    Some((
        Pose::new(
            at.x,
            at.y,
            crate::geometry::angle::wrap(a.pose.theta + turn * share),
        ),
        a.kappa,
    ))
}

/// The pose after an arc of the start point's curvature.
fn on_arc(start: &StartPoint, distance: f64) -> Pose {
    let half_turn = start.kappa * distance / 2.0;
    let chord = if half_turn.abs() < 1e-9 {
        distance
    } else {
        libm::sin(half_turn) / half_turn * distance
    };
    let middle = Pose {
        theta: start.pose.theta + half_turn,
        ..start.pose
    }
    .advanced(chord);
    Pose {
        theta: crate::geometry::angle::wrap(start.pose.theta + 2.0 * half_turn),
        ..middle
    }
}
