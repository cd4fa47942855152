//! Batches that calculate without the interpreter's lock, and end when a signal's handler raises:
//! Ctrl-C.

use std::cell::RefCell;
use std::num::NonZeroUsize;
use std::time::{Duration, Instant};

use pyo3::intern;
use pyo3::prelude::*;

use crate::batch::Batch;
use crate::error::Error;
use crate::interrupt::Interrupt;

/// How long a signal may wait.
const PATIENCE: Duration = Duration::from_millis(50);

/// Works without the interpreter's lock, on up to `threads` threads; for as long as no signal's
/// handler raises an exception.
pub(super) fn detached<R: Send>(
    py: Python<'_>,
    threads: Option<NonZeroUsize>,
    work: impl FnOnce(&mut Batch<'_>) -> Result<R, Error> + Send,
) -> PyResult<R> {
    Ok(detached_until(py, |interrupt| work(&mut Batch::until(threads, interrupt)))??)
}

/// Works without the interpreter's lock, until a signal's handler raises an exception.
pub(super) fn detached_until<R: Send>(
    py: Python<'_>,
    work: impl FnOnce(Interrupt<'_>) -> R + Send,
) -> PyResult<R> {
    let mut signals = Signals { asked: Instant::now(), is_deaf: false, raised: None };
    let answer = py.detach(|| {
        let signals = RefCell::new(&mut signals);
        work(Interrupt::when(&|| !signals.borrow_mut().is_quiet()))
    });
    match signals.raised {
        Some(raised) => Err(raised),
        None => Ok(answer),
    }
}

/// The signals of a call.
struct Signals {
    asked: Instant,
    /// Whether another thread than this is the one that handles signals.
    is_deaf: bool,
    /// The exception that a handler raised.
    raised: Option<PyErr>,
}

impl Signals {
    /// Whether no handler has raised anything; looks now and then.
    fn is_quiet(&mut self) -> bool {
        if self.raised.is_none() && !self.is_deaf && self.asked.elapsed() >= PATIENCE {
            // Whatever runs Python's code may raise what a handler raises.
            let heard = Python::attach(|py| py.check_signals().and_then(|()| is_main_thread(py)));
            match heard {
                Ok(is_main) => self.is_deaf = !is_main,
                Err(raised) => self.raised = Some(raised),
            }
            self.asked = Instant::now();
        }
        self.raised.is_none()
    }
}

/// Whether this is the thread that handles signals.
fn is_main_thread(py: Python<'_>) -> PyResult<bool> {
    let threading = py.import(intern!(py, "threading"))?;
    let main = threading.call_method0(intern!(py, "main_thread"))?;
    Ok(threading.call_method0(intern!(py, "current_thread"))?.is(&main))
}
