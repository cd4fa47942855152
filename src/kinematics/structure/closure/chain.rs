//! The chain whose closure is solved, and the conditions of a configuration.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;
use nalgebra::SMatrix;

use crate::kinematics::chain::axes::{Axes, Link};
use crate::kinematics::chain::dh::DhRow;
use crate::kinematics::chain::skew::TiltedRow;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::end_frames::Frame;
use crate::lanes::{LANES, mul_add, sin_cos};

/// A chain of six joints, its lengths in units of their sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Closure {
    links: [Link; 6],
    /// Sine and cosine of the rotation about y of each link, between x and z of it, if it has one.
    tilts: [Option<(f64, f64)>; 6],
    /// The sum of all lengths [m].
    pub(crate) reach: f64,
    /// Rounding of the closure [1].
    pub(crate) rounding: f64,
}

/// The last frame that a chain is to reach, in units of its lengths.
#[derive(Clone, Copy)]
pub(crate) struct Target {
    pub(crate) frame: Frame,
}

/// The six conditions at a configuration, and their derivatives by each joint.
#[derive(Clone, Copy)]
pub(super) struct Conditions<const W: usize> {
    /// What is missing to the target: along, then about, each axis.
    pub(super) missing: [[f64; W]; 6],
    /// By joint and condition.
    pub(super) columns: [[[f64; W]; 6]; 6],
}

/// Rounding of the closure by a product of six links and of the pose, in units of the reach [1].
const ROUNDING: f64 = 2e-15;

impl Closure {
    /// The chain of these rows, with rotations about y of nearly parallel axes or without; their
    /// theta does not count.
    pub(crate) fn of<R: Copy + Into<TiltedRow>>(rows: &[R; 6]) -> Self {
        let tilted: [TiltedRow; 6] = rows.map(Into::into);
        let rows = tilted.map(|TiltedRow { row, .. }| row);
        let tilts = tilted.map(|TiltedRow { beta, .. }| (beta != 0.0).then(|| beta.sin_cos()));
        let reach: f64 = rows.iter().map(|row| row.a.abs() + row.d.abs()).sum();
        let unit = if reach > 0.0 { reach } else { 1.0 };
        let links = rows
            .map(|row| Link::new(DhRow { a: row.a / unit, d: row.d / unit, theta: 0.0, ..row }));
        Self { links, tilts, reach: unit, rounding: ROUNDING }
    }

    /// The same between end frames with these lengths [m], which add to the rounding.
    pub(crate) fn between(self, ends: f64) -> Self {
        Self { rounding: ROUNDING * (1.0 + ends / self.reach), ..self }
    }

    /// A last frame in units of the chain.
    #[inline(always)]
    pub(crate) fn target(&self, t_first_last: &Frame) -> Target {
        let unit = 1.0 / self.reach;
        let [x, y, z] = t_first_last.origin;
        Target { frame: Frame { origin: [x * unit, y * unit, z * unit], ..*t_first_last } }
    }

    /// What a configuration reaches.
    pub(crate) fn reached(&self, theta: &[f64; 6]) -> Target {
        let (sin, cos) = sines(theta);
        let (last, _) = self.frames::<1, false>(&sin, &cos);
        Target { frame: Frame::of(&last.pose(0)) }
    }

    /// The derivatives of the conditions at a configuration [1].
    pub(crate) fn derivatives(&self, theta: &[f64; 6]) -> SMatrix<f64, 6, 6> {
        self.linear(&self.reached(theta), theta).0
    }

    /// The determinant of the geometric Jacobian [m^3].
    pub(crate) fn determinant(&self, theta: &[f64; 6]) -> f64 {
        self.derivatives(theta).determinant() * self.reach * self.reach * self.reach
    }

    /// The least singular value of the derivatives [1].
    pub(crate) fn least_singular_value(&self, theta: &[f64; 6]) -> f64 {
        self.derivatives(theta).singular_values()[5]
    }

    pub(crate) fn target_of(&self, t_first_last: &Pose) -> Target {
        self.target(&Frame::of(t_first_last))
    }

    /// The conditions in lanes: the position of the last frame and half of the sum of the products
    /// of its axes and the target's, which is the sine of the angle between them along its axis.
    #[inline(always)]
    pub(super) fn conditions<const W: usize, const FUSED: bool>(
        &self,
        target: &Target,
        sin: &[[f64; W]; 6],
        cos: &[[f64; W]; 6],
    ) -> Conditions<W> {
        let (last, frames) = self.frames::<W, FUSED>(sin, cos);
        let missing = missing::<W, FUSED>(&last, target);
        let mut columns = [[[0.0; W]; 6]; 6];
        for joint in 0..6 {
            let Axes { z, origin, .. } = &frames[joint];
            for lane in 0..W {
                let [x, y, w] = [z[0][lane], z[1][lane], z[2][lane]];
                let arm: [f64; 3] = [0, 1, 2].map(|i| last.origin[i][lane] - origin[i][lane]);
                columns[joint][0][lane] = mul_add::<FUSED>(y, arm[2], -(w * arm[1]));
                columns[joint][1][lane] = mul_add::<FUSED>(w, arm[0], -(x * arm[2]));
                columns[joint][2][lane] = mul_add::<FUSED>(x, arm[1], -(y * arm[0]));
                (columns[joint][3][lane], columns[joint][4][lane]) = (x, y);
                columns[joint][5][lane] = w;
            }
        }
        Conditions { missing, columns }
    }

    /// What is missing to the target, alone.
    #[inline(always)]
    pub(super) fn missing<const W: usize, const FUSED: bool>(
        &self,
        target: &Target,
        sin: &[[f64; W]; 6],
        cos: &[[f64; W]; 6],
    ) -> [[f64; W]; 6] {
        let (last, _) = self.frames::<W, FUSED>(sin, cos);
        missing::<W, FUSED>(&last, target)
    }

    #[inline(always)]
    pub(super) fn frames<const W: usize, const FUSED: bool>(
        &self,
        sin: &[[f64; W]; 6],
        cos: &[[f64; W]; 6],
    ) -> (Axes<W>, [Axes<W>; 6]) {
        let mut frame = Axes::of(&Pose::identity());
        let mut frames = [frame; 6];
        for joint in 0..6 {
            let link = self.links[joint];
            if let Some((sin_beta, cos_beta)) = self.tilts[joint] {
                let still = Link { d: 0.0, ..link };
                frame.advance::<FUSED>(still, &[0.0; W], &[1.0; W]);
                frame.tilt::<FUSED>(sin_beta, cos_beta);
                let rest = Link { sin_alpha: 0.0, cos_alpha: 1.0, a: 0.0, ..link };
                frame.advance::<FUSED>(rest, &sin[joint], &cos[joint]);
            } else {
                frame.advance::<FUSED>(link, &sin[joint], &cos[joint]);
            }
            frames[joint] = frame;
        }
        (frame, frames)
    }
}

#[inline(always)]
fn missing<const W: usize, const FUSED: bool>(last: &Axes<W>, target: &Target) -> [[f64; W]; 6] {
    let Frame { rotation, origin } = target.frame;
    let mut missing = [[0.0; W]; 6];
    for lane in 0..W {
        for i in 0..3 {
            missing[i][lane] = origin[i] - last.origin[i][lane];
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let mut sum = 0.0;
            for (column, axis) in [&last.x, &last.y, &last.z].into_iter().enumerate() {
                sum = mul_add::<FUSED>(axis[j][lane], rotation[k][column], sum);
                sum = mul_add::<FUSED>(-axis[k][lane], rotation[j][column], sum);
            }
            missing[3 + i][lane] = 0.5 * sum;
        }
        // Half a turn away the sum is zero too: it counts as a radian.
        let mut trace = 0.0;
        for i in 0..3 {
            trace = mul_add::<FUSED>(last.x[i][lane], rotation[i][0], trace);
            trace = mul_add::<FUSED>(last.y[i][lane], rotation[i][1], trace);
            trace = mul_add::<FUSED>(last.z[i][lane], rotation[i][2], trace);
        }
        missing[3][lane] = if trace > 0.0 { missing[3][lane] } else { 1.0 };
    }
    missing
}

/// Sines and cosines of one configuration.
pub(super) fn sines(theta: &[f64; 6]) -> ([[f64; 1]; 6], [[f64; 1]; 6]) {
    let both = theta.map(sin_cos::<false>);
    (both.map(|(sin, _)| [sin]), both.map(|(_, cos)| [cos]))
}

/// The greatest of six sizes, by lane.
#[inline(always)]
pub(super) fn largest<const W: usize>(of: &[[f64; W]; 6]) -> [f64; W] {
    let mut largest = [0.0_f64; W];
    for row in of {
        for lane in 0..W {
            let size = row[lane].abs();
            // Not a number is larger than all.
            let is_larger = (size > largest[lane]) | size.is_nan();
            largest[lane] = if is_larger { size } else { largest[lane] };
        }
    }
    largest
}

const _: () = assert!(LANES == 8, "candidates come in eights");
