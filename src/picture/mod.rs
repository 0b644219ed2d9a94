//! Pictures that live in a browser: pages of one file that need neither a server nor a network.
//!
//! Receives texts, facts and columns of numbers from targets, promises a page whose scripts and styles are its own and whose
//! texts stay texts. Never knows a machine, a marker or a program.

mod markup;
mod pack;
mod page;

pub use markup::{Markup, escape};
pub use pack::Columns;
pub use page::{Page, Script};
