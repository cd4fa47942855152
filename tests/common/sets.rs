//! The instruction sets of this processor, for the tests and the unit tests in `src`.

use std::sync::{Mutex, PoisonError};

use irbkin::InstructionSet;

/// Run `work` on each set in turn, one caller at a time, then return to the widest.
pub fn on_each_set(mut work: impl FnMut(InstructionSet)) {
    static FORCED: Mutex<()> = Mutex::new(());
    // A test that failed while it held the lock has reported its failure.
    let _one_at_a_time = FORCED.lock().unwrap_or_else(PoisonError::into_inner);
    // The widest is the last one.
    for set in InstructionSet::available() {
        set.force().unwrap();
        work(set);
    }
}
