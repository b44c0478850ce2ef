//! The door of a parked car: a thin body that swings out around its hinge.

use crate::scenario::Waypoint;
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2, angle};
use corridor_decider::road::Side;

/// Length of a front door, m.
pub(super) const LENGTH: f64 = 1.1;

/// Hinge of a front door ahead of a car's centre, m.
pub(super) const HINGE: f64 = 0.8;

/// Thickness of a door, m.
const THICKNESS: f64 = 0.06;

/// From the side of the car to the middle of the closed door, m: bodies must not be in each other.
const BESIDE: f64 = 0.04;

/// Straight legs in which it opens: over 20° each, the chord is within half a centimetre of the arc.
const LEGS: u32 = 4;

/// A door on its hinge.
pub(super) struct Hung {
    /// Pose of the car's centre.
    pub(super) car: Pose,
    pub(super) side: Side,
    /// Place of the hinge ahead of the car's centre, m.
    pub(super) hinge: f64,
    /// From the car's centre to its side, m.
    pub(super) beside: f64,
    pub(super) length: f64,
}

impl Hung {
    /// The outline around its middle.
    pub(super) fn shape(&self) -> ConvexPolygon {
        let half = self.length / 2.0;
        ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), half, half, THICKNESS / 2.0)
    }

    /// Its middle, opened by `open` rad: the free end points backwards when closed, and swings outwards.
    fn pose(&self, open: f64) -> Pose {
        let out = match self.side {
            Side::Left => 1.0,
            Side::Right => -1.0,
        };
        let (sin, cos) = angle::sin_cos(open);
        let half = self.length / 2.0;
        let middle = Vec2::new(self.hinge - half * cos, out * (self.beside + BESIDE + half * sin));
        let at = self.car.to_world(middle);
        Pose::new(at.x, at.y, angle::wrap(self.car.theta - out * open))
    }

    /// Where it is on its way to `open` rad, which takes `duration` seconds; and on its way back, if it stays there for
    /// so long only.
    pub(super) fn swing(&self, open: f64, duration: f64, stays: Option<f64>) -> Vec<Waypoint> {
        let share = |k| f64::from(k) / f64::from(LEGS);
        let at = |k| Waypoint {
            t: duration * share(k),
            pose: self.pose(open * share(k)),
        };
        let back = stays.into_iter().flat_map(|stays| {
            let closing = (0..=LEGS).rev();
            closing.map(move |k| Waypoint {
                t: duration + stays + duration * share(LEGS - k),
                ..at(k)
            })
        });
        (0..=LEGS).map(at).chain(back).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hinge_stays_where_it_is_and_the_free_end_swings_out() {
        for (side, out) in [(Side::Left, 1.0), (Side::Right, -1.0)] {
            let door = Hung {
                car: Pose::new(10.0, 5.0, 0.0),
                side,
                hinge: 0.8,
                beside: 0.9,
                length: 1.0,
            };
            let swing = door.swing(1.2, 2.0, Some(3.0));
            let times: Vec<f64> = swing.iter().map(|waypoint| waypoint.t).collect();
            assert_eq!(times, [0.0, 0.5, 1.0, 1.5, 2.0, 5.0, 5.5, 6.0, 6.5, 7.0]);
            assert_eq!(swing[5].pose, swing[4].pose);
            assert_eq!(
                (swing[9].pose, door.swing(1.2, 2.0, None).len()),
                (swing[0].pose, 5)
            );
            assert!(swing[0].t.abs() < 1e-12 && (swing[4].t - 2.0).abs() < 1e-12);
            let end = |waypoint: &Waypoint, x: f64| waypoint.pose.to_world(Vec2::new(x, 0.0));
            for waypoint in &swing {
                let hinge = end(waypoint, 0.5);
                assert!(
                    (hinge - Vec2::new(10.8, 5.0 + out * 0.94)).norm() < 1e-12,
                    "{hinge}"
                );
            }
            // Closed it lies along the car; open by 1.2 rad its end is cos and sin of that from the hinge.
            assert!((end(&swing[0], -0.5) - Vec2::new(9.8, 5.0 + out * 0.94)).norm() < 1e-12);
            let open = Vec2::new(10.8 - libm::cos(1.2), 5.0 + out * (0.94 + libm::sin(1.2)));
            assert!((end(&swing[4], -0.5) - open).norm() < 1e-12);
        }
    }
}
