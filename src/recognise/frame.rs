//! The frame of a marker: a rectangle around all parts, drawn like them.

use super::line::{Class, Line, SMALL_OUTLINE};
use super::nest::middle;
use crate::geom::Extent;
use crate::geom::boxes::Boxes;
use crate::machine::plot::Frame;

/// Share of a frame that the closed lines in it fill at least: less, and it is a part with cut-outs. What is taken for a
/// part by mistake is named; what is taken for a frame by mistake is cut inside.
const LEAST_FILL: f64 = 0.5;
/// How far past a frame the seam lines of its parts are drawn at the most, mm.
const HEM: f64 = 60.0;
/// Frames in frames that are looked for: the paper, and the cloth on it.
const MOST_FRAMES: usize = 3;

/// Boxes that are looked at for one that holds another.
const MOST_HOLDERS: usize = 64;

/// Marks the frames among the lines. A rectangle around one closed line alone is a part; `is_edged` tells an open line that a
/// rectangle would close along its edge, which is as good as a closed one.
pub(super) fn mark(lines: &mut [Line], how: Frame, slack: f64, is_edged: impl Fn(&Extent, &Line) -> bool) {
    let is_large = |line: &Line| line.may_hold() && line.size() > SMALL_OUTLINE;
    let mut order: Vec<usize> = (0..lines.len()).filter(|&i| is_large(&lines[i])).collect();
    order.sort_by(|&a, &b| lines[b].area.total_cmp(&lines[a].area).then(a.cmp(&b)));
    // A hem may be drawn past the corner of its part, and so past the frame.
    let holds = |lines: &[Line], outer: usize, inner: &[usize]| {
        let reach = lines[outer].extent.grown(slack);
        inner.iter().all(|&i| reach.holds(middle(&lines[i].extent)) && reach.grown(HEM).covers(&lines[i].extent))
    };
    match how {
        Frame::None => {}
        Frame::Outermost => {
            if let Some(&first) = order.first() {
                lines[first].class = Class::Frame;
            }
        }
        Frame::Auto => {
            let may_be = |k: &usize| lines[order[*k]].is_rectangle(slack) && holds(lines, order[*k], &order[k + 1..]);
            let count = (0..order.len().min(MOST_FRAMES)).take_while(may_be).count();
            let is_around_several = |&count: &usize| {
                let (frames, inner) = order.split_at(count);
                let frame = &lines[frames[count - 1]];
                let edged = beside(lines, inner, |line| is_edged(&frame.extent, line));
                let filled = outermost_area(lines, inner) + edged.iter().map(|&i| lines[i].area).sum::<f64>();
                let are_several = match inner {
                    [largest, others @ ..] => {
                        !edged.is_empty() || !others.is_empty() && !holds(lines, *largest, others)
                    }
                    [] => edged.len() > 1,
                };
                are_several && filled >= LEAST_FILL * frame.area
            };
            let count = (1..=count).rev().find(is_around_several).unwrap_or(0);
            order[..count].iter().for_each(|&frame| lines[frame].class = Class::Frame);
        }
    }
}

/// Large open lines of a kind that lie beside all closed ones and beside each other: what lies in another is a line of it.
fn beside(lines: &[Line], closed: &[usize], is: impl Fn(&Line) -> bool) -> Vec<usize> {
    let may_be = |line: &Line| !line.is_closed && line.is_open_question() && line.size() > SMALL_OUTLINE && is(line);
    let mut found: Vec<usize> = Vec::new();
    for i in (0..lines.len()).filter(|&i| may_be(&lines[i])) {
        let meets = |&other: &usize| lines[other].extent.overlaps(&lines[i].extent);
        if found.len() < MOST_HOLDERS && !closed.iter().any(meets) && !found.iter().any(meets) {
            found.push(i);
        }
    }
    found
}

/// The area of the closed lines whose box lies in that of no other, nearly: what they cover together.
fn outermost_area(lines: &[Line], by_size: &[usize]) -> f64 {
    let boxes = Boxes::new(by_size.iter().map(|&i| lines[i].extent).collect());
    let is_outermost = |k: usize| {
        let extent = &lines[by_size[k]].extent;
        !boxes.at(extent.min).take(MOST_HOLDERS).any(|other| other < k && boxes.all()[other].covers(extent))
    };
    (0..by_size.len()).filter(|&k| is_outermost(k)).map(|k| lines[by_size[k]].area).sum()
}
