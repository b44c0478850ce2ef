//! The hunt for planted faults: for each, one seed after the other with and without it, until a gate fails that the same
//! seed passes without.
//!
//! A fault that is not found is told from one that changes nothing: only the first is a hole in the net. Which seeds are
//! looked at, and in which order, does not depend on the threads; a fault is hunted by one of them.

use super::in_order::in_order;
use super::{Job, Judgement, Plan, RunResult, SweepError, SweepRow, Variant, row};
use crate::faults::{Failure, Fault, Spec};
use crate::settings::Settings;
use crate::shrink::{self, Demand};
use crate::verdict::{Ending, Metric};
use corridor_scenarios::MapCache;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};

/// What came of the hunt for one fault.
#[derive(Debug)]
pub struct Finding {
    /// The fault.
    pub fault: &'static Spec,
    /// Seeds that were run with and without it.
    pub seeds: usize,
    /// Seeds that did not suit: the run without the fault did not pass.
    pub unfit: usize,
    /// Seeds whose run the fault changed, be it by a bit.
    pub changed: usize,
    /// How it ended.
    pub result: Hunted,
    /// The first run, if no gate failed in any, in which a metric that is no gate went beyond its threshold and did not
    /// without the fault: a comparison of two sweeps would tell.
    pub noticed: Option<Box<Caught>>,
    /// How small the run that showed it can be made, once somebody has tried.
    pub shrunk: Option<Shrunk>,
}

/// How the hunt for a fault ended.
#[derive(Debug)]
pub enum Hunted {
    /// A gate failed.
    Caught(Box<Caught>),
    /// The testbed itself broke: by which command, and how.
    Broken(String, String),
    /// No gate failed in all the seeds.
    Escaped,
}

/// The run that showed a fault.
#[derive(Clone, Debug, PartialEq)]
pub struct Caught {
    /// Name of the scenario.
    pub scenario: String,
    /// Its seed.
    pub seed: u64,
    /// The first gate that failed.
    pub metric: String,
    /// How the run ended.
    pub ending: Ending,
    /// Why it failed, in one sentence.
    pub summary: String,
    /// The command that runs it again.
    pub replay: String,
}

/// The size of a run that was made small.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shrunk {
    /// Obstacles in it.
    pub obstacles: usize,
    /// How long it lasts, s.
    pub seconds: f64,
}

impl Finding {
    /// Whether the net holds: the fault was caught, or is known to be one that no gate can see.
    pub fn holds(&self) -> bool {
        match self.result {
            Hunted::Caught(_) => true,
            Hunted::Broken(..) => false,
            Hunted::Escaped => self.fault.unseen().is_some(),
        }
    }
}

/// What is hunted in, and how long.
#[derive(Debug)]
pub struct Hunt<'a> {
    /// The scenarios.
    pub plan: &'a Plan,
    /// Settings of the runs without a fault, and what of them is not the default.
    pub settings: &'a Settings,
    /// The same as the command line has them.
    pub overrides: &'a [String],
    /// The first seed.
    pub seed: u64,
    /// Most seeds for each fault.
    pub budget: usize,
    /// Most runs to make the one that shows a fault small; 0: it stays as it is.
    pub shrink: u32,
}

/// Hunts faults on `threads` threads (0: one per core). `done` hears of each finding, in the order of the faults.
///
/// # Errors
/// [`SweepError`] when the threads cannot be started.
#[expect(clippy::missing_panics_doc, reason = "a fault of a list has its number in it")]
pub fn hunt(
    hunt: &Hunt,
    faults: &[&'static Spec],
    threads: usize,
    done: &mut dyn FnMut(&Finding),
) -> Result<Vec<Finding>, SweepError> {
    let known = Known::default();
    let one = |number: u64| {
        let place = usize::try_from(number).expect("a place in the list of faults");
        hunt.one(faults[place], &known)
    };
    let mut findings = Vec::new();
    in_order(threads, faults.len() as u64, one, |_, finding| {
        done(&finding);
        findings.push(finding);
        ControlFlow::Continue(())
    })?;
    Ok(findings)
}

/// A run without a fault, as far as it matters, if it passed: its digest, and the metrics beyond their thresholds.
type Sound = Option<(String, Vec<String>)>;

/// Runs without a fault and without an occasion: all faults are held against the same ones.
type Known = Mutex<BTreeMap<Job, Sound>>;

impl Hunt<'_> {
    fn one(&self, fault: &'static Spec, known: &Known) -> Finding {
        let mut finding = Finding {
            fault,
            seeds: 0,
            unfit: 0,
            changed: 0,
            result: Hunted::Escaped,
            noticed: None,
            shrunk: None,
        };
        let trial = Trial::of(self, fault);
        for job in self.plan.in_turn(&fault.shows_in(), self.seed, self.budget) {
            let Some((digest, usual)) = trial.sound(self, job, known) else {
                finding.unfit += 1;
                continue;
            };
            finding.seeds += 1;
            let row = row(self.plan, job, &trial.faulty);
            match &row.result {
                RunResult::Broken(reason) => {
                    finding.result = Hunted::Broken(row.replay.clone(), reason.clone());
                    break;
                }
                RunResult::Judged(verdict) => {
                    finding.changed += usize::from(verdict.digest != digest);
                    if let Some(metric) = first_failed(verdict) {
                        finding.result = Hunted::Caught(Box::new(caught(&row, verdict, metric)));
                        finding.noticed = None;
                        finding.shrunk = self.shrunk(job, &trial);
                        break;
                    }
                    let is_new = |metric: &&Metric| !usual.contains(&metric.name);
                    if let (None, Some(metric)) = (&finding.noticed, verdict.failed.iter().find(is_new)) {
                        finding.noticed = Some(Box::new(caught(&row, verdict, metric)));
                    }
                }
            }
        }
        finding
    }

    /// How small the run becomes; none where it has no file of its own, or nobody asked.
    fn shrunk(&self, job: Job, trial: &Trial) -> Option<Shrunk> {
        let (family, _) = self.plan.family(job);
        let demand = Demand {
            settings: &trial.faulty.settings,
            sound: Some(&trial.sound.settings),
            keeps_map: false,
        };
        if self.shrink == 0 {
            return None;
        }
        let found = shrink::shrink(family, job.seed, &demand, self.shrink, &MapCache::new());
        found.ok().map(|found| Shrunk {
            obstacles: found.sizes[1].obstacles,
            seconds: found.sizes[1].duration,
        })
    }
}

/// The settings with and without one fault.
struct Trial {
    sound: Variant,
    faulty: Variant,
    has_occasion: bool,
}

impl Trial {
    fn of(hunt: &Hunt, fault: &'static Spec) -> Self {
        let failures = fault.occasion.iter().map(|(of, from, until)| Failure {
            of: *of,
            from: *from,
            until: *until,
        });
        let mut sound = Settings {
            fault: Fault::NONE,
            ..hunt.settings.clone()
        };
        sound.failures.extend(failures);
        let faulty = Settings {
            fault: fault.into(),
            ..sound.clone()
        };
        let mut overrides = hunt.overrides.to_vec();
        overrides.push(format!("fault={}", fault.name));
        let has_occasion = !fault.occasion.is_empty();
        if has_occasion {
            let failures = serde_json::to_string(&sound.failures).expect("names and numbers can be written");
            overrides.push(format!("failures={failures}"));
        }
        let variant = |settings, overrides| Variant {
            name: fault.name.to_owned(),
            settings,
            overrides,
        };
        Self {
            sound: variant(sound, Vec::new()),
            faulty: variant(faulty, overrides),
            has_occasion,
        }
    }

    /// The digest of the run without the fault, if that passed.
    fn sound(&self, hunt: &Hunt, job: Job, known: &Known) -> Sound {
        let run = || {
            let row = row(hunt.plan, job, &self.sound);
            row.verdict().filter(|verdict| verdict.pass).map(|verdict| {
                let beyond = verdict.failed.iter().map(|metric| metric.name.clone());
                (verdict.digest.clone(), beyond.collect())
            })
        };
        if self.has_occasion {
            return run();
        }
        // Nothing is left half done in there, whoever panicked; and two who look for the same find the same.
        let lock = || known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(sound) = lock().get(&job) {
            return sound.clone();
        }
        let sound = run();
        lock().insert(job, sound.clone());
        sound
    }
}

/// The first gate that a run fails; of a decider that broke down, that which says so.
fn first_failed(verdict: &Judgement) -> Option<&Metric> {
    let mut failed = verdict.failed.iter().filter(|metric| metric.gate);
    if verdict.ending == Ending::DeciderFailed {
        return failed.find(|metric| metric.name == "decider_ok");
    }
    failed.next()
}

fn caught(row: &SweepRow, verdict: &Judgement, metric: &Metric) -> Caught {
    Caught {
        scenario: row.scenario.clone(),
        seed: row.seed,
        metric: metric.name.clone(),
        ending: verdict.ending,
        summary: verdict.summary.clone(),
        replay: row.replay.clone(),
    }
}
