//! `irbkin.Robot` from tables, parameters and descriptions, and its description.

use pyo3::prelude::*;

use super::arm::on;
use super::arrays::vector;
use super::build::{self, Table};
use super::errors::Fault;
use super::robot::PyRobot;
use super::urdf::{self, Wanted};
use crate::kinematics::OpwParameters;
use crate::report::Convention;

#[pymethods]
impl PyRobot {
    /// Robot from a modified (Craig) Denavit-Hartenberg table: Rx(alpha) Tx(a) Rz(theta + q) Tz(d).
    ///
    /// Args:
    ///     rows: alpha [rad], a [m], d [m], theta offset [rad] of each joint, shape (6, 4) or (7,
    ///         4).
    ///     limits: Lower and upper limit of each joint [rad], shape (n, 2); none when not given.
    ///     name: A name of your own.
    ///     snap: An alpha or theta offset within this of a multiple of 90 deg is made exact [rad],
    ///         at most 1e-3: 1e-5 takes 1.5708 for a right angle. Lengths stay as they are.
    ///
    /// Raises:
    ///     InvalidModelError: A number is not finite, a limit is empty, or six joints are not
    ///         independent: the message names the axes. `missing_form` of a robot of structure
    ///         "general" has what keeps it from a closed form, and a `snap` that suffices.
    #[staticmethod]
    #[pyo3(signature = (rows, limits=None, name="", *, snap=0.0))]
    fn from_mdh(
        rows: &Bound<'_, PyAny>,
        limits: Option<&Bound<'_, PyAny>>,
        name: &str,
        snap: f64,
    ) -> PyResult<Self> {
        let table = Table { convention: Convention::Modified, snap };
        build::from_table(rows, limits, name, table).map(Self::from)
    }

    /// Robot from a standard Denavit-Hartenberg table: Rz(theta + q) Tz(d) Tx(a) Rx(alpha).
    ///
    /// Args:
    ///     rows: alpha [rad], a [m], d [m], theta offset [rad] of each joint, in this order too,
    ///         shape (6, 4) or (7, 4).
    ///     limits: Lower and upper limit of each joint [rad], shape (n, 2); none when not given.
    ///     name: A name of your own.
    ///     snap: An alpha or theta offset within this of a multiple of 90 deg is made exact [rad],
    ///         at most 1e-3: 1e-5 takes 1.5708 for a right angle. Lengths stay as they are.
    ///
    /// Raises:
    ///     InvalidModelError: As `from_mdh`.
    #[staticmethod]
    #[pyo3(signature = (rows, limits=None, name="", *, snap=0.0))]
    fn from_sdh(
        rows: &Bound<'_, PyAny>,
        limits: Option<&Bound<'_, PyAny>>,
        name: &str,
        snap: f64,
    ) -> PyResult<Self> {
        let table = Table { convention: Convention::Standard, snap };
        build::from_table(rows, limits, name, table).map(Self::from)
    }

    /// Robot from Brandstoetter's parameters of an ortho-parallel arm with a spherical wrist, which
    /// is straight up along z at zero theta.
    ///
    /// Args:
    ///     a1: Distance of axis 2 from axis 1 [m].
    ///     a2: Elbow offset [m]: distance of axis 4 from axis 3, negative where it lifts the
    ///         forearm of an ABB arm at zero.
    ///     b: Lateral offset of the wrist center from the plane through axis 1 [m].
    ///     c1: Height of axis 2 [m].
    ///     c2: Upper arm [m]: distance of axis 3 from axis 2.
    ///     c3: Forearm [m]: distance of the wrist center from axis 3, along axis 4.
    ///     c4: Distance of the flange from the wrist center [m].
    ///     offsets: Joint offsets [rad], shape (6,): theta = sign * q - offset, as opw_kinematics
    ///         has it; zeros when not given.
    ///     signs: Joint signs, each 1 or -1, shape (6,); ones when not given.
    ///     limits: Lower and upper limit of each joint [rad], shape (6, 2); none when not given.
    ///     name: A name of your own.
    ///
    /// Raises:
    ///     InvalidModelError: A number is not finite, a sign is not 1 or -1, a limit is empty, or a
    ///         link has no length.
    #[staticmethod]
    #[pyo3(signature = (
        *, a1, a2, b, c1, c2, c3, c4, offsets=None, signs=None, limits=None, name=""
    ))]
    #[expect(clippy::too_many_arguments, reason = "the parameters of the form have these names")]
    fn from_opw(
        py: Python<'_>,
        a1: f64,
        a2: f64,
        b: f64,
        c1: f64,
        c2: f64,
        c3: f64,
        c4: f64,
        offsets: Option<&Bound<'_, PyAny>>,
        signs: Option<&Bound<'_, PyAny>>,
        limits: Option<&Bound<'_, PyAny>>,
        name: &str,
    ) -> PyResult<Self> {
        let offsets =
            offsets.map_or(Ok([0.0; 6]), |offsets| vector(offsets, "offsets", Fault::Model))?;
        let signs = signs.map_or(Ok([1.0; 6]), |signs| vector(signs, "signs", Fault::Model))?;
        let opw = OpwParameters { a1, a2, b, c1, c2, c3, c4, offsets, signs: [1; 6] };
        build::from_opw(py, opw, signs, limits, name).map(Self::from)
    }

    /// Robot from a URDF: the revolute and continuous joints between two links, with their limits
    /// and velocities.
    ///
    /// Args:
    ///     text_or_path: The text, str that begins with "<" or bytes, or the path of a file. Xacro
    ///         must be expanded first.
    ///     base: Link in whose frame poses are given; the one without a parent when not given.
    ///     tip: Link that poses are of; when not given, the only one at the end of a chain of six
    ///         or seven joints.
    ///     name: A name of your own; the URDF's when not given.
    ///     snap: An angle of an origin, or an axis, within this of a multiple of 90 deg is made
    ///         exact [rad], at most 1e-3: 1e-5 takes 1.5708 for a right angle. Lengths stay as they
    ///         are.
    ///
    /// Raises:
    ///     InvalidModelError: The text is no URDF, several links could be meant, there are not six
    ///         or seven joints, a joint between base and tip is not revolute, continuous or fixed,
    ///         or six joints are not independent; the message names what is wrong.
    ///     OSError: The file cannot be read.
    #[staticmethod]
    #[pyo3(signature = (text_or_path, base=None, tip=None, name="", *, snap=0.0))]
    fn from_urdf(
        text_or_path: &Bound<'_, PyAny>,
        base: Option<&str>,
        tip: Option<&str>,
        name: &str,
        snap: f64,
    ) -> PyResult<Self> {
        let wanted = Wanted { base, tip, name, snap };
        urdf::from_urdf(text_or_path, wanted).map(Self::from)
    }

    /// Return the text of a URDF of the robot, which `from_urdf` reads back.
    ///
    /// Links are `base_link`, `link_1` .., `flange` and `tool0` (irbkin's flange, z out of it);
    /// `world` with a base, `tool` with a tool. Joints are `joint_1` .., velocities 0 if unknown. A
    /// parallelogram linkage is a joint that mimics `joint_2`; `uncoupled().to_urdf()` has none.
    /// See docs/conventions.md.
    fn to_urdf(&self) -> String {
        on!(self.arm(), robot => robot.to_urdf())
    }
}
