//! Transverse Mercator projection of latitude and longitude, in metres east and north of an origin.
//!
//! Source: L. Krüger, "Konforme Abbildung des Erdellipsoids in der Ebene" (1912), series in the third flattening to
//! fourth order, as in C. Karney, "Transverse Mercator with an accuracy of a few nanometers" (2011). With the
//! origin's own meridian and scale 1 lengths are true within 2 in a million up to 11 km from it.

/// Half axes of an ellipsoid by its larger one, m, and its flattening.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ellipsoid {
    semi_major: f64,
    flattening: f64,
}

/// What satellite positions refer to.
const WGS84: Ellipsoid = Ellipsoid {
    semi_major: 6_378_137.0,
    flattening: 1.0 / 298.257_223_563,
};

/// A projection around an origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct TransverseMercator {
    /// Rectifying radius, m.
    radius: f64,
    /// Coefficients of the series.
    alpha: [f64; 4],
    /// `2 sqrt(n) / (1 + n)`, which is the eccentricity.
    eccentricity: f64,
    /// Longitude of the origin, rad.
    meridian: f64,
    /// Northing of the origin, m from the equator.
    north: f64,
}

impl TransverseMercator {
    /// The projection of WGS84 positions around a latitude and longitude in degrees.
    pub(super) fn around(latitude: f64, longitude: f64) -> Self {
        Self::new(WGS84, latitude, longitude)
    }

    fn new(ellipsoid: Ellipsoid, latitude: f64, longitude: f64) -> Self {
        let n = ellipsoid.flattening / (2.0 - ellipsoid.flattening);
        let (n2, n3, n4) = (n * n, n * n * n, n * n * n * n);
        let mut projection = Self {
            radius: ellipsoid.semi_major / (1.0 + n) * (1.0 + n2 / 4.0 + n4 / 64.0),
            alpha: [
                n / 2.0 - 2.0 / 3.0 * n2 + 5.0 / 16.0 * n3 + 41.0 / 180.0 * n4,
                13.0 / 48.0 * n2 - 3.0 / 5.0 * n3 + 557.0 / 1440.0 * n4,
                61.0 / 240.0 * n3 - 103.0 / 140.0 * n4,
                49561.0 / 161_280.0 * n4,
            ],
            eccentricity: 2.0 * n.sqrt() / (1.0 + n),
            meridian: longitude.to_radians(),
            north: 0.0,
        };
        projection.north = projection.project(latitude, longitude).1;
        projection
    }

    /// Metres (east, north) of the origin of a latitude and longitude in degrees; not finite a quarter of the
    /// globe away.
    pub(super) fn project(&self, latitude: f64, longitude: f64) -> (f64, f64) {
        let (sin_latitude, away) = (
            libm::sin(latitude.to_radians()),
            longitude.to_radians() - self.meridian,
        );
        let e = self.eccentricity;
        // Tangent of the conformal latitude.
        let t = libm::sinh(libm::atanh(sin_latitude) - e * libm::atanh(e * sin_latitude));
        let xi = libm::atan2(t, libm::cos(away));
        let eta = libm::atanh(libm::sin(away) / (1.0 + t * t).sqrt());
        let (mut east, mut north) = (eta, xi);
        for (alpha, twice) in self.alpha.iter().zip([2.0, 4.0, 6.0, 8.0]) {
            east += alpha * libm::cos(twice * xi) * libm::sinh(twice * eta);
            north += alpha * libm::sin(twice * xi) * libm::cosh(twice * eta);
        }
        (self.radius * east, self.radius * north - self.north)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The worked example of J. P. Snyder, "Map Projections: A Working Manual" (1987), page 269.
    #[test]
    fn agrees_with_the_worked_example() {
        let eccentricity_squared: f64 = 0.006_768_66;
        let clarke = Ellipsoid {
            semi_major: 6_378_206.4,
            flattening: 1.0 - (1.0 - eccentricity_squared).sqrt(),
        };
        let (east, north) = TransverseMercator::new(clarke, 0.0, -75.0).project(40.5, -73.5);
        assert!((east * 0.9996 - 127_106.5).abs() < 0.06, "{east}");
        assert!((north * 0.9996 - 4_484_124.4).abs() < 0.06, "{north}");
    }

    #[test]
    fn the_quarter_meridian_has_its_known_length() {
        let (east, north) = TransverseMercator::around(0.0, 8.4).project(90.0, 8.4);
        assert!((north - 10_001_965.729).abs() < 1e-3 && east.abs() < 1e-6);
    }

    /// Short ways against the radii of curvature of the ellipsoid.
    #[test]
    fn short_ways_are_true_in_length_and_direction() {
        let e2 = WGS84.flattening * (2.0 - WGS84.flattening);
        for latitude in [-60.0, -10.0, 0.0, 35.0, 49.0_f64] {
            let sin = libm::sin(latitude.to_radians());
            let w = 1.0 - e2 * sin * sin;
            let meridian = WGS84.semi_major * (1.0 - e2) / (w * w.sqrt());
            let parallel = WGS84.semi_major / w.sqrt() * libm::cos(latitude.to_radians());
            let step = 1e-3_f64;
            let (east, north) =
                TransverseMercator::around(latitude, 8.4).project(latitude + step, 8.4 + step);
            let expected = (parallel * step.to_radians(), meridian * step.to_radians());
            // The meridians close in over the step.
            assert!((east / expected.0 - 1.0).abs() < 4e-5 && (north / expected.1 - 1.0).abs() < 4e-5);
        }
    }
}
