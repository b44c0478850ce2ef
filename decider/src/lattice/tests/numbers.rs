//! Worked numbers of the specification, section 22.

use crate::geometry::Polynomial;
use crate::lattice::*;

fn near(got: f64, wanted: f64) {
    assert!((got - wanted).abs() < 1e-6, "{got} is not {wanted}");
}

fn quartic(start: [f64; 3], end: [f64; 2], length: f64) -> Curve {
    Polynomial::quartic(start, end, length).unwrap().into()
}

fn straight() -> LineTable {
    let foot = |s: f64| crate::geometry::frenet::Foot {
        s,
        pose: crate::geometry::Pose::new(s, 0.0, 0.0),
        kappa: 0.0,
        dkappa: 0.0,
    };
    LineTable::polyline(vec![foot(0.0), foot(400.0)]).unwrap()
}

fn costs(curve: &Curve, guide: f64, blocked: &Blocked) -> LongitudinalCosts {
    LongitudinalCosts::new(&Sampled::new(curve), &[guide; SAMPLES], blocked, &straight())
}

#[test]
fn a_curve_goes_on_at_its_end() {
    let curve = quartic([50.0, 10.0, 0.5], [15.0, 0.0], 4.0);
    near(curve.at(4.0)[0], 100.666_666_7);
    let [s, v, a, _] = curve.at(6.0);
    near(s, 130.666_666_7);
    near(v, 15.0);
    near(a, 0.0);
}

#[test]
fn the_longitudinal_costs_are_those_of_the_specification() {
    let rising = quartic([0.0, 10.0, 0.0], [15.0, 0.0], 4.0);
    let of_it = costs(&rising, 15.0, &Blocked::default());
    near(of_it.objective, 0.028_978_9);
    // On the grid of whole multiples, at which the specification's number was found, the jerk at 4 s is 0.
    assert!((of_it.jerk - 0.625_781_2).abs() < 2e-2, "{}", of_it.jerk);
    near(rising.at(8.0)[0], 110.0);
    let constant = quartic([0.0, 10.0, 0.0], [10.0, 0.0], 8.0);
    near(costs(&constant, 15.0, &Blocked::default()).objective, 0.465_768_8);
    let blocked = Blocked::new([[Some((60.0, 65.0)); SAMPLES].into_iter()].into_iter());
    near(costs(&constant, 15.0, &blocked).collision, 0.980_873_2);
}

#[test]
fn the_lateral_costs_are_those_of_the_specification() {
    let lateral = Polynomial::quintic([0.5, 0.0, 0.0], [-0.5, 0.0, 0.0], 20.0).unwrap();
    let profile = LateralProfile::new(lateral.into());
    near(profile.offset_cost(100.0), 0.164_165_1);
    let constant = Sampled::new(&quartic([0.0, 10.0, 0.0], [10.0, 0.0], 8.0));
    assert!((lateral_comfort(&constant, &profile.curve) - 1.44).abs() < 1e-3);
}

#[test]
fn the_guides_are_those_of_the_specification() {
    type Case = ([f64; 4], &'static [(f64, f64)]);
    let cases: [Case; 5] = [
        (
            [100.0, 50.0, 15.0, 10.0],
            &[(2.0, 1.7082), (-3.0, 4.47214), (0.0, 1.81966)],
        ),
        (
            [120.0, 50.0, 11.18, 10.0],
            &[(2.0, 0.59), (0.0, 3.83898), (-3.0, 3.72667)],
        ),
        ([60.0, 50.0, 15.0, 10.0], &[(-5.0, 2.0), (0.0, 6.0)]),
        (
            [300.0, 50.0, 15.0, 20.0],
            &[(-3.0, 1.66667), (0.0, 12.22222), (-3.0, 5.0)],
        ),
        (
            [70.0, 50.0, 5.0, 10.0],
            &[(-3.0, 1.66667), (0.0, 0.66667), (-3.0, 1.66667), (0.0, 4.0)],
        ),
    ];
    let with = Braking {
        acceleration: 2.0,
        braking: 3.0,
        duration: 8.0,
    };
    for ([stop_s, s, cruise, v], wanted) in cases {
        let profile = braking_profile((s, stop_s), (v, cruise), with).unwrap();
        let got: Vec<(f64, f64)> = profile.segments().collect();
        assert_eq!(got.len(), wanted.len(), "{got:?}");
        for (got, wanted) in got.iter().zip(wanted) {
            assert!(
                (got.0 - wanted.0).abs() < 1e-4 && (got.1 - wanted.1).abs() < 1e-4,
                "{got:?} {wanted:?}"
            );
        }
    }
}
