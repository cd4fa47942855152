//! Forward kinematics of a chain in lanes: many joint vectors side by side, or the joints of one.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::kinematics::chain::Chain;
use crate::kinematics::chain::axes::Axes;
use crate::kinematics::pose::Pose;
use crate::lanes::{Column, Kernel, LANES, MOST_SIN_COS, run, sin_cos};

impl<const N: usize> Chain<N> {
    /// Pose of the tool for the joint angles `q` [rad].
    #[must_use]
    pub(crate) fn fk(&self, q: &[f64; N]) -> Pose {
        match self.tilts() {
            None => run(OnePose::<N, false> { chain: self, q }),
            Some(_) => run(OnePose::<N, true> { chain: self, q }),
        }
    }

    /// Frame `i` of the modified table after joint `i + 1`, for each joint, and the pose of the
    /// tool.
    #[must_use]
    pub(crate) fn link_frames(&self, q: &[f64; N]) -> ([Pose; N], Pose) {
        run(OneFrames { chain: self, q })
    }
}

/// The poses of rows of joint vectors; rows of NaN where one is not finite.
pub(crate) struct Poses<'a, const N: usize> {
    pub(crate) chain: &'a Chain<N>,
    pub(crate) q: &'a [[f64; N]],
    pub(crate) out: &'a mut [[f64; 16]],
}

/// The link frames of up to a block of joint vectors, one in a lane.
pub(crate) struct Frames<'a, const N: usize> {
    pub(crate) chain: &'a Chain<N>,
    pub(crate) q: &'a [[f64; N]],
    pub(crate) out: &'a mut [Axes<LANES>],
}

/// The pose of one joint vector, of a chain with tilts or without.
struct OnePose<'a, const N: usize, const TILTS: bool> {
    chain: &'a Chain<N>,
    q: &'a [f64; N],
}

/// The frames of one joint vector, and the pose of the tool.
pub(crate) struct OneFrames<'a, const N: usize> {
    pub(crate) chain: &'a Chain<N>,
    pub(crate) q: &'a [f64; N],
}

impl<const N: usize> Kernel for Poses<'_, N> {
    type Answer = ();
    const WIDE: bool = true;

    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        let first = Axes::of(self.chain.first());
        for (q, poses) in self.q.chunks(LANES).zip(self.out.chunks_mut(LANES)) {
            let (mut sin, mut cos) = ([[0.0; LANES]; N], [[0.0; LANES]; N]);
            sines_of_rows::<N, FUSED>(self.chain, q, &mut sin, &mut cos);
            tool::<N, LANES, true, FUSED>(self.chain, first, &sin, &cos).write(poses);
            for (_, pose) in q.iter().zip(poses).filter(|(q, _)| !is_finite(q)) {
                *pose = [f64::NAN; 16];
            }
        }
    }
}

impl<const N: usize> Kernel for Frames<'_, N> {
    type Answer = ();
    const WIDE: bool = true;

    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        let (mut sin, mut cos) = ([[0.0; LANES]; N], [[0.0; LANES]; N]);
        sines_of_rows::<N, FUSED>(self.chain, self.q, &mut sin, &mut cos);
        let mut frame = Axes::of(self.chain.first());
        for (joint, link) in self.chain.table_links().iter().enumerate() {
            frame.advance::<FUSED>(*link, &sin[joint], &cos[joint]);
            self.out[joint] = frame;
        }
    }
}

impl<const N: usize, const TILTS: bool> Kernel for OnePose<'_, N, TILTS> {
    type Answer = Pose;
    const WIDE: bool = false;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> Pose {
        let (sin, cos) = sines_of_joints::<N, FUSED>(&self.chain.uncoupled(self.q));
        let first = Axes::of(self.chain.first());
        tool::<N, 1, TILTS, FUSED>(self.chain, first, &sin, &cos).pose(0)
    }
}

impl<const N: usize> Kernel for OneFrames<'_, N> {
    type Answer = ([Pose; N], Pose);
    const WIDE: bool = false;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> ([Pose; N], Pose) {
        let (sin, cos) = sines_of_joints::<N, FUSED>(&self.chain.uncoupled(self.q));
        let first = Axes::<1>::of(self.chain.first());
        let (mut frame, mut frames) = (first, [Pose::identity(); N]);
        for (joint, (link, pose)) in self.chain.table_links().iter().zip(&mut frames).enumerate() {
            frame.advance::<FUSED>(*link, &sin[joint], &cos[joint]);
            *pose = frame.pose(0);
        }
        let tool = match self.chain.tilts() {
            None => frame.times::<FUSED>(self.chain.last()),
            // Not by the common normals of the table.
            Some(_) => tool::<N, 1, true, FUSED>(self.chain, first, &sin, &cos),
        };
        (frames, tool.pose(0))
    }
}

/// The tool's frames, starting from the frame before the first link; of a chain that may have tilts
/// or of one without.
#[inline(always)]
fn tool<const N: usize, const W: usize, const TILTS: bool, const FUSED: bool>(
    chain: &Chain<N>,
    first: Axes<W>,
    sin: &[[f64; W]; N],
    cos: &[[f64; W]; N],
) -> Axes<W> {
    let mut frame = first;
    let links = chain.links().iter().enumerate();
    match chain.tilts().filter(|_| TILTS) {
        None => {
            for (joint, link) in links {
                frame.advance::<FUSED>(*link, &sin[joint], &cos[joint]);
            }
        }
        Some(tilts) => {
            for (joint, link) in links {
                frame.advance_tilted::<FUSED>(*link, tilts[joint], &sin[joint], &cos[joint]);
            }
        }
    }
    frame.times::<FUSED>(chain.last())
}

/// A column of lanes for each joint.
pub(in crate::kinematics) type Joints<const N: usize> = [Column; N];

/// Sines and cosines of the table's angles for up to a block of rows, one row per lane.
#[inline(always)]
pub(in crate::kinematics) fn sines_of_rows<const N: usize, const FUSED: bool>(
    chain: &Chain<N>,
    rows: &[[f64; N]],
    sin: &mut Joints<N>,
    cos: &mut Joints<N>,
) {
    let mut angles = [[0.0; LANES]; N];
    for (lane, row) in rows.iter().enumerate() {
        for (column, angle) in angles.iter_mut().zip(chain.uncoupled(row)) {
            column[lane] = angle;
        }
    }
    sines::<N, FUSED>(&angles, sin, cos);
}

/// Sines and cosines of the joint angles of one arm, computed side by side; one lane of each is
/// returned.
#[inline(always)]
pub(in crate::kinematics) fn sines_of_joints<const N: usize, const FUSED: bool>(
    q: &[f64; N],
) -> ([[f64; 1]; N], [[f64; 1]; N]) {
    let (mut sin, mut cos) = ([[0.0]; N], [[0.0]; N]);
    for ((q, sin), cos) in q.chunks(LANES).zip(sin.chunks_mut(LANES)).zip(cos.chunks_mut(LANES)) {
        let mut angles = [0.0; LANES];
        angles[..q.len()].copy_from_slice(q);
        let (mut sines_of, mut cosines_of) = ([[0.0; LANES]], [[0.0; LANES]]);
        sines::<1, FUSED>(&[angles], &mut sines_of, &mut cosines_of);
        sin.as_flattened_mut().copy_from_slice(&sines_of[0][..q.len()]);
        cos.as_flattened_mut().copy_from_slice(&cosines_of[0][..q.len()]);
    }
    (sin, cos)
}

#[inline(always)]
fn sines<const N: usize, const FUSED: bool>(
    angles: &Joints<N>,
    sin: &mut Joints<N>,
    cos: &mut Joints<N>,
) {
    let (angles, sin, cos) =
        (angles.as_flattened(), sin.as_flattened_mut(), cos.as_flattened_mut());
    let mut inside = u64::MAX;
    for ((angle, sin), cos) in angles.iter().zip(&mut *sin).zip(&mut *cos) {
        (*sin, *cos) = sin_cos::<FUSED>(*angle);
        inside &= if angle.abs() <= MOST_SIN_COS { u64::MAX } else { 0 };
    }
    if inside == 0 {
        take_far_turns(angles, sin, cos);
    }
}

/// Angles with more turns than the lanes can count.
#[cold]
fn take_far_turns(angles: &[f64], sin: &mut [f64], cos: &mut [f64]) {
    for ((angle, sin), cos) in
        angles.iter().zip(sin).zip(cos).filter(|((angle, _), _)| angle.abs() > MOST_SIN_COS)
    {
        (*sin, *cos) = angle.sin_cos();
    }
}

pub(in crate::kinematics) fn is_finite<const N: usize>(q: &[f64; N]) -> bool {
    q.iter().all(|angle| f64::is_finite(*angle))
}
