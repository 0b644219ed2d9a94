//! Manual entries on the elements of SVG.

use crate::front::Word;

/// The elements of SVG and their effects.
#[rustfmt::skip] // a table: one row per line
pub(super) const WORDS: &[Word] = &[
    Word { words: "`svg`", about: "`width` and `height` with mm, cm, in, pt, pc, q; `viewBox` and `preserveAspectRatio` as browsers read them; inner ones likewise" },
    Word { words: "`path`, `rect`, `circle`, `ellipse`, `line`, `polyline`, `polygon`", about: "read; curves as chords within a quarter of the tolerance and 0.02 mm" },
    Word { words: "`g`, `a`, `use`, `symbol`, `switch`", about: "read, with every transform; `switch` takes its first child that asks for no extension and no language but English" },
    Word { words: "`style`, `style=`, `class=`", about: "say what is drawn: `display`, `visibility`, `opacity`, `stroke`, `fill`; selectors of elements, classes, ids and `*`, others are reported" },
    Word { words: "`text`", about: "labels; never cut" },
    Word { words: "`image`, `foreignObject`, `flowRoot`, `marker-end`, `clip-path`, `mask`, animations", about: "not cut or not obeyed, and reported" },
    Word { words: "`defs`, gradients, patterns, filters, metadata, elements of other namespaces", about: "draw nothing by themselves" },
    Word { words: "what is hidden or transparent, or has neither stroke nor fill", about: "not cut, and counted" },
];
