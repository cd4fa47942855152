//! The inverse: up to eight joint vectors of a wrist frame.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::ThreeParallel;
use super::reaching::Reaching;
use super::wrist::PlaneUncertainty;
use super::wrist::{Turn, Wrist, seen_from_plane, sin_5};
use crate::kinematics::answer::status::Status;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::branches::Branches;
use crate::kinematics::structure::free_choice::{FreeChoice, SeedPolicy};
use crate::kinematics::structure::planar_arm::{Elbow, Shoulder, Shoulders, Target};
use crate::kinematics::thresholds::{PATH_WRIST_SIN, WRIST_FREE_SIN, WRIST_MERGE_SIN};
use crate::report::FreeJoint;
use crate::report::Reach;

/// The shoulders to solve.
enum ShoulderChoice {
    Both,
    Front,
    Behind,
}

impl ShoulderChoice {
    fn of(merged: bool, policy: SeedPolicy) -> Self {
        match policy {
            SeedPolicy::Forced { behind: true, .. } => Self::Behind,
            SeedPolicy::Forced { behind: false, .. } => Self::Front,
            // On the cylinder of radius b both are one, x = 0.
            _ if merged => Self::Front,
            _ => Self::Both,
        }
    }
}

impl ThreeParallel {
    /// Every branch of the wrist frame `t_shoulder_wrist`.
    pub(super) fn solve_wrist(&self, t_shoulder_wrist: &Pose, free: &FreeChoice<6>) -> Branches<6> {
        let target = self.planar.target(t_shoulder_wrist, free, self.joint_map.theta(&free.q));
        match self.planar.shoulders(target.wxy, target.free_theta[0], free.policy) {
            Ok(shoulders) => self.branches(&shoulders, &target),
            Err(missed) => Branches::empty(missed),
        }
    }

    fn branches(
        &self,
        Shoulders { front, behind, merged, .. }: &Shoulders,
        target: &Target<'_>,
    ) -> Branches<6> {
        let mut branches = Branches::empty(Reach::Reached);
        let mut fill =
            |base: usize, shoulder: &Shoulder| self.fill(&mut branches, base, shoulder, target);
        branches.reach = match ShoulderChoice::of(*merged, target.free.policy) {
            ShoulderChoice::Front => fill(0, front),
            ShoulderChoice::Behind => fill(4, behind),
            ShoulderChoice::Both => {
                let reach = fill(0, front).nearer(fill(4, behind));
                self.drop_beyond(&mut branches, front);
                reach
            }
        };
        if *merged {
            branches.merge_shoulders(false, false);
        }
        branches
    }

    /// Drop an arm from beyond reach if the other shoulder reaches and, to the distance that the
    /// arm is beyond, is the same one.
    fn drop_beyond(&self, branches: &mut Branches<6>, shoulder: &Shoulder) {
        for slot in 0..8 {
            let (other, beyond) = (slot ^ 4, branches.beyond[slot]);
            if beyond > 0.0
                && branches.q[other].is_some()
                && branches.beyond[other] == 0.0
                && self.planar.is_one_shoulder(shoulder, beyond)
            {
                (branches.q[slot], branches.free[slot]) = (None, None);
                branches.flags[slot] |= Status::SHOULDER | Status::MERGED;
            }
        }
    }

    /// Fill slots `base` ..= `base` + 3 with the four branches of one shoulder.
    fn fill(
        &self,
        branches: &mut Branches<6>,
        base: usize,
        shoulder: &Shoulder,
        target: &Target<'_>,
    ) -> Reach {
        let (policy, free_6) = (target.free.policy, target.free_theta[5]);
        let [regular, flipped] = [false, true].map(|flipped| Turn::FromPose { flipped });
        let plane = PlaneUncertainty::of(self, shoulder, target);
        // A path keeps the joint 6 that it is heading for within the uncertainty of the plane.
        let shoulder = &if policy == SeedPolicy::Path
            && sin_5(&seen_from_plane(shoulder, target.rotation)) <= PATH_WRIST_SIN
        {
            plane.nearest_to_determining(free_6)
        } else {
            *shoulder
        };
        let m = seen_from_plane(shoulder, target.rotation);
        let sin_5 = sin_5(&m);
        let (nearest, least_sin_5) = plane.nearest_to_wrist(target);
        if policy.forces(6) {
            let determining =
                plane.determining(free_6).map_or(nearest, |angle| plane.rotated(angle));
            return self.put_merged(
                branches,
                base,
                self.reaching_or_beyond(&determining, Turn::Taken(free_6), target),
            );
        }
        if least_sin_5 <= policy.radius().max(WRIST_FREE_SIN) {
            return self.put_merged(
                branches,
                base,
                self.reaching_or_beyond(&nearest, Turn::Free(free_6), target),
            );
        }
        if sin_5 <= WRIST_MERGE_SIN {
            // One self-motion: of its two members that the pose determines, the one nearer to the
            // free angle, if it reaches.
            let away = (m[(1, 2)].atan2(m[(1, 0)]) - free_6).cos() < 0.0;
            let (near, far) = if away { (flipped, regular) } else { (regular, flipped) };
            let reaching = self.reaching(shoulder, near, target).or_else(|missed| {
                self.reaching(shoulder, far, target)
                    .or_else(|_| self.reaching_or_beyond(shoulder, near, target))
                    .or_else(|_| self.reaching_or_beyond(shoulder, far, target))
                    .map_err(|other| missed.nearer(other))
            });
            return self.put_merged(branches, base, reaching);
        }
        let missed = [(regular, base), (flipped, base + 1)].map(|(turn, slot)| {
            match self.reaching_or_beyond(shoulder, turn, target) {
                Ok(reaching) => {
                    self.put(branches, slot, &reaching, Status::empty());
                    Reach::Reached
                }
                Err(missed) => missed,
            }
        });
        missed[0].nearer(missed[1])
    }

    /// The branches of a wrist whose flip belongs to the same self-motion.
    fn put_merged(
        &self,
        branches: &mut Branches<6>,
        base: usize,
        reaching: Result<Reaching, Reach>,
    ) -> Reach {
        let reaching = match reaching {
            Ok(reaching) => reaching,
            Err(missed) => return missed,
        };
        let (kept, flipped) =
            if reaching.wrist.theta_5 < 0.0 { (base + 1, base) } else { (base, base + 1) };
        self.put(branches, kept, &reaching, Status::WRIST);
        for elbow in [0, 2] {
            branches.flags[flipped + elbow] = branches.flags[kept + elbow] | Status::MERGED;
            if reaching.wrist.theta_5.sin().abs() <= WRIST_MERGE_SIN {
                for slot in [kept, flipped] {
                    branches.free[slot + elbow] = Some(FreeJoint::Parallel);
                }
            }
        }
        Reach::Reached
    }

    /// Put both elbows of an arm into `slot` and `slot` + 2.
    fn put(&self, branches: &mut Branches<6>, slot: usize, reaching: &Reaching, flags: Status) {
        let Reaching { shoulder, wrist, elbows, beyond } = reaching;
        branches.beyond[slot] = *beyond;
        let flags = if elbows.behind.is_none() { flags | Status::ELBOW } else { flags };
        (branches.flags[slot], branches.flags[slot + 2]) = (flags, flags);
        branches.q[slot] = Some(self.joints(shoulder, &elbows.front, wrist));
        match &elbows.behind {
            Some(behind) => branches.q[slot + 2] = Some(self.joints(shoulder, behind, wrist)),
            None => branches.flags[slot + 2] |= Status::MERGED,
        }
        if elbows.free {
            let upper = FreeJoint::upper(self.joint_map.coupling);
            (branches.free[slot], branches.free[slot + 2]) = (Some(upper), Some(upper));
        }
    }

    pub(super) fn joints(&self, shoulder: &Shoulder, elbow: &Elbow, wrist: &Wrist) -> [f64; 6] {
        let theta_1 = shoulder.sin_1.atan2(shoulder.cos_1);
        // phi - theta_23 (eq. 40)
        let sin_4 = wrist.sin_phi * elbow.cos_23 - wrist.cos_phi * elbow.sin_23;
        let cos_4 = wrist.cos_phi * elbow.cos_23 + wrist.sin_phi * elbow.sin_23;
        self.joint_map.joints([
            theta_1,
            elbow.theta_2,
            elbow.theta_3,
            sin_4.atan2(cos_4),
            wrist.theta_5,
            wrist.theta_6,
        ])
    }
}
