//! Every solution of a pose.
//!
//! Docs: offset_wrist.md, section 5.

use super::geometry::OffsetWrist;
use crate::kinematics::structure::Structure as _;
use crate::kinematics::structure::by_roots::Search;
use crate::kinematics::structure::closure::Accepted;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::free_choice::FreeChoice;

impl OffsetWrist {
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
