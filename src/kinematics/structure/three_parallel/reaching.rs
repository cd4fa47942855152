//! An arm that brings its wrist to where the pose wants it, and what rounding leaves open of that.

use nalgebra::Matrix3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::ThreeParallel;
use super::plane::OpenPlane;
use super::wrist::{Turn, Wrist, seen_from_plane};
use crate::kinematics::answer::status::Reach;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::planar_arm::{Elbows, PlanarArm, Shoulder, Target};
use crate::kinematics::thresholds::{REACH_TOLERANCE, WRIST_FREE_SIN};

/// A shoulder and a wrist with the elbows between them.
pub(super) struct Reaching {
    pub(super) shoulder: Shoulder,
    pub(super) wrist: Wrist,
    pub(super) elbows: Elbows,
}

/// Halvings of the way between a plane in which the arm reaches and one in which it does not: to rounding.
const HALVINGS: u32 = 50;

impl ThreeParallel {
    /// The arm with this shoulder and joint 6 there; where that is out of reach, with what the pose leaves open moved towards reach: the plane
    /// of the arm, where joint 6 is told by the pose, and joint 6.
    pub(super) fn reaching(
        &self,
        shoulder: &Shoulder,
        turn: Turn,
        target: &Target<'_>,
    ) -> Result<Reaching, Reach> {
        let (missed, wrist) = match self.at(*shoulder, turn, target) {
            Ok(reaching) => {
                let straight = self.straightened(&reaching, turn, target);
                return Ok(straight.unwrap_or(reaching));
            }
            Err(missed) => missed,
        };
        let m = seen_from_plane(shoulder, target.rotation);
        if let Some(reaching) = self.in_another_plane(shoulder, turn, &m, (missed, wrist), target) {
            return Ok(reaching);
        }
        let Some(theta_6) = self.turned_into_reach(shoulder, turn, &m, &wrist, target) else {
            return Err(missed);
        };
        let nearer =
            |turned: Reach| if turned.shortfall() < missed.shortfall() { turned } else { missed };
        self.at(*shoulder, Turn::Taken(theta_6), target).map_err(|(turned, _)| nearer(turned))
    }

    /// The same where an arm less beyond reach than anyone could see is stretched or folded.
    pub(super) fn reaching_or_beyond(
        &self,
        shoulder: &Shoulder,
        turn: Turn,
        target: &Target<'_>,
    ) -> Result<Reaching, Reach> {
        self.reaching(shoulder, turn, target).or_else(|missed| {
            if missed.shortfall() > REACH_TOLERANCE {
                return Err(missed);
            }
            self.reaching(shoulder, turn, &target.beyond(missed.shortfall()))
        })
    }

    /// The stretched or folded arm in place of one whose two elbows differ by less than what rounding leaves open: of joint 6, a rounding over
    /// sin theta_5, or of the plane (eq. 45). None where they are two.
    fn straightened(&self, bent: &Reaching, turn: Turn, target: &Target<'_>) -> Option<Reaching> {
        let Reaching { shoulder, wrist, elbows } = bent;
        if !matches!(turn, Turn::Told { .. }) || elbows.behind.is_none() {
            return None;
        }
        let m = seen_from_plane(shoulder, target.rotation);
        let (open, plane) = (turn.open(&m), OpenPlane::of(self, shoulder, target));
        let moved = self.planar.straightening(elbows.front.theta_3);
        if moved > self.d5 * open + plane.lever(self) {
            return None;
        }
        // Where it is within a rounding beyond reach, it is straight.
        let rounding = 0.5 * self.planar.position_rounding();
        let edges = self.circle(shoulder, wrist, target, rounding)?;
        let taken = |turned: f64| self.at(*shoulder, Turn::Taken(wrist.theta_6 + turned), target);
        edges
            .turns()
            .map(|turned| turned_with_phi(turned, &m))
            .into_iter()
            .filter(|turned| turned.abs() <= open)
            .find_map(|turned| straight(taken(turned)))
            .or_else(|| {
                plane.ends().into_iter().find_map(|end| self.at_edge(&plane, end, turn, target))
            })
    }

    /// The straight arm in a plane between one in which it is bent and one at which it is out of reach.
    fn at_edge(
        &self,
        plane: &OpenPlane<'_>,
        end: f64,
        turn: Turn,
        target: &Target<'_>,
    ) -> Option<Reaching> {
        let at = |angle: f64| self.at(plane.turned(angle), turn, target);
        at(end).err()?;
        let (mut reaches, mut misses) = (0.0, end);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (reaches + misses);
            if at(middle).is_ok() {
                reaches = middle;
            } else {
                misses = middle;
            }
        }
        straight(at(reaches))
    }

    /// The arm that is just out of reach with this shoulder, in the nearest of the planes that rounding leaves open in which it reaches.
    fn in_another_plane(
        &self,
        shoulder: &Shoulder,
        turn: Turn,
        m: &Matrix3<f64>,
        (missed, wrist): (Reach, Wrist),
        target: &Target<'_>,
    ) -> Option<Reaching> {
        let plane = OpenPlane::of(self, shoulder, target);
        if !matches!(turn, Turn::Told { .. }) || missed.shortfall() > plane.lever(self) {
            return None;
        }
        let at = |angle: f64| self.at(plane.turned(angle), turn, target);
        let nearest = |reaches: f64| {
            let (mut misses, mut reaches, mut reaching) = (0.0, reaches, at(reaches).ok()?);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (misses + reaches);
                match at(middle) {
                    Ok(nearer) => (reaching, reaches) = (nearer, middle),
                    Err(_) => misses = middle,
                }
            }
            Some(reaching)
        };
        let ends = plane.ends().into_iter();
        let told = self
            .middles_of_reach(shoulder, m, &wrist, target)
            .into_iter()
            .flatten()
            .filter_map(|theta_6| plane.telling(theta_6));
        ends.chain(told).find_map(nearest)
    }

    /// The elbows of the end of the planar arm (eq. 37, 38), or how far it is out of reach.
    fn at(
        &self,
        shoulder: Shoulder,
        turn: Turn,
        target: &Target<'_>,
    ) -> Result<Reaching, (Reach, Wrist)> {
        let m = seen_from_plane(&shoulder, target.rotation);
        let wrist =
            turn.wrist(&m, target.free, target.free_theta[5], WRIST_FREE_SIN + shoulder.error);
        let end = [
            shoulder.x - self.planar.a1 - self.d5 * wrist.sin_phi,
            target.wz - self.d5 * wrist.cos_phi,
        ];
        match self.planar.elbows(end, target.tolerance, target.free_theta[1], target.free.trust) {
            Ok(elbows) => Ok(Reaching { shoulder, wrist, elbows }),
            Err(missed) => Err((missed, wrist)),
        }
    }

    /// theta_6 moved to where the end of the planar arm is in reach, or nearest to it; none where the pose does not leave it open so far.
    fn turned_into_reach(
        &self,
        shoulder: &Shoulder,
        turn: Turn,
        m: &Matrix3<f64>,
        wrist: &Wrist,
        target: &Target<'_>,
    ) -> Option<f64> {
        let Circle { from_line, least, most } = self.circle(shoulder, wrist, target, 0.0)?;
        let turned = from_line.abs().clamp(least, most).copysign(from_line) - from_line;
        (turned.abs() <= turn.open(m)).then_some(wrist.theta_6 + turned_with_phi(turned, m))
    }

    /// theta_6 in the middle of what is in reach on either side of the line to the wrist.
    fn middles_of_reach(
        &self,
        shoulder: &Shoulder,
        m: &Matrix3<f64>,
        wrist: &Wrist,
        target: &Target<'_>,
    ) -> Option<[f64; 2]> {
        let Circle { from_line, least, most } = self.circle(shoulder, wrist, target, 0.0)?;
        let middle = 0.5 * (least + most);
        Some([middle, -middle].map(|middle| wrist.theta_6 + turned_with_phi(middle - from_line, m)))
    }

    /// At sin theta_5 = 0 the end of the planar arm runs on a circle about the wrist (eq. 39). What is in reach, and this far beyond.
    fn circle(
        &self,
        shoulder: &Shoulder,
        wrist: &Wrist,
        target: &Target<'_>,
        beyond: f64,
    ) -> Option<Circle> {
        let PlanarArm { a1, c2, k, .. } = self.planar;
        let (x, z) = (shoulder.x - a1, target.wz);
        let (size, both) = (x.hypot(z), 2.0 * self.d5 * x.hypot(z));
        let cosine = |r: f64| ((size * size + self.d5 * self.d5 - r * r) / both).clamp(-1.0, 1.0);
        let from_line = wrap(wrist.sin_phi.atan2(wrist.cos_phi) - x.atan2(z));
        (both > 0.0).then(|| Circle {
            from_line,
            least: cosine(((c2 - k).abs() - beyond).max(0.0)).acos(),
            most: cosine(c2 + k + beyond).acos(),
        })
    }
}

/// Axis 5 on its way about the wrist: its angle from the line between axis 2 and the wrist, and between which angles, on either side of the
/// line, the end of the planar arm is in reach [rad].
struct Circle {
    from_line: f64,
    least: f64,
    most: f64,
}

impl Circle {
    /// How far to turn to the edges of reach [rad].
    fn turns(&self) -> [f64; 2] {
        [self.least, self.most].map(|edge| edge.copysign(self.from_line) - self.from_line)
    }
}

/// An arm that reaches and stands for both elbows.
fn straight<E>(reached: Result<Reaching, E>) -> Option<Reaching> {
    reached.ok().filter(|arm| arm.elbows.behind.is_none())
}

/// How far theta_6 turns where phi turns by this: by that over -cos theta_5, for phi + theta_6 is fixed at theta_5 = 0, phi - theta_6 at 180 deg.
fn turned_with_phi(turned: f64, m: &Matrix3<f64>) -> f64 {
    -turned / m[(1, 1)]
}
