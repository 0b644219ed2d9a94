//! Where what blocks cut lies on the cloth: in a row, or where insertions put it. The keys of the profile and the options of
//! the job alone say so.

use super::cuts::{Cuts, Mark, Measure, Place, Round};
use super::tags::{Sheet, sheets};
use crate::geom::{Extent, Point, Vector};
use crate::machine::Job;
use crate::machine::patterns::{Quantity, Sizes};
use crate::units::MM_PER_INCH;

/// Farthest that the chords of a curve may lie off it, as a part of the tolerance.
const SAGITTA: f64 = 0.25;
/// Places of a curve that are looked at to find its box.
const SAMPLES: usize = 720;

/// How a block is moved: where its X and its Y go, and its origin.
type Move = [Vector; 3];

const AS_DRAWN: Move = [Vector::new(1.0, 0.0), Vector::new(0.0, 1.0), Vector::new(0.0, 0.0)];
const MIRRORED: Move = [Vector::new(-1.0, 0.0), Vector::new(0.0, 1.0), Vector::new(0.0, 0.0)];

/// All that is cut, and how far places may be off because curves are chords, mm.
pub(super) fn cloth(bytes: &[u8], job: &Job) -> (Cuts, f64) {
    let (blocks, loose) = sheets(bytes);
    let says = |key: &str| loose.says(key).or_else(|| blocks.iter().find_map(|block| block.says(key)));
    let unit = job.profile.dxf.unit.mm().unwrap_or_else(|| {
        let is_inch = |text: &[u8]| text.first().is_some_and(|first| b"EIei".contains(first));
        if says("UNITS").or(says("UNIT")).is_some_and(is_inch) { MM_PER_INCH } else { 1.0 }
    });
    let sagitta = job.profile.tolerance(0.0) * SAGITTA;
    let measure = Measure { unit, sagitta, notch: job.profile.dxf.notch_mm };
    let is_cut = sizes(&blocks, says("SAMPLE SIZE"), job);
    let of_blocks: Vec<Cuts> = blocks
        .iter()
        .zip(&is_cut)
        .map(|(block, is_cut)| if *is_cut { Cuts::of(block, measure) } else { Cuts::default() })
        .collect();
    let of_loose = Cuts::of(&loose, measure);
    let mut all = Cuts::default();
    let mut laid = 0;
    if let Some(moves) = insertions(&blocks, &of_blocks, &loose, unit) {
        for (block, to) in moves {
            all.add_moved(&of_blocks[block], to);
        }
        all.add_moved(&of_loose, AS_DRAWN);
    } else {
        let mut x = 0.0;
        let wanted = blocks.iter().map(|block| quantity(block, job)).chain([[1, 0]]);
        for (cuts, count) in of_blocks.iter().chain([&of_loose]).zip(wanted).filter(|(cuts, _)| !cuts.places.is_empty())
        {
            for (axes, count) in [AS_DRAWN, MIRRORED].into_iter().zip(count) {
                let extent = cuts.extent(axes);
                for _ in 0..count {
                    let [right, up, _] = axes;
                    all.add_moved(cuts, [right, up, Vector::new(x, 0.0) - extent.min.coords]);
                    x += extent.max.x - extent.min.x + job.profile.dxf.gap_mm;
                    laid += 1;
                }
            }
        }
    }
    // Each piece before one in the row may be so much narrower than its curves, on both sides.
    let off = if all.rounds.is_empty() { 0.0 } else { 2.0 * sagitta * f64::from(laid + 1) };
    (all, off)
}

/// Whether each block is of a size that is cut.
fn sizes(blocks: &[Sheet], sample: Option<&[u8]>, job: &Job) -> Vec<bool> {
    let name = |text: &[u8]| job.profile.labels.text(text).trim().to_uppercase();
    let of_blocks: Vec<Option<String>> = blocks.iter().map(|block| block.says("SIZE").map(name)).collect();
    let sample = sample.map(name).filter(|sample| of_blocks.contains(&Some(sample.clone())));
    let wanted: Option<Vec<String>> = match &job.patterns.sizes {
        Some(Sizes::All) => None,
        Some(Sizes::Named(names)) => Some(names.iter().map(|name| name.trim().to_uppercase()).collect()),
        None => sample.map(|sample| vec![sample]),
    };
    let is_wanted = |size: &Option<String>| match (&wanted, size) {
        (Some(wanted), Some(size)) => wanted.contains(size),
        (None, _) | (_, None) => true,
    };
    of_blocks.iter().map(is_wanted).collect()
}

/// How often a block is cut as it is drawn, and mirrored.
fn quantity(block: &Sheet, job: &Job) -> [u32; 2] {
    if job.patterns.quantity.unwrap_or(job.profile.dxf.quantity) == Quantity::One {
        return [1, 0];
    }
    let text = block.says("QUANTITY").map(|text| String::from_utf8_lossy(text).into_owned()).unwrap_or_default();
    let numbers: Option<Vec<u32>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[right]) if right > 0 => [right, 0],
        Some(&[right, left]) if right + left > 0 => [right, left],
        _ => [1, 0],
    }
}

/// Where insertions put blocks that cut something; `None` when they put them nowhere.
fn insertions(blocks: &[Sheet], cuts: &[Cuts], loose: &Sheet, unit: f64) -> Option<Vec<(usize, Move)>> {
    let mut moves = Vec::new();
    for item in loose.items.iter().filter(|item| item.kind == b"INSERT") {
        let wanted = item.text(2).to_ascii_uppercase();
        let Some(block) = blocks.iter().position(|block| block.name == wanted) else { continue };
        if cuts[block].places.is_empty() {
            continue;
        }
        let [x, y] = item.pair([10, 20])?;
        let turn = item.number(50).unwrap_or(0.0).to_radians();
        let [right, up] = [item.number(41).unwrap_or(1.0), item.number(42).unwrap_or(1.0)];
        let right = Vector::new(turn.cos(), turn.sin()) * right;
        let up = Vector::new(-turn.sin(), turn.cos()) * up;
        let [base_x, base_y] = blocks[block].base;
        let origin = (Vector::new(x, y) - right * base_x - up * base_y) * unit;
        moves.push((block, [right, up, origin]));
    }
    let is_still = |(_, [right, up, origin]): &(usize, Move)| [*right, *up, *origin] == AS_DRAWN;
    (!moves.iter().all(is_still)).then_some(moves)
}

fn moved(at: Point, [right, up, origin]: Move) -> Point {
    Point::from(right * at.x + up * at.y + origin)
}

impl Cuts {
    /// The box around all of it, turned as a move turns it.
    fn extent(&self, to: Move) -> Extent {
        let mut extent = Extent::EMPTY;
        self.places.iter().for_each(|place| extent.add(moved(place.at, to)));
        for round in &self.rounds {
            (0..=SAMPLES).for_each(|k| extent.add(moved(round.at(k as f64 / SAMPLES as f64), to)));
        }
        extent
    }

    /// Adds what a block cuts where it comes to lie.
    fn add_moved(&mut self, cuts: &Cuts, to: Move) {
        let [right, up, _] = to;
        // Insertions may scale; patterns are scaled alike in both directions.
        let scale = right.norm().max(up.norm());
        self.places.extend(cuts.places.iter().map(|place| Place { at: moved(place.at, to), ..*place }));
        self.rounds.extend(cuts.rounds.iter().map(|round| Round {
            centre: moved(round.centre, to),
            radius: round.radius * scale,
            ..*round
        }));
        self.length += cuts.length * scale;
        self.slack += cuts.slack * scale;
        self.holes.extend(cuts.holes.iter().map(|at| moved(*at, to)));
        self.marks.extend(cuts.marks.iter().map(|mark| Mark {
            at: moved(mark.at, to),
            depth: mark.depth * scale,
            width: mark.width * scale,
            ..*mark
        }));
    }
}
