//! `tr1`: CommonRoad's cost function of that name over the driven run. It ranks runs of one scenario, nothing else.
//!
//! Integrals by Simpson's rule over 10 Hz samples, derivatives of acceleration and road-wheel angle by the parabola
//! through three of them. SI units, without one in the sum.

use super::SAMPLE_PERIOD;
use super::measure::Measure;
use super::savitzky_golay::derivative;
use super::surroundings::Surroundings;
use super::view::Sample;

/// Weights of jerk along the car, steering rate, distance and offset.
const WEIGHTS: [f64; 4] = [0.01, 22.0, 8.0, 0.5];

/// How fast the cost of a distance fades, 1/m.
const DISTANCE_SCALE: f64 = 0.2;

/// Samples in the window of a derivative.
const WINDOW: usize = 3;

/// What the costs are made of, sampled.
#[derive(Clone, Debug, Default)]
pub(super) struct Tr1Watch {
    a: Vec<f64>,
    steer: Vec<f64>,
    nearness: Vec<f64>,
    offset_squared: Vec<f64>,
}

impl Tr1Watch {
    pub(super) fn sample(&mut self, sample: &Sample, surroundings: &Surroundings) {
        let nearest = surroundings.ahead().map(|ahead| ahead.gap).reduce(f64::min);
        self.a.push(sample.ego().a);
        self.steer.push(sample.ego().steer);
        self.nearness
            .push(nearest.map_or(0.0, |gap| libm::exp(-DISTANCE_SCALE * gap)));
        self.offset_squared.push(sample.planned.l * sample.planned.l);
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        let squared_rate = |values: &[f64]| -> Vec<f64> {
            let rates = derivative(values, WINDOW, 1, SAMPLE_PERIOD);
            rates.into_iter().map(|rate| rate * rate).collect()
        };
        let parts = [
            squared_rate(&self.a),
            squared_rate(&self.steer),
            self.nearness.clone(),
            self.offset_squared.clone(),
        ];
        let costs = parts.iter().zip(WEIGHTS);
        let cost = costs
            .map(|(values, weight)| weight * integral(values, SAMPLE_PERIOD))
            .sum();
        let is_measured = self.a.len() >= WINDOW;
        vec![Measure::new("tr1", is_measured.then_some(cost))]
    }
}

/// Simpson's rule; the last interval of an odd number of them by the trapezium.
fn integral(values: &[f64], period: f64) -> f64 {
    let pairs = values.len().saturating_sub(1) / 2;
    let simpson: f64 = (0..pairs)
        .map(|k| {
            let [a, b, c] = [values[2 * k], values[2 * k + 1], values[2 * k + 2]];
            (a + 4.0 * b + c) * period / 3.0
        })
        .sum();
    let rest: f64 = values[(2 * pairs).min(values.len())..]
        .windows(2)
        .map(|pair| (pair[0] + pair[1]) * period / 2.0)
        .sum();
    simpson + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Simpson's rule is exact for cubics: ∫₀¹ x³ dx = 1/4; with one interval too many the trapezium adds its own.
    #[test]
    fn cubics_are_integrated_exactly() {
        let cubic = |count: u32| -> Vec<f64> {
            let x = |k: u32| f64::from(k) * 0.1;
            (0..count).map(|k| x(k) * x(k) * x(k)).collect()
        };
        assert!((integral(&cubic(11), 0.1) - 0.25).abs() < 1e-12);
        let one_more = 0.25 + (1.0 + 1.331) * 0.05;
        assert!((integral(&cubic(12), 0.1) - one_more).abs() < 1e-12);
        assert!(integral(&[], 0.1).abs() < 1e-12 && integral(&[3.0], 0.1).abs() < 1e-12);
        assert!((integral(&[1.0, 3.0], 0.1) - 0.2).abs() < 1e-12);
    }
}
