//! Where scenarios come from: files, folders, and the embedded catalog by name.

use corridor_scenarios::{Family, MapCache};
use std::path::Path;

/// One scenario by path or by catalog name.
pub(crate) fn family(given: &str, maps: &MapCache) -> anyhow::Result<Family> {
    Ok(Family::load_with(Path::new(given), maps)?)
}
