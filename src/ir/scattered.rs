//! Values of ids of which nearly all have the usual one, such as the neighbours of a segment.
//!
//! Only blocks of ids in which one is not as usual are kept: a large marker in which all are needs no room for them.

/// Ids of a block.
const BLOCK: usize = 1024;

/// Values by id.
#[derive(Debug, Clone)]
pub(super) struct Scattered<T> {
    /// A block is empty as long as all of its values are the usual ones.
    blocks: Vec<Vec<T>>,
}

impl<T> Default for Scattered<T> {
    fn default() -> Self {
        Self { blocks: Vec::new() }
    }
}

impl<T: Copy> Scattered<T> {
    /// The value of an id; `None` = the usual one, as far as is known.
    pub(super) fn get(&self, id: u32) -> Option<T> {
        let block = self.blocks.get(id as usize / BLOCK);
        block.and_then(|block| block.get(id as usize % BLOCK)).copied()
    }

    /// The value of an id, to change; `usual` gives those of all ids beside it.
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
