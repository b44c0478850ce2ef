//! A message of either form, not yet decoded, that can say where in its file something is wrong.

use super::fault::Fault;
use super::text::{Content, Field, Value, place};
use crate::import::{ImportError, TextPlace};

/// Largest message below the map itself, bytes: a lane of about 50,000 points. Decoded, a hostile one takes forty
/// times as much.
const MAX_RECORD: usize = 4 << 20;

/// How every error of the decoder begins.
pub(super) const NOISE: &str = "failed to decode Protobuf message: ";

/// A field of the outermost level.
#[derive(Debug)]
pub(super) enum Record<'a> {
    /// Its bytes.
    Wire(&'a [u8]),
    /// Its tree, and the text that it is part of.
    Text { text: &'a str, field: Field<'a> },
}

impl Record<'_> {
    /// The message inside.
    pub(super) fn decode<M: prost::Message + Default + Value>(&self) -> Result<M, Mistake> {
        match self {
            Self::Wire(bytes) if bytes.len() > MAX_RECORD => {
                let problem = format!("has {} bytes", bytes.len());
                Err(Fault::new(problem, format!("at most {MAX_RECORD}")).into())
            }
            Self::Wire(bytes) => M::decode(*bytes).map_err(|error| undecodable(&error).into()),
            Self::Text { text, field } => {
                M::read(field, &[]).map_err(|error| Mistake::Error(error.into_error(text)))
            }
        }
    }

    /// The place of a field by its path below this record; the nearest that is there.
    pub(super) fn place(
        &self,
        path: impl Iterator<Item = (&'static str, Option<usize>)>,
    ) -> Option<TextPlace> {
        let Self::Text { text, field } = self else {
            return None;
        };
        let mut found = field;
        for (name, nth) in path {
            let Content::Block(fields) = &found.content else {
                break;
            };
            let mut named = fields.iter().filter(|inner| inner.name == name);
            match named.nth(nth.unwrap_or(0)) {
                Some(inner) => found = inner,
                None => break,
            }
        }
        Some(place(text, found.at))
    }
}

/// What can go wrong with a record: a field that says something wrong, or an error that knows its place already.
#[derive(Debug)]
pub(super) enum Mistake {
    Fault(Fault),
    Error(ImportError),
}

impl From<Fault> for Mistake {
    fn from(fault: Fault) -> Self {
        Self::Fault(fault)
    }
}

/// What the decoder says, which names the fields on its way from the inside out, as `Message.field: `.
fn undecodable(error: &prost::DecodeError) -> Fault {
    let text = error.to_string();
    let mut rest = text.strip_prefix(NOISE).unwrap_or(&text);
    let mut path = Vec::new();
    while let Some((place, inner)) = rest.split_once(": ") {
        let Some((_, field)) = place.split_once('.').filter(|_| !place.contains(' ')) else {
            break;
        };
        path.insert(0, field.trim_start_matches("r#"));
        rest = inner;
    }
    let at = if path.is_empty() {
        String::new()
    } else {
        format!(" at `{}`", path.join("."))
    };
    Fault::new(format!("cannot be decoded{at}: {rest}"), "a message of Apollo's")
}
