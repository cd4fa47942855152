//! An arm that brings its wrist to where the pose requires it, and the uncertainty that rounding
//! leaves to it.

use nalgebra::Matrix3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::geometry::ThreeParallel;
use super::wrist::{PlaneUncertainty, Turn, Wrist, seen_from_plane, sin_5};
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::free_choice::SeedPolicy;
use crate::kinematics::structure::planar_arm::{Elbows, PlanarArm, Shoulder, Target};
use crate::kinematics::thresholds::{REACH_TOLERANCE, WRIST_FREE_SIN, WRIST_MERGE_SIN};
use crate::report::Reach;

/// A shoulder and a wrist with the elbows between them.
pub(super) struct Reaching {
    pub(super) shoulder: Shoulder,
    pub(super) wrist: Wrist,
    pub(super) elbows: Elbows,
    /// How far beyond reach the stretched or folded arm is [m].
    pub(super) beyond: f64,
}

/// Greatest rotation of axis 5 for which the elbows that it straightens count as one [rad]: beyond,
/// joint 6 is nearly free.
const MOST_STRAIGHTENING: f64 = 1e-2;

/// Bisections of the interval between a place where the arm reaches and one where it does not: to
/// rounding.
const HALVINGS: u32 = 50;

impl ThreeParallel {
    /// The arm with this shoulder and joint 6. If that is out of reach, what the pose leaves
    /// undetermined is moved towards reach: the plane of the arm, if the pose determines joint 6,
    /// and joint 6.
    pub(super) fn reaching(
        &self,
        shoulder: &Shoulder,
        turn: Turn,
        target: &Target<'_>,
    ) -> Result<Reaching, Reach> {
        let (missed, wrist) = match self.at(*shoulder, turn, target) {
            Ok(reaching) => return Ok(self.straightened(reaching, turn, target)),
            Err(missed) => missed,
        };
        let m = seen_from_plane(shoulder, target.rotation);
        let (reaching, missed) = match self.moved_into_reach(shoulder, turn, &m, &wrist, target) {
            Some(Ok(reaching)) => (Some(reaching), missed),
            Some(Err(nearest)) => (None, missed.nearer(nearest)),
            None => (None, missed),
        };
        reaching
            .or_else(|| self.in_another_plane(shoulder, turn, &m, (missed, wrist), target))
            .map(|reaching| self.straightened(reaching, turn, target))
            .ok_or(missed)
    }

    /// [`Self::reaching`], with an arm beyond reach by less than the tolerance stretched or folded.
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
            let beyond = missed.shortfall();
            let reaching = self.reaching(shoulder, turn, &target.beyond(beyond))?;
            Ok(Reaching { beyond, ..reaching })
        })
    }

    /// The stretched or folded arm in place of one whose two elbows differ by less than the
    /// uncertainty of the plane or of joint 6 (eq. 45). The arm is unchanged if they are two, and
    /// if joint 6 is nearly free, because each elbow then has a self-motion of its own. A path
    /// determines the elbow.
    fn straightened(&self, bent: Reaching, turn: Turn, target: &Target<'_>) -> Reaching {
        let Reaching { shoulder, elbows, .. } = &bent;
        let from_pose =
            matches!(turn, Turn::FromPose { .. }) && target.free.policy != SeedPolicy::Path;
        if !from_pose || elbows.behind.is_none() {
            return bent;
        }
        let m = seen_from_plane(shoulder, target.rotation);
        let (open, plane) = (turn.uncertainty(&m), PlaneUncertainty::of(self, shoulder, target));
        if sin_5(&m) <= WRIST_MERGE_SIN || plane.phi_uncertainty() > MOST_STRAIGHTENING {
            return bent;
        }
        let moved = self.planar.straightening(elbows.front.theta_3);
        if moved > self.d5 * open + plane.lever(self) {
            return bent;
        }
        // The edge in the middle of the range that is straight.
        let target = &target.beyond(target.tolerance - self.planar.position_rounding());
        let straight = self.straightened_by_six(&bent, open, target).or_else(|| {
            let rotated = |angle: f64| self.at(plane.rotated(angle), turn, target);
            plane.ends().into_iter().find_map(|end| {
                rotated(end).err()?;
                // A rounding of the plane may bend the arm again.
                let bent = at_edge(rotated, 0.0, end)?;
                if bent.elbows.behind.is_none() {
                    return Some(bent);
                }
                self.straightened_by_six(&bent, open, target)
            })
        });
        straight.unwrap_or(bent)
    }

    /// The arm with theta_6 moved to the edge of reach, by at most `open` [rad].
    fn straightened_by_six(
        &self,
        Reaching { shoulder, wrist, .. }: &Reaching,
        open: f64,
        target: &Target<'_>,
    ) -> Option<Reaching> {
        let m = seen_from_plane(shoulder, target.rotation);
        let rotated =
            |rotated: f64| self.at(*shoulder, Turn::Taken(wrist.theta_6 + rotated), target);
        let edges = self.circle(shoulder, wrist, target)?.edges();
        edges
            .map(|to_edge| rotated_with_phi(to_edge, &m))
            .into_iter()
            .filter(|to_edge| to_edge.abs() <= open)
            .filter_map(|to_edge| at_edge(rotated, 0.0, 2.0 * to_edge))
            .find(|reaching| reaching.elbows.behind.is_none())
    }

    /// The arm that is just out of reach with this shoulder, in the nearest plane within the
    /// uncertainty in which it reaches.
    fn in_another_plane(
        &self,
        shoulder: &Shoulder,
        turn: Turn,
        m: &Matrix3<f64>,
        (missed, wrist): (Reach, Wrist),
        target: &Target<'_>,
    ) -> Option<Reaching> {
        let plane = PlaneUncertainty::of(self, shoulder, target);
        if !matches!(turn, Turn::FromPose { .. }) || missed.shortfall() > plane.lever(self) {
            return None;
        }
        let nearest = |reaches: f64| {
            at_edge(|angle| self.at(plane.rotated(angle), turn, target), reaches, 0.0)
        };
        let ends = plane.ends().into_iter();
        let from_pose = self
            .middles_of_reach(shoulder, m, &wrist, target)
            .into_iter()
            .flatten()
            .filter_map(|theta_6| plane.determining(theta_6));
        ends.chain(from_pose).find_map(nearest)
    }

    /// The elbows for the end of the planar arm (eq. 37, 38), or how far it is out of reach.
    pub(super) fn at(
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
        match self.planar.elbows(end, target.tolerance, target.free_theta[1], target.free.policy) {
            Ok(elbows) => Ok(Reaching { shoulder, wrist, elbows, beyond: 0.0 }),
            Err(missed) => Err((missed, wrist)),
        }
    }

    /// The arm with theta_6 moved to where the end of the planar arm is in reach, or the distance
    /// that is missing there; `None` if that exceeds the uncertainty.
    fn moved_into_reach(
        &self,
        shoulder: &Shoulder,
        turn: Turn,
        m: &Matrix3<f64>,
        wrist: &Wrist,
        target: &Target<'_>,
    ) -> Option<Result<Reaching, Reach>> {
        let Circle { from_line, least, most } = self.circle(shoulder, wrist, target)?;
        let into_reach = from_line.abs().clamp(least, most).copysign(from_line) - from_line;
        if into_reach.abs() > turn.uncertainty(m) {
            return None;
        }
        let rotated = rotated_with_phi(into_reach, m);
        let at = |rotated: f64, target: &Target<'_>| {
            self.at(*shoulder, Turn::Taken(wrist.theta_6 + rotated), target)
        };
        // Rounding decides on which side of the edge that is, and bends the arm that is chosen
        // farther in.
        let inside = target.beyond(target.tolerance - self.planar.position_rounding());
        let mut ways = [(&inside, 1.0), (&inside, 2.0), (target, 1.0)].into_iter();
        let reaching = ways
            .find_map(|(target, far)| at_edge(|rotated| at(rotated, target), far * rotated, 0.0));
        match (reaching, at(rotated, target)) {
            (Some(reaching), _) => Some(Ok(reaching)),
            (None, Err((missed, _))) => Some(Err(missed)),
            (None, Ok(_)) => None,
        }
    }

    /// theta_6 in the middle of the range in reach on either side of the line to the wrist.
    fn middles_of_reach(
        &self,
        shoulder: &Shoulder,
        m: &Matrix3<f64>,
        wrist: &Wrist,
        target: &Target<'_>,
    ) -> Option<[f64; 2]> {
        let Circle { from_line, least, most } = self.circle(shoulder, wrist, target)?;
        let middle = 0.5 * (least + most);
        Some(
            [middle, -middle].map(|middle| wrist.theta_6 + rotated_with_phi(middle - from_line, m)),
        )
    }

    /// At sin theta_5 = 0 the end of the planar arm moves on a circle about the wrist (eq. 39).
    fn circle(&self, shoulder: &Shoulder, wrist: &Wrist, target: &Target<'_>) -> Option<Circle> {
        let from_axis_2 = [shoulder.x - self.planar.a1, target.wz];
        Circle::about(self, from_axis_2, [wrist.sin_phi, wrist.cos_phi], 0.0)
    }
}

/// The arm at the edge of reach between a place where it reaches and one where it does not, to
/// rounding.
fn at_edge<E>(
    at: impl Fn(f64) -> Result<Reaching, E>,
    mut reaches: f64,
    mut misses: f64,
) -> Option<Reaching> {
    let mut reaching = at(reaches).ok()?;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (misses + reaches);
        match at(middle) {
            Ok(nearer) => (reaching, reaches) = (nearer, middle),
            Err(_) => misses = middle,
        }
    }
    Some(reaching)
}

/// The rotation of theta_6 that corresponds to a rotation of phi: divided by -cos theta_5, because
/// phi + theta_6 is fixed at theta_5 = 0, phi - theta_6 at 180 deg.
fn rotated_with_phi(rotated: f64, m: &Matrix3<f64>) -> f64 {
    -rotated / m[(1, 1)]
}

/// Axis 5 on its way about the wrist: its angle from the line between axis 2 and the wrist, and
/// between which angles, on either side of the line, the end of the planar arm is in reach [rad].
pub(super) struct Circle {
    pub(super) from_line: f64,
    pub(super) least: f64,
    pub(super) most: f64,
}

impl Circle {
    /// About a wrist at (x, z) from axis 2, with the direction of axis 5, and the edges of reach
    /// `beyond` the arm's [m]; none where no place on it is nearer to axis 2 than another.
    pub(super) fn about(
        arm: &ThreeParallel,
        [x, z]: [f64; 2],
        [sin_phi, cos_phi]: [f64; 2],
        beyond: f64,
    ) -> Option<Self> {
        let PlanarArm { c2, k, .. } = arm.planar;
        let (size, both) = (x.hypot(z), 2.0 * arm.d5 * x.hypot(z));
        let cosine = |r: f64| ((size * size + arm.d5 * arm.d5 - r * r) / both).clamp(-1.0, 1.0);
        (both > 0.0).then(|| Self {
            from_line: wrap(sin_phi.atan2(cos_phi) - x.atan2(z)),
            least: cosine((c2 - k).abs() - beyond).acos(),
            most: cosine(c2 + k + beyond).acos(),
        })
    }

    /// How far axis 5 is from the edges of reach [rad].
    pub(super) fn edges(&self) -> [f64; 2] {
        [self.least, self.most].map(|edge| edge.copysign(self.from_line) - self.from_line)
    }
}
