//! Whether the car can turn in to a place at the edge of the road, in the time of two arcs of opposite bend.
//!
//! The car comes along the left limit of its corridor, turns right and then left, and stands straight. Over a
//! distance `d` one arc of radius `R` moves it aside by `R − √(R² − d²)`; both share the room that there is. An ego
//! that turns in already starts with its heading. Frame: the reference line, bends of the line left out.

use super::bound::BoundPoint;
use super::input::{EgoFrenet, Input};

/// How much of the tightest turn an arc may stand for. A smooth path (a quintic) of the same length and shift
/// bends 5.77 / 4 times as much at its worst as the two arcs do, and a path may use 0.95 of the steering.
const SMOOTH_SHARE: f64 = 0.95 * 4.0 / 5.77;

/// How far before its place a car stands straight, m.
const STRAIGHTEN: f64 = 2.0;

/// Way before the place that is looked at for turning in, m: enough for any lane width.
const TURN_IN_LENGTH: f64 = 20.0;

/// Whether the car can come to the place `l` at station number `index` inside `bound`, from where the ego is.
pub(super) fn is_possible(bound: &[BoundPoint], input: &Input, index: usize, l: f64) -> bool {
    let radius = input.vehicle.min_turn_radius / SMOOTH_SHARE;
    let before = |s: f64| (bound[index].s - s - STRAIGHTEN).max(0.0);
    let ego = input.ego;
    if ego.l - l > shift_of_ego(radius, ego, before(ego.s)) {
        return false;
    }
    let way = |point: &&BoundPoint| bound[index].s - point.s <= TURN_IN_LENGTH;
    let near = || bound[..index].iter().rev().take_while(way);
    // An ego this near cannot come from farther left than it is.
    let start = if bound[index].s - ego.s <= TURN_IN_LENGTH {
        ego.l
    } else {
        f64::MAX
    };
    let leftmost = near().map(|point| point.l_max).fold(start, f64::min);
    let room = leftmost - l;
    near().all(|point| point.l_min <= l + offset_before(radius, room, before(point.s)))
}

/// How far aside an arc leads from straight on over the distance `d`, m.
fn arc(radius: f64, d: f64) -> f64 {
    let d = d.clamp(0.0, radius);
    radius - (radius * radius - d * d).sqrt()
}

/// How far left of its place a car may be, `d` before it, that comes from `room` farther left by two equal arcs.
fn offset_before(radius: f64, room: f64, d: f64) -> f64 {
    let room = room.clamp(0.0, 2.0 * radius);
    let half = room / 2.0;
    let length = (half * (2.0 * radius - half)).sqrt();
    if d <= length {
        arc(radius, d)
    } else {
        room - arc(radius, 2.0 * length - d)
    }
}

/// How far to the right the ego gets over the distance `d`, from its heading `ψ` to straight: an arc to the right
/// from `ψ` to `−φ` and one back, `d = R (sin ψ + 2 sin φ)`, the shift `R (cos ψ + 1 − 2 cos φ)`.
fn shift_of_ego(radius: f64, ego: EgoFrenet, d: f64) -> f64 {
    let speed = (ego.s_dot * ego.s_dot + ego.l_dot * ego.l_dot).sqrt();
    let (sin_psi, cos_psi) = if ego.s_dot > 0.0 {
        (ego.l_dot / speed, ego.s_dot / speed)
    } else {
        (0.0, 1.0)
    };
    // Straight before it could turn right at all: it drifts left.
    let sin_phi = ((d / radius - sin_psi) / 2.0).clamp(0.0, 1.0);
    let cos_phi = (1.0 - sin_phi * sin_phi).sqrt();
    radius * (cos_psi + 1.0 - 2.0 * cos_phi)
}

#[cfg(test)]
mod tests {
    use super::*;

    const RADIUS: f64 = 8.0;

    /// The two arcs followed in small steps.
    fn driven(psi: f64, d: f64) -> f64 {
        let phi = libm::asin((d / RADIUS - libm::sin(psi)) / 2.0);
        let (steps, mut shift) = (200_000, 0.0);
        for (from, to) in [(psi, -phi), (-phi, 0.0)] {
            let step: f64 = (to - from) / f64::from(steps);
            for k in 0..steps {
                let theta = from + (f64::from(k) + 0.5) * step;
                shift -= libm::sin(theta) * RADIUS * step.abs();
            }
        }
        shift
    }

    #[test]
    fn the_ego_gets_as_far_aside_as_its_arcs_lead() {
        for (psi, d) in [(0.0, 6.0), (0.0, 12.0), (-0.2, 6.0), (0.2, 8.0)] {
            let ego = EgoFrenet {
                s: 0.0,
                s_dot: 5.0 * libm::cos(psi),
                l: 0.0,
                l_dot: 5.0 * libm::sin(psi),
            };
            let shift = shift_of_ego(RADIUS, ego, d);
            assert!((shift - driven(psi, d)).abs() < 1e-6, "{psi} {d}: {shift}");
        }
    }

    #[test]
    fn both_arcs_share_the_room() {
        // 3 m of room: each arc makes 1.5 m over sqrt(1.5 * 14.5) = 4.664 m.
        let offset = |d| offset_before(RADIUS, 3.0, d);
        assert_eq!(offset(0.0), 0.0);
        assert!((offset(4.663_689) - 1.5).abs() < 1e-5);
        assert!((offset(2.0 * 4.663_689 - 2.0) - (3.0 - offset(2.0))).abs() < 1e-5);
        assert_eq!(offset(12.0), 3.0);
        // Less room on the left takes longer: the same offset is reached farther from the place.
        assert!(offset_before(RADIUS, 1.0, 3.5) < offset(3.5));
        assert_eq!(offset_before(RADIUS, -1.0, 3.5), 0.0);
    }
}
