//! Notches as the profile wants them cut: found anew from the marker, which keeps them as they are drawn.

use std::collections::BTreeMap;

use crate::geom::bits;
use crate::ir::list::Segment;
use crate::ir::marker::{NotchKind, Piece, Stroke, Vee};
use crate::machine::{NotchStyle, Notches};

/// The slits of a piece, each with its speed in percent: those that are drawn, with their crossbars, and V notches that
/// outlines no longer have.
pub(super) fn slits(piece: &Piece, notches: Notches, replaced: &[(Vee, u8)]) -> Vec<(Stroke, u8)> {
    let mut slits = Vec::new();
    if notches.style == NotchStyle::Skip {
        return slits;
    }
    for notch in &piece.notches {
        let deeper = notches.depth_mm.map_or(0.0, |depth| depth - notch.depth());
        let deeper = (notch.tip - notch.root).normalize() * deeper;
        slits.push((Stroke { from: notch.root, to: notch.tip + deeper, span: notch.span }, notch.percent));
        if let (NotchKind::T(bar), NotchStyle::AsDrawn) = (notch.kind, notches.style) {
            slits.push((Stroke { from: bar.from + deeper, to: bar.to + deeper, span: bar.span }, notch.percent));
        }
    }
    for (vee, percent) in replaced {
        let inward = vee.direction() * notches.depth_mm.unwrap_or_else(|| vee.depth());
        let root = vee.apex - vee.direction() * vee.depth();
        slits.push((Stroke { from: root, to: root + inward, span: vee.span }, *percent));
    }
    slits
}

/// Takes the V notches that are not cut as they are drawn out of an outline; gives them with the speed of their slower leg.
pub(super) fn straighten(segments: &mut Vec<Segment>, piece: &Piece, notches: Notches) -> Vec<(Vee, u8)> {
    if notches.style == NotchStyle::AsDrawn {
        return Vec::new();
    }
    let by_mouth: BTreeMap<[u64; 2], &Vee> = piece.vees.iter().map(|vee| (bits(vee.mouth[0]), vee)).collect();
    let (mut kept, mut taken) = (Vec::with_capacity(segments.len()), Vec::new());
    let mut rest = segments.iter().peekable();
    // An outline may begin at an apex: then its last segment is the first leg.
    let (first, last) = (segments[0], segments[segments.len() - 1]);
    let is_leg = |leg: &Segment, other: &Segment| {
        by_mouth.get(&bits(leg.from)).copied().filter(|vee| leg.to == vee.apex && other.to == vee.mouth[1])
    };
    let around = is_leg(&last, &first);
    if around.is_some() {
        rest.next();
    }
    while let Some(&segment) = rest.next() {
        let other = rest.peek().copied().copied();
        let over = other.is_none().then_some(around).flatten();
        let Some(vee) = other.and_then(|other| is_leg(&segment, &other)).or(over) else {
            kept.push(segment);
            continue;
        };
        let other = rest.next().copied().unwrap_or(first);
        let percent = segment.percent.min(other.percent);
        kept.push(Segment { to: vee.mouth[1], span: other.span, percent, ..segment });
        taken.push((*vee, percent));
    }
    *segments = kept;
    taken
}
