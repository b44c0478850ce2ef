//! Reads files of cases and tells their kinds apart.

use crate::lattice::{self, LatticeCase};
use crate::map::MapCase;
use crate::path_bounds::PathBoundsCase;
use crate::qp::QpCase;
use crate::speed::{self, SpeedCase};
use std::io::Read;
use std::path::{Path, PathBuf};

/// A golden vector of some kind.
pub(crate) enum Case {
    /// A whole call of the path-bounds decider.
    PathBounds(Box<PathBoundsCase>),
    /// A question to a map, a route or a line.
    Map(Box<MapCase>),
    /// A piecewise-jerk problem.
    Qp(Box<QpCase>),
    /// A question to the lattice planner.
    Lattice(Box<LatticeCase>),
    /// A question to one of the speed tasks.
    Speed(Box<SpeedCase>),
}

impl Case {
    pub(crate) fn name(&self) -> &str {
        match self {
            Self::PathBounds(case) => &case.name,
            Self::Map(case) => &case.name,
            Self::Qp(case) => &case.name,
            Self::Speed(case) => &case.name,
            Self::Lattice(case) => &case.name,
        }
    }
}

/// Why a file of cases cannot be used.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CaseError {
    #[error("{file}: {source}")]
    Unreadable { file: PathBuf, source: std::io::Error },
    #[error("{file}: no case in it; JSON lines are wanted, one case each")]
    Empty { file: PathBuf },
    #[error("{file}:{line}: {source}")]
    Malformed {
        file: PathBuf,
        line: usize,
        source: serde_json::Error,
    },
    #[error(
        "{file}:{line}: unknown kind of case; known: path_bounds (`input.ref_line` and `input.status`), map (`map` \
         and `function`), a piecewise-jerk problem (`function` ends with `_qp` or `_qp_diagonal`), speed (a `function` of \
         the speed tasks), lattice (a `function` of the lattice planner)"
    )]
    UnknownKind { file: PathBuf, line: usize },
}

/// All cases of a file, plain or gzipped.
pub(crate) fn read(file: &Path) -> Result<Vec<Case>, CaseError> {
    let text = text(file).map_err(|source| CaseError::Unreadable {
        file: file.to_owned(),
        source,
    })?;
    let numbered = text
        .lines()
        .enumerate()
        .filter(|(_, line)| !line.trim().is_empty());
    let cases: Vec<Case> = numbered
        .map(|(k, line)| parse(file, k + 1, line))
        .collect::<Result<_, CaseError>>()?;
    if cases.is_empty() {
        Err(CaseError::Empty {
            file: file.to_owned(),
        })
    } else {
        Ok(cases)
    }
}

fn text(file: &Path) -> std::io::Result<String> {
    let bytes = std::fs::read(file)?;
    let mut text = String::new();
    if bytes.starts_with(&[0x1f, 0x8b]) {
        flate2::read::GzDecoder::new(bytes.as_slice()).read_to_string(&mut text)?;
    } else {
        bytes.as_slice().read_to_string(&mut text)?;
    }
    Ok(text)
}

fn parse(file: &Path, line: usize, text: &str) -> Result<Case, CaseError> {
    let malformed = |source| CaseError::Malformed {
        file: file.to_owned(),
        line,
        source,
    };
    let value: serde_json::Value = serde_json::from_str(text).map_err(malformed)?;
    let has = |key| value["input"].get(key).is_some();
    if has("ref_line") && has("status") && has("adc_sl_boundary") {
        return Ok(Case::PathBounds(Box::new(
            serde_json::from_value(value).map_err(malformed)?,
        )));
    }
    if value.get("map").is_some() && value.get("function").is_some() {
        return Ok(Case::Map(Box::new(
            serde_json::from_value(value).map_err(malformed)?,
        )));
    }
    if value["function"].as_str().is_some_and(QpCase::knows) {
        return Ok(Case::Qp(Box::new(
            serde_json::from_value(value).map_err(malformed)?,
        )));
    }
    if value["function"].as_str().is_some_and(speed::knows) {
        return Ok(Case::Speed(Box::new(
            serde_json::from_value(value).map_err(malformed)?,
        )));
    }
    if value["function"].as_str().is_some_and(lattice::knows) {
        return Ok(Case::Lattice(Box::new(
            serde_json::from_value(value).map_err(malformed)?,
        )));
    }
    Err(CaseError::UnknownKind {
        file: file.to_owned(),
        line,
    })
}
