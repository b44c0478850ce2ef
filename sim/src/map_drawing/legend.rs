//! What the colours mean and how long a metre is, below the map.

use super::path::Paper;
use crate::map_report::kind_name;
use corridor_decider::road::LaneKind;
use std::fmt::Write as _;

/// Height of the letters as a share of the map's size.
const LETTERS: f64 = 0.012;

/// Longest scale bar as a share of the map's size.
const LONGEST_BAR: f64 = 0.15;

/// The legend and the scale bar.
pub(super) fn legend(kinds: &[(LaneKind, &str)], paper: &Paper) -> String {
    let letter = paper.size() * LETTERS;
    let line = paper.bottom() + 3.0 * letter;
    let bar = bar_length(paper.size() * LONGEST_BAR);
    let mut legend = format!(
        "<path d=\"M0 {high:.0}V{line:.0}H{bar:.0}V{high:.0}\" fill=\"none\" stroke=\"#1b1f26\" \
         stroke-width=\"{stroke:.0}\"/>\n<text x=\"{beside:.0}\" y=\"{line:.0}\" font-size=\"{letter:.0}\">{} m</text>\n",
        bar / 100.0,
        high = line - letter / 2.0,
        stroke = (letter / 8.0).max(1.0),
        beside = bar + letter / 2.0,
    );
    let mut x = 0.0;
    let row = line + 1.8 * letter;
    for (kind, _) in kinds.iter().rev() {
        let name = kind_name(*kind);
        let _ = writeln!(
            legend,
            "<rect class=\"{name}\" x=\"{x:.0}\" y=\"{top:.0}\" width=\"{letter:.0}\" height=\"{letter:.0}\"/>\
             <text x=\"{text:.0}\" y=\"{row:.0}\" font-size=\"{letter:.0}\">{name}</text>",
            top = row - 0.85 * letter,
            text = x + 1.3 * letter,
        );
        x += entry_width(name) * letter;
    }
    legend
}

/// Length of the legend, cm.
pub(super) fn width(kinds: &[(LaneKind, &str)], size: f64) -> f64 {
    let entries = kinds.iter().map(|(kind, _)| entry_width(kind_name(*kind)));
    entries.sum::<f64>() * size * LETTERS
}

/// Room for a colour and its name, in heights of a letter.
fn entry_width(name: &str) -> f64 {
    // Sans-serif letters are a little over half as wide as they are high.
    #[expect(clippy::cast_precision_loss, reason = "a name of a few letters")]
    let letters = name.len() as f64 * 0.6;
    letters + 2.5
}

/// The largest of 1, 2, 5, 10, … metres that is not longer than `longest`; both cm.
fn bar_length(longest: f64) -> f64 {
    let steps = [1.0, 2.0, 5.0];
    let mut best = 100.0;
    let mut decade = 100.0;
    while decade <= longest {
        best = steps
            .iter()
            .map(|step| step * decade)
            .filter(|bar| *bar <= longest)
            .fold(best, f64::max);
        decade *= 10.0;
    }
    best
}

/// A text inside XML. Control characters, which XML has no way to write, are left out.
pub(super) fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => {}
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_are_round() {
        for (longest, metres) in [
            (150.0, 1.0),
            (250.0, 2.0),
            (999.0, 5.0),
            (1000.0, 10.0),
            (7.7e6, 50_000.0),
        ] {
            assert!((bar_length(longest) - 100.0 * metres).abs() < 1e-9, "{longest}");
        }
    }

    #[test]
    fn no_name_breaks_the_drawing() {
        assert_eq!(escaped("a<b>&\"c\"\u{1}"), "a&lt;b&gt;&amp;&quot;c&quot;");
    }
}
