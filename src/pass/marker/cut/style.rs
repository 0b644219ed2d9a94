//! Notches in the style of the profile: the slits that are cut, and the parts of the outline that they replace.
//!
//! A notch in an outline that is cut as a slit, or not at all, leaves the outline, which runs straight over its mouth. The
//! marker keeps it as drawn.

use crate::analysis::cloth::Cloth;
use crate::analysis::mouths::mouths;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Point;
use crate::ir::Marker;
use crate::ir::list::Segment;
use crate::ir::marker::{Notch, NotchKind, NotchStroke, OutlineNotch};
use crate::machine::{NotchStyle, Notches};
use crate::units::number::fixed;

/// Spacing of tested places along a slit, and the distance of the first from its tip, mm.
const STEP: f64 = 0.25;
const INSIDE: f64 = 0.05;

/// Cut of a notch: a stroke, and its speed in percent of the speed of its piece.
pub(super) struct Slit {
    pub(super) stroke: NotchStroke,
    pub(super) percent: u8,
}

/// Cuts of a notch that is drawn as a slit.
pub(super) fn strokes(notch: &Notch, notches: Notches) -> impl Iterator<Item = NotchStroke> + use<> {
    let notch = deepened(notch, notches.depth_mm);
    let count = match notches.style {
        NotchStyle::AsDrawn if notches.cuts_crossbars() => usize::MAX,
        NotchStyle::AsDrawn | NotchStyle::Slit => 1, // the stem
        NotchStyle::Skip => 0,
    };
    notch.strokes().take(count)
}

/// Warns of slits that the profile makes so deep that they lead out of their part.
pub(super) fn check_depths(marker: &Marker, cloth: &Cloth, notches: Notches, diagnostics: &mut Diagnostics) {
    let Some(depth) = notches.depth_mm else { return };
    for (index, piece) in marker.pieces.iter().enumerate() {
        let slits = piece.notches.iter().map(|notch| NotchStroke { from: notch.root, to: notch.tip, span: notch.span });
        let drawn = piece.outline_notches.iter().filter(|_| notches.style == NotchStyle::Slit);
        let drawn = drawn.map(|notch| slit(notch, Notches { depth_mm: None, ..notches }));
        for drawn in slits.chain(drawn).filter(|drawn| drawn.length() < depth) {
            let along = (drawn.to - drawn.from) / drawn.length();
            let deeper = depth - drawn.length();
            let steps = (deeper / STEP).ceil();
            let is_in = |i: usize| cloth.is_in_part(index, drawn.to + along * (deeper * i as f64 / steps).max(INSIDE));
            // A slit drawn outside of all parts belongs to none.
            if is_in(0) && !(1..=steps as usize).all(is_in) {
                let depth = fixed(depth, 2);
                let message = format!("a slit of {depth} mm leads out of its part, which is narrower here");
                let hint = "take a smaller notch.depth_mm, or give the piece a profile of its own";
                diagnostics.push(Diagnostic::new(&code::PATH_NOTCH_THROUGH, message).at(drawn.span).hint(hint));
            }
        }
    }
}

/// Notch with another depth; its crossbar stays at its tip.
fn deepened(notch: &Notch, depth: Option<f64>) -> Notch {
    let (Some(depth), along) = (depth, notch.tip - notch.root) else { return *notch };
    let tip = notch.root + along * (depth / notch.depth());
    let shift = tip - notch.tip;
    let kind = match notch.kind {
        NotchKind::Slit => NotchKind::Slit,
        NotchKind::T(bar) => NotchKind::T(NotchStroke { from: bar.from + shift, to: bar.to + shift, ..bar }),
    };
    Notch { kind, tip, ..*notch }
}

/// Slit in place of a notch in an outline: from the middle of its mouth into the part, even if the notch protrudes.
pub(super) fn slit(notch: &OutlineNotch, notches: Notches) -> NotchStroke {
    let depth = notches.depth_mm.unwrap_or(notch.depth());
    NotchStroke { from: notch.root(), to: notch.root() + notch.inwards() * depth, span: notch.span }
}

/// Notch over which an outline runs straight.
#[derive(Debug, Clone)]
pub(super) struct Bridged {
    /// Index of the segment over its mouth.
    pub(super) at: usize,
    /// Notch.
    pub(super) notch: OutlineNotch,
    /// Replaced segments of the outline.
    pub(super) legs: Vec<Segment>,
    /// Least speed of these, in percent.
    pub(super) percent: u8,
}

/// Replaces the notches of an outline by straight segments over their mouths, and returns them in the order of the outline.
pub(super) fn bridge(outline: &mut Vec<Segment>, notches: &[OutlineNotch]) -> Vec<Bridged> {
    let edges: Vec<[Point; 2]> = outline.iter().map(|segment| [segment.from, segment.to]).collect();
    let (drawn, count) = (outline.clone(), outline.len());
    let mut bridged = Vec::new();
    let mut is_gone = vec![false; count];
    for (i, notch) in mouths(&edges, notches) {
        let replaced = (0..notch.segments as usize).map(|k| (i + k) % count);
        let legs: Vec<Segment> = replaced.clone().map(|k| drawn[k]).collect();
        let percent = legs.iter().map(|leg| leg.percent).min().unwrap_or(drawn[i].percent);
        let span = legs.last().map_or(drawn[i].span, |last| last.span);
        replaced.skip(1).for_each(|k| is_gone[k] = true);
        outline[i] = Segment { to: notch.mouth[1], span, percent, ..drawn[i] };
        bridged.push(Bridged { at: i, notch: *notch, legs, percent });
    }
    let before = |kept: &mut usize, gone: &bool| Some(std::mem::replace(kept, *kept + usize::from(!gone)));
    let places: Vec<usize> = is_gone.iter().scan(0, before).collect();
    for bridged in &mut bridged {
        bridged.at = places[bridged.at];
    }
    let mut is_gone = is_gone.into_iter();
    outline.retain(|_| !is_gone.next().unwrap_or_default());
    bridged
}
