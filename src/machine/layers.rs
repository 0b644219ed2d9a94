//! Layers of drawings: uses of their lines as given by a user, a profile or the name of a layer.

use std::collections::BTreeMap;
use std::fmt;

use fast_glob::glob_match;
use thiserror::Error;

use super::key::Family;
use super::pen::PenUse;

/// Words in names of layers in English, German, Dutch, French, Italian and Spanish, in capitals, with the uses that they imply.
/// The earlier row takes precedence.
#[rustfmt::skip] // a table: a row a use
const WORDS: [(PenUse, &[&str]); 3] = [
    (PenUse::Ignore, &["TEXT", "TEXTS", "TEXTE", "TEKST", "TESTO", "TEXTO", "LABEL", "LABELS", "NOTE", "NOTES", "DIM", "DIMS", "DIMENSION", "DIMENSIONS", "BEMASSUNG", "MAATVOERING", "COTE", "COTES", "COTATION", "QUOTE", "COTAS", "ANNOTATION", "ANNOTATIONS", "DEFPOINTS", "VIEWPORT", "FRAME", "RAHMEN", "KADER", "CADRE", "CORNICE", "MARCO", "TITLE", "SHEET", "HATCH"]),
    (PenUse::Pen, &["NOCUT", "PEN", "STIFT", "ZEICHNEN", "TEKENEN", "STYLO", "PENNA", "LAPIZ", "FOLD", "FALZ", "BRUCH", "VOUW", "PLI", "PIEGA", "DOBLEZ", "CREASE", "SCORE", "SEAM", "SEW", "STITCH", "STITCHING", "NAHT", "NAAD", "COUTURE", "CUCITURA", "COSTURA", "GRAIN", "GRAINLINE", "FADENLAUF", "DRAADRICHTING", "NOTCH", "NOTCHES", "KNIP", "KNIPS", "CRAN", "CRANS", "TACCA", "TACCHE", "PIQUETE", "PIQUETES", "DRILL", "BOHRUNG", "ENGRAVE"]),
    (PenUse::Knife, &["CUT", "CUTS", "CUTTING", "CUTLINE", "CUTLINES", "CUTOUT", "CUTOUTS", "BLADE", "OUTLINE", "OUTLINES", "CONTOUR", "CONTOURS", "KNIFE", "SCHNITT", "SCHNITTE", "SCHNITTLINIE", "SCHNITTLINIEN", "AUSSCHNITT", "AUSSCHNITTE", "SCHNEIDEN", "MESSER", "KONTUR", "KONTUREN", "AUSSENKONTUR", "INNENKONTUR", "UMRISS", "SNIJ", "SNIJDEN", "SNIJLIJN", "MES", "COUPE", "COUPES", "DECOUPE", "DECOUPES", "DÉCOUPE", "DÉCOUPES", "CONTORNO", "CONTORNI", "OMTREK", "TAGLIO", "LAMA", "CORTE", "CUCHILLA", "THROUGHCUT"]),
];

/// Words for a knife that name holes in parts. If no other layer is a knife, the parts are on layers without a known use.
const HOLES: [&str; 5] = ["CUTOUT", "CUTOUTS", "AUSSCHNITT", "AUSSCHNITTE", "INNENKONTUR"];

/// Words for a pen that name notches and holes.
const MARKS: [&str; 12] = [
    "NOTCH", "NOTCHES", "KNIP", "KNIPS", "CRAN", "CRANS", "TACCA", "TACCHE", "PIQUETE", "PIQUETES", "DRILL", "BOHRUNG",
];

/// Words that void a word for a knife in the same name: the line is not cut, not cut through, or a note about cuts.
#[rustfmt::skip] // a table
const VOIDING: [&str; 19] = [
    "NO", "NOT", "NON", "NICHT", "KEIN", "KEINE", "NIET", "GEEN", "PAS", "SANS", "SIN", "SENZA", "KISS", "HALF", "GUIDE",
    "NUMBER", "NUMBERS", "LIST", "AREA",
];

/// Family with one key per layer.
pub(super) const LAYERS: Family =
    Family { start: "drawing.layers", has: is_layer, pattern: || "[^.]+".to_owned(), example: "\"CUT*\" = \"knife\"" };

/// True if a word may be the name of a layer or a pattern of names: anything without a dot.
fn is_layer(word: &str) -> bool {
    !word.is_empty() && !word.contains('.')
}

/// Uses of layers as typed: `CUT,NOTCH=pen,TEXT*=ignore`.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct LayerUses(Vec<(String, PenUse)>);

/// Error of a text that does not name layers.
#[derive(Debug, Error, PartialEq, Eq)]
#[error("expected layers, as in `CUT,FOLD=pen`; `{0}` must be NAME, NAME=knife, NAME=pen or NAME=ignore")]
pub struct NotLayers(String);

impl LayerUses {
    /// Reads comma-separated names or patterns, each with an optional use after `=`; the default is a knife.
    pub fn parse(text: &str) -> Result<Self, NotLayers> {
        let one = |part: &str| {
            let (name, said) = part.split_once('=').unwrap_or((part, "knife"));
            let used = match said.trim() {
                "knife" => PenUse::Knife,
                "pen" => PenUse::Pen,
                "ignore" => PenUse::Ignore,
                _ => return Err(NotLayers(part.to_owned())),
            };
            let name = name.trim();
            if name.is_empty() { Err(NotLayers(part.to_owned())) } else { Ok((name.to_owned(), used)) }
        };
        text.split(',').map(one).collect::<Result<Vec<_>, _>>().map(Self)
    }

    /// Use of a layer in the first entry that matches it.
    fn of(&self, name: &str) -> Option<PenUse> {
        self.0.iter().find(|(pattern, _)| names(pattern, name)).map(|(_, used)| *used)
    }

    /// Names and patterns that match none of some layers.
    pub fn unused<'a>(&'a self, layers: &[&str]) -> Vec<&'a str> {
        let is_unused = |pattern: &&str| !layers.iter().any(|layer| names(pattern, layer));
        self.0.iter().map(|(pattern, _)| pattern.as_str()).filter(is_unused).collect()
    }
}

/// Text as typed.
impl fmt::Display for LayerUses {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = |used: PenUse| match used {
            PenUse::Knife => "",
            PenUse::Pen => "=pen",
            PenUse::Ignore => "=ignore",
        };
        let parts = self.0.iter().map(|(name, used)| format!("{name}{}", word(*used)));
        out.write_str(&parts.collect::<Vec<_>>().join(","))
    }
}

/// True if a name or a pattern matches a layer, regardless of case.
fn names(pattern: &str, layer: &str) -> bool {
    // A slash separates folders in patterns of files; here it is an ordinary character.
    let [pattern, layer] = [pattern, layer].map(|text| text.trim().to_lowercase().replace('/', "\u{1}"));
    pattern == layer || glob_match(&pattern, &layer)
}

/// Source of the use of a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Known {
    /// The user, in the profile or for this job.
    Said,
    /// A word of its name.
    Named,
    /// Other layers are knives, and this one has no known use: it is a pen.
    Beside,
}

/// Uses of the layers of a drawing, in their order; `None` if unknown, so that their shapes decide.
pub fn uses(
    layers: &[&str],
    typed: Option<&LayerUses>,
    of_profile: &BTreeMap<String, PenUse>,
) -> Vec<Option<(PenUse, Known)>> {
    let said = |name: &str| {
        // An exact name precedes a pattern, and a longer pattern a shorter one.
        let rank = |(pattern, _): &(&String, &PenUse)| (!pattern.contains(['*', '?', '[', '{']), pattern.len());
        let naming = || of_profile.iter().filter(|(pattern, _)| names(pattern, name));
        let of_profile = || naming().max_by_key(rank).map(|(_, used)| *used);
        typed.and_then(|typed| typed.of(name)).or_else(of_profile)
    };
    // If the user names a knife, words of names add no others.
    let has_knife = layers.iter().any(|name| said(name) == Some(PenUse::Knife));
    let found = |name: &&str| {
        let said = said(name).map(|used| (used, Known::Said));
        let named = || by_name(name).filter(|used| !(has_knife && *used == PenUse::Knife));
        said.or_else(|| named().map(|used| (used, Known::Named)))
    };
    let mut uses: Vec<Option<(PenUse, Known)>> = layers.iter().map(found).collect();
    let is_of_outlines = |(name, used): (&&str, &Option<(PenUse, Known)>)| match used {
        Some((PenUse::Knife, known)) => *known != Known::Named || !names_holes_alone(name),
        _ => false,
    };
    if layers.iter().zip(&uses).any(is_of_outlines) {
        for used in &mut uses {
            _ = used.get_or_insert((PenUse::Pen, Known::Beside));
        }
    }
    uses
}

/// Use implied by the words of a name.
fn by_name(name: &str) -> Option<PenUse> {
    let used = WORDS.iter().find(|(_, known)| has_word(name, known)).map(|(used, _)| *used);
    let is_void = has_word(name, &VOIDING);
    used.map(|used| if is_void && used == PenUse::Knife { PenUse::Pen } else { used })
}

/// True if all words for a knife in a name are words for holes.
fn names_holes_alone(name: &str) -> bool {
    let is_knife = |word: &str| WORDS.iter().any(|(used, known)| *used == PenUse::Knife && known.contains(&word));
    words(name).iter().filter(|word| is_knife(word)).all(|word| HOLES.contains(&&**word))
}

/// True if a name says that the lines of the layer are notches or holes.
pub fn names_marks(name: &str) -> bool {
    has_word(name, &MARKS)
}

/// True if a name contains one of some words, in capitals.
fn has_word(name: &str, known: &[&str]) -> bool {
    words(name).iter().any(|word| known.contains(&&**word))
}

/// Words of a name, in capitals; `CUT OUT` is one word.
fn words(name: &str) -> Vec<String> {
    let name = name.to_uppercase();
    let mut words: Vec<String> = Vec::new();
    for word in name.split(|c: char| !c.is_alphabetic()).filter(|word| !word.is_empty()) {
        match words.last_mut() {
            Some(last) if last == "CUT" && ["OUT", "OUTS"].contains(&word) => last.push_str(word),
            _ => words.push(word.to_owned()),
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::Known::{Beside, Named, Said};
    use super::*;

    #[test]
    fn what_is_typed_is_read_and_shown_alike() {
        for text in ["CUT", "CUT,FOLD=pen,TEXT*=ignore", "Layer 1"] {
            assert_eq!(LayerUses::parse(text).expect("layers").to_string(), text);
        }
        for text in ["", "CUT,", "CUT=laser", "=pen"] {
            assert!(LayerUses::parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn what_is_typed_holds_before_the_profile_and_that_before_names() {
        let typed = LayerUses::parse("a*,CUT=ignore").expect("layers");
        let of_profile = BTreeMap::from([("abc".to_owned(), PenUse::Pen), ("fold".to_owned(), PenUse::Knife)]);
        let found = uses(&["ABC", "Cut", "FOLD", "TEXT 1", "other"], Some(&typed), &of_profile);
        let expected = [
            Some((PenUse::Knife, Said)),
            Some((PenUse::Ignore, Said)),
            Some((PenUse::Knife, Said)),
            Some((PenUse::Ignore, Named)),
            Some((PenUse::Pen, Beside)),
        ];
        assert_eq!(found, expected);
        assert_eq!(typed.unused(&["ABC"]), ["CUT"]);
    }

    #[test]
    fn names_say_nothing_where_no_word_does() {
        let none = BTreeMap::new();
        let typed = LayerUses::parse("TEIL").expect("layers");
        let beside = uses(&["TEIL", "CUT", "FOLD"], Some(&typed), &none);
        assert_eq!(beside[1..], [Some((PenUse::Pen, Beside)), Some((PenUse::Pen, Named))]);
        let no = uses(&["DO NOT CUT", "nicht schneiden", "Kiss cut", "cut number"], None, &none);
        assert!(no.iter().all(|used| used.is_some_and(|(used, _)| used != PenUse::Knife)), "{no:?}");
        assert_eq!(uses(&["0", "deel 1", "Layer1", "cutter"], None, &none), [None; 4]);
        let holes = uses(&["0", "CUTOUT", "TEXT"], None, &none);
        assert_eq!((holes[0], holes[1]), (None, Some((PenUse::Knife, Named))), "the parts are on layer 0");
        assert_eq!(uses(&["0", "Cut-outs"], None, &none), [None, Some((PenUse::Knife, Named))]);
        for outlines in ["CUT", "OUTLINE CUTOUT"] {
            assert_eq!(uses(&["0", "CUTOUT", outlines], None, &none)[0], Some((PenUse::Pen, Beside)), "{outlines}");
        }
        let cut = uses(&["CUT_OUTER", "SCHNITT-2", "dim.cut"], None, &none);
        assert_eq!(cut[0], Some((PenUse::Knife, Named)));
        assert_eq!([cut[1], cut[2]].map(|used| used.map(|used| used.0)), [Some(PenUse::Knife), Some(PenUse::Ignore)]);
    }
}
