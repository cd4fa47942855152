//! What other modules see of a module, compared: which of them must be read again after a change.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::string::String;

use crate::rapid::data::module::{Datum, Module};

/// The names in lower case by which two versions of a module differ to other modules: data with
/// another declaration or value, data that are assigned in one version, routines of one version.
///
/// A module that has none of them in its text is read as before.
#[must_use]
pub fn differing_names(before: &Module, after: &Module) -> BTreeSet<String> {
    let (old, new) = (data(before), data(after));
    let is_other = |of: &BTreeMap<&String, &Datum>, name: &String, datum: &Datum| {
        of.get(name).is_none_or(|other| !is_same(datum, other))
    };
    let gone = old.iter().filter(|(name, datum)| is_other(&new, name, datum));
    let come = new.keys().filter(|name| !old.contains_key(*name));
    let data = gone.map(|(name, _)| *name).chain(come.copied()).cloned();
    let assigned = before.assigned.symmetric_difference(&after.assigned).cloned();
    let routines = routines(before).symmetric_difference(&routines(after)).cloned().collect();
    let routines: BTreeSet<(String, bool)> = routines;
    data.chain(assigned).chain(routines.into_iter().map(|(name, _)| name)).collect()
}

/// The data of a module itself by their names in lower case.
fn data(module: &Module) -> BTreeMap<&String, &Datum> {
    let own = module.index.iter();
    own.filter_map(|(name, datum)| Some((name, module.data.get(*datum)?))).collect()
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
    fn data_that_change_come_or_go_are_named() {
        assert_eq!(names(&TEXT.replace("a:=1", "a:=1.5")), ["a"]);
        assert_eq!(names(&TEXT.replace("CONST num c", "LOCAL CONST num c")), ["c"]);
        assert_eq!(names(&TEXT.replace("num c", "num d")), ["c", "d"]);
        assert_eq!(names(&TEXT.replace("CONST num c:=3;", "")), ["c"]);
        assert_eq!(names(&TEXT.replace("CONST num a", "CONST dnum a")), ["a"]);
    }

    #[test]
    fn assignments_and_routines_are_named() {
        assert_eq!(names(&TEXT.replace("b:=a;", "other:=a;")), ["b", "other"]);
        assert_eq!(names(&TEXT.replace("PROC main", "LOCAL PROC main")), ["main"]);
        assert_eq!(names(&TEXT.replace("PROC main", "PROC Other")), ["main", "other"]);
    }
}
