//! One tick in words, for a terminal: what the decider saw, what it weighed, what it chose, and why.
//!
//! Offsets are metres left of the reference line; stations are metres along it. Bounds are for the rear axle,
//! with half the car's width already taken off.

mod around;
pub(crate) mod words;

use crate::trace::{TickRecord, Trace};
use corridor_decider::decision::{Candidate, PathPoint};
use corridor_decider::reference_line::LineQuery;
use corridor_decider::tasks::path_bounds::{BoundPoint, EdgeCause, PathBound};
use std::fmt::{self, Display, Formatter};

/// Events this near are told with a tick, s.
const EVENTS_WITHIN: f64 = 1.0;

/// The tick at `time` in words: the last that started then or before, else the first.
pub fn tick(trace: &Trace, time: f64) -> String {
    match trace.tick_at(time) {
        Some(k) => Explanation(trace, &trace.ticks[k]).to_string(),
        None => "the trace holds no tick\n".to_owned(),
    }
}

struct Explanation<'a>(&'a Trace, &'a TickRecord);

impl Display for Explanation<'_> {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        let Self(trace, tick) = self;
        let (header, decision) = (&trace.header, &tick.decision);
        writeln!(
            out,
            "{} (seed {}), tick {} at {:.2} s\n",
            header.scenario, header.seed, tick.frame.tick, tick.frame.time
        )?;
        situation(out, trace, tick)?;
        writeln!(out, "\ncandidates")?;
        for (k, candidate) in decision.candidates.iter().enumerate() {
            describe(out, trace, candidate, decision.chosen == Some(k))?;
        }
        if let Some(candidate) = decision.chosen.map(|k| &decision.candidates[k]) {
            writeln!(out, "\nlimits of {}", candidate.bound.label)?;
            stretches(out, trace, &candidate.bound, "left", |p| (p.left, p.l_max))?;
            stretches(out, trace, &candidate.bound, "right", |p| (p.right, p.l_min))?;
        }
        writeln!(out)?;
        conclusion(out, trace, tick)?;
        events(out, trace, tick.frame.time)
    }
}

/// Ego, command, line and what is around.
fn situation(out: &mut Formatter<'_>, trace: &Trace, tick: &TickRecord) -> fmt::Result {
    let (frame, ego) = (&tick.frame, &tick.frame.ego);
    let line = trace.line(tick);
    let at = line.to_frenet(ego.pose.position());
    writeln!(
        out,
        "ego         s {:.2} m, l {:+.2} m, v {:.2} m/s ({:.1} km/h), a {:+.2} m/s²",
        at.s,
        at.l,
        ego.v,
        ego.v * 3.6,
        ego.a
    )?;
    writeln!(
        out,
        "command     {}, at most {:.1} m/s",
        words::command(frame.command),
        frame.cruise_speed
    )?;
    let change = if tick.lines[tick.decision.line].1 {
        ", a change of lane"
    } else {
        ""
    };
    writeln!(
        out,
        "line        {} of {}{change}, {:.1} m long",
        tick.decision.line + 1,
        tick.lines.len(),
        line.length()
    )?;
    around::obstacles(out, trace, tick)?;
    if let Some((clearance, id)) = tick.clearance {
        writeln!(
            out,
            "clearance   at least {clearance:.2} m during this tick, to `{}`",
            trace.obstacle(id)
        )?;
    }
    Ok(())
}

/// One candidate: how long, how narrow, what became of it.
fn describe(out: &mut Formatter<'_>, trace: &Trace, candidate: &Candidate, chosen: bool) -> fmt::Result {
    let bound = &candidate.bound;
    let mark = if chosen { '*' } else { ' ' };
    let label = bound.label.to_string();
    writeln!(
        out,
        "{mark} {label:<22} {}",
        words::assessment(trace, candidate.assessment)
    )?;
    let Some(narrow) = words::narrowest(bound) else {
        return writeln!(out, "    no point in it");
    };
    let (start, end) = (bound.start_s(), bound.end_s());
    write!(out, "    s {start:.1}…{end:.1} ({:.1} m)", end - start)?;
    match bound.blocked_by {
        Some(id) => writeln!(out, ", blocked by `{}`", trace.obstacle(id))?,
        None => writeln!(out)?,
    }
    writeln!(
        out,
        "    narrowest at s {:.1}: {:.2} m, left: {} ({:+.2} m), right: {} ({:+.2} m)",
        narrow.s,
        narrow.l_max - narrow.l_min,
        words::cause(trace, narrow.left),
        narrow.l_max,
        words::cause(trace, narrow.right),
        narrow.l_min
    )
}

/// One side of a bound by cause, with the range of the limit in each stretch.
fn stretches(
    out: &mut Formatter<'_>,
    trace: &Trace,
    bound: &PathBound,
    side: &str,
    edge: impl Fn(&BoundPoint) -> (EdgeCause, f64),
) -> fmt::Result {
    for run in bound.points.chunk_by(|a, b| edge(a).0 == edge(b).0) {
        let (first, last) = (&run[0], &run[run.len() - 1]);
        let limits = || run.iter().map(|p| edge(p).1);
        let (low, high) = (
            limits().fold(f64::INFINITY, f64::min),
            limits().fold(f64::NEG_INFINITY, f64::max),
        );
        let cause = words::cause(trace, edge(first).0);
        write!(out, "    s {:6.1}…{:6.1}  {side:>5}: {cause}", first.s, last.s)?;
        if high - low < 0.005 {
            writeln!(out, " ({low:+.2} m)")?;
        } else {
            writeln!(out, " ({low:+.2} to {high:+.2} m)")?;
        }
    }
    Ok(())
}

/// Path, stop reason, outcome.
fn conclusion(out: &mut Formatter<'_>, trace: &Trace, tick: &TickRecord) -> fmt::Result {
    let decision = &tick.decision;
    match (decision.path.first(), decision.path.last()) {
        (Some(first), Some(last)) => {
            let extreme = |start: f64, more: fn(f64, f64) -> f64, value: fn(&PathPoint) -> f64| {
                decision.path.iter().map(value).fold(start, more)
            };
            writeln!(
                out,
                "path        {:.1} m, s {:.1}…{:.1}, l from {:+.2} to {:+.2} m within {:+.2}…{:+.2}, curvature up to {:.3} 1/m",
                last.distance - first.distance,
                first.s,
                last.s,
                first.l,
                last.l,
                extreme(f64::INFINITY, f64::min, |p| p.l),
                extreme(f64::NEG_INFINITY, f64::max, |p| p.l),
                extreme(0.0, f64::max, |p| p.kappa.abs()),
            )?;
        }
        _ => writeln!(out, "path        none")?,
    }
    if let Some(last) = decision.trajectory.last() {
        let hardest = decision.trajectory.iter().map(|p| p.a).fold(0.0, f64::min);
        writeln!(
            out,
            "trajectory  {:.1} s, {:.1} m, ends at {:.2} m/s, brakes with up to {:.2} m/s²",
            last.t,
            last.distance,
            last.v,
            hardest.abs()
        )?;
    }
    let stop = decision.stop.map(|stop| words::stop(trace, stop));
    writeln!(out, "stop        {}", stop.as_deref().unwrap_or("none"))?;
    if let Some(target) = decision.pull_over {
        let at = trace.line(tick).to_frenet(target.position);
        writeln!(
            out,
            "pull over   at s {:.1} m, l {:+.2} m, that is ({:.1}, {:.1}) heading {:.2} rad",
            at.s, at.l, target.position.x, target.position.y, target.theta
        )?;
    }
    writeln!(out, "outcome     {}", words::outcome(decision.outcome))?;
    if let Some(fallback) = decision.fallback {
        writeln!(out, "fallback    {}", words::fallback(trace, fallback))?;
    }
    tasks(out, tick)
}

/// What each task was given, what it found, and which one failed.
fn tasks(out: &mut Formatter<'_>, tick: &TickRecord) -> fmt::Result {
    for (k, report) in tick.decision.tasks.iter().enumerate() {
        if k == 0 {
            writeln!(out, "\ntasks")?;
        }
        let name = report.task.to_string();
        writeln!(out, "    {name:<26} {} -> {}", report.input, report.output)?;
        if let Some(error) = &report.error {
            writeln!(out, "    {:<26} failed: {error}", "")?;
        }
    }
    Ok(())
}

/// What happened around `time`.
fn events(out: &mut Formatter<'_>, trace: &Trace, time: f64) -> fmt::Result {
    let near = trace
        .ticks
        .iter()
        .flat_map(|tick| &tick.events)
        .filter(|event| (event.time - time).abs() <= EVENTS_WITHIN);
    for (k, event) in near.enumerate() {
        if k == 0 {
            writeln!(out, "\nevents within {EVENTS_WITHIN:.0} s")?;
        }
        let mark = if (event.time - time).abs() < 1e-6 {
            '*'
        } else {
            ' '
        };
        writeln!(
            out,
            "{mark}   {:.2} s  {}: {}",
            event.time,
            words::event(event.kind),
            event.text
        )?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::synthetic;

    #[test]
    fn a_tick_is_explained_whole() {
        let trace = synthetic::trace(60, 4);
        let text = tick(&trace, 1.2);
        let expected = [
            "tick 12 at 1.20 s",
            "ego         s 30.80 m, l +0.00 m, v 9.00 m/s (32.4 km/h), a +0.00 m/s²",
            "command     cruise, at most 10.0 m/s",
            "obstacles   4 seen, 1 of them moving",
            "  regular/self/          no path: it touches `van`\n    s 30.8…64.8 (34.0 m), blocked by `van`",
            "* regular/left/reverse   chosen\n    s 30.8…130.3 (99.5 m)\n    \
             narrowest at s 65.3: 3.40 m, left: far line of the borrowed lane (+4.10 m), \
             right: obstacle `van` (+0.70 m)",
            "    s   30.8… 130.3   left: far line of the borrowed lane (+4.10 m)\n    \
             s   30.8…  64.8  right: lane line (-0.69 m)\n    \
             s   65.3…  74.8  right: obstacle `van` (+0.70 m)\n    \
             s   75.3… 130.3  right: lane line (-0.69 m)",
            "stop        none",
            "outcome     normal: a path and a speed of this tick",
            "events within 1 s\n*   1.20 s  label: regular/self/ -> regular/left/reverse around `van`",
        ];
        let mut rest = &text[..];
        for part in expected {
            let at = rest.find(part);
            assert!(at.is_some(), "missing, or out of order:\n{part}\nin\n{text}");
            rest = &rest[at.unwrap() + part.len()..];
        }
    }

    #[test]
    fn the_least_there_can_be_is_explained() {
        let mut trace = synthetic::trace(1, 3);
        let decision = &mut trace.ticks[0].decision;
        decision.chosen = None;
        decision.path.clear();
        decision.trajectory.clear();
        decision.candidates.truncate(1);
        decision.candidates[0].bound.points.clear();
        let text = tick(&trace, 99.0);
        assert!(
            text.contains("no point in it") && text.contains("path        none"),
            "{text}"
        );
        trace.ticks.clear();
        assert_eq!(tick(&trace, 0.0), "the trace holds no tick\n");
    }
}
