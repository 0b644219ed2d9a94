//! Path data: single-letter commands with numbers (SVG 2, 9.3).

use std::ops::Range;

use super::scan::Scan;
use super::transform::Pair;

/// A step of a path, in units of the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Step {
    /// Start of a subpath.
    Move(Pair),
    /// A straight line.
    Line(Pair),
    /// A cubic Bezier curve: two control points and the end point.
    Cubic([Pair; 3]),
    /// An arc of an ellipse.
    Arc(Arc),
    /// Return to the start of the subpath.
    Close,
}

/// An arc of an ellipse, by its end point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Arc {
    /// Semi-axes.
    pub(super) radii: Pair,
    /// Angle from the x axis to the first semi-axis, degrees.
    pub(super) turn: f64,
    /// True for the arc of more than half a turn.
    pub(super) is_large: bool,
    /// True if its angle increases, from x to y.
    pub(super) is_growing: bool,
    /// End point.
    pub(super) to: Pair,
}

/// A fault of path data: its byte offset and a description.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Fault {
    pub(super) at: usize,
    pub(super) what: &'static str,
}

/// State of the path parser.
struct Reader<'a> {
    text: &'a str,
    scan: Scan<'a>,
    at: Pair,
    /// Start of the subpath.
    start: Pair,
    /// The last control point if the previous step was a curve: cubic, and quadratic.
    controls: [Option<Pair>; 2],
    steps: Vec<(Step, Range<usize>)>,
}

/// The steps of a path, each with its byte range.
pub(super) fn read(text: &str) -> Result<Vec<(Step, Range<usize>)>, Fault> {
    let mut reader =
        Reader { text, scan: Scan::of(text), at: [0.0; 2], start: [0.0; 2], controls: [None; 2], steps: Vec::new() };
    reader.scan.pass_blanks();
    if reader.scan.rest().trim_end() == "none" {
        return Ok(Vec::new());
    }
    let mut command = None;
    while !reader.scan.is_at_end() {
        let from = reader.scan.byte();
        let byte = text.as_bytes()[from];
        if b"MmLlHhVvCcSsQqTtAaZz".contains(&byte) {
            if command.is_none() && !byte.eq_ignore_ascii_case(&b'm') {
                return Err(Fault { at: from, what: "a path must begin with `M`" });
            }
            reader.scan.pass();
            reader.scan.pass_blanks();
            command = Some(byte);
        } else {
            command = match command {
                None => return Err(Fault { at: from, what: "a path must begin with `M`" }),
                Some(b'Z' | b'z') => return Err(Fault { at: from, what: "a command is missing behind `Z`" }),
                Some(b'M') => Some(b'L'),
                Some(b'm') => Some(b'l'),
                Some(byte) if b"0123456789.+-,".contains(&text.as_bytes()[from]) => Some(byte),
                Some(_) => return Err(Fault { at: from, what: "this is neither a command nor a number" }),
            };
        }
        if let Some(byte) = command {
            reader.step(byte, from)?;
        }
    }
    Ok(reader.steps)
}

impl Reader<'_> {
    /// Parses the numbers of a command; `from` is the offset of the command or of its first number.
    fn step(&mut self, byte: u8, from: usize) -> Result<(), Fault> {
        let origin = if byte.is_ascii_lowercase() { self.at } else { [0.0; 2] };
        let mut controls = [None; 2];
        let step = match byte.to_ascii_uppercase() {
            b'M' => {
                self.start = self.pair(origin)?;
                Step::Move(self.start)
            }
            b'L' => Step::Line(self.pair(origin)?),
            b'H' => Step::Line([self.number()? + origin[0], self.at[1]]),
            b'V' => Step::Line([self.at[0], self.number()? + origin[1]]),
            b'C' | b'S' => {
                let first = if byte.eq_ignore_ascii_case(&b'c') { self.pair(origin)? } else { self.mirrored(0) };
                let places = [first, self.pair(origin)?, self.pair(origin)?];
                controls[0] = Some(places[1]);
                Step::Cubic(places)
            }
            b'Q' | b'T' => {
                let control = if byte.eq_ignore_ascii_case(&b'q') { self.pair(origin)? } else { self.mirrored(1) };
                let to = self.pair(origin)?;
                controls[1] = Some(control);
                let third = |end: Pair| [0, 1].map(|axis| end[axis] + (control[axis] - end[axis]) * 2.0 / 3.0);
                Step::Cubic([third(self.at), third(to), to])
            }
            b'A' => {
                let radii = [self.number()?, self.number()?];
                let turn = self.number()?;
                let (is_large, is_growing) = (self.flag()?, self.flag()?);
                Step::Arc(Arc { radii, turn, is_large, is_growing, to: self.pair(origin)? })
            }
            _ => Step::Close,
        };
        self.at = match step {
            Step::Move(to) | Step::Line(to) | Step::Cubic([_, _, to]) | Step::Arc(Arc { to, .. }) => to,
            Step::Close => self.start,
        };
        self.controls = controls;
        let end = from + self.text[from..self.scan.byte()].trim_end_matches([' ', ',', '\t', '\n', '\r']).len();
        self.steps.push((step, from..end));
        self.scan.pass_blanks();
        Ok(())
    }

    /// The control point that continues the last curve of a kind smoothly.
    fn mirrored(&self, kind: usize) -> Pair {
        self.controls[kind].map_or(self.at, |last| [0, 1].map(|axis| 2.0 * self.at[axis] - last[axis]))
    }

    fn number(&mut self) -> Result<f64, Fault> {
        let number = self.scan.number();
        let what =
            if self.scan.is_at_end() { "the path ends where a number is missing" } else { "a number is missing" };
        let found = number.ok_or(Fault { at: self.scan.byte(), what });
        self.scan.pass_separator();
        found
    }

    fn pair(&mut self, origin: Pair) -> Result<Pair, Fault> {
        Ok([self.number()? + origin[0], self.number()? + origin[1]])
    }

    /// A flag of an arc: a single digit, which the next number may follow directly.
    fn flag(&mut self) -> Result<bool, Fault> {
        self.scan.pass_blanks();
        let is_set = match self.scan.next() {
            b'0' => false,
            b'1' => true,
            _ => return Err(Fault { at: self.scan.byte(), what: "a flag of an arc must be 0 or 1" }),
        };
        self.scan.pass();
        self.scan.pass_separator();
        Ok(is_set)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, expected: &[Step]) {
        let steps: Vec<Step> = read(text).expect("a path").into_iter().map(|(step, _)| step).collect();
        assert_eq!(steps, expected, "{text}");
    }

    #[test]
    fn commands_may_be_written_shortly() {
        use Step::{Close, Line, Move};
        check("M1 2", &[Move([1.0, 2.0])]);
        check("", &[]);
        check(" none ", &[]);
        check("M1,2L3-4.5.5.25z", &[Move([1.0, 2.0]), Line([3.0, -4.5]), Line([0.5, 0.25]), Close]);
        check("m1 2 3 4-5-6zl1 1", &[Move([1.0, 2.0]), Line([4.0, 6.0]), Line([-1.0, 0.0]), Close, Line([2.0, 3.0])]);
        check(
            "M0 0H5v-3h1e1V.5",
            &[Move([0.0; 2]), Line([5.0, 0.0]), Line([5.0, -3.0]), Line([15.0, -3.0]), Line([15.0, 0.5])],
        );
        let arc = Arc { radii: [1.0, 2.0], turn: 30.0, is_large: false, is_growing: true, to: [0.5, 0.25] };
        check("M0 0a1 2 30 01.5.25", &[Move([0.0; 2]), Step::Arc(arc)]);
    }
    #[test]
    fn smooth_curves_go_on_from_the_last_one_of_their_kind() {
        let last = |text: &str| read(text).expect("a path").last().map(|(step, _)| *step);
        let cubic = |places| Some(Step::Cubic(places));
        assert_eq!(last("M0 0C1 1 2 1 3 0S5 1 6 0"), cubic([[4.0, -1.0], [5.0, 1.0], [6.0, 0.0]]));
        assert_eq!(last("M0 0L3 0S5 1 6 0"), cubic([[3.0, 0.0], [5.0, 1.0], [6.0, 0.0]]));
        assert_eq!(last("M0 0Q3 3 6 0T12 0"), cubic([[8.0, -2.0], [10.0, -2.0], [12.0, 0.0]]));
        assert_eq!(last("M0 0T3 0"), cubic([[0.0, 0.0], [1.0, 0.0], [3.0, 0.0]]));
    }

    #[test]
    fn a_fault_is_told_at_its_byte() {
        let at = |text: &str| read(text).expect_err("a fault").at;
        assert_eq!(at("L1 2"), 0);
        assert_eq!(at("M1 2L3"), 6);
        assert_eq!(at("M1 2L3 x"), 7);
        assert_eq!(at("M1 2 x"), 5);
        assert_eq!(at("M1 2z 3"), 6);
        assert_eq!(at("M0 0A1 1 0 2 0 1 1"), 11);
        assert_eq!(at("M0 0L1e999 0"), 5);
    }
}
