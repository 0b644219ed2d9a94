//! Options that several commands share.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;

use super::choices::Format;
use super::finished::{FAULTY, Finished, USAGE, failure, say};
use super::{choices, files};
use crate::diagnostic::{Detail, Diagnostics, Severity, render_with};
use crate::front::{self, Dialect};
use crate::machine::layers::{LayerUses, NotLayers};
use crate::machine::patterns::{Patterns, Sizes};
use crate::machine::plot::Lines;
use crate::machine::{Centre, Faults, Job, Mode, NotNumbers, NotStart, Numbers, Remarks, Selection, Start};
use crate::machine::{SHIPPED, Shipped, load_given};
use crate::source::Source;
use crate::track;
pub(super) use crate::units::number::counted;
use crate::units::number::exact;

/// Heading of an option that follows a group with a heading but belongs to the command itself.
pub(super) const NO_HEADING: Option<&str> = None;

/// Which machine.
#[derive(Debug, Args)]
pub(super) struct Machine {
    /// Machine profile to use: a file, or the name of one that ships (`cutc profile list`)
    ///
    /// `cutc profile init` prints one with every key explained. A file is taken before a profile of its name. Without it the defaults hold: a real cutter's, with a worn 6.6 mm knife.
    #[arg(short, long, value_name = "PROFILE.toml")]
    pub(super) profile: Option<PathBuf>,

    /// Set one key of the profile, as in `--set knife.width_mm=7.2`; may be repeated
    ///
    /// Overrides the profile. `cutc profile init` explains the keys. A bare word needs no quotes: `--set
    /// knife.feed_mm_s=off`. A value may have a unit: `--set "knife.feed_mm_s=45 m/min"`.
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
}

/// How much is said about a file.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Messages")]
pub(super) struct Messages {
    /// Tell every finding; without it warnings of a code are summed up, the worst of them told
    #[arg(long, conflicts_with = "quiet")]
    pub(super) all: bool,

    /// Tell errors only
    #[arg(short, long)]
    pub(super) quiet: bool,
}

impl Messages {
    /// Detail of the messages on standard error. JSON holds every finding, so only their number is printed beside it.
    pub(super) fn detail(self, format: Format) -> Detail {
        match (self, format) {
            (Self { all: true, .. }, _) => Detail::All,
            (Self { quiet: true, .. }, _) => Detail::Errors,
            (_, Format::Json) => Detail::Counts,
            (_, Format::Text) => Detail::Short,
        }
    }
}

/// How an input is read.
#[derive(Debug, Args)]
pub(super) struct Reading {
    /// Read the file as this dialect; do not guess from its content
    ///
    /// What is plainly something else, such as a plot given as a cut file, is refused all the same.
    #[arg(long, value_name = "DIALECT", value_parser = choices::dialects())]
    pub(super) from: Option<&'static Dialect>,

    #[command(flatten)]
    pub(super) machine: Machine,

    #[command(flatten)]
    lines: Plotted,

    #[command(flatten)]
    patterns: Patterned,
}

/// Lines of a plot or a drawing that are cut.
#[derive(Debug, Args)]
#[command(next_help_heading = "Plots and drawings (HPGL, DXF, SVG)")]
struct Plotted {
    /// The pens that are knives, as in `--cut-pens 4`; what others draw is not cut, but for notches on cut edges
    ///
    /// Cuts their outermost closed lines and the closed lines inside these that are no seam lines. Overrides
    /// `hpgl.pens` of the profile, but for pens that it ignores. `cutc info` and `-t svg` show what lines were taken
    /// for.
    #[arg(long, value_name = "NUMBERS", value_parser = pens)]
    cut_pens: Option<Numbers>,

    /// The layers of a DXF or SVG drawing that are knives, as in `--layers CUT,FOLD=pen,TEXT*=ignore`
    ///
    /// A layer without a use is a knife. What others draw is not cut, but for notches on cut edges. Overrides
    /// `drawing.layers` of the profile and what names of layers say. `cutc info` lists the layers.
    #[arg(long, value_name = "LAYERS", value_parser = layers, conflicts_with = "cut_pens")]
    layers: Option<LayerUses>,

    /// Which closed lines inside parts are cut
    ///
    /// Without it `hpgl.inner` of the profile holds, by default none: seam lines are drawn like cut-outs. Given at all, it
    /// says that a line between strokes of an outline lies in one part and is no common edge of two.
    #[arg(long, value_name = "LINES", value_enum)]
    inner: Option<choices::Inner>,

    /// Cut every line, letters and seam lines too, but no frame; with --cut-pens only the lines of these pens
    #[arg(long)]
    cut_all: bool,
}

/// Which patterns of a set are cut.
#[derive(Debug, Args)]
#[command(next_help_heading = "Patterns (DXF)")]
pub(super) struct Patterned {
    /// The sizes of a pattern DXF that are cut, as in `--size M`, `--size S,M` or `--size all`; else its sample size
    #[arg(long = "size", value_name = "SIZES", value_parser = sizes)]
    sizes: Option<Sizes>,

    /// How often its pieces are cut; without it `dxf.quantity` of the profile holds
    #[arg(long, value_name = "HOW", value_enum)]
    quantity: Option<choices::Quantity>,
}

/// Parses sizes.
fn sizes(text: &str) -> anyhow::Result<Sizes> {
    Sizes::parse(text).ok_or_else(|| anyhow::anyhow!("expected names of sizes, as in S,M, or `all`"))
}

impl Patterned {
    /// The job with this choice of patterns.
    pub(super) fn of(&self, job: Job) -> Job {
        let patterns = Patterns { sizes: self.sizes.clone(), quantity: self.quantity.map(Into::into) };
        Job { patterns, ..job }
    }
}

impl Reading {
    /// The job on this machine with these lines, or the faults of its profile.
    pub(super) fn job(&self) -> anyhow::Result<Result<Job, Finished>> {
        self.job_with(&[])
    }

    /// The job on this machine with these lines and `more` settings as `key=value` after those of the command line, or the
    /// faults of its profile.
    pub(super) fn job_with(&self, more: &[String]) -> anyhow::Result<Result<Job, Finished>> {
        let Plotted { cut_pens, layers, inner, cut_all } = &self.lines;
        let lines =
            Lines { pens: cut_pens.clone(), layers: layers.clone(), inner: inner.map(Into::into), all: *cut_all };
        Ok(self.machine.job_with(more)?.map(|job| self.patterns.of(Job { lines, ..job })))
    }
}

/// Pieces that are left out.
#[derive(Debug, Args)]
#[command(next_help_heading = "What is cut")]
pub(super) struct LeftOut {
    /// Leave these pieces out, as in `--skip 4,9-10`
    #[arg(long, value_name = "NUMBERS", value_parser = numbers)]
    skip: Option<Numbers>,
}

impl LeftOut {
    /// The job without these pieces.
    pub(super) fn of(&self, job: Job) -> Job {
        Job { selection: Selection { skip: self.skip.clone(), ..job.selection }, ..job }
    }
}

/// What of a marker is cut, and whether the knife goes down.
#[derive(Debug, Args)]
#[command(next_help_heading = "What is cut")]
pub(super) struct Choice {
    /// Cut these pieces only, by their numbers in the file, as in `--pieces 3,7-12`
    ///
    /// The order stays that of `order.policy`. A number that the file does not have is an error. --pieces, --skip,
    /// --resume-from and --bites act together.
    #[arg(long, value_name = "NUMBERS", value_parser = numbers)]
    pieces: Option<Numbers>,

    #[command(flatten)]
    left_out: LeftOut,

    /// Cut from the piece of this number on, in cut order: what an interrupted run has left
    ///
    /// Of several copies (sheet.copies) the first, or as in `--resume-from 3/2` the second. `--resume-from bite:3` begins
    /// with the third window of a conveyor (`bite.length_mm`). The cloth lies then as it does when that is cut.
    #[arg(long, value_name = "NUMBER", value_parser = start)]
    resume_from: Option<Start>,

    /// Cut only these windows of a conveyor (`bite.length_mm`), as in `--bites 2-4`
    ///
    /// The cloth lies at the start as it does when the first of them is cut. `cutc info` lists the windows.
    #[arg(long, value_name = "NUMBERS", value_parser = numbers, conflicts_with = "resume_from")]
    bites: Option<Numbers>,

    /// The same motion with knife and drills up: nothing is cut
    #[arg(long, conflicts_with = "frame")]
    dry_run: bool,

    /// No cut, but once around the box of what would be cut, knife up: the C axis from home along it and back
    #[arg(long)]
    frame: bool,

    /// Follow cloth that wanders on its conveyor: the line of its centre, as `cutc track -t centre` writes it
    ///
    /// Every place is moved across by as much as the centre of the cloth is off the middle when the conveyor is at its
    /// X; lines are parted so that they follow within a part of the tolerance. `cutc flow` has the front of the marker
    /// come first (`flow.rulers_mm`).
    #[arg(long, value_name = "FILE")]
    centre: Option<PathBuf>,

    /// Lay the drawing on the table by its registration marks: a CSV of where they stand in it and where they were found
    ///
    /// The header is `x_mm,y_mm,found_x_mm,found_y_mm`, with one row for each of at least four marks. X and Y in the drawing
    /// are mm with Y upwards, as `cutc compile -t csv` without `--map` has them. Turn, stretch, skew and place are those that
    /// fit all marks best; `map.max_mm` limits how far that leaves a mark. The keys of `sheet` stay at their defaults.
    #[arg(long, value_name = "MARKS.csv", conflicts_with = "centre")]
    map: Option<PathBuf>,
}

fn numbers(text: &str) -> Result<Numbers, NotNumbers> {
    Numbers::parse(text)
}

fn start(text: &str) -> Result<Start, NotStart> {
    Start::parse(text)
}

/// Parses uses of layers.
fn layers(text: &str) -> Result<LayerUses, NotLayers> {
    LayerUses::parse(text)
}

/// Parses numbers of pens. 0 is refused: it stands for no pen.
fn pens(text: &str) -> anyhow::Result<Numbers> {
    let numbers = numbers(text)?;
    anyhow::ensure!(!numbers.has(0), "pen 0 stands for none: nothing is drawn with it; give others, as in 1,3-4");
    Ok(numbers)
}

impl Choice {
    /// Paths of the files beside the source, as typed: the centre line and the marks.
    pub(super) fn beside(&self) -> [Option<&Path>; 2] {
        [self.centre.as_deref(), self.map.as_deref()]
    }

    /// The job of `reading` with this choice, or the faults of its profile, its centre line or its marks.
    pub(super) fn job(&self, reading: &Reading) -> anyhow::Result<Result<Job, Finished>> {
        self.job_with(reading, &[])
    }

    /// The job of `reading` with this choice and `more` settings as `key=value` after those of the command line, or the faults
    /// of its files.
    pub(super) fn job_with(&self, reading: &Reading, more: &[String]) -> anyhow::Result<Result<Job, Finished>> {
        match reading.job_with(more)? {
            Ok(job) => self.of(job),
            Err(refused) => Ok(Err(refused)),
        }
    }

    /// The job with this choice, or the faults of its centre line or its marks.
    fn of(&self, job: Job) -> anyhow::Result<Result<Job, Finished>> {
        let job = self.left_out.of(job);
        let mut centre = None;
        if let Some(path) = &self.centre {
            let source = files::read(path)?;
            let mut found = Diagnostics::default();
            match track::centre::read(&source, &mut found) {
                Some(line) => centre = Some(Arc::new(Centre { line, source: Arc::new(source), rulers: None })),
                None => return Ok(Err(unfit(&found, &source, "centre line"))),
            }
        }
        let mut marks = None;
        if let Some(path) = &self.map {
            let source = Arc::new(files::read(path)?);
            let mut found = Diagnostics::default();
            match front::marks::read(&source, job.profile.map.max_mm, &mut found) {
                Some(read) => marks = Some(Arc::new(read)),
                None => return Ok(Err(unfit(&found, &source, "file of marks"))),
            }
        }
        let (pieces, bites) = (self.pieces.clone(), self.bites.clone());
        let selection = Selection { pieces, bites, resume_from: self.resume_from, ..job.selection };
        let mode = match (self.dry_run, self.frame) {
            (_, true) => Mode::Frame,
            (true, false) => Mode::Dry,
            (false, false) => Mode::Cut,
        };
        Ok(Ok(Job { selection, mode, centre, marks, ..job }))
    }
}

/// Message on a faulty file beside the source. `noun` names the kind of file.
fn unfit(found: &Diagnostics, source: &Source, noun: &str) -> Finished {
    let mut said = render_with(found, source, Detail::All);
    let errors = counted(found.count(Severity::Error), "error");
    say(&mut said, format_args!("the {noun} `{}` has {errors}", source.name()));
    Finished::text(String::new(), said, FAULTY)
}

/// The remarks of a page as options of the command line; empty if there are none.
pub(super) fn remarks(job: &Job) -> String {
    let Remarks { date, price } = &job.remarks;
    let mut words = Vec::new();
    words.extend(date.iter().map(|date| format!("--date {date}")));
    words.extend(price.iter().map(|price| format!("--rate {}/s --plies {}", exact(price.per_s), price.plies)));
    words.join(" ")
}

impl Machine {
    /// The job on this machine, or the faults of its profile: with the code [`FAULTY`] if the file has some, [`USAGE`] if only
    /// arguments do.
    pub(super) fn job(&self) -> anyhow::Result<Result<Job, Finished>> {
        self.job_with(&[])
    }

    /// The job on this machine with `more` settings as `key=value` after those of the command line, or the faults of its
    /// profile.
    fn job_with(&self, more: &[String]) -> anyhow::Result<Result<Job, Finished>> {
        let file = self.file()?;
        let loaded = load_given(file.as_ref(), &[&self.set[..], more].concat());
        Ok(loaded
            .map(|(profile, origin)| Job { profile, origin, ..Job::default() })
            .map_err(|faults| refuse(&faults, file.as_ref())))
    }

    fn file(&self) -> anyhow::Result<Option<Source>> {
        self.profile.as_deref().map(profile).transpose()
    }
}

/// Profile at a path, or the shipped one of that name. A file with the name of a shipped profile needs a path.
pub(super) fn profile(path: &Path) -> anyhow::Result<Source> {
    if let Some(shipped) = shipped(path) {
        if path.is_file() {
            let name = shipped.name;
            let message = format!("`{name}` is a profile that ships, and a file in this directory");
            return Err(failure(message, format!("say `./{name}` for the file, or give it another name")));
        }
        return Ok(shipped.source());
    }
    if path.exists() {
        return files::read(path);
    }
    let shown = path.display().to_string();
    if path.extension().is_none() && path.components().count() == 1 {
        return Err(no_profile(&shown));
    }
    let hint = format!("check the spelling, or begin one with `cutc profile init -o {shown}`");
    Err(failure(format!("there is no profile `{shown}`"), hint))
}

/// Failure for a name that no shipped profile has.
pub(super) fn no_profile(name: &str) -> anyhow::Error {
    let names: Vec<&str> = SHIPPED.iter().map(|shipped| shipped.name).collect();
    failure(format!("there is no profile `{name}`"), format!("these ship: {}", names.join(", ")))
}

/// Shipped profile that a path names.
pub(super) fn shipped(path: &Path) -> Option<&'static Shipped> {
    path.to_str().and_then(Shipped::find)
}

/// The result of a command with a faulty profile.
pub(super) fn refuse(faults: &Faults, file: Option<&Source>) -> Finished {
    let mut said = String::new();
    if let Some(file) = file {
        said.push_str(&render_with(&faults.file, file, Detail::All));
    }
    let arguments = Source::new("command line", Vec::new()).expect("nothing is small");
    said.push_str(&render_with(&faults.arguments, &arguments, Detail::All));
    let count = faults.file.count(Severity::Error) + faults.arguments.count(Severity::Error);
    let name = file.map_or_else(String::new, |file| format!(" `{}`", file.name()));
    say(&mut said, format_args!("the machine profile{name} has {}", counted(count, "error")));
    Finished::text(String::new(), said, if faults.file.has_errors() { FAULTY } else { USAGE })
}
