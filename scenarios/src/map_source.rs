//! Finds and reads the map that a scenario names, once for all its seeds.

use crate::error::{Place, ScenarioError};
use crate::import::opendrive::MapObject;
use crate::import::{ImportError, TextPlace};
use crate::map_format::{self, Content, MapFormat};
use crate::maps;
use corridor_decider::road::RoadMap;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// Stands for the folder of shared maps in a scenario's map path.
const MAPS_PREFIX: &str = "$MAPS/";

/// Names the folder of shared maps.
const MAPS_VARIABLE: &str = "CORRIDOR_MAPS";

/// Most bytes of a map file: many times a whole town's, and little enough for memory. A device has no end.
const LARGEST_FILE: u64 = 256 << 20;

/// A map with the text it was read from.
#[derive(Clone, Debug)]
pub struct LoadedMap {
    /// The map.
    pub map: Arc<RoadMap>,
    /// The content of its file; a binary one in hexadecimal.
    pub text: Arc<str>,
    /// What the reader had to leave out or repair.
    pub warnings: Arc<[String]>,
    /// What the file puts on and beside its roads; only OpenDRIVE has such things.
    pub objects: Arc<[MapObject]>,
}

impl LoadedMap {
    /// Reads a map file of any format, which its content tells.
    ///
    /// # Errors
    /// [`ImportError::InFile`] with the file's name around what the reader or the file system says.
    pub fn open(path: &Path) -> Result<Self, ImportError> {
        let bytes = bytes(path).map_err(ImportError::Io);
        bytes
            .and_then(|bytes| {
                let text: Arc<str> = map_format::as_text(&bytes).into();
                if text.trim().is_empty() {
                    return Err(empty());
                }
                let content = map_format::read(&text)?;
                Ok(Self::new(content, text))
            })
            .map_err(|error| ImportError::InFile {
                file: path.display().to_string(),
                error: Box::new(error),
            })
    }

    fn new(content: Content, text: Arc<str>) -> Self {
        Self {
            map: content.map,
            text,
            warnings: content.warnings.into(),
            objects: content.objects.into(),
        }
    }

    /// The format it was read from.
    pub fn format(&self) -> MapFormat {
        MapFormat::of(&self.text)
    }
}

/// The content of a file that is not too large.
fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let read = File::open(path)?.take(LARGEST_FILE + 1).read_to_end(&mut bytes)?;
    if read as u64 > LARGEST_FILE {
        let problem = format!(
            "it is larger than the {} MB of the largest map",
            LARGEST_FILE >> 20
        );
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, problem));
    }
    Ok(bytes)
}

/// That there is nothing to read.
fn empty() -> ImportError {
    ImportError::Text {
        place: TextPlace { line: 1, column: 1 },
        problem: "the file is empty".to_owned(),
        expected: "a map in OpenDRIVE, Lanelet2, Apollo or CommonRoad".to_owned(),
    }
}

/// Maps by where they come from. Cheap to share between threads; every map is read once.
#[derive(Debug, Default)]
pub struct MapCache {
    maps: Mutex<BTreeMap<String, LoadedMap>>,
    /// The answer to every name, if there is one.
    only: Option<LoadedMap>,
}

impl MapCache {
    /// An empty cache.
    pub fn new() -> Self {
        Self::default()
    }

    /// A cache that answers every name with the map of this text: for a trace, which holds its map.
    ///
    /// # Errors
    /// What is wrong with the map.
    pub fn holding(text: &str) -> Result<Self, String> {
        Ok(Self {
            only: Some(read(text.into())?),
            ..Self::default()
        })
    }

    /// Puts a map in under a name, before what files and the program hold under that name.
    pub fn insert(&self, name: &str, map: LoadedMap) {
        self.lock().insert(name.to_owned(), map);
    }

    /// The map called `name` in a scenario file that lies in `base`.
    ///
    /// # Errors
    /// [`ScenarioError::SharedMapsAbsent`], [`ScenarioError::MapNotFound`] or [`ScenarioError::MapInvalid`], at
    /// `place`.
    pub(crate) fn get(&self, name: &str, base: &Path, place: &Place) -> Result<LoadedMap, ScenarioError> {
        if let Some(found) = self.only.as_ref().or(self.lock().get(name)) {
            return Ok(found.clone());
        }
        let not_found = |hint: String| ScenarioError::MapNotFound {
            place: Box::new(place.clone()),
            map: name.to_owned(),
            hint,
        };
        let folder = shared_maps();
        if name.starts_with(MAPS_PREFIX) && !folder.is_dir() {
            return Err(ScenarioError::SharedMapsAbsent {
                place: Box::new(place.clone()),
                map: name.to_owned(),
                folder,
            });
        }
        let (key, text): (String, Arc<str>) = if is_path(name) {
            let path = locate(name, base, &folder).map_err(not_found)?;
            let key = path.display().to_string();
            if let Some(found) = self.lock().get(&key) {
                return Ok(found.clone());
            }
            let bytes = std::fs::read(&path)
                .map_err(|e| not_found(format!("cannot read `{}`: {e}", path.display())))?;
            (key, map_format::as_text(&bytes).into())
        } else {
            let text = maps::embedded(name).ok_or_else(|| {
                not_found(format!(
                    "expected one of {} or a path ending in {}",
                    own_maps(),
                    endings()
                ))
            })?;
            (name.to_owned(), text.into())
        };
        let loaded = read(text).map_err(|problem| ScenarioError::MapInvalid {
            place: Box::new(place.clone()),
            map: name.to_owned(),
            problem,
        })?;
        self.lock().insert(key, loaded.clone());
        Ok(loaded)
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, BTreeMap<String, LoadedMap>> {
        // A map is only put in when it is whole, so a panic elsewhere leaves nothing broken.
        self.maps.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn read(text: Arc<str>) -> Result<LoadedMap, String> {
    let content = map_format::read(&text).map_err(|e| e.to_string())?;
    Ok(LoadedMap::new(content, text))
}

/// The own maps, for a message.
fn own_maps() -> String {
    let names: Vec<String> = maps::names().map(|name| format!("`{name}`")).collect();
    names.join(", ")
}

/// The endings of map files, for a message.
fn endings() -> String {
    let endings = map_format::ENDINGS.map(|ending| format!("`.{ending}`"));
    endings.join(", ")
}

/// The name by which a scenario file that lies elsewhere than in `base` finds the same map.
pub(crate) fn name_from_anywhere(name: &str, base: &Path) -> String {
    if !is_path(name) || name.starts_with(MAPS_PREFIX) {
        return name.to_owned();
    }
    let path = base.join(name);
    std::path::absolute(&path).unwrap_or(path).display().to_string()
}

fn is_path(name: &str) -> bool {
    name.contains(['/', '\\'])
        || Path::new(name).extension().is_some_and(|e| {
            map_format::ENDINGS
                .iter()
                .any(|known| e.eq_ignore_ascii_case(known))
        })
}

/// The path that a map name means, or where it was looked for in vain.
fn locate(name: &str, base: &Path, shared: &Path) -> Result<PathBuf, String> {
    let path = match name.strip_prefix(MAPS_PREFIX) {
        Some(rest) => shared.join(rest),
        None => base.join(name),
    };
    if path.is_file() {
        return Ok(path);
    }
    Err(if name.starts_with(MAPS_PREFIX) {
        format!(
            "`{}` does not exist in the folder of shared maps, which {MAPS_VARIABLE} names",
            path.display()
        )
    } else {
        format!(
            "`{}` does not exist; a path is relative to the scenario file",
            path.display()
        )
    })
}

/// The folder of shared maps: the one the environment names, else `shared/maps` beside the workspace.
fn shared_maps() -> PathBuf {
    std::env::var_os(MAPS_VARIABLE).map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/maps"),
        PathBuf::from,
    )
}
