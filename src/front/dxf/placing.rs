//! Placing: which blocks the insertions of a file put on the cloth, and where.

use std::collections::BTreeMap;

use super::entity::{Block, NAME};
use super::lay::{Drawn, Motion};
use super::shape::Insert;
use super::tally::{Tally, Thing};
use super::text::Facts;
use crate::geom::Point;
use crate::source::Span;

/// Most pieces that are laid.
pub(super) const MOST_PIECES: usize = 100_000;

/// The insertions of a file beside its blocks.
#[derive(Debug)]
pub(super) struct Placing<'a> {
    /// Blocks by their names in capitals: of several with one name the first.
    names: BTreeMap<Vec<u8>, usize>,
    /// Base point and beginning of each block.
    blocks: Vec<(Point, Span)>,
    /// What the first insertion of each that says so says of how often it is wanted.
    quantities: Vec<Option<Span>>,
    /// Those that stand in no block.
    inserts: Vec<Insert<'a>>,
}

impl<'a> Placing<'a> {
    /// For blocks with their base points.
    pub(super) fn of(blocks: &[(&Block, Facts)], bases: Vec<Point>, inserts: Vec<Insert<'a>>) -> Self {
        let mut names = BTreeMap::new();
        for (k, (block, _)) in blocks.iter().enumerate() {
            names.entry(block.head.bytes(NAME).to_ascii_uppercase()).or_insert(k);
        }
        let blocks = bases.into_iter().zip(blocks).map(|(base, (block, _))| (base, block.head.span())).collect();
        let mut placing = Self { names, blocks, quantities: Vec::new(), inserts };
        let mut quantities = vec![None; placing.blocks.len()];
        for insert in &placing.inserts {
            if let Some(k) = placing.block(insert) {
                quantities[k] = quantities[k].or(insert.quantity);
            }
        }
        placing.quantities = quantities;
        placing
    }

    fn block(&self, insert: &Insert) -> Option<usize> {
        self.names.get(&insert.name.to_ascii_uppercase()).copied()
    }

    /// What the insertions of a block say of how often it is wanted.
    pub(super) fn quantity(&self, block: usize) -> Option<Span> {
        self.quantities[block]
    }

    /// Tells blocks that insertions in a block put there, though they have something to cut.
    pub(super) fn see_nested(&self, inserts: &[Insert], is_cut: &[bool], tally: &mut Tally) {
        for insert in inserts {
            match self.block(insert) {
                None => tally.add(Thing::NoBlock, insert.span),
                Some(k) if is_cut[k] => tally.add(Thing::Nested, insert.span),
                Some(_) => {}
            }
        }
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
            is_placing |= !pieces.is_empty() && (insert.at != base || insert.turn != 0.0 || insert.scale != [1.0; 2]);
            // Beyond so many the file is refused.
            let pieces = pieces.take(MOST_PIECES + 1 - placed.len().min(MOST_PIECES + 1));
            placed.extend(pieces.map(|piece| (piece, Motion::of_insert(insert, base))));
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
