//! Position, heading and curvature where lanes begin, end and meet, the same for all lanes of a joint.
//!
//! They are those of the smooth line through the joint: the centre lines some metres before and behind it are put
//! together and smoothed as one. So a lane of 0.2 m is held at both ends by nearly the same line. Where lanes fork, the
//! pair that bends least makes the line: through traffic goes straight on, and who turns begins to turn.

use super::centre::Strip;
use super::smooth::{CurvePoint, curve_point, graduated};
use corridor_decider::geometry::{Vec2, angle, cross};

/// How far to both sides of a joint its line is looked at, m: beyond five times the length of the smoothing nothing is felt.
const REACH: f64 = 10.0;

/// Distance of the points of that line, m.
const STEP: f64 = 0.5;

/// How far into both lanes the bend between them is measured, m.
const LOOK: f64 = 2.0;

/// How many short lanes are walked through.
const MOST_LANES: usize = 64;

/// Curvature is cut off here, 1/m: a kink of a real file, not a bend.
const MAX_CURVATURE: f64 = 2.0;

/// Links by strip. The first one is that along which the line bends least.
#[derive(Debug)]
pub(super) struct Links {
    pub(super) predecessors: Vec<Vec<usize>>,
    pub(super) successors: Vec<Vec<usize>>,
}

/// Which way a walk goes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    Back,
    Ahead,
}

/// How every strip begins and ends.
pub(super) fn end_poses(strips: &[Option<Strip>], links: &Links) -> Vec<Option<[CurvePoint; 2]>> {
    let walk = Walk { strips, links };
    let joints = joints(links);
    // The pair of strips that bends least at each joint.
    let mut pairs: Vec<Option<(f64, usize, usize)>> = vec![None; joints.len()];
    for (from, successors) in links.successors.iter().enumerate() {
        for &to in successors {
            let best = &mut pairs[joints[exit(from)]];
            let bend = bend(strips, from, to);
            if best.is_none_or(|(least, ..)| bend < least) {
                *best = Some((bend, from, to));
            }
        }
    }
    let poses: Vec<Option<CurvePoint>> = pairs
        .iter()
        .map(|pair| pair.and_then(|(_, from, to)| walk.pose(Some(from), Some(to))))
        .collect();
    let ends = |(number, strip): (usize, &Option<Strip>)| {
        strip.as_ref()?;
        let begins = poses[joints[entry(number)]].or_else(|| walk.pose(None, Some(number)))?;
        let ends = poses[joints[exit(number)]].or_else(|| walk.pose(Some(number), None))?;
        Some([begins, ends])
    };
    strips.iter().enumerate().map(ends).collect()
}

impl Links {
    /// Sorts the links of every strip.
    pub(super) fn straightest_first(mut self, strips: &[Option<Strip>]) -> Self {
        let order = |a: f64, b: f64| a.total_cmp(&b);
        for (number, list) in self.successors.iter_mut().enumerate() {
            list.sort_by(|a, b| order(bend(strips, number, *a), bend(strips, number, *b)));
        }
        for (number, list) in self.predecessors.iter_mut().enumerate() {
            list.sort_by(|a, b| order(bend(strips, *a, number), bend(strips, *b, number)));
        }
        self
    }
}

/// By how much the line from one strip into another bends, rad; infinite where a strip is missing.
pub(super) fn bend(strips: &[Option<Strip>], from: usize, to: usize) -> f64 {
    let (Some(a), Some(b)) = (&strips[from], &strips[to]) else {
        return f64::INFINITY;
    };
    let (a, b) = (&a.centre, &b.centre);
    let before = a.last() - a.at(a.length() - LOOK);
    let after = b.at(LOOK) - b.first();
    libm::atan2(cross(before, after), before.dot(&after)).abs()
}

fn entry(strip: usize) -> usize {
    2 * strip
}

fn exit(strip: usize) -> usize {
    2 * strip + 1
}

/// The joint of every end: the smallest number of an end that is linked to it.
fn joints(links: &Links) -> Vec<usize> {
    let mut parents: Vec<usize> = (0..2 * links.successors.len()).collect();
    for (from, successors) in links.successors.iter().enumerate() {
        for &to in successors {
            let (a, b) = (root(&mut parents, exit(from)), root(&mut parents, entry(to)));
            parents[a.max(b)] = a.min(b);
        }
    }
    (0..parents.len()).map(|end| root(&mut parents, end)).collect()
}

/// The representative of an end; the way there is shortened.
fn root(parents: &mut [usize], mut end: usize) -> usize {
    while parents[end] != end {
        parents[end] = parents[parents[end]];
        end = parents[end];
    }
    end
}

/// Walks along centre lines and through the lanes linked to them.
struct Walk<'a> {
    strips: &'a [Option<Strip>],
    links: &'a Links,
}

impl Walk<'_> {
    /// The line through the end of one strip and the start of another, there. One of them may be missing.
    fn pose(&self, from: Option<usize>, to: Option<usize>) -> Option<CurvePoint> {
        let before = from
            .map(|strip| self.points(strip, Way::Back))
            .unwrap_or_default();
        let after = to.map(|strip| self.points(strip, Way::Ahead)).unwrap_or_default();
        let start = to.and_then(|strip| Some(self.strips[strip].as_ref()?.centre.first()));
        let joint = start.or_else(|| Some(self.strips[from?].as_ref()?.centre.last()))?;
        let mut line: Vec<Vec2> = before.iter().rev().copied().collect();
        line.push(joint);
        line.extend(&after);
        Some(pose_at(&line, before.len()))
    }

    /// Points at even distances from the end of a strip backwards or from its start ahead.
    fn points(&self, strip: usize, way: Way) -> Vec<Vec2> {
        let mut points = Vec::new();
        let mut distance = STEP;
        while distance <= REACH {
            let (point, reached) = self.point(strip, way, distance);
            if reached < distance {
                break;
            }
            points.push(point);
            distance += STEP;
        }
        if let (true, Some(strip)) = (points.is_empty(), &self.strips[strip]) {
            // A lane on its own that is shorter than a step.
            points.push(if way == Way::Back {
                strip.centre.first()
            } else {
                strip.centre.last()
            });
        }
        points
    }

    /// The point `distance` away from an end of a strip, and how far it is where the lanes end before.
    fn point(&self, mut number: usize, way: Way, distance: f64) -> (Vec2, f64) {
        let (mut point, mut walked) = (Vec2::zeros(), 0.0);
        for _ in 0..MOST_LANES {
            let Some(Strip { centre, .. }) = &self.strips[number] else {
                break;
            };
            let rest = distance - walked;
            let (at, next) = match way {
                Way::Back => (centre.length() - rest, self.links.predecessors[number].first()),
                Way::Ahead => (rest, self.links.successors[number].first()),
            };
            point = centre.at(at);
            walked += centre.length().min(rest);
            match next {
                Some(&next) if rest > centre.length() => number = next,
                _ => break,
            }
        }
        (point, walked)
    }
}

/// The smooth line near some points at point `k`.
fn pose_at(points: &[Vec2], k: usize) -> CurvePoint {
    let line = graduated(points);
    let last = line.len() - 1;
    if last < 2 {
        let chord = line[last] - line[0];
        return CurvePoint {
            position: line[k],
            theta: libm::atan2(chord.y, chord.x),
            kappa: 0.0,
        };
    }
    // At an end the circle through the three outermost points goes on.
    let inner = k.clamp(1, last - 1);
    let mut pose = curve_point(&line[inner - 1..=inner + 1], Vec2::zeros());
    pose.kappa = pose.kappa.clamp(-MAX_CURVATURE, MAX_CURVATURE);
    let step = (line[k] - pose.position).norm();
    let towards = if k < inner { -step } else { step };
    CurvePoint {
        position: line[k],
        theta: angle::wrap(pose.theta + pose.kappa * towards),
        kappa: pose.kappa,
    }
}
