//! The rulers of a carriage: number of sensors covered by a cloth.

use crate::machine::Tracking;

/// Numbers of covered sensors I and J, for a position of the carriage and the edges of a cloth, mm.
///
/// The middle of ruler A is half the nominal width to the left of the carriage, that of ruler B to the right. Sensors are in
/// the middle of their pitch; the cloth covers those inside its edges.
pub(super) fn covered(track: &Tracking, carriage: f64, [left, right]: [f64; 2]) -> [u16; 2] {
    let half = track.width_mm / 2.0;
    let [over_left, over_right] = [carriage - half - left, right - (carriage + half)];
    let sensors = f64::from(track.sensors);
    [over_left, over_right].map(|over| (sensors / 2.0 + over / track.pitch_mm).round().clamp(0.0, sensors) as u16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_tell_centre_and_width_each_within_one() {
        let track = Tracking::default();
        for step in -200..200_i32 {
            let (off, wider) = (f64::from(step) * 0.037, f64::from(step % 17) * 0.31);
            let half = track.width_mm.midpoint(wider);
            let [i, j] = covered(&track, off, [-half, half]).map(f64::from);
            assert!((i - j - 2.0 * off).abs() <= 1.0 && (i + j - 64.0 - wider).abs() <= 1.0, "{off} {wider}: {i} {j}");
        }
    }
}
