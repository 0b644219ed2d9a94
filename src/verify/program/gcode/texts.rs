//! Lines of a profile and their meanings: outputs, stops, head and end of a program.

use std::rc::Rc;

use crate::machine::MachineProfile;
use crate::machine::gcode::{Dialect, Gcode, Step};
use crate::units::number::exact;
use crate::verify::program::number::whole;
use crate::verify::program::spelling::Expected;

/// First line of a program in a dialect, without its line number.
pub(super) fn first_line(dialect: Dialect) -> &'static str {
    match dialect {
        Dialect::Rs274 => "G17 G21 G40 G80 G90 G91.1",
        Dialect::Reprap => "G17 G21 G90",
    }
}

/// Numbers of the drills of a machine.
const DRILLS: std::ops::RangeInclusive<u8> = 1..=4;

/// Effect of lines that stand in the program verbatim, from the target or the profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Meaning {
    Head,
    Down,
    Up,
    Drill(u8),
    /// Lifts a drill.
    Raise(u8),
    Event(u8),
    End,
}

/// Lines of the profile that form a unit.
pub(super) struct Text {
    pub(super) lines: Vec<Rc<Expected>>,
    pub(super) meaning: Meaning,
    pub(super) stands: Stands,
}

/// Relation of lines to the motion of the axes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Stands {
    /// True if the axes must stand before the first line.
    pub(super) before: bool,
    /// True if Z moves in them.
    pub(super) moves_z: bool,
}

impl Stands {
    pub(super) fn of(steps: &[Step], profile: &MachineProfile) -> Self {
        let moves_z = steps.iter().any(|step| matches!(step, Step::Z { .. }));
        Self { before: profile.gcode.must_stand(steps), moves_z }
    }
}

/// Lines of a profile with their meanings; the head comes first.
pub(super) fn texts(profile: &MachineProfile) -> Vec<Text> {
    let keys = &profile.gcode;
    let blend = keys.blend_mm.map_or(String::new(), |blend| format!("G64 P{} Q0", exact(blend)));
    let first = first_line(keys.dialect);
    let head = format!("{first}\n{blend}\n{}\n{}", keys.header, keys.feed_mode.code());
    let text = |lines: &str, meaning| Text { lines: lines_of(lines), meaning, stands: Stands::default() };
    let steps = |steps: &[Step], drill: u8, meaning| {
        let lines = steps.iter().map(|step| Rc::new(Expected::of_step(step, drill.into(), keys.dialect))).collect();
        Text { lines, meaning, stands: Stands::of(steps, profile) }
    };
    let drills = DRILLS.flat_map(|tool| {
        [steps(&keys.drill_down, tool, Meaning::Drill(tool)), steps(&keys.drill_up, tool, Meaning::Raise(tool))]
    });
    let mut texts = vec![text(&head, Meaning::Head)];
    texts.extend([steps(&keys.knife_down, 0, Meaning::Down), steps(&keys.knife_up, 0, Meaning::Up)]);
    texts.extend(drills);
    texts.push(steps(&keys.stop, 0, Meaning::Event(1)));
    if !keys.advance.iter().any(Step::has_blank) {
        texts.push(steps(&keys.advance, 0, Meaning::Event(2)));
    }
    texts.push(text(&keys.footer, Meaning::End));
    texts.retain(|text| !text.lines.is_empty());
    texts
}

/// Lines of a text, blank ones left out.
pub(super) fn lines_of(text: &str) -> Vec<Rc<Expected>> {
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    lines.map(|line| Rc::new(Expected::new(line))).collect()
}

/// Advance of the cloth given by the first line of an advance, mm, and the lines that must follow; `None` for any other line.
pub(super) fn bite(line: &[u8], keys: &Gcode) -> Option<(u32, Vec<Rc<Expected>>)> {
    let (first, others) = keys.advance.split_first().filter(|(first, _)| first.has_blank())?;
    let text = first.to_string();
    let (before, behind) = text.split_once('#')?;
    let told = line.strip_prefix(before.as_bytes())?.strip_suffix(behind.as_bytes())?;
    let mm = whole(told)?;
    let of_step = |step: &Step| Rc::new(Expected::of_step(step, mm.into(), keys.dialect));
    of_step(first).is(line).then(|| (mm, others.iter().map(of_step).collect()))
}
