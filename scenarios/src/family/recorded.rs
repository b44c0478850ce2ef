//! Families that other tools recorded: CommonRoad files. Nothing in them is random; each planning problem is one
//! scenario, and seeds take them by turns, the first one with seed 1.

use super::{Drawn, Family, Origin};
use crate::error::{NoProblem, ScenarioError};
use crate::import::{ImportError, commonroad};
use crate::map_source::LoadedMap;
use crate::scenario::Scenario;
use std::sync::Arc;

/// The family of a CommonRoad text, called `name`.
pub(super) fn family(text: &str, file: &str, name: &str) -> Result<Family, ScenarioError> {
    let in_file = |error| ImportError::InFile {
        file: file.to_owned(),
        error: Box::new(error),
    };
    let read = commonroad::read(text).map_err(in_file)?;
    let problems: Vec<Option<i64>> = match read.file.problems.as_slice() {
        [] => vec![None],
        problems => problems.iter().map(|problem| Some(problem.id)).collect(),
    };
    let mut warnings = read.warnings.clone();
    let mut scenarios = Vec::new();
    for problem in problems.iter().copied() {
        let (scenario, more) = read.scenario(problem).map_err(in_file)?;
        scenarios.push(Scenario {
            name: name.to_owned(),
            ..scenario
        });
        // Problems of one file share what is odd about it.
        for warning in more {
            if !warnings.contains(&warning) {
                warnings.push(warning);
            }
        }
    }
    Ok(Family {
        name: name.to_owned(),
        description: format!("CommonRoad `{}`.", read.file.benchmark),
        source: text.into(),
        map: LoadedMap {
            map: Arc::clone(&read.map),
            text: text.into(),
            warnings: warnings.into(),
            objects: Arc::new([]),
        },
        fixed: scenarios.len() == 1,
        origin: Origin::Recorded {
            scenarios,
            problems: problems.into_iter().flatten().collect(),
        },
    })
}

/// The first seed whose turn it is to give the problem `id`.
pub(super) fn seed_of(problems: &[i64], id: i64) -> Result<u64, NoProblem> {
    let place = problems.iter().position(|problem| *problem == id);
    place
        .map(|place| place as u64 + 1)
        .ok_or_else(|| NoProblem::Unknown {
            id,
            known: problems
                .iter()
                .map(|problem| format!("`{problem}`"))
                .collect::<Vec<_>>()
                .join(", "),
        })
}

/// The scenario of a seed.
pub(super) fn draw(scenarios: &[Scenario], seed: u64) -> Drawn {
    let count = scenarios.len() as u64;
    let turn = seed.wrapping_sub(1) % count;
    let place = usize::try_from(turn).expect("less than the number of scenarios");
    Drawn {
        scenario: Scenario {
            seed,
            ..scenarios[place].clone()
        },
        rejected: Vec::new(),
        parameters: Vec::new(),
    }
}
