//! One seed is one scenario, whatever else is in the file or is drawn before it.

use crate::road::{family, maps};
use corridor_decider::geometry::Vec2;
use corridor_scenarios::random::{Stream, StreamName};
use corridor_scenarios::scenario::Behaviour;
use corridor_scenarios::{DrawError, Family, Scenario};
use std::path::Path;

const ROWS: &str = "map='street'\ncruise_speed={uniform=[4,9]}\n[ego]\nl={normal=[0,0.1],clamp=[-0.3,0.3]}\n\
    [[parked]]\nahead={uniform=[40,60]}\nfrom='right_edge'\nl={uniform=[0,0.4]}\ncount={uniform=[2,5]}\nspacing={uniform=[1,3]}\n";

fn places(scenario: &Scenario) -> Vec<Vec2> {
    let parked = scenario.obstacles.iter().filter_map(|o| match o.behaviour {
        Behaviour::Parked(pose) => Some(pose.position()),
        _ => None,
    });
    parked.collect()
}

fn draw(text: &str, seed: u64) -> Scenario {
    family(text).draw(seed).unwrap().scenario
}

#[test]
fn a_seed_gives_the_same_bits_in_every_order() {
    let rows = family(ROWS);
    assert!(!rows.is_fixed());
    let forwards: Vec<_> = (0..20).map(|seed| rows.draw(seed).unwrap().scenario).collect();
    for seed in (0..20).rev() {
        let again = family(ROWS).draw(seed).unwrap().scenario;
        let first = &forwards[usize::try_from(seed).unwrap()];
        assert_eq!(again.ego, first.ego);
        assert_eq!(again.cruise_speed.to_bits(), first.cruise_speed.to_bits());
        assert_eq!(places(&again), places(first));
    }
    assert_ne!(forwards[0].ego, forwards[1].ego);
}

#[test]
fn a_number_is_drawn_from_the_stream_of_its_key_path() {
    for seed in 0..10 {
        let drawn = family(ROWS).draw(seed).unwrap();
        assert!(drawn.rejected.is_empty());
        let attempt = StreamName::root(seed).join(format_args!("attempt")).seed(0);
        let speed = Stream::new(attempt, "cruise_speed", 0).uniform(4.0, 9.0);
        assert_eq!(drawn.scenario.cruise_speed.to_bits(), speed.to_bits());
        let ahead = Stream::new(attempt, "parked[0].ahead", 0).uniform(40.0, 60.0);
        assert!((places(&drawn.scenario)[0].x - 20.0 - ahead).abs() < 1e-9);
        let count = 2 + Stream::new(attempt, "parked[0].count", 0).index(4);
        assert_eq!(drawn.scenario.obstacles.len(), count);
    }
}

#[test]
fn other_keys_do_not_disturb_a_number() {
    let more = format!(
        "{ROWS}[[cone]]\nahead={{uniform=[100,120]}}\nl=-1.6\n[vehicle]\nwidth={{uniform=[1.8,2.1]}}\n"
    );
    for seed in 0..10 {
        let (alone, among) = (draw(ROWS, seed), draw(&more, seed));
        assert_eq!(alone.ego, among.ego);
        assert_eq!(places(&alone), places(&among)[..alone.obstacles.len()]);
    }
}

#[test]
fn whole_numbers_take_both_ends_and_choices_all_values() {
    let rows = family(ROWS);
    let mut seen = [0; 6];
    for seed in 0..400 {
        seen[rows.draw(seed).unwrap().scenario.obstacles.len()] += 1;
    }
    assert_eq!(seen[..2], [0, 0]);
    assert!(seen[2..].iter().all(|n| (60..140).contains(n)), "{seen:?}");
    let choice = family("map='street'\ncruise_speed={choice=[3, 5.5, 8]}");
    let speeds: Vec<f64> = (0..60)
        .map(|seed| choice.draw(seed).unwrap().scenario.cruise_speed)
        .collect();
    assert!([3.0, 5.5, 8.0].iter().all(|v| speeds.contains(v)));
    assert!(speeds.iter().all(|v| [3.0, 5.5, 8.0].contains(v)));
}

#[test]
fn means_and_ends_are_those_of_the_laws() {
    let laws = family(
        "map='street'\ncruise_speed={uniform=[2,8]}\n[ego]\nspeed={normal=[5,1],clamp=[4,6]}\nl={uniform=[-0.5,0.5]}",
    );
    let drawn: Vec<Scenario> = (0..4000).map(|seed| laws.draw(seed).unwrap().scenario).collect();
    let mean = |value: &dyn Fn(&Scenario) -> f64| drawn.iter().map(value).sum::<f64>() / 4000.0;
    // Five standard errors each.
    assert!((mean(&|s| s.cruise_speed) - 5.0).abs() < 0.14);
    assert!((mean(&|s| s.ego.speed) - 5.0).abs() < 0.07);
    assert!(mean(&|s| s.ego.pose.y).abs() < 0.023);
    assert!(drawn.iter().all(|s| (4.0..=6.0).contains(&s.ego.speed)));
    let clamped = drawn.iter().filter(|s| s.ego.speed >= 6.0).count();
    // 15.9 % of a normal law lie beyond one standard deviation.
    assert!((540..730).contains(&clamped), "{clamped}");
}

#[test]
fn what_is_rejected_is_told_and_drawn_again() {
    // Half of the places are inside the ego.
    let text = "map='street'\ncruise_speed=1\n[ego]\nspeed=0\n[expect]\noutcome='progress_by_gap'\n\
                [[cone]]\nahead={uniform=[0,8.18]}\n";
    let cones = family(text);
    let (mut rejected, seeds) = (0, 300);
    for seed in 0..seeds {
        let drawn = cones.draw(seed).unwrap();
        assert!(
            drawn.rejected.iter().all(|r| r.reason() == "overlap"),
            "{:?}",
            drawn.rejected
        );
        assert!(places(&drawn.scenario)[0].x > 20.0 + 3.89 + 0.2 - 1e-9);
        rejected += drawn.rejected.len();
    }
    // A fair coin: one rejected draw for each accepted one.
    assert!((220..390).contains(&rejected), "{rejected}");
}

#[test]
fn a_family_that_is_never_possible_says_so_after_its_attempts() {
    let never = family("map='street'\n[[cone]]\nahead={uniform=[0,3]}\n");
    match never.draw(5) {
        Err(DrawError::Exhausted {
            rejected, seed: 5, ..
        }) => assert_eq!(rejected.len(), 100),
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("possible"),
    }
    let message = never.draw(5).unwrap_err().to_string();
    assert!(
        message.contains("seed 5: no possible scenario in 100 attempts"),
        "{message}"
    );
    let fixed = family("map='street'\n[[cone]]\nahead=2\n")
        .draw(5)
        .unwrap_err()
        .to_string();
    assert_eq!(
        fixed,
        "scenario `test` is impossible: `ego` and `cone[0]` overlap at the start"
    );
}

#[test]
fn a_file_on_disk_is_named_by_itself_and_shares_its_map() {
    let folder = std::env::temp_dir().join(format!("corridor-scenarios-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("quiet_street.toml");
    std::fs::write(&path, "description='nothing'\nmap='street'\n").unwrap();
    let maps = maps();
    let family = Family::load_with(&path, &maps).unwrap();
    let again = Family::load_with(Path::new(&path), &maps).unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    assert_eq!(family.name(), "quiet_street");
    assert!(family.is_fixed());
    assert!(std::sync::Arc::ptr_eq(family.map(), again.map()));
    assert_eq!(&**family.source(), "description='nothing'\nmap='street'\n");
}
