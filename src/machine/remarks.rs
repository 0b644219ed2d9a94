//! Remarks on a job that a page prints and that do not affect the program.

use std::fmt;

use crate::units::S_PER_HOUR;
use crate::units::number::fixed;

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

/// Costs of a marker, as amounts of money.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Costs {
    /// Price of an hour.
    pub hour: f64,
    /// Number of plies.
    pub plies: u32,
    /// Cost of all plies.
    pub marker: f64,
    /// Cost of one ply.
    pub ply: f64,
    /// Cost of one part in one ply; `None` if there are no parts.
    pub part: Option<f64>,
}

impl Price {
    /// The costs of `pieces` pieces whose program takes `time_s` s.
    pub fn costs(&self, time_s: f64, pieces: usize) -> Costs {
        let marker = time_s * self.per_s;
        let ply = marker / f64::from(self.plies);
        Costs {
            hour: self.per_s * S_PER_HOUR,
            plies: self.plies,
            marker,
            ply,
            part: (pieces > 0).then(|| ply / pieces as f64),
        }
    }
}

impl fmt::Display for Costs {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { hour, plies, marker, ply, part } = *self;
        let of = if plies == 1 { "1 ply".to_owned() } else { format!("{plies} plies") };
        write!(f, "{} at {}/h for {of}: {} a ply", fixed(marker, 2), fixed(hour, 2), fixed(ply, 3))?;
        part.map_or(Ok(()), |part| write!(f, ", {} a part", fixed(part, 4)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn costs_are_shared_by_plies_and_parts() {
        let price = Price { per_s: 0.01, plies: 10 };
        let costs = price.costs(500.0, 4);
        assert_eq!((costs.marker, costs.ply, costs.part), (5.0, 0.5, Some(0.125)));
        assert_eq!(costs.to_string(), "5.00 at 36.00/h for 10 plies: 0.500 a ply, 0.1250 a part");
        assert_eq!(price.costs(0.0, 0).part, None);
    }
}
