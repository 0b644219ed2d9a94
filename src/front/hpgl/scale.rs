//! Conversion of file coordinates to plotter units: SC between the corners P1 and P2 of IP or IR, and RO.

/// A point or a vector, in units of the file or of the plotter.
pub(super) type Pair = [f64; 2];

/// Mapping of numbers to positions.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Frame {
    /// The corners P1 and P2, in plotter units.
    corners: [Pair; 2],
    /// True if the file gives the distance between the corners; otherwise it depends on the plotter.
    are_corners_given: bool,
    /// Size of the page (PS), in plotter units.
    page: Option<Pair>,
    /// The ranges of SC in force; `None` if numbers are plotter units.
    ranges: Option<Ranges>,
    /// Scale from the ranges and the corners.
    scale: Option<Scale>,
    /// Quarter turns of RO, counter-clockwise.
    quarters: u8,
}

/// Values of SC. They remain valid for later corners: a plotter moves and stretches the picture with them. (Hewlett-Packard,
/// "HP-GL/2 and HP RTL Reference Guide", IP and SC.)
#[derive(Debug, Clone, Copy, PartialEq)]
struct Ranges {
    x: [f64; 2],
    y: [f64; 2],
    kind: f64,
    /// Position of the picture in the space left over by equal scales: 0 = left and bottom, 1 = right and top.
    share: Pair,
}

/// A scale: `offset + number * factor`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Scale {
    offset: Pair,
    factor: Pair,
}

/// A value that depends on the plotter, or is unusable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Unknown {
    /// SC without IP or IR: the corners depend on the plotter.
    Corners,
    /// IR without PS.
    Page,
    /// A scale from or to an empty range.
    Range,
    /// SC with fewer than four numbers, or IP or IR with one or three.
    Incomplete,
    /// RO by an angle other than quarter turns.
    Angle,
    /// Different scales of X and Y.
    Uneven,
}

/// Percent.
const HUNDRED: f64 = 100.0;
/// Corners of a plotter for A4 paper, in units of 1/40 mm, used if the file gives none (HP 7475A).
const USUAL_CORNERS: [Pair; 2] = [[250.0, 596.0], [10_250.0, 7796.0]];
/// Greatest difference of the scales of the two axes, as a share of the lesser: a calibration makes less.
const MOST_UNEVEN: f64 = 0.01;
/// Kinds of SC: equal scales on both axes, and factors instead of ranges.
const ISOTROPIC: f64 = 1.0;
const FACTORS: f64 = 2.0;

impl Frame {
    /// The power-on state.
    pub(super) const fn new() -> Self {
        Self { corners: USUAL_CORNERS, are_corners_given: false, page: None, ranges: None, scale: None, quarters: 0 }
    }

    /// IN: reset, except the page size.
    pub(super) fn reset(&mut self) {
        *self = Self { page: self.page, ..Self::new() };
    }

    /// DF: the scale ends; corners, page and rotation stay.
    pub(super) fn set_default(&mut self) {
        (self.ranges, self.scale) = (None, None);
    }

    /// True if numbers are plotter units.
    pub(super) fn is_plain(&self) -> bool {
        self.scale.is_none()
    }

    /// IP: P1 and P2. P1 alone moves the box; no values restore the default box.
    pub(super) fn set_corners(&mut self, values: &[f64]) -> Result<(), Unknown> {
        let [p1, p2] = self.corners;
        match *values {
            [] => (self.corners, self.are_corners_given) = (USUAL_CORNERS, false),
            [x1, y1, x2, y2, ..] => (self.corners, self.are_corners_given) = ([[x1, y1], [x2, y2]], true),
            [x1, y1] => self.corners = [[x1, y1], [x1 + p2[0] - p1[0], y1 + p2[1] - p1[1]]],
            [_] | [_, _, _] => return Err(Unknown::Incomplete),
        }
        self.ranges.map_or(Ok(()), |ranges| self.put(ranges))
    }

    /// IR: P1 and P2 in percent of the page.
    pub(super) fn set_corners_percent(&mut self, values: &[f64]) -> Result<(), Unknown> {
        if values.is_empty() {
            return self.set_corners(values);
        }
        let [length, width] = self.page.ok_or(Unknown::Page)?;
        let units: arrayvec::ArrayVec<f64, 4> = values
            .iter()
            .take(4)
            .zip([length, width].into_iter().cycle())
            .map(|(v, size)| v / HUNDRED * size)
            .collect();
        self.set_corners(&units)
    }

    /// PS: length, then width; a single number sets both.
    pub(super) fn set_page(&mut self, values: &[f64]) {
        self.page = match *values {
            [length, width, ..] => Some([length, width]),
            [length] => Some([length, length]),
            [] => None,
        };
    }

    /// RO, degrees. Angles other than quarter turns are ignored, as by plotters, and reported by the error.
    pub(super) fn rotate(&mut self, values: &[f64]) -> Result<(), Unknown> {
        self.quarters = match values.first().copied().unwrap_or(0.0) {
            0.0 | 360.0 => 0,
            90.0 => 1,
            180.0 => 2,
            270.0 => 3,
            _ => return Err(Unknown::Angle),
        };
        Ok(())
    }

    /// SC: ranges between the corners; an error if they give the drawing no size.
    pub(super) fn set_scale(&mut self, values: &[f64]) -> Result<(), Unknown> {
        let [x0, x1, y0, y1, ..] = *values else {
            (self.ranges, self.scale) = (None, None);
            return if values.is_empty() { Ok(()) } else { Err(Unknown::Incomplete) };
        };
        let kind = values.get(4).copied().unwrap_or(0.0);
        // The default is half of the remaining space.
        let share = [values.get(5), values.get(6)].map(|p| p.copied().unwrap_or(HUNDRED / 2.0) / HUNDRED);
        self.put(Ranges { x: [x0, x1], y: [y0, y1], kind, share })
    }

    /// Applies ranges to the corners. On an error the previous ones stay in force.
    fn put(&mut self, ranges: Ranges) -> Result<(), Unknown> {
        let Ranges { x: [x0, x1], y: [y0, y1], kind, share } = ranges;
        let [p1, p2] = self.corners;
        let (mut offset, mut factor) = (p1, [x1, y1]);
        if kind == FACTORS {
            if x1 == 0.0 || y1 == 0.0 {
                return Err(Unknown::Range);
            }
        } else {
            if x0 == x1 || y0 == y1 || p1[0] == p2[0] || p1[1] == p2[1] {
                return Err(Unknown::Range);
            }
            factor = [(p2[0] - p1[0]) / (x1 - x0), (p2[1] - p1[1]) / (y1 - y0)];
            if kind == ISOTROPIC {
                let least = factor[0].abs().min(factor[1].abs());
                for (axis, range) in [x1 - x0, y1 - y0].into_iter().enumerate() {
                    let size = least.copysign(factor[axis]) * range;
                    offset[axis] += (p2[axis] - p1[axis] - size) * share[axis];
                    factor[axis] = least.copysign(factor[axis]);
                }
            }
        }
        let offset = [offset[0] - x0 * factor[0], offset[1] - y0 * factor[1]];
        (self.ranges, self.scale) = (Some(ranges), Some(Scale { offset, factor }));
        Ok(())
    }

    /// True if the size of the drawing depends on the plotter: a scale between corners that the file does not give. With
    /// factors only the position depends on the corners.
    pub(super) fn is_left_to_device(&self) -> bool {
        !self.are_corners_given && self.ranges.is_some_and(|ranges| ranges.kind != FACTORS)
    }

    /// Factors of the axes if they differ more than a calibration makes them: an unequal pair stretches the parts.
    pub(super) fn uneven(&self) -> Option<Pair> {
        let Scale { factor: [x, y], .. } = self.scale.filter(|_| !self.is_left_to_device())?;
        let [x, y] = [x.abs(), y.abs()];
        ((x - y).abs() > MOST_UNEVEN * x.min(y)).then_some([x, y])
    }

    /// Distortion of circles by the scale.
    pub(super) fn stretch(&self) -> Stretch {
        self.scale.map_or(Stretch::NONE, |Scale { factor: [x, y], .. }| {
            let greater = x.abs().max(y.abs());
            Stretch([x / greater, y / greater])
        })
    }

    /// Converts a point to plotter units, before RO.
    pub(super) fn place(&self, [x, y]: Pair) -> Pair {
        match self.scale {
            None => [x, y],
            Some(Scale { offset, factor }) => [offset[0] + x * factor[0], offset[1] + y * factor[1]],
        }
    }

    /// Converts a vector to plotter units, before RO.
    pub(super) fn way(&self, [x, y]: Pair) -> Pair {
        match self.scale {
            None => [x, y],
            Some(Scale { factor, .. }) => [x * factor[0], y * factor[1]],
        }
    }

    /// Applies RO to a point: rotates about the origin, then shifts the known page back to the origin.
    pub(super) fn turned(&self, [x, y]: Pair) -> Pair {
        let [length, width] = self.page.unwrap_or([0.0, 0.0]);
        match self.quarters {
            1 => [length - y, x],
            2 => [length - x, width - y],
            3 => [y, width - x],
            _ => [x, y],
        }
    }

    /// Inverse of [`Frame::turned`].
    pub(super) fn turned_back(&self, [x, y]: Pair) -> Pair {
        let [length, width] = self.page.unwrap_or([0.0, 0.0]);
        match self.quarters {
            1 => [y, length - x],
            2 => [length - x, width - y],
            3 => [width - y, x],
            _ => [x, y],
        }
    }

    /// True if RO rotates the drawing.
    pub(super) fn is_turned(&self) -> bool {
        self.quarters != 0
    }
}

/// Length of a unit of a circle along each axis of the plotter: at most 1, negative on a mirrored axis. A deviation from the
/// circle is therefore never enlarged on the ellipse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stretch(pub(super) Pair);

impl Stretch {
    /// No distortion.
    pub(super) const NONE: Self = Self([1.0, 1.0]);

    /// The vector between two plotter positions before the stretch.
    pub(super) fn undone(self, from: Pair, to: Pair) -> Pair {
        [(to[0] - from[0]) / self.0[0], (to[1] - from[1]) / self.0[1]]
    }

    /// Factor by which rounding errors are enlarged along the axis with the smaller scale.
    pub(super) fn unevenness(self) -> f64 {
        1.0 / self.0[0].abs().min(self.0[1].abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(corners: &[f64], scale: &[f64], place: Pair, expected: Pair) {
        let mut frame = Frame::new();
        assert_eq!(frame.set_corners(corners), Ok(()));
        assert_eq!(frame.set_scale(scale), Ok(()));
        assert_eq!(frame.place(place), expected, "{corners:?} {scale:?}");
    }

    #[test]
    fn ranges_lie_between_the_corners() {
        check(&[0.0, 0.0, 4000.0, 2000.0], &[0.0, 100.0, 0.0, 100.0], [50.0, 50.0], [2000.0, 1000.0]);
        check(&[100.0, 200.0, 4100.0, 2200.0], &[10.0, 110.0, 0.0, 100.0], [10.0, 0.0], [100.0, 200.0]);
        check(&[0.0, 0.0, 4000.0, 2000.0], &[0.0, 100.0, 0.0, 100.0, 1.0], [0.0, 0.0], [1000.0, 0.0]);
        check(&[0.0, 0.0, 4000.0, 2000.0], &[0.0, 100.0, 0.0, 100.0, 1.0, 0.0, 0.0], [100.0, 100.0], [2000.0, 2000.0]);
        check(&[0.0, 0.0, 4000.0, 2000.0], &[5.0, 2.0, 5.0, 3.0, 2.0], [6.0, 6.0], [2.0, 3.0]);
        check(&[0.0, 0.0, 4000.0, 2000.0], &[0.0, 100.0, 100.0, 0.0], [0.0, 0.0], [0.0, 2000.0]);
        check(&[0.0, 0.0, 4000.0, 2000.0], &[], [7.0, 8.0], [7.0, 8.0]);
    }

    #[test]
    fn what_depends_on_the_device_is_told() {
        let mut frame = Frame::new();
        assert_eq!(frame.set_scale(&[0.0, 1.0, 0.0, 1.0]), Ok(()));
        assert!(frame.is_left_to_device());
        assert_eq!(frame.set_corners_percent(&[0.0, 0.0, 50.0, 50.0]), Err(Unknown::Page));
        frame.set_page(&[4000.0, 2000.0]);
        assert_eq!(frame.set_corners_percent(&[0.0, 0.0, 50.0, 50.0]), Ok(()));
        assert_eq!(frame.set_scale(&[0.0, 1.0, 0.0, 1.0]), Ok(()));
        assert_eq!(frame.place([1.0, 1.0]), [2000.0, 1000.0]);
        assert!(!frame.is_left_to_device());
        assert_eq!(frame.set_scale(&[0.0, 0.0, 0.0, 1.0]), Err(Unknown::Range));
        assert_eq!(frame.set_corners(&[0.0, 0.0, 0.0, 4000.0]), Err(Unknown::Range));
        assert_eq!(frame.set_scale(&[0.0, 1.0, 0.0, 1.0]), Err(Unknown::Range));
        assert_eq!(frame.place([1.0, 1.0]), [2000.0, 1000.0]);
    }

    #[test]
    fn a_scale_moves_and_stretches_with_the_corners_that_follow_it() {
        let mut frame = Frame::new();
        frame.set_page(&[4000.0, 2000.0]);
        assert_eq!(frame.set_scale(&[0.0, 100.0, 0.0, 100.0]), Ok(()));
        for (corners, place) in [
            (&[0.0, 0.0, 4000.0, 2000.0][..], [2000.0, 1000.0]),
            (&[0.0, 0.0, 8000.0, 8000.0], [4000.0, 4000.0]),
            (&[100.0, 200.0], [4100.0, 4200.0]),
        ] {
            assert_eq!(frame.set_corners(corners), Ok(()));
            assert_eq!(frame.place([50.0, 50.0]), place, "{corners:?}");
        }
        assert_eq!(frame.set_corners_percent(&[0.0, 0.0, 50.0, 50.0]), Ok(()));
        assert_eq!(frame.place([50.0, 50.0]), [1000.0, 500.0]);
        assert_eq!(frame.set_corners(&[]), Ok(()));
        assert!(frame.is_left_to_device());
        frame.set_default();
        assert_eq!(frame.set_corners(&[0.0, 0.0, 8000.0, 8000.0]), Ok(()));
        assert_eq!(frame.place([50.0, 50.0]), [50.0, 50.0]);
    }

    #[test]
    fn what_is_broken_is_told_and_changes_nothing() {
        let mut frame = Frame::new();
        for broken in [&[1.0][..], &[1.0, 2.0, 3.0]] {
            assert_eq!(frame.set_corners(broken), Err(Unknown::Incomplete));
            assert_eq!(frame.set_scale(broken), Err(Unknown::Incomplete));
        }
        assert_eq!(frame.rotate(&[45.0]), Err(Unknown::Angle));
        assert_eq!(frame, Frame::new());
        // P1 alone moves the box of the plotter, whose size is unknown.
        assert_eq!(frame.set_corners(&[0.0, 0.0]), Ok(()));
        assert_eq!(frame.set_scale(&[0.0, 1.0, 0.0, 1.0]), Ok(()));
        assert!(frame.is_left_to_device());
    }

    #[test]
    fn a_default_keeps_corners_and_turn_and_ends_the_scale() {
        let mut frame = Frame::new();
        assert_eq!(frame.set_corners(&[0.0, 0.0, 400.0, 400.0]), Ok(()));
        assert_eq!(frame.set_scale(&[0.0, 1.0, 1.0, 0.0]), Ok(()));
        assert_eq!(frame.stretch(), Stretch([1.0, -1.0]));
        frame.set_default();
        assert!(frame.is_plain() && frame.stretch() == Stretch::NONE);
        assert_eq!(frame.set_scale(&[0.0, 1.0, 0.0, 1.0]), Ok(()));
    }

    #[test]
    fn a_turned_page_stays_at_the_origin() {
        let mut frame = Frame::new();
        assert_eq!(frame.rotate(&[90.0]), Ok(()));
        assert_eq!(frame.turned([3.0, 1.0]), [-1.0, 3.0]);
        frame.set_page(&[40.0, 20.0]);
        assert_eq!(frame.turned([3.0, 1.0]), [39.0, 3.0]);
        assert_eq!(frame.rotate(&[180.0]), Ok(()));
        assert_eq!(frame.turned([3.0, 1.0]), [37.0, 19.0]);
    }

    #[test]
    fn a_place_that_is_turned_and_turned_back_is_the_same() {
        for page in [&[][..], &[40.0, 20.0]] {
            for degrees in [0.0, 90.0, 180.0, 270.0] {
                let mut frame = Frame::new();
                frame.set_page(page);
                assert_eq!(frame.rotate(&[degrees]), Ok(()));
                assert_eq!(frame.turned_back(frame.turned([3.0, 1.0])), [3.0, 1.0], "{degrees} {page:?}");
            }
        }
    }
}
