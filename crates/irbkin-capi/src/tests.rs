use core::cell::Cell;
use core::ffi::{CStr, c_char};
use core::ptr::{null, null_mut};
use std::alloc::{GlobalAlloc, Layout, System};
use std::ffi::CString;

use irbkin::{catalog, on};

use crate::cell::{irbkin_cell_free, irbkin_cell_of_boxes};
use crate::fault::{Fault, IrbkinCode, guarded, report};
use crate::handle::{IrbkinCell, IrbkinRobot};
use crate::robot::{irbkin_robot_dof, irbkin_robot_free, irbkin_robot_named};
use crate::solve::{
    irbkin_configuration, irbkin_fk, irbkin_ik, irbkin_ik_configured, irbkin_ik_nearest,
    irbkin_jacobian,
};
use crate::{IRBKIN_MOST_JOINTS, IRBKIN_MOST_SLOTS, irbkin_last_error};

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

/// Counts the allocations of each thread.
struct Counting;

#[global_allocator]
static COUNTING: Counting = Counting;

// SAFETY: the system's allocator does the work.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: as of the caller.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as of the caller.
        unsafe { System.dealloc(pointer, layout) }
    }
}

fn message() -> String {
    // SAFETY: the text ends with a zero and lives until the next call that fails.
    unsafe { CStr::from_ptr(irbkin_last_error()) }.to_str().unwrap().to_owned()
}

fn named(name: &CStr) -> *mut IrbkinRobot {
    let mut robot = null_mut();
    // SAFETY: both are living values.
    assert_eq!(unsafe { irbkin_robot_named(name.as_ptr(), &raw mut robot) }, IrbkinCode::Ok);
    robot
}

#[test]
fn a_panic_becomes_a_code_and_a_message() {
    let code = guarded(|| panic!("number {}", 7));
    assert_eq!(code, IrbkinCode::Panic);
    assert_eq!(message(), "an error inside irbkin, please report it: number 7");
}

#[test]
fn each_thread_has_its_own_last_error() {
    // SAFETY: NULL is refused.
    unsafe { irbkin_robot_dof(null()) };
    assert_eq!(message(), "robot is NULL");
    assert_eq!(std::thread::spawn(message).join().unwrap(), "");
}

#[test]
fn a_long_message_is_cut_off_between_characters() {
    for start in ["", "x"] {
        let words = start.to_owned() + &"\u{e9}".repeat(2000);
        assert_eq!(report(&Fault::Broken(words.clone())), IrbkinCode::BrokenPath);
        assert_eq!(message().len(), 2046 + start.len());
        assert!(words.starts_with(&message()));
    }
}

#[test]
fn addresses_and_lengths_that_no_slice_has_are_refused() {
    let robot = named(c"IRB 2600-12/1.65");
    let (q, mut pose) = ([0.0; 7], [0.0; 16]);
    let odd = q.as_ptr().wrapping_byte_add(1);
    // SAFETY: what is refused is not read.
    let mut fk = |q, q_len| unsafe { irbkin_fk(robot, q, q_len, pose.as_mut_ptr()) };
    assert_eq!(fk(odd, 6), IrbkinCode::InvalidArgument);
    assert_eq!(message(), "q is misaligned: its address must be a multiple of 8");
    assert_eq!(fk(q.as_ptr(), usize::MAX), IrbkinCode::InvalidArgument);
    assert!(message().starts_with("q has 18446744073709551615 elements, it must have at most"));
    // SAFETY: nobody uses it any more.
    unsafe { irbkin_robot_free(robot) };
}

#[test]
fn a_solve_does_not_allocate() {
    for (name, q) in [
        (c"IRB 2600-12/1.65", &[0.3, -0.2, 0.4, 0.5, -0.6, 0.7][..]),
        (c"UR5e", &[0.3, -1.2, 1.4, -0.5, 0.6, 0.7]),
        (c"Panda", &[0.1, -0.7, 0.2, -2.2, 0.1, 1.7, 0.6]),
    ] {
        let (robot, dof) = (named(name), q.len());
        let (mut pose, mut jacobian, mut all) = ([0.0; 16], [0.0; 42], [0.0; 56]);
        let (mut status, mut found, mut near, mut confdata) = ([0; 8], 0, [0.0; 7], [0; 4]);
        let q7 = q.get(6).map_or(null(), |q7| &raw const *q7);
        let before = ALLOCATIONS.get();
        // SAFETY: all of them are living values of the lengths that are given.
        let codes = unsafe {
            let (q, pose, out) = (q.as_ptr(), pose.as_mut_ptr(), near.as_mut_ptr());
            let (all, status) = (all.as_mut_ptr(), status.as_mut_ptr());
            [
                irbkin_fk(robot, q, dof, pose),
                irbkin_jacobian(robot, q, dof, 1, jacobian.as_mut_ptr(), 6 * dof),
                irbkin_ik(robot, pose, q7, all, 8 * dof, status, 8, &raw mut found),
                irbkin_ik_nearest(robot, pose, q, null(), out, dof),
            ]
        };
        assert_eq!((ALLOCATIONS.get(), codes), (before, [IrbkinCode::Ok; 4]), "{name:?}");
        assert!(found > 0);
        if name == c"IRB 2600-12/1.65" {
            // SAFETY: as above.
            let codes = unsafe {
                let (q, confdata) = (q.as_ptr(), confdata.as_mut_ptr());
                let (pose, out) = (pose.as_ptr(), near.as_mut_ptr());
                [
                    irbkin_configuration(robot, q, dof, confdata),
                    irbkin_ik_configured(robot, pose, confdata, q, null(), out, dof),
                ]
            };
            assert_eq!((ALLOCATIONS.get(), codes), (before, [IrbkinCode::Ok; 2]));
        }
        // SAFETY: nobody uses it any more.
        unsafe { irbkin_robot_free(robot) };
    }
}

#[test]
fn a_debug_build_refuses_freed_handles_and_those_of_another_type() {
    let robot = named(c"UR5e");
    let mut cell: *mut IrbkinCell = null_mut();
    // SAFETY: a debug build keeps the memory of a handle, so that its mark can be read.
    unsafe {
        assert_eq!(irbkin_cell_of_boxes(null(), 0, 0.0, &raw mut cell), IrbkinCode::Ok);
        assert_eq!(irbkin_robot_dof(robot), 6);
        assert_eq!(irbkin_robot_dof(cell.cast()), 0);
        assert_eq!(message(), "robot is not a living handle: it was freed, or is of another type");
        irbkin_robot_free(robot);
        assert_eq!(irbkin_robot_dof(robot), 0);
        irbkin_robot_free(robot);
        irbkin_cell_free(cell);
        irbkin_cell_free(cell);
    }
    assert_eq!(message(), "cell is not a living handle: it was freed, or is of another type");
}

#[test]
fn no_arm_has_more_joints_or_slots_than_the_header_says() {
    for arm in catalog() {
        let robot = irbkin::AnyRobot::from_catalog(&arm).unwrap();
        assert!(robot.dof() <= IRBKIN_MOST_JOINTS);
        assert!(on!(robot, robot => robot.slot_count()) <= IRBKIN_MOST_SLOTS, "{}", arm.name);
    }
}

#[test]
fn texts_are_refused_that_are_no_utf_8() {
    let (name, mut robot) = ([b'U', b'R', 0xff, 0], null_mut());
    // SAFETY: both are living values.
    let code = unsafe { irbkin_robot_named(name.as_ptr().cast::<c_char>(), &raw mut robot) };
    assert_eq!((code, robot.is_null()), (IrbkinCode::InvalidArgument, true));
    assert_eq!(message(), "name is not UTF-8 from byte 2 on");
}

#[test]
fn a_name_of_10_mb_is_refused_at_once_with_a_short_message() {
    let (name, mut robot) = (CString::new(vec![b'a'; 10_000_000]).unwrap(), null_mut());
    // SAFETY: both are living values.
    let code = unsafe { irbkin_robot_named(name.as_ptr(), &raw mut robot) };
    assert_eq!((code, robot.is_null()), (IrbkinCode::UnknownRobot, true));
    assert!(message().len() < 200, "{}", message().len());
}
