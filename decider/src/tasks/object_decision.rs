//! What is decided about one obstacle: one longitudinal and one lateral decision, each merged from all that tasks ask
//! for.
//!
//! The ranks are the original's (`Obstacle::MergeLongitudinalDecision`, `MergeLateralDecision`): the safer decision
//! wins, of two equal ones the one that keeps the larger distance.

use serde::{Deserialize, Serialize};

/// Where a decision about an obstacle puts its fence.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fence {
    /// Distance from the obstacle, m: negative before it, positive behind it.
    pub distance: f64,
    /// Station on the reference line, m.
    pub s: f64,
}

/// How the ego moves along the path with regard to an obstacle, by ascending rank.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Longitudinal {
    /// As if it were not there.
    Ignore,
    /// Before it.
    Overtake(Fence),
    /// Behind it, at its pace.
    Follow(Fence),
    /// After it.
    Yield(Fence),
    /// Not past the fence.
    Stop(Fence),
}

impl Longitudinal {
    const fn rank(self) -> u8 {
        match self {
            Self::Ignore => 0,
            Self::Overtake(_) => 1,
            Self::Follow(_) => 2,
            Self::Yield(_) => 3,
            Self::Stop(_) => 4,
        }
    }

    /// The fence, for a decision that has one.
    pub const fn fence(self) -> Option<Fence> {
        match self {
            Self::Ignore => None,
            Self::Overtake(fence) | Self::Follow(fence) | Self::Yield(fence) | Self::Stop(fence) => {
                Some(fence)
            }
        }
    }

    /// Whether this is a stop.
    pub const fn is_stop(self) -> bool {
        matches!(self, Self::Stop(_))
    }

    /// The decision that does justice to both; `self` where they are alike.
    #[must_use]
    pub fn merge(self, other: Self) -> Self {
        if self.rank() != other.rank() {
            return if self.rank() > other.rank() { self } else { other };
        }
        let distance = |decision: Self| decision.fence().map_or(0.0, |fence| fence.distance);
        let other_keeps_more = match self {
            Self::Overtake(_) => distance(other) > distance(self),
            _ => distance(other) < distance(self),
        };
        if other_keeps_more { other } else { self }
    }
}

/// How the path passes an obstacle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Lateral {
    /// As if it were not there.
    Ignore,
    /// At a distance, m: positive to the left of it, negative to the right.
    Nudge(f64),
}

impl Lateral {
    /// The decision that does justice to both; `self` where they are alike.
    #[must_use]
    pub fn merge(self, other: Self) -> Self {
        match (self, other) {
            (Self::Nudge(a), Self::Nudge(b)) if b.abs() > a.abs() => other,
            (Self::Ignore, Self::Nudge(_)) => other,
            _ => self,
        }
    }
}

/// All that is decided about one obstacle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ObjectDecision {
    /// Along the path; none yet where absent.
    pub longitudinal: Option<Longitudinal>,
    /// Across it; none yet where absent.
    pub lateral: Option<Lateral>,
}

impl ObjectDecision {
    /// Both ignored.
    pub const IGNORED: Self = Self {
        longitudinal: Some(Longitudinal::Ignore),
        lateral: Some(Lateral::Ignore),
    };

    /// Merges a longitudinal decision into this.
    pub fn add_longitudinal(&mut self, decision: Longitudinal) {
        self.longitudinal = Some(self.longitudinal.map_or(decision, |own| own.merge(decision)));
    }

    /// Merges a lateral decision into this.
    pub fn add_lateral(&mut self, decision: Lateral) {
        self.lateral = Some(self.lateral.map_or(decision, |own| own.merge(decision)));
    }

    /// Ignores what nothing has been decided about.
    pub fn ignore_the_rest(&mut self) {
        self.longitudinal.get_or_insert(Longitudinal::Ignore);
        self.lateral.get_or_insert(Lateral::Ignore);
    }

    /// Whether neither direction minds the obstacle.
    pub fn is_ignored(&self) -> bool {
        *self == Self::IGNORED
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fence(distance: f64) -> Fence {
        Fence { distance, s: 0.0 }
    }

    #[test]
    fn the_safer_decision_wins_and_of_equal_ones_the_larger_distance() {
        let ranked = [
            Longitudinal::Ignore,
            Longitudinal::Overtake(fence(10.0)),
            Longitudinal::Follow(fence(-3.0)),
            Longitudinal::Yield(fence(-5.0)),
            Longitudinal::Stop(fence(-6.0)),
        ];
        for (i, a) in ranked.iter().enumerate() {
            for (k, b) in ranked.iter().enumerate() {
                assert_eq!(a.merge(*b), ranked[i.max(k)]);
            }
        }
        let (near, far) = (Longitudinal::Stop(fence(-6.0)), Longitudinal::Stop(fence(-8.0)));
        assert_eq!((near.merge(far), far.merge(near)), (far, far));
        let (less, more) = (
            Longitudinal::Overtake(fence(10.0)),
            Longitudinal::Overtake(fence(20.0)),
        );
        assert_eq!((less.merge(more), more.merge(less)), (more, more));
        assert_eq!(
            Lateral::Nudge(0.3).merge(Lateral::Nudge(-0.5)),
            Lateral::Nudge(-0.5)
        );
        assert_eq!(Lateral::Nudge(0.3).merge(Lateral::Ignore), Lateral::Nudge(0.3));
        assert_eq!(Lateral::Ignore.merge(Lateral::Nudge(0.3)), Lateral::Nudge(0.3));
    }

    #[test]
    fn what_is_undecided_can_be_ignored_and_what_is_decided_stays() {
        let mut decision = ObjectDecision::default();
        decision.add_longitudinal(Longitudinal::Stop(fence(-6.0)));
        decision.ignore_the_rest();
        assert_eq!(decision.longitudinal, Some(Longitudinal::Stop(fence(-6.0))));
        assert_eq!(decision.lateral, Some(Lateral::Ignore));
        assert!(!decision.is_ignored() && ObjectDecision::IGNORED.is_ignored());
    }
}
