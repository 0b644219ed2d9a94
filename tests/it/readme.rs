//! README is true: its commands run, and it names every page of the manual.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use cutc::manual::{PAGES, Page};

use crate::support;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn readme() -> String {
    fs::read_to_string(root().join("README.md")).expect("README.md is there")
}

/// The lines of README's code blocks that start with `word`, without their comments.
fn commands(word: &str) -> Vec<String> {
    let readme = readme();
    let lines = readme.lines().filter_map(|line| line.strip_prefix("    "));
    let commands = lines.filter(|line| line.starts_with(word));
    commands.map(|line| line.split('#').next().unwrap_or(line).trim().to_owned()).collect()
}

/// Runs a line of README in a directory, with `cutc` on the path.
fn shell(line: &str, directory: &Path) -> Output {
    let binary = PathBuf::from(env!("CARGO_BIN_EXE_cutc"));
    let folder = binary.parent().expect("a binary lies in a folder").display().to_string();
    let path = format!("{folder}:{}", std::env::var("PATH").unwrap_or_default());
    Command::new("sh").args(["-c", line]).current_dir(directory).env("PATH", path).output().expect("sh runs")
}

#[test]
fn the_first_two_commands_are_the_main_job_and_the_tests() {
    let commands = commands("cargo ");
    assert_eq!(commands[..2], ["cargo run -- compile fixtures/iso/seed-circle.cut", "cargo test"]);
    // The same as the first, with the binary of this test run.
    let folder = tempfile::tempdir().expect("a temporary folder");
    let input = root().join("fixtures/iso/seed-circle.cut");
    let ran = shell(&format!("cutc compile {}", input.display()), folder.path());
    let said = String::from_utf8_lossy(&ran.stderr);
    assert!(ran.status.success() && said.contains("verified"), "{said}");
    for name in ["seed-circle.csv", "seed-circle.csv.meta.json"] {
        assert!(folder.path().join(name).is_file(), "{name} was not written");
    }
}

#[test]
fn every_command_of_the_readme_runs() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::copy(root().join("fixtures/pictures/marker.cut"), folder.path().join("marker.cut")).expect("a copy");
    fs::write(folder.path().join("marks.csv"), support::MARKS).expect("marks");
    fs::write(folder.path().join("machine.toml"), "knife.width_mm = 7.2\n").expect("a profile");
    fs::create_dir(folder.path().join("in")).expect("a folder");
    fs::copy(root().join("fixtures/pictures/marker.cut"), folder.path().join("in/marker.cut")).expect("a copy");
    fs::copy(root().join("fixtures/sew/pocket.csv"), folder.path().join("pocket.csv")).expect("a copy");
    fs::copy(root().join("fixtures/track/step.toml"), folder.path().join("step.toml")).expect("a copy");
    fs::copy(root().join("fixtures/pictures/pattern.dxf"), folder.path().join("pattern.dxf")).expect("a copy");
    let drawing = root().join("fixtures/dxf/layers-that-say-what-they-are.dxf");
    fs::copy(drawing, folder.path().join("drawing.dxf")).expect("a copy");
    fs::copy(root().join("fixtures/spray/panel.csv"), folder.path().join("panel.csv")).expect("a copy");
    fs::copy(root().join("fixtures/machines/spray.toml"), folder.path().join("spray.toml")).expect("a copy");
    let commands = commands("cutc ");
    assert!(commands.len() >= 6, "{commands:?}");
    for command in commands {
        // `profile init` never overwrites, and `verify` judges against the profile that the program was made for.
        let command = command.replace("init -o machine.toml", "init -o other.toml");
        let command = command.replace("--source marker.cut", "--source marker.cut -p machine.toml");
        // A watch ends when it is asked to.
        let is_watch = command.starts_with("cutc watch ");
        let command = if is_watch { format!("timeout --preserve-status -s TERM 3 {command}") } else { command };
        let ran = shell(&command, folder.path());
        let expected = if is_watch { 143 } else { 0 };
        assert_eq!(ran.status.code(), Some(expected), "`{command}`: {}", String::from_utf8_lossy(&ran.stderr));
    }
}

#[test]
fn the_picture_is_what_the_program_draws() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    assert!(readme().contains("`cutc compile fixtures/pictures/marker.cut -t svg`"));
    let line = format!("cutc compile fixtures/pictures/marker.cut -t svg -o {}", folder.path().display());
    let ran = shell(&line, root());
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    let drawn = fs::read_to_string(folder.path().join("marker.svg")).expect("a picture");
    let shown = fs::read_to_string(root().join("fixtures/pictures/marker.svg")).expect("README's picture");
    let differ = drawn.lines().zip(shown.lines()).position(|(drawn, shown)| drawn != shown);
    assert!(drawn == shown, "marker.svg is stale from line {differ:?} on: write it anew with the command above it");
}

#[test]
fn the_readme_is_short_and_names_every_page_of_the_manual() {
    let readme = readme();
    assert!(readme.lines().count() <= 200);
    for Page { name, about, .. } in PAGES {
        assert!(readme.contains(&format!("| [{name}](src/manual/{name}.md) | {about} |")), "{name}");
    }
}
