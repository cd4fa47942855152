//! `irbkin.rapid.Module`.

use std::collections::BTreeSet;

use pyo3::prelude::*;
use pyo3::pybacked::PyBackedStr;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyIterator, PyMappingProxy, PyTuple};

use super::program::{Declaration, Move, Routine, Skipped, TextFault};
use super::values::{content, read_content};
use crate::errors::{Fault, exception, raised};
use irbkin::internal::similar;
use irbkin_abb::rapid;
use irbkin_abb::rapid::{Content, Datum, Module, NewValue};

/// A RAPID module: its data by name, its moves in order, and what was skipped.
///
/// A mapping of the names of the module's own data to their values: `module["p10"]`, `len`,
/// iteration, `in`, `get`, `keys`, `values`, `items`. Names are taken as RAPID takes them, in upper
/// or lower case. Frozen and picklable; two modules are equal where they declare and move the same,
/// whatever the lines. `parse` and `load` make one.
#[pyclass(name = "Module", module = "irbkin.rapid", eq, frozen, weakref)]
pub(crate) struct RapidModule {
    pub(super) module: Module,
    pub(super) source: String,
    /// The modules that names were looked for in.
    pub(super) context: Vec<Py<Self>>,
    data: PyOnceLock<Py<PyDict>>,
    moves: PyOnceLock<Py<PyTuple>>,
}

impl PartialEq for RapidModule {
    fn eq(&self, other: &Self) -> bool {
        self.module.clone().without_positions() == other.module.clone().without_positions()
    }
}

/// A text, and the modules that its names are looked for in.
type Source<'a, 'py> = (&'a str, Bound<'py, PyTuple>);

impl RapidModule {
    pub(super) fn new(module: Module, source: String, context: Vec<Py<Self>>) -> Self {
        Self { module, source, context, data: PyOnceLock::new(), moves: PyOnceLock::new() }
    }

    /// The data of the module itself.
    fn own_data(&self) -> impl Iterator<Item = &Datum> {
        self.module.data().iter().filter(|datum| datum.routine.is_none())
    }

    fn data_dict<'py>(&self, py: Python<'py>) -> PyResult<&Bound<'py, PyDict>> {
        let dict = self.data.get_or_try_init(py, || {
            let dict = PyDict::new(py);
            for datum in self.own_data() {
                dict.set_item(&datum.name, content(py, &datum.content)?)?;
            }
            Ok::<_, PyErr>(dict.unbind())
        });
        Ok(dict?.bind(py))
    }
}

#[pymethods]
impl RapidModule {
    /// Its name; None for declarations without a module around them.
    #[getter]
    fn name(&self) -> Option<&str> {
        self.module.name()
    }

    /// Its attributes, such as "SYSMODULE".
    #[getter]
    fn attributes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.module.attributes())
    }

    /// The text that it was read from.
    #[getter]
    fn source(&self) -> &str {
        &self.source
    }

    /// The data of the module itself, in the order of the text: names to records, to nested lists
    /// of records for arrays, to None if the declaration has no value. Data of routines are in
    /// `declarations`.
    #[getter]
    fn data<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyMappingProxy>> {
        Ok(PyMappingProxy::new(py, self.data_dict(py)?.as_mapping()))
    }

    /// Every declaration, of routines too: a tuple of `Declaration`.
    #[getter]
    fn declarations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let declarations = self.module.data().iter().map(|datum| Declaration::of(py, datum));
        PyTuple::new(py, declarations.collect::<PyResult<Vec<_>>>()?)
    }

    /// Its procedures, functions and traps, in the order of the text: a tuple of `Routine`.
    #[getter]
    fn routines<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.module.routines().iter().map(Routine::from))
    }

    /// The instructions that move, MoveL as well as TriggL and ArcL, in the order of the text,
    /// whatever branch or loop they are in.
    #[getter]
    fn moves<'py>(&self, py: Python<'py>) -> PyResult<&Bound<'py, PyTuple>> {
        let moves = self.moves.get_or_try_init(py, || {
            let moves = self.module.moves().iter().map(|step| Move::of(py, step));
            Ok::<_, PyErr>(PyTuple::new(py, moves.collect::<PyResult<Vec<_>>>()?)?.unbind())
        });
        Ok(moves?.bind(py))
    }

    /// The parts that were not read, in the order of the text: a tuple of `Skipped`.
    #[getter]
    fn skipped<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.module.skipped().into_iter().map(Skipped::from))
    }

    /// The faults of the text, in its order: a tuple of `TextFault`, which is empty
    /// for modules of `parse` and `load`; modules of `load_program` may have faults.
    #[getter]
    fn faults<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.module.faults().iter().map(TextFault::from))
    }

    /// Return the source with other values for some data; everything else, comments included, stays
    /// as it is, character for character.
    ///
    /// Args:
    ///     values: Names of the module's data to records of their type, to nested lists of as many
    ///         for arrays. None leaves a declaration without a value as it is.
    ///
    /// Returns:
    ///     The text.
    ///
    /// Raises:
    ///     RapidError: The module has no such data, or a value is of another type or size.
    fn rewritten(&self, values: &Bound<'_, PyAny>) -> PyResult<String> {
        let mut new_values = Vec::new();
        for item in values.call_method0("items")?.try_iter()? {
            let (name, value): (String, Bound<'_, PyAny>) = item?.extract()?;
            let (index, datum) = self.found(&name)?;
            if value.is_none() && matches!(datum.content, Content::Uninitialized { .. }) {
                continue;
            }
            let given = read_content(&value, &name)?;
            let sizes = match &datum.content {
                Content::Single(_) => &[][..],
                Content::Uninitialized { sizes } | Content::Array { sizes, .. } => sizes,
            };
            if given.sizes != sizes {
                return Err(Fault::Rapid.error(format_args!(
                    "{name} has dimensions {sizes:?}, the new value has {:?}",
                    given.sizes
                )));
            }
            let single = sizes.is_empty();
            new_values.extend(given.values.into_iter().enumerate().map(|(number, value)| {
                let value = value.into_type(datum.data_type);
                NewValue { datum: index, element: (!single).then_some(number), value }
            }));
        }
        rapid::rewrite(&self.source, &self.module, &new_values).map_err(exception)
    }

    /// Return the names of the module's own data, in the order of the text.
    fn keys<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.data(py)?.call_method0("keys")
    }

    /// Return the values of the module's own data, in the order of the text.
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.data(py)?.call_method0("values")
    }

    /// Return the pairs (name, value) of the module's own data, in the order of the text.
    fn items<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.data(py)?.call_method0("items")
    }

    /// Return the value of a datum of the module; `default` if the module has no such name.
    #[pyo3(signature = (name, default=None, /))]
    fn get<'py>(
        &self,
        name: &Bound<'py, PyAny>,
        default: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        match self.key(name) {
            Some(key) => self.data_dict(name.py())?.as_any().get_item(key),
            None => Ok(default.unwrap_or_else(|| name.py().None().into_bound(name.py()))),
        }
    }

    fn __getitem__<'py>(&self, name: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let key = self.key(name).ok_or_else(|| self.unknown(name))?;
        self.data_dict(name.py())?.as_any().get_item(key)
    }

    fn __contains__(&self, name: &Bound<'_, PyAny>) -> bool {
        self.key(name).is_some()
    }

    fn __len__(&self) -> usize {
        self.own_data().count()
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        self.data_dict(py)?.try_iter()
    }

    fn __reversed__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.data(py)?.call_method0("__reversed__")
    }

    /// The text and the context are read again.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Source<'_, 'py>)> {
        let context = PyTuple::new(py, &self.context)?;
        let is_sound = self.module.faults().is_empty();
        let reader = if is_sound { "parse_module" } else { "read_module" };
        Ok((py.import("irbkin._core")?.getattr(reader)?, (&self.source, context)))
    }

    /// The module as RAPID text, as `dump` writes it.
    fn __str__(&self) -> String {
        self.module.to_string()
    }

    fn __repr__(&self) -> String {
        let (data, moves) = (self.module.data().len(), counted(self.module.moves().len(), "move"));
        format!(
            "Module({:?}: {data} data, {moves}, {} skipped)",
            self.module.name().unwrap_or(""),
            self.module.skipped().len()
        )
    }
}

impl RapidModule {
    /// The name of a datum as it is written in the text.
    fn key(&self, name: &Bound<'_, PyAny>) -> Option<&str> {
        let name: PyBackedStr = name.extract().ok()?;
        self.module.find(&name).map(|datum| datum.name.as_str())
    }

    /// The error for a name that the module does not have, with names that are spelled alike.
    fn unknown(&self, name: &Bound<'_, PyAny>) -> PyErr {
        let known: Vec<&str> = self.own_data().map(|datum| datum.name.as_str()).collect();
        let wanted = name.extract::<PyBackedStr>();
        let close = wanted.as_ref().map(|wanted| close_names(wanted, &known)).unwrap_or_default();
        let hint = if !close.is_empty() {
            format!("did you mean {}?", close.join(", "))
        } else if known.is_empty() {
            "the module declares none outside its routines".to_owned()
        } else {
            format!("it has {} others: list(module)", known.len())
        };
        let shown = name.repr().map_or_else(|_| "this".to_owned(), |repr| repr.to_string());
        let message = format!("the module has no data of the name {shown}; {hint}");
        raised("UnknownNameError", message)
    }

    /// A datum of the module itself, and its index.
    fn found(&self, name: &str) -> PyResult<(usize, &Datum)> {
        let found = self.module.position(name).zip(self.module.find(name));
        let none = || Fault::Rapid.error(format_args!("the module has no data named {name:?}"));
        found.ok_or_else(none)
    }
}

pub(super) fn counted(number: usize, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

/// Names that are spelled like another one, the closest first.
pub(super) fn close_names<'a>(wanted: &str, known: &[&'a str]) -> Vec<&'a str> {
    /// Share of the letters that must be right [1].
    const LEAST_SIMILARITY: f64 = 0.6;
    const MOST_CLOSE: usize = 4;
    let others = known.iter().filter(|it| !it.eq_ignore_ascii_case(wanted));
    let others: BTreeSet<&str> = others.copied().collect();
    let wanted = wanted.to_lowercase();
    let similarity =
        |name: &str| strsim::normalized_damerau_levenshtein(&wanted, &name.to_lowercase());
    let mut close = similar(others.into_iter(), similarity, LEAST_SIMILARITY);
    close.truncate(MOST_CLOSE);
    close
}
