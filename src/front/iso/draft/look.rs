//! The cut since the last plunge of the knife.

use super::{Draft, State};
use crate::geom::Point;

/// The current cut, at its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::front::iso) enum Stroke {
    /// The knife has not moved since it went down.
    Empty,
    /// A line, longer than a slit, that does not end where it starts.
    Open,
    /// Any other, or none.
    Other,
}

impl Draft {
    /// Position of the knife, mm.
    pub(in crate::front::iso) fn at(&self) -> Point {
        self.at
    }

    /// The current cut.
    pub(in crate::front::iso) fn stroke(&self) -> Stroke {
        match self.state {
            State::Plunged { .. } if self.is_back_from_slit() => Stroke::Other,
            State::Plunged { .. } => Stroke::Empty,
            State::Cutting(chain) => {
                let chain = &self.chains[chain];
                let (first, last) = chain.ends();
                let is_open = first != last && !chain.is_stroke();
                if is_open { Stroke::Open } else { Stroke::Other }
            }
            State::Up | State::Slit { .. } => Stroke::Other,
        }
    }

    /// True where the knife is back at the end of a contour that it left for a slit: files lower it there even if the contour
    /// is closed already.
    fn is_back_from_slit(&self) -> bool {
        let left = self.left.and_then(|index| self.chains.get(index));
        left.is_some_and(|chain| chain.lift.is_none() && chain.ends().1 == self.at)
    }

    /// Number of the current piece; `None` in a file without N.
    pub(in crate::front::iso) fn piece_number(&self) -> Option<u32> {
        self.current.map(|piece| self.pieces[piece].number)
    }
}
