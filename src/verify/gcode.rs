//! Reads G-code as places along the way of the axes: no time, but at each place the exact direction of the tip.
//!
//! Knows the words of the target alone: G0 to G4 with full coordinates, the lines of the profile for knife, drill and
//! operator, comments. Arcs are followed as a controller does: around the centre that I and J give, with C linear in
//! their angle.

use std::collections::VecDeque;
use std::f64::consts::TAU;
use std::io::{BufRead, Read as _};

use super::read::{Rounding, Row, decimal};
use super::worst::{Worst, at};
use crate::geom::{Point, Vector};
use crate::ir::Finding;
use crate::machine::MachineProfile;

/// How every such program begins, behind the number of its line.
const HEAD: &[u8] = b"G17 G21 G40 G80 G90";
/// The longest line that is read, bytes.
const LINE_MAX: u64 = 1024;
/// Farthest that a straight step may leave an arc, mm.
const SAGITTA: f64 = 5e-3;
/// Longest step, mm, and greatest turn of C on one, degrees.
const STEP_MM: f64 = 8.0;
const STEP_DEG: f64 = 5.0;
/// Most steps of a line of a program: more are no way of a machine.
const STEPS_MAX: f64 = 1e5;
/// A whole turn, degrees, and what is none.
const TURN_DEG: f64 = 360.0;
const TURN_EPSILON: f64 = 1e-6;
/// Radii of both ends of an arc may differ by this many steps of the last decimal.
const RADIUS_STEPS: f64 = 8.0;

/// Whether bytes are meant as such a program.
pub(super) fn begins(bytes: &[u8]) -> bool {
    let line = bytes.split(|&byte| byte == b'\n').next().unwrap_or_default();
    unnumbered(line) == HEAD
}

/// A line without the number that it may begin with.
fn unnumbered(line: &[u8]) -> &[u8] {
    let Some(rest) = line.strip_prefix(b"N") else { return line };
    let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
    rest[digits..].strip_prefix(b" ").unwrap_or(line)
}

/// What a line of the profile does.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Meaning {
    Down,
    Up,
    Drill(u8),
    Event(u8),
    Nothing,
}

/// The places of a program.
pub(super) struct Places<'a> {
    input: &'a mut dyn BufRead,
    profile: &'a MachineProfile,
    texts: Vec<(String, Meaning)>,
    now: Row,
    queue: VecDeque<(Row, Vector)>,
    last_way: Vector,
    worst: Worst,
    ended: bool,
}

impl<'a> Places<'a> {
    pub(super) fn new(input: &'a mut dyn BufRead, profile: &'a MachineProfile) -> Self {
        let [x, y, c_deg] = profile.home;
        let now = Row { tick: 0, t: 0.0, centre: Point::new(x, y), c_deg, knife: false, drill: 0, event: 0, block: 0 };
        let worst = Worst::new("verify/format", "bad lines", Some(0.0));
        let mut places = Self {
            input,
            profile,
            texts: texts(profile),
            now,
            queue: VecDeque::new(),
            last_way: Vector::zeros(),
            worst,
            ended: false,
        };
        places.queue.push_back((now, Vector::zeros()));
        places
    }

    /// By how much its numbers may differ from what was meant.
    pub(super) fn rounding(profile: &MachineProfile) -> Rounding {
        Rounding { axes: [0.5 * step(profile); 3] }
    }

    /// The next place, and the way of the tip there, of any length; none where it rests.
    pub(super) fn next(&mut self) -> Option<(Row, Vector)> {
        while self.queue.is_empty() && !self.ended {
            let mut line = Vec::new();
            let read = (&mut *self.input).take(LINE_MAX).read_until(b'\n', &mut line).unwrap_or(0);
            if read == 0 {
                self.ended = true;
            } else if line.pop() != Some(b'\n') || self.line(unnumbered(&line)).is_none() {
                self.ended = true;
                let place = self.now.sighting();
                self.worst.see(1.0, || place);
            }
        }
        self.queue.pop_front()
    }

    /// What was found about the format.
    pub(super) fn finding(self) -> Finding {
        self.worst.finding()
    }

    /// Obeys a line; `None` when it is none that the target writes.
    fn line(&mut self, line: &[u8]) -> Option<()> {
        if let Some((_, meaning)) = self.texts.iter().find(|(text, _)| text.as_bytes() == line) {
            self.obey(*meaning);
            return Some(());
        }
        if line.starts_with(b"(") {
            let mut words = line.split(|&byte| byte == b' ').skip_while(|word| *word != b"block").skip(1);
            self.now.block = words.next().and_then(|word| std::str::from_utf8(word).ok()?.parse().ok()).unwrap_or(0);
            return line.ends_with(b")").then_some(());
        }
        let mut words = Words::default();
        for word in line.split(|&byte| byte == b' ') {
            let (&letter, number) = word.split_first()?;
            *words.place(letter, self.profile)? = Some(decimal(number)?);
        }
        match words.g? as u32 {
            4 => words.p.map(|_| ()),
            code @ 0..=3 => self.go(code, &words),
            _ => None,
        }
    }

    fn obey(&mut self, meaning: Meaning) {
        let was_down = self.now.knife;
        match meaning {
            Meaning::Down => self.now.knife = true,
            Meaning::Up => self.now.knife = false,
            Meaning::Drill(tool) => self.now.drill = tool,
            Meaning::Event(_) | Meaning::Nothing => {}
        }
        if let Meaning::Event(event) = meaning {
            self.push(Row { event, ..self.now }, Vector::zeros());
        } else if meaning != Meaning::Nothing {
            let way = if was_down { self.last_way } else { Vector::zeros() };
            self.last_way = Vector::zeros();
            self.push(self.now, way);
        }
    }

    fn push(&mut self, row: Row, way: Vector) {
        self.now.tick += 1;
        self.now.t = self.now.tick as f64;
        self.queue.push_back((Row { tick: self.now.tick, t: self.now.t, ..row }, way));
    }

    /// A move: all of its places.
    fn go(&mut self, code: u32, words: &Words) -> Option<()> {
        let from = self.now;
        let to = Point::new(words.x?, words.y?);
        let c_to = self.turned_to(words.c?);
        if code != 0 && words.f? <= 0.0 {
            return None;
        }
        let turned = c_to - from.c_deg;
        let arc = match code {
            2 | 3 => Some(self.arc(to, [words.i?, words.j?], if code == 3 { 1.0 } else { -1.0 })?),
            _ => None,
        };
        let length = arc.map_or((to - from.centre).norm(), |arc| arc.sweep.abs() * arc.start.norm());
        let by_bow = arc.map_or(0.0, |arc| arc.sweep.abs() * (arc.start.norm() / (8.0 * SAGITTA)).sqrt());
        let steps = by_bow.max(length / STEP_MM).max(turned.abs() / STEP_DEG).ceil().max(1.0);
        if steps > STEPS_MAX {
            return None;
        }
        let radius = self.profile.knife.radius();
        // In the air only the ends matter.
        let first = if from.knife { 0 } else { steps as usize };
        for i in first..=steps as usize {
            let share = i as f64 / steps;
            let (centre, pace) = match arc {
                Some(arc) => arc.at(share),
                None => (from.centre + (to - from.centre) * share, to - from.centre),
            };
            let c_deg = from.c_deg + turned * share;
            let (sin, cos) = c_deg.to_radians().sin_cos();
            // The tip swings about the centre as the blade turns.
            let way = pace + Vector::new(-sin, cos) * (radius * turned.to_radians());
            let centre = if i as f64 == steps { to } else { centre };
            self.last_way = way;
            self.push(Row { centre, c_deg, ..self.now }, way);
        }
        (self.now.centre, self.now.c_deg) = (to, c_to);
        Some(())
    }

    /// The unwrapped geometric position that a word of the axis means.
    fn turned_to(&self, told: f64) -> f64 {
        let c = &self.profile.c;
        let sign = if c.reverse { -1.0 } else { 1.0 };
        if !self.profile.gcode.wrapped {
            return c.offset_deg + sign * told;
        }
        let shown = sign * (self.now.c_deg - c.offset_deg);
        let back = told.is_sign_negative();
        let way = if back { shown - told.abs() } else { told - shown }.rem_euclid(TURN_DEG);
        let way = if TURN_DEG - way < TURN_EPSILON { way - TURN_DEG } else { way };
        self.now.c_deg + sign * if back { -way } else { way }
    }

    fn arc(&self, to: Point, [i, j]: [f64; 2], way: f64) -> Option<Arc> {
        let start = Vector::new(-i, -j);
        let centre = self.now.centre - start;
        let end = to - centre;
        if (start.norm() - end.norm()).abs() > RADIUS_STEPS * step(self.profile) || start.norm() == 0.0 {
            return None;
        }
        let angle = |v: Vector| v.y.atan2(v.x);
        let turned = (way * (angle(end) - angle(start))).rem_euclid(TAU);
        let sweep = way * if turned == 0.0 { TAU } else { turned };
        Some(Arc { centre, start, grown: end.norm() / start.norm(), sweep })
    }
}

/// The step of the last decimal, mm and degrees.
fn step(profile: &MachineProfile) -> f64 {
    10_f64.powi(-(profile.gcode.decimals as i32))
}

/// A way around a centre.
#[derive(Debug, Clone, Copy)]
struct Arc {
    centre: Point,
    /// Its start as seen from the centre.
    start: Vector,
    /// Radius at the end, in radii at the start.
    grown: f64,
    sweep: f64,
}

impl Arc {
    /// The place at a share of the angle, and the way there as the share grows.
    fn at(&self, share: f64) -> (Point, Vector) {
        let (sin, cos) = (self.sweep * share).sin_cos();
        let arm = Vector::new(self.start.x * cos - self.start.y * sin, self.start.x * sin + self.start.y * cos)
            * (1.0 + (self.grown - 1.0) * share);
        (self.centre + arm, Vector::new(-arm.y, arm.x) * self.sweep)
    }
}

/// The words of a line.
#[derive(Debug, Default)]
struct Words {
    g: Option<f64>,
    x: Option<f64>,
    y: Option<f64>,
    c: Option<f64>,
    i: Option<f64>,
    j: Option<f64>,
    f: Option<f64>,
    p: Option<f64>,
}

impl Words {
    /// Where the number of a letter goes; `None` when there is one already, or none such.
    fn place(&mut self, letter: u8, profile: &MachineProfile) -> Option<&mut Option<f64>> {
        let place = match letter {
            b'G' => &mut self.g,
            b'X' => &mut self.x,
            b'Y' => &mut self.y,
            b'I' => &mut self.i,
            b'J' => &mut self.j,
            b'F' => &mut self.f,
            b'P' => &mut self.p,
            letter if letter == profile.gcode.axis.letter() => &mut self.c,
            _ => return None,
        };
        place.is_none().then_some(place)
    }
}

/// The lines of a profile and what they do: of several behind each other the first acts.
fn texts(profile: &MachineProfile) -> Vec<(String, Meaning)> {
    let keys = &profile.gcode;
    let mut texts = Vec::new();
    let mut add = |text: &str, meaning: Meaning| {
        let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
        for (i, line) in lines.enumerate() {
            texts.push((line.to_owned(), if i == 0 { meaning } else { Meaning::Nothing }));
        }
    };
    add(&keys.knife_down, Meaning::Down);
    add(&keys.knife_up, Meaning::Up);
    for tool in 1..=4 {
        add(&keys.drill_down.replace('#', &tool.to_string()), Meaning::Drill(tool));
        add(&keys.drill_up.replace('#', &tool.to_string()), Meaning::Drill(0));
    }
    add(&keys.stop, Meaning::Event(1));
    add(&keys.advance, Meaning::Event(2));
    for text in [&keys.header, &keys.footer] {
        add(text, Meaning::Nothing);
    }
    add(std::str::from_utf8(HEAD).unwrap_or_default(), Meaning::Nothing);
    add(keys.feed_mode.code(), Meaning::Nothing);
    if let Some(blend) = keys.blend_mm {
        add(&format!("G64 P{blend}"), Meaning::Nothing);
    }
    texts
}

/// Rules that need no time; of the others a program without any says nothing.
pub(super) const RULES: &[&str] = &[
    "verify/format",
    "verify/end",
    "verify/c-range",
    "verify/table",
    "verify/on-path",
    "verify/stray",
    "verify/order",
    "verify/once",
    "verify/complete",
    "verify/heading",
    "verify/body",
    "verify/overcut-part",
    "verify/overcut-neighbour",
    "verify/overcut-waste",
    "verify/drills",
    "verify/drill-place",
    "verify/events",
];

/// A finding as a program without time has it.
pub(super) fn timeless(finding: Finding) -> Finding {
    Finding {
        place: finding
            .place
            .map(|place| at(0.0, place.point, place.block))
            .map(|p| crate::ir::finding::Sighting { time: None, ..p }),
        ..finding
    }
}
