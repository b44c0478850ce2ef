//! Ends the program when an input is read without end, or fills the memory, and tells which one it was.
//!
//! A thread that hangs cannot be stopped from outside, so the whole process ends; the input stays in its file.

use crate::limits::Meter;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// Time between two looks: memory grows by less than 200 MB in it.
const LOOK: Duration = Duration::from_millis(50);

/// Exit code of a process that was ended, as of a test that fails.
const FAILED: i32 = 101;

/// What is being read.
struct AtHand {
    file: PathBuf,
    length: usize,
    meter: Meter,
}

/// Watches over one thread that reads one input after the other.
pub(crate) struct Watch {
    at_hand: Arc<Mutex<Option<AtHand>>>,
    is_over: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Watch {
    pub(crate) fn start() -> Self {
        let at_hand: Arc<Mutex<Option<AtHand>>> = Arc::default();
        let is_over: Arc<AtomicBool> = Arc::default();
        let (watched, over) = (Arc::clone(&at_hand), Arc::clone(&is_over));
        let thread = thread::spawn(move || {
            while !over.load(Ordering::Relaxed) {
                thread::sleep(LOOK);
                look(watched.lock().unwrap_or_else(PoisonError::into_inner).as_ref());
            }
        });
        Self {
            at_hand,
            is_over,
            thread: Some(thread),
        }
    }

    /// From now on this thread reads the input of `length` bytes that lies in `file`.
    pub(crate) fn begin(&self, file: &Path, length: usize) {
        self.set(Some(AtHand {
            file: file.to_owned(),
            length,
            meter: Meter::start(),
        }));
    }

    /// The input has been read.
    pub(crate) fn end(&self) {
        self.set(None);
    }

    fn set(&self, at_hand: Option<AtHand>) {
        *self.at_hand.lock().unwrap_or_else(PoisonError::into_inner) = at_hand;
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

#[expect(clippy::print_stderr, reason = "the last words of a process that ends")]
fn look(at_hand: Option<&AtHand>) {
    let Some(at_hand) = at_hand else { return };
    if let Some(excess) = at_hand.meter.excess(at_hand.length) {
        let kept = at_hand.file.with_extension("endless");
        let _ = std::fs::copy(&at_hand.file, &kept);
        eprintln!("an input {excess}, and is still being read: {}", kept.display());
        std::process::exit(FAILED);
    }
}
