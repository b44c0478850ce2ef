//! Tokens of the text format, each with the byte where it starts.

use super::TextError;

/// A piece of text that cannot be divided.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token<'a> {
    /// The name of a field or of a value.
    Word(&'a str),
    /// A number, as it is written.
    Number(&'a str),
    /// A string without its quotes and escapes.
    Quoted(String),
    /// One of `{ } < > [ ] : , ; -`.
    Mark(char),
    /// There is no more.
    End,
}

impl Token<'_> {
    /// What it is, for a message.
    pub(super) fn describe(&self) -> String {
        const SHOWN: usize = 40;
        match self {
            Self::Word(text) | Self::Number(text) => {
                format!("`{}`", text.chars().take(SHOWN).collect::<String>())
            }
            Self::Quoted(text) => format!("{:?}", text.chars().take(SHOWN).collect::<String>()),
            Self::Mark(mark) => format!("`{mark}`"),
            Self::End => "the end of the text".to_owned(),
        }
    }
}

/// Walks over a text.
#[derive(Clone, Debug)]
pub(super) struct Lexer<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Lexer<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        let at = if text.starts_with('\u{feff}') { 3 } else { 0 };
        Self { text, at }
    }

    /// The next token and where it starts.
    pub(super) fn next(&mut self) -> Result<(usize, Token<'a>), TextError> {
        self.skip_blanks();
        let start = self.at;
        let Some(first) = self.rest().chars().next() else {
            return Ok((start, Token::End));
        };
        let token = match first {
            'a'..='z' | 'A'..='Z' | '_' => Token::Word(self.take_while(is_word)),
            '0'..='9' | '.' => Token::Number(self.take_number()),
            '"' | '\'' => Token::Quoted(self.take_quoted(first)?),
            '{' | '}' | '<' | '>' | '[' | ']' | ':' | ',' | ';' | '-' => {
                self.at += 1;
                Token::Mark(first)
            }
            other => {
                let problem = format!("there is a {other:?}");
                return Err(TextError::new(start, problem, "a field, such as `id: 1`"));
            }
        };
        Ok((start, token))
    }

    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    /// Blanks and comments, which end with their line.
    fn skip_blanks(&mut self) {
        loop {
            self.take_while(char::is_whitespace);
            if !self.rest().starts_with('#') {
                return;
            }
            self.take_while(|c| c != '\n');
        }
    }

    fn take_while(&mut self, is_inside: impl Fn(char) -> bool) -> &'a str {
        let rest = self.rest();
        let length = rest.find(|c| !is_inside(c)).unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    /// Letters and digits, and the sign of an exponent.
    fn take_number(&mut self) -> &'a str {
        let start = self.at;
        loop {
            self.take_while(|c| is_word(c) || c == '.');
            let so_far = &self.text[start..self.at];
            let exponent = so_far.ends_with(['e', 'E']) && !so_far.starts_with("0x");
            if !exponent || !self.rest().starts_with(['+', '-']) {
                return so_far;
            }
            self.at += 1;
        }
    }

    /// A string up to its closing quote, on one line.
    fn take_quoted(&mut self, quote: char) -> Result<String, TextError> {
        let start = self.at;
        self.at += 1;
        let mut bytes = Vec::new();
        loop {
            bytes.extend_from_slice(
                self.take_while(|c| c != quote && c != '\\' && c != '\n')
                    .as_bytes(),
            );
            match self.rest().chars().next() {
                Some(c) if c == quote => break,
                Some('\\') => self.take_escape(&mut bytes)?,
                _ => {
                    return Err(TextError::new(
                        start,
                        "a string does not end on its line",
                        format!("a closing {quote}"),
                    ));
                }
            }
        }
        self.at += 1;
        String::from_utf8(bytes)
            .map_err(|_| TextError::new(start, "a string is not UTF-8", "escapes that make up UTF-8"))
    }

    /// What a backslash and the letters after it stand for.
    fn take_escape(&mut self, bytes: &mut Vec<u8>) -> Result<(), TextError> {
        let start = self.at;
        self.at += 1;
        let Some(letter) = self.rest().chars().next() else {
            return Err(TextError::new(
                start,
                "the text ends in a string",
                "a closing quote",
            ));
        };
        let digits = |rest: &str, radix: u32, most: usize| {
            let count = rest.chars().take(most).take_while(|c| c.is_digit(radix)).count();
            (count, u32::from_str_radix(&rest[..count], radix).ok())
        };
        let (length, code) = match letter {
            '0'..='7' => digits(self.rest(), 8, 3),
            'x' | 'X' => {
                let (count, code) = digits(&self.rest()[1..], 16, 2);
                (count + 1, code)
            }
            _ => (letter.len_utf8(), simple_escape(letter)),
        };
        let byte = code.and_then(|code| u8::try_from(code).ok());
        let expected = "one of \\n \\r \\t \\a \\b \\f \\v \\\\ \\' \\\" \\? \\101 \\x41";
        bytes.push(
            byte.ok_or_else(|| TextError::new(start, format!("there is no escape \\{letter}"), expected))?,
        );
        self.at += length;
        Ok(())
    }
}

fn is_word(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

fn simple_escape(letter: char) -> Option<u32> {
    Some(match letter {
        'n' => 10,
        'r' => 13,
        't' => 9,
        'a' => 7,
        'b' => 8,
        'f' => 12,
        'v' => 11,
        '\\' | '\'' | '"' | '?' => u32::from(letter),
        _ => return None,
    })
}
