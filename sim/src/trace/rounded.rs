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

/// Longest text: a sign, 18 digits, a point.
const LENGTH: usize = 20;

/// Writes `f64` rounded, and everything else without spaces.
pub(super) struct Rounded;

impl Formatter for Rounded {
    fn write_f64<W: ?Sized + io::Write>(&mut self, writer: &mut W, value: f64) -> io::Result<()> {
        if value.abs() >= LARGEST {
            return CompactFormatter.write_f64(writer, value);
        }
        let mut text = [0; LENGTH];
        let start = decimal(&mut text, value);
        writer.write_all(&text[start..])
    }
}

/// Fills `text` from its end with `value` in decimals, without trailing zeros. Returns where the text starts.
fn decimal(text: &mut [u8; LENGTH], value: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "not negative and below 1e15; adding a half and cutting off rounds"
    )]
    let steps = (value.abs() * SCALE + 0.5) as u64;
    let (mut whole, mut fraction) = (steps / 10_000, steps % 10_000);
    let mut at = LENGTH;
    let mut push = |byte: u8| {
        at -= 1;
        text[at] = byte;
    };
    if fraction > 0 {
        let mut places = 4;
        while fraction % 10 == 0 {
            fraction /= 10;
            places -= 1;
        }
        for _ in 0..places {
            push(last_digit(fraction));
            fraction /= 10;
        }
        push(b'.');
    }
    push(last_digit(whole));
    whole /= 10;
    while whole > 0 {
        push(last_digit(whole));
        whole /= 10;
    }
    if value < 0.0 && steps > 0 {
        push(b'-');
    }
    at
}

fn last_digit(number: u64) -> u8 {
    let digit = (number % 10) as u8;
    b'0' + digit
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
            (-0.999_96, "-1"),
            (99_999_999_999.0, "99999999999"),
            (f64::MAX, "1.7976931348623157e308"),
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
