//! `st_boundary.*`: what a boundary is made of and what it says.

use super::{SpeedCase, check_failed};
use corridor_decider::st_graph::{BoundaryType, StBoundary, StBoundaryError, StPair, StPoint};
use serde::Deserialize;
use serde_json::{Value, json};

#[derive(Deserialize)]
struct Asked {
    pairs: Vec<[f64; 3]>,
    accurate: bool,
    #[serde(rename = "type", default)]
    kind: BoundaryType,
    #[serde(default)]
    s: f64,
    #[serde(default)]
    t: Value,
    #[serde(default)]
    points_ts: Vec<[f64; 2]>,
    #[serde(default)]
    segments_tsts: Vec<[f64; 4]>,
}

/// Pairs `[t, lower, upper]`.
pub(super) fn pairs(given: &[[f64; 3]]) -> Vec<StPair> {
    given
        .iter()
        .map(|[t, lower, upper]| StPair::new(*t, *lower, *upper))
        .collect()
}

pub(super) fn check(case: &SpeedCase, function: &str) -> Result<(), String> {
    let asked: Asked = case.input()?;
    let given = pairs(&asked.pairs);
    if function == "create_instance" && given.len() < 2 {
        return case.expect(&json!({ "empty": true, "pairs": [] }));
    }
    if function == "unblock_s_range" && given.is_empty() {
        // Where there is no boundary all is free; Corridor has no empty one.
        return case.expect(&json!([{ "ok": true, "upper": 200.0, "lower": 0.0 }]));
    }
    let made = if asked.accurate {
        StBoundary::new(given)
    } else {
        StBoundary::reduced(given)
    };
    let answer = made.and_then(|boundary| {
        let boundary = boundary.with_kind(asked.kind);
        answer(&boundary, function, &asked)
    });
    match answer {
        Ok(Some(answer)) => case.expect(&answer),
        Ok(None) => Err(case.unknown()),
        Err(_) => case.expect(&check_failed()),
    }
}

fn answer(boundary: &StBoundary, function: &str, asked: &Asked) -> Result<Option<Value>, StBoundaryError> {
    let time = || asked.t.as_f64().unwrap_or_default();
    Ok(Some(match function {
        "new" | "create_instance" => describe(Some(boundary)),
        "expand_by_s" => describe(Some(&boundary.expanded_by_s(asked.s)?)),
        "expand_by_t" => describe(Some(&boundary.expanded_by_t(time())?)),
        "cut_off_by_t" => describe(boundary.cut_off_before(time())?.as_ref()),
        "is_point_in" => {
            let inside = |[t, s]: &[f64; 2]| boundary.contains(StPoint::new(*t, *s));
            json!(asked.points_ts.iter().map(inside).collect::<Vec<_>>())
        }
        "has_overlap_segment" => {
            let meets = |[t1, s1, t2, s2]: &[f64; 4]| {
                boundary.meets_segment(StPoint::new(*t1, *s1), StPoint::new(*t2, *s2))
            };
            json!(asked.segments_tsts.iter().map(meets).collect::<Vec<_>>())
        }
        "unblock_s_range" | "boundary_s_range" | "boundary_slopes" => {
            let times = asked.t.as_array().into_iter().flatten();
            times
                .map(|t| at(boundary, function, t.as_f64().unwrap_or(f64::NAN)))
                .collect()
        }
        _ => return Ok(None),
    }))
}

fn at(boundary: &StBoundary, function: &str, t: f64) -> Value {
    match function {
        "unblock_s_range" => match boundary.unblocked_range(t) {
            Some(free) => json!({ "ok": true, "upper": free.upper, "lower": free.lower }),
            None => json!({ "ok": false, "upper": 200.0, "lower": 0.0 }),
        },
        "boundary_s_range" => match boundary.range(t) {
            Some(range) => json!({ "ok": true, "upper": range.upper, "lower": range.lower }),
            None => json!({ "ok": false }),
        },
        _ => match boundary.slopes(t) {
            Some(slopes) => json!({ "ok": true, "ds_upper": slopes.upper, "ds_lower": slopes.lower }),
            None => json!({ "ok": false }),
        },
    }
}

fn describe(boundary: Option<&StBoundary>) -> Value {
    let Some(boundary) = boundary else {
        return json!({ "empty": true, "pairs": [] });
    };
    let pairs = boundary.pairs().iter();
    json!({
        "empty": false,
        "pairs": pairs.map(|pair| [pair.t, pair.lower, pair.upper]).collect::<Vec<_>>(),
        "min_s": boundary.min_s(),
        "max_s": boundary.max_s(),
        "min_t": boundary.min_t(),
        "max_t": boundary.max_t(),
        "area": boundary.area(),
    })
}
