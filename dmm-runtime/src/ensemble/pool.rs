//! Batches of work on all cores, with the results in the order of the input.
//!
//! The calling thread takes the items from their iterator, a batch at a time, and hands the
//! results on as soon as all before them are there. There are a few batches a thread under way
//! at most, so that the memory needed does not depend on the number of items.

use std::any::Any;
use std::collections::VecDeque;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

/// Batches under way, for each thread.
const AHEAD: usize = 3;

/// A batch and its number.
type Job<Item> = (u64, Vec<Item>);
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
    /// Those of the batch to be delivered next and of the ones after it, where they are there.
    early: VecDeque<Option<Vec<Out>>>,
    /// The batch to be delivered next.
    next: u64,
    /// Results delivered.
    delivered: usize,
}

impl<Out, Sink: FnMut(usize, Out) -> ControlFlow<()>> Delivery<Out, Sink> {
    /// Takes what came of a batch, and delivers what is complete.
    fn take(&mut self, number: u64, results: Vec<Out>) -> ControlFlow<()> {
        let place = (number - self.next) as usize;
        if self.early.len() <= place {
            self.early.resize_with(place + 1, || None);
        }
        self.early[place] = Some(results);
        while let Some(results) = self.early.front_mut().and_then(Option::take) {
            self.early.pop_front();
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

/// What the calling thread and the others hand to each other.
struct Exchange<Item, Out> {
    state: Mutex<State<Item, Out>>,
    /// There is a job, or there will be none.
    given: Condvar,
    /// There is a result.
    made: Condvar,
}

/// See [`Exchange`].
struct State<Item, Out> {
    jobs: VecDeque<Job<Item>>,
    done: VecDeque<Done<Out>>,
    /// Whether there are no more jobs.
    is_closed: bool,
}

impl<Item, Out> Exchange<Item, Out> {
    fn new() -> Self {
        Self {
            state: Mutex::new(State {
                jobs: VecDeque::new(),
                done: VecDeque::new(),
                is_closed: false,
            }),
            given: Condvar::new(),
            made: Condvar::new(),
        }
    }

    fn lock(&self) -> MutexGuard<'_, State<Item, Out>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn give(&self, job: Job<Item>) {
        self.lock().jobs.push_back(job);
        self.given.notify_one();
    }

    /// Waits for a result.
    fn result(&self) -> Done<Out> {
        let mut state = self.lock();
        loop {
            if let Some(done) = state.done.pop_front() {
                return done;
            }
            let woken = self.made.wait(state);
            state = woken.unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Waits for a job; nothing if there are no more.
    fn job(&self) -> Option<Job<Item>> {
        let mut state = self.lock();
        loop {
            if let Some(job) = state.jobs.pop_front() {
                return Some(job);
            }
            if state.is_closed {
                return None;
            }
            let woken = self.given.wait(state);
            state = woken.unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Works on batches until there are no more.
    fn serve(&self, work: &(impl Fn(Vec<Item>) -> Vec<Out> + Sync)) {
        while let Some((number, batch)) = self.job() {
            // a thread that is gone must not be waited for
            let outcome = catch_unwind(AssertUnwindSafe(|| work(batch)));
            self.lock().done.push_back((number, outcome));
            self.made.notify_one();
        }
    }
}

/// Ends the work, also where a panic leaves it: what is not begun is not done.
struct Closes<'a, Item, Out>(&'a Exchange<Item, Out>);

impl<Item, Out> Drop for Closes<'_, Item, Out> {
    fn drop(&mut self) {
        let mut state = self.0.lock();
        state.is_closed = true;
        state.jobs.clear();
        drop(state);
        self.0.given.notify_all();
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
            early: VecDeque::new(),
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
        let exchange = Exchange::new();
        thread::scope(|scope| {
            let _closes = Closes(&exchange);
            for _ in 0..self.threads {
                scope.spawn(|| exchange.serve(&work));
            }
            self.feed(&mut batches, &exchange, &mut delivery);
        });
        delivery.delivered
    }

    /// Hands out batches and takes the results, until both are at an end.
    fn feed<Item, Out, Sink: FnMut(usize, Out) -> ControlFlow<()>>(
        self,
        batches: &mut Batches<impl Iterator<Item = Item>>,
        exchange: &Exchange<Item, Out>,
        delivery: &mut Delivery<Out, Sink>,
    ) {
        loop {
            let most = delivery.next + (AHEAD * self.threads) as u64;
            while batches.next < most
                && let Some(batch) = batches.next()
            {
                exchange.give(batch);
            }
            if delivery.next == batches.next {
                return;
            }
            let (number, results) = exchange.result();
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
