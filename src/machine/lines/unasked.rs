//! Lines that would put the knife down where the program believes it up: they belong to `gcode.knife_down` alone.

use super::alike::{Line, line};
use super::words::words;
use super::{Fault, Lines};

/// Keys whose lines stand where the knife is up and stays so.
const UP: [&str; 5] = ["gcode.header", "gcode.drill_up", "gcode.stop", "gcode.advance", "gcode.footer"];

/// Lines of other keys that put the knife down, of each key the first.
pub(super) fn faults(texts: &[Lines]) -> Vec<Fault> {
    let lines = |key: &str| -> Vec<Line> {
        let of_key = texts.iter().copied().filter(|text| text.key == key);
        of_key.flat_map(Lines::lines).filter(|text| switches(text)).map(line).collect()
    };
    let (down, up) = (lines("gcode.knife_down"), lines("gcode.knife_up"));
    let puts_down = |text: &&str| {
        let line = line(text);
        down.contains(&line) && !up.contains(&line)
    };
    let fault = |text: Lines| {
        let found = text.lines().find(puts_down)?;
        let message = format!("`{}` has {found}, which puts the knife down", text.key);
        let hint = "the program believes the knife up there: leave the line to `gcode.knife_down`".to_owned();
        Some(Fault { keys: vec![text.key], message, hint })
    };
    texts.iter().copied().filter(|text| UP.contains(&text.key)).filter_map(fault).collect()
}

/// Whether a line does more than rest, wait or say something.
fn switches(text: &str) -> bool {
    let words = words(text).unwrap_or_default();
    let is = |letter: u8, number: f64| words.iter().any(|word| word.letter == letter && word.number == number);
    !words.is_empty() && !is(b'G', 4.0) && !is(b'M', 66.0)
}

#[cfg(test)]
mod tests {
    use crate::machine::lines::tests::check;

    #[test]
    fn the_knife_is_put_down_by_its_own_lines_alone() {
        check(
            |profile| "(MSG, cloth)\nM64 P0\nG4 P1".clone_into(&mut profile.gcode.advance),
            &["`gcode.advance` has M64 P0, which puts the knife down"],
        );
        check(
            |profile| "M0\np0 m64".clone_into(&mut profile.gcode.stop),
            &["`gcode.stop` has p0 m64, which puts the knife down"],
        );
        check(
            |profile| "G54\nM64 P0".clone_into(&mut profile.gcode.header),
            &["`gcode.header` has M64 P0, which puts the knife down"],
        );
        // What lifts it, too, and what only rests, puts nothing down.
        check(
            |profile| {
                "M64 P7\nG4 P0.05\nM64 P0".clone_into(&mut profile.gcode.knife_down);
                "M65 P0\nM64 P7".clone_into(&mut profile.gcode.knife_up);
                "(go on)\nM64 P7\nG4 P0.05".clone_into(&mut profile.gcode.advance);
            },
            &[],
        );
        check(|profile| "G54\nM64 P6".clone_into(&mut profile.gcode.header), &[]);
    }
}
