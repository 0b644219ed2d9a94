//! Lines of keys that cannot be told apart: who reads a program knows what it does by the first line of each key.

use super::words::words;
use super::{DRILLS, Fault, Lines};

/// Lines that do one thing.
struct Order {
    key: &'static str,
    /// The drill that it is about, when its lines name one.
    drill: Option<u8>,
    lines: Vec<Line>,
}

/// A line as it is told from others: its words in any order, or its text where it has none.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Line {
    Words(Vec<(u8, f64)>),
    Comment(String),
}

/// What lines of keys do not tell apart.
pub(super) fn faults(texts: &[Lines]) -> Vec<Fault> {
    let orders: Vec<Order> = texts.iter().copied().flat_map(orders).collect();
    let mut faults: Vec<Fault> = Vec::new();
    for (i, order) in orders.iter().enumerate() {
        for before in &orders[..i] {
            let keys = keys_of(before, order);
            // What lifts is told by the drill that is down; what puts one down by its first line alone.
            let are_read = before.key != order.key || order.key == "gcode.drill_down";
            // Of the drills the first is enough.
            if are_read && faults.iter().all(|fault| fault.keys != keys) && mixed_up(before, order) {
                faults.push(fault(before, order));
            }
        }
    }
    faults
}

/// The keys of two orders, which may be those of two drills.
fn keys_of(a: &Order, b: &Order) -> Vec<&'static str> {
    if a.key == b.key { vec![a.key] } else { vec![a.key, b.key] }
}

/// What a key orders: a drill's lines hold its number.
fn orders(text: Lines) -> Vec<Order> {
    let lines = |text: &str| text.lines().map(str::trim).filter(|line| !line.is_empty()).map(line).collect::<Vec<_>>();
    let is_drill = text.key.starts_with("gcode.drill") && text.text.contains('#');
    let orders = if is_drill {
        let of = |drill: u8| (Some(drill), lines(&text.text.replace('#', &drill.to_string())));
        DRILLS.map(of).collect()
    } else {
        vec![(None, lines(text.text))]
    };
    // The head is read where it stands.
    let is_told = |(_, lines): &(_, Vec<Line>)| !lines.is_empty() && text.key != "gcode.header";
    orders.into_iter().filter(is_told).map(|(drill, lines)| Order { key: text.key, drill, lines }).collect()
}

/// A line as it is told from others.
pub(super) fn line(text: &str) -> Line {
    let mut words: Vec<_> =
        words(text).unwrap_or_default().into_iter().map(|word| (word.letter, word.number)).collect();
    words.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    if words.is_empty() { Line::Comment(text.to_owned()) } else { Line::Words(words) }
}

/// Whether a reader would take the one for the other.
fn mixed_up(a: &Order, b: &Order) -> bool {
    // What lifts both lifts the one that is down.
    let lifts = |order: &Order| matches!(order.key, "gcode.knife_up" | "gcode.drill_up");
    a.lines[0] == b.lines[0] && !(lifts(a) && lifts(b) && a.lines == b.lines)
}

fn fault(a: &Order, b: &Order) -> Fault {
    let keys = keys_of(a, b);
    let of = |order: &Order| order.drill.map_or(String::new(), |drill| format!(" of drill {drill}"));
    let both = format!("`{}`{} and `{}`{}", a.key, of(a), b.key, of(b));
    let message = if a.lines == b.lines { format!("{both} say the same") } else { format!("{both} begin alike") };
    let is = |key: &str| keys.contains(&key);
    let hint = if a.key == b.key {
        "write # in the first line, as in M64 P#, or a comment before it, such as (drill #)"
    } else if is("gcode.footer") {
        "leave that line out of `gcode.footer`: the program has lifted the knife before it"
    } else if is("gcode.drill_down") || is("gcode.drill_up") {
        "give the drills other lines; where there are none, gcode.drill_down = \"\" and gcode.drill_up = \"\""
    } else if is("gcode.stop") || is("gcode.advance") {
        "put a comment of its own before it, such as (MSG, the cloth is advanced)"
    } else {
        "the controller must be told apart what goes down and what is lifted"
    };
    Fault { keys, message, hint: hint.to_owned() }
}

#[cfg(test)]
mod tests {
    use crate::machine::lines::tests::check;

    #[test]
    fn lines_of_two_keys_begin_otherwise() {
        check(|_| (), &[]);
        check(
            |profile| "P0 M064".clone_into(&mut profile.gcode.knife_up),
            &["`gcode.knife_down` and `gcode.knife_up` say the same"],
        );
        check(
            |profile| "M64 P2".clone_into(&mut profile.gcode.knife_down),
            &["`gcode.knife_down` and `gcode.drill_down` of drill 2 say the same"],
        );
        check(
            |profile| {
                let keys = &mut profile.gcode;
                for (key, line) in [
                    (&mut keys.knife_down, "G0 Z-2"),
                    (&mut keys.knife_up, "G0 Z5"),
                    (&mut keys.drill_down, "G0 Z-#0"),
                    (&mut keys.drill_up, "G0 Z5"),
                    (&mut keys.footer, "G0 Z50\nM2"),
                ] {
                    line.clone_into(key);
                }
            },
            &[],
        );
        check(
            |profile| "M65 P0\nM2".clone_into(&mut profile.gcode.footer),
            &["`gcode.knife_up` and `gcode.footer` begin alike"],
        );
        check(
            |profile| "(drill)\nM64 P#".clone_into(&mut profile.gcode.drill_down),
            &["`gcode.drill_down` of drill 1 and `gcode.drill_down` of drill 2 begin alike"],
        );
        check(
            |profile| "G4 P0.02 (drill #)\nM64 P#".clone_into(&mut profile.gcode.drill_down),
            &["`gcode.drill_down` of drill 1 and `gcode.drill_down` of drill 2 begin alike"],
        );
        check(|profile| "(drill #)\nG4 P0.02\nM64 P#".clone_into(&mut profile.gcode.drill_down), &[]);
        check(|profile| "(up)\nM65 P#".clone_into(&mut profile.gcode.drill_up), &[]);
        check(
            |profile| "M0".clone_into(&mut profile.gcode.advance),
            &["`gcode.stop` and `gcode.advance` say the same"],
        );
        check(|profile| "(MSG, go on)\nM0".clone_into(&mut profile.gcode.advance), &[]);
    }
}
