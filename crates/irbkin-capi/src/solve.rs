//! One posture, one pose.

use core::ffi::c_char;

use irbkin::{Configuration, ConfigurationRequest, JacobianFrame, Pose, Robot, on, pose as poses};

use crate::arguments::{
    array, array_mut, check_length, given, joints, reference, slice, slice_mut, unchecked_pose,
};
use crate::fault::{Fault, IrbkinCode, guarded};
use crate::handle::{IrbkinRobot, handle};

/// The frame in which a Jacobian is.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IrbkinFrame {
    /// That of the base, or of the world if the robot has a base in it.
    Base = 0,
    /// That of the tool.
    Tool = 1,
}

/// Write the pose of the tool at joint angles [rad]: 16 numbers, a 4x4 matrix by rows.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_fk(
    robot: *const IrbkinRobot,
    q: *const f64,
    q_len: usize,
    pose: *mut f64,
) -> IrbkinCode {
    guarded(|| {
        // SAFETY: the pointers are as the header says.
        let (robot, q) = unsafe { (handle("robot", robot)?, slice("q", q, q_len)?) };
        let found = on!(robot.robot(), robot => robot.fk(joints("q", q)?));
        // SAFETY: as above.
        *unsafe { array_mut("pose", pose) }? = poses::to_rows(&found);
        Ok(())
    })
}

/// Write the geometric Jacobian of the tool at joint angles [rad]: 6 rows of dof numbers, three
/// linear [m/rad], then three angular [1].
///
/// `frame` is an IrbkinFrame.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_jacobian(
    robot: *const IrbkinRobot,
    q: *const f64,
    q_len: usize,
    frame: i32,
    jacobian: *mut f64,
    jacobian_len: usize,
) -> IrbkinCode {
    const BASE: i32 = IrbkinFrame::Base as i32;
    const TOOL: i32 = IrbkinFrame::Tool as i32;
    fn write<const N: usize>(
        robot: &Robot<N>,
        q: &[f64],
        frame: JacobianFrame,
        jacobian: &mut [f64],
    ) -> Result<(), Fault> {
        check_length("jacobian", jacobian.len(), 6 * N)?;
        let found = robot.jacobian(joints("q", q)?, frame);
        for (to, from) in jacobian.as_chunks_mut::<N>().0.iter_mut().zip(found.row_iter()) {
            to.iter_mut().zip(from.iter()).for_each(|(to, from)| *to = *from);
        }
        Ok(())
    }
    guarded(|| {
        let frame = match frame {
            BASE => JacobianFrame::Base,
            TOOL => JacobianFrame::Tool,
            other => {
                let (argument, value) = ("frame", other.into());
                return Err(Fault::Choice { argument, value, wanted: "0 (base) or 1 (tool)" });
            }
        };
        // SAFETY: the pointers are as the header says.
        let (robot, q) = unsafe { (handle("robot", robot)?, slice("q", q, q_len)?) };
        // SAFETY: as above.
        let jacobian = unsafe { slice_mut("jacobian", jacobian, jacobian_len) }?;
        on!(robot.robot(), robot => write(robot, q, frame, jacobian))
    })
}

/// Write every solution of a pose, each in its slot.
///
/// `q` has slot_count rows of dof joint angles [rad], NaN in an empty slot; `status` has the flags
/// IRBKIN_STATUS_... of each slot. `found` is the number of solutions, or NULL. A pose out of reach
/// has none: irbkin_explain() says why.
///
/// `q7` is the angle of joint 7 of seven joints [rad]; NULL of six.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_ik(
    robot: *const IrbkinRobot,
    pose: *const f64,
    q7: *const f64,
    q: *mut f64,
    q_len: usize,
    status: *mut u8,
    status_len: usize,
    found: *mut usize,
) -> IrbkinCode {
    guarded(|| {
        // SAFETY: the pointers are as the header says.
        let (robot, pose) = unsafe { (handle("robot", robot)?, unchecked_pose("pose", pose)?) };
        // SAFETY: as above.
        let q7 = given(q7, || unsafe { reference("q7", q7) })?.copied();
        // SAFETY: as above.
        let q = unsafe { slice_mut("q", q, q_len) }?;
        // SAFETY: as above.
        let status = unsafe { slice_mut("status", status, status_len) }?;
        let count = on!(robot.robot(), robot => all(robot, &pose, q7, q, status)?);
        // SAFETY: as above.
        if let Some([found]) = given(found, || unsafe { array_mut("found", found) })? {
            *found = count;
        }
        Ok(())
    })
}

/// Write all solutions; their number.
fn all<const N: usize>(
    robot: &Robot<N>,
    pose: &Pose,
    q7: Option<f64>,
    q: &mut [f64],
    status: &mut [u8],
) -> Result<usize, Fault> {
    check_length("q", q.len(), robot.slot_count() * N)?;
    check_length("status", status.len(), robot.slot_count())?;
    let answer = robot.ik_with(pose, q7);
    // An answer has a thousand bytes: it is not moved.
    let solutions = match &answer {
        Ok(solutions) => solutions,
        Err(error) => return Err(error.clone().into()),
    };
    let flags = solutions.status();
    let slots = q.as_chunks_mut::<N>().0.iter_mut().zip(status).zip(&*flags);
    for (slot, ((q, status), flags)) in slots.enumerate() {
        *status = flags.bits();
        *q = solutions.slot(slot).map_or([f64::NAN; N], |solution| solution.q);
    }
    Ok(solutions.len())
}

/// Write the outcome of irbkin_ik() in a sentence: how many solutions a pose has, or why it has
/// none.
///
/// `text` has `text_len` bytes, the final zero among them; a longer sentence is cut off.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_explain(
    robot: *const IrbkinRobot,
    pose: *const f64,
    q7: *const f64,
    text: *mut c_char,
    text_len: usize,
) -> IrbkinCode {
    guarded(|| {
        // SAFETY: the pointers are as the header says.
        let (robot, pose) = unsafe { (handle("robot", robot)?, unchecked_pose("pose", pose)?) };
        // SAFETY: as above.
        let q7 = given(q7, || unsafe { reference("q7", q7) })?.copied();
        let words = on!(robot.robot(), robot => robot.ik_with(&pose, q7)?.explain()).to_string();
        // SAFETY: as above.
        let text: &mut [u8] = unsafe { slice_mut("text", text.cast(), text_len) }?;
        let Some(room) = text.len().checked_sub(1) else {
            return Err(Fault::Choice { argument: "text_len", value: 0, wanted: "at least 1" });
        };
        let bytes = words.bytes().take(room).chain([0]);
        text.iter_mut().zip(bytes).for_each(|(to, from)| *to = from);
        Ok(())
    })
}

/// Write the solution inside the limits that is nearest to `seed` [rad] among all 2 pi equivalents,
/// and of seven joints among all angles of joint 7.
///
/// `seed`, `weights` and `q` have `len` numbers, dof; `weights` may be NULL: all are 1.
/// IRBKIN_CODE_UNREACHABLE if no solution is inside.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_ik_nearest(
    robot: *const IrbkinRobot,
    pose: *const f64,
    seed: *const f64,
    weights: *const f64,
    q: *mut f64,
    len: usize,
) -> IrbkinCode {
    fn nearest<const N: usize>(
        robot: &Robot<N>,
        pose: &Pose,
        seed: &[f64],
        weights: Option<&[f64]>,
    ) -> Result<[f64; N], Fault> {
        let ones = [1.0; N];
        let weights = weights.map_or(Ok(&ones), |weights| {
            let wrong = Fault::Length { argument: "weights", found: weights.len(), wanted: N };
            weights.try_into().map_err(|_| wrong)
        })?;
        Ok(robot.ik_nearest(pose, joints("seed", seed)?, weights)?.q)
    }
    guarded(|| {
        // SAFETY: the pointers are as the header says.
        let (robot, pose) = unsafe { (handle("robot", robot)?, unchecked_pose("pose", pose)?) };
        // SAFETY: as above.
        let seed = unsafe { slice("seed", seed, len) }?;
        // SAFETY: as above.
        let weights = given(weights, || unsafe { slice("weights", weights, len) })?;
        on!(robot.robot(), robot => {
            let nearest = nearest(robot, &pose, seed, weights)?;
            // SAFETY: as above; there are as many angles as in the seed.
            *unsafe { array_mut("q", q) }? = nearest;
        });
        Ok(())
    })
}

/// Write ABB's confdata cf1, cf4, cf6, cfx of joint angles [rad].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_configuration(
    robot: *const IrbkinRobot,
    q: *const f64,
    q_len: usize,
    confdata: *mut i32,
) -> IrbkinCode {
    guarded(|| {
        // SAFETY: the pointers are as the header says.
        let (robot, q) = unsafe { (handle("robot", robot)?, slice("q", q, q_len)?) };
        let found = on!(robot.robot(), robot => robot.configuration(joints("q", q)?)?);
        // SAFETY: as above.
        *unsafe { array_mut("confdata", confdata) }? = found.into();
        Ok(())
    })
}

/// Write the solution with ABB's confdata cf1, cf4, cf6, cfx.
///
/// `seed` may be NULL; of several solutions the nearest to it is written. `arm_angle` is the arm
/// angle of a YuMi [rad], NULL of other arms. IRBKIN_CODE_NO_CONFIGURATION if no solution has the
/// confdata: the message lists the existing ones.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_ik_configured(
    robot: *const IrbkinRobot,
    pose: *const f64,
    confdata: *const i32,
    seed: *const f64,
    arm_angle: *const f64,
    q: *mut f64,
    q_len: usize,
) -> IrbkinCode {
    fn configured<const N: usize>(
        robot: &Robot<N>,
        pose: &Pose,
        [cf1, cf4, cf6, cfx]: [i32; 4],
        seed: Option<&[f64]>,
        arm_angle: Option<f64>,
    ) -> Result<[f64; N], Fault> {
        let seed = seed.map(|seed| joints("seed", seed)).transpose()?.copied();
        let configuration = Configuration { cf1, cf4, cf6, cfx };
        let request = ConfigurationRequest { arm_angle, seed, ..configuration.into() };
        Ok(robot.ik_configured(pose, request)?.q)
    }
    guarded(|| {
        // SAFETY: the pointers are as the header says.
        let (robot, pose) = unsafe { (handle("robot", robot)?, unchecked_pose("pose", pose)?) };
        check_length("q", q_len, robot.robot().dof())?;
        // SAFETY: as above.
        let confdata = *unsafe { array("confdata", confdata) }?;
        // SAFETY: as above.
        let seed = given(seed, || unsafe { slice("seed", seed, q_len) })?;
        // SAFETY: as above.
        let arm_angle = given(arm_angle, || unsafe { reference("arm_angle", arm_angle) })?.copied();
        on!(robot.robot(), robot => {
            let found = configured(robot, &pose, confdata, seed, arm_angle)?;
            // SAFETY: as above, and the length fits.
            *unsafe { array_mut("q", q) }? = found;
        });
        Ok(())
    })
}
