//! The plan: which head stands in which row and cuts what, when, at which speed of the conveyor.

use serde::Serialize;

use crate::flow::Figures;
use crate::flow::program::Program;
use crate::ir::Marker;
use crate::machine::MachineProfile;
use crate::units::MS_PER_S;

/// A plan.
#[derive(Debug, Serialize)]
pub struct Plan {
    /// Speed of the conveyor.
    pub speed_mm_s: f64,
    /// Time between two setpoints.
    pub period_ms: f64,
    /// Rows of setpoints that every head has.
    pub rows_of_setpoints: u64,
    /// What the machine can do, as it was planned with.
    pub limits: Limits,
    /// What is known of the plan.
    pub figures: Figures,
    /// The heads.
    pub heads: Vec<PlanHead>,
    /// Files that show the plan.
    pub pictures: Vec<File>,
}

/// What the machine can do.
#[derive(Debug, Serialize)]
pub struct Limits {
    /// Of a head along the feed.
    pub travel_mm: f64,
    /// Room of a head across the feed.
    pub head_width_mm: f64,
    /// Of each head where another takes over.
    pub overlap_mm: f64,
    /// Heads that there are.
    pub heads: u32,
    /// Rows that there are.
    pub rows: u32,
}

/// A head in a plan.
#[derive(Debug, Serialize)]
pub struct PlanHead {
    /// Its number, from 1.
    pub head: usize,
    /// Its row, from 1.
    pub row: usize,
    /// Where that stands, from the origin of the marker.
    pub station_mm: f64,
    /// The files with its program.
    pub files: Vec<File>,
    /// What it cuts, in order.
    pub chains: Vec<Planned>,
}

/// A file of a plan.
#[derive(Debug, Serialize)]
pub struct File {
    /// Its name.
    pub file: String,
    /// Digest of its bytes.
    pub blake3: String,
}

/// A chain in a plan.
#[derive(Debug, Serialize)]
pub struct Planned {
    /// The number of the piece.
    pub piece: u32,
    /// The cut, from 1, in the order of the marker.
    pub cut: u32,
    /// Its first and its last block.
    pub blocks: [u32; 2],
    /// Greatest and least place along the feed.
    pub x_mm: [f64; 2],
    /// Length.
    pub length_mm: f64,
    /// When the knife goes down first and comes up last.
    pub time_s: [f64; 2],
    /// Where the head is along the feed at these times, from its station.
    pub along_mm: [f64; 2],
    /// Travel along the feed that it takes, its ramps included.
    pub travel_mm: f64,
}

/// The plan of a program whose heads have no files yet.
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
