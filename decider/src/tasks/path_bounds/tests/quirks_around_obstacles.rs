//! One test per quirk that is about obstacles: what the defect does, and that it is gone without it.

use super::setup::{OWN, Setup, assert_limits, at};
use crate::frame::ObstacleId;
use crate::reference_line::LineQuery;
use crate::road::Side;
use crate::tasks::path_bounds::{Label, PathBoundsError};

/// A cone narrows the lane from the right, then a car farther on closes it. Only the car is to blame.
#[test]
fn arbitrary_blocker() {
    let scene = Setup::fixed()
        .parked(1, (70.0, 90.0), (-1.7, -1.4))
        .parked(2, (80.0, 84.0), (-0.4, 1.75));
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.arbitrary_blocker = true);
    assert_eq!(off.bound(OWN).blocked_by, Some(ObstacleId(2)));
    assert_eq!(on.bound(OWN).blocked_by, Some(ObstacleId(1)));
    // Neither changes where the bound ends.
    assert_eq!(off.bound(OWN).points, on.bound(OWN).points);
}

/// The same in the original's own sweep, which had the code to name the right one.
#[test]
fn arbitrary_blocker_of_the_greedy_sweep() {
    let scene = Setup::fixed()
        .parked(1, (70.0, 90.0), (-1.7, -1.4))
        .parked(2, (80.0, 84.0), (-0.4, 1.75))
        .with(|setup| setup.config.quirks.greedy_sides = true);
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.arbitrary_blocker = true);
    assert_eq!(off.bound(OWN).blocked_by, Some(ObstacleId(2)));
    assert_eq!(on.bound(OWN).blocked_by, Some(ObstacleId(1)));
}

/// Issues 15531 and 14055: two obstacles get opposite sides, and a road that is free on the right of both is
/// taken for blocked.
#[test]
fn greedy_sides() {
    let scene = Setup::fixed()
        .with(|setup| setup.road.sections[0].lane = Some((3.5, 3.5)))
        .parked(1, (70.0, 70.5), (-0.3, 0.1))
        .parked(2, (71.0, 71.5), (2.2, 2.6));
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.greedy_sides = true);
    let bound = off.bound(OWN);
    assert_eq!((bound.blocked_by, bound.end_s()), (None, 149.5));
    assert_limits(&bound, 67.5, 72.5, (-2.445, -0.3 - 0.4 - 1.055));
    let bound = on.bound(OWN);
    assert_eq!((bound.blocked_by, bound.end_s()), (Some(ObstacleId(2)), 68.0));
}

/// The side is that of the obstacle's middle, at first seen from the ego, with or without room there.
#[test]
fn greedy_sides_without_room() {
    let scene = Setup::fixed()
        .with(|setup| setup.road.sections[0].lane = Some((1.75, 5.0)))
        .parked(1, (53.2, 54.0), (-0.5, 0.3));
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.greedy_sides = true);
    assert_limits(&off.bound(OWN), 50.5, 56.0, (-3.945, -1.955));
    assert_eq!(on.bound(OWN).end_s(), 50.0);
}

/// Behind the rear axle, beside the rear bumper.
#[test]
fn forgets_beside_overhang() {
    let scene = Setup::fixed()
        .with(|setup| setup.road.sections[0].lane = Some((3.5, 3.5)))
        .parked(1, (45.0, 49.5), (1.6, 3.0));
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.forgets_beside_overhang = true);
    let bound = off.bound(OWN);
    assert_limits(&bound, 50.0, 51.5, (-2.445, 1.6 - 0.4 - 1.055));
    assert_limits(&bound, 52.0, 149.5, (-2.445, 2.445));
    assert_limits(&on.bound(OWN), 50.0, 149.5, (-2.445, 2.445));
}

#[test]
fn pad_through_blocker() {
    let scene = Setup::fixed().parked(1, (80.0, 84.0), (-0.6, 1.2));
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.pad_through_blocker = true);
    let (short, padded) = (off.bound(OWN), on.bound(OWN));
    assert_eq!((short.points.len(), short.padding), (55, 0));
    assert_eq!((padded.points.len(), padded.padding), (75, 20));
    assert_eq!(short.end_s(), padded.end_s());
    assert_eq!(padded.points[..55], short.points[..]);
    assert_limits(&padded, 77.5, 87.0, (-0.695, 0.695));
}

/// Near the horizon there is less to pad with.
#[test]
fn padding_ends_with_the_horizon() {
    let mut setup = Setup::fixed()
        .with(|setup| setup.config.quirks.pad_through_blocker = true)
        .parked(1, (150.0, 154.0), (-0.6, 1.2));
    let bound = setup.bound(OWN);
    assert_eq!((bound.points.len(), bound.padding), (200, 5));
}

#[test]
fn silent_blocker() {
    let blocked = |setup: Setup| setup.parked(1, (100.0, 104.0), (-3.0, 3.0));
    let pulling_over = blocked(Setup::fixed()).pulling_over(Some(90.0));
    let changing = blocked(Setup::fixed()).with(|setup| {
        setup.is_change_lane = true;
        setup.memory.change_lane.is_clear = true;
    });
    for (scene, label) in [(pulling_over, Label::PullOver), (changing, Label::LaneChange)] {
        let (mut off, mut on) = scene.without_and_with(|quirks| quirks.silent_blocker = true);
        assert_eq!(off.bound(label).blocked_by, Some(ObstacleId(1)), "{label}");
        assert_eq!(on.bound(label).blocked_by, None, "{label}");
    }
}

/// Something right beside the ego leaves the lane-change bound without a single station.
#[test]
fn lane_change_discards_fallback() {
    let scene = Setup::fixed()
        .with(|setup| setup.is_change_lane = true)
        .parked(1, (51.0, 55.0), (-6.0, 6.0));
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.lane_change_discards_fallback = true);
    let bounds = off.decide().unwrap().bounds;
    assert_eq!(bounds.len(), 1);
    assert_eq!(bounds[0].label, Label::Fallback);
    assert_eq!(on.decide(), Err(PathBoundsError::EmptyLaneChange));
}

/// The original checks after it has set the pull-over bound's left edge to the lane line, wherever the ego is.
#[test]
fn asserts_ego_inside() {
    let scene = Setup::fixed().pulling_over(Some(120.0)).with(|setup| {
        setup.ego.l = 2.0;
        setup.config.quirks.pull_over_overhang = true;
    });
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.asserts_ego_inside = true);
    let bound = off.bound(Label::PullOver);
    assert!(
        bound.points[0].l_max < 2.0,
        "the ego is outside, and that is no error"
    );
    assert_eq!(on.decide(), Err(PathBoundsError::EgoOutside(Label::PullOver)));
}

/// Issue 15435: nothing keeps the fallback from driving into a parked car.
#[test]
fn fallback_ignores_obstacles() {
    let scene = Setup::fixed().parked(1, (80.0, 84.0), (0.9, 2.0));
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.fallback_ignores_obstacles = true);
    // The fallback goes nearer than other bounds do.
    assert_limits(
        &off.bound(Label::Fallback),
        77.5,
        86.0,
        (-0.695, 0.9 - 0.15 - 1.055),
    );
    assert_limits(&on.bound(Label::Fallback), 77.5, 86.0, (-0.695, 0.695));

    let scene = Setup::fixed().parked(1, (80.0, 84.0), (-0.6, 1.2));
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.fallback_ignores_obstacles = true);
    let (ends, goes_on) = (off.bound(Label::Fallback), on.bound(Label::Fallback));
    assert_eq!((ends.blocked_by, ends.end_s()), (Some(ObstacleId(1)), 77.0));
    assert_eq!((goes_on.blocked_by, goes_on.end_s()), (None, 149.5));
}

/// An obstacle on the kerb pushes the corridor left of the line; seen by the size of `l` that is near the kerb.
#[test]
fn unsigned_road_edge() {
    let scene = Setup::fixed()
        .with(|setup| {
            setup.road.sections[0].lane = Some((5.0, 5.0));
            setup.road.sections[0].road = Some((5.0, 3.0));
            setup.ego.l = 2.5;
        })
        .parked(1, (45.0, 140.0), (-3.0, 0.5))
        .pulling_over(Some(125.0));
    let (mut off, mut on) = scene.without_and_with(|quirks| quirks.unsigned_road_edge = true);
    let refused = off.decide().unwrap();
    assert_eq!(
        refused.refusal,
        Some(crate::tasks::path_bounds::PullOverRefusal::NoPlace)
    );
    on.bound(Label::PullOver);
    let place = on.memory.pull_over.place.unwrap();
    let l = on.road.to_frenet(place.position).l;
    assert!(
        l > 1.9,
        "the original stands {:.2} m from the kerb",
        l - 1.055 + 3.0
    );
}

/// The side on which each obstacle is passed goes to the memory's form, for either sweep.
#[test]
fn both_sweeps_tell_the_sides() {
    for greedy in [false, true] {
        let mut setup = Setup::fixed()
            .with(|setup| {
                setup.road.sections[0].lane = Some((3.5, 3.5));
                setup.config.quirks.greedy_sides = greedy;
            })
            .parked(1, (70.0, 72.0), (1.0, 3.0))
            .parked(2, (90.0, 145.0), (-3.0, -1.0));
        let answer = setup.decide().unwrap();
        let place = answer.bounds.iter().position(|bound| bound.label == OWN).unwrap();
        let sides = [(ObstacleId(1), Side::Right), (ObstacleId(2), Side::Left)];
        assert_eq!(answer.passed[place], sides, "greedy: {greedy}");
    }
}

/// What was passed on one side stays there unless the other is clearly better; the original has no memory.
#[test]
fn sides_are_kept_from_tick_to_tick() {
    let scene = Setup::fixed()
        .with(|setup| setup.road.sections[0].lane = Some((6.0, 6.0)))
        .parked(1, (80.0, 82.0), (-0.3, 0.2));
    let right_of_it = at(&scene.clone().bound(OWN), 80.0);
    assert!(right_of_it.0 > 0.0, "left is nearer: {right_of_it:?}");
    let mut latched = scene.with(|setup| setup.memory.passed = vec![(ObstacleId(1), Side::Right)]);
    assert!(at(&latched.bound(OWN), 80.0).1 < 0.0, "right was chosen before");
    let mut far = latched.with(|setup| setup.obstacles[0].start_l = -2.3);
    assert!(at(&far.bound(OWN), 80.0).0 > 0.0, "now left is much nearer");
}
