//! The verifier of heads over a conveyor is tested by damage: every way to spoil a program is refused under its rule.

use std::collections::BTreeSet;

use cutc::diagnostic::Diagnostics;
use cutc::flow::verify::{Bytes, RULES};
use cutc::flow::{self, Speed};
use cutc::geom::polyline;
use cutc::ir::marker::{Cut, CutKind};
use cutc::machine::Job;
use serde_json::{Value, json};

use super::{Planned, broken, job, judged, planned, written};

/// Two discs, cut by four heads: their plan, and the rows of each head, the first of which are names.
struct Case {
    plan: Value,
    heads: Vec<Vec<String>>,
}

/// A way to damage programs: its name, the rule that it breaks, and what it does.
struct Damage(&'static str, &'static str, fn(&mut Case));

const T: usize = 0;
const CONVEYOR: usize = 1;
const X: usize = 2;
const Y: usize = 3;
const C: usize = 4;
const KNIFE: usize = 5;
const BLOCK: usize = 6;

impl Case {
    fn value(&self, head: usize, row: usize, field: usize) -> f64 {
        self.heads[head][row].split(',').nth(field).expect("a field").parse().expect("a number")
    }

    fn set(&mut self, head: usize, row: usize, field: usize, text: &str) {
        let row = &mut self.heads[head][row];
        let mut fields: Vec<&str> = row.split(',').collect();
        fields[field] = text;
        *row = fields.join(",");
    }

    fn add(&mut self, head: usize, rows: impl Iterator<Item = usize>, field: usize, by: impl Fn(usize) -> f64) {
        for (i, row) in rows.enumerate() {
            let value = self.value(head, row, field) + by(i);
            self.set(head, row, field, &format!("{value:.6}"));
        }
    }

    fn all(&self) -> std::ops::Range<usize> {
        1..self.heads[0].len()
    }

    /// The first and the last row of a head with the knife down.
    fn down(&self, head: usize) -> [usize; 2] {
        let is_down = |row: &String| row.split(',').nth(KNIFE) == Some("1");
        let rows = &self.heads[head];
        [rows.iter().position(is_down).expect("it cuts"), rows.iter().rposition(is_down).expect("it cuts")]
    }

    /// A row amid a cut.
    fn amid(&self, head: usize) -> usize {
        let [first, last] = self.down(head);
        first.midpoint(last)
    }

    fn knife(&mut self, head: usize, rows: impl Iterator<Item = usize>, down: bool) {
        rows.for_each(|row| self.set(head, row, KNIFE, if down { "1" } else { "0" }));
    }

    /// Lifts the blade of the first head so far before its end, mm.
    fn let_go(&mut self, way: f64) {
        let [_, last] = self.down(0);
        let end = self.place(0, last);
        let is_before = |&row: &usize| {
            let here = self.place(0, row);
            (here.0 - end.0).hypot(here.1 - end.1) > way
        };
        let row = (0..last).rev().find(is_before).expect("a way");
        self.knife(0, row..=last, false);
    }

    /// Where a head is over the cloth, but for its station.
    fn place(&self, head: usize, row: usize) -> (f64, f64) {
        (self.value(head, row, X) - self.value(head, row, CONVEYOR), self.value(head, row, Y))
    }

    /// Two heads of one row.
    fn mates(&self) -> [usize; 2] {
        let row = |head: usize| self.plan["heads"][head]["row"].as_u64();
        let pairs = (0..self.heads.len()).flat_map(|a| (a + 1..self.heads.len()).map(move |b| [a, b]));
        pairs.into_iter().find(|&[a, b]| row(a) == row(b)).expect("a row of two")
    }
}

#[rustfmt::skip] // a table: a damage a row
const DAMAGES: &[Damage] = &[
    Damage("a field is missing", "flow-verify/format", |case| "0.010000,1.000000,3.0,4.0,180.0,0".clone_into(&mut case.heads[0][11])),
    Damage("other names", "flow-verify/format", |case| "t_s,x_mm,y_mm,c_deg,knife,block".clone_into(&mut case.heads[0][0])),
    Damage("a number is none", "flow-verify/format", |case| case.set(0, 20, Y, "nan")),
    Damage("half a knife", "flow-verify/format", |case| case.set(0, 20, KNIFE, "2")),
    Damage("a head ends before the others", "flow-verify/format", |case| case.heads[1].truncate(900)),
    Damage("no head has a row", "flow-verify/format", |case| for head in &mut case.heads { head.truncate(1); }),
    Damage("the plan has no speed", "flow-verify/format", |case| case.plan["speed_mm_s"] = Value::Null),
    Damage("the plan has no rows", "flow-verify/format", |case| case.plan["heads"][0]["row"] = json!("first")),
    Damage("a row that the machine does not have", "flow-verify/plan", |case| case.plan["heads"][0]["row"] = json!(9)),
    Damage("a conveyor that is faster than it can be", "flow-verify/plan", |case| case.plan["speed_mm_s"] = json!(900.0)),
    Damage("a row stands elsewhere", "flow-verify/station", |case| { let x = case.plan["heads"][0]["station_mm"].as_f64().expect("a place"); case.plan["heads"][0]["station_mm"] = json!(x + 1.0); }),
    Damage("a head is taken for one of another row", "flow-verify/station", |case| { let row = case.plan["heads"][0]["row"].as_u64().expect("a row"); case.plan["heads"][0]["row"] = json!(3 - row); }),
    Damage("a row is left out", "flow-verify/period", |case| for head in &mut case.heads { head.remove(500); }),
    Damage("a time is off", "flow-verify/period", |case| case.add(0, 300..301, T, |_| 0.0005)),
    Damage("the conveyor is elsewhere", "flow-verify/conveyor", |case| case.add(0, 300..301, CONVEYOR, |_| 0.01)),
    Damage("the conveyor runs at another speed", "flow-verify/conveyor", |case| case.plan["speed_mm_s"] = json!(101.0)),
    Damage("a head beyond its travel", "flow-verify/travel", |case| { let all = case.all(); case.add(0, all, X, |_| 160.0); }),
    Damage("a head before its station", "flow-verify/travel", |case| { let all = case.all(); case.add(0, all, X, |_| -60.0); }),
    Damage("a head off the table", "flow-verify/across", |case| { let all = case.all(); case.add(0, all, Y, |_| -700.0); }),
    Damage("C beyond its range", "flow-verify/c-range", |case| { let all = case.all(); case.add(0, all, C, |_| 720.0); }),
    Damage("an axis jumps", "flow-verify/speed", |case| case.add(0, 300..301, Y, |_| 5.0)),
    Damage("an axis jumps a long way", "flow-verify/speed", |case| { let row = case.amid(0); case.add(0, row..=row, Y, |_| 1e9); }),
    Damage("C jumps", "flow-verify/speed", |case| case.add(0, 300..301, C, |_| 5.0)),
    Damage("an axis jerks to a speed", "flow-verify/acceleration", |case| case.add(0, 300..340, X, |i| 0.02 * i as f64)),
    Damage("an axis trembles", "flow-verify/jerk", |case| case.add(0, 300..301, X, |_| 0.001)),
    Damage("an axis trembles in a cut", "flow-verify/jerk", |case| { let row = case.amid(0); case.add(0, row..=row, Y, |_| 0.001); }),
    Damage("two heads too near", "flow-verify/distance", |case| { let [a, b] = case.mates(); let by = case.value(b, 5, Y) - case.value(a, 5, Y); let (all, side) = (case.all(), by.signum()); case.add(a, all, Y, move |_| by - 40.0 * side); }),
    Damage("two heads at one place", "flow-verify/distance", |case| { let [a, b] = case.mates(); case.heads[a] = case.heads[b].clone(); }),
    Damage("the knife goes down too early", "flow-verify/rest", |case| { let [first, _] = case.down(0); case.knife(0, first - 40..first, true); }),
    Damage("the knife comes up too early", "flow-verify/rest", |case| { let row = case.amid(0); let [_, last] = case.down(0); case.knife(0, row..=last, false); }),
    Damage("the knife is down for a moment", "flow-verify/dwell", |case| { let [first, last] = case.down(0); case.knife(0, first + 1..=last, false); }),
    Damage("the knife is up for a moment", "flow-verify/up", |case| { let row = case.amid(0); case.knife(0, row..row + 3, false); }),
    Damage("the knife stays down", "flow-verify/ends", |case| { let [_, last] = case.down(0); let end = case.heads[0].len(); case.knife(0, last..end, true); }),
    Damage("a program ends in motion", "flow-verify/ends", |case| { let end = case.heads[0].len(); case.add(0, end - 1..end, X, |_| 0.1); }),
    Damage("a head cuts beside its line", "flow-verify/stray", |case| { let all = case.all(); case.add(0, all, Y, |_| 25.0); }),
    Damage("a head is behind the cloth", "flow-verify/deviation", |case| { let all = case.all(); case.add(0, all, X, |_| 2.0); }),
    Damage("a bulge in a cut", "flow-verify/deviation", |case| { let row = case.amid(0); case.add(0, row - 200..row + 200, Y, |i| 0.8 * (std::f64::consts::PI * i as f64 / 400.0).sin().powi(2)); }),
    Damage("the blade is askew", "flow-verify/heading", |case| { let all = case.all(); case.add(0, all, C, |_| 2.0); }),
    Damage("the blade lies as the head moves over the table", "flow-verify/heading", |case| { let row = case.amid(0); case.add(0, row - 100..row + 100, C, |i| 20.0 * (std::f64::consts::PI * i as f64 / 200.0).sin().powi(2)); }),
    Damage("the blade goes heel first", "flow-verify/heading", |case| {
        // 2.2 mm before the C axis and 4.4 mm behind it: turned round it lies where it lay.
        for row in case.all() {
            let (sin, cos) = case.value(0, row, C).to_radians().sin_cos();
            case.add(0, row..=row, X, |_| -2.2 * cos);
            case.add(0, row..=row, Y, |_| -2.2 * sin);
            case.add(0, row..=row, C, |_| 180.0);
        }
    }),
    Damage("a blade is too fast", "flow-verify/feed", |case| { let row = case.amid(0); case.add(0, row..=row, Y, |_| 0.3); case.add(0, row + 1..=row + 1, Y, |_| -0.6); }),
    Damage("a blade stands in the cloth", "flow-verify/crawl", |case| {
        let [first, _] = case.down(0);
        let (from, end) = (first + 300, case.heads[0].len() - 10);
        let [x, y, c, conveyor] = [X, Y, C, CONVEYOR].map(|field| case.value(0, from, field));
        for row in from..end {
            let along = x + case.value(0, row, CONVEYOR) - conveyor;
            for (field, value) in [(X, along), (Y, y), (C, c)] {
                case.set(0, row, field, &format!("{value:.6}"));
            }
        }
        case.knife(0, from..end, true);
    }),
    Damage("a head does not cut", "flow-verify/uncut", |case| { let all = case.all(); case.knife(0, all, false); }),
    Damage("a cut ends too early", "flow-verify/uncut", |case| { let [first, last] = case.down(0); case.knife(0, first + (last - first) * 9 / 10..=last, false); }),
    Damage("a head cuts what another one does", "flow-verify/twice", |case| { let [a, b] = case.mates(); case.heads[a] = case.heads[b].clone(); }),
    Damage("a head lets go before it should", "flow-verify/overlap", |case| {
        // Up to 2 mm before its end: all is cut still, but hardly twice.
        case.let_go(2.0);
    }),
    Damage("a head cuts on beyond its end", "flow-verify/overcut", |case| { let [_, last] = case.down(0); case.knife(0, last..last + 400, true); }),
    Damage("a row names another block", "flow-verify/block", |case| { let row = case.amid(0); case.set(0, row, BLOCK, "4000"); }),
];

fn case(name: &str, speed: f64, job: &Job) -> (super::Planned, Case) {
    let planned = planned(name, speed, job);
    let (plan, heads) = written(&planned, job, "csv");
    let lines = |bytes: Vec<u8>| String::from_utf8(bytes).expect("text").lines().map(str::to_owned).collect();
    let case = Case { plan: serde_json::from_str(&plan).expect("JSON"), heads: heads.into_iter().map(lines).collect() };
    (planned, case)
}

/// The machine of the fixtures whose C axis has ends.
fn bounded() -> Job {
    job(&["c.range_deg=[-400, 400]"])
}

fn rules(planned: &super::Planned, case: &Case, job: &Job) -> (Vec<&'static str>, Option<String>) {
    let heads: Vec<Vec<u8>> = case.heads.iter().map(|rows| (rows.join("\n") + "\n").into_bytes()).collect();
    let verdict = judged(&planned.marker, job, &case.plan.to_string(), Bytes::Rows, &heads);
    (verdict.broken().map(|finding| finding.rule.name).collect(), verdict.unread)
}

#[test]
fn every_damage_breaks_its_rule() {
    let job = bounded();
    let (planned, case) = case("flow/two-discs.csv", 100.0, &job);
    assert_eq!(rules(&planned, &case, &job), (Vec::new(), None));
    assert_eq!(case.heads.len(), 4);
    let mut missed = Vec::new();
    for Damage(name, rule, damage) in DAMAGES {
        let mut spoilt = Case { plan: case.plan.clone(), heads: case.heads.clone() };
        damage(&mut spoilt);
        let found = rules(&planned, &spoilt, &job);
        if !found.0.contains(rule) {
            missed.push(format!("{name}: {rule} is not among {found:?}"));
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

#[test]
fn a_head_that_goes_round_a_part_overlaps_its_own_start() {
    let job = job(&[]);
    let (planned, mut case) = case("flow/bent-extremum.csv", 20.0, &job);
    assert_eq!(case.heads.len(), 1);
    // At a bend of 21 degrees, beside which the blade is plunged and lifted.
    assert_eq!(rules(&planned, &case, &job), (Vec::new(), None));
    case.let_go(2.0);
    let (found, _) = rules(&planned, &case, &job);
    assert!(found.contains(&"flow-verify/overlap") && !found.contains(&"flow-verify/uncut"), "{found:?}");
}

#[test]
fn every_rule_is_broken_by_a_damage() {
    let aimed: BTreeSet<&str> = DAMAGES.iter().map(|damage| damage.1).collect();
    assert_eq!(aimed, RULES.iter().map(|row| row.name).collect());
}

#[test]
fn damaged_records_are_refused() {
    let job = bounded();
    let planned = planned("flow/two-discs.csv", 100.0, &job);
    let (plan, heads) = written(&planned, &job, "npy");
    let spoilt = |damage: &dyn Fn(&mut Vec<u8>)| {
        let mut heads = heads.clone();
        damage(&mut heads[0]);
        let verdict = judged(&planned.marker, &job, &plan, Bytes::Records, &heads);
        verdict.broken().map(|finding| finding.rule.name).collect::<Vec<_>>()
    };
    assert!(spoilt(&|_| {}).is_empty());
    for damage in [
        (&|bytes: &mut Vec<u8>| bytes.truncate(5000)) as &dyn Fn(&mut Vec<u8>),
        &|bytes| bytes.push(0),
        &|bytes| bytes[0] = b'N',
        &|bytes| bytes[40] = b'X',
        &|bytes| bytes[256 + 40] = 7,
        &|bytes| bytes[256 + 16..256 + 24].copy_from_slice(&f64::NAN.to_le_bytes()),
        &|bytes| bytes.truncate(100),
        &|bytes| bytes.clear(),
    ] {
        assert_eq!(spoilt(damage), ["flow-verify/format"]);
    }
}

#[test]
fn what_a_pass_over_the_marker_loses_is_seen() {
    for lines in ["common.lines=off", "common.lines=auto"] {
        let job = job(&["flow.heads=60", "flow.rows=30", lines]);
        let Planned { mut marker, .. } = planned("flow/touching-notched.cut", 50.0, &job);
        let length = |cut: &Cut| polyline::length(&marker.list.points(cut.range));
        for kind in [CutKind::Slit, CutKind::Outline, CutKind::Edge] {
            let of_kind = marker.cuts.iter().enumerate().filter(|(_, cut)| cut.kind == kind);
            let Some((lost, cut)) = of_kind.max_by(|a, b| length(a.1).total_cmp(&length(b.1))) else { continue };
            let cut = *cut;
            marker.cuts.remove(lost);
            let program = flow::plan(&marker, Speed::Of(50.0), &job, &mut Diagnostics::default());
            let spoilt = Planned { marker: marker.clone(), program: program.expect("fewer cuts are no harder") };
            let found = broken(&spoilt, &job);
            assert!(found.iter().any(|found| found.contains("flow-verify/uncut")), "{lines} {kind:?}: {found:?}");
            marker.cuts.insert(lost, cut);
        }
    }
}
