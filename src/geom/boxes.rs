//! A grid index of boxes: finds the boxes near a place among a hundred thousand.

use super::slots::Slots;
use super::{Extent, Point};

/// Fraction of the boxes that may lie beyond the grid on each side. Otherwise a few distant boxes would put all others into one
/// cell.
const FAR_SHARE: f64 = 0.01;
/// Maximum number of boxes sampled to size the grid.
const SAMPLE: usize = 500;
/// Target number of boxes per cell.
const BOXES_A_CELL: usize = 2;
/// Maximum average number of cells per box. Large boxes on top of each other would otherwise fill every cell.
const CELLS_A_BOX: f64 = 32.0;

/// Indexed boxes, each known by its index.
#[derive(Debug, Clone, PartialEq)]
pub struct Boxes {
    extents: Vec<Extent>,
    origin: Point,
    /// Width and height of a cell, mm.
    cell: [f64; 2],
    /// Columns and rows.
    count: [usize; 2],
    /// Indices of the boxes that meet each cell, row by row.
    cells: Slots,
}

impl Default for Boxes {
    fn default() -> Self {
        Self::new(Vec::new())
    }
}

impl Boxes {
    /// Builds the index. Empty boxes are never found.
    pub fn new(extents: Vec<Extent>) -> Self {
        let number = extents.iter().filter(|extent| !extent.is_empty()).count();
        let bulk = bulk(&extents, number.div_ceil(SAMPLE).max(1));
        let (width, height) = bulk.size();
        let cells = (number / BOXES_A_CELL).max(1) as f64;
        // About that many square cells. A long, narrow region is divided along its length only.
        let side = (width * height / cells).sqrt().max(width.max(height) / cells).max(f64::MIN_POSITIVE);
        let most = (number as f64 * CELLS_A_BOX).min(u32::MAX.into());
        let mut boxes = Self::bare(extents, &bulk, side);
        while boxes.count != [1, 1] && boxes.filled() > most {
            let side = 2.0 * boxes.cell[0].max(boxes.cell[1]);
            boxes = Self::bare(boxes.extents, &bulk, side);
        }
        boxes.cells = Slots::new(boxes.count[0] * boxes.count[1], |see| {
            for (extent, i) in boxes.extents.iter().zip(0..) {
                boxes.met(extent).for_each(|cell| see(cell, i));
            }
        });
        boxes
    }

    /// The grid over `bulk` with cells of about `side` mm, still without the boxes.
    fn bare(extents: Vec<Extent>, bulk: &Extent, side: f64) -> Self {
        let (width, height) = bulk.size();
        let count = [width, height].map(|length| ((length / side) as usize).max(1));
        let cell = [width / count[0] as f64, height / count[1] as f64].map(|size| size.max(f64::MIN_POSITIVE));
        Self { extents, origin: bulk.min, cell, count, cells: Slots::default() }
    }

    /// Upper bound on the number of cells occupied by the boxes, each box counted separately.
    fn filled(&self) -> f64 {
        let along = |length: f64, axis: usize| (length / self.cell[axis] + 2.0).min(self.count[axis] as f64);
        let met = |(width, height): (f64, f64)| along(width, 0) * along(height, 1);
        self.extents.iter().filter(|extent| !extent.is_empty()).map(|extent| met(extent.size())).sum()
    }

    /// All boxes, in order.
    pub fn all(&self) -> &[Extent] {
        &self.extents
    }

    /// Indices of the boxes that contain a point, ascending.
    pub fn at(&self, point: Point) -> impl Iterator<Item = usize> + '_ {
        let there = self.cells.of(self.cell_of(point)).iter().map(|&i| i as usize);
        there.filter(move |&i| self.extents[i].holds(point))
    }

    /// Indices of the boxes that meet a box, each once, unordered.
    pub fn near(&self, extent: Extent) -> impl Iterator<Item = usize> + '_ {
        self.near_from(0, extent)
    }

    /// Indices of the boxes from `first` on that meet a box, each once, unordered.
    pub fn near_from(&self, first: usize, extent: Extent) -> impl Iterator<Item = usize> + '_ {
        let those_of = |cell: usize| self.cells.of(cell).iter().map(move |&i| (cell, i as usize));
        let those = self.met(&extent).flat_map(those_of);
        let near = those.filter(move |&(_, i)| i >= first && self.extents[i].meets(&extent));
        // Two boxes may share several cells. Count the pair only in the cell where their intersection begins.
        let is_in_one = self.cell_of(extent.min) == self.cell_of(extent.max);
        let beginning = move |i: usize| self.cell_of(self.extents[i].min.sup(&extent.min));
        near.filter(move |&(cell, i)| is_in_one || cell == beginning(i)).map(|(_, i)| i)
    }

    /// Cost of [`Boxes::at`], in comparisons of boxes.
    pub fn cost_at(&self, point: Point) -> usize {
        self.cells.of(self.cell_of(point)).len()
    }

    /// Cost of [`Boxes::near`], in comparisons of boxes.
    pub fn cost_near(&self, extent: &Extent) -> usize {
        self.met(extent).map(|cell| self.cells.of(cell).len()).sum()
    }

    /// The cells that a box meets, row by row; none for an empty box.
    fn met(&self, Extent { min, max }: &Extent) -> impl Iterator<Item = usize> + use<> {
        let (columns, width) = (self.column(min.x)..self.column(max.x) + 1, self.count[0]);
        let rows = if min.x <= max.x { self.row(min.y)..self.row(max.y) + 1 } else { 0..0 };
        rows.flat_map(move |row| columns.clone().map(move |column| row * width + column))
    }

    /// The cell of a point.
    fn cell_of(&self, point: Point) -> usize {
        self.row(point.y) * self.count[0] + self.column(point.x)
    }

    /// The column of an x coordinate, clamped to the grid.
    fn column(&self, x: f64) -> usize {
        (((x - self.origin.x) / self.cell[0]).max(0.0) as usize).min(self.count[0] - 1)
    }

    /// The row of a y coordinate, clamped to the grid.
    fn row(&self, y: f64) -> usize {
        (((y - self.origin.y) / self.cell[1]).max(0.0) as usize).min(self.count[1] - 1)
    }
}

/// Bounding box of nearly all boxes, from every `step`th box that is not empty.
fn bulk(extents: &[Extent], step: usize) -> Extent {
    let mut values: Vec<f64> = Vec::with_capacity(SAMPLE);
    // The coordinate that only a fraction of `FAR_SHARE` lies beyond.
    let mut beyond = |corner: &dyn Fn(&Extent) -> f64, is_above: bool| {
        values.clear();
        values.extend(extents.iter().filter(|extent| !extent.is_empty()).step_by(step).map(corner));
        let last = values.len().checked_sub(1)?;
        let far = (FAR_SHARE * last as f64) as usize;
        Some(*values.select_nth_unstable_by(if is_above { last - far } else { far }, f64::total_cmp).1)
    };
    let min = beyond(&|extent| extent.min.x, false).zip(beyond(&|extent| extent.min.y, false));
    let max = beyond(&|extent| extent.max.x, true).zip(beyond(&|extent| extent.max.y, true));
    let corners =
        min.zip(max).map(|(min, max)| Extent { min: Point::new(min.0, min.1), max: Point::new(max.0, max.1) });
    corners.unwrap_or(Extent::EMPTY)
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
            let mut near: Vec<usize> = boxes.near(around).collect();
            near.sort_unstable();
            assert_eq!(near, those(&|extent| extent.meets(&around)));
            near.retain(|&i| i >= 1000);
            assert_eq!(boxes.near_from(1000, around).count(), near.len());
            assert!(boxes.cost_near(&around) < 120, "{}", boxes.cost_near(&around));
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
        assert!(dots.cost_at(dot(5000.0).min) < 8);
    }

    #[test]
    fn neither_empty_boxes_nor_a_few_far_away_make_the_cells_coarse() {
        let squares =
            (0..100).flat_map(|k| (0..100).map(move |l| Point::new(10.0 * f64::from(k), 10.0 * f64::from(l))));
        let mut extents: Vec<Extent> = squares.map(|at| Extent { min: at, max: at + Vector::new(9.0, 9.0) }).collect();
        extents.extend(std::iter::repeat_n(Extent::EMPTY, 200_000));
        let far = Point::new(9e5, -9e5);
        extents.push(Extent::between(far, far));
        let boxes = Boxes::new(extents);
        let costs = boxes.all()[..10_000].iter().map(|extent| boxes.cost_near(extent));
        assert!(costs.max().is_some_and(|most| most < 60));
        assert!(boxes.at(far).eq([210_000]) && boxes.near(boxes.all()[17]).eq([17]));
    }

    #[test]
    fn empty_boxes_are_nowhere() {
        for boxes in [Boxes::default(), Boxes::new(vec![Extent::EMPTY; 3])] {
            assert_eq!((boxes.at(Point::origin()).count(), boxes.near(Extent::EMPTY).count()), (0, 0));
            assert_eq!(boxes.near(Extent::between(Point::origin(), Point::new(1.0, 1.0))).count(), 0);
        }
    }
}
