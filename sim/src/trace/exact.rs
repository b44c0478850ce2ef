//! A JSON formatter that keeps numbers exactly and notices those that are none.
//!
//! JSON has no `NaN`; `serde_json` writes `null` instead, which nobody can read back as a number. What is
//! written here holds no optional values, so a `null` can only be such a number.

use serde_json::ser::Formatter;
use std::io;

/// Writes everything without spaces, as `serde_json` does by default; fails at a number that is not finite.
pub(super) struct Exact;

impl Formatter for Exact {
    fn write_null<W: ?Sized + io::Write>(&mut self, _: &mut W) -> io::Result<()> {
        Err(io::Error::new(
            io::ErrorKind::InvalidData,
            "a number is not finite",
        ))
    }
}
