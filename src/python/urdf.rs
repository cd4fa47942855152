//! `Robot.from_urdf`: the text of a URDF, given as it is or by its path.

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyString};

use super::arm::Arm;
use super::edits::Edit;
use super::errors::to_py;
use crate::error::{Error, UrdfFault};
use crate::urdf::UrdfArm;

/// What is taken of a URDF, and how.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    pub(super) base: Option<&'a str>,
    pub(super) tip: Option<&'a str>,
    /// The robot's name; that of the URDF where it is empty.
    pub(super) name: &'a str,
    /// How far an angle may be from a multiple of 90 deg and still be made one [rad].
    pub(super) snap: f64,
}

/// The arm between two links of a URDF, of six or seven joints.
pub(super) fn from_urdf(text_or_path: &Bound<'_, PyAny>, wanted: Wanted<'_>) -> PyResult<Arm> {
    let py = text_or_path.py();
    let bytes = bytes_of(text_or_path)?;
    py.detach(|| arm_of(&bytes, wanted)).map_err(|error| to_py(py, &error))
}

fn arm_of(bytes: &[u8], wanted: Wanted<'_>) -> Result<Arm, Error> {
    let text =
        str::from_utf8(bytes).map_err(|error| UrdfFault::NotUtf8 { byte: error.valid_up_to() })?;
    let read = UrdfArm::read(text, wanted.base, wanted.tip, &[6, 7])?;
    let arm = Arm::from(read.any_robot(wanted.snap)?);
    if wanted.name.is_empty() { Ok(arm) } else { arm.edited(&Edit::Name(wanted.name)) }
}

/// The bytes of a text, or of the file at a path. A str that begins with `<`, blanks aside, is a
/// text.
fn bytes_of(text_or_path: &Bound<'_, PyAny>) -> PyResult<Vec<u8>> {
    if let Ok(bytes) = text_or_path.cast::<PyBytes>() {
        return Ok(bytes.as_bytes().to_vec());
    }
    if let Ok(text) = text_or_path.cast::<PyString>() {
        // A half of a surrogate pair is kept as the bytes that it would be, which are no UTF-8.
        let bytes = text
            .call_method1("encode", ("utf-8", "surrogatepass"))?
            .cast_into::<PyBytes>()?
            .as_bytes()
            .to_vec();
        if String::from_utf8_lossy(&bytes)
            .trim_start_matches(|c: char| c.is_whitespace() || c == '\u{feff}')
            .starts_with('<')
        {
            return Ok(bytes);
        }
    }
    let py = text_or_path.py();
    let path = py.import("os")?.call_method1("fspath", (text_or_path,))?;
    let file = py.import("builtins")?.call_method1("open", (path, "rb"))?;
    let read = file.call_method0("read");
    file.call_method0("close")?;
    Ok(read?.cast::<PyBytes>()?.as_bytes().to_vec())
}
