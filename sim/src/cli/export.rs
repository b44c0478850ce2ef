//! `corridor run --solution` and `--with-ego`: a drive on a CommonRoad scenario for CommonRoad's own tools.

use super::output;
use anyhow::Context;
use clap::Args;
use corridor_decider::frame::EgoState;
use corridor_scenarios::import::commonroad::{self, DrivenState};
use corridor_scenarios::{Family, Scenario};
use corridor_sim::trace::Trace;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct Export {
    /// Write the drive as a solution of the CommonRoad benchmark to this file; only for CommonRoad scenarios.
    #[arg(long, value_name = "FILE")]
    solution: Option<PathBuf>,
    /// Write the scenario with the drive as one more obstacle to this file; only for CommonRoad scenarios.
    #[arg(long, value_name = "FILE")]
    with_ego: Option<PathBuf>,
}

impl Export {
    /// Whether anything is to be written.
    pub(crate) fn is_wanted(&self) -> bool {
        self.solution.is_some() || self.with_ego.is_some()
    }

    /// Makes sure, before the run, that there will be something to write and a place for it.
    pub(crate) fn check(&self, family: &Family) -> anyhow::Result<()> {
        for path in self.solution.iter().chain(&self.with_ego) {
            output::check(path)?;
        }
        anyhow::ensure!(
            !self.is_wanted() || commonroad::is_commonroad(family.source()),
            "`{}` is no CommonRoad scenario: `--solution` and `--with-ego` are for those",
            family.name()
        );
        Ok(())
    }

    /// Writes what is wanted of a finished run.
    pub(crate) fn write(&self, family: &Family, scenario: &Scenario, trace: &Trace) -> anyhow::Result<()> {
        let read = commonroad::read(family.source())?;
        let problem = read
            .problem_of_seed(scenario.seed)
            .context("the file has no planning problem: there is nothing to solve")?;
        let drive = drive(scenario, trace);
        if let Some(path) = &self.solution {
            output::write(path, &read.solution(problem, &drive, &scenario.vehicle))?;
        }
        if let Some(path) = &self.with_ego {
            let (text, _) = read.with_ego(family.source(), problem, &drive, &scenario.vehicle);
            output::write(path, &text)?;
        }
        Ok(())
    }
}

/// The ego at the start and at the end of every tick; of the last one, at the end of the run.
fn drive(scenario: &Scenario, trace: &Trace) -> Vec<DrivenState> {
    let start = DrivenState {
        t: 0.0,
        ego: EgoState {
            pose: scenario.ego.pose,
            v: scenario.ego.speed,
            a: 0.0,
            yaw_rate: 0.0,
            steer: 0.0,
        },
    };
    let end = trace
        .verdict
        .as_ref()
        .map_or(f64::INFINITY, |verdict| verdict.duration);
    let ticks = trace.ticks.iter().map(|tick| DrivenState {
        t: (tick.frame.time + trace.header.tick).min(end),
        ego: tick.ego,
    });
    std::iter::once(start).chain(ticks).collect()
}
