//! `corridor sweep`: many runs, one report.

mod compare;
mod shard;
mod until;

use super::outputs::Outputs;
use super::planner::{self, PlannerChoice};
use super::{Gate, output, source};
use clap::{Args, value_parser};
use corridor_scenarios::MapCache;
use corridor_sim::report::{Colour, SweepReport, to_table};
use corridor_sim::sweep::results::{Header, ResultsWriter};
use corridor_sim::sweep::{Claim, Plan, Shard, Standing, SweepRow, Variant, sweep};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::ops::ControlFlow;

/// Runs where nobody says how many.
const COUNT: u64 = 200;

/// Most runs of a sweep: more would take years.
const MOST_RUNS: u64 = 1_000_000_000;

/// Threads that any system can start.
const MOST_THREADS: i64 = 1024;

#[derive(Args)]
pub(crate) struct Sweep {
    /// Scenario files, folders of them, catalog names, `catalog` for all of it, or `hard` for its hard families.
    #[arg(required = true)]
    scenarios: Vec<String>,
    /// How many runs in all, with `--compare` of each planner; scenarios without random numbers are run once. [default:
    /// 200; with `--until`, what it can take at most]
    #[arg(long, value_parser = value_parser!(u64).range(1..=MOST_RUNS))]
    count: Option<u64>,
    /// The first seed.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Threads; 0: one per core. Does not change results.
    #[arg(long, default_value_t = 0, value_parser = value_parser!(u16).range(0..=MOST_THREADS))]
    jobs: u16,
    /// Stop as soon as it can be claimed at 95 % confidence, or is refuted, that fewer than RATE of such runs fail:
    /// `0.1%` or `0.001`.
    #[arg(long, value_name = "RATE", value_parser = until::rate)]
    until: Option<Claim>,
    /// Go on with the unfinished results file of the same sweep.
    #[arg(long)]
    resume: bool,
    /// Make only part I of N of the runs, from 1; `auto` takes both from Slurm or Kubernetes, `auto/N` only I.
    #[arg(long, value_name = "I/N", value_parser = shard::parse, conflicts_with = "until")]
    shard: Option<Shard>,
    #[command(flatten)]
    outputs: Outputs,
    /// Change a setting of all runs.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<String>,
    #[command(flatten)]
    planner: PlannerChoice,
    /// Run the same seeds under two planners, as in `lane_follow,lattice`, and test what differs.
    ///
    /// Which is better is a question and no gate: the exit code is 1 only if either has a collision at fault or a decider
    /// that fails, or a run could not be made.
    #[arg(long, value_name = "FIRST,SECOND", value_parser = planner::pair, conflicts_with = "planner")]
    compare: Option<[planner::Name; 2]>,
}

impl Sweep {
    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        match self.compare {
            Some(planners) => self.compare(planners),
            None => self.sweep(),
        }
    }

    fn sweep(&self) -> anyhow::Result<Gate> {
        let variant = Variant::new("sweep", self.planner.with(&self.settings))?;
        let plan = self.plan()?;
        self.outputs.check()?;
        let until = self.until.map(Claim::rate);
        let mut report = SweepReport::default();
        let place = self.outputs.results_place()?;
        anyhow::ensure!(
            place.is_some() || !self.resume,
            "`--resume` goes on with a results file: name it by `--results FILE` or `--out DIR`"
        );
        let header = || Header::new(&plan, &self.scenarios, &variant, until);
        let mut results = match &place {
            Some(place) if self.resume => Some(ResultsWriter::resume(place.path(), &header(), |row| {
                report.add(row);
            })?),
            Some(place) => Some(ResultsWriter::create(place.path(), &header())?),
            None => None,
        };
        self.make_runs(&plan, &variant, &mut report, results.as_mut())?;
        if let Some(results) = results {
            results.finish(&report)?;
        }
        output::print(&to_table(&report, Colour::from_env()));
        let claim = self.until.map(|claim| (claim, until::standing(claim, &report)));
        if let Some((claim, standing)) = claim {
            output::print(&until::sentence(claim, standing, &report));
        }
        if let Some(place) = &place {
            self.outputs.write(place.path(), &report)?;
            self.outputs.keep_failures(&plan, &variant, &report)?;
        } else {
            self.outputs.write_json(&report)?;
        }
        let passed = claim.map_or(report.passed(), |(_, standing)| standing == Standing::Made);
        Ok(if passed { Gate::Passed } else { Gate::Failed })
    }

    /// Makes the runs that the results do not hold yet.
    fn make_runs(
        &self,
        plan: &Plan,
        variant: &Variant,
        report: &mut SweepReport,
        mut results: Option<&mut ResultsWriter>,
    ) -> anyhow::Result<()> {
        if results.as_ref().is_some_and(|results| results.is_done()) {
            return Ok(());
        }
        let bar = progress_bar(plan.len());
        bar.set_position(report.runs());
        let done = report.runs();
        let mut written = Ok(());
        let is_enough = |report: &SweepReport| {
            self.until
                .is_some_and(|claim| until::standing(claim, report) != Standing::Open)
        };
        if is_enough(report) {
            return Ok(());
        }
        let take = |row: SweepRow| {
            bar.inc(1);
            if let Some(failure) = row.failure() {
                bar.println(format!("{} seed {}: {failure}", row.scenario, row.seed));
            }
            report.add(&row);
            if let Some(results) = &mut results {
                written = results.add(&row);
            }
            if written.is_err() || is_enough(report) {
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(())
        };
        sweep(plan, done, variant, usize::from(self.jobs), take)?;
        bar.finish_and_clear();
        Ok(written?)
    }

    /// The runs to make, of the scenarios that can be run on this machine.
    fn plan(&self) -> anyhow::Result<Plan> {
        let selection = source::select(&self.scenarios, &MapCache::new())?;
        for skipped in &selection.skipped {
            output::note(&format!("skipped {skipped}"));
        }
        anyhow::ensure!(
            !selection.families.is_empty(),
            "nothing to run: every scenario was skipped"
        );
        let usual = self.until.map_or(COUNT, until::most_runs);
        let plan = Plan::new(selection.families, self.count.unwrap_or(usual), self.seed);
        let plan = plan.part(self.shard.unwrap_or(Shard::WHOLE));
        anyhow::ensure!(
            !plan.is_empty(),
            "nothing to run: there are fewer runs than parts"
        );
        Ok(plan)
    }
}

fn progress_bar(length: u64) -> ProgressBar {
    let target = if std::io::stderr().is_terminal() {
        ProgressDrawTarget::stderr()
    } else {
        ProgressDrawTarget::hidden()
    };
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} runs, {per_sec}, {eta} left")
        .expect("the template is well-formed");
    ProgressBar::with_draw_target(Some(length), target).with_style(style)
}
