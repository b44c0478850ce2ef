//! Random problems of the three kinds, as a planner would pose them: some without a solution.

use crate::piecewise_jerk::{
    FallbackSpeedProblem, JerkCoupling, Limits, PathProblem, PathWeights, Problem, SpeedProblem,
    SpeedWeights, State, Term,
};

/// A stream of numbers that is the same everywhere (Steele, Lea and Flood 2014: `SplitMix64`).
pub(super) struct Draw(pub u64);

impl Draw {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        let share = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        low + share * (high - low)
    }

    pub(super) fn count(&mut self, low: usize, high: usize) -> usize {
        let span = u64::try_from(high - low + 1).expect("small");
        low + usize::try_from(self.next() % span).expect("small")
    }

    fn happens(&mut self, chance: f64) -> bool {
        self.between(0.0, 1.0) < chance
    }
}

/// A lane with obstacles that cut in from either side, and a curved reference line.
pub(super) fn path(draw: &mut Draw) -> PathProblem {
    let n = draw.count(20, 200);
    let speed = draw.between(0.0, 20.0);
    let half = draw.between(0.4, 1.9);
    let mut l = vec![(-half, half); n];
    for _ in 0..draw.count(0, 4) {
        let first = draw.count(0, n - 1);
        let last = (first + draw.count(2, 30)).min(n);
        let reach = draw.between(0.1, 1.2);
        let left = draw.happens(0.5);
        for (low, high) in &mut l[first..last] {
            if left {
                *high = (half - reach).max(*low + 0.05).min(*high);
            } else {
                *low = (reach - half).min(*high - 0.05).max(*low);
            }
        }
    }
    let (bend, change) = (draw.between(-0.03, 0.03), draw.between(-0.03, 0.03));
    let kappa = |i: usize| bend + (change - bend) * (i as f64 / n as f64);
    let end = if draw.happens(0.2) {
        draw.between(-half, half)
    } else {
        0.0
    };
    PathProblem {
        delta_s: 0.5,
        initial: State {
            x: draw.between(-0.7, 0.7) * half,
            dx: draw.between(-0.03, 0.03),
            ddx: draw.between(-0.005, 0.005),
        },
        l,
        dl: (-2.0, 2.0),
        ddl: (0..n).map(|i| (-0.1979 - kappa(i), 0.1979 - kappa(i))).collect(),
        dddl: 0.093_94 / speed.max(1.0),
        weights: PathWeights {
            dl: 20.0 * (speed * speed).max(5.0),
            ..PathWeights::default()
        },
        l_reference: if end == 0.0 {
            Vec::new()
        } else {
            vec![Term::new(10.0, end); n]
        },
        end_reference: State {
            x: end,
            ..State::default()
        },
        coupling: JerkCoupling::Symmetric,
    }
}

/// A car that follows, stops or overtakes on a road with a speed limit that changes.
pub(super) fn speed(draw: &mut Draw) -> SpeedProblem {
    let n = draw.count(41, 81);
    let delta = 0.1;
    let time = |i: usize| i as f64 * delta;
    let v0 = draw.between(0.0, 16.0);
    let mut s: Vec<Limits> = vec![(0.0, draw.between(30.0, 150.0)); n];
    match draw.count(0, 3) {
        0 => {}
        1 => {
            let stop = draw.between(0.2, 1.6) * (1.0 + v0 * v0 / 8.0);
            for (_, high) in &mut s {
                *high = high.min(stop);
            }
        }
        2 => {
            let (gap, lead) = (draw.between(1.0, 30.0), draw.between(0.0, 15.0));
            let since = draw.count(0, n / 2);
            let knots = s.iter_mut().enumerate().skip(since);
            knots.for_each(|(i, (_, high))| *high = high.min(gap + lead * time(i)));
        }
        _ => {
            let (since, pace) = (draw.count(n / 3, n - 1), draw.between(1.0, 8.0));
            let knots = s.iter_mut().enumerate().skip(since);
            knots.for_each(|(i, (low, high))| *low = (pace * time(i - since)).min(*high - 1.0));
        }
    }
    let (limit, later) = (
        draw.between(0.9, 1.5) * v0 + 2.0,
        draw.between(0.7, 1.3) * v0 + 2.0,
    );
    let cruise = draw.between(3.0, 16.0);
    let bend = draw.between(0.0, 0.05) * f64::from(u8::from(draw.happens(0.4)));
    SpeedProblem {
        delta_t: delta,
        initial: State {
            x: 0.0,
            dx: v0,
            ddx: draw.between(-2.0, 1.0),
        },
        v: (0..n)
            .map(|i| (0.0, if time(i) < 3.0 { limit } else { later }))
            .collect(),
        a: (-6.0, 2.0),
        jerk: (-4.0, 2.0),
        weights: SpeedWeights::default(),
        s_ref: s
            .iter()
            .enumerate()
            .map(|(i, (low, high))| (cruise * time(i)).min(*high).max(*low))
            .collect(),
        v_ref: cruise,
        kappa: (0..n).map(|i| bend * (i % 40) as f64 / 40.0).collect(),
        s,
        coupling: JerkCoupling::Symmetric,
    }
}

/// A car that is to stop.
pub(super) fn fallback(draw: &mut Draw) -> FallbackSpeedProblem {
    FallbackSpeedProblem::shortest_stop(draw.between(0.0, 25.0), draw.between(-4.0, 1.8))
}

/// One problem of any kind.
pub(super) fn any(seed: u64) -> Problem {
    let mut draw = Draw(seed.wrapping_mul(0x5851_f42d_4c95_7f2d));
    match seed % 3 {
        0 => path(&mut draw).to_problem(),
        1 => speed(&mut draw).to_problem(),
        _ => fallback(&mut draw).to_problem(),
    }
}
