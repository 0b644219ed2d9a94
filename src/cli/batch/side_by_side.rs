//! Work on many files at once: small ones side by side, a core each, large ones one after the other, each on all cores.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use rayon::ThreadPoolBuilder;

/// A file of so many bytes keeps all cores busy by itself.
const LARGE_BYTES: u64 = 1 << 20;

/// Files that wait for a disk, at most, for each thread: what they hold in memory stays bounded.
const WAITING: usize = 4;

/// What is done with a file: the work, and what waits for a disk, so that no core waits with it.
pub(in crate::cli) struct Stages<W, S> {
    /// On a thread of its own, or on all.
    pub(in crate::cli) work: W,
    /// Beside that, one file after the other.
    pub(in crate::cli) settle: S,
}

/// Does the work on each file, given by their sizes, on so many threads, and hands each result to `each` in the order of
/// the files.
pub(in crate::cli) fn run<D: Send, T: Send>(
    sizes: &[u64],
    threads: usize,
    stages: Stages<impl Fn(usize) -> D + Sync, impl Fn(usize, D) -> T + Sync>,
    mut each: impl FnMut(usize, T),
) {
    let Stages { work, settle } = stages;
    let (large, small): (Vec<usize>, Vec<usize>) = (0..sizes.len()).partition(|&i| sizes[i] >= LARGE_BYTES);
    // Fewer files than cores: alone each has all of them.
    let (large, small) = if small.len() < threads { ((0..sizes.len()).collect(), Vec::new()) } else { (large, small) };
    let mut in_order = InOrder { next: 0, waiting: BTreeMap::new(), each: &mut each };
    for i in large {
        in_order.take(i, settle(i, work(i)));
    }
    let (work, settle, small, next) = (&work, &settle, &small, &AtomicUsize::new(0));
    let (worked, to_settle) = mpsc::sync_channel(WAITING * threads);
    let (settled, results) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..threads.min(small.len()) {
            let worked = worked.clone();
            scope.spawn(move || {
                let work_on_all = || {
                    while let Some(&i) = small.get(next.fetch_add(1, Ordering::Relaxed)) {
                        if worked.send((i, work(i))).is_err() {
                            break;
                        }
                    }
                };
                // All that would be shared out stays on one thread. Without such a pool it is only slower.
                match ThreadPoolBuilder::new().num_threads(1).build() {
                    Ok(alone) => alone.install(work_on_all),
                    Err(_) => work_on_all(),
                }
            });
        }
        drop(worked);
        scope.spawn(move || {
            for (i, done) in to_settle {
                if settled.send((i, settle(i, done))).is_err() {
                    break;
                }
            }
        });
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
                let stages = Stages { work: |i| i * i, settle: |i, square| (i, square) };
                run(&sizes, threads, stages, |_, square| told.push(square));
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
            run(sizes, 2, Stages { work, settle: |_, ()| () }, |_, ()| {});
            most.load(Ordering::SeqCst)
        };
        assert_eq!(most(&[1; 4]), 2);
        assert_eq!(most(&[LARGE_BYTES; 4]), 1);
    }
}
