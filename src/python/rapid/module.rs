//! `irbkin.rapid.Module`.

use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyMappingProxy, PyTuple};

use super::records::{content, joint_target, read_content, record, rob_target};
use crate::python::classes;
use crate::python::errors::{rapid_fault, to_py};
use crate::rapid::{self, Argument, Content, Datum, Module, Move, NewValue, Target, Value};

/// A RAPID module: its data by name, its moves in order, what was skipped. Frozen; equal where it
/// says the same, wherever that stands.
///
/// `parse` and `load` make one.
#[pyclass(name = "Module", module = "irbkin.rapid", frozen)]
pub(crate) struct RapidModule {
    pub(super) module: Module,
    source: String,
    data: PyOnceLock<Py<PyDict>>,
    moves: PyOnceLock<Py<PyTuple>>,
}

impl RapidModule {
    pub(super) fn new(module: Module, source: String) -> Self {
        Self { module, source, data: PyOnceLock::new(), moves: PyOnceLock::new() }
    }

    fn data_dict<'py>(&self, py: Python<'py>) -> PyResult<&Bound<'py, PyDict>> {
        let dict = self.data.get_or_try_init(py, || {
            let dict = PyDict::new(py);
            for datum in self.module.data().iter().filter(|datum| datum.routine.is_none()) {
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
    /// of records for arrays, to None where the declaration has no value. Those of routines are in
    /// `declarations`.
    #[getter]
    fn data<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyMappingProxy>> {
        Ok(PyMappingProxy::new(py, self.data_dict(py)?.as_mapping()))
    }

    /// Every declaration, those of routines too: (name, type, scope, storage, routine, value, line,
    /// column).
    #[getter]
    fn declarations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let declarations = self.module.data().iter().map(|datum| declaration(py, datum));
        PyTuple::new(py, declarations.collect::<PyResult<Vec<_>>>()?)
    }

    /// MoveJ, MoveL, MoveC and MoveAbsJ in the order of the text, whatever branch or loop they
    /// stand in.
    #[getter]
    fn moves<'py>(&self, py: Python<'py>) -> PyResult<&Bound<'py, PyTuple>> {
        let moves = self.moves.get_or_try_init(py, || {
            let moves = self.module.moves().iter().map(|step| move_record(py, step));
            Ok::<_, PyErr>(PyTuple::new(py, moves.collect::<PyResult<Vec<_>>>()?)?.unbind())
        });
        Ok(moves?.bind(py))
    }

    /// What was not read, in the order of the text: (line, column, routine, what, text).
    #[getter]
    fn skipped<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let class = classes::skipped_class(py)?;
        let skipped = self.module.skipped().iter().map(|part| {
            let what = part.what.to_string();
            class.call1((part.line, part.column, &part.routine, what, &part.text))
        });
        PyTuple::new(py, skipped.collect::<PyResult<Vec<_>>>()?)
    }

    /// The source with other values for some data: everything else, comments too, stays as it is,
    /// character for character.
    ///
    /// Args:
    ///     values: Names of the module's data to records of their type, to nested lists of as many
    ///         for arrays.
    ///
    /// Returns:
    ///     The text.
    ///
    /// Raises:
    ///     RapidError: The module has no such data, or a value is of another type or size.
    fn rewritten(&self, values: &Bound<'_, PyAny>) -> PyResult<String> {
        let py = values.py();
        let mut new_values = Vec::new();
        for item in values.call_method0("items")?.try_iter()? {
            let (name, value): (String, Bound<'_, PyAny>) = item?.extract()?;
            let (index, datum) = self.found(py, &name)?;
            let given = read_content(&value, &name)?;
            let sizes = match &datum.content {
                Content::Single(_) => &[][..],
                Content::Uninitialized { sizes } | Content::Array { sizes, .. } => sizes,
            };
            if given.sizes != sizes {
                return Err(rapid_fault(
                    py,
                    format!("{name} has dimensions {sizes:?}, the new value has {:?}", given.sizes),
                ));
            }
            let single = sizes.is_empty();
            new_values.extend(given.values.into_iter().enumerate().map(|(number, value)| {
                NewValue { datum: index, element: (!single).then_some(number), value }
            }));
        }
        rapid::rewrite(&self.source, &self.module, &new_values).map_err(|error| to_py(py, &error))
    }

    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let datum = self.module.find(name).ok_or_else(|| PyKeyError::new_err(name.to_owned()))?;
        self.data_dict(py)?.as_any().get_item(&datum.name)
    }

    fn __contains__(&self, name: &str) -> bool {
        self.module.find(name).is_some()
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        let same = |other: &Self| {
            self.module.clone().without_positions() == other.module.clone().without_positions()
        };
        other.cast::<Self>().is_ok_and(|other| same(other.get()))
    }

    /// The module as RAPID text, as `dump` writes it.
    fn __str__(&self) -> String {
        self.module.to_string()
    }

    fn __repr__(&self) -> String {
        let count = |number: usize, what: &str| {
            format!("{number} {what}{}", if number == 1 { "" } else { "s" })
        };
        let (data, moves) = (self.module.data().len(), count(self.module.moves().len(), "move"));
        format!(
            "Module({:?}: {data} data, {moves}, {} skipped)",
            self.module.name().unwrap_or(""),
            self.module.skipped().len()
        )
    }
}

impl RapidModule {
    /// A datum of the module itself, and its index.
    fn found(&self, py: Python<'_>, name: &str) -> PyResult<(usize, &Datum)> {
        let found = self.module.position(name).zip(self.module.find(name));
        found.ok_or_else(|| rapid_fault(py, format!("the module has no data named {name:?}")))
    }
}

fn declaration<'py>(py: Python<'py>, datum: &Datum) -> PyResult<Bound<'py, PyAny>> {
    let value = content(py, &datum.content)?;
    let fields = (
        &datum.name,
        datum.data_type.name(),
        datum.scope.word(),
        datum.storage.word(),
        &datum.routine,
        value,
        datum.line,
        datum.column,
    );
    classes::declaration_class(py)?.call1(fields)
}

fn move_record<'py>(py: Python<'py>, step: &Move) -> PyResult<Bound<'py, PyAny>> {
    let target = argument(py, &step.target, |target| match target {
        Target::RobTarget(target) => rob_target(py, target),
        Target::JointTarget(target) => joint_target(py, target),
    })?;
    let via =
        step.via.as_ref().map(|via| argument(py, via, |via| rob_target(py, via))).transpose()?;
    let tool = argument(py, &step.tool, |tool| record(py, &Value::ToolData(*tool)))?;
    let wobj = step
        .wobj
        .as_ref()
        .map(|wobj| argument(py, wobj, |wobj| record(py, &Value::WobjData(wobj.clone()))))
        .transpose()?;
    let options = PyTuple::new(py, step.options.iter().map(|option| (&option.name, &option.text)))?;
    let fields = [
        step.kind.name().into_pyobject(py)?.into_any(),
        (&step.routine).into_pyobject(py)?.into_any(),
        target,
        via.into_pyobject(py)?.into_any(),
        (&step.speed).into_pyobject(py)?.into_any(),
        (&step.zone).into_pyobject(py)?.into_any(),
        tool,
        wobj.into_pyobject(py)?.into_any(),
        options.into_any(),
        step.line.into_pyobject(py)?.into_any(),
        step.column.into_pyobject(py)?.into_any(),
        step.displaced.into_pyobject(py)?.into_any(),
    ];
    classes::move_class(py)?.call1(PyTuple::new(py, fields)?)
}

fn argument<'py, T>(
    py: Python<'py>,
    argument: &Argument<T>,
    record: impl FnOnce(&T) -> PyResult<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let (value, reason) = match &argument.value {
        Ok(value) => (Some(record(value)?), None),
        Err(reason) => (None, Some(reason.to_string())),
    };
    classes::argument_class(py)?.call1((&argument.text, value, reason))
}
