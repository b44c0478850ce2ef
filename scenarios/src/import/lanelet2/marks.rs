//! The line on a bound, seen from one of its lanes.

use super::kinds::is_no;
use super::records::Tags;
use corridor_decider::road::{BoundaryType, Side};

/// The line on a way that bounds a lane. `lane_side` is the side of the way on which the lane lies, seen along the order
/// of the way's nodes.
///
/// A line that may be crossed from here is a dotted one, whatever it looks like from the other side. Tags on changing
/// lanes rule over the painting; where nothing is painted nothing is known, unless they forbid it.
pub(super) fn mark(tags: &Tags<'_>, lane_side: Side) -> BoundaryType {
    let kind = tags.get("type").copied().unwrap_or_default();
    let subtype = tags.get("subtype").copied().unwrap_or_default();
    let is_line = matches!(kind, "line_thin" | "line_thick");
    let painted = is_line.then(|| may_cross_line(subtype, lane_side)).flatten();
    let yellow = tags.get("color").or(tags.get("colour")) == Some(&"yellow");
    match override_tag(tags, lane_side).or(painted) {
        Some(true) if yellow => BoundaryType::DottedYellow,
        Some(true) => BoundaryType::DottedWhite,
        _ if is_hard(kind) => BoundaryType::Curb,
        Some(false) if yellow && subtype == "solid_solid" => BoundaryType::DoubleYellow,
        Some(false) if yellow => BoundaryType::SolidYellow,
        Some(false) => BoundaryType::SolidWhite,
        None => BoundaryType::Unknown,
    }
}

/// Whether a painted line may be crossed from a side; `None` when it is not said how it is painted.
fn may_cross_line(subtype: &str, lane_side: Side) -> Option<bool> {
    match subtype {
        "dashed" | "dashed_dashed" => Some(true),
        "solid" | "solid_solid" => Some(false),
        // The first word is the left line.
        "dashed_solid" => Some(lane_side == Side::Left),
        "solid_dashed" => Some(lane_side == Side::Right),
        _ => None,
    }
}

/// What the tags on changing lanes say about crossing from a side.
fn override_tag(tags: &Tags<'_>, lane_side: Side) -> Option<bool> {
    // They name the side that one goes to.
    let towards = match lane_side {
        Side::Left => "lane_change:right",
        Side::Right => "lane_change:left",
    };
    let value = tags.get(towards).or(tags.get("lane_change"))?;
    Some(!is_no(value))
}

/// What hurts the wheels or worse.
fn is_hard(kind: &str) -> bool {
    matches!(
        kind,
        "curbstone" | "road_border" | "wall" | "fence" | "guard_rail" | "jersey_barrier" | "gate"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(tags: &[(&'static str, &'static str)], side: Side) -> BoundaryType {
        mark(&tags.iter().copied().collect(), side)
    }

    #[test]
    fn two_lines_differ_by_side() {
        let line = [("type", "line_thin"), ("subtype", "dashed_solid")];
        assert_eq!(of(&line, Side::Left), BoundaryType::DottedWhite);
        assert_eq!(of(&line, Side::Right), BoundaryType::SolidWhite);
        let line = [("type", "line_thick"), ("subtype", "solid_dashed")];
        assert_eq!(of(&line, Side::Left), BoundaryType::SolidWhite);
        assert_eq!(of(&line, Side::Right), BoundaryType::DottedWhite);
    }

    #[test]
    fn tags_on_changing_lanes_rule() {
        let solid = [
            ("type", "line_thin"),
            ("subtype", "solid"),
            ("lane_change", "yes"),
        ];
        assert_eq!(of(&solid, Side::Left), BoundaryType::DottedWhite);
        let to_the_right = [
            ("type", "virtual"),
            ("lane_change:left", "no"),
            ("lane_change:right", "yes"),
        ];
        assert_eq!(of(&to_the_right, Side::Left), BoundaryType::DottedWhite);
        assert_eq!(of(&to_the_right, Side::Right), BoundaryType::SolidWhite);
    }

    #[test]
    fn what_is_not_painted_is_hard_or_unknown() {
        assert_eq!(
            of(&[("type", "virtual"), ("subtype", "dashed")], Side::Left),
            BoundaryType::Unknown
        );
        assert_eq!(
            of(&[("type", "curbstone"), ("subtype", "low")], Side::Left),
            BoundaryType::Curb
        );
        assert_eq!(of(&[("type", "line_thin")], Side::Left), BoundaryType::Unknown);
        assert_eq!(of(&[], Side::Right), BoundaryType::Unknown);
        let yellow = [
            ("type", "line_thin"),
            ("subtype", "solid_solid"),
            ("color", "yellow"),
        ];
        assert_eq!(of(&yellow, Side::Right), BoundaryType::DoubleYellow);
    }
}
