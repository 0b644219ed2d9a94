//! State of the axes at a place of a path, and the blade.

use crate::ir::toolpath::Pose;

/// Position of the axes x, y (mm) and c (rad) and their derivatives by the path parameter up to the third.
#[derive(Debug, Clone, Copy)]
pub(in crate::plan) struct Axes {
    /// Row k holds the k-th derivatives of x, y, c.
    pub(in crate::plan) q: [[f64; 3]; 4],
    /// |p'|: path length of the tip per unit of the parameter.
    pub(in crate::plan) pace: f64,
}

impl Axes {
    /// Pose of the axes.
    pub(in crate::plan) fn pose(&self) -> Pose {
        let [x, y, c] = self.q[0];
        Pose::new(x, y, c)
    }
}

/// The blade, mm: its width from heel to tip, and the radius from the C axis to the tip.
#[derive(Debug, Clone, Copy)]
pub(in crate::plan) struct Blade {
    pub(in crate::plan) width: f64,
    pub(in crate::plan) radius: f64,
}
