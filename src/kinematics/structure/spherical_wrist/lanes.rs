//! The arm in lanes: a block of poses side by side, and the four branches of one pose.

use super::branch::{Branch, Constants, branch};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::lanes::{
    AnswerRow, Block, BlockSlots, Columns, Directions, FOUND_INSIDE, JointColumn, LaneKernel,
    Poses, RegularPose, StatusRow, half_turn,
};
use crate::lanes::{Column, Flags, LANES, mul_add};

/// Slots of the structure.
const SLOTS: usize = 8;

/// Branches of the arm: two shoulders with two elbows each. Each has two wrists.
pub(super) const BRANCHES: usize = SLOTS / 2;

/// Columns of the directions of a block: one for each shoulder, then five for each branch.
const THETA_1: usize = 0;
const THETA_2: usize = THETA_1 + 2;
const THETA_23: usize = THETA_2 + BRANCHES;
const THETA_4: usize = THETA_23 + BRANCHES;
const THETA_5: usize = THETA_4 + BRANCHES;
const THETA_6: usize = THETA_5 + BRANCHES;
const DIRECTIONS: usize = THETA_6 + BRANCHES;

/// A column for each branch.
type Branches = [Column; BRANCHES];

/// A block of poses with its solutions.
pub(crate) struct WristBlock {
    /// Sines and cosines, of any length.
    directions: Directions<DIRECTIONS, LANES>,
    /// theta, later q, of the unflipped slots.
    q: [Branches; 6],
    /// theta, later q, of joints 4 to 6 with the wrist flipped.
    flipped: [Branches; 3],
    /// The status of the unflipped and of the flipped slots.
    status: [[Flags; BRANCHES]; 2],
    regular: Flags,
}

impl Block<Constants, 6, SLOTS> for WristBlock {
    type Slots = Self;

    const NEW: Self = Self {
        directions: Directions::NEW,
        q: [[[0.0; LANES]; BRANCHES]; 6],
        flipped: [[[0.0; LANES]; BRANCHES]; 3],
        status: [[[0; LANES]; BRANCHES]; 2],
        regular: [0; LANES],
    };

    #[inline(always)]
    fn solve<const FUSED: bool>(
        &mut self,
        kernel: &Constants,
        columns: &Columns<6>,
        wrists: &mut Poses,
        _: Column,
    ) -> Flags {
        self.regular = [1; LANES];
        if kernel.b == 0.0 {
            self.branches::<FUSED, false>(*kernel, wrists);
        } else {
            self.branches::<FUSED, true>(*kernel, wrists);
        }
        self.directions.angles::<FUSED>();
        self.wrap::<FUSED>(columns);
        self.regular
    }

    #[inline(always)]
    fn slots(&self) -> &Self {
        self
    }
}

impl BlockSlots<6, SLOTS> for WristBlock {
    #[inline(never)]
    #[expect(clippy::cast_possible_truncation, reason = "flags of a byte")]
    fn write(&self, q: &mut [AnswerRow<6, SLOTS>; LANES], status: &mut [StatusRow<SLOTS>; LANES]) {
        for slot in 0..SLOTS {
            let columns = self.columns_of(slot);
            for k in 0..3 {
                let (left, right) = (columns[2 * k], columns[2 * k + 1]);
                for lane in 0..LANES {
                    q[lane].as_flattened_mut().as_chunks_mut::<2>().0[3 * slot + k] =
                        [left[lane], right[lane]];
                }
            }
            for lane in 0..LANES {
                status[lane][slot] = self.status[slot % 2][slot / 2][lane] as u8;
            }
        }
    }

    #[inline(always)]
    fn angles(&self, slot: usize, joint: usize) -> Column {
        let (branch, flip) = (slot / 2, slot % 2);
        if flip == 0 || joint < 3 { self.q[joint][branch] } else { self.flipped[joint - 3][branch] }
    }

    #[inline(always)]
    fn status(&self, slot: usize) -> Flags {
        self.status[slot % 2][slot / 2]
    }
}

impl WristBlock {
    #[inline(always)]
    fn branches<const FUSED: bool, const LATERAL: bool>(&mut self, arm: Constants, wrists: &Poses) {
        for lane in 0..LANES {
            let frame = wrists.frame(lane);
            self.put(lane, 0, &branch::<FUSED, LATERAL>(&arm, &frame, 1.0, 1.0));
            self.put(lane, 1, &branch::<FUSED, LATERAL>(&arm, &frame, 1.0, -1.0));
            self.put(lane, 2, &branch::<FUSED, LATERAL>(&arm, &frame, -1.0, 1.0));
            self.put(lane, 3, &branch::<FUSED, LATERAL>(&arm, &frame, -1.0, -1.0));
        }
    }

    #[inline(always)]
    fn put(&mut self, lane: usize, number: usize, branch: &Branch) {
        let [theta_1, theta_2, theta_23, theta_4, theta_5, theta_6] = branch.theta;
        // The elbows of a shoulder share theta_1.
        self.directions.set(THETA_1 + number / 2, lane, theta_1);
        self.directions.set(THETA_2 + number, lane, theta_2);
        self.directions.set(THETA_23 + number, lane, theta_23);
        self.directions.set(THETA_4 + number, lane, theta_4);
        self.directions.set(THETA_5 + number, lane, theta_5);
        self.directions.set(THETA_6 + number, lane, theta_6);
        self.status[0][number][lane] = if branch.reached { FOUND_INSIDE } else { 0 };
        self.regular[lane] &= u64::from(branch.regular);
    }

    /// Joint angles of the slots, with both wrists (eq. 18 to 20).
    #[inline(always)]
    fn wrap<const FUSED: bool>(&mut self, columns: &Columns<6>) {
        let Columns { joints: columns, uncoupled, linkage, .. } = columns;
        let angle = &self.directions.angle;
        for number in 0..BRANCHES {
            let (theta_2, theta_23) = (&angle[THETA_2 + number], &angle[THETA_23 + number]);
            self.q[0][number] = angle[THETA_1 + number / 2];
            self.q[1][number] = *theta_2;
            for lane in 0..LANES {
                self.q[2][number][lane] =
                    mul_add::<FUSED>(-uncoupled, theta_2[lane], theta_23[lane]);
                self.flipped[0][number][lane] = half_turn(angle[THETA_4 + number][lane]);
                self.flipped[1][number][lane] = -angle[THETA_5 + number][lane];
                self.flipped[2][number][lane] = half_turn(angle[THETA_6 + number][lane]);
            }
            self.q[3][number] = angle[THETA_4 + number];
            self.q[4][number] = angle[THETA_5 + number];
            self.q[5][number] = angle[THETA_6 + number];
        }
        for joint in 0..3 {
            columns[joint]
                .wrap(self.q[joint].as_flattened_mut(), self.status[0].as_flattened_mut());
        }
        if let Some(linkage) = linkage {
            for number in 0..BRANCHES {
                for lane in 0..LANES {
                    let uncoupled_3 =
                        angle[THETA_23 + number][lane] - angle[THETA_2 + number][lane];
                    self.status[0][number][lane] &= linkage.left_of(uncoupled_3);
                }
            }
        }
        self.status[1] = self.status[0];
        for joint in 3..6 {
            columns[joint]
                .wrap(self.q[joint].as_flattened_mut(), self.status[0].as_flattened_mut());
            columns[joint].wrap(
                self.flipped[joint - 3].as_flattened_mut(),
                self.status[1].as_flattened_mut(),
            );
        }
    }

    #[inline(always)]
    fn columns_of(&self, slot: usize) -> [&Column; 6] {
        let (branch, flip) = (slot / 2, slot % 2);
        let (q, flipped) = (&self.q, &self.flipped);
        let wrist = if flip == 0 {
            [&q[3][branch], &q[4][branch], &q[5][branch]]
        } else {
            [&flipped[0][branch], &flipped[1][branch], &flipped[2][branch]]
        };
        [&q[0][branch], &q[1][branch], &q[2][branch], wrist[0], wrist[1], wrist[2]]
    }
}

impl LaneKernel<6, 8> for Constants {
    const DIFFERENCES: &'static [usize] = &[2];

    type Regular = WristSlots;
    type Block = WristBlock;

    fn for_path(&self) -> Option<Self> {
        Some(self.on_path())
    }

    #[inline(always)]
    fn solve_one<const FUSED: bool>(
        &self,
        columns: &Columns<6>,
        t_shoulder_wrist: &Frame,
        _: f64,
    ) -> Option<WristSlots> {
        let mut branches = if self.b == 0.0 {
            OneBranches::of::<FUSED, false>(self, t_shoulder_wrist)
        } else {
            OneBranches::of::<FUSED, true>(self, t_shoulder_wrist)
        }?;
        branches.directions.angles::<FUSED>();
        Some(branches.wrapped::<FUSED>(columns))
    }
}

/// Joint angles and status of the slots of a regular pose.
pub(crate) struct WristSlots {
    arm: [[f64; BRANCHES]; 3],
    /// The wrist angles, unflipped and flipped.
    wrist: [[[f64; BRANCHES]; 3]; 2],
    status: [[u64; BRANCHES]; 2],
}

impl RegularPose<6> for WristSlots {
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "flags of a byte")]
    fn slot(&self, slot: usize) -> Option<([f64; 6], u8)> {
        let (branch, flip) = (slot / 2, slot % 2);
        let (arm, wrist, status) = (&self.arm, &self.wrist[flip], self.status[flip][branch]);
        let q = [
            arm[0][branch],
            arm[1][branch],
            arm[2][branch],
            wrist[0][branch],
            wrist[1][branch],
            wrist[2][branch],
        ];
        (status != 0).then_some((q, status as u8))
    }
}

const SHOULDER: [f64; BRANCHES] = [1.0, 1.0, -1.0, -1.0];
const ELBOW: [f64; BRANCHES] = [1.0, -1.0, 1.0, -1.0];

/// The branches of a pose, one per lane.
struct OneBranches {
    directions: Directions<6, BRANCHES>,
    status: [u64; BRANCHES],
}

impl OneBranches {
    #[inline(always)]
    fn of<const FUSED: bool, const LATERAL: bool>(arm: &Constants, frame: &Frame) -> Option<Self> {
        let (arm, frame) = (*arm, *frame);
        let mut branches = Self { directions: Directions::NEW, status: [0; BRANCHES] };
        let mut regular = [0; BRANCHES];
        for lane in 0..BRANCHES {
            let branch = branch::<FUSED, LATERAL>(&arm, &frame, SHOULDER[lane], ELBOW[lane]);
            branches.directions.set_lane(lane, branch.theta);
            branches.status[lane] = if branch.reached { FOUND_INSIDE } else { 0 };
            regular[lane] = u64::from(branch.regular);
        }
        (regular == [1; BRANCHES] && branches.status != [0; BRANCHES]).then_some(branches)
    }

    /// Joint angles of the slots, with both wrists (eq. 18 to 20).
    #[inline(always)]
    fn wrapped<const FUSED: bool>(&self, columns: &Columns<6>) -> WristSlots {
        let Columns { joints: columns, uncoupled, linkage, .. } = *columns;
        let mut slots = WristSlots {
            arm: [[0.0; BRANCHES]; 3],
            wrist: [[[0.0; BRANCHES]; 3]; 2],
            status: [[0; BRANCHES]; 2],
        };
        for lane in 0..BRANCHES {
            let [theta_1, theta_2, theta_23, theta_4, theta_5, theta_6] =
                self.directions.angles_of(lane);
            let (q1, in_1) = columns[0].wrapped(theta_1);
            let (q2, in_2) = columns[1].wrapped(theta_2);
            let (q3, in_3) = columns[2].wrapped(mul_add::<FUSED>(-uncoupled, theta_2, theta_23));
            let arm = &mut slots.arm;
            [arm[0][lane], arm[1][lane], arm[2][lane]] = [q1, q2, q3];
            let reached = self.status[lane]
                & if in_1 & in_2 & in_3 { u64::MAX } else { JointColumn::OUTSIDE };
            let (q4, in_4) = columns[3].wrapped(theta_4);
            let (q5, in_5) = columns[4].wrapped(theta_5);
            let (q6, in_6) = columns[5].wrapped(theta_6);
            let [wrist, flipped] = &mut slots.wrist;
            [wrist[0][lane], wrist[1][lane], wrist[2][lane]] = [q4, q5, q6];
            slots.status[0][lane] =
                reached & if in_4 & in_5 & in_6 { u64::MAX } else { JointColumn::OUTSIDE };
            let (q4, in_4) = columns[3].wrapped(half_turn(theta_4));
            let (q5, in_5) = columns[4].wrapped(-theta_5);
            let (q6, in_6) = columns[5].wrapped(half_turn(theta_6));
            [flipped[0][lane], flipped[1][lane], flipped[2][lane]] = [q4, q5, q6];
            slots.status[1][lane] =
                reached & if in_4 & in_5 & in_6 { u64::MAX } else { JointColumn::OUTSIDE };
        }
        if let Some(linkage) = linkage {
            for lane in 0..BRANCHES {
                let [_, theta_2, theta_23, ..] = self.directions.angles_of(lane);
                let left = linkage.left_of(theta_23 - theta_2);
                slots.status[0][lane] &= left;
                slots.status[1][lane] &= left;
            }
        }
        slots
    }
}
