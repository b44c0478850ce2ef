//! Named streams of random numbers.
//!
//! A stream is derived from (seed, name, index) and from nothing else, so a value does not depend on which other
//! values were drawn before it, nor on how many there are. All conversions from raw bits to numbers are here,
//! written out, because range sampling in libraries changes between versions.
//!
//! Derivation: FNV-1a (64 bit) over the seed's eight bytes, the name's bytes, a byte `0xff` that no UTF-8 text
//! contains, and the index's eight bytes, all little-endian; two steps of `SplitMix64` from there fill the 128-bit
//! state of a `Pcg64Mcg` generator.

use rand::Rng;
use rand_pcg::Pcg64Mcg;
use std::f64::consts::PI;
use std::fmt;

/// Offset basis of FNV-1a, 64 bit.
const FNV_BASIS: u64 = 0xcbf2_9ce4_8422_2325;

/// Prime of FNV-1a, 64 bit.
const FNV_PRIME: u64 = 0x0000_0100_0000_01b3;

/// Ends a name in the hash: a byte that is in no UTF-8 text.
const END_OF_NAME: u8 = 0xff;

/// `2^-53`: the spacing of the uniform numbers drawn here.
const ULP: f64 = 1.0 / 9_007_199_254_740_992.0;

/// A key path that names streams, kept as the hash of (seed, text so far).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StreamName {
    hash: u64,
}

impl StreamName {
    /// The empty path under a root seed.
    pub fn root(seed: u64) -> Self {
        Self {
            hash: fnv(FNV_BASIS, &seed.to_le_bytes()),
        }
    }

    /// This path with `text` behind it.
    #[must_use]
    pub fn join(mut self, text: fmt::Arguments<'_>) -> Self {
        // The only writer is the hash below, which never fails.
        let _ = fmt::write(&mut self, text);
        self
    }

    /// The stream number `index` of this name.
    pub fn stream(self, index: u64) -> Stream {
        let mut state = fnv(fnv(self.hash, &[END_OF_NAME]), &index.to_le_bytes());
        let (high, low) = (split_mix(&mut state), split_mix(&mut state));
        Stream {
            generator: Pcg64Mcg::new((u128::from(high) << 64) | u128::from(low)),
        }
    }

    /// A root seed for streams that shall differ from those of this path.
    pub fn seed(self, index: u64) -> u64 {
        self.stream(index).bits()
    }
}

impl fmt::Write for StreamName {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.hash = fnv(self.hash, text.as_bytes());
        Ok(())
    }
}

/// One stream of random numbers.
#[derive(Clone, Debug)]
pub struct Stream {
    generator: Pcg64Mcg,
}

impl Stream {
    /// The stream number `index` of a name under a root seed.
    pub fn new(seed: u64, name: &str, index: u64) -> Self {
        StreamName::root(seed).join(format_args!("{name}")).stream(index)
    }

    /// The next 64 raw bits.
    pub fn bits(&mut self) -> u64 {
        self.generator.next_u64()
    }

    /// Uniform in `[0, 1)`, a multiple of `2^-53`.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * ULP
    }

    /// Uniform in `[low, high)`; `low` when both are equal.
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// A normal deviate, by the Box–Muller transform; at most 8.6 standard deviations from the mean.
    pub fn normal(&mut self, mean: f64, standard_deviation: f64) -> f64 {
        let (radius, turn) = (1.0 - self.unit(), self.unit());
        let unit = (-2.0 * libm::log(radius)).sqrt() * libm::cos(2.0 * PI * turn);
        mean + standard_deviation * unit
    }

    /// Uniform in `0..count`; 0 for an empty range. The bias is below `count / 2^64`.
    pub fn index(&mut self, count: usize) -> usize {
        let wide = u128::from(self.bits()) * count as u128;
        #[expect(
            clippy::cast_possible_truncation,
            reason = "less than count, which is a usize"
        )]
        let index = (wide >> 64) as usize;
        index
    }
}

fn fnv(hash: u64, bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .fold(hash, |h, b| (h ^ u64::from(*b)).wrapping_mul(FNV_PRIME))
}

/// One step of `SplitMix64` (Steele, Lea, Flood 2014).
fn split_mix(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Computed by an independent implementation of the derivation above, in another language.
    #[test]
    fn the_streams_give_the_captured_values() {
        let mut bits = Stream::new(1, "ego.speed", 0);
        assert_eq!(
            [bits.bits(), bits.bits()],
            [17_790_995_127_637_970_320, 15_973_515_778_145_481_193]
        );
        let units = [0, 1, 2].map(|k| Stream::new(7, "parked[2].ahead", k).unit().to_bits());
        assert_eq!(
            units,
            [
                0x3fea_702b_6f01_2d9f,
                0x3fd1_ec82_b8ce_e242,
                0x3fbe_a987_2acd_1f28
            ]
        );
        let stream = || Stream::new(7, "n", 0);
        assert_eq!(stream().normal(1.0, 2.0).to_bits(), 0x3ff2_a59c_ace3_80cf);
        assert_eq!(stream().uniform(-3.0, 5.0).to_bits(), 0x3fce_170c_3d72_0600);
        assert_eq!(stream().index(1000), 404);
    }

    #[test]
    fn a_joined_name_is_the_whole_name() {
        let joined = StreamName::root(9)
            .join(format_args!("parked[{}]", 2))
            .join(format_args!(".ahead"));
        let mut whole = Stream::new(9, "parked[2].ahead", 4);
        assert_eq!(joined.stream(4).bits(), whole.bits());
    }

    #[test]
    fn neighbouring_seeds_names_and_indices_are_unrelated() {
        // Mean of |difference| of two independent uniform numbers is 1/3, its standard deviation 0.236.
        let pairs = [
            |k: u64| (Stream::new(k, "a", 0).unit(), Stream::new(k + 1, "a", 0).unit()),
            |k: u64| (Stream::new(k, "a", 0).unit(), Stream::new(k, "b", 0).unit()),
            |k: u64| (Stream::new(3, "a", k).unit(), Stream::new(3, "a", k + 1).unit()),
            |k: u64| (Stream::new(k, "a", 1).unit(), Stream::new(k + 1, "a", 0).unit()),
        ];
        for pair in pairs {
            let mean = (0..4000).map(pair).map(|(a, b)| (a - b).abs()).sum::<f64>() / 4000.0;
            assert!((mean - 1.0 / 3.0).abs() < 5.0 * 0.236 / 4000_f64.sqrt(), "{mean}");
        }
    }

    #[test]
    fn moments_are_those_of_the_laws() {
        let n = 20_000_u64;
        let all = |law: &dyn Fn(&mut Stream) -> f64| -> (f64, f64) {
            let values: Vec<f64> = (0..n).map(|k| law(&mut Stream::new(5, "law", k))).collect();
            let mean = values.iter().sum::<f64>() / n as f64;
            let variance = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / n as f64;
            (mean, variance)
        };
        let (mean, variance) = all(&|s| s.uniform(2.0, 8.0));
        assert!(
            (mean - 5.0).abs() < 0.06 && (variance - 3.0).abs() < 0.1,
            "{mean} {variance}"
        );
        let (mean, variance) = all(&|s| s.normal(-1.0, 0.5));
        assert!(
            (mean + 1.0).abs() < 0.018 && (variance - 0.25).abs() < 0.013,
            "{mean} {variance}"
        );
        let (mean, _) = all(&|s| s.index(5) as f64);
        assert!((mean - 2.0).abs() < 0.05, "{mean}");
    }

    #[test]
    fn ends_of_the_ranges_are_kept() {
        for k in 0..1000 {
            let mut s = Stream::new(k, "range", 0);
            assert!((3.0..4.0).contains(&s.uniform(3.0, 4.0)));
            assert!(s.index(3) < 3);
            assert!(s.normal(0.0, 1.0).is_finite());
        }
        assert_eq!(Stream::new(1, "empty", 0).index(0), 0);
    }
}
