//! Manual entries on the instructions of plots.

use crate::front::Word;

/// The instructions of plots and their effects.
#[rustfmt::skip] // a table: one row per line
pub(super) const WORDS: &[Word] = &[
    Word { words: "`PU`, `PD`, `PA`, `PR`, `SP`", about: "moves; without `SP` pen 1 draws" },
    Word { words: "`PE`", about: "moves in 7 and 8 bits, with fractions; the next instruction may stand for its semicolon; bytes that were saved as UTF-8 are repaired, lost ones refused" },
    Word { words: "`AA`, `AR`, `AT`, `RT`, `CI`, `BZ`, `BR`", about: "curves, as chords within a quarter of the tolerance" },
    Word { words: "`EA`, `ER`, `EW`, `PM`, `EP`", about: "edges of rectangles, wedges, polygons" },
    Word { words: "`SC`, `IP`, `IR`, `PS`, `RO`", about: "obeyed; without `IP`, or with numbers missing, the size depends on the plotter, and is doubted; factors of X and Y that differ by more than 1 % give a warning" },
    Word { words: "`LB`, `BL`, `PB`, `DT`, `DI`, `DR`", about: "labels with any terminator, kept and written ones too; what is drawn from the end of a text gives a warning" },
    Word { words: "`WD`, `MG`, `CO`", about: "texts for the display, messages, comments: passed over, whatever words they hold" },
    Word { words: "`IN`, `BP`, `ESC E`", about: "as switched on: pen 1, up, at the origin; scale, corners and turn end; ETX ends labels" },
    Word { words: "`DF`", about: "the same of modes, scale and terminator; pen, place, corners and turn stay" },
    Word { words: "other escape sequences, lines of `@PJL`", about: "passed over, with the data that they count (`ESC*b26W`); `ESC.B` and the like amid a list of places, too" },
    Word { words: "`ESC ;@:` to a line `END`", about: "settings of Summa cutters: passed over" },
    Word { words: "`PG`, `AF`, `AH`, `EC`", about: "refused when a page behind it lies over the drawing before, reported when it lies beside it or is the same; `IN` is reported when the same place is drawn again" },
    Word { words: "`FR`", about: "refused when more is drawn behind it: the frames would lie on each other" },
    Word { words: "`FP`, `RA`, `RR`, `WG`, `FT`, `UC`, `CP`, `CS`, `SS`, `SM`, `IW`, `RP`", about: "reported" },
    Word { words: "`LT`, `VS`, `PW` and other settings", about: "no effect on the cut" },
    Word { words: "any other", about: "reported as unknown" },
];
