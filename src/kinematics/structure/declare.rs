//! Declares the structures of arms with a number of joints.

/// An enum of structures, each with its number of slots. Each is tried on a table in this order; if
/// none fits, the one with the smallest deviation gives the reason.
macro_rules! structures {
    (
        $(#[$doc:meta])* $name:ident, $joints:literal, $redundancy:ty:
        $($structure:ident: $slots:literal),+
        $(; $(#[$refined_doc:meta])* $refined:ident($inner:ty))?
    ) => {
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq)]
        #[allow(
            clippy::large_enum_variant,
            reason = "a robot is built once and borrowed from then on; a box would need the heap"
        )]
        #[allow(private_interfaces, reason = "part of a sealed trait: no one outside names it")]
        pub enum $name {
            $(
                #[doc = concat!("[`", stringify!($structure), "`]")]
                $structure(Solver<$structure, $joints, $slots>),
            )+
            $(
                $(#[$refined_doc])*
                $refined($inner),
            )?
            /// None of them.
            Unknown(UnknownStructure),
        }

        impl AnyStructure<$joints> for $name {
            type Redundancy = $redundancy;

            fn recognize(mdh: &Mdh<$joints>) -> (Chain<$joints>, Self) {
                let mut nearest: Option<UnknownStructure> = None;
                // The last one takes every table whose joints are independent.
                let mut refused = None;
                $(match recognized::<$structure, $joints, $slots>(mdh) {
                    Ok((chain, mut solver)) => {
                        solver.structure = solver.structure.noting(nearest);
                        return (chain, Self::$structure(solver));
                    }
                    Err(missed) if <$structure as Structure<$joints, $slots>>::IS_CLOSED_FORM => {
                        nearest = Some(missed.nearer_of(nearest));
                    }
                    Err(missed) => refused = Some(missed),
                })+
                // A link that is too short says more than what depends on it.
                let short = nearest.filter(UnknownStructure::is_length);
                let missed = short.or(refused).or(nearest).unwrap_or(UnknownStructure::joint_count($joints));
                (Chain::new(mdh.clone()), Self::Unknown(missed))
            }

            fn unknown(reason: UnknownStructure) -> Self {
                Self::Unknown(reason)
            }

            fn closed_form(mdh: &Mdh<$joints>) -> Result<&'static str, UnknownStructure> {
                let mut nearest: Option<UnknownStructure> = None;
                $(if <$structure as Structure<$joints, $slots>>::IS_CLOSED_FORM {
                    match recognized::<$structure, $joints, $slots>(mdh) {
                        Ok(_) => return Ok(<$structure as Structure<$joints, $slots>>::PATTERN.name),
                        Err(missed) => nearest = Some(missed.nearer_of(nearest)),
                    }
                })+
                Err(nearest.unwrap_or(UnknownStructure::joint_count($joints)))
            }

            fn between(self, chain: &Chain<$joints>, limits: &JointLimits<$joints>) -> Self {
                match self {
                    $(Self::$structure(solver) => {
                        Self::$structure(Solver::new(solver.structure, chain, limits))
                    })+
                    $(Self::$refined(refined) => Self::$refined(refined.between(chain, limits)),)?
                    Self::Unknown(reason) => Self::Unknown(reason),
                }
            }

            $(fn refining(
                self,
                nominal: &Chain<$joints>,
                chain: &Chain<$joints>,
                limits: &JointLimits<$joints>,
            ) -> Option<Self> {
                let nominal = nominal.clone();
                self.is_closed_form()
                    .then(|| Self::$refined(<$inner>::new(self, nominal, chain, limits)))
            })?

            fn is_closed_form(&self) -> bool {
                match self {
                    $(Self::$structure(_) => {
                        <$structure as Structure<$joints, $slots>>::IS_CLOSED_FORM
                    })+
                    $(Self::$refined(_) => false,)?
                    Self::Unknown(_) => false,
                }
            }

            fn hinting(self, hint: impl FnOnce(UnknownStructure) -> UnknownStructure) -> Self {
                match self {
                    $(Self::$structure(mut solver) => {
                        let nearest = solver.structure.nearest().map(hint);
                        solver.structure = solver.structure.noting(nearest);
                        Self::$structure(solver)
                    })+
                    $(refined @ Self::$refined(_) => refined,)?
                    Self::Unknown(reason) => Self::Unknown(hint(reason)),
                }
            }

            #[inline]
            fn slot_count(&self) -> usize {
                match self {
                    $(Self::$structure(_) => $slots,)+
                    $(Self::$refined(refined) => refined.slot_count(),)?
                    Self::Unknown(_) => 0,
                }
            }

            fn arm(&self) -> &dyn Arm<$joints, $redundancy> {
                match self {
                    $(Self::$structure(solver) => solver,)+
                    $(Self::$refined(refined) => refined,)?
                    Self::Unknown(reason) => reason,
                }
            }

            #[inline]
            fn solve_in_lanes(
                &self,
                solutions: &mut Solutions<$joints>,
                redundancy: $redundancy,
            ) -> bool {
                match self {
                    $(Self::$structure(solver) => solver.solve_in_lanes(solutions, redundancy),)+
                    $(Self::$refined(refined) => refined.solve_in_lanes(solutions, redundancy),)?
                    Self::Unknown(_) => false,
                }
            }
        }
    };
}
pub(crate) use structures;
