//! Shared by several tests: random numbers, arms, distances.

pub mod company;
pub mod coupled_arm;
pub mod rng;
pub mod scenes;
pub mod sets;
pub mod tally;

use std::f64::consts::{PI, TAU};

use irbkin::{Definition, DhRow, InstructionSet, JointLimits, Mdh, Pose, Robot, pose};
use proptest::prelude::*;
use proptest::test_runner::{Config as ProptestConfig, FileFailurePersistence, RngSeed};

pub use rng::Rng;

/// The table of a KUKA LBR iiwa 7 R800: alpha [deg], a, d [m], theta.
pub const IIWA_ROWS: [[f64; 4]; 7] = [
    [0.0, 0.0, 0.36, 0.0],
    [-90.0, 0.0, 0.0, 0.0],
    [90.0, 0.0, 0.42, 0.0],
    [90.0, 0.0, 0.0, 0.0],
    [-90.0, 0.0, 0.4, 0.0],
    [-90.0, 0.0, 0.0, 0.0],
    [90.0, 0.0, 0.126, 0.0],
];

/// A KUKA LBR iiwa 7 R800 with its limits.
pub fn iiwa() -> Robot<7> {
    let rows = IIWA_ROWS.map(|[alpha, a, d, theta]| DhRow::new(alpha.to_radians(), a, d, theta));
    let identity = Pose::identity();
    let robot = Robot::from_mdh(Mdh { base: identity, rows, flange: identity }).unwrap();
    let limits = [170.0, 120.0, 170.0, 120.0, 170.0, 120.0, 175.0_f64];
    let limits = limits.map(|limit| [-limit.to_radians(), limit.to_radians()]);
    robot.with_limits(JointLimits::new(limits).unwrap())
}

/// Use the instruction set named in `IRBKIN_INSTRUCTION_SET`; without it, the widest. Fails if the
/// processor does not support it: a run on another set would show nothing about this one.
pub fn asked_set() -> InstructionSet {
    if let Ok(name) = std::env::var("IRBKIN_INSTRUCTION_SET") {
        let names: Vec<_> = InstructionSet::available().map(InstructionSet::name).collect();
        let set = InstructionSet::available().find(|set| set.name() == name);
        set.unwrap_or_else(|| {
            panic!("IRBKIN_INSTRUCTION_SET is {name:?}, this processor has {names:?}")
        })
        .force()
        .unwrap();
    }
    InstructionSet::in_use()
}

/// Whether enough was drawn for a test to show something. Other random numbers (`IRBKIN_SEED`) give
/// other counts, of which nothing is asked.
pub fn enough(counts: bool) -> bool {
    counts || std::env::var_os("IRBKIN_SEED").is_some()
}

/// Seeds of cases that failed once; each run tries them first.
const REGRESSIONS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/regressions.txt");

/// The same cases everywhere, on the requested instruction set.
///
/// `PROPTEST_RNG_SEED` draws others, `PROPTEST_CASES` more. The seed of a case that fails is kept
/// in tests/regressions.txt, which is committed.
pub fn profile() -> ProptestConfig {
    asked_set();
    let asked = ProptestConfig::default();
    let rng_seed = match asked.rng_seed {
        RngSeed::Random => RngSeed::Fixed(20_260_117),
        fixed @ RngSeed::Fixed(_) => fixed,
    };
    let is_asked = std::env::var("PROPTEST_CASES").is_ok();
    let cases = if is_asked { asked.cases } else { 2000 / u32::try_from(divisor()).unwrap() };
    ProptestConfig {
        cases,
        rng_seed,
        max_global_rejects: 20 * cases,
        failure_persistence: Some(Box::new(FileFailurePersistence::Direct(REGRESSIONS))),
        ..asked
    }
}

/// Largest difference of two joint vectors, modulo 2 pi [rad].
pub fn apart<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| wrapped(a - b)).fold(0.0, f64::max)
}

/// Distance of an angle from the nearest multiple of 2 pi [rad].
pub fn wrapped(angle: f64) -> f64 {
    (angle - TAU * (angle / TAU).round()).abs()
}

/// Number of poses of a test: `IRBKIN_POSES`, or a default over the divisor.
pub fn poses_or(default: usize) -> usize {
    asked("IRBKIN_POSES").unwrap_or_else(|| default / divisor())
}

/// How many times fewer cases and poses are drawn: `IRBKIN_DIVISOR`, or 1.
pub fn divisor() -> usize {
    asked("IRBKIN_DIVISOR").unwrap_or(1)
}

fn asked(name: &str) -> Option<usize> {
    std::env::var(name).ok().map(|count| count.parse().unwrap())
}

/// Step of the central differences [rad].
pub const DIFFERENCE_STEP: f64 = 1e-5;

/// The column of a joint, from 0, of the Jacobian of the tool in the base, by central differences.
pub fn central_difference<const N: usize>(
    robot: &Robot<N>,
    q: &[f64; N],
    joint: usize,
) -> [f64; 6] {
    let (mut before, mut after) = (*q, *q);
    before[joint] -= DIFFERENCE_STEP;
    after[joint] += DIFFERENCE_STEP;
    let (before, after) = (robot.fk(&before), robot.fk(&after));
    let linear = (after.translation.vector - before.translation.vector) / (2.0 * DIFFERENCE_STEP);
    // dR/dq R^T is the cross-product matrix of the angular velocity.
    let rate = (after.rotation.matrix() - before.rotation.matrix()) / (2.0 * DIFFERENCE_STEP);
    let spin = rate * robot.fk(q).rotation.matrix().transpose();
    [linear.x, linear.y, linear.z, spin[(2, 1)], spin[(0, 2)], spin[(1, 0)]]
}

/// Bound of the error of a central difference for an arm with the given reach [m]: a sixth of
/// step^2 times the third derivative (one lever), and rounding over the step.
pub fn difference_bound(reach: f64) -> f64 {
    10.0 * (DIFFERENCE_STEP * DIFFERENCE_STEP + f64::EPSILON / DIFFERENCE_STEP) * (1.0 + reach)
}

/// Distance of the stretched arm's flange from axis 1, at the height of the shoulder [m].
pub fn reach_of<const N: usize>(robot: &Robot<N>) -> f64 {
    match robot.definition() {
        Definition::Opw(opw) => opw.a1.abs() + opw.c2 + opw.a2.hypot(opw.c3) + opw.c4,
        Definition::Mdh(mdh) | Definition::Refined { mdh, .. } => {
            mdh.rows.iter().map(|row| row.a.hypot(row.d)).sum()
        }
    }
}

/// Poses within so far along each axis [m], in any orientation.
pub fn poses(far: f64) -> impl Strategy<Value = Pose> {
    (prop::array::uniform3(-far..far), prop::array::uniform3(-PI..PI))
        .prop_map(|(xyz, zyx)| pose::from_euler_zyx(xyz, zyx).unwrap())
}

/// A pose within so far along each axis [m], in any orientation.
pub fn random_pose(rng: &mut Rng, far: f64) -> Pose {
    let xyz = std::array::from_fn(|_| rng.between(-far, far));
    pose::from_euler_zyx(xyz, rng.angles()).unwrap()
}
