//! Heads that cut cloth while a conveyor moves it: the keys `flow.*`.

use serde::{Deserialize, Serialize};

use super::fault::Fault;
use super::key::{Key, SPEED, Takes, between, from};

/// The keys `flow.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "flow.speed_mm_s", takes: Takes::Number(SPEED), about: "Speed of the conveyor, which carries the cloth towards +X; `--speed` overrides it." },
    Key { name: "flow.max_speed_mm_s", takes: Takes::Number(SPEED), about: "Greatest speed of the conveyor: what `--speed max` looks up to." },
    Key { name: "flow.travel_mm", takes: Takes::Number(from(0.0, 10_000.0)), about: "How far a head may travel along the feed, from its station on." },
    Key { name: "flow.heads", takes: Takes::Count(200), about: "How many heads the machine has, in all rows together." },
    Key { name: "flow.rows", takes: Takes::Count(50), about: "How many rows these stand in, one behind the other along the feed." },
    Key { name: "flow.first_row_mm", takes: Takes::Number(from(0.0, 100_000.0)), about: "From where the front of the marker lies when the conveyor counts 0 to the station of the\nfirst row." },
    Key { name: "flow.row_pitch_mm", takes: Takes::Number(from(1.0, 100_000.0)), about: "From the station of one row to that of the next." },
    Key { name: "flow.head_width_mm", takes: Takes::Number(from(0.0, 10_000.0)), about: "Room that a head takes across the feed: two of one row come no nearer to each other." },
    Key { name: "flow.rulers_mm", takes: Takes::Number(between(-100_000.0, 100_000.0)), about: "From where the front of the marker lies when the conveyor counts 0 to the rulers under which a\ncentre line was found (`--centre`)." },
    Key { name: "flow.overlap_mm", takes: Takes::Number(from(0.0, 100.0)), about: "How far a head cuts on along the line where another one takes over; the two overlap by twice\nthat." },
];

/// Heads over a conveyor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Flow {
    /// Speed of the conveyor.
    pub speed_mm_s: f64,
    /// Greatest speed of the conveyor.
    pub max_speed_mm_s: f64,
    /// Travel of a head along the feed, from its station.
    pub travel_mm: f64,
    /// Number of heads in all rows.
    pub heads: u32,
    /// Number of rows along the feed.
    pub rows: u32,
    /// Distance from the front of the marker, at conveyor count 0, to the station of the first row.
    pub first_row_mm: f64,
    /// Distance between the stations of adjacent rows.
    pub row_pitch_mm: f64,
    /// Width of a head across the feed.
    pub head_width_mm: f64,
    /// Distance from the front of the marker, at conveyor count 0, to the rulers.
    pub rulers_mm: f64,
    /// Length by which each of two heads cuts on where one takes over from the other.
    pub overlap_mm: f64,
}

impl Default for Flow {
    fn default() -> Self {
        Self {
            speed_mm_s: 100.0,
            max_speed_mm_s: 500.0,
            travel_mm: 200.0,
            heads: 24,
            rows: 8,
            first_row_mm: 300.0,
            row_pitch_mm: 600.0,
            head_width_mm: 80.0,
            rulers_mm: 0.0,
            overlap_mm: 2.0,
        }
    }
}

/// Checks values against each other.
pub(super) fn faults(flow: &Flow) -> Vec<Fault> {
    let mut faults = Vec::new();
    if flow.rows > 1 && flow.row_pitch_mm < flow.travel_mm {
        let message = format!(
            "`flow.row_pitch_mm` is {} mm, less than `flow.travel_mm`, {} mm",
            flow.row_pitch_mm, flow.travel_mm
        );
        let hint = "heads of one row would run into those of the next";
        faults.push(Fault::of_range(&["flow.row_pitch_mm", "flow.travel_mm"], message, hint));
    }
    if flow.speed_mm_s > flow.max_speed_mm_s {
        let message = format!(
            "`flow.speed_mm_s` is {} mm/s, more than `flow.max_speed_mm_s`, {} mm/s",
            flow.speed_mm_s, flow.max_speed_mm_s
        );
        let hint = "the conveyor does not run faster than it can";
        faults.push(Fault::of_range(&["flow.speed_mm_s", "flow.max_speed_mm_s"], message, hint));
    }
    faults
}
