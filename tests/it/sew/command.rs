//! `cutc sew` as it is used: many files, files that are none, what is said of pictures; and what other commands say of
//! files of sewing machines.

use super::fixture;
use crate::support::room::{DONE, FAULTY, Room, USAGE};

#[test]
fn many_files_are_sewn_below_one_folder() {
    let room = Room::new();
    std::fs::create_dir_all(room.at("in/b")).expect("writable");
    room.write("in/a.dst", &fixture("sew/seat.dst"));
    room.write("in/b/c.csv", &fixture("sew/pocket.csv"));
    room.write("in/bad.dst", &fixture("invalid/sew/record.dst"));
    let said = room.says("sew in -t queue,svg -o out", FAULTY);
    assert!(said.contains("3 files, 2 done, 1 failed") && said.contains("FAILED sew/record"), "{said}");
    assert!(said.contains("stitches") && said.contains("thread m"), "{said}");
    for name in ["out/a.queue.csv", "out/a.svg", "out/b/c.queue.csv", "out/b/c.svg.meta.json"] {
        assert!(room.has(name), "{name}");
    }
    assert!(!room.has("out/bad.queue.csv"));
    // What one alone gives.
    room.says("sew in/a.dst -t queue -o one/", DONE);
    assert_eq!(room.read("one/a.queue.csv"), room.read("out/a.queue.csv"));
    let (json, _) = room.expect("sew in/a.dst in/bad.dst -t queue -o out --format json", FAULTY);
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!((&json[0]["format"], &json[1]["format"]), (&"dst".into(), &serde_json::Value::Null));
    assert!(room.says("sew in/a.dst in/b/c.csv -o x.queue.csv", USAGE).contains("one place for many programs"));
    room.write("in/a.exp", &fixture("sew/three-seams.exp"));
    assert!(room.says("sew in/a.dst in/a.exp -t queue -o out", USAGE).contains("would collide"));
    assert!(room.says("sew in/*.none", USAGE).contains(".dst"));
}

#[test]
fn only_what_was_changed_is_sewn_and_a_part_of_a_folder_at_a_time() {
    let room = Room::new();
    std::fs::create_dir(room.at("in")).expect("writable");
    room.write("in/a.dst", &fixture("sew/seat.dst"));
    room.write("in/b.csv", &fixture("sew/pocket.csv"));
    let run = |options: &str, expected: &str| {
        let said = room.says(&format!("sew in -o out/ --changed {options}"), DONE);
        assert!(said.contains(expected), "{options}: {said}");
    };
    run("", "2 files, 2 done");
    let manifest = room.read("out/cutc.jsonl");
    let lines = String::from_utf8(manifest.clone()).expect("text");
    assert!(lines.lines().count() == 2 && lines.matches("\"verdict\":\"verified\"").count() == 2, "{lines}");
    run("", "2 files, 2 unchanged");
    assert_eq!(room.read("out/cutc.jsonl"), manifest);
    room.write("in/b.csv", &fixture("sew/square.csv"));
    run("", "2 files, 1 done, 1 unchanged");
    room.write("out/b.queue.csv", b"op\n");
    run("", "2 files, 1 done, 1 unchanged");
    // What the programs depend on: the profile, and whether they were judged.
    run("--set sewing.max_rpm=1000", "2 files, 2 done");
    run("--set sewing.max_rpm=1000 --no-verify", "2 files, 2 done");
    run("--set sewing.max_rpm=1000 --no-verify", "2 files, 2 unchanged");
    room.write("in/bad.dst", &fixture("invalid/sew/record.dst"));
    assert!(room.says("sew in -o out/ --changed", FAULTY).contains("3 files, 2 done, 1 failed"));
    let lines = String::from_utf8(room.read("out/cutc.jsonl")).expect("text");
    let refused = lines.lines().find(|line| line.contains("bad.dst")).expect("a line");
    assert!(refused.contains("\"verdict\":\"refused\",\"outputs\":[]"), "{refused}");
    std::fs::remove_file(room.at("in/bad.dst")).expect("removable");
    for part in 1..=2 {
        room.expect(&format!("sew in -o parts/ --shard {part}/2"), DONE);
    }
    for name in ["a.queue.csv", "b.queue.csv"] {
        assert_eq!(room.read(&format!("parts/{name}")), room.read(&format!("out/{name}")), "{name}");
    }
    assert!(room.says("sew in -o parts/ --changed", DONE).contains("2 files, 2 unchanged"));
}

#[test]
fn a_file_is_checked_for_the_machine_that_is_to_work_on_it() {
    let room = Room::new();
    room.write("seat.dst", &fixture("sew/seat.dst"));
    room.write("bad.dst", &fixture("invalid/sew/record.dst"));
    room.write("log.csv", &fixture("track/unix-times.csv"));
    room.write("disc.cut", &fixture("iso/seed-circle.cut"));
    room.write("across.csv", &fixture("invalid/flow/edge-across-the-feed.csv"));
    room.write("flow.toml", &fixture("machines/flow.toml"));
    let files = || std::fs::read_dir(room.at(".")).expect("readable").count();
    let before = files();
    assert!(room.says("check seat.dst --for sew", DONE).contains("seat.dst: dst, 0 errors"));
    assert!(room.says("check bad.dst --for sew", FAULTY).contains("sew/record"));
    assert!(room.says("check seat.dst", FAULTY).contains("cutc sew"));
    assert!(room.says("check log.csv --for track", DONE).contains("log.csv: log, "));
    let said = room.says("check disc.cut seat.dst --for sew", DONE);
    assert!(said.contains("2 files, 2 done"), "{said}");
    let said = room.says("check disc.cut --for flow --set bite.length_mm=500", USAGE);
    assert!(said.contains("cut cloth that moves"), "{said}");
    let said = room.says("check across.csv --for flow -p flow.toml", FAULTY);
    assert!(said.contains("flow/"), "{said}");
    assert!(room.says("check disc.cut --for milling", USAGE).contains("flow"));
    assert_eq!(files(), before, "a check writes nothing");
}

#[test]
fn programs_are_judged_anew_by_what_they_were_sewn_from() {
    let room = Room::new();
    std::fs::create_dir(room.at("in")).expect("writable");
    room.write("in/pocket.csv", &fixture("sew/pocket.csv"));
    room.write("in/disc.cut", &fixture("iso/seed-circle.cut"));
    room.expect("sew in/pocket.csv -t queue,jsonl,pulses,pulses-npy,dst,exp,svg -o out/", DONE);
    let said = room.says("verify out --source in/pocket.csv", DONE);
    assert!(said.contains("6 files, 6 done"), "{said}");
    let said = room.says("verify out/pocket.queue.csv --source in/pocket.csv", DONE);
    assert!(said.contains("PASS  `out/pocket.queue.csv` sews what `in/pocket.csv` says"), "{said}");
    assert!(!said.contains("warning"), "{said}");
    // Without its provenance a program is told by its name.
    room.write("carried.dst", &room.read("out/pocket.dst"));
    room.expect("verify carried.dst --source in/pocket.csv", DONE);
    let mut bytes = room.read("out/pocket.dst");
    bytes[600] ^= 1;
    room.write("out/pocket.dst", &bytes);
    let said = room.says("verify out/pocket.dst --source in/pocket.csv", FAULTY);
    assert!(said.contains("FAIL  sew-verify/needle-point") && said.contains("\n      entry "), "{said}");
    assert!(said.contains("its bytes are others"), "{said}");
    // Options of sewing are given again; options without an effect are refused.
    room.expect("sew in/disc.cut --inset 3 -t queue -o inset/", DONE);
    let judged = "verify inset/disc.queue.csv --source in/disc.cut";
    let said = room.says(&format!("{judged} --inset 3"), DONE);
    assert!(!said.contains("warning: the program was made with other options"), "{said}");
    let said = room.says(judged, FAULTY);
    assert!(said.contains("with --inset 3") && said.contains("FAIL  sew-verify/"), "{said}");
    assert!(room.says(&format!("{judged} --pieces 1"), USAGE).contains("`--pieces 1` does nothing"));
    room.expect("compile in/disc.cut -o disc.csv", DONE);
    assert!(room.says("verify disc.csv --source in/disc.cut --inset 3", USAGE).contains("no program of `cutc sew`"));
}

#[test]
fn pictures_are_not_said_to_be_read_back() {
    let room = Room::new();
    room.write("pocket.csv", &fixture("sew/pocket.csv"));
    let said = room.says("sew pocket.csv -t svg", DONE);
    assert!(said.contains("svg, a picture, is not read back") && said.contains("hold of pulses-npy"), "{said}");
    let (json, _) = room.expect("sew pocket.csv -t svg,queue --format json", DONE);
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let judged = |i: usize| (json["verified"][i]["target"].clone(), json["verified"][i]["judged"].clone());
    assert_eq!([judged(0), judged(1)], [("svg".into(), "queue".into()), ("queue".into(), "queue".into())]);
}

#[test]
fn other_commands_say_who_reads_files_of_sewing_machines() {
    let room = Room::new();
    let files = [
        "sew/seat.dst",
        "sew/three-seams.exp",
        "sew/pocket.csv",
        "sew/headline.csv",
        "sew/leaf.pes",
        "sew/leaf.pec",
        "sew/leaf.jef",
        "sew/leaf.vp3",
    ];
    for name in files {
        let file = name.rsplit('/').next().expect("a name");
        room.write(file, &fixture(name));
        for command in ["check", "info", "compile -o made/"] {
            let said = room.says(&format!("{command} {file}"), FAULTY);
            assert!(said.contains("`cutc sew` reads"), "{command} {file}: {said}");
        }
    }
}

#[test]
fn a_file_that_nothing_reads_is_told_all_that_is_read() {
    let room = Room::new();
    room.write("x.txt", b"hello world\n");
    for file in ["x.txt", "junk.cut"] {
        let said = room.says(&format!("sew {file}"), FAULTY);
        assert!(
            said.contains("reads pattern, queue, dst, exp, pes, pec, jef, vp3, xxx, u01, and the lines of iso"),
            "{said}"
        );
    }
}

#[test]
fn a_stitch_file_of_another_kind_is_named_with_a_way_to_convert_it() {
    let room = Room::new();
    room.write("patch.dsb", &fixture("invalid/sew/barudan.dsb"));
    room.write("patch.dst", &fixture("invalid/sew/barudan.dsb"));
    room.write("patch.hus", b"[\xb3\xc8\0 patch");
    room.write("patch.emb", b"\x01\x02 patch");
    for (file, what, advice) in [
        ("patch.dsb", "Barudan machines (DSB)", "pyembroidery"),
        ("patch.dst", "Barudan machines (DSB)", "pyembroidery"),
        ("patch.hus", "an embroidery file", "pyembroidery"),
        ("patch.emb", "an embroidery file", "its own program"),
    ] {
        for command in ["sew", "compile -o made/"] {
            let said = room.says(&format!("{command} {file}"), FAULTY);
            assert!(said.contains(what) && said.contains(advice) && said.contains("DST"), "{command} {file}: {said}");
        }
    }
}

#[test]
fn records_are_called_what_they_are_in_the_file() {
    let room = Room::new();
    room.write("line.csv", b"x_mm,y_mm,element\n0,0,\n0,9,\n\n0,20,\n13,20,\n");
    let said = room.says("sew line.csv --set sewing.pitch_mm=12.7 --on-long reject", FAULTY);
    assert!(said.contains("the stitch of line 2, 7.600 mm long"), "{said}");
    let said = room.says("sew circle.cut --set sewing.pitch_mm=12.7 --on-long reject", FAULTY);
    assert!(said.contains("the stitch of block"), "{said}");
}

#[test]
fn the_legend_of_a_small_picture_is_not_cut_off() {
    let room = Room::new();
    room.write("dot.csv", b"x_mm,y_mm,element\n0,0,\n5,0,\n");
    room.says("sew dot.csv -t svg", DONE);
    let svg = room.text("dot.svg");
    let width = svg.split_once("width=\"").expect("a width").1.split_once("mm").expect("in mm").0;
    let left = svg.split_once("viewBox=\"").expect("a box").1.split_once(' ').expect("numbers").0;
    let text = svg.split("<text x=\"").nth(4).expect("a row of the legend");
    let (at, text) = text.split_once('"').expect("a place");
    let letters = text.split_once('>').expect("text").1.split_once('<').expect("text").0.len();
    let number = |text: &str| text.parse::<f64>().expect("a number");
    // Letters of 3 mm are half as wide on average.
    assert!(number(at) + 1.5 * letters as f64 <= number(left) + number(width), "{svg}");
}
