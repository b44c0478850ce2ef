//! Small maps made by hand.
