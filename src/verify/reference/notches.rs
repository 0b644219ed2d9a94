//! Notches in the style of the profile, derived from the marker, which keeps them as drawn.

use std::collections::BTreeMap;

use crate::geom::bits;
use crate::ir::list::Segment;
use crate::ir::marker::{NotchKind, NotchStroke, OutlineNotch, Piece};
use crate::machine::{NotchStyle, Notches, TNotch};

/// Slits of a piece, each with its speed in percent: the drawn slits with their crossbars, and the slits that replace notches
/// of outlines.
pub(in crate::verify) fn slits(
    piece: &Piece,
    notches: Notches,
    replaced: &[(OutlineNotch, u8)],
) -> Vec<(NotchStroke, u8)> {
    let mut slits = Vec::new();
    if notches.style == NotchStyle::Skip {
        return slits;
    }
    for notch in &piece.notches {
        let deeper = notches.depth_mm.map_or(0.0, |depth| depth - notch.depth());
        let deeper = (notch.tip - notch.root).normalize() * deeper;
        slits.push((NotchStroke { from: notch.root, to: notch.tip + deeper, span: notch.span }, notch.percent));
        if let (NotchKind::T(bar), NotchStyle::AsDrawn, TNotch::AsDrawn) = (notch.kind, notches.style, notches.t) {
            slits.push((NotchStroke { from: bar.from + deeper, to: bar.to + deeper, span: bar.span }, notch.percent));
        }
    }
    for (notch, percent) in replaced {
        let [one, other] = notch.mouth;
        let root = one + (other - one) / 2.0;
        let drawn = notch.tip - root;
        let depth = notches.depth_mm.unwrap_or_else(|| drawn.norm());
        let inward = drawn.normalize() * if notch.outwards { -depth } else { depth };
        slits.push((NotchStroke { from: root, to: root + inward, span: notch.span }, *percent));
    }
    slits
}

/// Removes the notches that are not cut as drawn from an outline. Returns each with the lowest speed, in percent, of its
/// segments.
pub(super) fn straighten(segments: &mut Vec<Segment>, piece: &Piece, notches: Notches) -> Vec<(OutlineNotch, u8)> {
    if notches.style == NotchStyle::AsDrawn {
        return Vec::new();
    }
    let count = segments.len();
    // Index by the two ends of the stretch that is no longer cut.
    let by_mouth: BTreeMap<[[u64; 2]; 2], &OutlineNotch> =
        piece.outline_notches.iter().map(|notch| (notch.mouth.map(bits), notch)).collect();
    let mut by_length: Vec<usize> = piece.outline_notches.iter().map(|notch| notch.segments as usize).collect();
    by_length.sort_unstable();
    by_length.dedup();
    by_length.retain(|&length| length < count);
    let (mut kept, mut taken) = (Vec::with_capacity(count), Vec::new());
    // The remainder of a stretch that continues past the end of the list is at its beginning.
    let (mut k, mut carried_over) = (0, 0);
    while k < count {
        let segment = segments[k];
        let ways = by_length.iter().map(|&length| (length, segments[(k + length - 1) % count]));
        let opened = ways.clone().find_map(|(length, last)| {
            let notch = by_mouth.get(&[bits(segment.from), bits(last.to)])?;
            (notch.segments as usize == length).then_some((**notch, length, last))
        });
        let Some((notch, length, last)) = opened else {
            kept.push(segment);
            k += 1;
            continue;
        };
        let percent = (k..k + length).map(|i| segments[i % count].percent).min().unwrap_or(segment.percent);
        kept.push(Segment { to: last.to, span: last.span, percent, ..segment });
        taken.push((notch, percent));
        k += length;
        carried_over = k.saturating_sub(count);
    }
    kept.drain(..carried_over);
    *segments = kept;
    taken
}
