//! Faults in what is seen: obstacles, their predictions, and the ego's own place.

use super::planted::Past;
use super::scenario::KMH;
use super::spec::{Plant, Spec, Stage};
use corridor_decider::frame::{Frame, Obstacle, ObstacleId, ObstacleKind, PredictedPose};
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2, angle};
use corridor_decider::reference_line::{LineQuery, SlPoint};
use std::f64::consts::FRAC_PI_2;

/// How far a short-sighted sensor sees, m.
const SHORT_SIGHT: f64 = 20.0;

/// Ticks by which what is seen of others is late: half a second, that of a slow pipeline.
const STALE_OBSTACLES: usize = 5;

/// Ticks by which the whole frame is late.
const STALE_FRAME: usize = 3;

/// Of so many ticks an obstacle is seen in one.
const FLICKER: u32 = 3;

/// Half the size of a point, m: a body must have one.
const POINT: f64 = 0.05;

/// How late a prediction is, s.
const LATE: f64 = 1.0;

/// How far ahead a phantom stands, m, and half its size, m.
const PHANTOM: (f64, f64) = (15.0, 0.5);

/// How far beside itself the ego is localised, m: half a lane line's width of error is usual, this is a bad fix.
const EGO_OFF: f64 = 0.7;

/// By how much the ego's heading is off, rad: a misaligned antenna of 3°.
const HEADING_OFF: f64 = 0.052;

const fn on_frame(name: &'static str, what: &'static str, change: fn(&mut Frame, &mut Past)) -> Spec {
    Spec::new(name, what, Stage::Perception, Plant::Frame(change))
}

pub(super) const FAULTS: &[Spec] = &[
    on_frame(
        "mirrored",
        "Obstacles are seen on the other side of the line: `l` with the wrong sign.",
        |frame, _| mirror(frame),
    ),
    on_frame("obstacles_unseen", "No obstacle is seen.", |frame, _| {
        frame.obstacles.clear();
    }),
    on_frame(
        "half_of_the_obstacles",
        "Every other obstacle is forgotten: a loop that steps by two.",
        |frame, _| {
            frame.obstacles.retain(|obstacle| obstacle.id.0 % 2 == 1);
        },
    ),
    on_frame(
        "last_obstacle_dropped",
        "The last obstacle of the list is left out: a loop that ends one too early.",
        |frame, _| {
            frame.obstacles.pop();
        },
    ),
    on_frame(
        "nearest_obstacle_dropped",
        "The nearest obstacle is taken for the ego itself and left out.",
        |frame, _| {
            drop_nearest(frame);
        },
    ),
    on_frame(
        "short_sighted",
        "Nothing farther than 20 m is seen.",
        |frame, _| {
            let ego = frame.ego.pose.position();
            frame
                .obstacles
                .retain(|obstacle| (obstacle.pose.position() - ego).norm() <= SHORT_SIGHT);
        },
    ),
    on_frame(
        "vulnerable_unseen",
        "People on foot and on bicycles are filtered out as clutter.",
        |frame, _| {
            frame.obstacles.retain(|obstacle| !obstacle.kind.is_vulnerable());
        },
    ),
    on_frame(
        "small_unseen",
        "What is narrower than 0.8 m is filtered out as clutter.",
        |frame, _| {
            frame.obstacles.retain(|obstacle| extent(&obstacle.shape) >= 0.8);
        },
    ),
    on_frame(
        "flickering_obstacles",
        "Obstacles are seen in one tick of three.",
        |frame, past| {
            if !past.tick().is_multiple_of(FLICKER) {
                frame.obstacles.clear();
            }
        },
    ),
    on_frame(
        "stale_obstacles",
        "Obstacles are where they were half a second ago.",
        |frame, past| {
            if let Some(old) = past.frame_ago(STALE_OBSTACLES) {
                frame.obstacles.clone_from(&old.obstacles);
            }
        },
    ),
    on_frame(
        "stale_frame",
        "Ego and obstacles are where they were three ticks ago.",
        |frame, past| {
            if let Some(old) = past.frame_ago(STALE_FRAME) {
                frame.ego = old.ego;
                frame.obstacles.clone_from(&old.obstacles);
            }
        },
    ),
    on_frame(
        "frozen_obstacles",
        "Obstacles stay where they were when they were first seen.",
        freeze,
    ),
    on_frame(
        "points_for_bodies",
        "An obstacle is the point of its centre.",
        |frame, _| {
            reshape(frame, |_| {
                Some(ConvexPolygon::rectangle(
                    Pose::new(0.0, 0.0, 0.0),
                    POINT,
                    POINT,
                    POINT,
                ))
            });
        },
    ),
    on_frame(
        "bodies_of_half_size",
        "Lengths and widths are taken for the half of them once more.",
        |frame, _| {
            reshape(frame, |shape| scaled(shape, 0.5));
        },
    ),
    on_frame(
        "bodies_of_double_size",
        "Half lengths and half widths are taken for whole ones, and bodies are twice as large.",
        |frame, _| {
            reshape(frame, |shape| scaled(shape, 2.0));
        },
    ),
    on_frame(
        "rear_bumper_for_centre",
        "The place of an obstacle's rear bumper is taken for that of its centre.",
        |frame, _| {
            each(frame, |obstacle| {
                let back = -obstacle.shape.vertices().iter().map(|v| v.x).fold(0.0, f64::min);
                obstacle.pose = obstacle.pose.advanced(-back);
            });
        },
    ),
    on_frame(
        "headings_swapped",
        "Headings are computed with the arguments of the arctangent swapped.",
        |frame, _| {
            each(frame, |obstacle| {
                obstacle.pose.theta = angle::wrap(FRAC_PI_2 - obstacle.pose.theta);
            });
        },
    ),
    on_frame(
        "headings_in_degrees",
        "Headings in degrees are taken for radians.",
        |frame, _| {
            each(frame, |obstacle| {
                obstacle.pose.theta = angle::wrap(obstacle.pose.theta.to_degrees());
            });
        },
    ),
    on_frame(
        "prediction_ignored",
        "Whoever moves is expected to stay where he is.",
        |frame, _| {
            predict(frame, |now, then| PredictedPose { pose: now, ..then });
        },
    ),
    on_frame(
        "prediction_backwards",
        "Velocities have the wrong sign: everybody is expected to come from where he goes.",
        |frame, _| {
            predict(frame, |now, then| moved(now, then, -1.0));
        },
    ),
    on_frame(
        "prediction_in_kmh",
        "Speeds in km/h are taken for m/s: everybody is expected 3.6 times as far on.",
        |frame, _| {
            predict(frame, |now, then| moved(now, then, KMH));
        },
    ),
    on_frame(
        "prediction_late",
        "Everybody is expected a second later than he comes.",
        |frame, _| {
            each(frame, |obstacle| {
                let first = obstacle.prediction.first().copied();
                obstacle.prediction.iter_mut().for_each(|then| then.t += LATE);
                if let Some(first) = first {
                    obstacle.prediction.insert(0, first);
                }
            });
        },
    ),
    on_frame(
        "moving_as_static",
        "Whoever moves is taken for a thing that stands.",
        |frame, _| {
            each(frame, |obstacle| {
                obstacle.is_static = true;
                obstacle.prediction.clear();
            });
        },
    ),
    on_frame(
        "static_as_moving",
        "What stands is taken for somebody who moves, at no speed.",
        |frame, _| {
            each(frame, |obstacle| {
                if obstacle.is_static {
                    obstacle.is_static = false;
                    obstacle.prediction = staying(obstacle.pose);
                }
            });
        },
    ),
    on_frame(
        "swapped_ids",
        "The obstacles trade their identities from tick to tick.",
        |frame, past| {
            let ids: Vec<ObstacleId> = frame.obstacles.iter().map(|obstacle| obstacle.id).collect();
            let turn = past.tick() as usize;
            for (k, obstacle) in frame.obstacles.iter_mut().enumerate() {
                obstacle.id = ids[(k + turn) % ids.len()];
            }
        },
    ),
    on_frame(
        "phantom_ahead",
        "Something is seen 15 m ahead that is not there.",
        |frame, _| phantom(frame),
    ),
    on_frame(
        "ego_to_the_right",
        "The ego is localised 0.7 m right of where it is.",
        |frame, _| {
            let place = frame.ego.pose.to_world(Vec2::new(0.0, -EGO_OFF));
            (frame.ego.pose.x, frame.ego.pose.y) = (place.x, place.y);
        },
    ),
    on_frame(
        "ego_at_front_axle",
        "The place of the front axle is taken for that of the rear one.",
        |frame, _| {
            frame.ego.pose = frame.ego.pose.advanced(2.8448);
        },
    ),
    on_frame(
        "ego_heading_off",
        "The ego's heading is off by 3°.",
        |frame, _| {
            frame.ego.pose.theta = angle::wrap(frame.ego.pose.theta + HEADING_OFF);
        },
    ),
    on_frame(
        "ego_heading_in_degrees",
        "The ego's heading in degrees is taken for radians.",
        |frame, _| {
            frame.ego.pose.theta = angle::wrap(frame.ego.pose.theta.to_degrees());
        },
    ),
    on_frame(
        "ego_speed_in_kmh",
        "The ego's speed in km/h is taken for m/s.",
        |frame, _| frame.ego.v *= KMH,
    ),
    on_frame(
        "ego_stands",
        "The ego is taken to stand, whatever it does.",
        |frame, _| {
            (frame.ego.v, frame.ego.a, frame.ego.yaw_rate) = (0.0, 0.0, 0.0);
        },
    ),
];

fn each(frame: &mut Frame, change: impl Fn(&mut Obstacle)) {
    frame.obstacles.iter_mut().for_each(change);
}

fn reshape(frame: &mut Frame, shape: impl Fn(&ConvexPolygon) -> Option<ConvexPolygon>) {
    each(frame, |obstacle| {
        if let Some(shape) = shape(&obstacle.shape) {
            obstacle.shape = shape;
        }
    });
}

fn scaled(shape: &ConvexPolygon, by: f64) -> Option<ConvexPolygon> {
    let outline: Vec<Vec2> = shape.vertices().iter().map(|v| v * by).collect();
    ConvexPolygon::hull(&outline)
}

/// The width of a body across its heading, m.
fn extent(shape: &ConvexPolygon) -> f64 {
    let across = shape.vertices().iter().map(|v| v.y);
    let (low, high) = across.fold((f64::MAX, f64::MIN), |(low, high), y| (low.min(y), high.max(y)));
    high - low
}

fn predict(frame: &mut Frame, change: impl Fn(Pose, PredictedPose) -> PredictedPose) {
    each(frame, |obstacle| {
        let now = obstacle.pose;
        for then in &mut obstacle.prediction {
            *then = change(now, *then);
        }
    });
}

/// As expected, but so many times as far on.
fn moved(now: Pose, then: PredictedPose, times: f64) -> PredictedPose {
    let place = now.position() + (then.pose.position() - now.position()) * times;
    PredictedPose {
        pose: Pose::new(place.x, place.y, then.pose.theta),
        ..then
    }
}

/// The prediction of somebody who stays, for as long as anybody is predicted.
fn staying(pose: Pose) -> Vec<PredictedPose> {
    (0..=16_u32)
        .map(|k| PredictedPose {
            t: 0.5 * f64::from(k),
            pose,
        })
        .collect()
}

fn drop_nearest(frame: &mut Frame) {
    let ego = frame.ego.pose.position();
    let distance = |obstacle: &Obstacle| (obstacle.pose.position() - ego).norm();
    let nearest = (0..frame.obstacles.len())
        .min_by(|a, b| distance(&frame.obstacles[*a]).total_cmp(&distance(&frame.obstacles[*b])));
    if let Some(nearest) = nearest {
        frame.obstacles.remove(nearest);
    }
}

/// Every obstacle as it was in the oldest frame that is remembered and holds it, passed on from tick to tick.
fn freeze(frame: &mut Frame, past: &mut Past) {
    for obstacle in &mut frame.obstacles {
        match past.first_seen.iter().find(|first| first.id == obstacle.id) {
            Some(first) => obstacle.clone_from(first),
            None => past.first_seen.push(obstacle.clone()),
        }
    }
}

fn phantom(frame: &mut Frame) {
    let (ahead, half) = PHANTOM;
    frame.obstacles.push(Obstacle {
        id: ObstacleId::ANONYMOUS,
        kind: ObstacleKind::Other,
        pose: frame.ego.pose.advanced(ahead),
        shape: ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), half, half, half),
        velocity: Vec2::zeros(),
        is_static: true,
        prediction: Vec::new(),
    });
}

/// Every obstacle on the other side of the ego's line.
fn mirror(frame: &mut Frame) {
    let Some(line) = frame.lines.first().map(|first| first.line.clone()) else {
        return;
    };
    let flip = |pose: &mut Pose| {
        let SlPoint { s, l } = line.to_frenet(pose.position());
        let along = line.point(s).theta;
        let place = line.to_cartesian(SlPoint { s, l: -l });
        (pose.x, pose.y) = (place.x, place.y);
        pose.theta = angle::wrap(2.0 * along - pose.theta);
    };
    for obstacle in &mut frame.obstacles {
        flip(&mut obstacle.pose);
        obstacle
            .prediction
            .iter_mut()
            .for_each(|predicted| flip(&mut predicted.pose));
        let outline: Vec<Vec2> = obstacle
            .shape
            .vertices()
            .iter()
            .map(|v| Vec2::new(v.x, -v.y))
            .collect();
        if let Some(shape) = ConvexPolygon::hull(&outline) {
            obstacle.shape = shape;
        }
    }
}
