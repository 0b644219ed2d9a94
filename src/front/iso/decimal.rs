//! Decimal points in a file of whole numbers.

use super::block::Blocks;
use crate::diagnostic::{Diagnostic, code};
use crate::front::decimals::Decimals;

/// The finding on the decimal points of the places that are cut to, in the file that they are of.
pub(super) fn finding(decimals: &Decimals, bytes: &[u8]) -> Option<Diagnostic> {
    decimals.finding(&code::ISO_POINT, &code::ISO_LONE_POINT, |least| whole_places(bytes, least) >= least)
}

/// Number of places in whole numbers, up to `most`.
fn whole_places(bytes: &[u8], most: usize) -> usize {
    let (mut blocks, mut count) = (Blocks::new(bytes), 0);
    while count < most {
        if let Some((_, span)) = blocks.next_point() {
            count += usize::from(!bytes[span.start as usize..span.end as usize].contains(&b'.'));
        } else if blocks.next().is_none() {
            break;
        }
    }
    count
}
