//! Files of patterns and stitches: each is read or refused as it should be, whatever is done to it.

use std::fmt::Write as _;

use cutc::machine::{Job, load};
use cutc::sew::{Limit, Op};
use cutc::source::Source;
use fastrand::Rng;

use super::{broken, fixture, plan, planned, target, written};
use crate::support::damage::{names, survives};
use crate::support::room::{DONE, FAULTY, Room, USAGE};

/// Damages of each file that are tried.
const DAMAGES: usize = 400;

#[test]
fn every_pattern_is_sewn_and_said() {
    let job = Job::default();
    let mut all = String::new();
    for name in names("sew") {
        let original = fixture(&name);
        let (program, said, _) = plan(&name, original.clone(), &job);
        let program = program.unwrap_or_else(|| panic!("{name}: {said}"));
        let _ = writeln!(all, "{name}: {}, {} stitches", program.format, program.stitches.count());
        for run in &program.runs {
            let limit = match run.limit {
                Limit::Machine => "machine".to_owned(),
                Limit::User(i) => format!("user, entry {}", i + 1),
                Limit::Stitch(i) => format!("entry {}", i + 1),
            };
            let _ = writeln!(all, "  {} at {} rpm: {limit}, costs {:.2} s", run.steps.len(), run.rpm, run.cost);
        }
        all += &said;
        for name in ["queue", "jsonl", "pulses", "pulses-npy", "dst", "exp", "pes", "jef"] {
            let bytes = written(&program, &job, name);
            assert_eq!(broken(&program, &original, &job, (name, &bytes)), [""; 0], "{name}");
            assert_eq!(bytes, written(&program, &job, name));
        }
    }
    insta::assert_snapshot!(all);
}

#[test]
fn every_fault_of_a_file_is_said() {
    let mut all = String::new();
    for name in names("invalid/sew") {
        let (program, said, out) = plan(&name, fixture(&name), &Job::default());
        assert!(program.is_none() && out.has_errors(), "{name}: {said}");
        let _ = writeln!(all, "{name}\n{said}");
    }
    insta::assert_snapshot!(all);
}

#[test]
fn damaged_files_are_refused_or_sewn_but_never_end_in_a_panic() {
    let mut random = Rng::with_seed(11);
    for name in names("sew").into_iter().chain(names("invalid/sew")) {
        survives(&mut random, DAMAGES, (&name, &fixture(&name)), |bytes| {
            let job = Job::default();
            if let Some(program) = plan(&name, bytes.to_vec(), &job).0 {
                for target in ["queue", "dst", "jef"] {
                    let written = written(&program, &job, target);
                    assert_eq!(broken(&program, bytes, &job, (target, &written)), [""; 0]);
                }
            }
        });
    }
}

#[test]
fn a_file_that_is_cut_off_anywhere_is_refused_or_sewn_as_a_whole() {
    let job = Job::default();
    let is_of = |name: &str, extension: &str| name.rsplit_once('.').is_some_and(|(_, ends)| ends == extension);
    let is_told = |name: &&String| !is_of(name, "csv") && !name.contains("wrong-header");
    for name in names("sew").iter().filter(is_told) {
        let whole = fixture(name);
        let steps = planned(name, &job).stitches.steps;
        for end in 0..whole.len() {
            let cut = plan(name, whole[..end].to_vec(), &job).0;
            // An EXP file has no end; all others tell it, or how many records there are.
            if let Some(program) = cut.filter(|_| !is_of(name, "exp")) {
                assert_eq!(program.stitches.steps.len(), steps.len(), "{name}, {end} of {} bytes", whole.len());
            }
        }
    }
}

#[test]
fn stitches_of_all_formats_are_those_of_the_design() {
    let job = Job::default();
    let leaf = |extension: &str| planned(&format!("sew/leaf.{extension}"), &job);
    let needle = |program: &cutc::sew::Program| -> Vec<[i64; 2]> {
        let stitches = program.stitches.steps.iter().filter(|step| step.op == Op::Stitch);
        stitches.map(|step| [step.to.x, step.to.y].map(|mm| (10.0 * mm).round() as i64)).collect()
    };
    let first = needle(&leaf("pes"));
    assert_eq!((first.len(), first[0], first[37]), (64, [-150, -40], [-60, -160]));
    for extension in ["pec", "jef", "vp3", "xxx", "u01"] {
        assert_eq!(needle(&leaf(extension)), first, "{extension}");
    }
    let halts = |extension: &str| -> Vec<Op> {
        let steps = leaf(extension).stitches.steps;
        steps.iter().map(|step| step.op).filter(|op| !matches!(op, Op::Stitch | Op::Jump | Op::Trim)).collect()
    };
    for extension in ["pes", "pec", "jef", "u01"] {
        assert_eq!(halts(extension), [Op::Color(2), Op::Stop], "{extension}");
    }
    // XXX has a thread for a stop, and VP3 nothing.
    assert_eq!((halts("xxx"), halts("vp3")), (vec![Op::Color(2), Op::Color(3)], vec![Op::Color(2)]));
}

#[test]
fn stitch_files_and_queues_read_back_as_what_was_written() {
    let job = Job::default();
    let program = planned("sew/pocket.csv", &job);
    let places = |program: &cutc::sew::Program| {
        let stitches = program.stitches.steps.iter().filter(|step| step.op == Op::Stitch);
        stitches.map(|step| step.to).collect::<Vec<_>>()
    };
    for (name, accuracy) in [("dst", 0.051), ("exp", 0.051), ("pes", 0.051), ("jef", 0.051), ("queue", 0.0251)] {
        let (read, said, _) = plan(&format!("x.{name}"), written(&program, &job, name), &job);
        let read = read.unwrap_or_else(|| panic!("{said}"));
        let (asked, found) = (places(&program), places(&read));
        assert_eq!(asked.len(), found.len(), "{name}");
        for (a, b) in asked.iter().zip(&found) {
            assert!((a.x - b.x).abs().max((a.y - b.y).abs()) <= accuracy, "{name}: {a} {b}");
        }
        let ops = |program: &cutc::sew::Program| {
            program.stitches.steps.iter().filter(|step| matches!(step.op, Op::Trim | Op::Stitch)).count()
        };
        assert_eq!(ops(&program), ops(&read), "{name}");
    }
}

#[test]
fn the_command_writes_what_it_proves_and_nothing_else() {
    let room = Room::new();
    room.write("pocket.csv", &fixture("sew/pocket.csv"));
    room.write("long.csv", &fixture("invalid/sew/stitch-too-long.csv"));
    let said = room.says("sew pocket.csv -t queue,dst,svg,timing,html,pulses-npy", DONE);
    assert!(said.contains("3200") && said.contains("rules hold"), "{said}");
    for name in
        ["pocket.queue.csv", "pocket.dst", "pocket.svg", "pocket.timing.svg", "pocket.html", "pocket.pulses.npy"]
    {
        assert!(room.has(name) && room.has(&format!("{name}.meta.json")), "{name}");
    }
    let meta = room.text("pocket.dst.meta.json");
    assert!(meta.contains("\"verified\": \"yes\"") && meta.contains("\"target\": \"dst\""), "{meta}");
    // What fails leaves nothing, and moves aside what is there.
    room.write("long.dst", b"old");
    room.write("long.dst.meta.json", b"{\"source\": \"long.csv\"}");
    let said = room.says("sew long.csv -t dst", FAULTY);
    assert!(said.contains("record 3") && said.contains("13.000 mm"), "{said}");
    assert!(!room.has("long.dst") && room.has("long.dst.stale"));
    assert!(room.says("sew long.csv -t dst --on-long split", DONE).contains("penetrations"));
    assert!(room.says("sew pocket.csv --set sewing.feed_end_deg=250", USAGE).contains("no time to move"));
    assert!(room.says("sew pocket.csv -o x.csv", USAGE).contains("is the name of no target"));
    assert!(room.says("sew pocket.csv -o pocket.csv -t queue", USAGE).contains("is an input"));
    assert!(room.says("sew pocket.csv -t queue --set sewing.producer_hz=20", DONE).contains("runs dry"));
    let (json, _) = room.expect("sew pocket.csv -t queue --format json", DONE);
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!((&json["format"], &json["queue"]["depth"]), (&"pattern".into(), &64.into()));
    let (queue, _) = room.expect("sew pocket.csv -o -", DONE);
    assert_eq!(queue, room.text("pocket.queue.csv"));
}

#[test]
fn contours_of_cut_files_are_sewn_inside_and_lines_of_plots_by_their_pen() {
    let room = Room::new();
    let said = room.says("sew circle.cut --inset 2 -t queue", DONE);
    assert!(said.contains("iso") && said.contains("rules hold"), "{said}");
    assert!(room.says("sew circle.cut --inset 9 -t queue", FAULTY).contains("too narrow"));
    let square = "PU0,0;PD4000,0,4000,4000,0,4000,0,0;";
    let seam = "PU400,400;PD3600,400,3600,3600,400,3600,400,400;";
    room.write("part.plt", format!("IN;SP1;{square}SP2;{seam}SP0;").as_bytes());
    for line in ["2", "seam"] {
        let said = room.says(&format!("sew part.plt --line {line} -t queue -o {line}.queue.csv"), DONE);
        assert!(said.contains("135 in 1 run"), "{said}");
    }
    assert_eq!(room.read("2.queue.csv"), room.read("seam.queue.csv"));
    assert!(room.says("sew part.plt --line 7 -t queue", FAULTY).contains("pens or layers are 1, 2"));
    // A pattern is sewn where it says.
    room.write("pocket.csv", &fixture("sew/pocket.csv"));
    assert!(room.says("sew pocket.csv --inset 2 -t queue", FAULTY).contains("no contours"));
    assert!(room.says("sew pocket.csv --line seam -t queue", FAULTY).contains("no pens or layers"));
}

#[test]
fn the_picture_of_the_manual_is_what_the_program_draws() {
    let profile = String::from_utf8(fixture("machines/sew-capped.toml")).expect("text");
    let profile = Source::new("sew-capped.toml", profile.into_bytes()).expect("small");
    let job = Job { profile: load(Some(&profile), &[]).expect("legal"), ..Job::default() };
    let drawn = written(&planned("sew/slant.csv", &job), &job, "timing");
    let shown = fixture("pictures/slant.timing.svg");
    assert!(cutc::manual::PAGES.iter().any(|page| page.text.contains("fixtures/pictures/slant.timing.svg")));
    let command =
        "cutc sew fixtures/sew/slant.csv -p fixtures/machines/sew-capped.toml -t timing -o fixtures/pictures/";
    assert!(drawn == shown, "the picture is stale: write it anew with `{command} --force`");
}

#[test]
fn every_target_has_a_name_and_an_extension_of_its_own() {
    for (i, one) in cutc::sew::TARGETS.iter().enumerate() {
        assert_eq!(target(one.name).extension, one.extension);
        assert!(cutc::sew::TARGETS[..i].iter().all(|other| other.extension != one.extension), "{}", one.name);
    }
}
