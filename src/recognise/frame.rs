//! Frames of markers: rectangles around parts, drawn like these. A frame is recognised by its contents: a title block, a test
//! square or a second marker may lie beside it.

use super::close::Reach;
use super::line::{Class, Line, SMALL_OUTLINE};
use super::nest::middle;
use super::seam;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point};
use crate::ir::drawing::Vertex;
use crate::machine::plot::Frame;

/// Least share of a frame that the closed lines in it fill; a rectangle with less is a part with cut-outs. A frame taken for a
/// part is reported; a part taken for a frame would be cut inside.
const LEAST_FILL: f64 = 0.5;
/// Least share of a rectangle filled by the closed lines in it at which the user must decide whether it is a frame: with less
/// it is a part with cut-outs.
const LEAST_DOUBTFUL: f64 = 0.15;
/// Greatest area outside of frames, as a share of theirs: title blocks and test squares. More may be parts, and the rectangle
/// may then be one of them.
pub(super) const MOST_OUTSIDE: f64 = 0.1;
/// Least share of an outer frame taken up by the frame in it if something lies between them: the cloth on the paper; and of
/// the box of a frame whose corner a title block takes up.
const LEAST_CLOTH: f64 = 0.75;
/// Least number of parts, or least share of filled area, for rectangles beside each other to be frames: with less they may be
/// parts with cut-outs.
const SURE_PARTS: usize = 3;
const SURE_FILL: f64 = 0.7;
/// Greatest nesting depth of frames: the paper, and the cloth on it.
const MOST_FRAMES: usize = 3;

/// Greatest number of boxes around a corner that are tested for containing another, and of open lines that a frame closes.
const MOST_HOLDERS: usize = 64;
/// Largest mark on the hem of a part, mm: a loop, a button stand.
const LARGEST_MARK: f64 = 100.0;
/// Largest area of a mark, as a share of the area of the seam line.
const MARK_SHARE: f64 = 0.1;

/// Settings of the search for frames.
#[derive(Debug, Clone, Copy)]
pub(super) struct FrameSettings {
    pub(super) how: Frame,
    /// Greatest overlap of touching lines, mm.
    pub(super) band: f64,
    /// Greatest distances over which a line closes.
    pub(super) reach: Reach,
}

/// Marks the frames among the lines. A rectangle around a single closed line is a part, as is one around its seam line and
/// small marks. An open line that a rectangle would close along its edge from inside counts as closed. Returns a rectangle that
/// may be a frame or a part if only the user can decide.
pub(super) fn mark(
    lines: &mut [Line],
    vertices: &[Vertex],
    settings: FrameSettings,
    work: &mut Budget,
) -> Option<usize> {
    let is_large = |line: &Line| line.may_hold() && line.size() > SMALL_OUTLINE;
    let mut order: Vec<usize> = (0..lines.len()).filter(|&i| is_large(&lines[i])).collect();
    order.sort_by(|&a, &b| lines[b].area.total_cmp(&lines[a].area).then(a.cmp(&b)));
    let is_open = |line: &Line| !line.is_closed && line.is_open_question() && line.size() > SMALL_OUTLINE;
    let open = (0..lines.len()).filter(|&i| is_open(&lines[i])).collect();
    let search = Frames { lines, vertices, settings, open };
    let found = match settings.how {
        Frame::None => Found::default(),
        Frame::Outermost => search.asked(&order, work),
        Frame::Auto => search.find(&order, work),
    };
    found.frames.iter().for_each(|&frame| lines[frame].class = Class::Frame);
    found.doubt
}

/// Frames, and a rectangle that may be one.
#[derive(Default)]
struct Found {
    frames: Vec<usize>,
    doubt: Option<usize>,
}

/// Line that lies in no other, and the lines in it, the largest first.
struct Top {
    line: usize,
    inner: Vec<usize>,
}

/// Parts in a rectangle: their number, and the share of it that they fill.
#[derive(Clone, Copy)]
struct Filling {
    parts: usize,
    share: f64,
}

/// Lines among which frames are searched.
struct Frames<'a> {
    lines: &'a [Line],
    vertices: &'a [Vertex],
    settings: FrameSettings,
    /// Large open lines.
    open: Vec<usize>,
}

impl Frames<'_> {
    /// Largest line, and the rectangles beside it around at least two lines. A rectangle in one of them that may be a frame
    /// as well is a doubt.
    fn asked(&self, order: &[usize], work: &mut Budget) -> Found {
        let tops = self.tops(order, work);
        let is_frame = |(k, top): &(usize, &Top)| *k == 0 || self.is_rectangle(top.line) && top.inner.len() > 1;
        let found: Vec<&Top> = tops.iter().enumerate().filter(is_frame).map(|(_, top)| top).collect();
        let nested = |top: &&Top| self.inner_frames(top, 1, LEAST_DOUBTFUL, work).map(|(frames, _)| frames[0]);
        Found { doubt: found.iter().find_map(nested), frames: found.iter().map(|top| top.line).collect() }
    }

    /// Frames among large lines, given the largest first, including those of several markers beside each other.
    fn find(&self, order: &[usize], work: &mut Budget) -> Found {
        let tops = self.tops(order, work);
        let (mut frames, mut framed, mut outside) = (Vec::new(), 0.0, 0.0);
        let mut fillings: Vec<(usize, Filling)> = Vec::new();
        for top in &tops {
            let area = self.lines[top.line].area;
            match self.frame(top, 1, LEAST_FILL, work) {
                Some((found, filling)) => {
                    frames.extend(found);
                    fillings.push((top.line, filling));
                    framed += area;
                }
                None => outside += area,
            }
        }
        let Some(&(first, _)) = fillings.first() else {
            return Found { frames, doubt: self.doubtful(&tops, outside, work) };
        };
        let is_sure = |filling: Filling| filling.parts >= SURE_PARTS || filling.share >= SURE_FILL;
        let are_sure = fillings.len() == 1 || fillings.iter().all(|&(_, filling)| is_sure(filling));
        if outside <= MOST_OUTSIDE * framed && are_sure {
            return Found { frames, doubt: None };
        }
        // Among many parts a rectangle with cut-outs is one of them.
        Found { frames: Vec::new(), doubt: Some(first).filter(|_| outside <= framed) }
    }

    /// Rectangle that takes up nearly all the area and is partly filled with parts or cut-outs beside each other, or around
    /// another one that is. A title block may take up a corner of it.
    fn doubtful(&self, tops: &[Top], outside: f64, work: &mut Budget) -> Option<usize> {
        let top = tops.first().filter(|top| top.inner.len() > 1)?;
        let area = self.lines[top.line].area;
        let filling = if self.is_rectangle(top.line) {
            self.frame(top, 1, LEAST_DOUBTFUL, work)?.1
        } else {
            self.filling(top, work).filter(|filling| self.is_notched(top.line) && filling.share >= LEAST_DOUBTFUL)?
        };
        (filling.parts > 1 && outside - area <= MOST_OUTSIDE * area).then_some(top.line)
    }

    /// Nested frames from a line inwards, the outermost first; `None` if the line is not a frame, or if parts fill less than
    /// a share of the innermost rectangle.
    fn frame(&self, top: &Top, depth: usize, least: f64, work: &mut Budget) -> Option<(Vec<usize>, Filling)> {
        if depth > MOST_FRAMES || !self.is_rectangle(top.line) {
            return None;
        }
        let mut frames = vec![top.line];
        let inner = self.inner_frames(top, depth, least, work);
        let filling = self.filling(top, work).filter(|filling| filling.share >= least);
        let filling = match inner {
            Some((inner, filling)) => {
                frames.extend(inner);
                filling
            }
            None => filling?,
        };
        Some((frames, filling))
    }

    /// Frames in a frame: the cloth on the paper, around everything except a title block.
    fn inner_frames(&self, outer: &Top, depth: usize, least: f64, work: &mut Budget) -> Option<(Vec<usize>, Filling)> {
        let tops = self.tops(&outer.inner, work);
        let [first, others @ ..] = &tops[..] else { return None };
        let area = |line: usize| self.lines[line].area;
        let outside = others.iter().fold(0.0, |sum, top| sum + area(top.line));
        let is_cloth = area(first.line) >= LEAST_CLOTH * area(outer.line);
        if !others.is_empty() && (!is_cloth || outside > MOST_OUTSIDE * area(first.line)) {
            return None;
        }
        self.frame(first, depth + 1, least, work)
    }

    fn is_rectangle(&self, line: usize) -> bool {
        self.lines[line].is_rectangle(self.settings.band)
    }

    /// True if all edges of a line are parallel to the sides of its box, most of which it fills.
    fn is_notched(&self, line: usize) -> bool {
        let (width, height) = self.lines[line].extent.size();
        let points = self.lines[line].points(self.vertices);
        let is_parallel = |ends: &[Point]| (ends[1] - ends[0]).abs().min() <= self.settings.band;
        self.lines[line].area >= LEAST_CLOTH * width * height && points.windows(2).all(is_parallel)
    }

    /// Lines that lie in none of the others, each with the lines in it; empty if the budget is spent.
    fn tops(&self, order: &[usize], work: &mut Budget) -> Vec<Top> {
        let extent = |line: usize| self.lines[line].extent.grown(self.settings.band);
        let boxes = Boxes::new(order.iter().map(|&line| extent(line)).collect());
        let mut tops: Vec<Top> = Vec::new();
        let mut top_of: Vec<Option<usize>> = vec![None; order.len()];
        for (k, &line) in order.iter().enumerate() {
            let at = middle(&self.lines[line].extent);
            if !work.spend(boxes.cost_at(at)) {
                return Vec::new();
            }
            let holder = |other: usize| top_of[other].filter(|_| other < k && self.holds(order[other], &[line]));
            if let Some(top) = boxes.at(at).filter_map(holder).min() {
                tops[top].inner.push(line);
            } else {
                top_of[k] = Some(tops.len());
                tops.push(Top { line, inner: Vec::new() });
            }
        }
        tops
    }

    /// True if lines lie in another.
    fn holds(&self, outer: usize, inner: &[usize]) -> bool {
        let outer = [self.lines[outer].extent];
        inner.iter().all(|&i| is_in_frame(&self.lines[i], &outer, self.settings.band))
    }

    /// Filling of a rectangle with at least two parts; `None` with fewer.
    fn filling(&self, Top { line, inner }: &Top, work: &mut Budget) -> Option<Filling> {
        let frame = &self.lines[*line];
        let edged = self.beside(frame, inner, work);
        let are_several = match &inner[..] {
            [largest, others @ ..] => {
                let several = !edged.is_empty() || !others.is_empty() && !self.holds(*largest, others);
                several && !self.is_part(frame, *largest, &[others, &edged].concat(), work)
            }
            [] => edged.len() > 1,
        };
        if !are_several {
            return None;
        }
        let outermost = outermost(self.lines, inner);
        let all = || outermost.iter().chain(&edged);
        Some(Filling { parts: all().count(), share: all().map(|&i| self.lines[i].area).sum::<f64>() / frame.area })
    }

    /// True if a rectangle is a part: one line in it is its seam line, and all others in it are lines of that or small marks.
    fn is_part(&self, frame: &Line, largest: usize, others: &[usize], work: &mut Budget) -> bool {
        let is_small = |line: &Line| line.size() <= LARGEST_MARK && line.area <= MARK_SHARE * self.lines[largest].area;
        let is_mark = |&i: &usize| is_small(&self.lines[i]) || self.holds(largest, &[i]);
        let [outline, line] = [frame, &self.lines[largest]].map(|line| line.points(self.vertices));
        others.iter().all(is_mark) && work.spend(seam::COST * outline.len()) && seam::follows(&line, &outline)
    }

    /// Large open lines that a frame would close from inside. They lie beside all closed ones and beside each other, because a
    /// line inside another one belongs to it.
    fn beside(&self, frame: &Line, closed: &[usize], work: &mut Budget) -> Vec<usize> {
        let FrameSettings { band, reach, .. } = self.settings;
        let within = frame.extent.grown(band);
        let may_be = |line: &Line| within.covers(&line.extent) && reach.is_edged(&frame.extent, line, self.vertices);
        if !self.open.iter().any(|&i| may_be(&self.lines[i])) {
            return Vec::new(); // the usual case
        }
        let boxes = Boxes::new(closed.iter().map(|&i| self.lines[i].extent).collect());
        let mut found: Vec<usize> = Vec::new();
        for i in self.open.iter().copied().filter(|&i| may_be(&self.lines[i])) {
            let extent = self.lines[i].extent;
            if found.len() == MOST_HOLDERS || !work.spend(boxes.cost_near(&extent)) {
                break;
            }
            let meets = |other: &Extent| other.overlaps(&extent);
            let lies_alone = !boxes.near(extent).any(|k| meets(&boxes.all()[k]));
            if lies_alone && !found.iter().any(|&other| meets(&self.lines[other].extent)) {
                found.push(i);
            }
        }
        found
    }
}

/// Closed lines whose box lies in no other box.
fn outermost(lines: &[Line], by_size: &[usize]) -> Vec<usize> {
    let boxes = Boxes::new(by_size.iter().map(|&i| lines[i].extent).collect());
    let is_outermost = |k: &usize| {
        let extent = &lines[by_size[*k]].extent;
        !boxes.at(extent.min).take(MOST_HOLDERS).any(|other| other < *k && boxes.all()[other].covers(extent))
    };
    (0..by_size.len()).filter(is_outermost).map(|k| by_size[k]).collect()
}

/// Frames without another frame inside: they show the cloth.
pub(super) fn cloths(lines: &[Line], band: f64) -> Vec<Extent> {
    let frames: Vec<&Line> = lines.iter().filter(|line| line.class == Class::Frame).collect();
    let is_around = |outer: &Line| {
        let extent = [outer.extent];
        frames.iter().any(|inner| inner.area < outer.area && is_in_frame(inner, &extent, band))
    };
    frames.iter().filter(|frame| !is_around(frame)).map(|frame| frame.extent).collect()
}

/// True if a line lies in one of some frames. A hem may be drawn past it.
pub(super) fn is_in_frame(line: &Line, frames: &[Extent], band: f64) -> bool {
    let holds = |frame: &Extent| {
        let reach = frame.grown(band);
        reach.holds(middle(&line.extent)) && reach.grown(seam::FARTHEST).covers(&line.extent)
    };
    frames.iter().any(holds)
}
