//! Manual entries on the codes of cut files.

use crate::front::Word;

/// The codes of cut files and their effects.
#[rustfmt::skip] // a table: one row per line
pub(super) const WORDS: &[Word] = &[
    Word { words: "`A`, `M15`; `B`, `M14`", about: "knife up; knife down. Down and up without a place between is reported. Strokes that make a ring are one outline, in any order and either way" },
    Word { words: "`N`", about: "a piece begins; with the knife down, at the next lift" },
    Word { words: "`G70`, `G71`, `G91`", about: "unit 0.0254 mm, 0.1 mm, 0.254 mm (this one, too, where none of them stands, which is reported). Two that contradict each other are refused; G91 for relative coordinates is not read" },
    Word { words: "`G01`; `G02`, `G03` with `I J` or `R` and a number", about: "straight lines; arcs, as chords within a quarter of the tolerance and 0.01 mm" },
    Word { words: "`G00`", about: "straight lines; reported, since the knife alone says what is cut" },
    Word { words: "`F`", about: "cap on the speed, inches per minute, from there on" },
    Word { words: "`L`, `M25`; `O`, `M26`", about: "`knife.slow_percent` of the speed until normal speed or the next piece; normal speed" },
    Word { words: "`M60` to `M67`", about: "the piece at 95, 90 ... 60 percent of the speed" },
    Word { words: "`M01`", about: "event 1 (stop), before the next piece" },
    Word { words: "`M69`", about: "event 2 (advance), before the next piece" },
    Word { words: "`Z`", about: "bite size: no effect when it is longer than the marker or `bite.length_mm` is given, else reported" },
    Word { words: "`M17`; `M18`", about: "next plunge without heel overlap; next lift without front overlap" },
    Word { words: "`M19`", about: "knife down: a slit; knife up: no overlaps at the next plunge and lift. A stroke of at most 15 mm that starts on an outline of its piece is a slit without it, too; one that the tip of a slit divides is the crossbar of a T. A slit that begins on no edge is reported" },
    Word { words: "`M46`", about: "lift and plunge at the next corner" },
    Word { words: "`R` without a number, `M43`; `M44`; `M45`, `M72`; `M73`", about: "drill 1; 2; 3; 4" },
    Word { words: "`M31`", about: "label, in four layouts; never cut" },
    Word { words: "`M20`", about: "message; its size of the marker is checked" },
    Word { words: "`G04`, `M70`", about: "origin: no effect before the first coordinates, reported behind them; G04 is a dwell in most controllers. With X, Y or F in its block it is refused, since they are its own numbers; switched off, it is skipped with X, Y, F and P" },
    Word { words: "`M0`", about: "end; reported when something to cut follows. The list of labels behind it goes to its pieces" },
    Word { words: "`/ ... /`", about: "what stands between is skipped, but in texts; it is no code and cannot be switched off. A block end or M14 in it is reported: many machines skip one block behind a `/`" },
    Word { words: "`E`, `M68`; `M23`", about: "flick notch; edge clip: reported" },
    Word { words: "`M40`, `M41`, `M42`; `M47`, `M48`, `M51`", about: "sharpening; knife intelligence: reported" },
    Word { words: "`D1`, `D2`, `D4`, `Q`, `H`, `G90`, `M30`", about: "no effect on the cut" },
    Word { words: "any other", about: "reported as unknown; refused where X or Y follow in its block, which may be its own numbers" },
];
