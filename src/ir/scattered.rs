//! Sparse values by id: nearly all ids have a default, such as the original neighbours of a segment.
//!
//! Only blocks that contain another value are stored. A large marker with defaults only needs no memory for them.

/// Number of ids per block.
const BLOCK: usize = 1024;

/// Values by id.
#[derive(Debug, Clone)]
pub(super) struct Scattered<T> {
    /// Blocks of values; a block is empty while all of its values are defaults.
    blocks: Vec<Vec<T>>,
}

impl<T> Default for Scattered<T> {
    fn default() -> Self {
        Self { blocks: Vec::new() }
    }
}

impl<T: Copy> Scattered<T> {
    /// The value of an id; `None` in a block with defaults only.
    pub(super) fn get(&self, id: u32) -> Option<T> {
        let block = self.blocks.get(id as usize / BLOCK);
        block.and_then(|block| block.get(id as usize % BLOCK)).copied()
    }

    /// The value of an id, for modification; `usual` gives the default of each id in its block.
    pub(super) fn get_mut(&mut self, id: u32, usual: impl Fn(u32) -> T) -> &mut T {
        let place = id as usize / BLOCK;
        if self.blocks.len() <= place {
            self.blocks.resize_with(place + 1, Vec::new);
        }
        let block = &mut self.blocks[place];
        if block.is_empty() {
            let first = (place * BLOCK) as u32;
            block.extend((0..BLOCK as u32).map(|i| usual(first.wrapping_add(i))));
        }
        &mut block[id as usize % BLOCK]
    }
}
