//! Reads a map of either form record by record.

use super::convert;
use super::fault::Inside;
use super::messages::Header;
use super::record::{Mistake, Record};
use super::sanity;
use super::text::Parser;
use super::wire::Records;
use crate::import::ImportError;
use corridor_decider::hd_map::MapData;

/// Largest binary file, bytes. Ten kilometres of carefully surveyed road are about one megabyte.
const MAX_WIRE: usize = 64 << 20;

/// Largest text file, bytes. The text form takes four times the space of the binary one.
const MAX_TEXT: usize = 256 << 20;

/// Fields of the map that are read, with their names and numbers.
const FIELDS: [(&str, u32); 13] = [
    ("header", 1),
    ("crosswalk", 2),
    ("junction", 3),
    ("lane", 4),
    ("stop_sign", 5),
    ("signal", 6),
    ("yield", 7),
    ("overlap", 8),
    ("clear_area", 9),
    ("speed_bump", 10),
    ("road", 11),
    ("parking_space", 12),
    ("pnc_junction", 13),
];

/// Reads the bytes of a map in binary or text form, whichever it is.
///
/// # Errors
/// [`ImportError::Field`] and [`ImportError::Text`] with the field's path and, in a text, its line and column, when
/// the bytes are not an HD map of a schema that Apollo has used since version 3.
pub fn read_map(bytes: &[u8]) -> Result<MapData, ImportError> {
    let mut map = MapData::default();
    match text(bytes)? {
        Some(text) => read_text(text, &mut map)?,
        None => read_wire(bytes, &mut map)?,
    }
    sanity::check(&map).map_err(super::fault::Fault::into_error)?;
    Ok(map)
}

/// The bytes as text, if they are one: binary messages are full of control characters.
pub(super) fn text(bytes: &[u8]) -> Result<Option<&str>, ImportError> {
    let is_text = |byte: &u8| !byte.is_ascii_control() || byte.is_ascii_whitespace();
    let is_text = bytes.iter().all(is_text);
    let most = if is_text { MAX_TEXT } else { MAX_WIRE };
    if bytes.len() > most {
        return Err(ImportError::Bytes {
            at: most,
            problem: format!("the file has {} bytes", bytes.len()),
            expected: format!("at most {most}"),
        });
    }
    if !is_text {
        return Ok(None);
    }
    let text = std::str::from_utf8(bytes).map_err(|error| ImportError::Bytes {
        at: error.valid_up_to(),
        problem: "the text is not UTF-8 here".to_owned(),
        expected: "a text in UTF-8, or a binary message".to_owned(),
    })?;
    Ok(Some(text))
}

fn read_text(text: &str, map: &mut MapData) -> Result<(), ImportError> {
    let mut parser = Parser::new(text).map_err(|error| error.into_error(text))?;
    let mut counts = [0; FIELDS.len()];
    while let Some(field) = parser.next_field().map_err(|error| error.into_error(text))? {
        if let Some(which) = FIELDS.iter().position(|(name, _)| *name == field.name) {
            add(map, which, counts[which], &Record::Text { text, field })?;
            counts[which] += 1;
        }
    }
    Ok(())
}

fn read_wire(bytes: &[u8], map: &mut MapData) -> Result<(), ImportError> {
    let mut records = Records::new(bytes);
    let mut counts = [0; FIELDS.len()];
    let no_field = |error: super::wire::NoField| ImportError::Bytes {
        at: error.at,
        problem: error.problem,
        expected: "a field of Apollo's message `Map`".to_owned(),
    };
    while let Some((number, bytes)) = records.next_record().map_err(no_field)? {
        if let Some(which) = FIELDS.iter().position(|(_, known)| *known == number) {
            add(map, which, counts[which], &Record::Wire(bytes))?;
            counts[which] += 1;
        }
    }
    Ok(())
}

/// Puts the `nth` record of one of [`FIELDS`] into the map.
fn add(map: &mut MapData, which: usize, nth: usize, record: &Record<'_>) -> Result<(), ImportError> {
    push(map, FIELDS[which].1, record).map_err(|mistake| match mistake {
        Mistake::Error(error) => error,
        Mistake::Fault(fault) => {
            let place = record.place(fault.path());
            let fault = Err::<(), _>(fault).inside_nth(FIELDS[which].0, nth);
            fault.expect_err("was one before").into_error().at(place)
        }
    })
}

fn push(map: &mut MapData, number: u32, record: &Record<'_>) -> Result<(), Mistake> {
    match number {
        1 => {
            let header: Header = record.decode()?;
            map.projection = header.projection.and_then(|projection| projection.proj);
        }
        2 => map.crosswalks.push(convert::outline(record.decode()?)?),
        3 => map.junctions.push(convert::outline(record.decode()?)?),
        4 => map.lanes.push(convert::lane(record.decode()?)?),
        5 => map.stop_signs.push(convert::sign(record.decode()?)?),
        6 => map.signals.push(convert::signal(record.decode()?)?),
        7 => map.yield_signs.push(convert::sign(record.decode()?)?),
        8 => map.overlaps.push(convert::overlap(record.decode()?)?),
        9 => map.clear_areas.push(convert::clear_area(record.decode()?)?),
        10 => map.speed_bumps.push(convert::speed_bump(record.decode()?)?),
        11 => map.roads.push(convert::road(record.decode()?)?),
        12 => map.parking_spaces.push(convert::outline(record.decode()?)?),
        13 => map.pnc_junctions.push(convert::outline(record.decode()?)?),
        _ => {}
    }
    Ok(())
}
