//! Viewports: fitting a view box into its area (SVG 2, 8.2).

use svgtypes::{Align, AspectRatio};

use super::scan::Scan;
use super::transform::Pair;
use crate::geom::Vector;
use crate::geom::affine::Affine;

/// A view box: its corner and its size, in units of the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ViewBox {
    pub(super) at: Pair,
    pub(super) size: Pair,
}

impl ViewBox {
    /// Parses four numbers with a positive size; `None` for anything else.
    pub(super) fn read(text: &str) -> Option<Self> {
        let mut scan = Scan::of(text.trim());
        let mut number = || {
            let number = scan.number();
            scan.pass_separator();
            number
        };
        let (at, size) = ([number()?, number()?], [number()?, number()?]);
        (scan.is_at_end() && size.iter().all(|&size| size > 0.0)).then_some(Self { at, size })
    }
}

/// The map from a view box to an area of a given size with its corner at the origin; `None` if the rule is malformed.
pub(super) fn fit(view: ViewBox, size: Pair, rule: Option<&str>) -> Option<Affine> {
    let rule = rule.map(str::trim).filter(|rule| !rule.is_empty());
    let plain = AspectRatio { defer: false, align: Align::XMidYMid, slice: false };
    let AspectRatio { align, slice, .. } = rule.map_or(Some(plain), |rule| rule.parse().ok())?;
    let [x, y] = [0, 1].map(|axis| size[axis] / view.size[axis]);
    let uniform = if slice { x.max(y) } else { x.min(y) };
    let scale = if align == Align::None { [x, y] } else { [uniform; 2] };
    let free = [0, 1].map(|axis| size[axis] - view.size[axis] * scale[axis]);
    let shares = match align {
        Align::None | Align::XMinYMin => [0.0, 0.0],
        Align::XMidYMin => [0.5, 0.0],
        Align::XMaxYMin => [1.0, 0.0],
        Align::XMinYMid => [0.0, 0.5],
        Align::XMidYMid => [0.5, 0.5],
        Align::XMaxYMid => [1.0, 0.5],
        Align::XMinYMax => [0.0, 1.0],
        Align::XMidYMax => [0.5, 1.0],
        Align::XMaxYMax => [1.0, 1.0],
    };
    let moved = [0, 1].map(|axis| free[axis] * shares[axis] - view.at[axis] * scale[axis]);
    Some(Affine::scale(scale[0], scale[1]).then(&Affine::shift(Vector::from(moved))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::front::svg::transform::placed;

    #[test]
    fn a_view_box_keeps_its_shape_unless_it_is_told_otherwise() {
        let view = ViewBox::read("10 20,100 50").expect("a view box");
        let check = |rule: Option<&str>, from: Pair, to: Pair| {
            let found = fit(view, [200.0, 200.0], rule).expect("a rule");
            let found = placed(&found, from);
            assert_eq!(found, to, "{rule:?}");
        };
        check(None, [10.0, 20.0], [0.0, 50.0]);
        check(Some("xMidYMid meet"), [110.0, 70.0], [200.0, 150.0]);
        check(Some("xMinYMin"), [110.0, 70.0], [200.0, 100.0]);
        check(Some("xMaxYMax"), [110.0, 70.0], [200.0, 200.0]);
        check(Some("xMidYMid slice"), [60.0, 45.0], [100.0, 100.0]);
        check(Some("none"), [110.0, 70.0], [200.0, 200.0]);
        assert_eq!(fit(view, [1.0, 1.0], Some("middle")), None);
    }

    #[test]
    fn a_view_box_has_a_size() {
        for text in ["", "0 0 1", "0 0 1 0", "0 0 -1 1", "0 0 1 1 1", "0 0 1mm 1"] {
            assert_eq!(ViewBox::read(text), None, "{text}");
        }
    }
}
