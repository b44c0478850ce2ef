//! Tests of the inquest: the search against enumeration, the check of witnesses, and whose fault made-up runs are.

mod enumeration;
mod links;
mod scene;
mod witness;
