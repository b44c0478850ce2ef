//! One run as one self-contained HTML page: no server, no network, no build step.
//!
//! The page shows the road from above, the Frenet picture with every candidate bound and its causes, speed and
//! its companions over time, the events, the verdict, the decision and the tasks of each tick, with one slider for all.
//! A run of the lattice planner has in place of bounds every sampled curve, across the line and over time, in the colour
//! of its cost (`lattice.js`, `st.js`, `weighed.js`).
//! `page.html` is its skeleton; the data go in as JSON, thinned to what a screen can show.

mod again;
mod bundle;
mod data;
mod intern;
pub(crate) mod lane;
mod letters;
mod line;
mod series;
pub(crate) mod thin;
mod tick;

use crate::trace::Trace;

const SKELETON: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");

/// The scripts, in the order in which they build on each other.
const SCRIPTS: [&str; 11] = [
    include_str!("core.js"),
    include_str!("canvas.js"),
    include_str!("ground.js"),
    include_str!("lattice.js"),
    include_str!("road.js"),
    include_str!("frenet.js"),
    include_str!("st.js"),
    include_str!("charts.js"),
    include_str!("panel.js"),
    include_str!("weighed.js"),
    include_str!("main.js"),
];

/// The page of a run. `#t=12.3` at the end of its address opens it at that time.
#[expect(clippy::missing_panics_doc, reason = "plain data always serialise")]
pub fn page(trace: &Trace) -> String {
    let data = serde_json::to_string(&data::Page::new(trace)).expect("plain data always serialise");
    // In JSON `<` stands only inside strings, where its escape means the same; so no text of a scenario can end
    // the script element.
    let data = data.replace('<', "\\u003c");
    let script = SCRIPTS.concat();
    let title = escape(&trace.header.scenario);
    fill(
        SKELETON,
        &[
            ("{{title}}", &title),
            ("{{style}}", STYLE),
            ("{{data}}", &data),
            ("{{script}}", &script),
        ],
    )
}

/// Text as it may stand between tags.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

/// Puts values into their places; what is put in is not looked at again.
fn fill(skeleton: &str, values: &[(&str, &str)]) -> String {
    let mut out = String::new();
    let mut rest = skeleton;
    while let Some((at, place, value)) = values
        .iter()
        .filter_map(|(place, value)| rest.find(place).map(|at| (at, place, value)))
        .min_by_key(|(at, ..)| *at)
    {
        out.push_str(&rest[..at]);
        out.push_str(value);
        rest = &rest[at + place.len()..];
    }
    out.push_str(rest);
    out
}

#[cfg(test)]
mod tests;
