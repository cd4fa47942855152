//! A solve allocates nothing.
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use irbkin::follow::Follower;
use irbkin::{Corrections, JacobianFrame, Robot};
use irbkin_motion::Arm;
use irbkin_motion::body::Shape;
use irbkin_motion::stream::{Guard, GuardOptions, OnViolation, Reason};
use irbkin_motion::trajectory::state::{brake, to_rest};
use irbkin_motion::trajectory::{AxisLimits, AxisMotion, AxisState};

/// The system's allocator, counting the allocations of the test's own thread.
struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: every call is passed unchanged to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let _ = ALLOCATIONS.try_with(|count| count.set(count.get() + 1));
        // SAFETY: the caller's contract is that of the system's allocator.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations_of(work: impl FnOnce()) -> usize {
    let before = ALLOCATIONS.get();
    work();
    ALLOCATIONS.get() - before
}

#[test]
fn a_step_of_a_guard_allocates_nothing() {
    let robot: Arm<6> = Arm::named("IRB 2600-12/1.65").unwrap();
    let at = |x: f64, z: f64| irbkin::Pose::translation(x, 0.0, z);
    let obstacles = vec![
        ("box".to_string(), Shape::cuboid([0.2, 2.0, 2.0], &at(1.4, 1.0)).unwrap()),
        ("post".to_string(), Shape::cylinder(0.1, 2.0, &at(-1.0, 1.0)).unwrap()),
    ];
    let cell = irbkin_motion::cell::Cell::new(obstacles, 0.005).unwrap();
    let start = [0.0, 0.0, 0.0, 0.0, 0.5, 0.0];
    let options = GuardOptions {
        max_jerk: Some([60.0; 6]),
        max_tool_speed: Some(2.0),
        on_violation: OnViolation::Limit,
        ..GuardOptions::new(0.004, [8.0; 6])
    };
    let mut guard = Guard::new(&robot, &start, Some(&cell), &options).unwrap();
    let pose = robot.fk(&[0.3, 0.1, 0.1, 0.2, 0.7, 0.1]);
    let (mut refused, mut blocked) = (0, false);
    let count = allocations_of(|| {
        for cycle in 0..1500 {
            let step = match cycle / 100 % 5 {
                0 => guard.step_none(),
                1 => guard.step_pose(&pose),
                2 => guard.step(&[0.2, 1.2, 0.0, 0.0, 0.5, 0.0]),
                3 => guard.step(&[f64::NAN; 6]),
                _ => guard.step(&start),
            };
            refused += usize::from(!step.accepted);
            blocked |= matches!(step.reason, Some(Reason::Blocked { .. }));
        }
    });
    assert_eq!(count, 0);
    assert!(blocked && refused > 300);
}

#[test]
fn the_counter_counts() {
    assert_eq!(allocations_of(|| drop(std::hint::black_box(Box::new(1)))), 1);
}

#[test]
fn solve_allocates_nothing() {
    let robot: Arm<6> = Arm::named("IRB 2600-12/1.65").unwrap();
    let panda: Arm<7> = Arm::named("Panda").unwrap();
    let ur3: Arm<6> = Arm::named("UR3").unwrap();
    let coupled: Robot<6> = Robot::named("IRB 2400-10/1.55").unwrap();
    let coupled = coupled.with_linkage_limits(Some([-2.0, 1.0])).unwrap();
    let q = [0.3, -0.2, 0.4, 0.5, -0.6, 0.7];
    let pose = robot.fk(&q);
    let mut corrections = Corrections::NONE;
    corrections.rows = [[1e-3; 5]; 6];
    let refined = robot.with_corrections(&corrections).unwrap().with_nominal(&robot).unwrap();
    let count = allocations_of(|| {
        let solutions = std::hint::black_box(robot.ik(&pose).unwrap());
        assert_eq!(solutions.len(), 8);
        assert!(solutions.turns().count() > 8);
        std::hint::black_box(
            solutions.within_limits().filter(|s| s.q[0] > 0.0).least_motion(&q, &[1.0; 6]).is_ok(),
        );
        std::hint::black_box(robot.ik_nearest(&pose, &q, &[1.0; 6]).unwrap());
        // Singular poses and poses out of reach take the same path.
        std::hint::black_box(robot.ik(&robot.fk(&[0.0; 6])).unwrap());
        let mut far = pose;
        far.translation.vector.x += 10.0;
        std::hint::black_box(robot.ik(&far).unwrap().explain());
        std::hint::black_box(robot.jacobian(&q, JacobianFrame::Tool));
        std::hint::black_box(robot.singularity(&q));
        let free = robot.ik(&robot.fk(&[0.0; 6])).unwrap().slot(0).copied().unwrap();
        std::hint::black_box(
            robot.with_free_joint(&robot.fk(&[0.0; 6]), &free, 0.3).unwrap().unwrap(),
        );
        let mut follower = Follower::new(&robot, &q, &[1.0; 6]).unwrap();
        for step in 0..20 {
            let pose = robot.fk(&[0.3, -0.2, 0.4, 0.5, 0.05 * f64::from(step) - 0.6, 0.7]);
            assert!(std::hint::black_box(follower.step(&pose).unwrap()).0.is_some());
        }
        std::hint::black_box(robot.link_frames(&q));
        std::hint::black_box(panda.fk(&[0.1; 7]));
        std::hint::black_box(panda.singularity(&[0.1; 7]));
        let (bent, q7) = ([0.1, -0.7, 0.2, -2.2, 0.1, 1.7, 0.6], 0.6);
        assert!(std::hint::black_box(panda.ik(&panda.fk(&bent), q7).unwrap()).len() > 1);
        assert!(std::hint::black_box(panda.ik(&panda.fk(&[0.0; 7]), 0.0).unwrap()).len() > 1);
        std::hint::black_box(
            panda
                .ik_nearest(&panda.fk(&bent), &[0.0, -0.6, 0.1, -2.0, 0.0, 1.5, 0.5], &[1.0; 7])
                .unwrap(),
        );
        // By configuration, also for a free joint and a coupled arm.
        for (arm, q) in [(&*robot, q), (&*robot, [0.1, 0.2, 0.3, -2.0, 0.0, 1.0]), (&coupled, q)] {
            let configuration = arm.configuration(&q).unwrap();
            std::hint::black_box(arm.ik_configured(&arm.fk(&q), configuration).unwrap());
        }
        // Next to a singularity, too, where Newton's method alone does not do.
        for q in [q, [0.3, -0.2, 0.4, 0.5, 1e-4, 0.7]] {
            let pose = refined.fk(&q);
            assert!(!std::hint::black_box(refined.ik(&pose).unwrap()).is_empty());
            std::hint::black_box(refined.ik_nearest(&pose, &q, &[1.0; 6]).is_ok());
            std::hint::black_box(refined.corrected_fk(&corrections, &q));
        }
        for q in [q, [0.0; 6]] {
            assert!(!std::hint::black_box(ur3.ik(&ur3.fk(&q)).unwrap()).is_empty());
            std::hint::black_box(ur3.ik_nearest(&ur3.fk(&q), &q, &[1.0; 6]).unwrap());
        }
    });
    assert_eq!(count, 0);
}

#[test]
fn motions_of_axes_allocate_nothing_and_a_line_what_it_returns() {
    use irbkin_motion::paths::{ArcOrientation, Spacing, arc, line};
    use irbkin_motion::trajectory::{AxisLimits, AxisMotion, AxisState, Profile};

    let limits = AxisLimits { velocity: 3.0, acceleration: 8.0, jerk: 60.0 };
    let profiles = [Profile::Quintic, Profile::Cubic, Profile::Trapezoid, Profile::SCurve];
    let count = allocations_of(|| {
        for profile in profiles {
            // Six joints that arrive together.
            let ends = [0.1, -0.7, 1.9, 0.0, 2.0, -3.0];
            let axes = ends.map(|end| AxisMotion::within(profile, 0.0, end, &limits));
            let duration = axes.iter().map(AxisMotion::duration).fold(0.0, f64::max);
            let axes = axes.map(|axis| axis.stretched(duration));
            let middle = axes.map(|axis| axis.state(0.5 * duration).position);
            assert!(
                middle.iter().zip(ends).all(|(middle, end)| (middle - end / 2.0).abs() < 1e-12)
            );
        }
        let start = AxisState { position: 0.0, velocity: 1.0, acceleration: 2.0 };
        std::hint::black_box(AxisMotion::quintic(start, AxisState::at_rest(1.0), 2.0).state(0.3));
    });
    assert_eq!(count, 0);
    let poses = [[0.8, -0.2, 0.6], [0.9, 0.0, 0.6], [0.8, 0.2, 0.6]]
        .map(|xyz| irbkin::pose::from_euler_zyx(xyz, [xyz[1], 3.1, 0.0]).unwrap());
    let spacing = Spacing::count(1000).unwrap();
    let count = allocations_of(|| {
        assert_eq!(line(&poses[0], &poses[2], spacing, None).unwrap().len(), 1000);
        let path = arc(&poses[0], &poses[1], &poses[2], ArcOrientation::default(), spacing);
        assert_eq!(path.unwrap().len(), 1000);
    });
    assert_eq!(count, 2);
}

#[test]
fn motions_to_rest_and_brakes_allocate_nothing() {
    let now = AxisState { position: 0.2, velocity: 1.0, acceleration: -3.0 };
    let limits = AxisLimits { velocity: 2.0, acceleration: 8.0, jerk: 60.0 };
    let targets = [0.9, -1.0, 0.2, 0.21, 3.0, 0.0];
    let mut motions = [AxisMotion::still(0.0, 0.0); 6];
    let count = allocations_of(|| {
        std::hint::black_box(to_rest(&[now; 6], &targets, &[limits; 6], &mut motions).unwrap());
        std::hint::black_box(brake(&now, &limits).unwrap());
    });
    assert_eq!(count, 0);
}
