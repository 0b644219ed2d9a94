//! Lost characters: unreadable bytes may have moved, lowered or lifted the pen. The plotter then refuses the lines that depend
//! on them.

use super::plotter::Plotter;
use super::reader::Reader;
use crate::source::Span;

/// Handles bytes that begin no instruction; a letter of one may be lost.
pub(super) fn over_junk(reader: &Reader, plotter: &mut Plotter, span: Span) {
    if reader.is_quoted(span) && !reader.draws(span) {
        return; // a text without instructions that draw
    }
    let (is_torn, numbers) = (reader.is_torn_pen(span), reader.numbers_within(span));
    if numbers > 1 || reader.is_torn_encoded(span) {
        // Several coordinates: an outline may be among them.
        plotter.lost.add(span);
    } else if plotter.is_drawing() || is_torn || numbers > 0 || reader.follows_number(span) {
        plotter.lose(span);
    }
    if is_torn {
        plotter.tear(span);
    }
}

/// Handles an unknown instruction; it may be a known one with a wrong letter.
pub(super) fn over_unknown(mnemonic: [u8; 2], reader: &Reader, plotter: &mut Plotter, span: Span) {
    let is_like_pen = mnemonic[0] == b'P' || matches!(mnemonic[1], b'U' | b'D');
    if reader.number_follows() || is_like_pen && plotter.is_drawing() {
        plotter.lose(span);
    }
    if is_like_pen {
        plotter.tear(span);
    }
}
