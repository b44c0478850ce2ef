//! Running `corridor` in a folder of its own.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A scenario that every test may spoil.
pub(crate) const GOOD: &str = "description = \"an empty street\"\nmap = \"urban_parking\"\n\n\
                               [ego]\nlane = \"1_0_-1\"\ns = 30.0\n\n\
                               [expect]\noutcome = \"progress\"\ndistance = 20.0\n";

/// A folder that is empty at first and gone at the end.
pub(crate) struct Folder(PathBuf);

/// What a run of the program came to.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Folder {
    /// The folder of the test called `name`.
    pub(crate) fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("cli-{name}"));
        // What an interrupted test has left.
        let _ = std::fs::remove_dir_all(&path);
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    pub(crate) fn put(&self, name: &str, content: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), content).unwrap();
    }

    /// Names and sizes of all that is in it.
    pub(crate) fn content(&self) -> Vec<(String, u64)> {
        let entry = |entry: std::io::Result<std::fs::DirEntry>| {
            let entry = entry.unwrap();
            let name = entry.file_name().to_string_lossy().into_owned();
            (name, entry.metadata().unwrap().len())
        };
        let mut content: Vec<_> = std::fs::read_dir(&self.0).unwrap().map(entry).collect();
        content.sort();
        content
    }

    /// The program with these arguments, here.
    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_corridor"));
        command.args(arguments).current_dir(&self.0).stdin(Stdio::null());
        command
    }

    pub(crate) fn run(&self, arguments: &[&str]) -> Run {
        let output = self.command(arguments).output().unwrap();
        let run = Run {
            code: output.status.code(),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        };
        assert!(!run.err.contains("panicked"), "{arguments:?}: {}", run.err);
        run
    }

    /// The message of a run that must fail as wrong use, print no result and leave the folder as it was.
    pub(crate) fn refused(&self, arguments: &[&str]) -> String {
        let before = self.content();
        let run = self.run(arguments);
        assert_eq!(run.code, Some(2), "{arguments:?}: {run:?}");
        assert_eq!(run.out, "", "{arguments:?}");
        assert!(run.err.starts_with("error: "), "{arguments:?}: {}", run.err);
        assert_eq!(self.content(), before, "{arguments:?} left something behind");
        run.err
    }

    /// Checks that a run is refused with all of these in its message, each no more than once.
    pub(crate) fn refuses(&self, arguments: &[&str], parts: &[&str]) {
        let message = self.refused(arguments);
        for part in parts {
            assert!(message.contains(part), "{arguments:?}: no `{part}` in {message}");
        }
        if let Some((_, system)) = message.rsplit_once(": ") {
            let system = system.trim();
            assert_eq!(message.matches(system).count(), 1, "said twice: {message}");
        }
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder that stays behind is removed by the next run.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
