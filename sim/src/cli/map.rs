//! `corridor map`: what a map file holds, in words and as a drawing.

use super::{Gate, output};
use clap::Args;
use corridor_scenarios::LoadedMap;
use corridor_sim::{map_drawing, map_report};
use std::path::{Path, PathBuf};

#[derive(Args)]
pub(crate) struct Map {
    /// A map file: `OpenDRIVE`, Lanelet2, Apollo (binary or text) or `CommonRoad`.
    file: PathBuf,
    /// Draw the map into this file.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

impl Map {
    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        let map = open(&self.file)?;
        let name = self.file.display().to_string();
        if let Some(svg) = &self.svg {
            spare(&self.file, svg)?;
            output::check(svg)?;
            output::write(svg, &map_drawing::svg(&name, &map.map))?;
        }
        output::print(&map_report::report(&name, &map));
        if let Some(svg) = &self.svg {
            output::print(&format!("drawing    {}\n", svg.display()));
        }
        Ok(Gate::Passed)
    }
}

/// Reads a map file.
pub(crate) fn open(file: &Path) -> anyhow::Result<LoadedMap> {
    anyhow::ensure!(
        !file.is_dir(),
        "`{}` is a folder, a map file is wanted",
        file.display()
    );
    Ok(LoadedMap::open(file)?)
}

/// Makes sure that writing `target` does not destroy the map it is made from.
pub(crate) fn spare(map: &Path, target: &Path) -> anyhow::Result<()> {
    anyhow::ensure!(
        !is_same(map, target),
        "cannot write `{}`: it is the map that is to be read",
        target.display()
    );
    Ok(())
}

/// Whether two paths lead to one file that is there.
pub(crate) fn is_same(a: &Path, b: &Path) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}
