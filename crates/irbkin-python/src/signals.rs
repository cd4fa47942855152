//! Batches that calculate without the interpreter's lock, end when a signal's handler raises
//! (Ctrl-C), and report how far they are.

use std::cell::RefCell;
use std::num::NonZeroUsize;
use std::time::{Duration, Instant};

use crate::errors::exception;
use pyo3::intern;
use pyo3::prelude::*;

use irbkin::batch::Batch;
use irbkin::{Interrupt, Pace};
use irbkin_abb::Error;

/// How long a signal may wait.
const PATIENCE: Duration = Duration::from_millis(50);

/// Works without the interpreter's lock, on up to `threads` threads; for as long as no signal's
/// handler raises an exception.
pub(super) fn detached<R: Send, E: Into<Error> + Send>(
    py: Python<'_>,
    threads: Option<NonZeroUsize>,
    work: impl FnOnce(&mut Batch<'_>) -> Result<R, E> + Send,
) -> PyResult<R> {
    detached_until(py, |interrupt| work(&mut Batch::until(threads, interrupt)))?.map_err(exception)
}

/// Works without the interpreter's lock, until a signal's handler raises an exception.
pub(super) fn detached_until<R: Send>(
    py: Python<'_>,
    work: impl FnOnce(Interrupt<'_>) -> R + Send,
) -> PyResult<R> {
    watched(py, None, work)
}

/// As [`detached_until`], for a caller who passed `progress`: a callable, or a bar of tqdm.
pub(super) fn watched<R: Send>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(Interrupt<'_>) -> R + Send,
) -> PyResult<R> {
    let reporter = |progress| {
        let arguments = py.import("irbkin._arguments")?;
        arguments.call_method1("reporter", (progress,)).map(Bound::unbind)
    };
    let report = progress.map(reporter).transpose()?;
    let mut signals = Signals { asked: Instant::now(), is_deaf: false, raised: None, report };
    let (answer, [_, all]) = py.detach(|| {
        let (pace, signals) = (Pace::default(), RefCell::new(&mut signals));
        let is_raised = || !signals.borrow_mut().is_quiet(pace.rounds());
        (work(Interrupt::when(&is_raised).with_pace(&pace)), pace.rounds())
    });
    match signals.raised.take() {
        Some(raised) => Err(raised),
        None => signals.report(py, [all; 2]).map(|()| answer),
    }
}

struct Signals {
    asked: Instant,
    /// Whether another thread than this is the one that handles signals.
    is_deaf: bool,
    raised: Option<PyErr>,
    /// A callable that is told how much is done, and with the whole.
    report: Option<Py<PyAny>>,
}

impl Signals {
    /// Whether no handler has raised anything; looks now and then.
    fn is_quiet(&mut self, rounds: [usize; 2]) -> bool {
        let is_deaf = self.is_deaf && self.report.is_none();
        if self.raised.is_none() && !is_deaf && self.asked.elapsed() >= PATIENCE {
            // Whatever runs Python's code may raise what a handler raises.
            let heard = Python::attach(|py| {
                self.report(py, rounds)?;
                py.check_signals()?;
                // The main thread handles signals.
                let threading = py.import(intern!(py, "threading"))?;
                let main = threading.call_method0(intern!(py, "main_thread"))?;
                Ok(threading.call_method0(intern!(py, "current_thread"))?.is(&main))
            });
            match heard {
                Ok(is_main) => self.is_deaf = !is_main,
                Err(raised) => self.raised = Some(raised),
            }
            self.asked = Instant::now();
        }
        self.raised.is_none()
    }

    fn report(&self, py: Python<'_>, [done, all]: [usize; 2]) -> PyResult<()> {
        self.report.as_ref().map_or(Ok(()), |report| report.call1(py, (done, all)).map(drop))
    }
}
