//! Figures of a file beyond the columns common to all tables: notches, the area of its parts, the cloth used, and the costs of
//! cutting.

use crate::units::{MM_PER_M, MM2_PER_M2};

/// Percent per unit.
const PERCENT: f64 = 100.0;

/// Figures of a file or of several.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::cli) struct Figures {
    pub(in crate::cli) notches: usize,
    /// Area of the parts without their cut-outs, m2; `None` if unknown.
    pub(in crate::cli) area_m2: Option<f64>,
    pub(in crate::cli) cloth: Cloth,
}

/// Size of the cloth under a marker.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::cli) struct Cloth {
    /// Length along X, mm.
    pub(in crate::cli) length_mm: f64,
    /// Width along Y, mm; for several files the mean weighted by length.
    pub(in crate::cli) width_mm: f64,
}

impl Cloth {
    /// Area, m2.
    fn area_m2(self) -> f64 {
        self.length_mm * self.width_mm / MM2_PER_M2
    }
}

impl Figures {
    /// Share of the cloth that the parts take, percent; `None` without cloth or if the area of the parts is unknown.
    pub(in crate::cli) fn utilisation_percent(&self) -> Option<f64> {
        let cloth = self.cloth.area_m2();
        self.area_m2.filter(|_| cloth > 0.0).map(|area| PERCENT * area / cloth)
    }

    /// Sum of the figures of several files, with their cloths laid end to end; `None` for no files.
    pub(super) fn sum<'a>(all: impl Iterator<Item = &'a Self>) -> Option<Self> {
        let (mut sum, mut cloth_m2) = (None::<Self>, 0.0);
        for figures in all {
            cloth_m2 += figures.cloth.area_m2();
            sum = Some(match sum {
                None => *figures,
                Some(sum) => {
                    let length_mm = sum.cloth.length_mm + figures.cloth.length_mm;
                    let width_mm = if length_mm > 0.0 { cloth_m2 * MM_PER_M / length_mm * MM_PER_M } else { 0.0 };
                    Self {
                        notches: sum.notches + figures.notches,
                        area_m2: sum.area_m2.zip(figures.area_m2).map(|(one, other)| one + other),
                        cloth: Cloth { length_mm, width_mm },
                    }
                }
            });
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn several_cloths_are_used_as_one_behind_the_other() {
        let figures =
            |area_m2, length_mm, width_mm| Figures { notches: 2, area_m2, cloth: Cloth { length_mm, width_mm } };
        let all =
            [figures(Some(1.5), 2000.0, 1000.0), figures(Some(0.75), 1000.0, 1500.0), figures(Some(0.0), 0.0, 0.0)];
        assert_eq!(all.map(|one| one.utilisation_percent()), [Some(75.0), Some(50.0), None]);
        let sum = Figures::sum(all.iter()).expect("some");
        assert_eq!((sum.notches, sum.area_m2, sum.cloth.length_mm), (6, Some(2.25), 3000.0));
        assert!((sum.cloth.width_mm - 3500.0 / 3.0).abs() < 1e-9);
        assert!((sum.utilisation_percent().expect("cloth") - 225.0 / 3.5).abs() < 1e-9);
        let unknown = Figures::sum([all[0], figures(None, 1.0, 1.0)].iter()).expect("some");
        assert_eq!((unknown.area_m2, unknown.utilisation_percent()), (None, None));
        assert_eq!(Figures::sum([].iter()), None);
    }
}
