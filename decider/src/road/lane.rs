//! One lane: its centre line, edges, marks and links. All in driving direction.

use super::JunctionId;
use crate::geometry::Vec2;
use serde::{Deserialize, Serialize};

/// Handle of a lane inside its map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct LaneId(pub u32);

/// Left or right, seen in driving direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    /// Towards positive `l`.
    Left,
    /// Towards negative `l`.
    Right,
}

impl Side {
    /// The other side.
    #[must_use]
    pub fn opposite(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }

    /// `+1` for left, `-1` for right: the sign of `l` on this side.
    pub fn sign(self) -> f64 {
        match self {
            Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }
}

/// What a lane is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LaneKind {
    /// A through lane for cars.
    Driving,
    /// An acceleration, deceleration or turning lane, or a ramp.
    Ramp,
    /// A hard shoulder meant for stopping.
    Stop,
    /// A soft or narrow shoulder.
    Shoulder,
    /// A lane or bays to park in.
    Parking,
    /// A hard strip beside a lane: part of the road's body, not for driving.
    Border,
    /// A kerb.
    Curb,
    /// The strip between two carriageways.
    Median,
    /// Closed to traffic.
    Restricted,
    /// For bicycles.
    Biking,
    /// For pedestrians.
    Sidewalk,
    /// For trams or trains.
    Rail,
    /// Anything else, also unpaved ground.
    Other,
}

impl LaneKind {
    /// Whether through traffic may drive here.
    pub fn is_drivable(self) -> bool {
        matches!(self, Self::Driving | Self::Ramp)
    }

    /// Whether a car may stop here out of the traffic.
    pub fn is_stopping(self) -> bool {
        matches!(self, Self::Stop | Self::Shoulder | Self::Parking)
    }

    /// Whether a car's wheels are on the road here.
    pub fn is_road_surface(self) -> bool {
        self.is_drivable() || self.is_stopping()
    }
}

/// The line on one edge of a lane, in the original's classes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "SCREAMING_SNAKE_CASE")]
pub enum BoundaryType {
    /// Nothing known.
    Unknown,
    /// Broken yellow.
    DottedYellow,
    /// Broken white.
    DottedWhite,
    /// Solid yellow.
    SolidYellow,
    /// Solid white.
    SolidWhite,
    /// Two solid yellow lines.
    DoubleYellow,
    /// A kerb or another hard edge.
    Curb,
}

/// A boundary type that holds from station `s` of the lane on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// First station, m along the lane.
    pub s: f64,
    /// The line from there on.
    pub kind: BoundaryType,
}

/// A cross-section of a lane. Widths are metres to each side of the centre line, never negative.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LanePoint {
    /// Station along the lane, strictly increasing, 0 at the first point.
    pub s: f64,
    /// World position of the centre line.
    pub x: f64,
    /// World position of the centre line.
    pub y: f64,
    /// Driving direction.
    pub theta: f64,
    /// Curvature of the centre line, 1/m, left turns positive.
    pub kappa: f64,
    /// To the lane's left edge.
    pub left: f64,
    /// To the lane's right edge.
    pub right: f64,
    /// To the left edge of the road surface (oncoming lanes and stopping lanes included).
    pub road_left: f64,
    /// To the right edge of the road surface.
    pub road_right: f64,
    /// Speed limit, m/s; infinite where the map names none.
    pub speed_limit: f64,
}

impl LanePoint {
    /// The point `l` metres left of the centre line.
    pub fn offset(&self, l: f64) -> Vec2 {
        let (sin, cos) = crate::geometry::angle::sin_cos(self.theta);
        Vec2::new(self.x - l * sin, self.y + l * cos)
    }
}

/// A neighbouring lane of one kind: on a side, along or against the driving direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Neighbour {
    /// On which side.
    pub side: Side,
    /// Whether its traffic comes towards us.
    pub reverse: bool,
}

impl Neighbour {
    /// All four kinds in the order in which tables store them.
    pub const ALL: [Self; 4] = [
        Self {
            side: Side::Left,
            reverse: false,
        },
        Self {
            side: Side::Left,
            reverse: true,
        },
        Self {
            side: Side::Right,
            reverse: false,
        },
        Self {
            side: Side::Right,
            reverse: true,
        },
    ];

    /// Place in [`Neighbour::ALL`].
    pub fn index(self) -> usize {
        usize::from(self.side == Side::Right) * 2 + usize::from(self.reverse)
    }
}

/// One lane of a road section, from its entry to its exit in driving direction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lane {
    /// The name in its file, unique in the map; OpenDRIVE: `road_section_lane`.
    pub name: String,
    /// What it is for.
    pub kind: LaneKind,
    /// Name of the road it belongs to.
    pub road: String,
    /// The junction it leads through.
    pub junction: Option<JunctionId>,
    /// Cross-sections, at least two, about half a metre apart.
    pub points: Vec<LanePoint>,
    /// Line on the left edge, by ascending `s`; empty: unknown.
    pub left_marks: Vec<Mark>,
    /// Line on the right edge.
    pub right_marks: Vec<Mark>,
    /// Adjacent drivable lanes, indexed by [`Neighbour::index`].
    pub neighbours: [Option<LaneId>; 4],
    /// Lanes that lead here.
    pub predecessors: Vec<LaneId>,
    /// Lanes to go on to.
    pub successors: Vec<LaneId>,
}

impl Lane {
    /// Length of the centre line, m.
    pub fn length(&self) -> f64 {
        self.points.last().map_or(0.0, |p| p.s)
    }

    /// The adjacent lane of one kind.
    pub fn neighbour(&self, kind: Neighbour) -> Option<LaneId> {
        self.neighbours[kind.index()]
    }

    /// The cross-section at `s`, clamped to the lane. Linear between samples; headings take the short way.
    pub fn at(&self, s: f64) -> LanePoint {
        let above = self
            .points
            .partition_point(|p| p.s <= s)
            .clamp(1, self.points.len() - 1);
        let (a, b) = (&self.points[above - 1], &self.points[above]);
        let s = s.clamp(a.s.min(s.max(self.points[0].s)), b.s);
        let t = (s - a.s) / (b.s - a.s);
        let mix = |x: f64, y: f64| x + (y - x) * t;
        LanePoint {
            s,
            x: mix(a.x, b.x),
            y: mix(a.y, b.y),
            theta: crate::geometry::angle::wrap(
                a.theta + crate::geometry::angle::difference(b.theta, a.theta) * t,
            ),
            kappa: mix(a.kappa, b.kappa),
            left: mix(a.left, b.left),
            right: mix(a.right, b.right),
            road_left: mix(a.road_left, b.road_left),
            road_right: mix(a.road_right, b.road_right),
            speed_limit: a.speed_limit,
        }
    }

    /// The station of the place on the centre line that is nearest to `point`, m.
    pub fn station_of(&self, point: Vec2) -> f64 {
        let foot = |pair: &[LanePoint]| {
            let (a, b) = (Vec2::new(pair[0].x, pair[0].y), Vec2::new(pair[1].x, pair[1].y));
            let along = b - a;
            let t = ((point - a).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            (
                (point - a - along * t).norm_squared(),
                pair[0].s + (pair[1].s - pair[0].s) * t,
            )
        };
        let nearest = self
            .points
            .windows(2)
            .map(foot)
            .min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map_or(0.0, |(_, s)| s)
    }

    /// The line on `side` at `s`.
    pub fn mark(&self, side: Side, s: f64) -> BoundaryType {
        let marks = match side {
            Side::Left => &self.left_marks,
            Side::Right => &self.right_marks,
        };
        let past = marks.partition_point(|m| m.s <= s);
        marks
            .get(past.saturating_sub(1))
            .map_or(BoundaryType::Unknown, |m| m.kind)
    }
}
