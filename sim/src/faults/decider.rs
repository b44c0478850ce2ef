//! Faults of the decider as a whole: answers that are none, come late or never, and a memory that does not hold.

use super::planted::Past;
use super::spec::{Plant, Spec, Stage};
use corridor_decider::context::Context;
use corridor_decider::decision::Decision;
use corridor_decider::frame::Frame;
use corridor_decider::planner::{LinePlan, TaskName};
use corridor_decider::steps;

/// The tick of sudden faults: late enough to be under way, early enough for every run.
const SUDDEN: u32 = 10;

/// Of so many ticks one panics in the rare fault.
const RARE: u64 = 1000;

/// Of so many ticks only one is decided anew by a planner that is too slow.
const SLOW: u32 = 10;

const fn on_decision(name: &'static str, what: &'static str, change: fn(&mut Decision, &mut Past)) -> Spec {
    Spec::new(name, what, Stage::Decider, Plant::Decision(change))
}

const fn on_answer(name: &'static str, what: &'static str, fail: fn(&Frame)) -> Spec {
    Spec::new(name, what, Stage::Decider, Plant::Answer(fail))
}

pub(super) const FAULTS: &[Spec] = &[
    on_answer("panic", "The decider panics in its eleventh tick.", |frame| {
        if frame.tick == SUDDEN {
            panicked();
        }
    }),
    on_answer(
        "panic_one_in_a_thousand",
        "The decider panics in one tick of a thousand.",
        |frame| {
            if mixed(frame).is_multiple_of(RARE) {
                panicked();
            }
        },
    ),
    on_answer(
        "answers_never",
        "From its eleventh tick on the decider goes on for ever.",
        |frame| {
            if frame.tick >= SUDDEN {
                loop {
                    steps::count();
                }
            }
        },
    ),
    on_decision(
        "nan",
        "From the eleventh tick on the last speed of the trajectory is no number.",
        |decision, past| {
            if past.tick() >= SUDDEN
                && let Some(point) = decision.trajectory.last_mut()
            {
                point.v = f64::NAN;
            }
        },
    ),
    on_decision(
        "empty_answer",
        "From the eleventh tick on path and trajectory have no points.",
        |decision, past| {
            if past.tick() >= SUDDEN {
                decision.path.clear();
                decision.trajectory.clear();
            }
        },
    ),
    on_decision(
        "trajectory_from_back_to_front",
        "The points of the trajectory come in the wrong order.",
        |decision, _| {
            decision.trajectory.reverse();
        },
    ),
    on_decision(
        "chosen_beside_the_list",
        "The place of the chosen candidate is counted from one.",
        |decision, _| {
            decision.chosen = decision.chosen.map(|place| place + 1);
        },
    ),
    on_decision(
        "answers_rarely",
        "Only every tenth tick is decided anew; in between the old answer is given as if it were new.",
        |decision, past| match &past.decision {
            Some(old) if !past.tick().is_multiple_of(SLOW) => decision.clone_from(old),
            _ => past.decision = Some(decision.clone()),
        },
    ),
    on_decision(
        "answers_the_frame_before",
        "Each answer is that to the frame before.",
        |decision, past| {
            let now = past.decision.replace(decision.clone());
            if let Some(before) = now {
                *decision = before;
            }
        },
    ),
    Spec::new(
        "memory_lost",
        "The decider forgets everything between two ticks.",
        Stage::Decider,
        Plant::Memory(|context| {
            *context = Context::default();
        }),
    ),
    Spec::new(
        "last_trajectory_lost",
        "Planning always starts from the measured car, never from the last trajectory.",
        Stage::Decider,
        Plant::Memory(|context| {
            context.last = None;
        }),
    ),
    Spec::new(
        "label_flips_each_tick",
        "In every other tick another of the bounds is driven that has a path.",
        Stage::Decider,
        Plant::HandsOn(TaskName::PathAssessment, flip),
    ),
];

/// A panic of the decider, without a word of the panic hook: it is planted.
fn panicked() {
    std::panic::resume_unwind(Box::new(String::from("a planted fault")));
}

/// A number that looks random and is the same for the same frame: the finaliser of splitmix64 over the tick and the place.
fn mixed(frame: &Frame) -> u64 {
    let pose = frame.ego.pose;
    let mut z = u64::from(frame.tick) ^ pose.x.to_bits() ^ pose.y.to_bits().rotate_left(32);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

fn flip(plan: &mut LinePlan, past: &mut Past) {
    let Some((chosen, _)) = plan.chosen.as_ref().filter(|_| past.tick() % 2 == 1) else {
        return;
    };
    let others = plan
        .candidates
        .iter()
        .enumerate()
        .filter(|(place, _)| place != chosen);
    let other = others
        .filter_map(|(place, found)| Some((place, found.as_ref()?.as_ref().ok()?.clone())))
        .next_back();
    if let Some((place, path)) = other {
        plan.chosen = Some((place, path));
    }
}
