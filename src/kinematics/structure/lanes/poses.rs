//! A block of poses in lanes: read, checked, and expressed in the arm's frames.

use crate::kinematics::pose::rotation::{Rows3, determinant, gram_excess, nearest_rotation};
use crate::kinematics::structure::end_frames::{Frame, Seen};
use crate::kinematics::thresholds::{MOST_LENGTH, ROTATION_REPAIR_BOUND, ROTATION_ROUNDING};
use crate::lanes::{Column, Flags, LANES};

/// Row-major elements of a pose.
pub(crate) type PoseRow = [f64; 16];

/// The poses of a block, element by element.
#[derive(Clone, Copy)]
pub(crate) struct Poses {
    rotation: [[Column; 3]; 3],
    origin: [Column; 3],
    last_row: [Column; 4],
}

impl Poses {
    pub(crate) const NEW: Self = Self {
        rotation: [[[0.0; LANES]; 3]; 3],
        origin: [[0.0; LANES]; 3],
        last_row: [[0.0; LANES]; 4],
    };

    #[inline(never)]
    pub(crate) fn read(&mut self, rows: &[PoseRow; LANES]) {
        // Two lanes at a time: half the stores.
        for (pair, [left, right]) in rows.as_chunks::<2>().0.iter().enumerate() {
            for i in 0..3 {
                for j in 0..3 {
                    self.rotation[i][j].as_chunks_mut::<2>().0[pair] =
                        [left[4 * i + j], right[4 * i + j]];
                }
                self.origin[i].as_chunks_mut::<2>().0[pair] = [left[4 * i + 3], right[4 * i + 3]];
            }
            for j in 0..4 {
                self.last_row[j].as_chunks_mut::<2>().0[pair] = [left[12 + j], right[12 + j]];
            }
        }
    }

    #[inline(always)]
    pub(crate) fn frame(&self, lane: usize) -> Frame {
        let (r, p) = (&self.rotation, &self.origin);
        Frame {
            rotation: [
                [r[0][0][lane], r[0][1][lane], r[0][2][lane]],
                [r[1][0][lane], r[1][1][lane], r[1][2][lane]],
                [r[2][0][lane], r[2][1][lane], r[2][2][lane]],
            ],
            origin: [p[0][lane], p[1][lane], p[2][lane]],
        }
    }

    #[inline(always)]
    pub(crate) fn set_frame(&mut self, lane: usize, frame: Frame) {
        self.set_rotation(lane, frame.rotation);
        self.set_origin(lane, frame.origin);
    }

    #[inline(always)]
    fn set_rotation(&mut self, lane: usize, [x, y, z]: Rows3) {
        let r = &mut self.rotation;
        [r[0][0][lane], r[0][1][lane], r[0][2][lane]] = x;
        [r[1][0][lane], r[1][1][lane], r[1][2][lane]] = y;
        [r[2][0][lane], r[2][1][lane], r[2][2][lane]] = z;
    }

    #[inline(always)]
    fn set_origin(&mut self, lane: usize, origin: [f64; 3]) {
        let p = &mut self.origin;
        [p[0][lane], p[1][lane], p[2][lane]] = origin;
    }

    /// The lanes that hold a pose; a rotation with small errors is repaired.
    #[inline(always)]
    #[expect(
        clippy::float_cmp,
        reason = "another last row goes the scalar way, which has room for rounding"
    )]
    pub(crate) fn check(&mut self) -> Flags {
        let (mut sound, mut off) = ([0; LANES], [0; LANES]);
        for lane in 0..LANES {
            let Frame { rotation, origin: [x, y, z] } = self.frame(lane);
            let excess = gram_excess(&rotation);
            let [a, b, c, d] = &self.last_row;
            let near =
                (x.abs() <= MOST_LENGTH) & (y.abs() <= MOST_LENGTH) & (z.abs() <= MOST_LENGTH);
            let last = (a[lane] == 0.0) & (b[lane] == 0.0) & (c[lane] == 0.0) & (d[lane] == 1.0);
            sound[lane] = u64::from(
                near & last
                    & (determinant(&rotation) > 0.0)
                    & all_within(excess, ROTATION_REPAIR_BOUND),
            );
            off[lane] = u64::from(!all_within(excess, ROTATION_ROUNDING));
        }
        if off != [0; LANES] {
            for lane in 0..LANES {
                let rotation = self.frame(lane).rotation;
                let repaired = nearest_rotation(&rotation);
                self.set_rotation(lane, if off[lane] == 0 { rotation } else { repaired });
            }
        }
        sound
    }

    /// From the tool in the world frame to the wrist in the shoulder frame (eq. 1).
    #[inline(always)]
    pub(crate) fn seen_from_shoulder<const FUSED: bool>(&mut self, seen: Seen) {
        if seen.turns {
            for lane in 0..LANES {
                self.set_frame(lane, seen.rotated::<FUSED>(&self.frame(lane)));
            }
        } else {
            for lane in 0..LANES {
                let frame = self.frame(lane);
                self.set_origin(lane, seen.shifted::<FUSED>(&frame));
            }
        }
    }
}

#[inline(always)]
fn all_within([a, b, c, d, e, f]: [f64; 6], bound: f64) -> bool {
    (a.abs() <= bound)
        & (b.abs() <= bound)
        & (c.abs() <= bound)
        & (d.abs() <= bound)
        & (e.abs() <= bound)
        & (f.abs() <= bound)
}
