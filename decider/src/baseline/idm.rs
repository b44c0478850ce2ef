//! The law of the Intelligent Driver Model (Treiber, Hennecke, Helbing, "Congested traffic states in empirical
//! observations and microscopic simulations", 2000): `a·(1 − (v/v₀)⁴ − (s*/s)²)`, `s* = s₀ + max(0, vT + vΔv/(2√(ab)))`.

/// Smallest gap that enters the law, m: at contact it has a pole.
const SMALLEST_GAP: f64 = 0.1;

/// Who wants to drive more slowly than this wants to stand, m/s.
const STANDSTILL: f64 = 0.1;

/// A driver's parameters. Defaults: those of PDM-Closed, with the usual exponent and gap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IdmLaw {
    /// Acceleration on a free road, m/s².
    pub acceleration: f64,
    /// Comfortable braking, m/s², positive.
    pub braking: f64,
    /// Time behind what drives ahead, s.
    pub headway: f64,
    /// Gap at standstill, m.
    pub least_gap: f64,
}

impl Default for IdmLaw {
    fn default() -> Self {
        Self {
            acceleration: 1.5,
            braking: 3.0,
            headway: 1.5,
            least_gap: 2.0,
        }
    }
}

/// What is ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leader {
    /// Between the bumpers, m.
    pub gap: f64,
    /// Speed along the line, m/s.
    pub speed: f64,
}

impl IdmLaw {
    /// Acceleration at a speed, m/s². Too fast on a free road brakes no harder than is comfortable.
    pub fn acceleration(&self, v: f64, desired: f64, leader: Option<Leader>) -> f64 {
        let ratio = v / desired.max(STANDSTILL);
        let free = self.acceleration * (1.0 - ratio * ratio * ratio * ratio);
        let free = if desired < STANDSTILL {
            -self.braking
        } else {
            free.max(-self.braking)
        };
        let pressed = leader.map_or(0.0, |leader| {
            let part = self.wanted_gap(v, leader.speed) / leader.gap.max(SMALLEST_GAP);
            part * part
        });
        free - self.acceleration * pressed
    }

    /// The gap that is wanted behind something, m.
    fn wanted_gap(&self, v: f64, leader: f64) -> f64 {
        let brake = 2.0 * (self.acceleration * self.braking).sqrt();
        let dynamic = v * self.headway + v * (v - leader) / brake;
        self.least_gap + dynamic.max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At equal speeds the law is at rest at `(s₀ + vT)/√(1 − (v/v₀)⁴)`.
    #[test]
    fn the_gap_of_equilibrium_is_that_of_the_paper() {
        let law = IdmLaw::default();
        for v in [2.0, 8.0, 12.0] {
            let ratio: f64 = v / 15.0;
            let gap = (2.0 + 1.5 * v) / (1.0 - ratio * ratio * ratio * ratio).sqrt();
            let leader = |gap| Some(Leader { gap, speed: v });
            assert!(law.acceleration(v, 15.0, leader(gap)).abs() < 1e-12);
            assert!(law.acceleration(v, 15.0, leader(gap - 0.5)) < 0.0);
            assert!(law.acceleration(v, 15.0, leader(gap + 0.5)) > 0.0);
        }
    }

    #[test]
    fn a_free_road_is_driven_at_the_desired_speed() {
        let law = IdmLaw::default();
        assert!((law.acceleration(0.0, 10.0, None) - 1.5).abs() < 1e-12);
        assert!(law.acceleration(10.0, 10.0, None).abs() < 1e-12);
        assert!((law.acceleration(30.0, 10.0, None) + 3.0).abs() < 1e-12);
        assert!((law.acceleration(5.0, 0.0, None) + 3.0).abs() < 1e-12);
    }
}
