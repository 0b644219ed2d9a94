//! Labels and the other facts of a file, from its bytes to what `cutc info` and a picture show.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// Runs `cutc` on a fixture in a folder of its own; gives what it prints, and the files that it wrote, in order.
fn run(fixture: &str, arguments: &[&str]) -> (String, Vec<String>) {
    let folder = tempfile::tempdir().expect("a folder");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(fixture);
    let name = source.file_name().expect("a file");
    std::fs::copy(&source, folder.path().join(name)).expect("a fixture");
    let mut command = Command::new(env!("CARGO_BIN_EXE_cutc"));
    let words = [arguments[0].as_ref(), name].into_iter().chain(arguments[1..].iter().map(AsRef::as_ref));
    let output = command.current_dir(folder.path()).args(words).output().expect("the program starts");
    assert!(output.status.success(), "{fixture} {arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    let mut names: Vec<_> = std::fs::read_dir(folder.path()).expect("readable").flatten().map(|e| e.path()).collect();
    names.sort();
    let written = names.iter().filter(|path| path.extension().is_some_and(|extension| extension == "svg"));
    let written = written.map(|path| std::fs::read_to_string(path).expect("UTF-8")).collect();
    (String::from_utf8(output.stdout).expect("UTF-8"), written)
}

/// What `info --labels` adds to `info`.
fn labels(fixture: &str, encoding: &str) -> String {
    let set = format!("labels.encoding={encoding}");
    let (plain, _) = run(fixture, &["info"]);
    let (full, _) = run(fixture, &["info", "--labels", "--set", &set]);
    format!("{fixture}, {encoding}\n{}", full.strip_prefix(&plain).expect("the same figures first"))
}

#[test]
fn labels_are_listed_as_people_read_them() {
    let cases = [
        ("iso/label-in-cp1251.cut", "windows-1251"),
        ("iso/label-in-cp1251.cut", "utf-8"),
        ("iso/label-in-gbk.cut", "gbk"),
        ("iso/label-in-latin1.cut", "latin1"),
        ("iso/label-in-utf-8.cut", "utf-8"),
        ("iso/label-in-utf-8.cut", "windows-1251"),
        ("iso/label-in-utf-8.cut", "gbk"),
        ("iso/label-that-looks-like-codes.cut", "utf-8"),
        ("iso/label-with-control-characters.cut", "utf-8"),
        ("iso/labels-in-all-layouts.cut", "utf-8"),
        ("iso/trailer-in-cp1251.cut", "windows-1251"),
        ("iso/seed-circle.cut", "utf-8"),
    ];
    let text: Vec<String> = cases.iter().map(|(fixture, encoding)| labels(fixture, encoding)).collect();
    insta::assert_snapshot!(text.join("\n"));
}

#[test]
fn labels_come_as_json_with_units_in_the_keys() {
    let words = ["info", "--labels", "--format", "json", "--set", "labels.encoding=cp1251"];
    let of = |fixture: &str| -> Value {
        let json: Value = serde_json::from_str(&run(fixture, &words).0).expect("JSON");
        json["labels_by_piece"].clone()
    };
    let both = [of("iso/labels-in-all-layouts.cut"), of("iso/trailer-in-cp1251.cut")];
    insta::assert_snapshot!(serde_json::to_string_pretty(&both).expect("JSON"));
}

#[test]
fn what_a_file_asks_for_is_told_in_small_tables() {
    insta::assert_snapshot!(run("iso/speeds-and-events.cut", &["info"]).0);
    let json: Value =
        serde_json::from_str(&run("iso/speeds-and-events.cut", &["info", "--format", "json"]).0).expect("JSON");
    assert_eq!((&json["speeds"][0]["feed_mm_s"], &json["speeds"][0]["percent"]), (&127.0.into(), &100.into()));
    assert_eq!(json["events"][2], serde_json::json!({ "kind": "stop", "before_piece": null, "block": 35 }));
    let (plain, _) = run("iso/seed-circle.cut", &["info"]);
    assert!(!plain.contains("percent") && !plain.contains("event") && !plain.contains("depth"), "{plain}");
}

#[test]
fn a_picture_has_the_labels_in_the_encoding_of_the_profile() {
    let words = ["compile", "-t", "svg", "--set", "labels.encoding=gbk"];
    let (_, pictures) = run("iso/label-in-gbk.cut", &words);
    assert!(pictures[0].contains(">前片 44<title>label, block 6</title>"), "{}", pictures[0]);
    assert!(pictures[0].contains(">左袖 / 布料<title>"), "{}", pictures[0]);
}
