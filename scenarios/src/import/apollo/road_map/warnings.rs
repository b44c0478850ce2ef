//! What was survived, counted by kind so that a bad file does not drown its reader.

/// Warnings by order of first occurrence: what, how often, and the first of its kind.
#[derive(Debug, Default)]
pub(super) struct Warnings {
    kinds: Vec<(&'static str, usize, String)>,
}

impl Warnings {
    /// Counts one more `what`; the first one is remembered with its subject.
    pub(super) fn add(&mut self, what: &'static str, subject: impl FnOnce() -> String) {
        match self.kinds.iter_mut().find(|(known, ..)| *known == what) {
            Some((_, count, _)) => *count += 1,
            None => self.kinds.push((what, 1, subject())),
        }
    }

    pub(super) fn into_lines(self) -> Vec<String> {
        let line = |(what, count, subject): (&str, usize, String)| match count {
            1 => format!("{subject}: {what}"),
            _ => format!("{subject}: {what} ({count} of this kind in the file)"),
        };
        self.kinds.into_iter().map(line).collect()
    }
}
