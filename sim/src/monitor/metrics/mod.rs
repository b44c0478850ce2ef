//! The one list of all metrics: names, units, limits and roles. `sim/METRICS.md` shows it as a table, and every metric
//! of a verdict takes its limit and its role from it.
//!
//! Units are SI; an empty unit is a count, a share or a ratio.

mod criticality;
mod decisions;
mod driving;

use std::fmt::Write;

/// What a value is compared with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// Good up to this value.
    AtMost(f64),
    /// Good below this value.
    Below(f64),
    /// Good from this value on.
    AtLeast(f64),
    /// Good above this value.
    Above(f64),
}

impl Limit {
    /// The number itself.
    pub fn threshold(self) -> f64 {
        match self {
            Self::AtMost(limit) | Self::Below(limit) | Self::AtLeast(limit) | Self::Above(limit) => limit,
        }
    }

    /// Whether a value is good.
    pub fn holds(self, value: f64) -> bool {
        match self {
            Self::AtMost(limit) => value <= limit,
            Self::Below(limit) => value < limit,
            Self::AtLeast(limit) => value >= limit,
            Self::Above(limit) => value > limit,
        }
    }

    fn sign(self) -> &'static str {
        match self {
            Self::AtMost(_) => "≤",
            Self::Below(_) => "<",
            Self::AtLeast(_) => "≥",
            Self::Above(_) => ">",
        }
    }
}

/// What a metric is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Role {
    /// Failing it fails the run.
    Gate,
    /// A term of the scores, with its weight.
    Weighted(f64),
    /// For people; neither fails a run nor enters a score.
    Reported,
}

/// One metric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Definition {
    /// Its name in verdicts.
    pub name: &'static str,
    /// How it is measured, in words.
    pub formula: &'static str,
    /// Unit of its value.
    pub unit: &'static str,
    /// What is good; `None`: there is no such limit.
    pub limit: Option<Limit>,
    /// What it is for.
    pub role: Role,
    /// Where limit and role hold, if not in every run.
    pub only: Option<&'static str>,
    /// Where it comes from.
    pub source: &'static str,
}

impl Definition {
    /// A metric without a limit that is only reported.
    const fn new(
        name: &'static str,
        unit: &'static str,
        formula: &'static str,
        source: &'static str,
    ) -> Self {
        Self {
            name,
            formula,
            unit,
            limit: None,
            role: Role::Reported,
            only: None,
            source,
        }
    }

    const fn limit(self, limit: Limit) -> Self {
        Self {
            limit: Some(limit),
            ..self
        }
    }

    const fn gate(self) -> Self {
        Self {
            role: Role::Gate,
            ..self
        }
    }

    const fn weight(self, weight: f64) -> Self {
        Self {
            role: Role::Weighted(weight),
            ..self
        }
    }

    const fn only(self, place: &'static str) -> Self {
        Self {
            only: Some(place),
            ..self
        }
    }

    /// Whether failing it fails a run, where its limit holds.
    pub fn is_gate(&self) -> bool {
        self.role == Role::Gate
    }

    /// Its row in the table.
    fn row(&self) -> String {
        let limit = self.limit.map_or("–".to_owned(), |limit| {
            format!("{} {}", limit.sign(), limit.threshold())
        });
        let role = match self.role {
            Role::Gate => "gate".to_owned(),
            Role::Weighted(weight) => format!("weight {weight}"),
            Role::Reported => "reported".to_owned(),
        };
        let only = self.only.map_or(String::new(), |place| format!(", {place}"));
        let unit = if self.unit.is_empty() { "–" } else { self.unit };
        format!(
            "| `{}` | {} | {unit} | {limit} | {role}{only} | {} |",
            self.name, self.formula, self.source
        )
    }
}

/// The parts of the list with their headings.
const SECTIONS: [(&str, &[Definition]); 5] = [
    ("Gates", &driving::GATES),
    ("Score", &driving::SCORE),
    ("Decisions", &decisions::DECISIONS),
    ("Pull-over", &decisions::PULL_OVER),
    ("Criticality", &criticality::CRITICALITY),
];

/// Every metric, in the order of the table.
pub fn definitions() -> impl Iterator<Item = &'static Definition> {
    SECTIONS.iter().flat_map(|(_, definitions)| *definitions)
}

/// The metric of this name.
pub fn find(name: &str) -> Option<&'static Definition> {
    definitions().find(|definition| definition.name == name)
}

/// All of them as tables in Markdown, one under each heading.
pub fn tables() -> String {
    let mut text = String::new();
    for (heading, definitions) in SECTIONS {
        let _ = write!(
            text,
            "## {heading}\n\n| metric | what is measured | unit | good | role | source |\n|---|---|---|---|---|---|\n"
        );
        for definition in definitions {
            text.push_str(&definition.row());
            text.push('\n');
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_name_is_taken_twice_and_every_gate_has_a_limit() {
        let mut names: Vec<&str> = definitions().map(|d| d.name).collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count);
        assert!(definitions().all(|d| !d.is_gate() || d.limit.is_some()));
        assert_eq!(find("ttc").map(|d| d.role), Some(Role::Weighted(5.0)));
        assert_eq!(find("cttc"), None);
    }

    #[test]
    fn limits_hold_from_their_own_side() {
        let (good, bad) = (1.0, 1.0 + 1e-12);
        assert!(Limit::AtMost(1.0).holds(good) && !Limit::AtMost(1.0).holds(bad));
        assert!(Limit::Above(1.0).holds(bad) && !Limit::Above(1.0).holds(good));
        let (good, bad) = (1.0, 1.0 - 1e-12);
        assert!(Limit::AtLeast(1.0).holds(good) && !Limit::AtLeast(1.0).holds(bad));
        assert!(Limit::Below(1.0).holds(bad) && !Limit::Below(1.0).holds(good));
        let none = f64::NAN;
        assert!(!Limit::AtMost(1.0).holds(none) && !Limit::AtLeast(1.0).holds(none));
    }
}
