//! Speed limits, m/s: from tags, from signs, else what German law says without a sign.

use super::records::{File, RelationRecord, Tags};

/// m/s per km/h.
const KMH: f64 = 1.0 / 3.6;

/// m/s per mile an hour.
const MPH: f64 = 0.447_04;

/// Limits in Germany where no sign stands, km/h: in towns, outside, what is advised on motorways, and walking pace.
const URBAN: f64 = 50.0;
const NONURBAN: f64 = 100.0;
const MOTORWAY: f64 = 130.0;
const WALKING: f64 = 7.0;

/// A limit and where it comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Limit {
    /// The file gives it, m/s.
    Given(f64),
    /// The file gives none; what rules then, m/s.
    Default(f64),
    /// The file gives one that cannot be read; what rules without it, m/s.
    Unreadable(f64),
}

/// The limit on a lanelet: its own tag, else that of a regulatory element, else the default.
pub(super) fn limit(lanelet: &RelationRecord<'_>, file: &File<'_>) -> Limit {
    let default = default(&lanelet.tags);
    if let Some(text) = lanelet.tags.get("speed_limit") {
        return speed(text).map_or(Limit::Unreadable(default), Limit::Given);
    }
    let mut unreadable = false;
    for id in lanelet.members_as("relation", "regulatory_element") {
        let rule = file
            .relation_numbers
            .get(&id)
            .map(|number| &file.relations[*number]);
        let Some(rule) = rule.filter(|rule| rule.tags.get("subtype") == Some(&"speed_limit")) else {
            continue;
        };
        if let Some(limit) = regulated(rule, file) {
            return Limit::Given(limit);
        }
        unreadable = true;
    }
    if unreadable {
        Limit::Unreadable(default)
    } else {
        Limit::Default(default)
    }
}

/// The limit that a regulatory element says itself or by its signs.
fn regulated(rule: &RelationRecord<'_>, file: &File<'_>) -> Option<f64> {
    let sign = |text: &&str| speed(text).or_else(|| sign_speed(text));
    let own = ["speed_limit", "sign_type"]
        .iter()
        .find_map(|key| rule.tags.get(key).and_then(sign));
    own.or_else(|| {
        let signs = rule
            .members_as("way", "refers")
            .filter_map(|way| file.ways.get(&way));
        signs
            .filter_map(|way| way.tags.get("subtype"))
            .find_map(|subtype| sign_speed(subtype))
    })
}

/// A speed in words: a number of km/h, or with a unit.
fn speed(text: &str) -> Option<f64> {
    let text = text.trim();
    let end = text
        .find(|c: char| !c.is_ascii_digit() && c != '.')
        .unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    let unit = match unit.trim().to_ascii_lowercase().as_str() {
        "" | "km/h" | "kmh" | "kph" => KMH,
        "mph" => MPH,
        "m/s" | "mps" => 1.0,
        _ => return None,
    };
    let limit = number.parse::<f64>().ok()? * unit;
    (limit.is_finite() && limit > 0.0).then_some(limit)
}

/// The speed of a German traffic sign: `de274-60` a limit, `de274.1` a zone of 30, `de310` the entry to a town, `de325`
/// a play street. The separators differ between files.
fn sign_speed(sign: &str) -> Option<f64> {
    let number = sign.trim().strip_prefix("de")?;
    let (number, value) = number.split_once(['-', '_', '.', ':']).unwrap_or((number, ""));
    match (number, value) {
        ("274", "1") => Some(30.0 * KMH),
        ("274", value) => speed(value),
        ("310", _) => Some(URBAN * KMH),
        ("325", _) => Some(WALKING * KMH),
        _ => None,
    }
}

/// What rules where nothing is said.
fn default(tags: &Tags<'_>) -> f64 {
    let tag = |key| tags.get(key).copied().unwrap_or_default();
    KMH * match (tag("subtype"), tag("location")) {
        ("play_street", _) => WALKING,
        ("highway", "nonurban") => MOTORWAY,
        (_, "nonurban") => NONURBAN,
        _ => URBAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds_have_units() {
        let kmh = |text| speed(text).map(|limit| (limit * 36.0).round() / 10.0);
        assert_eq!(kmh("50"), Some(50.0));
        assert_eq!(kmh(" 30 km/h"), Some(30.0));
        assert_eq!(kmh("25 mph"), Some(40.2));
        assert_eq!(kmh("12.5m/s"), Some(45.0));
        for bad in ["", "none", "-5", "0", "50 knots", "1.2.3", "."] {
            assert_eq!(speed(bad), None, "{bad}");
        }
    }

    #[test]
    fn signs_have_speeds() {
        let kmh = |sign| sign_speed(sign).map(|limit| (limit * 3.6).round());
        assert_eq!(kmh("de274-60"), Some(60.0));
        assert_eq!(kmh("de274_1"), Some(30.0));
        assert_eq!(kmh("de310"), Some(50.0));
        for bad in ["de205", "usR1-1", "de274", "de274-x"] {
            assert_eq!(sign_speed(bad), None, "{bad}");
        }
    }
}
