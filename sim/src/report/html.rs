//! A sweep as one self-contained page: what it proves, each scenario, each kind of failure, and how the metrics spread.
//! Plain HTML and SVG, without scripts; the same bytes for the same rows.

use super::histogram::Histogram;
use super::table::percentage;
use super::{Coverage, Group, ScenarioSummary, SweepReport};
use crate::sweep::statistics::{CONFIDENCE, failure_rate_bound};
use std::fmt::Write;

/// How the page looks.
const STYLE: &str = include_str!("page.css");

/// Width and height of a plot's axes, px.
const PLOT: (f64, f64) = (360.0, 120.0);

/// The page.
pub fn to_html(report: &SweepReport) -> String {
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Corridor: a sweep of {} runs</title>\n\
         <style>\n{STYLE}</style></head><body>\n",
        report.runs()
    );
    page.push_str(&head(report));
    page.push_str(&groups(&report.groups()));
    page.push_str(&scenarios(&report.scenarios()));
    page.push_str(&coverage(report.coverage()));
    page.push_str("<h2>How the metrics spread</h2><div class=\"plots\">\n");
    report
        .histograms()
        .for_each(|histogram| page.push_str(&plot(histogram)));
    page.push_str("</div>\n</body></html>\n");
    page
}

fn head(report: &SweepReport) -> String {
    let (runs, failures) = (report.runs(), report.failures());
    let judged = runs - report.broken();
    let bound = failure_rate_bound(failures - report.broken(), judged, CONFIDENCE);
    let (class, words) = if report.passed() {
        ("good", format!("All {runs} runs passed"))
    } else {
        ("bad", format!("{failures} of {runs} runs did not pass"))
    };
    let rejected: u64 = report.rejected().values().sum();
    let reasons = report
        .rejected()
        .iter()
        .map(|(reason, count)| format!("{count} {reason}"));
    let reasons = reasons.collect::<Vec<_>>().join(", ");
    let reasons = if reasons.is_empty() {
        String::new()
    } else {
        format!(" ({reasons})")
    };
    format!(
        "<h1 class=\"{class}\">{words}</h1>\n<p>At 95 % confidence fewer than <b>{}</b> of all such runs fail. {rejected} draws \
         were rejected as impossible{}. Digest <code>{}</code>.</p>\n",
        percentage(bound),
        escaped(&reasons),
        report.digest()
    )
}

fn groups(groups: &[&Group]) -> String {
    if groups.is_empty() {
        return String::new();
    }
    let mut text = "<h2>Failures by kind</h2>\n<table><tr><th>runs</th><th class=\"text\">kind</th><th class=\"text\">scenarios</th>\
                    <th class=\"text\">the example that is over first</th></tr>\n"
        .to_owned();
    for group in groups {
        let of = group
            .scenarios
            .iter()
            .map(|(name, count)| format!("{name} ({count})"));
        let of = of.collect::<Vec<_>>().join(", ");
        let example = &group.smallest;
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "<tr><td>{}</td><td class=\"text\">{}</td><td class=\"text\">{}</td><td class=\"text\">{}<br><code>{}</code></td></tr>",
            group.count,
            escaped(&group.kind),
            escaped(&of),
            escaped(&example.failure),
            escaped(&example.replay)
        );
    }
    text + "</table>\n"
}

fn scenarios(summaries: &[ScenarioSummary]) -> String {
    let mut text = "<h2>Scenarios</h2>\n<table><tr><th class=\"text\">scenario</th><th>runs</th><th class=\"text\">passed</th>\
                    <th>collisions</th><th>at fault</th><th>off road</th><th>progress</th><th>nuplan_cls</th><th>ext_cls</th>\
                    <th>pulled over</th><th>rejected</th><th>failures &lt;</th></tr>\n"
        .to_owned();
    for summary in summaries {
        text.push_str(&scenario(summary));
    }
    text + "</table>\n"
}

fn scenario(summary: &ScenarioSummary) -> String {
    let score = |score: Option<f64>| score.map_or("–".to_owned(), |score| format!("{score:.2}"));
    let share = summary.passed as f64 / summary.runs.max(1) as f64 * 100.0;
    let pull_overs = match summary.pull_overs.asked {
        0 => "–".to_owned(),
        asked => format!("{}/{asked}", summary.pull_overs.done),
    };
    let marked = |count: u64| match count {
        0 => "<td>0</td>".to_owned(),
        count => format!("<td class=\"bad\">{count}</td>"),
    };
    format!(
        "<tr><td class=\"text\">{}</td><td>{}</td><td class=\"share\"><span class=\"bar\"><span style=\"width:{share:.1}%\"></span>\
         </span> {}</td>{}{}{}<td>{}</td><td>{}</td><td>{}</td><td>{pull_overs}</td><td>{}</td><td>{}</td></tr>\n",
        escaped(&summary.scenario),
        summary.runs,
        summary.passed,
        marked(summary.collisions),
        marked(summary.at_fault),
        marked(summary.off_road),
        score(summary.progress),
        score(summary.nuplan_cls),
        score(summary.ext_cls),
        summary.rejected,
        percentage(summary.failure_rate_bound),
    )
}

/// What was tried and what was not: the bins of the situations with their counts, and the numbers of families with bins
/// that no run fell into.
fn coverage(coverage: &Coverage) -> String {
    let mut text = "<h2>What was tried</h2>\n<table><tr><th class=\"text\">over all runs</th><th class=\"text\">bins and how often \
                    each was met</th></tr>\n"
        .to_owned();
    for (name, bins) in coverage.situations() {
        let cell = |(bin, count): &(String, u64)| match count {
            0 => format!("<span class=\"bad\">{}: never</span>", escaped(bin)),
            count => format!("{}: {count}", escaped(bin)),
        };
        let cells: Vec<String> = bins.counts().iter().map(cell).collect();
        let _ = writeln!(
            text,
            "<tr><td class=\"text\">{}</td><td class=\"text\">{}</td></tr>",
            escaped(name),
            cells.join(" · ")
        );
    }
    text.push_str("</table>\n");
    let all = coverage
        .parameters()
        .map(|(.., bins)| bins.counts().len())
        .sum::<usize>();
    let missed: Vec<String> = coverage
        .parameters()
        .filter(|(.., bins)| bins.empty().next().is_some())
        .map(|(family, key, bins)| {
            let empty: Vec<&str> = bins.empty().collect();
            format!("{family} {key}: {}", empty.join("; "))
        })
        .collect();
    let empty = coverage
        .parameters()
        .map(|(.., bins)| bins.empty().count())
        .sum::<usize>();
    let _ = writeln!(
        text,
        "<p>Of the numbers that families draw, {} of {all} bins were met.</p>",
        all - empty
    );
    if !missed.is_empty() {
        let _ = writeln!(
            text,
            "<details><summary>bins that no run fell into</summary><p>{}</p></details>",
            escaped(&missed.join("\n")).replace('\n', "<br>")
        );
    }
    text
}

/// Bars, failed runs stacked on passed ones; the outermost bars hold what lies beyond the axis.
fn plot(histogram: &Histogram) -> String {
    let (width, height) = PLOT;
    let step = width / histogram.bars.len() as f64;
    let scale = height / histogram.highest().max(1) as f64;
    let mut bars = String::new();
    for (k, [passed, failed]) in histogram.bars.iter().enumerate() {
        let x = k as f64 * step;
        let (low, top) = (*passed as f64 * scale, *failed as f64 * scale);
        for (class, y, tall) in [("passed", height - low, low), ("failed", height - low - top, top)] {
            if tall > 0.0 {
                let _ = write!(
                    bars,
                    "<rect class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"{tall:.1}\"/>",
                    step - 1.0
                );
            }
        }
    }
    format!(
        "<figure><svg viewBox=\"0 -4 {width} {}\"><line x1=\"0\" y1=\"{height}\" x2=\"{width}\" y2=\"{height}\"/>{bars}\
         <text x=\"0\" y=\"{y}\">{}</text><text x=\"{width}\" y=\"{y}\" text-anchor=\"end\">{} {}</text>\
         <text x=\"{width}\" y=\"8\" text-anchor=\"end\">highest bar: {} runs</text></svg><figcaption>{}</figcaption></figure>\n",
        height + 22.0,
        histogram.low,
        histogram.high,
        histogram.unit,
        histogram.highest(),
        histogram.name,
        y = height + 14.0,
    )
}

/// A text as it may stand in a page.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
