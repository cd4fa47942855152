//! Every solution of a pose.
//!
//! Docs: offset_wrist.md, section 5.

use fearless_simd::Simd;

use super::clusters::Clusters;
use super::geometry::OffsetWrist;
use super::parallel::Parallel;
use super::resultant::polynomial;
use super::search::Search;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::branches::Branches;
use crate::kinematics::structure::by_roots::{InCluster, SLOTS};
use crate::kinematics::structure::closure::Accepted;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::lanes::{VectorKernel, run_vectors};

/// The solve of one pose, compiled for each instruction set.
struct Solve<'a> {
    arm: &'a OffsetWrist,
    last: &'a Frame,
    in_cluster: InCluster,
    accepted: &'a mut Accepted,
}

impl VectorKernel for Solve<'_> {
    /// Whether the accepted solutions are all, by the number of roots.
    type Answer = bool;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> bool {
        let lengths = &self.arm.constants.lengths;
        let mut search = Search::new(self.arm, self.last, self.accepted);
        let polynomial = polynomial(simd, lengths, &search.hand);
        let has_parallel = lengths.has_parallel();
        let known = if has_parallel { Parallel::of(lengths, &search.hand) } else { Parallel::NONE };
        let roots = polynomial.roots(simd, known.as_slice());
        let simple = roots.as_slice().iter().filter(|root| root.is_simple);
        let mut clusters = Clusters::of(&roots, lengths.per_root());
        let count = lengths.per_root() * simple.clone().count();
        if self.in_cluster == InCluster::Middle {
            for cluster in roots.as_slice().iter().filter(|root| !root.is_simple) {
                search.put_all_at(cluster.angle());
            }
        } else {
            clusters.examine(&mut search);
        }
        search.at_all_roots(simd, simple);
        let agree = |clusters: &Clusters, accepted: &Accepted| {
            lengths.turns_wrist_point()
                && roots.is_complete
                && accepted.is_certain()
                && !accepted.has_self_motion()
                && clusters.agree(accepted.as_slice(), count)
        };
        if self.in_cluster == InCluster::Middle {
            return !search.accepted.has_singular() && agree(&clusters, search.accepted);
        }
        agree(&clusters, search.accepted) || {
            search.accepted.begin();
            search.everywhere();
            search.converge();
            agree(&clusters, search.accepted)
        }
    }
}

impl OffsetWrist {
    /// Every solution of a pose of frame 6, in slots.
    pub(super) fn solve_pose(
        &self,
        t_first_last: &Pose,
        free: &FreeChoice<6>,
    ) -> Branches<6, SLOTS> {
        let mut accepted = Accepted::NONE;
        let is_certified = self.solutions(t_first_last, free, &mut accepted);
        let mut branches = self.general.slots(t_first_last, &mut accepted, is_certified);
        if accepted.as_slice().is_empty() {
            branches.reach = self.missed(&Frame::of(t_first_last));
        }
        branches
    }

    /// Find every solution of a pose of frame 6, by its angles theta. Returns whether they are all,
    /// by the number of roots.
    pub(super) fn solutions(
        &self,
        t_first_last: &Pose,
        free: &FreeChoice<6>,
        accepted: &mut Accepted,
    ) -> bool {
        let last = &Frame::of(t_first_last);
        // The general method shares no polynomial with this one.
        self.attempt(last, InCluster::Middle, accepted)
            || self.attempt(last, InCluster::Everywhere, accepted)
            || self.general.search(t_first_last, free, accepted)
    }

    /// Take what there is at the roots of the resultant, and in clusters; returns whether it is
    /// certain to be all.
    pub(super) fn attempt(
        &self,
        last: &Frame,
        in_cluster: InCluster,
        accepted: &mut Accepted,
    ) -> bool {
        accepted.begin();
        run_vectors(Solve { arm: self, last, in_cluster, accepted })
    }
}
