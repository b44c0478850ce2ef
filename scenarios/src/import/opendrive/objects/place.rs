//! From records to outlines in the world: copies, parts of long things, corners.

use super::MapObject;
use super::read::{Corners, ObjectRecord, Outline, Repeat, Size};
use crate::import::ImportError;
use crate::import::notes::Notes;
use crate::import::opendrive::budget::Budget;
use crate::import::opendrive::cross_section::piece;
use crate::import::opendrive::record::Road;
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2, angle};

/// Side of a thing whose size nobody told and thickness of a line, m: a post.
const LEAST_SIZE: f64 = 0.1;

/// Corners of the polygon around a circle: its area is 2.4 % too large.
const CIRCLE_CORNERS: usize = 12;

/// Longest straight part of a thing without gaps, m.
const LONGEST_PART: f64 = 5.0;

/// How far a straight part may leave the bend that it follows, m.
const SAGITTA: f64 = 0.05;

/// Shortest part, m.
const SHORTEST_PART: f64 = 0.5;

/// An outline that fills less of its convex hull is told.
const CONVEX: f64 = 0.98;

/// What division leaves of a whole number of copies, and a length that is none, m.
const ROUNDING: f64 = 1e-6;

/// Coordinates beyond this are not on any map, m.
const FARTHEST: f64 = 1e8;

/// One copy of an object.
struct Copy {
    s: f64,
    t: f64,
    size: Size,
}

/// Adds an object to `objects`: its copies, and what it consists of.
pub(super) fn place(
    record: &ObjectRecord,
    road: &Road,
    objects: &mut Vec<MapObject>,
    budget: &mut Budget<'_>,
    notes: &mut Notes<'_>,
) -> Result<(), ImportError> {
    let before = objects.len();
    let mut placer = Placer {
        record,
        road,
        name: format!("{}_{}", road.id, record.id),
        objects,
        concave: false,
    };
    if !road.pieces.is_empty() {
        placer.all(budget)?;
    }
    let (name, concave) = (placer.name, placer.concave);
    if concave {
        let what = "an object whose outline is not convex is taken as its hull";
        notes.add(what, record.place, || format!("object `{name}`"));
    }
    if objects.len() == before {
        let what = "an object of which nothing is on the road's length is left out";
        notes.add(what, record.place, || format!("object `{name}`"));
    }
    Ok(())
}

struct Placer<'a> {
    record: &'a ObjectRecord,
    road: &'a Road,
    name: String,
    objects: &'a mut Vec<MapObject>,
    concave: bool,
}

impl Placer<'_> {
    fn all(&mut self, budget: &mut Budget<'_>) -> Result<(), ImportError> {
        let record = self.record;
        if record.repeats.is_empty() {
            budget.objects(1.0, self.corner_count(), self.road)?;
            self.copy(&Copy {
                s: record.s,
                t: record.t,
                size: record.size,
            });
        }
        for repeat in &record.repeats {
            let length = repeat.length.min(self.road.length - repeat.s);
            if length < 0.0 || repeat.s < 0.0 {
                continue;
            }
            let step = if repeat.distance > 0.0 {
                repeat.distance
            } else {
                SHORTEST_PART
            };
            budget.objects(1.0 + length / step, self.corner_count(), self.road)?;
            if repeat.distance > 0.0 {
                self.copies(repeat, length);
            } else {
                self.strip(repeat, length);
            }
        }
        Ok(())
    }

    fn corner_count(&self) -> f64 {
        let corners = self.record.outlines.iter().map(|outline| outline.corners.len());
        corners.sum::<usize>() as f64
    }

    fn copies(&mut self, repeat: &Repeat, length: f64) {
        let last = (length / repeat.distance + ROUNDING).floor();
        let mut number = 0.0;
        while number <= last {
            let along = number * repeat.distance;
            let share = along / repeat.length.max(ROUNDING);
            self.copy(&Copy {
                s: repeat.s + along,
                t: between(repeat.t, share),
                size: sized(self.record.size, repeat, share),
            });
            number += 1.0;
        }
    }

    /// A thing without gaps, in straight parts.
    fn strip(&mut self, repeat: &Repeat, length: f64) {
        let (road, end) = (self.road, repeat.s + length);
        let mut from = edge(road, self.record.size, repeat, repeat.s);
        let mut s = repeat.s;
        while s + ROUNDING < end {
            let kappa = piece(road, s).at(s).kappa.abs();
            let part = libm::sqrt(8.0 * SAGITTA / kappa).clamp(SHORTEST_PART, LONGEST_PART);
            s = (s + part).min(end);
            let (pose, [right, left]) = from;
            from = edge(road, self.record.size, repeat, s);
            let ring = [right, left, from.1[0], from.1[1]].map(|corner| pose.to_local(corner));
            self.polygon(pose, &ring);
        }
    }

    fn copy(&mut self, copy: &Copy) {
        let record = self.record;
        let mut pose = point(self.road, copy.s, copy.t);
        pose.theta = angle::wrap(pose.theta + record.hdg);
        if record.outlines.is_empty() {
            self.polygon(pose, &ring(copy.size));
        }
        for outline in &record.outlines {
            self.outline(outline, pose, copy);
        }
    }

    fn outline(&mut self, outline: &Outline, pose: Pose, copy: &Copy) {
        let (ds, dt) = (copy.s - self.record.s, copy.t - self.record.t);
        let corners: Vec<Vec2> = match &outline.corners {
            Corners::Local(corners) => corners.clone(),
            Corners::Road(corners) => corners
                .iter()
                .map(|(s, t)| pose.to_local(point(self.road, s + ds, t + dt).position()))
                .collect(),
        };
        if outline.closed {
            self.concave |= is_concave(&corners);
            return self.polygon(pose, &corners);
        }
        for pair in corners.windows(2) {
            self.polygon(pose, &thick(pair[0], pair[1]));
        }
    }

    /// Adds one polygon in the frame of `pose`, unless it has no area or is out of this world.
    fn polygon(&mut self, pose: Pose, ring: &[Vec2]) {
        let corners = ring.iter().flat_map(|corner| [corner.x, corner.y]);
        let believable = |value: f64| value.abs() <= FARTHEST;
        if !([pose.x, pose.y].into_iter().chain(corners).all(believable) && pose.theta.is_finite()) {
            return;
        }
        if let Some(hull) = ConvexPolygon::hull(ring) {
            self.objects.push(MapObject {
                name: self.name.clone(),
                kind: self.record.kind,
                outline: hull.at(pose),
                pose,
            });
        }
    }
}

/// Where a station and a lateral position are, along the road; beyond its ends straight on.
fn point(road: &Road, s: f64, t: f64) -> Pose {
    let inside = s.clamp(0.0, road.length);
    let base = piece(road, inside).at(inside);
    let pose = Pose::new(base.x, base.y, base.theta);
    let at = pose.to_world(Vec2::new(s - inside, t));
    Pose::new(at.x, at.y, base.theta)
}

/// A cut through a thing without gaps: its middle, its right and its left edge.
fn edge(road: &Road, size: Size, repeat: &Repeat, s: f64) -> (Pose, [Vec2; 2]) {
    let share = (s - repeat.s) / repeat.length.max(ROUNDING);
    let size = sized(size, repeat, share);
    let width = size.width.or(size.radius.map(|radius| 2.0 * radius));
    let (t, half) = (
        between(repeat.t, share),
        0.5 * width.unwrap_or(LEAST_SIZE).max(LEAST_SIZE),
    );
    let edges = [t - half, t + half].map(|t| point(road, s, t).position());
    (point(road, s, t), edges)
}

fn between((start, end): (f64, f64), share: f64) -> f64 {
    start + (end - start) * share.min(1.0)
}

/// The size of a copy: what the repetition does not say is the object's.
fn sized(size: Size, repeat: &Repeat, share: f64) -> Size {
    let or = |pair: Option<(f64, f64)>, own: Option<f64>| pair.map(|pair| between(pair, share)).or(own);
    Size {
        length: or(repeat.lengths, size.length),
        width: or(repeat.widths, size.width),
        radius: or(repeat.radii, size.radius),
    }
}

/// The corners of a box or around a circle, at the origin.
fn ring(size: Size) -> Vec<Vec2> {
    if let (Some(radius), None, None) = (size.radius, size.length, size.width) {
        let step = std::f64::consts::TAU / CIRCLE_CORNERS as f64;
        let outer = radius.max(0.5 * LEAST_SIZE) / libm::cos(0.5 * step);
        return (0..CIRCLE_CORNERS)
            .map(|k| {
                let (sin, cos) = angle::sin_cos(step * k as f64);
                Vec2::new(cos, sin) * outer
            })
            .collect();
    }
    let half = |size: Option<f64>| 0.5 * size.unwrap_or(LEAST_SIZE).max(LEAST_SIZE);
    let (u, v) = (half(size.length), half(size.width));
    [(-u, -v), (u, -v), (u, v), (-u, v)]
        .map(|(u, v)| Vec2::new(u, v))
        .into()
}

/// A line as a thin box.
fn thick(a: Vec2, b: Vec2) -> [Vec2; 4] {
    let along = b - a;
    let side = Vec2::new(-along.y, along.x) * (0.5 * LEAST_SIZE / along.norm());
    [a - side, b - side, b + side, a + side]
}

/// Whether a ring leaves a good part of its hull open.
fn is_concave(ring: &[Vec2]) -> bool {
    let next = ring.iter().cycle().skip(1);
    let twice: f64 = ring.iter().zip(next).map(|(a, b)| a.x * b.y - a.y * b.x).sum();
    ConvexPolygon::hull(ring).is_some_and(|hull| 0.5 * twice.abs() < CONVEX * hull.area())
}
