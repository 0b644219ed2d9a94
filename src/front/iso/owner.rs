//! Assignment of slits to pieces in files without piece numbers.
//!
//! Such files write slits before or after the outline that they belong to. Their order is ambiguous, but their roots are not: a
//! slit starts on an outline of its piece.

use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Point;
use crate::geom::near::{Near, sorted};
use crate::ir::list::SegmentList;
use crate::ir::marker::{Contour, Notch, NotchStroke, Piece};

/// A slit or stroke that may be assigned to the wrong piece.
#[derive(Debug, Clone, Copy)]
struct Loose {
    /// Index of its current piece.
    piece: usize,
    /// The stroke from its root to its tip.
    stroke: NotchStroke,
    /// Index of the right piece, once known.
    owner: Option<usize>,
    /// The contour, if it is not a notch.
    contour: Option<Contour>,
}

/// Assigns slits, and strokes that may be slits, to the piece whose outline they start on; the current piece has priority. A
/// crossbar goes with its slit. Strokes that start on no outline stay. `unit` is the grid of the file, mm. The remaining ones
/// stay if there are too many to examine.
pub(super) fn settle(list: &SegmentList, pieces: &mut [Piece], unit: f64, out: &mut Diagnostics) {
    let mut loose = gather(list, pieces);
    if pieces.len() < 2 || loose.is_empty() {
        return;
    }
    let mut near = Near::on_grid(unit);
    let roots = sorted(loose.iter().map(|loose| loose.stroke.from));
    for (i, piece) in pieces.iter().enumerate() {
        let outlines = piece.contours.iter().filter(|contour| stroke(list, contour).is_none());
        for ends in outlines.flat_map(|contour| list.lines(contour.range)) {
            near.each(&roots, ends, |k| {
                let Loose { piece, owner, .. } = &mut loose[k];
                if owner.is_none() || i == *piece {
                    *owner = Some(i);
                }
            });
        }
    }
    let tips = sorted(loose.iter().map(|loose| loose.stroke.to));
    for k in (0..loose.len()).filter(|&k| loose[k].owner.is_none()).collect::<Vec<_>>() {
        let bar = loose[k];
        let mut owner = None;
        near.each(&tips, [bar.stroke.from, bar.stroke.to], |i| {
            owner = owner.or(loose[i].owner.filter(|_| loose[i].piece == bar.piece));
        });
        loose[k].owner = owner;
    }
    if near.is_cut_short() {
        let message = "there are too many short lines to find the outline of each: some may be cut with another piece";
        out.push(Diagnostic::new(&code::MARKER_SEARCH_ENDED, message).hint("give every piece its number (N)"));
    }
    for Loose { piece, stroke, owner, contour } in loose {
        let Some(owner) = owner.filter(|&owner| owner != piece) else { continue };
        // Moving a cut to another piece must not make it faster.
        let feed = [pieces[piece].feed, pieces[owner].feed].into_iter().flatten().reduce(f64::min);
        pieces[owner].feed = feed;
        if let Some(contour) = contour {
            pieces[piece].contours.retain(|other| other.range != contour.range);
            pieces[owner].contours.push(contour);
        } else if let Some(place) = pieces[piece].notches.iter().position(|notch| is_same(notch, &stroke)) {
            let notch = pieces[piece].notches.remove(place);
            pieces[owner].notches.push(notch);
        }
    }
}

/// All notches, and contours that are strokes. Overlong notches are included, because M19 declares them.
fn gather(list: &SegmentList, pieces: &[Piece]) -> Vec<Loose> {
    let mut loose = Vec::new();
    for (piece, Piece { notches, contours, .. }) in pieces.iter().enumerate() {
        let slit = |notch: &Notch| NotchStroke { from: notch.root, to: notch.tip, span: notch.span };
        loose.extend(notches.iter().map(|notch| Loose { piece, stroke: slit(notch), owner: None, contour: None }));
        let strokes = contours.iter().filter_map(|contour| Some((stroke(list, contour)?, *contour)));
        loose.extend(strokes.map(|(stroke, contour)| Loose { piece, stroke, owner: None, contour: Some(contour) }));
    }
    loose
}

/// The contour as a stroke, if it runs only between two near points.
fn stroke(list: &SegmentList, contour: &Contour) -> Option<NotchStroke> {
    let mut segments = list.walk(contour.range).map(|(_, segment)| segment);
    let first = segments.find(|segment| segment.from != segment.to)?;
    let ends: [Point; 2] = [first.from, first.to];
    let stroke = NotchStroke { from: first.from, to: first.to, span: first.span };
    (stroke.length() <= Notch::LONGEST && segments.all(|segment| ends.contains(&segment.to))).then_some(stroke)
}

fn is_same(notch: &Notch, stroke: &NotchStroke) -> bool {
    (notch.root, notch.tip, notch.span) == (stroke.from, stroke.to, stroke.span)
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Diagnostics;
    use crate::machine::Job;
    use crate::source::Source;

    const FIRST: &str = "X0Y0*M14*X1000Y0*X1000Y1000*X0Y1000*X0Y0*M15*";
    const SECOND: &str = "X2000Y0*M14*X3000Y0*X3000Y1000*X2000Y1000*X2000Y0*M15*";

    /// Checks the numbers of notches and contours of each piece.
    fn check(blocks: &[&str], expected: &[(usize, usize)]) {
        let file = format!("H1*G71*M15*{}M0*", blocks.concat());
        let source = Source::new("a", file.clone().into_bytes()).expect("small");
        let marker = crate::front::iso::lower::lower(&source, &Job::default(), &mut Diagnostics::default());
        let found: Vec<_> = marker.pieces.iter().map(|piece| (piece.notches.len(), piece.contours.len())).collect();
        assert_eq!(found, expected, "{file}");
    }

    #[test]
    fn a_slit_belongs_to_the_outline_on_which_it_starts_wherever_it_stands() {
        let named = "X500Y0*M14*M19*X500Y50*M15*";
        let plain = "X500Y0*M14*X500Y50*M15*";
        let bar = "X470Y50*M14*X530Y50*M15*";
        check(&[FIRST, named, SECOND], &[(1, 1), (0, 1)]);
        check(&[FIRST, SECOND, named], &[(1, 1), (0, 1)]);
        check(&[named, FIRST, SECOND], &[(1, 1), (0, 1)]);
        check(&[FIRST, plain, SECOND], &[(0, 2), (0, 1)]);
        check(&[FIRST, SECOND, plain], &[(0, 2), (0, 1)]);
        check(&[FIRST, named, bar, SECOND], &[(1, 2), (0, 1)]);
    }

    #[test]
    fn what_starts_on_no_outline_or_on_two_stays_where_it_came_to() {
        let lost = "X1500Y0*M14*M19*X1500Y50*M15*";
        check(&[FIRST, lost, SECOND], &[(0, 1), (1, 1)]);
        let shared = SECOND.replace("X2000", "X1000");
        let between = "X1000Y500*M14*M19*X1050Y500*M15*";
        check(&[FIRST, between, &shared], &[(0, 1), (1, 1)]);
    }
}
