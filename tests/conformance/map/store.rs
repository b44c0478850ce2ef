//! The maps of the cases, read once.

use corridor_decider::hd_map::{HdMap, HdMapError};
use corridor_scenarios::import::ImportError;
use corridor_scenarios::import::apollo::read_map;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Name of each map in the cases, and its file.
const FILES: [(&str, &str); 3] = [
    ("borregas_ave", "borregas_ave.base_map.bin"),
    ("hdmap_unit_test", "hdmap_unit_test.base_map.bin"),
    ("garage", "garage_map.base_map.txt"),
];

/// Why a map cannot be had.
#[derive(Debug, thiserror::Error)]
pub(crate) enum StoreError {
    #[error("no Apollo maps in {0}; name their folder with `--maps DIR` or CORRIDOR_MAPS")]
    NoFolder(PathBuf),
    #[error("no file is known for map `{0}`")]
    Unknown(String),
    #[error("{file}: {source}")]
    Unreadable { file: PathBuf, source: std::io::Error },
    #[error("{file}: {source}")]
    Malformed { file: PathBuf, source: ImportError },
    #[error("{file}: {source}")]
    Wrong { file: PathBuf, source: HdMapError },
}

/// Maps by name.
pub(crate) struct MapStore {
    folder: PathBuf,
    maps: BTreeMap<String, Arc<HdMap>>,
}

impl MapStore {
    /// Maps in `folder`, or in its subfolder `apollo`.
    pub(crate) fn new(folder: &Path) -> Self {
        let inner = folder.join("apollo");
        Self {
            folder: if inner.is_dir() { inner } else { folder.to_owned() },
            maps: BTreeMap::new(),
        }
    }

    /// Whether all maps are there.
    pub(crate) fn check(&self) -> Result<(), StoreError> {
        if FILES.iter().all(|(_, file)| self.folder.join(file).is_file()) {
            Ok(())
        } else {
            Err(StoreError::NoFolder(self.folder.clone()))
        }
    }

    pub(crate) fn get(&mut self, name: &str) -> Result<Arc<HdMap>, StoreError> {
        if let Some(map) = self.maps.get(name) {
            return Ok(Arc::clone(map));
        }
        let known = FILES.iter().find(|(known, _)| *known == name);
        let (_, file) = known.ok_or_else(|| StoreError::Unknown(name.to_owned()))?;
        let file = self.folder.join(file);
        let map = Arc::new(read(&file)?);
        self.maps.insert(name.to_owned(), Arc::clone(&map));
        Ok(map)
    }
}

fn read(file: &Path) -> Result<HdMap, StoreError> {
    let file = || file.to_owned();
    let bytes = std::fs::read(file()).map_err(|source| StoreError::Unreadable { file: file(), source })?;
    let data = read_map(&bytes).map_err(|source| StoreError::Malformed { file: file(), source })?;
    HdMap::new(data).map_err(|source| StoreError::Wrong { file: file(), source })
}
