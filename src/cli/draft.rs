//! Drafts of files: written beside their place and moved there when they are complete.
//!
//! A draft is named after its machine and process, and locked by the process. A process that is stopped removes its drafts;
//! leftovers of one that could not are removed by the next process that writes there.

use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Seek as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

use super::files::{cannot_write, directory};
use super::finished::failure;
use crate::machine::sha256_of;

/// Prefix and suffix of the name of a draft: machine, process and some random letters are between them.
const PREFIX: &str = ".cutc-";
const SUFFIX: &str = ".tmp";

/// Files and folders that this process removes when it is stopped.
static MAKING: Mutex<Making> =
    Mutex::new(Making { drafts: BTreeSet::new(), folders: BTreeSet::new(), swept: BTreeSet::new() });

struct Making {
    drafts: BTreeSet<PathBuf>,
    /// Folders made for programs; they stay if they have content.
    folders: BTreeSet<PathBuf>,
    /// Folders that are free of leftovers of dead processes.
    swept: BTreeSet<PathBuf>,
}

fn making() -> MutexGuard<'static, Making> {
    // Each change is one call, so a panic leaves no partial change.
    MAKING.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Making {
    /// Removes leftovers in a folder, once: later ones are removed by other processes.
    fn sweep(&mut self, folder: &Path) {
        if self.swept.insert(folder.to_owned()) {
            sweep(folder);
        }
    }
}

/// Removes the leftovers of dead processes in the folders of some files.
pub(super) fn sweep_folders<'p>(paths: impl IntoIterator<Item = &'p Path>) {
    let mut making = making();
    for path in paths {
        making.sweep(directory(path));
    }
}

/// Removes the leftovers of dead processes in a folder and everything below it.
pub(super) fn sweep_below(folder: &Path) {
    let folders = walkdir::WalkDir::new(folder).into_iter().flatten().filter(|entry| entry.file_type().is_dir());
    let mut making = making();
    folders.for_each(|entry| making.sweep(entry.path()));
}

/// Removes all drafts and folders of this process, and keeps it from making more: it is about to end.
pub(super) fn abandon() {
    let making = making();
    // Files that cannot be removed are left to the next process.
    for draft in &making.drafts {
        let _ = fs::remove_file(draft);
    }
    for folder in making.folders.iter().rev() {
        let _ = fs::remove_dir(folder);
    }
    std::mem::forget(making);
}

/// A draft of a file.
#[derive(Debug)]
pub(super) struct Draft {
    file: NamedTempFile,
    path: PathBuf,
    known: Known,
}

/// Entry of a draft in the list of this process, for as long as it exists.
#[derive(Debug)]
struct Known(PathBuf);

impl Drop for Known {
    fn drop(&mut self) {
        making().drafts.remove(&self.0);
    }
}

impl Draft {
    /// Opens a draft of the file at `path`.
    pub(super) fn new(path: &Path) -> anyhow::Result<Self> {
        let folder = directory(path);
        let prefix = format!("{PREFIX}{}-{}-", machine(), std::process::id());
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix).suffix(SUFFIX);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt as _;
            // Permissions by the umask, as for any new file: a temporary one would be readable by its owner only.
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        let mut making = making();
        making.sweep(folder);
        loop {
            let file = builder.tempfile_in(folder).map_err(|error| cannot_write(path, &error))?;
            // Until it is locked another process may take it for a leftover.
            if !matches!(file.as_file().try_lock(), Err(TryLockError::WouldBlock)) && file.path().exists() {
                let known = Known(file.path().to_owned());
                making.drafts.insert(known.0.clone());
                return Ok(Self { file, path: path.to_owned(), known });
            }
        }
    }

    /// The file under its temporary name.
    pub(super) fn file(&mut self) -> &mut File {
        self.file.as_file_mut()
    }

    /// Its future path.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Moves the complete file to its place, where no file may be.
    pub(super) fn publish_new(self) -> anyhow::Result<()> {
        let Self { file, path, known: _known } = self;
        let _making = making();
        file.persist_noclobber(&path).map_err(|error| match error.error.kind() {
            io::ErrorKind::AlreadyExists => exists(&path),
            _ => cannot_write(&path, &error.error),
        })?;
        Ok(())
    }
}

/// Writes a text to a file that is not there yet.
pub(super) fn write_new(path: &Path, text: &str) -> anyhow::Result<()> {
    let mut draft = Draft::new(path)?;
    draft.file().write_all(text.as_bytes()).map_err(|error| cannot_write(path, &error))?;
    draft.publish_new()
}

/// A complete file that is about to take its place.
pub(super) struct Whole {
    pub(super) path: PathBuf,
    pub(super) sha256: String,
}

impl Whole {
    pub(super) fn of(draft: &mut Draft) -> anyhow::Result<Self> {
        let path = draft.path().to_owned();
        let digest = draft.file().rewind().and_then(|()| sha256_of(draft.file()));
        let sha256 = digest.map_err(|error| cannot_write(&path, &error))?;
        Ok(Self { path, sha256 })
    }
}

/// Moves complete files to their places, replacing older ones, and then runs `then`. A process that is stopped meanwhile stops
/// before or after all of it. `then` must not begin a draft.
pub(super) fn publish(drafts: Vec<Draft>, then: impl FnOnce() -> anyhow::Result<()>) -> anyhow::Result<()> {
    for Draft { file, path, .. } in &drafts {
        file.as_file().sync_all().map_err(|error| cannot_write(path, &error))?;
    }
    // Entries are dropped after the lock is released: dropping needs it.
    let (known, files): (Vec<Known>, Vec<_>) =
        drafts.into_iter().map(|Draft { file, path, known }| (known, (file, path))).unzip();
    let published = put(files, then);
    drop(known);
    published
}

fn put(files: Vec<(NamedTempFile, PathBuf)>, then: impl FnOnce() -> anyhow::Result<()>) -> anyhow::Result<()> {
    let _making = making();
    let mut there = Vec::new();
    for (file, path) in files {
        file.persist(&path).map_err(|error| cannot_write(&path, &error.error))?;
        there.push(path);
    }
    // Files without their record are removed.
    then().inspect_err(|_| there.iter().for_each(|path| drop(fs::remove_file(path))))
}

/// Removes the drafts in a folder that dead processes of this machine left.
fn sweep(folder: &Path) {
    let ours = format!("{PREFIX}{}-", machine());
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let Some(rest) = name.strip_prefix(&ours).and_then(|rest| rest.strip_suffix(SUFFIX)) else { continue };
        // The name of another machine may begin with that of this one.
        if rest.split_once('-').is_none_or(|(process, _)| process.parse::<u32>().is_err()) {
            continue;
        }
        // Locked until the file is gone, so that its maker, if it has just begun, begins another. Opened for writing: network
        // file systems lock no other files.
        if let Ok(file) = OpenOptions::new().read(true).write(true).open(entry.path())
            && file.try_lock().is_ok()
        {
            let _ = fs::remove_file(entry.path()); // it may be another user's
        }
    }
}

/// Name of this machine, with characters that are valid in a file name.
fn machine() -> String {
    let name = gethostname::gethostname();
    name.to_string_lossy().chars().map(|c| if c.is_ascii_alphanumeric() || c == '.' { c } else { '_' }).collect()
}

fn exists(path: &Path) -> anyhow::Error {
    failure(format!("`{}` exists: it is not overwritten", path.display()), "give another name, or move it away first")
}

/// Folders that were made for programs; those that are empty in the end are removed.
#[derive(Debug, Default)]
pub(super) struct MadeFolders(Vec<PathBuf>);

impl MadeFolders {
    /// Makes the folders of some files, with their parents.
    pub(super) fn of<'p>(paths: impl IntoIterator<Item = &'p Path>) -> anyhow::Result<Self> {
        let mut made = Self::default();
        for path in paths {
            made.make(directory(path)).map_err(|error| cannot_write(path, &error))?;
        }
        Ok(made)
    }

    fn make(&mut self, folder: &Path) -> io::Result<()> {
        if folder.as_os_str().is_empty() || folder.is_dir() {
            return Ok(());
        }
        self.make(folder.parent().unwrap_or(Path::new("")))?;
        let mut making = making();
        match fs::create_dir(folder) {
            Ok(()) => {
                making.folders.insert(folder.to_owned());
                self.0.push(folder.to_owned());
                Ok(())
            }
            // Another process has made it.
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Ok(()),
            Err(error) => Err(error),
        }
    }
}

impl MadeFolders {
    /// Keeps them, empty or not.
    pub(super) fn keep(&mut self) {
        let mut making = making();
        for folder in self.0.drain(..) {
            making.folders.remove(&folder);
        }
    }
}

impl Drop for MadeFolders {
    fn drop(&mut self) {
        let mut making = making();
        for folder in self.0.iter().rev() {
            // Only an empty folder can be removed, as intended.
            let _ = fs::remove_dir(folder);
            making.folders.remove(folder);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use super::*;

    #[test]
    fn folders_that_were_made_stay_with_what_is_in_them() {
        let directory = tempfile::tempdir().expect("a directory");
        let program = directory.path().join("out").join("a").join("x.csv");
        let other = directory.path().join("out").join("b").join("x.csv");
        drop(MadeFolders::of([program.as_path(), &other]).expect("writable"));
        assert!(!directory.path().join("out").exists());
        let made = MadeFolders::of([program.as_path(), &other]).expect("writable");
        fs::write(&program, "t_s").expect("writable");
        drop(made);
        assert!(program.exists() && !directory.path().join("out").join("b").exists());
        assert!(MadeFolders::of([program.as_path()]).expect("writable").0.is_empty());
    }

    #[test]
    fn a_draft_leaves_nothing_until_it_is_whole() {
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path().join("x.csv");
        let mut draft = Draft::new(&path).expect("a draft");
        draft.file().write_all(b"half").expect("writable");
        assert!(!path.exists());
        drop(draft);
        assert_eq!(fs::read_dir(directory.path()).expect("readable").count(), 0);
        let mut draft = Draft::new(&path).expect("a draft");
        draft.file().write_all(b"whole").expect("writable");
        publish(vec![draft], || Ok(())).expect("published");
        assert_eq!(fs::read(&path).expect("readable"), b"whole");
        let refused = Draft::new(&path).expect("a draft").publish_new().expect_err("refused");
        assert!(refused.to_string().contains("not overwritten"));
        assert_eq!(fs::read(&path).expect("readable"), b"whole");
    }

    #[test]
    fn what_cannot_take_its_place_leaves_none_waiting() {
        let directory = tempfile::tempdir().expect("a directory");
        let at = |name: &str| directory.path().join(name);
        fs::create_dir(at("a")).expect("writable");
        let drafts = || vec![Draft::new(&at("a")).expect("a draft"), Draft::new(&at("b")).expect("a draft")];
        assert!(publish(drafts(), || Ok(())).is_err());
        fs::remove_dir(at("a")).expect("removable");
        assert!(publish(drafts(), || Err(failure("the disk is full", ""))).is_err());
        assert_eq!(fs::read_dir(directory.path()).expect("readable").count(), 0);
        publish(drafts(), || Ok(())).expect("nobody waits for anything");
        assert!(at("a").is_file() && at("b").is_file());
    }

    #[test]
    fn what_gone_processes_left_is_swept_and_nothing_else() {
        let directory = tempfile::tempdir().expect("a directory");
        let at = |name: String| directory.path().join(name);
        let left = at(format!("{PREFIX}{}-4194305-a1B2c3{SUFFIX}", machine()));
        let kept = [
            at(format!("{PREFIX}{}-other-4194305-a1B2c3{SUFFIX}", machine())),
            at(format!("{PREFIX}elsewhere-1-a1B2c3{SUFFIX}")),
            at(format!("{PREFIX}notes.txt")),
        ];
        fs::write(&left, "half").expect("writable");
        for path in &kept {
            fs::write(path, "kept").expect("writable");
        }
        let draft = Draft::new(&at("x.csv".to_owned())).expect("a draft");
        sweep(directory.path());
        assert!(!left.exists() && kept.iter().all(|path| path.exists()));
        assert!(draft.file.path().exists(), "a draft that is held stays");
    }
}
