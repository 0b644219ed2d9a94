//! Which files are finished: renamed in, closed by who wrote them, or of the same size and time for a while.

use std::collections::BTreeMap;
use std::fs::Metadata;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

/// How long a file that nobody was seen to close must stay as it is.
pub(super) const STEADY: Duration = Duration::from_secs(1);
/// How long a file waits that could not be read or whose program could not be written: a disk may have room again.
const AGAIN: Duration = Duration::from_secs(5);

/// What tells that a file was changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Stamp {
    bytes: u64,
    changed: Option<SystemTime>,
    /// Which file it is, and when its bytes or name were changed, whatever time it was given: seconds, nanoseconds.
    #[cfg(unix)]
    file: (u64, i64, i64),
}

impl Stamp {
    /// That of a file as its file system knows it.
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

    /// That of the file at a path; `None` when there is none.
    pub(super) fn at(path: &Path) -> Option<Self> {
        path.metadata().ok().map(|known| Self::of(&known))
    }
}

/// The files of a folder, as they were last seen.
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
    /// It may be finished from then on.
    From(Instant),
    /// It is dealt with.
    Done,
}

impl Settling {
    /// A file was seen. One that was not changed since stays what it is.
    pub(super) fn see(&mut self, path: &Path, stamp: Stamp, now: Instant) {
        match self.files.get_mut(path) {
            Some(seen) if seen.stamp == stamp => {}
            _ => {
                self.files.insert(path.to_owned(), Seen { stamp, state: State::From(now + STEADY) });
            }
        }
    }

    /// A file was closed by who wrote it, or renamed: it is finished as it is now.
    pub(super) fn close(&mut self, path: &Path, stamp: Stamp, now: Instant) {
        let is_done = self.files.get(path).is_some_and(|seen| seen.stamp == stamp && seen.state == State::Done);
        if !is_done {
            self.files.insert(path.to_owned(), Seen { stamp, state: State::From(now) });
        }
    }

    /// The files that are finished, in order, with what they looked like then.
    pub(super) fn ready(&self, now: Instant) -> Vec<(PathBuf, Stamp)> {
        let is_ready = |seen: &Seen| matches!(seen.state, State::From(then) if then <= now);
        let ready = self.files.iter().filter(|(_, seen)| is_ready(seen));
        ready.map(|(path, seen)| (path.clone(), seen.stamp)).collect()
    }

    /// A file was dealt with as it looked then.
    pub(super) fn done(&mut self, path: &Path, stamp: Stamp) {
        self.set(path, stamp, State::Done);
    }

    /// A file is looked at again later, even if nobody changes it.
    pub(super) fn again(&mut self, path: &Path, stamp: Stamp, now: Instant) {
        self.set(path, stamp, State::From(now + AGAIN));
    }

    fn set(&mut self, path: &Path, stamp: Stamp, state: State) {
        // Changed since, it is another file.
        if let Some(seen) = self.files.get_mut(path).filter(|seen| seen.stamp == stamp) {
            seen.state = state;
        }
    }

    /// All files are to be dealt with anew.
    pub(super) fn renew(&mut self, now: Instant) {
        for seen in self.files.values_mut().filter(|seen| seen.state == State::Done) {
            seen.state = State::From(now);
        }
    }

    /// Forgets the files that are not there any more, and gives them.
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
        // It grows: the time begins anew.
        files.see(slow, stamp(2), start + STEADY / 2);
        assert!(names(&files, STEADY).is_empty());
        assert_eq!(names(&files, STEADY * 3 / 2), [slow]);
        // What was dealt with is not again, unless it is changed.
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
