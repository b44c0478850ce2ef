//! Gauss–Legendre quadrature with eight nodes: exact for polynomials of degree 15.

/// Nodes on `[-1, 1]` (the negative halves follow by symmetry) and their weights.
const NODES: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// Integral of a plane-valued function over `[from, to]`.
pub(super) fn integrate(from: f64, to: f64, f: impl Fn(f64) -> [f64; 2]) -> [f64; 2] {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let mut sum = [0.0; 2];
    for (node, weight) in NODES {
        let (low, high) = (f(middle - half * node), f(middle + half * node));
        sum[0] += weight * (low[0] + high[0]);
        sum[1] += weight * (low[1] + high[1]);
    }
    [half * sum[0], half * sum[1]]
}

#[cfg(test)]
mod tests {
    use super::integrate;

    #[test]
    fn is_exact_to_degree_fifteen() {
        let fifteenth = |x: f64| (0..15).fold(1.0, |product, _| product * x);
        let [a, b] = integrate(0.0, 2.0, |x| [16.0 * fifteenth(x), 1.0]);
        assert!((a - 65536.0).abs() < 1e-9 && (b - 2.0).abs() < 1e-15);
    }
}
