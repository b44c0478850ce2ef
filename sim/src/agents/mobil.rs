//! Choosing a lane by MOBIL (Kesting, Treiber, Helbing, "General lane-changing model MOBIL for car-following models",
//! 2007): a driver changes where it gains more acceleration than the others lose, and nobody has to brake hard.
//!
//! With `c` the driver, `o` and `n` its old and its new follower, and `ã` an acceleration after the change, it changes
//! when `ã_c − a_c + p (ã_n − a_n + ã_o − a_o) > Δa` and `ã_n ≥ −b_safe`. It takes the others to drive as it does itself.

use super::along_line::LineFollower;
use super::idm::acceleration;
use super::leader::{Body, Leader, Neighbours, neighbours_at};
use corridor_scenarios::scenario::{IdmParams, LateralMove, Mobil, Trigger};

/// Lanes whose centres are nearer than this are the same one, m: half a narrow lane.
const SAME_LANE: f64 = 1.2;

/// Below this speed nobody changes, m/s: a car does not slide sideways.
const LEAST_SPEED: f64 = 2.0;

/// How long one stays in a lane before looking for another, s.
const REST: f64 = 3.0;

/// Drivers look for lanes by turns, each at one of so many looks at the traffic: two who want the same gap do not take it
/// in the same moment, and the second sees the signal of the first.
const TURNS: usize = 5;

/// A driver's wish for a better lane.
#[derive(Clone, Debug)]
pub(super) struct LaneChooser {
    mobil: Mobil,
    looks: usize,
    rests_until: f64,
}

impl LaneChooser {
    pub(super) fn new(mobil: Mobil) -> Self {
        Self {
            mobil,
            looks: 0,
            rests_until: 0.0,
        }
    }

    /// It is in its new lane.
    pub(super) fn rest(&mut self, time: f64) {
        self.rests_until = time + REST;
    }

    /// The change of lane that is best now, if one is worth it and safe; of equal ones the first.
    pub(super) fn look(
        &mut self,
        follower: &LineFollower,
        params: &IdmParams,
        (place, bodies): (usize, &[Body]),
        time: f64,
    ) -> Option<LateralMove> {
        self.looks += 1;
        let is_my_turn = (self.looks + place).is_multiple_of(TURNS);
        if !is_my_turn || time < self.rests_until || follower.speed < LEAST_SPEED {
            return None;
        }
        let own = &bodies[place];
        let around = |l: f64| {
            let others = bodies.iter().enumerate().filter(|(k, _)| *k != place);
            neighbours_at(follower, own, l, others.map(|(_, body)| body))
        };
        let driver = Driver {
            params,
            speed: follower.speed,
            length: own.length(),
        };
        let here = around(follower.l);
        let mut best: Option<(f64, f64)> = None;
        for lane in self
            .mobil
            .lanes
            .iter()
            .copied()
            .filter(|lane| self.is_next(*lane, follower.l))
        {
            let gain = driver.gain(&self.mobil, &here, &around(lane));
            if let Some(gain) = gain.filter(|gain| best.is_none_or(|(most, _)| *gain > most)) {
                best = Some((gain, lane));
            }
        }
        let (_, to_l) = best.filter(|(gain, _)| *gain > self.mobil.threshold)?;
        Some(LateralMove {
            trigger: Trigger::Time(0.0),
            to_l,
            duration: self.mobil.duration,
        })
    }

    /// Whether a lane is another one than that at `l`, with none between.
    fn is_next(&self, lane: f64, l: f64) -> bool {
        let is_between = |other: f64| (other - l) * (lane - other) > 0.0 && (other - l).abs() > SAME_LANE;
        let is_other = (lane - l).abs() > SAME_LANE;
        is_other
            && !self
                .mobil
                .lanes
                .iter()
                .any(|other| (lane - other).abs() > SAME_LANE && is_between(*other))
    }
}

/// What of a driver enters the model.
struct Driver<'a> {
    params: &'a IdmParams,
    speed: f64,
    length: f64,
}

impl Driver<'_> {
    /// What a change from among `here` to among `there` gains, m/s², the others' losses counted; `None` when it is unsafe.
    fn gain(&self, mobil: &Mobil, here: &Neighbours, there: &Neighbours) -> Option<f64> {
        let is_beside = |other: Option<Leader>| other.is_some_and(|other| other.gap <= 0.0);
        if is_beside(there.ahead) || is_beside(there.behind) {
            return None;
        }
        let own = |ahead| acceleration(self.params, self.speed, ahead);
        let after = own(there.ahead);
        let (new_before, new_after) = self.follower(there);
        let (old_after, old_before) = self.follower(here);
        if new_after < -mobil.safe_braking || after < -mobil.safe_braking {
            return None;
        }
        Some(after - own(here.ahead) + mobil.politeness * (new_after - new_before + old_after - old_before))
    }

    /// Acceleration of the one behind, without this driver before it and with it.
    fn follower(&self, lane: &Neighbours) -> (f64, f64) {
        let Some(behind) = lane.behind else {
            return (0.0, 0.0);
        };
        let speed = behind.speed.max(0.0);
        let params = IdmParams {
            desired_speed: self.params.desired_speed.max(speed),
            ..*self.params
        };
        let beyond = lane.ahead.map(|ahead| Leader {
            gap: behind.gap + self.length + ahead.gap,
            ..ahead
        });
        let before_it = Leader {
            gap: behind.gap,
            speed: self.speed,
        };
        (
            acceleration(&params, speed, beyond),
            acceleration(&params, speed, Some(before_it)),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PARAMS: IdmParams = IdmParams {
        desired_speed: 20.0,
        time_gap: 1.5,
        min_gap: 2.0,
        max_acceleration: 1.4,
        comfortable_braking: 2.0,
    };

    fn driver(speed: f64) -> Driver<'static> {
        Driver {
            params: &PARAMS,
            speed,
            length: 4.6,
        }
    }

    fn at(gap: f64, speed: f64) -> Leader {
        Leader { gap, speed }
    }

    fn mobil(politeness: f64) -> Mobil {
        Mobil {
            politeness,
            ..Mobil::default()
        }
    }

    #[test]
    fn a_free_lane_beside_a_slow_leader_gains_what_the_leader_costs() {
        // By hand, at 10 m/s behind 5 m/s at 20 m: s* = 2 + 15 + 10·5/(2√2.8) = 31.940; 1.4·(31.940/20)² = 3.5706.
        let here = Neighbours {
            ahead: Some(at(20.0, 5.0)),
            behind: None,
        };
        let gain = driver(10.0)
            .gain(&mobil(0.2), &here, &Neighbours::default())
            .unwrap();
        assert!((gain - 3.5706).abs() < 1e-3, "{gain}");
        let nothing = driver(10.0).gain(&mobil(0.2), &Neighbours::default(), &Neighbours::default());
        assert_eq!(nothing, Some(0.0));
    }

    #[test]
    fn the_polite_count_what_the_new_follower_loses_and_the_old_one_gains() {
        let there = Neighbours {
            ahead: None,
            behind: Some(at(15.0, 10.0)),
        };
        // The new follower, at 10 m/s, has 10 m/s before it at 15 m: s* = 17; it loses 1.4·(17/15)² = 1.7982.
        let selfless = |p| {
            driver(10.0)
                .gain(&mobil(p), &Neighbours::default(), &there)
                .unwrap()
        };
        assert!(selfless(0.0).abs() < 1e-12);
        assert!((selfless(0.5) + 0.5 * 1.7982).abs() < 1e-3, "{}", selfless(0.5));
        // The old one gains the same, were it the lane that is left.
        let gain = driver(10.0)
            .gain(&mobil(0.5), &there, &Neighbours::default())
            .unwrap();
        assert!((gain - 0.5 * 1.7982).abs() < 1e-3, "{gain}");
        // With a leader 20 m ahead the follower there had 15 + 4.6 + 20 m before, to 10 m/s: it loses less.
        let full = Neighbours {
            ahead: Some(at(20.0, 10.0)),
            ..there
        };
        let loss = 1.4 * (17.0_f64 / 15.0) * (17.0 / 15.0) - 1.4 * (17.0_f64 / 39.6) * (17.0 / 39.6);
        let own = 1.4 * (17.0_f64 / 20.0) * (17.0 / 20.0);
        let gain = driver(10.0)
            .gain(&mobil(1.0), &Neighbours::default(), &full)
            .unwrap();
        assert!((gain + own + loss).abs() < 1e-9, "{gain}");
    }

    #[test]
    fn nobody_is_cut_off() {
        let fast_behind = |gap| Neighbours {
            ahead: None,
            behind: Some(at(gap, 18.0)),
        };
        let gain = |there: Neighbours| driver(10.0).gain(&mobil(0.0), &Neighbours::default(), &there);
        // s* = 2 + 27 + 18·8/(2√2.8) = 72.03: 1.4·(1 − 0.6561 − (72.03/40)²) = −4.06 at 40 m, −3.18 at 45 m.
        assert_eq!(gain(fast_behind(40.0)), None);
        assert!(gain(fast_behind(45.0)).is_some());
        assert_eq!(gain(fast_behind(-0.5)), None, "beside");
        let beside = Neighbours {
            ahead: Some(at(-1.0, 10.0)),
            behind: None,
        };
        assert_eq!(gain(beside), None);
    }

    #[test]
    fn only_the_next_lane_is_chosen() {
        let chooser = LaneChooser::new(Mobil {
            lanes: vec![0.0, 3.5, -3.5],
            ..Mobil::default()
        });
        let next = |l: f64| -> Vec<f64> {
            let lanes = chooser.mobil.lanes.iter().copied();
            lanes.filter(|lane| chooser.is_next(*lane, l)).collect()
        };
        assert_eq!(next(0.1), [3.5, -3.5]);
        assert_eq!(next(-3.4), [0.0]);
        assert_eq!(next(3.6), [0.0]);
    }
}
