//! Work through a batch part by part, on one thread or more, until the caller stops it.

#[cfg(feature = "std")]
use std::sync::atomic::{AtomicBool, Ordering};
#[cfg(feature = "std")]
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
#[cfg(feature = "std")]
use std::time::Duration;

use core::num::NonZeroUsize;

use alloc::vec::Vec;

#[cfg(feature = "std")]
use super::threads::Helpers;
use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::kinematics::{Followed, Pose};

/// How often the caller is asked while it waits for other threads.
#[cfg(feature = "std")]
const WAIT: Duration = Duration::from_millis(20);

/// Rows worked through part by part, on one thread or more.
///
/// Each method reads and writes flat row-major slices. A row's answer has the same bits alone, in
/// any batch and on any number of threads.
///
/// ```
/// use irbkin::Robot;
/// use irbkin::batch::Batch;
///
/// let robot: Robot<6> = Robot::named("IRB 2600-12/1.65")?;
/// let mut poses = [0.0; 32];
/// Batch::new(None).fk(&robot, &[0.1; 12], &mut poses)?;
/// assert_eq!(poses[..16], poses[16..]);
/// # Ok::<(), irbkin::Error>(())
/// ```
pub struct Batch<'a> {
    /// Threads that may work, the caller's among them.
    #[cfg_attr(not(feature = "std"), expect(dead_code, reason = "there are no threads"))]
    threads: usize,
    /// Asked after each part, on the thread of the caller.
    interrupt: Interrupt<'a>,
}

impl Batch<'static> {
    /// A batch on up to `threads` threads, but no more than there are cores; without the feature
    /// `std`, on the caller's.
    #[must_use]
    pub fn new(threads: Option<NonZeroUsize>) -> Self {
        Self { threads: threads.map_or(1, NonZeroUsize::get), interrupt: Interrupt::none() }
    }
}

impl<'a> Batch<'a> {
    /// A batch that ends early when it is interrupted.
    #[doc(hidden)]
    pub fn until(threads: Option<NonZeroUsize>, interrupt: Interrupt<'a>) -> Self {
        Self { interrupt, ..Batch::new(threads) }
    }
}

impl Batch<'_> {
    /// Works on the parts of `rows` rows, in any order. Work that takes long asks whether to end.
    ///
    /// The caller works, too: it does not wait for threads that wake up late.
    pub fn run<P: Send>(
        &mut self,
        rows: usize,
        mut parts: impl Iterator<Item = P> + Send,
        work: impl Fn(P, Interrupt<'_>) + Sync,
    ) {
        #[cfg(feature = "std")]
        if let Some(helpers) = Helpers::of(self.threads, rows) {
            self.share(&helpers, parts, work);
            helpers.release();
            return;
        }
        let _ = rows;
        for part in parts.by_ref() {
            work(part, self.interrupt);
            if self.interrupt.is_raised() {
                return;
            }
        }
    }

    /// `follow` of paths of `length` poses each, one behind the other, from a seed each.
    #[doc(hidden)]
    pub fn follow<const N: usize>(
        &mut self,
        poses: &[Pose],
        length: usize,
        seeds: &[[f64; N]],
        follow: impl Fn(&[Pose], &[f64; N], Interrupt<'_>) -> Result<Followed<N>, Error> + Sync,
    ) -> Result<Vec<Followed<N>>, Error> {
        let mut answers: Vec<_> = seeds.iter().map(|_| None).collect();
        // One path is one part.
        let rows = if seeds.len() > 1 { poses.len() } else { 0 };
        let parts = seeds.iter().zip(&mut answers).enumerate();
        self.run(rows, parts, |(number, (seed, answer)), interrupt| {
            let path = &poses[number * length..(number + 1) * length];
            *answer = Some(follow(path, seed, interrupt));
        });
        answers.into_iter().flatten().collect()
    }

    /// Each thread takes the next part as long as there is one.
    #[cfg(feature = "std")]
    fn share<P: Send>(
        &mut self,
        helpers: &Helpers,
        parts: impl Iterator<Item = P> + Send,
        work: impl Fn(P, Interrupt<'_>) + Sync,
    ) {
        let (parts, stopped) = (Mutex::new(parts), AtomicBool::new(false));
        let next = || {
            let mut parts = parts.lock().unwrap_or_else(PoisonError::into_inner);
            if stopped.load(Ordering::Relaxed) { None } else { parts.next() }
        };
        let (next, work, stopped) = (&next, &work, &stopped);
        let count = helpers.count().min(self.threads - 1);
        let busy = Busy { count: Mutex::new(count), changed: Condvar::new() };
        helpers.pool().in_place_scope(|scope| {
            for _ in 0..count {
                scope.spawn(|_| {
                    let _counted = Ended(&busy);
                    while let Some(part) = next() {
                        work(part, Interrupt::when(&|| stopped.load(Ordering::Relaxed)));
                    }
                });
            }
            let is_raised = || {
                let is_raised = self.interrupt.is_raised();
                stopped.fetch_or(is_raised, Ordering::Relaxed);
                is_raised
            };
            while let Some(part) = next() {
                work(part, Interrupt::when(&is_raised));
                is_raised();
            }
            // The last parts of others may take long.
            while busy.is_any() {
                is_raised();
            }
        });
    }
}

/// The helpers that have not ended yet.
#[cfg(feature = "std")]
struct Busy {
    count: Mutex<usize>,
    changed: Condvar,
}

#[cfg(feature = "std")]
impl Busy {
    fn locked(&self) -> MutexGuard<'_, usize> {
        self.count.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Whether there are any, after waiting a moment for them to end.
    fn is_any(&self) -> bool {
        let waited = self.changed.wait_timeout_while(self.locked(), WAIT, |count| *count > 0);
        let (count, _) = waited.unwrap_or_else(PoisonError::into_inner);
        *count > 0
    }
}

/// Counts a helper out when it ends, in whatever way.
#[cfg(feature = "std")]
struct Ended<'a>(&'a Busy);

#[cfg(feature = "std")]
impl Drop for Ended<'_> {
    fn drop(&mut self) {
        *self.0.locked() -= 1;
        self.0.changed.notify_one();
    }
}

#[cfg(all(test, feature = "std"))]
mod tests {
    use super::*;
    use crate::batch::threads::WORTH_A_THREAD;
    use core::cell::Cell;
    use std::sync::atomic::AtomicUsize;
    use std::thread;
    use std::vec::Vec;

    #[test]
    fn a_batch_that_is_large_enough_gets_threads_where_there_are_cores_for_them() {
        let cores = thread::available_parallelism().map_or(1, usize::from);
        let size = |threads, rows| {
            let helpers = Helpers::of(threads, rows);
            let size = helpers.as_ref().map_or(1, |helpers| 1 + helpers.count());
            drop(helpers);
            size
        };
        assert_eq!(size(2, 17_001), 2.min(cores));
        assert_eq!(size(4, 17_001), 4.min(cores));
        assert_eq!([size(1, 17_001), size(0, 17_001), size(4, WORTH_A_THREAD - 1)], [1; 3]);
    }

    #[test]
    fn every_part_is_worked_on_once_on_any_number_of_threads() {
        for threads in 1..5 {
            let mut done = vec![0_u8; 1000];
            Batch::new(NonZeroUsize::new(threads)).run(100_000, done.chunks_mut(7), |part, _| {
                for row in part {
                    *row += 1;
                }
            });
            assert_eq!(done, [1; 1000], "{threads} threads");
        }
    }

    #[test]
    fn work_ends_when_the_caller_wants_no_more() {
        for threads in [1, 2] {
            let worked = AtomicUsize::new(0);
            let asked = Cell::new(0);
            let is_raised = || asked.replace(asked.get() + 1) >= 2;
            let mut pace = Batch { threads, interrupt: Interrupt::when(&is_raised) };
            pace.run(100_000, 0..1_000_000, |_, _| {
                worked.fetch_add(1, Ordering::Relaxed);
                thread::yield_now();
            });
            let worked = worked.into_inner();
            assert!(if threads == 1 { worked == 3 } else { worked < 1_000_000 }, "{worked}");
        }
    }

    #[test]
    fn the_caller_is_asked_while_it_waits_for_the_part_of_another_thread() {
        let caller = thread::current().id();
        let is_ended = || {
            let (asked, ended) = (Cell::new(0), AtomicBool::new(false));
            let is_raised = || asked.replace(asked.get() + 1) >= 3;
            let mut pace = Batch { threads: 2, interrupt: Interrupt::when(&is_raised) };
            pace.run(100_000, 0..2, |_, interrupt| {
                if thread::current().id() == caller {
                    thread::sleep(Duration::from_millis(5));
                    return;
                }
                while !interrupt.is_raised() {
                    thread::yield_now();
                }
                ended.store(true, Ordering::Relaxed);
            });
            ended.into_inner()
        };
        // Other tests may have the helpers, and the caller may take both parts.
        let cores = thread::available_parallelism().map_or(1, NonZeroUsize::get);
        assert!(cores == 1 || (0..100).any(|_| is_ended()), "no helper worked in 100 calls");
    }

    #[test]
    fn helpers_stay_for_the_next_call() {
        let ids = || {
            let seen = Mutex::new(Vec::new());
            Batch::new(NonZeroUsize::new(2)).run(100_000, 0..200, |_, _| {
                seen.lock().unwrap().push(thread::current().id());
                thread::sleep(std::time::Duration::from_micros(100));
            });
            let own = thread::current().id();
            let mut ids = seen.into_inner().unwrap();
            ids.retain(|id| *id != own);
            ids.dedup();
            ids
        };
        // Other tests may take them for a moment, and end them.
        let cores = thread::available_parallelism().map_or(1, NonZeroUsize::get);
        let stay = (0..100).any(|_| {
            let (first, second) = (ids(), ids());
            first == second && (cores == 1 || !first.is_empty())
        });
        assert!(stay, "no call of 100 had the helper of the one before");
    }
}
