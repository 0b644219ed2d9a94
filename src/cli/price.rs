//! Options of costs: machine time at an hourly rate, shared by plies and parts. Amounts have no currency.

use clap::Args;

use crate::machine::Price;
use crate::units::{S_PER_HOUR, S_PER_MIN};

/// What one asks for on the command line.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Costs")]
pub(super) struct Pricing {
    /// What the machine costs, as in `--rate 45/h` or `--rate 0.75/min`: adds the cost of the marker by the time of its
    /// program, of each ply and of each part
    ///
    /// The number is money of any currency.
    #[arg(long, value_name = "MONEY/TIME", value_parser = Rate::parse)]
    rate: Option<Rate>,

    /// Plies of cloth that are cut at once; without it one
    #[arg(long, value_name = "N", requires = "rate", value_parser = clap::value_parser!(u32).range(1..))]
    plies: Option<u32>,
}

/// Rate of a machine.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Rate {
    /// Money per second.
    per_s: f64,
}

impl Rate {
    /// Parses `45/h`.
    fn parse(text: &str) -> Result<Self, String> {
        let rate = text.split_once('/').and_then(|(money, time)| {
            let seconds = match time.trim() {
                "h" => S_PER_HOUR,
                "min" => S_PER_MIN,
                "s" => 1.0,
                _ => return None,
            };
            let money: f64 = money.trim().parse().ok()?;
            (money.is_finite() && money >= 0.0).then_some(Self { per_s: money / seconds })
        });
        rate.ok_or_else(|| "a rate is a number and a time, as in 45/h or 0.75/min, without a currency".to_owned())
    }
}

impl Pricing {
    /// The price, if costs are requested.
    pub(super) fn price(self) -> Option<Price> {
        self.rate.map(|rate| Price { per_s: rate.per_s, plies: self.plies.unwrap_or(1) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rate_is_money_by_time() {
        for text in ["45/h", "0.75/min", "0.0125/s", " 45 / h"] {
            assert!((Rate::parse(text).expect("a rate").per_s - 0.0125).abs() < 1e-12, "{text}");
        }
        for text in ["45", "45/d", "-1/h", "inf/h", "EUR 45/h", "/h", ""] {
            assert!(Rate::parse(text).expect_err("refused").contains("45/h"), "{text}");
        }
    }
}
