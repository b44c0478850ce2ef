//! The metrics of how near it came to worse, and of how bad it was. None of them fails a run.

use super::Definition;
use super::Limit::{AtLeast, AtMost};
use crate::monitor::{following, pet};

const fn metric(
    name: &'static str,
    unit: &'static str,
    formula: &'static str,
    source: &'static str,
) -> Definition {
    Definition::new(name, unit, formula, source)
}

/// Conflicts, safe distances and contacts.
pub(super) const CRITICALITY: [Definition; 12] = [
    metric(
        "rss_lon",
        "m",
        "least gap along the line beyond the safe distance, to whoever is not safe to the side",
        "RSS, values of ad-rss-lib",
    )
    .limit(AtLeast(0.0)),
    metric(
        "rss_lat",
        "m",
        "least gap across the line beyond the safe distance, to whoever is not safe along it",
        "RSS, values of ad-rss-lib",
    )
    .limit(AtLeast(0.0)),
    metric(
        "rss_dangerous",
        "s",
        "time in which somebody is neither at a safe distance along the line nor across it",
        "RSS, values of ad-rss-lib",
    )
    .limit(AtMost(0.0)),
    metric(
        "rss_violation",
        "s",
        "time, from the response time on, in which the ego moves and brakes less than it must, with somebody ahead to \
         whom the distance along the line was the last to become unsafe",
        "RSS, values of ad-rss-lib",
    )
    .limit(AtMost(0.0)),
    metric(
        "ssm_ttc",
        "s",
        "least gap over closing speed to what is ahead in the strip along the line that the ego's front covers",
        "SUMO SSM",
    )
    .limit(AtLeast(following::TTC_LIMIT)),
    metric(
        "drac",
        "m/s²",
        "largest braking that would just keep the ego off what is ahead there: closing speed squared over twice the gap",
        "SUMO SSM",
    )
    .limit(AtMost(following::DRAC_LIMIT)),
    metric(
        "mdrac_count",
        "",
        "obstacles ahead there to which more than 3.4 m/s² would have been needed after 1 s of reaction",
        "SUMO SSM",
    )
    .limit(AtMost(0.0)),
    metric(
        "pet",
        "s",
        "least time between one leaving a place and the other taking it, for courses more than 30° apart, up to 5 s",
        "SUMO SSM",
    )
    .limit(AtLeast(pet::LIMIT)),
    metric(
        "delta_v",
        "m/s",
        "velocity that the ego loses in the hardest contact, 2000 kg against 2000 kg that stay together",
        "nuPlan",
    ),
    metric(
        "impact_energy",
        "kJ",
        "energy that this contact takes up",
        "nuPlan's masses",
    ),
    metric(
        "avoidable_collisions",
        "",
        "contacts that full braking within the last 3 s would have avoided",
        "Corridor",
    ),
    metric(
        "tr1",
        "",
        "0.01 ∫ (jerk along the car)² + 22 ∫ (steering rate)² + 8 ∫ e^(−0.2 distance to what is ahead there) + \
         0.5 ∫ (offset from the lane's middle)², by Simpson's rule; for ranking only",
        "CommonRoad cost function TR1",
    ),
];
