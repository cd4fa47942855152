//! Many postures or poses at once.

use core::num::NonZeroUsize;

use irbkin::batch::Batch;
use irbkin::on;
use irbkin_motion::cell::Cell;

use crate::arguments::{check_apart, given, slice, slice_mut};
use crate::fault::{IrbkinCode, guarded};
use crate::handle::{IrbkinCell, IrbkinRobot, handle};

fn batch(threads: usize) -> Batch<'static> {
    Batch::new(NonZeroUsize::new(threads))
}

/// Write the poses of many joint vectors: `count` rows of dof angles [rad] to `count` rows of 16
/// numbers, NaN for a row that is not finite.
///
/// Up to `threads` threads help; 0 and 1: none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_fk_batch(
    robot: *const IrbkinRobot,
    q: *const f64,
    q_len: usize,
    poses: *mut f64,
    poses_len: usize,
    threads: usize,
) -> IrbkinCode {
    guarded(|| {
        // SAFETY: the pointers are as the header says.
        let (robot, q) = unsafe { (handle("robot", robot)?, slice("q", q, q_len)?) };
        check_apart(("q", q), ("poses", poses, poses_len))?;
        // SAFETY: as above.
        let poses = unsafe { slice_mut("poses", poses, poses_len) }?;
        on!(robot.robot(), robot => Ok(batch(threads).fk(robot, q, poses)?))
    })
}

/// Write every solution of many poses, as irbkin_ik().
///
/// `poses` has `count` rows of 16 numbers, `angles` the angle of joint 7 of seven joints at each;
/// NULL of six. `q` has `count` times slot_count rows of dof angles [rad], `status` as many flags.
/// A row that is no pose has NaN and IRBKIN_STATUS_INVALID; the others are solved.
///
/// Up to `threads` threads help; 0 and 1: none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_ik_batch(
    robot: *const IrbkinRobot,
    poses: *const f64,
    count: usize,
    angles: *const f64,
    q: *mut f64,
    q_len: usize,
    status: *mut u8,
    status_len: usize,
    threads: usize,
) -> IrbkinCode {
    guarded(|| {
        let poses_len = count.saturating_mul(16);
        // SAFETY: the pointers are as the header says.
        let (robot, poses) =
            unsafe { (handle("robot", robot)?, slice("poses", poses, poses_len)?) };
        // SAFETY: as above.
        let angles =
            given(angles, || unsafe { slice("angles", angles, count) })?.unwrap_or_default();
        check_apart(("poses", poses), ("q", q, q_len))?;
        check_apart(("angles", angles), ("q", q, q_len))?;
        // SAFETY: as above.
        let (q, status) =
            unsafe { (slice_mut("q", q, q_len)?, slice_mut("status", status, status_len)?) };
        on!(robot.robot(), robot => Ok(batch(threads).ik_with(robot, poses, angles, q, status)?))
    })
}

/// Write whether an arm collides at many joint vectors: with itself, or with what is in a cell.
///
/// `cell` may be NULL: the arm is alone. `q` has `count` rows of dof angles [rad], `collides` has
/// `count` elements. Up to `threads` threads help; 0 and 1: none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_collides(
    robot: *const IrbkinRobot,
    cell: *const IrbkinCell,
    q: *const f64,
    count: usize,
    collides: *mut bool,
    threads: usize,
) -> IrbkinCode {
    guarded(|| {
        // SAFETY: the pointers are as the header says.
        let robot = unsafe { handle("robot", robot) }?;
        // SAFETY: as above.
        let cell = given(cell, || unsafe { handle("cell", cell) })?;
        let q_len = count.saturating_mul(robot.robot().dof());
        // SAFETY: as above. Zero is a byte of `bool`, whatever was there.
        let (q, collides) = unsafe {
            slice_mut("collides", collides.cast::<u8>(), count)?.fill(0);
            (slice("q", q, q_len)?, slice_mut("collides", collides, count)?)
        };
        let alone = Cell::default();
        let cell = cell.map_or(&alone, |cell| cell.cell());
        on!(robot.robot(), robot => Ok(cell.collides_batch(&mut batch(threads), robot, q, collides)?))
    })
}
