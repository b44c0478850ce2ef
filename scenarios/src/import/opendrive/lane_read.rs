//! Reads `<lanes>`: sections, lanes, widths, marks and speeds.

use super::profile::{Cubic, Profile};
use super::record::{Direction, Extent, LaneRecord, MarkRecord, Section, SpeedRecord};
use crate::import::ImportError;
use crate::import::notes::Notes;
use crate::import::xml::Element;
use corridor_decider::road::{BoundaryType, LaneKind};

/// Sections by ascending station, and the offset of lane 0.
pub(super) fn read(road: Element<'_>, notes: &mut Notes<'_>) -> Result<(Profile, Vec<Section>), ImportError> {
    let lanes = road.required_child("lanes")?;
    let mut offsets = Vec::new();
    for element in lanes.children("laneOffset") {
        offsets.push(cubic(element, element.number("s")?, Element::number)?);
    }
    let mut sections = Vec::new();
    for element in lanes.children("laneSection") {
        sections.push(section(element, notes)?);
    }
    if sections.is_empty() {
        return Err(lanes.error("has no <laneSection>", "at least one"));
    }
    sections.sort_by(|a, b| a.s.total_cmp(&b.s));
    Ok((Profile::new(offsets), sections))
}

fn section(element: Element<'_>, notes: &mut Notes<'_>) -> Result<Section, ImportError> {
    let s = element.number("s")?;
    if element.text("singleSide") == Some("true") {
        let what = "a section for one side only: the lanes of the other side end here";
        notes.add(what, element.place(), || format!("section at s = {s}"));
    }
    let mut section = Section {
        s,
        place: element.place(),
        lanes: Vec::new(),
        centre_marks: Vec::new(),
    };
    let sides = element
        .elements()
        .filter(|side| ["left", "center", "right"].contains(&side.name()));
    for lane in sides.flat_map(|side| side.children("lane")) {
        let id = lane.integer("id")?;
        if id == 0 {
            section.centre_marks = marks(lane, s, 0)?;
        } else {
            section.lanes.push(read_lane(lane, id, s, notes)?);
        }
    }
    section.lanes.sort_by_key(|lane| std::cmp::Reverse(lane.id));
    if let Some(pair) = section.lanes.windows(2).find(|pair| pair[0].id == pair[1].id) {
        return Err(element.error(format!("has two lanes of id {}", pair[0].id), "each id once"));
    }
    Ok(section)
}

fn read_lane(
    element: Element<'_>,
    id: i32,
    s: f64,
    notes: &mut Notes<'_>,
) -> Result<LaneRecord, ImportError> {
    let name = element.text("type").unwrap_or("none");
    let kind = kind(name).unwrap_or_else(|| {
        notes.add(
            "an unknown lane type, taken as closed ground",
            element.place(),
            || format!("`{name}`"),
        );
        LaneKind::Other
    });
    Ok(LaneRecord {
        id,
        place: element.place(),
        kind,
        direction: direction(element, name),
        extent: extent(element, s, notes)?,
        marks: marks(element, s, id)?,
        speeds: lane_speeds(element, s, notes)?,
        links: [link_ids(element, "predecessor")?, link_ids(element, "successor")?],
    })
}

/// `direction` since 1.8; before, a type of its own for lanes that both directions share.
fn direction(lane: Element<'_>, kind: &str) -> Direction {
    match lane.text("direction") {
        Some("reversed") => Direction::Reversed,
        Some("both") => Direction::Both,
        None if kind == "bidirectional" => Direction::Both,
        _ => Direction::Standard,
    }
}

/// The lane types of OpenDRIVE 1.1 to 1.8.
fn kind(name: &str) -> Option<LaneKind> {
    Some(match name {
        "driving" | "bidirectional" | "shared" | "HOV" => LaneKind::Driving,
        "entry" | "exit" | "onRamp" | "offRamp" | "connectingRamp" | "slipLane" | "mwyEntry" | "mwyExit" => {
            LaneKind::Ramp
        }
        "stop" => LaneKind::Stop,
        "shoulder" => LaneKind::Shoulder,
        "parking" => LaneKind::Parking,
        "border" => LaneKind::Border,
        "curb" => LaneKind::Curb,
        "median" => LaneKind::Median,
        // A private car may not use the lanes of one class of vehicles.
        "restricted" | "roadWorks" | "bus" | "taxi" => LaneKind::Restricted,
        "biking" => LaneKind::Biking,
        "sidewalk" | "walking" => LaneKind::Sidewalk,
        "tram" | "rail" => LaneKind::Rail,
        "none" | "special1" | "special2" | "special3" => LaneKind::Other,
        _ => return None,
    })
}

/// Width if there is one, else border, else nothing at all.
fn extent(element: Element<'_>, s: f64, notes: &mut Notes<'_>) -> Result<Extent, ImportError> {
    let mut widths = Vec::new();
    for width in element.children("width") {
        let mut record = cubic(width, s + width.number("sOffset")?, Element::any_number)?;
        if record.coefficients.iter().any(|c| !c.is_finite()) {
            notes.add(
                "a lane width that is not a number, taken as 0",
                width.place(),
                || "<width>".to_owned(),
            );
            record.coefficients = [0.0; 4];
        }
        widths.push(record);
    }
    if !widths.is_empty() {
        return Ok(Extent::Width(Profile::new(widths)));
    }
    let mut borders = Vec::new();
    for border in element.children("border") {
        borders.push(cubic(border, s + border.number("sOffset")?, Element::number)?);
    }
    let borders = Profile::new(borders);
    Ok(if borders.is_empty() {
        Extent::Width(borders)
    } else {
        Extent::Border(borders)
    })
}

fn cubic<'a>(
    element: Element<'a>,
    s: f64,
    number: impl Fn(Element<'a>, &str) -> Result<f64, ImportError>,
) -> Result<Cubic, ImportError> {
    let coefficients = [
        number(element, "a")?,
        number(element, "b")?,
        number(element, "c")?,
        number(element, "d")?,
    ];
    Ok(Cubic { s, coefficients })
}

fn link_ids(lane: Element<'_>, name: &'static str) -> Result<Vec<i32>, ImportError> {
    let links = lane.child("link");
    links
        .into_iter()
        .flat_map(|link| link.children(name))
        .map(|target| target.integer("id"))
        .collect()
}

/// The marks of one lane, by ascending station.
fn marks(lane: Element<'_>, s: f64, id: i32) -> Result<Vec<MarkRecord>, ImportError> {
    let mut records = Vec::new();
    for mark in lane.children("roadMark") {
        let yellow = mark.text("color") == Some("yellow");
        let (first, second) = lines(mark.text("type").unwrap_or("none"), yellow);
        // A pair of lines is listed from lane 0 outward, on lane 0 itself from left to right.
        let (from_left, from_right) = if id > 0 { (second, first) } else { (first, second) };
        records.push(MarkRecord {
            s: s + mark.number_or("sOffset", 0.0)?,
            from_left,
            from_right,
            change: lane_change(mark),
        });
    }
    records.sort_by(|a, b| a.s.total_cmp(&b.s));
    Ok(records)
}

/// Whether a lane change is allowed from the left and from the right of a mark. Ids increase towards the left.
fn lane_change(mark: Element<'_>) -> [bool; 2] {
    match mark.text("laneChange") {
        Some("none") => [false, false],
        Some("increase") => [false, true],
        Some("decrease") => [true, false],
        _ => [true, true],
    }
}

/// The classes of the first and the second line of a mark; single lines are both.
///
/// The original knows no white double line: `solid solid` is its only double class in either colour, which is
/// also what it means to a driver: never cross.
fn lines(name: &str, yellow: bool) -> (BoundaryType, BoundaryType) {
    use BoundaryType as B;
    let (dotted, solid) = if yellow {
        (B::DottedYellow, B::SolidYellow)
    } else {
        (B::DottedWhite, B::SolidWhite)
    };
    match name {
        "broken" | "broken broken" | "botts dots" => (dotted, dotted),
        "solid" => (solid, solid),
        "solid solid" => (B::DoubleYellow, B::DoubleYellow),
        "solid broken" => (solid, dotted),
        "broken solid" => (dotted, solid),
        "curb" | "grass" | "edge" => (B::Curb, B::Curb),
        _ => (B::Unknown, B::Unknown),
    }
}

fn lane_speeds(lane: Element<'_>, s: f64, notes: &mut Notes<'_>) -> Result<Vec<SpeedRecord>, ImportError> {
    let mut records = Vec::new();
    for element in lane.children("speed") {
        let at = s + element.number_or("sOffset", 0.0)?;
        if let Some(limit) = speed(element, notes)? {
            records.push(SpeedRecord { s: at, limit });
        }
    }
    records.sort_by(|a, b| a.s.total_cmp(&b.s));
    Ok(records)
}

/// The limit of a `<speed>` in m/s, infinite for none; `None` when it is not to be believed.
pub(super) fn speed(element: Element<'_>, notes: &mut Notes<'_>) -> Result<Option<f64>, ImportError> {
    if let Some("no limit" | "undefined") = element.text("max") {
        return Ok(Some(f64::INFINITY));
    }
    let factor = match element.text("unit") {
        None | Some("m/s") => 1.0,
        Some("km/h") => 1.0 / 3.6,
        Some("mph") => 0.447_04,
        Some(unit) => return Err(element.error(format!("has unit=\"{unit}\""), "m/s, km/h or mph")),
    };
    let limit = element.number("max")? * factor;
    if limit > 0.0 {
        return Ok(Some(limit));
    }
    notes.add(
        "a speed limit that is not positive, ignored",
        element.place(),
        || "<speed>".to_owned(),
    );
    Ok(None)
}
