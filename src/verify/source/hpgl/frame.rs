//! Coordinate system of a plot: scale, corners, page and rotation.

use super::scan::{Place, Scan};

/// Default corners of the scale, in units of the file.
const CORNERS: [f64; 4] = [250.0, 596.0, 10_250.0, 7796.0];

impl Scan<'_> {
    /// Executes scale, corners, page and rotation. The pen keeps its place on the table.
    pub(super) fn frame(&mut self, mnemonic: [u8; 2], numbers: &[f64]) {
        let on_table = self.turned(self.pen.at);
        self.set_frame(mnemonic, numbers);
        if self.turned(self.pen.at) != on_table {
            self.pen.at = self.turned_back(on_table);
        }
    }

    /// Place after the quarter turns about the origin and the shift that brings the page back to it.
    pub(super) fn turned(&self, place: Place) -> Place {
        let [x, y] = (0..self.quarters).fold(place, |[x, y], _| [-y, x]);
        let [dx, dy] = self.way_back();
        [x + dx, y + dy]
    }

    fn turned_back(&self, [x, y]: Place) -> Place {
        let [dx, dy] = self.way_back();
        (0..self.quarters).fold([x - dx, y - dy], |[x, y], _| [y, -x])
    }

    fn way_back(&self) -> Place {
        let [length, width] = self.page.unwrap_or_default();
        [[0.0, 0.0], [length, 0.0], [length, width], [0.0, width]][usize::from(self.quarters)]
    }

    fn set_frame(&mut self, mnemonic: [u8; 2], numbers: &[f64]) {
        let set_corners = |scan: &mut Self, numbers: &[f64]| {
            let [a, b, c, d] = scan.corners.unwrap_or(CORNERS);
            scan.corners = match *numbers {
                [] => None,
                [x1, y1, x2, y2, ..] => Some([x1, y1, x2, y2]),
                [x, y] => Some([x, y, x + c - a, y + d - b]),
                _ => scan.corners,
            };
            scan.rescale();
        };
        match (&mnemonic, numbers) {
            (b"IP", numbers) => set_corners(self, numbers),
            (b"IR", []) => set_corners(self, &[]),
            (b"IR", numbers) => {
                if let Some(page) = self.page {
                    let part = |(i, percent): (usize, &f64)| percent / 100.0 * page[i % 2];
                    let units: Vec<f64> = numbers.iter().take(4).enumerate().map(part).collect();
                    set_corners(self, &units);
                }
            }
            (b"PS", numbers) => self.page = numbers.first().map(|&x| [x, numbers.get(1).copied().unwrap_or(x)]),
            (b"RO", numbers) => {
                let degrees = numbers.first().copied().unwrap_or(0.0);
                let quarters = [0.0, 90.0, 180.0, 270.0, 360.0].iter().position(|&d| d == degrees);
                self.quarters = quarters.map_or(self.quarters, |quarters| quarters as u8 % 4);
            }
            (b"SC", &[x0, x1, y0, y1, ref kind @ ..]) if self.set_scale([x0, x1, y0, y1], kind) => {
                self.ranges = numbers.to_vec();
            }
            (b"SC", &[_, _, _, _, ..]) => {}
            (b"SC", _) => self.scale = None,
            _ => {}
        }
    }

    /// Computes the scale again for changed corners.
    fn rescale(&mut self) {
        let ranges = std::mem::take(&mut self.ranges);
        if let (Some(_), [x0, x1, y0, y1, kind @ ..]) = (self.scale, &ranges[..]) {
            self.set_scale([*x0, *x1, *y0, *y1], kind);
        }
        self.ranges = ranges;
    }

    /// Sets a scale; `false` if it is invalid, and the previous one remains.
    fn set_scale(&mut self, [x0, x1, y0, y1]: [f64; 4], kind: &[f64]) -> bool {
        let [a, b, c, d] = self.corners.unwrap_or(CORNERS);
        let mut factor = [(c - a) / (x1 - x0), (d - b) / (y1 - y0)];
        let mut least = [a, b];
        match kind.first() {
            Some(2.0) if x1 == 0.0 || y1 == 0.0 => return false,
            Some(2.0) => factor = [x1, y1],
            _ if x0 == x1 || y0 == y1 || a == c || b == d => return false,
            Some(1.0) => {
                let equal = factor[0].abs().min(factor[1].abs());
                let spare = [(c - a) * (1.0 - equal / factor[0].abs()), (d - b) * (1.0 - equal / factor[1].abs())];
                for axis in 0..2 {
                    least[axis] += spare[axis] * kind.get(axis + 1).copied().unwrap_or(50.0) / 100.0;
                    factor[axis] = equal * factor[axis].signum();
                }
            }
            _ => {}
        }
        self.scale = Some([[least[0] - x0 * factor[0], least[1] - y0 * factor[1]], factor]);
        true
    }
}
