//! The validity filter: each reason on a road where it can be worked out by hand, and its nearest neighbour
//! that is possible.

use crate::road::{family, rejection, scenario};
use corridor_scenarios::Rejection;
use corridor_scenarios::scenario::Expectation;

const STREET: &str = "map='street'\ncruise_speed=10\n[ego]\ns=40\n";

/// Checks that `bad` is rejected for `reason`, and that `good` is possible.
fn limit(reason: &str, bad: &str, good: &str) {
    let rejection = rejection(&format!("{STREET}{bad}"));
    assert_eq!(rejection.reason(), reason, "{rejection}");
    scenario(&format!("{STREET}{good}"));
}

#[test]
fn bodies_do_not_start_in_each_other() {
    // The bumper is 3.89 m ahead of the axle, the cone reaches 0.2 m; braking from 10 m/s is another matter.
    let cone =
        |ahead: f64, l: f64| format!("[expect]\noutcome='progress_by_gap'\n[[cone]]\nahead={ahead}\nl={l}\n");
    limit("overlap", &cone(2.0, -1.2), &cone(2.0, -1.3));
    let two = |gap: f64| {
        format!(
            "[[parked]]\nahead=60\nfrom='right_edge'\n[[parked]]\nahead={}\nfrom='right_edge'\n",
            64.6 + gap
        )
    };
    limit("overlap", &two(-0.01), &two(0.01));
}

#[test]
fn the_ego_starts_on_the_road() {
    // The road's right edge is 4.25 m from the line, half the car 1.055 m; 0.1 m is forgiven.
    let at = |l: f64| format!("map='street'\n[ego]\nl={l}\n");
    assert_eq!(rejection(&at(-3.30)).reason(), "ego_off_road");
    scenario(&at(-3.29));
}

#[test]
fn things_are_on_the_map() {
    let cone = |ahead: f64, l: f64| format!("[[cone]]\nahead={ahead}\nl={l}\n");
    limit("off_map", &cone(561.0, -3.0), &cone(559.0, -3.0));
    limit("off_map", &cone(60.0, -15.0), &cone(60.0, -14.0));
    limit(
        "off_map",
        "[command]\nkind='pull_over'\nahead=570\n",
        "[command]\nkind='pull_over'\nahead=90\n",
    );
    limit(
        "no_lane",
        "[[moving]]\nlane='left'\nahead=60\nspeed=5\n",
        "[[moving]]\nlane='oncoming'\nahead=60\nspeed=5\n",
    );
    let rejection = rejection("map='street'\n[ego]\ns=700\n");
    assert!(matches!(rejection, Rejection::OffMap { s, .. } if s > 699.0));
}

#[test]
fn what_stands_in_the_way_is_farther_than_braking() {
    // 10²/(2·6) + 0.3·10 + 1 = 12.333 m from bumper to cone.
    let cone = |gap: f64| {
        format!(
            "[expect]\noutcome='progress_by_gap'\n[[cone]]\nahead={}\n",
            3.89 + 0.2 + gap
        )
    };
    limit("too_near_to_stop", &cone(12.3), &cone(12.4));
    // Beside the ego's strip it may be anywhere.
    scenario(&format!("{STREET}[[cone]]\nahead=8\nl=-1.3\n"));
}

#[test]
fn what_moves_in_the_way_is_farther_than_braking_to_its_speed() {
    // Closing with 6 m/s: 36/12 + 1.8 + 1 = 5.8 m from bumper to bumper.
    let car = |gap: f64| format!("[[moving]]\nspeed=4\nlength=4\nahead={}\n", 3.89 + 2.0 + gap);
    limit("too_near_to_brake", &car(5.7), &car(5.9));
    // A faster one may be right ahead.
    scenario(&format!("{STREET}[[moving]]\nspeed=10\nlength=4\nahead=6\n"));
}

#[test]
fn a_cut_in_leaves_room() {
    let cut = |ahead: f64, speed: f64, when: &str| {
        format!(
            "map='dual'\ncruise_speed=10\n[ego]\nlane='right_a'\ns=60\n[[idm]]\nlane='left'\nlength=4\nahead={ahead}\n\
             speed={speed}\nlane_change={{to=0,duration=2,when={when}}}\n"
        )
    };
    // Equally fast: any gap will do, but not the ego's own ground.
    scenario(&cut(8.0, 10.0, "{at=1}"));
    assert_eq!(rejection(&cut(4.0, 10.0, "{at=1}")).reason(), "hit_from_the_side");
    // Slower: what is needed grows with the square of the difference.
    assert_eq!(rejection(&cut(14.0, 4.0, "{at=0}")).reason(), "too_near_to_brake");
    scenario(&cut(40.0, 4.0, "{at=0}"));
    // Far behind the ego it may change as it likes: it brakes for its leader.
    scenario(&cut(-30.0, 10.0, "{at=1}"));
}

#[test]
fn someone_stepping_out_leaves_room_unless_the_ego_is_gone() {
    let walker = |within: f64, speed: f64| {
        format!(
            "{STREET}[[pedestrian]]\nahead=80\nfrom='right_edge'\nl=0.5\nto=5\nspeed={speed}\nwhen={{within={within}}}\n"
        )
    };
    // From 3.45 m beside the line to the strip at 1.055 + 0.3 m: 1.5 s at 1.4 m/s, in which the ego drives 15 m.
    assert_eq!(rejection(&walker(30.0, 1.4)).reason(), "too_near_to_brake");
    scenario(&walker(38.0, 1.4));
    // A slow one comes when the ego has passed.
    scenario(&walker(8.0, 0.5));
}

#[test]
fn a_script_into_the_strip_leaves_room() {
    let script = |ahead: f64| {
        format!(
            "{STREET}[[scripted]]\nahead={ahead}\nfrom='right_edge'\nl=0.2\nwaypoints=[{{after=2,ahead={ahead},l=0}}]\n"
        )
    };
    assert_eq!(rejection(&script(20.0)).reason(), "too_near_to_brake");
    scenario(&script(60.0));
}

#[test]
fn nobody_who_never_brakes_comes_up_behind() {
    let behind = |kind: &str, speed: f64| format!("[[{kind}]]\nahead=-20\nspeed={speed}\n");
    limit(
        "hit_from_behind",
        &behind("moving", 12.0),
        &behind("moving", 10.0),
    );
    scenario(&format!("{STREET}{}", behind("idm", 12.0)));
}

#[test]
fn a_destination_is_within_the_limits_when_the_command_comes() {
    let at = |ahead: f64, time: f64| format!("[command]\nkind='pull_over'\nahead={ahead}\nat={time}\n");
    let near = rejection(&format!("{STREET}{}", at(28.0, 0.0)));
    assert!(
        matches!(near, Rejection::DestinationTooNear { distance, .. } if (distance - 24.11).abs() < 1e-9)
    );
    limit("destination_too_near", &at(60.0, 4.0), &at(80.0, 0.0));
    limit("destination_too_far", &at(96.0, 0.0), &at(95.9, 0.0));
}

#[test]
fn a_pull_over_has_its_gap() {
    // Free from the wall's end to three metres beyond the destination; 1.5 · 4.933 + 10 = 17.4 m are needed.
    let wall = |end: f64| {
        let car = |from: f64, to: f64| {
            format!(
                "[[parked]]\nlength={}\nahead={}\nfrom='right_edge'\nl=0.3\n",
                to - from,
                f64::midpoint(from, to)
            )
        };
        format!(
            "[command]\nkind='pull_over'\nahead=90\n{}{}",
            car(10.0, 50.0),
            car(51.0, end)
        )
    };
    limit("no_kerb_gap", &wall(75.7), &wall(75.5));
}

#[test]
fn the_gap_at_the_kerb_decides_the_end_by_its_length() {
    // Lorries along the whole kerb but for one gap.
    let end = |gap: f64| {
        let lorry = |from: f64, length: f64| {
            let centre = from + length / 2.0;
            format!("[[parked]]\nkind='truck'\nlength={length}\nahead={centre}\nfrom='right_edge'\nl=0.2\n")
        };
        let text = format!(
            "{STREET}[command]\nkind='pull_over'\nahead=90\n[expect]\noutcome='pulled_over_by_gap'\n{}{}",
            lorry(5.0, 40.0),
            lorry(45.0 + gap, 50.0)
        );
        scenario(&text).expect
    };
    assert_eq!(end(4.9), Expectation::Refusal);
    assert_eq!(end(5.0), Expectation::PulledOverOrRefusal);
    assert_eq!(end(17.3), Expectation::PulledOverOrRefusal);
    assert_eq!(end(17.5), Expectation::PulledOver);
}

#[test]
fn a_refusal_has_its_reason() {
    let at = |ahead: f64, timeout: f64| {
        format!(
            "map='street'\ncruise_speed=10\ntimeout={timeout}\n[expect]\noutcome='refusal'\n[command]\nkind='pull_over'\nahead={ahead}\n"
        )
    };
    assert_eq!(scenario(&at(28.0, 20.0)).expect, Expectation::Refusal);
    assert_eq!(scenario(&at(200.0, 10.0)).expect, Expectation::Refusal);
    // After twelve seconds the destination is in reach.
    assert_eq!(rejection(&at(200.0, 12.0)).reason(), "no_reason_to_refuse");
    assert_eq!(rejection(&at(80.0, 10.0)).reason(), "no_reason_to_refuse");
    assert_eq!(
        rejection("map='street'\n[expect]\noutcome='refusal'\n").reason(),
        "no_reason_to_refuse"
    );
}

#[test]
fn the_way_past_what_stands_decides_the_end_by_its_width() {
    // A gate between the road's edges: the ground is the own lane and the oncoming one, from -1.75 to 5.25 m.
    let gate = |gap: f64| {
        format!(
            "map='street'\ncruise_speed=8\n[expect]\noutcome='progress_by_gap'\ndistance=150\n\
             [[parked]]\nwidth=4\nlength=2\nahead=90\nfrom='right_edge'\nl=0\n\
             [[parked]]\nwidth={}\nlength=2\nahead=90\nfrom='left_edge'\nl=0\n",
            9.5 - 4.0 - gap
        )
    };
    assert_eq!(scenario(&gate(2.10)).expect, Expectation::Standstill);
    assert_eq!(
        scenario(&gate(2.12)).expect,
        Expectation::ProgressOrStandstill(150.0)
    );
    assert_eq!(
        scenario(&gate(3.10)).expect,
        Expectation::ProgressOrStandstill(150.0)
    );
    assert_eq!(scenario(&gate(3.12)).expect, Expectation::Progress(150.0));
    let outright = |outcome: &str, gap: f64| gate(gap).replace("progress_by_gap", outcome);
    assert_eq!(rejection(&outright("progress", 2.0)).reason(), "no_way_through");
    let standstill = |gap| outright("standstill", gap).replace("distance=150\n", "");
    assert_eq!(scenario(&standstill(2.0)).expect, Expectation::Standstill);
    assert_eq!(rejection(&standstill(2.2)).reason(), "no_reason_to_stand");
}

#[test]
fn a_solid_line_is_not_crossed() {
    let blocked = |lane: &str| {
        format!(
            "map='dual'\ncruise_speed=8\n[ego]\nlane='{lane}'\n[expect]\noutcome='progress_by_gap'\n\
             [[parked]]\nwidth=3.4\nahead=90\n"
        )
    };
    // From the right lane one passes on the left one.
    assert!(matches!(
        scenario(&blocked("right_a")).expect,
        Expectation::Progress(_)
    ));
    // From the left lane one passes on the right one, but never over the solid line to the left.
    assert!(matches!(
        scenario(&blocked("left_a")).expect,
        Expectation::Progress(_)
    ));
    let both = format!(
        "{}[[parked]]\nlane='right'\nwidth=3.4\nahead=90\n",
        blocked("left_a")
    );
    assert_eq!(scenario(&both).expect, Expectation::Standstill);
}

#[test]
fn nobody_pulls_over_in_a_junction() {
    // Comfortable braking from 10 m/s ends 28.89 m ahead of the axle. From 470 m that leaves 1 m before the junction,
    // and behind it what lies between 520 m and three metres beyond the destination.
    let at = |s: f64, ahead: f64| {
        format!("map='street'\ncruise_speed=10\n[ego]\ns={s}\n[command]\nkind='pull_over'\nahead={ahead}\n")
    };
    assert_eq!(rejection(&at(470.0, 60.0)).reason(), "no_kerb_gap");
    scenario(&at(470.0, 65.0));
    scenario(&at(450.0, 60.0));
}

#[test]
fn a_change_of_lane_and_a_goal_have_their_room() {
    assert_eq!(
        rejection("map='street'\n[command]\nkind='change_lane'\nside='left'\n").reason(),
        "no_target_lane"
    );
    let goal = |distance: f64| format!("[expect]\noutcome='progress'\ndistance={distance}\n");
    limit("goal_beyond_route", &goal(531.0), &goal(529.0));
    assert!(family(&format!("{STREET}{}", goal(529.0))).is_fixed());
}

/// Two long bodies stand askew, one behind the other's end: at no station is the way narrow, though the boxes
/// around them overlap.
#[test]
fn bodies_askew_are_taken_as_they_stand() {
    let text = "map='street'\ncruise_speed=8\n[expect]\noutcome='progress_by_gap'\ndistance=150\n\
                [[parked]]\nlength=12\nwidth=0.5\nahead=80\nl=0.3\nheading=0.4\n\
                [[parked]]\nlength=12\nwidth=0.5\nahead=80\nl=3.9\nheading=0.4\n";
    // 3.6 m between them across the road, less the thickness 0.5/cos 0.4: 3.06 m, though the boxes leave nothing.
    assert_eq!(scenario(text).expect, Expectation::ProgressOrStandstill(150.0));
}

#[test]
fn a_door_leaves_room_to_brake() {
    // The tip is in the ego's strip after 0.52 s, in which the ego drives 5 m of the distance at which it begins.
    let door = |within: f64| {
        format!(
            "{STREET}[[parked]]\nahead=80\nfrom='right_lane_line'\nl=0\n\
             door={{side='left',angle=1.2,duration=1,when={{within={within}}}}}\n"
        )
    };
    assert_eq!(rejection(&door(20.0)).reason(), "too_near_to_brake");
    scenario(&door(30.0));
    // One on the other side of the car, or hardly opened, is in nobody's way.
    scenario(&door(20.0).replace("'left'", "'right'"));
    scenario(&door(20.0).replace("angle=1.2", "angle=0.3"));
}

#[test]
fn who_cuts_in_and_brakes_leaves_room_for_that_too() {
    let cutter = |ahead: f64, stop: f64| {
        format!(
            "map='dual'\ncruise_speed=10\n[ego]\nlane='right_a'\ns=60\n[[scripted]]\nlane='left'\nahead={ahead}\n\
             waypoints=[{{after=1,ahead={},l=0,heading=0}},{{after=0.5,ahead={stop}}},{{after=5,ahead={}}}]\n",
            ahead + 10.0,
            stop + 0.1
        )
    };
    // The ego needs 3 m and 8.3 m from where it is when the cutter comes in, equally fast and clear ahead.
    assert_eq!(rejection(&cutter(10.5, 21.0)).reason(), "too_near_to_brake");
    scenario(&cutter(10.5, 25.5));
    scenario(&cutter(15.0, 26.0));
}

#[test]
fn who_wants_to_drive_slower_is_nearer_when_it_comes_in() {
    let cut = |desired: f64| {
        format!(
            "map='dual'\ncruise_speed=10\n[ego]\nlane='right_a'\ns=60\n[[idm]]\nlane='left'\nlength=4\nahead=34\n\
             speed=10\ndesired_speed={desired}\nlane_change={{to=0,duration=2,when={{at=3}}}}\n"
        )
    };
    scenario(&cut(10.0));
    assert_eq!(rejection(&cut(3.0)).reason(), "too_near_to_brake");
}

#[test]
fn what_is_seen_late_may_end_in_a_standstill() {
    // 10²/(2·6) + 0.3·10 + 1 + 12 = 24.3 m from bumper to cone.
    let end = |gap: f64, l: f64| {
        let cone = format!("[[cone]]\nahead={}\nl={l}\n", 3.89 + 0.2 + gap);
        scenario(&format!(
            "{STREET}[expect]\noutcome='progress_by_gap'\ndistance=100\n{cone}"
        ))
        .expect
    };
    assert_eq!(end(24.0, 0.0), Expectation::ProgressOrStandstill(100.0));
    assert_eq!(end(24.6, 0.0), Expectation::Progress(100.0));
    assert_eq!(end(8.0, -1.4), Expectation::Progress(100.0), "it is beside");
}
