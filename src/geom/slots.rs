//! Items grouped by slot in one block (CSR). A list per slot would need an allocation each.

use std::ops::RangeInclusive;

/// Items, slot by slot.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Slots {
    /// Index of the first item of each slot, then the number of all items.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Slots {
    /// Sorts items, fewer than 2^32, into `count` slots by counting sort. `each` reports the slot and the item of all; it is
    /// called twice and must report the same both times. Within a slot the items keep this order.
    pub fn new(count: usize, each: impl Fn(&mut dyn FnMut(usize, u32))) -> Self {
        // The count of a slot is stored two positions on. The prefix sum one position on is then the start of the slot while it
        // is filled, and its end afterwards.
        let mut starts = vec![0_u32; count + 2];
        each(&mut |slot, _| starts[slot + 2] += 1);
        for i in 2..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut items = vec![0; starts[count + 1] as usize];
        each(&mut |slot, item| {
            let next = &mut starts[slot + 1];
            items[*next as usize] = item;
            *next += 1;
        });
        starts.truncate(count + 1);
        Self { starts, items }
    }

    /// Number of slots.
    pub fn count(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Items of a slot.
    pub fn of(&self, slot: usize) -> &[u32] {
        self.of_all(slot..=slot)
    }

    /// Items of consecutive slots, slot by slot.
    pub fn of_all(&self, slots: RangeInclusive<usize>) -> &[u32] {
        &self.items[self.starts[*slots.start()] as usize..self.starts[slots.end() + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_come_slot_by_slot_in_the_order_that_they_were_called_out_in() {
        let slots =
            Slots::new(4, |see| [(2, 7), (0, 1), (2, 5), (3, 9)].into_iter().for_each(|(slot, item)| see(slot, item)));
        assert_eq!(slots.count(), 4);
        assert_eq!([slots.of(0), slots.of(1), slots.of(2), slots.of(3)], [&[1][..], &[], &[7, 5], &[9]]);
        assert_eq!(slots.of_all(1..=3), [7, 5, 9]);
        assert_eq!(Slots::default().count(), 0);
    }
}
