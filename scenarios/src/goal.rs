//! Where and how a run should end: regions of place, heading, speed and time, any one of which will do.
//!
//! World axes, SI units, seconds since the start of the run. What is asked of is the middle of the ego's body, as
//! CommonRoad has it.

use corridor_decider::geometry::{Pose, Vec2, angle, cross};
use serde::{Deserialize, Serialize};

/// Rounding in files must not decide who is inside, m, rad, m/s and s alike.
const TOLERANCE: f64 = 1e-6;

/// How far from a whole time step counts as on it, s: half the physics step, so that there always is one.
const ON_STEP: f64 = 0.005;

/// Several goals, any one of which will do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GoalRegion {
    /// Time between two moments that count, s: the first is the start of the run.
    pub time_step: f64,
    /// The goals.
    pub alternatives: Vec<GoalState>,
}

/// A goal: all that is given must hold at one moment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GoalState {
    /// First and last moment, s.
    pub time: (f64, f64),
    /// Where: any of these; empty: anywhere.
    pub areas: Vec<GoalArea>,
    /// Least and largest heading, rad, counter-clockwise from the first to the second.
    pub heading: Option<(f64, f64)>,
    /// Least and largest speed along the heading, m/s.
    pub speed: Option<(f64, f64)>,
}

/// A part of the plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GoalArea {
    /// A polygon, convex or not.
    Polygon(Vec<Vec2>),
    /// A circle.
    Circle {
        /// Its centre.
        center: Vec2,
        /// Its radius, m.
        radius: f64,
    },
}

impl GoalRegion {
    /// Whether one of the goals is met by a body with its middle at `center`, moving at `speed`, at `time`.
    pub fn is_met(&self, time: f64, center: Pose, speed: f64) -> bool {
        let step = (time / self.time_step).round() * self.time_step;
        if (time - step).abs() > ON_STEP + TOLERANCE {
            return false;
        }
        let time = step;
        self.alternatives
            .iter()
            .any(|goal| goal.is_met(time, center, speed))
    }

    /// The last moment at which a goal can be met, s.
    pub fn latest(&self) -> f64 {
        let times = self.alternatives.iter().map(|goal| goal.time.1);
        times.fold(0.0, f64::max)
    }
}

impl GoalState {
    fn is_met(&self, time: f64, center: Pose, speed: f64) -> bool {
        let is_within =
            |value: f64, (low, high): (f64, f64)| value >= low - TOLERANCE && value <= high + TOLERANCE;
        is_within(time, self.time)
            && self.speed.is_none_or(|range| is_within(speed, range))
            && self
                .heading
                .is_none_or(|range| is_turned_into(center.theta, range))
            && self.is_in_place(center.position())
    }

    /// Whether `point` is where the goal asks for.
    pub fn is_in_place(&self, point: Vec2) -> bool {
        self.areas.is_empty() || self.areas.iter().any(|area| area.contains(point))
    }
}

/// Whether a heading lies in the turn from `low` on to `high`.
fn is_turned_into(theta: f64, (low, high): (f64, f64)) -> bool {
    let middle = low + (high - low) / 2.0;
    angle::difference(theta, middle).abs() <= (high - low) / 2.0 + TOLERANCE
}

impl GoalArea {
    /// Whether `point` lies inside; of a polygon that crosses itself, where a ray to infinity meets its outline an
    /// odd number of times.
    pub fn contains(&self, point: Vec2) -> bool {
        match self {
            Self::Circle { center, radius } => (point - center).norm() <= radius + TOLERANCE,
            Self::Polygon(corners) => {
                let edges = corners.iter().zip(corners.iter().cycle().skip(1));
                let is_met = |(a, b): &(&Vec2, &Vec2)| {
                    let is_between = (a.y > point.y) != (b.y > point.y);
                    is_between && ((cross(*b - *a, point - *a) > 0.0) == (b.y > a.y))
                };
                edges.filter(is_met).count() % 2 == 1
            }
        }
    }

    /// A point to head for: the middle of its corners or its centre.
    pub fn middle(&self) -> Vec2 {
        match self {
            Self::Circle { center, .. } => *center,
            Self::Polygon(corners) => corners.iter().sum::<Vec2>() / (corners.len().max(1) as f64),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn goal() -> GoalState {
        GoalState {
            time: (1.0, 2.0),
            areas: Vec::new(),
            heading: None,
            speed: None,
        }
    }

    fn is_met(goal: GoalState, time: f64, center: Pose, speed: f64) -> bool {
        let region = GoalRegion {
            time_step: 0.1,
            alternatives: vec![goal],
        };
        region.is_met(time, center, speed)
    }

    /// A U open to the top: its notch is outside. The oracle knows the three bars that it is made of.
    #[test]
    fn a_polygon_need_not_be_convex() {
        let corners = [
            (0.0, 0.0),
            (6.0, 0.0),
            (6.0, 4.0),
            (4.0, 4.0),
            (4.0, 1.0),
            (2.0, 1.0),
            (2.0, 4.0),
            (0.0, 4.0),
        ];
        let corners: Vec<Vec2> = corners.iter().map(|(x, y)| Vec2::new(*x, *y)).collect();
        let turned = corners.iter().rev().copied().collect();
        for area in [GoalArea::Polygon(corners), GoalArea::Polygon(turned)] {
            for k in 0..800 {
                let point = Vec2::new(f64::from(k % 40) * 0.2 - 0.9, f64::from(k / 40) * 0.3 - 0.8);
                let within = |low: f64, value: f64, high: f64| value > low && value < high;
                let inside = within(0.0, point.y, 4.0)
                    && (within(0.0, point.x, 2.0)
                        || within(4.0, point.x, 6.0)
                        || within(0.0, point.x, 6.0) && point.y < 1.0);
                assert_eq!(area.contains(point), inside, "{point}");
            }
        }
    }

    #[test]
    fn only_whole_steps_count_and_each_has_a_moment() {
        let region = GoalRegion {
            time_step: 0.033,
            alternatives: vec![goal()],
        };
        let met = |k: u32| region.is_met(f64::from(k) * 0.01, Pose::new(0.0, 0.0, 0.0), 0.0);
        // 31 and 60 are the first and last step within the second from 1 to 2.
        let moments: Vec<u32> = (0..300).filter(|k| met(*k)).collect();
        assert_eq!(
            (moments.first(), moments.last()),
            (Some(&102), Some(&198)),
            "{moments:?}"
        );
        assert!(!met(104) && met(105) || met(106), "{moments:?}");
        // Thirty steps; one halfway between two moments has both.
        assert!((30..=33).contains(&moments.len()), "{moments:?}");
    }

    #[test]
    fn headings_are_compared_around_the_circle() {
        let goal = |low, high| GoalState {
            heading: Some((low, high)),
            ..goal()
        };
        let heads = |goal, theta| is_met(goal, 1.5, Pose::new(0.0, 0.0, theta), 0.0);
        assert!(heads(goal(3.0, 3.4), -3.0) && !heads(goal(3.0, 3.4), -2.8));
        assert!(heads(goal(-7.0, -5.5), 0.2) && !heads(goal(-7.0, -5.5), 1.0));
        assert!(heads(goal(-PI, PI), 2.0));
    }

    #[test]
    fn all_of_one_goal_or_all_of_another_must_hold_at_once() {
        let circle = |x: f64| {
            vec![GoalArea::Circle {
                center: Vec2::new(x, 0.0),
                radius: 1.0,
            }]
        };
        let slow = GoalState {
            areas: circle(0.0),
            speed: Some((0.0, 2.0)),
            ..goal()
        };
        let late = GoalState {
            time: (5.0, 5.0),
            areas: circle(10.0),
            ..goal()
        };
        let region = GoalRegion {
            time_step: 0.1,
            alternatives: vec![slow, late],
        };
        let at = |x| Pose::new(x, 0.0, 0.0);
        assert!(region.is_met(1.0, at(0.9), 2.0));
        assert!(!region.is_met(1.0, at(0.9), 2.1), "too fast");
        assert!(!region.is_met(1.0, at(10.0), 1.0), "at the place of the other");
        assert!(region.is_met(5.0, at(10.0), 9.0));
        assert!((region.latest() - 5.0).abs() < 1e-12);
    }
}
