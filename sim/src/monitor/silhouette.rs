//! What a standing obstacle covers of a line's Frenet plane, cell by cell: the monitor's own picture of it.
//!
//! The true outline is projected, its edges in short pieces, and what lies inside each cell of stations is kept as
//! one interval of offsets. No box is drawn around it, so a car that stands askew covers what it covers. Along the
//! line it is too large by less than a cell; across it by less than the sagitta of a piece. Metres.

use corridor_decider::frame::{Frame, Obstacle, ObstacleId};
use corridor_decider::geometry::Pose;
use corridor_decider::reference_line::{LineQuery, ReferenceLine, SlPoint};
use std::sync::Arc;

/// Length of a cell along the line, m: half the distance between two stations of a bound.
pub(super) const CELL: f64 = 0.25;

/// Longest piece of an edge that is taken as straight in the Frenet plane, m: on the tightest bend of a road, 10 m
/// in radius, it strays 3 mm.
const PIECE: f64 = 0.5;

/// Obstacles whose centre is farther than this from the ego are not looked at, m: no bound reaches so far.
const RANGE: f64 = 150.0;

/// An interval of offsets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Span {
    pub(super) right: f64,
    pub(super) left: f64,
}

impl Span {
    const NONE: Self = Self {
        right: f64::INFINITY,
        left: f64::NEG_INFINITY,
    };

    fn add(&mut self, l: f64) {
        (self.right, self.left) = (self.right.min(l), self.left.max(l));
    }

    fn join(self, other: Self) -> Self {
        Self {
            right: self.right.min(other.right),
            left: self.left.max(other.left),
        }
    }
}

/// One standing obstacle in the Frenet plane.
#[derive(Clone, Debug)]
pub(super) struct Silhouette {
    pub(super) id: ObstacleId,
    /// Its nearest and farthest station.
    pub(super) start: f64,
    pub(super) end: f64,
    /// Offsets per cell; the first cell holds `start`.
    cells: Vec<Span>,
    /// Where it stood when it was projected.
    pose: Pose,
}

impl Silhouette {
    fn of(line: &ReferenceLine, obstacle: &Obstacle) -> Self {
        let outline = project(line, obstacle);
        let stations = || outline.iter().map(|p| p.s);
        let (start, end) = (
            stations().fold(f64::INFINITY, f64::min),
            stations().fold(f64::NEG_INFINITY, f64::max),
        );
        let mut silhouette = Self {
            id: obstacle.id,
            start,
            end,
            cells: vec![Span::NONE; cell((end - start).max(0.0)) + 1],
            pose: obstacle.pose,
        };
        let next = outline.iter().cycle().skip(1);
        for (a, b) in outline.iter().zip(next) {
            silhouette.add_piece(*a, *b);
        }
        silhouette
    }

    /// Takes in the straight piece between two points of the outline.
    fn add_piece(&mut self, a: SlPoint, b: SlPoint) {
        let (near, far) = if a.s <= b.s { (a, b) } else { (b, a) };
        let (first, last) = (cell(near.s - self.start), cell(far.s - self.start));
        for k in first..=last.min(self.cells.len() - 1) {
            let edge = |k: usize| self.start + k as f64 * CELL;
            let at = |s: f64| {
                let share = if far.s > near.s {
                    (s - near.s) / (far.s - near.s)
                } else {
                    0.0
                };
                near.l + (far.l - near.l) * share
            };
            let (from, to) = (edge(k).max(near.s), edge(k + 1).min(far.s));
            let ends = if far.s > near.s {
                [at(from), at(to)]
            } else {
                [near.l, far.l]
            };
            for l in ends {
                self.cells[k].add(l);
            }
        }
    }

    /// What it covers between two stations, if anything.
    pub(super) fn between(&self, from: f64, to: f64) -> Option<Span> {
        if from > self.end || to < self.start {
            return None;
        }
        let first = cell((from - self.start).max(0.0));
        let last = cell((to - self.start).max(0.0)).min(self.cells.len() - 1);
        let covered = self.cells.get(first..=last)?.iter().copied();
        covered.reduce(Span::join)
    }
}

/// Number of the cell that lies `ahead` metres of the first one's beginning.
fn cell(ahead: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "saturates; obstacles are shorter than a road"
    )]
    let number = (ahead / CELL) as usize;
    number
}

/// The outline in short pieces, projected.
fn project(line: &ReferenceLine, obstacle: &Obstacle) -> Vec<SlPoint> {
    let mut points = Vec::new();
    for (a, b) in obstacle.footprint().edges() {
        let pieces = ((b - a).norm() / PIECE).ceil().max(1.0);
        let mut k = 0.0;
        while k < pieces {
            points.push(line.to_frenet(a + (b - a) * (k / pieces)));
            k += 1.0;
        }
    }
    points
}

/// The silhouettes of a run's standing obstacles along one line; projected once, since neither moves.
#[derive(Clone, Debug)]
struct Album {
    line: Arc<ReferenceLine>,
    all: Vec<Silhouette>,
}

/// The silhouettes along the lines of a run.
#[derive(Clone, Debug, Default)]
pub(super) struct Silhouettes {
    albums: Vec<Album>,
}

impl Silhouettes {
    /// The obstacles of `frame` that stand for good and are in range, along `line`.
    pub(super) fn of<'a>(&'a mut self, frame: &Frame, line: &Arc<ReferenceLine>) -> Vec<&'a Silhouette> {
        let place = self
            .albums
            .iter()
            .position(|album| Arc::ptr_eq(&album.line, line));
        let place = place.unwrap_or_else(|| {
            let line = Arc::clone(line);
            self.albums.push(Album {
                line,
                all: Vec::new(),
            });
            self.albums.len() - 1
        });
        let album = &mut self.albums[place];
        let ego = frame.ego.pose.position();
        let in_range =
            |o: &&Obstacle| o.is_static && (o.pose.position() - ego).norm_squared() <= RANGE * RANGE;
        let wanted: Vec<usize> = frame
            .obstacles
            .iter()
            .filter(in_range)
            .map(|o| album.place(o))
            .collect();
        let album = &self.albums[place];
        wanted.into_iter().map(|k| &album.all[k]).collect()
    }
}

impl Album {
    /// Place of an obstacle's silhouette, drawn now if it is new or has moved.
    fn place(&mut self, obstacle: &Obstacle) -> usize {
        let known = self.all.iter().position(|known| known.id == obstacle.id);
        match known {
            Some(k) if self.all[k].pose == obstacle.pose => k,
            Some(k) => {
                self.all[k] = Silhouette::of(&self.line, obstacle);
                k
            }
            None => {
                self.all.push(Silhouette::of(&self.line, obstacle));
                self.all.len() - 1
            }
        }
    }
}
