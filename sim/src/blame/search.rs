//! The reference search: is there a motion of the car that survives?
//!
//! Time is cut into steps; in each the car is commanded one of a few accelerations and one of a few ways to steer, at
//! most as much as its limits allow. Motions that change their command seldom come first, so what a driver would try
//! is tried first (limited discrepancy search, Harvey and Ginsberg 1995), and all others follow. Of motions that are
//! at one time nearly in one state, one is followed. Every motion is held against the true outlines of everybody at
//! every sample of their tracks, and against the edge of the road as often as the monitor looks.
//!
//! Nothing of a decider is in it: no bound, no path, no prediction.

use super::car::{CarState, Command, Limits};
use super::tracks::{Near, Rectangle, Surroundings};
use super::witness::Witness;
use corridor_decider::geometry::{Vec2, cross};
use corridor_decider::reference_line::LineQuery;
use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

/// How often the monitor looks at the edge of the road, s.
const ROAD_PERIOD: f64 = 0.1;

/// Distance within which a car that is to drive along the road takes on its direction: this much time, s, and at
/// least this much way, m.
const ALIGNING: (f64, f64) = (0.4, 3.0);

/// Nearer to the middle of a bend than this part of its radius nobody follows it.
const TIGHTEST: f64 = 0.2;

/// A way to steer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Steer {
    /// In the direction of the road.
    Along,
    /// This share of the largest curvature at the speed of now, left positive.
    Share(f64),
}

/// What motions are made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Length of a step, s.
    pub step: f64,
    /// Accelerations as shares of the hardest braking (negative) and of the largest acceleration.
    pub accelerations: Vec<f64>,
    /// Ways to steer.
    pub steers: Vec<Steer>,
    /// States nearer than this to each other are one: place, m; heading, rad; speed, m/s; curvature, 1/m.
    pub cell: [f64; 4],
}

impl Default for Grid {
    /// Fine enough that who survives does so here (measured over the runs of the catalog), coarse enough for seconds.
    fn default() -> Self {
        Self {
            step: 0.2,
            accelerations: vec![-1.0, 0.0, -0.5, 1.0],
            steers: vec![
                Steer::Along,
                Steer::Share(1.0),
                Steer::Share(-1.0),
                Steer::Share(0.3),
                Steer::Share(-0.3),
            ],
            cell: [0.3, 0.05, 0.5, 0.04],
        }
    }
}

/// What a search found.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// A motion that survives.
    Survives(Witness),
    /// None of the grid's motions does.
    Dies,
    /// Not found within so many steps of motions; there may be one.
    Exhausted(usize),
}

/// A question to the search.
#[derive(Clone, Copy, Debug)]
pub struct Question<'a> {
    /// Who else is there.
    pub surroundings: &'a Surroundings,
    /// The car's limits.
    pub limits: &'a Limits,
    /// What motions are made of.
    pub grid: &'a Grid,
    /// The car's body.
    pub body: Rectangle,
    /// How the motion begins.
    pub start: CarState,
    /// The samples at which it begins and ends.
    pub samples: (usize, usize),
    /// How many steps of motions may be tried.
    pub budget: usize,
}

/// A command of the grid, by its places there.
pub(super) type Choice = (usize, usize);

/// The end of a motion so far.
#[derive(Clone, Copy, Debug)]
struct Node {
    car: CarState,
    /// The sample at which it is there.
    sample: usize,
    /// About where along the line it is, m.
    station: f64,
    choice: Option<Choice>,
    changes: u32,
    parent: Option<usize>,
}

/// States that count as one: sample, place, heading, speed, curvature.
type Cell = (usize, [i32; 5]);

impl Question<'_> {
    /// Searches. Deterministic; what it costs is bounded by the budget.
    pub fn answer(&self) -> Answer {
        let line = &self.surroundings.scenario.line;
        let root = Node {
            car: self.start,
            sample: self.samples.0,
            station: line.to_frenet(self.start.place).s,
            choice: None,
            changes: 0,
            parent: None,
        };
        let mut nodes = vec![root];
        let mut queue = BinaryHeap::from([(Reverse(0), root.sample, Reverse(0))]);
        let mut seen: BTreeSet<Cell> = BTreeSet::new();
        let (mut tried, mut near) = (0, Near::default());
        while let Some((_, _, Reverse(place))) = queue.pop() {
            let node = nodes[place];
            if node.sample >= self.samples.1 {
                return Answer::Survives(self.witness(&nodes, place));
            }
            for choice in self.choices() {
                if tried >= self.budget {
                    return Answer::Exhausted(tried);
                }
                tried += 1;
                let Some(next) = self.step(&node, place, choice, &mut near) else {
                    continue;
                };
                if seen.insert(self.cell(&next)) {
                    queue.push((Reverse(next.changes), next.sample, Reverse(nodes.len())));
                    nodes.push(next);
                }
            }
        }
        Answer::Dies
    }

    fn choices(&self) -> impl Iterator<Item = Choice> {
        let steers = self.grid.steers.len();
        (0..self.grid.accelerations.len() * steers).map(move |k| {
            (
                k % (self.grid.accelerations.len()),
                k / self.grid.accelerations.len(),
            )
        })
    }

    /// One step of a motion; `None` when it ends in a collision or off the road.
    fn step(&self, node: &Node, parent: usize, choice: Choice, near: &mut Near) -> Option<Node> {
        let (command, station) = self.command(&node.car, node.station, choice);
        let end = (node.sample + self.samples_per_step()).min(self.samples.1);
        let way = (node.car.v + self.limits.acceleration * self.grid.step) * self.grid.step;
        self.surroundings
            .near(&self.body, &node.car, way, (node.sample, end), near);
        let mut car = node.car;
        for sample in node.sample + 1..=end {
            car = car.advanced(command, self.limits, self.surroundings.dt);
            if !self.survives(&car, sample, near) {
                return None;
            }
        }
        let changes = node.changes + u32::from(node.choice.is_some_and(|before| before != choice));
        Some(Node {
            car,
            sample: end,
            station,
            choice: Some(choice),
            changes,
            parent: Some(parent),
        })
    }

    fn survives(&self, car: &CarState, sample: usize, near: &Near) -> bool {
        let looks = sample.is_multiple_of(self.samples_in(ROAD_PERIOD));
        self.surroundings.is_clear(&self.body, car, sample, near)
            && (!looks || self.surroundings.is_on_road(&self.body, car))
    }

    /// What a choice asks of the car now, and where along the line that is.
    pub(super) fn command(&self, car: &CarState, near: f64, choice: Choice) -> (Command, f64) {
        let share = self.grid.accelerations[choice.0];
        let acceleration = if share < 0.0 {
            -share * self.limits.braking
        } else {
            share * self.limits.acceleration
        };
        let line = &self.surroundings.scenario.line;
        let at = line.to_frenet_near(car.place, near);
        let kappa = match self.grid.steers[choice.1] {
            Steer::Share(share) => share * self.limits.kappa_at(car.v),
            Steer::Along => {
                let point = line.point(at.s);
                let (sin, cos) = corridor_decider::geometry::angle::sin_cos(point.theta);
                let road = Vec2::new(cos, sin);
                let off = libm::atan2(cross(road, car.forward), road.dot(&car.forward));
                let bend = point.kappa / (1.0 - point.kappa * at.l).max(TIGHTEST);
                bend - off / (ALIGNING.0 * car.v).max(ALIGNING.1)
            }
        };
        (Command { acceleration, kappa }, at.s)
    }

    pub(super) fn samples_per_step(&self) -> usize {
        self.samples_in(self.grid.step)
    }

    fn samples_in(&self, time: f64) -> usize {
        samples_in(time, self.surroundings.dt)
    }

    fn cell(&self, node: &Node) -> Cell {
        let [place, heading, speed, kappa] = self.grid.cell;
        let car = &node.car;
        let from = car.place - self.start.place;
        let off = libm::atan2(
            cross(self.start.forward, car.forward),
            self.start.forward.dot(&car.forward),
        );
        let number = |value: f64, size: f64| {
            #[expect(clippy::cast_possible_truncation, reason = "saturates")]
            let number = (value / size).round() as i32;
            number
        };
        let numbers = [
            number(from.x, place),
            number(from.y, place),
            number(off, heading),
            number(car.v, speed),
            number(car.kappa, kappa),
        ];
        (node.sample, numbers)
    }

    /// The motion that ends at a node, sample by sample.
    fn witness(&self, nodes: &[Node], end: usize) -> Witness {
        let mut chain: Vec<usize> = std::iter::successors(Some(end), |k| nodes[*k].parent).collect();
        chain.reverse();
        let mut states = vec![self.start];
        for pair in chain.windows(2) {
            let (from, to) = (&nodes[pair[0]], &nodes[pair[1]]);
            let choice = to.choice.expect("only the root was not chosen");
            let (command, _) = self.command(&from.car, from.station, choice);
            let mut car = from.car;
            for _ in from.sample..to.sample {
                car = car.advanced(command, self.limits, self.surroundings.dt);
                states.push(car);
            }
        }
        Witness {
            first: self.samples.0,
            states,
        }
    }
}

/// Whole samples in a time, at least one.
pub(super) fn samples_in(time: f64, dt: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a small positive ratio"
    )]
    let samples = (time / dt).round().max(1.0) as usize;
    samples
}
