//! Profiles that ship with the program: one TOML file a controller, taken by name wherever a profile is taken.
//!
//! A new one is a file in `shipped/` and a row of [`SHIPPED`]. The comment at its head says which settings of the controller it
//! assumes.

use super::keys::KEYS;
use super::load::{Faults, load_given};
use super::show::Comments;
use crate::source::Source;

/// All shipped profiles.
pub const SHIPPED: &[Shipped] = &[
    Shipped {
        name: "linuxcnc",
        about: "LinuxCNC 2.9: arcs on which the axis C turns, knife and drills at digital outputs",
        text: include_str!("shipped/linuxcnc.toml"),
    },
    Shipped {
        name: "grblhal",
        about: "grblHAL: straight moves in inverse time, rotary axis A, knife at Z",
        text: include_str!("shipped/grblhal.toml"),
    },
    Shipped {
        name: "grblhal-arcs",
        about: "grblHAL: arcs on which the rotary axis A turns, knife at Z",
        text: include_str!("shipped/grblhal-arcs.toml"),
    },
    Shipped {
        name: "fluidnc",
        about: "FluidNC: straight moves in inverse time, rotary axis A, knife at Z",
        text: include_str!("shipped/fluidnc.toml"),
    },
    Shipped {
        name: "fluidnc-arcs",
        about: "FluidNC: arcs on which the rotary axis A turns, knife at Z",
        text: include_str!("shipped/fluidnc-arcs.toml"),
    },
    Shipped {
        name: "mega5x",
        about: "grbl-Mega-5X: straight moves in inverse time, rotary axis A, knife at Z",
        text: include_str!("shipped/mega5x.toml"),
    },
    Shipped {
        name: "reprap",
        about: "RepRapFirmware 3.5: arcs or lines, whichever is faster, rotary axis A, knife at Z",
        text: include_str!("shipped/reprap.toml"),
    },
];

/// Drawing of a trial, as a cut file: a square, a circle and a star of twelve strokes, on 220 x 80 mm.
pub const TRIAL: &str = include_str!("shipped/trial.cut");

/// Keys beside those of a shipped profile that every machine of this kind needs: what is measured on it.
const MEASURED: &[&str] = &[
    "home",
    "park",
    "knife.width_mm",
    "knife.back_mm",
    "knife.feed_mm_s",
    "knife.plunge_ms",
    "knife.lift_ms",
    "table.x_mm",
    "table.y_mm",
    "path.tolerance_mm",
    "axes.x.speed_mm_s",
    "axes.x.acceleration_mm_s2",
    "axes.y.speed_mm_s",
    "axes.y.acceleration_mm_s2",
    "axes.c.speed_deg_s",
    "axes.c.acceleration_deg_s2",
    "c.range_deg",
    "c.offset_deg",
    "c.reverse",
];

/// Profile that ships with the program.
#[derive(Debug, Clone, Copy)]
pub struct Shipped {
    /// Name by which it is taken.
    pub name: &'static str,
    /// Controller and its use, without a full stop.
    pub about: &'static str,
    /// TOML.
    text: &'static str,
}

/// Keys of a printed profile.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Keys that differ between machines with the controller.
    Needed,
    /// Every key.
    All,
}

impl Shipped {
    /// Profile of a name; `None` if no such profile ships.
    pub fn find(name: &str) -> Option<&'static Self> {
        SHIPPED.iter().find(|shipped| shipped.name == name)
    }

    /// Its file, under its name.
    pub fn source(&self) -> Source {
        Source::new(self.name, self.text.as_bytes().to_vec()).expect("a file of a few lines is small")
    }

    /// Profile of a machine to begin with: the assumed settings of the controller, then keys with their meaning and values.
    pub fn beginning(&self, extent: Extent) -> String {
        self.beginning_with(&[], extent).expect("a test loads every shipped profile")
    }

    /// The same with `key=value` arguments on top.
    ///
    /// # Errors
    ///
    /// The faults of the arguments.
    pub fn beginning_with(&self, sets: &[String], extent: Extent) -> Result<String, Faults> {
        let (profile, origin) = load_given(Some(&self.source()), sets)?;
        let is_needed = |name: &str| MEASURED.contains(&name) || origin.given.contains(name);
        let keep = |name: &str| extent == Extent::All || is_needed(name);
        let head = self.text.lines().take_while(|line| line.starts_with('#'));
        let head: String = head.flat_map(|line| [line, "\n"]).collect();
        let (count, all) = (KEYS.iter().filter(|key| keep(key.name)).count(), KEYS.len());
        let rest = match extent {
            Extent::Needed => format!(
                "#\n# {count} of {all} keys are here: those that differ between such machines. Measure yours.\n\
                 # `cutc profile init --for {} --all` prints the others, too.\n",
                self.name
            ),
            Extent::All => String::new(),
        };
        Ok(format!("{head}{rest}\n{}", profile.toml_of(Comments::Explained, &keep)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::render;
    use crate::machine::{MachineProfile, load};

    fn loaded(source: &Source) -> MachineProfile {
        load(Some(source), &[]).map_err(|faults| render(&faults.file, source)).expect("a legal profile")
    }

    #[test]
    fn each_is_legal_says_what_it_assumes_and_has_a_name_of_its_own() {
        for (i, shipped) in SHIPPED.iter().enumerate() {
            loaded(&shipped.source());
            assert!(shipped.text.starts_with("# ") && shipped.text.contains("\n# It assumes "), "{}", shipped.name);
            assert!(SHIPPED[..i].iter().all(|other| other.name != shipped.name), "{}", shipped.name);
            assert!(shipped.text.lines().all(|line| line.len() <= 100), "{}", shipped.name);
        }
    }

    #[test]
    fn a_beginning_is_the_shipped_profile_itself_with_the_keys_that_machines_differ_in() {
        for shipped in SHIPPED {
            let texts = [Extent::Needed, Extent::All].map(|extent| shipped.beginning(extent));
            for text in &texts {
                let source = Source::new("machine.toml", text.clone().into_bytes()).expect("small");
                assert_eq!(loaded(&source).digest(), loaded(&shipped.source()).digest(), "{}", shipped.name);
            }
            let keys =
                texts.map(|text| text.lines().filter(|line| line.contains(" = ") && !line.starts_with('#')).count());
            assert!((25..=45).contains(&keys[0]) && keys[1] > 150, "{keys:?}");
        }
        assert!(MEASURED.iter().all(|name| KEYS.iter().any(|key| key.name == *name)));
    }
}
