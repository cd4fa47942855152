//! A program: its names, and what its routines may do.

use core::ops::Deref;

use super::effects::Effects;
use super::index::Names;
use crate::rapid::data::module::Module;

/// Modules that know each other.
pub(in crate::rapid) struct Program<'m> {
    names: Names<'m>,
    pub(super) effects: Effects,
}

impl<'m> Program<'m> {
    pub(in crate::rapid) fn new(modules: &[&'m Module]) -> Self {
        let names = Names::new(modules);
        let effects = Effects::of(&names);
        Self { names, effects }
    }
}

impl<'m> Deref for Program<'m> {
    type Target = Names<'m>;

    fn deref(&self) -> &Names<'m> {
        &self.names
    }
}
