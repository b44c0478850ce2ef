//! What can be taken from a scenario, the greatest gains first.

use super::Failing;
use super::document::{Document, Key};
use crate::signature::Signature;
use crate::verdict::Ending;

/// Maps of the program from plain to hard, each with a lane to start in: tried in the place of others.
const PLAIN_MAPS: [&str; 2] = ["urban_parking", "highway_shoulder"];

/// Time that a run is given beyond its failure, s: what ends sooner fails sooner.
const GRACE: f64 = 0.5;

/// Shares of the way to the failure that are skipped, longest first.
const SKIPPED: [f64; 4] = [0.9, 0.75, 0.5, 0.25];

/// Decimals to which numbers are rounded, coarsest first; `-1`: tens.
const DECIMALS: [i32; 4] = [-1, 0, 1, 2];

/// Keys without which a file is no scenario, or means another one.
const KEPT: [&str; 7] = ["description", "map", "name", "outcome", "kind", "ahead", "side"];

/// A way to make a scenario smaller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// No longer than the failure takes.
    EndEarly,
    /// Groups of obstacles away, halves first.
    FewerObstacles,
    /// The ego starts nearer to where it fails.
    StartLate,
    /// A map of the program that is plain.
    PlainMap,
    /// Optional keys away: what is usual stays.
    FewerKeys,
    /// Numbers with fewer digits.
    RounderNumbers,
}

impl Step {
    /// In the order in which they are tried.
    pub(super) const ALL: [Self; 6] = [
        Self::EndEarly,
        Self::FewerObstacles,
        Self::StartLate,
        Self::PlainMap,
        Self::FewerKeys,
        Self::RounderNumbers,
    ];

    /// The attempt of this number, of those that can be made; `None` after the last.
    pub(super) fn attempt(self, failing: &Failing, signature: &Signature, number: usize) -> Option<Document> {
        match self {
            Self::EndEarly => end_early(failing, signature, number),
            Self::FewerObstacles => fewer_obstacles(&failing.document, number),
            Self::StartLate => start_late(failing, signature, number),
            Self::PlainMap => plain_map(&failing.document, number),
            Self::FewerKeys => fewer_keys(&failing.document, number),
            Self::RounderNumbers => rounder(&failing.document, number),
        }
    }

    /// The number of the attempt to go on with when one has gained: where attempts are counted by what is left, the same
    /// number is another attempt now.
    pub(super) fn after_gain(self, number: usize) -> usize {
        match self {
            Self::FewerObstacles | Self::FewerKeys | Self::RounderNumbers => number,
            Self::EndEarly | Self::StartLate | Self::PlainMap => number + 1,
        }
    }
}

/// Whether the failure is that something did not happen in time: time and way then belong to it.
fn is_omission(signature: &Signature) -> bool {
    matches!(
        signature.ending,
        Ending::Timeout | Ending::StoodStill | Ending::Refused | Ending::PulledOverBadly
    )
}

fn end_early(failing: &Failing, signature: &Signature, number: usize) -> Option<Document> {
    let end = ((failing.duration + GRACE) * 10.0).ceil() / 10.0;
    let is_shorter = failing
        .document
        .number(None, "timeout")
        .is_none_or(|timeout| end < timeout);
    let fits = number == 0 && is_shorter && !is_omission(signature);
    fits.then(|| failing.document.with(None, "timeout", end))
}

/// All of them, then halves, quarters, and so on down to single ones.
fn fewer_obstacles(document: &Document, number: usize) -> Option<Document> {
    let count = document.obstacles().len();
    let mut size = count;
    let mut first = number;
    while size > 0 {
        let groups = count.div_ceil(size);
        if first < groups {
            let begin = first * size;
            return Some(document.without_obstacles(begin..(begin + size).min(count)));
        }
        first -= groups;
        size = if size == 1 { 0 } else { size.div_ceil(2) };
    }
    None
}

fn start_late(failing: &Failing, signature: &Signature, number: usize) -> Option<Document> {
    if is_omission(signature) {
        return None;
    }
    let by = (SKIPPED.get(number)? * failing.driven).floor();
    if by < 1.0 {
        return None;
    }
    Some(failing.document.nearer(by))
}

fn plain_map(document: &Document, number: usize) -> Option<Document> {
    let current = document.text_of("map")?;
    let rank = PLAIN_MAPS
        .iter()
        .position(|map| *map == current)
        .unwrap_or(PLAIN_MAPS.len());
    let map = PLAIN_MAPS[..rank].get(number)?;
    let name = |key: &str| vec![Key::Name(key.to_owned())];
    let lane = vec![Key::Name("ego".to_owned()), Key::Name("lane".to_owned())];
    let mut plain = document.with(None, "map", *map).without(&lane);
    for key in ["route", "destination", "via", "route_length", "map_objects"] {
        plain = plain.without(&name(key));
    }
    Some(plain)
}

fn fewer_keys(document: &Document, number: usize) -> Option<Document> {
    let is_optional = |path: &Vec<Key>| match path.last() {
        Some(Key::Name(last)) => !KEPT.contains(&last.as_str()),
        _ => false,
    };
    let path = document.leaves().into_iter().filter(is_optional).nth(number)?;
    Some(document.without(&path))
}

/// Every number that has fewer digits when it is rounded, at each coarseness.
fn rounder(document: &Document, number: usize) -> Option<Document> {
    let mut attempts = document.leaves().into_iter().flat_map(|path| {
        let value = document.number_at(&path);
        DECIMALS.into_iter().filter_map(move |decimals| {
            let value = value?;
            let scale = libm::pow(10.0, f64::from(decimals));
            let round = (value * scale).round() / scale + 0.0;
            (digits(round) < digits(value)).then(|| (path.clone(), round))
        })
    });
    let (path, round) = attempts.nth(number)?;
    Some(document.with_number(&path, round))
}

/// Digits that somebody has to read.
fn digits(value: f64) -> usize {
    let text = value.abs().to_string();
    text.trim_end_matches('0')
        .chars()
        .filter(char::is_ascii_digit)
        .count()
}
