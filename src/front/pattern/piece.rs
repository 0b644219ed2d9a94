//! Pieces: the shapes of a block become the cut and drawn lines of a piece, on both halves.

use std::collections::{BTreeMap, BTreeSet};

use super::chain::{Chain, REACH, chains};
use super::curves::{CurveCounts, Curves, Drafting, Nodes};
use super::doubts::Doubt;
use super::fold::{Fold, Refusal};
use super::layer::{Does, Form, Layer, Named, OUTLINE};
use super::notch::{self, Mark, NotchedOutline};
use super::outline::{Outline, outlines};
use super::retrace::{Retraced, once};
use super::shape::{Dot, Line, Shapes};
use super::spur::chains_with_spurs;
use super::tally::{Tally, Thing};
use crate::diagnostic::{Diagnostic, Diagnostics, Severity, code};
use crate::geom::budget::Budget;
use crate::geom::{Heading, Point, bits};
use crate::ir::drawing::Vertex;
use crate::ir::marker::{Label, Notch};
use crate::source::Span;

/// A piece as drawn, mm; a mirrored half is already whole.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    pub(super) span: Span,
    /// The outline without notches.
    pub(super) plain: Chain,
    /// The outline with the notches that are part of it.
    pub(super) outline: Chain,
    pub(super) slits: Vec<Notch>,
    /// Notches that are omitted or cut differently.
    pub(super) doubts: Vec<Doubt>,
    pub(super) drills: Vec<(Point, Span)>,
    /// Lines that are cut inside the piece.
    pub(super) inner: Vec<Chain>,
    /// Lines that are drawn but not cut.
    pub(super) drawn: Vec<(Named, Chain)>,
    pub(super) labels: Vec<Label>,
    /// Reasons why it cannot be cut; usually empty.
    pub(super) faults: Vec<Diagnostic>,
}

impl Piece {
    /// A piece that cannot be cut.
    pub(super) fn at_fault(span: Span, labels: Vec<Label>, said: &Diagnostics) -> Self {
        let none = || Chain { vertices: Vec::new(), is_closed: false };
        Self {
            span,
            plain: none(),
            outline: none(),
            slits: Vec::new(),
            doubts: Vec::new(),
            drills: Vec::new(),
            inner: Vec::new(),
            drawn: Vec::new(),
            labels,
            faults: said.iter().filter(|finding| finding.code.severity == Severity::Error).cloned().collect(),
        }
    }

    pub(super) fn is_at_fault(&self) -> bool {
        !self.faults.is_empty()
    }
}

/// Context and findings of making pieces.
#[derive(Debug)]
pub(super) struct Making<'o> {
    /// Depth of notches that give none, mm.
    pub(super) notch_depth: f64,
    pub(super) drafting: Drafting,
    /// Counts of the origins of curves.
    pub(super) curved: CurveCounts,
    pub(super) work: Budget,
    pub(super) tally: Tally,
    /// Lines that continue past their own start or repeat themselves.
    pub(super) retraced: Vec<Retraced>,
    /// Lines of blocks without an outline.
    pub(super) apart: Vec<(Named, Chain)>,
    pub(super) out: &'o mut Diagnostics,
}

/// Fold and curves that turn the lines of a block into those of a whole piece.
#[derive(Debug, Clone, Copy)]
struct Wholes<'a> {
    fold: Option<Fold>,
    curves: &'a Curves,
}

/// Content of one outline.
#[derive(Debug, Default)]
struct Content {
    /// Start of the content in the file.
    span: Span,
    lines: Vec<(Named, Chain)>,
    dots: Vec<Dot>,
    labels: Vec<Label>,
}

impl Making<'_> {
    /// The pieces of a block that begins at `span`, with their findings separate.
    pub(super) fn pieces_apart(&mut self, shapes: Shapes, span: Span) -> (Vec<Piece>, Diagnostics) {
        let mut said = Diagnostics::default();
        std::mem::swap(self.out, &mut said);
        let pieces = self.pieces(shapes, span);
        std::mem::swap(self.out, &mut said);
        (pieces, said)
    }

    /// The pieces of a block that begins at `span`; most blocks have one.
    fn pieces(&mut self, shapes: Shapes, span: Span) -> Vec<Piece> {
        let Shapes { lines, dots, texts, .. } = shapes;
        for line in &lines {
            self.see_stroke(line);
        }
        let nodes = Nodes::of(&lines, &dots);
        let (folds, lines): (Vec<Line>, Vec<Line>) = lines.into_iter().partition(|line| line.layer.does == Does::Fold);
        let of_edges = |fold: Fold| fold.about_longest(lines.iter().flat_map(Line::edges_of_outline));
        let mut folded: Vec<Fold> = folds.iter().filter_map(|line| Fold::of(&line.vertices)).map(of_edges).collect();
        folded.dedup_by(|next, before| next.is_same(before));
        let is_folded = !folds.is_empty() || dots.iter().any(|dot| dot.layer.does == Does::Fold);
        let mut lines = joined(lines, &mut self.retraced);
        lines
            .extend(folds.into_iter().filter_map(|line| Some((line.layer, Chain::of(line.vertices, line.is_closed)?))));
        let (edges, lines): (Vec<_>, Vec<_>) = lines.into_iter().partition(|(layer, _)| layer.does == Does::Outline);
        let edges: Vec<Chain> = edges.into_iter().map(|(_, chain)| chain).collect();
        if edges.is_empty() {
            let is_cut = lines.iter().any(|(layer, _)| layer.is_cut()) || dots.iter().any(|dot| dot.layer.is_cut());
            if is_cut {
                let dot = dots.iter().find(|dot| dot.layer.is_cut()).map(|dot| dot.span);
                let line = lines.iter().find(|(layer, _)| layer.is_cut()).map(|(_, line)| line.vertices[0].span);
                let at = if span.block > 0 { Some(span) } else { dot.or(line) };
                self.tally.add(Thing::NoOutline, at.unwrap_or(span));
            }
            self.apart.extend(lines);
            return Vec::new();
        }
        let outlines = outlines(edges, &mut self.work);
        let whole = self.unfolded(&outlines, &folded, is_folded);
        let fold = whole.iter().flatten().find_map(|(_, fold)| fold.as_ref());
        let curves = Curves::of(nodes, &lines, fold);
        let contents = self.sorted(&outlines, Content { span, lines, dots, labels: texts });
        let is_alone = outlines.len() == 1;
        let mut pieces = Vec::new();
        for ((outline, whole), content) in outlines.into_iter().zip(whole).zip(contents) {
            let Some((plain, fold)) = whole else { continue };
            let span = if is_alone && span.block > 0 { span } else { outline.edge.vertices[0].span };
            let wholes = Wholes { fold, curves: &curves };
            let before = std::mem::take(&mut self.curved);
            let mut piece = self.piece(&plain, wholes, Content { span, ..content });
            // Two that take more than half of the outline each lie in each other: no piece has a cut-out in a cut-out.
            let large: Vec<Span> = outline.large_inner().map(|line| line.vertices[0].span).collect();
            match large[..] {
                [first, _, ..] => self.tally.add(Thing::Graded, first),
                _ => large.into_iter().for_each(|span| self.tally.add(Thing::LargeCutOut, span)),
            }
            let inner: Vec<Chain> = outline.inner.iter().flat_map(|line| self.wholes(wholes, OUTLINE, line)).collect();
            piece.inner.splice(0..0, inner);
            let of_piece = std::mem::replace(&mut self.curved, before);
            self.curved.add(of_piece);
            pieces.push(piece);
        }
        pieces
    }

    /// Reports lines on layers that only define cuts or curves by points, such as notches drawn as strokes or holes drawn as
    /// crosses.
    fn see_stroke(&mut self, line: &Line) {
        let thing = match line.layer.does {
            Does::Notch(_) => Thing::StrokeOfNotch,
            Does::Drill => Thing::StrokeOfHole,
            Does::Turn | Does::Curve => Thing::StrokeOfPoints,
            Does::Outline | Does::Fold | Does::Inner | Does::Drawn | Does::Seam | Does::Sign | Does::Fine => return,
        };
        self.tally.add(thing, line.vertices.first().map_or(Span::default(), |vertex| vertex.span));
    }

    /// The whole of each outline, and the fold used to unfold it; `None`, with an error, if it is not closed.
    fn unfolded(
        &mut self,
        outlines: &[Outline],
        folds: &[Fold],
        is_folded: bool,
    ) -> Vec<Option<(Chain, Option<Fold>)>> {
        let first = &outlines[0].edge;
        let refused = match (outlines, folds) {
            (_, []) if is_folded => Some("the fold line (layer 6) has no length"),
            (_, []) => None,
            ([_], &[fold]) => match fold.unfold_outline(first) {
                Ok(whole) => return vec![Some((whole, Some(fold)))],
                Err(Refusal::Lopsided) => Some("the fold line (layer 6) lies just inside of an edge of the outline"),
                Err(Refusal::Across) => {
                    self.tally.add(Thing::FoldAcross, first.vertices[0].span);
                    None
                }
                Err(Refusal::Beside) => Some("the fold line (layer 6) lies along no edge of the outline"),
                Err(Refusal::Several) => Some("the fold line (layer 6) lies along several edges of the outline"),
            },
            ([_], _) => Some("a piece has several fold lines (layer 6)"),
            _ => Some("a fold line (layer 6) stands beside several outlines: which is half a piece is not said"),
        };
        if let Some(message) = refused {
            let finding = Diagnostic::new(&code::DXF_FOLD, message).at(first.vertices[0].span);
            self.out.push(finding.hint("let the CAD system unfold the piece, or draw its half up to the fold line"));
            return vec![None; outlines.len()];
        }
        let closed = |Outline { edge, .. }: &Outline| {
            if !edge.is_closed {
                self.out.push(open_outline(edge));
            }
            edge.is_closed.then(|| (edge.clone(), None))
        };
        outlines.iter().map(closed).collect()
    }

    /// Distributes content to the outlines that contain it. Lines and points outside all outlines go to the first; labels
    /// outside all are dropped.
    fn sorted(&mut self, outlines: &[Outline], all: Content) -> Vec<Content> {
        if outlines.len() == 1 {
            return vec![all];
        }
        let mut contents: Vec<Content> = outlines.iter().map(|_| Content::default()).collect();
        for (layer, line) in all.lines {
            let owner = self.owner(outlines, line.vertices[0].at);
            contents[owner.unwrap_or(0)].lines.push((layer, line));
        }
        for dot in all.dots {
            let owner = self.owner(outlines, dot.at);
            contents[owner.unwrap_or(0)].dots.push(dot);
        }
        for label in all.labels {
            if let Some(owner) = label.at.and_then(|at| self.owner(outlines, at)) {
                contents[owner].labels.push(label);
            }
        }
        contents
    }

    fn owner(&mut self, outlines: &[Outline], at: Point) -> Option<usize> {
        outlines.iter().position(|outline| outline.holds(at, &mut self.work))
    }

    fn piece(&mut self, coarse: &Chain, wholes: Wholes, content: Content) -> Piece {
        let Wholes { fold, curves } = wholes;
        let edge = curves.curved(coarse, OUTLINE, &mut self.drafting, &mut self.work);
        self.curved.see(&edge);
        let (mut marks, drills) = self.points(&content.dots, fold);
        for mark in &mut marks {
            mark.at = edge.lifted(mark.at, &mut self.work);
        }
        let plain = edge.line;
        let NotchedOutline { outline, slits, doubts } = notch::cut(plain.vertices.clone(), &marks, &mut self.work);
        let (mut inner, mut drawn) = (Vec::new(), Vec::new());
        for (layer, line) in content.lines {
            match layer.does {
                Does::Inner => inner.extend(self.wholes(wholes, layer.row, &line)),
                Does::Drawn | Does::Seam => {
                    let lines = on_both_sides(fold, &line).into_iter();
                    let curved = |line: Chain| curves.curved(&line, layer.row, &mut self.drafting, &mut self.work).line;
                    drawn.extend(lines.map(curved).map(|line| (layer, line)));
                }
                Does::Fine => drawn.extend(on_both_sides(fold, &line).into_iter().map(|line| (layer, line))),
                Does::Outline | Does::Notch(_) | Does::Fold | Does::Drill | Does::Sign | Does::Turn | Does::Curve => {
                    drawn.push((layer, line));
                }
            }
        }
        let around = Outline::of(plain);
        let starts = inner.iter().map(|line| line.vertices[0]).map(|vertex| (vertex.at, vertex.span));
        for (at, span) in starts.chain(drills.iter().copied()) {
            if !around.holds(at, &mut self.work) {
                self.tally.add(Thing::Outside, span);
            }
        }
        self.see_seams(&around, &drawn);
        let plain = around.edge;
        let outline = Chain { vertices: outline, is_closed: true };
        let (labels, faults) = (content.labels, Vec::new());
        Piece { span: content.span, plain, outline, slits, doubts, drills, inner, drawn, labels, faults }
    }

    /// The notches and holes given by points, on both sides of a fold.
    fn points(&self, dots: &[Dot], fold: Option<Fold>) -> (Vec<Mark>, Vec<(Point, Span)>) {
        let mut marks: Vec<Mark> = Vec::new();
        let mut drills: Vec<(Point, Span)> = Vec::new();
        let mut holes = Holes::default();
        for dot in dots {
            let mirrored = fold.filter(|fold| !fold.is_middle(dot.at));
            match dot.layer.does {
                Does::Notch(form) => {
                    let mark = self.mark(dot, form);
                    marks.push(mark);
                    marks.extend(mirrored.map(|fold| Mark {
                        at: fold.mirror(mark.at),
                        along: mark.along.map(|along| fold.mirror_way(along)),
                        ..mark
                    }));
                }
                Does::Drill => {
                    // A hole may be drawn twice, as a circle and as its centre.
                    if holes.is_new(dot.at) {
                        for at in [Some(dot.at), mirrored.map(|fold| fold.mirror(dot.at))].into_iter().flatten() {
                            holes.add(at);
                            drills.push((at, dot.span));
                        }
                    }
                }
                Does::Outline
                | Does::Fold
                | Does::Inner
                | Does::Drawn
                | Does::Seam
                | Does::Sign
                | Does::Turn
                | Does::Curve
                | Does::Fine => {}
            }
        }
        (marks, drills)
    }

    /// Reports seam lines that enclose their outline.
    fn see_seams(&mut self, around: &Outline, drawn: &[(Named, Chain)]) {
        let seams = drawn.iter().filter(|(layer, line): &&(Named, Chain)| layer.does == Does::Seam && line.is_closed);
        for (_, seam) in seams.filter(|(_, seam)| around.is_in(seam)) {
            self.tally.add(Thing::SeamOutside, seam.vertices[0].span);
        }
    }

    /// The images of a cut line on both sides of a fold, with their curves.
    fn wholes(&mut self, Wholes { fold, curves }: Wholes, layer: &Layer, line: &Chain) -> Vec<Chain> {
        let mut lines = Vec::new();
        for line in on_both_sides(fold, line) {
            let curved = curves.curved(&line, layer, &mut self.drafting, &mut self.work);
            self.curved.see(&curved);
            lines.push(curved.line);
        }
        lines
    }

    fn mark(&self, dot: &Dot, form: Form) -> Mark {
        let Dot { at, depth, width, heading, span, .. } = *dot;
        let depth = if depth > 0.0 { depth } else { self.notch_depth };
        Mark { form, at, depth, width, along: heading.map(Heading::unit), span }
    }
}

fn on_both_sides(fold: Option<Fold>, line: &Chain) -> Vec<Chain> {
    fold.map_or_else(|| vec![line.clone()], |fold| fold.unfold(line))
}

/// Positions of holes, in cells as wide as the minimum distance of separate holes.
#[derive(Debug, Default)]
struct Holes(BTreeMap<[i64; 2], Vec<Point>>);

impl Holes {
    fn cell(at: Point) -> [i64; 2] {
        [at.x, at.y].map(|value| (value / REACH).floor() as i64)
    }

    /// True if there is no hole at the position yet.
    fn is_new(&self, at: Point) -> bool {
        let [x, y] = Self::cell(at);
        let around = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y]));
        around.filter_map(|cell| self.0.get(&cell)).flatten().all(|hole| (hole - at).norm() > REACH)
    }

    fn add(&mut self, at: Point) {
        self.0.entry(Self::cell(at)).or_default().push(at);
    }
}

/// Joins the lines of a layer where the convention allows them to be drawn in parts.
fn joined(lines: Vec<Line>, retraced: &mut Vec<Retraced>) -> Vec<(Named, Chain)> {
    let mut layers: Vec<(Named, Vec<Chain>)> = Vec::new();
    let mut places: BTreeMap<u16, usize> = BTreeMap::new();
    for Line { layer, vertices, is_closed } in lines {
        let Some(chain) = Chain::of(vertices, is_closed) else { continue };
        let place = *places.entry(layer.place).or_insert_with(|| {
            layers.push((layer, Vec::new()));
            layers.len() - 1
        });
        layers[place].1.push(chain);
    }
    for (_, lines) in &mut layers {
        drop_doubled(lines);
    }
    let mut unsaid = Vec::new();
    let join = |(layer, lines): (Named, Vec<Chain>)| {
        let lines = match layer.does {
            Does::Outline => chains_with_spurs(&lines, retraced),
            Does::Inner => once(chains(lines), retraced),
            Does::Fine => once(chains(lines), &mut unsaid),
            Does::Drawn | Does::Seam => chains(lines),
            Does::Notch(_) | Does::Fold | Does::Drill | Does::Sign | Does::Turn | Does::Curve => lines,
        };
        lines.into_iter().map(move |line| (layer, line))
    };
    layers.into_iter().flat_map(join).collect()
}

/// Drops lines that are drawn again, in either direction. Of an open and a closed one, the closed one stays.
fn drop_doubled(lines: &mut Vec<Chain>) {
    let way = |line: &Chain| {
        let way: Vec<[u64; 2]> = line.vertices.iter().map(|vertex| bits(vertex.at)).collect();
        let back: Vec<[u64; 2]> = way.iter().rev().copied().collect();
        way.min(back)
    };
    let closed: BTreeSet<_> = lines.iter().filter(|line| line.is_closed).map(way).collect();
    let mut seen: BTreeSet<Vec<[u64; 2]>> = BTreeSet::new();
    lines.retain(|line| {
        let way = way(line);
        (line.is_closed || !closed.contains(&way)) && seen.insert(way)
    });
}

/// The error for an outline that does not close.
fn open_outline(edge: &Chain) -> Diagnostic {
    let ends: [Vertex; 2] = [edge.vertices[0], edge.vertices[edge.vertices.len() - 1]];
    let gap = (ends[1].at - ends[0].at).norm();
    let message = format!("the outline that begins here does not close: its ends are {gap:.1} mm apart");
    let finding = Diagnostic::new(&code::DXF_OPEN_OUTLINE, message).at(ends[0].span);
    finding.hint("close it in the CAD system: no key of the profile closes gaps of patterns")
}
