//! Remarks on a job that a page prints and no program depends on.

/// A date and the price of the machine.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Remarks {
    /// Date as typed: nobody reads it but people.
    pub date: Option<String>,
    /// Costs of the machine; `None` where nobody asked.
    pub price: Option<Price>,
}

/// Costs of the machine, shared by the plies that are cut at once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Price {
    /// Money of any currency a second.
    pub per_s: f64,
    /// Plies, at least one.
    pub plies: u32,
}
