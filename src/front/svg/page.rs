//! The page: size of a unit of the file, and position of the drawing in mm, with y upwards.
//!
//! A pixel is 1/96 inch by CSS, but 1/90 inch in files of Inkscape before 0.92 and 1/72 inch in those of Adobe Illustrator.

use roxmltree::{Document, Node};

use super::length::Length;
use super::transform::Pair;
use super::viewport::{ViewBox, fit};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Extent;
use crate::geom::affine::Affine;
use crate::units::MM_PER_INCH;
use crate::units::number::{fixed, short};

/// Namespace of Inkscape, and the prefix of those of Adobe.
pub(super) const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";
const ADOBE: &str = "http://ns.adobe.com/";
/// The first version of Inkscape with 96 pixels to the inch.
const INKSCAPE_96: (u32, u32) = (0, 92);
/// Limits of plausible drawings, mm: a drawing is doubted if both sides exceed the first, or neither reaches the second.
const WIDEST: f64 = 3000.0;
const SMALLEST: f64 = 20.0;

/// A page.
#[derive(Debug, Clone, Copy)]
pub(super) struct Page {
    /// Map from units of the file to mm.
    pub(super) map: Affine,
    /// Size of a pixel, mm.
    pub(super) pixel: f64,
    /// Reference width and height of percentages, in units of the file.
    pub(super) whole: Pair,
    /// Pixels per inch, and the reason for the number.
    dots: Dots,
    /// True if the size of the drawing depends on the pixels per inch.
    is_by_pixels: bool,
}

/// Pixels per inch, and the reason for the number.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Dots {
    to_the_inch: f64,
    because: &'static str,
}

impl Dots {
    /// Pixels per inch of the program that wrote a file.
    fn of(document: &Document) -> Self {
        let root = document.root_element();
        if root.attribute((INKSCAPE, "version")).and_then(version).is_some_and(|version| version < INKSCAPE_96) {
            return Self { to_the_inch: 90.0, because: "as Inkscape before 0.92 has it" };
        }
        let is_said = |node: Node| {
            node.is_comment() && node.text().is_some_and(|text| text.contains("Generator: Adobe Illustrator"))
        };
        let is_named = || root.namespaces().any(|namespace| namespace.uri().starts_with(ADOBE));
        if document.root().children().any(is_said) || is_named() {
            return Self { to_the_inch: 72.0, because: "as Adobe Illustrator has it" };
        }
        Self { to_the_inch: 96.0, because: "as browsers have it" }
    }
}

/// Major and minor number of a version such as `0.91 r13725`.
fn version(text: &str) -> Option<(u32, u32)> {
    let mut numbers = text.trim().split(|c: char| !c.is_ascii_digit());
    Some((numbers.next()?.parse().ok()?, numbers.next()?.parse().ok()?))
}

/// A fault of an attribute of the root: its name and a description.
type Fault = (&'static str, &'static str);

impl Page {
    /// The page of a file.
    pub(super) fn of(document: &Document) -> Result<Self, Fault> {
        let dots = Dots::of(document);
        let root = document.root_element();
        let pixel = MM_PER_INCH / dots.to_the_inch;
        if root.has_attribute("transform") {
            return Err(("transform", "the page itself is transformed"));
        }
        let view = match root.attribute("viewBox") {
            Some(text) => {
                Some(ViewBox::read(text).ok_or(("viewBox", "this is no view box: four numbers, the size above 0"))?)
            }
            None => None,
        };
        let asked = [size(root, "width")?, size(root, "height")?];
        let millimetres = |length: Length| match length {
            Length::Px(px) => px * pixel,
            Length::Mm(mm) | Length::Percent(mm) => mm,
        };
        let mm = asked.map(|length| length.map(millimetres));
        // A single side determines the other by the aspect ratio of the view box; without any, a unit is a pixel.
        let mm = match (mm, view) {
            ([Some(width), Some(height)], _) => [width, height],
            ([Some(width), None], Some(view)) => [width, width * view.size[1] / view.size[0]],
            ([None, Some(height)], Some(view)) => [height * view.size[0] / view.size[1], height],
            ([None, None], Some(view)) => view.size.map(|size| size * pixel),
            (mm, None) => mm.map(|mm| mm.unwrap_or(0.0)),
        };
        let inner = match view {
            Some(view) => fit(view, mm, root.attribute("preserveAspectRatio"))
                .ok_or(("preserveAspectRatio", "this is no rule for the shape of the view box"))?,
            None => Affine::scale(pixel, pixel),
        };
        let map = inner.then(&Affine::matrix([1.0, 0.0, 0.0, -1.0, 0.0, mm[1]]));
        if !map.is_finite() {
            return Err(("viewBox", "the page has no size"));
        }
        let is_px = |length: &Option<Length>| !matches!(length, Some(Length::Mm(_)));
        let is_by_pixels =
            view.is_none() || asked.iter().all(is_px) || asked.iter().flatten().any(|l| matches!(l, Length::Px(_)));
        let whole = view.map_or_else(|| mm.map(|mm| mm / pixel), |view| view.size);
        Ok(Self { map, pixel, whole, dots, is_by_pixels })
    }

    /// Reports a size that depends on the pixels per inch, and doubts an implausible one.
    pub(super) fn check_size(&self, extent: &Extent, out: &mut Diagnostics) {
        if extent.is_empty() {
            return;
        }
        let (width, height) = extent.size();
        let sides = format!("{} x {} mm", fixed(width, 1), fixed(height, 1));
        let Dots { to_the_inch, because } = self.dots;
        let is_doubtful = width.min(height) > WIDEST || width.max(height) < SMALLEST;
        let mend = "if not, set the size of the page in mm and save it again";
        if self.is_by_pixels {
            let message = format!("its size is in pixels: {} to the inch, {because}", short(to_the_inch));
            let finding = Diagnostic::new(&code::SVG_NO_UNIT, message);
            out.push(finding.hint(format!("is the drawing {} mm wide? {mend}", fixed(width, 1))));
        }
        if is_doubtful {
            let what = if width.max(height) < SMALLEST { "smaller than any part" } else { "larger than any table" };
            let finding = Diagnostic::new(&code::SVG_SIZE, format!("the drawing is {sides}: {what}"));
            out.push(finding.hint(format!("is this {} mm wide? {mend}", fixed(width, 1))));
        }
    }
}

/// Width or height of the page; `None` if it is automatic.
fn size(root: Node, name: &'static str) -> Result<Option<Length>, Fault> {
    let Some(text) = root.attribute(name).map(str::trim).filter(|text| !text.is_empty() && *text != "auto") else {
        return Ok(None);
    };
    match Length::read(text) {
        None => Err((name, "this is no length: a number, and mm, cm, in, pt, pc, q, px or %")),
        Some(Length::Percent(_)) => Ok(None),
        Some(Length::Mm(number) | Length::Px(number)) if number <= 0.0 => Err((name, "the page has no size")),
        length => Ok(length),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::front::svg::transform::placed;

    fn page(text: &str) -> Result<Page, Fault> {
        Page::of(&Document::parse(text).expect("XML"))
    }

    fn check(root: &str, from: Pair, to: Pair) {
        let found = page(&format!("<svg {root}/>")).expect("a page").map;
        let found = placed(&found, from);
        assert!((found[0] - to[0]).hypot(found[1] - to[1]) < 1e-9, "{root}: {found:?}");
    }

    #[test]
    fn a_page_has_the_size_that_its_root_says() {
        check("width='100mm' height='50mm' viewBox='0 0 100 50'", [10.0, 10.0], [10.0, 40.0]);
        check("width='10cm' height='5cm' viewBox='0 0 1000 500'", [100.0, 100.0], [10.0, 40.0]);
        check("width='100mm' viewBox='0 0 200 100'", [20.0, 20.0], [10.0, 40.0]);
        check("height='50mm' viewBox='0 0 200 100'", [20.0, 20.0], [10.0, 40.0]);
        check("width='100mm' height='50mm' viewBox='-10 -10 100 50'", [-10.0, -10.0], [0.0, 50.0]);
        check("width='96' height='96'", [96.0, 96.0], [25.4, 0.0]);
        check("viewBox='0 0 96 96'", [96.0, 0.0], [25.4, 25.4]);
        check("width='100%' height='100%' viewBox='0 0 96 96'", [96.0, 0.0], [25.4, 25.4]);
        check("", [96.0, 96.0], [25.4, -25.4]);
        check("width='1in' height='1in'", [96.0, 96.0], [25.4, 0.0]);
    }

    #[test]
    fn the_program_says_how_large_a_pixel_is() {
        let dots = |text: &str| page(text).expect("a page").dots.to_the_inch;
        let inkscape = |version: &str| dots(&format!("<svg xmlns:i='{INKSCAPE}' i:version='{version}'/>"));
        assert_eq!(
            [inkscape("0.91 r13725"), inkscape("0.48.4"), inkscape("0.92.1"), inkscape("1.3")],
            [90.0, 90.0, 96.0, 96.0]
        );
        assert_eq!(dots("<!-- Generator: Adobe Illustrator 24.0 --><svg/>"), 72.0);
        assert_eq!(dots("<svg xmlns:i='http://ns.adobe.com/AdobeIllustrator/10.0/'/>"), 72.0);
        assert_eq!(dots("<svg/>"), 96.0);
    }

    #[test]
    fn a_page_without_a_size_is_refused() {
        let fault = |root: &str| page(&format!("<svg {root}/>")).expect_err("no page").0;
        assert_eq!(fault("width='0' height='5'"), "width");
        assert_eq!(fault("width='5' height='5em'"), "height");
        assert_eq!(fault("viewBox='0 0 0 5'"), "viewBox");
        assert_eq!(fault("viewBox='0 0 5 5' preserveAspectRatio='fit'"), "preserveAspectRatio");
        assert_eq!(fault("transform='scale(2)'"), "transform");
    }
}
