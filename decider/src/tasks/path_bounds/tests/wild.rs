//! Whatever the numbers, there is an answer or a typed error: no panic, no endless loop.

use super::setup::{OWN, PLAIN, Road, Section, Setup, assert_limits, parked};
use crate::geometry::{Pose, Vec2};
use crate::road::{BoundaryType, Side};
use crate::tasks::path_bounds::{
    Borrow, EgoFrenet, ObstacleSl, PathBoundsError, PullOverKind, PullOverPlace, Quirks,
};
use proptest::prelude::*;

/// Numbers of every size, and none at all.
fn wild() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -10.0..200.0_f64,
        1 => any::<f64>(),
        1 => prop::sample::select(vec![
            0.0, -0.0, 0.5, 1e-300, -1e-300, 1e9, -1e9, 1e16, -1e16, f64::MAX, f64::MIN,
            f64::INFINITY, f64::NEG_INFINITY, f64::NAN,
        ]),
    ]
}

fn pair() -> impl Strategy<Value = (f64, f64)> {
    (wild(), wild())
}

fn section() -> impl Strategy<Value = Section> {
    use BoundaryType as B;
    let mark = || {
        prop::sample::select(vec![
            B::Unknown,
            B::DottedWhite,
            B::SolidYellow,
            B::DoubleYellow,
            B::Curb,
        ])
    };
    let neighbours = prop::array::uniform4(prop::option::of(wild()));
    (
        prop::option::of(pair()),
        prop::option::of(pair()),
        prop::option::of(wild()),
        prop::option::of((mark(), mark())),
        neighbours,
        any::<bool>(),
    )
        .prop_map(|(lane, road, offset, marks, neighbours, junction)| Section {
            from: f64::NEG_INFINITY,
            lane,
            road,
            offset,
            marks,
            neighbours,
            junction,
        })
}

fn road() -> impl Strategy<Value = Road> {
    let plain = Just(vec![PLAIN]);
    let changing = (section(), section(), 0.0..150.0_f64)
        .prop_map(|(first, second, from)| vec![first, Section { from, ..second }]);
    let length = prop_oneof![0.0..300.0_f64, Just(f64::MAX), Just(f64::INFINITY)];
    (prop_oneof![plain, changing], length).prop_map(|(sections, length)| Road {
        origin: Pose::new(0.0, 0.0, 0.3),
        length,
        sections,
    })
}

fn obstacle() -> impl Strategy<Value = ObstacleSl> {
    (0..4_u32, pair(), pair(), wild()).prop_map(|(id, s, l, speed)| {
        let speed = if speed > 3.0 { 0.0 } else { speed };
        ObstacleSl {
            speed,
            ..parked(id, s, l)
        }
    })
}

fn quirks() -> impl Strategy<Value = Quirks> {
    let one = prop::array::uniform20(any::<bool>()).prop_map(|on| Quirks {
        arbitrary_blocker: on[0],
        greedy_sides: on[1],
        forgets_beside_overhang: on[2],
        pad_through_blocker: on[3],
        silent_blocker: on[4],
        lane_change_discards_fallback: on[5],
        asserts_ego_inside: on[6],
        pull_over_overhang: on[7],
        unsigned_road_edge: on[8],
        junction_at_anchor_only: on[9],
        unchecked_road_width: on[10],
        crosses_double_yellow: on[11],
        borrows_phantom_lane: on[12],
        zone_without_lane: on[13],
        endless_ego_extension: on[14],
        fallback_ignores_obstacles: on[15],
        unchecked_short_window: on[16],
        road_edge_at_axle: on[17],
        pull_over_stands_alone: on[18],
        unreachable_place: on[19],
    });
    prop_oneof![Just(Quirks::default()), Just(Quirks::apollo()), one]
}

fn setups() -> impl Strategy<Value = Setup> {
    let ego =
        (wild(), wild(), wild(), wild()).prop_map(|(s, s_dot, l, l_dot)| EgoFrenet { s, s_dot, l, l_dot });
    let place = prop::option::of((pair(), wild())).prop_map(|place| {
        place.map(|((x, y), theta)| PullOverPlace {
            position: Vec2::new(x, y),
            theta,
            length_front: 3.0,
            length_back: 2.0,
            width_left: 1.0,
            width_right: 1.0,
        })
    });
    let vehicle = prop::option::of(prop::array::uniform5(wild()));
    let config = prop::option::of(prop::array::uniform12(wild()));
    let points = (prop::option::of(pair()), prop::option::of(pair()), wild());
    let flags = prop::array::uniform5(any::<bool>());
    let things = (prop::collection::vec(obstacle(), 0..6), quirks());
    (road(), ego, place, vehicle, config, points, flags, things).prop_map(
        |(road, ego, place, vehicle, config, points, flags, (obstacles, quirks))| {
            let mut setup = Setup::fixed();
            (setup.road, setup.ego, setup.obstacles) = (road, ego, obstacles);
            if let Some([a, b, c, d, e]) = vehicle {
                (setup.vehicle.length, setup.vehicle.width) = (a, b);
                (
                    setup.vehicle.front_edge_to_center,
                    setup.vehicle.back_edge_to_center,
                ) = (c, d);
                setup.vehicle.min_turn_radius = e;
            }
            if let Some(numbers) = config {
                wild_numbers(&mut setup, numbers);
            }
            setup.config.quirks = quirks;
            setup.config.is_extend_lane_bounds_to_include_adc = flags[0];
            setup.is_change_lane = flags[1];
            setup.memory.change_lane.is_clear = flags[2];
            setup.memory.pull_over.is_requested = flags[3];
            setup.memory.pull_over.place = place;
            if flags[4] {
                setup.memory.pull_over.kind = PullOverKind::Emergency;
            }
            let (destination, start, cruise) = points;
            setup.destination = destination.map(|(x, y)| Vec2::new(x, y));
            setup.memory.change_lane.start = start.map(|(x, y)| Vec2::new(x, y));
            setup.cruise_speed = cruise;
            setup.borrow = vec![Borrow::Left, Borrow::Right];
            setup.memory.passed = setup.obstacles.iter().map(|it| (it.id, Side::Left)).collect();
            setup
        },
    )
}

fn wild_numbers(setup: &mut Setup, numbers: [f64; 12]) {
    let config = &mut setup.config;
    let fields = [
        &mut config.pull_over_road_edge_buffer,
        &mut config.pull_over_approach_lon_distance_adjust_factor,
        &mut config.adc_buffer_coeff,
        &mut config.obstacle_lat_buffer,
        &mut config.obstacle_lon_start_buffer,
        &mut config.obstacle_lon_end_buffer,
        &mut config.lane_change_prepare_length,
        &mut config.trajectory_time_length,
        &mut config.fallback_obstacle_lat_buffer,
        &mut config.hard_obstacle_lat_buffer,
        &mut config.ego_extension_hold_time,
        &mut config.ego_extension_fade_time,
    ];
    for (field, number) in fields.into_iter().zip(numbers) {
        *field = number;
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// Every bound that comes back is ordered where it had an order to begin with.
    #[test]
    fn wild_numbers_get_an_answer_or_a_typed_error(setup in setups()) {
        let mut setup = setup;
        for _ in 0..2 {
            if let Ok(answer) = setup.decide() {
                for bound in &answer.bounds {
                    prop_assert!(bound.points.len() <= 4001 && bound.padding <= bound.points.len());
                }
            }
        }
    }
}

/// An ego so far out that half a metre is lost in rounding has no stations; a horizon without end has one.
#[test]
fn stations_are_never_endless() {
    for s in [-1e16, -1e300, 1e300, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        let mut setup = Setup::fixed().with(|setup| {
            setup.ego.s = s;
            setup.road.length = f64::MAX;
        });
        assert_eq!(setup.decide(), Err(PathBoundsError::NoStations), "{s}");
    }
    let mut setup = Setup::fixed().with(|setup| {
        setup.road.length = f64::INFINITY;
        setup.cruise_speed = f64::INFINITY;
    });
    assert_eq!(setup.bound(OWN).points.len(), 4000);
}

/// An obstacle with an edge that is no number cannot be placed. It is left out, and what can be placed is passed
/// as ever. Edges in the wrong order still say where it is.
#[test]
fn boxes_that_are_none_are_left_out() {
    let nan = f64::NAN;
    let scene = |quirks: Quirks| {
        let mut setup = Setup::fixed().parked(1, (80.0, 84.0), (0.9, 2.0));
        setup.config.quirks = quirks;
        setup
    };
    let boxes = [
        ((nan, 84.0), (-1.0, 1.0)),
        ((80.0, nan), (-1.0, 1.0)),
        ((80.0, 84.0), (nan, 1.0)),
        ((80.0, 84.0), (-1.0, nan)),
    ];
    for quirks in [Quirks::default(), Quirks::apollo()] {
        for (s, l) in boxes {
            let mut with = scene(quirks).parked(2, s, l);
            assert_eq!(with.decide(), scene(quirks).decide(), "{s:?} {l:?}");
        }
    }
    let mut swapped = Setup::fixed().parked(1, (80.0, 84.0), (2.0, 0.9));
    assert_eq!(swapped.decide(), scene(Quirks::default()).decide());
}

/// A wall without end is an obstacle like any other.
#[test]
fn an_endless_wall_blocks() {
    let mut setup = Setup::fixed().parked(1, (80.0, f64::INFINITY), (f64::NEG_INFINITY, f64::INFINITY));
    let bound = setup.bound(OWN);
    assert_eq!((bound.end_s(), bound.blocked_by.map(|id| id.0)), (77.0, Some(1)));
    let mut setup = Setup::fixed().parked(1, (80.0, f64::INFINITY), (0.9, f64::INFINITY));
    assert_limits(&setup.bound(OWN), 77.5, 149.5, (-0.695, 0.9 - 1.455));
}
