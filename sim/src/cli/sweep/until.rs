//! `--until RATE`: a sweep that ends when its claim can be made.

use corridor_sim::report::SweepReport;
use corridor_sim::sweep::statistics::{CONFIDENCE, runs_for_claim};
use corridor_sim::sweep::{Claim, Standing};

/// How many times the runs of a clean sweep it may take: at half the claimed rate one in a hundred takes longer.
const PATIENCE: u64 = 20;

/// A share of runs, as in `0.1%` or `0.001`.
pub(super) fn rate(text: &str) -> Result<Claim, String> {
    let (number, scale) = text
        .strip_suffix('%')
        .map_or((text, 1.0), |number| (number, 0.01));
    let rate = number.trim().parse::<f64>().ok().map(|number| number * scale);
    rate.and_then(Claim::new)
        .ok_or_else(|| "a share between 0 and 1 is wanted, as in `0.1%` or `0.001`".to_owned())
}

/// How many runs it may take.
pub(super) fn most_runs(claim: Claim) -> u64 {
    let clean = runs_for_claim(claim.rate(), CONFIDENCE).expect("a claim is a share");
    PATIENCE.saturating_mul(clean).min(super::MOST_RUNS)
}

/// How the claim stands. A run that could not be made counts as one that failed.
pub(super) fn standing(claim: Claim, report: &SweepReport) -> Standing {
    claim.standing(report.failures(), report.runs())
}

/// What came of it, in a line.
pub(super) fn sentence(claim: Claim, standing: Standing, report: &SweepReport) -> String {
    let percent = claim.rate() * 100.0;
    let what = match standing {
        Standing::Made => format!("made: fewer than {percent} % of such runs fail"),
        Standing::Refuted => format!("refuted: more than {percent} % of such runs fail"),
        Standing::Open => {
            format!("open: that fewer than {percent} % of such runs fail can neither be claimed nor refuted")
        }
    };
    format!(
        "claim {what}, at {:.0} % confidence after {} runs with {} failures\n",
        CONFIDENCE * 100.0,
        report.runs(),
        report.failures()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rate_is_a_share_or_a_percentage() {
        let rate = |text| rate(text).ok().map(Claim::rate);
        assert_eq!(rate("0.001"), Some(0.001));
        assert!((rate("0.1%").unwrap() - 0.001).abs() < 1e-18);
        assert_eq!(rate("25 %"), Some(0.25));
        for wrong in ["0", "1", "100%", "-1%", "nan", "", "%", "1e999"] {
            assert_eq!(rate(wrong), None, "{wrong}");
        }
    }
}
