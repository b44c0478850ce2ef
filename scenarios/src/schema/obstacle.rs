//! Obstacles in a scenario file: one array of tables per behaviour.
//!
//! Arrays per behaviour, not one array with a `type` key, because tagged tables lose the place of a mistake.
//! All of them share the keys of a body and of a place; a macro writes these out into each struct, since
//! flattened structs lose the place as well.

use super::number::{
    Acceleration, Angle, Count, Duration, Length, Metres, MovingSpeed, Number, Seconds, Share, Size, Speed,
    Swing,
};
use corridor_decider::frame::ObstacleKind;
use corridor_decider::geometry::{ConvexPolygon, Vec2};
use corridor_decider::road::Side;
use serde::Deserialize;

/// Which lane a place refers to, seen from the ego's lane at that station.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LaneChoice {
    /// The lane of the route.
    #[default]
    Own,
    /// The lane to the left whose traffic goes our way.
    Left,
    /// The lane to the right whose traffic goes our way.
    Right,
    /// The lane to the left whose traffic comes towards us.
    Oncoming,
}

/// What `l` counts from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Datum {
    /// The lane's centre line to the body's centre, left positive.
    #[default]
    Centre,
    /// The right edge of the road surface to the nearer side of the body, inwards positive.
    RightEdge,
    /// The left edge of the road surface to the nearer side of the body, inwards positive.
    LeftEdge,
    /// The lane's right edge to the farther side of the body: how far it reaches into the lane.
    RightLaneLine,
    /// The lane's left edge to the farther side of the body: how far it reaches into the lane.
    LeftLaneLine,
}

/// Keys that every obstacle has: its body and where it is.
#[derive(Clone, Copy, Debug)]
pub struct Common<'a> {
    /// Name for people; the place in the file when absent.
    pub name: Option<&'a str>,
    /// Class.
    pub kind: Option<ObstacleKind>,
    /// Length instead of the class's.
    pub length: Option<&'a Number<Size>>,
    /// Width instead of the class's.
    pub width: Option<&'a Number<Size>>,
    /// Outline instead of a rectangle.
    pub polygon: Option<&'a Outline>,
    /// Lane that the place refers to.
    pub lane: LaneChoice,
    /// What `l` counts from.
    pub from: Datum,
    /// Station of the centre ahead of the ego's rear axle, along the route.
    pub ahead: &'a Number<Metres>,
    /// Lateral place.
    pub l: Option<&'a Number<Metres>>,
}

macro_rules! obstacle {
    ($(#[$doc:meta])* $name:ident { $($(#[$field_doc:meta])* $field:ident: $kind:ty,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Debug, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub struct $name {
            name: Option<String>,
            kind: Option<ObstacleKind>,
            length: Option<Number<Size>>,
            width: Option<Number<Size>>,
            polygon: Option<Outline>,
            #[serde(default)]
            lane: LaneChoice,
            #[serde(default)]
            from: Datum,
            ahead: Number<Metres>,
            l: Option<Number<Metres>>,
            $($(#[$field_doc])* pub $field: $kind,)*
        }

        impl $name {
            /// The keys that every obstacle has.
            pub fn common(&self) -> Common<'_> {
                Common {
                    name: self.name.as_deref(),
                    kind: self.kind,
                    length: self.length.as_ref(),
                    width: self.width.as_ref(),
                    polygon: self.polygon.as_ref(),
                    lane: self.lane,
                    from: self.from,
                    ahead: &self.ahead,
                    l: self.l.as_ref(),
                }
            }
        }
    };
}

obstacle!(
    /// Stands for the whole run: one, or a row of them.
    Parked {
        /// Heading relative to the lane's driving direction, rad.
        heading: Option<Number<Angle>>,
        /// How many in the row.
        count: Option<Number<Count>>,
        /// Clear distance from each to the next, m; drawn anew for each.
        spacing: Option<Number<Length>>,
        /// A door that someone opens.
        door: Option<Door>,
    }
);
obstacle!(
    /// Drives at constant speed along its lane.
    Moving {
        /// Speed, m/s.
        speed: Number<Speed>,
    }
);
obstacle!(
    /// Drives by the Intelligent Driver Model along its lane.
    Idm {
        /// Speed at the start, m/s.
        speed: Number<Speed>,
        /// Speed on a free road, m/s; that at the start when absent.
        desired_speed: Option<Number<MovingSpeed>>,
        /// Time gap to the leader, s.
        time_gap: Option<Number<Seconds>>,
        /// Gap at standstill, m.
        min_gap: Option<Number<Length>>,
        /// Acceleration on a free road, m/s².
        max_acceleration: Option<Number<Acceleration>>,
        /// Comfortable braking, m/s², positive.
        comfortable_braking: Option<Number<Acceleration>>,
        /// A change of lane on the way.
        lane_change: Option<LaneChange>,
        /// Changes lanes where it gets on better.
        mobil: Option<Mobil>,
    }
);
obstacle!(
    /// Passes through places at given times, from its own place at the start of the run.
    Scripted {
        /// Heading at the start relative to the lane's driving direction, rad.
        heading: Option<Number<Angle>>,
        /// Where it goes on to, by ascending time.
        waypoints: Vec<Waypoint>,
        /// What its timetable begins with; the start of the run when absent.
        when: Option<When>,
    }
);
obstacle!(
    /// Walks across the road along a straight line.
    Pedestrian {
        /// Lateral end of the walk, m from the centre of the ego's lane, left positive.
        to: Number<Metres>,
        /// Station of the end of the walk ahead of the ego's rear axle; that of the start when absent.
        to_ahead: Option<Number<Metres>>,
        /// Walking speed, m/s.
        speed: Number<MovingSpeed>,
        /// What sets it off.
        when: When,
    }
);

/// What sets an obstacle moving.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum When {
    /// A time since the start of the run, s.
    At(Number<Seconds>),
    /// The ego's rear axle comes this near, m.
    Within(Number<Length>),
}

/// A change of lane of another car.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LaneChange {
    /// Lateral place at its end, m from the centre of the ego's lane, left positive.
    pub to: Number<Metres>,
    /// How long it takes, s.
    pub duration: Number<Duration>,
    /// What sets it off.
    pub when: When,
}

/// The door of a parked car, hinged at its front end.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Door {
    /// On which side of the car.
    pub side: Side,
    /// Length instead of the usual one, m.
    pub length: Option<Number<Size>>,
    /// Place of the hinge ahead of the car's centre instead of the usual one, m.
    pub hinge: Option<Number<Metres>>,
    /// How far it opens, rad.
    pub angle: Number<Swing>,
    /// How long opening takes, s.
    pub duration: Number<Duration>,
    /// How long it stays open, s; for good when absent.
    pub stays: Option<Number<Duration>>,
    /// What opens it.
    pub when: When,
}

/// A lane of the same direction that a driver may choose, seen from that of the line it drives along.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LaneAlong {
    /// The line's own.
    Own,
    /// The next to the left.
    Left,
    /// The next to the right.
    Right,
}

/// Changes of lane by the model MOBIL.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mobil {
    /// The lanes to choose among; all that there are at its start when absent.
    pub lanes: Option<Vec<LaneAlong>>,
    /// How much the acceleration of the others counts, compared with its own.
    pub politeness: Option<Number<Share>>,
    /// Gain in acceleration from which on it changes, m/s².
    pub threshold: Option<Number<Acceleration>>,
    /// Hardest braking that it asks of its new follower, m/s², positive.
    pub safe_braking: Option<Number<Acceleration>>,
    /// How long a change takes, s.
    pub duration: Option<Number<Duration>>,
}

/// A place to be in at a time.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Waypoint {
    /// Seconds after the waypoint before, or after the start of the run.
    pub after: Number<Duration>,
    /// Station ahead of the ego's rear axle at the start, m.
    pub ahead: Number<Metres>,
    /// Lateral place, m from the centre of the ego's lane, left positive.
    pub l: Option<Number<Metres>>,
    /// Heading relative to the ego's lane; that of the leg that leads here when absent.
    pub heading: Option<Number<Angle>>,
}

/// A convex outline around the obstacle's centre, `x` forward, m.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "Vec<[f64; 2]>")]
pub struct Outline(pub ConvexPolygon);

impl TryFrom<Vec<[f64; 2]>> for Outline {
    type Error = String;

    fn try_from(points: Vec<[f64; 2]>) -> Result<Self, String> {
        let corners: Vec<Vec2> = points.iter().map(|[x, y]| Vec2::new(*x, *y)).collect();
        if let Some(far) = corners.iter().find(|c| !c.iter().all(|v| v.abs() <= 50.0)) {
            return Err(format!(
                "corner `[{}, {}]` is more than 50 m from the obstacle's centre",
                far.x, far.y
            ));
        }
        let hull = ConvexPolygon::hull(&corners)
            .ok_or("the corners span no area: expected at least three, not in one line")?;
        if hull.vertices().len() < corners.len() {
            return Err("the outline is not convex: a corner lies inside the others".to_owned());
        }
        Ok(Self(hull))
    }
}
