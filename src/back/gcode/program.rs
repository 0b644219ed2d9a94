//! The text of a program: lines of moves, and the lines that the profile defines for knife, drills and operator.

use std::io;
use std::rc::Rc;

use super::pace::{self, Feed, Move, Planner};
use crate::back::target::{Context, Limit, Output, Spent};
use crate::geom::{Point, Rotation, Vector, left};
use crate::ir::arcs::{Arc, Deviation, Path, Piece};
use crate::ir::toolpath::{Drill, Event, Pose};
use crate::machine::gcode::{Dialect, FeedCounts, FeedMode, Planner as Kind, SETTLE, Step};
use crate::machine::{Job, Mode};
use crate::source::Span;
use crate::units::number::{exact, push_fixed, push_integer, short};
use crate::units::{S_PER_MIN, rad};

/// Decimals of F and of dwells.
const FEED_DECIMALS: u32 = 3;
/// Decimals of a small F, which rounding to fewer would change too much, and the bound of a small F.
const FINE_DECIMALS: u32 = 6;
const FEED_FINE: f64 = 10.0;
/// Maximum length of a name in a comment, characters; longer lines could exceed the limit of controllers.
const NAME_CHARS: usize = 100;
/// A full turn, degrees.
const TURN_DEG: f64 = 360.0;

/// The base name in a text, restricted to characters that a comment may hold: ASCII without brackets.
fn comment(text: &str) -> String {
    let is_plain = |c: char| matches!(c, ' '..='~') && !matches!(c, '(' | ')' | ';');
    let name = text.rsplit(['/', '\\']).next().unwrap_or_default();
    name.chars().take(NAME_CHARS).map(|c| if is_plain(c) { c } else { '_' }).collect()
}

/// Steps as lines of a program.
#[derive(Clone)]
struct Lines {
    text: Rc<str>,
    steps: Rc<[Step]>,
    /// True if the axes must stand before them.
    must_stand: bool,
    /// True if Z moves in them.
    moves_z: bool,
}

impl Lines {
    fn new(steps: &[Step], job: &Job) -> Self {
        let dialect = job.profile.gcode.dialect;
        let text = steps.iter().map(|step| step.in_dialect(dialect)).collect::<Vec<_>>().join("\n").into();
        let moves_z = steps.iter().any(|step| matches!(step, Step::Z { .. }));
        Self { text, steps: steps.into(), must_stand: job.profile.gcode.must_stand(steps), moves_z }
    }

    /// Lines with a number in place of `#`.
    fn filled(steps: &[Step], blank: f64, job: &Job) -> Self {
        Self::new(&steps.iter().map(|step| step.filled(blank)).collect::<Vec<_>>(), job)
    }
}

/// A program under construction.
pub(super) struct Program<'a> {
    job: &'a Job,
    /// Name of the source file.
    source: &'a str,
    /// Lines that have not been written yet.
    text: Vec<u8>,
    /// Pose of the axes, in coordinates of the cloth.
    pose: Pose,
    /// Lines that lower the knife and that lift it, formatted once for all cuts.
    knife: [Lines; 2],
    /// True if no move may be under way.
    stands: bool,
    /// Advance of the cloth so far, mm.
    station: u32,
    /// Number of numbered lines so far.
    lines: u64,
    /// Number of moves with the knife down.
    pub(super) moves: usize,
    /// Number of arcs whose chords deviate more than permitted, because positions have too few decimals for finer ones.
    pub(super) coarse: usize,
    planner: Box<dyn Planner>,
}

impl<'a> Program<'a> {
    pub(super) fn new(context: &Context<'a>) -> Self {
        let job = context.job;
        let ([x, y, c], station) = (job.profile.home, context.marker.moved_on);
        let (pose, source) = (Pose::new(x + f64::from(station), y, rad(c)), context.source.name());
        let keys = &job.profile.gcode;
        let knife = [&keys.knife_down, &keys.knife_up].map(|steps| Lines::new(steps, job));
        let planner = pace::planner(job);
        Self {
            job,
            source,
            text: Vec::new(),
            pose,
            knife,
            stands: true,
            station,
            lines: 0,
            moves: 0,
            coarse: 0,
            planner,
        }
    }

    /// Writes the lines before the first move.
    pub(super) fn start(&mut self) {
        let keys = &self.job.profile.gcode;
        self.say(match keys.dialect {
            Dialect::Rs274 => "G17 G21 G40 G80 G90 G91.1",
            // It knows neither offsets of the tool, canned cycles nor centres that are not relative.
            Dialect::Reprap => "G17 G21 G90",
        });
        if let Some(blend) = keys.blend_mm {
            // Q0 keeps arcs as arcs; otherwise flat ones would become pairs of lines with a kink.
            self.say(&format!("G64 P{} Q0", exact(blend)));
        }
        self.say(&keys.header);
        self.say(keys.feed_mode.code());
        self.say(&format!("(from {})", comment(self.source)));
        let Job { profile, origin, .. } = self.job;
        let mut set = origin.set.keys();
        let changed = match (set.next(), set.len()) {
            (None, _) => String::new(),
            (Some(key), 0) => format!(", with {} set", comment(key)),
            (Some(_), others) => format!(", with {} keys set", others + 1),
        };
        self.say(&format!("(machine: {}{changed})", comment(origin.name())));
        let [width, radius] = [profile.knife.width_mm, profile.knife.radius()].map(short);
        self.say(&format!("(knife: {width} mm wide, axis {radius} mm behind the tip)"));
        match self.job.mode {
            Mode::Cut => {}
            Mode::Dry => self.say("(dry run: knife and drills stay up)"),
            Mode::Frame => self.say("(frame: once around the box of the marker, knife up)"),
        }
        // A previous program may have left the knife in the cloth.
        self.lift();
    }

    /// Writes the lines after the last move and returns the time of the program.
    pub(super) fn finish(&mut self) -> Spent {
        if let Some([x, y, c]) = self.job.profile.park {
            self.rapid(Pose::new(x + f64::from(self.station), y, rad(c)));
        }
        self.say(&self.job.profile.gcode.footer);
        self.planner.finish()
    }

    /// Planner whose time is estimated.
    pub(super) fn planned_by(&self) -> Kind {
        self.job.profile.gcode.planner
    }

    /// Writes the lines so far.
    pub(super) fn drain(&mut self, out: &mut dyn Output) -> io::Result<()> {
        out.write_all(&self.text)?;
        self.text.clear();
        Ok(())
    }

    /// Writes the lines of an event.
    pub(super) fn event(&mut self, event: Event) {
        let keys = &self.job.profile.gcode;
        match event {
            Event::Stop => self.order(&Lines::new(&keys.stop, self.job), 0.0),
            Event::Advance => self.order(&Lines::new(&keys.advance, self.job), 0.0),
            Event::AdvanceBy(mm) => {
                self.order(&Lines::filled(&keys.advance, mm.into(), self.job), 0.0);
                self.station += mm;
                self.pose.centre.x += f64::from(mm);
            }
        }
    }

    /// Writes a comment with the piece and the blocks of the next cut.
    pub(super) fn name(&mut self, piece: u32, spans: &[Span]) {
        self.number();
        let text = &mut self.text;
        text.extend_from_slice(b"(piece ");
        push_integer(text, piece.into());
        let [first, last] = [spans.first(), spans.last()].map(|span| span.map_or(0, |span| span.block));
        // A reversed run is named in the same way.
        for (word, block) in [(&b" block "[..], first.min(last)), (b" to ", first.max(last))] {
            text.extend_from_slice(word);
            push_integer(text, block.into());
        }
        text.extend_from_slice(b")\n");
    }

    /// A cut: plunge, the pieces of a path, lift.
    pub(super) fn cut(&mut self, path: &Path) {
        let job = self.job;
        self.rapid(path.start);
        if job.mode.cuts() {
            let [down, _] = self.knife.clone();
            self.order(&down, job.profile.knife.plunge());
        }
        for piece in &path.pieces {
            self.feed(piece, path);
        }
        if job.mode.cuts() {
            self.lift();
        }
    }

    /// Lifts the knife.
    fn lift(&mut self) {
        let [_, up] = self.knife.clone();
        self.order(&up, self.job.profile.knife.lift());
    }

    /// Drills a hole.
    pub(super) fn drill(&mut self, drill: &Drill) {
        let job = self.job;
        let keys = &job.profile.gcode;
        let [x, y] = job.profile.drill.offset_mm;
        self.rapid(Pose { centre: drill.at - Vector::new(x, y), c: self.pose.c });
        if job.mode.cuts() {
            let number = drill.tool.into();
            self.order(&Lines::filled(&keys.drill_down, number, job), job.profile.drill.dwell());
            self.order(&Lines::filled(&keys.drill_up, number, job), 0.0);
        }
    }

    /// Steps of the controller, which wait for the axes, followed by a dwell, s.
    fn order(&mut self, steps: &Lines, dwell: f64) {
        if steps.must_stand && !self.stands {
            self.dwell(SETTLE);
        }
        for line in steps.text.lines() {
            self.line(line);
        }
        self.planner.steps(&steps.steps);
        self.stands &= !steps.moves_z;
        if dwell > 0.0 {
            self.dwell(dwell);
        }
    }

    /// Writes a rest of the axes, s.
    fn dwell(&mut self, time: f64) {
        self.number();
        self.text.extend_from_slice(match self.job.profile.gcode.dialect {
            Dialect::Rs274 => b"G4 P",
            // P of `RepRapFirmware` is in ms.
            Dialect::Reprap => b"G4 S",
        });
        push_fixed(&mut self.text, time, FEED_DECIMALS);
        self.text.push(b'\n');
        self.planner.wait(time);
        self.stands |= time >= SETTLE;
    }

    /// Writes a rapid.
    pub(super) fn rapid(&mut self, to: Pose) {
        let way = to.centre - self.pose.centre;
        self.planner.go(&Move {
            ways: [way.x, way.y, to.c.0 - self.pose.c.0],
            length: way.norm(),
            feed: Feed::RAPID,
            along: [way.try_normalize(0.0).unwrap_or_default(); 2],
            curvature: 0.0,
        });
        self.stands = false;
        self.number();
        self.text.extend_from_slice(b"G0");
        self.axes(to);
        self.text.push(b'\n');
    }

    fn feed(&mut self, piece: &Piece, path: &Path) {
        let [x, y, _] = self.job.profile.axes.limits();
        let of_axis = |axis, speed| Feed { speed, limit: Limit::Speed(axis) };
        let fastest = of_axis('x', x.speed).or(of_axis('y', y.speed));
        let from = self.pose;
        let keys = &self.job.profile.gcode;
        let is_written =
            |centre: Point| keys.arcs && keys.max_radius_mm.is_none_or(|most| (centre - from.centre).norm() <= most);
        match piece.arc {
            Some(Arc { centre, turn }) if is_written(centre) => {
                self.number();
                self.text.extend_from_slice(if turn > 0.0 { b"G3" } else { b"G2" });
                let away = centre - from.centre;
                let best = self.planner.best_speed(piece.length, turn / piece.length);
                let turned = piece.to.c.0 - from.c.0;
                let feed = Feed { speed: piece.speed.min(best), limit: Limit::Feed };
                let feed = feed.or(fastest).or(self.followed(piece.length, turned));
                self.plan(piece.to, piece.length, feed, Some((turn, -away)));
                self.axes_of_cut(piece.to);
                self.word(b'I', away.x);
                self.word(b'J', away.y);
                self.push_feed(feed.speed, piece.length, turned);
            }
            _ => {
                let [parts, needed] = self.chords(piece, path.chord);
                self.coarse += usize::from(parts < needed);
                for i in 1..=parts {
                    let share = i as f64 / parts as f64;
                    let c = Rotation(from.c.0 + (piece.to.c.0 - from.c.0) * share);
                    let centre = match piece.arc {
                        Some(Arc { centre: around, turn }) if i < parts => {
                            let (sin, cos) = (turn * share).sin_cos();
                            let arm = from.centre - around;
                            around + Vector::new(arm.x * cos - arm.y * sin, arm.x * sin + arm.y * cos)
                        }
                        Some(_) | None => piece.to.centre,
                    };
                    let to = Pose { centre, c };
                    let (length, ratio) = self.told([self.pose, to], path);
                    let turned = to.c.0 - self.pose.c.0;
                    let feed = Feed { speed: piece.feed * ratio, limit: Limit::Feed };
                    let feed = feed.or(fastest).or(self.followed(length, turned));
                    self.number();
                    self.text.extend_from_slice(b"G1");
                    self.plan(to, length, feed, None);
                    self.axes_of_cut(to);
                    self.push_feed(feed.speed, length, turned);
                }
            }
        }
    }

    /// Accounts for a move with the knife down: its length and speed, and for an arc its turn, rad, and the vector from its
    /// centre to its start.
    fn plan(&mut self, to: Pose, length: f64, feed: Feed, arc: Option<(f64, Vector)>) {
        self.moves += 1;
        self.stands = false;
        let way = to.centre - self.pose.centre;
        let turn = arc.map_or(0.0, |(turn, _)| turn);
        let along = arc.map_or(way, |(_, arm)| left(arm) * turn.signum()).try_normalize(0.0).unwrap_or_default();
        let (sin, cos) = turn.sin_cos();
        let end = Vector::new(along.x * cos - along.y * sin, along.x * sin + along.y * cos);
        self.planner.go(&Move {
            ways: [way.x, way.y, to.c.0 - self.pose.c.0],
            length,
            feed,
            along: [along, end],
            curvature: arc.map_or(0.0, |(turn, _)| turn / length),
        });
    }

    /// Greatest speed along a move of a length, mm/s, at which C keeps its limit while it turns by an angle, rad, and the
    /// controller gets no more blocks a second than it takes.
    fn followed(&self, length: f64, turn: f64) -> Feed {
        let [_, _, c] = self.job.profile.axes.limits();
        let shortest = self.job.profile.gcode.max_blocks_s.map_or(0.0, f64::recip);
        let turning = turn.abs() / c.speed;
        let limit = if turning < shortest { Limit::Blocks } else { Limit::Speed('c') };
        Feed { speed: length / turning.max(shortest), limit }
    }

    /// Length of a straight move between two poses as written, mm, and the ratio of the speed of the axis to the greatest speed
    /// of the tip. Rounding lengthens short moves, which F in inverse time does not take into account.
    fn told(&self, ends: [Pose; 2], beside: &Path) -> (f64, f64) {
        let step = self.job.profile.gcode.step();
        let [from, to] = ends.map(|pose| pose.centre.map(|value| (value / step).round() * step));
        let (way, turned) = (to - from, ends[1].c.0 - ends[0].c.0);
        let tip = |pose: &Pose| {
            let blade = Rotation(pose.c.0 - beside.yaw).unit();
            (way + left(blade) * (beside.radius * turned)).norm()
        };
        let length = way.norm();
        let fastest = ends.iter().map(tip).fold(0.0, f64::max);
        (length, if fastest > 0.0 { length / fastest } else { 1.0 })
    }

    /// Number of chords that approximate a piece, and the number that a permitted deviation needs.
    fn chords(&self, piece: &Piece, permitted: Deviation) -> [usize; 2] {
        let keys = &self.job.profile.gcode;
        piece.arc.map_or([1; 2], |Arc { turn, .. }| {
            // A chord over a turn t deviates from its arc by t / 2 in direction at its ends, and by l t / 8 in the middle.
            let by_heading = turn.abs() / (2.0 * permitted.angle);
            let by_distance = (piece.length * turn.abs() / (8.0 * permitted.distance)).sqrt();
            // Rounding by d turns a chord of length l by d / l. A chord shorter than sqrt(2 d l / t) turns more than the arc.
            let by_decimals = (piece.length * turn.abs() / (2.0 * keys.step())).sqrt();
            let needed = by_heading.max(by_distance);
            [needed.min(by_decimals), needed].map(|count| count.ceil().max(1.0) as usize)
        })
    }

    /// Writes lines of text.
    fn say(&mut self, text: &str) {
        for line in text.lines().map(str::trim).filter(|line| !line.is_empty()) {
            self.line(line);
        }
    }

    /// Writes a line.
    fn line(&mut self, line: &str) {
        self.number();
        self.text.extend_from_slice(line.as_bytes());
        self.text.push(b'\n');
    }

    /// Writes the number of the line, if the controller wants line numbers.
    fn number(&mut self) {
        if self.job.profile.gcode.line_numbers {
            self.lines += 1;
            self.text.push(b'N');
            push_integer(&mut self.text, self.lines);
            self.text.push(b' ');
        }
    }

    /// Writes the word F of a move at a speed along a length, mm, while C turns by `turn` rad.
    fn push_feed(&mut self, speed: f64, length: f64, turn: f64) {
        let keys = &self.job.profile.gcode;
        let feed = match (keys.feed_mode, keys.feed_counts) {
            (FeedMode::G94, FeedCounts::Linear) => speed * S_PER_MIN,
            // C turns evenly along the move, so the ratio of the two lengths is constant.
            (FeedMode::G94, FeedCounts::All) => speed / length * length.hypot(turn.to_degrees()) * S_PER_MIN,
            (FeedMode::G93, FeedCounts::Linear | FeedCounts::All) => speed / length * S_PER_MIN,
        };
        let decimals = if feed < FEED_FINE { FINE_DECIMALS } else { FEED_DECIMALS };
        self.text.extend_from_slice(b" F");
        push_fixed(&mut self.text, feed, decimals);
        self.text.push(b'\n');
    }

    /// Writes the axis words of a rapid.
    fn axes(&mut self, to: Pose) {
        self.place(to);
        self.turn(to);
        self.pose = to;
    }

    /// Writes the axis words of a move with the knife down. A wrapped axis at rest gets no word: a controller that finds it
    /// marginally before its position would turn it all the way round.
    fn axes_of_cut(&mut self, to: Pose) {
        self.place(to);
        if !(self.job.profile.gcode.wrapped && self.rests(to)) {
            self.turn(to);
        }
        self.pose = to;
    }

    /// True if the word of a wrapped axis would be the same as before.
    fn rests(&self, to: Pose) -> bool {
        let [was, shown] = [self.pose, to].map(|pose| self.job.profile.c.shown_deg(pose.c.0));
        let step = self.job.profile.gcode.step();
        (self.within(shown) - self.within(was)).abs() < 0.5 * step && (shown - was).abs() < 0.5 * TURN_DEG
    }

    fn place(&mut self, to: Pose) {
        self.word(b'X', to.centre.x - f64::from(self.station));
        self.word(b'Y', to.centre.y);
    }

    fn turn(&mut self, to: Pose) {
        let profile = &self.job.profile;
        let keys = &profile.gcode;
        self.text.extend_from_slice(&[b' ', keys.letter.byte()]);
        let shown = profile.c.shown_deg(to.c.0);
        let shown = if keys.wrapped { self.wrapped(shown, profile.c.shown_deg(self.pose.c.0)) } else { shown };
        push_fixed(&mut self.text, shown, keys.decimals);
    }

    /// A position of a wrapped axis as written: from 0 to below 360, negative if it is reached by turning back. `was` is the
    /// current position, degrees.
    fn wrapped(&self, shown: f64, was: f64) -> f64 {
        let within = self.within(shown);
        // Turning back to the current position would be a full turn.
        let is_back = shown < was && (within - self.within(was)).abs() > 0.5 * self.job.profile.gcode.step();
        if is_back { -within } else { within }
    }

    /// The magnitude of a position of a wrapped axis as written. Zero has no sign in G-code, so it is replaced by the nearest
    /// value that has one.
    fn within(&self, shown: f64) -> f64 {
        let step = self.job.profile.gcode.step();
        let within = ((shown / step).round() * step).rem_euclid(TURN_DEG);
        if within < 0.5 * step || TURN_DEG - within < 0.5 * step { step } else { within }
    }

    fn word(&mut self, letter: u8, value: f64) {
        self.text.extend_from_slice(&[b' ', letter]);
        push_fixed(&mut self.text, value, self.job.profile.gcode.decimals);
    }
}
