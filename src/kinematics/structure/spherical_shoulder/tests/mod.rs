//! Laws of arms with a spherical shoulder. `IRBKIN_POSES` scales the number of poses.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod complete;
mod random;
mod reach;
mod recognised;
mod singular;

use core::f64::consts::{FRAC_PI_2, PI, TAU};
use std::vec::Vec;

use super::*;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::{DhRow, Mdh};
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::PoseError;
use crate::kinematics::structure::any::recognized;
use crate::kinematics::structure::branches::Branches;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::structure::solver::Solver;

const SLOTS: usize = 8;

const PANDA_LIMITS: [[f64; 2]; 7] = [
    [-2.8973, 2.8973],
    [-1.7628, 1.7628],
    [-2.8973, 2.8973],
    [-3.0718, -0.0698],
    [-2.8973, 2.8973],
    [-0.0175, 3.7525],
    [-2.8973, 2.8973],
];
const FR3_LIMITS: [[f64; 2]; 7] = [
    [-2.7437, 2.7437],
    [-1.7837, 1.7837],
    [-2.9007, 2.9007],
    [-3.0421, -0.1518],
    [-2.8065, 2.8065],
    [0.5445, 4.5169],
    [-3.0159, 3.0159],
];

/// A chain with its solver.
struct Arm {
    name: &'static str,
    chain: Chain<7>,
    solver: Solver<SphericalShoulder, 7, 8>,
}

impl Arm {
    fn new(name: &'static str, mdh: &Mdh<7>) -> Self {
        let (chain, solver) = recognized(mdh).unwrap();
        Self { name, solver, chain }
    }

    fn between(self, base: Pose, tool: Pose) -> Self {
        let chain = self.chain.with_base(base).with_tool(tool);
        Self {
            solver: Solver::new(self.solver.structure, &chain, &JointLimits::UNLIMITED),
            chain,
            name: self.name,
        }
    }

    fn geometry(&self) -> &SphericalShoulder {
        &self.solver.structure
    }

    /// Solved from the pose of `q`, the free joints at rest.
    fn ik(&self, q: &[f64; 7]) -> Branches<7> {
        self.solve(&self.chain.fk(q), &FreeChoice::rest([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, q[6]]))
    }

    fn solve(&self, pose: &Pose, free: &FreeChoice<7>) -> Branches<7> {
        let seven = self.solver.surroundings.wrist_pose(pose);
        self.geometry().solve(&seven, free.q[6], free)
    }

    /// The hand of a tool pose, seen from the shoulder.
    fn hand_pose(&self, pose: &Pose, q7: f64) -> Pose {
        self.geometry().hand(&self.solver.surroundings.wrist_pose(pose), q7)
    }

    /// The worst distance of a solution from the pose.
    fn residual(&self, branches: &Branches<7>, pose: &Pose) -> PoseError {
        let mut worst = PoseError::default();
        for q in branches.q.iter().flatten() {
            assert!(q.iter().all(|angle| angle.is_finite()), "{}: {branches:?}", self.name);
            let error = PoseError::between(&self.chain.fk(q), pose);
            worst = PoseError {
                position: worst.position.max(error.position),
                rotation: worst.rotation.max(error.rotation),
            };
        }
        worst
    }

    /// How well a joint vector is known from its pose: rounding over the smallest singular value of the Jacobian [rad].
    fn recall(&self, q: &[f64; 7]) -> f64 {
        let jacobian = self.chain.jacobian(q, crate::kinematics::JacobianFrame::Base);
        let sigma = jacobian.fixed_columns::<6>(0).into_owned().singular_values()[5];
        (8e-15 / sigma).max(1e-9)
    }

    /// The slot of a joint vector by its own angles.
    fn slot_of(&self, q: &[f64; 7]) -> usize {
        let theta = self.geometry().theta(q);
        let elbow = self.geometry().links.elbow_angle(theta[3]).sin() < 0.0;
        4 * usize::from(theta[1].sin() < 0.0)
            + 2 * usize::from(elbow)
            + usize::from(theta[4].cos() < 0.0)
    }
}

fn table(rows: [[f64; 4]; 7], flange: f64) -> Mdh<7> {
    let rows = rows.map(|[alpha, a, d, theta]| DhRow::new(alpha.to_radians(), a, d, theta));
    Mdh { base: Pose::identity(), rows, flange: crate::kinematics::pose::translation_z(flange) }
}

fn panda_table() -> Mdh<7> {
    table(
        [
            [0.0, 0.0, 0.333, 0.0],
            [-90.0, 0.0, 0.0, 0.0],
            [90.0, 0.0, 0.316, 0.0],
            [90.0, 0.0825, 0.0, 0.0],
            [-90.0, -0.0825, 0.384, 0.0],
            [90.0, 0.0, 0.0, 0.0],
            [90.0, 0.088, 0.0, 0.0],
        ],
        0.107,
    )
}

fn panda() -> Arm {
    Arm::new("Panda", &panda_table())
}

/// KUKA LBR iiwa 7 R800: axes 5, 6 and 7 meet too.
fn iiwa() -> Arm {
    let rows = [
        [0.0, 0.0, 0.34, 0.0],
        [-90.0, 0.0, 0.0, 0.0],
        [90.0, 0.0, 0.4, 0.0],
        [90.0, 0.0, 0.0, 0.0],
        [-90.0, 0.0, 0.4, 0.0],
        [-90.0, 0.0, 0.0, 0.0],
        [90.0, 0.0, 0.126, 0.0],
    ];
    Arm::new("iiwa", &table(rows, 0.0))
}

/// A long upper arm, so that the shoulder can come onto axis 6, joint 7 at an angle, no two lengths equal.
fn oblique() -> Arm {
    let rows = [
        [0.0, 0.0, 0.3, 0.2],
        [90.0, 0.0, 0.0, 0.3],
        [-90.0, 0.0, -0.45, -0.4],
        [90.0, -0.06, 0.0, 0.5],
        [90.0, 0.04, 0.35, -0.1],
        [-90.0, 0.0, 0.05, 0.7],
        [70.0, 0.03, 0.12, 0.6],
    ];
    Arm::new("oblique", &table(rows, 0.1))
}

/// Offsets, and upper arm as long as forearm: the shoulder can come to where axes 5 and 6 meet.
fn onto_itself() -> Arm {
    let rows = [
        [0.0, 0.0, 0.3, 0.0],
        [-90.0, 0.0, 0.0, 0.0],
        [90.0, 0.0, 0.4, 0.0],
        [90.0, 0.05, 0.0, 0.0],
        [-90.0, -0.05, 0.4, 0.0],
        [90.0, 0.0, 0.0, 0.0],
        [90.0, 0.08, 0.0, 0.0],
    ];
    Arm::new("onto itself", &table(rows, 0.1))
}

fn arms() -> [Arm; 4] {
    [panda(), iiwa(), oblique(), onto_itself()]
}

fn poses(default: u32) -> u32 {
    std::env::var("IRBKIN_POSES").ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// A small generator, so that a run gives the same poses everywhere (xorshift64*).
struct Rng(u64);

impl Rng {
    fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        #[expect(clippy::cast_precision_loss, reason = "53 bits")]
        let mantissa = (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64;
        low + (high - low) * mantissa / 2.0_f64.powi(53)
    }

    fn inside(&mut self, limits: &[[f64; 2]; 7]) -> [f64; 7] {
        limits.map(|[low, high]| self.between(low, high))
    }

    fn anywhere(&mut self) -> [f64; 7] {
        self.inside(&[[-PI, PI]; 7])
    }

    fn sign(&mut self) -> f64 {
        if self.between(-1.0, 1.0) < 0.0 { -1.0 } else { 1.0 }
    }

    fn pose(&mut self) -> Pose {
        let mut angle = || self.between(-PI, PI);
        crate::kinematics::pose::pose_from_euler_zyx(
            [angle() / 4.0, angle() / 4.0, angle() / 4.0],
            [angle(), angle(), angle()],
        )
        .unwrap()
    }
}

/// The wrist and the elbow where they are about as far from singular as still merges: rounding decides.
fn edge_of_merging(arm: &Arm, q: &[f64; 7]) -> Status {
    let theta = arm.geometry().theta(q);
    let links = arm.geometry().links;
    let (across, aside) = (links.elbow_at(theta[3]).across.abs(), arm.geometry().aside(q).abs());
    let rho = aside.hypot(links.elbow_at(theta[3]).along);
    let ratio = aside * aside / (2.0 * links.position_rounding() * across.min(rho));
    let mut edge = Status::empty();
    edge.set(Status::WRIST, (0.1..10.0).contains(&ratio));
    edge.set(Status::ELBOW, (1e-8..1e-6).contains(&arm.geometry().singular_distances(q).elbow));
    edge
}

/// Largest difference of two joint vectors, full turns not counted [rad].
fn apart(a: &[f64; 7], b: &[f64; 7]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b - TAU * ((a - b) / TAU).round()).abs()).fold(0.0, f64::max)
}

/// How far apart the two solutions are that are nearest to one another.
fn nearest_pair(branches: &Branches<7>) -> f64 {
    let found: Vec<_> = branches.q.iter().flatten().collect();
    let mut least = f64::INFINITY;
    for (i, a) in found.iter().enumerate() {
        for b in &found[..i] {
            least = least.min(apart(a, b));
        }
    }
    least
}

#[test]
fn the_slots_of_a_panda_are_told_by_its_own_joints() {
    let arm = panda();
    let mut rng = Rng::new(1);
    for _ in 0..2000 {
        let q = rng.inside(&PANDA_LIMITS);
        let slot = 4 * usize::from(q[1] < 0.0)
            + 2 * usize::from(q[3] > -0.467_178_6)
            + usize::from(q[4].abs() > FRAC_PI_2);
        assert_eq!(arm.slot_of(&q), slot, "{q:?}");
    }
    assert_eq!(arm.slot_of(&[0.0, 0.1, 0.0, -1.5, 0.0, 1.5, 0.0]), 0);
}

#[test]
fn the_determinant_is_the_product_of_its_factors() {
    let mut rng = Rng::new(2);
    for arm in arms() {
        for _ in 0..200 {
            let q = rng.anywhere();
            let jacobian = arm.chain.jacobian(&q, crate::kinematics::JacobianFrame::Base);
            let numeric = jacobian.fixed_columns::<6>(0).into_owned().determinant();
            let closed = arm.geometry().jacobian_determinant(&q);
            assert!((numeric - closed).abs() < 1e-14, "{}: {q:?} {numeric} {closed}", arm.name);
        }
    }
}
