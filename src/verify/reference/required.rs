//! Required cuts as a whole, for verifiers of programs that divide them differently than a cutter does.

use super::lines::{Reference, of_cuts};
use crate::geom::Point;
use crate::ir::Marker;
use crate::machine::MachineProfile;

/// Required cuts of a marker by its contours and notches, derived as for a cutter's programs.
#[derive(Debug, Clone, PartialEq)]
pub struct Required {
    /// All required cuts.
    pub cuts: Vec<RequiredCut>,
    /// Edges, mm, of parts that share cuts with others: each lies beside a cut.
    pub edges: Vec<Vec<Point>>,
    /// Greatest distance of an edge from its cut, mm.
    pub common: f64,
}

/// Line that must be cut.
#[derive(Debug, Clone, PartialEq)]
pub struct RequiredCut {
    /// Points, mm; a closed line ends with its first point.
    pub points: Vec<Point>,
    /// True if the line ends at its start.
    pub closed: bool,
    /// Source blocks, ascending.
    pub blocks: Vec<u32>,
    /// Speed caps of the tip along the line, in order.
    pub caps: Vec<Capped>,
    /// Corners at which the knife is lifted, mm from the start, in order; with any corner, the start of a closed line is one.
    pub corners: Vec<f64>,
    /// True if contours and notches require the cut; false for a cut that the marker adds for edges of several parts.
    pub drawn: bool,
}

/// Speed cap of the tip along a stretch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capped {
    /// End of the stretch, mm from the start of the cut.
    pub to: f64,
    /// Caps with the cut and against it, mm/s; infinite without a cap.
    pub speeds: [f64; 2],
}

/// Required cuts of a marker.
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
            // The next stretch of the same cut begins at the end of the previous one.
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
