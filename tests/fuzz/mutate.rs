//! Damage, at random but repeatable: what transmission, editors and careless programs do to files, and what someone
//! does who wants to see them fail.
//!
//! A mutation knows nothing of formats but what all of them share: numbers, words, elements between a beginning and its
//! end (tags, braces, sections, lines). Binary messages share eight-byte numbers behind a tag of that wire type.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use std::ops::Range;

/// Numbers that are none, are too large, or sit where a sign, a digit or a bit runs out.
const EXTREMES: [&str; 20] = [
    "nan",
    "inf",
    "-inf",
    "1e308",
    "-1e308",
    "1e-308",
    "0",
    "-0",
    "-1",
    "1",
    "0.0001",
    "1e5",
    "99999",
    "1e9",
    "2147483648",
    "4294967296",
    "-9223372036854775809",
    "18446744073709551616",
    "1e30",
    "0x10",
];

/// Words that mean something to some format.
const WORDS: [&str; 10] = [
    "left",
    "right",
    "driving",
    "true",
    "\"\"",
    "<a/>",
    "{}",
    "[]",
    "#",
    "\u{e9}\u{0}",
];

/// How deep elements are put into each other: a little, deeper than a limit for people, and deeper than a stack.
const DEPTHS: [usize; 4] = [1, 2, 40, 3000];

/// How often an element is repeated.
const COPIES: [usize; 3] = [1, 3, 200];

/// Largest input that is made, as a multiple of what it is made of, and in bytes beyond that.
const GROWTH: (usize, usize) = (4, 200_000);

/// A source of damage.
pub(crate) struct Mutator {
    random: Pcg64Mcg,
}

impl Mutator {
    pub(crate) fn new(seed: u64) -> Self {
        Self {
            random: Pcg64Mcg::seed_from_u64(seed),
        }
    }

    /// A number below `limit`; 0 where there is none.
    pub(crate) fn below(&mut self, limit: usize) -> usize {
        let limit = u64::try_from(limit.max(1)).expect("fits");
        usize::try_from(self.random.next_u64() % limit).expect("was one")
    }

    fn pick<'a, T>(&mut self, of: &'a [T]) -> &'a T {
        &of[self.below(of.len())]
    }

    /// `original` damaged once, as often as not once more, and so on; `other` lends pieces.
    pub(crate) fn damaged(&mut self, original: &[u8], other: &[u8]) -> Vec<u8> {
        let mut bytes = self.once(original.to_vec(), other);
        while self.below(2) == 0 && bytes.len() <= GROWTH.0 * original.len() + GROWTH.1 {
            bytes = self.once(bytes, other);
        }
        bytes
    }

    fn once(&mut self, mut bytes: Vec<u8>, other: &[u8]) -> Vec<u8> {
        if bytes.is_empty() {
            return other[..self.below(other.len())].to_vec();
        }
        let at = self.below(bytes.len());
        match self.below(20) {
            0 => bytes[at] ^= 1 << self.below(8),
            1 => bytes[at] = u8::try_from(self.below(256)).expect("is below 256"),
            2 => bytes.truncate(at),
            3 => replace(&mut bytes, at..at + self.below(64), b""),
            4 => self.copy_word(&mut bytes, at),
            5..=8 => {
                let number = *self.pick(&EXTREMES);
                let range = run(&bytes, at, is_of_number);
                replace(&mut bytes, range, number.as_bytes());
            }
            9 => {
                let word = *self.pick(&WORDS);
                let range = run(&bytes, at, is_of_word);
                replace(&mut bytes, range, word.as_bytes());
            }
            10..=12 => self.replace_double(&mut bytes, at),
            13 | 14 => {
                let digit = bytes[at..].iter_mut().find(|byte| byte.is_ascii_digit());
                let other = b"0123456789.-"[self.below(12)];
                if let Some(digit) = digit {
                    *digit = other;
                }
            }
            15 | 16 => {
                let range = element(&bytes, at);
                let copies = bytes[range.clone()].repeat(*self.pick(&COPIES));
                bytes.splice(range.end..range.end, copies);
            }
            17 => self.nest(&mut bytes, at),
            18 => {
                let range = element(&bytes, at);
                replace(&mut bytes, range, b"");
            }
            _ => {
                let piece = &other[element(other, self.below(other.len()))];
                let end = element(&bytes, at).end;
                bytes.splice(end..end, piece.iter().copied());
            }
        }
        bytes
    }

    /// Puts a word of the input in another one's place: names that no longer match, or match where they must not.
    fn copy_word(&mut self, bytes: &mut Vec<u8>, at: usize) {
        let from = run(bytes, self.below(bytes.len()), is_of_word);
        let word = bytes[from].to_vec();
        let to = run(bytes, at, is_of_word);
        replace(bytes, to, &word);
    }

    /// Another number behind the next tag of an eight-byte field of a binary message; in a text, another number.
    fn replace_double(&mut self, bytes: &mut Vec<u8>, at: usize) {
        if std::str::from_utf8(bytes).is_ok() {
            let number = *self.pick(&EXTREMES);
            let range = run(bytes, at, is_of_number);
            return replace(bytes, range, number.as_bytes());
        }
        let value: f64 = self.pick(&EXTREMES).parse().unwrap_or(f64::MAX);
        let tag = bytes[at..].iter().position(|byte| byte & 7 == 1 && *byte > 7);
        let start = tag.map_or(at, |tag| at + tag + 1);
        for (to, from) in bytes[start..].iter_mut().zip(value.to_le_bytes()) {
            *to = from;
        }
    }

    /// Puts an element into itself, again and again.
    fn nest(&mut self, bytes: &mut Vec<u8>, at: usize) {
        let range = element(bytes, at);
        let whole = bytes[range.clone()].to_vec();
        let (begin, end) = match whole.iter().position(|byte| matches!(byte, b'{' | b'[' | b'>')) {
            Some(open) if whole[open] == b'>' => {
                let name = run(&whole, 0, is_of_word);
                let close = [b"</", &whole[name], b">"].concat();
                (whole[..=open].to_vec(), close)
            }
            Some(open) => (whole[..=open].to_vec(), whole[whole.len() - 1..].to_vec()),
            None => (b"[".to_vec(), b"]".to_vec()),
        };
        let depth = *self.pick(&DEPTHS);
        let nested = [begin.repeat(depth), whole, end.repeat(depth)].concat();
        bytes.splice(range, nested);
    }
}

/// Puts `with` in the place of a range, as far as the range lies inside.
fn replace(bytes: &mut Vec<u8>, range: Range<usize>, with: &[u8]) {
    let end = range.end.min(bytes.len());
    bytes.splice(range.start.min(end)..end, with.iter().copied());
}

fn is_of_number(byte: u8) -> bool {
    byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+')
}

fn is_of_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || matches!(byte, b'.' | b'-' | b'+' | b'_')
}

/// The next run of such bytes from `at` on; empty at the end where there is none.
fn run(bytes: &[u8], at: usize, is_of_run: fn(u8) -> bool) -> Range<usize> {
    let start = bytes[at..].iter().position(|byte| is_of_run(*byte));
    let start = start.map_or(bytes.len(), |start| at + start);
    let length = bytes[start..].iter().position(|byte| !is_of_run(*byte));
    start..length.map_or(bytes.len(), |length| start + length)
}

/// The next element from `at` on: a tag with what is in it, or braces with the name before them, or a line.
fn element(bytes: &[u8], at: usize) -> Range<usize> {
    let begins = |byte: &u8| matches!(byte, b'<' | b'{' | b'[' | b'\n');
    let Some(open) = bytes[at..].iter().position(begins).map(|open| at + open) else {
        return at..bytes.len();
    };
    let rest = &bytes[open..];
    match bytes[open] {
        b'<' => open..open + end_of_tag(rest),
        b'{' | b'[' => {
            let named = bytes[..open]
                .iter()
                .rposition(|byte| matches!(byte, b'\n' | b'{' | b'}' | b','));
            named.map_or(0, |before| before + 1)..open + end_of_braces(rest)
        }
        _ => {
            let end = rest[1..].iter().position(|byte| *byte == b'\n');
            open + 1..end.map_or(bytes.len(), |end| open + end + 2)
        }
    }
}

/// Length of the tag at the beginning with what is in it.
fn end_of_tag(text: &[u8]) -> usize {
    let head = text
        .iter()
        .position(|byte| *byte == b'>')
        .map_or(text.len(), |end| end + 1);
    if text[..head].ends_with(b"/>") || !text.get(1).is_some_and(u8::is_ascii_alphabetic) {
        return head;
    }
    let close = [b"</", &text[run(text, 0, is_of_word)], b">"].concat();
    let end = text.windows(close.len()).position(|window| window == close);
    end.map_or(head, |end| end + close.len())
}

/// Length of the braces at the beginning with what is in them.
fn end_of_braces(text: &[u8]) -> usize {
    let mut depth = 0_usize;
    for (at, byte) in text.iter().enumerate() {
        match byte {
            b'{' | b'[' => depth += 1,
            b'}' | b']' => depth = depth.saturating_sub(1),
            _ => continue,
        }
        if depth == 0 {
            return at + 1;
        }
    }
    text.len()
}
