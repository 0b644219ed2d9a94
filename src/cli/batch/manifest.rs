//! Manifest of a folder of programs: `cutc.jsonl`, a line for the outcome of each file. A run adds a line for every file that
//! it finishes, and leaves the lines sorted, so that the manifest does not depend on the order of the work.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsStr;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, BufReader, Read as _, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use serde::{Deserialize, Serialize};

use super::Input;
use super::found::{Found, worst};
use super::shard::Shard;
use crate::cli::draft::{self, Draft, Whole};
use crate::cli::files::{cannot_write, directory, meta};
use crate::cli::finished::Console;
use crate::diagnostic::Diagnostics;
use crate::machine::{MachineProfile, sha256_hex, sha256_of};
use crate::source::Source;

/// The name of a manifest; prefix and suffix of those of parts.
const NAME: &str = "cutc.jsonl";
const PART: [&str; 2] = ["cutc.", ".jsonl"];

/// True if a file is a manifest by its name, of a folder or of a part.
pub(in crate::cli) fn is_manifest(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name == NAME || name.starts_with(PART[0]) && name.ends_with(PART[1])
}

/// Ingredients of the programs of a file; equal ingredients give equal bytes.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(in crate::cli) struct Made {
    /// The input's name below its folder.
    pub(in crate::cli) source: String,
    /// Targets that were written.
    pub(in crate::cli) targets: Vec<String>,
    pub(in crate::cli) source_sha256: String,
    /// Digest of the values in effect.
    pub(in crate::cli) profile_sha256: String,
    /// Other options, as typed.
    pub(in crate::cli) options: String,
    /// Version of this program.
    pub(in crate::cli) version: String,
}

impl Made {
    /// Ingredients of the programs of an input; `options` are as typed and may be empty.
    pub(in crate::cli) fn of(
        (input, source): (&Input, &Source),
        targets: impl Iterator<Item = &'static str>,
        profile: &MachineProfile,
        mut options: Vec<String>,
    ) -> Self {
        options.retain(|option| !option.is_empty());
        Self {
            source: input.key(),
            targets: targets.map(str::to_owned).collect(),
            source_sha256: sha256_hex(source.bytes()),
            profile_sha256: profile.digest(),
            options: options.join(" "),
            version: env!("CARGO_PKG_VERSION").to_owned(),
        }
    }
}

/// A file that was written.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(in crate::cli) struct Output {
    /// Path below the folder of the manifest.
    pub(in crate::cli) path: String,
    pub(in crate::cli) sha256: String,
}

/// Verdict on the programs of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(in crate::cli) enum Standing {
    /// Its programs were read back and proven.
    Verified,
    /// The programs were not read back, because of `--no-verify`.
    Unverified,
    /// The file has errors, or its programs failed: there are none.
    Refused,
}

/// Outcome of one file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(in crate::cli) struct Line {
    #[serde(flatten)]
    pub(in crate::cli) made: Made,
    pub(in crate::cli) verdict: Standing,
    /// Programs, and pictures of refused ones.
    pub(in crate::cli) outputs: Vec<Output>,
    /// Number of pieces; `None` if the file could not be read.
    pub(in crate::cli) pieces: Option<usize>,
    /// Length of the cuts, m.
    pub(in crate::cli) cut_m: Option<f64>,
    /// Time of the program, s, if it was planned.
    pub(in crate::cli) time_s: Option<f64>,
    /// The code of the worst finding, if there is any.
    pub(in crate::cli) worst: Option<String>,
    /// Findings in numbers and words; a line of an earlier version has none.
    #[serde(default)]
    pub(in crate::cli) found: Found,
}

/// The manifest of a folder of programs.
#[derive(Debug)]
pub(in crate::cli) struct Manifest {
    path: PathBuf,
    lines: Mutex<Lines>,
}

/// Lines of each input and its targets, the latest last.
type Known = BTreeMap<Key, Vec<Line>>;

/// An input and its targets.
type Key = (String, Vec<String>);

#[derive(Debug)]
struct Lines {
    /// The manifest, locked against other runs while this one writes.
    file: File,
    known: Known,
    /// Lines of earlier runs that this manifest may keep, the latest last.
    earlier: Vec<Line>,
    /// Lines that this run wrote or kept.
    fresh: BTreeMap<Key, Line>,
}

impl Line {
    fn key(&self) -> Key {
        (self.made.source.clone(), self.made.targets.clone())
    }
}

impl Manifest {
    /// Opens the manifest of a folder, or of one part of its programs. Waits for another run that writes to it, with a message.
    pub(in crate::cli) fn open(folder: &Path, shard: Option<Shard>, console: &mut Console) -> anyhow::Result<Self> {
        let path = Self::place(folder, shard);
        let waiting = || {
            // Ignore errors on standard error: the reader has closed it.
            let _ = writeln!(console.err, "waiting for another run that writes to `{}`", folder.display());
        };
        let mut file = held(&path, waiting).map_err(|error| cannot_write(&path, &error))?;
        let mut parts = parts(folder);
        parts.retain(|part| *part != path);
        let others = parts.iter().cloned().chain(shard.map(|_| folder.join(NAME)));
        let others: Vec<Vec<u8>> = others.filter_map(|path| std::fs::read(path).ok()).collect();
        let own = own(&mut file).map_err(|error| cannot_write(&path, &error))?;
        // The manifest of a part prefers its own lines; that of a folder takes in the lines of its parts.
        let own_first = if shard.is_some() { others.len() } else { 0 };
        let (mut known, mut earlier) = (Known::new(), Vec::new());
        for (i, text) in others.iter().chain([&own]).enumerate() {
            for line in lines_of(text) {
                earlier.extend((i >= own_first).then(|| line.clone()));
                known.entry(line.key()).or_default().push(line);
            }
        }
        let lines = Mutex::new(Lines { file, known, earlier, fresh: BTreeMap::new() });
        Ok(Self { path, lines })
    }

    /// Path of the manifest of a folder, or of one part of its programs.
    pub(in crate::cli) fn place(folder: &Path, shard: Option<Shard>) -> PathBuf {
        folder.join(shard.map_or_else(|| NAME.to_owned(), |shard| format!("{}{shard}{}", PART[0], PART[1])))
    }

    fn lines(&self) -> MutexGuard<'_, Lines> {
        self.lines.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Path of the manifest.
    pub(in crate::cli) fn path(&self) -> &Path {
        &self.path
    }

    /// Line of equal ingredients from before, if its outputs still stand as written.
    pub(in crate::cli) fn standing(&self, made: &Made) -> Option<Line> {
        let line = self
            .lines()
            .known
            .get(&(made.source.clone(), made.targets.clone()))?
            .iter()
            .rev()
            .find(|line| line.made == *made)?
            .clone();
        let is_made = match line.verdict {
            Standing::Verified | Standing::Unverified => true,
            Standing::Refused => false,
        };
        (is_made && line.outputs.iter().all(|output| self.stands(output))).then_some(line)
    }

    /// The latest line of an input and its targets, if it is a refusal of equal ingredients.
    pub(in crate::cli) fn refused(&self, made: &Made) -> Option<Line> {
        let lines = self.lines();
        let last = lines.known.get(&(made.source.clone(), made.targets.clone())).and_then(|lines| lines.last());
        last.filter(|line| line.made == *made && line.verdict == Standing::Refused).cloned()
    }

    /// Names of the inputs whose latest line is a refusal.
    pub(in crate::cli) fn refused_names(&self) -> Vec<String> {
        let lines = self.lines();
        let last = lines.known.values().filter_map(|lines| lines.last());
        last.filter(|line| line.verdict == Standing::Refused).map(|line| line.made.source.clone()).collect()
    }

    fn stands(&self, output: &Output) -> bool {
        let path = self.folder().join(&output.path);
        let digest = File::open(&path).and_then(|file| sha256_of(BufReader::new(file)));
        meta(&path).is_file() && digest.is_ok_and(|digest| digest == output.sha256)
    }

    fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new(""))
    }

    /// Name of a program in lines.
    fn name_of(&self, program: &Path) -> String {
        let below = program.strip_prefix(self.folder()).unwrap_or(program);
        let parts: Vec<_> = below.iter().map(|part| part.to_string_lossy()).collect();
        parts.join("/")
    }

    /// Line about files that take their place, without figures.
    pub(in crate::cli) fn line(&self, made: Made, verdict: Standing, whole: Vec<Whole>, out: &Diagnostics) -> Line {
        let output = |Whole { path, sha256 }| Output { path: self.name_of(&path), sha256 };
        let outputs = whole.into_iter().map(output).collect();
        let worst = worst(out).map(str::to_owned);
        Line { made, verdict, outputs, pieces: None, cut_m: None, time_s: None, worst, found: Found::of(out) }
    }

    /// Adds a line; if it cannot be written whole, removes the rest of it.
    pub(in crate::cli) fn add(&self, line: Line) -> anyhow::Result<()> {
        let mut text = serde_json::to_vec(&line).expect("plain data with text keys");
        text.push(b'\n');
        let Lines { file, known, fresh, .. } = &mut *self.lines();
        let end = file.seek(SeekFrom::End(0));
        let added = end.and_then(|end| {
            file.write_all(&text).inspect_err(|_| {
                // Otherwise the next line would be appended to half of this one.
                let _ = file.set_len(end);
            })
        });
        added.map_err(|error| cannot_write(&self.path, &error))?;
        known.insert(line.key(), vec![line.clone()]);
        fresh.insert(line.key(), line);
        Ok(())
    }

    /// Keeps a line of an earlier run.
    pub(in crate::cli) fn keep(&self, line: Line) {
        self.lines().fresh.insert(line.key(), line);
    }

    /// Leaves a sorted line for each input and its targets: of this run, or of earlier ones if their outputs are there and no
    /// newer line replaces them. The manifest of a folder takes in those of its parts whose runs are over.
    pub(in crate::cli) fn finish(self) -> anyhow::Result<()> {
        let folder = self.folder().to_owned();
        let Lines { file, known, mut earlier, fresh } = self.lines.into_inner().unwrap_or_else(PoisonError::into_inner);
        // Locked until they are removed, so that a run that waits for one begins another.
        let is_whole = self.path.file_name().is_some_and(|name| name == NAME);
        let parts = if is_whole { parts(&folder) } else { Vec::new() };
        let mut over: Vec<(PathBuf, File)> =
            parts.into_iter().filter_map(|part| over(&part).map(|file| (part, file))).collect();
        // Lines that were added to them during this run are newer than the rest.
        let mut added = Vec::new();
        over.retain_mut(|(_, file)| {
            let mut text = Vec::new();
            let is_read = file.read_to_end(&mut text).is_ok();
            added.extend(lines_of(&text));
            is_read
        });
        let added = added.into_iter();
        earlier.extend(added.filter(|line| known.get(&line.key()).is_none_or(|known| !known.contains(line))));
        let (mut taken, mut kept) = (BTreeSet::new(), BTreeMap::new());
        // A refusal that this run does not repeat may be of a removed file.
        let stands = |line: &Line| {
            !line.outputs.is_empty() && line.outputs.iter().all(|output| folder.join(&output.path).is_file())
        };
        let earlier = earlier.into_iter().rev().filter(stands);
        for line in fresh.into_values().chain(earlier) {
            if kept.contains_key(&line.key()) || line.outputs.iter().any(|output| taken.contains(&output.path)) {
                continue;
            }
            taken.extend(line.outputs.iter().map(|output| output.path.clone()));
            kept.insert(line.key(), line);
        }
        let text = |line: &Line| serde_json::to_string(line).expect("plain data with text keys") + "\n";
        let mut texts: Vec<String> = kept.values().map(text).collect();
        // In the order of `sort`, so that it can merge the manifests of parts.
        texts.sort_unstable();
        let mut draft = Draft::new(&self.path)?;
        draft.file().write_all(texts.concat().as_bytes()).map_err(|error| cannot_write(&self.path, &error))?;
        draft::publish(vec![draft], || Ok(()))?;
        drop(file);
        for (part, _) in &over {
            let _ = std::fs::remove_file(part); // its lines stand in the whole one, too
        }
        Ok(())
    }
}

/// Lines of a text; other text is skipped.
fn lines_of(text: &[u8]) -> Vec<Line> {
    text.split(|&byte| byte == b'\n').filter_map(|line| serde_json::from_slice(line).ok()).collect()
}

/// Locks the manifest of a part, unless a run still writes to it.
fn over(part: &Path) -> Option<File> {
    // Opened for writing, though nothing is written: network file systems lock no other files.
    let file = OpenOptions::new().read(true).write(true).open(part).ok()?;
    // Without locks nothing tells that another run is active, as in [`held`].
    (!matches!(file.try_lock(), Err(TryLockError::WouldBlock))).then_some(file)
}

/// Opens a manifest and locks it against other runs.
fn held(path: &Path, waiting: impl FnOnce()) -> io::Result<File> {
    let mut waiting = Some(waiting);
    loop {
        let file = OpenOptions::new().read(true).append(true).create(true).open(path)?;
        // On a file system without locks the user must run one writer per folder at a time.
        if matches!(file.try_lock(), Err(TryLockError::WouldBlock)) {
            waiting.take().into_iter().for_each(|say| say());
            let _ = file.lock();
        }
        // The previous owner may have replaced it.
        if same(&file, path) {
            return Ok(file);
        }
    }
}

/// True if an open file is the one at a path.
fn same(file: &File, path: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt as _;
        let known = |found: std::fs::Metadata| (found.dev(), found.ino());
        // Opened anew: a network file system may cache a name for seconds.
        let there = File::open(path).and_then(|file| file.metadata());
        file.metadata().ok().map(known) == there.ok().map(known)
    }
    #[cfg(not(unix))]
    {
        // On other systems an open file cannot be replaced.
        let _ = (file, path);
        true
    }
}

/// Text of a manifest, without the rest of a last line that a full disk or a power cut truncated.
fn own(file: &mut File) -> io::Result<Vec<u8>> {
    let mut text = Vec::new();
    file.read_to_end(&mut text)?;
    let end = text.iter().rposition(|&byte| byte == b'\n').map_or(0, |last| last + 1);
    if end < text.len() {
        file.set_len(end as u64)?;
        text.truncate(end);
    }
    Ok(text)
}

/// The manifests of parts in a folder, sorted.
fn parts(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(directory(&folder.join(NAME))).into_iter().flatten().flatten();
    let mut names: Vec<_> = entries.map(|entry| entry.file_name()).filter(|name| is_part(name)).collect();
    names.sort();
    names.into_iter().map(|name| folder.join(name)).collect()
}

fn is_part(name: &OsStr) -> bool {
    let name = name.to_string_lossy();
    let part = name.strip_prefix(PART[0]).and_then(|rest| rest.strip_suffix(PART[1]));
    let numbers = part.and_then(|part| part.split_once("-of-"));
    numbers.is_some_and(|(index, count)| Shard::parse(&format!("{index}/{count}")).is_ok())
}

/// Rounds to a millionth: micrometres of a metre, microseconds of a second, far below the resolution of a machine.
pub(in crate::cli) fn rounded(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}
