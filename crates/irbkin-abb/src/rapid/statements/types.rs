//! The types that a module may use: RAPID's, its own, and other modules'.

use crate::prelude::*;
use crate::rapid::data::module::Module;
use crate::rapid::data::own_types::{DEEPEST_TYPE, Definition, OwnTypes};
use crate::rapid::data::value::DataType;

pub(crate) struct Types<'a> {
    pub(crate) own: OwnTypes,
    pub(crate) context: &'a [&'a Module],
}

pub(crate) enum TypeKind<'t> {
    Read(DataType),
    Record(&'t [(String, String)]),
    Other,
}

impl Types<'_> {
    /// The kind of a type, by its name in any case.
    pub(crate) fn kind(&self, name: &str) -> TypeKind<'_> {
        if let Some(data_type) = DataType::named(name) {
            return TypeKind::Read(data_type);
        }
        let mut name = name.to_lowercase();
        for _ in 0..DEEPEST_TYPE {
            match self.named(&name) {
                Some(Definition::Record(components)) => return TypeKind::Record(components),
                Some(Definition::Alias(of)) => name.clone_from(of),
                None => break,
            }
            if let Some(data_type) = DataType::named(&name) {
                return TypeKind::Read(data_type);
            }
        }
        TypeKind::Other
    }

    fn named(&self, lower: &str) -> Option<&Definition> {
        let elsewhere = || {
            let mut all = self.context.iter().filter_map(|module| module.types.get(lower));
            all.find(|own| !own.is_local)
        };
        self.own.get(lower).or_else(elsewhere).map(|own| &own.of)
    }
}
