//! A hash over exact bits: 64-bit FNV-1a (Fowler, Noll, Vo), the same on every machine.

/// The hash of no bytes at all, by definition of FNV-1a.
const OFFSET_BASIS: u64 = 0xcbf2_9ce4_8422_2325;
/// The multiplier of 64-bit FNV, by definition.
const PRIME: u64 = 0x0000_0100_0000_01b3;

/// A running hash.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fnv(u64);

impl Fnv {
    pub(crate) fn new() -> Self {
        Self(OFFSET_BASIS)
    }

    /// Takes in the bytes of a word, lowest first.
    pub(crate) fn word(&mut self, word: u64) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(PRIME);
        }
    }

    /// Takes in the bits of numbers. `-0.0` and `0.0` differ.
    pub(crate) fn numbers<const N: usize>(&mut self, numbers: [f64; N]) {
        for number in numbers {
            self.word(number.to_bits());
        }
    }

    pub(crate) fn finish(self) -> u64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_a_plain_byte_loop_and_sees_every_bit() {
        let mut hash = Fnv::new();
        hash.word(0x61);
        let mut by_hand = 0xaf63_dc4c_8601_ec8c_u64; // FNV-1a of "a", from the published test vectors.
        for _ in 0..7 {
            by_hand = by_hand.wrapping_mul(PRIME);
        }
        assert_eq!(hash.finish(), by_hand);
        let of = |x: f64| {
            let mut hash = Fnv::new();
            hash.numbers([x]);
            hash.finish()
        };
        assert_ne!(of(0.0), of(-0.0));
        assert_ne!(of(1.0), of(1.0 + f64::EPSILON));
    }
}
