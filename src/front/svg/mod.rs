//! SVG drawings, as saved by Inkscape, Illustrator, `CorelDRAW`, Affinity and programs for sewing patterns.
//!
//! Receives XML. Promises a drawing in mm with y upwards: strokes with the names of their layers, groups or colours, and texts.
//! All transforms, copies and view boxes are resolved; curves are chords within a quarter of the tolerance and 0.02 mm; a
//! subpath that returns to its start ends exactly there. Never decides what is cut.
//!
//! [`mod@letters`] decodes the bytes, [`mod@page`] gives the size, [`walk`] traverses the elements with the [`scene`] of each,
//! which depends on [`style`] sheets and attributes. [`draw`] makes steps from [`mod@path`] and [`mod@shape`], which the
//! [`pencil`] draws, with chords for each [`curve`]. [`scan`] parses numbers; [`tally`] counts elements that are not cut.

mod curve;
mod draw;
mod length;
mod letters;
mod page;
mod path;
mod pencil;
mod scan;
mod scene;
mod shape;
mod style;
mod tally;
mod transform;
mod viewport;
mod walk;
mod words;

use roxmltree::{Document, Error, Node, ParsingOptions};

use self::letters::Letters;
use self::page::Page;
use self::walk::Walk;
use super::{Dialect, Likeness, Read, foreign};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::ir::Drawing;
use crate::machine::Job;
use crate::source::{Source, Span};

pub(super) const DIALECT: Dialect = Dialect {
    name: "svg",
    about: "SVG drawing at its true size; outermost closed lines are cut",
    extensions: &["svg"],
    sniff,
    syntax: check_syntax,
    read: Read::Drawing(read),
    words: words::WORDS,
};

/// Maximum deviation of chords from their curve: as a fraction of the tolerance, and in mm.
const SAGITTA: f64 = 0.25;
const MOST_SAGITTA: f64 = 0.02;
/// Maximum number of XML nodes of a file.
const MOST_NODES: u32 = 20_000_000;
const SVG: &str = "http://www.w3.org/2000/svg";

fn sniff(bytes: &[u8]) -> Likeness {
    if foreign::is_svg(bytes) { Likeness::Sure } else { Likeness::No }
}

/// Checks that the bytes are XML.
fn check_syntax(source: &Source, out: &mut Diagnostics) {
    match Letters::of(source) {
        Err(fault) => out.push(fault),
        Ok(letters) => {
            if let Err(fault) = Document::parse_with_options(&letters.text, options()) {
                out.push(not_xml(&fault, &letters));
            }
        }
    }
}

fn options<'a>() -> ParsingOptions<'a> {
    ParsingOptions { allow_dtd: true, nodes_limit: MOST_NODES, ..ParsingOptions::default() }
}

fn read(source: &Source, job: &Job, out: &mut Diagnostics) -> Drawing {
    read_xml(source, job, out).unwrap_or_else(|fault| {
        out.push(fault);
        Drawing::default()
    })
}

fn read_xml(source: &Source, job: &Job, out: &mut Diagnostics) -> Result<Drawing, Diagnostic> {
    let letters = Letters::of(source)?;
    let document = Document::parse_with_options(&letters.text, options()).map_err(|fault| not_xml(&fault, &letters))?;
    let root = document.root_element();
    let named = root.tag_name();
    if named.name() != "svg" || named.namespace().is_some_and(|namespace| namespace != SVG) {
        let message = format!("the file begins with the element `{}`, not with `svg`", shown(named.name()));
        return Err(Diagnostic::new(&code::SVG_NOT_XML, message).hint("let the program that drew it save it as SVG"));
    }
    if is_own_picture(root) {
        let message = "this is a picture that cutc made of a marker";
        return Err(Diagnostic::new(&code::SVG_OWN_PICTURE, message).hint("compile the marker itself"));
    }
    let page = Page::of(&document).map_err(|(name, what)| {
        let span = root.attribute_node(name).map(|attribute| letters.span(attribute.range_value(), 1));
        let finding = Diagnostic::new(&code::SVG_VALUE, format!("`{name}` of the page: {what}"));
        let finding = finding.hint("set the size of the page in the program that drew it, and save it again");
        span.map_or(finding.clone(), |span| finding.at(span))
    })?;
    let sagitta = (job.profile.tolerance(0.0) * SAGITTA).min(MOST_SAGITTA);
    let drawing = Walk::new(&document, &letters, page, sagitta, out).run(root);
    if !out.has_errors() {
        page.check_size(&drawing.extent(), out);
    }
    Ok(drawing)
}

/// True for a picture made by cutc, recognised by its root and style sheet.
fn is_own_picture(root: Node) -> bool {
    let mut sheets = root.children().filter(|node| node.has_tag_name((SVG, "style"))).filter_map(|node| node.text());
    root.attribute("id") == Some("marker") && sheets.any(|sheet| sheet.contains(".doubt-sign{"))
}

/// A name, shortened for a message.
fn shown(name: &str) -> String {
    name.chars().take(40).collect()
}

/// The finding on an XML error, with its location.
fn not_xml(fault: &Error, letters: &Letters) -> Diagnostic {
    let span = || {
        let at = fault.pos();
        let mut lines = letters.text.split_inclusive('\n');
        let before: usize = lines.by_ref().take(at.row.saturating_sub(1) as usize).map(str::len).sum();
        let line = lines.next().unwrap_or_default();
        let column = line.char_indices().nth(at.col.saturating_sub(1) as usize).map_or(line.len(), |(place, _)| place);
        Span { start: letters.byte(before + column), end: letters.byte(before + column) + 1, block: 0 }
    };
    match fault {
        Error::EntityReferenceLoop(_) => {
            let message = "entities of the file stand for each other again and again";
            let finding = Diagnostic::new(&code::SVG_ENTITIES, message).at(span());
            finding.hint("no program for drawings writes such a file: ask where it came from")
        }
        Error::NodesLimitReached => {
            let message = format!("the file has more than {MOST_NODES} nodes");
            Diagnostic::new(&code::SVG_TOO_MUCH, message).hint("divide the drawing into several files")
        }
        Error::UnexpectedEndOfStream | Error::UnclosedRootNode | Error::NoRootNode => {
            let message = "the file ends before its elements do";
            let finding = Diagnostic::new(&code::SVG_NOT_XML, message);
            finding.hint("it was cut short: copy it again, and compare the sizes")
        }
        fault => {
            let text = fault.to_string();
            // The location is reported beside the message.
            let text = text.rsplit_once(" at ").map_or(text.as_str(), |(text, _)| text);
            let finding = Diagnostic::new(&code::SVG_NOT_XML, format!("the file is no XML: {}", shown_fault(text)));
            finding.at(span()).hint("the file was damaged or cut short: save the drawing again")
        }
    }
}

/// The message of a library, as a single line.
fn shown_fault(text: &str) -> String {
    text.chars().take(120).map(|c| if c.is_control() { ' ' } else { c }).collect()
}
