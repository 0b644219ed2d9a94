//! What is said of entities that are not read, not in the drawing, or not shown.

use std::collections::{BTreeMap, BTreeSet};

use super::choice::Asked;
use super::curves::{CurvedFrom, CurvedPieces, Drafting};
use super::layer::Names;
use super::piece::Piece;
use super::shape::Unread;
use crate::diagnostic::{Diagnostic, Diagnostics, PieceName, code};
use crate::source::Span;

/// Layers that a message names.
const LAYERS_SHOWN: usize = 12;

/// For how many pieces a curve was taken or laid, and how far the curves leave the chords of layer 1.
pub(super) fn say_curves(curved: &CurvedPieces, drafting: &Drafting, out: &mut Diagnostics) {
    if drafting.is_overfull() {
        let message = "the curves through the curve points (layer 3) have more places than a set of patterns can need";
        let finding = Diagnostic::new(&code::DXF_CURVES, message);
        out.push(finding.hint("look for a damaged coordinate; `dxf.curves=points` lays no curves"));
        return;
    }
    if let Some(span) = drafting.wild {
        let message = "a curve through the curve points (layer 3) would leave its chords by more than half their length";
        let finding = Diagnostic::new(&code::DXF_WILD_CURVE, message).at(span);
        out.push(finding.hint("look at these points; `dxf.curves=points` lays no curves"));
    }
    let pieces = |from: &CurvedFrom| if from.pieces == 1 { "1 piece".to_owned() } else { format!("{} pieces", from.pieces) };
    let off = |from: &CurvedFrom| format!("up to {:.1} mm from the chords of its points", from.off);
    let CurvedPieces { fine, laid } = curved;
    if fine.pieces > 0 {
        let message = format!("{} cut along the curves of layers 84 to 87, {}", pieces(fine), off(fine));
        let finding = Diagnostic::new(&code::DXF_CURVED, message).at(fine.first);
        out.push(finding.hint("the file draws them so; `dxf.curves=points` cuts along the chords"));
    }
    if laid.pieces > 0 {
        let (pieces, off) = (pieces(laid), off(laid));
        let finding = match drafting.system {
            Some(system) => {
                let message = format!("{pieces} cut along curves through the curve points as {system} lays them, {off}");
                Diagnostic::new(&code::DXF_CURVED, message)
            }
            None => {
                let message = format!("{pieces} cut along curves through the curve points, {off}; the CAD system may lay others");
                Diagnostic::new(&code::DXF_CURVE_GUESSED, message)
            }
        };
        let hint = "let the CAD system export ASTM DXF with its curves on layer 84, or compare a neck and an armhole";
        out.push(finding.at(laid.first).hint(hint));
    }
}

/// Why a piece of these numbers cannot be cut, and how to leave it out.
pub(super) fn say_at_fault(piece: &Piece, numbers: &[u32], Asked { source, job, .. }: &Asked, out: &mut Diagnostics) {
    let first = numbers.first().copied().unwrap_or_default();
    let label = piece.labels.first().map(|label| job.profile.labels.text(source.slice(label.span)));
    let name = PieceName { number: first, copy: 0, label };
    let numbers: Vec<String> = numbers.iter().map(u32::to_string).collect();
    let hint = format!("all other pieces can be cut without it: `--skip {}`", numbers.join(","));
    for fault in &piece.faults {
        out.push(Diagnostic { piece: Some(Box::new(name.clone())), ..fault.clone() }.hint(hint.clone()));
    }
}

/// The finding that a file is a plain drawing on these layers.
pub(super) fn plain(names: &Names) -> Diagnostic {
    let names = names.all();
    let dots = if names.len() > LAYERS_SHOWN { ", ..." } else { "" };
    let word = if names.len() == 1 { "layer" } else { "layers" };
    let shown = names[..names.len().min(LAYERS_SHOWN)].join(", ");
    let message = format!("the file is a plain DXF drawing, not pattern DXF (AAMA, ASTM): its lines are on {word} {shown}{dots}");
    let hint = "let the CAD system export the pieces as AAMA or ASTM DXF, or the marker as a cut file (ISO) or an HPGL plot";
    Diagnostic::new(&code::DXF_PLAIN, message).hint(hint)
}

/// What kinds of entities are not read, and on which layers.
pub(super) fn say_unread(unread: &[Unread], out: &mut Diagnostics) {
    let mut kinds: BTreeMap<&str, (Vec<&Unread>, BTreeSet<&str>)> = BTreeMap::new();
    for entity in unread {
        let (of_kind, layers) = kinds.entry(&entity.kind).or_default();
        of_kind.push(entity);
        layers.insert(&entity.pen);
    }
    for (kind, (of_kind, layers)) in kinds {
        let word = if layers.len() == 1 { "layer" } else { "layers" };
        let layers = format!("{word} {}", layers.into_iter().collect::<Vec<_>>().join(", "));
        let (count, are) = (of_kind.len(), if of_kind.len() == 1 { "is" } else { "are" });
        let message = format!("{count} of the kind {kind} {are} not read, on {layers}");
        let finding = Diagnostic::new(&code::DXF_UNREAD, message).at(of_kind[0].span);
        out.push(finding.hint("nothing there is cut"));
    }
}

/// How much stands on the sheet around the drawing.
pub(super) fn say_on_paper(on_paper: Option<(usize, Span)>, out: &mut Diagnostics) {
    if let Some((count, span)) = on_paper {
        let message = if count == 1 { "1 entity is".to_owned() } else { format!("{count} entities are") };
        let finding = Diagnostic::new(&code::DXF_ON_PAPER, format!("{message} in paper space and not cut")).at(span);
        out.push(finding.hint("what is cut must be drawn in model space"));
    }
}

/// How much is cut that nobody sees in the drawing.
pub(super) fn say_hidden(hidden: Option<(usize, Span)>, out: &mut Diagnostics) {
    if let Some((count, span)) = hidden {
        let message = if count == 1 { "1 entity is".to_owned() } else { format!("{count} entities are") };
        let message = format!("{message} hidden in the drawing, on layers that are cut; they are cut all the same");
        out.push(
            Diagnostic::new(&code::DXF_HIDDEN, message).at(span).hint("show all layers in the CAD system and look"),
        );
    }
}

/// A text that says what must be known, and is not read.
pub(super) fn say_text(unread: Option<Span>, out: &mut Diagnostics) {
    if let Some(span) = unread {
        let message = "a text that may say a size, a quantity or the unit is long, or has codes amid it";
        out.push(Diagnostic::new(&code::DXF_TEXT, message).at(span).hint("write it as a TEXT of its own"));
    }
}
