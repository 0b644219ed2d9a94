//! Messages about layers: uses implied by their names, and options that have no effect on them.

use super::pens;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::ir::drawing::{Drawing, LayerLines, Pen};
use crate::machine::Job;
use crate::machine::layers::Known;
use crate::machine::plot::PenUse;

/// Word for the use of a layer without a known one.
const BY_SHAPE: &str = "by shape";

/// Greatest number of layers that a message names.
const SHOWN: usize = 8;

/// Reports the layers that are cut by their names, and refuses options without effect on a drawing with these pens.
pub(super) fn say(pens: &[Pen], job: &Job, out: &mut Diagnostics) {
    let names: Vec<&str> = pens.iter().filter(|pen| pen.is_layer).map(|pen| pen.name.as_str()).collect();
    if let Some(refusal) = misplaced(&names, job) {
        out.push(refusal);
        return;
    }
    let uses = pens::of_layers(pens, job);
    let of = |is: &dyn Fn(PenUse, Known) -> bool| {
        let found = names.iter().zip(&uses).filter(|(_, used)| used.is_some_and(|(used, known)| is(used, known)));
        found.map(|(name, _)| *name).collect::<Vec<&str>>()
    };
    let cut = of(&|used, known| used == PenUse::Knife && known == Known::Named);
    let uncut = of(&|used, known| used != PenUse::Knife && known == Known::Named);
    let beside = of(&|_, known| known == Known::Beside);
    if cut.is_empty() && uncut.is_empty() && beside.is_empty() {
        return;
    }
    let mut said = Vec::new();
    said.extend((!cut.is_empty()).then(|| format!("{} cut by name", listed(&cut))));
    said.extend((!uncut.is_empty()).then(|| format!("{} not cut by name", listed(&uncut))));
    said.extend((!beside.is_empty()).then(|| format!("{} not cut, since others are the knife", listed(&beside))));
    let message = format!("layers: {}", said.join("; "));
    let finding = Diagnostic::new(&code::DRAWING_LAYERS, message);
    out.push(finding.hint("say otherwise with `--layers CUT,FOLD=pen,TEXT=ignore`; `cutc info` lists the layers"));
}

/// Layers of a drawing, with their lines.
pub(super) fn drawn(drawing: &Drawing, job: &Job) -> Vec<LayerLines> {
    let mut uses = pens::of_layers(&drawing.pens, job).into_iter();
    let word = |used: PenUse| match used {
        PenUse::Knife => "knife",
        PenUse::Pen => "pen",
        PenUse::Ignore => "ignored",
    };
    let mut layers: Vec<Option<LayerLines>> = Vec::new();
    for pen in &drawing.pens {
        layers.push(pen.is_layer.then(|| LayerLines {
            name: pen.name.clone(),
            used: uses.next().flatten().map_or(BY_SHAPE, |(used, _)| word(used)),
            count: 0,
            length: 0.0,
        }));
    }
    for stroke in &drawing.strokes {
        if let Some(Some(layer)) = layers.get_mut(usize::from(stroke.pen)) {
            let places = drawing.vertices[stroke.range()].windows(2);
            layer.count += 1;
            layer.length += places.map(|pair| (pair[1].at - pair[0].at).norm()).sum::<f64>();
        }
    }
    layers.into_iter().flatten().collect()
}

/// Error if options for pens were given for a drawing with layers, or options for layers that it does not have.
fn misplaced(names: &[&str], job: &Job) -> Option<Diagnostic> {
    let error = |message: String, hint: String| Some(Diagnostic::new(&code::DRAWING_NO_LAYER, message).hint(hint));
    if let Some(typed) = &job.lines.layers {
        if names.is_empty() {
            let hint = "`--cut-pens` chooses pens; `cutc info` shows what lines were taken for".to_owned();
            return error("`--layers` chooses layers of a drawing, and this plot has pens".to_owned(), hint);
        }
        let unused = typed.unused(names);
        if !unused.is_empty() {
            let message = format!("`--layers` names {}, and no layer of the drawing is called so", quoted(&unused));
            return error(message, format!("its layers are {}", quoted(names)));
        }
    }
    if job.lines.pens.is_some() && !names.is_empty() {
        let message = "`--cut-pens` chooses pens of a plot, and this drawing has layers".to_owned();
        return error(message, format!("`--layers` chooses among them: {}", quoted(names)));
    }
    None
}

/// Names as the subject of a sentence.
fn listed(names: &[&str]) -> String {
    format!("{} {}", quoted(names), if names.len() == 1 { "is" } else { "are" })
}

/// Names in quotes, as many as fit in a message.
fn quoted(names: &[&str]) -> String {
    let quoted = |name: &&str| if name.is_empty() { "one without a name".to_owned() } else { format!("`{name}`") };
    let shown: Vec<String> = names.iter().take(SHOWN).map(quoted).collect();
    format!("{}{}", shown.join(", "), if names.len() > SHOWN { ", ..." } else { "" })
}
