//! Random markers on the grid of a file: what is drawn, and the marker that a reader must make of it.

use std::f64::consts::TAU;

use cutc::geom::{Heading, Point, Vector};
use cutc::ir::list::{FULL_SPEED, Joint, Segment};
use cutc::ir::marker::{
    Contour, Drill, Event, Label, Marker, Notch, NotchForm, NotchKind, NotchStroke, OutlineNotch, Piece,
};
use cutc::ir::toolpath;
use cutc::source::Span;
use fastrand::Rng;

/// How a file of the dialect looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shape {
    /// 0.1 mm under G71, pieces, a title, slits before their contour.
    Metric,
    /// 0.254 mm without a unit code, slits inside contours.
    Inch,
    /// 0.1 mm under G71, blanks behind blocks, no pieces, lifts at corners.
    Spaced,
}

impl Shape {
    /// What a number of the file is, mm.
    pub(crate) fn unit(self) -> f64 {
        match self {
            Self::Metric | Self::Spaced => 0.1,
            Self::Inch => 25.4 / 100.0,
        }
    }
}

/// A place in units of the file.
pub(crate) type Place = [i64; 2];

/// A vertex of an outline.
#[derive(Debug)]
pub(crate) struct Vertex {
    pub(crate) at: Place,
    /// Whether the knife is lifted there.
    pub(crate) lift: bool,
    /// The slit that starts there.
    pub(crate) slit: Option<Slit>,
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct Slit {
    pub(crate) tip: Place,
    /// A crossbar.
    pub(crate) bar: Option<[Place; 2]>,
    /// Whether M19 says that it is one.
    pub(crate) named: bool,
}

#[derive(Debug)]
pub(crate) struct Text {
    pub(crate) at: Place,
    /// A second place, which gives the direction.
    pub(crate) second: Option<Place>,
    pub(crate) words: &'static str,
}

/// One part. Its first contour is a cut-out when there are two.
#[derive(Debug)]
pub(crate) struct Part {
    pub(crate) number: u32,
    pub(crate) cut_out: Vec<Place>,
    pub(crate) outline: Vec<Vertex>,
    /// Index of the apex of each V notch.
    vees: Vec<usize>,
    pub(crate) drills: Vec<(Place, u8)>,
    pub(crate) labels: Vec<Text>,
    pub(crate) events: Vec<toolpath::Event>,
    /// The code M60 + this.
    pub(crate) speed: Option<u8>,
    /// Whether it is cut slowly.
    pub(crate) slow: bool,
    /// Inches per minute.
    pub(crate) feed: Option<u32>,
}

/// All of a file.
#[derive(Debug)]
pub(crate) struct Sheet {
    pub(crate) shape: Shape,
    pub(crate) parts: Vec<Part>,
    pub(crate) closing: Vec<toolpath::Event>,
}

/// The room of a part on the table, and the distance of its vertices from the middle, mm.
const ROOM: f64 = 600.0;
const RADII: [f64; 2] = [160.0, 240.0];
/// The same for drills and labels, and for cut-outs.
const INNER: [f64; 2] = [60.0, 80.0];
const CUT_OUT: f64 = 40.0;
/// Depth of slits, and half of a crossbar, mm.
const SLITS: [f64; 2] = [3.0, 12.0];
const HALF_BAR: f64 = 2.5;
/// Half of the mouth of a V notch, and its depth, mm.
const HALF_MOUTH: f64 = 1.1;
const VEE_DEPTH: f64 = 5.0;

fn add([x, y]: Place, [dx, dy]: Place) -> Place {
    [x + dx, y + dy]
}

fn between(random: &mut Rng, [least, greatest]: [f64; 2]) -> f64 {
    least + random.f64() * (greatest - least)
}

impl Sheet {
    pub(crate) fn random(random: &mut Rng, shape: Shape) -> Self {
        let parts = (0..random.u32(1..=4)).map(|i| Part::random(random, shape, i)).collect();
        Self { shape, parts, closing: events(random) }
    }

    /// The marker that it is, without spans.
    pub(crate) fn marker(&self) -> Marker {
        let mut marker = Marker { unit: self.shape.unit(), ..Marker::default() };
        for part in &self.parts {
            let piece = part.piece(self.shape, &mut marker);
            marker.pieces.push(piece);
        }
        marker.closing = self.closing.iter().map(|&kind| Event { kind, span: Span::default() }).collect();
        marker
    }
}

fn events(random: &mut Rng) -> Vec<toolpath::Event> {
    let kinds = [toolpath::Event::Stop, toolpath::Event::Advance];
    (0..random.usize(..3)).map(|_| kinds[random.usize(..2)]).collect()
}

impl Part {
    fn random(random: &mut Rng, shape: Shape, index: u32) -> Self {
        let unit = shape.unit();
        let way =
            |angle: f64, length: f64| [angle.cos(), angle.sin()].map(|part| (part * length / unit).round() as i64);
        let middle = way(0.0, ROOM * f64::from(index));
        let count = random.usize(6..=12);
        let corners: Vec<(f64, Place)> = (0..count)
            .map(|i| {
                let angle = (i as f64 + 0.3 * random.f64()) * TAU / count as f64;
                (angle, add(middle, way(angle, between(random, RADII))))
            })
            .collect();
        let (mut outline, mut vees) = (Vec::new(), Vec::new());
        for (i, &(angle, at)) in corners.iter().enumerate() {
            // A slit inside a contour cannot stand where it begins.
            let slit = (random.u8(..3) == 0 && (i > 0 || shape != Shape::Inch)).then(|| {
                let tip = add(at, way(angle + TAU / 2.0, between(random, SLITS)));
                let [dx, dy] = way(angle + TAU / 4.0, HALF_BAR);
                let bar = random.bool().then_some([add(tip, [dx, dy]), add(tip, [-dx, -dy])]);
                Slit { tip, bar, named: random.bool() }
            });
            outline.push(Vertex { at, lift: shape == Shape::Spaced && i > 0 && random.bool(), slit });
            if random.u8(..3) == 0 {
                let next = corners[(i + 1) % count].1;
                let along = Vector::new((next[0] - at[0]) as f64, (next[1] - at[1]) as f64).normalize();
                let half = [i64::midpoint(at[0], next[0]), i64::midpoint(at[1], next[1])];
                for (across, inward) in [(-HALF_MOUTH, 0.0), (0.0, VEE_DEPTH), (HALF_MOUTH, 0.0)] {
                    let way = (along * across + Vector::new(-along.y, along.x) * inward) / unit;
                    let at = add(half, [way.x.round() as i64, way.y.round() as i64]);
                    outline.push(Vertex { at, lift: false, slit: None });
                }
                vees.push(outline.len() - 2);
            }
        }
        let has_pieces = shape != Shape::Spaced;
        let cut_out = (0..5).map(|i| add(middle, way(f64::from(i) * TAU / 5.0, CUT_OUT)));
        let somewhere = |random: &mut Rng| add(middle, way(random.f64() * TAU, between(random, INNER)));
        let text = |random: &mut Rng| {
            let at = somewhere(random);
            let second =
                (shape == Shape::Metric && random.bool()).then(|| add(at, [random.i64(10..90), random.i64(0..9)]));
            Text { at, second, words: ["FRONT 1", "M14", "A/B=3,5", "X5Y5"][random.usize(..4)] }
        };
        Self {
            number: if has_pieces { 3 * index + 2 } else { index + 1 },
            cut_out: if has_pieces && random.bool() { cut_out.collect() } else { Vec::new() },
            outline,
            vees,
            drills: (0..random.usize(..3)).map(|_| (somewhere(random), random.u8(1..=4))).collect(),
            labels: (0..random.usize(..3)).map(|_| text(random)).collect(),
            events: events(random),
            speed: (has_pieces && random.bool()).then(|| random.u8(..8)),
            slow: random.bool(),
            feed: has_pieces.then(|| random.u32(10..2000)),
        }
    }

    fn piece(&self, shape: Shape, marker: &mut Marker) -> Piece {
        let point = |[x, y]: Place| Point::new(x as f64 * shape.unit(), y as f64 * shape.unit());
        let of_piece = self.speed.map_or(FULL_SPEED, |speed| 95 - 5 * speed);
        let percent = if self.slow { (75 * u32::from(of_piece) / 100) as u8 } else { of_piece };
        let span = Span::default();
        let mut piece = Piece { number: self.number, ..Piece::default() };
        let mut contour = |vertices: &[(Place, bool)]| {
            let next = vertices.iter().cycle().skip(1);
            let chain = vertices.iter().zip(next).map(|(&(from, lift), &(to, _))| Segment {
                from: point(from),
                to: point(to),
                span,
                joint: Joint { lift, ..Joint::default() },
                percent,
            });
            let range = marker.list.append(chain).expect("an outline has segments");
            piece.contours.push(Contour { range, closed: true });
        };
        if !self.cut_out.is_empty() {
            contour(&self.cut_out.iter().map(|&at| (at, false)).collect::<Vec<_>>());
        }
        contour(&self.outline.iter().map(|vertex| (vertex.at, vertex.lift)).collect::<Vec<_>>());
        for Vertex { at, slit, .. } in &self.outline {
            let Some(Slit { tip, bar, .. }) = *slit else { continue };
            let kind = bar.map_or(NotchKind::Slit, |[from, to]| {
                NotchKind::T(NotchStroke { from: point(from), to: point(to), span })
            });
            piece.notches.push(Notch { kind, root: point(*at), tip: point(tip), percent, span });
        }
        piece.outline_notches = (self.vees.iter())
            .map(|&i| {
                let [before, apex, after] = [i - 1, i, (i + 1) % self.outline.len()].map(|i| point(self.outline[i].at));
                let mouth = [before, after];
                OutlineNotch { form: NotchForm::V, outwards: false, mouth, tip: apex, segments: 2, span }
            })
            .collect();
        piece.drills = self.drills.iter().map(|&(at, tool)| Drill { at: point(at), tool, span }).collect();
        piece.labels = (self.labels.iter())
            .map(|text| {
                let at = point(text.at);
                let heading = text.second.map(|second| Heading::of(point(second) - at));
                Label { at: Some(at), heading, span, mirrored: None }
            })
            .collect();
        piece.events = self.events.iter().map(|&kind| Event { kind, span }).collect();
        piece.feed = self.feed.map(|feed| f64::from(feed) * 25.4 / 60.0);
        piece
    }
}
