//! Writes a sheet as an ISO cut file.

use std::fmt::Write as _;

use cutc::ir::toolpath::Event;

use crate::properties::sheet::{Part, Place, Shape, Sheet, Slit};

/// The bytes of the file.
pub(crate) fn write(sheet: &Sheet) -> Vec<u8> {
    let mut file = File { shape: sheet.shape, text: String::new() };
    file.block("H1");
    if sheet.shape != Shape::Inch {
        file.block("G71");
    }
    file.block("M15");
    if sheet.shape == Shape::Metric {
        let (length, width) = sheet.marker().extent().size();
        file.block("M20");
        file.block(&format!("JOB-1/L={:.1}cm/W={:.1}cm", length / 10.0, width / 10.0));
    }
    for part in &sheet.parts {
        file.part(part);
    }
    file.events(&sheet.closing);
    file.block("M0");
    file.text.into_bytes()
}

struct File {
    shape: Shape,
    text: String,
}

fn at([x, y]: Place) -> String {
    format!("X{x}Y{y}")
}

impl File {
    fn block(&mut self, text: &str) {
        let after = match self.shape {
            Shape::Metric | Shape::Inch => "",
            Shape::Spaced => "  ",
        };
        // Writing into a `String` cannot fail.
        let _ = write!(self.text, "{text}*{after}");
    }

    fn blocks(&mut self, texts: &[&str]) {
        for text in texts {
            self.block(text);
        }
    }

    fn events(&mut self, events: &[Event]) {
        for event in events {
            self.block(match event {
                Event::Stop => "M01",
                Event::Advance | Event::AdvanceBy(_) => "M69",
            });
        }
    }

    fn part(&mut self, part: &Part) {
        if self.shape != Shape::Spaced {
            self.block(&format!("N{}", part.number));
            self.blocks(&["D2", "M15"]);
        }
        self.events(&part.events);
        if let Some(feed) = part.feed {
            self.block(&format!("F{feed}"));
        }
        if let Some(speed) = part.speed {
            self.block(&format!("M6{speed}"));
        }
        self.block(if part.slow { "M25" } else { "M26" });
        self.marks(part);
        if self.shape != Shape::Inch {
            for vertex in &part.outline {
                if let Some(slit) = vertex.slit {
                    self.blocks(&[&at(vertex.at), "M14"]);
                    self.slit(slit);
                }
            }
        }
        if let Some(&first) = part.cut_out.first() {
            self.blocks(&[&at(first), "M14"]);
            for &place in &part.cut_out[1..] {
                self.block(&at(place));
            }
            self.blocks(&[&at(first), "M15"]);
        }
        let first = part.outline[0].at;
        self.blocks(&[&at(first), "M14"]);
        for vertex in &part.outline[1..] {
            self.block(&at(vertex.at));
            if vertex.lift {
                self.blocks(&["M15", &at(vertex.at), "M14"]);
            }
            if let Some(slit) = vertex.slit.filter(|_| self.shape == Shape::Inch) {
                self.slit(slit);
                self.blocks(&[&at(vertex.at), "M14"]);
            }
        }
        self.blocks(&[&at(first), "M15"]);
    }

    /// Drills and labels.
    fn marks(&mut self, part: &Part) {
        for &(place, tool) in &part.drills {
            let code = ["M43", "M44", "M45", "M73"][usize::from(tool) - 1];
            match self.shape {
                Shape::Metric => self.block(&(at(place) + code)),
                Shape::Inch => self.blocks(&["M15", code, &at(place), "M15"]),
                Shape::Spaced => self.blocks(&[&at(place), code]),
            }
        }
        for label in &part.labels {
            match self.shape {
                Shape::Metric | Shape::Spaced => self.blocks(&[&(at(label.at) + "M31"), label.words]),
                Shape::Inch => self.blocks(&["M31", &at(label.at), label.words]),
            }
            if let Some(second) = label.second {
                self.blocks(&["D2", "M15", &at(second), "M15"]);
            }
        }
    }

    /// A slit, from the knife down at its root to the knife up. Inside a contour M19 says that the knife leaves it.
    fn slit(&mut self, slit: Slit) {
        if slit.named || self.shape == Shape::Inch {
            self.block("M19");
        }
        self.blocks(&[&at(slit.tip), "M15"]);
        if let Some([from, to]) = slit.bar {
            self.blocks(&[&at(from), "M14", &at(to), "M15"]);
        }
    }
}
