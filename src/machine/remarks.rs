//! Remarks on a job that a page prints and that do not affect the program.

/// Date, and costs of the machine.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Remarks {
    /// Date as typed; it is not parsed.
    pub date: Option<String>,
    /// Costs of the machine; `None` if not asked for.
    pub price: Option<Price>,
}

/// Costs of the machine, shared by the plies that are cut at once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Price {
    /// Price in any currency per second.
    pub per_s: f64,
    /// Number of plies, at least one.
    pub plies: u32,
}
