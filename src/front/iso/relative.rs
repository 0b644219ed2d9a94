//! Relative coordinates: G91 asks for them in most controllers, and names a unit in cut files.

use crate::diagnostic::{Diagnostic, code};
use crate::geom::{Point, Vector};
use crate::ir::Marker;

/// Least number of places behind the start of a line that returns to it: three sides of an outline.
const LEAST_PLACES: usize = 3;
/// Largest sum of the moves of a closed outline, in units of the file: each may be rounded.
const ROUNDED: f64 = 2.0;

/// The finding on a file in which no line ends where it starts, but each one would if its places were moves.
pub(super) fn finding(marker: &Marker) -> Option<Diagnostic> {
    let lines = || marker.contours().map(|(_, contour)| contour);
    if lines().any(|contour| contour.closed) {
        return None; // the usual case
    }
    let returns = |points: &[Point]| {
        let sum = points.iter().skip(1).fold(Vector::zeros(), |sum, point| sum + point.coords);
        points.len() > LEAST_PLACES && sum.norm() <= ROUNDED * marker.unit
    };
    let mut long = lines().filter(|contour| marker.list.points(contour.range).len() > 2).peekable();
    let first = marker.list.spans(long.peek()?.range).first().copied()?;
    if !long.all(|contour| returns(&marker.list.points(contour.range))) {
        return None;
    }
    let message = "the places look like moves, and relative coordinates are not read";
    let finding = Diagnostic::new(&code::ISO_RELATIVE, message).at(first);
    Some(finding.hint("let the CAD write absolute coordinates (G90): in cut files G91 is the unit 0.254 mm"))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Diagnostics;
    use crate::machine::Job;
    use crate::machine::profile::CodeUse;
    use crate::source::Source;

    fn is_told(file: &str, ignored: Option<&str>) -> bool {
        let source = Source::new("a", file.as_bytes().to_vec()).expect("small");
        let (mut job, mut out) = (Job::default(), Diagnostics::default());
        job.profile.codes.extend(ignored.map(|name| (name.to_owned(), CodeUse::Ignore)));
        crate::front::iso::lower::lower(&source, &job, &mut out);
        out.iter().any(|finding| finding.code.name == "iso/relative-coordinates")
    }

    #[test]
    fn moves_that_close_are_told_from_places() {
        let moves = "G71*G91*N1*X1000Y1000*M14*X5000Y0*X0Y3000*X-5000Y0*X0Y-3000*M15*M0*";
        assert!(is_told(moves, None) && is_told(moves, Some("G91")));
        for places in [
            "G91*N1*X1000Y1000*M14*X6000Y1000*X6000Y4000*X1000Y4000*X1000Y1000*M15*M0*",
            "G91*N1*X1000Y1000*M14*X5000Y0*X0Y3000*X-5000Y0*X0Y-2000*M15*M0*",
            "G91*N1*X1000Y1000*M14*X5000Y0*X-5000Y0*M15*M0*",
        ] {
            assert!(!is_told(places, None), "{places}");
        }
    }
}
