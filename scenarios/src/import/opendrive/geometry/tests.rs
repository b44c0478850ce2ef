//! Geometry against closed forms, tables and finite differences.

use super::{CurvePoint, Parametric, Piece, Shape, ShapeError, Spiral};
use corridor_decider::geometry::{Pose, angle};

fn piece(length: f64, shape: Shape) -> Piece {
    Piece {
        s: 10.0,
        length,
        start: Pose::new(100.0, -50.0, 2.0),
        shape,
    }
}

fn spiral(start: f64, end: f64, length: f64) -> Shape {
    Shape::Spiral(Spiral::new(start, end, length).unwrap())
}

/// Pieces of every form.
fn samples() -> Vec<Piece> {
    let cubic = Parametric::new([0.0, 1.0, 0.01, -0.002], [0.0, 0.1, 0.03, 0.001], 20.0, 25.0).unwrap();
    let normalized = Parametric::new([0.0, 9.0, 1.0, 0.5], [0.0, 2.0, -3.0, 1.0], 1.0, 10.6).unwrap();
    vec![
        piece(20.0, Shape::Line),
        piece(20.0, Shape::Arc { curvature: -0.15 }),
        piece(20.0, Shape::Arc { curvature: 1e-9 }),
        piece(60.0, spiral(-0.0, 0.1, 60.0)),
        piece(60.0, spiral(0.08, -0.05, 60.0)),
        piece(25.0, Shape::Parametric(cubic)),
        piece(10.6, Shape::Parametric(normalized)),
        piece(
            15.0,
            Shape::Parametric(Parametric::function([0.5, 0.2, 0.05, -0.002], 15.0).unwrap()),
        ),
    ]
}

#[test]
fn heading_and_curvature_are_derivatives() {
    let h = 1e-4;
    for piece in samples() {
        for k in 1..20 {
            let s = piece.s + piece.length * f64::from(k) / 20.0;
            let (a, at, b) = (piece.at(s - h), piece.at(s), piece.at(s + h));
            let speed = libm::hypot(b.x - a.x, b.y - a.y) / (2.0 * h);
            assert!((speed - at.stretch).abs() < 1e-6, "{piece:?} walks at {speed}");
            let heading = libm::atan2(b.y - a.y, b.x - a.x);
            assert!(
                angle::difference(heading, at.theta).abs() < 1e-6,
                "{piece:?} at {s}"
            );
            let kappa = angle::difference(b.theta, a.theta) / (2.0 * h * at.stretch);
            assert!(
                (kappa - at.kappa).abs() < 1e-6,
                "{piece:?} at {s}: {kappa} {}",
                at.kappa
            );
            let dkappa = (b.kappa - a.kappa) / (2.0 * h);
            assert!(
                (dkappa - at.dkappa).abs() < 1e-6,
                "{piece:?} at {s}: {dkappa} {}",
                at.dkappa
            );
        }
    }
}

/// Fresnel integrals from Abramowitz and Stegun, table 7.7.
#[test]
fn the_unit_clothoid_gives_the_fresnel_integrals() {
    let curve = Spiral::new(0.0, 3.0 * std::f64::consts::PI, 3.0).unwrap();
    let table = [
        (0.5, 0.492_344_225_871_446, 0.064_732_432_859_999_3),
        (1.0, 0.779_893_400_376_823, 0.438_259_147_390_355),
        (2.0, 0.488_253_406_075_341, 0.343_415_678_363_698),
    ];
    for (s, c, f) in table {
        let CurvePoint { x, y, .. } = curve.at(s);
        assert!((x - c).abs() < 1e-13 && (y - f).abs() < 1e-13, "{s}: {x} {y}");
    }
}

/// The classic Runge–Kutta rule on `x' = cos theta, y' = sin theta, theta' = kappa`.
#[test]
fn a_spiral_agrees_with_an_independent_integration() {
    let (k0, k1, length) = (0.12, -0.2, 80.0);
    let piece = Piece {
        s: 0.0,
        length,
        start: Pose::new(3.0, 4.0, -1.0),
        shape: spiral(k0, k1, length),
    };
    let rate = |s: f64| {
        let theta = -1.0 + k0 * s + (k1 - k0) * s * s / (2.0 * length);
        (libm::cos(theta), libm::sin(theta))
    };
    let (mut x, mut y) = (3.0, 4.0);
    let steps = 40_000;
    let h = length / f64::from(steps);
    for k in 0..steps {
        let s = f64::from(k) * h;
        let (a, m, b) = (rate(s), rate(s + 0.5 * h), rate(s + h));
        x += h / 6.0 * (a.0 + 4.0 * m.0 + b.0);
        y += h / 6.0 * (a.1 + 4.0 * m.1 + b.1);
    }
    let end = piece.at(length);
    assert!(
        (end.x - x).abs() < 1e-10 && (end.y - y).abs() < 1e-10,
        "{} {}",
        end.x - x,
        end.y - y
    );
    assert!((end.theta - (-1.0 + 0.5 * (k0 + k1) * length)).abs() < 1e-12);
}

#[test]
fn a_quarter_circle_ends_where_it_should() {
    let quarter = Piece {
        s: 0.0,
        length: 10.0 * std::f64::consts::FRAC_PI_2,
        start: Pose::new(0.0, 0.0, 0.0),
        shape: Shape::Arc { curvature: -0.1 },
    };
    let end = quarter.at(1e9);
    assert!((end.x - 10.0).abs() < 1e-12 && (end.y + 10.0).abs() < 1e-12);
    assert!((end.theta + std::f64::consts::FRAC_PI_2).abs() < 1e-15);
}

/// The parabola `v = u²/2` has arc length `(u √(1 + u²) + asinh u) / 2`.
#[test]
fn cubics_are_walked_by_arc_length() {
    let arc = |u: f64| 0.5 * (u * (1.0 + u * u).sqrt() + libm::asinh(u));
    let length = arc(4.0);
    let by_parameter = Parametric::new([0.0, 4.0, 0.0, 0.0], [0.0, 0.0, 8.0, 0.0], 1.0, length).unwrap();
    let by_function = Parametric::function([0.0, 0.0, 0.5, 0.0], length).unwrap();
    for curve in [by_parameter, by_function] {
        for u in [0.0, 0.3, 1.0, 2.5, 3.9, 4.0] {
            let at = curve.at(arc(u));
            assert!(
                (at.x - u).abs() < 1e-9 && (at.y - 0.5 * u * u).abs() < 1e-9,
                "{u}: {at:?}"
            );
            let kappa = 1.0 / ((1.0 + u * u) * (1.0 + u * u).sqrt());
            assert!((at.kappa - kappa).abs() < 1e-9, "{u}: {at:?}");
        }
    }
}

#[test]
fn a_cubic_that_starts_from_rest_has_a_tangent() {
    // u = p², v = p²: bU = bV = 0, a straight line at 45°.
    let curve = Parametric::new([0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 1.0, 0.0], 1.0, 2f64.sqrt()).unwrap();
    for s in [0.0, 1e-12, 0.1, 1.4] {
        assert!((curve.at(s).theta - std::f64::consts::FRAC_PI_4).abs() < 1e-9);
    }
}

#[test]
fn impossible_curves_are_refused() {
    let turn = Spiral::new(0.0, 100.0, 1000.0).unwrap_err();
    assert!(matches!(turn, ShapeError::Turn { .. }));
    for u in [
        [0.0; 4],
        [0.0, 1e300, 1e300, 1e300],
        [0.0, 5.0, 0.0, 0.0],
        [0.0, 0.0, f64::MAX, f64::MIN],
    ] {
        let refused = Parametric::new(u, [0.0; 4], 1.0, 1.0);
        assert!(matches!(refused, Err(ShapeError::Length { .. })), "{u:?}");
    }
    assert!(Parametric::function([0.0, f64::MAX, f64::MAX, 0.0], 1.0).is_err());
}
