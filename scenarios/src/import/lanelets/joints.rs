//! Heading and curvature where lanes begin, end and meet, the same for all lanes of a joint.
//!
//! From the circle through three points of the centre lines, one of them the joint. Where a lane forks, the pair of
//! lanes that bends least counts most: through traffic goes straight on, and who turns begins to turn.

use super::centre::Strip;
use super::smooth::EndPose;
use corridor_decider::geometry::{Vec2, angle, cross};

/// How far from a joint the circle's other points lie, m: as far as the smoothing reaches.
const LOOK: f64 = 2.0;

/// How many lanes that are too short for that are walked through.
const MOST_LANES: usize = 16;

/// Pairs of lanes that bend by less than this count alike, rad.
const STRAIGHT: f64 = 0.02;

/// Curvature is cut off here, 1/m: no car turns on two metres.
const MAX_CURVATURE: f64 = 0.5;

/// Links by strip.
pub(super) struct Links {
    pub(super) predecessors: Vec<Vec<usize>>,
    pub(super) successors: Vec<Vec<usize>>,
}

/// How every strip begins and ends. Strips that are not there get a default.
pub(super) fn end_poses(strips: &[Option<Strip>], links: &Links) -> Vec<[EndPose; 2]> {
    let walk = Walk { strips, links };
    let joints = joints(links);
    let mut sums = vec![Sum::default(); 2 * strips.len()];
    for (from, successors) in links.successors.iter().enumerate() {
        for &to in successors {
            sums[joints[exit(from)]].add(&walk.across(from, to));
        }
    }
    let mut poses = vec![[EndPose::default(); 2]; strips.len()];
    for (number, strip) in strips.iter().enumerate() {
        if let Some(strip) = strip {
            let begins = sums[joints[entry(number)]].mean();
            let ends = sums[joints[exit(number)]].mean();
            poses[number] = [
                begins.unwrap_or_else(|| walk.free_start(number, strip)),
                ends.unwrap_or_else(|| walk.free_end(number, strip)),
            ];
        }
    }
    poses
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

/// How the line bends from one chord into another.
struct Bend {
    turn: f64,
    pose: EndPose,
}

/// The bend at the end of `before` and the start of `after`, which are short chords of one circle.
fn bend(before: Vec2, after: Vec2) -> Option<Bend> {
    let (a, b) = (before.norm(), after.norm());
    if !(a > 0.0 && b > 0.0) {
        return None;
    }
    let turn = libm::atan2(cross(before, after), before.dot(&after));
    let theta = angle::wrap(libm::atan2(before.y, before.x) + turn * a / (a + b));
    let kappa = (2.0 * turn / (a + b)).clamp(-MAX_CURVATURE, MAX_CURVATURE);
    Some(Bend {
        turn,
        pose: EndPose { theta, kappa },
    })
}

/// A weighted sum of bends.
#[derive(Clone, Debug, Default)]
struct Sum {
    direction: Vec2,
    kappa: f64,
    weight: f64,
}

impl Sum {
    fn add(&mut self, bend: &Option<Bend>) {
        let Some(Bend { turn, pose }) = bend else {
            return;
        };
        let weight = 1.0 / (turn * turn + STRAIGHT * STRAIGHT);
        let (sin, cos) = angle::sin_cos(pose.theta);
        self.direction += Vec2::new(cos, sin) * weight;
        self.kappa += pose.kappa * weight;
        self.weight += weight;
    }

    fn mean(&self) -> Option<EndPose> {
        (self.weight > 0.0 && self.direction.norm() > 0.0).then(|| EndPose {
            theta: libm::atan2(self.direction.y, self.direction.x),
            kappa: self.kappa / self.weight,
        })
    }
}

/// Walks along centre lines and through the lanes linked to them.
struct Walk<'a> {
    strips: &'a [Option<Strip>],
    links: &'a Links,
}

impl Walk<'_> {
    /// The bend from one strip into another.
    fn across(&self, from: usize, to: usize) -> Option<Bend> {
        let (a, b) = (self.strips[from].as_ref()?, self.strips[to].as_ref()?);
        bend(
            a.centre.last() - self.behind(from, LOOK),
            self.ahead(to, LOOK) - b.centre.first(),
        )
    }

    /// How a strip begins that nothing leads to: on the circle of its first metres.
    fn free_start(&self, number: usize, strip: &Strip) -> EndPose {
        let (first, near, far) = (strip.centre.first(), self.ahead(number, LOOK), self.ahead(number, 2.0 * LOOK));
        free_pose(near - first, far - near, -1.0)
    }

    /// How a strip ends that leads to nothing.
    fn free_end(&self, number: usize, strip: &Strip) -> EndPose {
        let (last, near, far) = (strip.centre.last(), self.behind(number, LOOK), self.behind(number, 2.0 * LOOK));
        free_pose(last - near, near - far, 1.0)
    }

    /// The point `distance` beyond the start of a strip.
    fn ahead(&self, mut number: usize, mut distance: f64) -> Vec2 {
        let mut point = Vec2::zeros();
        for _ in 0..MOST_LANES {
            let Some(strip) = &self.strips[number] else { break };
            point = strip.centre.at(distance);
            distance -= strip.centre.length();
            match self.links.successors[number].first() {
                Some(&next) if distance > 0.0 => number = next,
                _ => break,
            }
        }
        point
    }

    /// The point `distance` before the end of a strip.
    fn behind(&self, mut number: usize, mut distance: f64) -> Vec2 {
        let mut point = Vec2::zeros();
        for _ in 0..MOST_LANES {
            let Some(strip) = &self.strips[number] else { break };
            point = strip.centre.at(strip.centre.length() - distance);
            distance -= strip.centre.length();
            match self.links.predecessors[number].first() {
                Some(&next) if distance > 0.0 => number = next,
                _ => break,
            }
        }
        point
    }
}

/// The pose at the outer end of chord `outer`, beside which lies chord `inner`; `side` is 1 when the line runs from
/// `inner` to `outer`.
fn free_pose(outer: Vec2, inner: Vec2, side: f64) -> EndPose {
    let heading = libm::atan2(outer.y, outer.x);
    let both = if side > 0.0 { bend(inner, outer) } else { bend(outer, inner) };
    let Some(Bend { pose, .. }) = both else {
        return EndPose { theta: heading, kappa: 0.0 };
    };
    EndPose {
        theta: angle::wrap(heading + side * pose.kappa * outer.norm() / 2.0),
        kappa: pose.kappa,
    }
}
