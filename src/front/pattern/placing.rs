//! Placing: positions of blocks on the cloth from the insertions of a file.

use std::collections::{BTreeMap, BTreeSet};

use super::choice::Asked;
use super::lay::{AXIS_EPSILON, Drawn, Motion};
use super::layer::Names;
use super::piece::Making;
use super::shape::{Inserted, Shapes, Unread};
use super::tally::{Tally, Thing};
use super::text::Facts;
use crate::front::dxf::entity::{Block, NAME};
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point};
use crate::source::Span;

/// Maximum number of laid pieces.
pub(super) const MOST_PIECES: usize = 100_000;
/// Maximum number of copies of one piece; larger orders are cut in plies.
pub(super) const MOST_COPIES: usize = 2000;

/// Summary of the content of a block, independent of its role in a piece.
#[derive(Debug)]
pub(super) struct Held {
    /// True if it has anything to cut, or insertions of blocks that may have.
    pub(super) is_cut: bool,
    /// True if it has lines of the kinds that pieces have besides their outlines.
    pub(super) has_lines: bool,
    /// Pens of the other drawn content.
    drawn: BTreeSet<String>,
}

impl Held {
    pub(super) fn of(shapes: &Shapes, names: &Names) -> Self {
        let lines = shapes.lines.iter().map(|line| names.of(line.layer).to_owned());
        let unread = shapes.unread.iter().map(|unread| unread.pen.clone());
        let has_lines = shapes.lines.iter().any(|line| line.layer.is_curved() || line.layer.is_fine());
        Self { is_cut: shapes.is_cut(), has_lines, drawn: lines.chain(unread).collect() }
    }
}

/// The insertions of a file, with its blocks.
#[derive(Debug)]
pub(super) struct Placing<'a> {
    /// Indices of blocks by their names in capitals; the first of several with one name.
    names: BTreeMap<Vec<u8>, usize>,
    /// Base point and location of each block.
    blocks: Vec<(Point, Span)>,
    /// True for blocks that have a name of their own or are inserted.
    is_piece: Vec<bool>,
    /// Facts from the attributes of the insertions of each block.
    attributes: Vec<Facts>,
    /// Insertions outside all blocks.
    inserts: Vec<Inserted<'a>>,
}

impl<'a> Placing<'a> {
    /// Creates the placing for blocks with their base points.
    pub(super) fn of(asked: &Asked, blocks: &[Block], bases: Vec<Point>, inserts: Vec<Inserted<'a>>) -> Self {
        let mut names = BTreeMap::new();
        for (k, block) in blocks.iter().enumerate() {
            names.entry(block.head.bytes(NAME).to_ascii_uppercase()).or_insert(k);
        }
        let attributes = vec![Facts::default(); blocks.len()];
        let is_piece = blocks.iter().map(|block| !block.head.bytes(NAME).starts_with(b"*")).collect();
        let blocks = bases.into_iter().zip(blocks).map(|(base, block)| (base, block.head.span())).collect();
        let mut placing = Self { names, blocks, is_piece, attributes, inserts };
        for i in 0..placing.inserts.len() {
            let (name, facts) = match &placing.inserts[i] {
                Ok(insert) => (insert.name, insert.facts),
                Err((name, _)) => (*name, Facts::default()),
            };
            if let Some(k) = placing.block(name) {
                placing.is_piece[k] = true;
                placing.attributes[k] = placing.attributes[k].and(facts, asked.source, &asked.letters);
            }
        }
        placing
    }

    fn block(&self, name: &[u8]) -> Option<usize> {
        self.names.get(&name.to_ascii_uppercase()).copied()
    }

    /// Facts of a block: those from the attributes of its insertions, otherwise those from its own texts.
    pub(super) fn facts(&self, block: usize, own: Facts) -> Facts {
        own.under_attributes(&self.attributes[block])
    }

    /// Reports blocks with cuts that are inserted in other blocks. Returns the other content of nested blocks, which is not
    /// read.
    pub(super) fn nested(&self, inserts: &[Inserted], held: &[Held], tally: &mut Tally) -> Vec<Unread> {
        let mut unread = Vec::new();
        for insert in inserts {
            let (name, span) = match insert {
                Ok(insert) => (insert.name, insert.span),
                Err((name, fault)) => (*name, fault.span.unwrap_or_default()),
            };
            match self.block(name).map(|k| &held[k]) {
                None => tally.add(Thing::NoBlock, span),
                Some(held) if held.is_cut => tally.add(Thing::Nested, span),
                Some(held) => unread.extend(held.drawn.iter().map(|pen| Unread {
                    pen: pen.clone(),
                    kind: "INSERT".to_owned(),
                    span,
                })),
            }
        }
        unread
    }

    /// True if insertions place blocks beside each other, so that the middle of none lies in the box of another. The file is
    /// then a marker, whatever the sizes. `boxes` are the bounding boxes of the outlines as drawn in the blocks.
    pub(super) fn parts(&self, boxes: &[Extent]) -> bool {
        let mut laid = Vec::new();
        let mut is_placing = false;
        for insert in self.inserts.iter().flatten() {
            let Some(k) = self.block(insert.name).filter(|&k| !boxes[k].is_empty()) else { continue };
            let motion = Motion::of_insert(insert, self.blocks[k].0);
            is_placing |= !motion.is_still();
            let Extent { min, max } = boxes[k];
            let corners = [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)];
            laid.push(Extent::of(&corners.map(|corner| motion.place(corner))));
            if laid.len() > MOST_PIECES {
                return false;
            }
        }
        let boxes = Boxes::new(laid);
        let is_alone = |(k, own): (usize, &Extent)| {
            let middle = own.min + (own.max - own.min) / 2.0;
            boxes.at(middle).all(|other| other == k)
        };
        is_placing && boxes.all().iter().enumerate().all(is_alone)
    }

    /// True if a block is a piece. CAD systems use blocks without a name of their own, which begin with `*`, for dimensions,
    /// groups and sheets. Those are only pieces if they are inserted.
    pub(super) fn is_piece(&self, block: usize) -> bool {
        self.is_piece[block]
    }

    /// Maps of the pieces by the insertions; `None` if all insertions are identities.
    pub(super) fn placed(&self, drawn: &[Drawn], making: &mut Making) -> Option<Vec<(usize, Motion)>> {
        let mut is_placing = false;
        let mut placed = Vec::new();
        for insert in &self.inserts {
            let insert = match insert {
                Ok(insert) => insert,
                Err((name, fault)) => {
                    if self.block(name).is_some_and(|k| !drawn[k].pieces.is_empty()) {
                        making.out.push(fault.clone());
                    }
                    continue;
                }
            };
            let Some(k) = self.block(insert.name) else {
                making.tally.add(Thing::NoBlock, insert.span);
                continue;
            };
            let (pieces, base) = (drawn[k].pieces.clone(), self.blocks[k].0);
            let is_scaled = |scale: &f64| (scale.abs() - 1.0).abs() > AXIS_EPSILON;
            if !pieces.is_empty() && insert.scale.iter().any(is_scaled) {
                making.tally.add(Thing::Scaled, insert.span);
            }
            let motion = Motion::of_insert(insert, base);
            is_placing |= !pieces.is_empty() && !motion.is_still();
            // A file with more pieces is refused.
            let pieces = pieces.take(MOST_PIECES + 1 - placed.len().min(MOST_PIECES + 1));
            placed.extend(pieces.map(|piece| (piece, motion)));
        }
        is_placing.then_some(placed)
    }

    /// Sets the quantities of pieces, as drawn and mirrored, to their numbers of insertions if the file gives none.
    pub(super) fn as_often(&self, drawn: &mut [Drawn]) {
        let mut counts = vec![[0_u32; 2]; self.blocks.len()];
        for insert in self.inserts.iter().flatten() {
            if let Some(k) = self.block(insert.name) {
                counts[k][usize::from(insert.scale[0] * insert.scale[1] < 0.0)] += 1;
            }
        }
        for (drawn, count) in drawn.iter_mut().zip(counts).filter(|(_, count)| *count != [0, 0]) {
            drawn.quantity.get_or_insert(count);
        }
    }

    /// Reports blocks whose number of insertions differs from their quantity.
    pub(super) fn count(&self, drawn: &[Drawn], tally: &mut Tally) {
        let mut counts = vec![0; self.blocks.len()];
        self.inserts.iter().flatten().filter_map(|insert| self.block(insert.name)).for_each(|k| counts[k] += 1);
        for ((drawn, &count), &(_, span)) in drawn.iter().zip(&counts).zip(&self.blocks) {
            if drawn.pieces.is_empty() {
                continue;
            }
            if count == 0 {
                tally.add(Thing::NotPlaced, span);
            } else if drawn.quantity.is_some() && drawn.times() != count {
                tally.add(Thing::Placed, span);
            }
        }
    }
}
