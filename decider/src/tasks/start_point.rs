//! The planning start point: where the last trajectory says the ego should be now.
//!
//! Planning from the last trajectory rather than from the measured pose keeps the tracker's errors out of the
//! plan; when the ego has strayed too far, planning starts afresh from where it is (the original's
//! `TrajectoryStitcher`).

use crate::context::LastTrajectory;
use crate::decision::TrajectoryPoint;
use crate::frame::Frame;
use crate::geometry::frenet::{Foot, slopes};
use crate::geometry::{Pose, Vec2, angle};
use crate::reference_line::LineQuery;

/// Larger errors across the trajectory start a new one, m. The original: 0.5, at any speed.
const LATERAL_TOLERANCE: f64 = 0.5;

/// The same for a car that manoeuvres: with less room than that to what stands beside it, planning from where it is
/// not would plan through it.
const MANOEUVRING_TOLERANCE: f64 = 0.1;

/// Below this speed a car manoeuvres, m/s.
const MANOEUVRING: f64 = 3.0;

/// Larger errors along the trajectory start a new one, m. The original: 2.5, at which a car that has
/// overshot its stop line would be planned for as if it had not.
const LONGITUDINAL_TOLERANCE: f64 = 1.0;

/// Below this speed curvature cannot be told from yaw rate, m/s.
const STANDSTILL: f64 = 0.1;

/// Motion of the ego at the start of the plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartPoint {
    /// Rear axle.
    pub pose: Pose,
    /// Curvature of its motion, 1/m.
    pub kappa: f64,
    /// Speed, m/s, never negative.
    pub v: f64,
    /// Acceleration, m/s².
    pub a: f64,
}

/// Lateral motion as a function of station: `l`, `dl/ds`, `d²l/ds²`, with the station itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LateralState {
    /// Station, m.
    pub s: f64,
    /// Offset, first and second derivative by `s`.
    pub l: [f64; 3],
}

/// The start point of this frame's plan.
pub fn start_point(frame: &Frame, last: Option<&LastTrajectory>) -> StartPoint {
    last.and_then(|last| stitched(frame, last))
        .unwrap_or_else(|| StartPoint::measured(frame))
}

/// The last trajectory's point for now, if the ego is near it.
fn stitched(frame: &Frame, last: &LastTrajectory) -> Option<StartPoint> {
    let point = at_time(&last.points, frame.time - last.time)?;
    is_near(&point, frame).then_some(StartPoint {
        pose: point.pose,
        kappa: point.kappa,
        v: point.v,
        a: point.a,
    })
}

/// Whether the ego is where a trajectory wants it to be.
pub fn is_near(point: &TrajectoryPoint, frame: &Frame) -> bool {
    let error: Vec2 = point.pose.to_local(frame.ego.pose.position());
    let across = if frame.ego.v < MANOEUVRING {
        MANOEUVRING_TOLERANCE
    } else {
        LATERAL_TOLERANCE
    };
    error.x.abs() <= LONGITUDINAL_TOLERANCE && error.y.abs() <= across
}

impl StartPoint {
    /// The ego as localised.
    pub fn measured(frame: &Frame) -> Self {
        let ego = &frame.ego;
        let kappa = if ego.v > STANDSTILL {
            ego.yaw_rate / ego.v
        } else {
            0.0
        };
        Self {
            pose: ego.pose,
            kappa,
            v: ego.v.max(0.0),
            a: ego.a,
        }
    }
}

/// A trajectory's point at a time, linear between its points.
pub fn at_time(points: &[TrajectoryPoint], t: f64) -> Option<TrajectoryPoint> {
    let above = points.partition_point(|p| p.t <= t);
    if above == 0 {
        return None;
    }
    let a = points[above - 1];
    let Some(b) = points.get(above) else {
        return Some(a);
    };
    let share = (t - a.t) / (b.t - a.t);
    let mix = |x: f64, y: f64| x + (y - x) * share;
    Some(TrajectoryPoint {
        t,
        distance: mix(a.distance, b.distance),
        pose: Pose::new(
            mix(a.pose.x, b.pose.x),
            mix(a.pose.y, b.pose.y),
            angle::wrap(a.pose.theta + angle::difference(b.pose.theta, a.pose.theta) * share),
        ),
        kappa: mix(a.kappa, b.kappa),
        v: mix(a.v, b.v),
        a: mix(a.a, b.a),
    })
}

/// Largest heading error whose tangent is still used, rad: beyond it the car drives across the line and a
/// path as a function of station makes no sense.
const LARGEST_HEADING_ERROR: f64 = 1.2;

impl LateralState {
    /// The Frenet state of a start point (the original's `CartesianFrenetConverter`).
    pub fn of<L: LineQuery + ?Sized>(line: &L, start: &StartPoint) -> Self {
        let at = line.to_frenet(start.pose.position());
        let reference = line.point(at.s);
        let turn = angle::difference(start.pose.theta, reference.theta)
            .clamp(-LARGEST_HEADING_ERROR, LARGEST_HEADING_ERROR);
        let foot = Foot {
            s: at.s,
            pose: Pose::new(reference.x, reference.y, reference.theta),
            kappa: reference.kappa,
            dkappa: 0.0,
        };
        let [dl, ddl] = slopes(&foot, at.l, turn, start.kappa);
        Self {
            s: at.s,
            l: [at.l, dl, ddl],
        }
    }
}
