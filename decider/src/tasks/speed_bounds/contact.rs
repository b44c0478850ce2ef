//! The first stretch of a path along which the ego's body would touch an outline.
//!
//! In the frame of the body, what matters of an outline is the part within the body's width: its nearest and farthest
//! point say how far ahead or back the contact begins and ends if the path is straight. On a bend that is only a
//! guess, which is then tightened by halving.

use super::track::{Place, Track};
use crate::geometry::Vec2;
use crate::steps;

/// Ends of a stretch are found to this, m; what is added is added outside.
const TIGHT: f64 = 0.1;

/// Guesses along a bend before an end is taken as it is.
const MOST_GUESSES: u32 = 8;

/// A stretch of the path, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Where it begins for the rear axle.
    pub low: f64,
    /// Where it ends.
    pub high: f64,
}

/// What of an outline lies within the width of the body, along the body's axis, m.
#[derive(Clone, Copy)]
struct Reach {
    near: f64,
    far: f64,
}

impl Track {
    /// How far something around `center` with this radius is from touching the body anywhere on the path, at least, m;
    /// not positive where that cannot be told.
    pub(super) fn clearance(&self, center: Vec2, radius: f64) -> f64 {
        let squares = self
            .anchors
            .iter()
            .map(|anchor| (anchor.center - center).norm_squared());
        // Between two anchors the body is nearer to one of them than half their distance.
        let between = (self.front + self.back) * 0.5;
        squares.fold(f64::INFINITY, f64::min).sqrt() - (self.radius + radius + between)
    }

    /// The first stretch in which the body would touch an outline around `center`.
    pub(super) fn first_contact(&self, corners: &[Vec2], center: Vec2, radius: f64) -> Option<Contact> {
        let touching = (self.radius + radius) * (self.radius + radius);
        let near = |place: usize| (self.anchors[place].center - center).norm_squared() <= touching;
        let mut candidates = (0..self.anchors.len()).filter(|place| near(*place));
        let (place, reach) = candidates.find_map(|place| {
            let reach = self.touch(&self.anchors[place].place, corners)?;
            Some((place, reach))
        })?;
        let at = self.anchors[place].place.distance;
        let floor = match place {
            0 => 0.0,
            _ => self.anchors[place - 1].place.distance,
        };
        Some(Contact {
            low: self.low_end(corners, at, reach, floor),
            high: self.high_end(corners, at, reach),
        })
    }

    /// Where the contact at `at` begins. At `floor` there is none, unless that is the start of the path.
    fn low_end(&self, corners: &[Vec2], at: f64, reach: Reach, floor: f64) -> f64 {
        let (mut at, mut reach) = (at, reach);
        for _ in 0..MOST_GUESSES {
            let guess = (at + reach.near - self.front).max(floor);
            match self.touch_at(guess, corners) {
                Some(there) if guess > floor && at - guess > TIGHT => (at, reach) = (guess, there),
                Some(_) => return self.walked(corners, guess, floor),
                None => return self.tightened(corners, guess, at),
            }
        }
        floor
    }

    /// Where the contact at `at` ends.
    fn high_end(&self, corners: &[Vec2], at: f64, reach: Reach) -> f64 {
        let (mut at, mut reach) = (at, reach);
        let end = self.length();
        for _ in 0..MOST_GUESSES {
            let guess = (at + reach.far + self.back).min(end);
            match self.touch_at(guess, corners) {
                Some(there) if guess < end && guess - at > TIGHT => (at, reach) = (guess, there),
                Some(_) => return self.walked(corners, guess, end),
                None => return self.tightened(corners, guess, at),
            }
        }
        end
    }

    /// Where the contact at `from` ends towards `limit`, in growing steps: on a bend straight guesses come to rest before it.
    fn walked(&self, corners: &[Vec2], from: f64, limit: f64) -> f64 {
        let (mut touching, mut step) = (from, TIGHT.copysign(limit - from));
        while (limit - touching).abs() > f64::EPSILON {
            steps::count();
            let next = if step > 0.0 {
                (touching + step).min(limit)
            } else {
                (touching + step).max(limit)
            };
            if self.touch_at(next, corners).is_none() {
                return self.tightened(corners, next, touching);
            }
            touching = next;
            step *= 2.0;
        }
        limit
    }

    /// The free end of a stretch that holds an end of the contact, when it is at most [`TIGHT`] long.
    fn tightened(&self, corners: &[Vec2], free: f64, touching: f64) -> f64 {
        let mut free = free;
        let beside = free + TIGHT.copysign(touching - free);
        if (touching - free).abs() <= TIGHT || self.touch_at(beside, corners).is_some() {
            return free;
        }
        free = beside;
        let mut touching = touching;
        while (touching - free).abs() > TIGHT {
            steps::count();
            let middle = f64::midpoint(free, touching);
            if self.touch_at(middle, corners).is_some() {
                touching = middle;
            } else {
                free = middle;
            }
        }
        free
    }

    fn touch_at(&self, distance: f64, corners: &[Vec2]) -> Option<Reach> {
        self.touch(&self.place_at(distance), corners)
    }

    /// What of an outline lies within the width of the body at a place, if the body touches it.
    fn touch(&self, place: &Place, corners: &[Vec2]) -> Option<Reach> {
        let local = |corner: Vec2| {
            let d = corner - place.position;
            (
                d.dot(&place.forward),
                place.forward.x * d.y - place.forward.y * d.x,
            )
        };
        let mut reach = Reach {
            near: f64::INFINITY,
            far: -f64::INFINITY,
        };
        let width = self.half_width;
        let mut before = local(*corners.last()?);
        for corner in corners {
            let now = local(*corner);
            if now.1.abs() < width {
                reach.include(now.0);
            }
            for edge in [-width, width] {
                if (before.1 < edge) != (now.1 < edge) {
                    let share = (edge - before.1) / (now.1 - before.1);
                    reach.include(before.0 + share * (now.0 - before.0));
                }
            }
            before = now;
        }
        (reach.near < self.front && reach.far > -self.back).then_some(reach)
    }
}

impl Reach {
    fn include(&mut self, x: f64) {
        self.near = self.near.min(x);
        self.far = self.far.max(x);
    }
}
