//! `cutc` is a compiler from garment cutter files to machine programs for a tangential knife.

pub mod back;
pub mod cli;
pub mod diagnostic;
pub mod front;
pub mod geom;
pub mod ir;
pub mod machine;
pub mod pass;
pub mod pipeline;
pub mod source;
pub mod units;
