//! Free text of a profile: lines after the head of a program and at its end, which move nothing.
//!
//! A line is a step that moves no axis, codes that choose a coordinate system or state a mode that holds anyway, a tool, the
//! end of the program, or a comment. An interpreter then accepts every line, and none changes the meaning of the lines around
//! it. One thing cannot be checked: the tool that T chooses must be in the controller's own tool table.

use super::dialect::Dialect;
use super::step::{NUMBER_MAX, Step};
use super::words::{Flaw, Number, Word, words};

/// Position of a text in a program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum ProgramEnd {
    Start,
    End,
}

/// Line of a text.
#[derive(Debug, PartialEq)]
pub(super) enum Line {
    Step(Step),
    /// Codes that choose, or a tool.
    Choice,
    Comment,
    EndOfProgram,
}

/// Greatest length of a line, characters: `LinuxCNC` reads 252, and the line number precedes it.
const LINE_MAX: usize = 200;
/// Codes that choose, by modal group: a line has at most one of each group (`LinuxCNC` manual, G-code overview, "Modal
/// groups").
#[rustfmt::skip] // a table: one row a group
const CHOICES: &[(&str, &[&str])] = &[
    ("plane", &["G17"]),
    ("unit", &["G21"]),
    ("radius of the tool", &["G40"]),
    ("length of the tool", &["G49"]),
    ("coordinate system", &["G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"]),
    ("cycle", &["G80"]),
    ("distances", &["G90"]),
    ("distances of arcs", &["G91.1"]),
    ("offset", &["G92.1"]),
    ("overrides", &["M48", "M49"]),
];
/// Codes that choose and that every dialect has.
const COMMON: &[&str] = &["G17", "G21", "G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3", "G90"];
/// Codes that end a program in some dialect.
const ENDS: [&str; 2] = ["M2", "M30"];
/// Codes that move axes.
const MOVES: &[&str] = &["G0", "G1", "G2", "G3", "G28", "G30", "G53"];
/// Greatest number of a tool.
const TOOL_MAX: f64 = 1e6;
/// Beginnings of comments that controllers obey.
const ACTIVE: &[&str] =
    &["ABORT", "DEBUG", "LOG", "LOGAPPEND", "LOGCLOSE", "LOGOPEN", "PRINT", "PROBECLOSE", "PROBEOPEN", "PY"];

/// Lines of a text, trimmed, without blank ones.
pub(super) fn lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines().map(str::trim).filter(|line| !line.is_empty())
}

/// Meanings of the lines of a text, or its first flaw.
pub(super) fn read(text: &str, place: ProgramEnd, dialect: Dialect) -> Result<Vec<Line>, Flaw> {
    let lines: Vec<Line> = lines(text).map(|text| line(text, place, dialect)).collect::<Result<_, _>>()?;
    let end = lines.iter().position(|line| *line == Line::EndOfProgram);
    match (place, end) {
        (ProgramEnd::End, None) => {
            let hint = format!("its last line is {}", dialect.ends().join(" or "));
            Err(Flaw::new("no end of the program", hint))
        }
        (ProgramEnd::End, Some(end)) if lines[end + 1..].iter().any(|line| *line != Line::Comment) => Err(Flaw::new(
            "lines behind its end",
            format!("{} stands in the last one: nothing is read behind it", dialect.ends().join(" or ")),
        )),
        (ProgramEnd::Start | ProgramEnd::End, _) => Ok(lines),
    }
}

fn line(text: &str, place: ProgramEnd, dialect: Dialect) -> Result<Line, Flaw> {
    if let Some(c) = text.chars().find(|c| !matches!(c, ' '..='~' | '\t')) {
        let hint = "lines of G-code are plain ASCII, comments too";
        return Err(Flaw::new(format!("`{}`, which no controller reads", c.escape_default()), hint));
    }
    if text.len() > LINE_MAX {
        let hint = format!("controllers stop there: lines have {LINE_MAX} characters at the most");
        return Err(Flaw::new(format!("a line of {} characters", text.len()), hint));
    }
    let bare = uncommented(text)?;
    let words = words(&bare)?;
    match words.as_slice() {
        [] => Ok(Line::Comment),
        [code] if ENDS.iter().any(|end| code.is(end)) => match place {
            ProgramEnd::End => match dialect.other_effect(&code.to_string()) {
                None => Ok(Line::EndOfProgram),
                Some(effect) => Err(Flaw::new(
                    format!("{code}, by which {effect}"),
                    format!("its last line is {}", dialect.ends().join(" or ")),
                )),
            },
            ProgramEnd::Start => Err(Flaw::new(
                format!("{code}, which ends the program"),
                "only the last line of `gcode.footer` does that",
            )),
        },
        [tool, change @ ..] if tool.letter == 'T' && change.iter().all(|word| word.is("M6")) => chosen(*tool, place),
        words if words.iter().all(|word| group(*word).is_some()) => told_apart(words, dialect),
        words => switched(words, &bare, dialect),
    }
}

/// Line that chooses a tool.
fn chosen(tool: Word, place: ProgramEnd) -> Result<Line, Flaw> {
    let is_tool = |number: f64| (0.0..=TOOL_MAX).contains(&number) && number.fract() == 0.0;
    match tool.number {
        _ if place == ProgramEnd::End => {
            Err(Flaw::new(format!("{tool}, which chooses a tool"), "only `gcode.header` may choose one"))
        }
        Number::Plain(number) if is_tool(number) => Ok(Line::Choice),
        Number::Plain(_) | Number::Blank => {
            Err(Flaw::new(format!("{tool}, which is no tool"), "T is a whole number from 0 on"))
        }
    }
}

/// Modal group of a code that chooses.
fn group(word: Word) -> Option<&'static str> {
    CHOICES.iter().find(|(_, codes)| codes.iter().any(|code| word.is(code))).map(|&(group, _)| group)
}

/// Line of codes that choose, each of another group.
fn told_apart(words: &[Word], dialect: Dialect) -> Result<Line, Flaw> {
    let is_foreign = |word: &&Word| dialect == Dialect::Reprap && !COMMON.iter().any(|code| word.is(code));
    if let Some(word) = words.iter().find(is_foreign) {
        return Err(Flaw::new(format!("{word}, which {} does not know", dialect.title()), "leave it out"));
    }
    for (i, word) in words.iter().enumerate() {
        if let Some(other) = words[..i].iter().find(|other| group(**other) == group(*word)) {
            let both = format!("{other} and {word} on a line");
            return Err(Flaw::new(both, "no interpreter takes two codes of a kind on one: write two lines"));
        }
    }
    Ok(Line::Choice)
}

/// Line that is a single step that moves no axis.
fn switched(words: &[Word], bare: &str, dialect: Dialect) -> Result<Line, Flaw> {
    let is_move = |word: &&Word| matches!(word.letter, 'A'..='C' | 'U'..='Z') || MOVES.iter().any(|code| word.is(code));
    if let Some(word) = words.iter().find(is_move) {
        let hint = "only the program moves axes: `park` says where they go at the end, steps may move Z";
        return Err(Flaw::new(format!("{word}, which moves an axis"), hint));
    }
    match step(words, bare, dialect) {
        Ok(step) if step.has_blank() => Err(Flaw::new(
            format!("{step}, in which no drill is meant"),
            "# stands in `gcode.drill_down` and `gcode.drill_up`",
        )),
        Ok(step) => Ok(Line::Step(step)),
        Err(flaw) => Err(words.iter().find_map(|word| foreign(*word)).unwrap_or(flaw)),
    }
}

/// Step of a line as a dialect spells it: the line is written as it is.
fn step(words: &[Word], bare: &str, dialect: Dialect) -> Result<Step, Flaw> {
    let is_rest = words.first().is_some_and(|code| code.is("G4"));
    let step = match (dialect, words) {
        (Dialect::Reprap, [_, Word { letter: 'S', number: Number::Plain(time) }])
            if is_rest && (0.0..=NUMBER_MAX).contains(time) =>
        {
            Step::Dwell { time: *time }
        }
        (Dialect::Reprap, [_, word, ..]) if is_rest => {
            let why = if word.letter == 'P' { "which would be ms" } else { "which is no time" };
            let hint = "RepRapFirmware takes the seconds of a rest as S, as in G4 S0.5";
            return Err(Flaw::new(format!("G4 {word}, {why}"), hint));
        }
        (Dialect::Rs274 | Dialect::Reprap, _) => Step::read(bare)?,
    };
    step.foreign_to(dialect).map_or(Ok(step), Err)
}

/// Flaw for a word that the program writes itself, or that no text may have.
fn foreign(word: Word) -> Option<Flaw> {
    let hint = match (word.letter, word.to_string().as_str()) {
        ('N', _) => "the program numbers its lines where `gcode.line_numbers` says so",
        ('O', _) => "write what it does, line by line",
        ('F', _) => "every move of the program has its own",
        (_, "G61" | "G61.1" | "G64") => "`gcode.blend_mm` says how the program rounds its way",
        (_, "G93" | "G94" | "G95") => "`gcode.feed_mode` says what F means",
        ('G', _) if !word.is("G4") => {
            "modes are the program's own: mm, absolute places, no offset of a tool; G54 to G59.3 choose where"
        }
        ('M', "M70" | "M71" | "M72" | "M73") => "modes are the program's own",
        ('M', "M2" | "M30") => "it stands on a line of its own, the last one of `gcode.footer`",
        _ => return None,
    };
    Some(Flaw::new(format!("{word}, which has no business there"), hint))
}

/// Line without its comments, or the flaw of one of them.
fn uncommented(line: &str) -> Result<String, Flaw> {
    let mut bare = String::new();
    let mut left = line;
    while let Some(at) = left.find(['(', ';']) {
        bare.push_str(&left[..at]);
        // A comment separates words.
        bare.push(' ');
        let behind = &left[at + 1..];
        let (text, rest) = match &left[at..=at] {
            ";" => (behind, ""),
            _ => behind.split_once(')').ok_or_else(|| {
                Flaw::new("a comment without its other bracket", "controllers stop there: a comment is (...)")
            })?,
        };
        check_comment(text)?;
        left = rest;
    }
    Ok(bare + left)
}

/// Checks that an interpreter neither stops at a comment nor obeys it.
fn check_comment(text: &str) -> Result<(), Flaw> {
    if text.contains('(') {
        return Err(Flaw::new("a comment in a comment", "controllers stop there: brackets do not nest"));
    }
    let first = text.trim_start();
    let first = &first[..first.bytes().take_while(u8::is_ascii_alphabetic).count()];
    if ACTIVE.contains(&first.to_ascii_uppercase().as_str()) {
        let hint = "a comment that begins otherwise is none of the controller's business; (MSG, text) shows a text";
        return Err(Flaw::new(format!("a comment that begins with {first}, which is obeyed"), hint));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_every_interpreter_takes_are_taken() {
        for (place, text) in [
            (ProgramEnd::Start, ""),
            (ProgramEnd::Start, "G54\n(G20 X5) T1 M6\nM49"),
            (ProgramEnd::Start, "G21 G90 G40 G49 G80\nm03 s90"),
            (ProgramEnd::Start, "(a) (b) ; c\n\nM0 (wait)"),
            (ProgramEnd::End, "M2"),
            (ProgramEnd::End, "M9\nG4 P0.5\nM65 P0 (up)\nG80\nM30 (so)\n; it ends"),
        ] {
            let taken = read(text, place, Dialect::Rs274);
            assert!(taken.is_ok(), "{text}: {taken:?}");
        }
        assert_eq!(
            line("(up) m65p0", ProgramEnd::End, Dialect::Rs274),
            Ok(Line::Step("M65 P0".parse().expect("a step")))
        );
    }

    #[test]
    fn what_an_interpreter_refuses_or_what_undoes_the_program_is_named() {
        for (place, text, expected) in [
            (ProgramEnd::Start, "g20", "G20, which has no business there"),
            (ProgramEnd::Start, "G54\nG92 X10", "X10, which moves"),
            (ProgramEnd::Start, "G91", "G91, which has no business there"),
            (ProgramEnd::Start, "G64 P1", "G64, which has no business there"),
            (ProgramEnd::Start, "M30", "M30, which ends"),
            (ProgramEnd::Start, "G0X5", "G0, which moves"),
            (ProgramEnd::Start, "N5 G54", "N5, which has no business there"),
            (ProgramEnd::Start, "%", "`%`, which frames"),
            (ProgramEnd::Start, "#5221=1", "`#`, which computes"),
            (ProgramEnd::Start, "G54 G55", "G54 and G55 on a line"),
            (ProgramEnd::Start, "F100", "F100, which has no business there"),
            (ProgramEnd::Start, "U1", "U1, which moves"),
            (ProgramEnd::Start, "M72", "M72, which has no business there"),
            (ProgramEnd::Start, "M100", "M100, which runs a program"),
            (ProgramEnd::Start, "M64 P#", "M64 P#, in which no drill"),
            (ProgramEnd::Start, "T1.5", "T1.5, which is no tool"),
            (ProgramEnd::Start, "M(a)3", "M without a number"),
            (ProgramEnd::Start, "M0 (a", "a comment without its other bracket"),
            (ProgramEnd::Start, "M0 (a (b)", "a comment in a comment"),
            (ProgramEnd::Start, "(debug, x)", "a comment that begins with debug"),
            (ProgramEnd::Start, "(\u{e9})", "`\\u{e9}`, which no controller reads"),
            (ProgramEnd::End, "G0 X0 Y0\nM2", "G0, which moves"),
            (ProgramEnd::End, "G28\nM2", "G28, which moves"),
            (ProgramEnd::End, "T1\nM2", "T1, which chooses a tool"),
            (ProgramEnd::End, "M5 M2", "M2, which has no business there"),
            (ProgramEnd::End, "M2\nM5", "lines behind its end"),
            (ProgramEnd::End, "M5", "no end of the program"),
        ] {
            let found = read(text, place, Dialect::Rs274).expect_err(text).has;
            assert!(found.starts_with(expected), "{text}: {found}");
        }
        let long = format!("M3 ({})", "x".repeat(LINE_MAX));
        assert!(
            read(&long, ProgramEnd::Start, Dialect::Rs274)
                .expect_err("too long")
                .has
                .starts_with("a line of 205 characters")
        );
    }
    #[test]
    fn lines_are_spelled_as_the_dialect_spells_them() {
        let taken = read("G54\nG17 G21 G90\nG4 S2\nM42 P1 S1", ProgramEnd::Start, Dialect::Reprap).expect("lines");
        assert_eq!(taken[2], Line::Step(Step::Dwell { time: 2.0 }));
        assert!(read("G4 S0.5\nM2", ProgramEnd::End, Dialect::Reprap).is_ok());
        for (place, text, expected) in [
            (ProgramEnd::Start, "G4 P2", "G4 P2, which would be ms"),
            (ProgramEnd::Start, "G4 S-1", "G4 S-1, which is no time"),
            (ProgramEnd::Start, "G54\nG40", "G40, which RepRapFirmware does not know"),
            (ProgramEnd::Start, "M64 P0", "M64 P0, which RepRapFirmware does not know"),
            (ProgramEnd::Start, "M0", "M0, by which RepRapFirmware ends the job"),
            (ProgramEnd::End, "M30", "M30, by which RepRapFirmware deletes a file"),
        ] {
            assert_eq!(read(text, place, Dialect::Reprap).expect_err(text).has, expected);
        }
        let found = read("G4 S2", ProgramEnd::Start, Dialect::Rs274).expect_err("P is meant").has;
        assert_eq!(found, "S2, which G4 does not take");
        let found = read("M42 P1 S1", ProgramEnd::Start, Dialect::Rs274).expect_err("another dialect").has;
        assert_eq!(found, "M42 P1 S1, which RS274/NGC does not know");
    }
}
