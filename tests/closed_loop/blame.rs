//! The reference search never calls unavoidable what somebody survived: a planner in the catalog, or a human driver in
//! a recorded scene. `CORRIDOR_BLAME_RUNS` sets how many runs of the catalog are asked.

use crate::support::settings;
use corridor_decider::frame::ObstacleId;
use corridor_decider::geometry::{Pose, angle};
use corridor_decider::vehicle::VehicleParams;
use corridor_scenarios::scenario::{Behaviour, EgoStart, Obstacle, RecordedState};
use corridor_scenarios::{Family, MapCache, Scenario, catalog};
use corridor_sim::blame::avoidance::{AFTERMATH, Inquest};
use corridor_sim::blame::recorder::Recording;
use corridor_sim::blame::search::{Answer, Grid};
use std::path::{Path, PathBuf};

/// Runs of the catalog that are asked where nobody says how many.
const RUNS: usize = 60;

/// How long before a moment the search begins, s.
const BEFORE: f64 = 2.0;

/// Largest lateral acceleration of a car on a dry road, m/s².
const GRIP: f64 = 9.0;

/// Steps of motions that a search may try.
const BUDGET: usize = 60_000;

/// Whether the search survives from a time on, for as long as it would have to around a bad end [`BEFORE`] later.
fn survives(recording: &Recording, from: f64) -> Result<(), Answer> {
    let grid = Grid::default();
    let tick = (recording.sample_at(from) / 10) * 10;
    let event = tick + recording.sample_at(BEFORE);
    let inquest = Inquest::new(recording, &grid, event, None, 0.1);
    match inquest.search(tick, BUDGET, 0.0) {
        Answer::Survives(witness) => {
            assert_eq!(witness.check(&recording.surroundings, inquest.limits()), Ok(()));
            Ok(())
        }
        lost => Err(lost),
    }
}

/// The moments at which a survived run is asked: its start, and before it came nearest to somebody.
fn moments(recording: &Recording) -> Vec<f64> {
    let clearance = recording
        .verdict
        .metrics
        .iter()
        .find(|m| m.name == "min_clearance");
    let nearest = clearance.and_then(|m| m.worst_t).map(|t| (t - BEFORE).max(0.0));
    std::iter::once(0.0).chain(nearest).collect()
}

fn is_survived(recording: &Recording) -> bool {
    let road = recording
        .verdict
        .metrics
        .iter()
        .find(|m| m.name == "drivable_area");
    recording.verdict.collisions.is_empty() && road.is_none_or(|m| m.pass)
}

#[test]
fn what_a_planner_survived_the_search_survives() {
    let wanted = std::env::var("CORRIDOR_BLAME_RUNS")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(RUNS);
    let maps = MapCache::new();
    let families: Vec<Family> = catalog::ENTRIES
        .iter()
        .filter_map(|entry| entry.load(&maps).ok())
        .collect();
    let planners = [settings(&[]), settings(&["decider.planner=lattice"])];
    let (mut runs, mut asked, mut missed) = (0, 0, Vec::new());
    'all: for seed in 300.. {
        for (family, settings) in families.iter().flat_map(|f| planners.iter().map(move |s| (f, s))) {
            let Ok(drawn) = family.draw(seed) else { continue };
            let recording = Recording::of(&drawn.scenario, settings);
            if !is_survived(&recording) {
                continue;
            }
            runs += 1;
            for from in moments(&recording) {
                asked += 1;
                if let Err(lost) = survives(&recording, from) {
                    let planner = settings.decider.planner;
                    missed.push(format!(
                        "{} seed {seed} {planner:?} from {from}: {lost:?}",
                        family.name()
                    ));
                }
            }
            if runs >= wanted {
                break 'all;
            }
        }
    }
    eprintln!("{runs} survived runs, {asked} questions, {} missed", missed.len());
    assert!(missed.is_empty(), "{missed:#?}");
}

/// The recorded scenes of the shared maps; `None` without them.
fn recorded() -> Option<Vec<PathBuf>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/maps");
    let maps = std::env::var_os("CORRIDOR_MAPS").map_or(root, PathBuf::from);
    let Ok(folder) = std::fs::read_dir(maps.join("commonroad")) else {
        assert!(std::env::var_os("CORRIDOR_REQUIRE_MAPS").is_none(), "no maps");
        eprintln!("skipped: no maps");
        return None;
    };
    let mut files: Vec<PathBuf> = folder.filter_map(|entry| Some(entry.ok()?.path())).collect();
    files.retain(|path| path.extension().is_some_and(|e| e == "xml"));
    files.sort();
    Some(files)
}

/// The scene with the ego in the place of one of its recorded cars, as large as that one, and where that car then was
/// at each time.
fn as_driven_by(scene: &Scenario, driver: &Obstacle) -> Option<Scenario> {
    let Behaviour::Recorded { states, .. } = &driver.behaviour else {
        return None;
    };
    let there = states.first().is_some_and(|s| s.t <= 0.0) && states.last().is_some_and(|s| s.t >= 3.0);
    let start = states
        .iter()
        .take_while(|s| s.t <= 0.0)
        .last()
        .filter(|_| there)?;
    let half = |of: fn(&corridor_decider::geometry::Vec2) -> f64| {
        driver.shape.vertices().iter().map(of).fold(0.0, f64::max)
    };
    let (length, width) = (2.0 * half(|v| v.x), 2.0 * half(|v| v.y.abs()));
    let usual = VehicleParams::default();
    let back = usual.back_edge_to_center;
    let vehicle = VehicleParams {
        length,
        width,
        back_edge_to_center: back,
        front_edge_to_center: length - back,
        ..usual
    };
    let mut scenario = scene.clone();
    scenario.obstacles.retain(|o| o.id != driver.id);
    for (k, obstacle) in (0_u32..).zip(&mut scenario.obstacles) {
        obstacle.id = ObstacleId(k);
    }
    let axle = start.pose.advanced(back - length / 2.0);
    scenario.ego = EgoStart {
        pose: Pose::new(axle.x, axle.y, axle.theta),
        speed: start.speed,
    };
    scenario.vehicle = vehicle;
    (length > 3.0 && start.speed >= 0.0).then_some(scenario)
}

/// Whether a dry road could hold a car that moves as recorded: some records are drawn by hand.
fn is_drivable(states: &[RecordedState]) -> bool {
    states.windows(2).all(|pair| {
        let turn = angle::difference(pair[1].pose.theta, pair[0].pose.theta);
        let way = (pair[1].pose.position() - pair[0].pose.position()).norm();
        let time = pair[1].t - pair[0].t;
        (turn * way).abs() <= GRIP * time * time
    })
}

/// Whether the driver himself met nobody and kept to the road, in the scene that is left without him.
fn survived_himself(recording: &Recording, driver: &Obstacle, seconds: f64) -> bool {
    let Behaviour::Recorded { states, .. } = &driver.behaviour else {
        return false;
    };
    let surroundings = &recording.surroundings;
    let mut during = states.iter().filter(|s| s.t >= 0.0 && s.t <= seconds);
    is_drivable(states)
        && during.all(|state| {
            let body = driver.shape.at(state.pose);
            let sample = recording.sample_at(state.t);
            let others = &surroundings.scenario.obstacles;
            let on_road = |c| surroundings.scenario.map.distance_off_road(c) <= surroundings.off_road;
            others
                .iter()
                .all(|o| !body.overlaps(&surroundings.outline(o.id, sample)))
                && body.vertices().iter().all(|c| on_road(*c))
        })
}

#[test]
fn what_a_recorded_driver_survived_the_search_survives() {
    let Some(files) = recorded() else { return };
    let (mut drivers, mut missed) = (0, Vec::new());
    for file in files {
        let Ok(family) = Family::load(&file) else { continue };
        let scene = family.draw(1).unwrap().scenario;
        for driver in &scene.obstacles {
            let Some(scenario) = as_driven_by(&scene, driver) else {
                continue;
            };
            let short = Scenario {
                timeout: BEFORE + AFTERMATH,
                ..scenario
            };
            let recording = Recording::of(&short, &settings(&[]));
            if !survived_himself(&recording, driver, BEFORE + AFTERMATH) {
                continue;
            }
            drivers += 1;
            if let Err(lost) = survives(&recording, 0.0) {
                let (ego, vehicle) = (recording.ego[0], short.vehicle);
                missed.push(format!(
                    "{} `{}` {lost:?} {ego:?} {vehicle:?}",
                    family.name(),
                    driver.name
                ));
            }
        }
    }
    eprintln!("{drivers} recorded drivers, {} missed", missed.len());
    assert!(drivers > 20, "{drivers} drivers");
    assert!(missed.is_empty(), "{missed:#?}");
}
