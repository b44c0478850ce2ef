//! The project's own maps, part of the program: no path to look up, the same text everywhere.
//!
//! OpenDRIVE files written for this project; each opens with a comment that says what it shows.

/// Names and texts, by name.
const MAPS: [(&str, &str); 4] = [
    ("highway_shoulder", include_str!("../maps/highway_shoulder.xodr")),
    ("narrowing_street", include_str!("../maps/narrowing_street.xodr")),
    ("rural_curves", include_str!("../maps/rural_curves.xodr")),
    ("urban_parking", include_str!("../maps/urban_parking.xodr")),
];

/// The names of all maps, sorted.
pub fn names() -> impl Iterator<Item = &'static str> {
    MAPS.iter().map(|(name, _)| *name)
}

/// The text of a map by its name, with or without `.xodr`.
pub fn embedded(name: &str) -> Option<&'static str> {
    let name = name.strip_suffix(".xodr").unwrap_or(name);
    MAPS.iter()
        .find(|(known, _)| *known == name)
        .map(|(_, text)| *text)
}

#[cfg(test)]
mod tests;
