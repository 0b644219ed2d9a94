//! Placing: which blocks the insertions of a file put on the cloth, and where.

use std::collections::{BTreeMap, BTreeSet};

use super::entity::{Block, NAME};
use super::lay::{Drawn, Motion};
use super::layer::layer;
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
    is_cut: bool,
    /// The layers of its lines that may be sewn.
    sewn: BTreeSet<u16>,
}

impl Held {
    pub(super) fn of(shapes: &Shapes) -> Self {
        Self { is_cut: shapes.is_cut(), sewn: shapes.sewn() }
    }
}

/// The insertions of a file beside its blocks.
#[derive(Debug)]
pub(super) struct Placing<'a> {
    /// Blocks by their names in capitals: of several with one name the first.
    names: BTreeMap<Vec<u8>, usize>,
    /// Base point and beginning of each block.
    blocks: Vec<(Point, Span)>,
    /// Blocks whose name begins with `*`.
    unnamed: BTreeSet<usize>,
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
        let is_unnamed = |k: &usize| blocks[*k].head.bytes(NAME).starts_with(b"*");
        let unnamed = (0..blocks.len()).filter(is_unnamed).collect();
        let blocks = bases.into_iter().zip(blocks).map(|(base, block)| (base, block.head.span())).collect();
        let mut placing = Self { names, blocks, unnamed, attributes, inserts };
        for i in 0..placing.inserts.len() {
            if let Some(k) = placing.block(&placing.inserts[i]) {
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
        own.below(&self.attributes[block])
    }

    /// Tells blocks that insertions in a block put there, though they have something to cut; what else of them may be sewn is
    /// not read.
    pub(super) fn nested(&self, inserts: &[Insert], held: &[Held], tally: &mut Tally) -> Vec<Unread> {
        let mut unread = Vec::new();
        for insert in inserts {
            match self.block(insert).map(|k| &held[k]) {
                None => tally.add(Thing::NoBlock, insert.span),
                Some(held) if held.is_cut => tally.add(Thing::Nested, insert.span),
                Some(held) => unread.extend(held.sewn.iter().map(|&number| Unread {
                    layer: layer(Some(number)),
                    layer_name: number.to_string(),
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
        let is_inserted = || self.inserts.iter().any(|insert| self.block(insert) == Some(block));
        !self.unnamed.contains(&block) || is_inserted()
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
            if insert.scale.iter().any(|scale| scale.abs() != 1.0) {
                tally.add(Thing::Scaled, insert.span);
            }
            let (pieces, base) = (drawn[k].pieces.clone(), self.blocks[k].0);
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
