//! Where heads are across the feed over the time of a program, as far as it takes to tell whether two come too near.

/// Periods of a block.
const BLOCK: usize = 8;

/// The least and the greatest y of a head in each block of periods, mm.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Track(Vec<[f64; 2]>);

impl Track {
    /// The track of a head whose y is given tick by tick.
    pub(super) fn new(ticks: impl Iterator<Item = f64>) -> Self {
        let mut blocks: Vec<[f64; 2]> = Vec::new();
        for (i, y) in ticks.enumerate() {
            if i % BLOCK == 0 {
                blocks.push([y; 2]);
            }
            if let Some([least, most]) = blocks.last_mut() {
                *least = least.min(y);
                *most = most.max(y);
            }
        }
        Self(blocks)
    }

    /// Whether two heads come nearer to each other than `width` mm: they never pass each other.
    pub(super) fn is_near(&self, other: &Self, width: f64) -> bool {
        self.0.iter().zip(&other.0).any(|(a, b)| a[0] - b[1] < width && b[0] - a[1] < width)
    }
}
