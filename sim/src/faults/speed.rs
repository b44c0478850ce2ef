//! Faults of the speed: limits, stops, gaps, what moves, and the times of the trajectory.

use super::path::extend;
use super::planted::Past;
use super::quirks::NO_SPEED;
use super::scenario::{KMH, lines};
use super::spec::{Plant, Spec, Stage};
use corridor_decider::config::Config;
use corridor_decider::decision::{Decision, TrajectoryPoint};
use corridor_decider::planner::{LinePlan, TaskName};
use corridor_decider::tasks::object_decision::Longitudinal;

/// Length of the usual car, m.
const CAR_LENGTH: f64 = 4.933;

/// A tick, s.
const TICK: f64 = 0.1;

const fn handed_on(
    name: &'static str,
    what: &'static str,
    task: TaskName,
    change: fn(&mut LinePlan, &mut Past),
) -> Spec {
    Spec::new(name, what, Stage::Speed, Plant::HandsOn(task, change))
}

const fn configured(name: &'static str, what: &'static str, change: fn(&mut Config)) -> Spec {
    Spec::new(name, what, Stage::Speed, Plant::Config(change))
}

const fn on_trajectory(
    name: &'static str,
    what: &'static str,
    change: fn(&mut Vec<TrajectoryPoint>, &mut Past),
) -> Spec {
    Spec::new(name, what, Stage::Speed, Plant::Trajectory(change))
}

pub(super) const FAULTS: &[Spec] = &[
    Spec::new(
        "speed_limit_ignored",
        "The speed limits of the map are not read, and the car drives half as fast again as it is told.",
        Stage::Speed,
        Plant::Frame(|frame, past| {
            frame.cruise_speed *= 1.5;
            lines(frame, past, |sample| sample.speed_limit = None);
        }),
    ),
    configured("bends_ignored", "Bends limit no speed.", |config| {
        config.speed.lateral_acceleration = 100.0;
    }),
    handed_on(
        "stop_a_car_length_late",
        "A stop stands a car length too far: its distance is kept from the rear.",
        TaskName::RuleBasedStop,
        |plan, _| {
            extend(plan, CAR_LENGTH + 1.0);
            if let Some(wall) = &mut plan.wall {
                wall.distance += CAR_LENGTH;
            }
        },
    ),
    handed_on(
        "stop_a_car_length_early",
        "A stop stands a car length too near: the length is taken off twice.",
        TaskName::RuleBasedStop,
        |plan, _| {
            if let Some(wall) = &mut plan.wall {
                wall.distance = (wall.distance - CAR_LENGTH).max(0.0);
            }
        },
    ),
    configured(
        "stop_distance_short",
        "The distance kept from what blocks is short by one car length.",
        |config| {
            let speed = &mut config.speed;
            for distance in [
                &mut speed.stop_distance,
                &mut speed.pull_out_distance,
                &mut speed.least_stop_distance,
            ] {
                *distance = (*distance - CAR_LENGTH).max(0.0);
            }
        },
    ),
    configured(
        "pull_over_stops_late",
        "A pull-over ends a car length behind its place.",
        |config| config.speed.pull_over_early = -CAR_LENGTH,
    ),
    configured(
        "no_gap_to_a_leader",
        "Neither a time nor a distance is kept to a leader.",
        |config| {
            (config.speed.follow_distance, config.speed.follow_time) = (0.0, 0.0);
        },
    ),
    configured(
        "no_time_between_crossings",
        "No time has to lie between two uses of the same place.",
        |config| {
            config.speed.yield_time = 0.0;
        },
    ),
    configured(
        "moving_ones_are_narrow",
        "The room beside the path within which somebody claims it is none, less a metre.",
        |config| {
            config.speed.lateral_margin = -1.0;
        },
    ),
    configured(
        "planned_for_two_seconds",
        "The speed is planned two seconds ahead.",
        |config| config.speed.total_time = 2.0,
    ),
    configured(
        "brakes_at_the_last_moment",
        "Six metres per second squared count as comfortable braking.",
        |config| {
            (config.speed.braking, config.speed.hard_braking) = (6.0, 6.0);
        },
    ),
    handed_on(
        "moving_ones_ignored",
        "Whoever moves is left out of the ST graph.",
        TaskName::SpeedBoundsPriori,
        |plan, _| plan.on_path.clear(),
    ),
    handed_on(
        "only_the_first_on_the_path",
        "Of all who move on the path only the first of the list is minded.",
        TaskName::SpeedBoundsPriori,
        |plan, _| plan.on_path.truncate(1),
    ),
    handed_on(
        "yield_taken_for_overtake",
        "Before and after are swapped: who is to be yielded to is passed before.",
        TaskName::SpeedDecider,
        |plan, _| {
            for decision in &mut plan.decisions {
                if let Some(Longitudinal::Yield(fence) | Longitudinal::Stop(fence)) = decision.longitudinal {
                    decision.longitudinal = Some(Longitudinal::Overtake(fence));
                }
            }
        },
    ),
    handed_on(
        "follow_taken_for_overtake",
        "Who is to be followed is passed before.",
        TaskName::SpeedDecider,
        |plan, _| {
            for decision in &mut plan.decisions {
                if let Some(Longitudinal::Follow(fence)) = decision.longitudinal {
                    decision.longitudinal = Some(Longitudinal::Overtake(fence));
                }
            }
        },
    ),
    Spec::new(
        "emergency_brake_ignored",
        "A trajectory that only stops is not driven; the last one that was planned is, from where it was.",
        Stage::Speed,
        Plant::Decision(keep_going),
    )
    .when(NO_SPEED),
    on_trajectory(
        "speeds_in_kmh",
        "The speeds that the tracker is given are in km/h.",
        |points, _| scale(points, KMH),
    ),
    on_trajectory(
        "speeds_in_ms_for_kmh",
        "The tracker takes speeds in m/s for km/h.",
        |points, _| scale(points, 1.0 / KMH),
    ),
    on_trajectory(
        "acceleration_sign",
        "The acceleration that the tracker is given has the wrong sign.",
        |points, _| {
            for point in points.iter_mut() {
                point.a = -point.a;
            }
        },
    ),
    on_trajectory(
        "trajectory_one_tick_late",
        "The times that the tracker is given are late by a tick.",
        |points, _| shift(points, TICK),
    ),
    on_trajectory(
        "trajectory_one_tick_early",
        "The times that the tracker is given are early by a tick.",
        |points, _| shift(points, -TICK),
    ),
    on_trajectory(
        "trajectory_one_second_late",
        "The times that the tracker is given are late by a second.",
        |points, _| shift(points, 10.0 * TICK),
    ),
    on_trajectory(
        "trajectory_in_half_seconds",
        "Points a tenth of a second apart are taken for half a second apart.",
        |points, _| {
            for point in points.iter_mut() {
                point.t *= 5.0;
            }
        },
    ),
    on_trajectory(
        "never_stops",
        "Of what the tracker is given, no speed is below that of walking.",
        |points, _| {
            for point in points.iter_mut() {
                point.v = point.v.max(1.5);
            }
        },
    ),
];

fn scale(points: &mut [TrajectoryPoint], by: f64) {
    for point in points.iter_mut() {
        point.v *= by;
    }
}

fn shift(points: &mut [TrajectoryPoint], by: f64) {
    for point in points.iter_mut() {
        point.t += by;
    }
}

fn keep_going(decision: &mut Decision, past: &mut Past) {
    if decision.outcome.is_planned() {
        past.decision = Some(decision.clone());
    } else if let Some(planned) = &past.decision {
        decision.trajectory.clone_from(&planned.trajectory);
    }
}
