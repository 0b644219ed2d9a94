//! The rows of a program, to change and to print again.

use std::fmt::Write as _;
use std::ops::Range;

use cutc::geom::{Point, Vector};
use cutc::machine::Knife;

const HEADER: &str = "t_s,x_mm,y_mm,c_deg,knife,drill,event,block";

/// A setpoint as it is printed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Row {
    pub(crate) t: f64,
    /// X and Y in mm, C in degrees.
    pub(crate) pose: [f64; 3],
    pub(crate) knife: u8,
    pub(crate) drill: u8,
    pub(crate) event: u8,
    pub(crate) block: u32,
}

impl Row {
    pub(crate) fn tip(&self, knife: &Knife) -> Point {
        Point::new(self.pose[0], self.pose[1]) + along(self.pose[2]) * knife.radius()
    }

    pub(crate) fn tail(&self, knife: &Knife) -> Point {
        Point::new(self.pose[0], self.pose[1]) - along(self.pose[2]) * knife.back()
    }

    /// The row with its blade turned about the tip.
    pub(crate) fn turned_to(&self, c_deg: f64, knife: &Knife) -> Self {
        let centre = self.tip(knife) - along(c_deg) * knife.radius();
        Self { pose: [centre.x, centre.y, c_deg], ..*self }
    }

    /// Greatest difference of the axes, mm and degrees.
    pub(crate) fn away(&self, other: &Self) -> f64 {
        self.pose.iter().zip(other.pose).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }
}

fn along(c_deg: f64) -> Vector {
    let (sin, cos) = c_deg.to_radians().sin_cos();
    Vector::new(cos, sin)
}

pub(crate) fn parse(program: &[u8]) -> Vec<Row> {
    let text = std::str::from_utf8(program).expect("programs are ASCII");
    let row = |line: &str| {
        let f: Vec<f64> = line.split(',').map(|field| field.parse().expect("a number")).collect();
        let [knife, drill, event] = [f[4], f[5], f[6]].map(|output| output as u8);
        Row { t: f[0], pose: [f[1], f[2], f[3]], knife, drill, event, block: f[7] as u32 }
    };
    text.lines().skip(1).map(row).collect()
}

pub(crate) fn print(rows: &[Row]) -> Vec<u8> {
    let mut out = String::with_capacity(64 * (rows.len() + 1));
    let _ = writeln!(out, "{HEADER}");
    for row in rows {
        let [x, y, c] = row.pose.map(|value| value + 0.0);
        let Row { t, knife, drill, event, block, .. } = row;
        let _ = writeln!(out, "{t:.6},{x:.6},{y:.6},{c:.6},{knife},{drill},{event},{block}");
    }
    out.into_bytes()
}

/// Gives every row the time of its place.
pub(crate) fn renumber(rows: &mut [Row], period: f64) {
    for (tick, row) in rows.iter_mut().enumerate() {
        row.t = tick as f64 * period;
    }
}

/// The stretches of rows for which something holds.
pub(crate) fn stretches(rows: &[Row], holds: impl Fn(usize) -> bool) -> Vec<Range<usize>> {
    let mut found: Vec<Range<usize>> = Vec::new();
    for i in (0..rows.len()).filter(|&i| holds(i)) {
        match found.last_mut() {
            Some(last) if last.end == i => last.end = i + 1,
            _ => found.push(i..i + 1),
        }
    }
    found
}

/// The strokes of the knife, from plunge to lift.
pub(crate) fn strokes(rows: &[Row]) -> Vec<Range<usize>> {
    stretches(rows, |i| rows[i].knife == 1)
}

/// The ways through the air that are long enough to be in the midst of: every row of them moves.
pub(crate) fn travels(rows: &[Row]) -> Vec<Range<usize>> {
    let moves = |i: usize| i > 0 && rows[i].knife == 0 && rows[i].drill == 0 && rows[i].pose != rows[i - 1].pose;
    stretches(rows, moves).into_iter().filter(|travel| travel.len() >= 40).collect()
}

/// The holes, from the command to its end.
pub(crate) fn holes(rows: &[Row]) -> Vec<Range<usize>> {
    stretches(rows, |i| rows[i].drill != 0)
}

/// One of several by chance.
pub(crate) fn pick<T: Clone>(rng: &mut fastrand::Rng, of: &[T]) -> Option<T> {
    (!of.is_empty()).then(|| of[rng.usize(0..of.len())].clone())
}
