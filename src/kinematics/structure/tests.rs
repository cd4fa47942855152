//! Checks the contract with a structure that is as unlike the others as possible: sixteen slots
//! without names, and no kernel.

use core::f64::consts::TAU;
use std::vec::Vec;

use super::any::recognized;
use super::arm::{Arm as _, Rows};
use super::branches::Branches;
use super::free_choice::FreeChoice;
use super::joint_map::JointMap;
use super::lanes::NoKernel;
use super::solver::Solver;
use super::spherical_wrist::SphericalWrist;
use super::*;
use crate::kinematics::answer::solutions::Solutions;
use crate::kinematics::pose::pose_to_rows;
use crate::kinematics::robot::Robot;

/// The arm of an IRB 2600 with unnamed branches: its solutions are in the order of their angles.
#[derive(Clone, Debug, PartialEq)]
struct Ordinals(SphericalWrist);

impl Structure<6, 16> for Ordinals {
    const PATTERN: &'static Pattern = SphericalWrist::PATTERN;
    const SLOT_NAMES: Option<&'static [&'static str; 16]> = None;

    type Redundancy = ();
    type Kernel = NoKernel;

    fn measure(mdh: &mut Mdh<6>) -> Result<Self, UnknownStructure> {
        SphericalWrist::measure(mdh).map(Self)
    }

    fn joint_map(&self) -> &JointMap<6> {
        self.0.joint_map()
    }

    fn between(self, base: &Pose, tool: &Pose, coupled: bool) -> Self {
        Self(self.0.between(base, tool, coupled))
    }

    fn kernel(&self) -> Option<NoKernel> {
        None
    }

    fn solve(&self, pose: &Pose, (): (), free: &FreeChoice<6>) -> Branches<6, 16> {
        let named = self.0.solve(pose, (), free);
        let mut found: Vec<_> = named.q.iter().flatten().copied().collect();
        found.sort_by(|a, b| a.partial_cmp(b).unwrap());
        let mut branches = Branches::empty(named.reach);
        for (place, q) in branches.q.iter_mut().zip(found) {
            *place = Some(q);
        }
        branches
    }

    fn singular_distances(&self, q: &[f64; 6]) -> Option<SingularDistances> {
        self.0.singular_distances(q)
    }

    fn singularities(&self, q: &[f64; 6]) -> SingularityKind {
        self.0.singularities(q)
    }

    fn jacobian_determinant(&self, q: &[f64; 6]) -> f64 {
        self.0.jacobian_determinant(q)
    }

    fn slot(&self, _q: &[f64; 6]) -> Option<Slot> {
        None
    }
}

#[test]
fn the_contract_fits_a_structure_with_sixteen_ordinal_slots_and_no_kernel() {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
    let (chain, solver) = recognized::<Ordinals, 6, 16>(robot.mdh()).unwrap();
    let solver = Solver::new(solver.structure, &chain, robot.limits());
    assert_eq!(solver.slot_names(), None);
    let joints = [[0.3, -0.2, 0.4, 0.5, -0.6, 0.7], [-0.9, 0.5, -0.1, 1.5, 0.8, -2.0]];
    let poses = joints.map(|q| pose_to_rows(&chain.fk(&q)));
    let (mut q, mut status) = ([f64::NAN; 2 * 16 * 6], [0; 2 * 16]);
    let mut alone = Vec::new();
    for made in &joints {
        let pose = chain.fk(made);
        let mut solutions = Solutions::none(16, pose, *robot.limits());
        assert!(!solver.solve_in_lanes(&mut solutions, ()));
        solver.solve(&mut solutions, (), &FreeChoice::rest([0.0; 6])).unwrap();
        let named = robot.ik(&pose).unwrap();
        assert_eq!((solutions.len(), solutions.status().len()), (named.len(), 16));
        for (number, solution) in solutions.iter().enumerate() {
            assert_eq!((solution.slot.index(), solver.slot(&solution.q)), (number, None));
            let apart = |q: &[f64; 6]| {
                let turns = q.iter().zip(&solution.q).map(|(a, b)| (a - b) / TAU);
                turns.map(|part| TAU * (part - part.round()).abs()).fold(0.0, f64::max)
            };
            assert!(named.iter().any(|other| apart(&other.q) < 1e-12), "{solution:?}");
        }
        alone.push(solutions);
    }
    let rows = Rows { poses: &poses, redundancy: &[(); 2], q: &mut q, status: &mut status };
    solver.solve_rows(rows, &mut |row, q, status| {
        for solution in &alone[row] {
            q[solution.slot.index()] = solution.q;
            status[solution.slot.index()] = solution.status.bits();
        }
    });
    for (row, solutions) in alone.iter().enumerate() {
        let found = status[16 * row..16 * (row + 1)].iter().filter(|flags| **flags != 0).count();
        assert_eq!(found, solutions.len());
    }
}
