//! The arm in lanes: a block of poses side by side, and the eight slots of one pose.

use super::branch::{Branch, Constants, Facing, branch, facing};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::lanes::{
    Block, Columns, Directions, FOUND_INSIDE, LaneKernel, Poses, RegularSlots, SlotColumns,
    half_turn, where_found,
};
use crate::lanes::{Column, Flags, LANES, mul_add};

/// Slots of the structure.
pub(super) const SLOTS: usize = 8;

/// Columns of the directions of a block: four for each shoulder, then two for each slot.
const THETA_1: usize = 0;
const THETA_5: usize = THETA_1 + 2;
const THETA_6: usize = THETA_5 + 2;
const PHI: usize = THETA_6 + 2;
const THETA_2: usize = PHI + 2;
const THETA_23: usize = THETA_2 + SLOTS;
const DIRECTIONS: usize = THETA_23 + SLOTS;

/// A block of poses with its solutions.
pub(crate) struct ParallelBlock {
    directions: Directions<DIRECTIONS, LANES>,
    slots: SlotColumns<6, SLOTS>,
    regular: Flags,
}

impl Block<Constants, 6, SLOTS> for ParallelBlock {
    type Slots = SlotColumns<6, SLOTS>;

    const NEW: Self =
        Self { directions: Directions::NEW, slots: SlotColumns::NEW, regular: [0; LANES] };

    #[inline(always)]
    fn solve<const FUSED: bool>(
        &mut self,
        kernel: &Constants,
        columns: &Columns<6>,
        wrists: &mut Poses,
        _: Column,
    ) -> Flags {
        self.regular = [1; LANES];
        let constants = *kernel;
        for lane in 0..LANES {
            let frame = wrists.frame(lane);
            let wz = frame.origin[2];
            let front = facing::<FUSED>(&constants, &frame, 1.0);
            let behind = facing::<FUSED>(&constants, &frame, -1.0);
            self.put_shoulder(lane, 0, &front);
            self.put_shoulder(lane, 1, &behind);
            self.put(lane, 0, &branch::<FUSED>(&constants, &front, wz, 1.0, 1.0));
            self.put(lane, 1, &branch::<FUSED>(&constants, &front, wz, -1.0, 1.0));
            self.put(lane, 2, &branch::<FUSED>(&constants, &front, wz, 1.0, -1.0));
            self.put(lane, 3, &branch::<FUSED>(&constants, &front, wz, -1.0, -1.0));
            self.put(lane, 4, &branch::<FUSED>(&constants, &behind, wz, 1.0, 1.0));
            self.put(lane, 5, &branch::<FUSED>(&constants, &behind, wz, -1.0, 1.0));
            self.put(lane, 6, &branch::<FUSED>(&constants, &behind, wz, 1.0, -1.0));
            self.put(lane, 7, &branch::<FUSED>(&constants, &behind, wz, -1.0, -1.0));
        }
        self.directions.angles::<FUSED>();
        self.thetas::<FUSED>(columns.uncoupled);
        self.slots.wrap(&columns.joints);
        if let Some(linkage) = columns.linkage {
            // The serial joint 3.
            let angle = &self.directions.angle;
            for slot in 0..SLOTS {
                for lane in 0..LANES {
                    let theta_3 = angle[THETA_23 + slot][lane] - angle[THETA_2 + slot][lane];
                    self.slots.status[slot][lane] &= linkage.left_of(theta_3);
                }
            }
        }
        self.regular
    }

    #[inline(always)]
    fn slots(&self) -> &SlotColumns<6, SLOTS> {
        &self.slots
    }
}

impl ParallelBlock {
    #[inline(always)]
    fn put_shoulder(&mut self, lane: usize, shoulder: usize, facing: &Facing) {
        self.directions.set(THETA_1 + shoulder, lane, facing.theta_1);
        self.directions.set(THETA_5 + shoulder, lane, facing.theta_5);
        self.directions.set(THETA_6 + shoulder, lane, facing.theta_6);
        self.directions.set(PHI + shoulder, lane, facing.phi);
    }

    #[inline(always)]
    fn put(&mut self, lane: usize, slot: usize, branch: &Branch) {
        self.directions.set(THETA_2 + slot, lane, branch.theta_2);
        self.directions.set(THETA_23 + slot, lane, branch.theta_23);
        self.slots.status[slot][lane] = if branch.reached { FOUND_INSIDE } else { 0 };
        self.regular[lane] &= u64::from(branch.regular);
    }

    /// theta of every slot (eq. 40), with joint 3 as the controller's (eq. 25).
    #[inline(always)]
    fn thetas<const FUSED: bool>(&mut self, uncoupled: f64) {
        let (angle, status) = (&self.directions.angle, &self.slots.status);
        let q = &mut self.slots.q;
        for slot in 0..SLOTS {
            let (shoulder, flipped) = (slot / 4, slot % 2 == 1);
            for lane in 0..LANES {
                let (theta_5, theta_6, phi) = (
                    angle[THETA_5 + shoulder][lane],
                    angle[THETA_6 + shoulder][lane],
                    angle[PHI + shoulder][lane],
                );
                let (theta_2, theta_23) =
                    (angle[THETA_2 + slot][lane], angle[THETA_23 + slot][lane]);
                let found = status[slot][lane];
                q[0][slot][lane] = where_found(found, angle[THETA_1 + shoulder][lane]);
                q[1][slot][lane] = theta_2;
                q[2][slot][lane] = mul_add::<FUSED>(-uncoupled, theta_2, theta_23);
                q[3][slot][lane] = if flipped { half_turn(phi) } else { phi } - theta_23;
                q[4][slot][lane] = where_found(found, if flipped { -theta_5 } else { theta_5 });
                let theta_6 = if flipped { half_turn(theta_6) } else { theta_6 };
                q[5][slot][lane] = where_found(found, theta_6);
            }
        }
    }
}

const SHOULDER: [f64; SLOTS] = [1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0];
const ELBOW: [f64; SLOTS] = [1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0, -1.0];
const WRIST: [f64; SLOTS] = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0];

impl LaneKernel<6, SLOTS> for Constants {
    const DIFFERENCES: &'static [usize] = &[2, 3];

    type Regular = RegularSlots<6, SLOTS>;
    type Block = ParallelBlock;

    fn for_path(&self) -> Option<Self> {
        Some(self.on_path())
    }

    #[inline(always)]
    fn solve_one<const FUSED: bool>(
        &self,
        columns: &Columns<6>,
        t_shoulder_wrist: &Frame,
        _: f64,
    ) -> Option<RegularSlots<6, SLOTS>> {
        let (constants, frame) = (*self, *t_shoulder_wrist);
        let Columns { joints: columns, uncoupled, linkage, .. } = *columns;
        let wz = frame.origin[2];
        let (mut directions, mut slots, mut regular) =
            (Directions::<6, SLOTS>::NEW, RegularSlots::NEW, [0; SLOTS]);
        for slot in 0..SLOTS {
            let facing = facing::<FUSED>(&constants, &frame, SHOULDER[slot]);
            let branch = branch::<FUSED>(&constants, &facing, wz, WRIST[slot], ELBOW[slot]);
            let Facing { theta_1, theta_5, theta_6, phi, .. } = facing;
            directions
                .set_lane(slot, [theta_1, branch.theta_2, branch.theta_23, phi, theta_5, theta_6]);
            slots.status[slot] = if branch.reached { FOUND_INSIDE } else { 0 };
            regular[slot] = u64::from(branch.regular);
        }
        if regular != [1; SLOTS] || slots.status == [0; SLOTS] {
            return None;
        }
        directions.angles::<FUSED>();
        for slot in 0..SLOTS {
            let flipped = WRIST[slot] < 0.0;
            let [theta_1, theta_2, theta_23, phi, theta_5, theta_6] = directions.angles_of(slot);
            let phi = if flipped { half_turn(phi) } else { phi };
            slots.wrap(slot, 0, theta_1, columns[0]);
            slots.wrap(slot, 1, theta_2, columns[1]);
            slots.wrap(slot, 2, mul_add::<FUSED>(-uncoupled, theta_2, theta_23), columns[2]);
            slots.wrap(slot, 3, phi - theta_23, columns[3]);
            slots.wrap(slot, 4, WRIST[slot] * theta_5, columns[4]);
            slots.wrap(slot, 5, if flipped { half_turn(theta_6) } else { theta_6 }, columns[5]);
            if let Some(linkage) = linkage {
                slots.status[slot] &= linkage.left_of(theta_23 - theta_2);
            }
        }
        Some(slots)
    }
}
