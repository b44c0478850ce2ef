//! Faults of the tracker: the car that it believes in, its gains, and the controls on their way to the car.

use super::planted::Past;
use super::spec::{Plant, Spec, Stage};
use crate::trace::Controls;
use crate::tracker::TrackerConfig;
use corridor_decider::vehicle::VehicleParams;

/// Physics steps by which controls are late: 0.3 s at the usual step.
const LATENCY: usize = 30;

/// Hardest braking that is passed on, m/s².
const WEAK_BRAKES: f64 = 2.0;

/// By how much the steering is off its middle, rad: 2°.
const OFF_MIDDLE: f64 = 0.035;

/// Ticks after which the tracker takes in a new trajectory.
const RARELY: usize = 10;

const fn tracking(
    name: &'static str,
    what: &'static str,
    change: fn(&mut VehicleParams, &mut TrackerConfig),
) -> Spec {
    Spec::new(name, what, Stage::Tracker, Plant::Tracker(change))
}

const fn on_controls(name: &'static str, what: &'static str, change: fn(&mut Controls, &mut Past)) -> Spec {
    Spec::new(name, what, Stage::Tracker, Plant::Controls(change))
}

pub(super) const FAULTS: &[Spec] = &[
    tracking(
        "tracker_wheel_base_long",
        "The tracker believes in a wheelbase of twice the length.",
        |car, _| car.wheel_base *= 2.0,
    ),
    tracking(
        "tracker_wheel_base_short",
        "The tracker believes in a wheelbase of half the length.",
        |car, _| car.wheel_base *= 0.5,
    ),
    tracking(
        "feedback_lost",
        "The tracker has its feed-forward only.",
        |_, gains| {
            gains.feedback_distance = 1e6;
            (gains.speed_gain, gains.station_gain) = (0.0, 0.0);
        },
    ),
    tracking(
        "feedback_too_eager",
        "The lateral feedback is ten times as fast as the car can follow.",
        |_, gains| {
            (gains.feedback_time, gains.feedback_distance) = (0.05, 0.3);
        },
    ),
    on_controls(
        "steering_sign",
        "The steering turns the other way.",
        |controls, _| controls.steer = -controls.steer,
    ),
    on_controls(
        "steering_ratio_forgotten",
        "The angle of the wheels is taken for that of the steering wheel.",
        |controls, _| controls.steer /= 16.0,
    ),
    on_controls(
        "steering_in_degrees",
        "The steering angle in radians is taken for degrees.",
        |controls, _| controls.steer = controls.steer.to_radians(),
    ),
    on_controls(
        "steering_off_middle",
        "The wheels stand 2° to the left when they should stand straight.",
        |controls, _| controls.steer += OFF_MIDDLE,
    ),
    on_controls(
        "controls_late",
        "Controls reach the car 0.3 s late.",
        |controls, past| {
            past.controls.push_back(*controls);
            *controls = if past.controls.len() > LATENCY {
                past.controls.pop_front().unwrap_or_default()
            } else {
                Controls::default()
            };
        },
    ),
    on_controls(
        "brakes_capped",
        "The brakes are capped at 2 m/s².",
        |controls, _| controls.acceleration = controls.acceleration.max(-WEAK_BRAKES),
    ),
    on_controls("brakes_lost", "The car does not brake.", |controls, _| {
        controls.acceleration = controls.acceleration.max(0.0);
    }),
    on_controls(
        "drive_and_brakes_swapped",
        "Drive and brakes are swapped.",
        |controls, _| controls.acceleration = -controls.acceleration,
    ),
    Spec::new(
        "trajectory_taken_in_rarely",
        "The tracker takes in a new trajectory once a second, and reads the old one with the new one's clock.",
        Stage::Tracker,
        Plant::Trajectory(|points, past| {
            past.trajectories.push_back(points.clone());
            let now = past.trajectories.len();
            if let Some(kept) = past.trajectories.front() {
                points.clone_from(kept);
            }
            if now == RARELY {
                past.trajectories.clear();
            }
        }),
    ),
];
