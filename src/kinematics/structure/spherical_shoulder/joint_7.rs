//! Self-motions, and joint 7: the angles at which an elbow or a wrist is at the edge of its reach,
//! and those at which axes 1 and 3 may be in line (docs/theory/spherical_shoulder.md, section 5).

use core::f64::consts::{FRAC_PI_4, PI};

use nalgebra::Vector3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::SphericalShoulder;
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::family::{Family, Following, about_y, turned_back, y_to_z};
use crate::kinematics::structure::self_motions::{
    EDGES, MOST_ANGLES, SINGULAR_ANGLES, SelfMotions,
};
use crate::kinematics::thresholds::{FORM_TOLERANCE, ROTATION_ROUNDING, TOUCHING};
use crate::report::FreeJoint;

/// Distance of two axes [m], and sine of their angle [1], up to which the curve of self-motion is
/// found from where they would be in line. Farther off, samples of joint 7 are bisected where the
/// joints turn.
pub(crate) const NEARLY_IN_LINE: f64 = 3e-3;

/// A length, a cosine, or the square of a length that changes with joint 7: `mean + cos
/// cos(theta_7) + sin sin(theta_7)` (eq. 69, 70).
#[derive(Clone, Copy)]
struct Wave {
    mean: f64,
    cos: f64,
    sin: f64,
}

impl Wave {
    const ZERO: Self = Self::constant(0.0);

    const fn constant(mean: f64) -> Self {
        Self { mean, cos: 0.0, sin: 0.0 }
    }

    /// `direction . Rz(theta_7) point + constant`
    fn of(direction: &Vector3<f64>, point: &Vector3<f64>, constant: f64) -> Self {
        Self {
            mean: direction.z * point.z + constant,
            cos: direction.x * point.x + direction.y * point.y,
            sin: direction.y * point.x - direction.x * point.y,
        }
    }

    /// The value at an angle of this sine and cosine.
    fn at(&self, (sin, cos): (f64, f64)) -> f64 {
        self.mean + self.cos * cos + self.sin * sin
    }

    fn plus(&self, factor: f64, other: &Self) -> Self {
        Self {
            mean: self.mean + factor * other.mean,
            cos: self.cos + factor * other.cos,
            sin: self.sin + factor * other.sin,
        }
    }

    /// Measure angles from `start`.
    fn from(&self, start: f64) -> Self {
        let (sin, cos) = start.sin_cos();
        Self {
            mean: self.mean,
            cos: self.cos * cos + self.sin * sin,
            sin: self.sin * cos - self.cos * sin,
        }
    }

    /// Over `(1 + t^2)`, with `t = tan(theta_7 / 2)`: the coefficients of a parabola, constant
    /// first.
    fn parabola(&self) -> [f64; 3] {
        [self.mean + self.cos, 2.0 * self.sin, self.mean - self.cos]
    }

    /// The two angles at which it has a value (eq. 71); the same angle twice if the value is just
    /// missed.
    fn angles_at(&self, value: f64) -> [Option<f64>; 2] {
        let (size, phase) = (self.cos.hypot(self.sin), self.sin.atan2(self.cos));
        // The square of the sine of half the angle from the phase: near the phase a cosine is ill
        // conditioned.
        let part = (self.mean + size - value) / (2.0 * size);
        if !(-TOUCHING..=1.0 + TOUCHING).contains(&part) {
            return [None; 2];
        }
        let part = part.clamp(0.0, 1.0);
        let half = part.sqrt().atan2((1.0 - part).sqrt());
        [Some(phase + 2.0 * half), Some(phase - 2.0 * half)]
    }
}

impl SelfMotions<7> for SphericalShoulder {
    fn with_family(
        &self,
        t_shoulder_seven: &Pose,
        [q, rest]: [&[f64; 7]; 2],
        free: FreeJoint,
        search: &mut dyn FnMut(&dyn Family<7>),
    ) {
        let hand = *self.hand(t_shoulder_seven, q[6]).rotation.matrix();
        let theta = self.theta(q);
        let [_, _, _, theta_4, theta_5, theta_6, _] = theta;
        let (free, left, right) = match free {
            FreeJoint::Forearm => (4, hand * about_y(-theta_6), about_y(-theta_4)),
            FreeJoint::Hand => {
                let seen = turned_back(theta_5, &about_y(-theta_4));
                (5, hand * y_to_z().transpose(), y_to_z() * seen)
            }
            _ => return,
        };
        let (map, rest) = (&self.joint_map, self.theta(rest)[0]);
        search(&Following { map, theta, free, first: 0, left, right, rest, bit: 4 });
    }

    fn rounding(&self) -> Option<f64> {
        Some(self.links.position_rounding().max(ROTATION_ROUNDING))
    }

    fn edges_of_joint_7(&self, t_shoulder_seven: &Pose) -> [Option<f64>; EDGES] {
        let links = &self.links;
        let (upper2, forearm2) = (links.upper * links.upper, links.forearm * links.forearm);
        let (reach2, along_6) = self.waves(t_shoulder_seven);
        let mut edges = [None; EDGES];
        let (of_elbow, of_wrist) = edges.split_at_mut(4);
        // Stretched and folded.
        for (edges, reach) in
            of_elbow.chunks_mut(2).zip([links.upper + links.forearm, links.upper - links.forearm])
        {
            edges.copy_from_slice(&reach2.angles_at(reach * reach));
        }
        // The wrists merge (eq. 73).
        let cosine = reach2.plus(-1.0, &Wave::constant(upper2 + forearm2));
        let cosine = Wave::ZERO.plus(0.5 / (links.upper * links.forearm), &cosine);
        let tilt = Wave::constant(links.a4).plus(links.a4 * links.upper / links.forearm, &cosine);
        let radius = Wave::constant(links.c5);
        for (edges, side) in of_wrist.chunks_mut(MOST_ANGLES).zip([1.0, -1.0]) {
            let first = Wave::ZERO.plus(links.forearm / links.upper, &tilt.plus(side, &along_6));
            let second = Wave::ZERO.plus(links.c5, &cosine);
            edges.copy_from_slice(&angles_of(&[
                (1.0, first, first),
                (1.0, second, second),
                (-1.0, radius, radius),
            ]));
        }
        edges.map(|theta| self.joint_7(theta))
    }

    fn singular_angles_of_joint_7(
        &self,
        t_shoulder_seven: &Pose,
    ) -> [Option<f64>; SINGULAR_ANGLES] {
        let links = &self.links;
        let (reach2, along_6) = self.waves(t_shoulder_seven);
        // n, Z, yw and K of eq. 73a to 73c: lean, height, across and half.
        let axis_1 = t_shoulder_seven.rotation.inverse_transform_vector(&Vector3::z());
        let t_hand_seven = self.t_seven_hand.inverse();
        let (turn, shift) = (t_hand_seven.rotation.matrix(), t_hand_seven.translation.vector);
        let lean = Wave::of(&turn.row(1).transpose(), &axis_1, 0.0);
        let height = t_shoulder_seven.translation.vector.z;
        let height = Wave::of(&-turn.tr_mul(&shift), &axis_1, height);
        let across = Wave::ZERO.plus(-1.0, &along_6);
        let squares = links.forearm * links.forearm - links.upper * links.upper;
        let half = Wave::ZERO.plus(0.5, &reach2.plus(-1.0, &Wave::constant(squares)));
        let [sine, cosine] = links.psi.map(|part| links.product() * part);
        let nearly = NEARLY_IN_LINE * links.upper * (links.upper + links.forearm);
        let mut singular = [None; SINGULAR_ANGLES];
        for (singular, up) in singular.chunks_mut(MOST_ANGLES).zip([1.0, -1.0]) {
            let [lean, height] = [&lean, &height].map(|wave| Wave::ZERO.plus(up, wave));
            let straight = Wave::ZERO.plus(links.c5, &across).plus(-cosine, &lean);
            let half = half.plus(-links.c3, &height);
            if links.a3.abs().max(links.a4.abs()) <= FORM_TOLERANCE {
                singular[..2].copy_from_slice(&straight.angles_at(0.0));
            } else {
                let along = Wave::ZERO.plus(sine, &height).plus(links.a4, &reach2);
                let aside = Wave::constant(sine).plus(links.a4, &height);
                singular.copy_from_slice(&angles_of(&[
                    (1.0, half, straight),
                    (links.a3, lean, along),
                    (-links.a3, across, aside),
                ]));
            }
            // The forearm must reach, too (eq. 73a).
            let reaches = |theta: &f64| {
                let [half, reach2, height] =
                    [half, reach2, height].map(|wave| wave.at(theta.sin_cos()));
                let wide = (reach2 - height * height).max(0.0).sqrt();
                (half.abs() - (links.a3 * wide).abs()).abs() <= nearly
            };
            for angle in singular {
                *angle = self.joint_7(angle.filter(reaches));
            }
        }
        singular
    }
}

impl SphericalShoulder {
    fn joint_7(&self, theta: Option<f64>) -> Option<f64> {
        let (sign, offset) = (self.joint_map.signs[6], self.joint_map.offsets[6]);
        theta.map(|theta| wrap(sign * (theta + offset)))
    }

    /// The square of the distance of the shoulder from the intersection of axes 5 and 6 (eq. 69)
    /// [m^2], and its coordinate along axis 6 (eq. 70) [m].
    fn waves(&self, t_shoulder_seven: &Pose) -> (Wave, Wave) {
        let shoulder = -t_shoulder_seven
            .rotation
            .inverse_transform_vector(&t_shoulder_seven.translation.vector);
        let t_hand_seven = self.t_seven_hand.inverse();
        let (turn, shift) = (t_hand_seven.rotation.matrix(), t_hand_seven.translation.vector);
        let reach2 = Wave::of(
            &(2.0 * turn.tr_mul(&shift)),
            &shoulder,
            shoulder.norm_squared() + shift.norm_squared(),
        );
        (reach2, Wave::of(&turn.row(1).transpose(), &shoulder, shift.y))
    }
}

/// A factor and two waves, which are multiplied.
type Product = (f64, Wave, Wave);

/// The angles at which a sum of products is zero, and those at which it just touches zero.
fn angles_of(sum: &[Product]) -> [Option<f64>; MOST_ANGLES] {
    let parts = |theta: f64| {
        let at = theta.sin_cos();
        sum.iter().map(move |(factor, a, b)| factor * a.at(at) * b.at(at))
    };
    let off = |theta: f64| parts(theta).sum::<f64>();
    // Angles are measured from opposite to where the sum is largest: the tangent of half the angle
    // stays small.
    let eighths = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0].map(|eighth| {
        let theta = eighth * FRAC_PI_4;
        (off(theta).abs(), theta)
    });
    let (_, far) = eighths.into_iter().fold((0.0, 0.0), |a, b| if b.0 > a.0 { b } else { a });
    let start = far + PI;
    let mut quartic = [0.0; 5];
    for (factor, a, b) in sum {
        let [a, b] = [a, b].map(|wave| wave.from(start).parabola());
        for (power, coefficient) in quartic.iter_mut().enumerate() {
            let lowest = power.saturating_sub(2);
            *coefficient +=
                (lowest..=power.min(2)).map(|i| factor * a[i] * b[power - i]).sum::<f64>();
        }
    }
    let places = places(&quartic);
    let angle = |t: f64| start + 2.0 * t.atan();
    let size = parts(far).map(f64::abs).sum::<f64>();
    let mut found = [None; MOST_ANGLES];
    let (zeros, touching) = found.split_at_mut(4);
    zeros.copy_from_slice(&places.zeros.map(|t| t.map(angle)));
    touching.copy_from_slice(
        &places.stationary.map(|t| t.map(angle).filter(|at| off(*at).abs() <= TOUCHING * size)),
    );
    found
}

/// Maximum number of steps in which a bracketed zero is found to rounding: at least every second
/// one halves the bracket.
const ROUNDS: u32 = 120;

/// The zeros and the stationary points of a quartic, in ascending order.
pub(super) struct Places {
    pub(super) zeros: [Option<f64>; 4],
    pub(super) stationary: [Option<f64>; 3],
}

/// The zeros and stationary points of the quartic with these coefficients, constant first: the
/// zeros of each derivative separate the zeros of the previous one. Radicals are avoided: they lose
/// half of the digits near a double zero.
pub(super) fn places(quartic: &[f64; 5]) -> Places {
    let [_, a, b, c, d] = *quartic;
    let inflection = zeros::<1>(&[6.0 * c, 24.0 * d], &[]);
    let bends = zeros::<2>(&[2.0 * b, 6.0 * c, 12.0 * d], &inflection);
    let stationary = zeros::<3>(&[a, 2.0 * b, 3.0 * c, 4.0 * d], &bends);
    Places { zeros: zeros::<4>(quartic, &stationary), stationary }
}

/// The zeros of a polynomial, constant first, separated by its stationary points.
fn zeros<const N: usize>(polynomial: &[f64], stationary: &[Option<f64>]) -> [Option<f64>; N] {
    let mut found = [None; N];
    let bound = bound(polynomial);
    let ends = stationary.iter().flatten().copied().chain([bound]);
    let mut low = -bound;
    for (place, high) in found.iter_mut().zip(ends) {
        *place = zero_between(polynomial, low, high);
        low = high;
    }
    found
}

/// Upper bound of the size of a zero (Cauchy).
fn bound(polynomial: &[f64]) -> f64 {
    let Some((leading, others)) = polynomial.split_last() else { return 0.0 };
    1.0 + others.iter().map(|other| (other / leading).abs()).fold(0.0, f64::max)
}

/// Newton's method in a bracket that is halved if a step leaves it or gains too little.
fn zero_between(polynomial: &[f64], mut low: f64, mut high: f64) -> Option<f64> {
    let (at_low, at_high) = (value(polynomial, low).0, value(polynomial, high).0);
    if !(at_low * at_high <= 0.0 && low < high) {
        return None;
    }
    let rising = at_low < 0.0 || at_high > 0.0;
    let mut at = 0.5 * (low + high);
    for round in 0..ROUNDS {
        let (here, slope) = value(polynomial, at);
        *(if (here > 0.0) == rising { &mut high } else { &mut low }) = at;
        let newton = at - here / slope;
        let middle = 0.5 * (low + high);
        let next = if round % 2 == 0 && newton > low && newton < high { newton } else { middle };
        if (next - at).abs() <= f64::EPSILON * at.abs() || !next.is_finite() {
            break;
        }
        at = next;
    }
    Some(at)
}

/// Value and slope, by Horner's scheme.
fn value(polynomial: &[f64], at: f64) -> (f64, f64) {
    polynomial
        .iter()
        .rev()
        .fold((0.0, 0.0), |(value, slope), next| (value * at + next, slope * at + value))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The quartic with these zeros.
    fn with_zeros(zeros: [f64; 4]) -> [f64; 5] {
        let mut quartic = [1.0, 0.0, 0.0, 0.0, 0.0];
        for zero in zeros {
            for power in (0..5).rev() {
                let before = if power > 0 { quartic[power - 1] } else { 0.0 };
                quartic[power] = before - zero * quartic[power];
            }
        }
        quartic
    }

    #[test]
    fn every_zero_is_found() {
        for zeros in [
            [-2.0, -0.5, 0.25, 3.0],
            [-1e3, -1.0, 1.0, 1e3],
            [-1.0, 0.5, 0.5 + 1e-5, 2.0],
            [-1.0, -1.0 + 1e-6, 1.0 - 1e-6, 1.0],
        ] {
            let found = places(&with_zeros(zeros)).zeros;
            for (found, zero) in found.iter().zip(zeros) {
                // Two zeros at a distance d are known to rounding over d.
                assert!((found.unwrap() - zero).abs() < 1e-9 * zero.abs(), "{zeros:?} {found:?}");
            }
        }
    }

    #[test]
    fn a_quartic_without_zeros_has_none_and_is_stationary_once_or_thrice() {
        let found = places(&[1.0, 0.0, 1.0, 0.0, 1.0]);
        assert!(found.zeros.iter().all(Option::is_none));
        assert!(found.stationary.iter().flatten().any(|at| at.abs() < 1e-15));
        let touching = places(&with_zeros([-1.0, -1.0, 2.0, 2.0])).stationary;
        let at = |place: f64| touching.iter().flatten().any(|at| (at - place).abs() < 1e-14);
        assert!(at(-1.0) && at(0.5) && at(2.0), "{touching:?}");
    }
}
