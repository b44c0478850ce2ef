//! Which reader a map belongs to, and how a binary map is kept as text.
//!
//! A trace holds its map as text and must find the reader again without a file's name, so the format is told by the
//! content. Binary maps are kept in hexadecimal behind a first line that says so: twice the size, which compression
//! takes back.

use crate::head_on;
use crate::import::opendrive::MapObject;
use crate::import::{ImportError, apollo, commonroad, lanelet2, opendrive};
use corridor_decider::road::RoadMap;
use std::fmt::{self, Write as _};
use std::sync::Arc;

/// First line of a binary map kept as text.
const BINARY: &str = "# a binary map in hexadecimal\n";

/// The formats of map files that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MapFormat {
    /// ASAM `OpenDRIVE`.
    OpenDrive,
    /// Lanelet2, as OpenStreetMap XML.
    Lanelet2,
    /// An Apollo HD map, binary or as text.
    Apollo,
    /// A `CommonRoad` scenario, of which the lanelets are the map.
    CommonRoad,
}

impl MapFormat {
    /// The format of a text that [`as_text`] gave. What is none of the others is read as `OpenDRIVE`.
    pub(crate) fn of(text: &str) -> Self {
        if text.starts_with(BINARY) || is_apollo_text(text) {
            return Self::Apollo;
        }
        match root_element(text) {
            Some("osm") => Self::Lanelet2,
            Some("commonRoad") => Self::CommonRoad,
            _ => Self::OpenDrive,
        }
    }
}

impl fmt::Display for MapFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::OpenDrive => "OpenDRIVE",
            Self::Lanelet2 => "Lanelet2",
            Self::Apollo => "Apollo",
            Self::CommonRoad => "CommonRoad",
        })
    }
}

/// Endings of the map files that can be read.
pub(crate) const ENDINGS: [&str; 5] = ["xodr", "xml", "osm", "bin", "txt"];

/// The content of a map file as text. Bytes of a text that are not UTF-8 (names in older encodings) are replaced.
pub(crate) fn as_text(bytes: &[u8]) -> String {
    if let Some(text) = from_utf16(bytes) {
        return text;
    }
    if !is_binary(bytes) {
        return String::from_utf8_lossy(bytes).into_owned();
    }
    let mut text = String::with_capacity(BINARY.len() + 2 * bytes.len());
    text.push_str(BINARY);
    for byte in bytes {
        write!(text, "{byte:02x}").expect("a string takes everything");
    }
    text
}

/// A text in UTF-16, which begins with a byte order mark.
fn from_utf16(bytes: &[u8]) -> Option<String> {
    let unit: fn([u8; 2]) -> u16 = match bytes {
        [0xff, 0xfe, ..] => u16::from_le_bytes,
        [0xfe, 0xff, ..] => u16::from_be_bytes,
        _ => return None,
    };
    let units = bytes[2..].chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
    let text: String = char::decode_utf16(units)
        .map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER))
        .collect();
    text.trim_start().starts_with('<').then_some(text)
}

/// What a map file holds.
pub(crate) struct Content {
    pub(crate) map: Arc<RoadMap>,
    /// What stands on and beside its roads.
    pub(crate) objects: Vec<MapObject>,
    pub(crate) warnings: Vec<String>,
}

/// Reads a map from the text that [`as_text`] gave.
pub(crate) fn read(text: &str) -> Result<Content, ImportError> {
    let mut content = match MapFormat::of(text) {
        MapFormat::Apollo => match text.strip_prefix(BINARY) {
            Some(digits) => read_apollo(&from_hexadecimal(digits)?)?,
            None => read_apollo(text.as_bytes())?,
        },
        MapFormat::Lanelet2 => {
            let read = lanelet2::read(text)?;
            Content::without_objects(Arc::new(read.map), read.warnings)
        }
        MapFormat::CommonRoad => {
            let read = commonroad::read(text)?;
            Content::without_objects(read.map, read.warnings)
        }
        MapFormat::OpenDrive => read_opendrive(text)?,
    };
    content.warnings.extend(head_on::warning(&content.map));
    Ok(content)
}

impl Content {
    fn without_objects(map: Arc<RoadMap>, warnings: Vec<String>) -> Self {
        Self {
            map,
            objects: Vec::new(),
            warnings,
        }
    }
}

fn read_opendrive(text: &str) -> Result<Content, ImportError> {
    let opendrive::OpenDriveImport {
        map,
        objects,
        mut warnings,
        ..
    } = opendrive::read(text)?;
    let standing = objects.iter().filter(|object| !object.kind.is_flat()).count();
    if standing > 0 {
        warnings.push(format!(
            "{standing} objects of the map are part of scenarios that say `map_objects = true`, where they stand on \
             a lane"
        ));
    }
    Ok(Content {
        map: Arc::new(map),
        objects,
        warnings,
    })
}

fn read_apollo(bytes: &[u8]) -> Result<Content, ImportError> {
    let (map, warnings) = apollo::to_road_map(&apollo::read_map(bytes)?)?;
    Ok(Content::without_objects(Arc::new(map), warnings))
}

/// Name of the first element behind declarations and comments.
pub(crate) fn root_element(text: &str) -> Option<&str> {
    let mut rest = text;
    loop {
        rest = &rest[rest.find('<')?..];
        let past = match rest {
            comment if comment.starts_with("<!--") => comment.find("-->")? + 3,
            declaration if declaration.starts_with("<?") => declaration.find("?>")? + 2,
            declaration if declaration.starts_with("<!") => declaration.find('>')? + 1,
            element => {
                let name = element[1..].split(|c: char| c.is_whitespace() || matches!(c, '>' | '/'));
                return name.into_iter().next();
            }
        };
        rest = &rest[past..];
    }
}

/// Messages are full of control characters, XML and the text form of messages have none but blanks.
fn is_binary(bytes: &[u8]) -> bool {
    let is_control = |byte: &u8| byte.is_ascii_control() && !byte.is_ascii_whitespace();
    bytes.iter().any(is_control) && !contains(bytes, b"<?xml") && !contains(bytes, b"<OpenDRIVE")
}

fn contains(bytes: &[u8], what: &[u8]) -> bool {
    bytes.windows(what.len()).any(|window| window == what)
}

/// Whether the first thing behind blanks and comments is the name of a field, and nothing looks like an XML map.
fn is_apollo_text(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim_start);
    let first = lines.find(|line| !line.is_empty() && !line.starts_with('#'));
    first.is_some_and(|line| line.starts_with(|c: char| c.is_ascii_lowercase()))
        && !text.contains("<?xml")
        && !text.contains("<OpenDRIVE")
}

fn from_hexadecimal(digits: &str) -> Result<Vec<u8>, ImportError> {
    let digits = digits.trim_end().as_bytes();
    let value = |digit: u8| {
        char::from(digit)
            .to_digit(16)
            .and_then(|value| u8::try_from(value).ok())
    };
    let byte = |(at, pair): (usize, &[u8])| {
        match *pair {
            [high, low] => value(high).zip(value(low)).map(|(high, low)| 16 * high + low),
            _ => None,
        }
        .ok_or_else(|| ImportError::Bytes {
            at,
            problem: "the binary map is damaged".to_owned(),
            expected: "two hexadecimal digits".to_owned(),
        })
    };
    digits.chunks(2).enumerate().map(byte).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn binary_maps_survive_being_text() {
        let bytes: Vec<u8> = (0..=255).collect();
        let text = as_text(&bytes);
        assert_eq!(
            from_hexadecimal(text.strip_prefix(BINARY).unwrap()).unwrap(),
            bytes
        );
        for (damaged, at) in [("0", 0), ("00zz", 1), ("00-1", 1), ("00\u{e9}", 1)] {
            let error = from_hexadecimal(damaged).unwrap_err().to_string();
            assert!(
                error.starts_with(&format!("byte {at}: the binary map is damaged")),
                "{error}"
            );
        }
    }

    #[test]
    fn texts_stay_as_they_are() {
        for text in [
            "<?xml version='1.0'?>\n<OpenDRIVE/>",
            "# by hand\n\tlane { id { id: 'a' } }\r\n",
        ] {
            assert_eq!(as_text(text.as_bytes()), text);
        }
        assert_eq!(
            as_text(b"<OpenDRIVE name='\xe9\x01'/>"),
            "<OpenDRIVE name='\u{fffd}\u{1}'/>"
        );
    }

    /// Paint does not stand in the way.
    #[test]
    fn objects_that_scenarios_leave_out_are_told() {
        let text = crate::maps::embedded("urban_parking").unwrap();
        let objects = r#"<objects><object id="1" type="tree" s="1" t="9"><repeat s="1" length="9" distance="3"/></object>
            <object id="2" type="crosswalk" s="20" t="0" length="3" width="6"/></objects></road>"#;
        let warnings = read(&text.replace("</road>", objects)).unwrap().warnings;
        let told = "4 objects of the map are part of scenarios that say `map_objects = true`, where they stand on a lane";
        assert_eq!(warnings, [told]);
        assert!(read(text).unwrap().warnings.is_empty());
    }

    #[test]
    fn sixteen_bits_a_letter_are_read_too() {
        let text = "<?xml version='1.0' encoding='utf-16'?><a name='\u{fc}\u{1f697}'/>";
        let units: Vec<u16> = [0xfeff].into_iter().chain(text.encode_utf16()).collect();
        let little: Vec<u8> = units.iter().flat_map(|unit| unit.to_le_bytes()).collect();
        let big: Vec<u8> = units.iter().flat_map(|unit| unit.to_be_bytes()).collect();
        assert_eq!(
            (as_text(&little), as_text(&big)),
            (text.to_owned(), text.to_owned())
        );
        assert!(
            as_text(&[0xff, 0xfe, 0x41]).starts_with(BINARY) || as_text(&[0xff, 0xfe, 0x41]).contains('A')
        );
    }

    #[test]
    fn the_reader_is_chosen_by_content() {
        let problem = |text: &str| read(text).err().unwrap().to_string();
        assert!(problem("<html/>").contains("expected <OpenDRIVE>"));
        let lanelet2 = "<!-- no <OpenDRIVE> --><?xml version='1.0'?><osm/>";
        assert_eq!(problem(lanelet2), "the map has no drivable lane");
        let inside = problem("<!-- no <osm> --><OpenDRIVE><road><osm/></road></OpenDRIVE>");
        assert!(inside.contains("<road> has no `id`"), "{inside}");
        assert!(problem("junk <?xml version='1.0'?><a/>").contains("expected <OpenDRIVE>"));
        assert!(problem("").contains("not well-formed XML"));
        assert!(problem("\n# head\n header { version: 1 }").contains("lane the map has none"));
        assert!(problem(&as_text(&[10, 0])).contains("lane the map has none"));
    }
}
