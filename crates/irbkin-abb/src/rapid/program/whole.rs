//! A program: its names, and what its routines may do.

use core::ops::Deref;

use super::effects::Effects;
use super::index::{DatumId, Index};
use crate::Error;
use crate::rapid::data::module::{Datum, Module};
use crate::rapid::data::moves::Target;
use crate::rapid::data::value::DataType;
use crate::rapid::expression::names::ToolIn;
use crate::rapid::resolve::resolver::atoms_of;

/// The robot, as [`converter`](crate::rapid::calc::target::converter) has it.
type Convert<'r> = &'r dyn Fn(&Target, &ToolIn, Option<&ToolIn>) -> Result<Target, Error>;

pub(in crate::rapid) struct Program<'m> {
    index: Index<'m>,
    pub(super) effects: Effects<'m>,
    pub(super) convert: Convert<'m>,
}

impl<'m> Program<'m> {
    pub(in crate::rapid) fn new(modules: &[&'m Module], convert: Convert<'m>) -> Self {
        let index = Index::new(modules);
        let effects = Effects::of(&index);
        Self { index, effects, convert }
    }

    /// The datum that a name in lower case refers to in a module, if no statement assigns it.
    pub(in crate::rapid) fn unassigned(&self, module: usize, lower: &str) -> Option<&'m Datum> {
        let (id, datum) = self.datum(module, lower)?;
        (!self.effects.assigned.contains_key(&id)).then_some(datum)
    }

    pub(in crate::rapid) fn assigns_confdata(&self, target: DatumId) -> bool {
        let atoms = atoms_of(DataType::RobTarget.described(), &["robconf".into()]);
        let assigned = self.effects.assigned.get(&target);
        assigned.is_some_and(|it| it.meets(DataType::RobTarget, &atoms))
    }
}

impl<'m> Deref for Program<'m> {
    type Target = Index<'m>;

    fn deref(&self) -> &Index<'m> {
        &self.index
    }
}
