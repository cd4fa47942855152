//! One pose in lanes: its four branches of elbow and wrist side by side.

use super::block::BRANCHES;
use super::branch::branch;
use super::solver::{SevenSolver, hand_frame};
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::lanes::{
    Directions, FOUND_INSIDE, JointColumn, PlainSlots, half_turn,
};
use crate::kinematics::thresholds::MOST_ANGLE;
use crate::lanes::Kernel;

/// A pose to be solved, with the angle of joint 7.
pub(crate) struct Single<'a> {
    pub(crate) solver: &'a SevenSolver,
    pub(crate) pose: &'a Pose,
    pub(crate) q7: f64,
}

const ELBOW: [f64; BRANCHES] = [1.0, 1.0, -1.0, -1.0];
const WRIST: [f64; BRANCHES] = [1.0, -1.0, 1.0, -1.0];

impl Kernel for Single<'_> {
    /// Nothing where a branch is not plain, or none reaches: another way has to say more.
    type Answer = Option<PlainSlots<7>>;
    const WIDE: bool = true;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> Self::Answer {
        let Self { solver, pose, q7 } = self;
        let columns = *solver.columns.as_ref()?;
        if q7.is_nan() || q7.abs() > MOST_ANGLE {
            return None;
        }
        let seven = solver.surroundings.seen.of::<FUSED>(&Frame::of(pose));
        let hand = hand_frame::<FUSED>(&seven, solver.joint_7(), q7, &solver.hand);
        let constants = solver.constants;
        let (mut directions, mut status, mut plain) =
            (Directions::<6, BRANCHES>::NEW, [0; BRANCHES], [0; BRANCHES]);
        for lane in 0..BRANCHES {
            let branch = branch::<FUSED>(&constants, &hand, ELBOW[lane], WRIST[lane]);
            directions.set(0, lane, branch.theta_1);
            directions.set(1, lane, branch.theta_2);
            directions.set(2, lane, branch.theta_3);
            directions.set(3, lane, branch.theta_4);
            directions.set(4, lane, branch.theta_5);
            directions.set(5, lane, branch.theta_6);
            status[lane] = if branch.reached { FOUND_INSIDE } else { 0 };
            plain[lane] = u64::from(branch.plain);
        }
        if plain != [1; BRANCHES] || status == [0; BRANCHES] {
            return None;
        }
        directions.angles::<FUSED>();
        Some(settled(&columns, &directions.angle, status, q7))
    }
}

#[inline(always)]
fn settled(
    columns: &[JointColumn; 7],
    angle: &[[f64; BRANCHES]; 6],
    status: [u64; BRANCHES],
    q7: f64,
) -> PlainSlots<7> {
    let mut slots = PlainSlots::NEW;
    let given = columns[6].limited(q7);
    for lane in 0..BRANCHES {
        let flipped = lane + BRANCHES;
        [slots.status[lane], slots.status[flipped]] = [status[lane] & given; 2];
        slots.settle(lane, 0, angle[0][lane], columns[0]);
        slots.settle(lane, 1, angle[1][lane], columns[1]);
        slots.settle(lane, 2, angle[2][lane], columns[2]);
        slots.settle(flipped, 0, half_turn(angle[0][lane]), columns[0]);
        slots.settle(flipped, 1, -angle[1][lane], columns[1]);
        slots.settle(flipped, 2, half_turn(angle[2][lane]), columns[2]);
        for slot in [lane, flipped] {
            slots.settle(slot, 3, angle[3][lane], columns[3]);
            slots.settle(slot, 4, angle[4][lane], columns[4]);
            slots.settle(slot, 5, angle[5][lane], columns[5]);
            slots.q[6][slot] = q7;
        }
    }
    slots
}
