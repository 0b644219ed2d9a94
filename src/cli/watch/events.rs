//! What a file system tells of a folder. Where it tells nothing, as of disks in the network, looking will do.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver};
use std::time::Duration;

use notify::event::{AccessKind, AccessMode, ModifyKind, RenameMode};
use notify::{Event, EventKind, RecommendedWatcher, RecursiveMode, Watcher as _};

/// A folder that is listened to.
pub(super) struct Events {
    /// Listens for as long as it is there; `None` where the system does not tell.
    _watcher: Option<RecommendedWatcher>,
    told: Receiver<notify::Result<Event>>,
}

/// What was told of a file.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Told {
    /// It was closed by who wrote it, or renamed: it is whole.
    Closed(PathBuf),
    /// Something else.
    Changed(PathBuf),
}

impl Events {
    /// Begins to listen to a folder and those below it.
    pub(super) fn of(folder: &Path) -> Self {
        let (sender, told) = mpsc::channel();
        let watcher = notify::recommended_watcher(sender).and_then(|mut watcher| {
            watcher.watch(folder, RecursiveMode::Recursive)?;
            Ok(watcher)
        });
        Self { _watcher: watcher.ok(), told }
    }

    /// What was told up to now; waits so long at most for the first.
    pub(super) fn wait(&self, at_most: Duration) -> Vec<Told> {
        let first = self.told.recv_timeout(at_most);
        if matches!(first, Err(mpsc::RecvTimeoutError::Disconnected)) {
            std::thread::sleep(at_most);
        }
        // What it failed to tell is found by looking.
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
