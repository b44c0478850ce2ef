//! The cross-entropy method in the unit cube (Rubinstein 1999; de Boer et al. 2005): draw a generation, keep its best, draw
//! the next around them.

use corridor_scenarios::random::Stream;

/// Places in a generation.
const GENERATION: usize = 20;

/// Of them the ones that shape the next.
const ELITE: usize = 5;

/// Places of a generation that are drawn evenly whatever was learnt, so that a second valley can still be found.
const EVEN: usize = 5;

/// Share of the old centre and spread that the new ones take over.
const MEMORY: f64 = 0.3;

/// Spread at the start: almost even over the cube.
const WIDE: f64 = 0.4;

/// Least spread: the search never stands still.
const NARROW: f64 = 0.04;

/// A normal distribution in each direction of the cube, cut off at its sides.
#[derive(Clone, Debug)]
pub(super) struct CrossEntropy {
    centre: Vec<f64>,
    spread: Vec<f64>,
    stream: Stream,
    generations: u32,
}

impl CrossEntropy {
    /// In this many directions, with random numbers of its own.
    pub(super) fn new(directions: usize, seed: u64) -> Self {
        Self {
            centre: vec![0.5; directions],
            spread: vec![WIDE; directions],
            stream: Stream::new(seed, "search", 0),
            generations: 0,
        }
    }

    /// The next places to look at. The first generation is even.
    pub(super) fn generation(&mut self) -> Vec<Vec<f64>> {
        self.generations += 1;
        let even = if self.generations == 1 { GENERATION } else { EVEN };
        (0..GENERATION)
            .map(|k| if k < even { self.even_place() } else { self.place() })
            .collect()
    }

    /// As many places, all of them drawn evenly.
    pub(super) fn evenly(&mut self) -> Vec<Vec<f64>> {
        (0..GENERATION).map(|_| self.even_place()).collect()
    }

    fn even_place(&mut self) -> Vec<f64> {
        (0..self.centre.len()).map(|_| self.stream.unit()).collect()
    }

    /// Reflected at the sides, where a cut would pile places up.
    fn place(&mut self) -> Vec<f64> {
        let one = |k: usize, stream: &mut Stream| {
            let drawn: f64 = stream.normal(self.centre[k], self.spread[k]);
            let within = drawn.rem_euclid(2.0);
            if within > 1.0 { 2.0 - within } else { within }
        };
        let mut stream = self.stream.clone();
        let place = (0..self.centre.len()).map(|k| one(k, &mut stream)).collect();
        self.stream = stream;
        place
    }

    /// Moves to the places with the least margins; those without any (infinite) teach nothing.
    pub(super) fn learn(&mut self, places: &[Vec<f64>], margins: &[f64]) {
        let mut order: Vec<usize> = (0..places.len()).filter(|k| margins[*k].is_finite()).collect();
        order.sort_by(|a, b| margins[*a].total_cmp(&margins[*b]).then(a.cmp(b)));
        order.truncate(ELITE);
        if order.len() < 2 {
            return;
        }
        let count = order.len() as f64;
        let directions = self.centre.iter_mut().zip(&mut self.spread);
        for (k, (centre, spread)) in directions.enumerate() {
            let mean = order.iter().map(|place| places[*place][k]).sum::<f64>() / count;
            let square = |place: &usize| (places[*place][k] - mean) * (places[*place][k] - mean);
            let deviation = (order.iter().map(square).sum::<f64>() / count).sqrt();
            *centre = MEMORY * *centre + (1.0 - MEMORY) * mean;
            *spread = (MEMORY * *spread + (1.0 - MEMORY) * deviation).max(NARROW);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Looks until a place in a small corner of the cube is hit; the margin grows with the distance from it.
    fn looks_until_hit(by_learning: bool, seed: u64) -> usize {
        let corner = [0.93, 0.08, 0.5];
        let margin = |place: &Vec<f64>| {
            let far: f64 = place.iter().zip(corner).map(|(a, b)| (a - b) * (a - b)).sum();
            far.sqrt() - 0.07
        };
        let mut chooser = CrossEntropy::new(3, seed);
        for generation in 0..500 {
            let places = if by_learning {
                chooser.generation()
            } else {
                chooser.evenly()
            };
            let margins: Vec<f64> = places.iter().map(margin).collect();
            if let Some(hit) = margins.iter().position(|margin| *margin <= 0.0) {
                return generation * GENERATION + hit;
            }
            chooser.learn(&places, &margins);
        }
        500 * GENERATION
    }

    #[test]
    fn a_rare_corner_is_found_many_times_sooner() {
        let total = |by_learning| {
            (0..20)
                .map(|seed| looks_until_hit(by_learning, seed))
                .sum::<usize>()
        };
        let (learning, even) = (total(true), total(false));
        assert!(learning * 4 < even, "{learning} against {even}");
    }

    #[test]
    fn places_stay_in_the_cube_and_repeat() {
        let mut chooser = CrossEntropy::new(2, 1);
        let edge = vec![vec![0.0, 1.0]; GENERATION];
        chooser.learn(&edge, &[0.0; GENERATION]);
        let _ = chooser.generation();
        let places = chooser.generation();
        assert!(places.iter().flatten().all(|x| (0.0..=1.0).contains(x)));
        let mut same = CrossEntropy::new(2, 1);
        same.learn(&edge, &[0.0; GENERATION]);
        let _ = same.generation();
        assert_eq!(same.generation(), places);
        let nothing = vec![f64::INFINITY; GENERATION];
        let before = chooser.centre.clone();
        chooser.learn(&places, &nothing);
        assert_eq!(chooser.centre, before);
    }
}
