//! Layout of the cuts of blocks on the cloth: in a row, or at the places of insertions, by the keys of the profile and the
//! options of the job alone.

use std::collections::{BTreeMap, BTreeSet};

use super::curves::{Bow, lent};
use super::cuts::{Cuts, Mark, Place};
use super::left_out::wrong_count;
use super::letters::Letters;
use super::lines::{MEETS, Measure, Round, paths};
use super::lookup::Lookup;
use super::places::CutPlaces;
use super::tags::{File, Item, Sheet, sheets};
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, Vector, cross};
use crate::machine::Job;
use crate::machine::labels::Labels;
use crate::machine::patterns::{Curves, Dxf, Quantity, Sizes};
use crate::units::MM_PER_INCH;

/// Number of samples of a curve for its box.
const SAMPLES: usize = 720;

/// Numbers of units in the header, and their lengths, mm: inch, foot, mm, cm, m, yard, dm.
const UNITS: [(f64, f64); 7] =
    [(1.0, MM_PER_INCH), (2.0, 304.8), (4.0, 1.0), (5.0, 10.0), (6.0, 1000.0), (10.0, 914.4), (14.0, 100.0)];

/// A line longer than the outline of any part, mm.
const LONGEST: f64 = 3e4;

/// Rounding of an angle in degrees, rad: an insertion below it neither turns nor scales.
const TURNS: f64 = 1e-5;

/// Number of vertices of a block by which its place is found.
const CORNERS: usize = 16;
/// Greatest depth by which a notch may take cloth off the edge of a piece, mm.
const NOTCHED: f64 = 1.0;

/// Placement of a block: images of its X and its Y axis, and of its origin.
type Move = [Vector; 3];

/// Default count of a block: as drawn, and mirrored.
const ONCE: [u32; 2] = [1, 0];
const AS_DRAWN: Move = [Vector::new(1.0, 0.0), Vector::new(0.0, 1.0), Vector::new(0.0, 0.0)];
const MIRRORED: Move = [Vector::new(-1.0, 0.0), Vector::new(0.0, 1.0), Vector::new(0.0, 0.0)];

/// A file in blocks.
struct Sheets<'a> {
    blocks: Vec<Sheet<'a>>,
    /// Items outside blocks.
    loose: Sheet<'a>,
    /// Blocks by name; the first of several with one name.
    names: BTreeMap<Vec<u8>, usize>,
    /// Encoding of its texts.
    letters: Letters,
    /// Length of a unit, mm.
    unit: f64,
}

/// All cuts, with the greatest error of places by the chords of curves, mm: at the places of insertions, and in a row if there
/// are no places or the pieces would overlap there.
pub(super) fn cloths(bytes: &[u8], read: &CutPlaces, job: &Job) -> Vec<(Cuts, f64)> {
    let sheets = Sheets::of(bytes, job);
    let sagitta = job.profile.tolerance(0.0) * Dxf::CHORDS_OFF;
    let measure = Measure { unit: sheets.unit, sagitta, notch: job.profile.dxf.notch_mm };
    let with_curves = job.profile.dxf.curves == Curves::Auto;
    let lent = lent(&sheets.blocks, sheets.says("SAMPLE SIZE"), sheets.unit);
    let cuts_of = |block: &Sheet, lent: &[Vec<Point>; 2]| Cuts::of(block, with_curves.then_some(lent), measure);
    let all = || sheets.blocks.iter().zip(&lent).map(|(block, lent)| cuts_of(block, lent)).collect::<Vec<Cuts>>();
    let are_apart = job.patterns.sizes.is_none() && sheets.has_places() && sheets.met(&all()) == Some((0, true));
    let are_cut = sheets.are_cut(job, are_apart).into_iter().zip(&lent);
    let is_left_out = |block: &Sheet| read.blocks_left_out.contains(&block.number);
    let mut of_blocks: Vec<Cuts> = sheets
        .blocks
        .iter()
        .zip(are_cut)
        .map(
            |(block, (is_cut, lent))| {
                if is_cut && !is_left_out(block) { cuts_of(block, lent) } else { Cuts::default() }
            },
        )
        .collect();
    for (block, cuts) in sheets.blocks.iter().zip(&mut of_blocks).filter(|(_, cuts)| !cuts.places.is_empty()) {
        cuts.faults += usize::from(block.base.is_none()) + sheets.nested(block);
    }
    of_blocks.push(cuts_of(&sheets.loose, &Default::default()));
    // The extent of curves is not known here: each piece must lie where its vertices are.
    let placed = sheets.placed(&of_blocks).map(|placed| (placed, 0.0));
    let has_bows = of_blocks.iter().any(|cuts| !cuts.bows.is_empty());
    let row = Row { of_all: &of_blocks, read, has_bows, sagitta };
    let is_in_a_row = placed.is_none() || sheets.met(&of_blocks).is_some_and(|(met, _)| met > 0);
    // Only pieces that the user deselected may be missing.
    let mut cloths = Vec::new();
    if let Some((mut placed, off)) = placed {
        placed.faults += wrong_count(sheets.inserted(), &sheets.blocks, read, &job.selection);
        cloths.push((placed, off));
    }
    if is_in_a_row {
        let (mut laid, off) = sheets.in_a_row(&row, job);
        laid.faults += wrong_count(sheets.one_behind_the_other(job), &sheets.blocks, read, &job.selection);
        cloths.push((laid, off));
    }
    cloths
}

impl<'a> Sheets<'a> {
    fn of(bytes: &'a [u8], job: &'a Job) -> Self {
        let File { blocks, loose, unit: of_header, letters, .. } = sheets(bytes, &job.profile.labels);
        let mut names = BTreeMap::new();
        for (k, block) in blocks.iter().enumerate() {
            names.entry(block.name.clone()).or_insert(k);
        }
        let mut sheets = Self { blocks, loose, names, letters, unit: 1.0 };
        sheets.unit = job.profile.dxf.unit.mm().unwrap_or_else(|| {
            let unit = sheets.says("UNITS");
            match (unit, of_header) {
                (Some(unit), _) => unit_of(&letters.read(unit)),
                (None, Some(number)) => {
                    let unit = UNITS.iter().find(|unit| unit.0 == number).map_or(1.0, |unit| unit.1);
                    if sheets.is_too_long_in(unit) { 1.0 } else { unit }
                }
                (None, None) => 1.0,
            }
        });
        sheets
    }

    /// True if a line would be longer than the outline of any part in a unit of `unit` mm.
    fn is_too_long_in(&self, unit: f64) -> bool {
        if unit <= MM_PER_INCH {
            return false;
        }
        let measure = Measure { unit: 1.0, sagitta: 1.0, notch: 0.0 };
        let sheets = self.blocks.iter().chain([&self.loose]);
        let mut paths =
            sheets.flat_map(|sheet| [1, 11].into_iter().flat_map(|layer| paths(&sheet.items, layer, measure)));
        paths.any(|path| (0..path.curves.len()).map(|k| path.length(k)).sum::<f64>() * unit > LONGEST)
    }

    /// True if an insertion outside blocks moves its block.
    fn has_places(&self) -> bool {
        let mut inserts = self.loose.items.iter().filter(|item| item.kind == b"INSERT");
        inserts.any(|item| self.block(item).and_then(|k| self.to(item, k)).is_some_and(|to| !is_still(to)))
    }

    /// Number of boxes around the cuts of inserted blocks whose middle is in another box, and whether any insertion moves its
    /// block; `None` without such boxes.
    fn met(&self, of_all: &[Cuts]) -> Option<(usize, bool)> {
        let mut laid = Vec::new();
        let mut is_all_still = true;
        for item in self.loose.items.iter().filter(|item| item.kind == b"INSERT") {
            let Some(k) = self.block(item).filter(|&k| !of_all[k].places.is_empty()) else { continue };
            let Some(to) = self.to(item, k) else { continue };
            is_all_still &= is_still(to);
            let mut cuts = Cuts::default();
            cuts.add_moved(&of_all[k], to);
            laid.push(cuts.extent(AS_DRAWN));
        }
        let boxes = Boxes::new(laid);
        let is_met = |(k, own): (usize, &Extent)| boxes.at(own.min + (own.max - own.min) / 2.0).any(|other| other != k);
        let met = boxes.all().iter().enumerate().filter(|own| is_met(*own)).count();
        (!boxes.all().is_empty()).then_some((met, !is_all_still))
    }

    fn says(&self, key: &str) -> Option<&[u8]> {
        self.loose.says(key).or_else(|| self.blocks.iter().find_map(|block| block.says(key)))
    }

    fn block(&self, insert: &Item) -> Option<usize> {
        self.names.get(&insert.text(2).to_ascii_uppercase()).copied()
    }

    /// Number of insertions in a block of blocks that ask for cuts.
    fn nested(&self, block: &Sheet) -> usize {
        let inserts = block.items.iter().filter(|item| item.kind == b"INSERT");
        inserts.filter_map(|insert| self.block(insert)).filter(|&k| self.blocks[k].asks_for_cuts()).count()
    }

    /// Cuts of blocks in a row, and behind them those outside blocks.
    fn in_a_row(&self, row: &Row, job: &Job) -> (Cuts, f64) {
        let mut all = Cuts::default();
        let (mut x, mut laid, mut behind) = (0.0, 0, 0);
        let wanted = self.wanted(job).into_iter().chain([ONCE]);
        for (cuts, count) in row.of_all.iter().zip(wanted).filter(|(cuts, _)| !cuts.places.is_empty()) {
            for (axes, count) in [AS_DRAWN, MIRRORED].into_iter().zip(count) {
                let extent = cuts.extent(axes);
                let [right, up, _] = axes;
                for _ in 0..count {
                    let mut width = extent.max.x - extent.min.x;
                    let mut origin = Vector::new(x, 0.0) - extent.min.coords;
                    if let Some((found, drawn)) = row.found(cuts, axes, &mut behind) {
                        all.faults += usize::from(drawn.min.x < x - NOTCHED);
                        (origin, width) = (found, drawn.max.x - x);
                    }
                    all.add_moved(cuts, [right, up, origin]);
                    x += width + job.profile.dxf.gap_mm;
                    laid += 1;
                }
            }
        }
        // Each piece before one in the row may be narrower than its curves by that much, on both sides.
        let off = if all.rounds.is_empty() { 0.0 } else { 2.0 * row.sagitta * f64::from(laid + 1) };
        (all, off)
    }

    /// Counts of each block in a row, as drawn and mirrored: by its own quantity, else the number of its insertions.
    fn wanted(&self, job: &Job) -> Vec<[u32; 2]> {
        if job.patterns.quantity.unwrap_or(job.profile.dxf.quantity) == Quantity::One {
            return vec![ONCE; self.blocks.len()];
        }
        let mut inserted = vec![[0; 2]; self.blocks.len()];
        for item in self.loose.items.iter().filter(|item| item.kind == b"INSERT") {
            if let Some(k) = self.block(item) {
                let is_mirrored = item.number(41).unwrap_or(1.0) * item.number(42).unwrap_or(1.0) < 0.0;
                inserted[k][usize::from(is_mirrored)] += 1;
            }
        }
        let wanted = |(told, inserted): (Option<&[u8]>, [u32; 2])| {
            let inserted = if inserted == [0; 2] { ONCE } else { inserted };
            told.and_then(|told| quantity(&self.letters.read(told))).unwrap_or(inserted)
        };
        self.of_each("QUANTITY").into_iter().zip(inserted).map(wanted).collect()
    }

    /// Block of each piece in a row, in order.
    fn one_behind_the_other(&self, job: &Job) -> impl Iterator<Item = usize> {
        let times = self.wanted(job).into_iter().map(|count| count.iter().map(|&count| count as usize).sum());
        times.enumerate().flat_map(|(k, times): (usize, usize)| std::iter::repeat_n(k, times))
    }

    /// Block of each insertion, in order.
    fn inserted(&self) -> impl Iterator<Item = usize> + '_ {
        let inserts = self.loose.items.iter().filter(|item| item.kind == b"INSERT");
        inserts.filter_map(|insert| self.block(insert))
    }

    /// Value of a key for each block: by an attribute of its insertion, or by a text in it.
    fn of_each(&self, key: &str) -> Vec<Option<&[u8]>> {
        let mut told: Vec<Option<&[u8]>> = vec![None; self.blocks.len()];
        let mut behind = None;
        for item in &self.loose.items {
            match &item.kind[..] {
                b"INSERT" => behind = self.block(item),
                b"ATTRIB" => {
                    if let Some(k) = behind {
                        told[k] = told[k].or_else(|| item.says(key));
                    }
                }
                _ => behind = None,
            }
        }
        self.blocks.iter().zip(told).map(|(block, told)| told.or_else(|| block.says(key))).collect()
    }

    /// For each block, whether it is a piece of a size that is cut.
    fn are_cut(&self, job: &Job, are_apart: bool) -> Vec<bool> {
        let name = |bytes: &[u8]| {
            // Users name sizes as they see them.
            let text = Labels::default().text(self.letters.read(bytes).as_bytes());
            // Bytes that are not valid text are their own name.
            let text = if text.contains('\u{fffd}') { format!("{bytes:x?}") } else { text };
            text.trim().to_uppercase()
        };
        // Blocks without a name of their own are parts of the drawing, unless the drawing itself inserts them.
        let put: BTreeSet<usize> =
            self.loose.items.iter().filter(|item| item.kind == b"INSERT").filter_map(|item| self.block(item)).collect();
        let is_piece =
            |k: usize| self.blocks[k].asks_for_cuts() && (!self.blocks[k].name.starts_with(b"*") || put.contains(&k));
        let told = self.of_each("SIZE").into_iter().enumerate();
        let sizes: Vec<Option<String>> = told.map(|(k, size)| size.filter(|_| is_piece(k)).map(name)).collect();
        let all: BTreeSet<&String> = sizes.iter().flatten().collect();
        let sample = self.says("SAMPLE SIZE").map(name).filter(|sample| all.contains(sample));
        let is_wanted = |size: &String| match &job.patterns.sizes {
            Some(Sizes::All) => true,
            Some(Sizes::Named(names)) => names.iter().any(|name| name.trim().to_uppercase() == *size),
            None => are_apart || all.len() < 2 || sample.as_ref().is_none_or(|sample| sample == size),
        };
        let is_cut = |(k, size): (usize, &Option<String>)| is_piece(k) && size.as_ref().is_none_or(is_wanted);
        sizes.iter().enumerate().map(is_cut).collect()
    }

    /// Cuts of blocks at the places of their insertions, and of items outside blocks as drawn; `None` when no insertion moves a
    /// block.
    fn placed(&self, of_all: &[Cuts]) -> Option<Cuts> {
        let mut all = Cuts::default();
        let mut is_all_still = true;
        for item in self.loose.items.iter().filter(|item| item.kind == b"INSERT") {
            let Some(k) = self.block(item).filter(|&k| !of_all[k].places.is_empty()) else { continue };
            let to = self.to(item, k);
            all.faults += usize::from(!item.is_plain() || to.is_none());
            let to = to.unwrap_or(AS_DRAWN);
            is_all_still &= is_still(to);
            all.add_moved(&of_all[k], to);
        }
        all.add_moved(&of_all[of_all.len() - 1], AS_DRAWN);
        (!is_all_still || all.faults > 0).then_some(all)
    }

    /// Placement of a block by an insertion; `None` when one of its numbers is damaged.
    fn to(&self, insert: &Item, block: usize) -> Option<Move> {
        let [x, y] = insert.pair([10, 20])?;
        let turn = insert.number(50).unwrap_or(0.0).to_radians();
        let [right, up] = [insert.number(41).unwrap_or(1.0), insert.number(42).unwrap_or(1.0)];
        let right = Vector::new(turn.cos(), turn.sin()) * right;
        let up = Vector::new(-turn.sin(), turn.cos()) * up;
        let [base_x, base_y] = self.blocks[block].base?;
        Some([right, up, (Vector::new(x, y) - right * base_x - up * base_y) * self.unit])
    }
}

/// Pieces that lie in a row.
struct Row<'a> {
    of_all: &'a [Cuts],
    read: &'a CutPlaces,
    /// True if curves are laid, so that pieces are larger than their vertices.
    has_bows: bool,
    /// Greatest distance of chords from their curve, mm.
    sagitta: f64,
}

impl Row<'_> {
    /// Origin and box of the next contour that has vertices of a block; `None` when no curves are laid or there is no such
    /// contour. `behind` counts the contours that are taken.
    fn found(&self, cuts: &Cuts, [right, up, _]: Move, behind: &mut usize) -> Option<(Vector, Extent)> {
        if !self.has_bows {
            return None;
        }
        let turned = |at: Point| right * at.x + up * at.y;
        let contours = &self.read.contours;
        let numbers: BTreeSet<u32> = contours[*behind..].iter().flatten().map(|place| place.1).collect();
        let first = cuts.corners.iter().find(|(_, block)| numbers.contains(block))?;
        let has = |contour: &Vec<(Point, u32)>| contour.iter().any(|place| place.1 == first.1);
        let taken = *behind + contours[*behind..].iter().position(has)?;
        *behind = taken + 1;
        let contour = &contours[taken];
        let places = Lookup::of(contour.iter().map(|place| place.0), MEETS);
        let sample: Vec<(Point, u32)> =
            cuts.corners.iter().step_by(cuts.corners.len().div_ceil(CORNERS)).copied().collect();
        let met = |origin: &Vector| {
            let meets = |at: Point| {
                let at = Point::from(turned(at) + origin);
                places.near(at).map(|k| (contour[k].0 - at).norm()).fold(MEETS, f64::min)
            };
            sample.iter().map(|(at, _)| meets(*at)).sum::<f64>()
        };
        // Places of a curve and of its mirror image have the number of the vertex that they lead to. The vertex itself may be
        // missing: the mouth of a notch takes it away.
        let of_corner = |&(corner, block): &(Point, u32)| {
            let own = contour.iter().filter(move |place| place.1 == block);
            own.map(move |place| place.0.coords - turned(corner)).collect::<Vec<Vector>>()
        };
        let origins = sample.iter().chain([first]).flat_map(of_corner);
        let origins = origins.map(|origin| (met(&origin), origin));
        let (_, origin) = origins.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let points: Vec<Point> = contour.iter().map(|place| place.0).collect();
        Some((origin, Extent::of(&points)))
    }
}

/// Length of a unit, mm, by the first letters of its name in the languages of keys.
fn unit_of(name: &str) -> f64 {
    let name = name.trim().to_lowercase();
    let begins = |with: &[&str]| with.iter().any(|start| name.starts_with(start));
    if begins(&["e", "i", "anglais", "zoll", "po", "pul", "英"]) {
        MM_PER_INCH
    } else if begins(&["c", "z", "厘"]) {
        10.0
    } else {
        1.0
    }
}

/// Counts of a block as drawn and mirrored, by a text; `None` when the text gives none.
fn quantity(text: &str) -> Option<[u32; 2]> {
    let whole = |number: &str| {
        let (whole, share) = number.trim().split_once('.').unwrap_or((number.trim(), ""));
        whole.parse().ok().filter(|_| share.bytes().all(|digit| digit == b'0'))
    };
    let numbers: Option<Vec<u32>> = text.split(',').map(whole).collect();
    match numbers.as_deref() {
        None => worded(text),
        Some(&[right]) if right > 0 => Some([right, 0]),
        Some(&[right, left]) if right > 0 || left > 0 => Some([right, left]),
        _ => None,
    }
}

/// Words for pieces and names of materials, in lower case, each between blanks.
const PIECES: &str = " x × pc pcs piece pieces pièce pièces st stk stck styck stück stueck stuks pz pezzo pezzi pieza piezas \
                      peça peças szt sztuk sztuki ks db buc adet шт штук штуки дет 片 件 枚 张 張 个 個 장 매 \
                      self main shell lining fabric contrast interfacing ";

/// Words for a right piece and a left one, likewise.
const PAIRS: &str = " pair pairs pr prs paar paare paire paires paio paia par pares ";

/// Counts of a block, right and left, by a text of a number followed by a word for pieces or pairs, something in parentheses,
/// or both.
fn worded(text: &str) -> Option<[u32; 2]> {
    let text = text.trim().to_lowercase();
    let (number, rest) = text.split_at(text.find(|letter: char| !letter.is_ascii_digit())?);
    let (word, aside) = rest.split_at(rest.find('(').unwrap_or(rest.len()));
    let is_aside = aside.ends_with(')') && aside.matches(['(', ')']).count() == 2;
    let word = word.trim().trim_end_matches('.');
    let is_one_of = |words: &str| !word.is_empty() && !word.contains(' ') && words.contains(&format!(" {word} "));
    let is_pair = is_one_of(PAIRS);
    let is_word = word.is_empty() || is_pair || is_one_of(PIECES) || ["on fold", "on the fold"].contains(&word);
    let is_clear = is_word && (is_aside || aside.is_empty() && !word.is_empty());
    let number = number.parse().ok().filter(|number| is_clear && *number > 0)?;
    Some([number, if is_pair { number } else { 0 }])
}

/// True if a placement leaves a block where it is drawn.
fn is_still([right, up, origin]: Move) -> bool {
    let is_axis = |found: Vector, drawn: Vector| (found - drawn).norm() < TURNS;
    is_axis(right, AS_DRAWN[0]) && is_axis(up, AS_DRAWN[1]) && origin.norm() <= MEETS
}

fn moved(at: Point, [right, up, origin]: Move) -> Point {
    Point::from(right * at.x + up * at.y + origin)
}

impl Round {
    fn moved(&self, to: Move, scale: f64) -> Self {
        let centre = moved(self.centre, to);
        let spoke = moved(self.at(0.0), to) - centre;
        let sweep = if cross(to[0], to[1]) < 0.0 { -self.sweep } else { self.sweep };
        Self { centre, radius: self.radius * scale, start: spoke.y.atan2(spoke.x), sweep }
    }
}

impl Cuts {
    /// The box around all of it under the axes of a placement.
    fn extent(&self, to: Move) -> Extent {
        let mut extent = Extent::EMPTY;
        self.places.iter().for_each(|place| extent.add(moved(place.at, to)));
        for round in &self.rounds {
            (0..=SAMPLES).for_each(|k| extent.add(moved(round.at(k as f64 / SAMPLES as f64), to)));
        }
        extent
    }

    /// Adds the cuts of a block at a placement.
    fn add_moved(&mut self, cuts: &Cuts, to: Move) {
        let [right, up, _] = to;
        // Insertions may scale; patterns are scaled alike in both directions.
        let scale = right.norm().max(up.norm());
        self.places.extend(cuts.places.iter().map(|place| Place { at: moved(place.at, to), ..*place }));
        self.spare.extend(cuts.spare.iter().map(|at| moved(*at, to)));
        self.rounds.extend(cuts.rounds.iter().map(|round| round.moved(to, scale)));
        let both = |ends: [Point; 2]| ends.map(|at| moved(at, to));
        self.bows.extend(cuts.bows.iter().map(|bow| Bow { ends: both(bow.ends) }));
        self.bends.extend(cuts.bends.iter().map(|bend| bend.moved(|at| moved(at, to))));
        self.chords.extend(cuts.chords.iter().map(|ends| both(*ends)));
        self.faults += cuts.faults;
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
