//! Lines by themselves: both ways between frames, walking, the ends, and files.

use crate::geometry::Vec2;
use crate::reference_line::{LineQuery, LineSample, ReferenceLine, SlPoint, testing};
use crate::tasks::path_bounds::station;

#[test]
fn frenet_and_back_returns_to_the_point() {
    let line = testing::s_curve();
    for k in 0..400 {
        let s = 0.37 + f64::from(k) * 0.61;
        for l in [-3.0, -0.4, 0.0, 1.7, 4.0] {
            let there = line.to_frenet(line.to_cartesian(SlPoint { s, l }));
            assert!(
                (there.s - s).abs() < 1e-6 && (there.l - l).abs() < 1e-6,
                "{s} {l}: {there:?}"
            );
        }
    }
}

#[test]
fn walking_and_asking_one_by_one_agree() {
    let line = testing::s_curve();
    let mut walked = Vec::new();
    line.sample(3.3, 0.5, 120.0, &mut walked);
    assert_eq!(walked.len(), 234);
    for there in walked {
        assert_eq!(there, station(&line, there.s));
    }
}

#[test]
fn tangents_go_on_beyond_both_ends() {
    let line = testing::s_curve();
    let before = line.to_frenet(Vec2::new(-5.0, 2.0));
    assert!((before.s + 5.0).abs() < 1e-12 && (before.l - 2.0).abs() < 1e-12);
    assert!(line.lane_width(-0.1).is_none() && line.lane_width(line.length() + 0.1).is_none());
}

#[test]
fn a_line_survives_a_file() {
    let line = testing::s_curve();
    let samples: Vec<LineSample> = line.clone().into();
    assert_eq!(ReferenceLine::from(samples), line);
}
