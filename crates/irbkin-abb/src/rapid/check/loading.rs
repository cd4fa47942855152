//! What a controller refuses when it loads a program: names that nothing declares, values of other
//! types, constants that are assigned, functions that return nothing, names declared twice.

use alloc::collections::{BTreeMap, BTreeSet};

use super::findings::listed;
use super::undeclared::signature;
use crate::prelude::*;
use crate::rapid::data::expression::{Arguments, Expression, Form, Relation, written};
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::data::fit::parts;
use crate::rapid::data::module::{Datum, Module, RoutineKind, Scope, Storage};
use crate::rapid::data::statement::{Assignment, Condition, Flow, Statement, StatementKind};
use crate::rapid::data::table::Entry;
use crate::rapid::data::unread::Unresolved;
use crate::rapid::data::value::DataType;
use crate::rapid::expression::functions::result_of;
use crate::rapid::expression::names::{is_constant, predefined};
use crate::rapid::program::whole::Program;
use crate::rapid::text::words::words_of;
use irbkin::{Interrupt, Interrupted};

#[derive(Default)]
struct Declared {
    kind: Option<&'static str>,
    /// Why no statement may assign it.
    fixed: Option<&'static str>,
}

impl Declared {
    fn of(type_name: &str) -> Self {
        Self { kind: kind(type_name), fixed: None }
    }
}

/// The kind of the values of a type: types of one kind take each other's values.
fn kind(type_name: &str) -> Option<&'static str> {
    let is = |names: &[&str]| names.iter().any(|it| it.eq_ignore_ascii_case(type_name));
    match DataType::named(type_name) {
        Some(DataType::Dnum) => Some("num"),
        Some(data_type) => Some(data_type.name()),
        None if is(&["dionum", "errnum"]) => Some("num"),
        None if is(&["string"]) => Some("string"),
        None if is(&["bool"]) => Some("bool"),
        None => type_name.get(..6).filter(|it| it.eq_ignore_ascii_case("signal")).map(|_| "signal"),
    }
}

/// What a value may be, if its name is not declared.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Asked {
    Datum,
    /// A signal or a datum.
    Value,
    Signal,
}

/// A name that nothing declares: its first finding, how often it is written, and what is asked for
/// there, at least and at most.
struct Unknown {
    first: Finding,
    count: usize,
    asked: [Asked; 2],
}

/// Checks the statements of a program one after the other.
pub(super) struct Loading<'p, 'm> {
    program: &'p Program<'m>,
    /// The signals of the controller in lower case, if they are known.
    signals: Option<&'p BTreeSet<String>>,
    /// Whether tools are given for undeclared ones.
    has_tools: bool,
    /// Names in lower case in what is not read.
    unread: BTreeSet<String>,
    /// The module and the routine, in lower case, of the statement.
    module: usize,
    routine: String,
    statement: &'m Statement,
    /// The variables of the loops around it; `None` for another block.
    blocks: Vec<Option<&'m str>>,
    /// The places of unknown names in lower case.
    index: BTreeMap<String, usize>,
    unknown: Vec<Unknown>,
    found: Vec<Finding>,
}

/// The findings of a program, apart from names that nothing declares, which are the second. Tools
/// may be given for undeclared ones; in a whole program no module is an alternative of another.
pub(super) fn check_loading(
    program: &Program<'_>,
    signals: Option<&BTreeSet<String>>,
    has_tools: bool,
    is_whole: bool,
    interrupt: Interrupt<'_>,
) -> Result<(Vec<Finding>, Vec<Finding>), Interrupted> {
    let mut found = Vec::new();
    for (index, module) in program.modules.iter().enumerate() {
        found.extend(functions_without_return(module).map(|it| it.in_module(index)));
    }
    found.extend(duplicate_names(program, is_whole));
    let all = || program.modules.iter().flat_map(|module| &module.statements);
    let Some(statement) = all().next() else { return Ok((found, Vec::new())) };
    let is_read = |it: &&Statement| {
        !matches!(it.kind, StatementKind::Invalid { .. } | StatementKind::Unfinished { .. })
    };
    let unread = all().filter(|it| !is_read(it)).flat_map(|it| words_of(&it.text));
    let mut loading = Loading {
        program,
        signals,
        has_tools,
        unread: unread.map(str::to_lowercase).collect(),
        module: 0,
        routine: String::new(),
        statement,
        blocks: Vec::new(),
        index: BTreeMap::new(),
        unknown: Vec::new(),
        found,
    };
    for (index, module) in program.modules.iter().enumerate() {
        loading.module = index;
        for (at, statement) in module.statements.iter().enumerate() {
            interrupt.check(at)?;
            loading.check(statement);
        }
    }
    Ok(loading.into_findings())
}

impl<'m> Loading<'_, 'm> {
    fn check(&mut self, statement: &'m Statement) {
        let routine = statement.routine.as_deref().unwrap_or_default().to_lowercase();
        if routine != self.routine {
            self.routine = routine;
            self.blocks.clear();
        }
        self.statement = statement;
        match &statement.kind {
            StatementKind::Flow { flow, .. } => self.flow(flow),
            StatementKind::Assignment(it) => self.assignment(it),
            StatementKind::Instruction(it) => {
                let name = it.name.as_deref().unwrap_or_default();
                // GOTO names a label, CONNECT a trap routine.
                if !["goto", "connect"].contains(&name) {
                    self.arguments(name, &it.arguments, false);
                }
                if let Some((name, _)) = &it.written {
                    self.check_assignable(name);
                }
            }
            _ => {}
        }
    }

    fn flow(&mut self, flow: &'m Flow) {
        match flow {
            Flow::If { condition, is_single } => {
                self.condition(condition);
                if !is_single {
                    self.blocks.push(None);
                }
            }
            Flow::Part(condition) => self.condition(condition),
            Flow::Test(tested) => {
                if let Some(it) = tested {
                    self.names(it, Asked::Value);
                }
                self.blocks.push(None);
            }
            Flow::Loop { condition, counter } => {
                self.condition(condition);
                let numbers = counter.iter().flat_map(|it| it.bounds.iter().chain(&it.step));
                numbers.for_each(|it| self.names(it, Asked::Datum));
                self.blocks.push(counter.as_ref().map(|it| &*it.variable));
            }
            Flow::End => drop(self.blocks.pop()),
            Flow::Handler => {}
        }
    }

    fn condition(&mut self, condition: &'m Condition) {
        match condition {
            Condition::Compared(operands, relation) => self.comparison(&**operands, *relation),
            Condition::Case(values) => values.iter().for_each(|it| self.names(it, Asked::Value)),
            Condition::Other(Some(expression)) => self.names(expression, Asked::Value),
            _ => {}
        }
    }

    fn comparison(&mut self, operands: &[Expression<'_>], relation: Relation) {
        let is_equality = matches!(relation, Relation::Equal | Relation::Unequal);
        let asked = if is_equality { Asked::Value } else { Asked::Datum };
        for operand in operands {
            self.names(operand, asked);
        }
    }

    fn assignment(&mut self, assignment: &'m Assignment) {
        let Assignment { name, target, value, .. } = assignment;
        self.names(target, Asked::Datum);
        self.names(value, Asked::Value);
        self.check_assignable(&name.to_lowercase());
        let own = || written(&self.statement.text, target);
        self.found.extend(self.kind_finding(self.kind_of(target), &own, value));
    }

    /// The finding on a value of another kind than the datum or the parameter that gets it.
    fn kind_finding(
        &self,
        wanted: Option<&str>,
        own: &dyn Fn() -> String,
        value: &Expression<'_>,
    ) -> Option<Finding> {
        // A signal stands for its value.
        let given = self.kind_of(value).filter(|it| *it != "signal")?;
        let wanted = wanted.filter(|it| *it != given)?;
        let value = written(&self.statement.text, value);
        Some(self.finding(Code::WrongType, format!("{} is a {wanted}, {value} a {given}", own())))
    }

    /// Note what a statement assigns, if that cannot be assigned.
    fn check_assignable(&mut self, lower: &str) {
        if let Some(what) = self.declaration(lower).and_then(|it| it.fixed) {
            let words = format!("{lower} is {what}, which no statement may assign");
            self.found.push(self.finding(Code::ReadOnly, words));
        }
    }

    fn names(&mut self, expression: &Expression<'_>, asked: Asked) {
        if let Some((name, ..)) = expression.reference() {
            self.note_name(name, asked);
        }
        match &expression.form {
            Form::Call(call) => return self.arguments(&call.name, &call.arguments, true),
            Form::Compared(operands, relation) => return self.comparison(&**operands, *relation),
            _ => {}
        }
        let is_logical = matches!(expression.form, Form::Not(_) | Form::Unread(..));
        let asked = if is_logical { Asked::Value } else { Asked::Datum };
        expression.parts().into_iter().for_each(|part| self.names(part, asked));
    }

    /// Look for the names and compare the types of arguments.
    fn arguments(&mut self, name: &str, arguments: &Arguments<'_>, is_function: bool) {
        let entry = if is_function { Entry::function(name) } else { Entry::instruction(name) };
        let own = signature(self.program, self.module, &name.to_lowercase()).map(|(_, it)| it);
        let wanted = own.or_else(|| entry.map(|it| it.arguments)).unwrap_or("...");
        let required = parts(wanted).filter(|(sign, _)| *sign == b',').map(|(_, part)| part);
        let required = required.take_while(|part| *part != "...").map(Some);
        let required = required.chain(core::iter::repeat(None));
        for (value, part) in arguments.required.iter().zip(required) {
            self.argument(value, part);
        }
        for option in &arguments.optional {
            let is_it = |part: &&str| part.rsplit(' ').next().is_some_and(|it| option.is(it));
            let part = parts(wanted).map(|(_, part)| part).find(is_it);
            option.value.iter().for_each(|value| self.argument(value, part));
        }
    }

    /// Look for the names of an argument, and compare its type with the parameter's.
    fn argument(&mut self, value: &Expression<'_>, parameter: Option<&str>) {
        let mut words = parameter.unwrap_or_default().rsplit(' ');
        let own = words.next().unwrap_or_default();
        let type_name = words.next().unwrap_or_default();
        let wanted = kind(type_name).filter(|_| !own.ends_with('}'));
        // What the controller's configuration declares.
        let is_configured =
            ["mecunit", "tasks", "taskid", "cameradev", "identno"].contains(&type_name);
        let is_given = wanted == Some("tooldata") && self.has_tools;
        if (is_configured || is_given) && value.reference().is_some() {
            return;
        }
        let asked = match (parameter, wanted) {
            (_, Some("signal")) => Asked::Signal,
            (_, Some("bool")) | (None, _) => Asked::Value,
            _ => Asked::Datum,
        };
        self.names(value, asked);
        // AliasIO takes any signal by its name in a string, too.
        let wanted = wanted.filter(|_| type_name != "signal");
        self.found.extend(self.kind_finding(wanted, &|| own.to_string(), value));
    }

    fn kind_of(&self, expression: &Expression<'_>) -> Option<&'static str> {
        match &expression.form {
            Form::Number(_) => Some("num"),
            Form::Text(_) => Some("string"),
            Form::Bool(_) | Form::Compared(..) | Form::Not(_) => Some("bool"),
            Form::Negated(operand) => self.kind_of(operand),
            Form::Chain(first, rest) => {
                let own = self.kind_of(first).filter(|it| ["num", "string"].contains(it));
                own.filter(|_| rest.iter().all(|(_, it)| self.kind_of(it) == own))
            }
            Form::Call(call) if call.components.is_empty() => {
                let own = || self.program.function(self.module, &call.name.to_lowercase());
                let result = result_of(&call.name).or_else(|| Some(own()?.1.name()));
                result.and_then(kind)
            }
            _ => {
                let (name, _, components) = expression.reference()?;
                let whole = self.declaration(&name.to_lowercase())?.kind?;
                let Some(data_type) = DataType::named(whole) else {
                    return Some(whole).filter(|_| components.is_empty());
                };
                kind(data_type.described().part(components)?.0.name)
            }
        }
    }

    /// Note a name, if nothing declares it.
    fn note_name(&mut self, name: &str, asked: Asked) {
        let lower = name.to_lowercase();
        // Signals of the controller's own boards, such as DRV1BRAKE, are in no file.
        let is_of_board = || {
            asked > Asked::Datum
                && name.bytes().all(|it| it.is_ascii_uppercase() || it.is_ascii_digit())
        };
        let is_known = self.unread.contains(&lower)
            || self.signals.is_some_and(|it| it.contains(&lower) || is_of_board())
            || self.declaration(&lower).is_some()
            || is_constant(&lower);
        if is_known {
            return;
        }
        let asked = match asked {
            // What the program waits for changes by itself.
            _ if self.statement.kind.word().eq_ignore_ascii_case("WaitUntil") => Asked::Signal,
            Asked::Datum if is_named_as_signal(name) => Asked::Value,
            asked => asked,
        };
        let at = *self.index.entry(lower).or_insert(self.unknown.len());
        if at == self.unknown.len() {
            let finding = self.finding(Code::UnknownName, format!("nothing declares {name}"));
            let first = Finding { unknown: Some(name.to_string()), ..finding };
            self.unknown.push(Unknown { first, count: 0, asked: [asked; 2] });
        }
        let entry = &mut self.unknown[at];
        entry.count += 1;
        entry.asked = [entry.asked[0].min(asked), entry.asked[1].max(asked)];
    }

    /// What a name in lower case is declared as, where the statement is.
    fn declaration(&self, lower: &str) -> Option<Declared> {
        let Self { program, module, .. } = *self;
        let routine = self.routine.as_str();
        if self.blocks.iter().flatten().any(|it| *it == lower) {
            return Some(Declared { fixed: Some("the counter of a FOR"), ..Declared::of("num") });
        }
        let parameters = program.parameters(module, routine);
        if let Some(it) = parameters.iter().find(|it| it.name == lower) {
            return Some(Declared::of(it.data_type.map_or("", DataType::name)));
        }
        let read = |it: &Datum| Declared {
            fixed: Some("a constant").filter(|_| it.storage == Storage::Const),
            ..Declared::of(it.data_type.name())
        };
        let local = program.local(module, routine, lower);
        let global = program.datum(module, lower).map(|(_, it)| it);
        match (program.unread(module, lower), global) {
            _ if local.is_some() => local.map(read),
            _ if program.is_ambiguous(module, lower) => Some(Declared::default()),
            (Some(Unresolved::OtherType { type_name }), None) => Some(Declared::of(type_name)),
            // A routine may declare it, and the module too.
            (Some(_), _) => Some(Declared::default()),
            (None, Some(global)) => Some(read(global)),
            (None, None) => {
                let own = predefined(lower).map(|it| Declared::of(it.type_name()));
                own.or_else(|| program.callee(module, lower).map(|_| Declared::default()))
            }
        }
    }

    fn finding(&self, code: Code, words: String) -> Finding {
        Finding::new(code, words).at_statement(self.statement, 0).in_module(self.module)
    }

    /// The findings, and apart from them the names that nothing declares: signals are one finding,
    /// if the controller's are not known.
    fn into_findings(self) -> (Vec<Finding>, Vec<Finding>) {
        let mut found = self.found;
        let are_signals = |it: &Unknown| {
            let may_be = it.asked[0] > Asked::Datum || it.asked[1] == Asked::Signal;
            may_be && self.signals.is_none()
        };
        let (signals, names): (Vec<_>, Vec<_>) = self.unknown.into_iter().partition(are_signals);
        let names = names.into_iter().map(|Unknown { mut first, count, .. }| {
            if count > 1 {
                first.message = format!("{} ({count} times)", first.message);
            }
            first
        });
        let all: Vec<String> = signals.iter().filter_map(|it| it.first.unknown.clone()).collect();
        let first = signals.into_iter().map(|it| it.first).min_by_key(Finding::place);
        found.extend(first.map(|first| {
            let ending = if all.len() == 1 { "a signal" } else { "signals" };
            let message = format!("{} not declared, taken for {ending}", listed(&all));
            Finding { code: Code::UnknownSignal, unknown: None, message, ..first }
        }));
        (found, names.collect())
    }
}

/// The functions of a module that have no RETURN, nor anything else that leaves them.
fn functions_without_return(module: &Module) -> impl Iterator<Item = Finding> {
    let leaves = |it: &&Statement| match &it.kind {
        StatementKind::Instruction(it) => {
            ["return", "raise", "exit"].iter().any(|word| it.word.eq_ignore_ascii_case(word))
        }
        StatementKind::Invalid { .. } | StatementKind::Unfinished { .. } => true,
        _ => false,
    };
    let ended = module.statements.iter().filter(leaves).filter_map(|it| it.routine.as_deref());
    let mut ended: Vec<&str> = ended.collect();
    ended.sort_unstable();
    let functions = module.routines.iter().filter(|it| it.kind == RoutineKind::Func);
    functions.filter(move |it| ended.binary_search(&&*it.name).is_err()).map(|it| {
        let finding = Finding::new(Code::NoReturn, "no RETURN returns its value");
        finding.placed((it.line, it.column), None, 0, &format!("FUNC {}", it.name))
    })
}

/// The global names that several modules declare: of two modules they are one cause.
fn duplicate_names(program: &Program<'_>, is_whole: bool) -> Vec<Finding> {
    let mut found = Vec::new();
    // The first declarations, and their places by the names in lower case.
    let mut first = Vec::new();
    let mut index: BTreeMap<String, usize> = BTreeMap::new();
    for (module_index, module) in program.modules.iter().enumerate() {
        let routines = module.routines.iter().filter(|it| !it.is_local());
        let routines = routines.map(|it| (&it.name, (it.line, it.column)));
        let is_global = |it: &&Datum| it.routine.is_none() && it.scope != Scope::Local;
        let data = module.data.iter().filter(is_global);
        let data = data.map(|it| (&it.name, (it.line, it.column)));
        for (name, place) in routines.chain(data) {
            let at = *index.entry(name.to_lowercase()).or_insert(first.len());
            if at == first.len() {
                first.push((module_index, place.0));
            }
            let (other, line) = first[at];
            if other != module_index {
                let module = program.modules[other].name().unwrap_or("another file");
                let words = format!("{module} declares it, too, on line {line}");
                let finding = Finding::new(Code::NameTwice, words).placed(place, None, 0, name);
                let assumed = (!is_whole).then(|| "all files loaded".to_string());
                let cause = format!("{other} {module_index}");
                found.push(Finding { assumed, cause, ..finding }.in_module(module_index));
            }
        }
    }
    found
}

/// Whether a part of a name begins as the names of signals do: `giCode`, `I_diStart`, `DO_1`.
fn is_named_as_signal(name: &str) -> bool {
    let begins = |part: &str| {
        let (begin, rest) = part.split_at_checked(2).unwrap_or_default();
        ["ai", "ao", "di", "do", "gi", "go"].iter().any(|it| it.eq_ignore_ascii_case(begin))
            && !rest.starts_with(|it: char| it.is_lowercase())
    };
    name.split('_').any(begins)
}
