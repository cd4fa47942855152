//! What a program declares and nothing in it names: targets, tools, work objects, routines.

use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::data::module::Module;
use crate::rapid::data::value::DataType;
use crate::rapid::expression::names::predefined_names;
use crate::rapid::text::words::words_of;

/// The types of data that are looked for.
const TYPES: [DataType; 4] =
    [DataType::RobTarget, DataType::JointTarget, DataType::ToolData, DataType::WobjData];

/// The targets, tools, work objects and routines of a program that nothing in its texts names but
/// their declaration. A name in a string counts: `%"rPart"+num%` calls a routine.
pub(super) fn unused(modules: &[&Module], sources: &[&str]) -> Vec<Finding> {
    // How often each name is declared, less how often it is written.
    let mut left: BTreeMap<String, isize> = BTreeMap::new();
    for module in modules {
        let data = module.data().iter().map(|datum| &datum.name);
        for name in data.chain(module.routines().iter().map(|routine| &routine.name)) {
            *left.entry(name.to_lowercase()).or_default() += 1;
        }
    }
    let mut word = String::new();
    for text in sources {
        for line in text.lines() {
            for part in words(line) {
                word.clear();
                word.extend(part.chars().flat_map(char::to_lowercase));
                if let Some(count) = left.get_mut(&word) {
                    *count -= 1;
                }
            }
        }
    }
    let is_unused = |name: &str| left.get(&name.to_lowercase()).is_some_and(|count| *count >= 0);
    let mut found = Vec::new();
    for (index, module) in modules.iter().enumerate() {
        let mut add = |place: (usize, usize), routine: Option<String>, what: String| {
            let finding = Finding::new(Code::Unused, "nothing in the program names it");
            found.push(finding.placed(place, routine, 0, &what).in_module(index));
        };
        for datum in module.data() {
            let own = datum.data_type;
            let is_own = predefined_names(own).contains(&datum.name.to_lowercase());
            if TYPES.contains(&own) && !is_own && is_unused(&datum.name) {
                let what = format!("{} {}", own.name(), datum.name);
                add((datum.line, datum.column), datum.routine.clone(), what);
            }
        }
        for routine in module.routines() {
            if !routine.name.eq_ignore_ascii_case("main") && is_unused(&routine.name) {
                let what = format!("{} {}", routine.kind.name(), routine.name);
                add((routine.line, routine.column), None, what);
            }
        }
    }
    found
}

/// The names in a line, in its strings too; not in its comment.
fn words(line: &str) -> impl Iterator<Item = &str> {
    let mut is_string = false;
    let comment = line.find(|character| {
        is_string ^= character == '"';
        character == '!' && !is_string
    });
    words_of(&line[..comment.unwrap_or(line.len())])
}
