//! Reader of G-code as places along the path of the axes: without time, but with the motion at each place that F commands.
//!
//! It knows only the words of the target: G0 to G4 with full coordinates, the profile's lines for head, knife, drill, operator
//! and end, and comments, in any spelling. Arcs are followed as a controller does: around the centre given by I and J, with C
//! linear in their angle. At a line that cannot be read, reading ends: everything that follows from it would be wrong.

mod arc;
mod texts;

use std::collections::VecDeque;
use std::io::{self, BufRead, ErrorKind};
use std::rc::Rc;

use self::arc::Arc;
use self::texts::{Meaning, Stands, Text, bite, first_line, texts};
use crate::geom::Point;
use crate::ir::Finding;
use crate::ir::verdict::{Sighting, Worst};
use crate::machine::MachineProfile;
use crate::machine::gcode::{Dialect, FeedCounts, FeedMode, Moves, Outputs, SETTLE};
use crate::units::S_PER_MIN;
use crate::units::number::exact;
use crate::verify::axes::crawl::{Asked, Axes};
use crate::verify::program::number::{quoted, whole};
use crate::verify::program::row::{Going, Rounding, Row, SAGITTA};
use crate::verify::program::spelling::{Expected, Words, is_active, plain, unnumbered};
use crate::verify::rules;

/// Maximum length of a first line in a message, characters.
const FIRST_CHARS: usize = 60;
/// Longest line that a controller reads, bytes including its end: RS274/NGC, section 3.3.
const LINE_MAX: usize = 256;
/// Longest step, mm, and greatest turn of C in one step, degrees.
const STEP_MM: f64 = 8.0;
const STEP_DEG: f64 = 5.0;
/// Maximum number of steps of one line of a program; longer moves are beyond any machine.
const STEPS_MAX: f64 = 1e5;
/// Maximum number of steps with the knife down: a stroke of ten kilometres.
const STEPS_A_STROKE: f64 = 4e6;
/// Lower bound on the share of a move that is certain despite rounding; the target writes no moves that are too short for it.
const SURE_MIN: f64 = 0.95;
/// Full turn, degrees, and the greatest turn that counts as zero.
const TURN_DEG: f64 = 360.0;
const TURN_EPSILON: f64 = 1e-6;
/// Tolerance on the time of a rest, s: rounding of the text.
const REST_EPSILON: f64 = 1e-3;
/// G codes of moves.
const MOVES: [f64; 4] = [0.0, 1.0, 2.0, 3.0];
/// Error for a line that acts after the end of the program.
const BEHIND_END: &str = "comes behind the end of the program";

/// True if the bytes look like a program of this target in a dialect.
pub(in crate::verify) fn begins(bytes: &[u8], dialect: Dialect) -> bool {
    let lines = bytes.split(|&byte| byte == b'\n').map(|line| plain(line.strip_suffix(b"\r").unwrap_or(line)));
    // Blank lines and comments may precede the head.
    let mut asking = lines.skip_while(|line| matches!(line.as_deref(), Some([])));
    asking.next().flatten().is_some_and(|line| line == first_line(dialect).as_bytes())
}

/// Reason why G-code cannot be verified, and advice; `None` when the bytes do not look like G-code.
pub(in crate::verify) fn foreign(bytes: &[u8], dialect: Dialect) -> Option<[String; 2]> {
    let line = bytes.split(|&byte| byte == b'\n').next().unwrap_or_default();
    // Blocks of cut files end with an asterisk.
    let is_code =
        matches!(line, [b'G' | b'g' | b'N' | b'n', b'0'..=b'9', ..] | [b'%' | b'(', ..]) && !line.contains(&b'*');
    is_code.then(|| {
        let head = first_line(dialect);
        let text = String::from_utf8_lossy(line);
        let first: String = text.trim_end().escape_debug().take(FIRST_CHARS).collect();
        let hint = if first == "%" {
            "leave the lines of % out: the program ends by M2 or M30"
        } else {
            "G-code of the target gcode alone is judged, its first line with the words in that order"
        };
        [format!("its first line is `{first}`, not `{head}`"), hint.to_owned()]
    })
}

/// Iterator over the places of a program.
pub(in crate::verify) struct Places<'a> {
    input: &'a mut dyn BufRead,
    profile: &'a MachineProfile,
    texts: Vec<Text>,
    /// Lines that must come next: the rest of a text.
    due: VecDeque<Rc<Expected>>,
    /// Rest that must follow those lines, s.
    rest_due: Option<f64>,
    /// Rest since the last command beyond what the profile asks for, s; between moves there must be none.
    too_long: f64,
    dwell: Worst,
    /// True if no move may be under way.
    stands: bool,
    /// Rest since the last move that is allowed if an output follows it, s.
    settling: f64,
    axes: Axes,
    /// Meaning of F: that of the profile, or that of the head where the program chooses it.
    feed_mode: FeedMode,
    /// Number of lines read, and the buffer for the next one.
    lines: u64,
    room: Vec<u8>,
    now: Row,
    /// Rows of the last lines, and the number of those that were given out.
    rows: Vec<(Row, Going)>,
    given: usize,
    last: Going,
    /// Steps since the knife went down.
    in_stroke: f64,
    /// True once the lines at the end were read.
    over: bool,
    /// Error of the line that cannot be read, and the place of the axes there.
    bad: Option<(Sighting, String)>,
    ended: bool,
}

impl<'a> Places<'a> {
    /// Places of a program on cloth that was already advanced by `moved_on` mm.
    pub(in crate::verify) fn new(input: &'a mut dyn BufRead, moved_on: u32, profile: &'a MachineProfile) -> Self {
        let [x, y, c_deg] = profile.home;
        let now = Row {
            tick: 0,
            t: 0.0,
            centre: Point::new(x, y),
            c_deg,
            knife: false,
            drill: 0,
            event: 0,
            block: 0,
            station: moved_on,
            line: 1,
        };
        let texts = texts(profile);
        Self {
            input,
            profile,
            over: texts.iter().all(|text| text.meaning != Meaning::End),
            due: texts[0].lines.iter().cloned().collect(),
            texts,
            rest_due: None,
            too_long: 0.0,
            dwell: Worst::new(&rules::DWELL, Some(REST_EPSILON)).in_unit("s too long"),
            stands: true,
            settling: 0.0,
            axes: Axes::new(profile),
            feed_mode: profile.gcode.feed_mode,
            lines: 0,
            room: Vec::new(),
            now,
            rows: vec![(now, Going::default())],
            given: 0,
            last: Going::default(),
            in_stroke: 0.0,
            bad: None,
            ended: false,
        }
    }

    /// Greatest difference between the numbers of a program and the intended values.
    pub(in crate::verify) fn rounding(profile: &MachineProfile) -> Rounding {
        Rounding { axes: [0.5 * profile.gcode.step(); 3] }
    }

    /// Next place and the motion of the axes there.
    pub(in crate::verify) fn next(&mut self) -> Option<(Row, Going)> {
        while self.given == self.rows.len() && !self.ended {
            self.rows.clear();
            self.given = 0;
            if let Err(why) = self.read() {
                self.ended = true;
                let line = self.lines;
                self.bad = Some((Row { line, ..self.now }.sighting(), format!("line {line} {why}")));
            }
        }
        let next = self.rows.get(self.given).copied();
        self.given += usize::from(next.is_some());
        next
    }

    /// True if a line could not be read, so that nothing can be said about the program's effect.
    pub(in crate::verify) fn is_broken(&self) -> bool {
        self.bad.is_some()
    }

    /// Findings on the format and on rests, and the error of the line that cannot be read.
    pub(in crate::verify) fn findings(self) -> ([Finding; 2], Option<String>) {
        let mut worst = Worst::new(&rules::FORMAT, Some(0.0)).in_unit("bad lines");
        let (place, why) = self.bad.unzip();
        if let Some(place) = place {
            worst.see(1.0, || place);
        }
        ([worst.finding(), self.dwell.finding()], why)
    }

    /// Reads a line and executes it; the error is the end of a message about the line.
    fn read(&mut self) -> Result<(), String> {
        let mut line = std::mem::take(&mut self.room);
        line.clear();
        let read = read_line(&mut *self.input, &mut line).map_err(|_| "cannot be read")?;
        self.lines += 1;
        if read == 0 {
            self.ended = true;
            return match self.due.front() {
                Some(due) => Err(format!("is missing: `{}` belongs there", due.text)),
                None if !self.over => Err("is missing: the program has no end".to_owned()),
                None => Ok(()),
            };
        }
        if line.pop() != Some(b'\n') {
            let is_long = read == LINE_MAX;
            return Err(if is_long { "is too long" } else { "has no end: the file is cut short" }.to_owned());
        }
        if line.last() == Some(&b'\r') {
            line.pop();
        }
        let read = self.line(&line);
        self.room = line;
        read
    }

    /// Executes a line in any spelling.
    fn line(&mut self, line: &[u8]) -> Result<(), String> {
        let usual = unnumbered(line);
        let Err(why) = self.spelled(usual, usual) else { return Ok(()) };
        if line.contains(&0) {
            return Err("holds a NUL, behind which no controller reads on".to_owned());
        }
        match plain(line) {
            Some(plain) if plain.is_empty() => {
                self.name(usual);
                Ok(())
            }
            Some(plain) if plain != usual => self.spelled(&plain, usual),
            Some(_) | None => Err(why),
        }
    }

    /// Executes a line in the spelling of the target; on error nothing changes. Messages show the line as it is `written`.
    fn spelled(&mut self, line: &[u8], written: &[u8]) -> Result<(), String> {
        if let Some(due) = self.due.front().cloned() {
            let is_due = due.is(line) || self.is_mode(&due, line);
            let why = || format!("is {} where `{}` belongs", quoted(written), due.text);
            is_due.then_some(()).ok_or_else(why)?;
            self.due.pop_front();
            return Ok(());
        }
        if let Some(rest) = self.rest_due {
            let words = Words::of(line, self.profile).unwrap_or_default();
            let time = words.rest().filter(|time| *time >= rest - REST_EPSILON);
            let why = || format!("is {} where a rest of {} s belongs", quoted(written), exact(rest));
            let time = time.ok_or_else(why)?;
            self.rest_due = None;
            self.stands |= time >= SETTLE;
            self.linger(time - rest);
            return Ok(());
        }
        if matches!(line, [b'G', b'0'..=b'3', b' ', b'X', ..]) {
            return self.go(&Words::of(line, self.profile)?);
        }
        if let Some((mm, others)) = bite(line, &self.profile.gcode) {
            self.now.station =
                self.now.station.checked_add(mm).ok_or("moves the cloth on farther than there is any")?;
            self.obey(Meaning::Event(2), Stands::of(&self.profile.gcode.advance, self.profile))?;
            self.due.extend(others);
            return Ok(());
        }
        if let Some(text) = self.text(line) {
            let (meaning, stands, rest) = (text.meaning, text.stands, text.lines[1..].to_vec());
            self.obey(meaning, stands)?;
            self.due.extend(rest);
            return Ok(());
        }
        // A comment ends at its first closing bracket; anything behind that is executed.
        let comment = line.strip_prefix(b"(").and_then(|rest| rest.strip_suffix(b")"));
        if let Some(comment) = comment.filter(|text| !text.iter().any(|byte| matches!(byte, b'(' | b')' | 0))) {
            if is_active(comment) {
                return Err(format!("is {}, which is obeyed though it looks like a comment", quoted(line)));
            }
            self.name(comment);
            return Ok(());
        }
        let words = Words::of(line, self.profile)?;
        if words.g.is_some_and(|code| MOVES.contains(&code)) {
            // Words may come in any order.
            return self.go(&words);
        }
        let rest = words.rest().filter(|&time| time >= 0.0);
        let why = || format!("is {}, which is no line of the target gcode with this profile", quoted(written));
        let rest = rest.ok_or_else(why)?;
        if self.over {
            return Err(BEHIND_END.to_owned());
        }
        self.rest(rest);
        Ok(())
    }

    /// True if a line selects a meaning of F where the head of a program that chooses it selects one; it holds from then on.
    fn is_mode(&mut self, due: &Expected, line: &[u8]) -> bool {
        let is_free = self.profile.gcode.moves == Moves::Auto && due.text == self.profile.gcode.feed_mode.code();
        let mode = FeedMode::ALL.into_iter().find(|mode| is_free && Expected::new(mode.code()).is(line));
        self.feed_mode = mode.unwrap_or(self.feed_mode);
        mode.is_some()
    }

    /// Rests the axes for a time, s. As long as they need to stand, that is no rest beyond the profile's if an output follows.
    fn rest(&mut self, time: f64) {
        let settling = match self.profile.gcode.outputs {
            Outputs::Immediate if !self.stands => time.min(SETTLE),
            Outputs::Immediate | Outputs::Queued => 0.0,
        };
        self.settling += settling;
        self.stands |= time >= SETTLE;
        self.linger(time - settling);
    }

    /// Text that begins with a line. If several tools are lifted by the same line, the tool that is down is meant.
    fn text(&self, line: &[u8]) -> Option<&Text> {
        let fits = |text: &&Text| match text.meaning {
            Meaning::Up => self.now.drill == 0,
            Meaning::Raise(tool) => self.now.drill == tool,
            Meaning::Head | Meaning::Down | Meaning::Drill(_) | Meaning::Event(_) | Meaning::End => true,
        };
        let mut found = self.texts.iter().filter(|text| text.lines[0].is(line));
        found.clone().find(fits).or_else(|| found.next())
    }

    /// Adds time that the axes rest beyond the profile's, s.
    fn linger(&mut self, time: f64) {
        self.too_long += time;
        self.dwell.see(self.too_long, || self.now.sighting());
    }

    /// Takes over the block number that a comment names, if any.
    fn name(&mut self, comment: &[u8]) {
        let words = comment.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        let number = words.skip_while(|word| *word != b"block").nth(1);
        self.now.block = number.and_then(whole).unwrap_or(self.now.block);
    }

    fn obey(&mut self, meaning: Meaning, stands: Stands) -> Result<(), String> {
        if self.over && meaning != Meaning::End {
            return Err(BEHIND_END.to_owned());
        }
        if stands.before && !self.stands {
            return Err("acts while the axes move: a rest belongs before it".to_owned());
        }
        let settling = std::mem::take(&mut self.settling);
        self.linger(if stands.before { 0.0 } else { settling });
        self.stands &= !stands.moves_z;
        let was_down = self.now.knife;
        let is_change = match meaning {
            Meaning::Down => !was_down,
            Meaning::Up => was_down,
            Meaning::Drill(tool) => self.now.drill != tool,
            Meaning::Raise(_) => self.now.drill != 0,
            Meaning::Head | Meaning::Event(_) | Meaning::End => false,
        };
        match meaning {
            Meaning::Head => return Err("is the head of a program again".to_owned()),
            Meaning::End => {
                self.over = true;
                return Ok(());
            }
            Meaning::Event(event) => {
                self.too_long = 0.0;
                self.push(Row { event, ..self.now }, Going::default());
                return Ok(());
            }
            Meaning::Down if self.now.drill != 0 => return Err("puts the knife down beside a drill".to_owned()),
            // Otherwise the program could rest in the cloth for any number of plunges.
            Meaning::Down if was_down => return Err("puts the knife down that is down".to_owned()),
            Meaning::Down => self.now.knife = true,
            Meaning::Up => self.now.knife = false,
            Meaning::Drill(tool) => self.now.drill = tool,
            Meaning::Raise(tool) if ![0, tool].contains(&self.now.drill) => {
                return Err(format!("lifts drill {tool} while drill {} is down", self.now.drill));
            }
            Meaning::Raise(_) => self.now.drill = 0,
        }
        if is_change {
            self.too_long = 0.0;
        }
        let knife = &self.profile.knife;
        let rest = match meaning {
            Meaning::Down => knife.plunge(),
            Meaning::Up => knife.lift(),
            Meaning::Drill(_) => self.profile.drill.dwell(),
            Meaning::Raise(_) | Meaning::Head | Meaning::Event(_) | Meaning::End => 0.0,
        };
        self.rest_due = Some(rest).filter(|&rest| rest > 0.0);
        let going = if was_down { self.last } else { Going::default() };
        self.last = Going::default();
        self.push(self.now, going);
        if meaning == Meaning::Up {
            // The next cut names its own block.
            self.now.block = 0;
        }
        Ok(())
    }

    fn push(&mut self, row: Row, going: Going) {
        self.now.tick += 1;
        self.now.t = self.now.tick as f64;
        self.rows.push((Row { tick: self.now.tick, t: self.now.t, line: self.lines, ..row }, going));
    }

    /// Executes a move: adds all of its places.
    fn go(&mut self, words: &Words) -> Result<(), String> {
        if self.over {
            return Err(BEHIND_END.to_owned());
        }
        let settling = std::mem::take(&mut self.settling);
        self.linger(settling);
        self.stands = false;
        let from = self.now;
        if from.drill != 0 {
            return Err("is a move while a drill is down".to_owned());
        }
        let code = needed(words.g, 'G')?;
        let to = Point::new(needed(words.x, 'X')?, needed(words.y, 'Y')?);
        let c_to = self.asked_turn(words.c)?;
        if code == 0.0 && from.knife {
            return Err("is a rapid move while the knife is down".to_owned());
        }
        if let Some(letter) = words.foreign_to(code, self.profile.gcode.dialect) {
            return Err(format!("has {letter}, which such a move has not"));
        }
        let feed = if code == 0.0 { f64::INFINITY } else { needed(words.f, 'F')? };
        if feed <= 0.0 {
            return Err("has an F that is no speed".to_owned());
        }
        let turned = c_to - from.c_deg;
        let arc = if code > 1.0 {
            let [i, j] = [needed(words.i, 'I')?, needed(words.j, 'J')?];
            let way = if code == 3.0 { 1.0 } else { -1.0 };
            Some(Arc::new([from.centre, to], [i, j], way, &self.profile.gcode)?)
        } else {
            None
        };
        if arc.is_some() && self.feed_mode == FeedMode::G93 && !self.profile.gcode.divides_inverse_time() {
            return Err("is an arc in inverse time, which this controller mistimes".to_owned());
        }
        let length = arc.map_or((to - from.centre).norm(), |arc| arc.sweep.abs() * arc.start.norm());
        let by_deviation = arc.map_or(0.0, |arc| arc.sweep.abs() * (arc.start.norm() / (8.0 * SAGITTA)).sqrt());
        let steps = by_deviation.max(length / STEP_MM).max(turned.abs() / STEP_DEG).ceil().max(1.0);
        let in_stroke = if from.knife { self.in_stroke + steps } else { 0.0 };
        if steps > STEPS_MAX || in_stroke > STEPS_A_STROKE {
            return Err("is a way that no machine goes".to_owned());
        }
        self.in_stroke = in_stroke;
        let pace = self.pace(feed, length, turned);
        let asked = Asked {
            speed: length * pace,
            turn: turned.to_radians().abs() * pace,
            length,
            curvature: arc.map_or(0.0, |arc| arc.sweep.abs() / length),
        };
        // A move to the current position takes no time.
        let used = if length > 0.0 || turned != 0.0 { self.axes.used(&asked) } else { 0.0 };
        self.walk(&Walk { to, turned, arc, steps, pace, used });
        (self.now.centre, self.now.c_deg) = (to, c_to);
        Ok(())
    }

    /// Target position of C, degrees; an error when the word is missing or not allowed.
    fn asked_turn(&self, told: Option<f64>) -> Result<f64, String> {
        let from = self.now;
        let letter = char::from(self.profile.gcode.letter.byte());
        if !self.profile.gcode.wrapped {
            return Ok(self.turned_to(needed(told, letter)?));
        }
        if let Some(told) = told.filter(|told| told.abs() >= TURN_DEG) {
            return Err(format!("has {letter}{}, which an axis that goes round does not know", exact(told)));
        }
        let c_to = told.map_or(from.c_deg, |told| self.turned_to(told));
        if told.is_some() && from.knife && (c_to - from.c_deg).abs() < TURN_EPSILON {
            // The controller unwraps the word by its own arithmetic, and the result may lie slightly beyond a full turn.
            return Err(format!("has {letter} where that axis stands, which a controller may turn all round for"));
        }
        // The words of a wrapping axis do not count turns: in the air, take the turn that is nearest to the rest position.
        Ok(if from.knife { c_to } else { self.near_rest(c_to) })
    }

    /// Adds the rows along a move.
    fn walk(&mut self, walk: &Walk) {
        let Walk { to, turned, arc, steps, pace, used } = *walk;
        let from = self.now;
        // In the air only the ends of a straight move matter.
        let first = if from.knife || arc.is_some() { 0 } else { steps as usize };
        for i in first..=steps as usize {
            let share = i as f64 / steps;
            let (centre, ahead) = match arc {
                Some(arc) => arc.at(share),
                None => (from.centre + (to - from.centre) * share, to - from.centre),
            };
            let c_deg = from.c_deg + turned * share;
            let going = Going { way: ahead * pace, turn: turned.to_radians() * pace, used };
            let centre = if i as f64 == steps { to } else { centre };
            self.last = going;
            self.push(Row { centre, c_deg, ..from }, going);
        }
    }

    /// Moves per second that F commands for a move of this length (mm) and turn of C (degrees), lowest within the rounding of
    /// its ends. A rapid counts as one per second.
    fn pace(&self, feed: f64, length: f64, turned: f64) -> f64 {
        if feed.is_infinite() {
            return 1.0;
        }
        let rounding = 2.0 * Self::rounding(self.profile).axis();
        let size = if length > 0.0 { length } else { turned.abs() };
        let sure = ((size - rounding) / size.max(f64::MIN_POSITIVE)).max(SURE_MIN);
        let keys = &self.profile.gcode;
        let pace = match (self.feed_mode, keys.feed_counts) {
            (FeedMode::G93, FeedCounts::Linear | FeedCounts::All) => feed / S_PER_MIN,
            (FeedMode::G94, FeedCounts::Linear) => feed / S_PER_MIN / size.max(f64::MIN_POSITIVE),
            (FeedMode::G94, FeedCounts::All) => feed / S_PER_MIN / length.hypot(turned).max(f64::MIN_POSITIVE),
        };
        pace * sure
    }

    /// Unwrapped geometric position of C for a word of the axis.
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
        let to = shown + if back { -way } else { way };
        // The word is a multiple of the last decimal.
        let step = self.profile.gcode.step();
        c.offset_deg + sign * (to / step).round() * step
    }

    /// Position of C that differs by full turns and is nearest to its rest position at the end.
    fn near_rest(&self, c_deg: f64) -> f64 {
        let [.., rest] = self.profile.park.unwrap_or(self.profile.home);
        c_deg - ((c_deg - rest) / TURN_DEG).round() * TURN_DEG
    }
}

/// Appends a line with its end to `line`, at most [`LINE_MAX`] bytes, and returns its length; 0 at the end of the input.
fn read_line(input: &mut dyn BufRead, line: &mut Vec<u8>) -> io::Result<usize> {
    loop {
        let buffer = match input.fill_buf() {
            Err(error) if error.kind() == ErrorKind::Interrupted => continue,
            buffer => buffer?,
        };
        let part = &buffer[..buffer.len().min(LINE_MAX - line.len())];
        let end = memchr::memchr(b'\n', part);
        let read = end.map_or(part.len(), |end| end + 1);
        line.extend_from_slice(&part[..read]);
        input.consume(read);
        if end.is_some() || read == 0 {
            return Ok(line.len());
        }
    }
}

/// Value of a word that a move needs, or an error when it is missing.
fn needed(word: Option<f64>, letter: char) -> Result<f64, String> {
    word.ok_or_else(|| format!("has no {letter}"))
}

/// Move as it is divided into steps.
#[derive(Debug, Clone, Copy)]
struct Walk {
    to: Point,
    /// Turn of C, degrees.
    turned: f64,
    arc: Option<Arc>,
    /// Number of steps, a whole number.
    steps: f64,
    /// Moves per second that F commands.
    pace: f64,
    /// Greatest share of an axis limit that the move uses.
    used: f64,
}

/// Copy of a finding without the time of its place.
pub(in crate::verify) fn timeless(finding: &Finding) -> Finding {
    let timeless = |place: Sighting| Sighting { time: None, ..place };
    Finding { place: finding.place.map(timeless), ..*finding }
}
