//! Target `gcode`: arcs and lines for controllers of the kind of LinuxCNC that have a C axis.
//!
//! From the toolpath, not from the planned motion: such a controller plans for itself. Runs become few arcs and lines
//! inside the tube ([`fit`]), because planners crawl over many short ones where a rotary axis moves. C is linear along
//! each piece, so that the blade lies along the tangent everywhere; with the C axis behind the tip by r the centre goes
//! on an arc of radius sqrt(R^2 + r^2) around the same centre. How knife, drill and operator are told stands under
//! `gcode.` in the profile.

mod fit;
mod tube;
mod way;

use std::io;

use self::way::{Piece, Way};
use super::{Context, Emit, Output, Proof, Target};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Rotation;
use crate::ir::Toolpath;
use crate::ir::toolpath::{Event, Law, Pose, Run, Step};
use crate::machine::Job;
use crate::machine::controller::FeedMode;
use crate::source::Span;
use crate::units::number::{exact, fixed, push_fixed, push_integer};
use crate::units::{S_PER_MIN, rad};

pub(super) const TARGET: Target = Target {
    name: "gcode",
    about: "G-code of arcs and lines with C, for LinuxCNC and its like",
    extension: "ngc",
    emit: Emit::Toolpaths(emit),
    proof: Proof::Positions,
};

/// Decimals of F and of dwells.
const FEED_DECIMALS: u32 = 3;
/// A whole turn, degrees.
const TURN_DEG: f64 = 360.0;

fn emit(
    context: &Context,
    toolpaths: &[Toolpath],
    out: &mut dyn Output,
    diagnostics: &mut Diagnostics,
) -> io::Result<()> {
    let mut program = Program::new(context.job);
    program.head();
    for toolpath in toolpaths {
        program.toolpath(toolpath, diagnostics);
        out.write_all(&program.text)?;
        program.text.clear();
    }
    program.tail();
    out.write_all(&program.text)
}

/// A program in the making.
struct Program<'a> {
    job: &'a Job,
    text: Vec<u8>,
    /// Where the axes stand.
    pose: Pose,
    lines: u64,
}

impl<'a> Program<'a> {
    fn new(job: &'a Job) -> Self {
        let [x, y, c] = job.profile.home;
        Self { job, text: Vec::new(), pose: Pose::new(x, y, rad(c)), lines: 0 }
    }

    fn head(&mut self) {
        let keys = &self.job.profile.gcode;
        self.say("G17 G21 G40 G80 G90");
        if let Some(blend) = keys.blend_mm {
            self.say(&format!("G64 P{}", exact(blend)));
        }
        self.say(&keys.header);
        self.say(keys.feed_mode.code());
    }

    fn tail(&mut self) {
        if let Some([x, y, c]) = self.job.profile.park {
            self.rapid(Pose::new(x, y, rad(c)));
        }
        self.say(&self.job.profile.gcode.footer);
    }

    fn toolpath(&mut self, toolpath: &Toolpath, diagnostics: &mut Diagnostics) {
        let job = self.job;
        let (keys, cuts) = (&job.profile.gcode, job.mode.cuts());
        for (step, next) in toolpath.steps.iter().zip(toolpath.steps.iter().skip(1).map(Some).chain([None])) {
            match step {
                // What follows decides where a move in the air ends.
                Step::Turn(air) | Step::Travel(air) => {
                    if next.is_none_or(|next| matches!(next, Step::Turn(_) | Step::Travel(_))) {
                        self.rapid(air.to);
                    }
                }
                Step::Run(run) => {
                    self.name(toolpath.piece, &run.spans);
                    match self.way_of(run, toolpath.tolerance) {
                        Ok(way) => self.cut(&way),
                        Err(refused) => diagnostics.push(refused),
                    }
                }
                Step::Stab(stab) => {
                    self.name(toolpath.piece, &stab.spans);
                    self.cut(&Way { start: stab.pose, pieces: Vec::new() });
                }
                Step::Drill(drill) => {
                    self.name(toolpath.piece, &[drill.span]);
                    let [x, y] = job.profile.drill.offset_mm;
                    self.rapid(Pose::new(drill.at.x - x, drill.at.y - y, self.pose.c.0));
                    if cuts {
                        let tool = drill.tool.to_string();
                        self.say(&keys.drill_down.replace('#', &tool));
                        self.dwell(job.profile.drill.dwell());
                        self.say(&keys.drill_up.replace('#', &tool));
                    }
                }
                Step::Event(Event::Stop) => self.say(&keys.stop),
                Step::Event(Event::Advance) => self.say(&keys.advance),
            }
        }
    }

    fn way_of(&self, run: &Run, tolerance: f64) -> Result<Way, Diagnostic> {
        let refused = |message: &str| Diagnostic::new(&code::TARGET_REFUSED, message).at(run.spans[0]);
        if run.law == Law::Chord {
            return Err(refused("the target gcode lays the blade along the tangent only, not as a chord of curves"));
        }
        way::way(run, tolerance, self.job).map_err(|at| {
            let (x, y) = (fixed(at.x, 3), fixed(at.y, 3));
            refused(&format!("no arc or line stays within the tolerance at X {x} Y {y} mm"))
                .hint("a larger path.tolerance_mm or a smaller corner.angle_deg helps; the target csv needs no arcs")
        })
    }

    /// Which piece and block comes.
    fn name(&mut self, piece: u32, spans: &[Span]) {
        let blocks = [spans.first(), spans.last()].map(|span| span.map_or(0, |span| span.block));
        self.say(&format!("(piece {piece} block {} to {})", blocks[0], blocks[1]));
    }

    fn cut(&mut self, way: &Way) {
        let job = self.job;
        let (keys, knife) = (&job.profile.gcode, &job.profile.knife);
        self.rapid(way.start);
        if job.mode.cuts() {
            self.say(&keys.knife_down);
            self.dwell(knife.plunge());
        }
        for piece in &way.pieces {
            self.feed(piece);
        }
        if job.mode.cuts() {
            self.say(&keys.knife_up);
            self.dwell(knife.lift());
        }
    }

    /// Lines of text from the profile.
    fn say(&mut self, text: &str) {
        for line in text.lines().filter(|line| !line.trim().is_empty()) {
            self.number();
            self.text.extend_from_slice(line.trim().as_bytes());
            self.text.push(b'\n');
        }
    }

    /// The number of the line that begins, when the controller wants one.
    fn number(&mut self) {
        if self.job.profile.gcode.line_numbers {
            self.lines += 1;
            self.text.push(b'N');
            push_integer(&mut self.text, self.lines);
            self.text.push(b' ');
        }
    }

    fn dwell(&mut self, time: f64) {
        if time > 0.0 {
            self.say(&format!("G4 P{}", fixed(time, FEED_DECIMALS)));
        }
    }

    fn rapid(&mut self, to: Pose) {
        self.number();
        self.text.extend_from_slice(b"G0");
        self.axes(to);
        self.text.push(b'\n');
    }

    fn feed(&mut self, piece: &Piece) {
        let keys = &self.job.profile.gcode;
        let [x, y, _] = self.job.profile.axes.limits();
        let speed = piece.feed.min(x.speed).min(y.speed);
        let feed = match keys.feed_mode {
            FeedMode::G94 => speed * S_PER_MIN,
            FeedMode::G93 => speed / piece.length * S_PER_MIN,
        };
        let from = self.pose;
        match piece.arc.filter(|_| keys.arcs) {
            Some((centre, turn)) => {
                self.number();
                self.text.extend_from_slice(if turn > 0.0 { b"G3" } else { b"G2" });
                self.axes(piece.to);
                let away = centre - from.centre;
                self.word(b'I', away.x);
                self.word(b'J', away.y);
                self.push_feed(feed);
            }
            None => {
                let parts = self.chords(piece);
                for i in 1..=parts {
                    let share = i as f64 / parts as f64;
                    let c = Rotation(from.c.0 + (piece.to.c.0 - from.c.0) * share);
                    let centre = match piece.arc {
                        Some((around, turn)) if i < parts => {
                            let (sin, cos) = (turn * share).sin_cos();
                            let arm = from.centre - around;
                            around + crate::geom::Vector::new(arm.x * cos - arm.y * sin, arm.x * sin + arm.y * cos)
                        }
                        _ => piece.to.centre,
                    };
                    self.number();
                    self.text.extend_from_slice(b"G1");
                    self.axes(Pose { centre, c });
                    self.push_feed(match keys.feed_mode {
                        FeedMode::G94 => feed,
                        FeedMode::G93 => feed * parts as f64,
                    });
                }
            }
        }
    }

    /// How many straight lines stand for a piece.
    fn chords(&self, piece: &Piece) -> usize {
        let keys = &self.job.profile.gcode;
        piece.arc.map_or(1, |(_, turn)| {
            // A chord of turn t is off its arc by t / 2 in direction at its ends, and by l t / 8 in the middle.
            let by_heading = turn.abs() / (2.0 * rad(keys.heading_tolerance_deg));
            let by_bow = (piece.length * turn.abs() / (8.0 * keys.chord_mm)).sqrt();
            by_heading.max(by_bow).ceil().max(1.0) as usize
        })
    }

    fn push_feed(&mut self, feed: f64) {
        self.text.extend_from_slice(b" F");
        push_fixed(&mut self.text, feed, FEED_DECIMALS);
        self.text.push(b'\n');
    }

    fn axes(&mut self, to: Pose) {
        self.word(b'X', to.centre.x);
        self.word(b'Y', to.centre.y);
        self.text.push(b' ');
        let keys = &self.job.profile.gcode;
        self.text.push(keys.axis.letter());
        let shown = self.job.profile.c.shown_deg(to.c.0);
        if keys.wrapped {
            let was = self.job.profile.c.shown_deg(self.pose.c.0);
            self.wrapped(shown, shown < was);
        } else {
            push_fixed(&mut self.text, shown, keys.decimals);
        }
        self.pose = to;
    }

    /// A position of an axis that goes round: from 0 to below 360, negative = reached by turning back.
    fn wrapped(&mut self, shown: f64, is_back: bool) {
        let decimals = self.job.profile.gcode.decimals;
        let step = 10_f64.powi(-(decimals as i32));
        let mut within = (shown / step).round() * step;
        within = within.rem_euclid(TURN_DEG);
        if TURN_DEG - within < 0.5 * step {
            within = 0.0;
        }
        // There is no negative zero: the nearest place that has a sign.
        let told = if is_back { -within.max(step) } else { within };
        push_fixed(&mut self.text, told, decimals);
    }

    fn word(&mut self, letter: u8, value: f64) {
        self.text.extend_from_slice(&[b' ', letter]);
        push_fixed(&mut self.text, value, self.job.profile.gcode.decimals);
    }
}
