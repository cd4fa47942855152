//! `irbkin.rapid.Module`.

use pyo3::prelude::*;
use pyo3::pybacked::PyBackedStr;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyIterator, PyMappingProxy, PyTuple};

use super::records::{
    content, joint_target, read_content, record, rob_target, speed_data, zone_data,
};
use crate::python::classes;
use crate::python::errors::{rapid_fault, to_py, unknown_name};
use crate::rapid::{
    self, Argument, Content, Datum, Module, MotionSettings, Move, NewValue, Reason, Target, Value,
};
use crate::spelling::similar;

/// A RAPID module: its data by name, its moves in order, and what was skipped.
///
/// A mapping of the names of the module's own data to their values: `module["p10"]`, `len`,
/// iteration, `in`, `get`, `keys`, `values`, `items`. Names are taken as RAPID takes them, in upper
/// or lower case. Frozen and picklable; two modules are equal where they declare and move the same,
/// whatever the lines. `parse` and `load` make one.
#[pyclass(name = "Module", module = "irbkin.rapid", frozen, weakref)]
pub(crate) struct RapidModule {
    pub(super) module: Module,
    pub(super) source: String,
    /// The modules that names were looked for in.
    pub(super) context: Vec<Py<Self>>,
    data: PyOnceLock<Py<PyDict>>,
    moves: PyOnceLock<Py<PyTuple>>,
}

/// A text, and the modules that its names are looked for in.
type Source<'a, 'py> = (&'a str, Bound<'py, PyTuple>);

impl RapidModule {
    pub(super) fn new(module: Module, source: String, context: Vec<Py<Self>>) -> Self {
        Self { module, source, context, data: PyOnceLock::new(), moves: PyOnceLock::new() }
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

    /// Every declaration, including those of routines: a tuple of `Declaration`.
    #[getter]
    fn declarations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let declarations = self.module.data().iter().map(|datum| declaration(py, datum));
        PyTuple::new(py, declarations.collect::<PyResult<Vec<_>>>()?)
    }

    /// MoveJ, MoveL, MoveC and MoveAbsJ in the order of the text, whatever branch or loop they are
    /// in.
    #[getter]
    fn moves<'py>(&self, py: Python<'py>) -> PyResult<&Bound<'py, PyTuple>> {
        let moves = self.moves.get_or_try_init(py, || {
            let moves = self.module.moves().iter().map(|step| move_record(py, step));
            Ok::<_, PyErr>(PyTuple::new(py, moves.collect::<PyResult<Vec<_>>>()?)?.unbind())
        });
        Ok(moves?.bind(py))
    }

    /// What was not read, in the order of the text: a tuple of `Skipped`.
    #[getter]
    fn skipped<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let class = classes::skipped_class(py)?;
        let skipped = self.module.skipped().iter().map(|part| {
            let what = part.what.to_string();
            class.call1((part.line, part.column, &part.routine, what, &part.text))
        });
        PyTuple::new(py, skipped.collect::<PyResult<Vec<_>>>()?)
    }

    /// Return the source with other values for some data; everything else, comments included, stays
    /// as it is, character for character.
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

    /// Return the value of a datum of the module; `default` where there is none of that name.
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
        self.module.data().iter().filter(|datum| datum.routine.is_none()).count()
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
        Ok((py.import("irbkin._core")?.getattr("parse")?, (&self.source, context)))
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
    /// The name of a datum as it is written in the text.
    fn key(&self, name: &Bound<'_, PyAny>) -> Option<&str> {
        let name: PyBackedStr = name.extract().ok()?;
        self.module.find(&name).map(|datum| datum.name.as_str())
    }

    /// The error for a name that the module does not have; it tells those that are spelled alike.
    fn unknown(&self, name: &Bound<'_, PyAny>) -> PyErr {
        let py = name.py();
        let known = self.module.data().iter().filter(|datum| datum.routine.is_none());
        let known: Vec<&str> = known.map(|datum| datum.name.as_str()).collect();
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
        unknown_name(py, format!("the module has no data of the name {shown}; {hint}"))
    }

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
    let speed = known(py, &step.speed, &step.speed_data, |speed| speed_data(py, speed))?;
    let zone = known(py, &step.zone, &step.zone_data, |zone| zone_data(py, zone))?;
    let time = step.time.as_ref().map(|time| {
        let is_time = |option: &&rapid::MoveOption| option.name.eq_ignore_ascii_case("T");
        let text = step.options.iter().find(is_time).and_then(|option| option.text.as_deref());
        known(py, text.unwrap_or_default(), time, |time| Ok(time.into_pyobject(py)?.into_any()))
    });
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
        speed,
        zone,
        time.transpose()?.into_pyobject(py)?.into_any(),
        motion_settings(py, step.settings)?,
    ];
    classes::move_class(py)?.call1(PyTuple::new(py, fields)?)
}

fn argument<'py, T>(
    py: Python<'py>,
    argument: &Argument<T>,
    record: impl FnOnce(&T) -> PyResult<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    known(py, &argument.text, &argument.value, record)
}

/// What is written, with its value or the reason why that is not known.
fn known<'py, T>(
    py: Python<'py>,
    text: &str,
    value: &Result<T, Reason>,
    record: impl FnOnce(&T) -> PyResult<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let (value, reason) = match value {
        Ok(value) => (Some(record(value)?), None),
        Err(reason) => (None, Some(reason.to_string())),
    };
    classes::argument_class(py)?.call1((text, value, reason))
}

fn motion_settings(py: Python<'_>, settings: MotionSettings) -> PyResult<Bound<'_, PyAny>> {
    let MotionSettings { conf_l, conf_j, sing_area, cir_path_mode } = settings;
    let fields = (conf_l, conf_j, sing_area.name(), cir_path_mode.name());
    classes::motion_settings_class(py)?.call1(fields)
}

/// Names that are spelled like another one, the closest first.
pub(super) fn close_names<'a>(wanted: &str, known: &[&'a str]) -> Vec<&'a str> {
    /// Share of the letters that must be right [1].
    const LEAST_SIMILARITY: f64 = 0.6;
    const MOST_CLOSE: usize = 4;
    let wanted = wanted.to_lowercase();
    let similarity =
        |name: &str| strsim::normalized_damerau_levenshtein(&wanted, &name.to_lowercase());
    let mut close = similar(known.iter().copied(), similarity, LEAST_SIMILARITY);
    close.truncate(MOST_CLOSE);
    close
}
