//! Threads that help the caller of a batch.
//!
//! They are started by the first batch that is worth them and stay: starting one takes as long as
//! a thousand poses. A call takes them for itself; one that comes meanwhile starts its own. A
//! process that was forked has none of its parent's threads and starts its own, too.

use std::mem;
use std::process;
use std::sync::Mutex;
use std::thread;

use rayon::{ThreadPool, ThreadPoolBuilder};

/// Fewest rows for which a second thread pays: waking it takes as long as some hundreds of them.
pub(super) const WORTH_A_THREAD: usize = 4096;

/// Threads that no call uses at the moment.
static IDLE: Mutex<Option<Helpers>> = Mutex::new(None);

/// Threads, for the time of a call.
pub(super) struct Helpers {
    /// The process that they run in.
    process: u32,
    pool: ThreadPool,
}

impl Helpers {
    /// The helpers of a batch of `rows` that may run on `threads` threads, the caller's among
    /// them; `None` where they would not pay. No more threads than there are cores.
    pub(super) fn of(threads: usize, rows: usize) -> Option<Self> {
        if threads <= 1 || rows < WORTH_A_THREAD {
            return None;
        }
        let cores = thread::available_parallelism().map_or(1, usize::from);
        let threads = threads.min(2 * rows / WORTH_A_THREAD).min(cores);
        if threads <= 1 { None } else { Self::take(threads - 1) }
    }

    fn take(count: usize) -> Option<Self> {
        // Never waits: a fork may have copied the lock while a thread of the parent held it.
        let idle = IDLE.try_lock().ok()?.take();
        match idle {
            // The threads of a parent are not here to be ended.
            Some(idle) if idle.process != process::id() => mem::forget(idle),
            Some(idle) if idle.count() >= count => return Some(idle),
            _ => {}
        }
        let pool = ThreadPoolBuilder::new().num_threads(count).build().ok()?;
        Some(Self { process: process::id(), pool })
    }

    pub(super) fn count(&self) -> usize {
        self.pool.current_num_threads()
    }

    pub(super) fn pool(&self) -> &ThreadPool {
        &self.pool
    }

    /// Leaves them to the next call. Of two calls that end, the helpers of one stay.
    pub(super) fn release(self) {
        if let Ok(mut idle) = IDLE.try_lock()
            && idle.as_ref().is_none_or(|idle| idle.count() < self.count())
        {
            *idle = Some(self);
        }
    }
}
