//! A scenario written down with the numbers that its seed drew is the same scenario, to the bit.

use crate::catalog::families;
use crate::road::{family, maps};
use corridor_decider::reference_line::{LineQuery, ReferenceLine};
use corridor_scenarios::scenario::{AlongLine, Behaviour, Obstacle};
use corridor_scenarios::{Family, MapCache, Scenario};
use std::path::Path;

/// Everything of a scenario but the seed that drew it; of a line, which is long, its ends and its number of samples.
fn text(scenario: &Scenario) -> String {
    let line = |line: &ReferenceLine| (line.samples().len(), line.point(0.0), line.point(line.length()));
    let start = |at: &AlongLine| format!("{:?} {:?} {:?} {:?}", line(&at.line), at.s, at.l, at.speed);
    let obstacle = |obstacle: &Obstacle| {
        let behaviour = match &obstacle.behaviour {
            Behaviour::ConstantSpeed(along) => start(along),
            Behaviour::Idm {
                start: along,
                params,
                lane_change,
                mobil,
            } => format!("{} {params:?} {lane_change:?} {mobil:?}", start(along)),
            other => format!("{other:?}"),
        };
        let Obstacle {
            id,
            name,
            kind,
            shape,
            ..
        } = obstacle;
        format!("{id:?} {name} {kind:?} {shape:?} {behaviour}")
    };
    let obstacles: Vec<String> = scenario.obstacles.iter().map(obstacle).collect();
    let target = scenario.target_line.as_deref().map(line);
    format!(
        "{} {} {:?} {:?} {:?} {target:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {obstacles:?}",
        scenario.name,
        scenario.description,
        scenario.route,
        scenario.provider.is_some(),
        line(&scenario.line),
        scenario.ego,
        scenario.command,
        scenario.command_time,
        scenario.cruise_speed,
        scenario.vehicle,
        scenario.timeout,
        scenario.expect,
    )
}

#[test]
fn every_family_of_the_catalog_can_be_written_down() {
    let maps = MapCache::new();
    for (name, family) in families() {
        for seed in [1, 2, 7] {
            let fixed = family.fixed(seed).unwrap();
            let again = Family::parse_with(&fixed, "other.toml", Path::new(""), &maps)
                .unwrap_or_else(|e| panic!("{name}: {e}\n{fixed}"));
            assert!(again.is_fixed(), "{name} seed {seed}: {fixed}");
            let (a, b) = (family.draw(seed).unwrap(), again.draw(seed + 30).unwrap());
            assert!(
                text(&a.scenario) == text(&b.scenario),
                "{name} seed {seed} is another scenario as\n{fixed}"
            );
            assert_eq!(again.fixed(0).unwrap(), fixed, "{name} seed {seed}");
        }
    }
}

#[test]
fn rows_become_single_obstacles_with_the_names_they_had() {
    let rows = family(
        "map='street'\n[[parked]]\nahead=40\nl=-2.5\n[[parked]]\nname='row'\nahead={uniform=[60,70]}\n\
         from='right_edge'\nl={uniform=[0,0.4]}\ncount={choice=[3]}\nspacing={uniform=[1,3]}\n\
         [[parked]]\nahead=150\nl=-2.5\nlength={uniform=[1,2]}\npolygon=[[1,0],[0,1],[-1,0]]\n",
    );
    let fixed: toml::Table = rows.fixed(3).unwrap().parse().unwrap();
    let parked = fixed["parked"].as_array().unwrap();
    let names: Vec<&str> = parked.iter().map(|p| p["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["parked[0]", "row.0", "row.1", "row.2", "parked[2]"]);
    assert!(
        parked
            .iter()
            .all(|p| p.get("count").is_none() && !p["ahead"].is_table())
    );
    assert!(parked[4].get("length").is_none(), "nobody asked for it");
    let text_of = rows.fixed(3).unwrap();
    let again = Family::parse_with(&text_of, "again.toml", Path::new(""), &maps()).unwrap();
    assert_eq!(
        text(&again.draw(9).unwrap().scenario),
        text(&rows.draw(3).unwrap().scenario)
    );
}
