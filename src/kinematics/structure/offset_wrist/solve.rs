//! Every solution of a pose: seeds from the roots of the resultant, brought to the pose by the
//! closure of the chain.
//!
//! Docs: offset_wrist.md, section 5.

use super::geometry::OffsetWrist;
use super::seeds::{Seeds, seeds};
use crate::kinematics::answer::status::Status;
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::branches::Branches;
use crate::kinematics::structure::closure::{Accepted, Candidates, Closure, Kind, Target};
use crate::kinematics::structure::end_frames::Frame;
use crate::lanes::{Kernel, LANES, run};
use crate::report::Reach;

/// The solutions of a pose.
pub(super) struct Found {
    pub(super) accepted: Accepted,
    /// Whether they are all, by the number of roots.
    pub(super) is_certified: bool,
}

/// The solve of one pose, compiled for each instruction set.
struct Solve<'a> {
    arm: &'a OffsetWrist,
    last: &'a Frame,
}

impl Kernel for Solve<'_> {
    type Answer = Found;
    const WIDE: bool = true;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> Found {
        self.arm.find::<FUSED>(self.last)
    }
}

impl OffsetWrist {
    /// Every solution of a pose of frame 6, in the order of sides of shoulder and elbow, then of
    /// joint 6.
    pub(super) fn solve_pose(&self, t_first_last: &Pose) -> Branches<6, 16> {
        let last = Frame::of(t_first_last);
        let found = run(Solve { arm: self, last: &last });
        let mut branches = Branches::empty(Reach::Reached);
        let mut solutions = found.accepted;
        let solutions = solutions.as_mut_slice();
        if solutions.is_empty() {
            return Branches::empty(self.missed(&last));
        }
        solutions.sort_unstable_by(|a, b| self.order(&a.theta).total_cmp(&self.order(&b.theta)));
        let mut merged = 0;
        for (slot, one) in solutions.iter().enumerate() {
            branches.q[slot] = Some(self.joint_map.joints(one.theta));
            merged += usize::from(one.kind == Kind::Fold);
        }
        let free = solutions.len();
        for flags in branches.flags.iter_mut().skip(free).take(merged) {
            *flags |= Status::MERGED;
        }
        branches
    }

    /// Every solution for a frame 6 in the shoulder frame, by its angles theta.
    #[inline(always)]
    pub(super) fn find<const FUSED: bool>(&self, last: &Frame) -> Found {
        let target = self.closure.target(last);
        let mut accepted = Accepted::NONE;
        let mut seeds = seeds::<FUSED>(self, last);
        converge::<FUSED>(&self.closure, &target, &seeds, &mut accepted);
        if !seeds.agrees(&accepted) {
            seeds.examine_all(self, last);
            converge::<FUSED>(&self.closure, &target, &seeds, &mut accepted);
        }
        accepted.thin(&self.closure, &target);
        Found { is_certified: seeds.agrees(&accepted), accepted }
    }
}

/// Brings the seeds to the target, eight at once.
fn converge<const FUSED: bool>(
    closure: &Closure,
    target: &Target,
    seeds: &Seeds,
    accepted: &mut Accepted,
) {
    for block in seeds.as_slice().chunks(LANES) {
        let mut candidates = Candidates::NEW;
        for (lane, seed) in block.iter().enumerate() {
            candidates.put(lane, seed);
        }
        closure.converge::<FUSED>(target, &mut candidates);
        accepted.take(closure, target, &candidates, block.len());
    }
}

impl OffsetWrist {
    /// A number by which solutions are put in order: the sides of shoulder and elbow, and joint 6.
    fn order(&self, theta: &[f64; 6]) -> f64 {
        let [shoulder, elbow] = self.sides(theta);
        let behind = if shoulder < 0.0 { 16.0 } else { 0.0 };
        let bent = if elbow < 0.0 { 8.0 } else { 0.0 };
        behind + bent + wrap(theta[5])
    }
}
