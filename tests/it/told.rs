//! What `verify` tells of a broken rule: the piece, the line of the program, what stands there, and what to do.

use std::fs;

use crate::support::room::Room;

/// Two pieces, the second one named.
const PIECES: &str = "H1*G71*N1*M15*M15*X200Y200*M14*X700Y200*X700Y600*X200Y600*X200Y200*M15*\
                      N2*M15*M15*X900Y200*M31*FRONT*M14*X1400Y200*X1400Y600*X900Y600*X900Y200*M15*M0*\n";

/// What follows the row of a broken rule.
fn told(said: &str, rule: &str) -> String {
    let broken = |line: &str| line.starts_with("FAIL") && line.split_whitespace().nth(1) == Some(rule);
    let lines = said.lines().skip_while(|line| !broken(line)).skip(1);
    lines.take_while(|line| line.starts_with("      ")).map(|line| line.trim_start().to_owned() + "\n").collect()
}

#[test]
fn a_row_that_was_moved_is_quoted_with_its_line() {
    let room = Room::with("two.cut", PIECES);
    // Behind the rows of the plunge, and on an edge along Y.
    for (target, skipped) in [("csv", 120), ("gcode", 1)] {
        room.says(&format!("compile two.cut -t {target} --force"), 0);
        let name = if target == "csv" { "two.csv" } else { "two.ngc" };
        let text = room.text(name);
        let (mut lines, mut at) = (text.lines().map(str::to_owned).collect::<Vec<_>>(), 0);
        let is_cut = |line: &String| match target {
            "csv" => line.split(',').nth(4) == Some("1"),
            _ => line.starts_with("G1 X"),
        };
        for (i, line) in lines.iter_mut().enumerate().filter(|(_, line)| is_cut(line)).skip(skipped).take(1) {
            let moved = if target == "csv" {
                let mut fields: Vec<String> = line.split(',').map(str::to_owned).collect();
                fields[1] = "3.500000".to_owned();
                fields.join(",")
            } else {
                line.split(' ')
                    .map(|word| if word.starts_with('X') { "X3.5000" } else { word })
                    .collect::<Vec<_>>()
                    .join(" ")
            };
            (*line, at) = (moved, i + 1);
        }
        assert!(at > 0, "{target} has a row that cuts");
        fs::write(room.at(name), lines.join("\n") + "\n").expect("writable");
        let said = room.says(&format!("verify {name} --source two.cut"), 1);
        let told = told(&said, "verify/on-path") + &told(&said, "verify/stray");
        assert!(told.contains(&format!("line {at} of the program: {}\n", lines[at - 1])), "{target}: {said}");
        assert!(told.contains("what to do: "), "{said}");
    }
}

#[test]
fn a_line_that_cannot_be_read_is_quoted_and_nothing_in_it_reaches_the_terminal() {
    let room = Room::with("two.cut", PIECES);
    room.says("compile two.cut -t csv", 0);
    let text = room.text("two.csv");
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    lines[99] = "0.098000,abc\u{1b}[2J,0,0,0,0,0,0".to_owned();
    fs::write(room.at("two.csv"), lines.join("\n") + "\n").expect("writable");
    let said = room.says("verify two.csv --source two.cut", 1);
    let quoted = r"line 100 of the program: 0.098000,abc\u{1b}[2J,0,0,0,0,0,0";
    assert!(told(&said, "verify/format").contains(quoted) && !said.contains('\u{1b}'), "{said}");
}

#[test]
fn a_piece_that_is_not_cut_is_named() {
    let room = Room::with("two.cut", PIECES);
    room.says("compile two.cut -t csv --pieces 1 -o one.csv", 0);
    let said = room.says("verify one.csv --source two.cut", 1);
    assert!(told(&said, "verify/complete").contains("not cut at all: piece 2"), "{said}");
    let value = room.says("verify one.csv --source two.cut --format json --quiet", 1);
    let value: serde_json::Value = serde_json::from_str(&value).expect("JSON");
    let rules = value["rules"].as_array().expect("a list");
    let complete = rules.iter().find(|rule| rule["code"] == "verify/complete").expect("it is judged");
    assert_eq!(complete["uncut"][0]["number"], 2);
}

#[test]
fn of_a_program_without_lines_the_record_is_told() {
    let room = Room::with("two.cut", PIECES);
    room.says("compile two.cut -t counts", 0);
    let mut bytes = room.read("two.counts");
    let middle = 1024 + (bytes.len() - 1024) / 20 / 2 * 20;
    bytes[middle..middle + 4].copy_from_slice(&2_000_000_i32.to_le_bytes());
    fs::write(room.at("two.counts"), bytes).expect("writable");
    let said = room.says("verify two.counts --source two.cut", 1);
    assert!(
        told(&said, "verify/speed-x").contains(&format!("record {} of the program", (middle - 1024) / 20)),
        "{said}"
    );
}
