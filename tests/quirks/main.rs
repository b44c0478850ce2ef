//! Planted faults: what a sweep must catch.
