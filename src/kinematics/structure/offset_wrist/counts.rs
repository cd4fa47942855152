//! How many solutions are in an interval of joint 6, branch by branch.
//!
//! Docs: offset_wrist.md, eq. 145 to 149.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::branch::{Plane, SIDES, SLACK};
use super::geometry::Constants;
use super::hand::{Hand, Moving};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::thresholds::REACH_TOLERANCE;
use crate::lanes::sin_cos;

/// Part of its rate by which the condition of axis 5 may change for one solution to be certain [1]:
/// the rest is for rounding.
const CERTAIN: f64 = 0.5;

/// Parts of an interval in which a branch is decided, if it is not as a whole: an odd number, for
/// structured poses have their solutions in the middle.
const PARTS: [u8; 2] = [1, 9];

/// Distance of the wrist point from axes 1 and 2 from which on the branches are apart, relative to
/// the lengths of the arm [1]: next to them solutions are left of self-motions.
const APART: f64 = 1e-2;

impl Constants {
    /// The most solutions at angles of joint 6 as near to one [rad] as a radius; `None` if a branch
    /// is undecided.
    pub(super) fn most_near(&self, last: &Frame, angle: f64, radius: f64) -> Option<usize> {
        let on =
            |sides| PARTS.iter().find_map(|parts| self.runs(last, angle, radius, sides, *parts));
        SIDES.map(on).into_iter().sum()
    }

    /// Whether the four branches are apart at angles of joint 6 as near to one [rad] as a radius: the
    /// wrist point is neither on axis 1 nor on axis 2.
    pub(super) fn are_apart(&self, last: &Frame, angle: f64, radius: f64) -> bool {
        let lengths = &self.lengths;
        let (sin, cos) = sin_cos::<false>(angle);
        let ([x, y, h], _) = Hand::of(lengths, last).at([sin, cos]);
        let across = x.hypot(y);
        let (sigma, [_, _, rate]) = (self.aside(across), self.rates(across, radius));
        let distances = [1.0, -1.0].map(|side| (side * sigma - lengths.a1).hypot(h));
        let least = distances.into_iter().fold(across - lengths.b.abs(), f64::min);
        // False where there is no number.
        least > APART * lengths.extent + rate * radius
    }

    /// How far the wrist point is from axis 1 aside from its part along axes 2 and 3 (eq. 122).
    pub(super) fn aside(&self, across: f64) -> f64 {
        let b = self.lengths.b;
        ((across - b) * (across + b)).max(0.0).sqrt()
    }

    /// That distance at least at angles of joint 6 as near as a radius, the most rate of axis 1, and
    /// of the wrist point in the plane of the arm (eq. 145).
    fn rates(&self, across: f64, radius: f64) -> [f64; 3] {
        let (b, w) = (self.lengths.b.abs(), self.lengths.circle);
        let nearest = self.aside((across - w * radius).max(b));
        let first = w / nearest;
        [nearest, first, w + if b == 0.0 { 0.0 } else { first * b }]
    }

    /// The runs of parts in which the condition of axis 5 is monotonic on a branch: as many solutions
    /// at most, for its rate keeps its sign from one part to the next.
    fn runs(
        &self,
        last: &Frame,
        angle: f64,
        radius: f64,
        sides: [f64; 2],
        parts: u8,
    ) -> Option<usize> {
        let (mut most, mut before) = (0, 0);
        let half = radius / f64::from(parts);
        for part in 0..parts {
            let place = 2.0 * f64::from(part) + 1.0 - f64::from(parts);
            let (sin, cos) = sin_cos::<false>(angle + half * place);
            let hand = Hand::of(&self.lengths, last).moving([sin, cos]);
            let here = self.most_on(&hand, [sin, cos], half, sides)?;
            (most, before) = (most + here.saturating_sub(before), here);
        }
        Some(most)
    }

    /// The most on one branch: none where the links do not span the distance of the wrist point, one
    /// where the condition of axis 5 is monotonic.
    fn most_on(
        &self,
        hand: &Moving<f64>,
        sin_cos_6: [f64; 2],
        radius: f64,
        [shoulder, elbow]: [f64; 2],
    ) -> Option<usize> {
        let lengths = &self.lengths;
        let (b, w, forearm) = (lengths.b.abs(), lengths.circle, lengths.forearm);
        let upper = lengths.upper.abs();
        let ([x, y, h], _) = hand.at;
        let across = x.hypot(y);
        let (sigma, [nearest, first, rate]) = (self.aside(across), self.rates(across, radius));
        let distance = (shoulder * sigma - lengths.a1).hypot(h);
        let ends = [distance - rate * radius, distance + rate * radius];
        let [shortest, longest] = lengths.span();
        if ends[0] > longest + REACH_TOLERANCE || ends[1] < shortest - REACH_TOLERANCE {
            return Some(0);
        }
        // Eq. 146: L1 L2 times the sine of the angle at the elbow is least at an end.
        let swing = |distance: f64| {
            let square = distance * distance;
            0.5 * ((longest * longest - square) * (square - shortest * shortest)).max(0.0).sqrt()
        };
        let least = swing(ends[0].max(0.0)).min(swing(ends[1]));
        if least <= 0.0 || nearest <= 0.0 {
            return None;
        }
        let second = upper * rate / least;
        // Eq. 147: their derivatives.
        let first_rate = (w + first * (w + rate)) / nearest;
        let bend = w * (1.0 + first) + first_rate * b;
        let of_elbow = rate + forearm * second;
        let second_rate = (of_elbow * (rate + second * forearm)
            + upper * (bend + second * second * forearm))
            / least;
        // Eq. 148.
        let turn = first + second;
        let most = first_rate + second_rate + first * second + (1.0 + turn) * (1.0 + turn);
        let branch = Plane::of(lengths, hand.at, shoulder).with_elbow(lengths, elbow, SLACK);
        let determinant = branch.stepped(lengths, hand, sin_cos_6).determinant;
        // Eq. 149; false where there is no number.
        (CERTAIN * determinant > most * radius * sigma * swing(distance)).then_some(1)
    }
}
