//! File system events of a folder. Where there are none, as on network disks, polling takes their place.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver};
use std::time::Duration;

use notify::event::{AccessKind, AccessMode, ModifyKind, RenameMode};
use notify::{Event, EventKind, RecommendedWatcher, RecursiveMode, Watcher as _};

/// A watched folder.
pub(super) struct Events {
    /// Watches as long as it lives; `None` if the system has no events.
    _watcher: Option<RecommendedWatcher>,
    told: Receiver<notify::Result<Event>>,
}

/// An event on a file.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Told {
    /// The writer closed the file, or it was renamed: it is complete.
    Closed(PathBuf),
    /// Any other event.
    Changed(PathBuf),
}

impl Events {
    /// Watches a folder and its subfolders.
    pub(super) fn of(folder: &Path) -> Self {
        let (sender, told) = mpsc::channel();
        let watcher = notify::recommended_watcher(sender).and_then(|mut watcher| {
            watcher.watch(folder, RecursiveMode::Recursive)?;
            Ok(watcher)
        });
        Self { _watcher: watcher.ok(), told }
    }

    /// Events since the last call. Waits for the first one for at most `at_most`.
    pub(super) fn wait(&self, at_most: Duration) -> Vec<Told> {
        let first = self.told.recv_timeout(at_most);
        if matches!(first, Err(mpsc::RecvTimeoutError::Disconnected)) {
            std::thread::sleep(at_most);
        }
        // Errors of the watcher are dropped: polling finds the files.
        first.into_iter().chain(self.told.try_iter()).flatten().flat_map(files).collect()
    }
}

fn files(event: Event) -> Vec<Told> {
    let is_closed = match event.kind {
        EventKind::Access(AccessKind::Close(AccessMode::Write))
        | EventKind::Modify(ModifyKind::Name(RenameMode::To | RenameMode::Both)) => true,
        EventKind::Access(_) => return Vec::new(),
        EventKind::Any | EventKind::Create(_) | EventKind::Modify(_) | EventKind::Remove(_) | EventKind::Other => false,
    };
    event.paths.into_iter().map(|path| if is_closed { Told::Closed(path) } else { Told::Changed(path) }).collect()
}
