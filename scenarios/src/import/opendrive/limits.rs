//! Which speed limit rules on a lane: its own record, else the road's, else the last sign that was passed.

use super::record::{LaneRecord, Road, SpeedRecord, SpeedSign};

/// The limits of one direction of a lane.
pub(super) struct Limits<'a> {
    lane: &'a [SpeedRecord],
    road: &'a [SpeedRecord],
    /// Station and limit of the signs for it, ascending.
    signs: Vec<(f64, f64)>,
    forward: bool,
}

impl<'a> Limits<'a> {
    pub(super) fn new(road: &'a Road, lane: &'a LaneRecord, forward: bool) -> Self {
        let meant = |sign: &&SpeedSign| {
            let covers = |(from, to): &(i32, i32)| (*from.min(to)..=*from.max(to)).contains(&lane.id);
            sign.forward.is_none_or(|along| along == forward)
                && (sign.lanes.is_empty() || sign.lanes.iter().any(covers))
        };
        let signs = road.signs.iter().filter(meant);
        Self {
            lane: &lane.speeds,
            road: &road.speeds,
            signs: signs.map(|sign| (sign.s, sign.limit)).collect(),
            forward,
        }
    }

    /// The limit at a road station, m/s; infinite for none.
    ///
    /// A lane's record that allows any speed rules too; a road's does not, since roads whose type is all that is
    /// known look the same.
    pub(super) fn at(&self, s: f64) -> f64 {
        let ruling = |records: &[SpeedRecord]| {
            let past = records.partition_point(|record| record.s <= s);
            past.checked_sub(1).map(|k| records[k].limit)
        };
        ruling(self.lane)
            .or_else(|| ruling(self.road).filter(|limit| limit.is_finite()))
            .or_else(|| self.sign(s))
            .unwrap_or(f64::INFINITY)
    }

    /// The limit of the last sign that traffic has passed at a station.
    fn sign(&self, s: f64) -> Option<f64> {
        let last = if self.forward {
            self.signs.partition_point(|sign| sign.0 <= s).checked_sub(1)?
        } else {
            self.signs.partition_point(|sign| sign.0 < s)
        };
        self.signs.get(last).map(|sign| sign.1)
    }
}
