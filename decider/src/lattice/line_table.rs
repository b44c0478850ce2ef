//! A line by points: what belongs to a station, and the station that belongs to a point (the original's `PathMatcher`).

use crate::geometry::angle::turned;
use crate::geometry::frenet::Foot;
use crate::geometry::{Pose, Vec2, angle, cross};
use crate::reference_line::{LineQuery, SlPoint};

/// Distance between the points that a smooth line is sampled at, m: between them an arc is exact to a tenth of a
/// millimetre in the tightest bend that a car can drive.
const SPACING: f64 = 0.5;

/// Half the length over which the change of a smooth line's curvature is taken, m.
const BEND_STEP: f64 = 0.5;

/// A point that is nearer to the centre of its bend than this share of the radius is beside no single place.
const NEAR_CENTRE: f64 = 0.5;

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

/// What belongs to a station of a line, its direction as a unit vector too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LinePlace {
    pub(super) position: Vec2,
    pub(super) theta: f64,
    pub(super) forward: Vec2,
    pub(super) kappa: f64,
    pub(super) dkappa: f64,
}

impl LinePlace {
    fn foot(&self, s: f64) -> Foot {
        Foot {
            s,
            pose: Pose::new(self.position.x, self.position.y, self.theta),
            kappa: self.kappa,
            dkappa: self.dkappa,
        }
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
        let above = self.feet.partition_point(|foot| foot.s < s);
        let (first, last) = (&self.feet[0], &self.feet[self.feet.len() - 1]);
        self.at_place(above, s).foot(s.clamp(first.s, last.s))
    }

    /// The same for a station at or beyond the last one that was asked for, whose place is in `hint`.
    #[inline]
    pub(super) fn at_next(&self, s: f64, hint: &mut usize) -> LinePlace {
        while *hint < self.feet.len() && self.feet[*hint].s < s {
            *hint += 1;
        }
        self.at_place(*hint, s)
    }

    #[inline]
    fn at_place(&self, above: usize, s: f64) -> LinePlace {
        if above == 0 || above == self.feet.len() {
            return self.at_point(above.saturating_sub(1));
        }
        self.between(above - 1, above, s)
    }

    fn at_point(&self, k: usize) -> LinePlace {
        let foot = &self.feet[k];
        LinePlace {
            position: foot.pose.position(),
            theta: foot.pose.theta,
            forward: self.forward[k],
            kappa: foot.kappa,
            dkappa: foot.dkappa,
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
        let nearest = self.nearest_place(point);
        let (low, high) = (nearest.saturating_sub(1), (nearest + 1).min(self.feet.len() - 1));
        let (a, b) = (&self.feet[low], &self.feet[high]);
        let chord = b.pose.position() - a.pose.position();
        let along = (point - a.pose.position()).dot(&chord) / chord.norm();
        self.between(low, high, a.s + along).foot(a.s + along)
    }

    /// Place of the nearest of the line's points; the first of equals.
    pub(super) fn nearest_place(&self, point: Vec2) -> usize {
        let mut best = (f64::MAX, 0);
        for (k, foot) in self.feet.iter().enumerate() {
            let distance = (foot.pose.position() - point).norm_squared();
            if distance < best.0 {
                best = (distance, k);
            }
        }
        best.1
    }

    /// Frenet coordinates of a point.
    pub fn frenet(&self, point: Vec2) -> SlPoint {
        let foot = self.nearest(point);
        let l = foot.offset(Pose::new(point.x, point.y, 0.0));
        SlPoint { s: foot.s, l }
    }

    /// Roughly where a point lies beside the line: beside the chord to which one comes from that at `hint`, going on in
    /// one direction while the foot lies beyond. The bulge of half a metre of road is lost.
    pub(super) fn glance(&self, point: Vec2, hint: &mut usize) -> Option<SlPoint> {
        let last = self.feet.len() - 2;
        let share = |k: usize| {
            let from = self.feet[k].pose.position();
            let (along, to) = (self.feet[k + 1].pose.position() - from, point - from);
            let per_square = 1.0 / along.norm_squared();
            (along.dot(&to) * per_square, cross(along, to) * per_square.sqrt())
        };
        let mut k = (*hint).min(last);
        let (mut t, mut l) = share(k);
        let direction = if t > 1.0 { 1 } else { -1 };
        while (direction > 0 && t > 1.0) || (direction < 0 && t < 0.0) {
            k = k.checked_add_signed(direction).filter(|k| *k <= last)?;
            (t, l) = share(k);
        }
        *hint = k;
        let (a, b) = (&self.feet[k], &self.feet[k + 1]);
        let is_single = (a.kappa.abs().max(b.kappa.abs()) * l).abs() < NEAR_CENTRE;
        is_single.then(|| SlPoint {
            s: a.s + (b.s - a.s) * t.clamp(0.0, 1.0),
            l,
        })
    }

    #[inline]
    fn between(&self, low: usize, high: usize, s: f64) -> LinePlace {
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
        LinePlace {
            position: Vec2::new(x, y),
            theta,
            forward,
            kappa,
            dkappa: mix(a.dkappa, b.dkappa),
        }
    }
}
