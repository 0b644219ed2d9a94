//! Lines of G-code that a profile gives: what they may say, so that every interpreter takes the program around them.
//!
//! Each line is words of the plain language RS274/NGC ([`words`]) whose codes stand in a list ([`codes`]); what is down
//! and what is up again must be told apart ([`alike`]), and none but its own lines puts the knife down ([`unasked`]). An
//! interpreter then refuses no line of a program, whichever the table, and nothing in a table changes what the lines around
//! it mean. One thing a profile cannot know: the tool that T chooses must stand in the controller's own tool table.

mod alike;
mod codes;
mod unasked;
mod words;

use self::codes::{Does, does};
use super::profile::MachineProfile;

/// Longest line, characters: `LinuxCNC` reads 252, and the number of the line comes before it.
const LINE_MAX: usize = 200;
/// Drills of a machine.
const DRILLS: std::ops::RangeInclusive<u8> = 1..=4;

/// What is wrong with a line.
#[derive(Debug, PartialEq)]
struct Flaw {
    /// What it has, as it goes on behind "the key has".
    has: String,
    hint: String,
}

impl Flaw {
    fn new(has: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { has: has.into(), hint: hint.into() }
    }
}

/// What is wrong with the lines of one key, or of several.
#[derive(Debug, PartialEq)]
pub(super) struct Fault {
    pub(super) keys: Vec<&'static str>,
    pub(super) message: String,
    pub(super) hint: String,
}

/// Where lines stand in a program.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    Start,
    /// Where a tool is put down or lifted.
    Tool,
    /// Where something is waited for, no tool down.
    Between,
    End,
}

/// The lines of a key.
#[derive(Debug, Clone, Copy)]
struct Lines<'a> {
    key: &'static str,
    text: &'a str,
    place: Place,
    /// The longest rest that it may have, and the key that says so, s.
    rest: Option<(f64, &'static str)>,
}

impl<'a> Lines<'a> {
    /// The lines that say something, as they stand in a program.
    fn lines(self) -> impl Iterator<Item = &'a str> {
        self.text.lines().map(str::trim).filter(|line| !line.is_empty())
    }
}

/// The lines of a profile by their keys.
fn texts(profile: &MachineProfile) -> [Lines<'_>; 8] {
    let (keys, knife) = (&profile.gcode, &profile.knife);
    let text = |key, text, place| Lines { key, text, place, rest: None };
    let tool = |key, lines, rest| Lines { rest: Some(rest), ..text(key, lines, Place::Tool) };
    [
        text("gcode.header", keys.header.as_str(), Place::Start),
        tool("gcode.knife_down", &keys.knife_down, (knife.plunge(), "knife.plunge_ms")),
        tool("gcode.knife_up", &keys.knife_up, (knife.lift(), "knife.lift_ms")),
        tool("gcode.drill_down", &keys.drill_down, (profile.drill.dwell(), "drill.dwell_ms")),
        tool("gcode.drill_up", &keys.drill_up, (knife.lift(), "knife.lift_ms")),
        text("gcode.stop", &keys.stop, Place::Between),
        text("gcode.advance", &keys.advance, Place::Between),
        text("gcode.footer", &keys.footer, Place::End),
    ]
}

/// Everything that is wrong with the lines of a profile: of each key the first, and what keys do not tell apart.
pub(super) fn faults(profile: &MachineProfile) -> Vec<Fault> {
    let texts = texts(profile);
    let blade = profile.gcode.letter.byte();
    let mut faults: Vec<Fault> = texts.into_iter().filter_map(|text| fault_of(text, blade)).collect();
    let broken: Vec<&str> = faults.iter().flat_map(|fault| fault.keys.clone()).collect();
    let sound: Vec<Lines> = texts.into_iter().filter(|text| !broken.contains(&text.key)).collect();
    faults.extend(alike::faults(&sound));
    let told: Vec<&str> = faults.iter().flat_map(|fault| fault.keys.clone()).collect();
    faults.extend(unasked::faults(&sound).into_iter().filter(|fault| !told.contains(&fault.keys[0])));
    faults
}

/// The first thing that is wrong with the lines of a key.
fn fault_of(text: Lines, blade: u8) -> Option<Fault> {
    let Lines { key, .. } = text;
    let fault = |message, hint: &str| Some(Fault { keys: vec![key], message, hint: hint.to_owned() });
    let is_drill = matches!(key, "gcode.drill_down" | "gcode.drill_up");
    // All drills are told alike but for their number.
    let numbers = if is_drill { DRILLS } else { 1..=1 };
    let mut acts = false;
    for number in numbers {
        let told = if is_drill { text.text.replace('#', &number.to_string()) } else { text.text.to_owned() };
        match read(Lines { text: &told, ..text }, blade) {
            Err(flaw) => return fault(format!("`{key}` has {}", flaw.has), &flaw.hint),
            Ok(does) => acts = does.acts,
        }
    }
    let is_needed = matches!(key, "gcode.knife_down" | "gcode.knife_up");
    let is_blank = text.lines().next().is_none();
    if is_blank && (is_needed || key == "gcode.footer") {
        let hint = "give the lines that the controller needs, such as M3 and M5 for the knife, M2 for the end";
        return fault(format!("`{key}` says nothing"), hint);
    }
    if text.place == Place::End && begins_with_a_place(text, blade) {
        let hint = "it is told from a move of the program by nothing: `park` says where the axes go at the end";
        return fault(format!("`{key}` begins with a move of X, Y and {}", char::from(blade)), hint);
    }
    if text.place == Place::Tool && !acts && !is_blank {
        let hint = "what switches is M64 P, M65 P, M68 E Q, M3 to M5 with S, M7 to M9, or G0 and G1 F with an axis";
        return fault(format!("`{key}` moves and switches nothing"), hint);
    }
    None
}

/// Whether the first line of a text is a move to a place, such as the program has itself.
fn begins_with_a_place(text: Lines, blade: u8) -> bool {
    let first = text.lines().next().and_then(|line| words::words(line).ok()).unwrap_or_default();
    [b'X', b'Y', blade].iter().all(|&letter| first.iter().any(|word| word.letter == letter))
}

/// What the lines of a text do, all together.
fn read(text: Lines, blade: u8) -> Result<Does, Flaw> {
    let mut all = Does::default();
    for line in text.lines() {
        if let Some(c) = line.chars().find(|c| !matches!(c, ' '..='~' | '\t')) {
            let hint = "lines of G-code are plain ASCII, comments too";
            return Err(Flaw::new(format!("{}, which no controller reads", named(c)), hint));
        }
        if line.len() > LINE_MAX {
            let hint = format!("controllers stop there: lines have {LINE_MAX} characters at the most");
            return Err(Flaw::new(format!("a line of {} characters", line.len()), hint));
        }
        if all.ends {
            return Err(Flaw::new(
                "lines behind its end",
                "M2 or M30 stands in the last one: nothing is read behind it",
            ));
        }
        let words = words::words(line)?;
        let does = does(&words, text.place, blade)?;
        all = Does { acts: all.acts || does.acts, rest: all.rest + does.rest, ends: does.ends };
    }
    if let Some((longest, by)) = text.rest.filter(|(longest, _)| all.rest > longest.max(0.0)) {
        let has = format!("rests of {} s, longer than `{by}`, {longest} s", all.rest);
        return Err(Flaw::new(has, format!("the program rests as long as `{by}` says by itself")));
    }
    if text.place == Place::End && !all.ends && text.lines().next().is_some() {
        return Err(Flaw::new("no end of the program", "its last line is M2 or M30"));
    }
    Ok(all)
}

/// A character as a message shows it.
fn named(c: char) -> String {
    if c.is_control() { format!("the character U+{:04X}", u32::from(c)) } else { format!("`{c}`") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::controller::{Gcode, Letter};

    /// Checks what is said about the lines of the default profile, changed.
    pub(super) fn check(change: fn(&mut MachineProfile), expected: &[&str]) {
        let mut profile = MachineProfile::default();
        change(&mut profile);
        let found: Vec<String> = faults(&profile).into_iter().map(|fault| fault.message).collect();
        assert_eq!(found, expected);
    }

    /// What is said about lines of a key.
    fn said(key: &str, lines: &str) -> Vec<String> {
        let mut profile = MachineProfile::default();
        let gcode = &mut profile.gcode;
        let text = match key {
            "header" => &mut gcode.header,
            "knife_down" => &mut gcode.knife_down,
            "knife_up" => &mut gcode.knife_up,
            "drill_down" => &mut gcode.drill_down,
            "drill_up" => &mut gcode.drill_up,
            "stop" => &mut gcode.stop,
            "advance" => &mut gcode.advance,
            _ => &mut gcode.footer,
        };
        lines.clone_into(text);
        faults(&profile).into_iter().map(|fault| fault.message).collect()
    }

    #[test]
    fn lines_that_every_interpreter_takes_are_taken() {
        for (key, lines) in [
            ("header", ""),
            ("header", "G54\n(G20 X5) T1 M6\nM49"),
            ("header", "G53 G0 Z0\nG21 G90 G40 G49 G80"),
            ("knife_down", "M3"),
            ("knife_down", "M3 S1000"),
            ("knife_down", "m03 s90"),
            ("knife_down", "G0 Z-2"),
            ("knife_down", "G1 Z-2 F300"),
            ("knife_down", "G0 B30 ; tilted"),
            ("knife_down", "(MSG, down)\nM64 P0 M8"),
            ("knife_down", "M68 E0 Q-5"),
            ("knife_down", "M64 P5\nG4 P0.05\nM65 P5\nM66 P1 L3 Q2"),
            ("knife_up", "G53 G1 Z5 F300"),
            ("drill_down", "G0 Z-#"),
            ("drill_down", ""),
            ("stop", "(MSG, wait)\nM0"),
            ("advance", "M64 P5\nG4 P0.5\nM65 P5"),
            ("footer", "M9\nG0 X0 Y0\nG1 Z5 C0 F100\nG28\nM30"),
            ("footer", "M5 M2"),
        ] {
            assert_eq!(said(key, lines), Vec::<String>::new(), "{key}: {lines}");
        }
    }

    #[test]
    fn what_an_interpreter_refuses_or_what_undoes_the_program_is_named() {
        for (key, lines, expected) in [
            ("header", "g20", "G20, which undoes"),
            ("header", "G54 G 92 X10", "G92, which undoes"),
            ("header", "M30", "M30, which ends"),
            ("header", "G0X5", "X5, which undoes"),
            ("header", "N5 G54", "N5, a number"),
            ("header", "%", "`%`, which frames"),
            ("header", "#5221=1", "`#`, which computes"),
            ("header", "G33", "G33, which is no code"),
            ("header", "G54 G55", "G54 and G55 on a line"),
            ("header", "F100", "F100 without G1"),
            ("header", "U1", "U1, an axis"),
            ("knife_down", "G1 Z-2", "G1 without F"),
            ("knife_down", "G1 Z-2 F0", "F0, which is no speed"),
            ("knife_down", "G0 Z-2 F300", "F300 beside G0"),
            ("knife_down", "Z-2", "Z-2 without G0 or G1"),
            ("knife_down", "G0", "G0 without an axis"),
            ("knife_down", "G0 C5", "C5, which undoes"),
            ("knife_down", "G53", "G53 without G0 or G1"),
            ("knife_down", "G55\nM3", "G55, which has no business"),
            ("knife_down", "M428", "M428, which is no code"),
            ("knife_down", "M101", "M101, which runs a program"),
            ("knife_down", "m62 p0", "M62, which acts only"),
            ("knife_down", "M64\nP0", "M64 without P"),
            ("knife_down", "P0 M3", "P0 without its code"),
            ("knife_down", "M64 P-1", "P-1, which is no output"),
            ("knife_down", "M64 P0 P1", "two words P"),
            ("knife_down", "M64 P0 M65", "M64 and M65 on a line"),
            ("knife_down", "M64 P0 G4", "P0, which two codes"),
            ("knife_down", "M3 M0", "M0, which waits"),
            ("knife_down", "M3 S-1", "S-1, which is no speed"),
            ("knife_down", "M3\nG4 P5", "rests of 5 s, longer than `knife.plunge_ms`, 0.08 s"),
            ("drill_down", "M64 P9#", "no output"),
            ("advance", "M66 P0 L3", "M66 without Q"),
            ("advance", "M66 P0 L3 Q0", "Q0, which is no time"),
            ("stop", "M0 \u{e9}", "`\u{e9}`, which no controller reads"),
            ("stop", "M0 (a", "a comment without its other bracket"),
            ("footer", "G91\nM2", "G91, which undoes"),
            ("footer", "M2\nM5", "lines behind its end"),
            ("footer", "M5", "no end"),
            ("footer", "G1 X0\nM2", "G1 without F"),
            ("footer", "G0 C0 X0 Y0\nM2", "begins with a move"),
        ] {
            let found = said(key, lines);
            assert!(found.len() == 1 && found[0].contains(expected), "{key}: {lines}: {found:?}");
        }
        let long = format!("M3 ({})", "x".repeat(LINE_MAX));
        assert!(said("header", &long)[0].contains("a line of 205 characters"));
    }

    #[test]
    fn what_puts_a_tool_down_must_do_something() {
        assert_eq!(said("knife_down", "G4 P0.05"), ["`gcode.knife_down` moves and switches nothing"]);
        assert_eq!(said("drill_up", "(up)"), ["`gcode.drill_up` moves and switches nothing"]);
        assert_eq!(said("knife_up", " \n"), ["`gcode.knife_up` says nothing"]);
    }

    #[test]
    fn the_axis_of_the_blade_is_the_one_that_the_profile_names() {
        let gcode = Gcode { letter: Letter::A, knife_down: "G0 C5".to_owned(), ..Gcode::default() };
        let mut profile = MachineProfile { gcode, ..MachineProfile::default() };
        assert_eq!(faults(&profile), []);
        profile.gcode.knife_down = "G0 A5".to_owned();
        assert_eq!(faults(&profile).len(), 1);
    }
}
