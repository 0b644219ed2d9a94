//! Placing: which blocks the insertions of a file put on the cloth, and where.

use std::collections::{BTreeMap, BTreeSet};

use super::entity::{Block, NAME};
use super::lay::{AXIS_EPSILON, Drawn, Motion};
use super::layer::Names;
use super::shape::{Insert, Shapes, Unread};
use super::tally::{Tally, Thing};
use super::text::Facts;
use crate::geom::Point;
use crate::source::{Source, Span};

/// Most pieces that are laid.
pub(super) const MOST_PIECES: usize = 100_000;

/// What a block holds, whichever piece it would be in.
#[derive(Debug)]
pub(super) struct Held {
    /// Whether it holds anything to cut, or a block that may.
    pub(super) is_cut: bool,
    /// The pens of what else is drawn in it.
    drawn: BTreeSet<String>,
}

impl Held {
    pub(super) fn of(shapes: &Shapes, names: &Names) -> Self {
        let lines = shapes.lines.iter().map(|line| names.of(line.layer).to_owned());
        let unread = shapes.unread.iter().map(|unread| unread.pen.clone());
        Self { is_cut: shapes.is_cut(), drawn: lines.chain(unread).collect() }
    }
}

/// The insertions of a file beside its blocks.
#[derive(Debug)]
pub(super) struct Placing<'a> {
    /// Blocks by their names in capitals: of several with one name the first.
    names: BTreeMap<Vec<u8>, usize>,
    /// Base point and beginning of each block.
    blocks: Vec<(Point, Span)>,
    /// Which blocks have a name of their own, or are put somewhere.
    is_piece: Vec<bool>,
    /// What the attributes of its insertions say of each.
    attributes: Vec<Facts>,
    /// Those that stand in no block.
    inserts: Vec<Insert<'a>>,
}

impl<'a> Placing<'a> {
    /// For blocks with their base points.
    pub(super) fn of(source: &Source, blocks: &[Block], bases: Vec<Point>, inserts: Vec<Insert<'a>>) -> Self {
        let mut names = BTreeMap::new();
        for (k, block) in blocks.iter().enumerate() {
            names.entry(block.head.bytes(NAME).to_ascii_uppercase()).or_insert(k);
        }
        let attributes = vec![Facts::default(); blocks.len()];
        let is_piece = blocks.iter().map(|block| !block.head.bytes(NAME).starts_with(b"*")).collect();
        let blocks = bases.into_iter().zip(blocks).map(|(base, block)| (base, block.head.span())).collect();
        let mut placing = Self { names, blocks, is_piece, attributes, inserts };
        for i in 0..placing.inserts.len() {
            if let Some(k) = placing.block(&placing.inserts[i]) {
                placing.is_piece[k] = true;
                placing.attributes[k] = placing.attributes[k].and(placing.inserts[i].facts, source);
            }
        }
        placing
    }

    fn block(&self, insert: &Insert) -> Option<usize> {
        self.names.get(&insert.name.to_ascii_uppercase()).copied()
    }

    /// What is said of a block: by the attributes of its insertions, else by its own texts.
    pub(super) fn facts(&self, block: usize, own: Facts) -> Facts {
        own.under_attributes(&self.attributes[block])
    }

    /// Tells blocks that insertions in a block put there, though they have something to cut; what else of them may be sewn is
    /// not read.
    pub(super) fn nested(&self, inserts: &[Insert], held: &[Held], tally: &mut Tally) -> Vec<Unread> {
        let mut unread = Vec::new();
        for insert in inserts {
            match self.block(insert).map(|k| &held[k]) {
                None => tally.add(Thing::NoBlock, insert.span),
                Some(held) if held.is_cut => tally.add(Thing::Nested, insert.span),
                Some(held) => unread.extend(held.drawn.iter().map(|pen| Unread {
                    pen: pen.clone(),
                    kind: "INSERT".to_owned(),
                    span: insert.span,
                })),
            }
        }
        unread
    }

    /// Whether a block is a piece. CAD systems have blocks without a name of their own, which begin with `*`: for dimensions,
    /// groups and sheets. Those are pieces where an insertion puts them.
    pub(super) fn is_piece(&self, block: usize) -> bool {
        self.is_piece[block]
    }

    /// Where the insertions put the pieces that blocks draw; `None` when all of them put them nowhere, at the origin.
    pub(super) fn placed(&self, drawn: &[Drawn], tally: &mut Tally) -> Option<Vec<(usize, Motion)>> {
        let mut is_placing = false;
        let mut counts = vec![0; self.blocks.len()];
        let mut placed = Vec::new();
        for insert in &self.inserts {
            let Some(k) = self.block(insert) else {
                tally.add(Thing::NoBlock, insert.span);
                continue;
            };
            counts[k] += 1;
            let (pieces, base) = (drawn[k].pieces.clone(), self.blocks[k].0);
            let is_scaled = |scale: &f64| (scale.abs() - 1.0).abs() > AXIS_EPSILON;
            if !pieces.is_empty() && insert.scale.iter().any(is_scaled) {
                tally.add(Thing::Scaled, insert.span);
            }
            let motion = Motion::of_insert(insert, base);
            is_placing |= !pieces.is_empty() && !motion.is_still();
            // Beyond so many the file is refused.
            let pieces = pieces.take(MOST_PIECES + 1 - placed.len().min(MOST_PIECES + 1));
            placed.extend(pieces.map(|piece| (piece, motion)));
        }
        if !is_placing {
            return None;
        }
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
        Some(placed)
    }
}
