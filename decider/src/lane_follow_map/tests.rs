//! Hand-made routes, and what must hold on them.
