//! The bundles of curves: longitudinal ones over time, lateral ones over path length (the original's
//! `Trajectory1dGenerator`).

use super::curve::Curve;
use super::end_conditions::{self, EndCondition};
use crate::geometry::Polynomial;
use crate::geometry::frenet::FrenetMotion;

/// What a longitudinal curve is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// To reach a speed.
    Cruise,
    /// To be behind or before an obstacle.
    PathTime,
    /// To stand at the stop point.
    Stop,
}

/// A longitudinal curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Longitudinal {
    /// What it is for.
    pub kind: Kind,
    /// Where it ends.
    pub end: EndCondition,
    /// Its polynomial.
    pub polynomial: Polynomial,
    /// The polynomial, going on at its end.
    pub curve: Curve,
}

impl Longitudinal {
    fn new(kind: Kind, start: [f64; 3], end: EndCondition) -> Option<Self> {
        let [_, v, a] = end.state;
        let polynomial = match kind {
            Kind::Cruise => Polynomial::quartic(start, [v, a], end.length)?,
            Kind::PathTime | Kind::Stop => Polynomial::quintic(start, end.state, end.length)?,
        };
        Some(Self {
            kind,
            end,
            polynomial,
            curve: polynomial.into(),
        })
    }
}

/// Longitudinal curves to these ends, in this order: cruise, path-time, stop.
pub fn longitudinal_bundle(
    start: [f64; 3],
    cruise: &[EndCondition],
    path_time: &[EndCondition],
    stop: &[EndCondition],
) -> Vec<Longitudinal> {
    let kinds = [
        (Kind::Cruise, cruise),
        (Kind::PathTime, path_time),
        (Kind::Stop, stop),
    ];
    let curves = kinds
        .into_iter()
        .flat_map(|(kind, ends)| ends.iter().map(move |end| (kind, *end)));
    curves
        .filter_map(|(kind, end)| Longitudinal::new(kind, start, end))
        .collect()
}

/// The sampled lateral curves from the offset that the car has now.
pub fn lateral_bundle(initial: &FrenetMotion) -> Vec<Polynomial> {
    let ends = end_conditions::lateral().into_iter();
    ends.filter_map(|end| Polynomial::quintic(initial.l, end.state, end.length))
        .collect()
}
