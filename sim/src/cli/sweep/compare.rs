//! `corridor sweep --compare`: the same seeds under two planners, and what differs.

use super::super::planner::{self, Name};
use super::super::{Gate, output};
use super::{Sweep, fill, progress_bar};
use corridor_sim::report::{Colour, Comparison, comparison_to_json, comparison_to_table};
use corridor_sim::sweep::{CycleTimes, Plan, Variant, compare};

impl Sweep {
    pub(super) fn compare(&self, planners: [Name; 2]) -> anyhow::Result<Gate> {
        self.check_use()?;
        let [first, second] = planners.map(|name| Variant::new(name.text(), name.with(&self.settings)));
        let variants = [first?, second?];
        let plan = self.plan()?;
        self.check_places(&variants)?;
        let bar = progress_bar(2 * plan.jobs().len());
        let comparison = compare(&plan, &variants, usize::from(self.jobs), &|| bar.inc(2))?;
        bar.finish_and_clear();
        output::print(&comparison_to_table(&comparison, Colour::from_env()));
        output::print(&cycles(&comparison));
        self.write_comparison(&plan, &variants, &comparison)?;
        Ok(if comparison.is_safe() {
            Gate::Passed
        } else {
            Gate::Failed
        })
    }

    /// What makes no sense with two planners.
    fn check_use(&self) -> anyhow::Result<()> {
        anyhow::ensure!(
            self.junit.is_none(),
            "`--junit` with `--compare`: a comparison is no list of cases; `--out DIR` writes a JUnit report per planner"
        );
        if let Some(setting) = self.settings.iter().find(|setting| planner::is_choice(setting)) {
            anyhow::bail!(
                "`--set {setting}` with `--compare`, which chooses the planners: leave one of them out"
            );
        }
        Ok(())
    }

    fn check_places(&self, variants: &[Variant; 2]) -> anyhow::Result<()> {
        self.check_outputs()?;
        let Some(folder) = &self.out else { return Ok(()) };
        variants
            .iter()
            .try_for_each(|variant| output::make_folder(&folder.join(&variant.name)))
    }

    fn write_comparison(
        &self,
        plan: &Plan,
        variants: &[Variant; 2],
        comparison: &Comparison,
    ) -> anyhow::Result<()> {
        let json = comparison_to_json(comparison)?;
        if let Some(path) = &self.json {
            output::write(path, &json)?;
        }
        let Some(folder) = &self.out else { return Ok(()) };
        output::write(&folder.join("comparison.json"), &json)?;
        let table = comparison_to_table(comparison, Colour::Never);
        output::write(&folder.join("comparison.txt"), &table)?;
        for (variant, report) in variants.iter().zip(comparison.reports()) {
            fill(&folder.join(&variant.name), plan, variant, report)?;
        }
        Ok(())
    }
}

/// How long the planners took for a cycle here and now. It is printed and stands in no file that is compared.
fn cycles(comparison: &Comparison) -> String {
    let lines = comparison.names().iter().zip(comparison.reports()).map(|(name, report)| {
        let cycles: CycleTimes = report.cycles();
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
