//! Faults of the path bounds: they are planted on what the path-bounds task hands on, so that all behind it drives by
//! them.

use super::planted::Past;
use super::spec::{Plant, Spec, Stage};
use corridor_decider::config::Config;
use corridor_decider::planner::{LinePlan, TaskName};
use corridor_decider::tasks::path_bounds::{BoundPoint, EdgeCause, PathBound};

/// Stations of a car length, at half a metre each.
const CAR_LENGTH: usize = 10;

/// Length of a bound that is cut short, stations.
const SHORT: usize = 20;

/// Feet in a metre.
const FEET: f64 = 3.280_84;

const fn on_bounds(name: &'static str, what: &'static str, change: fn(&mut LinePlan, &mut Past)) -> Spec {
    Spec::new(
        name,
        what,
        Stage::Bound,
        Plant::HandsOn(TaskName::PathBounds, change),
    )
}

const fn configured(name: &'static str, what: &'static str, change: fn(&mut Config)) -> Spec {
    Spec::new(name, what, Stage::Bound, Plant::Config(change))
}

pub(super) const FAULTS: &[Spec] = &[
    on_bounds(
        "bound_mirrored",
        "`l` of the bound has the wrong sign.",
        |plan, _| {
            points(plan, |point, _| {
                (point.l_min, point.l_max) = (-point.l_max, -point.l_min);
            });
        },
    ),
    on_bounds(
        "bound_sides_swapped",
        "Left and right limit are swapped.",
        |plan, _| {
            points(plan, |point, _| {
                (point.l_min, point.l_max) = (point.l_max, point.l_min);
            });
        },
    ),
    on_bounds(
        "bound_stations_unordered",
        "Two stations in the middle of the bound are swapped.",
        |plan, _| {
            bounds(plan, |bound| {
                let middle = bound.points.len() / 2;
                if middle > 0 {
                    bound.points.swap(middle - 1, middle);
                }
            });
        },
    ),
    on_bounds(
        "bound_one_station_late",
        "Each limit stands at the station after its own: off by one.",
        |plan, _| late(plan, 1),
    ),
    on_bounds(
        "bound_one_station_early",
        "Each limit stands at the station before its own: off by one.",
        |plan, _| early(plan, 1),
    ),
    on_bounds(
        "bound_a_car_length_late",
        "Limits are found for the front of the car and given for its rear: a car length late.",
        |plan, _| late(plan, CAR_LENGTH),
    ),
    on_bounds(
        "bound_a_car_length_early",
        "Limits are given a car length before where they were found.",
        |plan, _| early(plan, CAR_LENGTH),
    ),
    on_bounds(
        "bound_without_half_width",
        "Half the car's width is not taken off.",
        |plan, _| widen(plan, 1.0),
    ),
    on_bounds(
        "bound_with_half_width_twice",
        "Half the car's width is taken off twice.",
        |plan, _| widen(plan, -1.0),
    ),
    on_bounds("bound_in_feet", "`l` is given in feet.", |plan, _| {
        points(plan, |point, _| {
            (point.l_min, point.l_max) = (point.l_min * FEET, point.l_max * FEET);
        });
    }),
    on_bounds(
        "bound_without_obstacles",
        "What obstacles limit is forgotten again.",
        |plan, _| forget_obstacles(plan),
    ),
    on_bounds(
        "bound_one_tick_old",
        "The bound is that of the tick before.",
        |plan, past| {
            let line = usize::from(plan.scene.is_change_lane);
            let now = past.bounds[line].replace(plan.bounds.clone());
            if let Some(before) = now.filter(|before| !before.bounds.is_empty()) {
                plan.bounds = before;
            }
        },
    ),
    on_bounds(
        "bound_ten_metres_long",
        "The bound ends after ten metres.",
        |plan, _| {
            bounds(plan, |bound| bound.points.truncate(SHORT));
        },
    ),
    on_bounds(
        "fallback_bound_only",
        "Only the first of the bounds is handed on: a list that is read as one.",
        |plan, _| {
            plan.bounds.bounds.truncate(1);
            plan.bounds.passed.truncate(1);
        },
    ),
    configured(
        "obstacle_buffers_zeroed",
        "Obstacles are not widened at all.",
        |config| {
            let bounds = &mut config.path_bounds;
            (bounds.obstacle_lat_buffer, bounds.hard_obstacle_lat_buffer) = (0.0, 0.0);
            bounds.fallback_obstacle_lat_buffer = 0.0;
            (bounds.obstacle_lon_start_buffer, bounds.obstacle_lon_end_buffer) = (0.0, 0.0);
        },
    ),
    configured(
        "obstacle_lat_buffer_zeroed",
        "Obstacles are not widened to the side.",
        |config| {
            config.path_bounds.obstacle_lat_buffer = 0.0;
        },
    ),
    configured(
        "obstacle_lat_buffer_doubled",
        "Obstacles are widened to the side by twice as much.",
        |config| {
            config.path_bounds.obstacle_lat_buffer *= 2.0;
        },
    ),
    configured(
        "obstacle_lon_buffers_negative",
        "Obstacles are shortened by what they should be lengthened by.",
        |config| {
            let bounds = &mut config.path_bounds;
            bounds.obstacle_lon_start_buffer *= -1.0;
            bounds.obstacle_lon_end_buffer *= -1.0;
        },
    ),
];

fn bounds(plan: &mut LinePlan, change: impl Fn(&mut PathBound)) {
    plan.bounds.bounds.iter_mut().for_each(change);
}

fn points(plan: &mut LinePlan, change: impl Fn(&mut BoundPoint, usize)) {
    bounds(plan, |bound| {
        for (k, point) in bound.points.iter_mut().enumerate() {
            change(point, k);
        }
    });
}

/// Limits of another station, at the own one.
fn limits_of(point: &mut BoundPoint, other: &BoundPoint) {
    *point = BoundPoint { s: point.s, ..*other };
}

fn late(plan: &mut LinePlan, stations: usize) {
    bounds(plan, |bound| {
        let found = bound.points.clone();
        for (k, point) in bound.points.iter_mut().enumerate() {
            limits_of(point, &found[k.saturating_sub(stations)]);
        }
    });
}

fn early(plan: &mut LinePlan, stations: usize) {
    bounds(plan, |bound| {
        let found = bound.points.clone();
        for (k, point) in bound.points.iter_mut().enumerate() {
            limits_of(point, &found[(k + stations).min(found.len() - 1)]);
        }
    });
}

/// Moves both limits out by so many half widths of the car.
fn widen(plan: &mut LinePlan, half_widths: f64) {
    let by = half_widths * plan.scene.vehicle.half_width();
    points(plan, |point, _| {
        // A bound that closes is a bound of no width: the mistake is in the number, not in the order.
        let middle = f64::midpoint(point.l_min, point.l_max);
        point.l_min = (point.l_min - by).min(middle);
        point.l_max = (point.l_max + by).max(middle);
    });
}

/// Limits that obstacles cause become those of the widest station that no obstacle limits.
fn forget_obstacles(plan: &mut LinePlan) {
    bounds(plan, |bound| {
        let is_obstacle = |cause: EdgeCause| matches!(cause, EdgeCause::Obstacle(_));
        let free_left = bound.points.iter().filter(|point| !is_obstacle(point.left));
        let free_right = bound.points.iter().filter(|point| !is_obstacle(point.right));
        let left = free_left.map(|point| point.l_max).reduce(f64::max);
        let right = free_right.map(|point| point.l_min).reduce(f64::min);
        for point in &mut bound.points {
            if let Some(left) = left.filter(|_| is_obstacle(point.left)) {
                point.l_max = left.max(point.l_max);
            }
            if let Some(right) = right.filter(|_| is_obstacle(point.right)) {
                point.l_min = right.min(point.l_min);
            }
        }
        bound.blocked_by = None;
    });
}
