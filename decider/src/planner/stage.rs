//! The stage: tasks run in the order of a list, up to the first that fails.

use super::plan::LinePlan;
use super::probe::Probe;
use super::task::{Part, TaskError, TaskName};
use crate::context::Context;
use crate::decision::TaskReport;
use crate::steps;

/// The tasks of lane following, in the original's order.
pub const LANE_FOLLOW: [TaskName; 14] = [
    TaskName::LaneChange,
    TaskName::PathReuse,
    TaskName::LaneBorrow,
    TaskName::PathBounds,
    TaskName::PiecewiseJerkPath,
    TaskName::PathAssessment,
    TaskName::PathDecider,
    TaskName::RuleBasedStop,
    TaskName::SpeedBoundsPriori,
    TaskName::SpeedHeuristic,
    TaskName::SpeedDecider,
    TaskName::SpeedBoundsFinal,
    TaskName::PiecewiseJerkSpeed,
    TaskName::Rss,
];

/// Runs tasks in order. The probe says which of them are to fail, whatever they would find.
///
/// # Errors
/// The first task that failed, and why; those after it have not run.
pub(super) fn run(
    tasks: &[TaskName],
    plan: &mut LinePlan,
    context: &mut Context,
    probe: &mut dyn Probe,
) -> Result<(), (TaskName, TaskError)> {
    for task in tasks {
        steps::count();
        let input = task.input(plan);
        probe.begins(*task);
        let result = if probe.fails(Part::Task(*task)) {
            Err(TaskError::OnRequest)
        } else {
            task.run()(plan, context)
        };
        probe.ended(*task);
        if result.is_ok() {
            probe.hands_on(*task, plan);
        }
        plan.reports.push(TaskReport {
            task: *task,
            input,
            output: task.output(plan),
            error: result.err().map(|error| error.to_string()),
        });
        result.map_err(|error| (*task, error))?;
    }
    Ok(())
}
