//! Time of all solutions of a pose and of forward kinematics, by the Rust crate and by the C
//! library in turn: overhead LIBRARY.
#![allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::float_cmp)]

use std::ffi::{CString, c_char, c_int, c_void};
use std::hint::black_box;
use std::mem::transmute;
use std::ptr::{null, null_mut};
use std::time::Instant;

use irbkin::{Robot, pose};

/// Rounds, each so short that other programs leave many of them alone.
const ROUNDS: usize = 300;
const CALLS: u32 = 2_000;

unsafe extern "C" {
    fn dlopen(path: *const c_char, flags: c_int) -> *mut c_void;
    fn dlsym(library: *mut c_void, name: *const c_char) -> *mut c_void;
}

type Named = unsafe extern "C" fn(*const c_char, *mut *mut c_void) -> c_int;
type Fk = unsafe extern "C" fn(*const c_void, *const f64, usize, *mut f64) -> c_int;
type Ik = unsafe extern "C" fn(
    *const c_void,
    *const f64,
    *const f64,
    *mut f64,
    usize,
    *mut u8,
    usize,
    *mut usize,
) -> c_int;

/// Time of a call [ns].
fn time(mut call: impl FnMut()) -> f64 {
    let start = Instant::now();
    (0..CALLS).for_each(|_| call());
    start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS)
}

fn main() {
    let path = CString::new(std::env::args().nth(1).unwrap()).unwrap();
    // SAFETY: the library's initialization has no conditions. 2 is RTLD_NOW.
    let library = unsafe { dlopen(path.as_ptr(), 2) };
    assert!(!library.is_null(), "{path:?} cannot be loaded");
    let symbol = |name: &str| {
        let name = CString::new(name).unwrap();
        // SAFETY: the library was loaded, and the name ends with a zero.
        let symbol = unsafe { dlsym(library, name.as_ptr()) };
        assert!(!symbol.is_null(), "{name:?} is missing");
        symbol
    };
    // SAFETY: these are the types of irbkin.h.
    let (named, fk, ik): (Named, Fk, Ik) = unsafe {
        (
            transmute::<*mut c_void, Named>(symbol("irbkin_robot_named")),
            transmute::<*mut c_void, Fk>(symbol("irbkin_fk")),
            transmute::<*mut c_void, Ik>(symbol("irbkin_ik")),
        )
    };

    let name = "IRB 2600-12/1.65";
    // On the heap, as a handle.
    let robot: Box<Robot<6>> = Box::new(Robot::named(name).unwrap());
    let q = [0.3, -0.2, 0.4, 0.5, -0.6, 0.7];
    let at = robot.fk(&q);
    let (rows, mut handle) = (pose::to_rows(&at), null_mut());
    let name = CString::new(name).unwrap();
    // SAFETY: both are living values.
    assert_eq!(unsafe { named(name.as_ptr(), &raw mut handle) }, 0);
    let (mut all, mut status, mut found, mut to) = ([0.0; 48], [0; 8], 0, [0.0; 16]);

    let mut calls: [&mut dyn FnMut(); 4] = [
        &mut || _ = black_box(robot.ik(black_box(&at))),
        &mut || {
            let (q, status, rows) = (all.as_mut_ptr(), status.as_mut_ptr(), rows.as_ptr());
            // SAFETY: all of them are living values of the lengths that are given.
            let code =
                unsafe { ik(handle, black_box(rows), null(), q, 48, status, 8, &raw mut found) };
            assert_eq!(black_box(code), 0);
        },
        &mut || _ = black_box(robot.fk(black_box(&q))),
        &mut || {
            // SAFETY: as above.
            let code = unsafe { fk(handle, black_box(q.as_ptr()), 6, to.as_mut_ptr()) };
            assert_eq!(black_box(code), 0);
        },
    ];
    let mut best = [f64::INFINITY; 4];
    for _ in 0..ROUNDS {
        for (best, call) in best.iter_mut().zip(&mut calls) {
            *best = best.min(time(&mut **call));
        }
    }
    assert_eq!(found, robot.ik(&at).unwrap().len());
    assert_eq!(to, rows);
    let whats = ["all 8 solutions of a pose", "forward kinematics"];
    for (what, [rust, c]) in whats.iter().zip(best.as_chunks::<2>().0) {
        println!(
            "{what}: Rust {rust:.0} ns, C {c:.0} ns, ratio {:.2}, {:+.0} ns",
            c / rust,
            c - rust
        );
    }
}
