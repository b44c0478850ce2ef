//! Writing and reading: nothing lost but digits, nothing read that was not written.

use super::record::TickRecord;
use super::{Trace, TraceError, TraceWriter, synthetic};
use corridor_decider::frame::ObstacleId;
use corridor_decider::tasks::path_bounds::EdgeCause;
use proptest::prelude::*;
use std::path::{Path, PathBuf};

/// A file that goes away with its test.
struct Temporary(PathBuf);

impl Temporary {
    fn new(name: &str) -> Self {
        let name = format!("corridor-trace-{}-{name}.trace", std::process::id());
        Self(std::env::temp_dir().join(name))
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

fn write(trace: &Trace, path: &Path) {
    let mut writer = TraceWriter::create(path, &trace.header).unwrap();
    for tick in &trace.ticks {
        writer.tick(tick).unwrap();
    }
    if let Some(verdict) = &trace.verdict {
        writer.finish(verdict).unwrap();
    }
}

fn bytes(trace: &Trace, name: &str) -> Vec<u8> {
    let file = Temporary::new(name);
    write(trace, &file.0);
    std::fs::read(&file.0).unwrap()
}

fn read(bytes: &[u8]) -> Result<Trace, TraceError> {
    Trace::read(bytes, Path::new("test.trace"), 1 << 26)
}

fn compress(text: &str) -> Vec<u8> {
    zstd::encode_all(text.as_bytes(), 1).unwrap()
}

fn assert_close(a: f64, b: f64) {
    let same = a.to_bits() == b.to_bits() || (a - b).abs() <= 0.500_001e-4 || (a.is_nan() && b.is_nan());
    assert!(same, "{a} was read as {b}");
}

/// Equal but for the digits that the writer drops.
fn assert_same_tick(written: &TickRecord, read: &TickRecord) {
    assert_eq!(written.frame, read.frame);
    assert_eq!(written.lines, read.lines);
    assert_eq!(written.controls, read.controls);
    assert_eq!(written.ego, read.ego);
    assert_eq!((&written.hash, &written.events), (&read.hash, &read.events));
    let (a, b) = (&written.decision, &read.decision);
    assert_eq!((a.line, a.chosen, a.outcome), (b.line, b.chosen, b.outcome));
    assert_eq!(a.candidates.len(), b.candidates.len());
    for (a, b) in a.candidates.iter().zip(&b.candidates) {
        assert_eq!(a.assessment, b.assessment);
        assert_eq!(
            (a.bound.label, a.bound.blocked_by, a.bound.padding),
            (b.bound.label, b.bound.blocked_by, b.bound.padding)
        );
        assert_eq!(a.bound.points.len(), b.bound.points.len());
        for (a, b) in a.bound.points.iter().zip(&b.bound.points) {
            assert_eq!((a.left, a.right), (b.left, b.right));
            assert_close(a.s, b.s);
            assert_close(a.l_min, b.l_min);
            assert_close(a.l_max, b.l_max);
        }
    }
    assert_eq!(
        (a.path.len(), a.trajectory.len()),
        (b.path.len(), b.trajectory.len())
    );
    for (a, b) in a.path.iter().zip(&b.path) {
        assert_close(a.l, b.l);
        assert_close(a.pose.x, b.pose.x);
        assert_close(a.kappa, b.kappa);
    }
    for (a, b) in a.trajectory.iter().zip(&b.trajectory) {
        assert_close(a.t, b.t);
        assert_close(a.pose.y, b.pose.y);
        assert_close(a.v, b.v);
    }
}

#[test]
fn what_is_written_is_read() {
    let written = synthetic::trace(40, 5);
    let trace = read(&bytes(&written, "roundtrip")).unwrap();
    assert!(!trace.truncated);
    assert_eq!(trace.verdict, written.verdict);
    assert_eq!(trace.header.lines, written.header.lines);
    assert_eq!(trace.header.source, written.header.source);
    assert_eq!(trace.ticks.len(), 40);
    for (a, b) in written.ticks.iter().zip(&trace.ticks) {
        assert_same_tick(a, b);
    }
}

#[test]
fn a_frame_gets_its_lines_back() {
    let trace = read(&bytes(&synthetic::trace(3, 3), "frame")).unwrap();
    let frame = trace.frame(2).unwrap();
    assert_eq!(frame.lines.len(), 1);
    assert_eq!(frame.lines[0].line, trace.header.lines[0]);
    assert_eq!(frame.obstacles, trace.ticks[2].frame.obstacles);
    assert!(trace.frame(3).is_none());
}

#[test]
fn lines_left_in_a_frame_are_not_written_twice() {
    let plain = synthetic::trace(20, 3);
    let mut full = plain.clone();
    for k in 0..20 {
        full.ticks[k].frame = plain.frame(k).unwrap();
    }
    assert_eq!(bytes(&plain, "plain"), bytes(&full, "full"));
}

#[test]
fn times_typed_in_decimals_find_their_tick() {
    let trace = synthetic::trace(30, 3);
    let times = [
        (-1.0, 0),
        (0.0, 0),
        (0.3, 3),
        (0.35, 3),
        (0.6, 6),
        (2.3, 23),
        (99.0, 29),
    ];
    for (time, tick) in times {
        assert_eq!(trace.tick_at(time), Some(tick), "at {time}");
    }
    assert_eq!(synthetic::trace(0, 3).tick_at(1.0), None);
}

#[test]
fn every_truncation_gives_an_error_or_a_shorter_trace() {
    let written = synthetic::trace(25, 3);
    let whole = bytes(&written, "truncation");
    let mut most = 0;
    for length in (0..whole.len()).step_by(37).chain(whole.len() - 40..whole.len()) {
        let Ok(trace) = read(&whole[..length]) else {
            continue;
        };
        assert!(
            trace.truncated,
            "{length} of {} bytes count as whole",
            whole.len()
        );
        assert!(trace.ticks.len() >= most, "more bytes, fewer ticks");
        most = trace.ticks.len();
        for (a, b) in written.ticks.iter().zip(&trace.ticks) {
            assert_same_tick(a, b);
        }
    }
    assert_eq!(most, 25);
}

#[test]
fn a_killed_run_leaves_all_but_its_last_second() {
    let written = synthetic::trace(37, 3);
    let file = Temporary::new("killed");
    let mut writer = TraceWriter::create(&file.0, &written.header).unwrap();
    for tick in &written.ticks {
        writer.tick(tick).unwrap();
    }
    let so_far = Trace::open(&file.0).unwrap();
    assert!(so_far.truncated && so_far.verdict.is_none());
    assert_eq!(so_far.ticks.len(), 30, "flushed every second");
    drop(writer);
    assert_eq!(
        Trace::open(&file.0).unwrap().ticks.len(),
        37,
        "flushed at the end"
    );
}

#[test]
fn numbers_that_are_none_in_a_decision_survive() {
    let mut written = synthetic::trace(2, 3);
    let decision = &mut written.ticks[1].decision;
    decision.path[3].l = f64::NAN;
    decision.candidates[1].bound.points[0].l_max = f64::INFINITY;
    decision.candidates[1].bound.points[1].l_min = f64::NEG_INFINITY;
    decision.candidates[1].bound.points[2].l_min = f64::MIN;
    let trace = read(&bytes(&written, "nan")).unwrap();
    assert_same_tick(&written.ticks[1], &trace.ticks[1]);
}

#[test]
fn a_frame_that_could_not_be_read_back_is_refused_and_leaves_nothing() {
    let mut written = synthetic::trace(3, 3);
    written.ticks[1].frame.ego.v = f64::NAN;
    let file = Temporary::new("not-finite");
    let mut writer = TraceWriter::create(&file.0, &written.header).unwrap();
    writer.tick(&written.ticks[0]).unwrap();
    let refused = writer.tick(&written.ticks[1]);
    assert!(
        matches!(refused, Err(TraceError::NotFinite { tick: 1 })),
        "{refused:?}"
    );
    writer.tick(&written.ticks[2]).unwrap();
    drop(writer);
    assert_eq!(Trace::open(&file.0).unwrap().ticks.len(), 2);
}

#[test]
fn other_files_are_refused_with_a_reason() {
    let message = |bytes: &[u8]| read(bytes).unwrap_err().to_string();
    assert!(message(b"").contains("is empty"));
    assert!(message(b"seed = 7\n").contains("not compressed with zstd"));
    assert!(message(&compress("hello\n")).contains("its first line is no header"));
    let old = compress("{\"header\":{\"format\":99,\"new\":1}}\n");
    assert_eq!(
        message(&old),
        "`test.trace` has trace format 99; this program reads format 3"
    );
    assert!(message(&compress("{\"header\":{\"format\":3}}\n")).contains("line 1: missing field"));
    assert!(message(&compress("")).contains("is empty"));
    let missing = Trace::open(Path::new("no/such.trace")).unwrap_err();
    assert!(matches!(missing, TraceError::Io { .. }));
}

/// The text of a small trace with one replacement.
fn tampered(from: &str, to: &str) -> String {
    let whole = bytes(&synthetic::trace(2, 3), &format!("tampered-{}", from.len()));
    let text = String::from_utf8(zstd::decode_all(&whole[..]).unwrap()).unwrap();
    assert!(text.contains(from), "`{from}` is not in the trace");
    read(&compress(&text.replacen(from, to, 1)))
        .unwrap_err()
        .to_string()
}

#[test]
fn wrong_references_and_lengths_are_refused_with_their_line() {
    let message = tampered("\"lines\":[[0,false]]", "\"lines\":[[9,false]]");
    assert!(message.contains("line 2: refers to line 9 of 1"), "{message}");
    let message = tampered("\"chosen\":2", "\"chosen\":44");
    assert!(message.contains("line 2: chose a candidate beyond"), "{message}");
    let message = tampered(
        "\"right\":[[\"road_edge\",200]]",
        "\"right\":[[\"road_edge\",4000000000000]]",
    );
    assert!(message.contains("4000000000000 causes on the right"), "{message}");
    let message = tampered("\"first_s\"", "\"l_mid\"");
    assert!(message.contains("unknown field `l_mid`"), "{message}");
    let message = tampered("\"kappa\":[", "\"kappa\":[1,");
    assert!(message.contains("invalid length 201"), "{message}");
}

#[test]
fn a_bomb_is_an_error() {
    let zeros = zstd::encode_all(std::io::repeat(b'0').take_bytes(1 << 24), 1).unwrap();
    let bomb = Trace::read(&zeros[..], Path::new("bomb"), 1 << 20).unwrap_err();
    assert!(
        matches!(
            bomb,
            TraceError::TooLong {
                line: 1,
                limit: 1_048_576,
                ..
            }
        ),
        "{bomb}"
    );
}

/// `Read::take` by another name, so that the call above reads well.
trait TakeBytes: std::io::Read + Sized {
    fn take_bytes(self, count: u64) -> std::io::Take<Self> {
        self.take(count)
    }
}

impl TakeBytes for std::io::Repeat {}

proptest! {
    #[test]
    fn any_bounds_survive(
        edges in prop::collection::vec((any::<f64>(), any::<f64>(), 0..9_u32, 0..9_u32), 0..60),
        start in -1e4..1e4_f64,
        uneven in any::<bool>(),
    ) {
        let cause = |k: u32| match k {
            0 => EdgeCause::Unbounded,
            1 => EdgeCause::RoadEdge,
            2 => EdgeCause::LaneChangeZone,
            3..=5 => EdgeCause::LaneLine,
            id => EdgeCause::Obstacle(ObstacleId(id)),
        };
        let mut written = synthetic::trace(1, 3);
        let bound = &mut written.ticks[0].decision.candidates[0].bound;
        let mut point = bound.points[0];
        bound.points.clear();
        for (k, (l_min, l_max, right, left)) in edges.into_iter().enumerate() {
            let bend = if uneven { 0.01 * (k * k) as f64 } else { 0.0 };
            point.s = start + k as f64 * bound.delta_s + bend;
            (point.l_min, point.l_max) = (l_min, l_max);
            (point.right, point.left) = (cause(right), cause(left));
            bound.points.push(point);
        }
        // Exact text first: the columns alone lose nothing.
        let text = serde_json::to_string(&*bound).unwrap();
        let back: corridor_decider::tasks::path_bounds::PathBound = serde_json::from_str(&text).unwrap();
        prop_assert_eq!(format!("{:?}", bound), format!("{:?}", back));
    }

    #[test]
    fn garbage_never_panics(noise in prop::collection::vec(any::<u8>(), 0..300), at in 0..4000_usize) {
        prop_assert!(read(&noise).is_err());
        let mut text = zstd::decode_all(&bytes(&synthetic::trace(1, 3), "garbage")[..]).unwrap();
        let tick_line = text.iter().position(|b| *b == b'\n').unwrap() + 1;
        for (k, byte) in noise.iter().take(3).enumerate() {
            let place = tick_line + (at + 97 * k) % (text.len() - tick_line);
            text[place] = *byte;
        }
        if let Ok(trace) = read(&zstd::encode_all(&text[..], 1).unwrap()) {
            prop_assert!(trace.ticks.len() <= 1);
        }
    }
}

/// Prints what a large trace costs. Not a check: the machine decides.
#[test]
#[ignore = "a measurement: run with --release --nocapture"]
#[expect(clippy::disallowed_types, clippy::print_stdout, reason = "a measurement")]
fn cost_of_a_large_trace() {
    let trace = synthetic::trace(600, 20);
    let file = Temporary::new("cost");
    // The fastest of several: what else the machine does is not our cost.
    let timed = |action: &dyn Fn()| {
        let once = || {
            let start = std::time::Instant::now();
            action();
            start.elapsed()
        };
        (0..10).map(|_| once()).min().unwrap()
    };
    let writing = timed(&|| write(&trace, &file.0));
    let size = std::fs::metadata(&file.0).unwrap().len();
    let reading = timed(&|| assert_eq!(Trace::open(&file.0).unwrap().ticks.len(), 600));
    println!(
        "{size} bytes, {:?} a tick to write, {:?} to read",
        writing / 600,
        reading / 600
    );
}
