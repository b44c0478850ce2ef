//! From fields of a text to values of messages.

use super::super::messages::Names;
use super::TextError;
use super::parser::{Content, Field};

/// What can stand in a field.
pub(in super::super) trait Value: Sized {
    /// Reads a field's value. `names` are those of an enumeration's values.
    fn read(field: &Field<'_>, names: Names) -> Result<Self, TextError>;
}

/// A place in a message that a field of the text fills.
pub(in super::super) trait Slot {
    /// Adds what the field holds.
    fn put(&mut self, field: &Field<'_>, names: Names) -> Result<(), TextError>;
}

impl<V: Value> Slot for Option<V> {
    fn put(&mut self, field: &Field<'_>, names: Names) -> Result<(), TextError> {
        if self.is_some() {
            let problem = format!("there is a second `{}`", field.name);
            return Err(TextError::new(
                field.at,
                problem,
                "it at most once in its message",
            ));
        }
        *self = Some(V::read(field, names)?);
        Ok(())
    }
}

impl<V: Value> Slot for Vec<V> {
    fn put(&mut self, field: &Field<'_>, names: Names) -> Result<(), TextError> {
        self.push(V::read(field, names)?);
        Ok(())
    }
}

/// An error about a field's value.
fn wrong<T>(field: &Field<'_>, expected: impl Into<String>) -> Result<T, TextError> {
    const SHOWN: usize = 40;
    let value = match &field.content {
        Content::Scalar { negative, text } => {
            let sign = if *negative { "-" } else { "" };
            format!("{sign}{}", text.chars().take(SHOWN).collect::<String>())
        }
        Content::Quoted(text) => format!("{:?}", text.chars().take(SHOWN).collect::<String>()),
        Content::Block(_) => "a message".to_owned(),
    };
    Err(TextError::new(
        field.at,
        format!("`{}` is {value}", field.name),
        expected,
    ))
}

impl Value for f64 {
    fn read(field: &Field<'_>, _: Names) -> Result<Self, TextError> {
        let expected = "a number";
        let Content::Scalar { negative, text } = &field.content else {
            return wrong(field, expected);
        };
        // The C++ writer marks single precision by an f; Rust knows inf and nan in any case.
        let digits = text.starts_with(|c: char| c.is_ascii_digit() || c == '.');
        let bare = if digits {
            text.trim_end_matches(['f', 'F'])
        } else {
            text
        };
        match bare.parse::<Self>() {
            Ok(number) => Ok(if *negative { -number } else { number }),
            Err(_) => wrong(field, expected),
        }
    }
}

impl Value for bool {
    fn read(field: &Field<'_>, _: Names) -> Result<Self, TextError> {
        match &field.content {
            Content::Scalar {
                negative: false,
                text,
            } => match *text {
                "true" | "True" | "t" | "1" => Ok(true),
                "false" | "False" | "f" | "0" => Ok(false),
                _ => wrong(field, "true or false"),
            },
            _ => wrong(field, "true or false"),
        }
    }
}

impl Value for String {
    fn read(field: &Field<'_>, _: Names) -> Result<Self, TextError> {
        match &field.content {
            Content::Quoted(text) => Ok(text.clone()),
            _ => wrong(field, "a string in quotes"),
        }
    }
}

/// The value of an enumeration, by name or by number.
impl Value for i32 {
    fn read(field: &Field<'_>, names: Names) -> Result<Self, TextError> {
        if let Content::Scalar { negative, text } = &field.content {
            let known = names.iter().find(|(name, _)| name == text);
            let number = known
                .map(|(_, number)| *number)
                .or_else(|| text.parse::<Self>().ok());
            if let Some(number) = number {
                return Ok(if *negative { -number } else { number });
            }
        }
        let names: Vec<&str> = names.iter().map(|(name, _)| *name).collect();
        wrong(field, format!("one of {}", names.join(", ")))
    }
}
