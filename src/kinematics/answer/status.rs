//! What a solve says of one slot.

bitflags::bitflags! {
    /// What a solve says of one slot.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
    pub struct Status: u8 {
        /// The slot holds a solution.
        const FOUND = 1;
        /// The solution is inside the joint limits.
        const WITHIN_LIMITS = 2;
        /// sin q5 = 0: axes 4 and 6 of a spherical wrist are one, only q4 + q6 or q4 - q6 is determined; axis 6 of a three-parallel arm is
        /// parallel to axes 2 to 4. Of seven axes: the shoulder is in the plane of axes 5 and 6.
        const WRIST = 4;
        /// The arm is stretched or folded: both elbow branches coincide.
        const ELBOW = 8;
        /// The wrist centre is on axis 1: q1 is not determined. With a lateral offset: on the edge of its cylinder, where front and back meet.
        /// Of seven axes: axes 1 and 3 are one.
        const SHOULDER = 16;
        /// The slot is empty because its solution coincides with that of another slot at a singularity.
        const MERGED = 32;
        /// The input of this row was invalid.
        const INVALID = 64;
    }
}

impl Status {
    /// The three kinds of singularity.
    pub const KINDS: Self = Self::WRIST.union(Self::ELBOW).union(Self::SHOULDER);
}
