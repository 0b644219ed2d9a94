//! Pieces with their names and figures for the page.

use std::fmt;

use super::record::{Record, Sums};
use crate::back::target::{Context, Outcome};
use crate::diagnostic::{Diagnostic, PieceName};
use crate::geom::{Extent, Point};
use crate::ir::marker::{self, NotchKind};
use crate::source::Span;

/// Keys with which labels of pattern systems give the name of a piece, and its size.
const NAMES: [&str; 3] = ["piece name", "piece", "name"];
const SIZES: [&str; 1] = ["size"];

/// A piece on the page.
#[derive(Debug)]
pub(super) struct Piece {
    /// Index of the piece to which it belongs: its own, except for an early section of a piece that windows of a conveyor
    /// split.
    pub(super) whole: usize,
    /// Its number in the file and its copy.
    key: [u32; 2],
    /// Number in the file, with its copy if there are several.
    pub(super) number: String,
    /// Name from its labels; empty when it has none.
    pub(super) name: String,
    /// Size from its labels; empty when it has none.
    pub(super) size: String,
    /// All texts of the piece, joined.
    pub(super) texts: String,
    /// Counts of notches by kind, and of holes; of a split piece with its last section.
    pub(super) marks: Marks,
    /// Length of its cuts, mm.
    pub(super) cut: f64,
    /// Its time and path lengths.
    pub(super) sums: Sums,
    /// Messages that name it, by their index.
    pub(super) messages: Vec<usize>,
    /// Index of its conveyor window, from 0; `None` where the cloth does not advance.
    pub(super) window: Option<usize>,
    /// Bounding box of its lines.
    pub(super) extent: Extent,
}

/// Counts of notches by kind, and of holes.
#[derive(Debug, Default)]
pub(super) struct Marks(Vec<(&'static str, usize)>);

/// All pieces and sections, in cut order.
pub(super) fn pieces(context: &Context, record: &Record, outcome: Outcome) -> Vec<Piece> {
    let stations = context.marker.stations();
    let mut windows = stations.clone();
    windows.dedup();
    let is_moved = stations.iter().any(|&station| station > 0);
    let (wholes, owners) = (context.marker.wholes(), context.marker.owners());
    let mut wholes = wholes.iter();
    let pieces = (0..).zip(&context.marker.pieces).zip(&stations);
    let piece = |((part, piece), station): ((u32, &marker::Piece), &u32)| {
        let texts = texts(context, piece);
        let is_about = |&message: &usize| is_about(outcome.messages[message], piece);
        let whole = if owners[part as usize] == part as usize { wholes.next() } else { None };
        Piece {
            whole: owners[part as usize],
            key: [piece.number, piece.copy],
            number: piece.name(),
            name: told(&texts, &NAMES).or_else(|| plain(&texts)).unwrap_or_default(),
            size: told(&texts, &SIZES).or_else(|| texts.iter().find(|text| is_size(text)).cloned()).unwrap_or_default(),
            texts: texts.join(" · "),
            marks: whole.map(Marks::of).unwrap_or_default(),
            cut: context.marker.cut_length_of(part),
            sums: record.pieces[part as usize],
            messages: (0..outcome.messages.len()).filter(is_about).collect(),
            window: windows.iter().position(|window| window == station).filter(|_| is_moved),
            extent: whole.map_or(Extent::EMPTY, |whole| extent(context, whole)),
        }
    };
    let mut pieces: Vec<Piece> = pieces.map(piece).collect();
    // The labels of a split piece are those of its last section: all have its name.
    for section in 0..pieces.len() {
        let name = pieces[pieces[section].whole].name.clone();
        pieces[section].name = name;
    }
    pieces
}

impl Piece {
    /// Name on the page, as in `piece 3 "Front"`.
    pub(super) fn title(&self) -> String {
        let Self { number, name, .. } = self;
        if name.is_empty() { format!("piece {number}") } else { format!("piece {number} \"{name}\"") }
    }

    /// True if a message that names a piece means this one.
    pub(super) fn is_called(&self, name: &PieceName) -> bool {
        self.key == [name.number, name.copy]
    }
}

/// True if a message names a piece.
fn is_about(message: &Diagnostic, piece: &marker::Piece) -> bool {
    let is_named = |name: &PieceName| name.number == piece.number && name.copy == piece.copy;
    message.piece.as_deref().is_some_and(is_named) || message.pieces.contains(&piece.number)
}

/// The non-empty texts of a piece.
fn texts(context: &Context, piece: &marker::Piece) -> Vec<String> {
    let letters = context.marker.letters(&context.job.profile.labels);
    let text = |span: Span| letters.text(context.source.slice(span)).trim().to_owned();
    let labels = piece.labels.iter().map(|label| text(label.span));
    let fields = piece.fields.iter().map(|field| format!("{}: {}", char::from(field.letter), text(field.span)));
    labels.chain(fields).filter(|text| !text.is_empty()).collect()
}

/// The value of the first text with one of the keys, as in `Size: M`.
fn told(texts: &[String], keys: &[&str]) -> Option<String> {
    let value = |text: &String| {
        let (key, value) = text.split_once(':')?;
        let is_key = keys.iter().any(|known| key.trim().eq_ignore_ascii_case(known));
        (is_key && !value.trim().is_empty()).then(|| value.trim().to_owned())
    };
    texts.iter().find_map(value)
}

/// The first text that is neither a key with its value nor a size.
fn plain(texts: &[String]) -> Option<String> {
    texts.iter().find(|text| !text.contains(": ") && !is_size(text)).cloned()
}

/// True if a text is a size in letters, as in `M` or `2XL`.
fn is_size(text: &str) -> bool {
    let letters = text.trim_start_matches(|c: char| c.is_ascii_digit());
    let stem = letters.trim_start_matches('X');
    matches!(stem, "S" | "L") || (stem == "M" && stem.len() == text.len())
}

impl Marks {
    fn of(piece: &marker::Piece) -> Self {
        let of_piece = piece.notches.iter().map(|notch| match notch.kind {
            NotchKind::Slit => "slit",
            NotchKind::T(_) => "t",
        });
        let drills = piece.drills.iter().map(|_| "drill");
        let outline = piece.outline_notches.iter().map(marker::OutlineNotch::word);
        let mut marks = Self::default();
        of_piece.chain(outline).chain(drills).for_each(|word| marks.add(word, 1));
        marks
    }

    /// Counts over several pieces.
    pub(super) fn all<'a>(pieces: impl Iterator<Item = &'a Self>) -> Self {
        let mut all = Self::default();
        pieces.flat_map(|marks| &marks.0).for_each(|&(word, count)| all.add(word, count));
        all
    }

    fn add(&mut self, word: &'static str, more: usize) {
        match self.0.iter_mut().find(|(known, _)| *known == word) {
            Some((_, count)) => *count += more,
            None => self.0.push((word, more)),
        }
    }

    /// Number of all of them.
    pub(super) fn total(&self) -> usize {
        self.0.iter().map(|(_, count)| count).sum()
    }
}

impl fmt::Display for Marks {
    /// Text as in `6: 2 slit, 1 v, 3 drill`; one kind needs no total.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let said: Vec<String> = self.0.iter().map(|(word, count)| format!("{count} {word}")).collect();
        if said.len() > 1 {
            write!(f, "{}: ", self.total())?;
        }
        f.write_str(&said.join(", "))
    }
}

fn extent(context: &Context, piece: &marker::Piece) -> Extent {
    let contours = piece.contours.iter().flat_map(|contour| context.marker.points(contour));
    let notches = piece.notches.iter().flat_map(|notch| [notch.root, notch.tip]);
    let points: Vec<Point> = contours.chain(notches).chain(piece.drills.iter().map(|drill| drill.at)).collect();
    Extent::of(&points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_sizes_are_read_off_labels() {
        let texts = ["Style: A", "SIZE: 42", "piece name: Front : left", "FRONT"].map(str::to_owned);
        assert_eq!(told(&texts, &NAMES).as_deref(), Some("Front : left"));
        assert_eq!(told(&texts, &SIZES).as_deref(), Some("42"));
        assert_eq!(plain(&texts).as_deref(), Some("FRONT"));
        assert_eq!(told(&texts, &["colour"]), None);
        for (text, expected) in [("M", true), ("XXS", true), ("3XL", true), ("S4", false), ("XM", false), ("12", false)]
        {
            assert_eq!(is_size(text), expected, "{text}");
        }
    }

    #[test]
    fn marks_of_several_kinds_have_a_total() {
        let marks = Marks(vec![("slit", 2), ("v", 1)]);
        assert_eq!((marks.total(), marks.to_string()), (3, "3: 2 slit, 1 v".to_owned()));
        assert_eq!(Marks(vec![("drill", 4)]).to_string(), "4 drill");
        assert_eq!((Marks::default().total(), Marks::default().to_string()), (0, String::new()));
    }
}
