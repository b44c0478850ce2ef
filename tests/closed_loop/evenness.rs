//! How even the reference lines of a drive are: along each line, and from each tick to the next.
//!
//! Metres and radians. From tick to tick the lines of one lane are compared where both lie in it, from the ego to as
//! far ahead as is planned.

use corridor_decider::geometry::{Vec2, angle};
use corridor_decider::reference_line::{LineQuery, ReferenceLine};
use corridor_sim::trace::{TickRecord, Trace};
use std::fmt;
use std::sync::Arc;

/// Length ahead of the ego that is planned on, m.
const PLANNED: u32 = 100;

/// Stretch at the end of a line that may still move when the line grows, m: what lies beyond it was not known.
const OPEN_END: f64 = 20.0;

/// How far beside an ego its own line may be, m: of lines farther off it is not clear which belongs to which.
const BESIDE: f64 = 1.0;

/// The largest unevennesses of a drive.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Evenness {
    /// Change of heading along a line beyond what the curvature makes it turn, rad.
    pub(crate) heading: f64,
    /// Change of curvature along a line, per metre, 1/m².
    pub(crate) curvature: f64,
    /// From tick to tick: station of the ego, m.
    pub(crate) s_jump: f64,
    /// Place of the line, m.
    pub(crate) l_jump: f64,
    /// Its heading, rad.
    pub(crate) heading_jump: f64,
    /// Its curvature, 1/m.
    pub(crate) curvature_jump: f64,
    /// How many times a line gave way to another one of the same lane.
    pub(crate) grown: usize,
}

impl fmt::Display for Evenness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "heading within {:.1e} rad and curvature within {:.1e} 1/m per metre; over {} growths of a line: \
             s {:.1e} m, l {:.1e} m, heading {:.1e} rad, curvature {:.1e} 1/m",
            self.heading,
            self.curvature,
            self.grown,
            self.s_jump,
            self.l_jump,
            self.heading_jump,
            self.curvature_jump
        )
    }
}

impl Evenness {
    pub(crate) fn of(trace: &Trace) -> Self {
        let mut worst = Self::default();
        for line in &trace.header.lines {
            worst.along(line);
        }
        for pair in trace.ticks.windows(2) {
            worst.between(&trace.header.lines, &pair[0], &pair[1]);
        }
        worst
    }

    fn along(&mut self, line: &ReferenceLine) {
        for pair in line.samples().windows(2) {
            let (a, b) = (pair[0].point, pair[1].point);
            let ds = pair[1].s - pair[0].s;
            let turned = angle::difference(b.theta, a.theta) - f64::midpoint(a.kappa, b.kappa) * ds;
            raise(&mut self.heading, turned);
            raise(&mut self.curvature, (b.kappa - a.kappa) / ds);
        }
    }

    /// The ego's own lines of two ticks, where they are not one and the same.
    fn between(&mut self, lines: &[Arc<ReferenceLine>], before: &TickRecord, after: &TickRecord) {
        let own = |tick: &TickRecord| tick.lines.iter().find(|(_, is_change)| !is_change).copied();
        let (Some((old, _)), Some((new, _))) = (own(before), own(after)) else {
            return;
        };
        let (old, new) = (&lines[old], &lines[new]);
        let here = before.ego.pose.position();
        if Arc::ptr_eq(old, new)
            || new.to_frenet(here).l.abs() > BESIDE
            || old.to_frenet(here).l.abs() > BESIDE
        {
            return;
        }
        let (there, then) = (old.to_frenet(here).s, new.to_frenet(here).s);
        if old.sample_at(there).lane != new.sample_at(then).lane {
            return;
        }
        self.grown += 1;
        raise(&mut self.s_jump, then - there);
        let reach = (0..PLANNED).map(|k| then + f64::from(k));
        for s in reach.take_while(|s| *s < new.length()) {
            let point = new.point(s);
            let at = old.to_frenet_near(Vec2::new(point.x, point.y), s - then + there);
            if at.s >= old.length() - OPEN_END || old.sample_at(at.s).lane != new.sample_at(s).lane {
                break;
            }
            let known = old.point(at.s);
            raise(&mut self.l_jump, at.l);
            raise(
                &mut self.heading_jump,
                angle::difference(point.theta, known.theta),
            );
            raise(&mut self.curvature_jump, point.kappa - known.kappa);
        }
    }
}

fn raise(worst: &mut f64, value: f64) {
    *worst = worst.max(value.abs());
}
