//! `cutc watch`: a hot folder. Every complete cutter file in it is compiled; its program appears complete.
//!
//! The work is recorded in the manifest beside the programs, like that of a batch with `--changed`: after a kill, the next run
//! continues there. A file without a program has a report.

mod arguments;
mod events;
mod report;
mod settings;
mod settling;

pub(super) use arguments::Arguments;

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use self::events::{Events, Told};
use self::settings::{Settings, Stamps};
use self::settling::{STEADY, Settling, Stamp};
use super::batch::{self, Input, Manifest, Outcome, Row, Stages, State};
use super::choices::Format;
use super::compile::many::{Became, Many, made};
use super::compile::overview::{Overview, page_of};
use super::destination::below;
use super::draft::{self, MadeFolders};
use super::finished::{Console, Finished, failure};
use super::options::counted;
use super::times::clock;
use super::{files, stop};
use crate::units::number::fixed;

/// Longest wait for events of the folder before the clock and signals are checked.
const TICK: Duration = Duration::from_millis(200);
/// Interval of searches of the folder, for files without events.
const LOOK: Duration = Duration::from_secs(2);
/// Least interval of searches as a multiple of their duration, for large folders.
const LOOK_SHARE: u32 = 50;

pub(super) fn run(arguments: &Arguments, typed: &[OsString], console: &mut Console) -> anyhow::Result<Finished> {
    let Arguments { folder, making, threads, .. } = arguments;
    if !folder.is_dir() {
        let message = format!("`{}` is no folder", folder.display());
        return Err(failure(message, "name the folder that cutter files come into"));
    }
    let settings = match Settings::read(folder, typed)? {
        Ok(settings) => settings,
        Err(refused) => return Ok(refused),
    };
    let out = making.place();
    if out.as_os_str().is_empty() {
        return Err(failure("where the programs go is not said", "name a directory with -o, as in `-o out/`"));
    }
    if out.canonicalize().is_ok_and(|out| folder.canonicalize().is_ok_and(|folder| folder == out)) {
        let message = format!("programs in `{}` itself would be among the files that come in", folder.display());
        return Err(failure(message, "name another directory with -o, as in `-o out/`"));
    }
    MadeFolders::of([out.join(settings::NAME).as_path()])?.keep();
    draft::sweep_below(out);
    let manifest = Manifest::open(out, None, console)?;
    // When idle, a signal ends the program at once.
    stop::finish_first();
    let folders = Folders { from: folder, out, inner: inner(folder, out), threads: threads.set(), manifest: &manifest };
    let mut watch = Watch {
        folders,
        settings,
        changed: None,
        files: Settling::default(),
        told: BTreeMap::new(),
        rows: BTreeMap::new(),
    };
    let _ = writeln!(console.err, "watching `{}`; programs go to `{}`", folder.display(), out.display());
    let code = watch.go(typed, console);
    manifest.finish()?;
    Ok(Finished::text(String::new(), String::new(), code))
}

/// Folders of inputs and of programs.
struct Folders<'a> {
    from: &'a Path,
    out: &'a Path,
    /// Path of the folder of programs from the root, if it is inside the folder of inputs.
    inner: Option<PathBuf>,
    threads: usize,
    manifest: &'a Manifest,
}

/// Path of the folder of programs from the root, if it is inside the folder of inputs.
fn inner(from: &Path, out: &Path) -> Option<PathBuf> {
    let [from, out] = [from, out].map(|folder| folder.canonicalize().ok());
    out.filter(|out| from.is_some_and(|from| out.starts_with(from)))
}

/// A hot folder at work.
struct Watch<'a> {
    folders: Folders<'a>,
    settings: Settings,
    /// Stamps of the option files and the time of their change, if they differ from those read: nothing is compiled then.
    changed: Option<(Stamps, Instant)>,
    files: Settling,
    /// Last message about each file that could not be worked on; it is printed once.
    told: BTreeMap<PathBuf, String>,
    /// Outcome of each file, with the places of its programs, for the overview of their pages.
    rows: BTreeMap<PathBuf, (Row, Vec<PathBuf>)>,
}

/// Outcome of the work on a file.
enum Dealt {
    /// The file is gone.
    Gone,
    /// It already had its program, or its report.
    Before(Row),
    /// It has its program, or its report: a line about that.
    With(String, Row),
    /// It could not be read or written, and is tried again: the error.
    Not(String),
    /// It has changed since it was found complete, or the end was requested.
    Later,
}

impl Watch<'_> {
    /// Works until a signal requests the end, and returns the exit code.
    fn go(&mut self, typed: &[OsString], console: &mut Console) -> u8 {
        let events = Events::of(self.folders.from);
        let mut next_look = Instant::now();
        self.forget_reports();
        loop {
            if let Some(code) = stop::asked() {
                return code;
            }
            self.mind_options(typed, console);
            let now = Instant::now();
            if now >= next_look {
                self.look(console);
                next_look = Instant::now() + LOOK.max(now.elapsed() * LOOK_SHARE);
            }
            for told in events.wait(TICK) {
                self.hear(told);
            }
            if self.changed.is_none() {
                self.work(console);
            }
        }
    }

    /// Checks whether the options have changed, and reads them once they are steady.
    fn mind_options(&mut self, typed: &[OsString], console: &mut Console) {
        let (now, stamps) = (Instant::now(), self.settings.look());
        match &self.changed {
            None if stamps == *self.settings.stamps() => {}
            Some((seen, since)) if *seen == stamps => {
                if now >= *since + STEADY {
                    self.read_options(&stamps, typed, console);
                }
            }
            None | Some(_) => self.changed = Some((stamps, now)),
        }
    }

    /// Reads the options with these stamps; changed ones hold for all files.
    fn read_options(&mut self, stamps: &Stamps, typed: &[OsString], console: &mut Console) {
        let file = self.folders.from.join(settings::NAME);
        let wrong = match Settings::read(self.folders.from, typed) {
            // They may be half written if they have just changed: they are read again.
            Ok(Ok(settings)) if settings.stamps()[0] != stamps[0] || settings.look() != *settings.stamps() => return,
            Ok(Ok(settings)) => {
                self.settings = settings;
                self.changed = None;
                self.told.remove(&file);
                self.files.renew(Instant::now());
                // Their places are those of the targets before.
                self.rows.clear();
                let _ = writeln!(console.err, "the options were changed: they hold for all files");
                return;
            }
            Ok(Err(refused)) => refused.stderr,
            Err(error) => format!("error: {error:#}\n"),
        };
        self.say_once(&file, &format!("{wrong}nothing is compiled until the options are mended\n"), console);
    }

    fn say_once(&mut self, about: &Path, said: &str, console: &mut Console) {
        if self.told.get(about).is_none_or(|before| before != said) {
            // Ignore errors on standard error: the reader has closed it.
            let _ = console.err.write_all(said.as_bytes());
            self.told.insert(about.to_owned(), said.to_owned());
        }
    }

    /// Searches the folder for files without events, and for removed ones.
    fn look(&mut self, console: &mut Console) {
        let now = Instant::now();
        let mut there = BTreeSet::new();
        for Input { path, .. } in batch::files_in(self.folders.from) {
            if self.is_left_alone(&path) {
                continue;
            }
            if !batch::is_cutter_file(&path) {
                let known = batch::extensions();
                let said = format!(
                    "{}: left alone, by its name it is no cutter file\n  = hint: cutter files end in {known}: rename it if it is one\n",
                    path.display()
                );
                self.say_once(&path, &said, console);
            } else if let Some(stamp) = Stamp::at(&path) {
                self.files.see(&path, stamp, now);
            }
            there.insert(path);
        }
        for gone in self.files.keep(|path| there.contains(path)) {
            report::remove(&report::path(self.folders.out, self.folders.name(&gone)));
        }
        let before = self.rows.len();
        self.rows.retain(|path, _| there.contains(path));
        if self.rows.len() < before {
            self.write_overview(console);
        }
        let out = self.folders.out;
        self.told.retain(|path, _| there.contains(path) || path.ends_with(settings::NAME) || path == out);
    }

    /// Removes the reports on files that were removed while no run watched.
    fn forget_reports(&self) {
        for name in self.folders.manifest.refused_names() {
            if !self.folders.from.join(&name).exists() {
                report::remove(&report::path(self.folders.out, Path::new(&name)));
            }
        }
    }

    fn is_left_alone(&self, path: &Path) -> bool {
        let inner = self.folders.inner.as_deref();
        let is_inside = || inner.is_some_and(|inner| path.canonicalize().is_ok_and(|path| path.starts_with(inner)));
        self.settings.says(path) || files::meta(path).exists() || is_inside()
    }

    fn hear(&mut self, told: Told) {
        let (told, is_closed) = match told {
            Told::Closed(path) => (path, true),
            Told::Changed(path) => (path, false),
        };
        let Some(path) = self.folders.as_typed(&told) else { return };
        let is_hidden = self.folders.name(&path).iter().any(|part| part.to_string_lossy().starts_with('.'));
        if is_hidden || !path.is_file() || !batch::is_cutter_file(&path) || self.is_left_alone(&path) {
            return;
        }
        match Stamp::at(&path) {
            Some(stamp) if is_closed => self.files.close(&path, stamp, Instant::now()),
            Some(stamp) => self.files.see(&path, stamp, Instant::now()),
            None => {}
        }
    }

    /// Works on every complete file, in parallel.
    fn work(&mut self, console: &mut Console) {
        let (mut finished, mut taken) = (Vec::new(), BTreeSet::new());
        for (path, stamp) in self.files.ready(Instant::now()) {
            let extensions: Vec<&str> = self.settings.targets.iter().map(|target| target.extension).collect();
            let places = below(self.folders.out, self.folders.name(&path), &extensions);
            // The second of two files with one place waits, and then finds the program of the other.
            if places.iter().all(|place| !taken.contains(place)) {
                taken.extend(places.iter().cloned());
                let name = self.folders.name(&path).to_owned();
                finished.push(Finish { input: Input { path, name }, stamp, places });
            }
        }
        if finished.is_empty() {
            return;
        }
        let sizes: Vec<u64> = finished.iter().map(|finish| finish.input.size()).collect();
        let mut dealt = Vec::new();
        let (folders, settings) = (&self.folders, &self.settings);
        let deal = |i: usize| {
            let input = &finished[i].input;
            let dealt = batch::unless_broken(input, || folders.deal(&finished[i], settings));
            dealt.unwrap_or_else(|said| folders.refuse(input, &said, Row::broken(&input.path)))
        };
        batch::side_by_side(&sizes, self.folders.threads, Stages { work: deal, settle: |_, how| how }, |i, how| {
            if let Dealt::With(line, _) = &how {
                let _ = writeln!(console.out, "{line}").and_then(|()| console.out.flush());
            }
            dealt.push((i, how));
        });
        for (i, how) in dealt {
            let Finish { input: Input { path, .. }, stamp, places } = &finished[i];
            match how {
                Dealt::Gone => self.files.done(path, *stamp),
                Dealt::Before(row) | Dealt::With(_, row) => {
                    self.told.remove(path);
                    self.files.done(path, *stamp);
                    self.rows.insert(path.clone(), (row, places.clone()));
                }
                Dealt::Not(wrong) => {
                    self.files.again(path, *stamp, Instant::now());
                    self.say_once(path, &wrong, console);
                }
                Dealt::Later => {}
            }
        }
        self.write_overview(console);
    }

    /// Brings the overview of the pages up to date.
    fn write_overview(&mut self, console: &mut Console) {
        let Settings { targets, arguments, .. } = &self.settings;
        let places = self.rows.values().map(|(_, places)| places.as_slice());
        let (Some(page), Some(overview)) = (page_of(targets), Overview::of(self.folders.out, targets, places)) else {
            return;
        };
        let rows: Vec<_> = self.rows.values().map(|(row, places)| (row, places[page].as_path())).collect();
        let may = if arguments.making.force { Ok(()) } else { overview.may_be_written() };
        let out = self.folders.out;
        match may.and_then(|()| overview.write(&rows, &self.settings.job)) {
            Ok(_) => _ = self.told.remove(out),
            Err(error) => self.say_once(out, &format!("error: {error:#}\n"), console),
        }
    }
}

/// A complete file with its stamp at that time, and the places of its programs.
struct Finish {
    input: Input,
    stamp: Stamp,
    places: Vec<PathBuf>,
}

impl Folders<'_> {
    /// The name of a file below the folder.
    fn name<'p>(&self, path: &'p Path) -> &'p Path {
        path.strip_prefix(self.from).expect("files are found below the folder")
    }

    /// A path in an event, which starts at the root, as the user would write it.
    fn as_typed(&self, path: &Path) -> Option<PathBuf> {
        let root = std::path::absolute(self.from).ok()?;
        Some(self.from.join(path.strip_prefix(root).ok()?))
    }

    /// Compiles a file, unless that is done already, or leaves a report.
    fn deal(&self, Finish { input, stamp, places }: &Finish, settings: &Settings) -> Dealt {
        if stop::asked().is_some() {
            return Dealt::Later;
        }
        let report = report::path(self.out, &input.name);
        let not = |error: &anyhow::Error| self.not_now(input, &format!("error: {error:#}\n"));
        let source = match files::read(&input.path) {
            Ok(source) => source,
            Err(_) if !input.path.exists() => return Dealt::Gone,
            Err(error) => return not(&error),
        };
        if Stamp::at(&input.path) != Some(*stamp) {
            return Dealt::Later;
        }
        let Arguments { making, messages, .. } = &settings.arguments;
        let many = Many { making, targets: &settings.targets, job: &settings.job, manifest: self.manifest };
        let made = made(making, &settings.targets, &settings.job, (input, &source));
        if let Some(line) = self.manifest.standing(&made) {
            report::remove(&report);
            return Dealt::Before(batch::kept(self.manifest, input, line));
        }
        if let Some(line) = self.manifest.refused(&made).filter(|_| report.exists()) {
            return Dealt::Before(batch::kept(self.manifest, input, line));
        }
        // The report is about the previous content of the file.
        report::remove(&report);
        match MadeFolders::of(places.iter().map(PathBuf::as_path)) {
            Ok(mut folders) => folders.keep(),
            Err(error) => return not(&error),
        }
        let published = many.publish(many.draft(input, source, made, places));
        let became = published.became();
        let Outcome { row, said, .. } = published.outcome(input, &settings.job, *messages, Format::Text);
        let row = row.unwrap_or_else(|| Row::new(&input.path, State::Failed));
        match became {
            Became::Program => Dealt::With(written(&row, &input.path, places), row),
            Became::Refused => self.refuse(input, &said, row),
            Became::Unwritten => self.not_now(input, &said),
        }
    }

    /// Leaves a report on a file that has no program until it is changed.
    fn refuse(&self, input: &Input, said: &str, row: Row) -> Dealt {
        let report = report::path(self.out, &input.name);
        let (file, worst) = (input.path.display(), &row.worst);
        match report::write(&report, said) {
            Ok(()) => Dealt::With(format!("{file}: FAILED {worst} -> `{}`", report.display()), row),
            Err(error) => Dealt::Not(format!("{said}error: {error:#}\n")),
        }
    }

    /// Leaves a report, if possible, on a file that is tried again.
    fn not_now(&self, input: &Input, said: &str) -> Dealt {
        let _ = report::write(&report::path(self.out, &input.name), said);
        Dealt::Not(said.to_owned())
    }
}

/// A line about a file that has its programs.
fn written(row: &Row, file: &Path, places: &[PathBuf]) -> String {
    let pieces = row.pieces.map(|pieces| counted(pieces, "piece"));
    let cut = row.cut_m.map(|cut| format!("{} m", fixed(cut, 1)));
    let worst = Some(row.worst.clone()).filter(|worst| !worst.is_empty());
    let figures: Vec<String> = [pieces, cut, row.time_s.map(clock), worst].into_iter().flatten().collect();
    let places: Vec<_> = places.iter().map(|place| format!("`{}`", place.display())).collect();
    format!("{}: {} -> {}", file.display(), figures.join(", "), places.join(" "))
}
