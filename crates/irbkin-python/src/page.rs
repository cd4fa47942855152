//! The engine of a page in a browser, which Python serves.

use std::sync::{Mutex, PoisonError};

use pyo3::prelude::*;

use irbkin_page::Page;

/// The engine of a page in a browser, with the robot, the cell and the program that requests set.
#[pyclass(frozen, module = "irbkin._core")]
#[derive(Default)]
pub(crate) struct PageEngine(Mutex<Page>);

#[pymethods]
impl PageEngine {
    #[new]
    fn new() -> Self {
        Self::default()
    }

    /// Return the answer to a request, both JSON (page/README.md).
    fn answer(&self, py: Python<'_>, request: &str) -> String {
        py.detach(|| self.0.lock().unwrap_or_else(PoisonError::into_inner).answer(request))
    }
}
