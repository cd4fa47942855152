//! The last step of Newton's method in joint 6 alone: joints 1 to 3 follow it along their branch.
//!
//! Docs: offset_wrist.md, eq. 138 to 142.

use super::branch::Branch;
use super::geometry::Lengths;
use super::hand::Moving;
use crate::lanes::Number;

/// A branch after the step.
pub(super) struct Stepped<T> {
    pub(super) branch: Branch<T>,
    /// Sine and cosine of joint 6.
    pub(super) sin_cos_6: [T; 2],
    /// The size of the determinant of the geometric Jacobian before the step [m^3].
    pub(super) determinant: T,
}

impl<T: Number> Branch<T> {
    /// Turn joint 6 to where axis 5 has its angle from axis 4 (eq. 142). Not a number where
    /// the branch has no derivative.
    #[inline(always)]
    pub(super) fn stepped(
        &self,
        lengths: &Lengths,
        Moving { at: (point, axis_5), rates: (point_rate, axis_rate) }: &Moving<T>,
        [s6, c6]: [T; 2],
    ) -> Stepped<T> {
        let Lengths { forearm, v: [v1, v2], s1, e, cos_3, m, .. } = *lengths;
        let ([cos, sin], [er, eh]) = (self.forearm, self.elbow);
        let [sigma, aside] = facing(point, self.shoulder);
        let [sigma_rate, aside_rate] = facing(point_rate, self.shoulder);
        let [radial, sideways] = facing(axis_5, self.shoulder);
        let [radial_rate, sideways_rate] = facing(axis_rate, self.shoulder);
        // Eq. 138.
        let first = aside_rate / sigma;
        let r_rate = first.times_plus(aside, sigma_rate);
        let radial_rate = first.times_plus(sideways, radial_rate);
        let sideways_rate = sideways_rate - first * radial;
        // Eq. 139: the forearm, and a quarter turn on.
        let along = [cos.scaled_plus(v1, sin * -v2), sin.scaled_plus(v1, cos * v2)];
        let swing = (eh * along[0] - er * along[1]) * forearm;
        let h_rate = point_rate[2];
        let second = er.times_plus(r_rate, eh * h_rate) / swing;
        // Eq. 140.
        let turning = cos.times_plus(axis_rate[2], sin * -radial_rate);
        let turned = sin.times_plus(axis_5[2], cos * radial);
        let off_rate =
            sideways_rate.scaled_plus(-(s1 * e * cos_3), (turning - second * turned) * m);
        let step = -(self.off / off_rate);

        let (first, second) = (first * step, second * step);
        let lever = second * forearm;
        Stepped {
            branch: Branch {
                off: self.off,
                forearm: turned_by([cos, sin], second),
                shoulder: turned_by(self.shoulder, first),
                elbow: [
                    r_rate.times_plus(step, lever.times_plus(along[1], er)),
                    h_rate.times_plus(step, lever.times_plus(-along[0], eh)),
                ],
            },
            sin_cos_6: [c6.times_plus(step, s6), s6.times_plus(-step, c6)],
            determinant: (sigma * swing * off_rate).size(),
        }
    }
}

/// A direction, by cosine and sine, after a turn that has no square.
#[inline(always)]
fn turned_by<T: Number>([cos, sin]: [T; 2], turn: T) -> [T; 2] {
    [sin.times_plus(-turn, cos), cos.times_plus(turn, sin)]
}

/// The horizontal components of a vector, along x1 and y1.
#[inline(always)]
fn facing<T: Number>([x, y, _]: &[T; 3], [cos, sin]: [T; 2]) -> [T; 2] {
    [x.times_plus(cos, *y * sin), y.times_minus(cos, *x * sin)]
}
