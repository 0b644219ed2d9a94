//! Smooth fading along a path, without a jolt at either end.

/// Remaining fraction at `x`, 0 to 1, of a fade, and its first three derivatives by x: 1 - S(x), with S the step of degree 7
/// (smoothstep) that has three vanishing derivatives at both ends.
pub fn left_of(x: f64) -> [f64; 4] {
    let x = x.clamp(0.0, 1.0);
    let y = x * (1.0 - x);
    [
        1.0 - x.powi(4) * (35.0 - 84.0 * x + 70.0 * x * x - 20.0 * x.powi(3)),
        -140.0 * y.powi(3),
        -420.0 * y * y * (1.0 - 2.0 * x),
        -840.0 * y * (1.0 - 5.0 * y),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_fades_from_all_to_nothing_and_its_derivatives_are_its_differences() {
        assert_eq!([left_of(-1.0), left_of(1.0)], [[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]]);
        let h = 1e-5;
        for i in 1..20 {
            let x = f64::from(i) / 20.0;
            for k in 0..3 {
                let slope = (left_of(x + h)[k] - left_of(x - h)[k]) / (2.0 * h);
                assert!((slope - left_of(x)[k + 1]).abs() < 1e-5, "order {k} at {x}");
            }
        }
    }
}
