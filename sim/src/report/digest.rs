//! One hash over a sweep: FNV-1a, 64 bit (Fowler, Noll, Vo). It finds differences; it does not keep secrets.

use super::{RunResult, SweepRow};

const OFFSET_BASIS: u64 = 0xcbf2_9ce4_8422_2325;
const PRIME: u64 = 0x0000_0100_0000_01b3;

/// The hash of rows in the order given, hexadecimal. Of a row counts what a run of the same seed must repeat: its
/// ending, its judgement and the digest of its states.
pub(super) fn of(rows: &[SweepRow]) -> String {
    let mut hash = OFFSET_BASIS;
    for row in rows {
        hash = text(hash, &row.scenario);
        hash = bytes(hash, &row.seed.to_le_bytes());
        hash = match &row.result {
            RunResult::Judged(verdict) => {
                let marks = [1, verdict.ending as u8, u8::from(verdict.pass)];
                text(bytes(hash, &marks), &verdict.digest)
            }
            RunResult::Broken(reason) => text(bytes(hash, &[0]), reason),
        };
    }
    format!("{hash:016x}")
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
