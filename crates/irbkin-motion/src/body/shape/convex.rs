//! How far a capsule is from a convex shape whose nearest point to a point is known.

use nalgebra::Vector3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::capsule::{Capsule, Separation};
use super::segment::at;

/// Rounds in which the nearest point of an axis is found, at most.
const ROUNDS: u32 = 60;

/// How far off the square of a distance may be [m^2].
const SQUARE_OFF: f64 = 1e-14;

/// How far a capsule is from a convex shape. Along the axis the square of the distance is convex,
/// and its slope changes sign at the least one.
pub(super) fn of_convex(
    capsule: &Capsule,
    nearest: impl Fn(&Vector3<f64>) -> Vector3<f64>,
) -> Separation {
    let axis = capsule.ends[1] - capsule.ends[0];
    let look = |part: f64| {
        let from = at(&capsule.ends, part);
        let to = nearest(&from);
        (axis.dot(&(from - to)), from, to)
    };
    let (first, last) = (look(0.0), look(1.0));
    let mut best = if first.0 >= 0.0 { first } else { last };
    let mut rest = 0.0;
    if first.0 < 0.0 && last.0 > 0.0 {
        let (mut low, mut high, mut slopes) = (0.0, 1.0, [first.0, last.0]);
        for round in 0..ROUNDS {
            let part = if round % 2 == 0 {
                low - slopes[0] * (high - low) / (slopes[1] - slopes[0])
            } else {
                0.5 * (low + high)
            };
            best = look(part);
            // By convexity, the square is nowhere in between less by more than this.
            rest = 2.0 * best.0.abs() * (high - low);
            if rest <= SQUARE_OFF {
                break;
            }
            if best.0 < 0.0 {
                (low, slopes[0]) = (part, best.0);
            } else {
                (high, slopes[1]) = (part, best.0);
            }
        }
    }
    let (_, from, to) = best;
    let square = ((from - to).norm_squared() - rest).max(0.0);
    Separation::of_rounded(square.sqrt(), [from, to], [capsule.radius, 0.0])
}

/// The point of a box around the origin, of half that size, that is nearest to a point.
pub(super) fn nearest_of_box(half: &Vector3<f64>, point: &Vector3<f64>) -> Vector3<f64> {
    point.zip_map(half, |value, half| value.clamp(-half, half))
}

/// The point of a cylinder along z around the origin that is nearest to a point.
pub(super) fn nearest_of_cylinder(radius: f64, half: f64, point: &Vector3<f64>) -> Vector3<f64> {
    let across = point.x.hypot(point.y);
    let scale = if across > radius { radius / across } else { 1.0 };
    Vector3::new(scale * point.x, scale * point.y, point.z.clamp(-half, half))
}
