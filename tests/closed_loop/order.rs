//! The order in which a scenario lists its obstacles means nothing.

use crate::support::{scenario, settings};
use corridor_decider::frame::{EgoState, ObstacleId};
use corridor_scenarios::Scenario;
use corridor_sim::closed_loop::Sink;
use corridor_sim::run::run_into;
use corridor_sim::trace::{TickRecord, TraceError};
use corridor_sim::verdict::Ending;

/// Keeps how the ego moved.
#[derive(Default)]
struct Motion(Vec<EgoState>);

impl Sink for Motion {
    fn tick(&mut self, tick: &TickRecord) -> Result<(), TraceError> {
        self.0.push(tick.ego);
        Ok(())
    }
}

fn drive(scenario: &Scenario, planner: &str) -> (Vec<EgoState>, Ending) {
    let mut motion = Motion::default();
    let verdict = run_into(scenario, &settings(&[planner]), &mut motion).unwrap();
    (motion.0, verdict.ending)
}

#[test]
fn obstacles_in_another_order_change_nothing() {
    check("decider.planner=lane_follow");
}

#[test]
fn nor_do_they_under_the_lattice_planner() {
    check("decider.planner=lattice");
}

fn check(planner: &str) {
    let names = [
        "nudge_several",
        "parked_row",
        "cone_taper",
        "pull_over_between_parked",
        "borrow_with_oncoming",
        "borrow_with_column",
    ];
    for name in names {
        let listed = scenario(name);
        let count = listed.obstacles.len();
        assert!(count > 1, "{name}");
        let expected = drive(&listed, planner);
        for turn in [1, count / 2] {
            let mut turned = listed.clone();
            turned.obstacles.reverse();
            turned.obstacles.rotate_left(turn);
            for (id, obstacle) in (0..).zip(&mut turned.obstacles) {
                obstacle.id = ObstacleId(id);
            }
            assert!(
                drive(&turned, planner) == expected,
                "{name}, reversed and turned by {turn}"
            );
        }
    }
}
