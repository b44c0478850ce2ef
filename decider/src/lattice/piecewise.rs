//! Polynomials one after the other.

use crate::geometry::Polynomial;

/// Shortest piece of constant third derivative (the original's).
const SHORTEST: f64 = 1e-6;

/// Polynomials one after the other. Nothing makes them meet: where one ends and the next begins, the first one counts.
/// Before the start and beyond the end the first and the last one go on.
#[derive(Clone, Debug, PartialEq)]
pub struct Piecewise {
    /// Each with the parameter at which it ends; never empty.
    pieces: Vec<(f64, Polynomial)>,
}

impl Piecewise {
    /// These polynomials in order, each over its length; `None` without one.
    pub fn new(polynomials: &[Polynomial]) -> Option<Self> {
        let mut end = 0.0;
        let piece = |polynomial: &Polynomial| {
            end += polynomial.length();
            (end, *polynomial)
        };
        let pieces: Vec<_> = polynomials.iter().map(piece).collect();
        (!pieces.is_empty()).then_some(Self { pieces })
    }

    /// From value, first and second derivative `start` on with constant third derivatives, each over a length; `None`
    /// without one or with one that is too short.
    pub fn of_jerks(start: [f64; 3], jerks: &[(f64, f64)]) -> Option<Self> {
        let mut from = start;
        let mut pieces = Vec::with_capacity(jerks.len());
        for (jerk, length) in jerks {
            let piece = Polynomial::constant_jerk(from, *jerk, *length).filter(|_| *length > SHORTEST)?;
            let [x, v, a, _] = piece.at(*length);
            from = [x, v, a];
            pieces.push(piece);
        }
        Self::new(&pieces)
    }

    /// Length of all pieces.
    pub fn length(&self) -> f64 {
        self.pieces[self.pieces.len() - 1].0
    }

    /// The parameters at which the pieces end.
    pub fn ends(&self) -> impl Iterator<Item = f64> + '_ {
        self.pieces.iter().map(|(end, _)| *end)
    }

    /// Value and first three derivatives at `p`.
    pub fn at(&self, p: f64) -> [f64; 4] {
        let (piece, p) = self.piece_at(p);
        piece.at(p)
    }

    /// The derivative of any order at `p`.
    pub fn derivative(&self, order: usize, p: f64) -> f64 {
        let (piece, p) = self.piece_at(p);
        piece.derivative(order, p)
    }

    /// The same for parameters that mostly grow; `hint` is the place of the last one's piece.
    pub(super) fn at_next(&self, p: f64, hint: &mut usize) -> [f64; 4] {
        while *hint > 0 && self.pieces[*hint - 1].0 >= p {
            *hint -= 1;
        }
        while *hint + 1 < self.pieces.len() && self.pieces[*hint].0 < p {
            *hint += 1;
        }
        let (piece, p) = self.piece(*hint, p);
        piece.at(p)
    }

    fn piece_at(&self, p: f64) -> (&Polynomial, f64) {
        let place = self
            .pieces
            .partition_point(|(end, _)| *end < p)
            .min(self.pieces.len() - 1);
        self.piece(place, p)
    }

    /// A piece, and where in it a parameter lies.
    fn piece(&self, place: usize, p: f64) -> (&Polynomial, f64) {
        let start = place.checked_sub(1).map_or(0.0, |before| self.pieces[before].0);
        (&self.pieces[place].1, p - start)
    }
}
