//! What must be cut, whole, for judges of programs that part it otherwise than a cutter does.

use super::lines::{Reference, of_cuts};
use crate::geom::Point;
use crate::ir::Marker;
use crate::machine::MachineProfile;

/// What must be cut of a marker, as contours and notches say, found anew as for a cutter's programs.
#[derive(Debug, Clone, PartialEq)]
pub struct Required {
    /// Everything that must be cut.
    pub cuts: Vec<RequiredCut>,
    /// The edges, mm, of parts that are cut together with others': each lies beside a cut.
    pub edges: Vec<Vec<Point>>,
    /// How far beside it that may be, mm.
    pub common: f64,
}

/// A line that must be cut.
#[derive(Debug, Clone, PartialEq)]
pub struct RequiredCut {
    /// Its points, mm; a closed one ends with its first.
    pub points: Vec<Point>,
    /// Whether it ends where it starts.
    pub closed: bool,
    /// The source blocks that it comes from, in rising order.
    pub blocks: Vec<u32>,
    /// How fast the tip may go along it, in order.
    pub caps: Vec<Capped>,
    /// Where the knife is lifted at a corner of it, mm from its start, in order; the start of a closed one is one of these where
    /// there is any.
    pub corners: Vec<f64>,
    /// Whether contours and notches themselves say that it is cut; else the marker does, for edges of several parts.
    pub drawn: bool,
}

/// How fast the tip may go along a stretch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capped {
    /// Where it ends, mm from the start of the cut.
    pub to: f64,
    /// With the cut and against it, mm/s; infinite where nothing caps the tip.
    pub speeds: [f64; 2],
}

/// What must be cut of a marker.
pub fn required(marker: &Marker, profile: &MachineProfile) -> Required {
    let Reference { lines, of_pieces, open, common, .. } = Reference::new(marker, profile);
    let shared: Vec<bool> = (0..marker.pieces.len()).map(|piece| of_cuts(piece, marker).is_some()).collect();
    let (mut cuts, mut edges): (Vec<RequiredCut>, Vec<Vec<Point>>) = (Vec::new(), Vec::new());
    let mut last = None;
    for (i, line) in lines.iter().enumerate() {
        if line.cut.is_edge {
            edges.push(line.points().collect());
            continue;
        }
        let blocks = (0..line.chords()).map(|chord| line.block(chord));
        let caps = |from: f64| line.caps().into_iter().map(move |(to, speeds)| Capped { to: from + to, speeds });
        if last == Some(line.cut.index) {
            // The next stretch of the same cut begins where the one before it ends.
            let cut = cuts.last_mut().expect("a line came before");
            cut.points.extend(line.points().skip(1));
            cut.blocks.extend(blocks);
            let from = cut.caps.last().map_or(0.0, |last| last.to);
            cut.corners.push(from);
            cut.caps.extend(caps(from));
        } else {
            let piece = line.piece as usize;
            let drawn = !shared[piece] || of_pieces[piece].slits.contains(&i);
            let closed = line.cut.round.is_some();
            let (points, blocks, caps) = (line.points().collect(), blocks.collect(), caps(0.0).collect());
            let corners = if closed && !line.ring { vec![0.0] } else { Vec::new() };
            cuts.push(RequiredCut { points, closed, blocks, caps, corners, drawn });
        }
        last = Some(line.cut.index);
    }
    for cut in &mut cuts {
        cut.blocks.sort_unstable();
        cut.blocks.dedup();
    }
    edges.extend(open.iter().map(|drawn| drawn.ends.to_vec()));
    Required { cuts, edges, common }
}
