//! The programs that are damaged: small markers, each with a machine of its own.

use std::fs;
use std::path::Path;

use cutc::diagnostic::Diagnostics;
use cutc::ir::Marker;
use cutc::machine::{Follow, Job};
use cutc::pipeline::{self, Declared};
use cutc::source::Source;

use crate::support::program::{declared, setpoints};
use crate::verifier::measure::HARMLESS;
use crate::verifier::rows::{self, Row};

/// A marker, its machine and its sound program.
pub(crate) struct Case {
    pub(crate) name: &'static str,
    pub(crate) marker: Marker,
    pub(crate) job: Job,
    pub(crate) program: Vec<u8>,
    pub(crate) rows: Vec<Row>,
    /// What the program says that it does beside the drawing.
    pub(crate) declared: Declared,
}

impl Case {
    /// A marker on a machine, and the program that the compiler makes of it.
    pub(crate) fn new(name: &'static str, marker: Marker, job: Job) -> Self {
        let program = setpoints(&marker, &job);
        Self { name, rows: rows::parse(&program), declared: declared(&marker, &job), marker, job, program }
    }

    /// Permitted deviation of the tip, mm.
    pub(crate) fn tolerance(&self) -> f64 {
        self.job.profile.tolerance(self.marker.unit)
    }

    /// The program of another marker on the same machine, which is not asked about its table.
    pub(crate) fn redrawn(&self, marker: &Marker) -> Vec<u8> {
        let mut job = self.job.clone();
        job.profile.table = cutc::machine::Table::default();
        setpoints(marker, &job)
    }

    /// The same, planned to a third of the tolerance: what is off is the marker.
    pub(crate) fn redrawn_closely(&self, marker: &Marker) -> Vec<u8> {
        let mut job = self.job.clone();
        job.profile.table = cutc::machine::Table::default();
        job.profile.path.tolerance_mm = Some(self.tolerance() * HARMLESS);
        setpoints(marker, &job)
    }

    /// The program of the same marker on another machine.
    pub(crate) fn on(&self, change: impl FnOnce(&mut Job)) -> Vec<u8> {
        let mut job = self.job.clone();
        change(&mut job);
        setpoints(&self.marker, &job)
    }
}

/// What the machine of a case has that others have not.
type Change = fn(&mut Job);

/// Overlaps that are longer than the gaps of the marker with narrow ones are wide, by more than what is still the edge of a
/// part, mm.
pub(crate) const WIDE: f64 = 1.5;

/// Markers of `fixtures/markers` and of `fixtures/iso`, and what the machine of each has that others have not.
const CASES: &[(&str, Change)] = &[
    ("circles", |_| {}),
    ("drills-and-slits", |job| job.profile.drill.offset_mm = [12.0, -5.0]),
    ("tight-curves-and-short-runs", |job| job.profile.knife.back_mm = Some(2.2)),
    ("metric-four-pieces", |_| {}),
    ("inch-four-pieces", |job| job.profile.knife.back_mm = Some(2.2)),
    ("spaced-four-pieces", |job| job.profile.time.period_ms = 2.0),
    ("metric-six-pieces", |job| {
        job.profile.home = [20.0, -10.0, 90.0];
        job.profile.knife.max_down_mm = Some(300.0);
    }),
    ("speeds-and-events", |_| {}),
    ("narrow-gaps", |job| {
        (job.profile.knife.front_overlap_mm, job.profile.knife.corner_front_overlap_mm) = (WIDE, WIDE);
    }),
    ("chords", |job| job.profile.knife.follow = Follow::Chord),
];

pub(crate) fn all() -> Vec<Case> {
    CASES.iter().map(|&(name, change)| case(name, change)).collect()
}

fn case(name: &'static str, change: Change) -> Case {
    let mut job = Job::default();
    let profile = &mut job.profile;
    profile.park = Some([5.0, 5.0, 0.0]);
    profile.c.range_deg = Some([-1080.0, 1080.0]);
    profile.table.x_mm = Some([-60.0, 4000.0]);
    profile.table.y_mm = Some([-60.0, 2000.0]);
    profile.knife.feed_mm_s = Some(400.0);
    change(&mut job);
    let marker = marker(name, &job);
    Case::new(name, marker, job)
}

/// The names of all cases.
pub(crate) fn names() -> Vec<&'static str> {
    CASES.iter().map(|case| case.0).collect()
}

/// The source of a marker.
pub(crate) fn source(name: &str) -> Source {
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures");
    let paths = ["markers", "iso"].map(|folder| fixtures.join(format!("{folder}/{name}.cut")));
    let path = paths.iter().find(|path| path.exists()).unwrap_or_else(|| panic!("no fixture is called {name}"));
    let bytes = fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    Source::new(name, bytes).expect("fixtures are small")
}

/// A marker as it is read.
pub(crate) fn marker(name: &str, job: &Job) -> Marker {
    let mut diagnostics = Diagnostics::default();
    let input = pipeline::read(&source(name), None, job, &mut diagnostics);
    assert!(!diagnostics.has_errors(), "{name}: {diagnostics:?}");
    input.expect("it is read").marker
}
