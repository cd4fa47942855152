//! Handles: a value on the heap whose address a caller has.
//!
//! In a debug build each handle has a mark, by which a handle that was freed or is of another type
//! is recognized. Such a build does not return the memory of a handle that is freed.

use core::ffi::c_char;
use core::mem::offset_of;
use core::sync::atomic::{AtomicU64, Ordering};
use std::ffi::CString;
use std::sync::Arc;

use irbkin::{ByJoints, on};
use irbkin_motion::Arm;
use irbkin_motion::cell::Cell;

use crate::arguments::{array_mut, given, reference};
use crate::fault::Fault;

/// An arm of six or of seven joints.
pub(crate) type Arms = ByJoints<Arm<6>, Arm<7>, Arm<5>>;

/// A robot arm. It does not change: any threads may use it at the same time.
pub struct IrbkinRobot(Marked<(Arms, CString)>);

/// Obstacles around an arm. They do not change: any threads may use them at the same time.
pub struct IrbkinCell(Marked<Arc<Cell>>);

/// A value behind a mark, which is at the address of the handle, whatever the type.
#[repr(C)]
struct Marked<T> {
    mark: AtomicU64,
    value: T,
}

pub(crate) trait Handle {
    /// The mark of a living handle: of this type only, and nothing that memory often holds.
    const LIVING: u64;
}

impl Handle for IrbkinRobot {
    const LIVING: u64 = u64::from_le_bytes(*b"irbkin_R");
}

impl Handle for IrbkinCell {
    const LIVING: u64 = u64::from_le_bytes(*b"irbkin_C");
}

const _: () = assert!(offset_of!(IrbkinRobot, 0) == 0 && offset_of!(IrbkinCell, 0) == 0);

/// Any threads may use a handle at the same time.
const _: () = {
    const fn is_shared<H: Send + Sync>() {}
    is_shared::<IrbkinRobot>();
    is_shared::<IrbkinCell>();
};

impl IrbkinRobot {
    pub(crate) fn new(robot: Arms) -> Self {
        let name = CString::new(on!(&robot, robot => robot.name())).unwrap_or_default();
        Self(Marked { mark: AtomicU64::new(Self::LIVING), value: (robot, name) })
    }

    pub(crate) fn robot(&self) -> &Arms {
        &self.0.value.0
    }

    pub(crate) fn name(&self) -> *const c_char {
        self.0.value.1.as_ptr()
    }
}

impl IrbkinCell {
    pub(crate) fn new(cell: Cell) -> Self {
        Self(Marked { mark: AtomicU64::new(Self::LIVING), value: Arc::new(cell) })
    }

    pub(crate) fn cell(&self) -> &Arc<Cell> {
        &self.0.value
    }
}

/// The value of a handle.
///
/// # Safety
///
/// The handle is NULL or of [`give`], and is not freed during the call.
pub(crate) unsafe fn handle<'a, H: Handle>(
    argument: &'static str,
    pointer: *const H,
) -> Result<&'a H, Fault> {
    if cfg!(debug_assertions) {
        // SAFETY: as of the caller; each handle begins with its mark.
        let mark: &AtomicU64 = unsafe { reference(argument, pointer.cast()) }?;
        if mark.load(Ordering::Relaxed) != H::LIVING {
            return Err(Fault::NoHandle { argument });
        }
    }
    // SAFETY: as of the caller.
    unsafe { reference(argument, pointer) }
}

/// Give the handle of a new value to the caller; NULL where the call fails.
///
/// # Safety
///
/// `out` is NULL or writable.
pub(crate) unsafe fn give<H>(
    argument: &'static str,
    out: *mut *mut H,
    new: impl FnOnce() -> Result<H, Fault>,
) -> Result<(), Fault> {
    // SAFETY: as of the caller.
    let [out] = unsafe { array_mut(argument, out) }?;
    *out = core::ptr::null_mut();
    *out = Box::into_raw(Box::new(new()?));
    Ok(())
}

/// Free a handle; NULL does nothing.
///
/// # Safety
///
/// The handle is NULL or of [`give`], and nobody uses it any more.
pub(crate) unsafe fn free<H: Handle>(argument: &'static str, pointer: *mut H) -> Result<(), Fault> {
    // SAFETY: as of the caller.
    if given(pointer, || unsafe { handle(argument, pointer) })?.is_none() {
        return Ok(());
    }
    if cfg!(debug_assertions) {
        // SAFETY: the mark, which has nothing to drop, stays, and the rest is dropped once.
        unsafe {
            (*pointer.cast::<AtomicU64>()).store(0, Ordering::Relaxed);
            pointer.drop_in_place();
        }
    } else {
        // SAFETY: it is of `Box::into_raw`.
        drop(unsafe { Box::from_raw(pointer) });
    }
    Ok(())
}
