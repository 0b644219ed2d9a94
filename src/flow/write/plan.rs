//! The plan file: rows of the heads, their chains with times, and the speed of the conveyor.

use serde::Serialize;

use crate::flow::Figures;
use crate::flow::program::Program;
use crate::ir::Marker;
use crate::machine::MachineProfile;
use crate::units::MS_PER_S;

/// Contents of the plan file.
#[derive(Debug, Serialize)]
pub struct Plan {
    /// Speed of the conveyor.
    pub speed_mm_s: f64,
    /// Time between two setpoints.
    pub period_ms: f64,
    /// Number of setpoints of each head.
    pub rows_of_setpoints: u64,
    /// Limits of the machine that the plan was made for.
    pub limits: Limits,
    /// Figures of the plan.
    pub figures: Figures,
    /// The heads.
    pub heads: Vec<PlanHead>,
    /// Files that show the plan.
    pub pictures: Vec<File>,
}

/// Limits of the machine.
#[derive(Debug, Serialize)]
pub struct Limits {
    /// Travel of a head along the feed.
    pub travel_mm: f64,
    /// Space that a head takes across the feed.
    pub head_width_mm: f64,
    /// Overlap of each chain where another takes over.
    pub overlap_mm: f64,
    /// Number of heads available.
    pub heads: u32,
    /// Number of rows available.
    pub rows: u32,
}

/// A head in the plan.
#[derive(Debug, Serialize)]
pub struct PlanHead {
    /// Number, from 1.
    pub head: usize,
    /// Row, from 1.
    pub row: usize,
    /// Position of the row along the feed, from the origin of the marker.
    pub station_mm: f64,
    /// Program files of the head.
    pub files: Vec<File>,
    /// Chains in the order of cutting.
    pub chains: Vec<Planned>,
}

/// A file of the plan.
#[derive(Debug, Serialize)]
pub struct File {
    /// File name.
    pub file: String,
    /// BLAKE3 digest of its bytes.
    pub blake3: String,
}

/// A chain in the plan.
#[derive(Debug, Serialize)]
pub struct Planned {
    /// Number of the piece.
    pub piece: u32,
    /// Number of the cut, from 1, in the order of the marker.
    pub cut: u32,
    /// First and last block.
    pub blocks: [u32; 2],
    /// Maximum and minimum place along the feed.
    pub x_mm: [f64; 2],
    /// Length of the chain.
    pub length_mm: f64,
    /// Time of the first plunge and of the last lift.
    pub time_s: [f64; 2],
    /// Positions of the head along the feed at these times, from its station.
    pub along_mm: [f64; 2],
    /// Travel along the feed that it takes, including its ramps.
    pub travel_mm: f64,
}

/// The plan of a program, without the files of the heads and the pictures.
pub fn describe(program: &Program, marker: &Marker, profile: &MachineProfile) -> Plan {
    let flow = &profile.flow;
    let head = |(i, head): (usize, &crate::flow::Head)| PlanHead {
        head: i + 1,
        row: head.row + 1,
        station_mm: program.stations[head.row],
        files: Vec::new(),
        chains: (0..head.tasks.len()).map(|task| chain(program, marker, head, task)).collect(),
    };
    Plan {
        speed_mm_s: program.speed,
        period_ms: program.period() * MS_PER_S,
        rows_of_setpoints: program.ticks,
        limits: Limits {
            travel_mm: flow.travel_mm,
            head_width_mm: flow.head_width_mm,
            overlap_mm: flow.overlap_mm,
            heads: flow.heads,
            rows: flow.rows,
        },
        figures: program.figures.clone(),
        heads: program.heads.iter().enumerate().map(head).collect(),
        pictures: Vec::new(),
    }
}

fn chain(program: &Program, marker: &Marker, head: &crate::flow::Head, task: usize) -> Planned {
    let stroke = &program.strokes[head.tasks[task].task];
    let (ticks, states) = program.chain(head, task);
    let spans = marker.list.spans(marker.cuts[stroke.cut as usize].range);
    let block = |span: Option<&crate::source::Span>| span.map_or(0, |span| span.block);
    Planned {
        piece: stroke.piece[0],
        cut: stroke.cut + 1,
        blocks: [block(spans.first()), block(spans.last())],
        x_mm: stroke.span,
        length_mm: stroke.length(),
        time_s: ticks.map(|tick| (tick + program.origin(head.row)) as f64 * program.period()),
        along_mm: states.map(|state| state.xi),
        travel_mm: stroke.lag.travel(program.moving.ramp.way),
    }
}
