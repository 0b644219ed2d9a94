//! The manual is true: its commands and scripts run as they stand there.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use cutc::back::TARGETS;
use cutc::diagnostic::code;
use cutc::front::DIALECTS;
use cutc::ir::verdict::Rule;
use cutc::machine::SHIPPED;
use cutc::machine::keys::{self, KEYS};
use cutc::machines::{Listed, MACHINES, Machine};
use cutc::manual::{PAGES, Page, glossary};
use cutc::sew;
use cutc::verify::RULES;
use yaml_rust2::{Yaml, YamlLoader};

use crate::support;
use crate::support::page::{blocks, commands, expect_same, page, search_path, section};
use crate::support::room::{DONE, FAULTY, Room, USAGE};

/// Exit code of a watch that was asked to end.
const TERMINATED: i32 = 143;

/// The longest line of a page, in columns: read on a terminal as it stands.
const COLUMNS: usize = 125;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A room with the folder `in`: cutter files in folders, and with `junk` one that is refused.
fn room_of_many(junk: bool) -> Room {
    let room = Room::new();
    let copies = [("fixtures/iso", "in/iso"), ("fixtures/markers", "in/markers")];
    for (from, to) in copies {
        fs::create_dir_all(room.at(to)).expect("writable");
        for file in fs::read_dir(root().join(from)).expect("a folder") {
            let file = file.expect("readable");
            fs::copy(file.path(), room.at(to).join(file.file_name())).expect("writable");
        }
    }
    if junk {
        fs::rename(room.at("junk.cut"), room.at("in/junk.cut")).expect("writable");
    }
    room
}

/// Runs a line under a shell in a room, with `cutc` and the room's own scripts on the path.
fn shell(line: &str, room: &Room, environment: &[(&str, &str)]) -> Output {
    let path = search_path(&room.at(""));
    let mut shell = Command::new("bash");
    shell.args(["-c", line]).current_dir(room.at("")).env("PATH", path).envs(environment.iter().copied());
    shell.output().expect("bash runs")
}

fn said(output: &Output) -> String {
    format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr))
}

/// Expects that the room's `out` is what a single run makes of its `in`, and that the joining run found all of it done.
fn expect_joined(room: &Room, joining: &Output) {
    let said = said(joining);
    assert_eq!(joining.status.code(), Some(FAULTY), "{said}");
    let sum = said.lines().rfind(|line| line.contains(" files, ")).unwrap_or_default();
    assert!(sum.ends_with(" unchanged, 1 failed") && !sum.contains(" done"), "{said}");
    room.expect("compile in -o single/ -q", FAULTY);
    expect_same(&room.at("out"), &room.at("single"));
}

#[test]
fn every_page_is_in_the_table_and_fits_a_terminal() {
    let files = fs::read_dir(root().join("src/manual")).expect("a folder");
    let names = files.map(|file| file.expect("readable").file_name().to_string_lossy().into_owned());
    let files: BTreeSet<String> = names.filter_map(|name| name.strip_suffix(".md").map(str::to_owned)).collect();
    assert_eq!(files, PAGES.iter().map(|page| page.name.to_owned()).collect());
    for Page { name, text, .. } in PAGES {
        assert!(text.starts_with("# ") && text.ends_with('\n'), "{name} begins with its title and ends a line");
        // A table is as wide as it is.
        let is_long = |line: &&str| line.chars().count() > COLUMNS && !line.starts_with('|');
        let long: Vec<&str> = text.lines().filter(is_long).collect();
        assert!(long.is_empty(), "{name}: {long:?}");
    }
}

#[test]
fn pages_are_listed_and_printed_and_the_nearest_is_named() {
    let room = Room::new();
    let (list, _) = room.expect("manual", DONE);
    for Page { name, about, text } in PAGES {
        assert!(list.lines().any(|line| line.starts_with(name) && line.ends_with(about)), "{list}");
        assert_eq!(room.expect(&format!("manual {name}"), DONE).0, *text);
    }
    let (_, stderr) = room.expect("manual many-flies", USAGE);
    assert!(stderr.contains("many-files"), "{stderr}");
}

#[test]
fn every_command_of_the_manual_runs() {
    let room = room_of_many(false);
    fs::copy(root().join("fixtures/pictures/marker.cut"), room.at("marker.cut")).expect("a copy");
    fs::copy(root().join("fixtures/pictures/pattern.dxf"), room.at("pattern.dxf")).expect("a copy");
    let drawing = root().join("fixtures/dxf/layers-that-say-what-they-are.dxf");
    fs::copy(drawing, room.at("drawing.dxf")).expect("a copy");
    fs::copy(root().join("fixtures/svg/inkscape-layers-in-mm.svg"), room.at("pattern.svg")).expect("a copy");
    room.write("machine.toml", b"knife.width_mm = 7.2\n");
    room.write("marks.csv", support::MARKS);
    // As shipped, every one.
    room.write("answers.txt", "\n".repeat(12).as_bytes());
    for name in ["pocket.csv", "seat.dst"] {
        fs::copy(root().join("fixtures/sew").join(name), room.at(name)).expect("a copy");
    }
    fs::create_dir(room.at("designs")).expect("a folder");
    fs::copy(root().join("fixtures/sew/seat.dst"), room.at("designs/seat.dst")).expect("a copy");
    for name in ["step.toml", "wander.toml"] {
        fs::copy(root().join("fixtures/track").join(name), room.at(name)).expect("a copy");
    }
    for name in ["spray/panel.csv", "machines/spray.toml", "machines/spray-plain.toml"] {
        let (_, to) = name.split_once('/').expect("a folder");
        fs::copy(root().join("fixtures").join(name), room.at(to)).expect("a copy");
    }
    room.expect("compile marker.cut", DONE);
    for Page { name, text, .. } in PAGES {
        let commands = commands(text);
        assert!(!commands.is_empty(), "{name}");
        for command in commands {
            // A watch ends when it is asked to.
            let (command, code) = if command.starts_with("cutc watch ") {
                (format!("timeout --preserve-status -s TERM 3 {command}"), TERMINATED)
            } else {
                (command, DONE)
            };
            let ran = shell(&command, &room, &[]);
            assert_eq!(ran.status.code(), Some(code), "{name}: `{command}`: {}", said(&ran));
        }
    }
}

/// A row of a list in lines of the manual's width.
fn item(text: &str) -> String {
    let mut lines = vec!["-".to_owned()];
    for word in text.split_whitespace() {
        let last = lines.last_mut().expect("a line");
        if last.chars().count() + 1 + word.chars().count() > COLUMNS {
            lines.push(format!("  {word}"));
        } else {
            last.push(' ');
            last.push_str(word);
        }
    }
    lines.join("\n")
}

/// The machine of a list, with its word: "targets" or "rules".
fn machine(list: &str) -> Option<(&'static Machine, &str)> {
    let (name, what) = list.split_once(' ').filter(|(_, what)| ["targets", "rules"].contains(what))?;
    Some((MACHINES.iter().find(|machine| machine.name == name)?, what))
}

fn rules(rules: &[&Rule]) -> Vec<String> {
    rules.iter().map(|rule| format!("`{}`: {}.", rule.name, rule.about)).collect()
}

/// A list that the program's own tables give, by its name in the pages.
fn list(name: &str) -> String {
    let rows: Vec<String> = match name {
        "dialects" => DIALECTS.iter().map(|dialect| format!("`{}`: {}.", dialect.name, dialect.about)).collect(),
        "targets" => TARGETS.iter().map(|target| format!("`{}`: {}.", target.name, target.about)).collect(),
        "sewing formats" => sew::FORMATS.iter().map(|format| format!("`{}`: {}.", format.name, format.about)).collect(),
        "rules" => rules(RULES),
        "profiles" => SHIPPED.iter().map(|shipped| format!("`{}`: {}.", shipped.name, shipped.about)).collect(),
        "codes" => {
            let severity = |code: &code::Code| format!("{:?}", code.severity).to_lowercase();
            code::all().map(|code| format!("`{}` ({}): {}", code.name, severity(code), code.about)).collect()
        }
        "keys" => {
            let shown = |value: toml::Value| format!(" = `{}`", keys::shown_value(&value));
            let default = |key| keys::default_of(key).map_or_else(String::new, shown);
            KEYS.iter().map(|key| format!("`{}`{}: {}. {}", key.name, default(key), key.expects(), key.about)).collect()
        }
        words => match machine(words) {
            Some((machine, "targets")) => {
                let row = |row: Listed| format!("`{}` (`.{}`): {}.", row.name, row.extension, row.about);
                (machine.targets)().into_iter().map(row).collect()
            }
            Some((machine, _)) => rules(machine.rules),
            None => {
                let dialect =
                    words.strip_prefix("words ").and_then(|name| DIALECTS.iter().find(|row| row.name == name));
                let words = dialect.unwrap_or_else(|| panic!("there is no list `{name}`")).words;
                words.iter().map(|row| format!("{}: {}.", row.words, row.about)).collect()
            }
        },
    };
    rows.iter().map(|row| item(row) + "\n").collect()
}

/// A page with the lists of the program's tables between their marks.
fn with_lists(text: &str) -> String {
    let mut parts = text.split("<!-- table: ");
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (name, rest) = part.split_once(" -->\n").expect("the mark of a list ends its line");
        let rest = rest.split_once("<!-- end -->").expect("a list has an end").1;
        out.extend(["<!-- table: ", name, " -->\n", &list(name), "<!-- end -->", rest]);
    }
    out
}

#[test]
fn the_lists_of_the_manual_are_those_of_the_program() {
    for Page { name, .. } in PAGES {
        let path = root().join(format!("src/manual/{name}.md"));
        let text = fs::read_to_string(&path).expect("a page");
        let right = with_lists(&text);
        if std::env::var_os("CUTC_RENEW_MANUAL").is_some() && right != text {
            fs::write(&path, &right).expect("writable");
        } else {
            assert!(right == text, "{name} is stale: CUTC_RENEW_MANUAL=1 cargo test manual writes its lists anew");
        }
    }
}

#[test]
fn every_word_of_the_glossary_is_in_order_and_explained() {
    let terms: Vec<&str> = glossary().map(|entry| entry.term).collect();
    assert!(terms.len() > 30 && terms.is_sorted(), "{terms:?}");
    assert!(glossary().all(|entry| entry.text.ends_with('.')), "each entry is a sentence");
    let room = Room::new();
    for term in terms {
        assert!(room.expect(&format!("explain {term}"), DONE).0.starts_with(term));
    }
}

#[test]
fn the_page_on_many_files_names_every_ending_and_every_key_of_the_manifest() {
    let text = page("many-files");
    for extension in DIALECTS.iter().flat_map(|dialect| dialect.extensions) {
        assert!(text.contains(&format!("`.{extension}`")), "many-files.md does not name `.{extension}`");
    }
    let room = room_of_many(true);
    room.expect("compile in -o out/ -q", FAULTY);
    let section = section(text, "The manifest");
    let first_cells = section.lines().filter_map(|line| Some(line.strip_prefix("| `")?.split_once(" | ")?.0));
    let words = first_cells.flat_map(|cell| cell.split([',', '`', ' ']));
    let told: BTreeSet<&str> = words.filter(|word| !word.is_empty()).collect();
    // The example, in one line again.
    let example: String = section.lines().filter_map(|line| line.strip_prefix("    ")).collect();
    for line in room.text("out/cutc.jsonl").lines().chain([example.as_str()]) {
        let line: serde_json::Value = serde_json::from_str(line).unwrap_or_else(|error| panic!("{error}: {line}"));
        let keys: BTreeSet<&str> = line.as_object().expect("an object").keys().map(String::as_str).collect();
        assert_eq!(keys, told);
    }
}

/// Stands for the scheduler: runs the tasks of an array one after the other, and what waits for them behind them.
const SBATCH: &str = r#"#!/bin/bash
case "$1" in
--parsable)
    script=$2
    shift 2
    count=$(sed -n 's/^#SBATCH --array=1-//p' "$script")
    cpus=$(sed -n 's/^#SBATCH --cpus-per-task=//p' "$script")
    for ((task = count; task > 0; task--)); do
        SLURM_ARRAY_TASK_ID=$task SLURM_ARRAY_TASK_COUNT=$count SLURM_CPUS_PER_TASK=$cpus bash "$script" "$@" >&2
        echo "task $task ended with $?" >&2
    done
    echo 4711
    ;;
--dependency=afterany:4711)
    sh -c "${2#--wrap=}"
    ;;
*) exit 99 ;;
esac
"#;

#[test]
fn a_slurm_array_makes_what_a_single_run_makes() {
    let room = room_of_many(true);
    let scripts = blocks(section(page("many-files"), "Slurm"), "bash");
    let [script, submission] = scripts.try_into().expect("the script and how it is given in");
    room.write("cut.sbatch", script.as_bytes());
    room.write("sbatch", SBATCH.as_bytes());
    shell("chmod +x sbatch", &room, &[]);
    let ran = shell(&submission, &room, &[]);
    let ended = |code: i32| said(&ran).matches(&format!(" ended with {code}\n")).count();
    assert_eq!((ended(DONE), ended(FAULTY)), (15, 1), "{}", said(&ran));
    expect_joined(&room, &ran);
}

/// What stands under a way of keys, which must be there.
fn at<'y>(yaml: &'y Yaml, way: &[&str]) -> &'y Yaml {
    way.iter().fold(yaml, |yaml, key| match yaml {
        Yaml::Array(list) => &list[key.parse::<usize>().expect("a number")],
        table => &table[*key],
    })
}

#[test]
fn a_kubernetes_job_makes_what_a_single_run_makes() {
    let room = room_of_many(true);
    let text = blocks(section(page("many-files"), "Kubernetes"), "yaml").concat();
    let job = &YamlLoader::load_from_str(&text).expect("YAML")[0];
    let word = |way: &[&str]| at(job, way).as_str().unwrap_or_else(|| panic!("{way:?} is a word")).to_owned();
    assert_eq!([word(&["apiVersion"]), word(&["kind"])], ["batch/v1", "Job"]);
    assert_eq!(word(&["spec", "completionMode"]), "Indexed");
    let pod = ["spec", "template", "spec"];
    let container = |key: &str| at(job, &[&pod[..], &["containers", "0", key]].concat());
    let volume = |key: &str| word(&[&pod[..], &["containers", "0", "volumeMounts", "0", key]].concat());
    assert_eq!(volume("name"), word(&[&pod[..], &["volumes", "0", "name"]].concat()));
    // The room stands for the volume.
    assert_eq!(container("workingDir").as_str(), Some(volume("mountPath").as_str()));
    let words = ["command", "args"].map(|key| container(key).as_vec().expect("a list").clone()).concat();
    let words: Vec<&str> = words.iter().map(|word| word.as_str().expect("a word")).collect();
    let completions = at(job, &["spec", "completions"]).as_i64().expect("a number");
    for index in 0..completions {
        let mut pod = Command::new(words[0]);
        pod.args(&words[1..]).current_dir(room.at("")).env("PATH", search_path(&room.at("")));
        let ran = pod.env("JOB_COMPLETION_INDEX", index.to_string()).output().expect("it starts");
        assert_eq!(ran.status.code(), Some(DONE), "{index}: {}", said(&ran));
    }
    let joining = commands(page("many-files")).pop().expect("the page ends with the joining run");
    expect_joined(&room, &shell(&joining, &room, &[]));
}

#[test]
fn the_manifest_of_a_part_has_the_lines_of_its_files_alone_and_goes_when_it_is_joined() {
    let room = room_of_many(true);
    room.expect("compile in -o out/ -q", FAULTY);
    let single = room.text("out/cutc.jsonl");
    let mut lines: Vec<String> = Vec::new();
    for part in 1..=3 {
        let code = room.run(&format!("compile in -o out/ --shard {part}/3 --changed -q")).status.code();
        assert!(code == Some(DONE) || code == Some(FAULTY));
        lines.extend(room.text(&format!("out/cutc.{part}-of-3.jsonl")).lines().map(str::to_owned));
    }
    lines.sort();
    assert_eq!(lines, single.lines().collect::<Vec<_>>());
    // One that is held still runs: it stays, and is taken in when it has ended.
    let holder = fs::File::open(room.at("out/cutc.2-of-3.jsonl")).expect("readable");
    holder.lock().expect("locks");
    room.expect("compile in -o out/ --changed -q", FAULTY);
    assert!(!room.has("out/cutc.1-of-3.jsonl") && room.has("out/cutc.2-of-3.jsonl"));
    drop(holder);
    room.expect("compile in -o out/ --changed -q", FAULTY);
    assert!(!room.has("out/cutc.2-of-3.jsonl"));
    assert_eq!(room.text("out/cutc.jsonl"), single);
}
