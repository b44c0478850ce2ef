//! What a lanelet is for, by its subtype and by who may use it.

use super::records::Tags;
use corridor_decider::road::LaneKind;

/// The use of a lanelet, or `None` when the subtype is an unknown word.
///
/// A subtype says who may use it unless any tag `participant:...` is there: then those and nobody else may.
pub(super) fn kind(tags: &Tags<'_>) -> Option<LaneKind> {
    let by_subtype = match tags.get("subtype").copied().unwrap_or("road") {
        "road" | "highway" | "play_street" | "exit" => LaneKind::Driving,
        "bus_lane" | "emergency_lane" => LaneKind::Restricted,
        "bicycle_lane" => LaneKind::Biking,
        "walkway" | "shared_walkway" | "crosswalk" | "stairs" | "pedestrian_lane" => LaneKind::Sidewalk,
        "rail" => LaneKind::Rail,
        "road_shoulder" => LaneKind::Shoulder,
        _ => return None,
    };
    let Some(participants) = Participants::of(tags) else {
        return Some(by_subtype);
    };
    Some(match by_subtype {
        LaneKind::Rail | LaneKind::Shoulder => by_subtype,
        _ if participants.cars => LaneKind::Driving,
        LaneKind::Driving if participants.bicycles => LaneKind::Biking,
        LaneKind::Driving if participants.pedestrians => LaneKind::Sidewalk,
        LaneKind::Driving => LaneKind::Restricted,
        other => other,
    })
}

/// Whether traffic runs both ways. Words for "no" other than that one are in use.
pub(super) fn is_two_way(tags: &Tags<'_>) -> bool {
    tags.get("one_way").is_some_and(|value| is_no(value))
}

/// Whether a value denies.
pub(super) fn is_no(value: &str) -> bool {
    matches!(value, "no" | "false" | "0")
}

/// Who is named as allowed.
struct Participants {
    cars: bool,
    bicycles: bool,
    pedestrians: bool,
}

impl Participants {
    /// `None` when nobody is named.
    fn of(tags: &Tags<'_>) -> Option<Self> {
        let named = || {
            tags.iter()
                .filter_map(|(key, value)| Some((key.strip_prefix("participant:")?, value)))
        };
        named().next()?;
        // A more special tag rules over the general one.
        let allowed = |names: &[&str]| {
            let ruling = names.iter().find_map(|name| named().find(|(key, _)| key == name));
            ruling.is_some_and(|(_, value)| !is_no(value))
        };
        Some(Self {
            cars: allowed(&["vehicle:car", "vehicle"]),
            bicycles: allowed(&["bicycle"]),
            pedestrians: allowed(&["pedestrian"]),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(tags: &[(&'static str, &'static str)]) -> Option<LaneKind> {
        kind(&tags.iter().copied().collect())
    }

    #[test]
    fn participants_rule_over_the_subtype() {
        assert_eq!(of(&[]), Some(LaneKind::Driving));
        assert_eq!(of(&[("subtype", "bus_lane")]), Some(LaneKind::Restricted));
        let bus = [("subtype", "bus_lane"), ("participant:vehicle", "yes")];
        assert_eq!(of(&bus), Some(LaneKind::Driving));
        let no_cars = [("participant:vehicle", "yes"), ("participant:vehicle:car", "no")];
        assert_eq!(of(&no_cars), Some(LaneKind::Restricted));
        let shared = [
            ("subtype", "road"),
            ("participant:bicycle", "yes"),
            ("participant:pedestrian", "yes"),
        ];
        assert_eq!(of(&shared), Some(LaneKind::Biking));
        assert_eq!(of(&[("subtype", "moat")]), None);
    }
}
