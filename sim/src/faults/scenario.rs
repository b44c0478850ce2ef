//! Faults in what is known of the task and the road: commands, cruise speed, speed limits, widths, marks, junctions.

use super::planted::Past;
use super::spec::{Plant, Spec, Stage};
use corridor_decider::frame::{Command, Frame};
use corridor_decider::geometry::angle;
use corridor_decider::reference_line::LineSample;
use corridor_decider::road::BoundaryType;

/// km/h in a m/s.
pub(super) const KMH: f64 = 3.6;

/// How late a command is heard, s: a driver would have asked twice.
const DEAF: f64 = 10.0;

/// How far beside its lane the line lies, m: an import that takes a lane's edge for its middle.
const BESIDE: f64 = 1.75;

/// How much too wide lanes and road are taken to be, to either side, m: a lane width read as half of one.
const WIDER: f64 = 1.75;

/// How far off the destination is read, m: three car lengths.
const DESTINATION_OFF: f64 = 15.0;

const fn on_frame(name: &'static str, what: &'static str, change: fn(&mut Frame, &mut Past)) -> Spec {
    Spec::new(name, what, Stage::Scenario, Plant::Frame(change))
}

pub(super) const FAULTS: &[Spec] = &[
    on_frame(
        "command_forgotten",
        "Whatever is asked for, the decider hears that it is to cruise.",
        |frame, _| {
            frame.command = Command::Cruise;
        },
    ),
    on_frame(
        "command_heard_late",
        "A command is heard ten seconds after it is given.",
        |frame, _| {
            if frame.time < DEAF {
                frame.command = Command::Cruise;
                frame.lines.truncate(1);
            }
        },
    ),
    on_frame(
        "target_lane_forgotten",
        "The line to change to is left out.",
        |frame, _| frame.lines.truncate(1),
    ),
    on_frame(
        "destination_ahead",
        "The place to pull over is read 15 m farther along the line than it is.",
        |frame, _| {
            destination_ahead(frame);
        },
    ),
    on_frame(
        "cruise_speed_in_kmh",
        "The cruise speed is given in km/h and taken for m/s, limits or not.",
        |frame, past| {
            frame.cruise_speed *= KMH;
            lines(frame, past, |sample| sample.speed_limit = None);
        },
    ),
    on_frame(
        "cruise_speed_in_ms",
        "The cruise speed is given in m/s and taken for km/h.",
        |frame, _| {
            frame.cruise_speed /= KMH;
        },
    ),
    on_frame(
        "line_beside_its_lane",
        "The line lies 1.75 m left of its lane's middle, which the map data take for it.",
        |frame, past| {
            lines(frame, past, |sample| {
                let (sin, cos) = angle::sin_cos(sample.point.theta);
                sample.point.x -= sin * BESIDE;
                sample.point.y += cos * BESIDE;
            });
        },
    ),
    on_frame(
        "lanes_too_wide",
        "Lane and road are taken to be 1.75 m wider to either side than they are.",
        |frame, past| {
            lines(frame, past, |sample| {
                let wider = |(left, right): (f64, f64)| (left + WIDER, right + WIDER);
                sample.lane_width = wider(sample.lane_width);
                sample.road_width = wider(sample.road_width);
            });
        },
    ),
    on_frame(
        "lanes_too_narrow",
        "Of lane and road a fifth is taken off on either side.",
        |frame, past| {
            lines(frame, past, |sample| {
                let narrower = |(left, right): (f64, f64)| (0.8 * left, 0.8 * right);
                sample.lane_width = narrower(sample.lane_width);
                sample.road_width = narrower(sample.road_width);
            });
        },
    ),
    on_frame(
        "road_sides_swapped",
        "Left and right are swapped in all that is known of the road beside the line.",
        |frame, past| {
            lines(frame, past, swap_sides);
        },
    ),
    on_frame(
        "marks_unread",
        "Every line on the road may be crossed.",
        |frame, past| {
            lines(frame, past, |sample| {
                sample.marks = (BoundaryType::DottedWhite, BoundaryType::DottedWhite);
            });
        },
    ),
    on_frame(
        "neighbours_unknown",
        "There are no neighbouring lanes.",
        |frame, past| {
            lines(frame, past, |sample| sample.neighbours = [None; 4]);
        },
    ),
    on_frame(
        "junctions_unknown",
        "No place is in a junction.",
        |frame, past| {
            lines(frame, past, |sample| sample.in_junction = false);
        },
    ),
];

/// Changes every cross-section of every line.
pub(super) fn lines(frame: &mut Frame, past: &mut Past, change: impl Fn(&mut LineSample)) {
    for line in &mut frame.lines {
        line.line = past.altered(&line.line, &change);
    }
}

fn swap_sides(sample: &mut LineSample) {
    let swapped = |(left, right): (f64, f64)| (right, left);
    sample.lane_width = swapped(sample.lane_width);
    sample.road_width = swapped(sample.road_width);
    sample.marks = (sample.marks.1, sample.marks.0);
    sample.neighbours.swap(0, 2);
    sample.neighbours.swap(1, 3);
}

fn destination_ahead(frame: &mut Frame) {
    use corridor_decider::reference_line::{LineQuery, SlPoint};
    if let (Command::PullOver(place), Some(first)) = (&mut frame.command, frame.lines.first()) {
        let SlPoint { s, l } = first.line.to_frenet(*place);
        *place = first.line.to_cartesian(SlPoint {
            s: s + DESTINATION_OFF,
            l,
        });
    }
}
