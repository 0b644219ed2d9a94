//! Parallel work on many files: small ones concurrently, one core each; large ones in sequence, each on all cores.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use rayon::ThreadPoolBuilder;

/// Minimum size of a file that keeps all cores busy by itself, bytes.
const LARGE_BYTES: u64 = 1 << 20;

/// Maximum number of files per thread that wait for the disk. It bounds the memory that they hold.
const WAITING: usize = 4;

/// The two stages of a file: the computation, and the disk access, so that no core waits for the disk.
pub(in crate::cli) struct Stages<W, S> {
    /// Computation, on one thread or on all.
    pub(in crate::cli) work: W,
    /// Disk access, one file at a time, concurrently with the computation.
    pub(in crate::cli) settle: S,
}

/// Processes files, given by their sizes, on a number of threads, and passes each result to `each` in the order of the files.
pub(in crate::cli) fn run<D: Send, T: Send>(
    sizes: &[u64],
    threads: usize,
    stages: Stages<impl Fn(usize) -> D + Sync, impl Fn(usize, D) -> T + Sync>,
    mut each: impl FnMut(usize, T),
) {
    let Stages { work, settle } = stages;
    let (large, small): (Vec<usize>, Vec<usize>) = (0..sizes.len()).partition(|&i| sizes[i] >= LARGE_BYTES);
    // With fewer small files than threads, each file gets all cores in turn.
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
                // A pool of one thread keeps nested parallel work on this thread. Without the pool the work is only slower.
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

/// Results in the order of the files. A result waits for all those before it.
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
