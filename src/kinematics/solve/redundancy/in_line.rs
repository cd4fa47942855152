//! Joint vectors with several axes in one line: these joints turn about it, the sum of their angles
//! is fixed, and the others stand still. Of axes 1 and 3, this is at a single angle of joint 7, and
//! no sample of joint 7 meets it (docs/theory/spherical_shoulder.md, section 5).

use core::f64::consts::TAU;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::Search;
use super::descent::STEPS;
use super::free_joints::measured;
use super::samples::Samples;
use crate::error::Error;
use crate::kinematics::pose::Pose;
use crate::kinematics::solve::self_motion_curve::Joints;
use crate::kinematics::structure::spherical_shoulder::NEARLY_IN_LINE;

/// Distance of two axes [m], and sine of their angle [1], up to which they count as one line: to
/// rounding, and nearly.
const IN_LINE: [f64; 2] = [1e-7, NEARLY_IN_LINE];

/// How often an interval of forces is halved: to rounding.
const HALVINGS: u32 = 60;

impl Search<'_> {
    /// Search at the angles of joint 7 at which axes 1 and 3 may be in line.
    pub(super) fn at_singular_angles(&mut self) -> Result<(), Error> {
        let motions = self.robot.self_motions(self.pose);
        let angles = motions.map(|(motions, pose)| motions.singular_angles_of_joint_7(&pose));
        for angle in angles.into_iter().flatten().flatten() {
            let Some(q7) = self.robot.limits().turn_nearest(6, angle, self.seed[6]) else {
                continue;
            };
            let cost = self.weights[6] * (q7 - self.seed[6]).powi(2);
            if self.best.is_some_and(|(least, _)| cost >= least) {
                continue;
            }
            for sample in self.samples_at(q7)?.slots.into_iter().flatten() {
                self.turn_in_line(&sample.q)?;
            }
        }
        Ok(())
    }

    /// Search from the samples at an edge of reach, where the arm may be stretched along an axis.
    pub(super) fn at_edge(&mut self, samples: &Samples) -> Result<(), Error> {
        let free = samples.slots.iter().flatten().filter(|sample| sample.is_free);
        for sample in free.filter(|_| samples.are_named) {
            self.turn_in_line(&sample.q)?;
        }
        Ok(())
    }

    /// Turn joints whose axes are in line to where they are nearest to the seed, and descend from
    /// there.
    pub(super) fn turn_in_line(&mut self, q: &[f64; 7]) -> Result<(), Error> {
        for apart in IN_LINE {
            let Some(turned) = self.turned_in_line(q, apart) else { continue };
            self.samples(&turned)?;
            if let Some(start) = self.curve.nearest(&Joints::from(turned)) {
                self.descend(start, STEPS.first);
            }
            self.slide(self.sample(turned))?;
        }
        Ok(())
    }

    /// The nearest joint vector to the seed inside the limits with these sums of angles, but for
    /// whole turns; `None` if no axes are in line.
    fn turned_in_line(&self, q: &[f64; 7], apart: f64) -> Option<[f64; 7]> {
        let (frames, _) = self.robot.link_frames(q);
        let (mut turned, mut is_grouped, mut found) = (*q, [false; 7], false);
        for first in 0..6 {
            let signs = core::array::from_fn(|joint| {
                if joint < first || is_grouped[joint] {
                    return 0.0;
                }
                sign_in_line(&frames[first], &frames[joint], apart)
            });
            if signs.iter().filter(|sign| **sign != 0.0).count() < 2 {
                continue;
            }
            for (is_grouped, sign) in is_grouped.iter_mut().zip(&signs) {
                *is_grouped |= *sign != 0.0;
            }
            if let Some(nearest) = self.nearest_with_sum(&turned, &signs) {
                (turned, found) = (nearest, true);
            }
        }
        found.then_some(turned)
    }

    /// The joint vector nearest to the seed, inside the limits of the joints that have a sign, that
    /// differs in these joints alone and has the same sum of them, times their signs, but for whole
    /// turns.
    fn nearest_with_sum(&self, q: &[f64; 7], signs: &[f64; 7]) -> Option<[f64; 7]> {
        let off = (0..7).map(|joint| signs[joint] * (q[joint] - self.seed[joint])).sum::<f64>();
        let off = off - TAU * (off / TAU).round();
        let all = [off, off - TAU, off + TAU].map(|off| self.spread(q, signs, off));
        all.into_iter().flatten().min_by(|a, b| self.cost(a).total_cmp(&self.cost(b)))
    }

    /// The joints of the seed that have a sign, turned by a sum of angles so that this costs least:
    /// one force pushes them all, each against its weight, as far as its limits.
    fn spread(&self, q: &[f64; 7], signs: &[f64; 7], sum: f64) -> Option<[f64; 7]> {
        let (limits, weights) = (self.robot.limits().to_array(), measured(&self.weights));
        let pushed = |force: f64| -> [f64; 7] {
            core::array::from_fn(|joint| {
                let [low, high] = limits[joint];
                let wanted = self.seed[joint] + signs[joint] * force / weights[joint];
                if signs[joint] == 0.0 { q[joint] } else { wanted.clamp(low, high) }
            })
        };
        let left = |turned: &[f64; 7]| {
            let turn = |joint: usize| signs[joint] * (turned[joint] - self.seed[joint]);
            sum - (0..7).map(turn).sum::<f64>()
        };
        let most = weights.into_iter().fold(0.0, f64::max) * (sum.abs() + left(&pushed(0.0)).abs());
        let (mut low, mut high) = (-most, most);
        // Neither if every weight is zero.
        let is_between = left(&pushed(low)) >= 0.0 && left(&pushed(high)) <= 0.0;
        if !is_between {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *(if left(&pushed(middle)) > 0.0 { &mut low } else { &mut high }) = middle;
        }
        Some(pushed(high))
    }
}

/// The sign with which a joint turns about the line of another one's axis; 0 if its own is not in
/// line.
fn sign_in_line(one: &Pose, other: &Pose, apart: f64) -> f64 {
    let [z, other_z] = [one, other].map(|frame| frame.rotation.matrix().column(2).into_owned());
    let from = other.translation.vector - one.translation.vector;
    if z.cross(&other_z).norm() > apart || z.cross(&from).norm() > apart {
        return 0.0;
    }
    z.dot(&other_z).signum()
}
