//! Two versions of a module compared as other modules see it, to read no others again.

use alloc::collections::{BTreeMap, BTreeSet};

use crate::prelude::*;
use crate::rapid::data::module::{Datum, Module, Scope};

/// The names in lower case by which two versions of a module differ to other modules: data that are
/// not LOCAL with another declaration or value, data that are assigned in one version, routines of
/// one version.
///
/// A module that has none of them in its text is read as before.
#[must_use]
pub fn differing_names(before: &Module, after: &Module) -> BTreeSet<String> {
    let (old, new) = (data(before), data(after));
    let is_other = |name: &&String| match (old.get(*name), new.get(*name)) {
        (Some(old), Some(new)) => !is_same(old, new),
        _ => true,
    };
    let data = old.keys().chain(new.keys()).copied().filter(is_other).cloned();
    let (old, new) = (assigned(before), assigned(after));
    let assigned = old.symmetric_difference(&new).copied().cloned();
    let (old, new) = (routines(before), routines(after));
    let routines = old.symmetric_difference(&new).map(|(name, _)| name.clone());
    data.chain(assigned).chain(routines).collect()
}

/// The data of a module that others see, by their names in lower case.
fn data(module: &Module) -> BTreeMap<&String, &Datum> {
    let own = module.index.iter();
    let own = own.filter_map(|(name, datum)| Some((name, module.data.get(*datum)?)));
    own.filter(|(_, datum)| datum.scope != Scope::Local).collect()
}

/// The names in lower case that a module assigns, but for its LOCAL data.
fn assigned(module: &Module) -> BTreeSet<&String> {
    let is_local = |name: &str| module.find(name).is_some_and(|it| it.scope == Scope::Local);
    module.assigned.iter().filter(|name| !is_local(name)).collect()
}

/// Whether data are the same but for their places.
fn is_same(one: &Datum, other: &Datum) -> bool {
    (one.data_type, one.scope, one.storage) == (other.data_type, other.scope, other.storage)
        && one.content == other.content
}

/// The names of routines in lower case, and whether each is local.
fn routines(module: &Module) -> BTreeSet<(String, bool)> {
    module.routines.iter().map(|it| (it.name.to_lowercase(), it.is_local())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rapid::read;
    use alloc::vec::Vec;

    const TEXT: &str = "MODULE M
CONST num a:=1;
LOCAL PERS num b:=2;
CONST num c:=3;
PROC main()
    b:=a;
ENDPROC
ENDMODULE";

    fn names(after: &str) -> Vec<String> {
        differing_names(&read(TEXT, &[]), &read(after, &[])).into_iter().collect()
    }

    #[test]
    fn places_bodies_and_comments_make_no_difference() {
        assert_eq!(names(TEXT), [] as [&str; 0]);
        let moved = TEXT.replace("MODULE M", "! A comment.\nMODULE M").replace("b:=a", "b:=a+1");
        assert_eq!(names(&moved), [] as [&str; 0]);
    }

    #[test]
    fn local_data_are_not_seen() {
        assert_eq!(names(&TEXT.replace("b:=2", "b:=7").replace("b:=a", "")), [] as [&str; 0]);
        assert_eq!(names(&TEXT.replace("LOCAL PERS num b:=2;", "")), ["b"]);
    }

    #[test]
    fn data_that_change_come_or_go_are_named() {
        assert_eq!(names(&TEXT.replace("a:=1", "a:=1.5")), ["a"]);
        assert_eq!(names(&TEXT.replace("CONST num c", "LOCAL CONST num c")), ["c"]);
        assert_eq!(names(&TEXT.replace("num c", "num d")), ["c", "d"]);
        assert_eq!(names(&TEXT.replace("CONST num c:=3;", "")), ["c"]);
        assert_eq!(names(&TEXT.replace("CONST num a", "PERS num a")), ["a"]);
    }

    #[test]
    fn assignments_and_routines_are_named() {
        assert_eq!(names(&TEXT.replace("b:=a;", "other:=a;")), ["other"]);
        assert_eq!(names(&TEXT.replace("PROC main", "LOCAL PROC main")), ["main"]);
        assert_eq!(names(&TEXT.replace("PROC main", "PROC Other")), ["main", "other"]);
    }
}
