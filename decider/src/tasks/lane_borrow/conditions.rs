//! Whether what blocks the own lane may be passed through another one at all: not close before a junction, and not
//! where the car is going anyway.
//!
//! The original asks for signals and stop lines and never reaches its question about junctions; the lines here know
//! junctions only, so that is what is asked. Its question about queues has its answer already: only what is parked
//! blocks a lane, who only waits is followed.

use super::BorrowState;
use crate::frame::Command;
use crate::reference_line::LineQuery;
use crate::tasks::path_bounds::ObstacleSl;
use crate::tasks::scene::Scene;

/// Whether all of that holds of the blocker; of one without a name nothing is known that speaks against it.
pub(super) fn may_be_passed(scene: &Scene, state: &BorrowState) -> bool {
    let Some(blocker) = state.blocker.and_then(|id| scene.obstacle(id)) else {
        return true;
    };
    is_far_from_junction(scene, blocker) && blocker.start_s <= destination(scene)
}

fn is_far_from_junction(scene: &Scene, blocker: &ObstacleSl) -> bool {
    let half = 0.5 * scene.config.lane_borrow.junction_clearance_distance;
    !scene.line.near_junction(blocker.end_s + half, half)
}

/// Station at which the drive ends, m.
fn destination(scene: &Scene) -> f64 {
    match scene.frame.command {
        Command::PullOver(place) => scene.line.to_frenet(place).s,
        Command::Cruise | Command::ChangeLane(_) | Command::EmergencyPullOver => scene.line.length(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vec2;
    use crate::tasks::testing::Stage;

    /// Whether a car from 48 to 52 m may be passed.
    fn passes(junction_from: f64, command: Command) -> bool {
        let mut stage = Stage::new(200.0, junction_from);
        stage.frame.command = command;
        let blocker = Some(stage.park(50.0));
        let state = BorrowState {
            blocker,
            ..BorrowState::default()
        };
        may_be_passed(&stage.scene(), &state)
    }

    #[test]
    fn what_stands_close_before_a_junction_is_not_passed() {
        assert!(passes(f64::MAX, Command::Cruise));
        assert!(passes(68.0, Command::Cruise));
        assert!(!passes(66.0, Command::Cruise));
        assert!(!passes(40.0, Command::Cruise), "nor what stands in one");
    }

    #[test]
    fn what_stands_beyond_the_destination_is_not_passed() {
        let to = |s: f64| Command::PullOver(Vec2::new(s, -1.0));
        assert!(passes(f64::MAX, to(60.0)));
        assert!(!passes(f64::MAX, to(45.0)));
    }

    #[test]
    fn of_a_blocker_without_a_name_nothing_is_known() {
        let stage = Stage::new(200.0, 0.0);
        assert!(may_be_passed(&stage.scene(), &BorrowState::default()));
    }
}
