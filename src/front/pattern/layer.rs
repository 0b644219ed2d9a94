//! The layers of the convention (AAMA DXF, ASTM D6673) and their functions.

use std::collections::BTreeMap;
use std::ops::Deref;

/// Function of a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Does {
    /// Outlines of pieces.
    Outline,
    /// Notch points on outlines.
    Notch(Form),
    /// Axis at which a half piece is mirrored.
    Fold,
    /// Lines that are cut inside pieces.
    Inner,
    /// Points of drilled holes.
    Drill,
    /// Lines that are drawn on pieces, on both halves of a mirrored one.
    Drawn,
    /// Seam lines, drawn as [`Does::Drawn`].
    Seam,
    /// Lines that are drawn once, without mirroring.
    Sign,
    /// Points at corners of lines.
    Turn,
    /// Points on curves.
    Curve,
    /// Curves of another layer in small chords.
    Fine,
}

/// Form of a notch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// A slit if it has no width, otherwise a V.
    Plain,
    T,
    Castle,
    /// A V with one perpendicular leg, which is cut as a symmetric V.
    Check,
    U,
}

/// An entry of the table.
#[derive(Debug)]
pub(super) struct Layer {
    pub(super) number: u16,
    /// Name of its lines.
    pub(super) name: &'static str,
    /// Description of how its lines are recognised.
    pub(super) about: &'static str,
    pub(super) does: Does,
}

/// A layer of a file: its function and its name.
#[derive(Debug, Clone, Copy)]
pub(super) struct Named {
    pub(super) row: &'static Layer,
    /// Index of its name in [`Names`].
    pub(super) place: u16,
}

impl Deref for Named {
    type Target = Layer;

    fn deref(&self) -> &Layer {
        self.row
    }
}

/// The layer names of a file: the numbers of the convention, otherwise the names in the file.
#[derive(Debug, Clone, Default)]
pub(super) struct Names {
    places: BTreeMap<String, u16>,
    names: Vec<String>,
}

impl Names {
    /// The layer of a number, or of the name in the file. Names beyond the maximum number of pens are lost.
    pub(super) fn layer(&mut self, number: Option<u16>, written: impl FnOnce() -> String) -> Named {
        let row = layer(number);
        let name = if row.number == OTHER.number { written() } else { row.number.to_string() };
        let next = u16::try_from(self.names.len()).unwrap_or(u16::MAX);
        let place = *self.places.entry(name).or_insert_with_key(|name| {
            self.names.push(name.clone());
            next
        });
        Named { row, place }
    }

    /// All names.
    pub(super) fn all(&self) -> &[String] {
        &self.names
    }

    /// Name of a layer.
    pub(super) fn of(&self, layer: Named) -> &str {
        self.names.get(usize::from(layer.place)).map_or("", String::as_str)
    }
}

/// Number of the seam line layer.
const SEAM: u16 = 14;
/// Name of the seam line layer as a pen.
pub(super) const SEAMS: &str = "14";

/// The layers of the convention.
#[rustfmt::skip] // a table: one row per layer
pub(super) const LAYERS: [Layer; 20] = [
    Layer { number: 1, name: "outline", about: "layer 1", does: Does::Outline },
    Layer { number: 2, name: "turn point", about: "layer 2", does: Does::Turn },
    Layer { number: 3, name: "curve point", about: "layer 3", does: Does::Curve },
    Layer { number: 4, name: "notch", about: "layer 4", does: Does::Notch(Form::Plain) },
    Layer { number: 5, name: "grade reference", about: "layer 5", does: Does::Sign },
    Layer { number: 6, name: "fold line", about: "layer 6", does: Does::Fold },
    Layer { number: 7, name: "grain line", about: "layer 7", does: Does::Sign },
    Layer { number: 8, name: "internal line", about: "layer 8", does: Does::Drawn },
    Layer { number: 11, name: "cut-out", about: "layer 11", does: Does::Inner },
    Layer { number: 13, name: "drill hole", about: "layer 13", does: Does::Drill },
    Layer { number: SEAM, name: "seam line", about: "layer 14", does: Does::Seam },
    Layer { number: 15, name: "annotation", about: "layer 15", does: Does::Sign },
    Layer { number: 80, name: "T notch", about: "layer 80", does: Does::Notch(Form::T) },
    Layer { number: 81, name: "castle notch", about: "layer 81", does: Does::Notch(Form::Castle) },
    Layer { number: 82, name: "check notch", about: "layer 82", does: Does::Notch(Form::Check) },
    Layer { number: 83, name: "U notch", about: "layer 83", does: Does::Notch(Form::U) },
    Layer { number: 84, name: "curve of an outline", about: "layer 84", does: Does::Fine },
    Layer { number: 85, name: "curve of an internal line", about: "layer 85", does: Does::Fine },
    Layer { number: 86, name: "curve of a cut-out", about: "layer 86", does: Does::Fine },
    Layer { number: 87, name: "curve of a seam line", about: "layer 87", does: Does::Fine },
];

/// The layers of outlines and of cut-outs.
pub(super) const OUTLINE: &Layer = &LAYERS[0];
pub(super) const CUT_OUT: &Layer = &LAYERS[8];

/// Layers of the convention for lines of the fabric, which nothing is made of, and one that it leaves free.
const FREE: [u16; 3] = [9, 10, 12];

/// True if the convention has no such layer, or an entity names none.
pub(super) fn is_unknown(number: Option<u16>) -> bool {
    layer(number).number == OTHER.number && number.is_none_or(|number| !FREE.contains(&number))
}

/// Entry for any other layer.
pub(super) const OTHER: Layer =
    Layer { number: 0, name: "line of another layer", about: "any other layer", does: Does::Sign };

/// The layer with a number; [`OTHER`] if the convention has none.
pub(super) fn layer(number: Option<u16>) -> &'static Layer {
    LAYERS.iter().find(|layer| Some(layer.number) == number).unwrap_or(&OTHER)
}

impl Layer {
    /// True if unread content on the layer would make the cut wrong.
    pub(super) fn is_cut(&self) -> bool {
        match self.does {
            Does::Outline | Does::Notch(_) | Does::Fold | Does::Inner | Does::Drill => true,
            Does::Drawn | Does::Seam | Does::Sign | Does::Turn | Does::Curve | Does::Fine => false,
        }
    }

    /// True if damaged content on the layer would change the shape of a cut.
    pub(super) fn shapes_cuts(&self) -> bool {
        self.is_cut() || matches!(self.does, Does::Turn | Does::Curve | Does::Fine)
    }

    /// True if its lines may have curves between their vertices.
    pub(super) fn is_curved(&self) -> bool {
        self.fine().is_some()
    }

    /// True if its lines are the curves of another layer.
    pub(super) fn is_fine(&self) -> bool {
        self.does == Does::Fine
    }

    /// The layer that usually has its curves in small chords.
    pub(super) fn fine(&self) -> Option<u16> {
        match self.does {
            Does::Outline => Some(84),
            Does::Drawn => Some(85),
            Does::Inner => Some(86),
            Does::Seam => Some(87),
            Does::Notch(_) | Does::Fold | Does::Drill | Does::Sign | Does::Turn | Does::Curve | Does::Fine => None,
        }
    }
}
