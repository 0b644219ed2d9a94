//! Sound drawings on which a compile was once refused as a fault of its own: each has a program that is verified.

use std::path::Path;

use rayon::prelude::*;

use crate::support::room::{DONE, Room};

/// Drawings of `fixtures/sound` with the settings or options under which they were refused, and the habit that each shows.
const DRAWINGS: &[(&str, &str)] = &[
    ("across-loops.plt", "--cut-all"), // a line from one loop of a seam line into another
    ("along-edge.plt", "--cut-all --target=gcode"), // a slit that lies along an edge, which arcs bow away from
    ("barbs.cut", LONG_OVERLAPS),      // a long overlap along an edge and through a barb
    ("bay.cut", ""),                   // a bay narrower than the blade
    ("bends.cut", "knife.max_down_mm=100"), // a lift in a bend that is followed
    ("box-in-overlap.cut", ""),        // a wall of a box whose edge goes on nearly straight, within another part
    ("castles.cut", NO_OVERLAPS),      // overlaps of one tolerance, written with six decimals
    ("corner-on-edge.plt", "--cut-all"), // a corner on an edge that it leaves by 7 degrees
    ("crossed-earlier.plt", "--cut-all"), // two cuts beside an edge that cross before the one ends
    ("deep-end.cut", "path.tolerance_mm=0.02"), // a blade that is deepest in the part before its end
    ("dense-blob.cut", "corner.angle_deg=20"), // tight curves of points as near as their rounding
    ("dense-corners.cut", "corner.angle_deg=20"), // the same hole with corners, each side cut by one plunge
    ("dense-hole.cut", ""),            // the same around a hole narrower than the blade
    ("dense-keyhole.cut", "knife.width_mm=2 knife.back_mm=1"), // its tight curve between two corners
    ("dense-ring.cut", LONG_OVERLAPS), // a ring that is longer than the way along it
    ("edge-again.cut", ""),            // an edge of one part that another piece cuts again
    ("edge-again.dxf", ""),            // an edge on the layer of the knife that is drawn again
    ("flat-ellipse.cut", ""),          // the end of a cut in a tight curve
    ("fold-in-a-curve.dxf", ""),       // a curve that goes on over the fold
    ("inch-hole.cut", ""),             // a ring whose end must run over its start
    ("inch-nest.cut", ""),             // two cuts that end at one corner and go on the same way
    ("led-to-one-end.ggt", "knife.width_mm=8.89"), // two cuts that are led on to one place, where the drawing has neither
    ("lifted-bends.cut", "knife.max_down_mm=60"),  // a lift over one bend of a coarse circle
    ("lifted-blob.cut", "knife.max_down_mm=38"),   // lifts right before bends
    ("lifted-coarse.csv", "knife.width_mm=3 knife.back_mm=1.5 knife.max_down_mm=30"), // lifts on chords that stand for a curve
    ("lifted-ring.cut", "knife.max_down_mm=30"),                                      // lifts amid a ring
    ("lifted-slit.csv", "knife.max_down_mm=10"), // a slit that ends on a curve where the blade is plunged
    ("lifted-start.cut", "knife.max_down_mm=60"), // a ring that begins where no blade can enter it
    ("line-in-overlap.cut", OVERLAPPING),        // a line of one piece where another one, cut before, lies over it
    ("long-heel.cut", LONG_HEEL),                // a heel overlap of half a blade
    ("narrow-spike.cut", COARSE),                // a leg of a spike beside the other leg
    ("needle-corner.cut", NEEDLE_CORNER),        // a needle with a second vertex beside its tip
    ("needle-led-over.plt", ""),                 // a cut that is led over to another at the tip of a needle
    ("needle-plunged.plt", ""),                  // a needle one side of which is a plunge cut
    ("needle-tip.plt", ""),                      // cuts on both sides of a needle that meet past its tip
    ("nibbled-blob.cut", NIBBLED_BLOB),          // plunges in a hole that lie along its other side, too
    ("nibbled-dense.cut", NIBBLED_DENSE),        // plunges in the steps of a dense circle
    ("nibbled-round.cut", "c.range_deg=[-185,185]"), // a nibbled circle that ends over its start
    ("nibbled.cut", "knife.tight_curves=\"nibble\""), // a spike cut by plunges
    ("noisy-circle.cut", ""),                    // a digitised circle of 5 mm
    ("notch-of-another.cut", ""),                // a notch of a part that stands under the number of the next one
    ("open-bend.cut", "knife.width_mm=2.5 path.fit=\"polygon\""), // a start that bows away from the bend ahead
    ("part-around-a-cut-out.dxf", OVERLAPPING),  // a part over another, around a cut-out of that
    ("polygon.cut", ""),                         // edges shorter than the blade
    ("scallops.cut", COARSE), // a chord that the blade before covers and the one behind does not meet
    ("seam-out-of-part.plt", "--cut-all nest.overlap_mm=off"), // a seam line that sticks out of its part into another one
    ("slit-askew.cut", NO_OVERLAPS), // slits that lean on their edge, led on by the tolerance alone
    ("slit-coarse.csv", ""),         // slits that end on an edge whose chords stand for a curve
    ("slit-root.plt", "knife.width_mm=3 knife.back_mm=1.5"), // a slit whose edge is cut as far beside it as may be
    ("slit-there-and-back.cut", ""), // a slit inside its part, in a stroke there and back
    ("slot-overlap.cut", SLOT_OVERLAP), // an overlap that goes round the end of a slot
    ("small-holes.cut", LONG_OVERLAPS), // holes narrower than the blade with long overlaps
    ("spike.plt", "--cut-all nest.overlap_mm=off"), // a chord of 0.18 mm at the point of a spike
    ("straight-edge.cut", COARSE),   // an edge as long as the blade that bends a little
    ("stroke-there-and-back.plt", "--cut-all"), // the same in a plot
    ("tabs.cut", ""),                // a curve that begins at a reflex corner
    ("thread-between-edges.cut", ""), // a cut that ends between two edges of its neighbours, 0.2 mm apart
    ("touching-seam.plt", "--cut-all"), // a line that touches another and goes on along it
    ("two-plunges.cut", COARSE),     // a line whose last two plunges reach its end
    ("u-half-as-deep-as-wide.dxf", ""), // a notch that is half a circle
    ("u-notch.cut", "knife.reflex_front_overlap_mm=0.1"), // overlaps into the part itself
    ("u-past-edge.plt", ""),         // a notch whose stroke overshoots its edge
];
const NO_OVERLAPS: &str =
    "knife.front_overlap_mm=0 knife.corner_front_overlap_mm=0 knife.heel_overlap_mm=0 knife.corner_heel_overlap_mm=0";
const LONG_OVERLAPS: &str =
    "knife.front_overlap_mm=3 knife.corner_front_overlap_mm=3 knife.heel_overlap_mm=3 knife.corner_heel_overlap_mm=3";
const OVERLAPPING: &str = "nest.overlap_mm=off";
const COARSE: &str = "path.tolerance_mm=0.3";
const LONG_HEEL: &str = "knife.corner_heel_overlap_mm=3 path.tolerance_mm=0.15 nest.band_mm=0.3";
const NEEDLE_CORNER: &str = "knife.width_mm=8 knife.back_mm=4 corner.angle_deg=20 knife.tight_curves=\"nibble\"";
const NIBBLED_BLOB: &str = "knife.width_mm=5 knife.back_mm=2.5 corner.angle_deg=40 knife.tight_curves=\"nibble\"";
const NIBBLED_DENSE: &str = "knife.width_mm=1.5 knife.back_mm=1.125 knife.tight_curves=\"nibble\"";
const SLOT_OVERLAP: &str = "knife.width_mm=5 knife.back_mm=3.75 knife.front_overlap_mm=3";

#[test]
fn every_sound_drawing_has_a_program_that_is_verified() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/sound");
    let entries = std::fs::read_dir(&folder).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    assert_eq!(names, DRAWINGS.iter().map(|(name, _)| *name).collect::<Vec<_>>(), "each drawing has its row");
    DRAWINGS.par_iter().for_each(|(name, settings)| {
        let room = Room::new();
        room.write(name, &std::fs::read(folder.join(name)).expect("readable"));
        let argument = |word: &str| if word.starts_with("--") { format!(" {word}") } else { format!(" --set {word}") };
        let settings: String = settings.split_whitespace().map(argument).collect();
        let program = if settings.contains("gcode") { "program.ngc" } else { "program.csv" };
        room.expect(&format!("compile {name} -o {program}{settings}"), DONE);
        let said = room.text(&format!("{program}.meta.json"));
        assert!(said.contains("\"verified\": \"yes\""), "{name}: {said}");
    });
}
