use super::*;
use crate::geom::{Heading, Point, Rotation, Vector};
use crate::ir::list::Segment;
use crate::ir::marker::{
    self, Contour, Cut, Drill, Field, Label, Marker, Notch, NotchForm, NotchKind, OutlineNotch, Piece,
};
use crate::ir::toolpath::{self, Air, Edge, Overcut, PlungeCut, Pose, Run, Step, Toolpath};
use crate::source::Span;

/// Seeded random numbers (`splitmix64`, Steele, Lea & Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }

    fn flag(&mut self) -> bool {
        self.below(2) == 0
    }

    fn overcut(&mut self) -> Overcut {
        let mut length = || if self.flag() { self.number().abs() } else { 0.0 };
        Overcut { own: length(), other: length() }
    }

    /// Numbers on a grid, full mantissas, and magnitudes far from 1.
    fn number(&mut self) -> f64 {
        let fraction = (self.next() >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
        match self.below(4) {
            0 => self.below(20_000) as f64 * 0.1,
            1 => fraction * 1e-12,
            2 => fraction * 1e15,
            _ => fraction * 3000.0,
        }
    }

    fn point(&mut self) -> Point {
        Point::new(self.number(), self.number())
    }

    fn span(&mut self) -> Span {
        let start = self.below(1000) as u32;
        Span { start, end: start + self.below(20) as u32, block: self.below(300) as u32 }
    }

    fn joint(&mut self) -> Joint {
        Joint { lift: self.flag(), full_advance: self.flag(), no_overcut: self.flag() }
    }

    fn percent(&mut self) -> u8 {
        if self.flag() { 100 } else { 1 + self.below(99) as u8 }
    }

    fn event(&mut self) -> marker::Event {
        marker::Event { kind: EVENTS[self.below(2) as usize].1, span: self.span() }
    }

    fn pose(&mut self) -> Pose {
        Pose { centre: self.point(), c: Rotation(self.number()) }
    }

    fn end(&mut self) -> End {
        End { corner: self.flag(), bare: self.flag(), side: SIDES[self.below(3) as usize].1 }
    }

    fn some<T>(&mut self, most: u64, mut make: impl FnMut(&mut Self) -> T) -> Vec<T> {
        (0..self.below(most + 1)).map(|_| make(self)).collect()
    }
}

fn marker(random: &mut Random) -> Marker {
    let mut marker = Marker { unit: random.number().abs(), ..Marker::default() };
    for _ in 0..random.below(4) {
        let mut piece = Piece {
            number: random.below(99) as u32,
            copy: random.below(3) as u32,
            span: random.span(),
            section: random.some(1, |r| [r.point().x, r.point().x]).pop(),
            drills: random.some(2, |r| Drill { at: r.point(), tool: 1 + r.below(4) as u8, span: r.span() }),
            notches: random.some(2, |r| Notch {
                kind: NotchKind::Slit,
                root: r.point(),
                tip: r.point(),
                percent: r.percent(),
                span: r.span(),
            }),
            contours: Vec::new(),
            outline_notches: random.some(2, |r| OutlineNotch {
                form: [NotchForm::V, NotchForm::Castle, NotchForm::U][r.span().block as usize % 3],
                outwards: r.span().block % 2 == 1,
                mouth: [r.point(), r.point()],
                tip: r.point(),
                segments: r.span().block,
                span: r.span(),
            }),
            labels: random.some(2, |r| {
                let at = r.flag().then(|| r.point());
                let heading = r.flag().then(|| Heading::new(r.number()));
                Label { at, heading, span: r.span(), mirrored: r.flag().then(|| r.span()) }
            }),
            events: random.some(2, Random::event),
            feed: random.flag().then(|| random.number()),
            fields: random.some(3, |r| Field { letter: b'A' + r.below(26) as u8, span: r.span() }),
        };
        for _ in 0..random.below(3) {
            let mut at = random.point();
            let mut chain = random.some(5, |r| {
                let from = at;
                at = r.point();
                Segment { from, to: at, span: r.span(), joint: r.joint(), percent: r.percent() }
            });
            let (to, joint, percent) = (random.point(), random.joint(), random.percent());
            chain.push(Segment { from: at, to, span: Span::default(), joint, percent });
            let range = marker.list.append(chain).expect("a segment at least");
            let range = if random.flag() { range.reversed() } else { range };
            piece.contours.push(Contour { range, closed: random.flag() });
        }
        marker.pieces.push(piece);
    }
    marker.closing = random.some(2, Random::event);
    add_cuts(&mut marker, random);
    marker
}

/// Adds cuts along contours and cuts with segments of their own.
fn add_cuts(marker: &mut Marker, random: &mut Random) {
    for (place, piece) in (0..).zip(&marker.pieces) {
        let sides = [random.flag().then_some(place), random.flag().then_some(0)];
        for contour in &piece.contours {
            let range = if random.flag() {
                contour.range
            } else {
                let [from, to] = [random.point(), random.point()];
                let (joint, percent) = (random.joint(), random.percent());
                let segment = Segment { from, to, span: random.span(), joint, percent };
                marker.list.append([segment]).expect("a segment")
            };
            marker.cuts.push(Cut { kind: KINDS[random.below(4) as usize].1, piece: place, sides, range });
        }
    }
}

fn chords(random: &mut Random) -> (Vec<Point>, Vec<Span>) {
    let spans = [random.some(4, Random::span), vec![random.span()]].concat();
    ((0..=spans.len()).map(|_| random.point()).collect(), spans)
}

fn step(random: &mut Random) -> Step {
    match random.below(6) {
        0 => {
            let (points, spans) = chords(random);
            Step::Run(Run {
                joints: points.iter().map(|_| random.joint()).collect(),
                points,
                shape: SHAPES[random.below(2) as usize].1,
                orientation: ORIENTATION_MODES[random.below(2) as usize].1,
                front: random.number(),
                heel: random.number(),
                feeds: spans
                    .iter()
                    .map(|_| if random.flag() { f64::INFINITY } else { random.number().abs() + 1.0 })
                    .collect(),
                junctions: if random.flag() { spans.iter().map(|_| true).collect() } else { Vec::new() },
                ends: [random.end(), random.end()],
                turned: random.flag(),
                edge: if random.flag() { Edge::Back } else { Edge::Front },
                start: random.pose(),
                end: random.pose(),
                spans,
            })
        }
        1 => {
            let (points, spans) = chords(random);
            Step::PlungeCut(PlungeCut {
                points,
                spans,
                along: Vector::new(random.number(), random.number()),
                front: random.number(),
                heel: random.number(),
                ends: [random.end(), random.end()],
                turned: random.flag(),
                edge: if random.flag() { Edge::Back } else { Edge::Front },
                overcut: [random.overcut(), random.overcut()],
                pose: random.pose(),
            })
        }
        2 => Step::Turn(Air { from: random.pose(), to: random.pose() }),
        3 => Step::Travel(Air { from: random.pose(), to: random.pose() }),
        4 => Step::Drill(toolpath::Drill { at: random.point(), tool: random.below(9) as u8, span: random.span() }),
        _ => Step::Event(EVENTS[random.below(2) as usize].1),
    }
}

#[test]
fn a_marker_survives_the_round_trip_to_the_bit() {
    for seed in 0..500 {
        let before = marker(&mut Random(seed));
        let text = print_marker(&before);
        let after = read_marker(&text).unwrap_or_else(|error| panic!("seed {seed}: {error}\n{text}"));
        assert_eq!(print_marker(&after), text, "seed {seed}");
        assert_eq!(after.unit.to_bits(), before.unit.to_bits());
        assert_eq!((after.pieces.len(), &after.closing), (before.pieces.len(), &before.closing));
        for (a, b) in after.pieces.iter().zip(&before.pieces) {
            assert_eq!((a.number, a.copy, a.span), (b.number, b.copy, b.span));
            assert_eq!(
                (&a.drills, &a.notches, &a.outline_notches, &a.labels),
                (&b.drills, &b.notches, &b.outline_notches, &b.labels)
            );
            assert_eq!((&a.events, a.feed, &a.fields), (&b.events, b.feed, &b.fields));
            let contents = |m: &Marker, c: &Contour| {
                let both_ways = [c.range, c.range.reversed()];
                let walks = both_ways.map(|range| m.list.walk(range).map(|(_, s)| s).collect::<Vec<_>>());
                (c.closed, walks)
            };
            let of = |m: &Marker, p: &Piece| p.contours.iter().map(|c| contents(m, c)).collect::<Vec<_>>();
            assert_eq!(of(&after, a), of(&before, b), "seed {seed}");
        }
    }
}

#[test]
fn a_toolpath_survives_the_round_trip_to_the_bit() {
    for seed in 0..500 {
        let mut random = Random(seed);
        let before = Toolpath {
            piece: random.below(99) as u32,
            part: random.below(3) as u32,
            tolerance: random.number(),
            entry: random.pose(),
            steps: random.some(8, step),
        };
        let text = print_toolpath(&before);
        assert_eq!(read_toolpath(&text).as_ref(), Ok(&before), "seed {seed}:\n{text}");
    }
}

#[test]
fn the_examples_of_the_documentation_are_what_is_printed() {
    let doc: String =
        include_str!("mod.rs").lines().filter_map(|l| l.strip_prefix("//!")).fold(String::new(), |mut text, line| {
            text.push_str(line.strip_prefix(' ').unwrap_or(line));
            text.push('\n');
            text
        });
    let examples: Vec<&str> = doc.split("```text\n").skip(1).filter_map(|e| e.split("```").next()).collect();
    assert_eq!(print_marker(&read_marker(examples[0]).expect("a marker")), examples[0]);
    assert_eq!(print_toolpath(&read_toolpath(examples[1]).expect("a toolpath")), examples[1]);
}

#[test]
fn comments_and_blank_lines_say_nothing() {
    let text = "; a title\n\nmarker unit-mm 0 ; not rounded\n\tpiece 7\n";
    assert_eq!(print_marker(&read_marker(text).expect("a marker")), "marker unit-mm 0\npiece 7\n");
}

#[test]
fn an_error_names_the_line_and_what_was_expected() {
    let head = "marker unit-mm 0.1\n";
    let path = "toolpath piece 1 tolerance-mm 0 entry 0 0 c-rad 0\n";
    let marker = |text: &str| read_marker(text).expect_err("a fault").to_string();
    let toolpath = |text: &str| read_toolpath(text).expect_err("a fault").to_string();
    assert_eq!(marker(""), "line 1: expected marker");
    assert_eq!(marker(path), "line 1: expected marker");
    assert_eq!(marker(&format!("{head}drill 1 2 tool 1")), "line 2: expected piece");
    assert_eq!(marker(&format!("{head}piece 1\ndrill 1 2 tool 999")), "line 3: expected the number of a drill");
    assert_eq!(marker(&format!("{head}piece 1\ncontour closed")), "line 3: expected a segment in the next line");
    assert_eq!(marker(&format!("{head}piece 1\ncontour round")), "line 3: expected closed or open");
    assert_eq!(marker(&format!("{head}piece 1\ncontour open\n to 1 1")), "line 4: expected from");
    assert_eq!(marker(&format!("{head}piece 1\ncontour open\n from 1 1 to 2 NaN")), "line 4: expected a finite number");
    assert_eq!(
        marker(&format!("{head}piece 1\ncontour open\n from 1 1 to 2 2\n from 3 3 to 4 4")),
        "line 5: expected to, since a segment starts where the one before it ends"
    );
    assert_eq!(
        marker(&format!("{head}piece 1\ncontour open\n from 1 1 to 2 2 @3..4 lift")),
        "line 4: expected a span @start..end#block"
    );
    assert_eq!(
        marker(&format!("{head}piece 1\ncontour open\n from 1 1 to 2 2 lift up")),
        "line 4: expected the end of the line"
    );
    assert_eq!(toolpath(&format!("{path}event go")), "line 2: expected stop or advance");
    assert_eq!(toolpath(&format!("{path}jump")), "line 2: expected run, stab, turn, travel, drill or event");
    assert_eq!(toolpath(&format!("{path}stab along 1 0 front 0 heel 0\n")), "line 3: expected ends");
}
