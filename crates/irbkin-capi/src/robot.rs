//! Robots: made of names, texts and tables, and of other robots; what they are.

use core::ffi::c_char;

use irbkin::{DhRow, Error, JointLimits, Joints, Mdh, OpwParameters, Pose, Robot, Sdh, on};
use irbkin_motion::{AnyArm, Arm};

use crate::arguments::{check_length, given, pose, reference, slice, slice_mut, text};
use crate::fault::{Fault, IrbkinCode, guarded, report};
use crate::handle::{Arms, IrbkinRobot, free, give, handle};

/// Parameters of an ortho-parallel arm with a spherical wrist.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct IrbkinOpwParameters {
    /// Distance of axis 2 from axis 1 [m].
    pub a1: f64,
    /// Distance of axis 4 from axis 3 [m].
    pub a2: f64,
    /// Lateral offset of the wrist center [m].
    pub b: f64,
    /// Height of axis 2 [m].
    pub c1: f64,
    /// Distance of axis 3 from axis 2 [m].
    pub c2: f64,
    /// Distance of the wrist center from axis 3 along axis 4 [m].
    pub c3: f64,
    /// Distance of the flange from the wrist center [m].
    pub c4: f64,
    /// Joint offsets [rad]; ABB: 0, 0, -pi/2, 0, 0, 0.
    pub offsets: [f64; 6],
    /// Joint signs, each 1 or -1.
    pub signs: [i8; 6],
}

/// Call `make` and give its robot to the caller.
///
/// # Safety
///
/// `made` is NULL or writable.
unsafe fn made(
    made: *mut *mut IrbkinRobot,
    make: impl FnOnce() -> Result<Arms, Fault>,
) -> IrbkinCode {
    // SAFETY: as of the caller.
    guarded(|| unsafe { give("made", made, || make().map(IrbkinRobot::new)) })
}

/// Call `change` for a robot and give the new one to the caller.
///
/// # Safety
///
/// `robot` is as of [`handle`], `made` is NULL or writable.
unsafe fn changed(
    robot: *const IrbkinRobot,
    made: *mut *mut IrbkinRobot,
    change: impl FnOnce(Arms) -> Result<Arms, Fault>,
) -> IrbkinCode {
    // SAFETY: as of the caller.
    unsafe { self::made(made, || change(handle("robot", robot)?.robot().clone())) }
}

/// Make the arm of the catalog with a name, as "IRB 2600-12/1.65" or "UR5e".
///
/// Case, blanks, "-", "_" and "/" do not matter. An error lists close names.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_robot_named(
    name: *const c_char,
    made: *mut *mut IrbkinRobot,
) -> IrbkinCode {
    // SAFETY: the pointers are as the header says.
    unsafe { self::made(made, || Ok(AnyArm::named(text("name", name)?)?.into())) }
}

/// Make the arm of six or seven revolute joints between two links of a URDF.
///
/// `urdf` is its text, not a file name. `base` and `tip` are names of links; NULL where the text
/// has only one choice.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_robot_from_urdf(
    urdf: *const c_char,
    base: *const c_char,
    tip: *const c_char,
    made: *mut *mut IrbkinRobot,
) -> IrbkinCode {
    let make = || {
        // SAFETY: the pointers are as the header says.
        let link = |argument, link| given(link, || unsafe { text(argument, link) });
        let (base, tip) = (link("base", base)?, link("tip", tip)?);
        // SAFETY: as above.
        Ok(AnyArm::from_urdf(unsafe { text("urdf", urdf) }?, base, tip)?.into())
    };
    // SAFETY: as above.
    unsafe { self::made(made, make) }
}

/// Make an arm of a modified (Craig) Denavit-Hartenberg table without limits.
///
/// `rows` has alpha [rad], a [m], d [m] and the theta offset [rad] of each joint: `rows_len` is 24
/// or 28.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_robot_from_mdh(
    rows: *const f64,
    rows_len: usize,
    made: *mut *mut IrbkinRobot,
) -> IrbkinCode {
    // SAFETY: the pointers are as the header says.
    unsafe { self::made(made, || of_table(rows, rows_len, false)) }
}

/// Make an arm of a standard Denavit-Hartenberg table without limits, as irbkin_robot_from_mdh().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_robot_from_sdh(
    rows: *const f64,
    rows_len: usize,
    made: *mut *mut IrbkinRobot,
) -> IrbkinCode {
    // SAFETY: the pointers are as the header says.
    unsafe { self::made(made, || of_table(rows, rows_len, true)) }
}

/// The arm of a table of six or of seven rows.
///
/// # Safety
///
/// As of [`slice`].
unsafe fn of_table(rows: *const f64, rows_len: usize, is_standard: bool) -> Result<Arms, Fault> {
    fn robot<const N: usize>(rows: &[[f64; 4]], is_standard: bool) -> Result<Arms, Error>
    where
        Robot<N>: Joints<N>,
        Arms: From<Robot<N>>,
    {
        let mut rows = rows.iter().map(|&[alpha, a, d, theta]| DhRow::new(alpha, a, d, theta));
        let rows = core::array::from_fn(|_| rows.next().unwrap_or_default());
        let (base, flange) = (Pose::identity(), Pose::identity());
        let robot: Robot<N> = if is_standard {
            Robot::from_sdh(Sdh { base, rows, flange })?
        } else {
            Robot::from_mdh(Mdh { base, rows, flange })?
        };
        Ok(robot.into())
    }
    if rows_len != 24 && rows_len != 28 {
        let (argument, value) = ("rows_len", i64::try_from(rows_len).unwrap_or(i64::MAX));
        return Err(Fault::Choice { argument, value, wanted: "24 or 28, four for each joint" });
    }
    // SAFETY: as of the caller.
    let rows = unsafe { slice("rows", rows, rows_len) }?.as_chunks::<4>().0;
    let robot = if rows.len() == 7 { robot::<7> } else { robot::<6> };
    Ok(robot(rows, is_standard)?)
}

/// Make an arm of the parameters of an ortho-parallel arm with a spherical wrist without limits.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_robot_from_opw(
    parameters: *const IrbkinOpwParameters,
    made: *mut *mut IrbkinRobot,
) -> IrbkinCode {
    let make = || {
        // SAFETY: the pointers are as the header says.
        let IrbkinOpwParameters { a1, a2, b, c1, c2, c3, c4, offsets, signs } =
            *unsafe { reference("parameters", parameters) }?;
        let opw = OpwParameters { a1, a2, b, c1, c2, c3, c4, offsets, signs };
        Ok(Robot::from_opw(opw)?.into())
    };
    // SAFETY: as above.
    unsafe { self::made(made, make) }
}

/// Make a robot with its tool center point at `tool` in the flange frame, a 4x4 matrix by rows.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_robot_with_tool(
    robot: *const IrbkinRobot,
    tool: *const f64,
    made: *mut *mut IrbkinRobot,
) -> IrbkinCode {
    let change = |robot: Arms| {
        // SAFETY: the pointers are as the header says.
        let tool = unsafe { pose("tool", tool) }?;
        on!(robot, robot => Ok(robot.map(|robot| robot.with_tool(&tool)).map_err(Fault::of("tool"))?.into()))
    };
    // SAFETY: as above.
    unsafe { changed(robot, made, change) }
}

/// Make a robot with its base at `base` in the world, a 4x4 matrix by rows. Poses are then in the
/// world.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_robot_with_base(
    robot: *const IrbkinRobot,
    base: *const f64,
    made: *mut *mut IrbkinRobot,
) -> IrbkinCode {
    let change = |robot: Arms| {
        // SAFETY: the pointers are as the header says.
        let base = unsafe { pose("base", base) }?;
        on!(robot, robot => Ok(robot.map(|robot| robot.with_base(&base)).map_err(Fault::of("base"))?.into()))
    };
    // SAFETY: as above.
    unsafe { changed(robot, made, change) }
}

/// Make a robot with other joint limits: lower and upper limit of each joint [rad], 2 dof numbers,
/// infinite where a joint has none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_robot_with_limits(
    robot: *const IrbkinRobot,
    limits: *const f64,
    limits_len: usize,
    made: *mut *mut IrbkinRobot,
) -> IrbkinCode {
    fn limited<const N: usize>(arm: Arm<N>, limits: &[f64]) -> Result<Arms, Fault>
    where
        Arms: From<Arm<N>>,
    {
        check_length("limits", limits.len(), 2 * N)?;
        let mut pairs = limits.as_chunks::<2>().0.iter();
        let pairs = core::array::from_fn(|_| pairs.next().copied().unwrap_or_default());
        let limits = JointLimits::new(pairs)?;
        Ok(arm.map(|robot| Ok(robot.with_limits(limits)))?.into())
    }
    let change = |robot: Arms| {
        // SAFETY: the pointers are as the header says.
        let limits = unsafe { slice("limits", limits, limits_len) }?;
        on!(robot, robot => limited(robot, limits))
    };
    // SAFETY: as above.
    unsafe { changed(robot, made, change) }
}

/// Make a robot with an approximate body, from the lengths of its table: the real arm may reach
/// outside it. Arms of the catalog have a body; an arm of a table needs one for collisions.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_robot_with_approximate_body(
    robot: *const IrbkinRobot,
    made: *mut *mut IrbkinRobot,
) -> IrbkinCode {
    let change = |robot: Arms| {
        on!(robot, robot => {
            let body = robot.approximate_body()?;
            Ok(robot.with_body(Some(body))?.into())
        })
    };
    // SAFETY: the pointers are as the header says.
    unsafe { changed(robot, made, change) }
}

/// Free a robot; NULL does nothing. Robots that were made of it stay.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_robot_free(robot: *mut IrbkinRobot) {
    // SAFETY: the pointer is as the header says.
    guarded(|| unsafe { free("robot", robot) });
}

/// Read something of a robot; without one, return `none` and keep the message.
///
/// # Safety
///
/// As of [`handle`].
unsafe fn read<T>(robot: *const IrbkinRobot, none: T, of: impl FnOnce(&IrbkinRobot) -> T) -> T {
    // SAFETY: as of the caller.
    match unsafe { handle("robot", robot) } {
        Ok(robot) => of(robot),
        Err(fault) => {
            report(&fault);
            none
        }
    }
}

/// Number of joints, 6 or 7; 0 if `robot` is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_robot_dof(robot: *const IrbkinRobot) -> usize {
    // SAFETY: the pointer is as the header says.
    unsafe { read(robot, 0, |robot| robot.robot().dof()) }
}

/// Number of slots of an answer, at most IRBKIN_MOST_SLOTS; 0 if `robot` is NULL, and of seven
/// joints of which the first six are not independent.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_robot_slot_count(robot: *const IrbkinRobot) -> usize {
    // SAFETY: the pointer is as the header says.
    unsafe { read(robot, 0, |robot| on!(robot.robot(), robot => robot.slot_count())) }
}

/// The name, empty of an arm of a table; NULL if `robot` is NULL. It lives as long as the robot.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_robot_name(robot: *const IrbkinRobot) -> *const c_char {
    // SAFETY: the pointer is as the header says.
    unsafe { read(robot, core::ptr::null(), IrbkinRobot::name) }
}

/// Write the lower and upper limit of each joint [rad], 2 dof numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_robot_limits(
    robot: *const IrbkinRobot,
    limits: *mut f64,
    limits_len: usize,
) -> IrbkinCode {
    guarded(|| {
        // SAFETY: the pointers are as the header says.
        let robot = unsafe { handle("robot", robot) }?;
        check_length("limits", limits_len, 2 * robot.robot().dof())?;
        // SAFETY: as above.
        let limits = unsafe { slice_mut("limits", limits, limits_len) }?;
        on!(robot.robot(), robot => {
            limits.copy_from_slice(robot.limits().to_array().as_flattened());
        });
        Ok(())
    })
}
