//! How it drives, not only where: stops are eased and final, and the path stays where it is while nothing changes.

use crate::support::{family, is_here, settings};
use corridor_decider::decision::PathPoint;
use corridor_sim::closed_loop::Sink;
use corridor_sim::run::run_into;
use corridor_sim::trace::{TickRecord, TraceError};

/// Planning period, s.
const TICK: f64 = 0.1;

/// Keeps all ticks.
#[derive(Default)]
struct Ticks(Vec<TickRecord>);

impl Sink for Ticks {
    fn tick(&mut self, tick: &TickRecord) -> Result<(), TraceError> {
        self.0.push(tick.clone());
        Ok(())
    }
}

fn drive(name: &str, seed: u64) -> Vec<TickRecord> {
    let mut ticks = Ticks::default();
    let scenario = family(name).draw(seed).unwrap().scenario;
    run_into(&scenario, &settings(&[]), &mut ticks).unwrap();
    ticks.0
}

/// Largest change of acceleration from tick to tick, m/s³, and when.
fn largest_jerk(ticks: &[TickRecord]) -> (f64, f64) {
    let jerk = |pair: &[TickRecord]| ((pair[1].ego.a - pair[0].ego.a).abs() / TICK, pair[1].frame.time);
    ticks.windows(2).map(jerk).fold(
        (0.0, 0.0),
        |worst, here| if here.0 > worst.0 { here } else { worst },
    )
}

/// How often acceleration turns back by more than 0.3 m/s².
fn turns(ticks: &[TickRecord]) -> u32 {
    let (mut turns, mut extreme, mut rising) = (0, ticks[0].ego.a, None);
    for tick in ticks {
        let a = tick.ego.a;
        match rising {
            Some(true) if a >= extreme => extreme = a,
            Some(false) if a <= extreme => extreme = a,
            _ if (a - extreme).abs() > 0.3 => {
                turns += u32::from(rising.is_some());
                (rising, extreme) = (Some(a > extreme), a);
            }
            _ => {}
        }
    }
    turns
}

/// Time spent rolling slower than walking, s.
fn creeping(ticks: &[TickRecord]) -> f64 {
    ticks
        .iter()
        .filter(|tick| (0.03..0.7).contains(&tick.ego.v))
        .count() as f64
        * TICK
}

#[test]
fn a_stop_before_what_blocks_the_road_is_eased_and_final() {
    for (name, seed) in [
        ("blocked_both_lanes", 1),
        ("double_parked", 3),
        ("cone_gate", 1),
        ("cone_gate", 2),
    ] {
        let ticks = drive(name, seed);
        let (jerk, time) = largest_jerk(&ticks);
        assert!(jerk < 5.0, "{name} {seed}: jerk {jerk} m/s³ at {time} s");
        let turns = turns(&ticks);
        assert!(
            turns <= 1,
            "{name} {seed}: it brakes by fits and starts, {turns} times"
        );
        let last = &ticks[ticks.len() - 1];
        assert!(
            last.ego.v.abs() < 1e-3,
            "{name} {seed}: it rolls at {} m/s",
            last.ego.v
        );
        // Beside the cones of the gate stand walls that are nearer than what blocks.
        if name == "cone_gate" {
            continue;
        }
        let (gap, _) = last.clearance.unwrap();
        assert!(
            (5.5..7.0).contains(&gap),
            "{name} {seed}: it stands {gap} m before it"
        );
    }
}

#[test]
fn at_the_kerb_it_stops_without_a_jolt() {
    for name in ["pull_over_between_parked", "pull_over_empty_kerb"] {
        let (jerk, time) = largest_jerk(&drive(name, 1));
        assert!(jerk < 6.0, "{name}: jerk {jerk} m/s³ at {time} s");
    }
}

#[test]
fn behind_a_standing_leader_it_stands() {
    for seed in 1..=5 {
        let ticks = drive("hard_braking_leader", seed);
        let (jerk, time) = largest_jerk(&ticks);
        assert!(jerk < 6.0, "seed {seed}: jerk {jerk} m/s³ at {time} s");
        let creeping = creeping(&ticks);
        assert!(creeping < 3.0, "seed {seed}: it creeps for {creeping} s");
    }
}

/// How far ahead a path is about to be driven, m: farther on, what comes into view may still change it.
const SOON: f64 = 30.0;

/// The farthest that two paths lie apart at the same station of the next metres, m, and where.
fn jump(before: &[PathPoint], after: &[PathPoint]) -> (f64, f64) {
    let offset = |point: &PathPoint| {
        let above = before.partition_point(|p| p.s <= point.s);
        let (a, b) = (before.get(above.checked_sub(1)?)?, before.get(above)?);
        Some(a.l + (b.l - a.l) * (point.s - a.s) / (b.s - a.s))
    };
    after
        .iter()
        .take_while(|point| point.distance < SOON)
        .filter_map(|point| Some(((offset(point)? - point.l).abs(), point.s)))
        .fold(
            (0.0, 0.0),
            |worst, here| if here.0 > worst.0 { here } else { worst },
        )
}

/// The bound that is driven, if it is the same one along the same line in both ticks.
fn is_same_bound(before: &TickRecord, after: &TickRecord) -> bool {
    let label = |tick: &TickRecord| {
        let decision = &tick.decision;
        Some((
            decision.candidates.get(decision.chosen?)?.bound.label,
            decision.line,
        ))
    };
    before.lines == after.lines && label(before).is_some() && label(before) == label(after)
}

#[test]
fn the_path_stays_where_it_is_while_nothing_changes() {
    let runs = [
        ("cone_taper", 1),
        ("two_cones", 1),
        ("double_parked", 1),
        ("double_parked", 6),
        ("curves_stopped_car", 2),
        ("nudge_sweep", 3),
        ("straight_blocked", 4),
        ("straight_blocked", 5),
        ("lane_change_left", 1),
    ];
    for (name, seed) in runs.into_iter().filter(|(name, _)| is_here(name)) {
        let ticks = drive(name, seed);
        for pair in ticks.windows(2).filter(|pair| is_same_bound(&pair[0], &pair[1])) {
            let (apart, s) = jump(&pair[0].decision.path, &pair[1].decision.path);
            let time = pair[1].frame.time;
            assert!(
                apart < 0.4,
                "{name} {seed} at {time} s: the path jumps by {apart} m at {s} m"
            );
        }
    }
}
