//! The built program as a user meets it: exit codes, what is written and what is not, and what is said.

use std::fs;
use std::process::Stdio;

use cutc::back::TARGETS;
use cutc::machine::{MachineProfile, blake3_of, sha256_hex};
use cutc::pass::marker::MARKER_PASSES;
use cutc::pass::toolpath::TOOLPATH_PASSES;
use serde_json::Value;

use crate::support::room::{DONE, FAULTY, Room, USAGE};

fn keys(value: &Value) -> Vec<&str> {
    let mut keys: Vec<_> = value.as_object().expect("an object").keys().map(String::as_str).collect();
    keys.sort_unstable();
    keys
}

/// The keys of the figures as JSON, sorted.
#[rustfmt::skip] // a list of words
const FIGURES: [&str; 28] = [
    "axes", "closed_contours", "contours", "cut_m", "declared", "dialect", "drills", "errors", "extent_mm",
    "follow", "knife", "labels", "lifts", "notch_style", "notches", "pieces", "profile", "runs", "savings", "sides",
    "spent", "stabs", "tally", "tangent_runs", "time_s", "travel_m", "unit_mm", "warnings",
];

#[test]
fn a_compile_writes_the_program_with_its_provenance_and_a_summary() {
    let room = Room::new();
    let (stdout, stderr) = room.expect("compile circle.cut", DONE);
    assert_eq!(stdout, "");
    for label in ["dialect", "pieces", "contours", "cut ", "travel", "runs", "time", "warnings", "acceleration"] {
        assert!(stderr.contains(label), "{label}\n{stderr}");
    }
    assert!(stderr.lines().all(|line| line.chars().count() <= 80), "{stderr}");
    assert_eq!(room.names(), ["circle.csv", "circle.csv.meta.json", "circle.cut", "junk.cut"]);
    assert!(room.read("circle.csv").starts_with(b"t_s,x_mm,y_mm,c_deg,knife,drill,event,block\n"));

    let meta: Value = serde_json::from_slice(&room.read("circle.csv.meta.json")).expect("JSON");
    assert_eq!(meta["source"], "circle.cut");
    assert_eq!(meta["source_sha256"], sha256_hex(&room.read("circle.cut")));
    assert_eq!(meta["profile_sha256"], MachineProfile::default().digest());
    assert_eq!((&meta["target"], &meta["verified"]), (&Value::from("csv"), &Value::from("yes")));
    assert_eq!(meta["period_ms"], 1.0);
    assert_eq!(meta["program_blake3"], blake3_of(&room.read("circle.csv")[..]).expect("memory is read"));
    assert_eq!(meta["declared"][0]["kind"], "plunge", "the blade is straight and the circle is not: {meta}");
    assert_eq!(meta["source_path"], "circle.cut", "as seen from the program");
    let expected = "declared period_ms profile profile_sha256 program_blake3 source source_path source_sha256 target \
                    units verified version";
    assert_eq!(keys(&meta).join(" "), expected);
}

#[test]
fn a_program_goes_where_the_user_says_with_the_same_bytes() {
    let room = Room::new();
    fs::create_dir(room.at("out")).expect("writable");
    room.expect("compile circle.cut -o one.txt", DONE);
    room.expect("compile circle.cut -o out", DONE);
    room.expect("compile circle.cut -o out/", DONE);
    let (piped, _) = room.expect("compile circle.cut -o -", DONE);
    let program = room.read("one.txt");
    assert_eq!(room.read("out/circle.csv"), program);
    assert_eq!(piped.as_bytes(), program);
    assert!(room.has("one.txt.meta.json") && room.has("out/circle.csv.meta.json"));
    assert_eq!(room.names(), ["circle.cut", "junk.cut", "one.txt", "one.txt.meta.json", "out"]);
}

#[cfg(unix)]
#[test]
fn a_program_may_be_read_by_whom_any_new_file_may() {
    use std::os::unix::fs::PermissionsExt as _;
    let room = Room::new();
    room.expect("compile circle.cut", DONE);
    room.write("new", b"");
    let mode = |name: &str| fs::metadata(room.at(name)).expect("there").permissions().mode();
    assert_eq!(mode("circle.csv"), mode("new"));
    assert_eq!(mode("circle.csv.meta.json"), mode("new"));
}

#[test]
fn the_figures_come_as_json_with_every_key() {
    let room = Room::new();
    let (stdout, stderr) = room.expect("compile circle.cut --format json", DONE);
    let figures: Value = serde_json::from_str(&stdout).expect("JSON");
    assert_eq!(keys(&figures), FIGURES);
    assert!(!stderr.contains("acceleration"), "{stderr}");
    assert_eq!((&figures["contours"], &figures["closed_contours"]), (&1.into(), &1.into()));
    let kinds = ["castle", "castle-out", "slit", "t", "u", "u-out", "v", "v-out"];
    assert_eq!(keys(&figures["notches"]), kinds);
    assert_eq!(figures["errors"], Value::Array(Vec::new()));
    for axis in ["x", "y", "c"] {
        for limit in ["speed", "acceleration", "jerk"] {
            let peak = &figures["axes"][axis][limit];
            let (worst, limit) = (peak["worst"].as_f64().expect("a number"), peak["limit"].as_f64().expect("a number"));
            assert!(worst > 0.0 && worst <= limit, "{axis} {peak}");
        }
    }
    let rows = String::from_utf8(room.read("circle.csv")).expect("text").lines().count() - 1;
    let time = figures["time_s"].as_f64().expect("a number");
    assert!((time - rows as f64 * 0.001).abs() < 0.0015, "{rows} rows, {time} s");
}

#[test]
fn info_has_the_same_keys_and_more_and_null_for_what_only_planning_knows() {
    let room = Room::new();
    let (stdout, _) = room.expect("info circle.cut --format json", DONE);
    let figures: Value = serde_json::from_str(&stdout).expect("JSON");
    let cloth = ["area_m2", "cloth_length_mm", "cloth_width_mm", "utilisation_percent"];
    let mut expected = [&FIGURES[..], &["events", "notch_depths", "speeds"], &cloth].concat();
    expected.sort_unstable();
    assert_eq!(keys(&figures), expected);
    let (stdout, _) = room.expect("info junk.cut --format json", FAULTY);
    let unread: Value = serde_json::from_str(&stdout).expect("JSON");
    assert_eq!(keys(&unread), expected);
    assert!(unread["speeds"].is_null() && unread["pieces"].is_null());
    for key in ["travel_m", "runs", "stabs", "lifts", "time_s", "axes"] {
        assert!(figures[key].is_null(), "{key}");
    }
    assert!(figures["cut_m"].as_f64().expect("a number") > 0.0);
    let (stdout, _) = room.expect("info circle.cut", DONE);
    assert!(stdout.contains("contours") && !stdout.contains("travel"), "{stdout}");
    assert_eq!(room.names(), ["circle.cut", "junk.cut"]);
}

#[test]
fn check_reads_every_file_and_writes_none() {
    let room = Room::new();
    room.write("empty.cut", b"");
    room.expect("check circle.cut", DONE);
    for (file, why) in [("empty.cut", "source/empty"), ("nowhere.cut", "there is no such file")] {
        let (_, stderr) = room.expect(&format!("check {file} junk.cut circle.cut"), FAULTY);
        assert!(stderr.contains(why) && stderr.contains("3 files, 1 done, 2 failed"), "{stderr}");
    }
    let (stdout, _) = room.expect("check circle.cut junk.cut --format json", FAULTY);
    let verdicts: Value = serde_json::from_str(&stdout).expect("JSON");
    assert_eq!(keys(&verdicts[0]), ["dialect", "errors", "file", "tally", "warnings"]);
    assert_eq!(verdicts[1]["errors"].as_array().map(Vec::is_empty), Some(false));
    assert_eq!(room.names(), ["circle.cut", "empty.cut", "junk.cut"]);
}

#[test]
fn a_program_with_errors_is_never_written() {
    let room = Room::new();
    for arguments in ["compile junk.cut", "compile junk.cut -o x.csv", "compile junk.cut --from iso -o x.csv"] {
        let (stdout, stderr) = room.expect(arguments, FAULTY);
        assert!(stdout.is_empty() && stderr.contains("no program was written"), "{stderr}");
    }
    let (stdout, _) = room.expect("compile junk.cut -o -", FAULTY);
    assert_eq!(stdout, "");
    let (stdout, _) = room.expect("compile junk.cut --format json", FAULTY);
    let figures: Value = serde_json::from_str(&stdout).expect("JSON");
    assert_eq!(keys(&figures), FIGURES);
    assert!(figures["time_s"].is_null() && figures["errors"][0]["code"].is_string());
    assert_eq!(room.names(), ["circle.cut", "junk.cut"]);
}

#[test]
fn an_older_program_is_moved_aside_when_a_compile_fails() {
    let room = Room::new();
    room.expect("compile circle.cut -o x.csv", DONE);
    let (older, good) = (room.read("x.csv"), room.read("circle.cut"));
    room.write("circle.cut", &room.read("junk.cut"));
    let (_, stderr) = room.expect("compile circle.cut -o x.csv", FAULTY);
    assert!(stderr.contains("x.csv.stale"), "{stderr}");
    assert_eq!(room.read("x.csv.stale"), older);
    assert_eq!(room.names(), ["circle.cut", "junk.cut", "x.csv.meta.json.stale", "x.csv.stale"]);
    room.write("circle.cut", &good);
    room.expect("compile circle.cut -o x.csv", DONE);
    room.write("bad.toml", b"[time]\nperiod_ms = 0\n");
    room.expect("compile circle.cut -p bad.toml -o x.csv", FAULTY);
    assert!(!room.has("x.csv") && room.has("x.csv.stale"));
}

#[test]
fn a_slip_in_the_arguments_touches_no_program() {
    let room = Room::new();
    room.expect("compile circle.cut", DONE);
    let older = room.read("circle.csv");
    for slip in ["-t cvs", "--set time.period=2", "--set knife.width_mm=-1", "--from dfx", "-p none.toml", "--fromat"] {
        room.expect(&format!("compile circle.cut {slip}"), USAGE);
        assert_eq!(room.read("circle.csv"), older, "{slip}");
    }
    room.expect("compile nowhere.cut -o circle.csv", USAGE);
    assert_eq!(room.read("circle.csv"), older);
}

#[test]
fn an_input_is_never_overwritten() {
    let room = Room::new();
    let text = b"x_mm,y_mm\n0,0\n100,0\n100,100\n";
    room.write("line.csv", text);
    for arguments in ["compile line.csv", "compile line.csv -o .", "compile line.csv -o ./line.csv"] {
        let (_, stderr) = room.expect(arguments, USAGE);
        assert!(stderr.contains("input") && stderr.contains("-o"), "{stderr}");
    }
    assert_eq!(room.read("line.csv"), text);
    room.write("machine.toml", b"");
    room.expect("compile circle.cut -p machine.toml -o machine.toml", USAGE);
    assert_eq!(room.read("machine.toml"), b"");
    fs::remove_file(room.at("machine.toml")).expect("removable");
    assert_eq!(room.names(), ["circle.cut", "junk.cut", "line.csv"]);
}

#[test]
fn a_program_and_figures_do_not_share_standard_output() {
    let (_, stderr) = Room::new().expect("compile circle.cut -o - --format json", USAGE);
    assert!(stderr.contains("-o -") && stderr.contains("hint"), "{stderr}");
}

#[test]
fn a_closed_pipe_is_no_error() {
    let room = Room::new();
    // A slow axis makes a program that no pipe holds.
    let mut child = room
        .command("compile circle.cut -o - --set axes.x.speed_mm_s=10")
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    drop(child.stdout.take());
    assert_eq!(child.wait().expect("it ends").code(), Some(DONE));
}

#[test]
fn files_that_cannot_be_used_are_named_with_what_to_do() {
    let room = Room::new();
    fs::create_dir(room.at("folder")).expect("writable");
    let check = |arguments: &str, expected: &str| {
        let (_, stderr) = room.expect(arguments, USAGE);
        assert!(stderr.contains(expected) && stderr.contains("hint: "), "cutc {arguments}\n{stderr}");
        assert!(stderr.lines().count() <= 3, "{stderr}");
    };
    check("compile nowhere.cut", "cannot read `nowhere.cut`: there is no such file");
    check("compile folder", "`folder` holds no files to work on");
    check("info folder", "`folder` holds no files to work on");
    check("compile circle.cut -o nowhere/x.csv", "there is no directory `nowhere`");
    check("compile circle.cut -o nowhere/folder/", "there is no directory `nowhere/folder`");
    check("compile circle.cut -o junk.cut/x.csv", "there is no directory `junk.cut`");
    check("compile circle.cut -p nowhere.toml", "there is no profile `nowhere.toml`");
    check("profile check nowhere.toml", "there is no profile `nowhere.toml`");
    assert_eq!(room.names(), ["circle.cut", "folder", "junk.cut"]);
}

#[cfg(unix)]
#[test]
fn a_place_without_permission_is_refused() {
    use std::os::unix::fs::PermissionsExt as _;
    let room = Room::new();
    fs::create_dir(room.at("locked")).expect("writable");
    fs::set_permissions(room.at("locked"), fs::Permissions::from_mode(0o555)).expect("its owner may");
    fs::set_permissions(room.at("junk.cut"), fs::Permissions::from_mode(0o000)).expect("its owner may");
    // The superuser may write and read everywhere.
    if fs::write(room.at("locked/probe"), b"").is_err() {
        let (_, stderr) = room.expect("compile circle.cut -o locked", USAGE);
        assert!(stderr.contains("permission denied") && stderr.contains("hint: "), "{stderr}");
    }
    if fs::read(room.at("junk.cut")).is_err() {
        let (_, stderr) = room.expect("check junk.cut", USAGE);
        assert!(stderr.contains("permission denied") && stderr.contains("hint: "), "{stderr}");
    }
    fs::set_permissions(room.at("locked"), fs::Permissions::from_mode(0o755)).expect("its owner may");
}

#[cfg(unix)]
#[test]
fn a_device_is_not_replaced_by_a_program() {
    let (_, stderr) = Room::new().expect("compile circle.cut -o /dev/null", USAGE);
    assert!(stderr.contains("not a regular file"), "{stderr}");
}

#[test]
fn a_profile_begins_with_every_key_and_loads_back() {
    let room = Room::new();
    let (text, _) = room.expect("profile init", DONE);
    room.expect("profile init -o machine.toml", DONE);
    assert_eq!(room.read("machine.toml"), text.as_bytes());
    room.expect("profile check machine.toml", DONE);
    let (shown, _) = room.expect("profile show -p machine.toml", DONE);
    assert_eq!(shown, room.expect("profile show", DONE).0);
    assert!(shown.contains("back_mm = 6.35"), "{shown}");

    room.write("machine.toml", b"# mine\n");
    let (_, stderr) = room.expect("profile init -o machine.toml", USAGE);
    assert!(stderr.contains("not overwritten"), "{stderr}");
    assert_eq!(room.read("machine.toml"), b"# mine\n");
}

#[test]
fn what_is_shown_is_what_holds() {
    let room = Room::new();
    room.write("machine.toml", b"[knife]\nwidth_mm = 8.89\nradius_mm = 2.54\n");
    let (shown, _) = room.expect("profile show -p machine.toml --set units=in/100", DONE);
    assert!(shown.contains("back_mm = 6.35") && shown.contains("units = \"in/100\""), "{shown}");
    let (shown, _) = room.expect("profile show --set knife.width_mm=0", DONE);
    assert!(shown.contains("back_mm = 0.0"), "{shown}");
}

#[test]
fn faults_of_a_profile_end_a_command_with_the_exit_code_of_their_place() {
    let room = Room::new();
    room.write("bad.toml", b"[knife]\nwidht_mm = 6.6\nback_mm = 9\n");
    for arguments in ["profile check bad.toml", "profile show -p bad.toml", "compile circle.cut -p bad.toml"] {
        let (_, stderr) = room.expect(arguments, FAULTY);
        assert!(stderr.contains("knife.width_mm") && stderr.contains("profile/range"), "{stderr}");
    }
    let (_, stderr) = room.expect("compile circle.cut --set knife.widht_mm=6", USAGE);
    assert!(stderr.contains("--set knife.widht_mm=6") && stderr.contains("knife.width_mm"), "{stderr}");
    assert_eq!(room.names(), ["bad.toml", "circle.cut", "junk.cut"]);
}

#[test]
fn a_pass_can_be_looked_into() {
    let room = Room::new();
    let passes = MARKER_PASSES.iter().map(|pass| pass.name).chain(TOOLPATH_PASSES.iter().map(|pass| pass.name));
    for pass in passes {
        let (stdout, _) = room.expect(&format!("compile circle.cut --dump-after {pass}"), DONE);
        assert!(!stdout.is_empty(), "{pass}");
    }
    room.expect("compile circle.cut --dump-after wedl", USAGE);
    assert_eq!(room.names(), ["circle.cut", "junk.cut"]);
}

#[test]
fn every_target_gives_a_file_with_its_provenance() {
    let room = Room::new();
    for target in TARGETS {
        let (_, stderr) = room.expect(&format!("compile circle.cut -t {}", target.name), DONE);
        assert!(stderr.contains("verified ") && stderr.contains("rules hold"), "{stderr}");
        let name = format!("circle.{}", target.extension);
        assert!(!room.read(&name).is_empty());
        let meta: Value = serde_json::from_slice(&room.read(&format!("{name}.meta.json"))).expect("JSON");
        assert_eq!((&meta["target"], &meta["verified"]), (&Value::from(target.name), &Value::from("yes")));
    }
    assert!(room.read("circle.svg").starts_with(b"<"));
}

#[test]
fn a_program_that_nobody_verified_says_so() {
    let room = Room::new();
    let (_, stderr) = room.expect("compile circle.cut", DONE);
    assert!(stderr.contains("rules hold; tip at most 0.0"), "{stderr}");
    let verified = room.read("circle.csv");
    let (_, stderr) = room.expect("compile circle.cut --no-verify", DONE);
    assert!(stderr.contains("--no-verify") && !stderr.contains("rules hold"), "{stderr}");
    let meta: Value = serde_json::from_slice(&room.read("circle.csv.meta.json")).expect("JSON");
    assert_eq!(meta["verified"], "no");
    assert_eq!(room.read("circle.csv"), verified);
    room.expect("compile circle.cut --no-verify -t svg", DONE);
    assert!(room.has("circle.svg"));
}

/// A limit that no program of the circle keeps: a straight blade leaves every curve.
const TOO_STRICT: &str = "--set verify.max_body_mm=0.001";

#[test]
fn a_program_that_fails_its_verification_is_never_written() {
    let room = Room::new();
    let (_, stderr) = room.expect(&format!("compile circle.cut {TOO_STRICT}"), FAULTY);
    for words in ["verify/body: ", "(0.001 allowed)", "`verify.max_body_mm`", "no program was written"] {
        assert!(stderr.contains(words), "{words}\n{stderr}");
    }
    assert!(stderr.contains("the program breaks 1 rule of its verification"), "{stderr}");
    assert!(stderr.contains("no program was written to `circle.csv`"), "{stderr}");
    let (stdout, _) = room.expect(&format!("compile circle.cut -o - {TOO_STRICT}"), FAULTY);
    assert_eq!(stdout, "");
    let (stdout, _) = room.expect(&format!("compile circle.cut --format json {TOO_STRICT}"), FAULTY);
    let figures: Value = serde_json::from_str(&stdout).expect("JSON");
    assert_eq!(keys(&figures), FIGURES);
    assert_eq!(figures["errors"][0]["code"], "verify/broken");
    assert_eq!(room.names(), ["circle.cut", "junk.cut"]);

    room.expect("compile circle.cut", DONE);
    let older = room.read("circle.csv");
    let (_, stderr) = room.expect(&format!("compile circle.cut {TOO_STRICT}"), FAULTY);
    assert!(stderr.contains("circle.csv.stale"), "{stderr}");
    assert_eq!(room.read("circle.csv.stale"), older);
    assert_eq!(room.names(), ["circle.csv.meta.json.stale", "circle.csv.stale", "circle.cut", "junk.cut"]);
    room.expect(&format!("compile circle.cut --no-verify {TOO_STRICT}"), DONE);
    assert_eq!(room.read("circle.csv"), older);
}

impl Room {
    /// Compiles the circle and moves one row, in the middle of the cut, by 1 mm in X and in Y, as a slip of the hand would. Gives
    /// the time of that row.
    fn edited(&self) -> f64 {
        self.expect("compile circle.cut", DONE);
        let text = String::from_utf8(self.read("circle.csv")).expect("text");
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let down: Vec<usize> =
            (1..lines.len()).filter(|&i| lines[i].split(',').nth(4).expect("a knife") == "1").collect();
        let at = down[down.len() / 2];
        let mut fields: Vec<String> = lines[at].split(',').map(str::to_owned).collect();
        for place in &mut fields[1..3] {
            *place = format!("{:.6}", place.parse::<f64>().expect("a number") + 1.0);
        }
        lines[at] = fields.join(",");
        self.write("edited.csv", (lines.join("\n") + "\n").as_bytes());
        fields[0].parse().expect("a number")
    }
}

#[test]
fn what_is_no_program_is_called_so() {
    let room = Room::new();
    room.write("empty.csv", b"");
    room.write("one-line.csv", &vec![b'7'; 5_000_000]);
    for file in ["circle.cut", "empty.csv", "one-line.csv"] {
        let (stdout, stderr) = room.expect(&format!("verify {file} --source circle.cut"), FAULTY);
        assert!(stdout.is_empty() && stderr.contains("not a program") && stderr.contains("hint"), "{stdout}{stderr}");
    }
}

#[test]
fn a_program_is_verified_alone() {
    let room = Room::new();
    room.expect("compile circle.cut", DONE);
    let (stdout, stderr) = room.expect("verify circle.csv --source circle.cut", DONE);
    assert!(!stderr.contains("made"), "{stderr}");
    assert!(stdout.lines().all(|line| line.chars().count() <= 100), "{stdout}");
    assert!(stdout.ends_with("rules hold\n") && stdout.contains("\nPASS  `circle.csv`"), "{stdout}");
    assert!(stdout.contains("verify/on-path") && stdout.contains("source/length"), "{stdout}");

    let (stdout, _) = room.expect("verify circle.csv --source circle.cut --format json", DONE);
    let judged: Value = serde_json::from_str(&stdout).expect("JSON");
    assert_eq!((keys(&judged), &judged["verdict"]), (vec!["rules", "verdict"], &Value::from("pass")));
    let rules = judged["rules"].as_array().expect("a list");
    assert!(rules.len() > 25);
    for rule in rules {
        assert_eq!(keys(rule), ["code", "holds", "limit", "unit", "where", "worst"]);
        assert!(rule["code"].is_string() && rule["unit"].is_string() && rule["holds"] == true, "{rule}");
        assert!(rule["worst"].is_number() && (rule["limit"].is_number() || rule["limit"].is_null()), "{rule}");
        if !rule["where"].is_null() {
            assert_eq!(keys(&rule["where"]), ["block", "line", "time_s", "x_mm", "y_mm"]);
        }
    }
    assert!(rules.iter().any(|rule| !rule["where"].is_null()));
}

#[test]
fn a_slip_of_the_hand_in_a_program_is_found_with_its_place() {
    let room = Room::new();
    let time = room.edited();
    let (stdout, stderr) = room.expect("verify edited.csv --source circle.cut", FAULTY);
    assert!(stderr.contains("iso/no-end"), "{stderr}");
    let last = stdout.lines().last().expect("a verdict");
    assert!(last.starts_with("FAIL  `edited.csv` must not run: it breaks "), "{stdout}");
    let on_path = stdout.lines().find(|line| line.contains("verify/on-path")).expect("a row");
    assert!(on_path.starts_with("FAIL"), "{stdout}");

    let (stdout, _) = room.expect("verify edited.csv --source circle.cut --format json", FAULTY);
    let judged: Value = serde_json::from_str(&stdout).expect("JSON");
    assert_eq!(judged["verdict"], "fail");
    let rules = judged["rules"].as_array().expect("a list");
    let on_path = rules.iter().find(|rule| rule["code"] == "verify/on-path").expect("a rule");
    assert_eq!(on_path["holds"], false);
    let found = on_path["where"]["time_s"].as_f64().expect("a time");
    assert!((found - time).abs() < 0.002, "at {found} s, not {time} s");
}

#[test]
fn a_program_is_judged_by_the_source_and_profile_it_was_made_from() {
    let room = Room::new();
    room.expect("compile circle.cut", DONE);
    let text = String::from_utf8(room.read("circle.cut")).expect("text");
    // The same cut with other bytes: a warning, no more.
    room.write("again.cut", format!("{text}\n").as_bytes());
    let (_, stderr) = room.expect("verify circle.csv --source again.cut", DONE);
    assert!(stderr.contains("was not made from this `again.cut`") && stderr.contains("`circle.cut`"), "{stderr}");
    // Another cut altogether.
    room.write("other.csv", b"x_mm,y_mm\n100,100\n200,100\n200,200\n");
    let (stdout, stderr) = room.expect("verify circle.csv --source other.csv", FAULTY);
    assert!(stdout.contains("FAIL  verify/complete") && stderr.contains("was not made from"), "{stdout}{stderr}");
    // A slower machine: the program is too fast for it.
    let slower = "verify circle.csv --source circle.cut --set axes.x.speed_mm_s=10";
    let (stdout, stderr) = room.expect(slower, FAULTY);
    assert!(stdout.contains("FAIL  verify/speed-x") && stderr.contains("another machine profile"), "{stdout}{stderr}");
    let told = String::from_utf8(room.read("circle.csv.meta.json")).expect("text");
    let entry = |magnitude: &str| {
        format!(r#"{{"kind": "lift", "cut": 0, "from_mm": 1, "to_mm": 1, "magnitude_mm": {magnitude}}}"#)
    };
    for (declared, said) in [
        ("[1]".to_owned(), "cannot be read"),
        (format!("[{}]", entry("\"much\"")), "cannot be read"),
        (format!("[{}]", entry("-1")), "declares a magnitude of -1 mm"),
    ] {
        let mut meta: serde_json::Value = serde_json::from_str(&told).expect("JSON");
        meta["declared"] = serde_json::from_str(&declared).expect("JSON");
        room.write("circle.csv.meta.json", meta.to_string().as_bytes());
        let (_, stderr) = room.expect("verify circle.csv --source circle.cut", FAULTY);
        assert!(stderr.contains(said), "{declared}: {stderr}");
    }
    room.write("circle.csv.meta.json", b"{");
    let (_, stderr) = room.expect("verify circle.csv --source circle.cut", FAULTY);
    assert!(stderr.contains("is no JSON"), "{stderr}");
}

#[test]
fn what_cannot_be_verified_is_said() {
    let room = Room::new();
    room.expect("compile circle.cut", DONE);
    fs::create_dir(room.at("folder")).expect("writable");
    room.write("bad.toml", b"[time]\nperiod_ms = 0\n");
    let check = |arguments: &str, code, expected: &str| {
        let (_, stderr) = room.expect(&format!("verify {arguments}"), code);
        assert!(stderr.contains(expected), "cutc verify {arguments}\n{stderr}");
    };
    check("circle.csv", USAGE, "--source");
    check("nowhere.csv --source circle.cut", USAGE, "cannot read `nowhere.csv`: there is no such file");
    check("circle.csv --source nowhere.cut", USAGE, "cannot read `nowhere.cut`: there is no such file");
    check("folder --source circle.cut", USAGE, "`folder` holds no files to work on");
    check("circle.csv --source circle.cut -p nowhere.toml", USAGE, "there is no profile");
    check("circle.csv --source circle.cut --set time.period=1", USAGE, "time.period_ms");
    check("circle.csv --source circle.cut -p bad.toml", FAULTY, "profile/range");
    check("circle.csv --source junk.cut", FAULTY, "`circle.csv` was not judged");
    let (stdout, _) = room.expect("verify circle.csv --source junk.cut --format json", FAULTY);
    let judged: Value = serde_json::from_str(&stdout).expect("JSON");
    assert_eq!(judged.to_string(), r#"{"rules":[],"verdict":"fail"}"#);
    let (stdout, _) = room.expect("verify junk.cut --source circle.cut --format json", FAULTY);
    assert_eq!(stdout.trim(), room.expect("verify circle.csv --source junk.cut --format json", FAULTY).0.trim());
}

#[test]
fn the_help_is_enough_to_begin() {
    let room = Room::new();
    let (help, _) = room.expect("--help", DONE);
    for word in ["Examples", "cutc compile", "cutc profile init", "Exit codes"] {
        assert!(help.contains(word), "{word}\n{help}");
    }
    assert!(TARGETS.iter().all(|target| help.contains(target.about)), "{help}");
    let (help, _) = room.expect("compile --help", DONE);
    assert!(TARGETS.iter().all(|target| help.contains(target.about)), "{help}");
    room.expect("", USAGE);
    room.expect("complie circle.cut", USAGE);
    assert!(room.expect("--version", DONE).0.starts_with("cutc "));
}

#[test]
fn a_picture_of_what_was_refused_is_written_and_the_program_is_not() {
    let room = Room::new();
    room.expect("compile circle.cut -t csv,svg", DONE);
    let (_, stderr) = room.expect(&format!("compile circle.cut -t csv,svg {TOO_STRICT}"), FAULTY);
    for words in [
        "no program was written to `circle.csv`",
        "moved to `circle.csv.stale`",
        "wrote `circle.svg`, a picture of what was refused",
    ] {
        assert!(stderr.contains(words), "{words}\n{stderr}");
    }
    assert!(!room.has("circle.csv") && !room.has("circle.csv.meta.json"));
    let picture = room.text("circle.svg");
    for words in [">refused</text>", "class=\"fails\"", "REFUSED, no program was written", "verify/body"] {
        assert!(picture.contains(words), "{words}");
    }
    let meta: Value = serde_json::from_slice(&room.read("circle.svg.meta.json")).expect("JSON");
    assert_eq!(meta["verified"], "refused");
    let (piped, _) = room.expect(&format!("compile circle.cut -t svg -o - {TOO_STRICT}"), FAULTY);
    assert_eq!(piped, picture);
    // What is never read has no picture.
    room.expect("compile junk.cut -t svg", FAULTY);
    assert!(!room.has("junk.svg"));
}

#[test]
fn what_is_refused_before_it_is_planned_is_marked_in_the_picture() {
    let room = Room::new();
    let strict = "--set table.x_mm=[0,100] --set table.y_mm=[0,1000]";
    let (_, stderr) = room.expect(&format!("compile circle.cut -t gcode,svg {strict}"), FAULTY);
    assert!(
        stderr.contains("no program was written to `circle.ngc`") && stderr.contains("wrote `circle.svg`"),
        "{stderr}"
    );
    let picture = room.text("circle.svg");
    for words in [">refused</text>", "class=\"fails\"", "marker/off-table  FAILS, at X "] {
        assert!(picture.contains(words), "{words}");
    }
    assert!(!room.has("circle.ngc"));
}

#[test]
fn programs_and_figures_name_machine_and_knife() {
    let room = Room::new();
    room.write("left (2).toml", b"knife.width_mm = \"0.28 in\"\n");
    room.write("left.toml", &room.read("left (2).toml"));
    let (_, stderr) = room.expect("compile circle.cut", DONE);
    assert!(stderr.contains("machine    default machine; no -p was given\n  knife      6.6 mm wide"), "{stderr}");
    let (stdout, _) = room.expect("compile circle.cut -p left.toml --format json", DONE);
    let figures: Value = serde_json::from_str(&stdout).expect("JSON");
    assert_eq!((&figures["profile"]["file"], &figures["knife"]["axis"]), (&"left.toml".into(), &"assumed".into()));
    let gcode = ["compile", "circle.cut", "-t", "gcode", "-p", "left (2).toml"];
    let ran = room.command("").args(gcode).output().expect("it runs");
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    let program = room.text("circle.ngc");
    assert!(program.contains("(machine: left _2_.toml)\n(knife: 7.112 mm wide, axis 0.762 mm behind the tip)\n"));
}
