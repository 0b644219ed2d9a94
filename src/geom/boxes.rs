//! Boxes by the cells of a lattice, so that those around a place are found among a hundred thousand.

use super::slots::Slots;
use super::{Extent, Point};

/// Boxes for each cell, about.
const BOXES_A_CELL: usize = 2;
/// Cells that a box meets on average, at the most: large ones that lie over each other would fill every cell.
const CELLS_A_BOX: f64 = 32.0;

/// Some boxes, each known by its place among them.
#[derive(Debug, Clone, PartialEq)]
pub struct Boxes {
    extents: Vec<Extent>,
    origin: Point,
    /// Width and height of a cell, mm.
    cell: [f64; 2],
    /// Columns and rows.
    count: [usize; 2],
    /// The boxes that meet each cell, row by row.
    cells: Slots,
}

impl Default for Boxes {
    fn default() -> Self {
        Self::new(Vec::new())
    }
}

impl Boxes {
    /// An index of boxes; empty ones are nowhere.
    pub fn new(extents: Vec<Extent>) -> Self {
        let (mut all, mut number) = (Extent::EMPTY, 0_usize);
        for extent in extents.iter().filter(|extent| !extent.is_empty()) {
            all.join(extent);
            number += 1;
        }
        let (width, height) = all.size();
        let cells = (number / BOXES_A_CELL).max(1) as f64;
        // As many cells as that, about as high as wide; what is long and narrow has as many as it is long.
        let side = (width * height / cells).sqrt().max(width.max(height) / cells).max(f64::MIN_POSITIVE);
        let most = (number as f64 * CELLS_A_BOX).min(u32::MAX.into());
        let mut boxes = Self::bare(extents, &all, side);
        while boxes.count != [1, 1] && boxes.filled() > most {
            let side = 2.0 * boxes.cell[0].max(boxes.cell[1]);
            boxes = Self::bare(boxes.extents, &all, side);
        }
        boxes.cells = Slots::new(boxes.count[0] * boxes.count[1], |see| {
            for (extent, i) in boxes.extents.iter().zip(0..) {
                boxes.met(extent).for_each(|cell| see(cell, i));
            }
        });
        boxes
    }

    /// Boxes that lie in this one, with cells of about this side, mm, that they are not in yet.
    fn bare(extents: Vec<Extent>, all: &Extent, side: f64) -> Self {
        let (width, height) = all.size();
        let count = [width, height].map(|length| ((length / side) as usize).max(1));
        let cell = [width / count[0] as f64, height / count[1] as f64].map(|size| size.max(f64::MIN_POSITIVE));
        Self { extents, origin: all.min, cell, count, cells: Slots::default() }
    }

    /// In how many cells the boxes are, at the most.
    fn filled(&self) -> f64 {
        let along = |length: f64, axis: usize| length / self.cell[axis] + 2.0;
        let met = |(width, height): (f64, f64)| along(width, 0) * along(height, 1);
        self.extents.iter().map(|extent| met(extent.size())).sum()
    }

    /// All boxes, in order.
    pub fn all(&self) -> &[Extent] {
        &self.extents
    }

    /// The boxes that hold a point, in order.
    pub fn at(&self, point: Point) -> impl Iterator<Item = usize> + '_ {
        let there = self.cells.of(self.cell_of(point)).iter().map(|&i| i as usize);
        there.filter(move |&i| self.extents[i].holds(point))
    }

    /// The boxes that meet a box, from the `first`th on, each once, in no order.
    pub fn near(&self, extent: Extent, first: usize) -> impl Iterator<Item = usize> + '_ {
        let those_of = |cell: usize| self.cells.of(cell).iter().map(move |&i| (cell, i as usize));
        let those = self.met(&extent).flat_map(those_of);
        let near = those.filter(move |&(_, i)| i >= first && self.extents[i].meets(&extent));
        // Two boxes may have several cells in common: the one in which what they share begins counts.
        let is_in_one = self.cell_of(extent.min) == self.cell_of(extent.max);
        let beginning = move |i: usize| self.cell_of(self.extents[i].min.sup(&extent.min));
        near.filter(move |&(cell, i)| is_in_one || cell == beginning(i)).map(|(_, i)| i)
    }

    /// How many boxes are looked at to find those that hold a point.
    pub fn looked_at(&self, point: Point) -> usize {
        self.cells.of(self.cell_of(point)).len()
    }

    /// How many are looked at to find those that meet a box.
    pub fn looked_at_near(&self, extent: &Extent) -> usize {
        self.met(extent).map(|cell| self.cells.of(cell).len()).sum()
    }

    /// The cells that a box meets, row by row; none when it is empty.
    fn met(&self, Extent { min, max }: &Extent) -> impl Iterator<Item = usize> + use<> {
        let (columns, width) = (self.column(min.x)..self.column(max.x) + 1, self.count[0]);
        let rows = if min.x <= max.x { self.row(min.y)..self.row(max.y) + 1 } else { 0..0 };
        rows.flat_map(move |row| columns.clone().map(move |column| row * width + column))
    }

    /// The cell of a point.
    fn cell_of(&self, point: Point) -> usize {
        self.row(point.y) * self.count[0] + self.column(point.x)
    }

    /// The column of a place; beyond the outermost ones it belongs to these.
    fn column(&self, x: f64) -> usize {
        (((x - self.origin.x) / self.cell[0]).max(0.0) as usize).min(self.count[0] - 1)
    }

    /// The row, likewise.
    fn row(&self, y: f64) -> usize {
        (((y - self.origin.y) / self.cell[1]).max(0.0) as usize).min(self.count[1] - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;

    fn extent(random: &mut fastrand::Rng, size: f64) -> Extent {
        let min = Point::new(1000.0 * random.f64() - 500.0, 1000.0 * random.f64() - 500.0);
        Extent { min, max: min + Vector::new(size * random.f64(), size * random.f64()) }
    }

    #[test]
    fn every_box_around_a_place_is_found_and_few_others_are_looked_at() {
        let mut random = fastrand::Rng::with_seed(1);
        let mut extents: Vec<Extent> = (0..2000).map(|_| extent(&mut random, 20.0)).collect();
        extents.extend((0..10).map(|_| extent(&mut random, 900.0)));
        extents.insert(7, Extent::EMPTY);
        let boxes = Boxes::new(extents.clone());
        let those =
            |wanted: &dyn Fn(&Extent) -> bool| (0..extents.len()).filter(|&i| wanted(&extents[i])).collect::<Vec<_>>();
        for _ in 0..1000 {
            let around = extent(&mut random, 30.0);
            assert_eq!(boxes.at(around.min).collect::<Vec<_>>(), those(&|extent| extent.holds(around.min)));
            let mut near: Vec<usize> = boxes.near(around, 0).collect();
            near.sort_unstable();
            assert_eq!(near, those(&|extent| extent.meets(&around)));
            near.retain(|&i| i >= 1000);
            assert_eq!(boxes.near(around, 1000).count(), near.len());
            assert!(boxes.looked_at_near(&around) < 120, "{}", boxes.looked_at_near(&around));
        }
    }

    #[test]
    fn boxes_over_each_other_or_in_a_line_take_no_more_memory() {
        let square = |k: f64| Extent::between(Point::new(k, k), Point::new(9e5 - k, 9e5 - k));
        let strip = |k: f64| Extent::between(Point::new(0.0, k), Point::new(1e4, k));
        let dot = |k: f64| Extent::between(Point::new(k, 1.0), Point::new(k, 1.0));
        let places = || (0..9000).map(f64::from);
        for extents in
            [places().map(square).collect::<Vec<_>>(), places().map(strip).collect(), places().map(dot).collect()]
        {
            let at = extents[4000].min;
            let boxes = Boxes::new(extents);
            let cells = boxes.cells.count();
            assert!(cells <= 9000 && boxes.cells.of_all(0..=cells - 1).len() as f64 <= 9000.0 * CELLS_A_BOX);
            assert!(boxes.at(at).any(|i| i == 4000));
        }
        let dots = Boxes::new(places().map(dot).collect());
        assert!(dots.looked_at(dot(5000.0).min) < 8);
    }

    #[test]
    fn empty_boxes_are_nowhere() {
        for boxes in [Boxes::default(), Boxes::new(vec![Extent::EMPTY; 3])] {
            assert_eq!((boxes.at(Point::origin()).count(), boxes.near(Extent::EMPTY, 0).count()), (0, 0));
            assert_eq!(boxes.near(Extent::between(Point::origin(), Point::new(1.0, 1.0)), 0).count(), 0);
        }
    }
}
