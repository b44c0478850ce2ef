//! A line by points: what belongs to a station, and the station that belongs to a point (the original's `PathMatcher`).

use crate::geometry::angle::turned;
use crate::geometry::frenet::Foot;
use crate::geometry::{Pose, Vec2, angle};
use crate::reference_line::{LineQuery, SlPoint};

/// Distance between the points that a smooth line is sampled at, m: between them an arc is exact to a tenth of a
/// millimetre in the tightest bend that a car can drive.
const SPACING: f64 = 0.5;

/// Half the length over which the change of a smooth line's curvature is taken, m.
const BEND_STEP: f64 = 0.5;

/// What belongs to a station of a smooth line, exactly.
pub fn foot_on<L: LineQuery + ?Sized>(line: &L, s: f64) -> Foot {
    let at = line.point(s);
    let change = line.point(s + BEND_STEP).kappa - line.point(s - BEND_STEP).kappa;
    Foot {
        s,
        pose: Pose::new(at.x, at.y, at.theta),
        kappa: at.kappa,
        dkappa: change / (2.0 * BEND_STEP),
    }
}

/// A line by points. At least two, by ascending station.
#[derive(Clone, Debug, PartialEq)]
pub struct LineTable {
    feet: Vec<Foot>,
    /// The direction of the line at each, as a unit vector.
    forward: Vec<Vec2>,
    /// Whether the pieces between points are arcs, as those of a smooth line are, or straight.
    has_arcs: bool,
}

impl LineTable {
    /// Straight pieces between points, as the original has them; `None` for fewer than two, or out of order.
    pub fn polyline(feet: Vec<Foot>) -> Option<Self> {
        let ordered = feet.windows(2).all(|pair| pair[1].s > pair[0].s);
        (feet.len() >= 2 && ordered).then(|| Self {
            forward: feet.iter().map(|foot| foot.pose.forward()).collect(),
            feet,
            has_arcs: false,
        })
    }

    /// A smooth line from one station to another, as far as it leads; `None` where that is no length.
    pub fn sampled<L: LineQuery + ?Sized>(line: &L, from: f64, to: f64) -> Option<Self> {
        let (from, to) = (from.max(line.start()), to.min(line.length()));
        let mut feet = Vec::with_capacity(512);
        let mut push = |s: f64| {
            let at = line.point(s);
            feet.push(Foot {
                s,
                pose: Pose::new(at.x, at.y, at.theta),
                kappa: at.kappa,
                dkappa: 0.0,
            });
        };
        let mut s = from;
        while s < to {
            push(s);
            s += SPACING;
        }
        push(to);
        for k in 1..feet.len().saturating_sub(1) {
            feet[k].dkappa = (feet[k + 1].kappa - feet[k - 1].kappa) / (feet[k + 1].s - feet[k - 1].s);
        }
        Self::polyline(feet).map(|table| Self {
            has_arcs: true,
            ..table
        })
    }

    /// Last station, m.
    pub fn end(&self) -> f64 {
        self.feet[self.feet.len() - 1].s
    }

    /// What belongs to a station; the ends' beyond them.
    pub fn at(&self, s: f64) -> Foot {
        self.at_place(self.feet.partition_point(|foot| foot.s < s), s).0
    }

    /// The same, with the line's direction as a unit vector, for a station at or beyond the last one that was asked for,
    /// whose place is in `hint`.
    pub fn at_next(&self, s: f64, hint: &mut usize) -> (Foot, Vec2) {
        while *hint < self.feet.len() && self.feet[*hint].s < s {
            *hint += 1;
        }
        self.at_place(*hint, s)
    }

    fn at_place(&self, above: usize, s: f64) -> (Foot, Vec2) {
        match (above, self.feet.get(above)) {
            (_, None) => (self.feet[above - 1], self.forward[above - 1]),
            (0, Some(first)) => (*first, self.forward[0]),
            (_, Some(_)) => self.between(above - 1, above, s),
        }
    }

    /// Curvature at a station; the ends' beyond them.
    pub fn kappa(&self, s: f64, hint: &mut usize) -> f64 {
        while *hint < self.feet.len() && self.feet[*hint].s < s {
            *hint += 1;
        }
        while *hint > 0 && self.feet[*hint - 1].s >= s {
            *hint -= 1;
        }
        match (*hint, self.feet.get(*hint)) {
            (_, None) => self.feet[*hint - 1].kappa,
            (0, Some(first)) => first.kappa,
            (_, Some(b)) => {
                let a = &self.feet[*hint - 1];
                a.kappa + (b.kappa - a.kappa) * ((s - a.s) / (b.s - a.s))
            }
        }
    }

    /// What belongs to a point: on the chord between the neighbours of the nearest of the line's points, which is
    /// extended at the ends.
    pub fn nearest(&self, point: Vec2) -> Foot {
        let mut best = (f64::MAX, 0);
        for (k, foot) in self.feet.iter().enumerate() {
            let distance = (foot.pose.position() - point).norm_squared();
            if distance < best.0 {
                best = (distance, k);
            }
        }
        let (low, high) = (best.1.saturating_sub(1), (best.1 + 1).min(self.feet.len() - 1));
        let (a, b) = (&self.feet[low], &self.feet[high]);
        let chord = b.pose.position() - a.pose.position();
        let along = (point - a.pose.position()).dot(&chord) / chord.norm();
        self.between(low, high, a.s + along).0
    }

    /// Frenet coordinates of a point.
    pub fn frenet(&self, point: Vec2) -> SlPoint {
        let foot = self.nearest(point);
        let l = foot.offset(Pose::new(point.x, point.y, 0.0));
        SlPoint { s: foot.s, l }
    }

    fn between(&self, low: usize, high: usize, s: f64) -> (Foot, Vec2) {
        let (a, b) = (&self.feet[low], &self.feet[high]);
        let length = b.s - a.s;
        let share = (s - a.s) / length;
        let mix = |a: f64, b: f64| a + (b - a) * share;
        let turn = angle::difference(b.pose.theta, a.pose.theta);
        let theta = angle::wrap(a.pose.theta + turn * share);
        let kappa = mix(a.kappa, b.kappa);
        let (mut x, mut y) = (mix(a.pose.x, b.pose.x), mix(a.pose.y, b.pose.y));
        let forward = turned(self.forward[low], turn * share);
        if self.has_arcs {
            let bulge = 0.5 * turn * length * share * (share - 1.0);
            (x, y) = (x - bulge * forward.y, y + bulge * forward.x);
        }
        let foot = Foot {
            s,
            pose: Pose::new(x, y, theta),
            kappa,
            dkappa: mix(a.dkappa, b.dkappa),
        };
        (foot, forward)
    }
}
