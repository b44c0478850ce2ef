//! The binary form of protocol buffers, its outermost level: one record after the other.
//!
//! Records are handed out before they are decoded, so that no file is in memory twice as a whole and a damaged one is
//! told by the record where it is.

use super::record::NOISE;
use prost::encoding::{DecodeContext, WireType, decode_key, decode_varint, skip_field};

/// Walks over the fields of the outermost message.
#[derive(Clone, Debug)]
pub(super) struct Records<'a> {
    bytes: &'a [u8],
    rest: &'a [u8],
}

/// Bytes that are no field, and where they are.
#[derive(Debug)]
pub(super) struct NoField {
    pub(super) at: usize,
    pub(super) problem: String,
}

impl<'a> Records<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, rest: bytes }
    }

    /// The next length-delimited field: its number and its bytes. Others are skipped.
    pub(super) fn next_record(&mut self) -> Result<Option<(u32, &'a [u8])>, NoField> {
        let at = self.bytes.len() - self.rest.len();
        let no_field = |problem: String| NoField {
            at,
            problem: problem.replace(NOISE, ""),
        };
        while !self.rest.is_empty() {
            let (number, kind) = decode_key(&mut self.rest).map_err(|e| no_field(e.to_string()))?;
            if kind != WireType::LengthDelimited {
                skip_field(kind, number, &mut self.rest, DecodeContext::default())
                    .map_err(|e| no_field(e.to_string()))?;
                continue;
            }
            let length = decode_varint(&mut self.rest).map_err(|e| no_field(e.to_string()))?;
            let record = usize::try_from(length)
                .ok()
                .and_then(|n| self.rest.split_at_checked(n));
            let Some((record, rest)) = record else {
                let left = self.rest.len();
                return Err(no_field(format!(
                    "field {number} says it has {length} bytes, but {left} are left"
                )));
            };
            self.rest = rest;
            return Ok(Some((number, record)));
        }
        Ok(None)
    }
}
