//! The verifier of heads is tested by damage: for each rule a program that breaks it.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use cutc::machine::{Job, Mode};
use cutc::verify::spray::RULES;

use super::{broken, compiled, fixture, job};
use crate::support::damage::survives;
use fastrand::Rng;

/// A program as rows of fields, and the number of the row in the middle of its first edge.
struct Program {
    rows: Vec<Vec<f64>>,
    middle: usize,
}

impl Program {
    fn of(bytes: &[u8]) -> Self {
        let text = std::str::from_utf8(bytes).expect("text");
        let rows: Vec<Vec<f64>> =
            text.lines().skip(1).map(|line| line.split(',').map(|f| f.parse().expect("a number")).collect()).collect();
        let first = rows.iter().position(|row| row[6] == 1.0).expect("a jet");
        let middle = first + 1500;
        assert_eq!(rows[middle][6], 1.0);
        Self { rows, middle }
    }

    /// The bytes of it after a damage.
    fn damaged(&self, damage: impl Fn(&mut Vec<Vec<f64>>, usize)) -> Vec<u8> {
        let mut rows = self.rows.clone();
        damage(&mut rows, self.middle);
        let mut text = String::from("t_s,x_mm,y_mm,c_deg,vx_mm_s,vy_mm_s,jet,block\n");
        for row in rows {
            let [t, x, y, c, vx, vy, jet, block] = row[..] else { panic!("eight fields") };
            // Writing into a `String` cannot fail.
            let _ = writeln!(text, "{t:.6},{x:.6},{y:.6},{c:.6},{vx:.4},{vy:.4},{jet},{block}");
        }
        text.into_bytes()
    }
}

/// A slow bump on a column, over some rows around another.
fn bump(rows: &mut [Vec<f64>], at: usize, column: usize, height: f64) {
    let half = 400;
    for i in 0..=2 * half {
        let share = i as f64 / half as f64 - 1.0;
        rows[at + i - half][column] += height * (1.0 - share * share).powi(4);
    }
}

/// The head comes to stand for three seconds in the middle of a straight edge along X, smoothly.
fn linger(rows: &mut Vec<Vec<f64>>, at: usize) {
    let (ramp, stand) = (1200, 3000);
    let all = 2 * ramp + stand;
    let slow = |tick: usize| {
        let away = if tick < ramp { ramp - tick } else { tick.saturating_sub(ramp + stand) };
        (1.0 - (away as f64 / ramp as f64).powi(2)).powi(4)
    };
    let sum: f64 = (0..all).map(slow).sum();
    // What is left out is a whole number of rows.
    let kept = (all as f64 - 0.9999 * sum).ceil() as usize;
    let depth = (all - kept) as f64 / sum;
    let from = at - kept / 2;
    let mut reached = from as f64;
    let mut lingering = Vec::new();
    for tick in 0..all {
        let (before, share) = (reached as usize, reached.fract());
        let mut row = rows[before].clone();
        for column in 1..=3 {
            row[column] += (rows[before + 1][column] - row[column]) * share;
        }
        lingering.push(row);
        reached += 1.0 - depth * slow(tick);
    }
    rows.splice(from..from + kept, lingering);
    for (tick, row) in rows.iter_mut().enumerate() {
        row[0] = tick as f64 * 1e-3;
    }
    for i in from..from + all {
        for column in [1, 2] {
            rows[i][column + 3] = (rows[i + 1][column] - rows[i - 1][column]) / 2e-3;
        }
    }
}

/// A disc whose outer edge is gone round two times: the second time begins with a jerk, and everything is sprayed again.
fn sprayed_again() -> &'static str {
    let (disc, head) = (fixture("spray/disc.csv"), job(&[]));
    let (_, bytes, _) = compiled(&disc, "csv", &head).unwrap_or_else(|said| panic!("{said}"));
    let again = Program::of(&bytes).damaged(|rows, _| {
        let on = |row: &&Vec<f64>| row[6] == 1.0;
        let first = rows.iter().position(|row| on(&row)).expect("a jet");
        let last = first + rows[first..].iter().take_while(on).count() - 1;
        let turn = rows[last][3] - rows[first][3];
        let mut second = rows.split_off(first);
        rows.extend_from_slice(&second[..=last - first]);
        for row in &mut second {
            row[3] += turn;
        }
        rows.append(&mut second);
        for (tick, row) in rows.iter_mut().enumerate() {
            row[0] = tick as f64 * 1e-3;
        }
    });
    let found = broken(&disc, &again, &head);
    assert!(found.contains(&"spray-verify/twice") && !found.contains(&"spray-verify/coverage"), "{found:?}");
    "spray-verify/twice"
}

#[test]
fn every_rule_is_broken_by_its_damage_and_nothing_else_by_none() {
    let (panel, head) = (fixture("spray/panel.csv"), job(&["park=[-400, -400, 360]", "c.range_deg=[-100, 500]"]));
    let (_, bytes, _) = compiled(&panel, "csv", &head).unwrap_or_else(|said| panic!("{said}"));
    let program = Program::of(&bytes);
    assert_eq!(broken(&panel, &bytes, &head), Vec::<&str>::new());
    assert_eq!(broken(&panel, &program.damaged(|_, _| {}), &head), Vec::<&str>::new());
    let mut seen = BTreeSet::new();
    let mut check = |rule: &str, bytes: &[u8], job: &Job| {
        let found = broken(&panel, bytes, job);
        let rule = format!("spray-verify/{rule}");
        assert!(found.contains(&&*rule), "{rule}: {found:?}");
        seen.insert(rule);
    };
    let damaged = |damage: &dyn Fn(&mut Vec<Vec<f64>>, usize)| program.damaged(damage);
    check("format", &bytes[..bytes.len() - 5], &head);
    check("time", &damaged(&|rows, at| drop(rows.remove(at))), &head);
    check("start", &damaged(&|rows, _| rows[0][1] += 0.01), &head);
    check("end", &damaged(&|rows, _| rows.last_mut().expect("rows")[6] = 1.0), &head);
    for (axis, column) in [("x", 1), ("y", 2), ("c", 3)] {
        check(&format!("jerk-{axis}"), &damaged(&|rows, at| rows[at][column] += 0.01), &head);
        check(&format!("acceleration-{axis}"), &damaged(&|rows, at| rows[at][column] += 0.05), &head);
        check(&format!("speed-{axis}"), &damaged(&|rows, at| rows[at][column] += 5.0), &head);
    }
    let mut narrow = head.clone();
    narrow.profile.c.range_deg = Some([-100.0, 180.0]);
    check("c-range", &bytes, &narrow);
    check("table", &bytes, &job(&["table.y_mm=[-290, 2000]"]));
    check("velocity", &damaged(&|rows, at| rows[at][4] += 0.2), &head);
    check("distance", &damaged(&|rows, at| bump(rows, at, 2, 0.2)), &head);
    // A head over the material that looks outwards is as far from the edge.
    let inside = |rows: &mut Vec<Vec<f64>>, _: usize| {
        for row in rows.iter_mut().filter(|row| row[6] == 1.0 && row[2] < -299.9) {
            (row[2], row[3]) = (300.0, row[3] + 180.0);
        }
    };
    check("distance", &damaged(&inside), &head);
    check("heading", &damaged(&|rows, at| bump(rows, at, 3, 3.0)), &head);
    check("edge-speed", &bytes, &job(&["tool.edge_speed_mm_s=250"]));
    // Ten milliseconds without a jet are 3 mm without a coat.
    let gap = damaged(&|rows, at| rows[at..at + 10].iter_mut().for_each(|row| (row[6], row[7]) = (0.0, 0.0)));
    assert_eq!(broken(&panel, &gap, &head), ["spray-verify/coverage"]);
    check("coverage", &gap, &head);
    let standing = damaged(&linger);
    assert_eq!(broken(&panel, &standing, &head), ["spray-verify/dwell"]);
    check("dwell", &standing, &head);
    check("block", &damaged(&|rows, at| rows[at][7] = 134.0), &head);
    check("jet", &bytes, &Job { mode: Mode::Dry, ..head.clone() });
    seen.insert(sprayed_again().to_owned());
    let reported = ["spray-verify/edge-slow"];
    let all: BTreeSet<String> =
        RULES.iter().map(|row| row.name.to_owned()).filter(|name| !reported.contains(&name.as_str())).collect();
    assert_eq!(seen, all);
}

#[test]
fn damaged_programs_and_drawings_are_judged_or_refused_without_a_panic() {
    let (panel, head) = (fixture("spray/slot.csv"), job(&["time.period_ms=50", "axes.c.speed_deg_s=90"]));
    let (_, bytes, _) = compiled(&panel, "csv", &head).unwrap_or_else(|said| panic!("{said}"));
    let mut random = Rng::with_seed(28);
    survives(&mut random, 60, ("slot.csv", &bytes), |bytes| drop(broken(&panel, bytes, &head)));
    survives(&mut random, 60, ("slot.csv", panel.bytes()), |bytes| {
        let source = cutc::source::Source::new("slot.csv", bytes.to_vec()).expect("small");
        drop(compiled(&source, "csv", &head));
    });
}
