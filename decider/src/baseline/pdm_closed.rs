//! The best of fifteen drives: five speeds by three offsets, each simulated and scored.

use super::rollout::{Proposal, Rollout};
use super::score::{Assessment, assess};
use super::traffic::Traffic;
use super::{Driven, Scene};

/// Shares of the desired speed, the one that is preferred among equals first.
pub const SPEEDS: [f64; 5] = [1.0, 0.8, 0.6, 0.4, 0.2];

/// Offsets from the line, m, the one that is preferred among equals first.
pub const OFFSETS: [f64; 3] = [0.0, -1.0, 1.0];

/// A collision sooner than this is met with the brakes alone, s.
pub const EMERGENCY: f64 = 2.0;

/// The best drive; full braking along it where even that touches something soon.
pub(super) fn best_proposal(scene: &Scene, traffic: &Traffic) -> Driven {
    let proposals = OFFSETS
        .into_iter()
        .flat_map(|offset| SPEEDS.map(|share| Proposal { offset, share }));
    let assessed: Vec<(Rollout, Assessment)> = proposals
        .map(|proposal| {
            let rollout = Rollout::new(scene, traffic, proposal);
            let assessment = assess(scene, traffic, &rollout);
            (rollout, assessment)
        })
        .collect();
    let possible = assessed.iter().filter(|(_, of_it)| of_it.is_possible());
    let farthest = possible.map(|(_, of_it)| of_it.progress).fold(0.0, f64::max);
    // Where nothing is possible all scores are 0: then what touches something last is best.
    let worth = |of_it: &Assessment| (of_it.score(farthest), of_it.collision.unwrap_or(f64::MAX));
    let mut drives = assessed.into_iter();
    let first = drives.next().expect("there are proposals");
    let (best, of_it) = drives.fold(first, |best, next| {
        if worth(&next.1) > worth(&best.1) {
            next
        } else {
            best
        }
    });
    let is_emergency = of_it.collision.is_some_and(|t| t < EMERGENCY);
    Driven {
        rollout: if is_emergency {
            best.braking_hardest(scene)
        } else {
            best
        },
        is_emergency,
    }
}
