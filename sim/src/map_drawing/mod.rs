//! A map as one self-contained SVG: lanes by kind, marks, driving directions, a legend and a scale bar.
//!
//! Drawn in whole centimetres, `y` turned so that north is up. A junction's lanes are paler, and every lane tells its
//! name where the pointer rests on it. Lines thinner than could be seen when the whole map is shown are made wider.

mod legend;
mod path;

use crate::map_report::{corners, kind_name, limit_name};
use crate::trace::outline;
use crate::view::lane::{MarkData, marks};
use corridor_decider::geometry::Vec2;
use corridor_decider::road::{BoundaryType, Lane, LaneKind, RoadMap};
use path::Paper;
use std::fmt::Write as _;

/// Colours of the lanes. Marks are white, so nothing on which they are painted is.
const COLOURS: [(LaneKind, &str); 13] = [
    (LaneKind::Other, "#dcdcd6"),
    (LaneKind::Sidewalk, "#d8cfbd"),
    (LaneKind::Border, "#c4c6c0"),
    (LaneKind::Curb, "#8a8f96"),
    (LaneKind::Median, "#bfd0a8"),
    (LaneKind::Rail, "#a58f86"),
    (LaneKind::Restricted, "#d3a5a5"),
    (LaneKind::Biking, "#9fc7ab"),
    (LaneKind::Shoulder, "#b9c4c9"),
    (LaneKind::Parking, "#9dbbe0"),
    (LaneKind::Stop, "#a9b8dc"),
    (LaneKind::Ramp, "#b3a7c9"),
    (LaneKind::Driving, "#a3abb6"),
];

/// Width of a painted line, m.
const MARK: f64 = 0.12;

/// Widest that a line is drawn to be seen from afar, m: lanes stay apart.
const WIDEST_MARK: f64 = 0.4;

/// Part of the map's size that a line is wide at least: not much less than a pixel of a screen.
const VISIBLE: f64 = 1.0 / 2000.0;

/// Least size of a map that things are in proportion to, m.
const SMALLEST: f64 = 20.0;

/// The drawing of a map called `name`.
pub fn svg(name: &str, map: &RoadMap) -> String {
    let (low, high) = corners(map.lanes());
    let size = (high - low).norm().max(SMALLEST);
    let paper = Paper::new(low, high, size);
    let shown: Vec<(LaneKind, &str)> = COLOURS
        .into_iter()
        .filter(|(kind, _)| map.lanes().iter().any(|lane| lane.kind == *kind))
        .collect();
    let mut svg = paper.opening(name, legend::width(&shown, paper.size()));
    svg += &style((size * VISIBLE).clamp(MARK, WIDEST_MARK));
    let mut lanes: Vec<&Lane> = map.lanes().iter().collect();
    // Roads over pavements, junctions below the roads that lead to them.
    lanes.sort_by_key(|lane| (layer(lane.kind), lane.junction.is_none()));
    for lane in &lanes {
        svg += &surface(lane, &paper);
    }
    let outlines: Vec<_> = map
        .lanes()
        .iter()
        .map(|lane| outline::outline_by(lane, 1))
        .collect();
    for mark in marks(&outlines, low) {
        svg += &painted(&mark, &paper);
    }
    svg += "<path class=\"arrow\" d=\"";
    for lane in lanes.iter().filter(|lane| lane.kind.is_drivable()) {
        svg += &path::arrows(lane, &paper);
    }
    svg += "\"/>\n";
    svg + &legend::legend(&shown, &paper) + "</svg>\n"
}

/// What lies over what: the place of the kind in the table of colours.
fn layer(kind: LaneKind) -> usize {
    COLOURS.iter().position(|(known, _)| *known == kind).unwrap_or(0)
}

/// The style sheet, for lines `width` metres wide.
fn style(width: f64) -> String {
    let mark = width * 100.0;
    let mut style = String::from("<style>\n");
    for (kind, colour) in COLOURS {
        let _ = writeln!(style, ".{}{{fill:{colour}}}", kind_name(kind));
    }
    let _ = write!(
        style,
        "path{{stroke-linejoin:round}}\n.lane{{stroke:#6d747e;stroke-width:{edge:.1}}}\n.inside{{fill-opacity:.5;\
         stroke-opacity:.5}}\n.lane:hover{{fill:#f0c14b}}\n.mark{{fill:none;stroke-width:{mark:.1}}}\n\
         .white{{stroke:#fff}}\n.yellow{{stroke:#e09c00}}\n.kerb{{stroke:#3f454d}}\n\
         .broken{{stroke-dasharray:300 300}}\n.double{{stroke:#e09c00;stroke-width:{double:.1}}}\n\
         .between{{stroke:#a3abb6;stroke-width:{between:.1}}}\n.arrow{{fill:#39424e}}\n\
         text{{font-family:sans-serif;fill:#1b1f26}}\n</style>\n",
        edge = mark / 2.0,
        double = 4.0 * mark,
        between = 1.6 * mark,
    );
    style
}

/// The surface of a lane, with its name.
fn surface(lane: &Lane, paper: &Paper) -> String {
    let points = &lane.points;
    let left: Vec<Vec2> = points.iter().map(|p| p.offset(p.left)).collect();
    let right: Vec<Vec2> = points.iter().rev().map(|p| p.offset(-p.right)).collect();
    let mut ring = paper.thinned(&left);
    ring.extend(paper.thinned(&right));
    let inside = if lane.junction.is_some() { " inside" } else { "" };
    let limit = if lane.kind.is_drivable() {
        format!(", {}", limit_name(lane))
    } else {
        String::new()
    };
    format!(
        "<path class=\"lane {kind}{inside}\" d=\"{}z\"><title>{}: {kind}, {:.1} m{limit}</title></path>\n",
        path::data(&ring),
        legend::escaped(&lane.name),
        lane.length(),
        kind = kind_name(lane.kind),
    )
}

/// A painted line; a double one is a wide one with a gap painted over it.
fn painted(mark: &MarkData, paper: &Paper) -> String {
    let points: Vec<Vec2> = mark
        .at
        .chunks_exact(2)
        .map(|at| paper.low() + Vec2::new(at[0], at[1]))
        .collect();
    let data = path::data(&paper.thinned(&points));
    let line = |class: &str| format!("<path class=\"mark {class}\" d=\"{data}\"/>\n");
    match mark.kind {
        BoundaryType::Unknown => String::new(),
        BoundaryType::DottedYellow => line("yellow broken"),
        BoundaryType::DottedWhite => line("white broken"),
        BoundaryType::SolidYellow => line("yellow"),
        BoundaryType::SolidWhite => line("white"),
        BoundaryType::DoubleYellow => line("double") + &line("between"),
        BoundaryType::Curb => line("kerb"),
    }
}

#[cfg(test)]
mod tests;
