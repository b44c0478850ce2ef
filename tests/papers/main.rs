//! The papers tell the truth.
