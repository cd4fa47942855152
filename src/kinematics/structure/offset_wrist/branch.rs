//! The joints before joint 6, from its angle: the branches of an arm with an offset wrist.
//!
//! Docs: offset_wrist.md, eq. 51 to 53 and 60 to 63.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::geometry::Lengths;
use super::resultant::Hand;
use crate::kinematics::structure::end_frames::Frame;
use crate::lanes::mul_add;

/// Sines and cosines of joints 1 to 6.
pub(super) type SinCos = [[f64; 2]; 6];

/// The arm with joint 6 given, on one branch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Branch {
    /// z4 . z5 - cos alpha_4: zero where the branch is a solution [1].
    pub(super) off: f64,
    /// x3 in the plane of the arm: cosine and sine of its angle above x1.
    forearm: [f64; 2],
    /// x1: cosine and sine of theta_1.
    shoulder: [f64; 2],
    /// Elbow from axis 2, in the plane of the arm.
    elbow: [f64; 2],
}

/// The plane of the arm for a wrist point and an axis 5.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    /// x1: cosine and sine of theta_1.
    x1: [f64; 2],
    /// Wrist point from axis 2 [m].
    point: [f64; 2],
    /// Axis 5 along x1, z1 and axis 2.
    axis_5: [f64; 3],
    /// The square of sigma, which is negative where the wrist point is nearer to axis 1 than the
    /// plane of the arm [m^2].
    sigma2: f64,
}

impl Plane {
    /// With the wrist point in front of axis 1 or behind it: a sign (eq. 51).
    #[inline(always)]
    pub(super) fn of<const FUSED: bool>(
        lengths: &Lengths,
        ([wx, wy, h], axis_5): ([f64; 3], [f64; 3]),
        shoulder: f64,
    ) -> Self {
        let Lengths { b, s1, .. } = *lengths;
        let r2 = mul_add::<FUSED>(wx, wx, wy * wy);
        let r = r2.sqrt();
        let sigma2 = (r - b) * (r + b);
        let sigma = shoulder * sigma2.max(0.0).sqrt();
        let x1 =
            [mul_add::<FUSED>(sigma, wx, -(s1 * b * wy)), mul_add::<FUSED>(sigma, wy, s1 * b * wx)];
        let scale = 1.0 / mul_add::<FUSED>(x1[0], x1[0], x1[1] * x1[1]).sqrt();
        let x1 = if scale.is_finite() { x1.map(|part| part * scale) } else { [1.0, 0.0] };
        Self::facing::<FUSED>(lengths, x1, [sigma, h], axis_5, sigma2)
    }

    /// With x1 in a direction, and the wrist point at (sigma, h) from axis 1.
    #[inline(always)]
    pub(super) fn facing<const FUSED: bool>(
        lengths: &Lengths,
        x1: [f64; 2],
        [sigma, h]: [f64; 2],
        [zx, zy, zz]: [f64; 3],
        sigma2: f64,
    ) -> Self {
        let radial = mul_add::<FUSED>(zx, x1[0], zy * x1[1]);
        let lateral = lengths.s1 * mul_add::<FUSED>(zx, x1[1], -(zy * x1[0]));
        Self { x1, point: [sigma - lengths.a1, h], axis_5: [radial, zz, lateral], sigma2 }
    }

    /// Factors of cosine and sine of the forearm, and what their sum must be, for axis 5 to be at
    /// its angle from axis 4 (eq. 52).
    #[inline(always)]
    fn axis_condition(&self, lengths: &Lengths) -> ([f64; 2], f64) {
        let Lengths { m, e, cos_3, cos_4, .. } = *lengths;
        let [radial, rise, lateral] = self.axis_5;
        ([m * rise, -m * radial], cos_4 - e * cos_3 * lateral)
    }

    /// The same for the upper arm to have its length (eq. 53).
    #[inline(always)]
    fn length_condition<const FUSED: bool>(&self, lengths: &Lengths) -> ([f64; 2], f64) {
        let Lengths { upper, forearm, v: [v1, v2], .. } = *lengths;
        let [r, h] = self.point;
        let square = mul_add::<FUSED>(r, r, h * h);
        let factors = [mul_add::<FUSED>(r, v1, h * v2), mul_add::<FUSED>(h, v1, -(r * v2))];
        (factors, (square + (forearm - upper) * (forearm + upper)) / (2.0 * forearm))
    }

    /// The branch with the elbow on one side: a sign (eq. 60); `None` if the links do not span the
    /// distance of the wrist point by more than `slack`, relative to it.
    #[inline(always)]
    pub(super) fn with_elbow<const FUSED: bool>(
        &self,
        lengths: &Lengths,
        side: f64,
        slack: f64,
    ) -> Option<Branch> {
        let forearm = direction(self.length_condition::<FUSED>(lengths), side, slack)?;
        Some(self.branch::<FUSED>(lengths, forearm))
    }

    /// The branch that meets the condition of axis 5, where the distance of the wrist point leaves
    /// the forearm undetermined; a sign chooses one of two.
    pub(super) fn with_axis_5<const FUSED: bool>(
        &self,
        lengths: &Lengths,
        side: f64,
        slack: f64,
    ) -> Option<Branch> {
        let forearm = direction(self.axis_condition(lengths), side, slack)?;
        Some(self.branch::<FUSED>(lengths, forearm))
    }

    #[inline(always)]
    fn branch<const FUSED: bool>(&self, lengths: &Lengths, [cos, sin]: [f64; 2]) -> Branch {
        let Lengths { forearm, v: [v1, v2], .. } = *lengths;
        let ([of_cos, of_sin], wanted) = self.axis_condition(lengths);
        let along = [mul_add::<FUSED>(v1, cos, -(v2 * sin)), mul_add::<FUSED>(v1, sin, v2 * cos)];
        Branch {
            off: mul_add::<FUSED>(of_cos, cos, mul_add::<FUSED>(of_sin, sin, -wanted)),
            forearm: [cos, sin],
            shoulder: self.x1,
            elbow: [
                mul_add::<FUSED>(-forearm, along[0], self.point[0]),
                mul_add::<FUSED>(-forearm, along[1], self.point[1]),
            ],
        }
    }
}

/// The unit vector with a given product with `factors`, on one side of them.
#[inline(always)]
fn direction(([x, y], wanted): ([f64; 2], f64), side: f64, slack: f64) -> Option<[f64; 2]> {
    let square = x * x + y * y;
    let rest = square - wanted * wanted;
    if rest < -slack * square || square <= 0.0 {
        return None;
    }
    let across = side * rest.max(0.0).sqrt();
    let (cos, sin) = (wanted * x - across * y, wanted * y + across * x);
    let length = cos.hypot(sin);
    (length > 0.0).then(|| [cos / length, sin / length])
}

impl Branch {
    /// How far the upper arm is from having its length [m].
    pub(super) fn misses(&self, lengths: &Lengths) -> f64 {
        (self.elbow[0].hypot(self.elbow[1]) - lengths.upper.abs()).abs()
    }

    /// Sines and cosines of all joints (eq. 61 to 63).
    #[inline(always)]
    pub(super) fn joints<const FUSED: bool>(
        &self,
        lengths: &Lengths,
        last: &Frame,
        sin_cos_6: [f64; 2],
        constants: &Twists,
    ) -> SinCos {
        let Lengths { upper, s1, e, .. } = *lengths;
        let turn = s1 * e;
        let [c1, n1] = self.shoulder;
        let [cos, sin] = self.forearm;
        let scale = 1.0 / upper;
        let [x2, y2] = self.elbow.map(|part| part * scale);
        // theta_2 and theta_2 + e theta_3 are angles in the plane, times s1.
        let second = [s1 * y2, x2];
        let third =
            [turn * mul_add::<FUSED>(sin, x2, -(cos * y2)), mul_add::<FUSED>(cos, x2, sin * y2)];
        // Axes of frame 3 in the shoulder frame.
        let x3 = [cos * c1, cos * n1, sin];
        let y3 = [-turn * sin * c1, -turn * sin * n1, turn * cos];
        let z3 = [e * s1 * n1, -e * s1 * c1, 0.0];
        // Frame 5: frame 6 turned back by joint 6, with its twist removed.
        let [s6, c6] = sin_cos_6;
        let r = &last.rotation;
        let column = |j: usize| [r[0][j], r[1][j], r[2][j]];
        let (x6, y6, z6) = (column(0), column(1), column(2));
        let x5 = combined::<FUSED>(x6, c6, y6, -s6);
        let across = combined::<FUSED>(x6, s6, y6, c6);
        let z5 = combined::<FUSED>(across, constants.sin_5, z6, constants.cos_5);
        let y3_turned = combined::<FUSED>(y3, constants.cos_3, z3, constants.sin_3);
        // z5 = sin alpha_4 (sin theta_4 x3 - cos theta_4 y3') + ...
        let (s4, c4) = (
            dot::<FUSED>(z5, x3) / constants.sin_4,
            -dot::<FUSED>(z5, y3_turned) / constants.sin_4,
        );
        let size = 1.0 / mul_add::<FUSED>(s4, s4, c4 * c4).sqrt();
        let (s4, c4) = (s4 * size, c4 * size);
        let x4 = combined::<FUSED>(x3, c4, y3_turned, s4);
        let y4 = cross::<FUSED>(z5, x4);
        let fifth = [dot::<FUSED>(x5, y4), dot::<FUSED>(x5, x4)];
        [[n1, c1], second, third, [s4, c4], fifth, sin_cos_6]
    }
}

/// Sines and cosines of the twists of rows 4 to 6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Twists {
    pub(super) sin_3: f64,
    pub(super) cos_3: f64,
    pub(super) sin_4: f64,
    pub(super) sin_5: f64,
    pub(super) cos_5: f64,
}

#[inline(always)]
fn combined<const FUSED: bool>(a: [f64; 3], x: f64, b: [f64; 3], y: f64) -> [f64; 3] {
    let part = |i: usize| mul_add::<FUSED>(a[i], x, b[i] * y);
    [part(0), part(1), part(2)]
}

#[inline(always)]
fn dot<const FUSED: bool>(a: [f64; 3], b: [f64; 3]) -> f64 {
    mul_add::<FUSED>(a[0], b[0], mul_add::<FUSED>(a[1], b[1], a[2] * b[2]))
}

#[inline(always)]
fn cross<const FUSED: bool>(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    let part = |i: usize, j: usize| mul_add::<FUSED>(a[i], b[j], -(a[j] * b[i]));
    [part(1, 2), part(2, 0), part(0, 1)]
}

/// The four branches of an arm for an angle of joint 6: shoulder and elbow on either side.
pub(super) const SIDES: [[f64; 2]; 4] = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];

/// The branch with shoulder and elbow on given sides, for sine and cosine of joint 6.
pub(super) fn branch_at(
    lengths: &Lengths,
    hand: &Hand,
    [shoulder, elbow]: [f64; 2],
    sin_cos_6: [f64; 2],
    slack: f64,
) -> Option<Branch> {
    let plane = Plane::of::<false>(lengths, hand.at::<false>(sin_cos_6), shoulder);
    (plane.sigma2 >= 0.0).then(|| plane.with_elbow::<false>(lengths, elbow, slack)).flatten()
}

/// How far the arm is inside its reach with the shoulder on a given side, for sine and cosine of
/// joint 6 [1]: negative where there is no branch.
pub(super) fn room_at(lengths: &Lengths, hand: &Hand, shoulder: f64, sin_cos_6: [f64; 2]) -> f64 {
    let plane = Plane::of::<false>(lengths, hand.at::<false>(sin_cos_6), shoulder);
    let size = lengths.upper.abs() + lengths.forearm;
    let at_shoulder = plane.sigma2 / (size * size);
    if at_shoulder < 0.0 {
        return at_shoulder;
    }
    let ([x, y], wanted) = plane.length_condition::<false>(lengths);
    (x * x + y * y - wanted * wanted) / (size * size)
}
