//! Many files looked into, checked and judged at once, as a user meets it.

use std::fs;

use serde_json::Value;

use crate::support::room::{DONE, FAULTY, Room, USAGE};

/// A square of 100 mm with a notch of 4 mm2 in an edge, in it a cut-out of 60 mm, in that a part of 20 mm, beside them a
/// rectangle of 50 x 80 mm.
const PARTS: &str = "H1*G71*M15*N1*X200Y200*M14*X800Y200*X800Y800*X200Y800*X200Y200*M15*\
    X0Y0*M14*X480Y0*X500Y20*X520Y0*X1000Y0*X1000Y1000*X0Y1000*X0Y0*M15*\
    N2*X400Y400*M14*X600Y400*X600Y600*X400Y600*X400Y400*M15*\
    N3*X1500Y0*M14*X2000Y0*X2000Y800*X1500Y800*X1500Y0*M15*M0*";
/// Its area, m2: 10,000 - 4 - 3,600 + 400 + 4,000 mm2.
const PARTS_M2: f64 = 0.010_796;
/// A square of 100 mm with sharp corners.
const SQUARE: &str = "x_mm,y_mm\n0,0\n100,0\n100,100\n0,100\n0,0\n";

/// A room with good files and a bad one in folders.
fn folders() -> Room {
    let room = Room::new();
    for folder in ["in", "in/a", "in/b"] {
        fs::create_dir(room.at(folder)).expect("writable");
    }
    room.write("in/parts.cut", PARTS.as_bytes());
    room.write("in/a/square.csv", SQUARE.as_bytes());
    fs::copy(room.at("circle.cut"), room.at("in/a/circle.cut")).expect("writable");
    fs::copy(room.at("junk.cut"), room.at("in/b/bad.cut")).expect("writable");
    room
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

fn near(value: &Value, expected: f64) {
    let value = value.as_f64().unwrap_or_else(|| panic!("{value} is a number"));
    assert!((value - expected).abs() <= 1e-8 * expected.abs().max(1.0), "{value}, not {expected}");
}

#[test]
fn check_tells_each_file_by_itself_and_ends_with_a_table() {
    let room = folders();
    let (stdout, stderr) = room.expect("check in -j 2", FAULTY);
    assert_eq!(stdout, "");
    let table: Vec<&str> = stderr.lines().skip_while(|line| !line.starts_with("  file")).collect();
    assert!(table[0].ends_with("pieces  cut m  worst finding"), "{stderr}");
    let firsts: Vec<_> = table.iter().filter_map(|line| line.split_whitespace().next()).collect();
    assert_eq!(firsts, ["file", "in/a/circle.cut", "in/a/square.csv", "in/parts.cut", "in/b/bad.cut", "all", "4"]);
    assert!(table[4].contains("FAILED source/") && table[6] == "4 files, 3 done, 1 failed", "{stderr}");
    assert!(!stderr.contains("0 errors"), "{stderr}");
    assert!(room.says("check in/a in/parts.cut", DONE).contains("3 files, 3 done"));
    let (_, stderr) = room.expect_of(SQUARE.as_bytes(), "check circle.cut -", DONE);
    assert!(stderr.contains("  stdin ") && stderr.contains("2 files, 2 done"), "{stderr}");
    assert_eq!(room.expect("check in/parts.cut", DONE).1, "in/parts.cut: iso, 0 errors, 0 warnings\n");
}

#[test]
fn check_of_many_files_is_the_list_of_check_of_each() {
    let room = folders();
    let (all, _) = room.expect("check in --format json", FAULTY);
    let of = |name: &str, code| {
        let (one, _) = room.expect(&format!("check {name} --format json"), code);
        one.trim_start_matches("[\n").trim_end_matches("\n]\n").to_owned()
    };
    let each = [of("in/a/circle.cut", DONE), of("in/a/square.csv", DONE), of("in/b/bad.cut", FAULTY)];
    assert_eq!(all, format!("[\n{},\n{}\n]\n", each.join(",\n"), of("in/parts.cut", DONE)));
}

#[test]
fn the_area_of_parts_is_that_of_their_outlines_less_their_cut_outs() {
    let room = folders();
    let (stdout, _) = room.expect("info in/parts.cut --format json", DONE);
    let figures = json(&stdout);
    near(&figures["area_m2"], PARTS_M2);
    near(&figures["cloth_length_mm"], 200.0);
    near(&figures["cloth_width_mm"], 100.0);
    near(&figures["utilisation_percent"], 53.98);
    assert!(figures["time_s"].is_null() && figures.get("cost").is_none());
    let (stdout, stderr) = room.expect("info in/parts.cut --cloth-width 200", DONE);
    assert!(stdout.contains("  area       0.0108 m2 of parts\n"), "{stdout}");
    assert!(stdout.contains("  used       27.0 % of 200.0 x 200.0 mm of cloth\n"), "{stdout}");
    assert_eq!(stderr, "");
    let (_, stderr) = room.expect("info in/parts.cut --cloth-width 9cm", DONE);
    assert!(stderr.contains("100 mm wide, more than the 90 mm of the cloth"), "{stderr}");
    room.expect("info in/parts.cut --cloth-width 0", USAGE);
}

#[test]
fn info_of_many_files_is_a_row_a_file_and_a_sum() {
    let room = folders();
    let (stdout, stderr) = room.expect("info in --cloth-width 150", FAULTY);
    assert!(stderr.contains("in/b/bad.cut") && !stderr.contains("  file"), "{stderr}");
    let lines: Vec<&str> = stdout.lines().collect();
    assert!(lines[0].ends_with("pieces  cut m  time  notches  area m2   cloth mm  used %  worst finding"), "{stdout}");
    assert!(lines[3].starts_with("  in/parts.cut") && lines[3].contains("0.011  200 x 150    36.0"), "{stdout}");
    assert!(lines[4].contains("FAILED source/") && lines[5].starts_with("  all "), "{stdout}");
    assert_eq!(lines[6], "4 files, 3 done, 1 failed");
    assert_eq!(room.expect("info in -q --cloth-width 150", FAULTY).0, stdout, "quiet is about messages");
    let (_, stderr) = room.expect("info in --labels", USAGE);
    assert!(stderr.contains("one file") && stderr.contains("hint: "), "{stderr}");
}

#[test]
fn figures_of_many_files_come_as_json_with_their_sum() {
    let room = folders();
    let (stdout, _) = room.expect("info in --format json --rate 36/h --plies 10", FAULTY);
    let all = json(&stdout);
    let files = all["files"].as_array().expect("a list");
    let names: Vec<_> = files.iter().map(|file| file["file"].as_str().expect("a name")).collect();
    assert_eq!(names, ["in/a/circle.cut", "in/a/square.csv", "in/parts.cut", "in/b/bad.cut"]);
    assert!(files[3]["state"] == "failed" && files[3]["pieces"].is_null() && files[3]["cost"].is_null());
    for key in ["pieces", "cut_m", "time_s", "notches", "area_m2", "length_mm", "cost", "cost_per_ply"] {
        let sum: f64 = files.iter().filter_map(|file| file[key].as_f64()).sum();
        near(&all["sum"][key], sum);
    }
    let [sum, parts] = [&all["sum"], &files[2]];
    assert_eq!((&sum["files"], &sum["failed"], &sum["plies"]), (&4.into(), &1.into(), &10.into()));
    let time = parts["time_s"].as_f64().expect("planned");
    assert!(time > 1.0, "{time}");
    near(&parts["cost"], time * 0.01);
    near(&parts["cost_per_ply"], time * 0.001);
    near(&parts["cost_per_part"], time * 0.001 / 3.0);
    let (time, pieces) = (sum["time_s"].as_f64().expect("planned"), sum["pieces"].as_f64().expect("known"));
    near(&sum["cost_per_part"], time * 0.001 / pieces);
    let (compiled, _) = room.expect("compile in/parts.cut -o parts.csv --format json", DONE);
    near(&json(&compiled)["time_s"], parts["time_s"].as_f64().expect("planned"));
}

#[test]
fn figures_come_as_csv_with_a_row_a_file_and_nothing_else() {
    let room = folders();
    room.write("in/b/odd, \"name\".cut", PARTS.as_bytes());
    let (stdout, stderr) = room.expect("info in --format csv --rate 0.6/min", FAULTY);
    let lines: Vec<&str> = stdout.lines().collect();
    assert_eq!(
        lines[0],
        "file,state,pieces,cut_m,time_s,notches,area_m2,length_mm,width_mm,utilisation_percent,cost,cost_per_ply,\
         cost_per_part,worst"
    );
    assert!(lines[3].starts_with("\"in/b/odd, \"\"name\"\".cut\",done,3,"), "{stdout}");
    assert!(lines[5].starts_with("in/b/bad.cut,failed,,,,,,,,,,,,source/") && lines.len() == 6, "{stdout}");
    assert!(stderr.ends_with("5 files, 4 done, 1 failed\n"), "{stderr}");
    let (stdout, _) = room.expect("info in/parts.cut --format csv", DONE);
    let lines: Vec<&str> = stdout.lines().collect();
    assert!(lines.len() == 2 && lines[1].starts_with("in/parts.cut,done,3,0.981656854,"), "{stdout}");
    assert!(lines[1].contains(",1,0.010796,200,100,53.98,"), "{stdout}");
}

#[test]
fn one_file_tells_its_costs_in_a_line() {
    let room = folders();
    let (stdout, _) = room.expect("info in/parts.cut --rate 45/h --plies 40", DONE);
    let line = stdout.lines().find(|line| line.starts_with("  cost")).expect("a line");
    assert!(line.contains(" for 40 plies: ") && line.contains(" a ply, ") && line.ends_with(" a part"), "{line}");
    let axes = stdout.find("greatest value of limit").expect("planned");
    assert!(stdout.find(line).expect("there") < axes, "{stdout}");
    assert_eq!(room.expect("info in/parts.cut", DONE).0.matches("cost").count(), 0);
    for slip in ["--plies 3", "--rate 45", "--rate 45/h --plies 0"] {
        room.expect(&format!("info in/parts.cut {slip}"), USAGE);
    }
}

#[test]
fn programs_of_a_folder_are_judged_by_the_files_they_were_made_from() {
    let room = folders();
    room.expect("compile in/a in/parts.cut -o flat -t csv,svg", DONE);
    room.expect("compile in -o out -t gcode,csv,json", FAULTY);
    let (stdout, stderr) = room.expect("verify out/**/*.{csv,ngc} --source in -q", DONE);
    assert_eq!((stdout.as_str(), stderr.as_str()), ("6 files, 6 done\n", ""));
    // One file of the folder has no program, since it is faulty.
    let (stdout, stderr) = room.expect("verify out --source in", FAULTY);
    assert_eq!(stdout.matches("PASS").count(), 6, "{stdout}");
    assert!(stdout.ends_with("7 files, 6 done, 1 failed\n") && !stdout.contains(".json"), "{stdout}");
    assert!(stderr.contains("no program was made from `in/"), "{stderr}");

    let program = String::from_utf8(room.read("out/parts.csv")).expect("text");
    let lines: Vec<&str> = program.lines().collect();
    room.write("out/parts.csv", (lines[..lines.len() / 2].join("\n") + "\n").as_bytes());
    let (stdout, stderr) = room.expect("verify out/*.csv out/a --source in", FAULTY);
    assert!(stdout.contains("out/parts.csv") && stdout.contains("FAILED verify/"), "{stdout}");
    assert!(stderr.contains("out/parts.csv: breaks"), "{stderr}");
    // Named by itself, `a` is the folder: its files are looked for in `in`.
    assert!(stderr.contains("there is no `in/circle.cut`, which `out/a/circle.csv` was made from"), "{stderr}");
    let (stdout, _) = room.expect("verify out --source in --format json", FAULTY);
    let verdicts = json(&stdout);
    let of = |name: &str| verdicts.as_array().and_then(|all| all.iter().find(|one| one["program"] == name)).cloned();
    assert_eq!(of("out/parts.csv").expect("judged")["verdict"], "fail");
    assert_eq!(of("out/parts.ngc").expect("judged")["verdict"], "pass");
}

#[test]
fn a_folder_lacks_no_program_no_provenance_and_has_none_in_the_place_of_another() {
    let room = folders();
    room.expect("compile in/a -o out", DONE);
    room.expect("verify out --source in/a", DONE);
    let exchange = |a: &str, b: &str| {
        for end in ["csv", "csv.meta.json"] {
            let [a, b] = [a, b].map(|name| room.at(&format!("out/{name}.{end}")));
            let aside = room.at("aside");
            fs::rename(&a, &aside)
                .and_then(|()| fs::rename(&b, &a))
                .and_then(|()| fs::rename(&aside, &b))
                .expect("there");
        }
    };
    let names: Vec<String> = fs::read_dir(room.at("in/a"))
        .expect("readable")
        .map(|entry| entry.expect("readable").path().file_stem().expect("a name").to_string_lossy().into_owned())
        .collect();
    let [first, second, ..] = &names[..] else { panic!("{names:?}") };
    exchange(first, second);
    let (_, stderr) = room.expect("verify out --source in/a", FAULTY);
    assert_eq!(stderr.matches("and has the name of the program of").count(), 2, "{stderr}");
    exchange(first, second);
    fs::remove_file(room.at(&format!("out/{first}.csv.meta.json"))).expect("there");
    let (_, stderr) = room.expect("verify out --source in/a", FAULTY);
    assert!(stderr.contains("does not say what it was made from"), "{stderr}");
    fs::remove_file(room.at(&format!("out/{first}.csv"))).expect("there");
    let (_, stderr) = room.expect("verify out --source in/a", FAULTY);
    assert!(stderr.contains("no program was made from"), "{stderr}");
}

#[test]
fn several_programs_are_judged_by_one_file_or_refused_by_name() {
    let room = folders();
    room.expect("compile circle.cut -t csv,gcode", DONE);
    let (stdout, _) = room.expect("verify circle.csv circle.ngc --source circle.cut", DONE);
    assert!(stdout.ends_with("2 files, 2 done\n"), "{stdout}");
    let (stdout, _) = room.expect("verify circle.csv circle.ngc junk.cut --source circle.cut --format json", FAULTY);
    assert_eq!(json(&stdout)[2]["verdict"], "fail");
    // The source of one program is found in a folder, too.
    assert!(room.expect("verify circle.csv --source in/a", DONE).0.contains("PASS  `circle.csv` cuts what"));
    fs::remove_file(room.at("circle.csv.meta.json")).expect("there");
    for arguments in ["circle.csv", "circle.csv circle.ngc"] {
        let code = if arguments == "circle.csv" { USAGE } else { FAULTY };
        let (_, stderr) = room.expect(&format!("verify {arguments} --source in/a"), code);
        assert!(stderr.contains("no `circle.csv.meta.json`") && stderr.contains("hint: "), "{stderr}");
    }
    let (_, stderr) = room.expect("verify in --source in", FAULTY);
    assert!(stderr.contains("not a program: `in/a/square.csv`"), "{stderr}");
    assert!(stderr.contains("no program was made from `in/parts.cut`"), "{stderr}");
}
