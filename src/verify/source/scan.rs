//! Minimal scan of a cut file by other means than the reader's: it follows the knife and computes statistics.

use std::f64::consts::TAU;

use super::census::{ARC_SAGITTA, Census, Slack};
use super::words::{Block, Blocks};
use crate::geom::moments::Moments;
use crate::geom::{Extent, Point, Vector};
use crate::machine::MachineProfile;
use crate::machine::keys::CODE_NAMES;

/// Codes that drill.
const DRILLS: [&str; 6] = ["R", "M43", "M44", "M45", "M72", "M73"];
/// Codes that may stand between the start place of a contour and its knife-down.
const BEFORE_DOWN: [&str; 10] = ["A", "M15", "M17", "M18", "H", "G90", "D1", "D2", "D4", "M30"];
/// Values of [`Scan::way`]: straight lines, or the rotation of arcs.
const STRAIGHT: f64 = 0.0;
const CLOCKWISE: f64 = -1.0;
const COUNTERCLOCKWISE: f64 = 1.0;

/// Scans a cut file with a unit of `unit` mm. Only codes that move the knife matter; all others are skipped.
pub(super) fn scan_iso(bytes: &[u8], unit: f64, profile: &MachineProfile) -> (Census, Slack) {
    let mut scan = Scan {
        blocks: Blocks::new(bytes),
        unit,
        profile,
        census: Census::empty(unit),
        slack: Slack {
            sagitta: profile.tolerance(unit) * ARC_SAGITTA,
            length: 0.0,
            bounds: 0.0,
            moments: Moments::default(),
        },
        stroke: None,
        at: Point::origin(),
        fresh: false,
        waiting: false,
        way: STRAIGHT,
    };
    while let Some(block) = scan.blocks.next() {
        if let Ok(block) = block {
            scan.obey(&block);
        }
    }
    scan.up();
    (scan.census, scan.slack)
}

struct Scan<'a> {
    blocks: Blocks<'a>,
    unit: f64,
    profile: &'a MachineProfile,
    census: Census,
    slack: Slack,
    /// Current stroke, while the knife is down.
    stroke: Option<Drawn>,
    at: Point,
    /// True if the knife moved here in the air, and nothing has been drilled here yet.
    fresh: bool,
    /// True if a hole waits for its place.
    waiting: bool,
    /// Rotation of arcs.
    way: f64,
}

impl Scan<'_> {
    fn obey(&mut self, block: &Block) {
        let (mut moves, mut turns, mut is_label, mut drills) = (true, block.place[2..] != [None, None], false, false);
        let mut radius = None;
        for word in &block.codes {
            let name = word.name();
            match name.as_str() {
                "Q" | "Z" => moves = false,
                "M20" => self.blocks.skip_text(),
                "M31" => is_label = true,
                // X and Y beside an origin or a dwell that is switched off are its own numbers.
                name if !self.profile.obeys(name) => moves &= !matches!(name, "G4" | "M70"),
                "M14" | "B" => self.stroke = self.stroke.take().or_else(|| Some(Drawn::new(self.at))),
                "M15" | "A" => self.up(),
                "G0" | "G1" => self.way = STRAIGHT,
                "G2" => (self.way, turns) = (CLOCKWISE, true),
                "G3" => (self.way, turns) = (COUNTERCLOCKWISE, true),
                name if DRILLS.contains(&name) => drills = true,
                _ if word.letter == 'R' && block.has_place() => radius = word.number,
                _ => {}
            }
        }
        let place = Some(block).filter(|block| moves && block.has_place());
        if drills {
            // No place follows the end of the program, and a place behind M31 belongs to the label.
            let may_wait = !is_label && block.codes.iter().all(|word| word.name() != "M0");
            if place.is_none() && may_wait && !self.fresh && self.place_follows() {
                self.waiting = true;
            } else {
                self.drill(place);
            }
        }
        if is_label {
            self.label(place);
        } else if let Some(block) = place.filter(|_| !drills) {
            self.go(block, radius, turns);
        }
    }

    /// Ends a stroke; a stroke that never moves cuts nothing.
    fn up(&mut self) {
        self.fresh = false;
        let Some(stroke) = self.stroke.take().filter(|stroke| stroke.points > 0) else { return };
        self.census.points += stroke.points;
        self.census.length += stroke.length;
        self.census.bounds.add(stroke.bounds.min);
        self.census.bounds.add(stroke.bounds.max);
    }

    /// Point of the coordinates of a block.
    fn place(&self, block: &Block) -> Point {
        let [x, y, ..] = block.place.map(|number| number.map(|number| number * self.unit));
        Point::new(x.unwrap_or(self.at.x), y.unwrap_or(self.at.y))
    }

    fn go(&mut self, block: &Block, radius: Option<f64>, turns: bool) {
        let to = self.place(block);
        let Some(stroke) = &mut self.stroke else {
            self.at = to;
            self.fresh = true;
            if std::mem::take(&mut self.waiting) {
                self.hole();
            }
            return;
        };
        let [_, _, i, j] = block.place.map(|number| number.map(|number| number * self.unit));
        match radius.map(|radius| radius * self.unit) {
            _ if self.way == STRAIGHT => stroke.line(to),
            _ if i.is_some() || j.is_some() => {
                let centre = Vector::new(i.unwrap_or(0.0), j.unwrap_or(0.0));
                stroke.arc(to, centre, self.way, &mut self.slack);
            }
            Some(radius) => stroke.arc(to, bulge(to - self.at, radius, self.way), self.way, &mut self.slack),
            None if turns => {} // an arc without a centre is an error in the file
            None => stroke.line(to),
        }
        self.at = to;
    }

    /// Adds a hole at the knife.
    fn hole(&mut self) {
        self.census.drills += 1;
        self.census.bounds.add(self.at);
        self.fresh = false;
    }

    /// Adds a hole at the place of its block, or at the knife.
    fn drill(&mut self, place: Option<&Block>) {
        if let Some(block) = place {
            self.at = self.place(block);
        }
        self.hole();
    }

    /// True if the next block is a place, but not the start of a contour.
    fn place_follows(&self) -> bool {
        let mut ahead = self.blocks.clone();
        if !ahead.skip_if(|block| block.codes.is_empty() && block.has_place()) {
            return false;
        }
        while let Some(Ok(block)) = ahead.next() {
            if block.has_place() {
                return true;
            }
            for name in block.codes.iter().map(|word| word.name()) {
                if ["M14", "B"].contains(&name.as_str()) && self.profile.obeys(&name) {
                    return false;
                }
                if !BEFORE_DOWN.contains(&name.as_str()) {
                    return true;
                }
            }
        }
        true
    }

    /// Skips the texts and places behind M31.
    fn label(&mut self, place: Option<&Block>) {
        if place.is_none() {
            self.blocks.skip_if(|block| block.codes.is_empty() && block.is_whole_place());
            self.blocks.skip_text();
            return;
        }
        self.blocks.skip_text();
        // The text for mirrored pieces is not codes; it is followed by a second place with M31 and then by codes.
        let mut ahead = self.blocks.clone();
        if ahead.next().is_none_or(|text| is_known(text.as_ref().ok())) {
            return;
        }
        let mut ahead = self.blocks.clone();
        ahead.skip_text();
        let is_second = |block: &Block| {
            block.is_whole_place() && block.codes.len() == 1 && block.codes.iter().all(|word| word.name() == "M31")
        };
        if ahead.skip_if(is_second) && ahead.clone().next().is_none_or(|after| is_known(after.as_ref().ok())) {
            self.blocks = ahead;
        }
    }
}

/// True if a block consists of known codes and coordinates.
fn is_known(block: Option<&Block>) -> bool {
    block.is_some_and(|block| block.codes.iter().all(|word| CODE_NAMES.contains(&word.name().as_str())))
}

/// Path of the knife between down and up.
struct Drawn {
    at: Point,
    points: usize,
    length: f64,
    bounds: Extent,
}

impl Drawn {
    fn new(at: Point) -> Self {
        let mut bounds = Extent::EMPTY;
        bounds.add(at);
        Self { at, points: 0, length: 0.0, bounds }
    }

    fn line(&mut self, to: Point) {
        self.points += usize::from(to != self.at);
        self.length += (to - self.at).norm();
        self.bounds.add(to);
        self.at = to;
    }

    /// Adds an arc around `at + centre`, `way` 1 counter-clockwise and -1 clockwise. It exceeds its chords by s / (3 r) of its
    /// length, with s their sagitta.
    fn arc(&mut self, to: Point, centre: Vector, way: f64, slack: &mut Slack) {
        let around = self.at + centre;
        let (start, end) = (-centre, to - around);
        let radius = start.norm();
        let angle = |v: Vector| v.y.atan2(v.x);
        let turned = (way * (angle(end) - angle(start))).rem_euclid(TAU);
        let sweep = if to == self.at { TAU } else { turned };
        for quarter in 0..4 {
            let extreme = f64::from(quarter) * TAU / 4.0;
            if (way * (extreme - angle(start))).rem_euclid(TAU) < sweep {
                self.bounds.add(around + Vector::new(extreme.cos(), extreme.sin()) * radius);
            }
        }
        let length = sweep * radius;
        self.points += 1;
        self.length += length;
        self.bounds.add(to);
        self.at = to;
        let uneven = (end.norm() - radius).abs();
        slack.length += length * (slack.sagitta / (3.0 * radius)).min(1.0) + uneven * (1.0 + sweep);
        slack.bounds = slack.bounds.max(slack.sagitta + uneven);
    }
}

/// Centre of an arc relative to its start, from the radius in the file; a negative radius selects the longer way around.
fn bulge(chord: Vector, radius: f64, way: f64) -> Vector {
    let half = chord.norm() / 2.0;
    let height = (radius * radius - half * half).max(0.0).sqrt() * way * radius.signum();
    chord / 2.0 + Vector::new(-chord.y, chord.x) / (2.0 * half) * height
}
