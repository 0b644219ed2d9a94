//! Which words a line of a profile may have: codes from a list, each with the words that it takes.
//!
//! The list holds what an interpreter of RS274/NGC takes at every place where the line may stand, and what leaves alone
//! how the program around it is read. What is not in it is refused, whatever it may mean to one controller: a program
//! that another cannot read cannot be tried. Groups are the modal ones of the `LinuxCNC` manual (G-code overview,
//! "Modal groups"): of each a line has one code at the most.

use super::words::Word;
use super::{Flaw, Place};

/// A code that lines may have.
struct Code {
    name: &'static str,
    /// Its modal group; those of M are from 20 on.
    group: u8,
    /// Letters of the words that it must have, and of those that it may have.
    needs: &'static str,
    takes: &'static str,
    at: At,
    acts: bool,
}

/// Where a code may stand.
#[derive(Debug, Clone, Copy, PartialEq)]
enum At {
    Anywhere,
    /// Where no tool is down: at the start, at the end, where the operator or the cloth is waited for.
    Between,
    /// At the start and at the end.
    Ends,
    Start,
    End,
}

impl At {
    fn allows(self, place: Place) -> bool {
        match self {
            Self::Anywhere => true,
            Self::Between => place != Place::Tool,
            Self::Ends => matches!(place, Place::Start | Place::End),
            Self::Start => place == Place::Start,
            Self::End => place == Place::End,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Anywhere => "anywhere",
            Self::Between => "in `gcode.header`, `gcode.stop`, `gcode.advance` and `gcode.footer`",
            Self::Ends => "in `gcode.header` and `gcode.footer`",
            Self::Start => "in `gcode.header`",
            Self::End => "in `gcode.footer`",
        }
    }
}

/// A code that moves or switches something.
const fn act(name: &'static str, group: u8, needs: &'static str) -> Code {
    Code { name, group, needs, takes: "", at: At::Anywhere, acts: true }
}

/// A code that does neither, and stands at some places.
const fn mode(name: &'static str, group: u8, at: At) -> Code {
    Code { name, group, needs: "", takes: "", at, acts: false }
}

/// Every code that lines may have.
const CODES: &[Code] = &[
    Code { takes: AXES, ..act("G0", 1, "") },
    Code { takes: AXES, ..act("G1", 1, "F") },
    Code { needs: "P", ..mode("G4", 0, At::Anywhere) },
    mode("G17", 2, At::Ends),
    mode("G21", 6, At::Ends),
    Code { takes: AXES, ..mode("G28", 0, At::End) },
    Code { takes: AXES, ..mode("G30", 0, At::End) },
    mode("G40", 7, At::Ends),
    mode("G49", 8, At::Ends),
    // A move may be told in the coordinates of the machine.
    mode("G53", 0, At::Anywhere),
    mode("G54", 12, At::Ends),
    mode("G55", 12, At::Ends),
    mode("G56", 12, At::Ends),
    mode("G57", 12, At::Ends),
    mode("G58", 12, At::Ends),
    mode("G59", 12, At::Ends),
    mode("G59.1", 12, At::Ends),
    mode("G59.2", 12, At::Ends),
    mode("G59.3", 12, At::Ends),
    mode("G80", 1, At::Ends),
    mode("G90", 3, At::Ends),
    mode("G91.1", 4, At::Ends),
    mode("G92.1", 0, At::Ends),
    mode("M0", 24, At::Between),
    mode("M1", 24, At::Between),
    mode("M2", 24, At::End),
    act("M3", 27, ""),
    act("M4", 27, ""),
    act("M5", 27, ""),
    mode("M6", 26, At::Start),
    act("M7", 28, ""),
    act("M8", 28, ""),
    act("M9", 28, ""),
    mode("M30", 24, At::End),
    mode("M48", 29, At::Ends),
    mode("M49", 29, At::Ends),
    mode("M60", 24, At::Between),
    act("M64", 25, "P"),
    act("M65", 25, "P"),
    Code { needs: "PLQ", ..mode("M66", 25, At::Anywhere) },
    act("M68", 25, "EQ"),
];

/// Letters of axes: those that every interpreter knows.
const AXES: &str = "XYZABC";
/// Codes that change what every number behind them means, or how the way there is taken.
const UNDOES: &[&str] = &[
    "G7", "G10", "G18", "G19", "G20", "G41", "G42", "G43", "G43.1", "G43.2", "G51", "G52", "G61", "G61.1", "G64",
    "G68", "G70", "G90.1", "G91", "G92", "G93", "G94", "G95", "M70", "M71", "M72", "M73",
];
/// Codes that switch outputs, but only where the next move begins: the knife would come down as it is led on.
const LATE: &[&str] = &["M62", "M63", "M67"];
/// Codes that run programs of the controller's own.
const OWN: std::ops::RangeInclusive<f64> = 100.0..=199.0;
/// Most codes M of a line, as `LinuxCNC` takes them.
const M_MAX: usize = 4;
/// Greatest number of an output or input: controllers have 64 at the most (`LinuxCNC`, motion module, `num_dio`).
const PIN_MAX: f64 = 63.0;
/// Greatest mode of waiting for an input.
const WAIT_MAX: f64 = 4.0;
/// Greatest number of other words; no axis, speed or time of a machine is beyond it.
const NUMBER_MAX: f64 = 1e6;
/// What to write where a code is none of the list.
const WHAT_TO_WRITE: &str =
    "what switches is M64 P, M65 P, M68 E Q, M3 to M5 with S, M7 to M9, or G0 and G1 F with an axis";

/// What a line does.
#[derive(Debug, Default, Clone, Copy)]
pub(super) struct Does {
    /// Whether it moves or switches something.
    pub(super) acts: bool,
    /// How long it rests, s.
    pub(super) rest: f64,
    /// Whether it ends the program.
    pub(super) ends: bool,
}

/// What the words of a line do; otherwise what is wrong with them first. `blade` is the letter of the axis that turns it.
pub(super) fn does(words: &[Word], place: Place, blade: u8) -> Result<Does, Flaw> {
    let codes = codes(words, place)?;
    for (i, word) in words.iter().enumerate().filter(|(_, word)| !is_code(word)) {
        if words[..i].iter().any(|before| before.letter == word.letter) {
            let letter = char::from(word.letter);
            return Err(Flaw::new(
                format!("two words {letter} on a line"),
                "no interpreter takes that: write two lines",
            ));
        }
        taken(word, &codes, (place, blade))?;
    }
    let is_there = |letter: char| words.iter().any(|word| char::from(word.letter) == letter);
    for code in &codes {
        complete(code, &is_there)?;
    }
    let has = |names: &[&str]| codes.iter().any(|code| names.contains(&code.name));
    if has(&["G53"]) && !has(&["G0", "G1"]) {
        return Err(Flaw::new("G53 without G0 or G1", "it stands on the line of a move, as in G53 G0 Z0"));
    }
    let rest = words.iter().find(|word| word.letter == b'P' && has(&["G4"])).map_or(0.0, |word| word.number);
    let acts = codes.iter().any(|code| code.acts) || is_there('S');
    Ok(Does { acts, rest, ends: has(&["M2", "M30"]) })
}

fn is_code(word: &Word) -> bool {
    matches!(word.letter, b'G' | b'M')
}

/// The codes of a line, all of the list and of groups of their own.
fn codes(words: &[Word], place: Place) -> Result<Vec<&'static Code>, Flaw> {
    let mut codes: Vec<&Code> = Vec::new();
    for word in words.iter().filter(|word| is_code(word)) {
        let name = format!("{}{}", char::from(word.letter), word.number);
        let code = CODES.iter().find(|code| code.name == name).ok_or_else(|| unknown(word, &name))?;
        if !code.at.allows(place) {
            return Err(misplaced(word, code.at));
        }
        if let Some(other) = codes.iter().find(|other| other.group == code.group) {
            let both = format!("{} and {} on a line", other.name, code.name);
            return Err(Flaw::new(both, "no interpreter takes two codes of a kind on one: write two lines"));
        }
        codes.push(code);
    }
    if codes.iter().filter(|code| code.name.starts_with('M')).count() > M_MAX {
        return Err(Flaw::new("more than four codes M on a line", "no interpreter takes that: write two lines"));
    }
    Ok(codes)
}

/// What to say of a code that stands where it must not.
fn misplaced(word: &Word, at: At) -> Flaw {
    let text = &word.text;
    match at {
        At::End if matches!(text.as_str(), "G28" | "G30") => {
            Flaw::new(format!("{text}, which moves axes without naming them"), "only `gcode.footer` may move them")
        }
        At::End => {
            Flaw::new(format!("{text}, which ends the program"), "only the last line of `gcode.footer` does that")
        }
        At::Between => Flaw::new(
            format!("{text}, which waits for the operator amid a cut"),
            "`gcode.stop` is what the file stops for",
        ),
        At::Anywhere | At::Ends | At::Start => {
            Flaw::new(format!("{text}, which has no business there"), format!("it may stand {}", at.name()))
        }
    }
}

/// What to say of a code that is none of the list.
fn unknown(word: &Word, name: &str) -> Flaw {
    let text = &word.text;
    let is_any = |list: &[&str]| list.contains(&name);
    if is_any(UNDOES) {
        let hint = match name {
            "G64" | "G61" | "G61.1" => "`gcode.blend_mm` says how the program rounds its way",
            "G93" | "G94" | "G95" => "`gcode.feed_mode` says what F means",
            _ => "modes are the program's own: mm, absolute places, no offset of a tool",
        };
        return Flaw::new(format!("{text}, which undoes what the program says"), hint);
    }
    if is_any(LATE) {
        let hint = "M64, M65 and M68 act at once, before the rest that the knife is given";
        return Flaw::new(format!("{text}, which acts only where the next move begins"), hint);
    }
    if word.letter == b'M' && OWN.contains(&word.number) {
        let hint =
            "the interpreter knows none of those by itself, nor what they do: M64 P0 and M65 P0 switch an output";
        return Flaw::new(format!("{text}, which runs a program of the controller's own"), hint);
    }
    Flaw::new(format!("{text}, which is no code that its lines may have"), WHAT_TO_WRITE)
}

/// Whether a word that is no code may stand on its line.
fn taken(word: &Word, codes: &[&Code], (place, blade): (Place, u8)) -> Result<(), Flaw> {
    if matches!(word.letter, b'S' | b'T') {
        return alone(word, place);
    }
    let (letter, text) = (char::from(word.letter), &word.text);
    let flaw = |why: &str, hint: &str| Err(Flaw::new(format!("{text}{why}"), hint));
    let is_axis = AXES.contains(letter);
    if is_axis && place != Place::End && (matches!(letter, 'X' | 'Y') || word.letter == blade) {
        let hint = "X, Y and the axis of the blade are the program's own; only `gcode.footer` may move them";
        return flaw(", which undoes what the program says", hint);
    }
    let has = |name: &str| codes.iter().any(|code| code.name == name);
    let takers = codes.iter().filter(|code| code.needs.contains(letter) || code.takes.contains(letter)).count();
    match (takers, letter) {
        (0, 'N') => flaw(", a number of a line", "the program numbers its lines where `gcode.line_numbers` says so"),
        (0, 'O') => flaw(", which calls another program", "write what it does, line by line"),
        (0, 'U' | 'V' | 'W') => flaw(", an axis that not every interpreter knows", "axes are X, Y, Z, A, B and C"),
        (0, _) if is_axis => flaw(" without G0 or G1", "each line is complete, as in G0 Z-2 or G1 Z-2 F600"),
        (0, 'F') if has("G0") => flaw(" beside G0", "G0 goes as fast as it can"),
        (0, 'F') => flaw(" without G1", "F stands on the line of its move, as in G1 Z-2 F600"),
        (0, 'P' | 'E' | 'L' | 'Q') => {
            flaw(" without its code", "each line is complete, as in M64 P0, M68 E0 Q5 or G4 P0.5")
        }
        (0, _) => flaw(", which no code of its line takes", WHAT_TO_WRITE),
        (1, _) => within(word, &has),
        _ => flaw(", which two codes of its line take", "write two lines"),
    }
}

/// Whether a word that needs no code may stand there: the speed of a spindle, a tool.
fn alone(word: &Word, place: Place) -> Result<(), Flaw> {
    let flaw = |why: &str, hint: &str| Err(Flaw::new(format!("{}{why}", word.text), hint));
    match word.letter {
        b'T' if place != Place::Start => flaw(", which chooses a tool", "only `gcode.header` may choose one"),
        b'T' if !is_whole(word.number, NUMBER_MAX) => flaw(", which is no tool", "T is a whole number from 0 on"),
        _ if !(0.0..=NUMBER_MAX).contains(&word.number) => flaw(", which is no speed", "S is from 0 on"),
        _ => Ok(()),
    }
}

/// Whether the number of a word is one that its code takes.
fn within(word: &Word, has: &dyn Fn(&str) -> bool) -> Result<(), Flaw> {
    let flaw = |why: &str, hint: &str| Err(Flaw::new(format!("{}{why}", word.text), hint));
    match word.letter {
        b'F' if word.number <= 0.0 => flaw(", which is no speed", "F is above 0"),
        b'P' if has("G4") && word.number < 0.0 => flaw(", which is no time", "P of G4 is from 0 on, in seconds"),
        b'P' | b'E' if !has("G4") && !is_whole(word.number, PIN_MAX) => {
            flaw(", which is no output", "outputs and inputs are counted from 0 to 63")
        }
        b'L' if word.number < 1.0 || !is_whole(word.number, WAIT_MAX) => {
            flaw(", which is no way to wait", "L of M66 is 1 to 4: for an edge up or down, a level high or low")
        }
        b'Q' if has("M66") && word.number <= 0.0 => flaw(", which is no time", "Q of M66 is above 0, in seconds"),
        _ if word.number.abs() > NUMBER_MAX => flaw(", which is beyond every machine", "is it mistyped?"),
        _ => Ok(()),
    }
}

fn is_whole(number: f64, most: f64) -> bool {
    (0.0..=most).contains(&number) && number.fract() == 0.0
}

/// Whether a code has all words that it needs.
fn complete(code: &Code, is_there: &dyn Fn(char) -> bool) -> Result<(), Flaw> {
    let name = code.name;
    let takes_axes = code.acts && code.takes == AXES;
    if takes_axes && !AXES.chars().any(is_there) {
        return Err(Flaw::new(format!("{name} without an axis"), "a move names its axis, as in G0 Z-2 or G1 Z-2 F600"));
    }
    if let Some(letter) = code.needs.chars().find(|&letter| !is_there(letter)) {
        let hint = match letter {
            'F' => "no F is in force there, or that of a cut: write its own, as in G1 Z-2 F600, or G0 Z-2".to_owned(),
            _ => format!("each line is complete, as in {}", example(name)),
        };
        return Err(Flaw::new(format!("{name} without {letter}"), hint));
    }
    Ok(())
}

/// A line with all words that a code needs.
fn example(name: &str) -> String {
    match name {
        "M68" => "M68 E0 Q5".to_owned(),
        "G4" => "G4 P0.5".to_owned(),
        "M66" => "M66 P0 L3 Q10".to_owned(),
        _ => format!("{name} P0"),
    }
}
