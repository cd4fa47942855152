//! Every solution of a pose.
//!
//! Docs: offset_wrist.md, section 5.

use super::geometry::OffsetWrist;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::Structure as _;
use crate::kinematics::structure::branches::Branches;
use crate::kinematics::structure::by_roots::{SLOTS, Search};
use crate::kinematics::structure::closure::Accepted;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::free_choice::FreeChoice;

impl OffsetWrist {
    /// Return every solution of a pose of frame 6, in slots.
    pub(super) fn solve_pose(
        &self,
        t_first_last: &Pose,
        free: &FreeChoice<6>,
    ) -> Branches<6, SLOTS> {
        let mut accepted = Accepted::new();
        let last = &Frame::of(t_first_last);
        let is_certified = self.solutions(last, free, &mut accepted);
        let mut branches = self.general.slots(&mut accepted, is_certified);
        if accepted.as_slice().is_empty() {
            branches.reach = self.constants.missed(last);
        }
        branches
    }

    /// Take every solution of a pose of frame 6; returns whether they are certified to be all.
    pub(super) fn solutions(
        &self,
        last: &Frame,
        free: &FreeChoice<6>,
        accepted: &mut Accepted,
    ) -> bool {
        let near = self.joint_map().theta(&free.q);
        let mut search = Search::new(&self.constants.closure, last, near, accepted, 1);
        search.attempt(&self.constants);
        // The polynomials of the splits are others than the resultant.
        self.general.search(search)
    }
}
