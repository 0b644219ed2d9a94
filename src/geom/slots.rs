//! Items by the slots that they belong to, in one block: as many small lists as slots would each have memory of its own.

use std::ops::RangeInclusive;

/// Items, slot by slot.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Slots {
    /// Where the items of each slot begin, and where those of the last one end.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Slots {
    /// Sorts items, fewer than 2^32, into `count` slots by counting, first how many, then where. `each` calls out the
    /// slot and the item of all, each time the same; in a slot they stay in this order.
    pub fn new(count: usize, each: impl Fn(&mut dyn FnMut(usize, u32))) -> Self {
        // A slot's count stands two places on, so that what is counted up one place on is where it begins, then where
        // it ends.
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

    /// How many slots there are.
    pub fn count(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// The items of a slot.
    pub fn of(&self, slot: usize) -> &[u32] {
        self.of_all(slot..=slot)
    }

    /// The items of slots that follow each other, slot by slot.
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
