//! Work on many files at once: small ones side by side, a core each, large ones one after the other, each on all cores.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use rayon::ThreadPoolBuilder;

/// A file of so many bytes keeps all cores busy by itself.
const LARGE_BYTES: u64 = 1 << 20;

/// Does `work` on each file, given by their sizes, on so many threads, and hands each result to `each` in the order of
/// the files.
pub(in crate::cli) fn run<T: Send>(
    sizes: &[u64],
    threads: usize,
    work: impl Fn(usize) -> T + Sync,
    mut each: impl FnMut(usize, T),
) {
    let (large, small): (Vec<usize>, Vec<usize>) = (0..sizes.len()).partition(|&i| sizes[i] >= LARGE_BYTES);
    // Fewer files than cores: alone each has all of them.
    let (large, small) = if small.len() < threads { ((0..sizes.len()).collect(), Vec::new()) } else { (large, small) };
    let mut in_order = InOrder { next: 0, waiting: BTreeMap::new(), each: &mut each };
    for i in large {
        in_order.take(i, work(i));
    }
    let (work, small, next) = (&work, &small, &AtomicUsize::new(0));
    let (sender, results) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..threads.min(small.len()) {
            let sender = sender.clone();
            scope.spawn(move || {
                // All that would be shared out stays on this thread. Without such a pool it is only slower.
                let _alone = ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
                while let Some(&i) = small.get(next.fetch_add(1, Ordering::Relaxed)) {
                    if sender.send((i, work(i))).is_err() {
                        break;
                    }
                }
            });
        }
        drop(sender);
        for (i, result) in results {
            in_order.take(i, result);
        }
    });
}

/// Results wait for those before them.
struct InOrder<'e, T, E: FnMut(usize, T)> {
    next: usize,
    waiting: BTreeMap<usize, T>,
    each: &'e mut E,
}

impl<T, E: FnMut(usize, T)> InOrder<'_, T, E> {
    fn take(&mut self, i: usize, result: T) {
        self.waiting.insert(i, result);
        while let Some(result) = self.waiting.remove(&self.next) {
            (self.each)(self.next, result);
            self.next += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_the_order_of_the_files() {
        for threads in [1, 2, 5] {
            for sizes in [vec![], vec![1], vec![1, LARGE_BYTES, 1, 1, 2 * LARGE_BYTES, 1], vec![1; 100]] {
                let mut told = Vec::new();
                run(&sizes, threads, |i| i * i, |i, square| told.push((i, square)));
                assert_eq!(told, (0..sizes.len()).map(|i| (i, i * i)).collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn small_files_run_side_by_side_and_large_ones_alone() {
        let running = AtomicUsize::new(0);
        let most = |sizes: &[u64]| {
            let most = AtomicUsize::new(0);
            let barrier = std::sync::Barrier::new(2);
            let work = |_| {
                let now = running.fetch_add(1, Ordering::SeqCst) + 1;
                most.fetch_max(now, Ordering::SeqCst);
                if sizes[0] < LARGE_BYTES {
                    barrier.wait();
                }
                running.fetch_sub(1, Ordering::SeqCst);
            };
            run(sizes, 2, work, |_, ()| {});
            most.load(Ordering::SeqCst)
        };
        assert_eq!(most(&[1; 4]), 2);
        assert_eq!(most(&[LARGE_BYTES; 4]), 1);
    }
}
