//! Rules for the steps of a profile, for each list and between lists, and for what F means. A reader of a program must know
//! which tool is down from the first step of each list, and a tool that is put down must be lifted again.

use super::step::{Parameter, Step, WHAT_ACTS};
use super::text::{self, Line, ProgramEnd};
use super::words::{Flaw, Number};
use super::{Dialect, FeedMode, Gcode, Moves};
use crate::machine::MachineProfile;
use crate::machine::fault::Fault;

/// Numbers of drills.
const DRILLS: std::ops::RangeInclusive<u8> = 1..=4;
/// M codes that wait for the operator.
const WAITS: [u8; 4] = [0, 1, 60, 226];

/// Steps of a key.
struct List<'a> {
    key: &'static str,
    steps: &'a [Step],
    of: Of,
}

/// Purpose of a list.
#[derive(Debug, Clone, Copy)]
enum Of {
    /// Puts a tool down or lifts it.
    Tool { is_drill: bool, longest_rest: f64, rest_key: &'static str },
    /// Waits for the operator or the cloth; no tool is down.
    Pause,
}

/// All lists of a profile.
fn lists(profile: &MachineProfile) -> [List<'_>; 6] {
    let (keys, knife) = (&profile.gcode, &profile.knife);
    let tool = |is_drill, longest_rest, rest_key| Of::Tool { is_drill, longest_rest, rest_key };
    let list = |key, steps, of| List { key, steps, of };
    [
        list("gcode.knife_down", &keys.knife_down, tool(false, knife.plunge(), "knife.plunge_ms")),
        list("gcode.knife_up", &keys.knife_up, tool(false, knife.lift(), "knife.lift_ms")),
        list("gcode.drill_down", &keys.drill_down, tool(true, profile.drill.dwell(), "drill.dwell_ms")),
        list("gcode.drill_up", &keys.drill_up, tool(true, knife.lift(), "knife.lift_ms")),
        list("gcode.stop", &keys.stop, Of::Pause),
        list(ADVANCE, &keys.advance, Of::Pause),
    ]
}

/// Faults in the steps and texts of a profile: the first one of each key; contradictions between keys only if there is none.
pub(in crate::machine) fn faults(profile: &MachineProfile) -> Vec<Fault> {
    let keys = &profile.gcode;
    let lists = lists(profile);
    let fault = |key: &str, flaw: Flaw| Fault::of_range(&[key], format!("`{key}` has {}", flaw.has), &flaw.hint);
    let mut faults: Vec<Fault> =
        lists.iter().filter_map(|list| Some(fault(list.key, flaw_of(list, keys.dialect)?))).collect();
    let mut read = |key: &str, text: &str, place: ProgramEnd| {
        let lines = text::read(text, place, keys.dialect);
        lines.unwrap_or_else(|flaw| {
            faults.push(fault(key, flaw));
            Vec::new()
        })
    };
    let header = read("gcode.header", &keys.header, ProgramEnd::Start);
    let footer = read("gcode.footer", &keys.footer, ProgramEnd::End);
    faults.extend(unknown_blend(keys));
    if faults.is_empty() {
        faults = mixed_up(&lists, &footer);
        faults.extend(lasting(&lists));
        faults.extend(shared_output(&lists));
        faults.extend(unasked(&lists, [("gcode.header", header), ("gcode.footer", footer)]));
        faults.extend(mistimed(keys));
        faults.extend(lists.iter().filter_map(|list| hasty(list, keys)));
        faults.extend(lists.iter().filter_map(|list| inverse_feed(list, keys)));
        faults.extend([[0, 1], [2, 3]].into_iter().filter_map(|[down, up]| upside_down(&lists[down], &lists[up])));
        // The first fault of a key is enough.
        let mut told: Vec<String> = Vec::new();
        faults.retain(|fault| {
            let is_new = !fault.keys.iter().any(|key| told.contains(key));
            told.extend(fault.keys.iter().cloned());
            is_new
        });
    }
    faults
}

/// Fault of a list by itself.
fn flaw_of(list: &List, dialect: Dialect) -> Option<Flaw> {
    if let Some(flaw) = list.steps.iter().find_map(|step| step.foreign_to(dialect)) {
        return Some(flaw);
    }
    let is_wait = |step: &&Step| matches!(step, Step::Code { m, .. } if WAITS.contains(m));
    let is_needed = matches!(list.key, "gcode.knife_down" | "gcode.knife_up");
    match list.of {
        Of::Pause if list.key == ADVANCE => way_of_cloth(list.steps),
        Of::Tool { is_drill: false, .. } | Of::Pause if list.steps.iter().any(Step::has_blank) => Some(Flaw::new(
            "#, but means no drill",
            "# stands in `gcode.drill_down`, `gcode.drill_up` and `gcode.advance`",
        )),
        Of::Pause => None,
        Of::Tool { .. } if list.steps.is_empty() => {
            let hint = "give what puts the knife down and lifts it, such as [\"M3\"] and [\"M5\"]";
            is_needed.then(|| Flaw::new("no step", hint))
        }
        Of::Tool { longest_rest, rest_key, .. } => {
            // A rest out of its own range is reported at its own key.
            let longest_rest = longest_rest.max(0.0);
            if let Some(wait) = list.steps.iter().find(is_wait) {
                let has = format!("{wait}, which waits for the operator amid a cut");
                return Some(Flaw::new(has, "`gcode.stop` is what the file stops for"));
            }
            if list.steps.iter().all(|step| what(step).is_none()) {
                return Some(Flaw::new("no step that moves or switches something", WHAT_ACTS));
            }
            let rest: f64 =
                list.steps.iter().map(|step| if let Step::Dwell { time } = step { *time } else { 0.0 }).sum();
            (rest > longest_rest).then(|| {
                let has = format!("rests of {rest} s, longer than `{rest_key}`, {longest_rest} s");
                Flaw::new(has, format!("the program rests as long as `{rest_key}` says by itself"))
            })
        }
    }
}

/// Key of the list that may tell the distance that the cloth advances.
const ADVANCE: &str = "gcode.advance";

/// Fault if the advance of the cloth is told in another way than as the value of an analog output by the first step: the later
/// steps start the conveyor and wait for it.
fn way_of_cloth(steps: &[Step]) -> Option<Flaw> {
    let hint = "the first one tells the mm of an advance, as in [\"M68 E0 Q#\", \"M64 P1\"]";
    let (first, others) = steps.split_first()?;
    if others.iter().any(Step::has_blank) {
        return Some(Flaw::new("# behind its first step", hint));
    }
    let is_value = |word: &Parameter| word.letter == 'Q' || word.number != Number::Blank;
    let is_output = matches!(first, Step::Code { m: 68, parameters } if parameters.iter().all(is_value));
    (first.has_blank() && !is_output).then(|| Flaw::new(format!("{first}, where # is no value of an output"), hint))
}

/// Faults of lists that set the analog output by which the advance of the cloth is told.
fn shared_output(lists: &[List]) -> Vec<Fault> {
    let [others @ .., advance] = lists else { return Vec::new() };
    let Some(told) = advance.steps.first().filter(|step| step.has_blank()).and_then(what) else { return Vec::new() };
    let sets = |list: &&List| list.steps.iter().any(|step| what(step) == Some(told));
    let fault = |list: &List| {
        let message = format!("`{}` sets the output by which `{ADVANCE}` tells the way of the cloth", list.key);
        Fault::of_range(&[list.key, ADVANCE], message, "give the way of the cloth an analog output of its own")
    };
    others.iter().filter(sets).map(fault).collect()
}

/// Actuator on which a step acts.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Actuator {
    Output(f64),
    Analog(f64),
    Spindle,
    Coolant,
    Z,
}

/// Actuator that a step moves or switches, with 0 for `#`; `None` if it rests or waits.
fn what(step: &Step) -> Option<Actuator> {
    match step {
        Step::Output { pin, .. } => Some(Actuator::Output(pin.of(0.0))),
        Step::Code { m: 42, parameters } => {
            parameters.iter().find(|word| word.letter == 'P').map(|word| Actuator::Output(word.number.of(0.0)))
        }
        Step::Z { .. } => Some(Actuator::Z),
        Step::Code { m: 3..=5, .. } => Some(Actuator::Spindle),
        Step::Code { m: 7..=9, .. } => Some(Actuator::Coolant),
        Step::Code { m: 68, parameters } => {
            parameters.iter().find(|word| word.letter == 'E').map(|word| Actuator::Analog(word.number.of(0.0)))
        }
        Step::Dwell { .. } | Step::Code { .. } => None,
    }
}

/// Steps as they are in a program, with the number of a drill where they name one.
struct Order {
    key: &'static str,
    drill: Option<u8>,
    steps: Vec<Step>,
}

impl Order {
    /// Steps of a list, once for every drill that they name.
    fn all(list: &List) -> Vec<Self> {
        let order = |drill: Option<u8>| {
            let steps =
                list.steps.iter().map(|step| drill.map_or_else(|| step.clone(), |drill| step.filled(drill.into())));
            Self { key: list.key, drill, steps: steps.collect() }
        };
        if list.steps.iter().any(Step::has_blank) { DRILLS.map(Some).map(order).collect() } else { vec![order(None)] }
    }

    fn lifts(&self) -> bool {
        matches!(self.key, "gcode.knife_up" | "gcode.drill_up")
    }

    /// True if a reader of the first step of one could take it for the other.
    fn begins_as(&self, other: &Self) -> bool {
        // A lift shared by several tools lifts the one that is down.
        let are_one = self.lifts() && other.lifts() && self.steps == other.steps;
        !are_one && self.steps.first().is_some_and(|first| other.steps.first() == Some(first))
    }
}

/// Faults of lists with the same first step.
fn mixed_up(lists: &[List], footer: &[Line]) -> Vec<Fault> {
    let mut orders: Vec<Order> = lists.iter().flat_map(Order::all).collect();
    if let Some(Line::Step(step)) = footer.first() {
        orders.push(Order { key: "gcode.footer", drill: None, steps: vec![step.clone()] });
    }
    let mut faults = Vec::new();
    for (i, order) in orders.iter().enumerate() {
        for before in &orders[..i] {
            // A lift is recognised by the drill that is down, a plunge only by its first step.
            let are_read = before.key != order.key || order.key == "gcode.drill_down";
            if are_read && before.begins_as(order) {
                faults.push(said_alike(before, order));
            }
        }
    }
    faults
}

fn said_alike(a: &Order, b: &Order) -> Fault {
    let of = |order: &Order| order.drill.map_or(String::new(), |drill| format!(" of drill {drill}"));
    let both = format!("`{}`{} and `{}`{}", a.key, of(a), b.key, of(b));
    let message = if a.steps == b.steps { format!("{both} are the same") } else { format!("{both} begin alike") };
    let is = |keys: [&str; 2]| keys.contains(&a.key) || keys.contains(&b.key);
    let hint = if a.key == b.key {
        "write # in the first step, as in M64 P#"
    } else if is(["gcode.footer"; 2]) {
        "leave that line out of `gcode.footer`: the program has lifted the knife before it"
    } else if is(["gcode.drill_down", "gcode.drill_up"]) {
        "give the drills other steps; where there are none, gcode.drill_down = [] and gcode.drill_up = []"
    } else if is(["gcode.stop", "gcode.advance"]) {
        "let one of them begin with a step of its own, such as M1 in place of M0"
    } else {
        "the controller must be told apart what goes down and what is lifted"
    };
    let keys = if a.key == b.key { vec![a.key] } else { vec![a.key, b.key] };
    Fault::of_range(&keys, message, hint)
}

/// Faults of lists that leave something on: the lists of the knife must undo each other, and the lift of a drill its plunge.
fn lasting(lists: &[List]) -> Vec<Fault> {
    let [knife_down, knife_up, drill_down, drill_up, ..] = lists else { return Vec::new() };
    let mut faults = Vec::new();
    for (list, other) in [(knife_down, knife_up), (knife_up, knife_down), (drill_down, drill_up)] {
        // A drill without steps is refused where it is used.
        let has_both = !list.steps.is_empty() && !other.steps.is_empty();
        let drills = if list.key == drill_down.key { DRILLS } else { 1..=1 };
        let kept = drills.filter(|_| has_both).find_map(|drill| {
            let told = |list: &List| list.steps.iter().map(|step| step.filled(drill.into())).collect::<Vec<_>>();
            left_on(&told(list), &told(other)).map(|step| (drill, step))
        });
        if let Some((drill, step)) = kept {
            let of = if list.key == drill_down.key { format!(" of drill {drill}") } else { String::new() };
            let message = format!("`{}` does not undo {step}{of} in `{}`", other.key, list.key);
            let hint =
                "what one switches or moves the other takes back: M64 P0 and M65 P0, M3 and M5, G0 Z-2 and G0 Z5";
            faults.push(Fault::of_range(&[list.key, other.key], message, hint));
        }
    }
    faults
}

/// First step of a list whose effect outlasts the other list. A step that is switched on and off again within a list is a
/// pulse, as for valves with two coils, and its effect is the valve's own.
fn left_on(steps: &[Step], other: &[Step]) -> Option<Step> {
    let last = |steps: &[Step], acts_on: Actuator| steps.iter().rev().find(|step| what(step) == Some(acts_on)).cloned();
    let is_pulse = |acts_on: Actuator, last: &Step| {
        steps.iter().any(|step| what(step) == Some(acts_on) && step != last && acts_on != Actuator::Z)
    };
    steps.iter().find_map(|step| {
        let acts_on = what(step)?;
        let state = last(steps, acts_on)?;
        let is_undone = last(other, acts_on).is_some_and(|undone| undone != state);
        (!is_undone && !is_pulse(acts_on, &state)).then_some(state)
    })
}

/// Faults of steps in other keys that put the knife down where the program believes it up.
fn unasked(lists: &[List], texts: [(&'static str, Vec<Line>); 2]) -> Vec<Fault> {
    let of = |key: &str| lists.iter().find(|list| list.key == key).map_or(&[][..], |list| list.steps);
    let (down, up) = (of("gcode.knife_down"), of("gcode.knife_up"));
    let puts_down = |step: &Step| what(step).is_some() && down.contains(step) && !up.contains(step);
    let others = ["gcode.drill_up", "gcode.stop", "gcode.advance"].map(|key| (key, of(key).to_vec()));
    let step = |line: Line| if let Line::Step(step) = line { Some(step) } else { None };
    let texts = texts.map(|(key, lines)| (key, lines.into_iter().filter_map(step).collect()));
    let fault = |(key, steps): (&'static str, Vec<Step>)| {
        let step = steps.into_iter().find(puts_down)?;
        let message = format!("`{key}` has {step}, which puts the knife down");
        Some(Fault::of_range(
            &[key],
            message,
            "the program believes the knife up there: leave it to `gcode.knife_down`",
        ))
    };
    others.into_iter().chain(texts).filter_map(fault).collect()
}

/// Fault of a tolerance of the path in a dialect without G64.
fn unknown_blend(keys: &Gcode) -> Option<Fault> {
    let blend = match keys.dialect {
        Dialect::Rs274 => return None,
        Dialect::Reprap => keys.blend_mm?,
    };
    let message = format!("`gcode.blend_mm` is {blend} mm, but {} does not know G64", keys.dialect.title());
    Some(Fault::of_range(&["gcode.blend_mm", "gcode.dialect"], message, "take `gcode.blend_mm = \"off\"`"))
}

/// Fault of arcs in inverse time on a controller that mistimes them.
fn mistimed(keys: &Gcode) -> Option<Fault> {
    (keys.moves == Moves::Fixed && keys.mistimes_arcs()).then(|| {
        let (who, hint, others) = match keys.dialect {
            Dialect::Rs274 => {
                let hint = "take \"G94\" or `gcode.arcs = false`; others have `gcode.feed_counts = \"linear\"`";
                ("the grbl family", hint, "gcode.feed_counts")
            }
            Dialect::Reprap => ("RepRapFirmware", "take \"G94\" or `gcode.arcs = false`", "gcode.dialect"),
        };
        let message = format!("`gcode.feed_mode` is \"G93\" with arcs, which {who} mistimes");
        Fault::of_range(&["gcode.feed_mode", "gcode.arcs", others], message, hint)
    })
}

/// Fault of a list with a step that acts when it is read, straight behind a move of Z.
fn hasty(list: &List, keys: &Gcode) -> Option<Fault> {
    let pair = list.steps.windows(2).find(|pair| matches!(pair[0], Step::Z { .. }) && keys.must_stand(&pair[1..]))?;
    let message = format!("`{}` has {} behind {}, for which it does not wait", list.key, pair[1], pair[0]);
    let hint = "put a rest between them, such as G4 P0.01, or see `gcode.outputs`";
    Some(Fault::of_range(&[list.key, "gcode.outputs"], message, hint))
}

/// Fault of a list with a feed of Z in inverse time: there F is the inverse of the time of a move, and not a speed.
fn inverse_feed(list: &List, keys: &Gcode) -> Option<Fault> {
    let is_inverse = keys.moves == Moves::Fixed && keys.feed_mode == FeedMode::G93;
    let step = list.steps.iter().find(|step| step.has_feed()).filter(|_| is_inverse)?;
    let message = format!("`{}` has {step}, whose F is no speed where `gcode.feed_mode` is \"G93\"", list.key);
    let hint = "G0 moves Z as fast as the controller lets it: set the speed of Z there";
    Some(Fault::of_range(&[list.key, "gcode.feed_mode"], message, hint))
}

/// Fault of a tool that Z lifts to no more than where it puts it down. Z counts upwards (ISO 841).
fn upside_down(down: &List, up: &List) -> Option<Fault> {
    let end = |list: &List| {
        let to = |step: &Step| if let Step::Z { to_mm, .. } = step { Some(*to_mm) } else { None };
        list.steps.iter().rev().find_map(to)
    };
    let (low, high) = end(down).zip(end(up))?;
    (high <= low).then(|| {
        let message = format!("`{}` lifts Z to {high} mm, and `{}` puts it down to {low} mm", up.key, down.key);
        Fault::of_range(&[down.key, up.key], message, "Z counts upwards: the higher place is the lifted one")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks the faults of the default profile with other steps (separated by commas) or texts.
    fn check(changes: &[(&str, &str)], expected: &[&str]) {
        let mut profile = MachineProfile::default();
        for (key, value) in changes {
            let gcode = &mut profile.gcode;
            let list = match *key {
                "header" => return_text(&mut gcode.header, value),
                "footer" => return_text(&mut gcode.footer, value),
                "knife_down" => Some(&mut gcode.knife_down),
                "knife_up" => Some(&mut gcode.knife_up),
                "drill_down" => Some(&mut gcode.drill_down),
                "drill_up" => Some(&mut gcode.drill_up),
                "stop" => Some(&mut gcode.stop),
                _ => Some(&mut gcode.advance),
            };
            let steps = || value.split(", ").filter(|step| !step.is_empty()).map(|step| step.parse().expect("a step"));
            if let Some(list) = list {
                *list = steps().collect();
            }
        }
        let found: Vec<String> = faults(&profile).into_iter().map(|fault| fault.message).collect();
        assert_eq!(found, expected, "{changes:?}");
    }

    fn return_text<'a>(key: &mut String, text: &str) -> Option<&'a mut Vec<Step>> {
        text.clone_into(key);
        None
    }

    #[test]
    fn lists_of_all_kinds_of_machines_are_taken() {
        for changes in [
            &[][..],
            &[("knife_down", "M3 S1000"), ("knife_up", "M5")],
            &[("knife_down", "M3 S90"), ("knife_up", "M3 S10")],
            &[("knife_down", "M64 P5, M65 P6"), ("knife_up", "M64 P6, M65 P5")],
            &[("knife_down", "M64 P5, G4 P0.05, M65 P5"), ("knife_up", "M64 P6, G4 P0.05, M65 P6")],
            &[("knife_down", "M68 E0 Q5"), ("knife_up", "M68 E0 Q-5")],
            &[("knife_down", "G0 Z0, G1 Z-2 F300"), ("knife_up", "G0 Z5")],
            &[("drill_down", ""), ("drill_up", "")],
            &[("drill_up", "M65 P1, M65 P2, M65 P3, M65 P4")],
            &[("drill_down", "M3 S#, G1 Z-5 F200"), ("drill_up", "G0 Z5, M5")],
            &[("header", "G54\nM64 P6"), ("footer", "M9\nM2")],
            &[("advance", "M64 P5, G4 P0.5, M65 P5, M66 P1 L3 Q2")],
        ] {
            check(changes, &[]);
        }
    }

    #[test]
    fn what_is_said_of_drills_and_waits_is_true() {
        let about = |name: &str| crate::machine::keys::find(name).expect("a key").about;
        assert!(about("gcode.drill_down").contains(&format!("{} to {}", DRILLS.start(), DRILLS.end())));
        assert!(WAITS.iter().all(|m| about("gcode.stop").contains(&format!("M{m}"))));
    }

    #[test]
    fn a_list_does_what_it_is_for() {
        check(&[("knife_up", "")], &["`gcode.knife_up` has no step"]);
        check(&[("knife_down", "G4 P0.05")], &["`gcode.knife_down` has no step that moves or switches something"]);
        let rests = "`gcode.knife_down` has rests of 5 s, longer than `knife.plunge_ms`, 0.08 s";
        check(&[("knife_down", "M64 P0, G4 P5")], &[rests]);
        let waits = "`gcode.knife_down` has M0, which waits for the operator amid a cut";
        check(&[("knife_down", "M64 P0, M0")], &[waits]);
        check(&[("stop", "M64 P#")], &["`gcode.stop` has #, but means no drill"]);
        check(&[("footer", "M5")], &["`gcode.footer` has no end of the program"]);
    }

    #[test]
    fn what_lifts_a_tool_leads_upwards() {
        let knife = "`gcode.knife_up` lifts Z to -2 mm, and `gcode.knife_down` puts it down to 5 mm";
        check(&[("knife_down", "G0 Z5"), ("knife_up", "G0 Z-2")], &[knife]);
        let drill = "`gcode.drill_up` lifts Z to -7 mm, and `gcode.drill_down` puts it down to -5 mm";
        check(&[("drill_down", "M3 S#, G1 Z-5 F200"), ("drill_up", "G0 Z-7, M5")], &[drill]);
    }

    #[test]
    fn steps_are_those_of_the_dialect() {
        let mut profile = MachineProfile::default();
        profile.gcode.dialect = Dialect::Reprap;
        profile.gcode.footer = "M30".to_owned();
        let found = |profile: &MachineProfile| -> Vec<String> {
            faults(profile).into_iter().map(|fault| fault.message).collect()
        };
        let unknown = |key: &str, step: &str| format!("`gcode.{key}` has {step}, which RepRapFirmware does not know");
        let expected = [
            unknown("knife_down", "M64 P0"),
            unknown("knife_up", "M65 P0"),
            unknown("drill_down", "M64 P#"),
            unknown("drill_up", "M65 P#"),
            "`gcode.stop` has M0, by which RepRapFirmware ends the job".to_owned(),
            "`gcode.advance` has M1, by which RepRapFirmware ends the job".to_owned(),
            "`gcode.footer` has M30, by which RepRapFirmware deletes a file".to_owned(),
            "`gcode.blend_mm` is 0.05 mm, but RepRapFirmware does not know G64".to_owned(),
        ];
        assert_eq!(found(&profile), expected);
        check(&[("stop", "M226")], &["`gcode.stop` has M226, which RS274/NGC does not know"]);
        let set = "`gcode.advance` has M42 P5 S1, which RS274/NGC does not know";
        check(&[("advance", "M42 P5 S1, M42 P5 S0")], &[set]);
    }

    #[test]
    fn a_feed_of_z_is_a_speed() {
        let mut profile = MachineProfile::default();
        profile.gcode.feed_mode = FeedMode::G93;
        profile.gcode.knife_down = vec!["G1 Z-2 F600".parse().expect("a step")];
        profile.gcode.knife_up = vec!["G0 Z5".parse().expect("a step")];
        let found: Vec<String> = faults(&profile).into_iter().map(|fault| fault.message).collect();
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].starts_with("`gcode.knife_down` has G1 Z-2 F600, whose F is no speed"), "{found:?}");
        profile.gcode.feed_mode = FeedMode::G94;
        assert!(faults(&profile).is_empty());
    }

    #[test]
    fn lists_of_two_keys_begin_otherwise() {
        check(&[("knife_up", "M64 P0")], &["`gcode.knife_down` and `gcode.knife_up` are the same"]);
        let drill = "`gcode.knife_down` and `gcode.drill_down` of drill 2 are the same";
        check(&[("knife_down", "M64 P2"), ("knife_up", "M65 P2")], &[drill]);
        let footer = "`gcode.knife_up` and `gcode.footer` begin alike";
        check(&[("footer", "M65 P0\nM2")], &["`gcode.knife_up` and `gcode.footer` are the same"]);
        check(&[("knife_up", "M65 P0, M9"), ("knife_down", "M64 P0, M8"), ("footer", "(up) m65p0\nM2")], &[footer]);
        let drills = "`gcode.drill_down` of drill 1 and `gcode.drill_down` of drill 2 begin alike";
        check(&[("drill_down", "G4 P0.02, M64 P#")], &[drills]);
        check(&[("advance", "M0")], &["`gcode.stop` and `gcode.advance` are the same"]);
    }

    #[test]
    fn what_one_list_does_another_undoes() {
        let undone =
            |other: &str, step: &str, list: &str| format!("`gcode.{other}` does not undo {step} in `gcode.{list}`");
        check(&[("knife_up", "M65 P9")], &[&undone("knife_up", "M64 P0", "knife_down")]);
        check(&[("knife_down", "G0 Z-2"), ("knife_up", "M5")], &[&undone("knife_up", "G0 Z-2", "knife_down")]);
        check(&[("knife_up", "M65 P0, G0 Z5")], &[&undone("knife_down", "G0 Z5", "knife_up")]);
        check(
            &[("knife_down", "G0 Z1, G0 Z-2"), ("knife_up", "G0 Z5, G0 Z-2")],
            &[&undone("knife_up", "G0 Z-2", "knife_down")],
        );
        check(&[("drill_up", "M65 P1")], &[&undone("drill_up", "M64 P2 of drill 2", "drill_down")]);
    }

    #[test]
    fn the_knife_is_put_down_by_its_own_steps_alone() {
        check(&[("advance", "G4 P1, M64 P0")], &["`gcode.advance` has M64 P0, which puts the knife down"]);
        check(&[("stop", "M0, M64 P0")], &["`gcode.stop` has M64 P0, which puts the knife down"]);
        check(&[("header", "G54\nM64P0")], &["`gcode.header` has M64 P0, which puts the knife down"]);
    }
}
