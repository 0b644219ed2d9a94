//! Boxes by the cells of a grid, so that those around a place are found among a hundred thousand.

use std::collections::BTreeMap;

use crate::geom::{Extent, Point};

/// A box over more cells than this stands in a list of its own: nested ones would fill every cell.
const MOST_CELLS: i64 = 64;
/// Smallest cell, mm: boxes without size have one, too.
const LEAST_CELL: f64 = 1.0;

/// Some boxes, known by their index.
#[derive(Debug)]
pub(super) struct Boxes {
    /// Side of a cell, mm: the mean size of a box, so that most lie over four cells at the most.
    cell: f64,
    cells: BTreeMap<[i64; 2], Vec<usize>>,
    large: Vec<usize>,
}

impl Boxes {
    /// Boxes, each known by its index.
    pub(super) fn new(extents: &[Extent]) -> Self {
        let size = |extent: &Extent| {
            let (width, height) = extent.size();
            width.max(height)
        };
        let mean = extents.iter().map(size).sum::<f64>() / extents.len().max(1) as f64;
        let mut boxes = Self { cell: mean.max(LEAST_CELL), cells: BTreeMap::new(), large: Vec::new() };
        for (i, extent) in extents.iter().enumerate() {
            let ([left, low], [right, high]) = (boxes.cell_of(extent.min), boxes.cell_of(extent.max));
            if (right - left + 1).saturating_mul(high - low + 1) > MOST_CELLS {
                boxes.large.push(i);
                continue;
            }
            for cell in (left..=right).flat_map(|x| (low..=high).map(move |y| [x, y])) {
                boxes.cells.entry(cell).or_default().push(i);
            }
        }
        boxes
    }

    /// The boxes that may hold a place; every one that holds it is among them.
    pub(super) fn near(&self, at: Point) -> impl Iterator<Item = usize> {
        let cell = self.cells.get(&self.cell_of(at)).into_iter().flatten();
        cell.chain(&self.large).copied()
    }

    fn cell_of(&self, at: Point) -> [i64; 2] {
        [at.x, at.y].map(|mm| (mm / self.cell).floor() as i64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_box_that_holds_a_place_is_near_it_and_few_others_are() {
        let mut random = fastrand::Rng::with_seed(1);
        let extent = |random: &mut fastrand::Rng, size: f64| {
            let min = Point::new(1000.0 * random.f64() - 500.0, 1000.0 * random.f64() - 500.0);
            Extent { min, max: min + crate::geom::Vector::new(size * random.f64(), size * random.f64()) }
        };
        let mut extents: Vec<Extent> = (0..2000).map(|_| extent(&mut random, 20.0)).collect();
        extents.extend((0..10).map(|_| extent(&mut random, 900.0)));
        let boxes = Boxes::new(&extents);
        for _ in 0..1000 {
            let at = extent(&mut random, 0.0).min;
            let near: Vec<usize> = boxes.near(at).collect();
            assert!((0..extents.len()).filter(|&i| extents[i].holds(at)).all(|i| near.contains(&i)));
            assert!(near.len() < 60, "{}", near.len());
        }
    }
}
