//! Reads `<signals>`: the signs that set a speed limit. All others are counted.
//!
//! German signs (`StVO`, catalogue of traffic signs): 274 sets a limit, 278 ends one, 282 ends all.

use super::record::SpeedSign;
use crate::import::ImportError;
use crate::import::notes::Notes;
use crate::import::xml::Element;

/// The speed limit signs of a road, by ascending station.
pub(super) fn speed_signs(road: Element<'_>, notes: &mut Notes<'_>) -> Vec<SpeedSign> {
    let mut signs = Vec::new();
    for signal in road.children("signals").flat_map(Element::elements) {
        if signal.name() != "signal" {
            let what = "a reference to a signal of another road is not followed";
            notes.add(what, signal.place(), || format!("<{}>", signal.name()));
            continue;
        }
        match speed_sign(signal) {
            Ok(Some(sign)) => signs.push(sign),
            Ok(None) | Err(_) => notes.add(untold(signal), signal.place(), || {
                signal
                    .text("type")
                    .map_or("<signal>".to_owned(), |kind| format!("type=\"{kind}\""))
            }),
        }
    }
    signs.sort_by(|a, b| a.s.total_cmp(&b.s));
    signs
}

/// What is not done with a signal.
fn untold(signal: Element<'_>) -> &'static str {
    if signal.text("dynamic") == Some("yes") {
        "a signal that changes, such as a traffic light, is not obeyed"
    } else {
        "a sign that is not a readable speed limit is not obeyed"
    }
}

fn speed_sign(signal: Element<'_>) -> Result<Option<SpeedSign>, ImportError> {
    let german = signal.text("country").is_some_and(|country| {
        ["DE", "DEU"]
            .iter()
            .any(|known| country.eq_ignore_ascii_case(known))
    });
    if !german || signal.text("dynamic") == Some("yes") {
        return Ok(None);
    }
    let limit = match signal.text("type") {
        Some("274") => limit(signal),
        Some("278" | "282") => Some(f64::INFINITY),
        _ => None,
    };
    let Some(limit) = limit else { return Ok(None) };
    let mut lanes = Vec::new();
    for validity in signal.children("validity") {
        lanes.push((validity.integer("fromLane")?, validity.integer("toLane")?));
    }
    Ok(Some(SpeedSign {
        s: signal.number("s")?,
        limit,
        forward: match signal.text("orientation") {
            Some("+") => Some(true),
            Some("-") => Some(false),
            _ => None,
        },
        lanes,
    }))
}

/// The value in m/s, if it is one. Older files give no unit: the sign shows km/h.
fn limit(signal: Element<'_>) -> Option<f64> {
    let factor = match signal.text("unit") {
        None | Some("km/h") => 1.0 / 3.6,
        Some("m/s") => 1.0,
        Some("mph") => 0.447_04,
        Some(_) => return None,
    };
    let value = signal.number("value").ok()?;
    (value > 0.0).then_some(value * factor)
}
