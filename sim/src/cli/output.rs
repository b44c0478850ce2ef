//! Writing results: whole files or none, and never a panic because nobody reads.

use anyhow::Context;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Makes sure that `write` will be able to write `path`, before any work is done for it. Leaves nothing behind.
pub(crate) fn check(path: &Path) -> anyhow::Result<()> {
    anyhow::ensure!(
        !path.is_dir(),
        "cannot write `{}`: it is a folder, the name of a file is wanted",
        path.display()
    );
    if is_special(path) {
        return Ok(());
    }
    let partial = partial(path);
    File::create(&partial)
        .and_then(|_| std::fs::remove_file(&partial))
        .with_context(|| format!("cannot write `{}`", path.display()))
}

/// Writes `text` to `path` by way of a file beside it, so that nobody ever reads half of it.
pub(crate) fn write(path: &Path, text: &str) -> anyhow::Result<()> {
    write_with(path, |mut file| Ok(file.write_all(text.as_bytes())?))
}

/// The same for what is too long to be held: `fill` writes it piece by piece.
pub(crate) fn write_with(path: &Path, fill: impl FnOnce(File) -> anyhow::Result<()>) -> anyhow::Result<()> {
    let written = if is_special(path) {
        File::options()
            .write(true)
            .open(path)
            .map_err(Into::into)
            .and_then(fill)
    } else {
        let partial = partial(path);
        let filled = File::create(&partial).map_err(Into::into).and_then(fill);
        let written = filled.and_then(|()| Ok(std::fs::rename(&partial, path)?));
        if written.is_err() {
            // The first error is the one to tell.
            let _ = std::fs::remove_file(&partial);
        }
        written
    };
    written.with_context(|| format!("cannot write `{}`", path.display()))
}

/// Writes several files, all of them or none: the first is only put in place when the last is written.
pub(crate) fn write_all(files: &[(PathBuf, Vec<u8>)]) -> anyhow::Result<()> {
    for (path, _) in files {
        check(path)?;
    }
    let staged = files.iter().try_for_each(|(path, content)| {
        let written = if is_special(path) {
            Ok(())
        } else {
            std::fs::write(partial(path), content)
        };
        written.with_context(|| format!("cannot write `{}`", path.display()))
    });
    let placed = staged.and_then(|()| {
        files.iter().try_for_each(|(path, content)| {
            let placed = if is_special(path) {
                std::fs::write(path, content)
            } else {
                std::fs::rename(partial(path), path)
            };
            placed.with_context(|| format!("cannot write `{}`", path.display()))
        })
    });
    if placed.is_err() {
        for (path, _) in files {
            // The first error is the one to tell.
            let _ = std::fs::remove_file(partial(path));
        }
    }
    placed
}

/// Whether this is a pipe or a device: such a thing is written to and never replaced.
fn is_special(path: &Path) -> bool {
    path.metadata().is_ok_and(|what| !what.is_file())
}

fn partial(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".partial");
    name.into()
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

/// Prints a line for people, beside the results. Nobody has to read it either.
pub(crate) fn note(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}
