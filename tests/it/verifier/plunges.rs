//! Plunges in a hole narrower than the blade, which lie over several stretches of its line: the name of another stretch than
//! the one that is cut gains nothing.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use cutc::diagnostic::Diagnostics;
use cutc::machine::{Job, TightCurves};
use cutc::pipeline;
use cutc::source::Source;

use crate::verifier::case::Case;
use crate::verifier::judge;
use crate::verifier::rows::{Row, print, strokes};

/// Turn of a blade about its middle, degrees: ten times what a heading may be off.
const TURN_DEG: f64 = 5.0;
/// Rules about the blade on its line; turned rows between rows that are not break those of the axes in any case.
const OF_THE_BLADE: [&str; 6] =
    ["verify/heading", "verify/on-path", "verify/block", "verify/declared", "verify/stray", "verify/complete"];
/// Number of plunges that are turned, and of names that each is given.
const TURNED: usize = 6;
const NAMES: usize = 12;

/// The nibbled hole of the sound drawings, on its machine.
fn hole() -> Case {
    let mut job = Job::default();
    let knife = &mut job.profile.knife;
    (knife.width_mm, knife.back_mm, knife.tight_curves) = (5.0, Some(2.5), TightCurves::Nibble);
    job.profile.corner.angle_deg = 40.0;
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/sound/nibbled-blob.cut");
    let source = Source::new("nibbled-blob", fs::read(path).expect("readable")).expect("fixtures are small");
    let mut diagnostics = Diagnostics::default();
    let input = pipeline::read(&source, None, &job, &mut diagnostics).expect("it is read");
    Case::new("nibbled-blob", input.marker, job)
}

/// The rules about the blade that a program with other rows breaks.
fn broken(case: &Case, rows: &[Row]) -> Vec<&'static str> {
    let verdict = judge(&print(rows), &case.marker, &case.declared, &case.job);
    verdict.broken().map(|found| found.rule.name).filter(|name| OF_THE_BLADE.contains(name)).collect()
}

#[test]
fn a_turned_plunge_is_refused_by_whatever_name() {
    let case = hole();
    assert_eq!(broken(&case, &case.rows), [""; 0]);
    let knife = case.job.profile.knife.clone();
    let names: BTreeSet<u32> = strokes(&case.rows).into_iter().map(|stroke| case.rows[stroke.start].block).collect();
    let stands = |stroke: &std::ops::Range<usize>| {
        let [first, last] = [stroke.start, stroke.end - 1].map(|row| case.rows[row]);
        first.away(&last) < 0.01
    };
    let plunges: Vec<_> = strokes(&case.rows).into_iter().filter(stands).collect();
    assert!(plunges.len() >= TURNED && names.len() >= NAMES, "{} {}", plunges.len(), names.len());
    let mut passing = Vec::new();
    for plunge in plunges.iter().step_by(plunges.len() / TURNED) {
        for &name in names.iter().step_by(names.len() / NAMES) {
            let mut rows = case.rows.clone();
            for row in &mut rows[plunge.clone()] {
                let middle = |row: &Row| nalgebra::center(&row.tip(&knife), &row.tail(&knife));
                let turned = row.turned_to(row.pose[2] + TURN_DEG, &knife);
                let shift = middle(row) - middle(&turned);
                let [x, y, c] = turned.pose;
                *row = Row { pose: [x + shift.x, y + shift.y, c], block: name, ..*row };
            }
            if broken(&case, &rows).is_empty() {
                passing.push((plunge.start, case.rows[plunge.start].block, name));
            }
        }
    }
    assert!(passing.is_empty(), "{passing:?}");
}
