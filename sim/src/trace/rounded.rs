//! A JSON formatter that writes numbers to four decimals.
//!
//! A tenth of a millimetre, of a milliradian, of a millimetre per second: ten times below what a picture can
//! show or a check asks for. It makes the text of a decision a third as long, and integer arithmetic writes it
//! faster than the shortest exact decimal could be found.

use serde_json::ser::{CompactFormatter, Formatter};
use std::io;

/// Steps per unit.
const SCALE: f64 = 1e4;

/// From here on a step is finer than the number itself; such numbers are written exactly.
const LARGEST: f64 = 1e11;

/// Place of the point in the text: eleven digits and a sign fit before it.
const POINT: usize = 12;

/// A sign, eleven digits, a point, four digits.
const LENGTH: usize = POINT + 5;

/// The digits of 0 to 99, two each: one division gives two digits.
const PAIRS: [[u8; 2]; 100] = {
    let mut pairs = [[b'0'; 2]; 100];
    let mut k = 0_u8;
    while k < 100 {
        pairs[k as usize] = [b'0' + k / 10, b'0' + k % 10];
        k += 1;
    }
    pairs
};

/// Writes `f64` rounded, and everything else without spaces.
pub(super) struct Rounded;

impl Formatter for Rounded {
    fn write_f64<W: ?Sized + io::Write>(&mut self, writer: &mut W, value: f64) -> io::Result<()> {
        if value.abs() >= LARGEST {
            return CompactFormatter.write_f64(writer, value);
        }
        let mut text = [b'.'; LENGTH];
        let (start, end) = decimal(&mut text, value);
        writer.write_all(&text[start..end])
    }
}

/// Puts `value` into `text` in decimals, without trailing zeros. Returns where it starts and ends.
fn decimal(text: &mut [u8; LENGTH], value: f64) -> (usize, usize) {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "not negative and below 1e15; adding a half and cutting off rounds"
    )]
    let steps = (value.abs() * SCALE + 0.5) as u64;
    let (whole, fraction) = (steps / 10_000, (steps % 10_000) as usize);
    let start = integer(text, whole);
    let places = decimals(text, fraction);
    let end = if places == 0 { POINT } else { POINT + 1 + places };
    if value < 0.0 && steps > 0 {
        text[start - 1] = b'-';
        return (start - 1, end);
    }
    (start, end)
}

/// Puts the digits of `whole` before the point. Returns where they start.
fn integer(text: &mut [u8; LENGTH], mut whole: u64) -> usize {
    let mut at = POINT;
    while whole >= 10 {
        at -= 2;
        text[at..at + 2].copy_from_slice(&PAIRS[(whole % 100) as usize]);
        whole /= 100;
    }
    if whole > 0 || at == POINT {
        at -= 1;
        text[at] = PAIRS[(whole % 10) as usize][1];
    }
    at
}

/// Puts the four digits of `fraction` behind the point. Returns how many matter.
fn decimals(text: &mut [u8; LENGTH], fraction: usize) -> usize {
    let (high, low) = (fraction / 100, fraction % 100);
    text[POINT + 1..POINT + 3].copy_from_slice(&PAIRS[high]);
    text[POINT + 3..POINT + 5].copy_from_slice(&PAIRS[low]);
    match (high, low) {
        (0, 0) => 0,
        (high, 0) => 2 - usize::from(high % 10 == 0),
        (_, low) => 4 - usize::from(low % 10 == 0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use serde::Serialize;

    fn text(value: f64) -> String {
        let mut out = Vec::new();
        value
            .serialize(&mut serde_json::Serializer::with_formatter(&mut out, Rounded))
            .unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn numbers_are_short_and_plain() {
        let cases = [
            (0.0, "0"),
            (-0.0, "0"),
            (-0.000_04, "0"),
            (0.000_05, "0.0001"),
            (-12.5, "-12.5"),
            (100.0, "100"),
            (1.000_1, "1.0001"),
            (7.3, "7.3"),
            (10.03, "10.03"),
            (-345.02, "-345.02"),
            (6_789.120_3, "6789.1203"),
            (-0.999_96, "-1"),
            (-99_999_999_999.0, "-99999999999"),
            (f64::MAX, "1.7976931348623157e+308"),
        ];
        for (value, expected) in cases {
            assert_eq!(text(value), expected);
        }
    }

    proptest! {
        #[test]
        fn rounding_is_to_the_nearest_step(value in -1e9..1e9_f64) {
            let read: f64 = text(value).parse().unwrap();
            prop_assert!((read - value).abs() <= 0.5 / SCALE + 1e-6, "{value} became {read}");
            prop_assert_eq!(text(read), text(value), "writing what was read changes nothing");
        }
    }
}
