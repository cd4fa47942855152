//! The chain whose closure is solved, and the conditions of a configuration.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;
use nalgebra::{SMatrix, SVector};

use super::placed::Placed;
use crate::kinematics::chain::axes::Link;
use crate::kinematics::chain::dh::DhRow;
use crate::kinematics::chain::singular_values::least_singular_value;
use crate::kinematics::chain::skew::TiltedRow;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::end_frames::Frame;
use crate::lanes::{Number, cross, sin_cos};

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

/// The last frame that a chain is to reach, in units of its lengths, or one in each lane.
#[derive(Clone, Copy)]
pub(crate) struct Target<T = f64> {
    pub(crate) frame: Frame<T>,
}

impl Target {
    /// Broadcast to the lanes of a number.
    #[inline(always)]
    pub(crate) fn in_lanes<T: Number>(&self, like: T) -> Target<T> {
        Target { frame: self.frame.in_lanes(like) }
    }

    /// Whether it is farther away than the sum of the lengths.
    pub(crate) fn is_beyond(&self) -> bool {
        let square = self.frame.origin.iter().map(|x| x * x).sum::<f64>();
        square > (1.0 + BEYOND) * (1.0 + BEYOND)
    }
}

/// The six conditions at a configuration, and their derivatives by each joint.
#[derive(Clone, Copy)]
pub(super) struct Conditions<T> {
    /// The differences to the target: along, then about, each axis.
    pub(super) missing: [T; 6],
    /// By joint and condition.
    pub(super) columns: [[T; 6]; 6],
}

/// The axis of a joint.
#[derive(Clone, Copy)]
struct Axis<T> {
    direction: [T; 3],
    point: [T; 3],
}

/// How far beyond the sum of its lengths nothing is in reach of a chain, relative to it [1].
const BEYOND: f64 = 1e-9;

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

    /// Return the closure between end frames with these lengths [m], which add to the rounding.
    pub(crate) fn between(self, ends: f64) -> Self {
        Self { rounding: ROUNDING * (1.0 + ends / self.reach), ..self }
    }

    /// A last frame in units of the chain.
    #[inline(always)]
    pub(crate) fn target<T: Number>(&self, t_first_last: Frame<T>) -> Target<T> {
        Target { frame: t_first_last.in_units(1.0 / self.reach) }
    }

    /// Return the target that a configuration reaches.
    pub(crate) fn reached(&self, theta: &[f64; 6]) -> Target {
        let (sin, cos) = sines(theta);
        let (Placed { x, y, z, origin }, _) = self.frames(&sin, &cos);
        let rotation = core::array::from_fn(|i| [x[i], y[i], z[i]]);
        Target { frame: Frame { rotation, origin } }
    }

    /// The last frame of a configuration [m].
    pub(crate) fn last_frame(&self, theta: &[f64; 6]) -> Frame {
        self.reached(theta).frame.in_units(self.reach)
    }

    /// The derivatives of the conditions at a configuration [1].
    pub(crate) fn derivatives(&self, theta: &[f64; 6]) -> SMatrix<f64, 6, 6> {
        self.linear(&self.reached(theta), theta).0
    }

    /// Derivatives and missing conditions at angles.
    pub(super) fn linear(
        &self,
        target: &Target,
        theta: &[f64; 6],
    ) -> (SMatrix<f64, 6, 6>, SVector<f64, 6>) {
        let (sin, cos) = sines(theta);
        let conditions = self.conditions(target, &sin, &cos);
        (
            SMatrix::from_fn(|row, joint| conditions.columns[joint][row]),
            SVector::from_fn(|row, _| conditions.missing[row]),
        )
    }

    /// The determinant of the geometric Jacobian [m^3].
    pub(crate) fn determinant(&self, theta: &[f64; 6]) -> f64 {
        self.derivatives(theta).determinant() * self.reach * self.reach * self.reach
    }

    /// The least singular value of the derivatives [1].
    pub(crate) fn least_singular_value(&self, theta: &[f64; 6]) -> f64 {
        least_singular_value(&self.derivatives(theta).into())
    }

    pub(crate) fn target_of(&self, t_first_last: &Pose) -> Target {
        self.target(Frame::of(t_first_last))
    }

    /// The conditions: the position of the last frame and half of the sum of the products of its
    /// axes and the target's, which is the sine of the angle between them along its axis.
    #[inline(always)]
    pub(super) fn conditions<T: Number>(
        &self,
        target: &Target<T>,
        sin: &[T; 6],
        cos: &[T; 6],
    ) -> Conditions<T> {
        let (last, axes) = self.frames(sin, cos);
        let mut columns = [[sin[0]; 6]; 6];
        for joint in 0..6 {
            let Axis { direction, point } = axes[joint];
            let mut arm = point;
            for i in 0..3 {
                arm[i] = last.origin[i] - point[i];
            }
            let ([x, y, z], [a, b, c]) = (cross(direction, arm), direction);
            columns[joint] = [x, y, z, a, b, c];
        }
        Conditions { missing: missing(&last, target), columns }
    }

    /// Return the differences to the target, alone.
    #[inline(always)]
    pub(super) fn missing<T: Number>(
        &self,
        target: &Target<T>,
        sin: &[T; 6],
        cos: &[T; 6],
    ) -> [T; 6] {
        missing(&self.frames(sin, cos).0, target)
    }

    /// The last frame, and each joint's axis and a point on it.
    #[inline(always)]
    fn frames<T: Number>(&self, sin: &[T; 6], cos: &[T; 6]) -> (Placed<T>, [Axis<T>; 6]) {
        let mut frame = Placed::of(Frame::IDENTITY.in_lanes(sin[0]));
        let mut axes = [Axis { direction: frame.z, point: frame.origin }; 6];
        for joint in 0..6 {
            let link = &self.links[joint];
            frame = frame.screwed(link);
            if let Some(tilt) = self.tilts[joint] {
                frame = frame.tilted(tilt);
            }
            frame = frame.turned(sin[joint], cos[joint]).raised(link.d);
            axes[joint] = Axis { direction: frame.z, point: frame.origin };
        }
        (frame, axes)
    }
}

#[inline(always)]
fn missing<T: Number>(last: &Placed<T>, target: &Target<T>) -> [T; 6] {
    let Frame { rotation, origin } = target.frame;
    let zero = last.x[0].like(0.0);
    let mut missing = [zero; 6];
    let mut trace = zero;
    for i in 0..3 {
        missing[i] = origin[i] - last.origin[i];
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let (a, b) = (&rotation[j], &rotation[k]);
        let ahead = last.z[j].times_plus(b[2], last.z[k] * -a[2]);
        let ahead = last.y[j].times_plus(b[1], last.y[k].times_plus(-a[1], ahead));
        missing[3 + i] = last.x[j].times_plus(b[0], last.x[k].times_plus(-a[0], ahead)) * 0.5;
        let [x, y, z] = rotation[i];
        let along = last.y[i].times_plus(y, last.z[i].times_plus(z, trace));
        trace = last.x[i].times_plus(x, along);
    }
    // Half a turn away the sum is zero too: it counts as a radian.
    missing[3] = trace.if_above(zero, missing[3], zero.like(1.0));
    missing
}

/// Sines and cosines of one configuration.
pub(super) fn sines(theta: &[f64; 6]) -> ([f64; 6], [f64; 6]) {
    let both = theta.map(sin_cos::<false>);
    (both.map(|(sin, _)| sin), both.map(|(_, cos)| cos))
}

/// The greatest of six sizes; not a number if one of them is not, or not finite.
#[inline(always)]
pub(super) fn largest<T: Number>(of: &[T; 6]) -> T {
    let (mut largest, mut sum) = (of[0].size(), of[0]);
    for number in &of[1..] {
        largest = number.size().or_more(largest);
        sum = sum + *number;
    }
    sum.scaled_plus(0.0, largest)
}
