//! A program that somebody has edited: what is wrong is named where it stands, and nothing that only follows from it.

use serde_json::Value;

use crate::support::room::{DONE, FAULTY, Room};

/// A room with the compiled circle, and the lines of its program.
fn compiled() -> (Room, Vec<String>) {
    let room = Room::new();
    room.expect("compile circle.cut", DONE);
    let text = String::from_utf8(room.read("circle.csv")).expect("text");
    (room, text.lines().map(str::to_owned).collect())
}

fn judge(room: &Room, lines: &[String]) -> (String, String) {
    room.write("edited.csv", (lines.join("\n") + "\n").as_bytes());
    room.expect("verify edited.csv --source circle.cut", FAULTY)
}

#[test]
fn a_row_that_is_missing_or_repeated_is_told_where_it_is() {
    let (room, lines) = compiled();
    let row = lines.len() / 2;
    let check = |lines: Vec<String>, time: &str| {
        let (stdout, _) = judge(&room, &lines);
        let found = stdout.lines().find(|line| line.starts_with("FAIL  verify/time")).expect("it is broken");
        assert!(found.contains(&format!(" {time} ")), "{found}, not at {time}");
    };
    let at =
        |row: usize| format!("{:.3}", lines[row].split(',').next().expect("a time").parse::<f64>().expect("a number"));
    check([&lines[..row], &lines[row + 1..]].concat(), &at(row + 1));
    check([&lines[..row], &lines[row - 1..]].concat(), &at(row - 1));
}

#[test]
fn rows_that_cannot_be_read_are_named_by_their_lines_and_nothing_else_is_blamed() {
    let (room, mut lines) = compiled();
    let row = lines.len() / 2;
    lines[row] = lines[row]
        .split(',')
        .enumerate()
        .map(|(i, field)| if i == 1 { "abc" } else { field })
        .collect::<Vec<_>>()
        .join(",");
    let (stdout, _) = judge(&room, &lines);
    let unread = format!("line {} has `abc` as x_mm, which is no number", row + 1);
    assert!(stdout.contains(&unread) && stdout.contains("mend them first"), "{stdout}");
    let broken: Vec<&str> = stdout.lines().filter(|line| line.starts_with("FAIL  verify/")).collect();
    assert!(matches!(broken[..], [only] if only.contains("verify/format")), "{stdout}");
    lines[row + 5].push_str(",1");
    let (stdout, _) = judge(&room, &lines);
    assert!(stdout.contains(&format!("2 rows cannot be read, the first: {unread}")), "{stdout}");

    let (stdout, _) = room.expect("verify edited.csv --source circle.cut --format json", FAULTY);
    let judged: Value = serde_json::from_str(&stdout).expect("JSON");
    assert!(judged["unread"].as_str().expect("text").ends_with(&unread), "{stdout}");
    assert!(
        judged["rules"].as_array().expect("a list").iter().all(|rule| rule["code"] != "verify/complete"),
        "{stdout}"
    );
}

#[test]
fn a_header_that_is_none_is_told_apart() {
    let (room, lines) = compiled();
    let check = |edited: Vec<String>, expected: &str| {
        let (stdout, stderr) = judge(&room, &edited);
        assert!(
            stdout.is_empty() && stderr.contains(expected) && stderr.contains("hint"),
            "{expected}\n{stdout}{stderr}"
        );
    };
    let with = |header: String| [&[header], &lines[1..]].concat();
    check(with(lines[0].replace("c_deg", "c_rad")), "its header says `c_rad` where `c_deg` belongs");
    check(lines[1..].to_vec(), "its header is missing");
    check(with(format!("\u{feff}{}", lines[0])), "byte order mark");
    check(lines.iter().map(|line| line.replace(',', ";")).collect(), "separated by `;`");
}
