//! Files that are written, and those that cannot be.

use crate::program::{Folder, GOOD};
use std::fs::OpenOptions;
use std::io::Read;
use std::os::unix::fs::FileTypeExt;
use std::process::Command;

#[test]
fn what_cannot_be_written_is_known_before_the_work() {
    let folder = Folder::new("unwritable");
    folder.put("good.toml", GOOD);
    std::fs::create_dir(folder.path("folder")).unwrap();
    for option in ["--trace", "--view"] {
        for place in ["no/such/folder/x", "folder", "good.toml/x"] {
            folder.refuses(&["run", "good.toml", option, place], &[&format!("`{place}`")]);
        }
    }
    folder.refuses(
        &["run", "good.toml", "--view", "x", "--trace", "x"],
        &["`x`", "its own file"],
    );
    for option in ["--json", "--junit"] {
        for place in ["no/such/folder/x", "folder", "good.toml/x"] {
            folder.refuses(&["sweep", "good.toml", option, place], &[&format!("`{place}`")]);
        }
    }
    folder.refuses(
        &["sweep", "good.toml", "--out", "good.toml"],
        &["cannot make the folder `good.toml`"],
    );
}

#[test]
fn a_page_leaves_nothing_beside_it_and_touches_no_trace() {
    let folder = Folder::new("page");
    folder.put("good.toml", GOOD);
    folder.put("x.trace.zst", "someone else's");
    assert_eq!(
        folder.run(&["run", "good.toml", "--view", "x.html"]).code,
        Some(0)
    );
    let names: Vec<String> = folder.content().into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["good.toml", "x.html", "x.trace.zst"]);
    assert_eq!(
        std::fs::read(folder.path("x.trace.zst")).unwrap(),
        b"someone else's"
    );
    let page = std::fs::read_to_string(folder.path("x.html")).unwrap();
    assert!(page.starts_with("<!") && page.trim_end().ends_with("</html>"));
}

#[test]
fn a_page_of_a_run_is_the_page_of_its_trace() {
    let folder = Folder::new("same-page");
    let page = |name: &str| std::fs::read_to_string(folder.path(name)).unwrap();
    folder.run(&["run", "nudge_parked_car", "--view", "a.html"]);
    folder.run(&["run", "nudge_parked_car", "--view", "b.html", "--trace", "b.zst"]);
    folder.run(&["view", "b.zst", "-o", "c.html"]);
    assert!(page("b.html") == page("c.html"));
    // Numbers of the trace were rounded twice.
    assert!(page("a.html").len().abs_diff(page("b.html").len()) < page("b.html").len() / 50);
}

#[test]
fn a_sweep_leaves_its_reports_and_a_trace_of_each_failure() {
    let folder = Folder::new("out");
    let late = GOOD
        .replace("distance = 20.0", "distance = 400.0")
        .replace("[ego]", "timeout = 2.0\n[ego]");
    folder.put("late.toml", late);
    assert_eq!(folder.run(&["sweep", "late.toml", "--out", "a/b"]).code, Some(1));
    for file in ["report.json", "report.xml", "report.txt", "late-1.trace.zst"] {
        assert!(folder.path("a/b").join(file).is_file(), "{file}");
    }
    assert_eq!(folder.run(&["replay", "a/b/late-1.trace.zst"]).code, Some(0));
}

/// A report may go to a pipe or a device: it is written to and still what it was.
#[test]
fn a_pipe_is_not_replaced_by_a_file() {
    let folder = Folder::new("pipe");
    folder.put("good.toml", GOOD);
    let pipe = folder.path("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    // Open for both, so that neither side waits for the other; a report fits into the pipe's memory.
    let mut reader = OpenOptions::new().read(true).write(true).open(&pipe).unwrap();
    assert_eq!(
        folder.run(&["sweep", "good.toml", "--json", "pipe"]).code,
        Some(0)
    );
    assert!(pipe.metadata().unwrap().file_type().is_fifo());
    let mut start = [0; 2];
    reader.read_exact(&mut start).unwrap();
    assert_eq!(&start, b"{\n");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_said() {
    let folder = Folder::new("full");
    folder.put("good.toml", GOOD);
    folder.refuses(
        &["run", "good.toml", "--trace", "/dev/full"],
        &["`/dev/full`", "No space left"],
    );
    folder.refuses(
        &["run", "good.toml", "--view", "/dev/full"],
        &["`/dev/full`", "No space left"],
    );
}
