//! One frame in the Frenet frame of one line: the ego and every obstacle, projected once per tick.

use crate::config::Config;
use crate::frame::{Frame, Obstacle, ObstacleId};
use crate::geometry::{ConvexPolygon, Vec2, angle};
use crate::reference_line::{LineQuery, ReferenceLine, SlPoint};
use crate::tasks::path_bounds::{EgoFrenet, ObstacleSl};
use crate::tasks::start_point::{LateralState, StartPoint};
use crate::vehicle::VehicleParams;

/// Obstacles farther than this from the line do not concern it, m.
const LATERAL_RANGE: f64 = 20.0;

/// A frame seen along one line.
#[derive(Debug)]
pub struct Scene<'a> {
    /// The frame.
    pub frame: &'a Frame,
    /// The line.
    pub line: &'a ReferenceLine,
    /// Whether it leads into another lane.
    pub is_change_lane: bool,
    /// Speed to drive where nothing limits it, m/s.
    pub cruise_speed: f64,
    /// The ego's body.
    pub vehicle: &'a VehicleParams,
    /// Settings.
    pub config: &'a Config,
    /// Where planning starts.
    pub start: StartPoint,
    /// Its Frenet motion by time.
    pub ego: EgoFrenet,
    /// Its Frenet motion by station.
    pub lateral: LateralState,
    /// Boxes of the obstacles near the line, in the frame's order.
    pub obstacles: Vec<ObstacleSl>,
    /// Outlines of the static ones among them, in world coordinates.
    pub bodies: Vec<Body>,
    /// The moving ones among them, with their predictions.
    pub moving: Vec<Moving>,
}

/// A body that stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Which obstacle.
    pub id: ObstacleId,
    /// Its outline.
    pub outline: ConvexPolygon,
    /// Middle of a circle around it.
    pub center: Vec2,
    /// Radius of that circle, m.
    pub radius: f64,
}

/// A moving obstacle and where it will be.
#[derive(Clone, Debug, PartialEq)]
pub struct Moving {
    /// Which obstacle.
    pub id: ObstacleId,
    /// Its box now and at later times, by ascending time.
    pub boxes: Vec<TimedBox>,
}

/// A box in the Frenet frame at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedBox {
    /// Seconds from the frame's time.
    pub t: f64,
    /// Middle.
    pub at: SlPoint,
    /// Half its extent along the line, m.
    pub half_length: f64,
    /// Half its extent across the line, m.
    pub half_width: f64,
    /// Speed along the line, m/s.
    pub s_dot: f64,
}

impl<'a> Scene<'a> {
    /// Projects a frame onto the line at `place` of its lines.
    pub fn new(
        frame: &'a Frame,
        place: usize,
        vehicle: &'a VehicleParams,
        config: &'a Config,
        start: StartPoint,
    ) -> Self {
        let line = &*frame.lines[place].line;
        let lateral = LateralState::of(line, &start);
        let mut scene = Self {
            frame,
            line,
            is_change_lane: frame.lines[place].is_change_lane,
            cruise_speed: frame.cruise_speed,
            vehicle,
            config,
            start,
            ego: EgoFrenet::at(line, start.pose, start.v),
            lateral,
            obstacles: Vec::with_capacity(frame.obstacles.len()),
            bodies: Vec::new(),
            moving: Vec::new(),
        };
        for obstacle in &frame.obstacles {
            scene.add(obstacle);
        }
        scene
    }

    fn add(&mut self, obstacle: &Obstacle) {
        let center = self.line.to_frenet(obstacle.pose.position());
        if center.l.abs() > LATERAL_RANGE {
            return;
        }
        let sl = if obstacle.is_static {
            let outline = obstacle.footprint();
            let sl = sl_box(self.line, obstacle, outline.vertices());
            self.bodies.push(Body {
                id: obstacle.id,
                center: obstacle.pose.position(),
                radius: radius(&obstacle.shape),
                outline,
            });
            sl
        } else {
            let moving = moving(self.line, obstacle);
            let now = moving.boxes[0];
            self.moving.push(moving);
            ObstacleSl {
                start_s: now.at.s - now.half_length,
                end_s: now.at.s + now.half_length,
                start_l: now.at.l - now.half_width,
                end_l: now.at.l + now.half_width,
                ..flags(obstacle)
            }
        };
        self.obstacles.push(sl);
    }

    /// Station of the front bumper, m.
    pub fn ego_end_s(&self) -> f64 {
        self.ego.s + self.vehicle.front_edge_to_center
    }

    /// The box of one obstacle, if it is near the line.
    pub fn obstacle(&self, id: ObstacleId) -> Option<&ObstacleSl> {
        self.obstacles.iter().find(|obstacle| obstacle.id == id)
    }
}

fn flags(obstacle: &Obstacle) -> ObstacleSl {
    ObstacleSl {
        id: obstacle.id,
        start_s: 0.0,
        end_s: 0.0,
        start_l: 0.0,
        end_l: 0.0,
        speed: obstacle.speed(),
        is_static: obstacle.is_static,
        is_virtual: false,
        is_ignored: false,
    }
}

/// The box around projected corners.
fn sl_box(line: &ReferenceLine, obstacle: &Obstacle, corners: &[Vec2]) -> ObstacleSl {
    let mut sl = ObstacleSl {
        start_s: f64::MAX,
        end_s: -f64::MAX,
        start_l: f64::MAX,
        end_l: -f64::MAX,
        ..flags(obstacle)
    };
    for corner in corners {
        let at = line.to_frenet(*corner);
        (sl.start_s, sl.end_s) = (sl.start_s.min(at.s), sl.end_s.max(at.s));
        (sl.start_l, sl.end_l) = (sl.start_l.min(at.l), sl.end_l.max(at.l));
    }
    sl
}

fn radius(shape: &ConvexPolygon) -> f64 {
    shape
        .vertices()
        .iter()
        .map(nalgebra::Matrix::norm)
        .fold(0.0, f64::max)
}

/// Boxes over time: the middle is projected, the extents follow from the heading to the line.
fn moving(line: &ReferenceLine, obstacle: &Obstacle) -> Moving {
    let extent = |pose_theta: f64, line_theta: f64| {
        let (sin, cos) = angle::sin_cos(pose_theta - line_theta);
        obstacle
            .shape
            .vertices()
            .iter()
            .fold((0.0_f64, 0.0_f64), |(along, across), v| {
                (
                    along.max((cos * v.x - sin * v.y).abs()),
                    across.max((sin * v.x + cos * v.y).abs()),
                )
            })
    };
    let now = crate::frame::PredictedPose {
        t: 0.0,
        pose: obstacle.pose,
    };
    let poses = if obstacle.prediction.is_empty() {
        std::slice::from_ref(&now)
    } else {
        &obstacle.prediction
    };
    let mut boxes: Vec<TimedBox> = poses
        .iter()
        .map(|predicted| {
            let at = line.to_frenet(predicted.pose.position());
            let (half_length, half_width) = extent(predicted.pose.theta, line.point(at.s).theta);
            TimedBox {
                t: predicted.t,
                at,
                half_length,
                half_width,
                s_dot: 0.0,
            }
        })
        .collect();
    for k in 0..boxes.len() {
        let (a, b) = (k.min(boxes.len().saturating_sub(2)), (k + 1).min(boxes.len() - 1));
        let dt = boxes[b].t - boxes[a].t;
        boxes[k].s_dot = if dt > 0.0 {
            (boxes[b].at.s - boxes[a].at.s) / dt
        } else {
            0.0
        };
    }
    Moving {
        id: obstacle.id,
        boxes,
    }
}
