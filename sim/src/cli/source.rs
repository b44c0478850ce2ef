//! Where scenarios come from: files, folders, and the embedded catalog by name.

use anyhow::Context;
use corridor_scenarios::{Family, MapCache, ScenarioError, catalog};
use std::path::{Path, PathBuf};

/// Stands for the whole embedded catalog.
pub(crate) const CATALOG: &str = "catalog";

/// Stands for the hard families of the catalog.
pub(crate) const HARD: &str = "hard";

/// One scenario by path or by catalog name.
pub(crate) fn family(given: &str, maps: &MapCache) -> anyhow::Result<Family> {
    let path = Path::new(given);
    anyhow::ensure!(
        !path.is_dir(),
        "`{given}` is a folder, one scenario is wanted; `corridor sweep {given}` runs all that are in it"
    );
    if path.exists() {
        return Ok(Family::load_with(path, maps)?);
    }
    match catalog::find(given) {
        Some(entry) => Ok(entry.load(maps)?),
        None => anyhow::bail!(
            "`{given}`: neither a scenario file nor a name in the catalog; `corridor list` shows the names"
        ),
    }
}

/// Families to sweep over, and those whose map is not on this machine.
#[derive(Default)]
pub(crate) struct Selection {
    /// Each with how to name it on the command line.
    pub families: Vec<(Family, String)>,
    /// Why others are left out.
    pub skipped: Vec<String>,
}

/// All scenarios of files, folders (with their subfolders) and catalog names.
pub(crate) fn select(given: &[String], maps: &MapCache) -> anyhow::Result<Selection> {
    let mut selection = Selection::default();
    for name in given {
        let is_set = (name == CATALOG || name == HARD) && !Path::new(name).exists();
        if is_set {
            let wanted = catalog::ENTRIES
                .iter()
                .filter(|entry| name == CATALOG || entry.is_hard);
            let regressions = catalog::REGRESSIONS
                .iter()
                .filter(|_| !selection.has_regressions());
            for entry in regressions.collect::<Vec<_>>().into_iter().chain(wanted) {
                selection.add(entry.load(maps), entry.name.to_owned())?;
            }
        } else if Path::new(name).is_dir() {
            for file in files(name)? {
                selection.add(Family::load_with(&file, maps), file.display().to_string())?;
            }
        } else {
            selection.families.push((family(name, maps)?, name.clone()));
        }
    }
    selection.check_names()?;
    Ok(selection)
}

impl Selection {
    fn has_regressions(&self) -> bool {
        let mut names = self.families.iter().map(|(family, _)| family.name());
        names.any(|name| catalog::REGRESSIONS.iter().any(|entry| entry.name == name))
    }

    fn add(&mut self, family: Result<Family, ScenarioError>, given: String) -> anyhow::Result<()> {
        match family {
            Ok(family) => self.families.push((family, given)),
            Err(ScenarioError::SharedMapsAbsent { map, .. }) => {
                self.skipped.push(format!("{given}: {}", absent(&map)));
            }
            Err(error) => return Err(error.into()),
        }
        Ok(())
    }

    /// Rows are told apart by the families' names.
    fn check_names(&self) -> anyhow::Result<()> {
        let mut names: Vec<&str> = self.families.iter().map(|(family, _)| family.name()).collect();
        names.sort_unstable();
        match names.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => anyhow::bail!("two scenarios are called `{}`: give one another `name`", pair[0]),
            None => Ok(()),
        }
    }
}

/// Why a scenario on a shared map is skipped.
pub(crate) fn absent(map: &str) -> String {
    format!("`{map}` is not on this machine; set CORRIDOR_MAPS to the folder of shared maps")
}

/// A file itself, or all scenario files of a folder.
pub(crate) fn files(given: &str) -> anyhow::Result<Vec<PathBuf>> {
    let path = Path::new(given);
    if !path.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let files = files_below(path)?;
    anyhow::ensure!(
        !files.is_empty(),
        "`{given}`: no scenario file (`*.toml`) in this folder"
    );
    Ok(files)
}

/// All `*.toml` files of a folder and its subfolders, sorted.
fn files_below(folder: &Path) -> anyhow::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        let entries = std::fs::read_dir(&folder).with_context(|| format!("`{}`", folder.display()))?;
        for entry in entries {
            let entry = entry.with_context(|| format!("`{}`", folder.display()))?;
            let path = entry.path();
            if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "toml") {
                files.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}
