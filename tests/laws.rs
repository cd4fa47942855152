//! Laws of the kinematics that hold for every structure, on its subjects and on random arms.
//!
//! Laws of one structure alone are in the folder `laws`.

mod near_singularities;
mod of_robots;
mod of_tables;
mod profile;
// nalgebra has matrices of any size with std alone.
mod singular_values;
mod spherical_shoulder_alone;
mod spherical_wrist_alone;
mod three_parallel_alone;

use std::cell::Cell;
use std::f64::consts::PI;

use irbkin::{
    Definition, JacobianFrame, Joints, Mdh, Pose, PoseDifference, Reach, Robot, Sdh, Status, pose,
};
use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;
use proptest::sample::Index;
use proptest::test_runner::TestRunner;

use crate::common::{apart, central_difference, difference_bound, divisor, enough, poses, profile};
use crate::structures::three_parallel::arm::turn;
use crate::structures::{Structure, Subject};

crate::structures::on_every_structure!(
    all_branches_are_found,
    every_solution_closes,
    slots_are_those_of_the_joints,
    both_wrists_of_an_arm_are_flips,
    slots_are_stable_along_a_path,
    jacobian_matches_central_differences,
    the_tool_jacobian_is_the_rotated_base_jacobian,
    the_determinant_is_the_product_of_its_factors,
    a_table_may_have_its_frames_anywhere,
    both_conventions_describe_the_same_arm,
    base_and_tool_move_the_pose_and_not_the_joints,
    link_frames_end_at_the_tool,
    turns_are_solutions_inside_the_limits,
    any_pose_has_an_answer_or_a_shortfall,
    an_invalid_pose_is_refused,
);

crate::structures::on_structures_of_ordinals!(
    all_branches_are_found,
    every_solution_closes,
    jacobian_matches_central_differences,
    the_tool_jacobian_is_the_rotated_base_jacobian,
    the_determinant_is_the_product_of_its_factors,
    both_conventions_describe_the_same_arm,
    base_and_tool_move_the_pose_and_not_the_joints,
    link_frames_end_at_the_tool,
    turns_are_solutions_inside_the_limits,
    any_pose_has_an_answer_or_a_shortfall,
    an_invalid_pose_is_refused,
);

/// An arm, a joint vector and two poses.
#[derive(Clone, Debug)]
struct Case<const N: usize> {
    arm: Subject<N>,
    q: [f64; N],
    velocity: [f64; N],
    ends: [Pose; 2],
    bits: u32,
}

type Law<const N: usize> = fn(&Case<N>, &Counts) -> Result<(), TestCaseError>;

/// What a law compared, and what it left out: both are asserted.
#[derive(Debug, Default)]
struct Counts {
    compared: Cell<usize>,
    left_out: Cell<usize>,
}

impl Counts {
    /// Counts a comparison that is made or left out; returns which.
    fn is_compared(&self, compared: bool) -> bool {
        let count = if compared { &self.compared } else { &self.left_out };
        count.set(count.get() + 1);
        compared
    }
}

/// Runs a law on the subjects of a structure and on random arms.
fn hold<const N: usize>(structure: &Structure<N>, law: Law<N>) -> Counts {
    let subjects = structure.subjects.clone();
    let listed = any::<Index>().prop_map(move |index| index.get(&subjects).clone());
    let arms = prop_oneof![1 => listed, 3 => structure.random.clone()];
    let vectors = (prop::array::uniform7(-PI..PI), prop::array::uniform7(-1.0..1.0));
    let cases = (arms, vectors, (poses(2.0), poses(1.0)), any::<u32>()).prop_map(
        |(arm, (q, velocity), (base, tool), bits)| Case {
            arm,
            q: std::array::from_fn(|i| q[i]),
            velocity: std::array::from_fn(|i| velocity[i]),
            ends: [base, tool],
            bits,
        },
    );
    let counts = Counts::default();
    let outcome = TestRunner::new(profile()).run(&cases, |case| law(&case, &counts));
    assert!(outcome.is_ok(), "{}: {}", structure.name, outcome.unwrap_err());
    println!("{}: {counts:?}", structure.name);
    counts
}

/// Asserts that a law compared at least this many times.
fn assert_compared(counts: &Counts, least: usize) {
    let least = least / divisor();
    assert!(counts.compared.get() >= least, "{counts:?}, at least {least} comparisons are wanted");
}

fn all_branches_are_found<const N: usize>(structure: &Structure<N>) {
    let counts = hold(structure, |Case { arm, q, .. }, counts| {
        if !counts.is_compared(arm.is_regular(q)) {
            return Ok(());
        }
        let solutions = arm.ik(&arm.robot.fk(q), q);
        let nearest = solutions.iter().map(|s| apart(&s.q, q)).fold(f64::INFINITY, f64::min);
        let bound = arm.joint_bound(q);
        prop_assert!(nearest <= bound, "off by {nearest:e}, bound {bound:e}");
        Ok(())
    });
    assert_compared(&counts, 1000);
}

fn every_solution_closes<const N: usize>(structure: &Structure<N>) {
    hold(structure, |Case { arm, q, .. }, _| {
        let pose = arm.robot.fk(q);
        let solutions = arm.ik(&pose, q);
        prop_assert!(!solutions.is_empty());
        let [position, rotation] = arm.closure();
        for solution in &solutions {
            let residual = arm.robot.residual(&solution.q, &pose);
            prop_assert!(residual.position <= position, "{residual:?}");
            prop_assert!(residual.rotation <= rotation, "{residual:?}");
        }
        Ok(())
    });
}

fn slots_are_those_of_the_joints<const N: usize>(structure: &Structure<N>) {
    let counts = hold(structure, |Case { arm, q, .. }, counts| {
        for solution in &arm.ik(&arm.robot.fk(q), q) {
            if counts.is_compared(arm.arm.has_slots() && arm.is_regular(&solution.q)) {
                prop_assert_eq!(solution.slot.index(), arm.slot(&solution.q));
            }
        }
        Ok(())
    });
    assert_compared(&counts, 4000);
}

fn both_wrists_of_an_arm_are_flips<const N: usize>(structure: &Structure<N>) {
    let counts = hold(structure, |Case { arm, q, .. }, counts| {
        let solutions = arm.ik(&arm.robot.fk(q), q);
        for slot in [0, 2, 4, 6] {
            let both = solutions.slot(slot).zip(solutions.slot(slot + 1));
            counts.is_compared(both.is_some());
            if let Some((straight, flipped)) = both {
                let flip = arm.arm.wrist_flip([straight, flipped]);
                prop_assert!(flip.is_ok(), "{}", flip.unwrap_err());
            }
        }
        Ok(())
    });
    assert_compared(&counts, 2000);
}

fn slots_are_stable_along_a_path<const N: usize>(structure: &Structure<N>) {
    const STEP: f64 = 0.02;
    let counts = hold(structure, |Case { arm, q, velocity, .. }, counts| {
        let mut slots = Vec::new();
        for step in 0..200 {
            let ahead = std::array::from_fn(|i| q[i] + STEP * f64::from(step) * velocity[i]);
            if !arm.is_regular(&ahead) {
                break;
            }
            let solutions = arm.ik(&arm.robot.fk(&ahead), &ahead);
            let bound = arm.joint_bound(&ahead);
            let own = solutions.iter().find(|solution| apart(&solution.q, &ahead) <= bound);
            slots.push(own.map(|solution| solution.slot));
        }
        if counts.is_compared(slots.len() > 10) {
            let is_stable = slots.iter().all(|slot| slot.is_some() && *slot == slots[0]);
            prop_assert!(is_stable, "{slots:?}");
        }
        Ok(())
    });
    assert_compared(&counts, 500);
}

fn jacobian_matches_central_differences<const N: usize>(structure: &Structure<N>) {
    hold(structure, |Case { arm, q, ends: [_, tool], .. }, _| {
        let arm = arm.clone().with_robot(|robot| robot.with_tool(tool).unwrap());
        let jacobian = arm.robot.jacobian(q, JacobianFrame::Base);
        let bound = difference_bound(arm.reach());
        for joint in 0..N {
            let difference = central_difference(&arm.robot, q, joint);
            for (row, wanted) in difference.into_iter().enumerate() {
                prop_assert!((jacobian[(row, joint)] - wanted).abs() < bound);
            }
        }
        Ok(())
    });
}

fn the_tool_jacobian_is_the_rotated_base_jacobian<const N: usize>(structure: &Structure<N>) {
    hold(structure, |Case { arm, q, ends: [_, tool], .. }, _| {
        let robot = arm.robot.clone().with_tool(tool).unwrap();
        let rotation = robot.fk(q).rotation;
        let [base, tool] =
            [JacobianFrame::Base, JacobianFrame::Tool].map(|frame| robot.jacobian(q, frame));
        let bound = 1e-14 * (10.0 + arm.reach());
        for joint in 0..N {
            for half in [0, 3] {
                let turned = rotation.inverse() * base.fixed_view::<3, 1>(half, joint);
                prop_assert!((turned - tool.fixed_view::<3, 1>(half, joint)).norm() < bound);
            }
        }
        Ok(())
    });
}

fn the_determinant_is_the_product_of_its_factors<const N: usize>(structure: &Structure<N>) {
    hold(structure, |Case { arm, q, ends: [_, tool], .. }, _| {
        let arm = arm.clone().with_robot(|robot| robot.with_tool(tool).unwrap());
        let jacobian = arm.robot.jacobian(q, JacobianFrame::Base);
        let numeric = jacobian.fixed_columns::<6>(0).into_owned().determinant();
        let closed = arm.arm.determinant(&arm.robot, q);
        // An LU of six columns, each no longer than the reach with the tool.
        let scale = (1.0 + arm.reach()).powi(3);
        prop_assert!((numeric - closed).abs() < 1e-14 * scale, "{numeric} against {closed}");
        if N == 6 {
            let manipulability = arm.robot.singularity(q).manipulability;
            prop_assert!((manipulability - closed.abs()).abs() < 1e-13 * scale);
        }
        Ok(())
    });
}

/// The same arm by a table with the x axes of some frames flipped, and by a standard one.
fn a_table_may_have_its_frames_anywhere<const N: usize>(structure: &Structure<N>)
where
    Robot<N>: Joints<N>,
{
    let counts = hold(structure, |Case { arm, q, bits, .. }, counts| {
        let mdh = arm.robot.mdh().clone();
        let table = with_x_flipped(mdh.clone(), *bits);
        let pose = arm.robot.fk(q);
        let bound = 1e-14 * (1.0 + arm.reach());
        let standard = Robot::from_sdh(Sdh::from(table.clone())).unwrap();
        for robot in [Robot::from_mdh(mdh).unwrap(), Robot::from_mdh(table).unwrap(), standard] {
            prop_assert!(PoseDifference::between(&pose, &robot.fk(q)).largest() < bound);
            let other = arm.clone().with_robot(|_| robot);
            let (ours, theirs) = (arm.ik(&pose, q), other.ik(&pose, q));
            for solution in &theirs {
                let residual = other.robot.residual(&solution.q, &pose);
                prop_assert!(residual.position <= arm.closure()[0], "{residual:?}");
                prop_assert!(residual.rotation <= arm.closure()[1], "{residual:?}");
            }
            if counts.is_compared(ours.iter().all(|s| arm.is_regular(&s.q))) {
                prop_assert_eq!(ours.len(), theirs.len());
            }
            for ours in ours.iter().filter(|s| arm.is_regular(&s.q)) {
                let off = theirs.iter().map(|s| apart(&s.q, &ours.q)).fold(f64::INFINITY, f64::min);
                prop_assert!(off <= 2.0 * arm.joint_bound(&ours.q), "off by {off:e}");
            }
        }
        Ok(())
    });
    assert_compared(&counts, 1000);
}

/// `Rz(pi) Rx(alpha) Tx(a) = Rx(-alpha) Tx(-a) Rz(pi)`.
fn with_x_flipped<const N: usize>(mut mdh: Mdh<N>, over: u32) -> Mdh<N> {
    let mut turned = false;
    for (i, row) in mdh.rows.iter_mut().enumerate() {
        if turned {
            (row.alpha, row.a, row.theta) = (-row.alpha, -row.a, row.theta - PI);
        }
        turned = over >> i & 1 == 1;
        row.theta += if turned { PI } else { 0.0 };
    }
    if turned {
        mdh.flange = turn(Matrix3::from_diagonal(&Vector3::new(-1.0, -1.0, 1.0))) * mdh.flange;
    }
    mdh
}

fn both_conventions_describe_the_same_arm<const N: usize>(structure: &Structure<N>)
where
    Robot<N>: Joints<N>,
{
    hold(structure, |Case { arm, q, .. }, _| {
        let standard = Sdh::from(arm.robot.mdh().clone());
        let back = Robot::serial_chain(Mdh::from(standard)).unwrap();
        let off = PoseDifference::between(&arm.robot.fk(q), &back.fk(q)).largest();
        prop_assert!(off < 1e-14 * (1.0 + arm.reach()));
        Ok(())
    });
}

fn base_and_tool_move_the_pose_and_not_the_joints<const N: usize>(structure: &Structure<N>) {
    let counts = hold(structure, |Case { arm, q, ends: [base, tool], .. }, counts| {
        if !counts.is_compared(arm.is_regular(q)) {
            return Ok(());
        }
        let robot = arm.robot.clone().with_base(base).unwrap().with_tool(tool).unwrap();
        let moved = arm.clone().with_robot(|_| robot);
        let (pose, flange) = (moved.robot.fk(q), arm.robot.fk(q));
        let off = PoseDifference::between(&pose, &(base * flange * tool)).largest();
        prop_assert!(off < 1e-14 * (1.0 + moved.reach()));
        let (ours, theirs) = (moved.ik(&pose, q), arm.ik(&flange, q));
        let is_regular = |s: &&irbkin::Solution<N>| arm.is_regular(&s.q);
        if ours.iter().all(|s| is_regular(&s)) {
            prop_assert_eq!(ours.len(), theirs.len());
        }
        for ours in ours.iter().filter(is_regular) {
            let is_same = |s: &&irbkin::Solution<N>| arm.has_ordinals() || s.slot == ours.slot;
            // Rounded where base and tool are applied to the pose, again where they are removed.
            let off = theirs.iter().filter(is_same).map(|s| apart(&ours.q, &s.q));
            let off = off.fold(f64::INFINITY, f64::min);
            prop_assert!(off <= 3.0 * moved.joint_bound(&ours.q), "{off:e}");
        }
        Ok(())
    });
    assert_compared(&counts, 1000);
}

fn link_frames_end_at_the_tool<const N: usize>(structure: &Structure<N>) {
    hold(structure, |Case { arm, q, .. }, _| {
        let (frames, tool) = arm.robot.link_frames(q);
        prop_assert_eq!(tool, arm.robot.fk(q));
        let flange = frames[N - 1] * arm.robot.mdh().flange;
        let off = PoseDifference::between(&flange, &tool).largest();
        // The flange of a spherical wrist is a quarter turn, which is exact.
        let is_exact = matches!(arm.robot.definition(), Definition::Opw(_));
        let bound = if is_exact { 0.0 } else { 4.0 * f64::EPSILON * (1.0 + arm.reach()) };
        prop_assert!(off <= bound, "{off:e}");
        Ok(())
    });
}

fn turns_are_solutions_inside_the_limits<const N: usize>(structure: &Structure<N>) {
    let counts = hold(structure, |Case { arm, q, .. }, counts| {
        let is_limited = arm.robot.limits().to_array().as_flattened().iter().all(|x| x.is_finite());
        if !counts.is_compared(is_limited) {
            return Ok(());
        }
        let solutions = arm.ik(&arm.robot.fk(q), q);
        let turns: Vec<_> = solutions.turns().collect();
        prop_assert_eq!(u32::try_from(turns.len()).map(f64::from), Ok(solutions.turn_total()));
        for turn in &turns {
            prop_assert!(arm.robot.limits().contains(&turn.q));
            let [position, rotation] = arm.closure();
            let residual = arm.robot.residual(&turn.q, solutions.pose());
            prop_assert!(residual.largest() < position.min(rotation).max(1e-14));
        }
        let nearest = solutions.nearest(q, &[1.0; N]);
        let cost =
            |s: &irbkin::Solution<N>| s.q.iter().zip(q).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
        let least = turns.iter().map(cost).fold(f64::INFINITY, f64::min);
        let found = nearest.map_or(f64::INFINITY, |s| cost(&s));
        // A sum of at most seven squares is rounded 14 times: two may differ in that alone.
        let rounding = 14.0 * f64::EPSILON * least;
        prop_assert!(found == least || found - least <= rounding, "{found:e} {least:e}");
        Ok(())
    });
    assert_compared(&counts, 100);
}

/// Half of the poses are drawn near the arm, so that both cases are frequent.
fn any_pose_has_an_answer_or_a_shortfall<const N: usize>(structure: &Structure<N>) {
    let counts = hold(structure, |Case { arm, q, ends: [place, _], bits, .. }, counts| {
        let mut pose = arm.robot.fk(q);
        if bits & 1 == 1 {
            pose.rotation = place.rotation;
        }
        if bits & 2 == 2 {
            // Within 2 m along each axis; here within 1.2 of the reach.
            pose.translation.vector = place.translation.vector * (0.6 * arm.reach());
        }
        let solutions = arm.ik(&pose, q);
        let reach = solutions.reach();
        let is_short = reach.shortfall() > 0.0 || arm.has_ordinals() && reach == Reach::NoRoots;
        prop_assert_eq!(solutions.is_empty(), is_short);
        let found = solutions.status().iter().filter(|s| s.contains(Status::FOUND)).count();
        prop_assert_eq!(found, solutions.len());
        counts.is_compared(!solutions.is_empty());
        Ok(())
    });
    assert_compared(&counts, 500);
    assert!(enough(counts.left_out.get() > 400 / divisor()), "few are out of reach: {counts:?}");
}

fn an_invalid_pose_is_refused<const N: usize>(structure: &Structure<N>) {
    hold(structure, |Case { arm, q, bits, .. }, _| {
        let pose = arm.robot.fk(q);
        let row = bits % 3;
        let mut infinite = pose;
        infinite.translation.vector[row as usize] =
            [f64::NAN, f64::INFINITY][(bits >> 3) as usize % 2];
        let refused = (arm.calls.ik)(&arm.robot, &infinite, q).unwrap_err().to_string();
        prop_assert!(refused.contains("must be finite"), "{refused}");
        let mut mirrored = *pose.rotation.matrix();
        mirrored.column_mut(row as usize).neg_mut();
        let mut rows = pose::to_rows(&pose);
        for i in 0..3 {
            for j in 0..3 {
                rows[4 * i + j] = mirrored[(i, j)];
            }
        }
        let refused = irbkin::pose::from_rows(&rows).unwrap_err().to_string();
        prop_assert!(refused.contains("mirrors"), "{refused}");
        Ok(())
    });
}
