//! Types that a program defines. Names are in lower case.

use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;

use super::module::Module;
use super::value::DataType;

/// Most names that stand for one another, and records in records.
pub(crate) const DEEPEST_TYPE: usize = 8;

/// A type that a program defines.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OwnType {
    pub(crate) of: Definition,
    /// Whether only its own module may use it.
    pub(crate) is_local: bool,
}

/// How a type is defined.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Definition {
    /// As another name of a type.
    Alias(String),
    /// As a record: the type and the name of each component.
    Record(Vec<(String, String)>),
}

/// Types by their names.
pub(crate) type OwnTypes = BTreeMap<String, OwnType>;

/// The types that a module may use.
pub(crate) struct Types<'a> {
    pub(crate) own: OwnTypes,
    pub(crate) context: &'a [&'a Module],
}

/// The kind of a type.
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
