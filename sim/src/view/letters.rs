//! Whole numbers as letters: small ones take one, and none needs a comma.
//!
//! A number is doubled, less one and positive if it was negative, and written in base 45 with the low digits first;
//! digits that others follow are 45 letters further on. `core.js` reads it.

/// Digits of a letter.
const BASE: u64 = 45;

/// The first letter; from it on all but `<` and `\`, which JSON or a page would have to write as several.
const FIRST: u8 = b'#';

/// The numbers, one after the other.
pub(super) fn letters(numbers: impl IntoIterator<Item = i64>) -> String {
    let mut text = String::new();
    for number in numbers {
        let mut rest = 2 * number.unsigned_abs() - u64::from(number < 0);
        while rest >= BASE {
            text.push(letter(rest % BASE + BASE));
            rest /= BASE;
        }
        text.push(letter(rest));
    }
    text
}

/// Each number less the one before it.
pub(super) fn differences(numbers: impl IntoIterator<Item = i64>) -> impl Iterator<Item = i64> {
    numbers.into_iter().scan(0, |last, number| {
        let difference = number - *last;
        *last = number;
        Some(difference)
    })
}

fn letter(digit: u64) -> char {
    let plain = FIRST + u8::try_from(digit).expect("a digit is below twice the base");
    let past = |letter: u8| u8::from(letter >= b'<');
    let without_angle = plain + past(plain);
    char::from(without_angle + u8::from(without_angle >= b'\\'))
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use proptest::prelude::*;

    /// What `core.js` does.
    pub(in crate::view) fn numbers(text: &str) -> Vec<i64> {
        let (mut all, mut number, mut scale) = (Vec::new(), 0, 1);
        for letter in text.bytes() {
            let digit = i64::from(letter - FIRST - u8::from(letter > b'<') - u8::from(letter > b'\\'));
            number += digit % 45 * scale;
            scale *= 45;
            if digit < 45 {
                all.push(if number % 2 == 0 {
                    number / 2
                } else {
                    -(number + 1) / 2
                });
                (number, scale) = (0, 1);
            }
        }
        all
    }

    #[test]
    fn small_numbers_take_one_letter() {
        assert_eq!(letters([0, -1, 1, 22, -22, 23]), "#$%POR$");
        assert_eq!(letters(-22..=22).len(), 45);
        let all: String = (0..90).map(letter).collect();
        assert!(all.ends_with('~') && !all.contains(['<', '\\', '"']), "{all}");
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn what_is_written_can_be_read(all in prop::collection::vec(-1_000_000_000_i64..1_000_000_000, 0..40)) {
            prop_assert_eq!(numbers(&letters(all.iter().copied())), all.clone());
            let mut sum = 0;
            let sums: Vec<i64> = differences(all.iter().copied()).map(|step| { sum += step; sum }).collect();
            prop_assert_eq!(sums, all);
        }
    }
}
