//! The place on a line where one chain takes over from another, away from bends over which a blade cannot be plunged.

use crate::geom::{Point, Vector, polyline};

/// Fraction of the tolerance by which a plunged blade may deviate from a bend.
const BOW_SHARE: f64 = 0.25;

/// Two chains that begin at a vertex and are both extended beyond it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Join {
    /// The vertex, between its neighbours.
    pub(super) about: [Point; 3],
    /// Distance by which each chain is extended beyond the place where it takes over, mm.
    pub(super) overlap: f64,
    /// Width of the blade, mm.
    pub(super) blade: f64,
    /// Permitted deviation of the tip, mm.
    pub(super) tolerance: f64,
}

impl Join {
    /// Distance behind the vertex at which the chains take over from each other, mm; negative before it. The place lies on the
    /// straight segment on one side of the bend where both blades find room; of two such segments, the one on which x changes
    /// less per length. 0 if the blade passes the bend or neither segment is long enough.
    pub(super) fn place(self) -> f64 {
        let Self { about: [before, at, behind], overlap, blade, tolerance } = self;
        // Distance of the vertex from a blade whose heel is plunged an overlap before it.
        let bow = overlap * (blade - overlap).max(0.0) / blade * polyline::turn_at(before, at, behind).sin().abs();
        if blade == 0.0 || bow <= BOW_SHARE * tolerance {
            return 0.0;
        }
        let away = overlap.max(blade - overlap);
        let ways = [(before, -away), (behind, away)].map(|(next, place)| (next - at, place));
        let roomy = ways.into_iter().filter(|(way, _)| way.norm() >= away + overlap);
        let falls = |way: &Vector| way.x.abs() / way.norm();
        roomy.min_by(|(a, _), (b, _)| falls(a).total_cmp(&falls(b))).map_or(0.0, |(_, place)| place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(before: (f64, f64), behind: (f64, f64)) -> f64 {
        let about = [before, (0.0, 0.0), behind].map(|(x, y)| Point::new(x, y));
        Join { about, overlap: 2.0, blade: 6.6, tolerance: 0.07 }.place()
    }

    #[test]
    fn chains_take_over_beside_a_bend_where_both_blades_have_room() {
        assert_eq!(place((-1.0, -30.0), (-9.0, 20.0)), -4.6);
        assert_eq!(place((-20.0, -30.0), (-1.0, 20.0)), 4.6);
        assert_eq!(place((-1.0, -5.0), (-9.0, 20.0)), 4.6);
        assert_eq!(place((-1.0, -5.0), (-3.0, 5.0)), 0.0);
        assert_eq!(place((-0.1, -30.0), (-0.1, 20.0)), 0.0);
    }
}
