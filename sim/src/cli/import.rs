//! `corridor import`: a map file becomes a scenario that can be run, beside a report and a drawing of the map.
//!
//! A `CommonRoad` file is a scenario already: it is copied.

use super::map::{is_same, open, spare};
use super::{Gate, output};
use anyhow::Context;
use clap::Args;
use corridor_scenarios::{Family, LoadedMap, MapCache, MapFormat, starter};
use corridor_sim::{map_drawing, map_report};
use std::path::{Component, Path, PathBuf};

#[derive(Args)]
pub(crate) struct Import {
    /// A map file: `OpenDRIVE`, Lanelet2, Apollo (binary or text) or `CommonRoad`.
    file: PathBuf,
    /// The folder to write to; made where there is none.
    #[arg(long, short, value_name = "FOLDER")]
    output: PathBuf,
}

/// A file to be written.
type Output = (PathBuf, Vec<u8>);

impl Import {
    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        let map = open(&self.file)?;
        let shown = self.file.display().to_string();
        let name = self
            .file
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let (scenario, content, remark) = match map.format() {
            MapFormat::CommonRoad => self.recorded(&map)?,
            _ => self.started(&map, &name)?,
        };
        let beside = |ending: &str| self.output.join(format!("{name}.{ending}"));
        let mut outputs: Vec<Output> = vec![
            (beside("map.txt"), map_report::report(&shown, &map).into_bytes()),
            (beside("svg"), map_drawing::svg(&shown, &map.map).into_bytes()),
        ];
        if !is_same(&self.file, &scenario) {
            outputs.insert(0, (scenario.clone(), content));
        }
        for (path, _) in &outputs {
            spare(&self.file, path)?;
        }
        output::make_folder(&self.output)?;
        output::write_all(&outputs)?;
        for (path, _) in &outputs {
            output::print(&format!("{}\n", path.display()));
        }
        output::note(&format!("{remark}; run it: corridor run {}", scenario.display()));
        Ok(Gate::Passed)
    }

    /// The scenario that a `CommonRoad` file is, as it stands there.
    fn recorded(&self, map: &LoadedMap) -> anyhow::Result<(PathBuf, Vec<u8>, &'static str)> {
        let base = self.file.parent().unwrap_or(Path::new(""));
        Family::parse_with(
            &map.text,
            &self.file.display().to_string(),
            base,
            &MapCache::new(),
        )?;
        let name = self.file.file_name().context("a file that was read has a name")?;
        Ok((
            self.output.join(name),
            map.text.as_bytes().to_vec(),
            "a CommonRoad file is a scenario itself",
        ))
    }

    /// A first scenario on a map.
    fn started(&self, map: &LoadedMap, name: &str) -> anyhow::Result<(PathBuf, Vec<u8>, &'static str)> {
        let path = path_from(&self.output, &self.file)?;
        let text = starter(name, map, &path).with_context(|| format!("`{}`", self.file.display()))?;
        Ok((
            self.output.join(format!("{name}.toml")),
            text.into_bytes(),
            "the scenario refers to the map where it lies",
        ))
    }
}

/// The path of `file` as a file in `folder` names it; neither has to be written yet.
fn path_from(folder: &Path, file: &Path) -> anyhow::Result<String> {
    let shown = || format!("`{}`", file.display());
    let file = file.canonicalize().with_context(shown)?;
    let folder = resolved(folder)?;
    let (from, to): (Vec<Component<'_>>, Vec<Component<'_>>) =
        (folder.components().collect(), file.components().collect());
    let shared = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    let mut path: PathBuf = if shared == from.len() {
        PathBuf::from(".")
    } else {
        from[shared..].iter().map(|_| "..").collect()
    };
    path.extend(&to[shared..]);
    let path = path
        .to_str()
        .with_context(|| format!("{}: the path is not UTF-8, which a scenario is", shown()))?;
    Ok(path.to_owned())
}

/// The absolute path of a folder that may not be there yet: what is there of it, links followed, and the rest.
fn resolved(folder: &Path) -> anyhow::Result<PathBuf> {
    let absolute = std::path::absolute(folder).with_context(|| format!("`{}`", folder.display()))?;
    let mut rest = Vec::new();
    for above in absolute.ancestors() {
        if let Ok(mut found) = above.canonicalize() {
            found.extend(rest.iter().rev());
            return Ok(found);
        }
        rest.extend(above.file_name());
    }
    Ok(absolute)
}
