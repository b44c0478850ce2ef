//! What a CommonRoad file says, as plain data in the shape of its elements: versions 2018b and 2020a.
//!
//! Metres, radians, metres per second, in the axes of the file. Times are counted in steps of
//! [`File::time_step`] seconds. Numbers that a file gives as intervals stay intervals. Source: the format's
//! specification, version 2020a.

use crate::import::TextPlace;
use corridor_decider::geometry::Vec2;

/// A whole file.
#[derive(Clone, Debug, PartialEq)]
pub struct File {
    /// The format's version, as written.
    pub version: String,
    /// The scenario's name in the benchmark collection.
    pub benchmark: String,
    /// Duration of a time step, s.
    pub time_step: f64,
    /// Lanelets in file order.
    pub lanelets: Vec<Lanelet>,
    /// Traffic signs.
    pub signs: Vec<Sign>,
    /// Traffic lights.
    pub lights: Vec<Light>,
    /// Intersections.
    pub intersections: Vec<Intersection>,
    /// Obstacles of all roles in file order.
    pub obstacles: Vec<Obstacle>,
    /// Planning problems.
    pub problems: Vec<Problem>,
}

/// Identity of an element, unique in its file but for what real files do.
pub type Id = i64;

/// A lane between two bounds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lanelet {
    /// Its id.
    pub id: Id,
    /// Left and right bound.
    pub bounds: [Bound; 2],
    /// Lanelets that lead here.
    pub predecessors: Vec<Id>,
    /// Lanelets to go on to.
    pub successors: Vec<Id>,
    /// The lanelets beside it on the left and on the right.
    pub adjacent: [Option<Adjacent>; 2],
    /// Speed limit, m/s: 2018b only.
    pub speed_limit: Option<f64>,
    /// What it is, often several words: 2020a only.
    pub types: Vec<String>,
    /// Who may use it, in one direction or both; empty: not said.
    pub users: Vec<String>,
    /// Signs that hold on it.
    pub signs: Vec<Id>,
    /// Lights that hold on it.
    pub lights: Vec<Id>,
    /// Whether a stop line crosses it.
    pub has_stop_line: bool,
}

/// One edge of a lanelet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bound {
    /// Its points, in driving direction.
    pub points: Vec<Vec2>,
    /// The line on it, as written.
    pub marking: Option<String>,
}

/// A lanelet beside another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Adjacent {
    /// Its id.
    pub id: Id,
    /// Whether it is driven the same way.
    pub same_direction: bool,
}

/// A traffic sign: what is on one post.
#[derive(Clone, Debug, PartialEq)]
pub struct Sign {
    /// Its id.
    pub id: Id,
    /// The plates: the country's number of the sign, and what is written on it.
    pub plates: Vec<(String, Vec<String>)>,
}

/// A traffic light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Its id.
    pub id: Id,
    /// Colours in their order, each with its duration in steps.
    pub cycle: Vec<(String, f64)>,
    /// Where in its cycle it is at the start, in steps.
    pub offset: f64,
    /// Whether it works.
    pub active: bool,
}

/// Lanelets that lead into an area where roads cross, and those that lead through it.
#[derive(Clone, Debug, PartialEq)]
pub struct Intersection {
    /// Its id.
    pub id: Id,
    /// Lanelets that lead into it.
    pub incoming: Vec<Id>,
    /// Lanelets that lead through it.
    pub through: Vec<Id>,
}

/// A number, or an interval where the file is not certain or leaves a choice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Least value.
    pub low: f64,
    /// Largest value.
    pub high: f64,
}

impl Interval {
    /// Just this number.
    pub const fn exact(value: f64) -> Self {
        Self {
            low: value,
            high: value,
        }
    }

    /// Its middle.
    pub fn middle(self) -> f64 {
        // Halves first: the sum of two numbers need not be one.
        self.low / 2.0 + self.high / 2.0
    }

    /// Whether it is a single number.
    pub fn is_exact(self) -> bool {
        self.low >= self.high
    }
}

/// An outline around an origin, or in the axes of the file where it stands alone.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A rectangle.
    Rectangle {
        /// Size along its orientation, m.
        length: f64,
        /// Size across, m.
        width: f64,
        /// Its orientation, rad.
        orientation: f64,
        /// Its centre.
        center: Vec2,
    },
    /// A circle.
    Circle {
        /// Its radius, m.
        radius: f64,
        /// Its centre.
        center: Vec2,
    },
    /// A polygon, convex or not, in either sense of rotation.
    Polygon(Vec<Vec2>),
}

/// Where something is, or may be.
#[derive(Clone, Debug, PartialEq)]
pub enum Position {
    /// Here.
    Point(Vec2),
    /// Anywhere in these shapes.
    Shapes(Vec<Shape>),
    /// Anywhere in these lanelets.
    Lanelets(Vec<Id>),
}

/// A state of motion at a time. What a file leaves out is `None`.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Where.
    pub position: Option<Position>,
    /// Heading, rad.
    pub orientation: Option<Interval>,
    /// When, in steps.
    pub time: Interval,
    /// Speed along the heading, m/s.
    pub velocity: Option<Interval>,
    /// Acceleration along the heading, m/s².
    pub acceleration: Option<Interval>,
    /// Yaw rate, rad/s.
    pub yaw_rate: Option<Interval>,
    /// Angle from the heading to the direction of motion, rad.
    pub slip_angle: Option<Interval>,
}

/// What part an obstacle plays.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    /// Stands.
    Static,
    /// Moves.
    Dynamic,
    /// Belongs to the surroundings, such as a building.
    Environment,
    /// May or may not be there.
    Phantom,
}

/// Where an obstacle goes.
#[derive(Clone, Debug, PartialEq)]
pub enum Prediction {
    /// Nowhere.
    None,
    /// Through these states.
    Trajectory(Vec<State>),
    /// Somewhere in these shapes, each at a time in steps.
    Occupancy(Vec<(Interval, Vec<Shape>)>),
}

/// Anything in the way.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// Its id.
    pub id: Id,
    /// The part it plays.
    pub role: Role,
    /// Its class, as written.
    pub kind: String,
    /// Its outline: the union of these shapes.
    pub shape: Vec<Shape>,
    /// Where it is at first; absent for [`Role::Environment`] and [`Role::Phantom`].
    pub initial: Option<State>,
    /// Where it goes.
    pub prediction: Prediction,
}

/// A task: from here to there.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Its id.
    pub id: Id,
    /// Where in the text it starts.
    pub place: TextPlace,
    /// Where the vehicle starts.
    pub initial: State,
    /// Where to get: any of these.
    pub goals: Vec<State>,
}
