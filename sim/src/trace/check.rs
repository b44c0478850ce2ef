//! What must hold between the records of a trace, beyond what their types say.
//!
//! Everyone downstream indexes with the places that a trace names; here they are checked once.

use super::record::{Header, TickRecord};
use corridor_decider::reference_line::ReferenceLine;
use std::sync::Arc;

/// Whether the header can be used: a period, and lines that are lines.
pub(super) fn header(header: &Header) -> Result<(), String> {
    if !(header.tick.is_finite() && header.tick > 0.0) {
        return Err(format!(
            "the planning period is {} s; it must be positive",
            header.tick
        ));
    }
    lines(&header.lines, 0)
}

/// Whether the lines from place `first` on are lines.
pub(super) fn lines(lines: &[Arc<ReferenceLine>], first: usize) -> Result<(), String> {
    for (k, line) in lines.iter().enumerate().skip(first) {
        let samples = line.samples();
        if samples.len() < 2 {
            return Err(format!("reference line {k} has fewer than two samples"));
        }
        if samples.windows(2).any(|pair| pair[1].s <= pair[0].s) {
            return Err(format!("stations of reference line {k} do not increase"));
        }
    }
    Ok(())
}

/// Whether everything that a tick refers to exists.
pub(super) fn tick(header: &Header, record: &TickRecord) -> Result<(), String> {
    let (lines, candidates) = (record.lines.len(), record.decision.candidates.len());
    if let Some((place, _)) = record
        .lines
        .iter()
        .find(|(place, _)| *place >= header.lines.len())
    {
        return Err(format!(
            "refers to line {place} of {} in the header",
            header.lines.len()
        ));
    }
    if record.decision.line >= lines {
        return Err(format!(
            "decides along line {} of {lines} in the frame",
            record.decision.line
        ));
    }
    if record.decision.chosen.is_some_and(|k| k >= candidates) {
        return Err(format!("chose a candidate beyond the {candidates} there are"));
    }
    if let Some(obstacle) = (record.frame.obstacles.iter()).find(|o| o.shape.vertices().len() < 3) {
        return Err(format!(
            "obstacle {} has an outline of fewer than three corners",
            obstacle.id.0
        ));
    }
    Ok(())
}
