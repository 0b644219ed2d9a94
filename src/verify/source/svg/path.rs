//! Path data: commands with fixed numbers of parameters.

use super::numbers::Numbers;
use super::trace::Trace;

/// Commands, and the number of parameters of each.
const COMMANDS: [(u8, usize); 10] =
    [(b'M', 2), (b'L', 2), (b'H', 1), (b'V', 1), (b'C', 6), (b'S', 4), (b'Q', 4), (b'T', 2), (b'A', 7), (b'Z', 0)];
/// Indices of the flags among the parameters of an arc.
const FLAGS: std::ops::Range<usize> = 3..5;

/// Follows path data as far as it can be read.
pub(super) fn follow(text: &str, trace: &mut Trace) {
    let mut numbers = Numbers::of(text);
    let mut letter = 0;
    // Last control point of a cubic and of a quadratic curve.
    let mut knees: [Option<[f64; 2]>; 2] = [None; 2];
    loop {
        numbers.skip();
        match numbers.peek() {
            None => break,
            Some(byte) if byte.is_ascii_alphabetic() => {
                letter = byte;
                numbers.at += 1;
            }
            // Pairs behind a move are lines.
            Some(_) if letter == b'M' => letter = b'L',
            Some(_) if letter == b'm' => letter = b'l',
            Some(_) if letter.eq_ignore_ascii_case(&b'z') => break,
            Some(_) => {}
        }
        let capital = letter.to_ascii_uppercase();
        let Some(&(_, count)) = COMMANDS.iter().find(|(known, _)| *known == capital) else { break };
        let mut values = [0.0; 7];
        let is_whole = (0..count).all(|k| {
            let value =
                if capital == b'A' && FLAGS.contains(&k) { numbers.flag().map(f64::from) } else { numbers.number() };
            values[k] = value.unwrap_or_default();
            value.is_some()
        });
        if !is_whole {
            break;
        }
        make_absolute(&mut values, letter, trace.at);
        knees = obey(capital, &values, knees, trace);
    }
    trace.pen.lift();
}

/// Adds the position of the pen to the parameters of a command in lower case.
fn make_absolute(values: &mut [f64; 7], letter: u8, [x, y]: [f64; 2]) {
    let from = if letter.is_ascii_lowercase() { [x, y] } else { [0.0; 2] };
    match letter.to_ascii_uppercase() {
        b'H' => values[0] += from[0],
        b'V' => values[0] += from[1],
        b'A' => {
            values[5] += from[0];
            values[6] += from[1];
        }
        _ => values.iter_mut().enumerate().for_each(|(k, value)| *value += from[k % 2]),
    }
}

/// Executes a command and returns the control points that a smooth command may continue from.
fn obey(capital: u8, v: &[f64; 7], knees: [Option<[f64; 2]>; 2], trace: &mut Trace) -> [Option<[f64; 2]>; 2] {
    let [x, y] = trace.at;
    let mirror = |knee: Option<[f64; 2]>| knee.map_or([x, y], |[a, b]| [2.0 * x - a, 2.0 * y - b]);
    match capital {
        b'M' => trace.start([v[0], v[1]]),
        b'L' => trace.line([v[0], v[1]]),
        b'H' => trace.line([v[0], y]),
        b'V' => trace.line([x, v[0]]),
        b'C' => return [trace.bezier(&[[v[0], v[1]], [v[2], v[3]], [v[4], v[5]]]), None],
        b'S' => return [trace.bezier(&[mirror(knees[0]), [v[0], v[1]], [v[2], v[3]]]), None],
        b'Q' => return [None, trace.bezier(&[[v[0], v[1]], [v[2], v[3]]])],
        b'T' => return [None, trace.bezier(&[mirror(knees[1]), [v[0], v[1]]])],
        b'A' => trace.arc([v[0], v[1], v[2]], [v[3] != 0.0, v[4] != 0.0], [v[5], v[6]]),
        _ => trace.close(),
    }
    [None; 2]
}
