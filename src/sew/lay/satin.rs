//! Satin between two rails: stitches from rail to rail, which advance evenly from rung to rung.

use crate::geom::Point;

/// Needle points of a satin. Its points alternate between both rails: each two of them are a rung. No stitch advances by more
/// than `pitch` along the longer rail.
pub(super) fn satin(points: &[Point], pitch: f64) -> Vec<Point> {
    let (rungs, _) = points.as_chunks::<2>();
    let Some(&[first, _]) = rungs.first() else { return Vec::new() };
    let mut out = vec![first];
    for pair in rungs.windows(2) {
        let rails = [0, 1].map(|side| (pair[0][side], pair[1][side]));
        let longest = rails.map(|(from, to)| (to - from).norm()).into_iter().fold(0.0, f64::max);
        let count = (longest / pitch).ceil().max(1.0) as usize;
        for i in 1..=count {
            let (from, to) = rails[out.len() % 2];
            out.push(from + (to - from) * (i as f64 / count as f64));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_satin_goes_from_rail_to_rail_and_fans_out_in_a_curve() {
        let points = [[0.0, 0.0], [0.0, 2.0], [1.0, 0.0], [2.0, 2.0]].map(|[x, y]| Point::new(x, y));
        let laid: Vec<[f64; 2]> = satin(&points, 0.5).iter().map(|point| [point.x, point.y]).collect();
        assert_eq!(laid, [[0.0, 0.0], [0.5, 2.0], [0.5, 0.0], [1.5, 2.0], [1.0, 0.0]]);
    }
}
