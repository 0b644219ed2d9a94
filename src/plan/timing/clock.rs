//! Path parameter as a function of time: quintic pieces that match position, speed and acceleration at dense nodes.

use super::grid;

/// Nodes per knot span. The pieces then reproduce the motion to far below the rounding of the output.
const NODES_A_SPAN: usize = 3;

/// A motion along a path, u(t), from rest to rest.
#[derive(Debug, Clone)]
pub(in crate::plan) struct Clock {
    nodes: Vec<Node>,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    /// Time, s.
    t: f64,
    /// Parameter and its first two derivatives by time.
    u: [f64; 3],
}

impl Clock {
    /// The motion with b = (du/dt)^2 and db/du given by `pace(span, s)` on each span of `breaks`; s counts from the parameter
    /// `start`.
    pub(super) fn new(start: f64, breaks: &[f64], pace: impl Fn(usize, f64) -> (f64, f64)) -> Self {
        let length = breaks[breaks.len() - 1];
        let mut nodes = vec![Node { t: 0.0, u: [start, 0.0, 0.0] }];
        let mut t = 0.0;
        for (span, cell) in grid::cells(breaks).enumerate() {
            for i in 0..NODES_A_SPAN {
                let share = |i: usize| i as f64 / NODES_A_SPAN as f64;
                let part = cell.part(share(i), share(i + 1));
                t += part.gauss().iter().map(|&(s, weight)| weight / pace(span, s).0.sqrt()).sum::<f64>();
                let s = part.end();
                let (b, slope) = if s < length { pace(span, s) } else { (0.0, 0.0) };
                nodes.push(Node { t, u: [start + s, b.max(0.0).sqrt(), slope / 2.0] });
            }
        }
        if let Some(end) = nodes.last_mut() {
            end.u = [start + length, 0.0, 0.0];
        }
        Self { nodes }
    }

    /// Duration from rest to rest, s.
    pub(in crate::plan) fn duration(&self) -> f64 {
        self.nodes[self.nodes.len() - 1].t
    }

    /// Parameter at `count` equally spaced times from start to end, both included.
    pub(in crate::plan) fn sample(&self, count: usize) -> Vec<f64> {
        let mut piece = 0;
        let mut samples = Vec::with_capacity(count);
        for i in 0..count {
            let t = self.duration() * i as f64 / (count - 1) as f64;
            while piece + 2 < self.nodes.len() && self.nodes[piece + 1].t <= t {
                piece += 1;
            }
            let (a, b) = (self.nodes[piece], self.nodes[piece + 1]);
            samples.push(hermite(a, b, t).clamp(a.u[0], b.u[0]));
        }
        samples
    }
}

/// Value at time `t` of the quintic through position, speed and acceleration of two nodes.
fn hermite(a: Node, b: Node, t: f64) -> f64 {
    let h = b.t - a.t;
    if h <= 0.0 {
        return b.u[0];
    }
    let x = (t - a.t) / h;
    let (p0, v0, a0) = (a.u[0], a.u[1] * h, a.u[2] * h * h);
    let (way, v1, a1) = (b.u[0] - p0, b.u[1] * h, b.u[2] * h * h);
    let (c, d, e) = (way - v0 - a0 / 2.0, v1 - v0 - a0, a1 - a0);
    let (c3, c4, c5) = (10.0 * c - 4.0 * d + e / 2.0, -15.0 * c + 7.0 * d - e, 6.0 * c - 3.0 * d + e / 2.0);
    p0 + x * (v0 + x * (a0 / 2.0 + x * (c3 + x * (c4 + x * c5))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_reproduce_a_polynomial_motion() {
        // u = t^5 - 2 t^4 + 3 t^2 from t = 0.5 to 0.9.
        let node = |t: f64| Node {
            t,
            u: [
                t.powi(5) - 2.0 * t.powi(4) + 3.0 * t * t,
                5.0 * t.powi(4) - 8.0 * t.powi(3) + 6.0 * t,
                20.0 * t.powi(3) - 24.0 * t * t + 6.0,
            ],
        };
        for i in 0..=10 {
            let t = 0.5 + 0.04 * f64::from(i);
            assert!((hermite(node(0.5), node(0.9), t) - node(t).u[0]).abs() < 1e-14);
        }
    }
}
