//! What the lattice planner weighed in one tick, for the page: every curve, every pair with its costs and its fault.
//!
//! Some eighty longitudinal and a dozen lateral curves make 700 pairs, ten times a second. Curves and costs are written
//! as whole numbers in [`letters`], curves that come back are written once.
//! A tick takes 4.5 kB while the car moves in traffic and less when it stands, a minute 2 to 3 MB.

use super::letters::{differences, letters};
use super::thin;
use super::tick::Pools;
use crate::explain::words;
use crate::trace::Trace;
use corridor_decider::geometry::Vec2;
use corridor_decider::lattice::{
    Assessed, BackupPair, Curve, Kind, LongitudinalCosts, Outcome, PathTimeEntry, Rejection, Survey, TIMES,
    Unfit,
};
use corridor_decider::planner::LatticeSurvey;
use serde::Serialize;

/// Places of the grid between two points of a longitudinal curve that the page gets: half a second. Between them the
/// hardest braking is off by less than 0.2 m, half a pixel. Ways are told to 0.1 m.
const TIME_STEP: usize = 5;

/// Way over which lateral curves are drawn, m: the longest of them.
const WAY: u32 = 80;

/// What a lateral curve may move when points are left out, m: as much as it is rounded.
const TOLERANCE: f64 = 0.01;

/// Numbers beyond this are written as this: nothing there is drawn, and differences of them are still numbers.
const FARTHEST: f64 = 1e9;

/// One tick. Curves are told from the start; costs in hundredths.
#[derive(Serialize)]
pub(super) struct BundleData {
    /// Station and offset of the start, m.
    start: [f64; 2],
    /// Station that the rear axle may not pass, m.
    stop: Option<f64>,
    /// Speed that is wanted, m/s.
    cruise: f64,
    /// Places of the lateral curves in the page's curves, each less the one before it: `way, l, way, l, …` in m and cm.
    lateral: String,
    /// Places of the longitudinal curves there: second differences of the way, one every half second, in dm.
    longitudinal: String,
    /// What each longitudinal curve is for: `c`ruise, `p`ath and time, `s`top.
    kinds: String,
    /// Why it is in no pair: passes the `s`top point, breaks `l`imits; `-` for one that is.
    unfit: String,
    /// Four costs of each longitudinal curve that is in pairs.
    alone: String,
    /// Two costs, of offset and comfort, of each pair: for each of those curves one with every lateral curve.
    together: String,
    /// What is wrong with each pair: 0 for nothing, then the faults from 1 on.
    wrong: String,
    /// Places in the texts.
    faults: Vec<usize>,
    /// What the path-time graph holds: obstacle, `t, lower, upper` when it enters and when it leaves.
    boxes: Vec<(u32, [f64; 6])>,
    /// Longitudinal and lateral curve that are driven.
    chosen: Option<[usize; 2]>,
    /// What is driven where no pair may be.
    braking: Option<BrakingData>,
    /// Place in the frame, cost and surcharge of every line.
    lines: Vec<(usize, f64, f64)>,
    /// Place in the frame of the one that is driven.
    line: usize,
}

/// Constant braking along a lateral curve.
#[derive(Serialize)]
struct BrakingData {
    /// m/s², negative.
    deceleration: f64,
    lateral: usize,
    /// Place of its way over time in the page's curves.
    longitudinal: usize,
    /// What is wrong with it all the same, if it is the last resort.
    against: Option<usize>,
}

impl BundleData {
    pub(super) fn new(trace: &Trace, of: &LatticeSurvey, pools: &mut Pools) -> Self {
        let survey = &of.survey;
        let ([s, ..], [l, ..]) = (survey.initial.s, survey.initial.l);
        let (wrong, faults) = faults(&survey.pairs);
        let of_lateral = survey.lateral.iter().map(lateral);
        let of_longitudinal = (survey.longitudinal.iter())
            .map(|(sampled, _)| second_differences(TIMES.iter().map(|t| sampled.curve.at(*t)[0] - s)));
        Self {
            start: [thin::centi(s), thin::centi(l)],
            stop: survey.target.stop_s.map(thin::centi),
            cruise: thin::centi(survey.target.cruise_speed),
            lateral: places(of_lateral, pools),
            longitudinal: places(of_longitudinal, pools),
            kinds: survey.longitudinal.iter().map(|(of, _)| kind(of.kind)).collect(),
            unfit: survey.longitudinal.iter().map(|(_, why)| unfit(*why)).collect(),
            alone: alone(survey),
            together: letters(
                survey
                    .costs
                    .iter()
                    .flat_map(|pair| [pair.offset, pair.comfort].map(hundredths)),
            ),
            wrong,
            faults: (faults.into_iter())
                .map(|fault| pools.texts.place(words::rejection(trace, fault)))
                .collect(),
            boxes: survey.entries.iter().map(occupied).collect(),
            chosen: match survey.planned.outcome {
                Outcome::Found(pair) => Some([pair.longitudinal, pair.lateral]),
                Outcome::Backup(_) | Outcome::LastResort(..) => None,
            },
            braking: match survey.planned.outcome {
                Outcome::Found(_) => None,
                Outcome::Backup(pair) => Some(braking(trace, survey, pair, None, pools)),
                Outcome::LastResort(pair, why) => Some(braking(trace, survey, pair, Some(why), pools)),
            },
            lines: (of.lines.iter())
                .map(|line| {
                    (
                        line.place,
                        thin::centi(line.trajectory),
                        thin::centi(line.surcharge),
                    )
                })
                .collect(),
            line: of.place,
        }
    }
}

fn braking(
    trace: &Trace,
    survey: &Survey,
    pair: BackupPair,
    against: Option<Rejection>,
    pools: &mut Pools,
) -> BrakingData {
    let [s, ..] = survey.initial.s;
    let way = second_differences(survey.planned.points.iter().map(|point| point.s - s));
    BrakingData {
        deceleration: thin::centi(pair.deceleration),
        lateral: pair.lateral,
        longitudinal: pools.curves.place(way),
        against: against.map(|why| pools.texts.place(words::rejection(trace, why))),
    }
}

/// Of each longitudinal curve that is in pairs: they have its costs.
fn alone(survey: &Survey) -> String {
    let curves = survey.costs.chunks(survey.lateral.len().max(1));
    letters(curves.flat_map(|pairs| {
        let LongitudinalCosts {
            objective,
            jerk,
            collision,
            centripetal,
        } = pairs[0].longitudinal;
        [objective, jerk, collision, centripetal].map(hundredths)
    }))
}

/// What is wrong with each pair, and the faults in the order of their numbers.
fn faults(pairs: &[Assessed]) -> (String, Vec<Rejection>) {
    let mut known: Vec<Rejection> = Vec::new();
    let mut number = |rejection: Rejection| {
        let place = known.iter().position(|fault| *fault == rejection);
        1 + place.unwrap_or_else(|| {
            known.push(rejection);
            known.len() - 1
        })
    };
    let numbers: Vec<i64> = (pairs.iter())
        .map(|(_, rejection)| rejection.map_or(0, |rejection| whole(number(rejection))))
        .collect();
    (letters(numbers), known)
}

/// Where curves are written.
fn places(curves: impl Iterator<Item = String>, pools: &mut Pools) -> String {
    letters(differences(curves.map(|curve| whole(pools.curves.place(curve)))))
}

fn kind(kind: Kind) -> char {
    match kind {
        Kind::Cruise => 'c',
        Kind::PathTime => 'p',
        Kind::Stop => 's',
    }
}

fn unfit(why: Option<Unfit>) -> char {
    match why {
        None => '-',
        Some(Unfit::PassesStop) => 's',
        Some(Unfit::BreaksLimits) => 'l',
    }
}

fn occupied(entry: &PathTimeEntry) -> (u32, [f64; 6]) {
    let (from, to) = (entry.enters, entry.leaves);
    let corners = [from.t, from.lower, from.upper, to.t, to.lower, to.upper];
    (entry.id.0, corners.map(thin::centi))
}

/// `way, l, way, l, …` in metres and centimetres.
fn lateral(curve: &Curve) -> String {
    let points: Vec<Vec2> = (0..=WAY)
        .map(|k| Vec2::new(f64::from(k), curve.at(f64::from(k))[0]))
        .collect();
    let kept = thin::keep_within(&points, TOLERANCE, |_| false);
    let kept = points.iter().zip(kept).filter(|(_, kept)| *kept);
    letters(kept.flat_map(|(p, _)| [rounded(p.x), hundredths(p.y)]))
}

/// Of ways at the times of the grid, in tenths of a metre. A way that grows evenly has none.
fn second_differences(ways: impl Iterator<Item = f64>) -> String {
    let tenths = ways.step_by(TIME_STEP).map(|way| rounded(way * 10.0));
    letters(differences(differences(tenths)))
}

/// As a whole number of hundredths.
fn hundredths(value: f64) -> i64 {
    rounded(value * 100.0)
}

#[expect(clippy::cast_possible_truncation, reason = "it is kept within what fits")]
fn rounded(value: f64) -> i64 {
    value.clamp(-FARTHEST, FARTHEST).round() as i64
}

fn whole(place: usize) -> i64 {
    i64::try_from(place).expect("there are fewer places than numbers")
}
