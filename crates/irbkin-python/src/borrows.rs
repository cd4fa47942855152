//! Memory that calls use while they calculate without the interpreter's lock.
//!
//! NumPy's own bookkeeping of borrows knows an array by the object that owns its memory. Two arrays
//! made of one buffer or of one address have no owner in common, so the addresses themselves are
//! kept. They change hands under the interpreter's lock only: whoever looks sees every call that is
//! under way. Two mappings of one file are two memories to any process, and are not told apart.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// The use that a call makes of memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Access {
    Read,
    Write,
}

struct Entry {
    number: usize,
    memory: Range<usize>,
    access: Access,
}

static ENTRIES: Mutex<Vec<Entry>> = Mutex::new(Vec::new());

/// How many borrows there are: where there are none, nobody waits for [`ENTRIES`].
static BORROWS: AtomicUsize = AtomicUsize::new(0);

/// How many of them write.
static WRITES: AtomicUsize = AtomicUsize::new(0);

/// Memory that is in use until this is dropped.
pub(super) struct Borrow {
    number: usize,
    access: Access,
}

impl Borrow {
    /// Takes `memory`, which must have been found free.
    pub(super) fn new(memory: Range<usize>, access: Access) -> Self {
        static NEXT: AtomicUsize = AtomicUsize::new(0);
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        locked(|entries| entries.push(Entry { number, memory, access }));
        BORROWS.fetch_add(1, Ordering::Relaxed);
        if access == Access::Write {
            WRITES.fetch_add(1, Ordering::Relaxed);
        }
        Self { number, access }
    }
}

impl Drop for Borrow {
    fn drop(&mut self) {
        locked(|entries| entries.retain(|entry| entry.number != self.number));
        BORROWS.fetch_sub(1, Ordering::Release);
        if self.access == Access::Write {
            WRITES.fetch_sub(1, Ordering::Release);
        }
    }
}

/// Whether any call writes.
#[inline]
pub(super) fn is_any_written() -> bool {
    WRITES.load(Ordering::Acquire) != 0
}

/// Whether memory may be used: read where no call writes it, written where no call uses it.
pub(super) fn is_free(memory: &Range<usize>, access: Access) -> bool {
    let users = match access {
        Access::Read => &WRITES,
        Access::Write => &BORROWS,
    };
    users.load(Ordering::Acquire) == 0
        || locked(|entries| {
            !entries.iter().any(|entry| {
                overlap(&entry.memory, memory)
                    && (access == Access::Write || entry.access == Access::Write)
            })
        })
}

pub(super) fn overlap(one: &Range<usize>, other: &Range<usize>) -> bool {
    one.start < other.end && other.start < one.end
}

fn locked<R>(work: impl FnOnce(&mut Vec<Entry>) -> R) -> R {
    work(&mut ENTRIES.lock().unwrap_or_else(PoisonError::into_inner))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_is_read_by_many_or_written_by_one() {
        let (read, write) = (Access::Read, Access::Write);
        assert!(is_free(&(10..20), write));
        let reader = Borrow::new(10..20, read);
        assert!(is_free(&(10..20), read) && !is_any_written());
        let free =
            [(0..10, true), (0..11, false), (19..30, false), (20..30, true), (12..13, false)];
        for (memory, is) in free.clone() {
            assert_eq!(is_free(&memory, write), is, "{memory:?}");
        }
        let second = Borrow::new(15..25, read);
        drop(reader);
        assert!(is_free(&(10..15), write) && !is_free(&(10..16), write));
        drop(second);
        let writer = Borrow::new(10..20, write);
        assert!(is_any_written());
        for (memory, is) in free {
            assert_eq!((is_free(&memory, write), is_free(&memory, read)), (is, is), "{memory:?}");
        }
        // Memory without elements overlaps nothing.
        assert!(is_free(&(15..15), write));
        drop(writer);
        assert!(is_free(&(10..20), write) && !is_any_written());
    }
}
