//! One hash over a sweep: the sum of a hash of every run, FNV-1a (Fowler, Noll, Vo; 64 bit) with its bits mixed. It finds
//! differences; it does not keep secrets.

use crate::sweep::{RunResult, SweepRow};
use std::fmt;

const OFFSET_BASIS: u64 = 0xcbf2_9ce4_8422_2325;
const PRIME: u64 = 0x0000_0100_0000_01b3;

/// The hash of the rows so far, which may come in any order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Digest(u64);

impl Digest {
    /// Of a row counts what a run of the same seed must repeat: its ending, its judgement and the digest of its states.
    pub(super) fn add(&mut self, row: &SweepRow) {
        let hash = text(OFFSET_BASIS, &row.scenario);
        let hash = bytes(hash, &row.seed.to_le_bytes());
        let hash = match &row.result {
            RunResult::Judged(verdict) => {
                let marks = [1, verdict.ending as u8, u8::from(verdict.pass)];
                text(bytes(hash, &marks), &verdict.digest)
            }
            RunResult::Broken(reason) => text(bytes(hash, &[0]), reason),
        };
        self.0 = self.0.wrapping_add(mixed(hash));
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

/// The finishing step of `SplitMix64`: without it, differences of two hashes could cancel in a sum.
fn mixed(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

fn bytes(hash: u64, bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .fold(hash, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(PRIME))
}

/// A text and where it ends, so that neighbours cannot trade letters.
fn text(hash: u64, text: &str) -> u64 {
    let length = (text.len() as u64).to_le_bytes();
    bytes(bytes(hash, &length), text.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The published test vectors of FNV-1a.
    #[test]
    fn agrees_with_the_published_vectors() {
        assert_eq!(bytes(OFFSET_BASIS, b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(bytes(OFFSET_BASIS, b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(bytes(OFFSET_BASIS, b"foobar"), 0x8594_4171_f739_67e8);
    }
}
