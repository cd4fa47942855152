//! The joints before joint 6, from its angle: the branches of an arm with an offset wrist.
//!
//! Docs: offset_wrist.md, eq. 122 to 124 and 131 to 132.

use super::geometry::{Lengths, Twists};
use crate::kinematics::structure::end_frames::Frame;
use crate::lanes::{Number, cross, dot};

/// Square of a length that has a direction, relative to the arm's [1].
const LEAST_SQUARE: f64 = 1e-300;

/// How far a branch may be out of reach and still be a candidate, relative to the squares of the
/// lengths [1].
pub(super) const SLACK: f64 = 1e-3;

/// The arm with joint 6 given, on one branch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Branch<T> {
    /// z4 . z5 - cos alpha_4: zero where the branch is a solution, infinite where the links do not
    /// span the distance [1].
    pub(super) off: T,
    /// x3 in the plane of the arm: cosine and sine of its angle above x1.
    pub(super) forearm: [T; 2],
    /// x1: cosine and sine of theta_1.
    pub(super) shoulder: [T; 2],
    /// Elbow from axis 2, in the plane of the arm.
    pub(super) elbow: [T; 2],
}

/// The plane of the arm for a wrist point and an axis 5.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane<T> {
    /// x1: cosine and sine of theta_1.
    x1: [T; 2],
    /// Wrist point from axis 2 [m].
    point: [T; 2],
    /// Axis 5 along x1, z1 and axis 2.
    axis_5: [T; 3],
}

impl<T: Number> Plane<T> {
    /// With the wrist point in front of axis 1 or behind it: a sign (eq. 122).
    #[inline(always)]
    pub(super) fn of(
        lengths: &Lengths,
        ([wx, wy, h], axis_5): ([T; 3], [T; 3]),
        shoulder: T,
    ) -> Self {
        let Lengths { b, s1, .. } = *lengths;
        let zero = h.like(0.0);
        let r = wx.times_plus(wx, wy * wy).root();
        let sigma2 = (r - r.like(b)) * (r + r.like(b));
        let sigma = sigma2.or_more(zero).root() * shoulder;
        let x1 = [sigma.times_plus(wx, wy * -(s1 * b)), sigma.times_plus(wy, wx * (s1 * b))];
        let square = x1[0].times_plus(x1[0], x1[1] * x1[1]);
        let (scale, least) = (square.root().inverse(), zero.like(LEAST_SQUARE));
        let x1 = [
            square.if_above(least, x1[0] * scale, zero.like(1.0)),
            square.if_above(least, x1[1] * scale, zero),
        ];
        Self::facing(lengths, x1, [sigma, h], axis_5)
    }

    /// With x1 in a direction, and the wrist point at (sigma, h) from axis 1.
    #[inline(always)]
    pub(super) fn facing(
        lengths: &Lengths,
        x1: [T; 2],
        [sigma, h]: [T; 2],
        [zx, zy, zz]: [T; 3],
    ) -> Self {
        let radial = zx.times_plus(x1[0], zy * x1[1]);
        let lateral = zx.times_minus(x1[1], zy * x1[0]) * lengths.s1;
        let point = [sigma - sigma.like(lengths.a1), h];
        Self { x1, point, axis_5: [radial, zz, lateral] }
    }

    /// Factors of cosine and sine of the forearm, and what their sum must be, for axis 5 to be at
    /// its angle from axis 4 (eq. 123).
    #[inline(always)]
    fn axis_condition(&self, lengths: &Lengths) -> ([T; 2], T) {
        let Lengths { m, e, cos_3, cos_4, .. } = *lengths;
        let [radial, rise, lateral] = self.axis_5;
        ([rise * m, radial * -m], lateral.scaled_plus(-(e * cos_3), lateral.like(cos_4)))
    }

    /// The condition for the upper arm to have its length (eq. 124).
    #[inline(always)]
    fn length_condition(&self, lengths: &Lengths) -> ([T; 2], T) {
        let Lengths { upper, forearm, v: [v1, v2], .. } = *lengths;
        let [r, h] = self.point;
        let square = r.times_plus(r, h * h);
        let factors = [r.scaled_plus(v1, h * v2), h.scaled_plus(v1, r * -v2)];
        let excess = r.like((forearm - upper) * (forearm + upper));
        (factors, (square + excess) / r.like(2.0 * forearm))
    }

    /// The branch with the elbow on one side: a sign (eq. 131); none if the links do not span the
    /// distance of the wrist point by more than `slack`, relative to it.
    #[inline(always)]
    pub(super) fn with_elbow(&self, lengths: &Lengths, side: T, slack: f64) -> Branch<T> {
        self.branch(lengths, self.length_condition(lengths), side, slack)
    }

    /// The branch that meets the condition of axis 5, where the distance of the wrist point leaves
    /// the forearm undetermined; a sign chooses one of two.
    #[inline(always)]
    pub(super) fn with_axis_5(&self, lengths: &Lengths, side: T, slack: f64) -> Branch<T> {
        self.branch(lengths, self.axis_condition(lengths), side, slack)
    }

    /// The branch with the forearm along the unit vector with a given product with `factors`, on
    /// one side of them.
    #[inline(always)]
    fn branch(
        &self,
        lengths: &Lengths,
        ([x, y], wanted): ([T; 2], T),
        side: T,
        slack: f64,
    ) -> Branch<T> {
        let (zero, none) = (x.like(0.0), x.like(f64::INFINITY));
        let square = x.times_plus(x, y * y);
        let rest = square - wanted * wanted;
        let across = rest.or_more(zero).root() * side;
        let (cos, sin) = (wanted * x - across * y, wanted * y + across * x);
        let scale = cos.times_plus(cos, sin * sin).root().inverse();
        let (cos, sin) = (cos * scale, sin * scale);

        let Lengths { forearm, v: [v1, v2], .. } = *lengths;
        let ([of_cos, of_sin], wanted) = self.axis_condition(lengths);
        let off = of_cos.times_plus(cos, of_sin.times_plus(sin, -wanted));
        let off = (square * -slack).if_above(rest, none, off);
        let along = [cos.scaled_plus(v1, sin * -v2), sin.scaled_plus(v1, cos * v2)];
        Branch {
            off: square.if_above(zero, off, none),
            forearm: [cos, sin],
            shoulder: self.x1,
            elbow: [
                along[0].scaled_plus(-forearm, self.point[0]),
                along[1].scaled_plus(-forearm, self.point[1]),
            ],
        }
    }
}

impl<T: Number> Branch<T> {
    /// How far the upper arm is from having its length [m].
    #[inline(always)]
    pub(super) fn misses(&self, lengths: &Lengths) -> T {
        let [x, y] = self.elbow;
        (x.times_plus(x, y * y).root() - x.like(lengths.upper.abs())).size()
    }

    /// This branch where it is nearer to a solution, else another.
    #[inline(always)]
    pub(super) fn or_nearer(&self, other: &Self) -> Self {
        Self::where_above(other.off.size(), self.off.size(), self, other)
    }

    /// A branch where a number is above another, else another branch.
    #[inline(always)]
    pub(super) fn where_above(one: T, two: T, yes: &Self, no: &Self) -> Self {
        let mut chosen = *no;
        chosen.off = one.if_above(two, yes.off, no.off);
        for i in 0..2 {
            chosen.forearm[i] = one.if_above(two, yes.forearm[i], no.forearm[i]);
            chosen.shoulder[i] = one.if_above(two, yes.shoulder[i], no.shoulder[i]);
            chosen.elbow[i] = one.if_above(two, yes.elbow[i], no.elbow[i]);
        }
        chosen
    }

    /// Sines and cosines of all joints (eq. 132).
    #[inline(always)]
    pub(super) fn joints(
        &self,
        lengths: &Lengths,
        last: &Frame<T>,
        [s6, c6]: [T; 2],
        twists: &Twists,
    ) -> [[T; 6]; 2] {
        let Lengths { upper, s1, e, .. } = *lengths;
        let turn = s1 * e;
        let [c1, n1] = self.shoulder;
        let [cos, sin] = self.forearm;
        let scale = 1.0 / upper;
        let [x2, y2] = [self.elbow[0] * scale, self.elbow[1] * scale];
        // theta_2 and theta_2 + e theta_3 are angles in the plane, times s1.
        let second = [y2 * s1, x2];
        let third = [sin.times_minus(x2, cos * y2) * turn, cos.times_plus(x2, sin * y2)];
        // Axes of frame 3 in the shoulder frame.
        let zero = sin.like(0.0);
        let x3 = [cos * c1, cos * n1, sin];
        let y3 = [sin * c1 * -turn, sin * n1 * -turn, cos * turn];
        let z3 = [n1 * (e * s1), c1 * -(e * s1), zero];
        // Frame 5: frame 6 turned back by joint 6, with its twist removed.
        let (mut x5, mut z5) = (x3, x3);
        for i in 0..3 {
            let [x6, y6, z6] = last.rotation[i];
            x5[i] = c6.times_plus(x6, s6 * -y6);
            let across = s6.times_plus(x6, c6 * y6);
            z5[i] = across.scaled_plus(twists.sin_5, z6 * twists.cos_5);
        }
        let (sin_3, cos_3) = (zero.like(twists.sin_3), zero.like(twists.cos_3));
        let y3_turned = combined(y3, cos_3, z3, sin_3);
        // z5 = sin alpha_4 (sin theta_4 x3 - cos theta_4 y3') + ...
        let scale = 1.0 / twists.sin_4;
        let (s4, c4) = (dot(z5, x3) * scale, dot(z5, y3_turned) * -scale);
        let size = s4.times_plus(s4, c4 * c4).root().inverse();
        let (s4, c4) = (s4 * size, c4 * size);
        let x4 = combined(x3, c4, y3_turned, s4);
        let y4 = cross(z5, x4);
        let (s5, c5) = (dot(x5, y4), dot(x5, x4));
        [[n1, second[0], third[0], s4, s5, s6], [c1, second[1], third[1], c4, c5, c6]]
    }
}

#[inline(always)]
fn combined<T: Number>(a: [T; 3], x: T, b: [T; 3], y: T) -> [T; 3] {
    [a[0].times_plus(x, b[0] * y), a[1].times_plus(x, b[1] * y), a[2].times_plus(x, b[2] * y)]
}

/// The four branches of an arm for an angle of joint 6: shoulder and elbow on either side.
pub(super) const SIDES: [[f64; 2]; 4] = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
