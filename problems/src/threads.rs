//! Parts of a study on threads of their own.

use std::panic::resume_unwind;
use std::thread;

/// Does `work` for each item on a thread of its own, and tells `ended` of the results in the order of the
/// items, each as soon as those before it are there. A panic of `work` goes on here.
///
/// ```
/// let mut squares = Vec::new();
/// dmm_problems::threads::side_by_side(1..4, |k| k * k, |square| squares.push(square));
/// assert_eq!(squares, [1, 4, 9]);
/// ```
pub fn side_by_side<T: Send, R: Send>(
    items: impl IntoIterator<Item = T>,
    work: impl Fn(T) -> R + Sync,
    mut ended: impl FnMut(R),
) {
    let work = &work;
    thread::scope(|scope| {
        let items = items.into_iter();
        let started: Vec<_> = items.map(|item| scope.spawn(move || work(item))).collect();
        for thread in started {
            ended(thread.join().unwrap_or_else(|panic| resume_unwind(panic)));
        }
    });
}
