//! RAPID's records as classes of Python: a constructor with keywords, documented fields, equality by
//! value, `repr`, `hash`, pickling, and copies with changes.

use pyo3::prelude::*;
use pyo3::types::{PyByteArray, PyBytes, PyDict, PyFrozenSet, PySet, PyTuple, PyType};
use std::convert::Infallible;

use crate::records;
use irbkin::Configuration;
use irbkin_abb::rapid;

/// An argument of a constructor.
pub(crate) enum Argument<'py, T> {
    /// The default.
    Default(T),
    /// An object to be read.
    Object(Bound<'py, PyAny>),
}

impl<'py, T> FromPyObject<'_, 'py> for Argument<'py, T> {
    type Error = Infallible;

    fn extract(object: Borrowed<'_, 'py, PyAny>) -> Result<Self, Infallible> {
        Ok(Self::Object(object.to_owned()))
    }
}

impl<T: Field> Argument<'_, T> {
    /// The value of a field, which has a class and a name for messages.
    pub(crate) fn read(self, class: &str, field: &str) -> PyResult<T> {
        match self {
            Self::Default(value) => Ok(value),
            Self::Object(object) => T::read(&object).map_err(|refused| match refused {
                Refused::Wanted(wanted) => {
                    let got = object.repr().map_or_else(|_| "this".into(), |it| it.to_string());
                    fault(object.py(), format!("{class}: {field} must be {wanted}, got {got}"))
                }
                Refused::Raised(error) => error,
            }),
        }
    }
}

fn fault(py: Python<'_>, message: String) -> PyErr {
    let raised = || py.import("irbkin.errors")?.getattr("RapidError")?.call1((message,));
    raised().map_or_else(|failure| failure, PyErr::from_value)
}

/// Why an object is not read.
pub(crate) enum Refused {
    /// The field must be something else.
    Wanted(String),
    /// A field of the object is refused.
    Raised(PyErr),
}

impl From<PyErr> for Refused {
    fn from(error: PyErr) -> Self {
        Self::Raised(error)
    }
}

/// A field of a record, from and to Python.
pub(crate) trait Field: Sized {
    fn read(given: &Bound<'_, PyAny>) -> Result<Self, Refused>;

    fn show<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>>;
}

/// Fields that Python has types for, with the words for them.
macro_rules! fields {
    ($($Type:ty: $wanted:literal;)*) => {$(
        impl Field for $Type {
            fn read(given: &Bound<'_, PyAny>) -> Result<Self, Refused> {
                given.extract().map_err(|_| Refused::Wanted($wanted.to_string()))
            }

            fn show<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
                Ok(self.into_pyobject(py)?.to_owned().into_any())
            }
        }
    )*};
}

fields! {
    bool: "True or False";
    String: "a str";
}

fn finite(given: &Bound<'_, PyAny>) -> Option<f64> {
    given.extract().ok().filter(|number: &f64| number.is_finite())
}

/// Finite numbers of anything that is iterated in order.
fn numbers<const N: usize>(given: &Bound<'_, PyAny>) -> Option<[f64; N]> {
    let is_unordered = given.is_instance_of::<PySet>()
        || given.is_instance_of::<PyFrozenSet>()
        || given.is_instance_of::<PyDict>();
    let is_bytes = given.is_instance_of::<PyBytes>() || given.is_instance_of::<PyByteArray>();
    if is_unordered || is_bytes {
        return None;
    }
    let each = given.try_iter().ok()?.map(|number| finite(&number.ok()?));
    each.collect::<Option<Vec<f64>>>()?.try_into().ok()
}

impl Field for f64 {
    fn read(given: &Bound<'_, PyAny>) -> Result<Self, Refused> {
        finite(given).ok_or_else(|| Refused::Wanted("a finite number".into()))
    }

    fn show<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(self.into_pyobject(py)?.into_any())
    }
}

impl<const N: usize> Field for [f64; N] {
    fn read(given: &Bound<'_, PyAny>) -> Result<Self, Refused> {
        numbers(given).ok_or_else(|| Refused::Wanted(format!("{N} finite numbers")))
    }

    fn show<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(PyTuple::new(py, self)?.into_any())
    }
}

impl Field for Configuration {
    fn read(given: &Bound<'_, PyAny>) -> Result<Self, Refused> {
        #[expect(clippy::cast_possible_truncation, reason = "checked: it is whole and in range")]
        let whole = |number: f64| {
            let is_whole = number.fract() == 0.0 && number.abs() <= f64::from(i32::MAX);
            is_whole.then_some(number as i32)
        };
        let [cf1, cf4, cf6, cfx] =
            numbers::<4>(given).map(|numbers| numbers.map(whole)).unwrap_or_default();
        let read = || Some(Self { cf1: cf1?, cf4: cf4?, cf6: cf6?, cfx: cfx? });
        let wanted = || format!("4 whole numbers of at most {}", i32::MAX);
        read().ok_or_else(|| Refused::Wanted(wanted()))
    }

    fn show<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(Bound::new(py, records::Configuration::from(*self))?.into_any())
    }
}

/// `Class(first=1, second=2)`.
pub(crate) fn repr(class: &str, names: &[&str], fields: &Bound<'_, PyTuple>) -> PyResult<String> {
    let written = names.iter().zip(fields).map(|(name, field)| {
        let value = field.repr()?;
        Ok(format!("{name}={value}"))
    });
    Ok(format!("{class}({})", written.collect::<PyResult<Vec<_>>>()?.join(", ")))
}

/// A record of a class with other values for some fields.
pub(crate) fn replaced<'py>(
    class: &Bound<'py, PyAny>,
    names: &[&str],
    fields: &Bound<'py, PyTuple>,
    changes: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let all = PyDict::new(class.py());
    for (name, field) in names.iter().zip(fields) {
        all.set_item(name, field)?;
    }
    if let Some(changes) = changes {
        all.update(changes.as_mapping())?;
    }
    class.call((), Some(&all))
}

/// Define the class of each record: the record itself, with methods of its fields.
macro_rules! classes {
    ($(
        $(#[doc = $doc:literal])*
        $Record:ident: $TYPE:ident as $class:literal $(with $Derived:ident)? {
            $($(#[doc = $field_doc:literal])* $field:ident: $Field:ty $(= $default:expr)?,)*
        }
    )*) => {$(
        $(#[doc = $doc])*
        #[pyclass(frozen, eq, from_py_object, name = $class, module = "irbkin.rapid")]
        #[derive(Clone, PartialEq)]
        pub(crate) struct $Record(pub(crate) rapid::$Record);

        impl $Record {
            const FIELDS: &'static [&'static str] = &[$(stringify!($field)),*];

            fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
                PyTuple::new(py, [$(self.0.$field.show(py)?),*])
            }
        }

        #[pymethods]
        impl $Record {
            #[new]
            #[pyo3(signature = ($($field $(= Argument::Default($default))?),*))]
            fn made($($field: Argument<'_, $Field>),*) -> PyResult<Self> {
                $(let $field = $field.read($class, stringify!($field))?;)*
                Ok(Self(rapid::$Record { $($field),* }))
            }

            $(
                $(#[doc = $field_doc])*
                #[getter]
                fn $field<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
                    self.0.$field.show(py)
                }
            )*

            fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
                repr($class, Self::FIELDS, &self.fields(py)?)
            }

            fn __hash__(&self, py: Python<'_>) -> PyResult<isize> {
                self.fields(py)?.hash()
            }

            fn __reduce__<'py>(
                &self,
                py: Python<'py>,
            ) -> PyResult<(Bound<'py, PyType>, Bound<'py, PyTuple>)> {
                Ok((py.get_type::<Self>(), self.fields(py)?))
            }

            /// Return a copy with other values for some fields.
            #[pyo3(signature = (**changes))]
            fn _replace<'py>(
                &self,
                py: Python<'py>,
                changes: Option<&Bound<'py, PyDict>>,
            ) -> PyResult<Bound<'py, PyAny>> {
                replaced(&py.get_type::<Self>(), Self::FIELDS, &self.fields(py)?, changes)
            }
        }
    )*};
}
irbkin_abb::rapid_records!(classes);
