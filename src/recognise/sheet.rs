//! A drawing with classified lines, and the decision which of them are cut.

use std::collections::BTreeSet;

use super::line::{Class, Cut, Line, ROUNDING, SIGN, SMALL_OUTLINE};
use super::marks::{EdgeLine, Lie, Mark, Search};
use super::pens::Use;
use super::remains::Remains;
use super::strokes::{self, Stroke};
use super::{close, enclosed, frame, letters, marks, nest, remains, seam, signs};
use crate::analysis::nesting::Nesting;
use crate::geom::budget::Budget;
use crate::ir::drawing::{Encoded, Ending, Moved, Pen, Vertex};
use crate::ir::marker::Label;
use crate::machine::Job;
use crate::machine::plot::Inner;

/// Depth to which lines that touch may be in one another, mm; at least a diagonal of the unit, since each was rounded by
/// itself.
const BAND: f64 = 0.2;
/// Greatest ratio of the sides of a hole's box.
const HOLE_RATIO: f64 = 1.1;
/// Least share of its box that a hole fills: a circle of eight chords; a square fills all of it.
const HOLE_FILL: f64 = 0.7;
/// Greatest share of its part that an inner line encloses to be cut: a larger one is the part itself, drawn once more.
const LARGEST_INNER: f64 = 0.5;

/// Least number of parts with a seam line, in all and for each part without one: fewer say nothing about the others.
const MANY: usize = 3;

/// Distance within which lines are at one place in a file with that unit, mm.
pub(super) fn band(unit: f64) -> f64 {
    BAND.max(ROUNDING * unit)
}

/// A drawing with classified lines.
#[derive(Debug)]
pub(super) struct Sheet {
    pub(super) vertices: Vec<Vertex>,
    pub(super) lines: Vec<Line>,
    pub(super) nest: Nesting,
    pub(super) marks: Vec<Mark>,
    /// Notches that are open strokes between two places of an outline.
    pub(super) strokes: Vec<Stroke>,
    /// Lines at the edge of a part, other than notches.
    pub(super) from_edges: Vec<EdgeLine>,
    /// Open lines that are remains of outlines, with the closed lines that they go around.
    pub(super) remains: Vec<Remains>,
    /// A rectangle that may be a frame or a part.
    pub(super) frame_doubt: Option<usize>,
    /// The pens that draw them.
    pub(super) pens: Vec<Pen>,
    pub(super) texts: Vec<Label>,
    /// Encoded polylines.
    pub(super) encoded: Vec<Encoded>,
    /// Rows of places that the pen passes in the air as if it drew an outline.
    pub(super) passed: Vec<Vec<Vertex>>,
    pub(super) unit: f64,
    pub(super) ending: Ending,
    pub(super) moved: Moved,
    /// True if a search ended early.
    pub(super) is_cut_short: bool,
}

/// True if so many parts have a seam line that those without are doubtful.
pub(super) fn are_many(with: &[usize], without: &[usize]) -> bool {
    with.len() >= MANY * without.len().max(1)
}

/// True if a closed line is a square or a circle.
pub(super) fn is_square_or_circle(line: &Line) -> bool {
    let (width, height) = line.extent.size();
    width.max(height) <= HOLE_RATIO * width.min(height) && line.area >= HOLE_FILL * width * height
}

impl Sheet {
    /// Classifies every line.
    pub(super) fn sort_out(&mut self, job: &Job) {
        let band = self.band();
        let reach = close::Reach::of(self.unit, job);
        let mut work = Budget::of_a_marker();
        self.frame_doubt = frame::mark(
            &mut self.lines,
            &self.vertices,
            frame::FrameSettings { how: job.profile.hpgl.frame, band, reach },
            &mut work,
        );
        close::close_along_frames(&mut self.lines, &mut self.vertices, reach);
        self.nest = nest::nesting(&self.lines, &self.vertices, &mut work);
        self.find_parts();
        let mut remains = Budget::of_lines(self.lines.len());
        self.find_remains(&mut remains);
        self.is_cut_short |= work.is_spent();
        let mut work = Budget::of_a_marker();
        self.find_marks(&mut work);
        letters::mark(&mut self.lines, &self.vertices, &mut work);
        self.find_holes(job);
        self.find_seams(&mut work);
        self.find_stretches(&mut remains);
        for i in 0..self.lines.len() {
            let line = &mut self.lines[i];
            if line.is_outline() && line.is_open_question() {
                line.class = match self.nest.parent(i) {
                    _ if line.size() < SIGN => Class::Sign,
                    None => Class::SmallOutline,
                    Some(_) => Class::Inner,
                };
            }
        }
        self.find_parts_of_knives(&mut work);
        let parts = self.indices(|line| line.class == Class::Part);
        let from_edges = marks::from_edges(self.search(&parts), &mut work);
        self.from_edges.extend(from_edges);
        // A closed line keeps its class.
        for &EdgeLine { line, .. } in self.from_edges.iter().filter(|edge| edge.lie != Lie::Stands) {
            self.lines[line].class = Class::FromEdge;
        }
        self.is_cut_short |= work.is_spent() || remains.is_spent();
    }

    /// Makes parts of the large lines that are in no other. If a frame shows the cloth, closed lines outside it are not on the
    /// cloth: title blocks, test squares. Lines of a pen that is declared a knife are parts all the same.
    fn find_parts(&mut self) {
        let band = self.band();
        let frames = frame::cloths(&self.lines, band);
        let is_on_cloth =
            |line: &Line| frames.is_empty() || line.usage.is_knife() || frame::is_in_frame(line, &frames, band);
        for i in 0..self.lines.len() {
            let outermost = self.nest.outermost(i).unwrap_or(i);
            let is_part = outermost == i && self.lines[i].size() > SMALL_OUTLINE;
            let is_outside = self.lines[outermost].size() > SMALL_OUTLINE && !is_on_cloth(&self.lines[outermost]);
            let line = &mut self.lines[i];
            if line.is_outline() && is_outside {
                line.class = Class::Outside;
            } else if line.is_outline() && is_part {
                line.class = Class::Part;
            }
        }
    }

    /// Depth to which lines that touch may be in one another, mm.
    pub(super) fn band(&self) -> f64 {
        band(self.unit)
    }

    /// Indices of the lines that satisfy a condition.
    pub(super) fn indices(&self, is: impl Fn(&Line) -> bool) -> Vec<usize> {
        (0..self.lines.len()).filter(|&i| is(&self.lines[i])).collect()
    }

    pub(super) fn search<'a>(&'a self, outlines: &'a [usize]) -> Search<'a> {
        Search { lines: &self.lines, vertices: &self.vertices, unit: self.unit, outlines }
    }

    /// Finds the open lines that are remains of an outline: the closed line that they go around is its seam line, and no part.
    fn find_remains(&mut self, work: &mut Budget) {
        let all = remains::Drawn { lines: &self.lines, vertices: &self.vertices, nest: &self.nest };
        self.remains = remains::find(all, work);
        let enclosed = enclosed::find(all, &self.remains, work);
        self.remains.extend(enclosed);
        for remains in self.remains.iter().filter(|remains| remains.is_sure) {
            self.lines[remains.inner].class = Class::Seam;
        }
    }

    /// Finds open lines beside parts that lack a seam line where most have one.
    fn find_stretches(&mut self, work: &mut Budget) {
        let [with, without] = self.parts_by_seam();
        if !without.is_empty() && are_many(&with, &without) {
            let all = remains::Drawn { lines: &self.lines, vertices: &self.vertices, nest: &self.nest };
            let found = remains::beside_bare(all, &without, &self.remains, work);
            self.remains.extend(found);
        }
    }

    /// The parts with a seam line, and those without.
    pub(super) fn parts_by_seam(&self) -> [Vec<usize>; 2] {
        let mut has_seam = vec![false; self.lines.len()];
        for i in self.indices(|line| line.class == Class::Seam) {
            if let Some(part) = self.nest.outermost(i) {
                has_seam[part] = true;
            }
        }
        let (with, without) =
            self.indices(|line| line.class == Class::Part).into_iter().partition(|&part| has_seam[part]);
        [with, without]
    }

    /// Finds the notches that are strokes, on the edges of parts.
    fn find_marks(&mut self, work: &mut Budget) {
        let parts = self.indices(|line| line.class == Class::Part);
        self.find_marks_on(&parts, work);
    }

    fn find_marks_on(&mut self, parts: &[usize], work: &mut Budget) {
        let mut strokes = strokes::on_outlines(self.search(parts), work);
        for stroke in &strokes {
            self.lines[stroke.line].class = Class::Notch;
        }
        let mut marks = marks::on_outlines(self.search(parts), work);
        let ends = strokes.iter().map(|stroke| (stroke.line, stroke.outline, stroke.miss));
        let ends = ends.chain(marks.iter().map(|mark| (mark.line, mark.outline, mark.miss)));
        let letters = self.letters(&ends.collect::<Vec<_>>(), work);
        strokes.retain(|stroke| !letters.contains(&stroke.line));
        marks.retain(|mark| !letters.contains(&mark.line));
        self.strokes.extend(strokes);
        let touch = marks::TOUCH + ROUNDING * self.unit;
        let signs = signs::among(&marks, self.search(parts), touch, work);
        for &Mark { line, outline, .. } in marks.iter().filter(|mark| signs.contains(&mark.line)) {
            self.lines[line].class = Class::FromEdge;
            self.from_edges.push(EdgeLine { line, outline, other: None, lie: Lie::Sign });
        }
        marks.retain(|mark| !signs.contains(&mark.line));
        for mark in &marks {
            self.lines[mark.line].class = Class::Notch;
        }
        for bar in marks::take_crossbars(&mut marks, self.search(parts)) {
            self.lines[bar].class = Class::Notch;
        }
        self.marks.extend(marks);
    }

    /// Sets apart strokes that have the shape of notches and are letters; each comes with its outline and its distance from it,
    /// mm.
    fn letters(&mut self, strokes: &[(usize, usize, f64)], work: &mut Budget) -> BTreeSet<usize> {
        let touch = marks::TOUCH + ROUNDING * self.unit;
        let mut off: Vec<usize> = strokes.iter().filter(|stroke| stroke.2 > touch).map(|stroke| stroke.0).collect();
        off.sort_unstable();
        off.dedup();
        if off.is_empty() {
            return BTreeSet::new(); // as in nearly all
        }
        let letters = letters::among(&off, &self.lines, &self.vertices, touch, work);
        for &(line, outline, _) in strokes.iter().filter(|stroke| letters.contains(&stroke.0)) {
            // The other one of two legs has already set it.
            if self.lines[line].class != Class::FromEdge {
                self.lines[line].class = Class::FromEdge;
                self.from_edges.push(EdgeLine { line, outline, other: None, lie: Lie::Letters });
            }
        }
        letters
    }

    /// Makes parts of the outermost lines of a pen that is a knife, whatever other pens draw around them, such as the edge of a
    /// table.
    fn find_parts_of_knives(&mut self, work: &mut Budget) {
        let is_drawn = |i: usize| self.nest.parent(i).is_some_and(|parent| self.lines[parent].usage.is_drawn());
        let is_knife = |line: &Line| line.class == Class::Inner && line.usage.is_knife() && line.size() > SMALL_OUTLINE;
        let mut parts = self.indices(is_knife);
        parts.retain(|&i| is_drawn(i));
        for &part in &parts {
            self.lines[part].class = Class::Part;
        }
        self.find_marks_on(&parts, work);
    }

    /// The part that is cut around a line.
    pub(super) fn part_around(&self, line: usize) -> Option<usize> {
        let around = std::iter::successors(self.nest.parent(line), |&outer| self.nest.parent(outer));
        around.filter(|&outer| self.lines[outer].class == Class::Part && self.lines[outer].is_cut).last()
    }

    /// Finds the closed squares and circles of the size of a hole.
    fn find_holes(&mut self, job: &Job) {
        // A unit of rounding: the hint of `drawing/holes` rounds down by as much.
        let Some(most) = job.profile.hpgl.drill_max_mm.map(|most| most + self.unit) else { return };
        for line in self.lines.iter_mut().filter(|line| line.is_outline() && line.is_open_question()) {
            if line.size() <= most && is_square_or_circle(line) {
                line.class = Class::Hole;
            }
        }
    }

    /// Finds the seam line of each closed line that has one: inside a part, or inside a frame.
    fn find_seams(&mut self, work: &mut Budget) {
        let may_be = |line: &Line| line.is_outline() && line.is_open_question() && line.size() >= SIGN;
        let mut inner = self.indices(may_be);
        inner.retain(|&i| self.nest.parent(i).is_some());
        inner.sort_by(|&a, &b| {
            let key = |i: usize| (self.nest.parent(i), self.lines[i].area);
            key(a).0.cmp(&key(b).0).then(key(b).1.total_cmp(&key(a).1)).then(a.cmp(&b))
        });
        let mut seams = Vec::new();
        for children in inner.chunk_by(|&a, &b| self.nest.parent(a) == self.nest.parent(b)) {
            let Some(parent) = self.nest.parent(children[0]) else { continue };
            let outline = self.lines[parent].points(&self.vertices);
            let tried = children.iter().take(seam::CANDIDATES);
            // A line that was not compared is not cut as a cut-out.
            let mut is_seam = |&&i: &&usize| {
                !work.spend(seam::COST * outline.len())
                    || seam::follows(&self.lines[i].points(&self.vertices), &outline)
            };
            seams.extend(tried.filter(|i| is_seam(i)).copied().next());
        }
        // A line inside a seam line is a cut-out: a part has one seam line.
        seams.sort_unstable();
        let is_in_seam = |i: usize| {
            let mut around = std::iter::successors(self.nest.parent(i), |&outer| self.nest.parent(outer));
            around.any(|outer| seams.binary_search(&outer).is_ok())
        };
        for &i in seams.iter().filter(|&&i| !is_in_seam(i)) {
            self.lines[i].class = Class::Seam;
        }
    }

    /// Decides for each line whether it is cut, by the table of classes.
    pub(super) fn decide(&mut self, job: &Job) {
        let inner = job.lines.inner.unwrap_or(job.profile.hpgl.inner);
        for i in 0..self.lines.len() {
            let line = &self.lines[i];
            let is_knife = line.usage.is_knife();
            let by_rule = match line.class.rule().cut {
                Cut::Always => true,
                Cut::Knife => is_knife,
                Cut::Inner => inner == Inner::All || (is_knife || inner == Inner::Cut) && !self.is_too_large(i),
                Cut::All => inner == Inner::All,
                Cut::Every | Cut::Never => false,
            };
            let may_be = match line.usage {
                Use::Unsaid | Use::Knife | Use::Tool => true,
                Use::Drawn | Use::Marks => line.class == Class::Notch,
                Use::Ignore => false,
            };
            // A frame that is cut would make cut-outs of all parts, and one cut is enough for a line.
            let by_option = (job.lines.all || line.usage == Use::Tool) && line.class.rule().cut != Cut::Never;
            self.lines[i].is_cut = may_be && (by_rule || by_option);
        }
        // A notch is cut with its outline.
        for stroke in &self.strokes {
            self.lines[stroke.line].is_cut &= job.lines.all || self.lines[stroke.outline].is_cut;
        }
        for marks in self.marks.chunk_by(|a, b| a.line == b.line) {
            let is_cut = job.lines.all || marks.iter().any(|mark| self.lines[mark.outline].is_cut);
            for line in marks.iter().filter_map(|mark| mark.bar).chain([marks[0].line]) {
                self.lines[line].is_cut &= is_cut;
            }
        }
    }

    /// Sets the class of some lines.
    pub(super) fn set_class(&mut self, lines: impl IntoIterator<Item = usize>, class: Class) {
        for line in lines {
            self.lines[line].class = class;
        }
    }

    /// True if an inner line encloses most of its part.
    fn is_too_large(&self, line: usize) -> bool {
        let part = self.nest.parent(line).map_or(f64::INFINITY, |part| self.lines[part].area);
        self.lines[line].area > LARGEST_INNER * part
    }
}
