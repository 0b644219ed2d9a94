//! Encoded outlines that have lost a byte. Each vertex of an encoded polyline depends on the one before. If a number loses a
//! byte, the outline misses its start along one axis by the difference. If the flag that lifts the pen is lost, a line leads to
//! the outline.

use super::line::{Class, Closing, Line, SMALL_OUTLINE};
use super::parts::Parts;
use super::pens::Use;
use super::sheet::Sheet;
use crate::diagnostic::{Diagnostic, code};
use crate::ir::drawing::{Encoded, Vertex};
use crate::units::number::fixed;

/// Decimals of lengths, mm.
const DECIMALS: u32 = 1;
/// Tolerance of whole steps, as a fraction of a step: vertices are sums of multiples of it.
const WHOLE_EPSILON: f64 = 1e-3;
/// Greatest number of bytes of a number.
const MOST_DIGITS: u32 = 8;

/// Finding about the first outline that has lost a byte.
pub(super) fn first(sheet: &Sheet) -> Option<Diagnostic> {
    let parts = Parts::of(sheet);
    let is_open = |line: &&Line| match line.closing {
        Closing::Gap(_) => true,
        // An overcut continues from the start itself.
        Closing::Retraced => {
            let drawn = line.as_drawn(&sheet.vertices);
            !drawn[1..drawn.len() - 1].iter().any(|vertex| vertex.at == drawn[0].at)
        }
        Closing::Drawn | Closing::Open(_) => !line.is_closed && !parts.hold(line),
        Closing::Bridged(..) | Closing::Edge(_) => false,
    };
    let may_be_outline = |line: &&Line| {
        line.size() > SMALL_OUTLINE
            && !matches!(line.usage, Use::Drawn | Use::Marks | Use::Ignore)
            && line.class != Class::Again
    };
    let mut outlines = sheet.lines.iter().filter(may_be_outline).filter(is_open);
    let told = |line: &Line| {
        let drawn = line.as_drawn(&sheet.vertices);
        told(drawn, drawn_by(drawn, &sheet.encoded)?)
    };
    outlines.find_map(told)
}

/// The encoded polyline that draws all of a line.
fn drawn_by<'a>(vertices: &[Vertex], encoded: &'a [Encoded]) -> Option<&'a Encoded> {
    let [first, last] = [vertices[1].span, vertices[vertices.len() - 1].span];
    let next = encoded.partition_point(|one| one.span.start <= first.start);
    encoded.get(next.checked_sub(1)?).filter(|one| last.end <= one.span.end)
}

/// Finding about a line that has lost a byte.
fn told(vertices: &[Vertex], encoded: &Encoded) -> Option<Diagnostic> {
    let lacking = vertices.windows(2).find(|ends| lacks_a_byte(ends, vertices, encoded));
    let (at, how) = if let Some(ends) = lacking {
        let gap = fixed((vertices[vertices.len() - 1].at - vertices[0].at).norm(), DECIMALS);
        (ends[1], format!("misses its start by {gap} mm: a byte is lost here"))
    } else {
        (hangs_on_a_line(vertices)?, "hangs on a line: a flag that lifts the pen is lost".to_owned())
    };
    let found = Diagnostic::new(&code::DRAWING_BYTE_LOST, format!("an encoded outline (PE) {how}"));
    let found = found.at(at.span).on_cloth(at.at);
    Some(found.hint("transfer the file again, as binary data; `--cut-pens` leaves the pen of a right line out"))
}

/// Vertex where a line joins the ring that one of its ends closes.
fn hangs_on_a_line(line: &[Vertex]) -> Option<Vertex> {
    let [first, last] = [0, line.len() - 1];
    let is_ring = |from: usize, to: usize| {
        let ring = Line::of(&line[from..=to], 0, Use::Unsaid);
        ring.is_closed && ring.size() > SMALL_OUTLINE && ring.area > SMALL_OUTLINE * SMALL_OUTLINE
    };
    let of_end = (1..last).find(|&k| line[k].at == line[last].at).filter(|&k| is_ring(k, last));
    let of_start = || (1..last).rev().find(|&k| line[k].at == line[first].at).filter(|&k| is_ring(first, k));
    of_end.or_else(of_start).map(|k| line[k])
}

/// True if the line would close with another byte in the number of one edge.
fn lacks_a_byte(edge: &[Vertex], line: &[Vertex], encoded: &Encoded) -> bool {
    let way = edge[1].at - edge[0].at;
    let gap = line[line.len() - 1].at - line[0].at;
    let along = |axis: usize| {
        let [number, gap] = [way[axis], gap[axis]].map(|length| steps(length, encoded.step));
        number.zip(gap).is_some_and(|(number, gap)| {
            // A plot may be turned, and a line drawn from its end.
            gap != 0 && [1, -1].iter().any(|sign| is_left_of(sign * number, sign * (number - gap), encoded.digit_bits))
        })
    };
    let [is_off_x, is_off_y] = [0, 1].map(|axis| steps(gap[axis], encoded.step) != Some(0));
    is_off_x != is_off_y && along(usize::from(is_off_y))
}

/// A length in whole steps.
fn steps(length: f64, step: f64) -> Option<i64> {
    let count = (length / step).round();
    ((length / step - count).abs() <= WHOLE_EPSILON).then_some(count as i64)
}

/// True if a number is the rest of a whole one after one of its bytes, except the last, is lost.
fn is_left_of(number: i64, whole: i64, digit_bits: u32) -> bool {
    let encoded = |number: i64| number.unsigned_abs() << 1 | u64::from(number < 0);
    // Zero has no sign.
    let is_it = |left: u64| left == encoded(number) || number == 0 && left == 1;
    let whole = encoded(whole);
    (0..MOST_DIGITS).map(|digit| digit * digit_bits).take_while(|low| whole >> low >> digit_bits > 0).any(|low| {
        let kept = whole & ((1 << low) - 1);
        is_it(whole >> low >> digit_bits << low | kept)
    })
}
