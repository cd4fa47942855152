//! `irbkin.Robot` from tables, parameters, limits and URDF, and its URDF.

use std::path::PathBuf;

use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyString};
use roxmltree::Document;

use super::arm::{SharedArm, changed, on};
use super::arrays::{Rows, vector};
use super::errors::{Fault, exception};
use super::outputs::matrix;
use super::robot::PyRobot;
use super::shapes::{read_capsules, row_of};
use super::targets::pose_array;
use irbkin::internal::{Convention, ModelFault};
use irbkin::{DhRow, JointLimits, Joints, Mdh, OpwParameters, Pose, Robot, Sdh};
use irbkin_motion::internal::{Carrier, UrdfArm, UrdfFault, read_document};
use irbkin_motion::{Arm, Error};

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
    ///         independent: the message names the axes. Of a robot of structure "general",
    ///         `print(robot)` shows what keeps it from a closed form, and a `snap` that suffices.
    #[staticmethod]
    #[pyo3(signature = (rows, limits=None, name="", *, snap=0.0))]
    fn from_mdh(
        rows: &Bound<'_, PyAny>,
        limits: Option<&Bound<'_, PyAny>>,
        name: &str,
        snap: f64,
    ) -> PyResult<Self> {
        from_table(rows, limits, name, (Convention::Modified, snap))
    }

    /// Robot from a standard Denavit-Hartenberg table: Rz(theta + q) Tz(d) Tx(a) Rx(alpha).
    ///
    /// Args:
    ///     rows: alpha [rad], a [m], d [m], theta offset [rad] of each joint, in this order too,
    ///         shape (5, 4), (6, 4) or (7, 4).
    ///     limits: As of `from_mdh`.
    ///     name: As of `from_mdh`.
    ///     snap: As of `from_mdh`.
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
        from_table(rows, limits, name, (Convention::Standard, snap))
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
    fn from_opw(
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
        let given = signs.map_or(Ok([1.0; 6]), |signs| vector(signs, "signs", Fault::Model))?;
        let mut signs = [1; 6];
        for (joint, value) in given.into_iter().enumerate() {
            match value {
                1.0 => {}
                -1.0 => signs[joint] = -1,
                _ => {
                    let joint = joint + 1;
                    return Err(exception(Error::from(ModelFault::Sign { joint, value })));
                }
            }
        }
        let opw = OpwParameters { a1, a2, b, c1, c2, c3, c4, offsets, signs };
        let robot = Robot::from_opw(opw).map_err(exception)?;
        named_and_limited(&Arm::from(robot).into(), limits, name)
    }

    /// Robot from a URDF: the revolute and continuous joints between two links, with their limits
    /// and velocities, and a body of the collision shapes.
    ///
    /// A prismatic joint before all of these is a rail or a lift, the robot's `carrier`. `base` is
    /// then the link behind it, at the joint's zero or the limit nearest to it; `at` moves it.
    ///
    /// Links behind joints beside the arm, as of a gripper, are in the body wherever these joints
    /// may be. With a mesh, or a shape that is not valid, there is no body. See
    /// docs/guide/bodies.md.
    ///
    /// Args:
    ///     text_or_path: The text, str that begins with "<" or bytes, or the path of a file, of
    ///         URDF 1.0 to 1.2, or of a .xacro file, which the extra `xacro` expands: such a file
    ///         is a program. Of a text that others send give bytes, which name no file.
    ///     base: Link in whose frame poses are given; the one without a parent when not given.
    ///     tip: Link that poses are of; when not given, the only one at the end of a chain of six
    ///         or seven joints, or else of five, if the last can be no gripper's; of several on one
    ///         link the first named tool0, tcp, flange or grasp.
    ///     name: A name of your own; the URDF's when not given.
    ///     snap: An angle of an origin, or an axis, within this of a multiple of 90 deg is made
    ///         exact [rad], at most 1e-3; 0 keeps all. By default right angles rounded to four or
    ///         more decimals are, unless that may move the tool by more than 1e-4 m; see `repr`.
    ///     args: Values of the arguments of a xacro file, by their names.
    ///     packages: Folders of the ROS packages that a xacro file names.
    ///
    /// Raises:
    ///     InvalidModelError: The text is not a URDF, several links could be meant, there are not
    ///         six or seven joints, a joint between base and tip is not revolute, continuous or
    ///         fixed, an unknown attribute could move a joint, or six joints are not independent;
    ///         the message names what is wrong, and the base and tip that could be passed.
    ///     OSError: The file cannot be read.
    #[staticmethod]
    #[pyo3(signature = (text_or_path, base=None, tip=None, name="", *, snap=None, args=None,
        packages=None))]
    fn from_urdf(
        text_or_path: &Bound<'_, PyAny>,
        base: Option<&str>,
        tip: Option<&str>,
        name: &str,
        snap: Option<f64>,
        args: Option<&Bound<'_, PyAny>>,
        packages: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let text = text_in(text_or_path)?;
        // A text that others send is no program, whatever it ends with.
        let is_xacro = text.is_none() && is_xacro_file(text_or_path)?;
        let bytes = if is_xacro || args.is_some() || packages.is_some() {
            let module = text_or_path.py().import("irbkin._xacro")?;
            let text = module.call_method1("expanded", (text_or_path, args, packages))?;
            text.extract::<String>()?.into_bytes()
        } else {
            text.map_or_else(|| read_file(text_or_path), Ok)?
        };
        let read = || UrdfArm::read_any(text_of(&bytes)?, base, tip)?.any_arm(snap);
        let arm = SharedArm::from(text_or_path.py().detach(read).map_err(exception)?);
        Ok(if name.is_empty() { arm } else { named(&arm, name)? }.into())
    }

    /// Robot from a MuJoCo model, MJCF: the hinge joints between two bodies, with their ranges.
    ///
    /// A slide joint before these is a `carrier`, as of `from_urdf`. The extra `mjcf` reads the
    /// file. Meshes need not be there. See docs/guide/urdf.md.
    ///
    /// Args:
    ///     path: A file, or a text that begins with "<".
    ///     base: Body in whose frame poses are given.
    ///     tip: Site or body that poses are of; when not given, as of `from_urdf`.
    ///     name: A name of your own; the model's when not given.
    ///     snap: As of `from_urdf`; 0 keeps all angles.
    ///
    /// Raises:
    ///     InvalidModelError: As `from_urdf`; MuJoCo cannot read the file.
    ///     OSError: The file cannot be read.
    #[staticmethod]
    #[pyo3(signature = (path, base=None, tip=None, name="", *, snap=0.0))]
    fn from_mjcf(
        path: &Bound<'_, PyAny>,
        base: Option<&str>,
        tip: Option<&str>,
        name: &str,
        snap: f64,
    ) -> PyResult<Py<Self>> {
        let module = path.py().import("irbkin._mjcf")?;
        Ok(module.call_method1("robot_of", (path, base, tip, name, snap))?.extract()?)
    }

    /// Robot from a file of ABB's RobotStudio: its table, base frame, flange and limits.
    ///
    /// A station that only refers to ABB's libraries has the axes alone: the robot then has no
    /// limits, its flange is the frame of the last axis, and its name says so. See
    /// docs/guide/robotstudio.md.
    ///
    /// Args:
    ///     path: A library, .rslib, or a station, .rsstn, .rsstnx or .rspag.
    ///     name: Name of the arm in the file; needed if the file has several.
    ///     coupled_limits: False to leave out limits that couple axes. Only a robot with a linkage
    ///         can have them, and only of axes 2 and 3: of any other they are an error.
    ///
    /// Raises:
    ///     InvalidModelError: The file has another format, is broken or too large, no arm or
    ///         several could be meant, a joint is not revolute or follows others, or the file
    ///         contradicts itself; the message names the element and the bound.
    ///     OSError: The file cannot be read.
    #[staticmethod]
    #[pyo3(signature = (path, name=None, *, coupled_limits=true))]
    fn from_robotstudio(
        path: &Bound<'_, PyAny>,
        name: Option<&str>,
        coupled_limits: bool,
    ) -> PyResult<Py<Self>> {
        let module = path.py().import("irbkin._robotstudio")?;
        Ok(module.call_method1("robot_of", (path, name, coupled_limits))?.extract()?)
    }

    /// Return the robot with other joint limits; limits of a linkage stay.
    ///
    /// Args:
    ///     limits: Lower and upper limit of each joint [rad], shape (n, 2); infinite for none.
    ///
    /// Raises:
    ///     InvalidModelError: A limit is NaN, a lower one is above the upper one, or the shape is
    ///         wrong.
    fn with_limits(&self, limits: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(with_limits(self.arm(), limits)?.into())
    }

    /// Return the text of a URDF of the robot, which `from_urdf` reads back.
    ///
    /// Links are `base_link`, `link_1` .., `flange` and `tool0` (irbkin's flange, z out of it);
    /// `world` with a base, `tool` with a tool. Joints are `joint_1` .., velocities 1e5 if unknown.
    /// A parallelogram linkage is a joint that mimics `joint_2`; `uncoupled().to_urdf()` has none.
    /// A rail is not written: the base is where it is now. See docs/guide/urdf.md.
    ///
    /// Args:
    ///     visual: Whether links get the capsules of `body` as `visual` and `collision` elements, a
    ///         cylinder and two spheres each. What the flange carries is of `tool0`.
    ///
    /// Raises:
    ///     InvalidModelError: visual, and the robot has no body.
    #[pyo3(signature = (visual=false))]
    fn to_urdf(&self, visual: bool) -> PyResult<String> {
        if visual {
            return Ok(on!(self.arm(), robot => robot.to_urdf_with_body().map_err(exception)?));
        }
        Ok(on!(self.arm(), robot => robot.to_urdf()))
    }
}

/// A robot from a Denavit-Hartenberg table of 5 to 7 rows. An angle within `snap` of a multiple of
/// 90 deg becomes one [rad].
fn from_table(
    rows: &Bound<'_, PyAny>,
    limits: Option<&Bound<'_, PyAny>>,
    name: &str,
    (convention, snap): (Convention, f64),
) -> PyResult<PyRobot> {
    let fits = |shape: &[usize]| matches!(shape, [5..=7, 4]);
    let rows = Rows::shaped(rows, || "(5, 4), (6, 4) or (7, 4)", "rows", Fault::Model, fits)?;
    let rows = rows.chunks::<4>()?;
    let arm = match rows.len() {
        5 => robot_of_table::<5>(rows, convention, snap).map_err(exception)?.into(),
        6 => robot_of_table::<6>(rows, convention, snap).map_err(exception)?.into(),
        _ => robot_of_table::<7>(rows, convention, snap).map_err(exception)?.into(),
    };
    named_and_limited(&arm, limits, name)
}

fn robot_of_table<const N: usize>(
    numbers: &[[f64; 4]],
    convention: Convention,
    snap: f64,
) -> Result<Arm<N>, irbkin::Error>
where
    Robot<N>: Joints<N>,
{
    let found = numbers.len();
    let numbers: &[[f64; 4]; N] =
        numbers.try_into().map_err(|_| ModelFault::JointCount { found, wanted: N })?;
    let rows = numbers.map(|[alpha, a, d, theta]| DhRow::new(alpha, a, d, theta));
    let (base, flange) = (Pose::identity(), Pose::identity());
    let robot = match convention {
        Convention::Modified => Robot::from_mdh(Mdh { base, rows, flange }.snapped(snap)?),
        Convention::Standard => Robot::from_sdh(Sdh { base, rows, flange }.snapped(snap)?),
    };
    robot.map(Arm::from)
}

fn named_and_limited(
    arm: &SharedArm,
    limits: Option<&Bound<'_, PyAny>>,
    name: &str,
) -> PyResult<PyRobot> {
    let arm = named(arm, name)?;
    Ok(match limits {
        Some(limits) => with_limits(&arm, limits)?.into(),
        None => arm.into(),
    })
}

fn named(arm: &SharedArm, name: &str) -> PyResult<SharedArm> {
    on!(arm, arm => changed(arm, |robot| Ok(robot.with_name(name.to_owned()))))
}

/// The arm with limits of shape (n, 2).
fn with_limits(arm: &SharedArm, limits: &Bound<'_, PyAny>) -> PyResult<SharedArm> {
    let shape = [arm.dof(), 2];
    let rows = Rows::exact(limits, &shape, "limits", Fault::Model)?;
    on!(arm, arm => { let limits = rows.chunks()?; changed(arm, |robot| limited(robot, limits)) })
}

fn limited<const N: usize>(
    robot: Robot<N>,
    limits: &[[f64; 2]],
) -> Result<Robot<N>, irbkin::Error> {
    let found = limits.len();
    let limits = limits.try_into().map_err(|_| ModelFault::JointCount { found, wanted: N })?;
    Ok(robot.with_limits(JointLimits::new(limits)?))
}

/// Name, link of the body, and pose in its frame.
type Link<'py> = (String, usize, Option<Bound<'py, PyAny>>);

/// Name, link of the body and pose in its frame of every link of a URDF that moves with the arm, no
/// pose of those behind joints beside it; and a remark on these.
#[pyfunction(name = "_urdf_links")]
pub(super) fn urdf_links<'py>(
    text_or_path: &Bound<'py, PyAny>,
    base: Option<&str>,
    tip: Option<&str>,
) -> PyResult<(Vec<Link<'py>>, String)> {
    let (py, bytes) = (text_or_path.py(), bytes_of(text_or_path)?);
    let (links, remark) =
        UrdfArm::links(text_of(&bytes).map_err(exception)?, base, tip).map_err(exception)?;
    let row = |(name, number, carrier): (String, usize, Carrier)| {
        let is_rigid = carrier.beside.is_empty();
        (name, number, is_rigid.then(|| pose_array(py, &carrier.pose).into_any()))
    };
    Ok((links.into_iter().map(row).collect(), remark))
}

/// Capsules that contain those of a link wherever the joints beside the arm are, in the frame of
/// the body's link, and by how much they are thicker [m].
#[pyfunction(name = "_urdf_swept")]
pub(super) fn urdf_swept<'py>(
    text_or_path: &Bound<'py, PyAny>,
    base: Option<&str>,
    tip: Option<&str>,
    name: &str,
    links: Vec<usize>,
    capsules: &Bound<'py, PyAny>,
) -> PyResult<(Bound<'py, PyArray2<f64>>, f64)> {
    let (py, bytes) = (text_or_path.py(), bytes_of(text_or_path)?);
    let (moving, _) =
        UrdfArm::links(text_of(&bytes).map_err(exception)?, base, tip).map_err(exception)?;
    let own = read_capsules(links, capsules)?;
    let own: Vec<_> = own.iter().map(|own| own.capsule).collect();
    let carrier = moving.iter().find(|(other, ..)| other == name);
    let (swept, growth) = carrier.map(|(.., carrier)| carrier.swept(&own)).unwrap_or_default();
    Ok((matrix(py, &swept.iter().map(row_of).collect::<Vec<_>>()), growth))
}

/// The text of an XML file without what is refused in it and of no arm: prefixes without a
/// namespace, a document type, `&` alone; as it is, if it is refused for more.
#[pyfunction(name = "_urdf_text")]
pub(super) fn urdf_text<'py>(text: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let bytes = bytes_of(text)?;
    let own = |document: &Document<'_>, _| Ok::<_, Error>(document.input_text().to_owned());
    match text_of(&bytes).and_then(|text| read_document(text, own)) {
        Ok(mended) => Ok(mended.into_pyobject(text.py())?.into_any()),
        Err(_) => Ok(text.clone()),
    }
}

fn text_of(bytes: &[u8]) -> Result<&str, Error> {
    let text =
        str::from_utf8(bytes).map_err(|error| UrdfFault::NotUtf8 { byte: error.valid_up_to() })?;
    Ok(text)
}

/// The bytes of a text, or of the file at a path.
fn bytes_of(text_or_path: &Bound<'_, PyAny>) -> PyResult<Vec<u8>> {
    text_in(text_or_path)?.map_or_else(|| read_file(text_or_path), Ok)
}

/// The bytes of a text; `None` of a path. A str that begins with `<`, blanks aside, is a text.
fn text_in(text_or_path: &Bound<'_, PyAny>) -> PyResult<Option<Vec<u8>>> {
    if let Ok(bytes) = text_or_path.cast::<PyBytes>() {
        return Ok(Some(bytes.as_bytes().to_vec()));
    }
    if let Ok(text) = text_or_path.cast::<PyString>() {
        // A half of a surrogate pair is kept as the bytes that it would be, which are no UTF-8.
        let bytes = text.call_method1("encode", ("utf-8", "surrogatepass"))?;
        let bytes = bytes.cast::<PyBytes>()?.as_bytes();
        let is_blank = |c: char| c.is_whitespace() || c == '\u{feff}';
        if String::from_utf8_lossy(bytes).trim_start_matches(is_blank).starts_with('<') {
            return Ok(Some(bytes.to_vec()));
        }
    }
    Ok(None)
}

fn is_xacro_file(path: &Bound<'_, PyAny>) -> PyResult<bool> {
    let name: PathBuf = path.py().import("os")?.call_method1("fspath", (path,))?.extract()?;
    Ok(name.extension().is_some_and(|it| it.eq_ignore_ascii_case("xacro")))
}

fn read_file(path: &Bound<'_, PyAny>) -> PyResult<Vec<u8>> {
    let py = path.py();
    let path = py.import("os")?.call_method1("fspath", (path,))?;
    let file = py.import("builtins")?.call_method1("open", (path, "rb"))?;
    let read = file.call_method0("read");
    file.call_method0("close")?;
    Ok(read?.cast::<PyBytes>()?.as_bytes().to_vec())
}
