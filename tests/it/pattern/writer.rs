//! Writes pattern DXF, one way of drawing after the other.

use std::fmt::Write as _;

pub(super) type Place = [f64; 2];

/// A file in the making.
#[derive(Debug, Clone, Default)]
pub(super) struct Writer {
    text: String,
}

/// Outlines as CAD systems draw them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Drawn {
    Closed,
    FirstIsLast,
    /// Three polylines, the second the other way round.
    Parts,
    Lines,
    Twice,
}

impl Drawn {
    pub(super) const ALL: [Self; 5] = [Self::Closed, Self::FirstIsLast, Self::Parts, Self::Lines, Self::Twice];
}

impl Writer {
    pub(super) fn group(&mut self, code: i32, value: impl std::fmt::Display) -> &mut Self {
        let _ = write!(self.text, "{code:>3}\n{value}\n");
        self
    }

    /// What is written so far.
    pub(super) fn text_so_far(&self) -> &str {
        &self.text
    }

    /// A file up to its first block.
    pub(super) fn begin() -> Self {
        let mut file = Self::default();
        file.group(0, "SECTION").group(2, "HEADER").group(0, "ENDSEC").group(0, "SECTION").group(2, "BLOCKS");
        file
    }

    pub(super) fn block(&mut self, name: &str) -> &mut Self {
        self.group(0, "BLOCK").group(8, 1).group(2, name).group(70, 64).group(10, 0).group(20, 0)
    }

    pub(super) fn end_block(&mut self) -> &mut Self {
        self.group(0, "ENDBLK")
    }

    /// The whole file, with texts behind its blocks.
    pub(super) fn end(mut self, texts: &[&str]) -> String {
        self.group(0, "ENDSEC").group(0, "SECTION").group(2, "ENTITIES");
        for text in texts {
            self.text(text);
        }
        self.group(0, "ENDSEC").group(0, "EOF");
        self.text
    }

    pub(super) fn text(&mut self, text: &str) -> &mut Self {
        self.group(0, "TEXT").group(8, 1).group(10, 0).group(20, 0).group(40, 3).group(1, text)
    }

    pub(super) fn polyline(&mut self, layer: u32, places: &[Place], is_closed: bool) -> &mut Self {
        self.group(0, "POLYLINE").group(8, layer).group(66, 1).group(70, i32::from(is_closed));
        for [x, y] in places {
            self.group(0, "VERTEX").group(8, layer).group(10, x).group(20, y);
        }
        self.group(0, "SEQEND")
    }

    pub(super) fn line(&mut self, layer: u32, [from, to]: [Place; 2]) -> &mut Self {
        self.group(0, "LINE").group(8, layer).group(10, from[0]).group(20, from[1]).group(11, to[0]).group(21, to[1])
    }

    pub(super) fn point(&mut self, layer: u32, [x, y]: Place, [depth, width]: [f64; 2]) -> &mut Self {
        self.group(0, "POINT").group(8, layer).group(10, x).group(20, y).group(30, depth).group(39, width)
    }

    /// A closed line in one of several ways.
    pub(super) fn outline(&mut self, layer: u32, places: &[Place], drawn: Drawn) -> &mut Self {
        let again = [places, &places[..1]].concat();
        let third = again.len() / 3;
        match drawn {
            Drawn::Closed => self.polyline(layer, places, true),
            Drawn::FirstIsLast => self.polyline(layer, &again, false),
            Drawn::Twice => {
                let twice: Vec<Place> = again.iter().flat_map(|place| [*place; 2]).collect();
                self.polyline(layer, &twice, false)
            }
            Drawn::Parts => {
                let second: Vec<Place> = again[third..=2 * third].iter().rev().copied().collect();
                self.polyline(layer, &again[..=third], false);
                self.polyline(layer, &again[2 * third..], false);
                self.polyline(layer, &second, false)
            }
            Drawn::Lines => {
                for ends in again.windows(2) {
                    self.line(layer, [ends[0], ends[1]]);
                }
                self
            }
        }
    }
}
