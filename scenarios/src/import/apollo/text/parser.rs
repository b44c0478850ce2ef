//! Nests tokens into fields. Fields of the outermost level come one by one, so that a large file is never a tree as
//! a whole.

use super::TextError;
use super::lexer::{Lexer, Token};

/// Deepest nesting. Maps nest nine deep.
const MAX_DEPTH: usize = 32;

/// Most fields inside one field of the outermost level: a lane with 250,000 points.
const MAX_FIELDS: usize = 1_000_000;

/// `name: value` or `name { ... }`.
#[derive(Clone, Debug, PartialEq)]
pub(in super::super) struct Field<'a> {
    pub(in super::super) name: &'a str,
    /// Byte of the text where the name starts.
    pub(in super::super) at: usize,
    pub(in super::super) content: Content<'a>,
}

/// The right-hand side of a field.
#[derive(Clone, Debug, PartialEq)]
pub(in super::super) enum Content<'a> {
    /// A number or the name of a value.
    Scalar { negative: bool, text: &'a str },
    /// A string.
    Quoted(String),
    /// A message.
    Block(Vec<Field<'a>>),
}

impl<'a> Field<'a> {
    /// The fields inside, of a message.
    pub(in super::super) fn inside(&self) -> Result<&[Field<'a>], TextError> {
        match &self.content {
            Content::Block(fields) => Ok(fields),
            _ => Err(TextError::new(
                self.at,
                format!("`{}` is a single value", self.name),
                format!("a message, as in `{} {{ ... }}`", self.name),
            )),
        }
    }
}

/// Reads fields one after the other.
#[derive(Debug)]
pub(in super::super) struct Parser<'a> {
    lexer: Lexer<'a>,
    /// The token that comes next.
    at: usize,
    next: Token<'a>,
    /// Fields seen inside the present one.
    count: usize,
    /// Elements of a list of which the first ones have been handed out.
    pending: std::vec::IntoIter<Field<'a>>,
}

impl<'a> Parser<'a> {
    pub(in super::super) fn new(text: &'a str) -> Result<Self, TextError> {
        let mut lexer = Lexer::new(text);
        let (at, next) = lexer.next()?;
        Ok(Self {
            lexer,
            at,
            next,
            count: 0,
            pending: Vec::new().into_iter(),
        })
    }

    /// The next field of the outermost level, if there is one more.
    pub(in super::super) fn next_field(&mut self) -> Result<Option<Field<'a>>, TextError> {
        loop {
            if let Some(field) = self.pending.next() {
                return Ok(Some(field));
            }
            if self.next == Token::End {
                return Ok(None);
            }
            self.count = 0;
            let mut fields = Vec::new();
            self.field(&mut fields, 0)?;
            self.pending = fields.into_iter();
        }
    }

    /// Everything that is left, as the inside of one message.
    pub(in super::super) fn whole(mut self, name: &'static str) -> Result<Field<'a>, TextError> {
        let mut fields = Vec::new();
        while self.next != Token::End {
            self.field(&mut fields, 0)?;
        }
        Ok(Field {
            name,
            at: 0,
            content: Content::Block(fields),
        })
    }

    fn advance(&mut self) -> Result<Token<'a>, TextError> {
        let (at, next) = self.lexer.next()?;
        self.at = at;
        Ok(std::mem::replace(&mut self.next, next))
    }

    fn skip(&mut self, mark: char) -> Result<bool, TextError> {
        let found = self.next == Token::Mark(mark);
        if found {
            self.advance()?;
        }
        Ok(found)
    }

    fn unexpected<T>(&self, expected: impl Into<String>) -> Result<T, TextError> {
        let problem = format!("there is {}", self.next.describe());
        Err(TextError::new(self.at, problem, expected))
    }

    /// One field, which is several when its value is a list.
    fn field(&mut self, fields: &mut Vec<Field<'a>>, depth: usize) -> Result<(), TextError> {
        let at = self.at;
        let Token::Word(name) = self.next else {
            return self.unexpected("the name of a field");
        };
        self.advance()?;
        let colon = self.skip(':')?;
        if self.skip('[')? {
            while !self.skip(']')? {
                let content = self.content(name, depth, true)?;
                self.push(fields, Field { name, at, content })?;
                if !self.skip(',')? && self.next != Token::Mark(']') {
                    return self.unexpected("`,` or `]`");
                }
            }
        } else {
            let content = self.content(name, depth, colon)?;
            self.push(fields, Field { name, at, content })?;
        }
        if !self.skip(',')? {
            self.skip(';')?;
        }
        Ok(())
    }

    fn push(&mut self, fields: &mut Vec<Field<'a>>, field: Field<'a>) -> Result<(), TextError> {
        self.count += 1;
        if self.count > MAX_FIELDS {
            let problem = format!("more than {MAX_FIELDS} fields belong together");
            return Err(TextError::new(field.at, problem, "a smaller message"));
        }
        fields.push(field);
        Ok(())
    }

    /// The value after a name; without a colon it must be a message.
    fn content(&mut self, name: &str, depth: usize, colon: bool) -> Result<Content<'a>, TextError> {
        let closing = match self.next {
            Token::Mark('{') => '}',
            Token::Mark('<') => '>',
            _ if colon => return self.scalar(name),
            _ => return self.unexpected(format!("`:` or `{{` after `{name}`")),
        };
        if depth == MAX_DEPTH {
            let problem = format!("messages are nested more than {MAX_DEPTH} deep");
            return Err(TextError::new(self.at, problem, "a map, which nests nine deep"));
        }
        let opened = self.at;
        self.advance()?;
        let mut fields = Vec::new();
        while !self.skip(closing)? {
            if self.next == Token::End {
                let problem = format!("`{name}` is not closed");
                return Err(TextError::new(opened, problem, format!("a `{closing}`")));
            }
            self.field(&mut fields, depth + 1)?;
        }
        Ok(Content::Block(fields))
    }

    /// A number, a name or a string; strings side by side are one.
    fn scalar(&mut self, name: &str) -> Result<Content<'a>, TextError> {
        let negative = self.skip('-')?;
        match self.next {
            Token::Word(text) | Token::Number(text) => {
                self.advance()?;
                Ok(Content::Scalar { negative, text })
            }
            Token::Quoted(_) if !negative => {
                let mut whole = String::new();
                while matches!(self.next, Token::Quoted(_)) {
                    if let Token::Quoted(part) = self.advance()? {
                        whole.push_str(&part);
                    }
                }
                Ok(Content::Quoted(whole))
            }
            _ => self.unexpected(format!("a value for `{name}`")),
        }
    }
}
