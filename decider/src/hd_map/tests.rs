//! Hand-made maps and what must hold on them.
