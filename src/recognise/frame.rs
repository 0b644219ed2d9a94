//! The frame of a marker: a rectangle around all parts, drawn like them.

use super::close::Reach;
use super::line::{Class, Line, SMALL_OUTLINE};
use super::nest::middle;
use super::seam;
use crate::geom::Extent;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::ir::drawing::Vertex;
use crate::machine::plot::Frame;

/// Least share of a frame that the closed lines in it fill; a rectangle with less is a part with cut-outs. A frame taken for
/// a part is reported; a part taken for a frame would be cut inside.
const LEAST_FILL: f64 = 0.5;
/// Frames in frames that are looked for: the paper, and the cloth on it.
const MOST_FRAMES: usize = 3;

/// Boxes around a corner that are looked at for one that holds another, and open lines that a frame closes.
const MOST_HOLDERS: usize = 64;
/// Largest mark on the hem of a part, mm: a loop, a button stand.
const LARGEST_MARK: f64 = 100.0;
/// Largest area of a mark, as a share of that of the seam line.
const MARK_SHARE: f64 = 0.1;

/// Settings of the search for frames.
#[derive(Debug, Clone, Copy)]
pub(super) struct FrameSettings {
    pub(super) how: Frame,
    /// How far lines that touch may lie in one another, mm.
    pub(super) band: f64,
    /// How far apart two places may be that a line closes over.
    pub(super) reach: Reach,
}

/// Marks the frames among the lines. A rectangle around one closed line alone is a part, and so is one around its seam
/// line and small marks. An open line that a rectangle would close along its edge, from inside, is as good as a closed
/// one.
pub(super) fn mark(lines: &mut [Line], vertices: &[Vertex], settings: FrameSettings, work: &mut Budget) {
    let is_large = |line: &Line| line.may_hold() && line.size() > SMALL_OUTLINE;
    let mut order: Vec<usize> = (0..lines.len()).filter(|&i| is_large(&lines[i])).collect();
    order.sort_by(|&a, &b| lines[b].area.total_cmp(&lines[a].area).then(a.cmp(&b)));
    match settings.how {
        Frame::None => {}
        Frame::Outermost => {
            if let Some(&first) = order.first() {
                lines[first].class = Class::Frame;
            }
        }
        Frame::Auto => {
            let count = Frames { lines, vertices, settings }.count(&order, work);
            order[..count].iter().for_each(|&frame| lines[frame].class = Class::Frame);
        }
    }
}

/// The lines among which frames are looked for.
struct Frames<'a> {
    lines: &'a [Line],
    vertices: &'a [Vertex],
    settings: FrameSettings,
}

impl Frames<'_> {
    /// How many of the large lines, the largest first, are frames.
    fn count(&self, order: &[usize], work: &mut Budget) -> usize {
        let may_be = |k: &usize| {
            self.lines[order[*k]].is_rectangle(self.settings.band) && self.holds(order[*k], &order[k + 1..])
        };
        let count = (0..order.len().min(MOST_FRAMES)).take_while(may_be).count();
        (1..=count).rev().find(|&count| self.is_around_several(order, count, work)).unwrap_or(0)
    }

    /// Whether lines lie in another. A hem may be drawn past the corner of its part, and so past the frame.
    fn holds(&self, outer: usize, inner: &[usize]) -> bool {
        let reach = self.lines[outer].extent.grown(self.settings.band);
        let lies_in = |extent: &Extent| reach.holds(middle(extent)) && reach.grown(seam::FARTHEST).covers(extent);
        inner.iter().all(|&i| lies_in(&self.lines[i].extent))
    }

    /// Whether the last of some frames holds two parts or more that fill much of it.
    fn is_around_several(&self, order: &[usize], count: usize, work: &mut Budget) -> bool {
        let (frames, inner) = order.split_at(count);
        let frame = &self.lines[frames[count - 1]];
        let edged = self.beside(frame, inner, work);
        let filled = outermost_area(self.lines, inner) + edged.iter().map(|&i| self.lines[i].area).sum::<f64>();
        let are_several = match inner {
            [largest, others @ ..] => {
                let several = !edged.is_empty() || !others.is_empty() && !self.holds(*largest, others);
                several && !self.is_part(frame, *largest, &[others, &edged].concat(), work)
            }
            [] => edged.len() > 1,
        };
        are_several && filled >= LEAST_FILL * frame.area
    }

    /// Whether a rectangle is a part: one line in it is its seam line, and all others in it are lines of that or small
    /// marks.
    fn is_part(&self, frame: &Line, largest: usize, others: &[usize], work: &mut Budget) -> bool {
        let is_small = |line: &Line| line.size() <= LARGEST_MARK && line.area <= MARK_SHARE * self.lines[largest].area;
        let is_mark = |&i: &usize| is_small(&self.lines[i]) || self.holds(largest, &[i]);
        let [outline, line] = [frame, &self.lines[largest]].map(|line| line.points(self.vertices));
        others.iter().all(is_mark) && work.spend(seam::COST * outline.len()) && seam::follows(&line, &outline)
    }

    /// Large open lines that a frame would close from inside. They lie beside all closed ones and beside each other:
    /// a line inside another one belongs to it.
    fn beside(&self, frame: &Line, closed: &[usize], work: &mut Budget) -> Vec<usize> {
        let FrameSettings { band, reach, .. } = self.settings;
        let within = frame.extent.grown(band);
        let may_be = |line: &Line| {
            let is_open = !line.is_closed && line.is_open_question() && line.size() > SMALL_OUTLINE;
            is_open && within.covers(&line.extent) && reach.is_edged(&frame.extent, line, self.vertices)
        };
        let boxes = Boxes::new(closed.iter().map(|&i| self.lines[i].extent).collect());
        let mut found: Vec<usize> = Vec::new();
        for i in (0..self.lines.len()).filter(|&i| may_be(&self.lines[i])) {
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

/// Area covered by the closed lines, mm2: that of the lines whose box lies in no other box.
fn outermost_area(lines: &[Line], by_size: &[usize]) -> f64 {
    let boxes = Boxes::new(by_size.iter().map(|&i| lines[i].extent).collect());
    let is_outermost = |k: usize| {
        let extent = &lines[by_size[k]].extent;
        !boxes.at(extent.min).take(MOST_HOLDERS).any(|other| other < k && boxes.all()[other].covers(extent))
    };
    (0..by_size.len()).filter(|&k| is_outermost(k)).map(|k| lines[by_size[k]].area).sum()
}
