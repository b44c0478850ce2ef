//! Other lists of tasks drive too.

use crate::support::scenario;
use corridor_decider::planner::{LANE_FOLLOW, TaskName};
use corridor_sim::run::run;
use corridor_sim::settings::Settings;
use corridor_sim::verdict::Verdict;

/// A run with one task in the place of another.
fn with(name: &str, old: TaskName, new: TaskName) -> Verdict {
    let mut settings = Settings::default();
    let replaced = LANE_FOLLOW.map(|task| if task == old { new } else { task });
    settings.decider.tasks = replaced.to_vec();
    run(&scenario(name), &settings)
}

#[test]
fn sampled_paths_drive() {
    for name in [
        "nudge_parked_car",
        "blocked_borrow",
        "curve_parked_car",
        "lane_change_left",
    ] {
        let verdict = with(name, TaskName::PiecewiseJerkPath, TaskName::SampledPath);
        assert!(verdict.pass, "{name}: {}", verdict.summary);
    }
}

#[test]
fn the_nonlinear_speed_drives_too() {
    let old = TaskName::PiecewiseJerkSpeed;
    for name in [
        "nudge_parked_car",
        "curve_parked_car",
        "slow_leader",
        "pull_over_empty_kerb",
    ] {
        let verdict = with(name, old, TaskName::PiecewiseJerkNonlinearSpeed);
        assert!(verdict.pass, "{name}: {}", verdict.summary);
    }
    let digest = |new| with("curve_empty", old, new).digest;
    assert_ne!(
        digest(old),
        digest(TaskName::PiecewiseJerkNonlinearSpeed),
        "it reads the bends elsewhere"
    );
}

#[test]
fn a_stage_without_a_task_falls_back_and_says_so() {
    let mut settings = Settings::default();
    settings
        .decider
        .tasks
        .retain(|task| *task != TaskName::PathBounds);
    let verdict = run(&scenario("nudge_parked_car"), &settings);
    assert!(
        !verdict.pass && !verdict.fallbacks.is_empty(),
        "{}",
        verdict.summary
    );
    assert!(verdict.collisions.is_empty(), "{}", verdict.summary);
}
