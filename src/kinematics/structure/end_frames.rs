//! The end frames of an arm's geometry: base, shoulder, flange and tool.

use fearless_simd::prelude::*;
use nalgebra::Vector3;

use crate::kinematics::chain::Chain;
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::rotation::Rows3;
use crate::kinematics::structure::joint_map::JointMap;
use crate::lanes::{LANES, Number, Vector, dot, mul_add, same, transposed};

/// The constant factors of eq. 1, which remove base, shoulder height, flange and tool from a pose.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct EndFrames {
    t_shoulder_world: Pose,
    t_tool_wrist: Pose,
    pub(crate) seen: Seen,
}

impl EndFrames {
    /// The factors for the base and the tool of a chain.
    pub(crate) fn new<const M: usize, const N: usize>(
        joint_map: &JointMap<M>,
        chain: &Chain<N>,
    ) -> Self {
        let t_shoulder_world = (chain.base() * joint_map.t_base_shoulder).inverse();
        let t_tool_wrist = (joint_map.t_wrist_flange * chain.tool()).inverse();
        Self { t_shoulder_world, t_tool_wrist, seen: Seen::new(&t_shoulder_world, &t_tool_wrist) }
    }

    /// The wrist frame of a pose, in the shoulder frame (eq. 1).
    pub(crate) fn wrist_pose(&self, pose: &Pose) -> Pose {
        self.t_shoulder_world * pose * self.t_tool_wrist
    }

    /// The direction of axis 1 in the world, upwards.
    pub(crate) fn up(&self) -> Vector3<f64> {
        self.t_shoulder_world.inverse_transform_vector(&Vector3::z())
    }

    /// The tool center point of a pose in the shoulder frame, and the same point in the wrist
    /// frame.
    pub(crate) fn tool_point(&self, pose: &Pose) -> (Vector3<f64>, Vector3<f64>) {
        let point = self.t_shoulder_world.transform_point(&pose.translation.vector.into());
        (point.coords, self.t_tool_wrist.inverse().translation.vector)
    }
}

const UNTURNED: Rows3 = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The constant factors of eq. 1, as kernels take them: they remove base, shoulder height, flange
/// and tool from a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Seen {
    before: Frame,
    behind: Frame,
    /// Whether either factor rotates: an identity rotation changes no bit of a nonzero number, and
    /// is skipped.
    pub(crate) turns: bool,
}

impl Seen {
    fn new(t_shoulder_world: &Pose, t_tool_wrist: &Pose) -> Self {
        let (before, behind) = (Frame::of(t_shoulder_world), Frame::of(t_tool_wrist));
        Self { before, behind, turns: before.rotation != UNTURNED || behind.rotation != UNTURNED }
    }

    /// The wrist in the shoulder frame, for the tool in the world frame.
    #[inline(always)]
    pub(crate) fn of<const FUSED: bool>(&self, t_world_tool: &Frame) -> Frame {
        if self.turns {
            self.rotated::<FUSED>(t_world_tool)
        } else {
            Frame { rotation: t_world_tool.rotation, origin: self.shifted::<FUSED>(t_world_tool) }
        }
    }

    #[inline(always)]
    pub(crate) fn rotated<const FUSED: bool>(&self, t_world_tool: &Frame) -> Frame {
        let before = &self.before.rotation;
        let rotation = product::<FUSED>(before, &t_world_tool.rotation);
        let origin = moved::<FUSED>(before, t_world_tool.origin, self.before.origin);
        Frame {
            rotation: product::<FUSED>(&rotation, &self.behind.rotation),
            origin: moved::<FUSED>(&rotation, self.behind.origin, origin),
        }
    }

    #[inline(always)]
    pub(crate) fn shifted<const FUSED: bool>(&self, t_world_tool: &Frame) -> [f64; 3] {
        let [x, y, z] = t_world_tool.origin;
        let [dx, dy, dz] = self.before.origin;
        moved::<FUSED>(&t_world_tool.rotation, self.behind.origin, [x + dx, y + dy, z + dz])
    }
}

/// A transform as kernels take it, or one in each lane: the rows of its rotation, and its origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame<T = f64> {
    pub(crate) rotation: [[T; 3]; 3],
    pub(crate) origin: [T; 3],
}

impl Frame {
    pub(crate) const IDENTITY: Self = Self { rotation: UNTURNED, origin: [0.0; 3] };

    pub(crate) fn of(pose: &Pose) -> Self {
        Self {
            rotation: pose.rotation.matrix().transpose().into(),
            origin: pose.translation.vector.into(),
        }
    }

    /// The frame in every lane.
    #[inline(always)]
    pub(crate) fn in_lanes<T: Number>(&self, like: T) -> Frame<T> {
        let zero = like.like(0.0);
        let mut lanes = Frame { rotation: [[zero; 3]; 3], origin: [zero; 3] };
        for i in 0..3 {
            for j in 0..3 {
                lanes.rotation[i][j] = zero.like(self.rotation[i][j]);
            }
            lanes.origin[i] = zero.like(self.origin[i]);
        }
        lanes
    }

    pub(crate) fn inverse(&self) -> Self {
        let [a, b, c] = self.rotation;
        let rotation = [[a[0], b[0], c[0]], [a[1], b[1], c[1]], [a[2], b[2], c[2]]];
        let [x, y, z] = Self { rotation, ..*self }.turned(self.origin);
        Self { rotation, origin: [-x, -y, -z] }
    }
}

impl<S: Simd> Frame<Vector<S>> {
    /// Gather frames by their indices, a lane for each.
    #[inline(always)]
    pub(crate) fn of_lanes(simd: S, all: &[Frame], numbers: &[usize; LANES]) -> Self {
        if let Some(one) = same(numbers) {
            return all[one].in_lanes(Vector::splat(simd, 0.0));
        }
        let mut each = [&all[0]; LANES];
        for lane in 0..LANES {
            each[lane] = &all[numbers[lane]];
        }
        Self::of_each(simd, &each)
    }

    /// Eight frames, one in each lane.
    #[inline(always)]
    pub(crate) fn of_each(simd: S, each: &[&Frame; LANES]) -> Self {
        let ([mut a, mut b, mut c], mut origins) =
            ([[&each[0].origin; LANES]; 3], [&each[0].origin; LANES]);
        for lane in 0..LANES {
            let Frame { rotation, origin } = each[lane];
            ([a[lane], b[lane], c[lane]], origins[lane]) = (rotation.each_ref(), origin);
        }
        Self {
            rotation: [transposed(simd, &a), transposed(simd, &b), transposed(simd, &c)],
            origin: transposed(simd, &origins),
        }
    }
}

impl<T: Number> Frame<T> {
    /// A vector turned by the rotation.
    #[inline(always)]
    pub(crate) fn turned(&self, v: [T; 3]) -> [T; 3] {
        let [a, b, c] = self.rotation;
        [dot(a, v), dot(b, v), dot(c, v)]
    }

    /// Scale lengths to units.
    #[inline(always)]
    pub(crate) fn in_units(self, unit: f64) -> Self {
        let [x, y, z] = self.origin;
        Self { origin: [x * unit, y * unit, z * unit], ..self }
    }
}

impl Frame {
    /// This frame rotated back by an angle about its z axis.
    #[inline(always)]
    pub(crate) fn unturned<const FUSED: bool>(&self, sin: f64, cos: f64) -> Self {
        let [a, b, c] = self.rotation;
        Self {
            rotation: [
                turned_back::<FUSED>(a, sin, cos),
                turned_back::<FUSED>(b, sin, cos),
                turned_back::<FUSED>(c, sin, cos),
            ],
            ..*self
        }
    }

    #[inline(always)]
    pub(crate) fn times<const FUSED: bool>(&self, behind: &Self) -> Self {
        Self {
            rotation: product::<FUSED>(&self.rotation, &behind.rotation),
            origin: moved::<FUSED>(&self.rotation, behind.origin, self.origin),
        }
    }
}

#[inline(always)]
fn turned_back<const FUSED: bool>([x, y, z]: [f64; 3], sin: f64, cos: f64) -> [f64; 3] {
    [mul_add::<FUSED>(x, cos, -(y * sin)), mul_add::<FUSED>(x, sin, y * cos), z]
}

#[inline(always)]
fn product<const FUSED: bool>(a: &Rows3, b: &Rows3) -> Rows3 {
    [row_times::<FUSED>(a[0], b), row_times::<FUSED>(a[1], b), row_times::<FUSED>(a[2], b)]
}

/// `r v + p`
#[inline(always)]
fn moved<const FUSED: bool>(r: &Rows3, v: [f64; 3], p: [f64; 3]) -> [f64; 3] {
    [
        dot_plus::<FUSED>(r[0], v, p[0]),
        dot_plus::<FUSED>(r[1], v, p[1]),
        dot_plus::<FUSED>(r[2], v, p[2]),
    ]
}

#[inline(always)]
fn row_times<const FUSED: bool>(a: [f64; 3], b: &Rows3) -> [f64; 3] {
    [
        dot_plus::<FUSED>(a, [b[0][0], b[1][0], b[2][0]], 0.0),
        dot_plus::<FUSED>(a, [b[0][1], b[1][1], b[2][1]], 0.0),
        dot_plus::<FUSED>(a, [b[0][2], b[1][2], b[2][2]], 0.0),
    ]
}

#[inline(always)]
fn dot_plus<const FUSED: bool>(a: [f64; 3], b: [f64; 3], c: f64) -> f64 {
    mul_add::<FUSED>(a[0], b[0], mul_add::<FUSED>(a[1], b[1], mul_add::<FUSED>(a[2], b[2], c)))
}
