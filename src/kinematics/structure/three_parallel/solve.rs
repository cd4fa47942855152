//! The inverse: up to eight joint vectors of a wrist frame.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::ThreeParallel;
use super::plane::OpenPlane;
use super::reaching::Reaching;
use super::wrist::{Turn, Wrist, seen_from_plane, sin_5};
use crate::kinematics::answer::status::Status;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::branches::Branches;
use crate::kinematics::structure::free_choice::{FreeChoice, Trust};
use crate::kinematics::structure::planar_arm::{Elbow, Shoulder, Shoulders, Target};
use crate::kinematics::thresholds::{WRIST_FREE_SIN, WRIST_MERGE_SIN};
use crate::report::FreeJoint;
use crate::report::Reach;

impl ThreeParallel {
    /// Every branch of the wrist frame `t_shoulder_wrist`.
    pub(super) fn solve_wrist(&self, t_shoulder_wrist: &Pose, free: &FreeChoice<6>) -> Branches<6> {
        let free_theta = self.placement.theta(&free.q);
        self.planar.solve(t_shoulder_wrist, free, free_theta, |shoulders, target| {
            self.branches(shoulders, target)
        })
    }

    fn branches(&self, shoulders: &Shoulders, target: &Target<'_>) -> Branches<6> {
        let mut branches = Branches::empty(Reach::Reached);
        let Shoulders { front, behind, merged, .. } = shoulders;
        let mut reach: Option<Reach> = None;
        for asked in self.asked(shoulders, target) {
            for (side, shoulder) in
                [front, behind].into_iter().enumerate().filter(|(side, _)| asked[*side])
            {
                let filled = self.fill(&mut branches, 4 * side, shoulder, target);
                reach =
                    reach.filter(|reach| reach.shortfall() <= filled.shortfall()).or(Some(filled));
            }
            if reach == Some(Reach::Reached) {
                break;
            }
        }
        branches.reach = reach.unwrap_or(Reach::Reached);
        if *merged {
            let (sin_1, cos_1) = target.free_theta[0].sin_cos();
            let off = |shoulder: &Shoulder| (shoulder.sin_1 * cos_1 - shoulder.cos_1 * sin_1).abs();
            branches.merge_shoulders(
                target.free.trust != Trust::Pose && off(behind) < off(front),
                false,
            );
        }
        branches
    }

    /// Which shoulders are asked, in front and behind; and which in their place where those do not reach.
    fn asked(
        &self,
        Shoulders { front, behind, merged, .. }: &Shoulders,
        target: &Target<'_>,
    ) -> [[bool; 2]; 2] {
        if let Trust::Forced { behind, .. } = target.free.trust {
            return [[!behind, behind], [false; 2]];
        }
        let families = [front, behind].map(|shoulder| *merged && self.is_family(shoulder, target));
        // Two shoulders that are one need not have one wrist: the branch is the one whose wrist declares its singularity.
        if families[0] == families[1] {
            [[true; 2], [false; 2]]
        } else {
            [families, families.map(|family| !family)]
        }
    }

    /// Whether the two wrists of a shoulder are one family.
    fn is_family(&self, shoulder: &Shoulder, target: &Target<'_>) -> bool {
        let sin_5 = sin_5(&seen_from_plane(shoulder, target.rotation));
        let (_, least_sin_5) = OpenPlane::of(self, shoulder, target).nearest_to_wrist(target);
        sin_5 <= WRIST_MERGE_SIN || least_sin_5 <= target.free.trust.radius().max(WRIST_FREE_SIN)
    }

    /// Puts the four branches of one shoulder into slots `base` ..= `base` + 3.
    fn fill(
        &self,
        branches: &mut Branches<6>,
        base: usize,
        shoulder: &Shoulder,
        target: &Target<'_>,
    ) -> Reach {
        let m = seen_from_plane(shoulder, target.rotation);
        let (sin_5, trust, free_6) = (sin_5(&m), target.free.trust, target.free_theta[5]);
        let [told, flipped] = [false, true].map(|flipped| Turn::Told { flipped });
        let plane = OpenPlane::of(self, shoulder, target);
        let (nearest, least_sin_5) = plane.nearest_to_wrist(target);
        if trust.forces(6) {
            let telling = plane.telling(free_6).map_or(nearest, |angle| plane.turned(angle));
            return self.put_merged(
                branches,
                base,
                self.reaching(&telling, Turn::Taken(free_6), target),
            );
        }
        if least_sin_5 <= trust.radius().max(WRIST_FREE_SIN) {
            return self.put_merged(
                branches,
                base,
                self.reaching(&nearest, Turn::Free(free_6), target),
            );
        }
        if sin_5 <= WRIST_MERGE_SIN {
            // One family: of its two members that the pose tells, the one nearer to the free angle, if it reaches.
            let away = (m[(1, 2)].atan2(m[(1, 0)]) - free_6).cos() < 0.0;
            let (near, far) = if away { (flipped, told) } else { (told, flipped) };
            let reaching = self.reaching(shoulder, near, target).or_else(|missed| {
                let nearer = |other: Reach| {
                    if other.shortfall() < missed.shortfall() { other } else { missed }
                };
                self.reaching(shoulder, far, target).map_err(nearer)
            });
            return self.put_merged(branches, base, reaching);
        }
        let missed = [(told, base), (flipped, base + 1)].map(|(turn, slot)| {
            match self.reaching(shoulder, turn, target) {
                Ok(reaching) => {
                    self.put(branches, slot, &reaching, Status::empty());
                    Reach::Reached
                }
                Err(missed) => missed,
            }
        });
        if missed[1].shortfall() < missed[0].shortfall() { missed[1] } else { missed[0] }
    }

    /// The branches of a wrist whose flip is the same family.
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

    /// Both elbows of an arm, into `slot` and `slot` + 2.
    fn put(&self, branches: &mut Branches<6>, slot: usize, reaching: &Reaching, flags: Status) {
        let Reaching { shoulder, wrist, elbows } = reaching;
        let flags = if elbows.behind.is_none() { flags | Status::ELBOW } else { flags };
        (branches.flags[slot], branches.flags[slot + 2]) = (flags, flags);
        branches.q[slot] = Some(self.joints(shoulder, &elbows.front, wrist));
        match &elbows.behind {
            Some(behind) => branches.q[slot + 2] = Some(self.joints(shoulder, behind, wrist)),
            None => branches.flags[slot + 2] |= Status::MERGED,
        }
        if elbows.free {
            (branches.free[slot], branches.free[slot + 2]) =
                (Some(FreeJoint::Upper), Some(FreeJoint::Upper));
        }
    }

    fn joints(&self, shoulder: &Shoulder, elbow: &Elbow, wrist: &Wrist) -> [f64; 6] {
        let theta_1 = shoulder.sin_1.atan2(shoulder.cos_1);
        // phi - theta_23 (eq. 40)
        let sin_4 = wrist.sin_phi * elbow.cos_23 - wrist.cos_phi * elbow.sin_23;
        let cos_4 = wrist.cos_phi * elbow.cos_23 + wrist.sin_phi * elbow.sin_23;
        self.placement.joints([
            theta_1,
            elbow.theta_2,
            elbow.theta_3,
            sin_4.atan2(cos_4),
            wrist.theta_5,
            wrist.theta_6,
        ])
    }
}
