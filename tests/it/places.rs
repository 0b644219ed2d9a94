//! Where files come from and where programs go: standard input and output, extensions, directories, names in messages.

use cutc::back::TARGETS;

use crate::support::room::{DONE, FAULTY, Room, USAGE};

#[test]
fn the_extension_of_a_place_chooses_the_target() {
    let room = Room::new();
    for target in TARGETS {
        let name = format!("x.{}", target.extension);
        room.expect(&format!("compile circle.cut -o {name}"), DONE);
        room.expect(&format!("compile circle.cut -t {}", target.name), DONE);
        assert!(room.read(&name) == room.read(&format!("circle.{}", target.extension)), "{name}");
    }
    let (_, stderr) = room.expect("compile circle.cut -t svg -o z.csv", USAGE);
    assert!(stderr.contains("`-t svg` and `-o z.csv` disagree") && stderr.contains("`-o z.svg`"), "{stderr}");
    let (_, stderr) = room.expect("compile circle.cut -o pictures", USAGE);
    assert!(stderr.contains("`-o pictures/`") && stderr.contains("`-o pictures.csv`"), "{stderr}");
    assert!(!room.has("z.csv") && !room.has("pictures"));
}

#[test]
fn a_directory_is_made_for_a_program_and_only_for_one() {
    let room = Room::new();
    room.expect("compile junk.cut -o out/", FAULTY);
    assert!(!room.has("out"));
    room.expect("compile circle.cut -t csv,svg -o out/", DONE);
    assert!(room.has("out/circle.csv") && room.has("out/circle.svg.meta.json"));
}

#[test]
fn a_dash_is_standard_input() {
    let room = Room::new();
    room.expect("compile circle.cut", DONE);
    let (circle, program) = (room.read("circle.cut"), room.read("circle.csv"));
    let (piped, stderr) = room.expect_of(&circle, "compile - -o -", DONE);
    assert!(piped.as_bytes() == program && stderr.starts_with("warning") && stderr.contains("stdin"), "{stderr}");
    room.expect_of(&circle, "compile - --from iso -o x.csv", DONE);
    assert!(room.read("x.csv") == program);
    assert!(String::from_utf8_lossy(&room.read("x.csv.meta.json")).contains("\"source\": \"stdin\""));
    room.expect_of(&circle, "compile - -o out/", DONE);
    assert!(room.read("out/stdin.csv") == program);
    let (_, stderr) = room.expect_of(&circle, "compile -", USAGE);
    assert!(stderr.contains("standard input has no name") && stderr.contains("-o FILE"), "{stderr}");

    assert!(room.expect_of(&circle, "check -", DONE).1.contains("stdin: iso, 0 errors"));
    assert!(room.expect_of(b"", "check -", FAULTY).1.contains("source/empty"));
    assert!(room.expect_of(&circle, "info -", DONE).0.starts_with("stdin\n"));
    let (stdout, _) = room.expect_of(&circle, "verify circle.csv --source -", DONE);
    assert!(stdout.contains("cuts what `stdin` says"), "{stdout}");
    let (_, stderr) = room.expect_of(&program, "verify - --source circle.cut", USAGE);
    assert!(stderr.contains("not judged from standard input"), "{stderr}");
}

#[test]
fn a_profile_goes_to_standard_output() {
    let room = Room::new();
    assert_eq!(room.expect("profile init -o -", DONE), room.expect("profile init", DONE));
    assert!(!room.has("-"));
}

#[test]
fn each_of_several_profiles_is_named_with_its_count_of_errors() {
    let room = Room::new();
    room.write("a.toml", b"[knife]\nwidht_mm = 6.6\nback_mm = 9\n");
    room.write("b.toml", b"");
    room.write("c.toml", b"x = 1\n");
    let (_, stderr) = room.expect("profile check a.toml b.toml c.toml", FAULTY);
    for words in ["the machine profile `a.toml` has 2 errors", "b.toml: no errors", "profile `c.toml` has 1 error\n"] {
        assert!(stderr.contains(words), "{words}\n{stderr}");
    }
}

#[test]
fn every_command_has_a_manual_page_and_examples_stay_as_they_are() {
    let room = Room::new();
    let (page, _) = room.expect("man", DONE);
    assert!(page.contains(".TH cutc") && page.contains("\n.nf\n"), "{page}");
    assert!(page.contains("\n  cutc check *.cut                            says all that is wrong"), "{page}");
    // Every page that a page names is there.
    let named = |page: &str, prefix: &str| -> Vec<String> {
        let words = page.split(|c: char| c.is_whitespace() || c == '(').map(|word| word.replace("\\-", "-"));
        words.filter_map(|word| word.strip_prefix(prefix).map(str::to_owned)).collect()
    };
    let commands = named(&page, "cutc-");
    assert!(commands.len() >= 8, "{commands:?}");
    for command in commands {
        let (page, _) = room.expect(&format!("man {command}"), DONE);
        assert!(page.contains(".TH cutc-") && page.contains(".SH SYNOPSIS"), "{command}\n{page}");
        for inner in named(&page, &format!("cutc-{command}-")) {
            room.expect(&format!("man {command} {inner}"), DONE);
        }
    }
    assert!(room.expect("man compile", DONE).0.contains("resume\\-from"));
    assert!(room.expect("man compiel", USAGE).1.contains("compile, watch, sew, track, flow, verify"));
}

#[test]
fn a_code_of_cut_files_is_explained() {
    let room = Room::new();
    let (text, _) = room.expect("explain M19", DONE);
    assert!(text.starts_with("M19\n") && text.contains("slit"), "{text}");
}
