//! The names of a scope.

use alloc::collections::BTreeMap;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use crate::error::RapidFaultKind;
use crate::rapid::data::reason::Unresolved;

/// Whether a name is a placeholder: for something that the program does not name yet.
pub(crate) fn is_placeholder(name: &str) -> bool {
    name.starts_with('<')
}

/// What a name refers to.
#[derive(Clone)]
pub(crate) enum Named {
    /// Data, by their index.
    Datum(usize),
    /// Something that has no value here, with the reason.
    Other(Unresolved),
}

/// The names of the module and of each routine.
pub(crate) struct Scopes {
    /// By the index of the routine, from 1; 0 for the module. Names are in lower case.
    names: Vec<BTreeMap<String, Named>>,
}

impl Scopes {
    pub(crate) fn new() -> Self {
        Self { names: Vec::from([BTreeMap::new()]) }
    }

    /// Begins the scope of the next routine.
    pub(crate) fn add_routine(&mut self) {
        self.names.push(BTreeMap::new());
    }

    /// Declare a name, which must not exist yet; `routine_name` is for the message. A placeholder
    /// declares nothing.
    pub(crate) fn declare(
        &mut self,
        routine: usize,
        routine_name: Option<&str>,
        name: &str,
        named: Named,
    ) -> Result<(), RapidFaultKind> {
        let Some(scope) = self.names.get_mut(routine).filter(|_| !is_placeholder(name)) else {
            return Ok(());
        };
        match scope.insert(name.to_lowercase(), named) {
            None => Ok(()),
            Some(_) => Err(RapidFaultKind::SameName {
                name: name.to_string(),
                routine: routine_name.map(ToString::to_string),
            }),
        }
    }

    /// What a name in lower case refers to, in a routine or else in the module.
    pub(crate) fn find(&self, routine: usize, lower: &str) -> Option<&Named> {
        let local = if routine > 0 {
            self.names.get(routine).and_then(|scope| scope.get(lower))
        } else {
            None
        };
        local.or_else(|| self.names.first().and_then(|scope| scope.get(lower)))
    }

    /// Data of the module by their names in lower case.
    pub(crate) fn module_data(self) -> impl Iterator<Item = (String, usize)> {
        let module = self.names.into_iter().next().unwrap_or_default();
        module.into_iter().filter_map(|(name, named)| match named {
            Named::Datum(index) => Some((name, index)),
            Named::Other(_) => None,
        })
    }
}
