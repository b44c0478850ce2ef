//! Rows as `JUnit` XML: one suite, a case per run, its scenario as the class name.
//!
//! A `failure` is a violated property, an `error` is a testbed that could not run. The command that runs the case again
//! is in `system-out`. Cases are written one by one, so a million of them take no room; their `time` is simulated time,
//! for a results file knows no other.

use crate::sweep::{Judgement, RunResult, SweepRow};
use crate::verdict::Metric;
use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesEnd, BytesStart, BytesText, Event};
use std::fmt::Write as _;
use std::io::{self, Write};

/// What stands at the head of the document.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Totals {
    /// Runs in all.
    pub runs: u64,
    /// Runs that were judged and failed.
    pub failures: u64,
    /// Runs that could not be judged.
    pub errors: u64,
}

/// A document that is being written.
pub struct Junit<W: Write> {
    writer: Writer<W>,
}

impl<W: Write> Junit<W> {
    /// Begins a document.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn begin(out: W, totals: Totals) -> io::Result<Self> {
        let mut writer = Writer::new_with_indent(out, b' ', 2);
        writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
        for tag in ["testsuites", "testsuite"] {
            let mut start = BytesStart::new(tag);
            start.push_attribute(("name", "corridor"));
            for (key, value) in [
                ("tests", totals.runs),
                ("failures", totals.failures),
                ("errors", totals.errors),
            ] {
                start.push_attribute((key, value.to_string().as_str()));
            }
            writer.write_event(Event::Start(start))?;
        }
        Ok(Self { writer })
    }

    /// Writes the case of one run.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn case(&mut self, row: &SweepRow) -> io::Result<()> {
        let time = row.verdict().map_or(0.0, |verdict| verdict.duration);
        let mut start = BytesStart::new("testcase");
        start.push_attribute(("name", format!("{}[seed={}]", row.scenario, row.seed).as_str()));
        start.push_attribute(("classname", row.scenario.as_str()));
        start.push_attribute(("time", format!("{time:.3}").as_str()));
        self.writer.write_event(Event::Start(start))?;
        self.status(row)?;
        self.text("system-out", &row.replay)?;
        self.writer.write_event(Event::End(BytesEnd::new("testcase")))
    }

    fn status(&mut self, row: &SweepRow) -> io::Result<()> {
        let (tag, kind, details) = match &row.result {
            RunResult::Judged(verdict) if verdict.pass => return Ok(()),
            RunResult::Judged(verdict) => ("failure", failed_gate(verdict), details(verdict)),
            RunResult::Broken(reason) => ("error", "infrastructure", reason.clone()),
        };
        let mut start = BytesStart::new(tag);
        start.push_attribute(("message", row.failure().unwrap_or_default()));
        start.push_attribute(("type", kind));
        self.writer.write_event(Event::Start(start))?;
        self.writer.write_event(Event::Text(BytesText::new(&details)))?;
        self.writer.write_event(Event::End(BytesEnd::new(tag)))
    }

    fn text(&mut self, tag: &str, text: &str) -> io::Result<()> {
        self.writer.write_event(Event::Start(BytesStart::new(tag)))?;
        self.writer.write_event(Event::Text(BytesText::new(text)))?;
        self.writer.write_event(Event::End(BytesEnd::new(tag)))
    }

    /// Ends the document and gives back what it was written to.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn end(mut self) -> io::Result<W> {
        for tag in ["testsuite", "testsuites"] {
            self.writer.write_event(Event::End(BytesEnd::new(tag)))?;
        }
        let mut out = self.writer.into_inner();
        out.write_all(b"\n")?;
        Ok(out)
    }
}

/// Name of the first gate that failed.
fn failed_gate(verdict: &Judgement) -> &str {
    let failed = verdict.failed.iter().find(|metric| metric.gate);
    failed.map_or("ending", |metric| metric.name.as_str())
}

/// Every metric that is not good, one a line, gates first.
fn details(verdict: &Judgement) -> String {
    let mut text = verdict.summary.clone();
    if let Some(signature) = &verdict.signature {
        // Writing to a string cannot fail.
        let _ = write!(text, "\nsignature: {signature}");
    }
    for metric in &verdict.failed {
        let _ = write!(text, "\n{}", line(metric));
    }
    text
}

fn line(metric: &Metric) -> String {
    let number = |v: Option<f64>| v.map_or("-".to_owned(), |v| format!("{v:.3}"));
    let kind = if metric.gate { "gate" } else { "metric" };
    let mut text = format!(
        "{kind} {} = {} (limit {})",
        metric.name,
        number(metric.value),
        number(metric.threshold)
    );
    if let Some(t) = metric.worst_t {
        let _ = write!(text, " at {t:.2} s");
    }
    if let Some(obstacle) = &metric.worst_obstacle {
        let _ = write!(text, " with {obstacle}");
    }
    text
}
