//! What is known of a file beyond its row in every table: notches, the area of its parts, the cloth that they lie on, and
//! what cutting them costs.

use crate::units::{MM_PER_M, MM2_PER_M2};

/// Hundredths in a whole.
const PERCENT: f64 = 100.0;

/// Figures of a file, or of several.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::cli) struct Figures {
    pub(in crate::cli) notches: usize,
    /// Of the parts, less their cut-outs, m2; `None` when it is not known.
    pub(in crate::cli) area_m2: Option<f64>,
    pub(in crate::cli) cloth: Cloth,
}

/// What a marker lies on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::cli) struct Cloth {
    /// Along X, mm.
    pub(in crate::cli) length_mm: f64,
    /// Along Y, mm; of several the mean by length.
    pub(in crate::cli) width_mm: f64,
}

impl Cloth {
    /// m2.
    fn area_m2(self) -> f64 {
        self.length_mm * self.width_mm / MM2_PER_M2
    }
}

impl Figures {
    /// How much of the cloth the parts take, percent; `None` of no cloth, or of parts of no known area.
    pub(in crate::cli) fn utilisation_percent(&self) -> Option<f64> {
        let cloth = self.cloth.area_m2();
        self.area_m2.filter(|_| cloth > 0.0).map(|area| PERCENT * area / cloth)
    }

    /// Those of several files, their cloths one behind the other; `None` of none.
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
