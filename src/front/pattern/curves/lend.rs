//! Turn and curve points for sizes without any, taken from the same vertices of another size of the piece.

use std::collections::BTreeMap;

use crate::front::pattern::layer::{Does, Layer};
use crate::front::pattern::shape::{Dot, Line, Shapes};
use crate::geom::Point;
use crate::machine::patterns::Dxf;
use crate::source::Span;

/// Piece name of a block, and whether the block has the sample size.
#[derive(Debug, Clone, Copy)]
pub(in crate::front::pattern) struct Size<'a> {
    pub(in crate::front::pattern) piece: Option<&'a [u8]>,
    pub(in crate::front::pattern) is_sample: bool,
}

/// Gives blocks without turn and curve points those of another size of the same piece with equally many vertices per line: the
/// sample size if it has some, otherwise the first. Returns the lender of each block.
pub(in crate::front::pattern) fn lend(blocks: &mut [Shapes], sizes: &[Size]) -> Vec<Option<usize>> {
    let mut lenders: BTreeMap<&[u8], usize> = BTreeMap::new();
    for (k, size) in sizes.iter().enumerate().filter(|(k, _)| has_dots(&blocks[*k])) {
        let Some(piece) = size.piece else { continue };
        let known = lenders.entry(piece).or_insert(k);
        if size.is_sample && !sizes[*known].is_sample {
            *known = k;
        }
    }
    let lender =
        |k: usize| sizes[k].piece.and_then(|piece| lenders.get(piece)).filter(|_| !has_dots(&blocks[k])).copied();
    let of_blocks: Vec<Option<usize>> = (0..blocks.len()).map(lender).collect();
    for (k, lender) in of_blocks.iter().enumerate() {
        if let Some(lender) = *lender {
            let dots = lent(&blocks[lender], &blocks[k]);
            blocks[k].dots.extend(dots);
        }
    }
    of_blocks
}

fn says(dot: &Dot) -> bool {
    matches!(dot.layer.does, Does::Turn | Does::Curve)
}

fn has_dots(block: &Shapes) -> bool {
    block.dots.iter().any(says)
}

fn lines<'a>(block: &'a Shapes) -> impl Iterator<Item = &'a Line> {
    block.lines.iter().filter(|line| line.layer.is_curved())
}

/// The points of one block, moved to the vertices of another; empty if their lines differ.
fn lent(lender: &Shapes, block: &Shapes) -> Vec<Dot> {
    let shape = |line: &Line| (line.layer.number, line.vertices.len(), line.is_closed);
    if !lines(lender).map(shape).eq(lines(block).map(shape)) {
        return Vec::new();
    }
    let vertices = |block| lines(block).flat_map(|line| &line.vertices).map(|vertex| vertex.at);
    let mut kinds: BTreeMap<[i64; 2], Vec<(Point, &'static Layer)>> = BTreeMap::new();
    let cell = |at: Point| [at.x, at.y].map(|value| (value / Dxf::POINT_OFF).round() as i64);
    lender
        .dots
        .iter()
        .filter(|dot| says(dot))
        .for_each(|dot| kinds.entry(cell(dot.at)).or_default().push((dot.at, dot.layer)));
    let mut dots = Vec::new();
    for (its, own) in vertices(lender).zip(vertices(block)) {
        let [x, y] = cell(its);
        let around = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y]));
        let near = around.filter_map(|cell| kinds.get(&cell)).flatten();
        let near = near.filter(|(at, _)| (at - its).norm() <= Dxf::POINT_OFF);
        dots.extend(near.map(|&(_, layer)| Dot {
            layer,
            at: own,
            depth: 0.0,
            width: 0.0,
            heading: None,
            span: Span::default(),
        }));
    }
    dots
}
