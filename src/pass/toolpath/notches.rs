//! Notches in the style of the profile: which slits are cut, and what of the outline they replace.
//!
//! A V notch that is cut as a slit, or not at all, leaves the outline: that runs straight over its mouth. The marker keeps
//! it as it is drawn.

use std::collections::BTreeMap;

use super::scene::Scene;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::bits;
use crate::ir::Marker;
use crate::ir::list::Segment;
use crate::ir::marker::{Notch, NotchKind, Stroke, Vee};
use crate::machine::{NotchStyle, Notches};
use crate::units::number::fixed;

/// Places along a slit are looked at this far from each other, mm, the first so far behind its tip.
const STEP: f64 = 0.25;
const INSIDE: f64 = 0.05;

/// The cuts of a notch that is drawn as a slit.
pub(super) fn strokes(notch: &Notch, notches: Notches) -> impl Iterator<Item = Stroke> + use<> {
    let notch = deepened(notch, notches.depth_mm);
    let count = match notches.style {
        NotchStyle::AsDrawn => usize::MAX,
        NotchStyle::Slit => 1, // the stem
        NotchStyle::Skip => 0,
    };
    notch.strokes().take(count)
}

/// Finds slits that the profile makes so deep that they lead out of their part.
pub fn check_depths(marker: &Marker, scene: &Scene, diagnostics: &mut Diagnostics) {
    let notches = scene.job.profile.notch;
    let Some(depth) = notches.depth_mm.filter(|_| notches.style != NotchStyle::Skip) else { return };
    for (index, piece) in marker.pieces.iter().enumerate() {
        let slits = piece.notches.iter().map(|notch| Stroke { from: notch.root, to: notch.tip, span: notch.span });
        let vees = piece.vees.iter().filter(|_| notches.style == NotchStyle::Slit);
        let vees = vees.map(|vee| slit(vee, Notches { depth_mm: None, ..notches }));
        for drawn in slits.chain(vees).filter(|drawn| drawn.length() < depth) {
            let along = (drawn.to - drawn.from) / drawn.length();
            let deeper = depth - drawn.length();
            let steps = (deeper / STEP).ceil();
            let is_in = |i: usize| scene.is_in_part(index, drawn.to + along * (deeper * i as f64 / steps).max(INSIDE));
            // A slit that is drawn outside of all parts is nobody's.
            if is_in(0) && !(1..=steps as usize).all(is_in) {
                let depth = fixed(depth, 2);
                let message = format!("a slit of {depth} mm leads out of its part, which is narrower here");
                let hint = "take a smaller notch.depth_mm, or give the piece a profile of its own";
                diagnostics.push(Diagnostic::new(&code::PATH_NOTCH_THROUGH, message).at(drawn.span).hint(hint));
            }
        }
    }
}

/// A notch of another depth; its crossbar stays at its tip.
fn deepened(notch: &Notch, depth: Option<f64>) -> Notch {
    let (Some(depth), along) = (depth, notch.tip - notch.root) else { return *notch };
    let tip = notch.root + along * (depth / notch.depth());
    let shift = tip - notch.tip;
    let kind = match notch.kind {
        NotchKind::Slit => NotchKind::Slit,
        NotchKind::T(bar) => NotchKind::T(Stroke { from: bar.from + shift, to: bar.to + shift, ..bar }),
    };
    Notch { kind, tip, ..*notch }
}

/// The slit that a V notch becomes, from the middle of its mouth.
pub(super) fn slit(vee: &Vee, notches: Notches) -> Stroke {
    let from = vee.mouth[0] + (vee.mouth[1] - vee.mouth[0]) / 2.0;
    let depth = notches.depth_mm.unwrap_or(vee.depth());
    Stroke { from, to: from + vee.direction() * depth, span: vee.span }
}

/// Leads an outline straight over the mouths of its V notches: these, in the order of the outline, each with the speed of
/// its legs in percent.
pub(super) fn bridge(outline: &mut Vec<Segment>, vees: &[Vee]) -> Vec<(Vee, u8)> {
    let at: BTreeMap<[u64; 2], &Vee> = vees.iter().map(|vee| (bits(vee.apex), vee)).collect();
    let legs: Vec<(Segment, Segment)> = outline.iter().copied().zip(outline.iter().copied().cycle().skip(1)).collect();
    let mut bridged = Vec::new();
    let mut is_second = vec![false; outline.len()];
    for (i, (first, second)) in legs.into_iter().enumerate() {
        let vee = at.get(&bits(first.to)).filter(|vee| vee.mouth == [first.from, second.to]);
        let Some(&&vee) = vee else { continue };
        let percent = first.percent.min(second.percent);
        outline[i] = Segment { to: second.to, span: second.span, percent, ..first };
        is_second[(i + 1) % outline.len()] = true;
        bridged.push((vee, percent));
    }
    let mut is_second = is_second.into_iter();
    outline.retain(|_| !is_second.next().unwrap_or_default());
    bridged
}
