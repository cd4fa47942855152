//! RAPID text read and written.

use std::collections::BTreeSet;

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyMapping};

use super::module::RapidModule;
use super::values::{Elements, read_content, record};
use crate::errors::{Fault, exception};
use crate::signals::detached_until;
use irbkin_abb::rapid;
use irbkin_abb::rapid::internal::{Faults, read_with};
use irbkin_abb::rapid::{Content, Datum, Module, RapidFault, Storage, Value};

/// Return the RAPID text of a record, of a module, or of a mapping of names to values.
///
/// `parse` gives back modules with all their data, and single RobTarget, JointTarget, ToolData,
/// WobjData, Pose and LoadData. The text of any other single value belongs into a declaration:
/// alone its shape does not determine its type, and `parse` refuses it.
///
/// Args:
///     value: RobTarget, JointTarget, ToolData, WobjData, Pose, LoadData, SpeedData, ZoneData,
///         Configuration, a number, a tuple of 3 (pos), 4 (orient) or 6 (extjoint) numbers, nested
///         lists of these for an array: the text of the value. A Module, or a mapping of names to
///         values: the text of a module, with tools and work objects as PERS, others as CONST.
///     name: Name of the module that is made of a mapping.
///
/// Raises:
///     RapidError: A value is not RAPID data or not finite, or a name is not an identifier.
#[pyfunction]
#[pyo3(signature = (value, name="Data"))]
pub(crate) fn dump(value: &Bound<'_, PyAny>, name: &str) -> PyResult<String> {
    if let Ok(module) = value.cast::<RapidModule>() {
        return Ok(module.get().module.to_string());
    }
    let module = |name: &str, data| Module::new(Some(name.to_owned()), data, Vec::new(), &[]);
    let Ok(data) = value.cast::<PyMapping>() else {
        let datum = datum("value".to_owned(), value)?;
        let text = datum.content.to_string();
        // A module takes only what can be read again.
        module("Value", vec![datum]).map_err(exception)?;
        return Ok(text);
    };
    let mut declared = Vec::new();
    for item in data.items()? {
        let (name, value): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
        let name = name.extract().map_err(|_| {
            Fault::Rapid.error(format_args!(
                "{name} is not a RAPID identifier (a letter, then letters, digits, _)"
            ))
        })?;
        declared.push(datum(name, &value)?);
    }
    Ok(module(name, declared).map_err(exception)?.to_string())
}

/// The declaration of a Python record, or of nested lists of records.
fn datum(name: String, value: &Bound<'_, PyAny>) -> PyResult<Datum> {
    let Elements { sizes, values } = read_content(value, &name)?;
    let first = values.first().cloned().unwrap_or(Value::Num(0.0));
    // A controller keeps tools and work objects where it can change them.
    let storage = match first {
        Value::ToolData(_) | Value::WobjData(_) => Storage::Pers,
        _ => Storage::Const,
    };
    let datum = Datum::single(name, storage, first);
    let is_single = sizes.is_empty();
    Ok(if is_single { datum } else { Datum { content: Content::Array { sizes, values }, ..datum } })
}

/// Parse a RAPID module, with or without MODULE around it, or a single record.
///
/// Args:
///     text: RAPID text, or the bytes of a file: UTF-8, UTF-16 with its mark, else Latin-1. Text
///         that begins with a bracket is one robtarget, jointtarget, tooldata, wobjdata, pose or
///         loaddata, as `dump` writes them, determined by its shape.
///     context: Modules in which names that the text does not declare are looked for: their data
///         that are not LOCAL.
///
/// Returns:
///     Module; or RobTarget, JointTarget, ToolData, WobjData, Pose or LoadData.
///
/// Raises:
///     RapidError: The text is broken; the message and the attributes `line` and `column` have the
///         place. Unknown statements are no error: they are skipped and listed in `Module.skipped`.
#[pyfunction]
#[pyo3(signature = (text, context=None))]
pub(crate) fn parse<'py>(
    text: &Bound<'py, PyAny>,
    context: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = text.py();
    let source = decoded(text)?;
    if source.trim_start().starts_with('[') {
        return record(py, &rapid::parse_record(&source).map_err(exception)?);
    }
    Ok(Bound::new(py, module_of(py, source, context)?)?.into_any())
}

/// Parse a RAPID module, as `parse`; a record is refused.
#[pyfunction]
#[pyo3(signature = (text, context=None))]
pub(crate) fn parse_module(
    text: &Bound<'_, PyAny>,
    context: Option<&Bound<'_, PyAny>>,
) -> PyResult<RapidModule> {
    module_of(text.py(), decoded(text)?, context)
}

/// Read a RAPID module in spite of its faults, which are `Module.faults`.
///
/// Args:
///     content: RAPID text, or the bytes of a file, as for `parse`.
///     context: Modules in which names that the text does not declare are looked for.
#[pyfunction]
#[pyo3(signature = (content, context=None))]
pub(crate) fn read_module(
    content: &Bound<'_, PyAny>,
    context: Option<&Bound<'_, PyAny>>,
) -> PyResult<RapidModule> {
    let source = decoded(content)?;
    with_context(content.py(), source, context, true)
}

/// Read the modules of a program in spite of their faults: each knows the data of the others.
///
/// Args:
///     contents: Texts, or bytes of files, as for `parse`.
///
/// Returns:
///     A list of Module.
#[pyfunction]
pub(crate) fn read_modules(contents: &Bound<'_, PyAny>) -> PyResult<Vec<Py<RapidModule>>> {
    let py = contents.py();
    let sources: Vec<String> =
        contents.try_iter()?.map(|content| decoded(&content?)).collect::<PyResult<_>>()?;
    let (alone, modules) = detached_until(py, |interrupt| {
        let read_all = |context: &[&Module]| {
            let faults = || Faults::new(true, interrupt);
            let modules = sources.iter().map(|text| read_with(text, context, faults()));
            modules.collect::<Result<Vec<_>, _>>()
        };
        let alone = read_all(&[])?;
        if alone.len() == 1 {
            return Ok::<_, RapidFault>((Vec::new(), alone));
        }
        let modules = read_all(&alone.iter().collect::<Vec<_>>())?;
        Ok((alone, modules))
    })?
    .map_err(exception)?;
    let alone = sources
        .iter()
        .zip(alone)
        .map(|(source, module)| Py::new(py, RapidModule::new(module, source.clone(), Vec::new())));
    let alone = alone.collect::<PyResult<Vec<_>>>()?;
    let made = sources.into_iter().zip(modules).enumerate().map(|(own, (source, module))| {
        let others = alone.iter().enumerate().filter(|(other, _)| *other != own);
        let context = others.map(|(_, it)| it.clone_ref(py)).collect();
        Py::new(py, RapidModule::new(module, source, context))
    });
    made.collect()
}

/// Return the names in lower case by which two versions of a module differ to other modules.
///
/// A module that has none of them in its text is read as before.
///
/// Args:
///     before: Module.
///     after: Module.
#[pyfunction]
pub(crate) fn differing_names(
    before: &Bound<'_, RapidModule>,
    after: &Bound<'_, RapidModule>,
) -> BTreeSet<String> {
    let (before, after) = (&before.get().module, &after.get().module);
    rapid::differing_names(before, after)
}

fn module_of(
    py: Python<'_>,
    source: String,
    context: Option<&Bound<'_, PyAny>>,
) -> PyResult<RapidModule> {
    if is_path(&source) {
        return Err(Fault::Rapid.error(format_args!(
            "{source:?} is a path, parse takes the text of a module: use load"
        )));
    }
    with_context(py, source, context, false)
}

/// The module of a text, in spite of its faults or not, and of the modules of its context.
fn with_context(
    py: Python<'_>,
    source: String,
    context: Option<&Bound<'_, PyAny>>,
    is_tolerant: bool,
) -> PyResult<RapidModule> {
    let mut others = Vec::new();
    if let Some(context) = context {
        for other in context.try_iter()? {
            others.push(other?.cast_into::<RapidModule>()?);
        }
    }
    let context: Vec<&Module> = others.iter().map(|other| &other.get().module).collect();
    let module = detached_until(py, |interrupt| {
        read_with(&source, &context, Faults::new(is_tolerant, interrupt))
    })?
    .map_err(exception)?;
    let context = others.into_iter().map(Bound::unbind).collect();
    Ok(RapidModule::new(module, source, context))
}

/// Whether a text is the path of a module: one word with its ending, which no RAPID text is.
fn is_path(text: &str) -> bool {
    let endings = [".mod", ".modx", ".sys", ".sysx", ".prg"];
    let (text, marks) = (text.trim().to_ascii_lowercase(), ['\n', ';', '[', '"', '!']);
    endings.iter().any(|ending| text.ends_with(ending)) && !text.contains(marks)
}

/// RAPID text from a str, or from the bytes of a file.
fn decoded(text: &Bound<'_, PyAny>) -> PyResult<String> {
    match text.cast::<PyBytes>() {
        Ok(bytes) => Ok(rapid::decode(bytes.as_bytes()).into_owned()),
        Err(_) => text.extract(),
    }
}
