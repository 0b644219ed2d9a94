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
    /// Whether contours and notches themselves say that it is cut; else the marker does, for edges of several parts.
    pub drawn: bool,
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
        if last == Some(line.cut.index) {
            // The next stretch of the same cut begins where the one before it ends.
            let cut = cuts.last_mut().expect("a line came before");
            cut.points.extend(line.points().skip(1));
            cut.blocks.extend(blocks);
        } else {
            let piece = line.piece as usize;
            let drawn = !shared[piece] || of_pieces[piece].slits.contains(&i);
            let closed = line.cut.round.is_some();
            cuts.push(RequiredCut { points: line.points().collect(), closed, blocks: blocks.collect(), drawn });
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
