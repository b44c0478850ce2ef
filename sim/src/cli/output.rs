//! Writing results: whole files or none.

use anyhow::Context;
use std::io::Write;
use std::path::Path;

/// Writes `text` to `path` by way of a file beside it, so that nobody ever reads half of it.
pub(crate) fn write(path: &Path, text: &str) -> anyhow::Result<()> {
    let mut partial = path.as_os_str().to_owned();
    partial.push(".partial");
    let partial = Path::new(&partial);
    let written = std::fs::write(partial, text).and_then(|()| std::fs::rename(partial, path));
    if written.is_err() {
        // The first error is the one to tell.
        let _ = std::fs::remove_file(partial);
    }
    written.with_context(|| format!("cannot write `{}`", path.display()))
}

/// Makes a folder and those above it.
pub(crate) fn make_folder(path: &Path) -> anyhow::Result<()> {
    std::fs::create_dir_all(path).with_context(|| format!("cannot make the folder `{}`", path.display()))
}

/// Prints a result. A reader that has gone away (`corridor … | head`) is no error.
pub(crate) fn print(text: &str) {
    let mut out = std::io::stdout().lock();
    let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
}
