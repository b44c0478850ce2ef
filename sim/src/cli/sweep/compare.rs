//! `corridor sweep --compare`: the same seeds under two planners, and what differs.

use super::super::outputs::Outputs;
use super::super::planner::{self, Name};
use super::super::{Gate, output};
use super::{Sweep, progress_bar};
use corridor_sim::report::{Colour, Comparison, SweepReport, comparison_to_json, comparison_to_table};
use corridor_sim::sweep::results::{Header, ResultsError, ResultsWriter};
use corridor_sim::sweep::{Plan, SweepRow, Variant, compare};
use std::path::PathBuf;

impl Sweep {
    pub(super) fn compare(&self, planners: [Name; 2]) -> anyhow::Result<Gate> {
        self.check_use()?;
        let [first, second] = planners.map(|name| Variant::new(name.text(), name.with(&self.settings)));
        let variants = [first?, second?];
        let plan = self.plan()?;
        self.check_places(&variants)?;
        let pairs = self.pairs(&plan, &variants)?;
        let comparison = Comparison::new(variants.each_ref().map(|variant| variant.name.clone()), pairs);
        output::print(&comparison_to_table(&comparison, Colour::from_env()));
        output::print(&cycles(&comparison));
        self.write_comparison(&plan, &variants, &comparison)?;
        Ok(if comparison.is_safe() {
            Gate::Passed
        } else {
            Gate::Failed
        })
    }

    /// Makes all runs; each goes to the results file of its planner as it ends.
    fn pairs(&self, plan: &Plan, variants: &[Variant; 2]) -> anyhow::Result<Vec<[SweepRow; 2]>> {
        let mut writers = Vec::new();
        for variant in variants {
            if let Some(place) = self.results_of(variant) {
                let header = Header::new(plan, &self.scenarios, variant, None);
                writers.push(ResultsWriter::create(&place, &header)?);
            }
        }
        let bar = progress_bar(2 * plan.len());
        let (mut pairs, mut written) = (Vec::new(), Ok(()));
        compare(plan, variants, usize::from(self.jobs), |pair| {
            bar.inc(2);
            let mut add = |(writer, row): (&mut ResultsWriter, &SweepRow)| writer.add(row);
            let added: Result<(), ResultsError> = writers.iter_mut().zip(&pair).try_for_each(&mut add);
            if written.is_ok() {
                written = added;
            }
            pairs.push(pair);
        })?;
        bar.finish_and_clear();
        written?;
        for (side, writer) in writers.into_iter().enumerate() {
            let report: SweepReport = pairs.iter().map(|pair| &pair[side]).collect();
            writer.finish(&report)?;
        }
        Ok(pairs)
    }

    fn folder_of(&self, variant: &Variant) -> Option<PathBuf> {
        Some(self.outputs.out.as_ref()?.join(&variant.name))
    }

    fn results_of(&self, variant: &Variant) -> Option<PathBuf> {
        Some(self.folder_of(variant)?.join("results.jsonl"))
    }

    /// What makes no sense with two planners.
    fn check_use(&self) -> anyhow::Result<()> {
        let outputs = &self.outputs;
        let refused = [
            ("--junit", outputs.junit.is_some()),
            ("--csv", outputs.csv.is_some()),
            ("--html", outputs.html.is_some()),
            ("--results", outputs.has_results()),
            ("--resume", self.resume),
            ("--until", self.until.is_some()),
        ];
        if let Some((flag, _)) = refused.iter().find(|(_, is_given)| *is_given) {
            anyhow::bail!(
                "`{flag}` with `--compare`: a comparison is no list of cases; `--out DIR` writes results and reports per planner"
            );
        }
        if let Some(setting) = self.settings.iter().find(|setting| planner::is_choice(setting)) {
            anyhow::bail!(
                "`--set {setting}` with `--compare`, which chooses the planners: leave one of them out"
            );
        }
        Ok(())
    }

    fn check_places(&self, variants: &[Variant; 2]) -> anyhow::Result<()> {
        self.outputs.check()?;
        let mut folders = variants.iter().filter_map(|variant| self.folder_of(variant));
        folders.try_for_each(|folder| output::make_folder(&folder))
    }

    fn write_comparison(
        &self,
        plan: &Plan,
        variants: &[Variant; 2],
        comparison: &Comparison,
    ) -> anyhow::Result<()> {
        let json = comparison_to_json(comparison)?;
        if let Some(path) = &self.outputs.json {
            output::write(path, &json)?;
        }
        let Some(folder) = &self.outputs.out else {
            return Ok(());
        };
        output::write(&folder.join("comparison.json"), &json)?;
        let table = comparison_to_table(comparison, Colour::Never);
        output::write(&folder.join("comparison.txt"), &table)?;
        for (variant, report) in variants.iter().zip(comparison.reports()) {
            let outputs = Outputs::folder(folder.join(&variant.name));
            let place = folder.join(&variant.name).join("results.jsonl");
            outputs.write(&place, report)?;
            outputs.keep_failures(plan, variant, report)?;
        }
        Ok(())
    }
}

/// How long the planners took for a cycle here and now. It is printed and stands in no file that is compared.
fn cycles(comparison: &Comparison) -> String {
    let lines = comparison.names().iter().zip(comparison.reports()).map(|(name, report)| {
        let cycles = report.cycles();
        let ms = |time: std::time::Duration| time.as_secs_f64() * 1e3;
        format!(
            "planning cycle of {name}, on this machine and not repeatable: median {:.2} ms, 99 % within {:.2} ms, \
             longest {:.1} ms, {} cycles\n",
            ms(cycles.quantile(0.5)),
            ms(cycles.quantile(0.99)),
            ms(cycles.longest()),
            cycles.count()
        )
    });
    lines.collect()
}
