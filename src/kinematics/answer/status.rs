//! The status of one slot.

bitflags::bitflags! {
    /// The status of one slot.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
    pub struct Status: u8 {
        /// The slot holds a solution.
        const FOUND = 1;
        /// The solution is inside the joint limits.
        const WITHIN_LIMITS = 2;
        /// sin q5 = 0. Axes 4 and 6 of a spherical wrist coincide: only q4 + q6 or q4 - q6 is
        /// determined. For a three-parallel arm, axis 6 is parallel to axes 2 to 4. For seven axes,
        /// the shoulder is in the plane of axes 5 and 6. For an arm without a closed form: its
        /// joints can move with the tool standing still.
        const WRIST = 4;
        /// The arm is stretched or folded: both elbow branches coincide. For an arm without a
        /// closed form: any two branches coincide.
        const ELBOW = 8;
        /// The wrist center is on axis 1: q1 is not determined. With a lateral offset: on the edge
        /// of its cylinder, where the front and back branch meet. For seven axes: axes 1 and 3
        /// coincide.
        const SHOULDER = 16;
        /// The slot is empty because its solution coincides with another slot's at a
        /// singularity.
        const MERGED = 32;
        /// The input of this row was invalid.
        const INVALID = 64;
        /// It is not certain that the slots hold every solution of the pose. On every slot of an
        /// answer, or on none; never where the structure has a closed form.
        const UNCERTIFIED = 128;
    }
}

bitflags::bitflags! {
    /// Singularities, with the bits that they have in [`Status`].
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
    pub struct SingularityKind: u8 {
        /// See [`Status::WRIST`].
        const WRIST = Status::WRIST.bits();
        /// See [`Status::ELBOW`].
        const ELBOW = Status::ELBOW.bits();
        /// See [`Status::SHOULDER`].
        const SHOULDER = Status::SHOULDER.bits();
    }
}

impl Status {
    /// The singularities among the flags.
    #[must_use]
    pub const fn singularities(self) -> SingularityKind {
        SingularityKind::from_bits_truncate(self.bits())
    }
}

impl SingularityKind {
    /// Each with its word.
    pub(crate) const NAMED: [(Self, &'static str); 3] =
        [(Self::WRIST, "wrist"), (Self::ELBOW, "elbow"), (Self::SHOULDER, "shoulder")];

    /// The words for all of them.
    #[doc(hidden)]
    pub fn words(self) -> impl Iterator<Item = &'static str> {
        Self::NAMED.into_iter().filter(move |(kind, _)| self.contains(*kind)).map(|(_, word)| word)
    }

    /// The word for the one that explains a jump: the first of wrist, shoulder and elbow.
    #[doc(hidden)]
    pub fn word(self) -> Option<&'static str> {
        let words = [(Self::WRIST, "wrist"), (Self::SHOULDER, "shoulder"), (Self::ELBOW, "elbow")];
        words.into_iter().find(|(kind, _)| self.contains(*kind)).map(|(_, word)| word)
    }
}

impl From<SingularityKind> for Status {
    fn from(singularities: SingularityKind) -> Self {
        Self::from_bits_retain(singularities.bits())
    }
}
