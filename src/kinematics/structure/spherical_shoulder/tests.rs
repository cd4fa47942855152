//! A solve that takes what the pose leaves undetermined from a joint vector, which no public
//! function offers. The laws of the structure are in tests/.

use std::format;
use std::string::String;
use std::vec::Vec;

use super::*;
use crate::kinematics::answer::status::Status;
use crate::kinematics::chain::Chain;
use crate::kinematics::pose::PoseDifference;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::branches::Branches;
use crate::kinematics::structure::free_choice::{FreeChoice, SeedPolicy};
use crate::kinematics::structure::known::solver_of;
use crate::kinematics::structure::self_motions::SelfMotions as _;
use crate::kinematics::structure::solver::Solver;
use crate::rng::Rng;
use crate::structures::place::{At, Place};
use crate::structures::spherical_shoulder::arm::ShoulderArm;

const SLOTS: usize = 8;

const OFF: [f64; 8] = [0.0, 1e-12, 1e-9, 2e-9, 1e-7, 1e-6, 1e-5, 1e-4];

/// Largest change of a given joint that a solve must return unchanged.
const KEPT: f64 = 1e-12;

/// An arm with its chain and its solver.
struct Solved {
    name: &'static str,
    arm: ShoulderArm,
    chain: Chain<7>,
    solver: Solver<SphericalShoulder, 7, 8>,
}

impl Solved {
    fn new(name: &'static str, arm: ShoulderArm) -> Self {
        let (chain, solver) = solver_of(&arm.mdh()).unwrap();
        Self { name, arm, chain, solver }
    }

    fn solve(&self, pose: &Pose, free: &FreeChoice<7>) -> Branches<7> {
        let t_shoulder_seven = self.solver.end_frames.wrist_pose(pose);
        self.solver.structure.solve(&t_shoulder_seven, free.q[6], free)
    }

    /// The largest residual of all solutions.
    fn residual(&self, branches: &Branches<7>, pose: &Pose) -> f64 {
        let of = |q: &[f64; 7]| PoseDifference::between(&self.chain.fk(q), pose).largest();
        // NaN stays the worst.
        branches.q.iter().flatten().map(of).fold(0.0, |a, b| if b <= a { a } else { b })
    }
}

fn arms() -> [Solved; 4] {
    [
        Solved::new("Panda", ShoulderArm::panda()),
        Solved::new("iiwa", ShoulderArm::iiwa()),
        Solved::new("oblique", ShoulderArm::oblique()),
        Solved::new("onto itself", ShoulderArm::onto_itself()),
    ]
}

fn poses() -> usize {
    std::env::var("IRBKIN_POSES").ok().and_then(|text| text.parse().ok()).unwrap_or(100)
}

/// Poses at and near every singularity, and every two and three of them with shoulder or wrist.
fn places() -> Vec<(Place, usize)> {
    let pairs = || OFF.iter().flat_map(|a| OFF.map(|b| (*a, b)));
    let (one_of, several_of) = (poses(), poses().div_ceil(4));
    let mut places = Vec::new();
    for one in [At::Shoulder, At::Stretched, At::Folded, At::Wrist, At::Forearm, At::Hand] {
        places.extend(OFF.map(|off| (Place::of(one, off), one_of)));
        for two in [At::Shoulder, At::Wrist].into_iter().filter(|two| *two != one) {
            places.extend(pairs().map(|(a, b)| (Place(vec_of([(one, a), (two, b)])), several_of)));
        }
        if !matches!(one, At::Shoulder | At::Wrist) {
            places.extend(pairs().map(|(a, b)| {
                let three = [(one, a), (At::Wrist, b), (At::Shoulder, a)];
                (Place(vec_of(three)), several_of)
            }));
        }
    }
    places
}

fn vec_of<const M: usize>(parts: [(At, f64); M]) -> Vec<(At, f64)> {
    parts.into_iter().collect()
}

#[test]
fn a_seed_and_a_path_keep_their_branch_at_and_near_singularities() {
    let mut rng = Rng::new(30);
    for arm in arms() {
        let (mut judged, mut amiss) = (0, Vec::new());
        for (place, count) in places() {
            for _ in 0..count {
                let Some(theta) = arm.arm.at(&place, &mut rng) else { break };
                judged += 1;
                amiss.extend(judge(&arm, &theta).map(|what| format!("{place:?}: {what}")));
            }
        }
        std::println!("{:12} {judged:7} poses, {} amiss", arm.name, amiss.len());
        assert!(judged > 100 * poses(), "{}: {judged}", arm.name);
        assert!(amiss.is_empty(), "{}: {} of {judged}, {}", arm.name, amiss.len(), amiss[0]);
    }
}

/// The first failed check of the solves that are given the joint vector that made the pose.
fn judge(arm: &Solved, theta: &[f64; 7]) -> Option<String> {
    let q = arm.arm.q(*theta);
    let pose = arm.chain.fk(&q);
    let bounds = arm.arm.bounds(theta, KEPT);
    for policy in [SeedPolicy::Seed, SeedPolicy::Path] {
        let kept = arm.solve(&pose, &FreeChoice { q, policy });
        let is_found =
            |found: &[f64; 7]| ShoulderArm::is_branch(&arm.arm.theta(found), theta, &bounds);
        let found = kept.q.iter().flatten().any(is_found);
        // A path is extrapolated as far as rounding leaves the upper arm undetermined.
        let allowed = 4e-12 + if policy == SeedPolicy::Path { bounds[2] } else { 0.0 };
        let residual = arm.residual(&reached(arm, theta, &kept), &pose);
        if !found || residual > allowed || residual.is_nan() {
            return Some(format!("{policy:?} {q:?} {bounds:?} {residual:e}: {kept:?}"));
        }
    }
    None
}

/// The branches, without the other elbow if its wrist is at its edge: that one may be up to
/// a nanometer beyond reach.
fn reached(arm: &Solved, theta: &[f64; 7], branches: &Branches<7>) -> Branches<7> {
    let (own, mut reached) = (arm.arm.slot(theta) & 2, *branches);
    for (slot, flags) in branches.flags.iter().enumerate() {
        if slot & 2 != own && flags.contains(Status::WRIST) && !flags.contains(Status::ELBOW) {
            reached.q[slot] = None;
        }
    }
    reached
}

#[test]
fn a_free_joint_takes_the_given_angle() {
    let mut rng = Rng::new(33);
    let mut moved = 0;
    for arm in arms() {
        for at in [At::Shoulder, At::Forearm, At::Hand] {
            for _ in 0..poses() {
                let Some(theta) = arm.arm.at(&Place::of(at, 0.0), &mut rng) else { break };
                let rest = FreeChoice::rest([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, arm.arm.q(theta)[6]]);
                let pose = arm.chain.fk(&arm.arm.q(theta));
                let branches = arm.solve(&pose, &rest);
                for slot in 0..SLOTS {
                    let (Some(q), Some(free)) = (branches.q[slot], branches.free[slot]) else {
                        continue;
                    };
                    moved += 1;
                    assert!(
                        self_motion_closes(&arm, &pose, q, slot, free.joint()),
                        "{}: {q:?}",
                        arm.name
                    );
                }
            }
        }
    }
    assert!(moved > 10 * poses(), "{moved}");
}

#[test]
fn axes_1_and_3_are_in_line_at_one_of_the_singular_angles_of_joint_7() {
    let mut rng = Rng::new(34);
    let mut asked = 0;
    for arm in arms() {
        for _ in 0..10 * poses() {
            let Some(theta) = arm.arm.at(&Place::of(At::Shoulder, 0.0), &mut rng) else { break };
            let q = arm.arm.q(theta);
            let t_shoulder_seven = arm.solver.end_frames.wrist_pose(&arm.chain.fk(&q));
            let angles = arm.solver.structure.singular_angles_of_joint_7(&t_shoulder_seven);
            let off = angles.into_iter().flatten().map(|angle| wrap(angle - q[6]).abs());
            let off = off.fold(f64::INFINITY, f64::min);
            assert!(off < IN_LINE, "{}: {off:e} {q:?}", arm.name);
            asked += 1;
        }
    }
    assert_eq!(asked, 40 * poses());
}

/// Precision of an angle at which a quartic may have a double zero [rad].
const IN_LINE: f64 = 1e-7;

#[test]
fn an_answer_that_represents_a_surface_is_not_certified() {
    let mut rng = Rng::new(35);
    for arm in &arms()[..2] {
        for (straight, is_surface) in [(&[1][..], false), (&[3], false), (&[1, 3], true)] {
            for _ in 0..poses() {
                // Axes 1, 3 and 5 are in one line if joints 2 and 4 are straight.
                let mut theta: [f64; 7] = rng.angles();
                for joint in straight {
                    theta[*joint] = 0.0;
                }
                let q = arm.arm.q(theta);
                let rest = FreeChoice::rest([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, q[6]]);
                let branches = arm.solve(&arm.chain.fk(&q), &rest);
                assert!(branches.q.iter().any(Option::is_some));
                assert_eq!(branches.is_certified, !is_surface, "{}: {q:?}", arm.name);
            }
        }
    }
}

fn self_motion_closes(
    arm: &Solved,
    pose: &Pose,
    found: [f64; 7],
    slot: usize,
    joint: usize,
) -> bool {
    let mut q = found;
    q[joint - 1] = 0.7;
    let members = arm.solve(pose, &FreeChoice::forced(q, joint, false));
    // The shoulder, or the wrist and with it the shoulder, may be kept in its other branch there.
    let bits = if joint == 1 { &[0, 4][..] } else { &[0, 1, 4, 5] };
    let moved = bits.iter().find_map(|bits| members.q[slot ^ bits]);
    moved.is_some_and(|q| {
        (q[joint - 1] - 0.7).abs() < 1e-15
            && PoseDifference::between(&arm.chain.fk(&q), pose).largest() < 4e-9
    })
}
