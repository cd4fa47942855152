//! A program: its names, and what its routines may do.

use core::ops::Deref;

use super::effects::Effects;
use super::index::Index;
use crate::rapid::data::module::Module;

/// Modules that know each other.
pub(in crate::rapid) struct Program<'m> {
    index: Index<'m>,
    pub(super) effects: Effects,
}

impl<'m> Program<'m> {
    pub(in crate::rapid) fn new(modules: &[&'m Module]) -> Self {
        let index = Index::new(modules);
        let effects = Effects::of(&index);
        Self { index, effects }
    }
}

impl<'m> Deref for Program<'m> {
    type Target = Index<'m>;

    fn deref(&self) -> &Index<'m> {
        &self.index
    }
}
