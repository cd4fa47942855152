//! The geometric Jacobian of a chain.

use nalgebra::SMatrix;

use crate::kinematics::chain::Chain;
use crate::kinematics::chain::axes::{Axes, Vectors};
use crate::kinematics::chain::forward::{is_finite, sines_of_joints, sines_of_rows};
use crate::lanes::{Kernel, LANES, mul_add, run};

/// The frame in which a Jacobian's rows are expressed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum JacobianFrame {
    /// The frame in which poses are given.
    #[default]
    Base,
    /// The tool's own frame.
    Tool,
}

impl<const N: usize> Chain<N> {
    /// Geometric Jacobian of the tool.
    ///
    /// Three linear rows [m/rad], then three angular [1]; column `i` belongs to joint `i + 1`.
    /// Column `i` is `z_i x (p_tool - p_i)` over `z_i`, with axis and origin of frame `i` itself:
    /// in a modified table a joint turns about its own frame's z, in a standard one about the
    /// frame's before it. Reference: Siciliano et al., Robotics, 2009, eq. 3.30, with the
    /// modified-DH index shift of docs/guide/conventions.md.
    #[must_use]
    pub(crate) fn jacobian(&self, q: &[f64; N], frame: JacobianFrame) -> SMatrix<f64, 6, N> {
        let rows = self.jacobian_rows(q, frame);
        SMatrix::from_fn(|i, joint| rows[i][joint])
    }

    pub(crate) fn jacobian_rows(&self, q: &[f64; N], frame: JacobianFrame) -> [[f64; N]; 6] {
        match self.tilts() {
            None => run(OneJacobian::<N, false> { chain: self, frame, q }),
            Some(_) => run(OneJacobian::<N, true> { chain: self, frame, q }),
        }
    }
}

/// The Jacobians of rows of joint vectors; rows of NaN where one is not finite.
pub(crate) struct Jacobians<'a, const N: usize> {
    pub(crate) chain: &'a Chain<N>,
    pub(crate) frame: JacobianFrame,
    pub(crate) q: &'a [[f64; N]],
    /// Six rows of each.
    pub(crate) out: &'a mut [[[f64; N]; 6]],
}

/// The Jacobian of one joint vector, in six rows, of a chain with tilts or without.
struct OneJacobian<'a, const N: usize, const TILTS: bool> {
    chain: &'a Chain<N>,
    frame: JacobianFrame,
    q: &'a [f64; N],
}

impl<const N: usize> Kernel for Jacobians<'_, N> {
    type Answer = ();
    const WIDE: bool = true;

    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        for (q, jacobians) in self.q.chunks(LANES).zip(self.out.chunks_mut(LANES)) {
            let (mut sin, mut cos) = ([[0.0; LANES]; N], [[0.0; LANES]; N]);
            sines_of_rows::<N, FUSED>(self.chain, q, &mut sin, &mut cos);
            let rows = jacobian_rows::<N, LANES, true, FUSED>(self.chain, self.frame, &sin, &cos);
            for (lane, jacobian) in jacobians.iter_mut().enumerate() {
                for (to, from) in jacobian.iter_mut().zip(&rows) {
                    for (to, from) in to.iter_mut().zip(from) {
                        *to = from[lane];
                    }
                }
            }
            for (_, jacobian) in q.iter().zip(jacobians).filter(|(q, _)| !is_finite(q)) {
                *jacobian = [[f64::NAN; N]; 6];
            }
        }
    }
}

impl<const N: usize, const TILTS: bool> Kernel for OneJacobian<'_, N, TILTS> {
    type Answer = [[f64; N]; 6];
    const WIDE: bool = false;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> [[f64; N]; 6] {
        let (sin, cos) = sines_of_joints::<N, FUSED>(&self.chain.uncoupled(self.q));
        let rows = jacobian_rows::<N, 1, TILTS, FUSED>(self.chain, self.frame, &sin, &cos);
        let mut jacobian = [[0.0; N]; 6];
        for (to, from) in jacobian.iter_mut().zip(&rows) {
            for (to, from) in to.iter_mut().zip(from) {
                *to = from[0];
            }
        }
        jacobian
    }
}

/// The rows of the Jacobian, each with a column per joint: `z_i x (p_tool - p_i)` over `z_i`, in
/// the base frame; of a chain that may have tilts or of one without.
#[inline(always)]
pub(in crate::kinematics) fn jacobian_rows<
    const N: usize,
    const W: usize,
    const TILTS: bool,
    const FUSED: bool,
>(
    chain: &Chain<N>,
    in_frame: JacobianFrame,
    sin: &[[f64; W]; N],
    cos: &[[f64; W]; N],
) -> [[[f64; W]; N]; 6] {
    let mut frame = Axes::of(chain.first());
    let mut frames = [frame; N];
    let links = chain.links().iter().zip(&mut frames);
    match chain.tilts().filter(|_| TILTS) {
        None => {
            for (joint, (link, place)) in links.enumerate() {
                frame.advance::<FUSED>(*link, &sin[joint], &cos[joint]);
                *place = frame;
            }
        }
        Some(tilts) => {
            for (joint, (link, place)) in links.enumerate() {
                frame.advance_tilted::<FUSED>(*link, tilts[joint], &sin[joint], &cos[joint]);
                *place = frame;
            }
        }
    }
    let tool = frame.times::<FUSED>(chain.last());
    let mut rows = [[[0.0; W]; N]; 6];
    for (joint, frame) in frames.iter().enumerate() {
        if W > 1 {
            // Keeps the loop over joints scalar: without this the compiler vectorizes over joints
            // instead of lanes, with gathers and scatters.
            core::hint::black_box(());
        }
        let mut linear = cross::<W, FUSED>(&frame.z, &tool.origin, &frame.origin);
        let mut angular = frame.z;
        if in_frame == JacobianFrame::Tool {
            (linear, angular) =
                (seen_from::<W, FUSED>(&tool, &linear), seen_from::<W, FUSED>(&tool, &angular));
        }
        for i in 0..3 {
            (rows[i][joint], rows[3 + i][joint]) = (linear[i], angular[i]);
        }
    }
    if chain.coupling() != 0.0 {
        take_coupling_back(&mut rows, chain.coupling());
    }
    rows
}

/// With q3 measured from the base, q2 turns the serial joint 3 back: the column of joint 3 is
/// subtracted from joint 2's by the factor of the coupling (eq. 26).
#[inline(always)]
fn take_coupling_back<const N: usize, const W: usize>(
    rows: &mut [[[f64; W]; N]; 6],
    coupling: f64,
) {
    for row in rows {
        if let [_, second, third, ..] = &mut row[..] {
            for (second, third) in second.iter_mut().zip(third) {
                *second -= coupling * *third;
            }
        }
    }
}

/// `axis x (to - from)`
#[inline(always)]
fn cross<const W: usize, const FUSED: bool>(
    axis: &Vectors<W>,
    to: &Vectors<W>,
    from: &Vectors<W>,
) -> Vectors<W> {
    let mut product = [[0.0; W]; 3];
    for lane in 0..W {
        let (ax, ay, az) = (axis[0][lane], axis[1][lane], axis[2][lane]);
        let (lx, ly, lz) =
            (to[0][lane] - from[0][lane], to[1][lane] - from[1][lane], to[2][lane] - from[2][lane]);
        product[0][lane] = mul_add::<FUSED>(ay, lz, -(az * ly));
        product[1][lane] = mul_add::<FUSED>(az, lx, -(ax * lz));
        product[2][lane] = mul_add::<FUSED>(ax, ly, -(ay * lx));
    }
    product
}

/// Vectors in the base frame, expressed in the tool frame.
#[inline(always)]
fn seen_from<const W: usize, const FUSED: bool>(tool: &Axes<W>, v: &Vectors<W>) -> Vectors<W> {
    [dot::<W, FUSED>(&tool.x, v), dot::<W, FUSED>(&tool.y, v), dot::<W, FUSED>(&tool.z, v)]
}

#[inline(always)]
fn dot<const W: usize, const FUSED: bool>(a: &Vectors<W>, b: &Vectors<W>) -> [f64; W] {
    let mut sum = [0.0; W];
    for lane in 0..W {
        sum[lane] = mul_add::<FUSED>(
            a[0][lane],
            b[0][lane],
            mul_add::<FUSED>(a[1][lane], b[1][lane], a[2][lane] * b[2][lane]),
        );
    }
    sum
}
