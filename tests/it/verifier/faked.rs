//! Declarations that are left out, moved, made greater or less, or given to something else: none of them excuses anything.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use cutc::geom::{Heading, Point};
use cutc::ir::declaration::{Declaration, Kind, Which};
use cutc::machine::{Job, TightCurves};
use cutc::pipeline::Declared;

use crate::support;
use crate::support::program::declarations;
use crate::verifier::case::{self, Case};
use crate::verifier::judge;

/// How far a declaration is moved along its cut, mm.
const AWAY: f64 = 20.0;
/// Entries of a kind that are faked in each program, at the most.
const OF_A_KIND: usize = 3;
/// A deviation of less is none to speak of, mm: half of it is within what is allowed anyway.
const WORTH: f64 = 1.2;
/// Faked declarations, at the least.
const AT_LEAST: usize = 40;

/// What is done to a declaration; `None` where that would change nothing.
type Fake = fn(&Declaration) -> Option<Option<Declaration>>;

const FAKES: &[(&str, Fake)] = &[
    ("left out", |entry| (entry.kind != Kind::Swing && is_worth(entry)).then_some(None)),
    ("half", |entry| {
        let can_be = ![Kind::Swing, Kind::Lift].contains(&entry.kind);
        (can_be && is_worth(entry)).then(|| Some(Declaration { magnitude_mm: entry.magnitude_mm / 2.0, ..*entry }))
    }),
    ("ten times as much", |entry| {
        (entry.magnitude_mm > WORTH).then_some(Some(Declaration { magnitude_mm: 10.0 * entry.magnitude_mm, ..*entry }))
    }),
    ("of another cut", |entry| is_worth(entry).then(|| Some(Declaration { cut: entry.cut + 1000, ..*entry }))),
    ("moved", |entry| {
        let moved = |station: f64| station + AWAY;
        // One that is of all of its cut lies nowhere else.
        let is_short = (entry.to_mm - entry.from_mm).abs() < AWAY && entry.kind != Kind::Swing;
        (is_worth(entry) && is_short)
            .then(|| Some(Declaration { from_mm: moved(entry.from_mm), to_mm: moved(entry.to_mm), ..*entry }))
    }),
    ("of the other end", |entry| {
        let other = |end| if end == Which::Start { Which::End } else { Which::Start };
        let end = entry.end.filter(|_| is_worth(entry) && entry.kind != Kind::Lift)?;
        Some(Some(Declaration { end: Some(other(end)), ..*entry }))
    }),
    ("of another part", |entry| {
        entry.part.filter(|_| is_worth(entry)).map(|part| Some(Declaration { part: Some(part + 1000), ..*entry }))
    }),
];

fn is_worth(entry: &Declaration) -> bool {
    entry.magnitude_mm > WORTH || matches!(entry.kind, Kind::Lift | Kind::Nibbled)
}

fn verdict_of(case: &Case, entries: Vec<Declaration>) -> Vec<&'static str> {
    judge(&case.program, &case.marker, &Declared::new(entries), &case.job)
        .broken()
        .map(|found| found.rule.name)
        .collect()
}

/// A part with a rounded notch that is nibbled, on whose straight legs the blade goes on by less than the tolerance.
fn nibbled() -> Case {
    let mut job = Job::default();
    job.profile.knife.tight_curves = TightCurves::Nibble;
    let knife = &job.profile.knife;
    let leg = knife.width_mm - knife.corner_heel_overlap_mm + 0.03;
    let round = (0..=6).map(|i| Point::new(43.0, leg) + Heading::new(PI - PI * f64::from(i) / 6.0).unit() * 3.0);
    let [before, behind] =
        [[(0.0, 0.0), (40.0, 0.0)].as_slice(), &[(46.0, 0.0), (90.0, 0.0), (90.0, 60.0), (0.0, 60.0), (0.0, 0.0)]]
            .map(|points| points.iter().map(|&(x, y)| Point::new(x, y)));
    let points: Vec<Point> = before.chain(round).chain(behind).collect();
    Case::new("nibbled", support::marker(&points), job)
}

/// How many fakes of a program are refused; `of_a_kind` entries of each kind are faked at the most.
fn check(case: &Case, of_a_kind: usize) -> usize {
    let entries = declarations(&case.marker, &case.job);
    assert_eq!(verdict_of(case, entries.clone()), [""; 0], "{}", case.name);
    let (mut of_kinds, mut faked) = (BTreeMap::<Kind, usize>::new(), 0);
    for (place, entry) in entries.iter().enumerate() {
        let count = of_kinds.entry(entry.kind).or_default();
        *count += 1;
        if *count > of_a_kind {
            continue;
        }
        for (name, fake) in FAKES {
            let Some(fake) = fake(entry) else { continue };
            let mut others = entries.clone();
            others.splice(place..=place, fake);
            let is_refused = !verdict_of(case, others).is_empty();
            // A blade may lie that deep without a word where other parts or cuts are so near.
            let may_be =
                entry.kind == Kind::Surplus && ["left out", "half", "moved", "of the other end"].contains(name);
            assert!(is_refused || may_be, "{}: {entry:?}, {name}", case.name);
            faked += usize::from(is_refused);
        }
    }
    faked
}

#[test]
fn a_faked_declaration_refuses_its_program() {
    let faked: usize = case::all().iter().map(|case| check(case, OF_A_KIND)).sum();
    assert!(faked >= AT_LEAST, "{faked}");
}

#[test]
fn each_plunge_of_a_nibbled_curve_needs_its_own_declaration() {
    let case = nibbled();
    let legs = declarations(&case.marker, &case.job);
    let legs = legs.iter().filter(|entry| entry.kind == Kind::Nibbled && entry.magnitude_mm > 6.0).count();
    assert_eq!(legs, 2, "the blade stands still on both legs");
    assert!(check(&case, usize::MAX) >= AT_LEAST);
}
