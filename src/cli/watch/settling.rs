//! Detection of finished files: renamed into the folder, closed by their writer, or unchanged in size and time for a while.

use std::collections::BTreeMap;
use std::fs::Metadata;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

/// Time for which a file must stay unchanged if no event reports that it was closed.
pub(super) const STEADY: Duration = Duration::from_secs(1);
/// Delay before another attempt at a file that could not be read or whose program could not be written, such as on a full disk.
const AGAIN: Duration = Duration::from_secs(5);

/// State of a file by which changes are detected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Stamp {
    bytes: u64,
    changed: Option<SystemTime>,
    /// Inode and time of the last status change (seconds, nanoseconds), which no program can set.
    #[cfg(unix)]
    file: (u64, i64, i64),
}

impl Stamp {
    /// The stamp of a file from its metadata.
    pub(super) fn of(known: &Metadata) -> Self {
        #[cfg(unix)]
        use std::os::unix::fs::MetadataExt as _;
        Self {
            bytes: known.len(),
            changed: known.modified().ok(),
            #[cfg(unix)]
            file: (known.ino(), known.ctime(), known.ctime_nsec()),
        }
    }

    /// The stamp of the file at a path; `None` if there is no file.
    pub(super) fn at(path: &Path) -> Option<Self> {
        path.metadata().ok().map(|known| Self::of(&known))
    }
}

/// The files of a folder as last seen.
#[derive(Debug, Default)]
pub(super) struct Settling {
    files: BTreeMap<PathBuf, Seen>,
}

#[derive(Debug)]
struct Seen {
    stamp: Stamp,
    state: State,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    /// Waiting; the file may be finished from this time on.
    From(Instant),
    /// Processed.
    Done,
}

impl Settling {
    /// Records a file that was seen. An unchanged file keeps its state.
    pub(super) fn see(&mut self, path: &Path, stamp: Stamp, now: Instant) {
        match self.files.get_mut(path) {
            Some(seen) if seen.stamp == stamp => {}
            _ => {
                self.files.insert(path.to_owned(), Seen { stamp, state: State::From(now + STEADY) });
            }
        }
    }

    /// Records a file that was closed by its writer or renamed. It is finished in its current state.
    pub(super) fn close(&mut self, path: &Path, stamp: Stamp, now: Instant) {
        let is_done = self.files.get(path).is_some_and(|seen| seen.stamp == stamp && seen.state == State::Done);
        if !is_done {
            self.files.insert(path.to_owned(), Seen { stamp, state: State::From(now) });
        }
    }

    /// The finished files, in order, with their stamps.
    pub(super) fn ready(&self, now: Instant) -> Vec<(PathBuf, Stamp)> {
        let is_ready = |seen: &Seen| matches!(seen.state, State::From(then) if then <= now);
        let ready = self.files.iter().filter(|(_, seen)| is_ready(seen));
        ready.map(|(path, seen)| (path.clone(), seen.stamp)).collect()
    }

    /// Marks a file as processed if it still has the given stamp.
    pub(super) fn done(&mut self, path: &Path, stamp: Stamp) {
        self.set(path, stamp, State::Done);
    }

    /// Schedules another attempt at a file, even if it does not change.
    pub(super) fn again(&mut self, path: &Path, stamp: Stamp, now: Instant) {
        self.set(path, stamp, State::From(now + AGAIN));
    }

    fn set(&mut self, path: &Path, stamp: Stamp, state: State) {
        // A file that changed since counts as another one.
        if let Some(seen) = self.files.get_mut(path).filter(|seen| seen.stamp == stamp) {
            seen.state = state;
        }
    }

    /// Marks all files for processing.
    pub(super) fn renew(&mut self, now: Instant) {
        for seen in self.files.values_mut().filter(|seen| seen.state == State::Done) {
            seen.state = State::From(now);
        }
    }

    /// Drops the files that no longer exist, and returns their paths.
    pub(super) fn keep(&mut self, is_there: impl Fn(&Path) -> bool) -> Vec<PathBuf> {
        let gone: Vec<_> = self.files.keys().filter(|path| !is_there(path)).cloned().collect();
        for path in &gone {
            self.files.remove(path);
        }
        gone
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stamp(bytes: u64) -> Stamp {
        Stamp {
            bytes,
            changed: None,
            #[cfg(unix)]
            file: (0, 0, 0),
        }
    }

    #[test]
    fn a_file_is_finished_when_it_is_closed_or_steady() {
        let (mut files, start) = (Settling::default(), Instant::now());
        let (slow, closed) = (Path::new("slow.cut"), Path::new("closed.cut"));
        let names = |files: &Settling, after: Duration| -> Vec<PathBuf> {
            files.ready(start + after).into_iter().map(|(path, _)| path).collect()
        };
        files.see(slow, stamp(1), start);
        files.see(closed, stamp(1), start);
        files.close(closed, stamp(9), start);
        assert_eq!(names(&files, Duration::ZERO), [closed]);
        files.done(closed, stamp(9));
        // The file grows, so its time begins anew.
        files.see(slow, stamp(2), start + STEADY / 2);
        assert!(names(&files, STEADY).is_empty());
        assert_eq!(names(&files, STEADY * 3 / 2), [slow]);
        // A processed file is not processed again unless it changes.
        files.done(slow, stamp(2));
        files.see(slow, stamp(2), start + STEADY * 2);
        files.close(slow, stamp(2), start + STEADY * 2);
        assert!(names(&files, STEADY * 4).is_empty());
        files.see(slow, stamp(3), start + STEADY * 2);
        assert_eq!(names(&files, STEADY * 4), [slow]);
    }

    #[test]
    fn what_failed_waits_and_what_changed_meanwhile_is_not_done() {
        let (mut files, start) = (Settling::default(), Instant::now());
        let path = Path::new("a.cut");
        files.close(path, stamp(1), start);
        files.again(path, stamp(1), start);
        assert!(files.ready(start + AGAIN / 2).is_empty());
        assert_eq!(files.ready(start + AGAIN).len(), 1);
        files.close(path, stamp(2), start);
        files.done(path, stamp(1));
        assert_eq!(files.ready(start), [(path.to_owned(), stamp(2))]);
        files.done(path, stamp(2));
        files.renew(start);
        assert_eq!(files.ready(start).len(), 1);
        assert_eq!(files.keep(|_| false), [path]);
        assert!(files.ready(start).is_empty());
    }
}
