//! The machine: its profile, the options of one compile, and the closed forms of its axes.
//!
//! Receives TOML, promises validated numbers in mm, s and rad, and knows nothing of cuts. [`load()`] reads a profile and
//! reports every fault in it; [`keys::KEYS`] describes each key once, for the commented profile, the messages, the schema, the
//! help and the manual.

pub mod axes;
mod bite;
mod centre;
mod codes;
pub mod common;
pub mod counts;
mod digest;
mod drafting_codes;
pub mod drawings;
pub mod drill;
mod encoding;
mod fault;
pub mod flow;
pub mod gcode;
mod key;
pub mod keys;
pub mod kinematics;
pub mod knife;
pub mod labels;
pub mod layers;
pub mod letters;
mod load;
pub mod marks;
mod measured;
mod near;
pub mod nest;
pub mod notches;
pub mod order;
mod origin;
pub mod path;
pub mod patterns;
mod pen;
pub mod plot;
pub mod profile;
mod remarks;
mod schema;
mod selection;
pub mod sewing;
pub mod sheet;
mod shipped;
mod show;
mod sizes;
pub mod table;
pub mod time;
mod tool;
pub mod tracking;
mod typed;
mod validate;
pub mod verify;
mod word;

use std::sync::Arc;

pub use bite::Bite;
pub use centre::{Centre, CentreLine};
pub use common::{Common, CommonLines, Lines};
pub use digest::{blake3_of, sha256_hex, sha256_of};
pub use drawings::{Beside, CLOSE_MOST_MM, Drawings};
pub use flow::Flow;
pub use kinematics::Limits;
pub use knife::{Follow, Knife, Spare, TightCurves};
pub use load::{Faults, load, load_given};
pub use marks::{AffineMap, Mark, Marks};
pub use nest::Nest;
pub use notches::{NotchStyle, Notches, TNotch};
pub use order::{Order, OrderPolicy};
pub use origin::{Axis, Origin};
pub use path::Fit;
pub use profile::{FileUnit, MachineProfile};
pub use remarks::{Costs, Price, Remarks};
pub use schema::schema;
pub use selection::{Mode, NotNumbers, NotStart, Numbers, Selection, Start};
pub use sewing::Sewing;
pub use sheet::{Flip, Mirror, Sheet};
pub use shipped::{Extent, SHIPPED, Shipped, TRIAL};
pub use show::Comments;
pub use sizes::{LONGEST_LAY_MM, LONGEST_PART_MM};
pub use table::Table;
pub use tool::{Basis, Planner, Quintic, Tool, ToolKind};
pub use tracking::Tracking;
pub use typed::file_name;

/// Task of one compile: the profile and the options of this run.
#[derive(Debug, Clone, Default)]
pub struct Job {
    /// The machine and the cutting room.
    pub profile: MachineProfile,
    /// Source of the profile.
    pub origin: Origin,
    /// Pieces that it cuts.
    pub selection: Selection,
    /// Use of the knife.
    pub mode: Mode,
    /// Lines of a plot that it cuts.
    pub lines: plot::Lines,
    /// Offset of the cloth across the conveyor that brings it; `None` = everywhere in the middle.
    pub centre: Option<Arc<Centre>>,
    /// Place of the drawing on the table by its registration marks; `None` = by the sheet of the profile.
    pub marks: Option<Arc<Marks>>,
    /// Patterns that it cuts.
    pub patterns: patterns::Patterns,
    /// Remarks that a page prints beside it.
    pub remarks: Remarks,
}

impl Job {
    /// Greatest factor by which the drawing grows on the table.
    pub fn growth(&self) -> f64 {
        self.marks.as_ref().map_or(self.profile.sheet.growth(), |marks| marks.map().growth())
    }
}
