//! Declares the structures of arms with a number of joints.

/// An enum of structures, each with its number of slots. Each is tried on a table in this order; if
/// none fits, the one with the smallest deviation gives the reason.
macro_rules! structures {
    (
        $(#[$doc:meta])* $name:ident, $joints:literal, $redundancy:ty:
        $($structure:ident: $slots:literal),+
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
            /// None of them.
            Unknown(UnknownStructure),
        }

        impl AnyStructure<$joints> for $name {
            type Redundancy = $redundancy;

            fn recognize(mdh: &Mdh<$joints>) -> (Chain<$joints>, Self) {
                let mut nearest: Option<UnknownStructure> = None;
                $(match recognized::<$structure, $joints, $slots>(mdh) {
                    Ok((chain, mut solver)) => {
                        solver.structure = solver.structure.noting(nearest);
                        return (chain, Self::$structure(solver));
                    }
                    Err(missed) if <$structure as Structure<$joints, $slots>>::IS_CLOSED_FORM => {
                        nearest = Some(missed.nearer_of(nearest));
                    }
                    Err(missed) => nearest = nearest.or(Some(missed)),
                })+
                let missed = nearest.unwrap_or(UnknownStructure::joint_count($joints));
                (Chain::new(mdh.clone()), Self::Unknown(missed))
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
                    Self::Unknown(reason) => Self::Unknown(reason),
                }
            }

            fn hinting(self, hint: impl FnOnce(UnknownStructure) -> UnknownStructure) -> Self {
                match self {
                    $(Self::$structure(mut solver) => {
                        let nearest = solver.structure.nearest().map(hint);
                        solver.structure = solver.structure.noting(nearest);
                        Self::$structure(solver)
                    })+
                    Self::Unknown(reason) => Self::Unknown(hint(reason)),
                }
            }

            #[inline]
            fn slot_count(&self) -> usize {
                match self {
                    $(Self::$structure(_) => $slots,)+
                    Self::Unknown(_) => 0,
                }
            }

            fn arm(&self) -> &dyn Arm<$joints, $redundancy> {
                match self {
                    $(Self::$structure(solver) => solver,)+
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
                    Self::Unknown(_) => false,
                }
            }
        }
    };
}
pub(crate) use structures;
