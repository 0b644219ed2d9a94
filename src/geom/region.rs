//! Regions of the plane, each bounded by the rings of one owner by the even-odd rule, and how far one may go straight on
//! before entering one. Every question looks at what is near only, so that asking it everywhere is nearly linear.

use rayon::prelude::*;

use super::{Extent, Point, Vector, cross, polyline};

/// Edges that a band of a region holds on average, at the least.
const EDGES_A_BAND: usize = 8;
/// Regions that a cell of the lattice of boxes holds on average, at the least; and the most cells along a side.
const REGIONS_A_BOX: usize = 2;
const BOXES_MAX: usize = 1024;
/// Least size of a cell, mm, and the most cells along a side.
const CELL_MIN: f64 = 4.0;
const CELLS_MAX: f64 = 2048.0;
/// Places nearer than this are the same, mm: rounding of coordinates of some metres.
const SAME_EPSILON: f64 = 1e-9;
/// Where between two crossings it is seen whether a way lies well inside.
const PROBES: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// Regions, indexed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Regions {
    /// Those of one owner side by side.
    edges: Vec<Edge>,
    /// Each owner's region, in order.
    owners: Vec<Region>,
    /// Regions by the cells that their boxes meet.
    boxes: Lattice,
    /// Edges by the cell that they pass.
    cells: Lattice,
}

/// A straight way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub from: Point,
    /// Its direction, a unit vector.
    pub along: Vector,
    /// Its length, mm.
    pub reach: f64,
}

/// How far a way goes before it enters a region, mm; infinite when it does not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Room {
    /// Before it enters the region of its own owner.
    pub own: f64,
    /// Before it enters that of another.
    pub other: f64,
}

impl Room {
    /// Before it enters any, mm.
    pub fn least(self) -> f64 {
        self.own.min(self.other)
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Edge {
    from: Point,
    to: Point,
    owner: u32,
}

/// Cells of one size side by side, each with the items that it holds, one cell after the other.
#[derive(Debug, Clone, PartialEq, Default)]
struct Lattice {
    origin: Point,
    size: [f64; 2],
    count: [usize; 2],
    starts: Vec<u32>,
    items: Vec<u32>,
}

/// The region of one owner.
#[derive(Debug, Clone, PartialEq)]
struct Region {
    owner: u32,
    extent: Extent,
    /// Where its edges begin.
    first: usize,
    /// Its edges by the band along Y that they reach into: all that a ray along X can meet.
    bands: Lattice,
}

impl Lattice {
    /// Puts each edge into the cells that it passes.
    fn new(edges: &[Edge], origin: Point, size: [f64; 2], count: [usize; 2]) -> Self {
        Self::of(edges.len(), (origin, size, count), |lattice, i, see| lattice.passed(&edges[i], see))
    }

    /// Puts each box into the cells that it meets.
    fn of_boxes(boxes: &[Region], origin: Point, size: [f64; 2], count: [usize; 2]) -> Self {
        Self::of(boxes.len(), (origin, size, count), |lattice, i, see| lattice.met(boxes[i].extent).for_each(see))
    }

    /// Puts each item into cells, which `cells` calls out.
    fn of(
        items: usize,
        (origin, size, count): (Point, [f64; 2], [usize; 2]),
        cells: impl Fn(&Self, usize, &mut dyn FnMut(usize)),
    ) -> Self {
        let mut lattice = Self { origin, size, count, starts: Vec::new(), items: Vec::new() };
        // Counting sort: first how many, then where.
        let mut counts = vec![0_u32; count[0] * count[1] + 1];
        for i in 0..items {
            cells(&lattice, i, &mut |cell| counts[cell + 1] += 1);
        }
        for i in 1..counts.len() {
            counts[i] += counts[i - 1];
        }
        let mut placed = vec![0; counts[count[0] * count[1]] as usize];
        let mut next = counts.clone();
        for i in 0..items {
            cells(&lattice, i, &mut |cell| {
                placed[next[cell] as usize] = i as u32;
                next[cell] += 1;
            });
        }
        (lattice.starts, lattice.items) = (counts, placed);
        lattice
    }

    /// The cells that a box meets.
    fn met(&self, extent: Extent) -> impl Iterator<Item = usize> + '_ {
        let rows = self.place(extent.min.y, 1)..=self.place(extent.max.y, 1);
        let columns = self.place(extent.min.x, 0)..=self.place(extent.max.x, 0);
        rows.flat_map(move |row| columns.clone().map(move |column| row * self.count[0] + column))
    }

    fn place(&self, value: f64, axis: usize) -> usize {
        let origin = [self.origin.x, self.origin.y][axis];
        (((value - origin) / self.size[axis]).max(0.0) as usize).min(self.count[axis] - 1)
    }

    /// Calls `see` for each cell that an edge passes, row by row.
    fn passed(&self, edge: &Edge, mut see: impl FnMut(usize)) {
        let (low, high) = if edge.from.y <= edge.to.y { (edge.from, edge.to) } else { (edge.to, edge.from) };
        let rows = self.place(low.y, 1)..=self.place(high.y, 1);
        for row in rows {
            let bottom = self.origin.y + self.size[1] * row as f64;
            let share = |y: f64| if high.y > low.y { ((y - low.y) / (high.y - low.y)).clamp(0.0, 1.0) } else { 0.0 };
            let flat = high.y <= low.y;
            let at = |y: f64| low.x + (high.x - low.x) * share(y);
            let ends = if flat { [low.x, high.x] } else { [at(bottom), at(bottom + self.size[1])] };
            for column in self.place(ends[0].min(ends[1]), 0)..=self.place(ends[0].max(ends[1]), 0) {
                see(row * self.count[0] + column);
            }
        }
    }

    /// The items of all cells that a box meets; some more than once.
    fn near(&self, extent: Extent) -> impl Iterator<Item = usize> + '_ {
        let cells = (!self.items.is_empty()).then(|| self.met(extent)).into_iter().flatten();
        cells
            .flat_map(|cell| &self.items[self.starts[cell] as usize..self.starts[cell + 1] as usize])
            .map(|&i| i as usize)
    }
}

/// The region of each owner of edges, which lie side by side.
fn regions(edges: &[Edge]) -> Vec<Region> {
    let by_owner: Vec<&[Edge]> = edges.chunk_by(|a, b| a.owner == b.owner).collect();
    let starts = by_owner.iter().scan(0, |next, edges| Some(std::mem::replace(next, *next + edges.len())));
    let starts: Vec<usize> = starts.collect();
    by_owner.into_par_iter().zip(starts).map(|(edges, first)| Region::new(edges, first)).collect()
}

impl Regions {
    /// The regions that rings bound, each ring with its owner; whether a ring repeats its first point does not matter.
    pub fn new<'a>(rings: impl IntoIterator<Item = (u32, &'a [Point])>) -> Self {
        let (mut edges, mut extent) = (Vec::new(), Extent::EMPTY);
        for (owner, ring) in rings {
            let Some(&last) = ring.last() else { continue };
            let mut from = last;
            for &to in ring {
                extent.add(to);
                if from != to {
                    edges.push(Edge { from, to, owner });
                }
                from = to;
            }
        }
        if edges.is_empty() {
            return Self::default();
        }
        edges.sort_by_key(|edge| edge.owner); // stable: the rings of an owner keep their order
        let (width, height) = extent.size();
        let cell = CELL_MIN.max(width.max(height) / CELLS_MAX);
        let cells = [width, height].map(|side| (side / cell) as usize + 1);
        let (owners, cells) = rayon::join(|| regions(&edges), || Lattice::new(&edges, extent.min, [cell; 2], cells));
        let wanted = (owners.len() / REGIONS_A_BOX).max(1) as f64;
        // As many cells as that, about as high as wide.
        let side = (width * height / wanted).sqrt().max(f64::MIN_POSITIVE);
        let count = [width, height].map(|length| ((length / side) as usize).clamp(1, BOXES_MAX));
        let size = [width / count[0] as f64, height / count[1] as f64].map(|size| size.max(f64::MIN_POSITIVE));
        Self { boxes: Lattice::of_boxes(&owners, extent.min, size, count), owners, cells, edges }
    }

    /// The owners in whose region a point lies, in order. A point on an edge may count either way.
    pub fn owners_at(&self, point: Point) -> Vec<u32> {
        let near = self.boxes.near(Extent { min: point, max: point }).map(|i| &self.owners[i]);
        let mut owners: Vec<u32> =
            near.filter(|region| region.holds(point, &self.edges)).map(|region| region.owner).collect();
        owners.sort_unstable();
        owners
    }

    /// Whether a point that lies in an owner's region is farther than `slack` mm from its edges.
    fn is_deep(&self, point: Point, owner: u32, slack: f64) -> bool {
        let reach = Vector::new(slack, slack);
        let mut near = self.cells.near(Extent { min: point - reach, max: point + reach }).map(|i| &self.edges[i]);
        !near.any(|edge| edge.owner == owner && polyline::distance_to_segment(point, edge.from, edge.to) <= slack)
    }

    /// How far a way of `owner` goes before it enters a region, its own or another's. What comes no deeper than `slack` mm
    /// enters nothing: it lies along an edge. A region of another in which the way starts is no obstacle.
    pub fn room(&self, ray: &Ray, owner: u32, slack: f64) -> Room {
        let mut room = Room { own: f64::INFINITY, other: f64::INFINITY };
        let mut extent = Extent::EMPTY;
        extent.add(ray.from);
        extent.add(ray.from + ray.along * ray.reach);
        let mut cuts = vec![0.0, ray.reach];
        for i in self.cells.near(extent) {
            self.edges[i].crossings(ray, &mut cuts);
        }
        cuts.sort_by(f64::total_cmp);
        let deep = |way: f64, owner: u32| self.is_deep(ray.from + ray.along * way, owner, slack);
        let mut under: Option<Vec<u32>> = None;
        for ends in cuts.windows(2).filter(|ends| ends[1] - ends[0] > SAME_EPSILON) {
            let [a, b] = [ends[0], ends[1]];
            for inside in self.owners_at(ray.from + ray.along * f64::midpoint(a, b)) {
                let so_far = if inside == owner { room.own } else { room.other };
                if a >= so_far || !PROBES.iter().any(|share| deep(a + (b - a) * share, inside)) {
                    continue;
                }
                if inside == owner {
                    room.own = a;
                    continue;
                }
                let under = under.get_or_insert_with(|| self.owners_at(ray.from));
                if !(under.contains(&inside) && deep(0.0, inside)) {
                    room.other = a;
                }
            }
        }
        room
    }
}

impl Region {
    fn new(edges: &[Edge], first: usize) -> Self {
        let mut extent = Extent::EMPTY;
        for edge in edges {
            extent.add(edge.from);
        }
        let (width, height) = extent.size();
        let count = (edges.len() / EDGES_A_BAND).max(1);
        let band = [width, height / count as f64].map(|size| size.max(f64::MIN_POSITIVE));
        Self { owner: edges[0].owner, extent, first, bands: Lattice::new(edges, extent.min, band, [1, count]) }
    }

    /// Whether a ray to the right of a point crosses its edges an odd number of times.
    fn holds(&self, point: Point, edges: &[Edge]) -> bool {
        let Extent { min, max } = self.extent;
        if point.x < min.x || point.x > max.x || point.y < min.y || point.y > max.y {
            return false;
        }
        let crossed = self.bands.near(Extent { min: point, max: point }).filter(|&i| {
            let Edge { from, to, .. } = edges[self.first + i];
            (from.y > point.y) != (to.y > point.y)
                && from.x + (to.x - from.x) * (point.y - from.y) / (to.y - from.y) > point.x
        });
        crossed.count() % 2 == 1
    }
}

impl Edge {
    /// Adds how far along a way it crosses or touches it.
    fn crossings(&self, ray: &Ray, cuts: &mut Vec<f64>) {
        let (a, b) = (self.from - ray.from, self.to - ray.from);
        let (side_a, side_b) = (cross(ray.along, a), cross(ray.along, b));
        let mut add = |way: f64| {
            if way > 0.0 && way < ray.reach {
                cuts.push(way);
            }
        };
        for (end, side) in [(a, side_a), (b, side_b)] {
            if side.abs() <= SAME_EPSILON {
                add(ray.along.dot(&end));
            }
        }
        if side_a * side_b < 0.0 {
            add(ray.along.dot(&(a + (b - a) * (side_a / (side_a - side_b)))));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, side: f64) -> Vec<Point> {
        [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)].map(|(dx, dy)| Point::new(x + dx, y + dy)).to_vec()
    }

    fn east(x: f64, y: f64) -> Ray {
        Ray { from: Point::new(x, y), along: Vector::new(1.0, 0.0), reach: 20.0 }
    }

    #[test]
    fn a_cut_out_belongs_to_no_region_and_what_lies_in_it_to_its_own() {
        let mut turned = square(10.0, 10.0, 30.0);
        turned.reverse();
        let regions = Regions::new([(1, &square(0.0, 0.0, 50.0)[..]), (1, &turned), (2, &square(20.0, 20.0, 10.0))]);
        let owners = |x: f64, y: f64| regions.owners_at(Point::new(x, y));
        assert_eq!([owners(5.0, 5.0), owners(15.0, 15.0), owners(25.0, 25.0)], [vec![1], vec![], vec![2]]);
        assert_eq!([owners(-5.0, 25.0), owners(55.0, 25.0), owners(25.0, 99.0)].concat(), Vec::<u32>::new());
    }

    #[test]
    fn a_way_ends_where_it_enters_a_region() {
        let regions = Regions::new([(1, &square(0.0, 0.0, 10.0)[..]), (2, &square(10.5, 0.0, 10.0))]);
        let room = |ray: &Ray, owner| regions.room(ray, owner, 0.05);
        let from_corner = room(&east(10.0, 5.0), 1);
        assert!((from_corner.other - 0.5).abs() < 1e-9 && from_corner.own == f64::INFINITY);
        assert_eq!(room(&east(0.0, 5.0), 1).own, 0.0);
        // Along the edge, and nearer to it than the slack, it enters nothing.
        assert_eq!(room(&east(10.0, 0.0), 1).least(), f64::INFINITY);
        assert_eq!(room(&east(10.0, 0.04), 1).least(), f64::INFINITY);
        // Drawings that overlap are no obstacle to each other.
        assert_eq!(room(&east(12.0, 5.0), 1), Room { own: f64::INFINITY, other: f64::INFINITY });
    }

    #[test]
    fn no_regions_leave_room_everywhere() {
        let nothing = Regions::new([]);
        assert_eq!(nothing.room(&east(0.0, 0.0), 0, 0.1).least(), f64::INFINITY);
        assert!(nothing.owners_at(Point::origin()).is_empty());
    }
}
