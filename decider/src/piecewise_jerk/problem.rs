//! The problem itself: knots, limits, a separable convex cost, and whether they make sense.
//!
//! With spacing `D`, third derivative `j` on an interval and state `(x, x', x'')` at its start, the state at its end is
//! `x + D x' + D²/2 x'' + D³/6 j`, `x' + D x'' + D²/2 j`, `x'' + D j`.

use super::Solution;

/// Lowest and highest value; infinite where there is none.
pub type Limits = (f64, f64);

/// The curve at a knot.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    /// Value.
    pub x: f64,
    /// First derivative.
    pub dx: f64,
    /// Second derivative.
    pub ddx: f64,
}

/// The cost `weight · (value − reference)²`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Term {
    /// At least zero.
    pub weight: f64,
    /// Where it costs nothing.
    pub reference: f64,
}

impl Term {
    /// A cost of distance from `reference`.
    pub const fn new(weight: f64, reference: f64) -> Self {
        Self { weight, reference }
    }

    /// Two terms on the same value as one, and the constant by which they differ from it.
    #[must_use]
    pub fn joined(self, other: Self) -> (Self, f64) {
        let weight = self.weight + other.weight;
        if weight <= 0.0 {
            return (Self::default(), 0.0);
        }
        let share = other.weight / weight;
        let apart = other.reference - self.reference;
        let term = Self::new(weight, self.reference + share * apart);
        (term, self.weight * share * apart * apart)
    }

    pub(super) fn at(self, value: f64) -> f64 {
        let off = value - self.reference;
        self.weight * off * off
    }
}

/// How the squared third derivative enters the cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum JerkCoupling {
    /// As `((x''ᵢ₊₁ − x''ᵢ)/D)²`: neighbours are coupled.
    #[default]
    Symmetric,
    /// Without the product of neighbours, `(x''ᵢ₊₁² + x''ᵢ²)/D²`: what the original effectively minimises, because the
    /// triangle it hands its solver the products in is not the one that is read.
    Diagonal,
}

/// What is minimised: the sum of all terms.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cost {
    /// Per knot, on the value.
    pub x: Vec<Term>,
    /// Per knot, on the first derivative.
    pub dx: Vec<Term>,
    /// Per knot, on the second derivative.
    pub ddx: Vec<Term>,
    /// Weight of the squared third derivative, per interval.
    pub dddx: f64,
    /// How the third derivative enters.
    pub coupling: JerkCoupling,
    /// On value, first and second derivative at the last knot, on top of the others.
    pub end: [Term; 3],
    /// What does not depend on the curve.
    pub constant: f64,
}

/// A piecewise-jerk problem.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Distance of the knots: positive.
    pub delta: f64,
    /// The curve at knot 0. It must lie within the limits there: see [`Problem::admit_initial_state`].
    pub initial: State,
    /// Limits of the value, per knot.
    pub x: Vec<Limits>,
    /// Limits of the first derivative, per knot.
    pub dx: Vec<Limits>,
    /// Limits of the second derivative, per knot.
    pub ddx: Vec<Limits>,
    /// Limits of the third derivative, per interval: one less than knots.
    pub dddx: Vec<Limits>,
    /// What is minimised.
    pub cost: Cost,
}

/// Why a problem makes no sense.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProblemError {
    /// Too few knots.
    #[error("a curve has at least 2 knots, not {0}")]
    TooFewKnots(usize),
    /// Spacing that is not a positive number.
    #[error("the spacing of the knots must be positive, not {0}")]
    Spacing(f64),
    /// A list of another length than the others ask for.
    #[error("`{list}` has {length} entries, not {wanted}")]
    Length {
        /// Which list.
        list: &'static str,
        /// Its length.
        length: usize,
        /// The right one.
        wanted: usize,
    },
    /// Limits that are not numbers, or the wrong way round.
    #[error("`{list}` at {index}: limits {low} to {high} are not a range")]
    Limits {
        /// Which list.
        list: &'static str,
        /// Where in it.
        index: usize,
        /// Lowest value.
        low: f64,
        /// Highest value.
        high: f64,
    },
    /// A weight that is negative or not finite, or a reference that is not finite.
    #[error("`{list}` at {index}: a weight must be finite and at least 0, a reference finite")]
    Cost {
        /// Which list.
        list: &'static str,
        /// Where in it.
        index: usize,
    },
    /// An initial state that is not finite.
    #[error("the initial state is not finite")]
    Initial,
}

impl Problem {
    /// Number of knots.
    pub fn knots(&self) -> usize {
        self.x.len()
    }

    /// Widens the limits at knot 0 so that they hold the initial state, which nothing can change any more.
    pub fn admit_initial_state(&mut self) {
        let State { x, dx, ddx } = self.initial;
        for (limits, value) in [(&mut self.x, x), (&mut self.dx, dx), (&mut self.ddx, ddx)] {
            if let Some((low, high)) = limits.first_mut() {
                *low = low.min(value);
                *high = high.max(value);
            }
        }
    }

    /// The same problem in a mirror: `x` is `−x`.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let swap = |list: &[Limits]| list.iter().map(|(low, high)| (-high, -low)).collect();
        let turn = |term: &Term| Term::new(term.weight, -term.reference);
        let turn_all = |terms: &[Term]| terms.iter().map(turn).collect();
        let State { x, dx, ddx } = self.initial;
        Self {
            delta: self.delta,
            initial: State {
                x: -x,
                dx: -dx,
                ddx: -ddx,
            },
            x: swap(&self.x),
            dx: swap(&self.dx),
            ddx: swap(&self.ddx),
            dddx: swap(&self.dddx),
            cost: Cost {
                x: turn_all(&self.cost.x),
                dx: turn_all(&self.cost.dx),
                ddx: turn_all(&self.cost.ddx),
                end: self.cost.end.map(|term| turn(&term)),
                ..self.cost
            },
        }
    }

    /// Whether the problem makes sense.
    ///
    /// # Errors
    /// [`ProblemError`]: what does not.
    pub fn validate(&self) -> Result<(), ProblemError> {
        let n = self.knots();
        if n < 2 {
            return Err(ProblemError::TooFewKnots(n));
        }
        if !(self.delta > 0.0 && self.delta.is_finite()) {
            return Err(ProblemError::Spacing(self.delta));
        }
        let State { x, dx, ddx } = self.initial;
        if !(x.is_finite() && dx.is_finite() && ddx.is_finite()) {
            return Err(ProblemError::Initial);
        }
        check_limits("x", &self.x, n)?;
        check_limits("dx", &self.dx, n)?;
        check_limits("ddx", &self.ddx, n)?;
        check_limits("dddx", &self.dddx, n - 1)?;
        check_terms("cost.x", &self.cost.x, n)?;
        check_terms("cost.dx", &self.cost.dx, n)?;
        check_terms("cost.ddx", &self.cost.ddx, n)?;
        check_terms("cost.dddx", &[Term::new(self.cost.dddx, 0.0)], 1)?;
        check_terms("cost.end", &self.cost.end, 3)
    }

    /// The cost of a curve, constants included.
    pub(super) fn cost_of(&self, [x, dx, ddx]: [&[f64]; 3], dddx: &[f64]) -> f64 {
        let sum = |terms: &[Term], values: &[f64]| -> f64 {
            let each = terms.iter().zip(values).map(|(term, value)| term.at(*value));
            each.sum()
        };
        let jerk: f64 = match self.cost.coupling {
            JerkCoupling::Symmetric => dddx.iter().map(|j| j * j).sum(),
            JerkCoupling::Diagonal => {
                let squares = ddx.windows(2).map(|pair| pair[0] * pair[0] + pair[1] * pair[1]);
                squares.sum::<f64>() / (self.delta * self.delta)
            }
        };
        let last = self.knots() - 1;
        let end = [x[last], dx[last], ddx[last]];
        sum(&self.cost.x, x)
            + sum(&self.cost.dx, dx)
            + sum(&self.cost.ddx, ddx)
            + self.cost.dddx * jerk
            + sum(&self.cost.end, &end)
            + self.cost.constant
    }

    /// The cost of a solution of this problem or of another with as many knots.
    pub fn cost_of_solution(&self, solution: &Solution) -> f64 {
        self.cost_of([&solution.x, &solution.dx, &solution.ddx], &solution.dddx)
    }

    /// How far the worst value lies outside its limits, each in its own unit.
    pub fn violation(&self, solution: &Solution) -> f64 {
        let pairs = [
            (&self.x, &solution.x),
            (&self.dx, &solution.dx),
            (&self.ddx, &solution.ddx),
            (&self.dddx, &solution.dddx),
        ];
        let each = pairs
            .into_iter()
            .flat_map(|(limits, values)| limits.iter().zip(values));
        each.map(|((low, high), value)| (low - value).max(value - high))
            .fold(0.0, f64::max)
    }
}

fn check_length(list: &'static str, length: usize, wanted: usize) -> Result<(), ProblemError> {
    if length == wanted {
        Ok(())
    } else {
        Err(ProblemError::Length { list, length, wanted })
    }
}

fn check_limits(list: &'static str, limits: &[Limits], wanted: usize) -> Result<(), ProblemError> {
    check_length(list, limits.len(), wanted)?;
    let is_wrong = |(low, high): &Limits| {
        low.is_nan() || high.is_nan() || low > high || *low == f64::INFINITY || *high == f64::NEG_INFINITY
    };
    match limits.iter().position(is_wrong) {
        None => Ok(()),
        Some(index) => {
            let (low, high) = limits[index];
            Err(ProblemError::Limits {
                list,
                index,
                low,
                high,
            })
        }
    }
}

fn check_terms(list: &'static str, terms: &[Term], wanted: usize) -> Result<(), ProblemError> {
    check_length(list, terms.len(), wanted)?;
    let is_wrong =
        |term: &Term| !(term.weight >= 0.0 && term.weight.is_finite() && term.reference.is_finite());
    match terms.iter().position(is_wrong) {
        None => Ok(()),
        Some(index) => Err(ProblemError::Cost { list, index }),
    }
}
