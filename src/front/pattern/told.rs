//! Messages on unsupported entities, entities in paper space, and hidden entities.

use std::collections::{BTreeMap, BTreeSet};

use super::choice::Asked;
use super::curves::{CurveCount, CurveCounts, Drafting};
use super::layer::{Names, is_unknown};
use super::piece::Piece;
use super::shape::Unread;
use crate::diagnostic::{Diagnostic, Diagnostics, PieceName, code};
use crate::front::dxf::entity::{Block, Entity};
use crate::source::Span;

/// Kinds of lines.
const LINES: [&str; 5] = ["LINE", "POLYLINE", "LWPOLYLINE", "ARC", "CIRCLE"];

/// Maximum total length of names in a message, bytes.
const SHOWN: usize = 50;

/// Reports the number of pieces with curves from fine lines or by a rule, and the distance of the curves from the chords of
/// layer 1.
pub(super) fn say_curves(curved: &CurveCounts, drafting: &Drafting, out: &mut Diagnostics) {
    if drafting.is_overfull() {
        let message = "the curves through the curve points (layer 3) have more places than a set of patterns can need";
        let finding = Diagnostic::new(&code::DXF_CURVES, message);
        out.push(finding.hint("look for a damaged coordinate; `dxf.curves=points` lays no curves"));
        return;
    }
    let pieces =
        |from: &CurveCount| if from.pieces == 1 { "1 piece".to_owned() } else { format!("{} pieces", from.pieces) };
    let off = |from: &CurveCount| format!("up to {:.1} mm off the chords", from.off);
    let CurveCounts { fine, laid, missed, chords, stray } = curved;
    let compare = "compare a neck and an armhole in the picture (`-t svg`) with the CAD system";
    if missed.pieces > 0 {
        let along = match chords.pieces {
            0 => "",
            count if count == missed.pieces => ", cut along the chords of layer 1",
            _ => ", some cut along the chords of layer 1",
        };
        let message = format!("a line of {} misses vertices and is not used: {}{along}", missed.layers, pieces(missed));
        out.push(Diagnostic::new(&code::DXF_CURVE_MISSED, message).at(missed.first).hint(compare));
    }
    if stray.pieces > 0 {
        let message =
            format!("curve points (layer 3) mark no vertex of a line, so that chords are cut there: {}", pieces(stray));
        out.push(Diagnostic::new(&code::DXF_CURVE_MISSED, message).at(stray.first).hint(compare));
    }
    if fine.pieces > 0 {
        let message = format!("cut along the curves of {}: {}, {}", fine.layers, pieces(fine), off(fine));
        let finding = Diagnostic::new(&code::DXF_CURVED, message).at(fine.first);
        out.push(finding.hint("the file draws them so; `dxf.curves=points` cuts along the chords"));
    }
    if laid.pieces > 0 {
        let (pieces, off) = (pieces(laid), off(laid));
        let (code, message, hint) = match drafting.system {
            Some(system) => (
                &code::DXF_CURVED,
                format!("cut along curves as {system} lays them: {pieces}, {off}"),
                "its curve points (layer 3) tell them; `dxf.curves=points` cuts along the chords",
            ),
            None => (
                &code::DXF_CURVE_GUESSED,
                format!("cut along guessed curves: {pieces}, {off}"),
                "its AUTHOR names no rule that is known: compare a neck and an armhole, or export layer 84",
            ),
        };
        out.push(Diagnostic::new(code, message).at(laid.first).hint(hint));
    }
}

/// Reports the reasons why a piece cannot be cut, with a hint on cutting without it.
pub(super) fn say_at_fault(piece: &Piece, number: u32, hint: Option<&str>, asked: &Asked, out: &mut Diagnostics) {
    let text = |span: Span| asked.letters.text(asked.source.slice(span));
    let label = piece.labels.first().map(|label| text(label.span));
    let name = PieceName { number, copy: 0, label };
    for fault in &piece.faults {
        let finding = Diagnostic { piece: Some(Box::new(name.clone())), ..fault.clone() };
        out.push(hint.iter().fold(finding, |finding, hint| finding.hint(*hint)));
    }
}

/// Lists names, up to the length of a message.
fn listed(names: impl Iterator<Item = String>) -> String {
    let mut shown = String::new();
    for name in names {
        let comma = if shown.is_empty() { "" } else { ", " };
        if shown.len() + name.len() > SHOWN {
            shown.push_str(comma);
            shown.push_str("...");
            break;
        }
        shown.push_str(comma);
        shown.push_str(&name);
    }
    shown
}

/// The finding that a file is a plain drawing on these layers.
pub(super) fn plain(names: &Names) -> Diagnostic {
    let names: Vec<&String> = names.all().iter().filter(|name| !name.is_empty()).collect();
    let word = if names.len() == 1 { "layer" } else { "layers" };
    let shown = listed(names.into_iter().cloned());
    let message = "the file is a plain DXF drawing, not pattern DXF (AAMA, ASTM)";
    let finding = Diagnostic::new(&code::DXF_PLAIN, message).hint(format!("its lines are on {word} {shown}"));
    finding.hint("leave `--from pattern` out: then it is cut as a drawing, whose layers are tools")
}

/// Reports pieces without any cut; `names` are the texts with their names.
pub(super) fn say_uncut(names: &[Span], asked: &Asked, out: &mut Diagnostics) {
    let Some(first) = names.first() else { return };
    let text = |span: &Span| asked.letters.name(asked.source.slice(*span));
    let message = match names.len() {
        1 => "a piece has no outline on layer 1; nothing of it is cut".to_owned(),
        count => format!("{count} pieces have no outline on layer 1; nothing of them is cut"),
    };
    let finding = Diagnostic::new(&code::DXF_NO_OUTLINE, message).at(*first);
    let named = if names.len() == 1 { "its name is" } else { "their names are" };
    let finding = finding.hint(format!("{named} {}", listed(names.iter().map(text))));
    out.push(finding.hint("let the CAD system export each outline on layer 1"));
}

/// Reports the kinds of unsupported entities and their layers.
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

/// Reports points of pieces on layers that the convention does not have, and whatever is on no layer: it may be a notch.
fn say_strange(blocks: &[Block], asked: &Asked, out: &mut Diagnostics) {
    let is_strange = |entity: &&Entity| {
        let is_nowhere = || entity.layer_bytes().is_empty() && LINES.iter().any(|kind| entity.is(kind));
        entity.is("POINT") && is_unknown(entity.layer()) || is_nowhere()
    };
    let strange: Vec<&Entity> = blocks.iter().flat_map(|block| &block.entities).filter(is_strange).collect();
    let Some(first) = strange.first() else { return };
    let message = match strange.len() {
        1 => "1 line or point of a piece is on no layer of the convention, and not cut".to_owned(),
        count => format!("{count} lines and points of pieces are on no layer of the convention, and not cut"),
    };
    let names: BTreeSet<String> = strange.iter().map(|entity| entity.layer_name(&asked.letters)).collect();
    let name = |name: String| if name.is_empty() { "none is named".to_owned() } else { name };
    let finding = Diagnostic::new(&code::DXF_OTHER_LAYERS, message).at(first.span());
    out.push(finding.hint(format!("their layers: {}", listed(names.into_iter().map(name)))));
}

/// Warns of entities in paper space, of hidden cuts, and of lines and points of blocks on no known layer.
pub(super) fn say_unseen(
    [on_paper, hidden]: [Option<(usize, Span)>; 2],
    blocks: &[Block],
    asked: &Asked,
    out: &mut Diagnostics,
) {
    say_strange(blocks, asked, out);
    say_on_paper(on_paper, out);
    say_hidden(hidden, out);
}

/// Warns of entities in paper space.
fn say_on_paper(on_paper: Option<(usize, Span)>, out: &mut Diagnostics) {
    if let Some((count, span)) = on_paper {
        let message = if count == 1 { "1 entity is".to_owned() } else { format!("{count} entities are") };
        let finding = Diagnostic::new(&code::DXF_ON_PAPER, format!("{message} in paper space and not cut")).at(span);
        out.push(finding.hint("what is cut must be drawn in model space"));
    }
}

/// Reports the number of hidden cuts.
fn say_hidden(hidden: Option<(usize, Span)>, out: &mut Diagnostics) {
    if let Some((count, span)) = hidden {
        let message = if count == 1 { "1 entity is".to_owned() } else { format!("{count} entities are") };
        let message = format!("{message} hidden in the drawing, on layers that are cut; they are cut all the same");
        out.push(
            Diagnostic::new(&code::DXF_HIDDEN, message).at(span).hint("show all layers in the CAD system and look"),
        );
    }
}

/// Reports a text that gives a required fact but is unreadable.
pub(super) fn say_text(unread: Option<Span>, out: &mut Diagnostics) {
    if let Some(span) = unread {
        let message = "a text that may say a size, a quantity or the unit is long, or has codes amid it";
        out.push(Diagnostic::new(&code::DXF_TEXT, message).at(span).hint("write it as a TEXT of its own"));
    }
}
