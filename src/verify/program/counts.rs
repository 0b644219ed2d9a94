//! Reader of timed setpoints as encoder counts: a JSON header with the scales, then records of five little-endian `i32`, or six
//! with a conveyor.

use std::io::{BufRead, Read as _};

use serde_json::Value;

use super::row::Row;
use crate::geom::Point;
use crate::machine::MachineProfile;

/// First bytes of every such file.
const MAGIC: &[u8] = b"{\"format\": \"cutc-counts\"";
/// Bytes of the header, including its line feed.
const HEADER: u64 = 1024;
/// Bytes of a number.
const NUMBER: usize = 4;
/// Names of the numbers in a record. The last one is present only with a conveyor.
const NAMES: [&str; 6] = ["x", "y", "c", "outputs", "block", "advance_mm"];
const LEAST: usize = 5;
const COLUMNS: [usize; 2] = [LEAST, NAMES.len()];
/// Number of values of a 32-bit register.
const TURN: i64 = 1 << 32;

/// True if the program has this format.
pub(in crate::verify) fn begins(input: &mut dyn BufRead) -> bool {
    input.fill_buf().is_ok_and(|bytes| bytes.starts_with(MAGIC))
}

/// Scales and offsets of the counts, and the state of the reader.
#[derive(Debug, Clone)]
pub(in crate::verify) struct Counts {
    /// Counts per mm (X, Y) and per degree (C).
    scales: [f64; 3],
    offsets: [f64; 3],
    zero_deg: f64,
    sign: f64,
    period: f64,
    /// Numbers per record.
    columns: usize,
    /// Counts of the last record, unwrapped.
    last: Option<[i64; 3]>,
}

impl Counts {
    /// Reads the header and returns the scales and the number of records; `None` when the header is malformed or contradicts
    /// the profile.
    pub(in crate::verify) fn read(input: &mut dyn BufRead, profile: &MachineProfile) -> Option<(Self, u64)> {
        let mut line = Vec::new();
        input.take(HEADER).read_until(b'\n', &mut line).ok()?;
        if line.len() as u64 != HEADER || line.last() != Some(&b'\n') {
            return None;
        }
        let told: Value = serde_json::from_slice(&line).ok()?;
        let number = |pointer: &str| told.pointer(pointer).and_then(Value::as_f64);
        let counts = Self {
            scales: [number("/x/per_mm")?, number("/y/per_mm")?, number("/c/per_deg")?],
            offsets: [number("/x/offset")?, number("/y/offset")?, number("/c/offset")?],
            zero_deg: number("/c/zero_deg")?,
            sign: if told.pointer("/c/reverse")?.as_bool()? { -1.0 } else { 1.0 },
            period: number("/period_s")?,
            columns: told["columns"].as_array()?.len(),
            last: None,
        };
        let (keys, c) = (&profile.counts, &profile.c);
        let bits = [("knife_bit", 0), ("drill_bit", 4), ("drill_bits", 3), ("event_bit", 8), ("event_bits", 2)];
        let as_asked = counts.scales == [keys.x.per_mm, keys.y.per_mm, keys.c.per_deg]
            && counts.offsets == [keys.x.offset, keys.y.offset, keys.c.offset]
            && counts.zero_deg == c.offset_deg
            && (counts.sign < 0.0) == c.reverse
            && counts.period == profile.time.period()
            && told["version"] == 1
            && told["type"] == "<i4"
            && COLUMNS.contains(&counts.columns)
            && told["columns"] == serde_json::json!(NAMES[..counts.columns])
            && bits.iter().all(|(name, bit)| told["outputs"][name] == *bit);
        let rows = told["rows"].as_u64()?;
        as_asked.then_some((counts, rows))
    }

    /// Half a count of each axis, mm and degrees.
    pub(in crate::verify) fn rounding(&self) -> [f64; 3] {
        self.scales.map(|scale| 0.5 / scale)
    }

    /// Reads the next record into `bytes`; `left` is the number of records still expected. `Some(false)` at the end of the
    /// program, `None` when it ends too early or bytes are left over.
    pub(in crate::verify) fn record(
        &self,
        input: &mut dyn BufRead,
        left: &mut u64,
        bytes: &mut Vec<u8>,
    ) -> Option<bool> {
        if *left == 0 {
            return input.fill_buf().ok()?.is_empty().then_some(false);
        }
        *left -= 1;
        bytes.resize(NUMBER * self.columns, 0);
        input.read_exact(bytes).ok()?;
        Some(true)
    }

    /// Row of a record; `None` when its outputs are not legal.
    pub(in crate::verify) fn row(&mut self, record: &[u8], tick: u64) -> Option<Row> {
        let word = |i: usize| Some(i32::from_le_bytes(record.get(4 * i..4 * i + 4)?.try_into().ok()?));
        let read = [word(0)?, word(1)?, word(2)?].map(i64::from);
        let counts = match self.last {
            // A register that seems to leap has wrapped around: take the shorter way.
            Some(last) => std::array::from_fn(|i| {
                let way = (read[i] - last[i]).rem_euclid(TURN);
                last[i] + if way >= TURN / 2 { way - TURN } else { way }
            }),
            None => read,
        };
        self.last = Some(counts);
        let [x, y, shown] = std::array::from_fn(|i| (counts[i] as f64 - self.offsets[i]) / self.scales[i]);
        let outputs = word(3)? as u32;
        let (knife, drill, event) = (outputs & 1, outputs >> 4 & 0b111, outputs >> 8 & 0b11);
        let legal = outputs == knife | drill << 4 | event << 8 && drill <= 4 && event <= 2;
        legal.then_some(Row {
            tick,
            t: tick as f64 * self.period,
            centre: Point::new(x, y),
            c_deg: self.zero_deg + self.sign * shown,
            knife: knife == 1,
            drill: drill as u8,
            event: event as u8,
            block: word(4)? as u32,
            station: if self.columns > LEAST { word(LEAST)? as u32 } else { 0 },
            line: tick,
        })
    }
}
