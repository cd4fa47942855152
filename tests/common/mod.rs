//! What several law tests need: random numbers, arms, distances.
#![allow(dead_code, unreachable_pub, missing_docs, clippy::unwrap_used, clippy::panic)]

pub mod parallel_arm;
pub mod tally;

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::{Mutex, PoisonError};

use irbkin::{Definition, Error, InstructionSet, JointLimits, OpwParameters, Robot};
use proptest::test_runner::Config as ProptestConfig;

/// Takes the instruction set that `IRBKIN_INSTRUCTION_SET` asks for, by its name; without it, the widest. Fails where the processor does not
/// have it: a run on another set would tell nothing of this one.
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

/// The same cases everywhere, on the instruction set that was asked for.
pub fn profile() -> ProptestConfig {
    asked_set();
    ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() }
}

/// Works on each instruction set of this processor in turn; one test at a time, for a set is forced in the whole process.
pub fn on_each_set(mut work: impl FnMut(InstructionSet)) {
    static FORCED: Mutex<()> = Mutex::new(());
    // A test that failed while it held the lock has said why.
    let _one_at_a_time = FORCED.lock().unwrap_or_else(PoisonError::into_inner);
    for set in InstructionSet::available() {
        set.force().unwrap();
        work(set);
    }
}

/// A small generator, so that a run gives the same poses everywhere (xorshift64*).
pub struct Rng(u64);

impl Rng {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// Uniform in 0 .. 1.
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        #[expect(clippy::cast_precision_loss, reason = "53 bits")]
        let mantissa = (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64;
        mantissa / 2.0_f64.powi(53)
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform inside the limits; in two turns either way where a joint has none.
    pub fn inside<const N: usize>(&mut self, limits: &JointLimits<N>) -> [f64; N] {
        limits.to_array().map(|[low, high]| self.between(low.max(-TAU * 2.0), high.min(TAU * 2.0)))
    }
}

/// Largest difference of two joint vectors, full turns not counted [rad].
pub fn apart<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b - TAU * ((a - b) / TAU).round()).abs()).fold(0.0, f64::max)
}

/// Step of the central differences [rad].
pub const DIFFERENCE_STEP: f64 = 1e-5;

/// The column of a joint, from 0, of the Jacobian of the tool in the base, by central differences.
pub fn central_difference(robot: &Robot<6>, q: &[f64; 6], joint: usize) -> [f64; 6] {
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

/// How far they may be off, the arm reaching so far [m]: a sixth of step^2 times the third derivative (one lever), and rounding over the step.
pub fn difference_bound(reach: f64) -> f64 {
    10.0 * (DIFFERENCE_STEP * DIFFERENCE_STEP + f64::EPSILON / DIFFERENCE_STEP) * (1.0 + reach)
}

/// Distance of the stretched arm's flange from axis 1, at the height of the shoulder [m].
pub fn reach_of<const N: usize>(robot: &Robot<N>) -> f64
where
    irbkin::Joints<N>: irbkin::Arity<N>,
{
    match robot.definition() {
        Definition::Opw(opw) => opw.a1.abs() + opw.c2 + opw.a2.hypot(opw.c3) + opw.c4,
        Definition::Mdh(mdh) => mdh.rows.iter().map(|row| row.a.hypot(row.d)).sum(),
    }
}

/// KUKA KR 6 R700 sixx (parameters of the cases from rs-opw-kinematics).
pub fn kuka_kr6() -> Result<Robot<6>, Error> {
    let robot = Robot::from_opw(OpwParameters {
        a1: 0.025,
        a2: -0.035,
        b: 0.0,
        c1: 0.4,
        c2: 0.315,
        c3: 0.365,
        c4: 0.08,
        offsets: [0.0, -FRAC_PI_2, 0.0, 0.0, 0.0, 0.0],
        signs: [-1, 1, 1, -1, 1, -1],
    })?;
    Ok(robot.with_limits(JointLimits::new([[-PI, PI]; 6])?))
}
