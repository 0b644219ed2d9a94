//! Made-up garment markers of any size, as cutter files in three dialect shapes and as plots.
//!
//! Pieces of clothes are drawn from straight lines and cubic curves, graded to a size, flattened to a chord tolerance as
//! pattern systems do, and laid in rows across the cloth. Everything follows from the order: the same one gives the same
//! bytes. Pieces are made while they are written, so that the size of a marker does not matter.

use std::io::{self, Write};

use cutc::geom::{Extent, Point, Vector, left, polyline};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// How the cutter file is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Dialect {
    /// Tenths of a millimetre under G71; V notches are part of the contour; a label is a block with place, M31 and text.
    G71,
    /// Hundredths of an inch without a unit code; notches are slits behind M19; a label is three blocks.
    Inch,
    /// Tenths of a millimetre, blanks between blocks, no pieces and no labels; the knife is lifted at corners.
    Spaced,
}

/// What is asked of a marker.
#[derive(Debug, Clone)]
pub(crate) struct Order {
    pub(crate) dialect: Dialect,
    /// Number of pieces, when `vertices` does not say.
    pub(crate) pieces: usize,
    /// As many pieces as have this many vertices on their outlines.
    pub(crate) vertices: Option<usize>,
    /// Farthest of a curve from its chords, mm.
    pub(crate) tolerance: f64,
    /// Width of the cloth, mm.
    pub(crate) width: f64,
    /// Least distance between the boxes of two pieces, mm.
    pub(crate) gap: f64,
    /// Whether bodices and trouser legs have contours inside.
    pub(crate) cutouts: bool,
    pub(crate) seed: u64,
}

impl Default for Order {
    fn default() -> Self {
        Self {
            dialect: Dialect::G71,
            pieces: 12,
            vertices: None,
            tolerance: 0.05,
            width: 1500.0,
            gap: 4.0,
            cutouts: false,
            seed: 1,
        }
    }
}

/// Writes the marker of an order.
pub(crate) fn write(order: &Order, out: &mut impl Write) -> io::Result<()> {
    let mut file = CutFile { dialect: order.dialect, right: 0.0, out };
    file.head(order.width)?;
    for (piece, number) in Layout::new(order).zip(1..) {
        file.piece(&piece, number)?;
    }
    file.tail()
}

/// Writes the marker of an order as an HPGL plot, whatever its dialect: slits are spikes of the outlines, drills circles.
pub(crate) fn write_plot(order: &Order, out: &mut impl Write) -> io::Result<()> {
    let mut plot = Plot { out };
    plot.out.write_all(b"IN;DT\x03,1;SP1;")?;
    for piece in Layout::new(order) {
        plot.piece(&piece)?;
    }
    plot.out.write_all(b"PU;SP0;")
}

/// A size of clothes: its name, and what the base size is scaled by.
const SIZES: [(&str, f64); 5] = [("S", 0.94), ("M", 1.0), ("L", 1.05), ("XL", 1.11), ("XXL", 1.17)];

/// A stretch of an outline, from where the one before ended.
enum Stretch {
    Line([f64; 2]),
    /// A cubic in Bézier form: two control points and the end.
    Cubic([f64; 2], [f64; 2], [f64; 2]),
}

use Stretch::{Cubic, Line};

/// A pattern in base size, counter-clockwise, mm. The last stretch ends at the start.
struct Pattern {
    name: &'static str,
    start: [f64; 2],
    stretches: &'static [Stretch],
}

/// Patterns in the order in which pieces take their turns.
const PATTERNS: [Pattern; 6] = [
    Pattern {
        name: "BODICE",
        start: [0.0, 0.0],
        stretches: &[
            Line([270.0, 0.0]),
            Line([270.0, 397.0]),
            Cubic([208.0, 410.0], [200.0, 499.0], [228.0, 595.0]),
            Line([95.0, 640.0]),
            Cubic([90.0, 580.0], [50.0, 552.0], [0.0, 550.0]),
            Line([0.0, 0.0]),
        ],
    },
    Pattern {
        name: "SLEEVE",
        start: [70.0, 0.0],
        stretches: &[
            Line([330.0, 0.0]),
            Line([400.0, 403.0]),
            Cubic([330.0, 414.0], [272.0, 560.0], [200.0, 560.0]),
            Cubic([136.0, 560.0], [80.0, 437.0], [0.0, 403.0]),
            Line([70.0, 0.0]),
        ],
    },
    Pattern {
        name: "LEG",
        start: [60.0, 0.0],
        stretches: &[
            Line([270.0, 0.0]),
            Cubic([280.0, 364.0], [320.0, 624.0], [330.0, 749.0]),
            Cubic([260.0, 780.0], [268.0, 894.0], [270.0, 1040.0]),
            Line([30.0, 1026.0]),
            Cubic([-6.0, 832.0], [20.0, 416.0], [60.0, 0.0]),
        ],
    },
    Pattern {
        name: "COLLAR",
        start: [0.0, 0.0],
        stretches: &[
            Cubic([90.0, -22.0], [300.0, -22.0], [390.0, 0.0]),
            Line([410.0, 70.0]),
            Cubic([300.0, 52.0], [90.0, 52.0], [-20.0, 70.0]),
            Line([0.0, 0.0]),
        ],
    },
    Pattern {
        name: "POCKET",
        start: [22.0, 0.0],
        // Two quarters of a circle of 22 mm, 0.5523 of the radius to each control point.
        stretches: &[
            Line([118.0, 0.0]),
            Cubic([130.15, 0.0], [140.0, 9.85], [140.0, 22.0]),
            Line([140.0, 165.0]),
            Line([0.0, 165.0]),
            Line([0.0, 22.0]),
            Cubic([0.0, 9.85], [9.85, 0.0], [22.0, 0.0]),
        ],
    },
    Pattern {
        name: "BAND",
        start: [0.0, 0.0],
        stretches: &[Line([800.0, 0.0]), Line([800.0, 40.0]), Line([0.0, 40.0]), Line([0.0, 0.0])],
    },
];

/// A point of a contour, mm.
#[derive(Debug, Clone, Copy)]
struct Vertex {
    at: Point,
    /// Whether two stretches meet here.
    corner: bool,
    notch: Option<Notch>,
}

impl Vertex {
    fn new(at: Point, corner: bool) -> Self {
        Self { at, corner, notch: None }
    }
}

/// Where a notch goes: unit vectors along the contour in its sense, and into the part.
#[derive(Debug, Clone, Copy)]
struct Notch {
    along: Vector,
    inward: Vector,
}

impl Notch {
    /// How deep it is, mm.
    const DEPTH: f64 = 5.0;
    /// Half of the width of a V at the edge, mm.
    const HALF_WIDTH: f64 = 1.0;
    /// How far the next vertices are at least, mm: a V must fit between them.
    const ROOM: f64 = 1.5;
    /// Part of the vertices that have one, and the most on a piece.
    const PART: f64 = 0.04;
    const MOST: usize = 4;

    /// The innermost point.
    fn tip(self, root: Point) -> Point {
        root + self.inward * Self::DEPTH
    }
}

/// The outline of a pattern in a size, flattened.
fn flatten(pattern: &Pattern, scale: f64, tolerance: f64) -> Vec<Vertex> {
    let at = |[x, y]: [f64; 2]| Point::new(x * scale, y * scale);
    let mut vertices = Vec::new();
    let mut from = at(pattern.start);
    for stretch in pattern.stretches {
        vertices.push(Vertex::new(from, true));
        match *stretch {
            Line(to) => from = at(to),
            Cubic(b, c, to) => {
                let curve = [from, at(b), at(c), at(to)];
                let chords = chords(&curve, tolerance);
                let inner = (1..chords).map(|i| f64::from(i) / f64::from(chords));
                vertices.extend(inner.map(|t| Vertex::new(on_cubic(&curve, t), false)));
                from = at(to);
            }
        }
    }
    vertices
}

/// Into how many chords of equal parameter a cubic is cut so that none is farther from it than the tolerance: Wang's
/// formula (Wang, Xu, "The termination criterion for subdivision of the rational Bézier curves", 1991), which takes the
/// greatest second difference of the control points for the second derivative.
fn chords([a, b, c, d]: &[Point; 4], tolerance: f64) -> u32 {
    let bend = ((a - b) + (c - b)).norm().max(((b - c) + (d - c)).norm());
    ((6.0 * bend / (8.0 * tolerance)).sqrt().ceil() as u32).max(2)
}

/// A point of a cubic in Bézier form.
fn on_cubic([a, b, c, d]: &[Point; 4], t: f64) -> Point {
    let u = 1.0 - t;
    let weights = [u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t];
    let sum: Vector = [a, b, c, d].iter().zip(weights).map(|(p, w)| p.coords * w).sum();
    Point::from(sum)
}

/// A circle of radius 30 mm and a slot of 120 by 12 mm, beside and below a centre.
fn holes(centre: Point, tolerance: f64) -> [Vec<Vertex>; 2] {
    const RADIUS: f64 = 30.0;
    let chords = (std::f64::consts::PI / (1.0 - tolerance / RADIUS).acos()).ceil().max(12.0) as u32;
    let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(chords);
    let circle = (0..chords).map(angle).map(|a| {
        let at = centre + Vector::new(-40.0 + RADIUS * a.cos(), 60.0 + RADIUS * a.sin());
        Vertex::new(at, false)
    });
    let slot = [(-60.0, -90.0), (60.0, -90.0), (60.0, -78.0), (-60.0, -78.0)];
    let slot = slot.map(|(x, y)| Vertex::new(centre + Vector::new(x, y), true));
    [circle.collect(), slot.to_vec()]
}

/// A piece in its place.
struct Piece {
    name: &'static str,
    size: &'static str,
    centre: Point,
    /// In the sense in which it is cut.
    outline: Vec<Vertex>,
    holes: Vec<Vec<Vertex>>,
    drills: Vec<Point>,
}

/// Lays pieces in rows across the cloth.
struct Layout<'a> {
    order: &'a Order,
    random: ChaCha8Rng,
    /// Pieces and vertices so far.
    pieces: usize,
    vertices: usize,
    /// Where the next piece goes, and the length of its row along the cloth.
    corner: Point,
    row: f64,
}

impl<'a> Layout<'a> {
    fn new(order: &'a Order) -> Self {
        let random = ChaCha8Rng::seed_from_u64(order.seed);
        Self { order, random, pieces: 0, vertices: 0, corner: Point::origin(), row: 0.0 }
    }

    /// Moves an outline to the next free place; gives its centre.
    fn place(&mut self, outline: &mut [Vertex]) -> Point {
        let mut extent = Extent::EMPTY;
        for vertex in outline.iter() {
            extent.add(vertex.at);
        }
        let (length, height) = extent.size();
        if self.corner.y + height > self.order.width {
            self.corner = Point::new(self.corner.x + self.row + self.order.gap, 0.0);
            self.row = 0.0;
        }
        let shift = self.corner - extent.min;
        for vertex in outline.iter_mut() {
            vertex.at += shift;
        }
        let centre = self.corner + Vector::new(length, height) / 2.0;
        self.corner.y += height + self.order.gap;
        self.row = self.row.max(length);
        centre
    }

    /// Puts notches on curves of a counter-clockwise outline.
    fn notch(&mut self, outline: &mut [Vertex]) {
        let mut notches = 0;
        for i in 1..outline.len() {
            let (before, here, after) = (outline[i - 1], outline[i], outline[(i + 1) % outline.len()]);
            let room = (here.at - before.at).norm().min((after.at - here.at).norm());
            let curved = !(here.corner || after.corner);
            if notches < Notch::MOST && curved && room > Notch::ROOM && self.random.random_bool(Notch::PART) {
                let along = polyline::direction(before.at, after.at).expect("vertices on a curve are apart");
                outline[i].notch = Some(Notch { along, inward: left(along) });
                notches += 1;
            }
        }
    }
}

/// Goes round a contour the other way, from the same start.
fn turn_round(contour: &mut [Vertex]) {
    contour[1..].reverse();
    for notch in contour.iter_mut().filter_map(|vertex| vertex.notch.as_mut()) {
        notch.along = -notch.along;
    }
}

impl Iterator for Layout<'_> {
    type Item = Piece;

    fn next(&mut self) -> Option<Piece> {
        let done = self.order.vertices.map_or(self.pieces >= self.order.pieces, |most| self.vertices >= most);
        if done {
            return None;
        }
        let (size, scale) = SIZES[self.random.random_range(0..SIZES.len())];
        let pattern = &PATTERNS[self.pieces % PATTERNS.len()];
        let mut outline = flatten(pattern, scale, self.order.tolerance);
        // Left and right of a garment mirror each other; the mirror image, taken backwards, stays counter-clockwise.
        if self.random.random_bool(0.5) {
            for vertex in &mut outline {
                vertex.at.x = -vertex.at.x;
            }
            outline.reverse();
        }
        if self.random.random_bool(0.5) {
            for vertex in &mut outline {
                vertex.at = -vertex.at;
            }
        }
        let centre = self.place(&mut outline);
        self.notch(&mut outline);
        let mut holes = match (self.order.cutouts, pattern.name) {
            (true, "BODICE" | "LEG") => holes(centre, self.order.tolerance).to_vec(),
            _ => Vec::new(),
        };
        let drills = if pattern.name == "BODICE" { vec![centre] } else { Vec::new() };
        if self.random.random_bool(0.5) {
            turn_round(&mut outline);
            for hole in &mut holes {
                turn_round(hole);
            }
        }
        self.pieces += 1;
        self.vertices += outline.len();
        Some(Piece { name: pattern.name, size, centre, outline, holes, drills })
    }
}

/// A cutter file in the making.
struct CutFile<'a, W> {
    dialect: Dialect,
    /// The greatest x of an outline so far, mm.
    right: f64,
    out: &'a mut W,
}

impl<W: Write> CutFile<'_, W> {
    fn block(&mut self, text: &str) -> io::Result<()> {
        let end = match self.dialect {
            Dialect::G71 | Dialect::Inch => "*",
            Dialect::Spaced => "*  ",
        };
        write!(self.out, "{text}{end}")
    }

    fn blocks(&mut self, texts: &[&str]) -> io::Result<()> {
        texts.iter().try_for_each(|text| self.block(text))
    }

    /// A point in units of the file.
    fn coordinates(&self, at: Point) -> String {
        let unit = match self.dialect {
            Dialect::G71 | Dialect::Spaced => 0.1,
            Dialect::Inch => 0.254,
        };
        let whole = |value: f64| (value / unit).round() as i64;
        format!("X{}Y{}", whole(at.x), whole(at.y))
    }

    fn go(&mut self, at: Point) -> io::Result<()> {
        self.block(&self.coordinates(at))
    }

    fn head(&mut self, width: f64) -> io::Result<()> {
        self.block("H1")?;
        match self.dialect {
            Dialect::Spaced => return self.block("G71"),
            Dialect::G71 => self.block("G71")?,
            Dialect::Inch => {}
        }
        self.blocks(&["M70", "D2", "M15", "M20", &format!("MADE-1/W={}cm", width / 10.0)])
    }

    fn piece(&mut self, piece: &Piece, number: u32) -> io::Result<()> {
        match self.dialect {
            Dialect::G71 | Dialect::Inch => {
                self.blocks(&[&format!("N{number}"), "D2", "M15"])?;
                self.label(piece)?;
                for &drill in &piece.drills {
                    self.blocks(&["M15", &format!("{}M43", self.coordinates(drill))])?;
                }
            }
            Dialect::Spaced => {}
        }
        // What lies inside is cut first, while the piece still hangs on the cloth.
        piece.holes.iter().try_for_each(|hole| self.contour(hole))?;
        self.contour(&piece.outline)?;
        self.right = piece.outline.iter().fold(self.right, |right, vertex| right.max(vertex.at.x));
        self.block("M15")
    }

    fn label(&mut self, piece: &Piece) -> io::Result<()> {
        let place = self.coordinates(piece.centre);
        match self.dialect {
            Dialect::G71 => {
                let end = self.coordinates(piece.centre + Vector::new(16.0, 0.0));
                let text = format!("S:{}-A M:{}", piece.size, piece.name);
                self.blocks(&[&format!("{place}M31"), &text, "D2", "M15", &end])
            }
            Dialect::Inch => {
                self.blocks(&["M31", &place, piece.size])?;
                self.blocks(&["M31", &place, &format!("{} X1", piece.name)])
            }
            Dialect::Spaced => Ok(()),
        }
    }

    fn contour(&mut self, contour: &[Vertex]) -> io::Result<()> {
        let (start, rest) = contour.split_first().expect("a contour has vertices");
        self.blocks(&["M15", &self.coordinates(start.at), "M14"])?;
        for vertex in rest {
            match (self.dialect, vertex.notch) {
                (Dialect::G71, Some(notch)) => {
                    self.go(vertex.at - notch.along * Notch::HALF_WIDTH)?;
                    self.go(notch.tip(vertex.at))?;
                    self.go(vertex.at + notch.along * Notch::HALF_WIDTH)?;
                }
                (Dialect::Inch | Dialect::Spaced, Some(notch)) => {
                    let (edge, tip) = (self.coordinates(vertex.at), self.coordinates(notch.tip(vertex.at)));
                    self.blocks(&[&edge, "M19", &tip, "M15", &edge, "M14"])?;
                }
                (Dialect::Spaced, None) if vertex.corner => {
                    let corner = self.coordinates(vertex.at);
                    self.blocks(&[&corner, "M15", &corner, "M14"])?;
                }
                (Dialect::G71 | Dialect::Inch | Dialect::Spaced, None) => self.go(vertex.at)?,
            }
        }
        self.go(start.at)
    }

    fn tail(&mut self) -> io::Result<()> {
        match self.dialect {
            Dialect::G71 => {
                self.block(&format!("Q{}", self.coordinates(Point::new(self.right, 0.0))))?;
                self.out.write_all(b"M0*")
            }
            Dialect::Inch => {
                self.block(&format!("Q{}", self.coordinates(Point::new(self.right, 0.0))))?;
                self.out.write_all(b"M0*\n")
            }
            Dialect::Spaced => self.out.write_all(b"M0*"),
        }
    }
}

/// A plot in the making.
struct Plot<'a, W> {
    out: &'a mut W,
}

impl<W: Write> Plot<'_, W> {
    /// Units of a plot in a millimetre.
    const PER_MM: f64 = 40.0;
    /// Radius of the circle that stands for a drill, mm.
    const DRILL_RADIUS: f64 = 1.5;

    /// A point in units of the plot.
    fn coordinates(at: Point) -> String {
        let whole = |value: f64| (value * Self::PER_MM).round() as i64;
        format!("{},{}", whole(at.x), whole(at.y))
    }

    fn piece(&mut self, piece: &Piece) -> io::Result<()> {
        write!(self.out, "PU{};LB{} {}\x03;", Self::coordinates(piece.centre), piece.size, piece.name)?;
        for &drill in &piece.drills {
            write!(self.out, "PU{};CI{};", Self::coordinates(drill), Self::DRILL_RADIUS * Self::PER_MM)?;
        }
        piece.holes.iter().try_for_each(|hole| self.contour(hole))?;
        self.contour(&piece.outline)
    }

    fn contour(&mut self, contour: &[Vertex]) -> io::Result<()> {
        let (start, rest) = contour.split_first().expect("a contour has vertices");
        let start = Self::coordinates(start.at);
        write!(self.out, "PU{start};PD")?;
        for vertex in rest {
            let edge = Self::coordinates(vertex.at);
            write!(self.out, "{edge},")?;
            if let Some(notch) = vertex.notch {
                write!(self.out, "{},{edge},", Self::coordinates(notch.tip(vertex.at)))?;
            }
        }
        write!(self.out, "{start};")
    }
}
