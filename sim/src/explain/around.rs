//! What stands and moves around the ego, nearest first, as the reference line sees it.

use crate::trace::{TickRecord, Trace};
use corridor_decider::frame::{Obstacle, ObstacleKind};
use corridor_decider::reference_line::LineQuery;
use std::fmt::{self, Formatter};

/// So many obstacles are told of; more would bury the decision.
const TOLD: usize = 6;

/// An obstacle along the line, m.
struct Along {
    /// From the front bumper to its near end, or from the rear one (negative); zero beside the ego.
    gap: f64,
    low_l: f64,
    high_l: f64,
}

/// The nearest obstacles of a tick, a line each.
pub(super) fn obstacles(out: &mut Formatter<'_>, trace: &Trace, tick: &TickRecord) -> fmt::Result {
    let all = &tick.frame.obstacles;
    let moving = all.iter().filter(|o| !o.is_static).count();
    writeln!(out, "obstacles   {} seen, {moving} of them moving", all.len())?;
    let mut near: Vec<(Along, &Obstacle)> = all.iter().map(|o| (along(trace, tick, o), o)).collect();
    near.sort_by(|(a, p), (b, q)| a.gap.abs().total_cmp(&b.gap.abs()).then(p.id.cmp(&q.id)));
    let left_out = near.len().saturating_sub(TOLD);
    for (place, obstacle) in near.into_iter().take(TOLD) {
        let speed = obstacle.speed();
        let motion = if obstacle.is_static {
            "standing".to_owned()
        } else {
            format!("{speed:.1} m/s")
        };
        writeln!(
            out,
            "    {:<14} `{}`, {}, {motion}, l {:+.2} to {:+.2} m",
            where_is(place.gap),
            trace.obstacle(obstacle.id),
            kind(obstacle.kind),
            place.low_l,
            place.high_l
        )?;
    }
    if left_out > 0 {
        writeln!(out, "    and {left_out} further away")?;
    }
    Ok(())
}

fn where_is(gap: f64) -> String {
    match gap {
        gap if gap > 0.0 => format!("{gap:.1} m ahead"),
        gap if gap < 0.0 => format!("{:.1} m behind", -gap),
        _ => "beside".to_owned(),
    }
}

fn along(trace: &Trace, tick: &TickRecord, obstacle: &Obstacle) -> Along {
    let line = trace.line(tick);
    let vehicle = &trace.header.vehicle;
    let ego_s = line.to_frenet(tick.frame.ego.pose.position()).s;
    let (front, back) = (
        ego_s + vehicle.front_edge_to_center,
        ego_s - vehicle.back_edge_to_center,
    );
    let footprint = obstacle.footprint();
    let corners = footprint.vertices().iter().map(|p| line.to_frenet(*p));
    let mut spans = [(f64::INFINITY, f64::NEG_INFINITY); 2];
    for corner in corners {
        for (span, value) in spans.iter_mut().zip([corner.s, corner.l]) {
            *span = (span.0.min(value), span.1.max(value));
        }
    }
    let [(low_s, high_s), (low_l, high_l)] = spans;
    let gap = if low_s > front {
        low_s - front
    } else {
        (high_s - back).min(0.0)
    };
    Along { gap, low_l, high_l }
}

fn kind(kind: ObstacleKind) -> &'static str {
    match kind {
        ObstacleKind::Car => "car",
        ObstacleKind::Truck => "truck",
        ObstacleKind::Bicycle => "bicycle",
        ObstacleKind::Pedestrian => "pedestrian",
        ObstacleKind::Cone => "cone",
        ObstacleKind::Other => "something",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::synthetic;

    #[test]
    fn gaps_are_between_the_bumpers() {
        let trace = synthetic::trace(120, 3);
        let van = |k: usize| along(&trace, &trace.ticks[k], &trace.ticks[k].frame.obstacles[0]);
        let (first, last) = (van(0), van(119));
        assert!(first.gap > 0.0 && last.gap < 0.0, "{} {}", first.gap, last.gap);
        let passed = (0..120).find(|k| van(*k).gap == 0.0).map(|k| van(k).gap);
        assert_eq!(passed, Some(0.0), "beside it at some time");
        // The ego starts at station 20, the van's middle is at 70 and its length is said by its shape.
        let obstacle = &trace.ticks[0].frame.obstacles[0];
        let half = obstacle
            .shape
            .vertices()
            .iter()
            .fold(0.0_f64, |most, p| most.max(p.x));
        let expected = 70.0 - half - 20.0 - trace.header.vehicle.front_edge_to_center;
        assert!((first.gap - expected).abs() < 0.5, "{} or {expected}", first.gap);
        assert!(first.low_l < first.high_l);
    }

    #[test]
    fn places_are_said_as_people_say_them() {
        assert_eq!(where_is(3.25), "3.2 m ahead");
        assert_eq!(where_is(-12.0), "12.0 m behind");
        assert_eq!(where_is(0.0), "beside");
    }
}
