//! Batches of work on all cores, with the results in the order of the input.
//!
//! The calling thread takes the items from their iterator, a batch at a time, and hands the
//! results on as soon as all before them are there. There are a few batches a thread under way
//! at most, so that the memory needed does not depend on the number of items.

use std::any::Any;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// Batches under way, for each thread.
const AHEAD: usize = 3;

/// What came of a batch, or the panic that it ended in.
type Done<Out> = (u64, Result<Vec<Out>, Box<dyn Any + Send>>);

/// Threads, and how many items they are given at once.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pool {
    pub(super) threads: usize,
    pub(super) batch: usize,
}

/// The results on their way to the caller.
struct Delivery<Out, Sink> {
    sink: Sink,
    early: BTreeMap<u64, Vec<Out>>,
    /// The batch to be delivered next.
    next: u64,
    /// Results delivered.
    delivered: usize,
}

impl<Out, Sink: FnMut(usize, Out) -> ControlFlow<()>> Delivery<Out, Sink> {
    /// Takes what came of a batch, and delivers what is complete.
    fn take(&mut self, number: u64, results: Vec<Out>) -> ControlFlow<()> {
        self.early.insert(number, results);
        while let Some(results) = self.early.remove(&self.next) {
            self.next += 1;
            for result in results {
                let index = self.delivered;
                self.delivered += 1;
                (self.sink)(index, result)?;
            }
        }
        ControlFlow::Continue(())
    }
}

impl Pool {
    /// Does `work` on batches of `items`, which gives one result an item, and hands the results
    /// to `sink` with the number of their item, in order. Returns how many there were.
    pub(super) fn run<Item: Send, Out: Send>(
        self,
        items: impl Iterator<Item = Item>,
        work: impl Fn(Vec<Item>) -> Vec<Out> + Sync,
        sink: impl FnMut(usize, Out) -> ControlFlow<()>,
    ) -> usize {
        let mut batches = Batches {
            items,
            size: self.batch.max(1),
            next: 0,
        };
        let mut delivery = Delivery {
            sink,
            early: BTreeMap::new(),
            next: 0,
            delivered: 0,
        };
        if self.threads <= 1 {
            while let Some((number, batch)) = batches.next() {
                if delivery.take(number, work(batch)).is_break() {
                    break;
                }
            }
            return delivery.delivered;
        }
        let (jobs, queue) = mpsc::channel();
        let (results, done) = mpsc::channel();
        let queue = Mutex::new(queue);
        thread::scope(|scope| {
            for _ in 0..self.threads {
                let results = results.clone();
                let (queue, work) = (&queue, &work);
                scope.spawn(move || serve(queue, &results, work));
            }
            self.feed(&mut batches, &jobs, &done, &mut delivery);
            drop(jobs);
        });
        delivery.delivered
    }

    /// Hands out batches and takes the results, until both are at an end.
    fn feed<Item, Out, Sink: FnMut(usize, Out) -> ControlFlow<()>>(
        self,
        batches: &mut Batches<impl Iterator<Item = Item>>,
        jobs: &Sender<(u64, Vec<Item>)>,
        done: &Receiver<Done<Out>>,
        delivery: &mut Delivery<Out, Sink>,
    ) {
        loop {
            let most = delivery.next + (AHEAD * self.threads) as u64;
            while batches.next < most
                && let Some(batch) = batches.next()
            {
                if jobs.send(batch).is_err() {
                    return;
                }
            }
            if delivery.next == batches.next {
                return;
            }
            let Ok((number, results)) = done.recv() else {
                return;
            };
            match results {
                Ok(results) => {
                    if delivery.take(number, results).is_break() {
                        return;
                    }
                }
                Err(panic) => resume_unwind(panic),
            }
        }
    }
}

/// The items by batch.
struct Batches<I> {
    items: I,
    size: usize,
    /// The number of the next batch.
    next: u64,
}

impl<I: Iterator> Batches<I> {
    fn next(&mut self) -> Option<(u64, Vec<I::Item>)> {
        let batch: Vec<I::Item> = self.items.by_ref().take(self.size).collect();
        let number = self.next;
        (!batch.is_empty()).then(|| {
            self.next += 1;
            (number, batch)
        })
    }
}

/// Works on batches until there are no more.
fn serve<Item, Out>(
    queue: &Mutex<Receiver<(u64, Vec<Item>)>>,
    results: &Sender<Done<Out>>,
    work: &(impl Fn(Vec<Item>) -> Vec<Out> + Sync),
) {
    loop {
        let job = queue.lock().unwrap_or_else(PoisonError::into_inner).recv();
        let Ok((number, batch)) = job else { return };
        // a thread that is gone must not be waited for
        let outcome = catch_unwind(AssertUnwindSafe(|| work(batch)));
        if results.send((number, outcome)).is_err() {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Work that takes longest for the first items.
    fn squares(threads: usize, count: u64) -> Vec<(usize, u64)> {
        let mut seen = Vec::new();
        let work = |batch: Vec<u64>| {
            let first = batch.first().copied().unwrap_or_default();
            thread::sleep(std::time::Duration::from_micros(200 / (1 + first)));
            batch.into_iter().map(|i| i * i).collect()
        };
        let pool = Pool { threads, batch: 3 };
        let delivered = pool.run(0..count, work, |index, square| {
            seen.push((index, square));
            ControlFlow::Continue(())
        });
        assert_eq!(delivered, seen.len());
        seen
    }

    #[test]
    fn results_come_in_order() {
        for threads in [1, 2, 5] {
            for count in [0, 1, 3, 100] {
                let expected: Vec<(usize, u64)> = (0..count).map(|i| (i as usize, i * i)).collect();
                assert_eq!(squares(threads, count), expected, "{threads} {count}");
            }
        }
    }

    #[test]
    fn no_more_is_taken_than_fits_in_memory() {
        let pool = Pool {
            threads: 2,
            batch: 4,
        };
        let mut most = 0;
        let taken = std::cell::Cell::new(0);
        let items = (0..1000).inspect(|_| taken.set(taken.get() + 1));
        pool.run(
            items,
            |batch| batch,
            |index, _| {
                most = most.max(taken.get() - index);
                ControlFlow::Continue(())
            },
        );
        assert!(most <= (AHEAD * 2 + 1) * 4, "{most}");
    }

    #[test]
    fn an_endless_input_ends_when_the_sink_has_enough() {
        for threads in [1, 3] {
            let pool = Pool { threads, batch: 2 };
            let delivered = pool.run(
                0u64..,
                |batch| batch,
                |index, _| match index {
                    41 => ControlFlow::Break(()),
                    _ => ControlFlow::Continue(()),
                },
            );
            assert_eq!(delivered, 42);
        }
    }

    #[test]
    fn a_panic_is_passed_on() {
        let pool = Pool {
            threads: 2,
            batch: 1,
        };
        let work = |batch: Vec<u64>| {
            assert!(!batch.contains(&7), "seven");
            batch
        };
        let run = || pool.run(0..100, work, |_, _| ControlFlow::Continue(()));
        assert!(catch_unwind(AssertUnwindSafe(run)).is_err());
    }
}
