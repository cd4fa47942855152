//! Tasks of a controller that wait for each other forever.

use alloc::collections::{BTreeMap, BTreeSet, VecDeque};

use super::undeclared::may_be_elsewhere;
use crate::prelude::*;
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::data::instructions::Effect;
use crate::rapid::data::module::Module;
use crate::rapid::data::statement::{Condition, Statement, StatementKind};
use crate::rapid::program::index::Index;
use crate::rapid::program::tree::{Block, Node};
use crate::rapid::text::words::words_of;

/// The name of a task and its modules, none if some are missing.
pub type Task<'a> = (&'a str, Vec<&'a Module>);

/// The names of tasks in each list, by its name in lower case.
type Lists<'m> = BTreeMap<String, Vec<&'m str>>;

/// Most routines of a program that are followed, and most points that are compared.
const MOST: usize = 500;

/// A statement of a module that waits for tasks at a point, whose name is in lower case.
struct Wait<'m> {
    module: usize,
    statement: &'m Statement,
    point: String,
    tasks: &'m [&'m str],
    /// Whether no branch, jump or second call decides when it waits.
    is_certain: bool,
}

/// The program of a task, followed from `main` to each wait.
struct Course<'m> {
    index: &'m Index<'m>,
    lists: &'m Lists<'m>,
    /// How many statements have each word in lower case, declarations apart.
    uses: BTreeMap<String, usize>,
    is_whole: bool,
    waits: Vec<Wait<'m>>,
    /// Modules and names of routines.
    followed: BTreeSet<(usize, String)>,
    /// The branches that are open, and the jumps before.
    doubts: usize,
}

impl<'m> Course<'m> {
    fn new(index: &'m Index<'m>, lists: &'m Lists<'m>) -> Self {
        let mut uses = BTreeMap::new();
        let statements = index.modules.iter().flat_map(|it| &it.statements);
        for it in statements.filter(|it| !matches!(it.kind, StatementKind::DatumOfType { .. })) {
            words_of(&it.text).for_each(|word| *uses.entry(word.to_lowercase()).or_default() += 1);
        }
        let has_main = index.callee(0, "main").is_some();
        let is_whole = has_main && !may_be_elsewhere(&index.modules, Some(true));
        let waits = Vec::new();
        let followed = BTreeSet::new();
        let mut course = Self { index, lists, uses, is_whole, waits, followed, doubts: 0 };
        course.call(0, "main");
        course
    }

    fn call(&mut self, module: usize, lower: &str) {
        let index = self.index;
        if let Some((home, _)) = index.callee(module, lower)
            && let Some(body) = index.body(home, lower)
            && self.followed.len() < MOST
            && self.followed.insert((home, lower.to_string()))
        {
            let is_once = lower == "main" || self.uses.get(lower) == Some(&1);
            self.block(home, &body.main, usize::from(!is_once));
        }
    }

    fn block(&mut self, module: usize, block: &'m Block<'m>, doubts: usize) {
        self.doubts += doubts;
        for node in block {
            match node {
                Node::Other(statement) => self.statement(module, statement),
                Node::Loop { condition, body, .. } => {
                    let is_forever = matches!(condition, Condition::Always);
                    self.block(module, body, usize::from(!is_forever));
                }
                Node::Branches { parts, .. } => {
                    for part in parts {
                        self.block(module, &part.block, 1);
                    }
                }
                _ => {}
            }
        }
        self.doubts -= doubts;
    }

    fn statement(&mut self, module: usize, statement: &'m Statement) {
        let StatementKind::Instruction(call) = &statement.kind else { return };
        match (call.name.as_deref(), call.effect, call.arguments.required.as_slice()) {
            (None | Some("callbyvar"), ..)
            | (_, Effect::Jumps | Effect::Leaves | Effect::Returns, _) => self.doubts += 1,
            (Some("waitsynctask" | "syncmoveon"), _, [point, list]) => {
                let routine = statement.routine.as_deref().unwrap_or_default().to_lowercase();
                let has_parameters = !self.index.parameters(module, &routine).is_empty();
                let is_limited = call.arguments.optional.iter().any(|it| it.is("TimeOut"));
                if let Some((point, [], [])) = point.reference()
                    && let Some((list, [], [])) = list.reference()
                    && let Some(tasks) = self.lists.get(&list.to_lowercase())
                    && !(has_parameters || is_limited)
                {
                    let point = point.to_lowercase();
                    let is_certain = self.doubts == 0;
                    self.waits.push(Wait { module, statement, point, tasks, is_certain });
                }
            }
            (Some(name), ..) => self.call(module, name),
        }
    }
}

fn is_wait(statement: &Statement) -> bool {
    let word = statement.kind.word();
    ["WaitSyncTask", "SyncMoveOn"].iter().any(|it| it.eq_ignore_ascii_case(word))
}

/// The lists that have one value in all tasks, and that no statement may change.
fn lists_of<'m>(tasks: &[Task<'m>]) -> Lists<'m> {
    let mut lists = Lists::new();
    let statements = || tasks.iter().flat_map(|(_, of)| of).flat_map(|it| &it.statements);
    for statement in statements() {
        if let StatementKind::DatumOfType { name, type_name } = &statement.kind
            && type_name.eq_ignore_ascii_case("tasks")
            && statement.text.contains('"')
            && !statement.text.contains('!')
        {
            let quoted = statement.text.split('"').skip(1).step_by(2);
            let names: Vec<&str> = quoted.filter(|it| !it.trim().is_empty()).collect();
            let first = lists.entry(name.to_lowercase()).or_insert_with(|| names.clone());
            if *first != names {
                first.clear();
            }
        }
    }
    let is_other =
        |it: &&Statement| !is_wait(it) && !matches!(it.kind, StatementKind::DatumOfType { .. });
    for word in statements().filter(is_other).flat_map(|it| words_of(&it.text)) {
        lists.remove(&word.to_lowercase());
    }
    lists
}

/// The findings on the first of the tasks of a controller.
pub(super) fn check_tasks(tasks: &[Task<'_>], is_whole: Option<bool>) -> Vec<Finding> {
    // Most programs wait for no other.
    let own = tasks.first().into_iter().flat_map(|(_, of)| of);
    if !own.flat_map(|it| &it.statements).any(is_wait) {
        return Vec::new();
    }
    let lists = lists_of(tasks);
    let indices: Vec<Index<'_>> = tasks.iter().map(|(_, modules)| Index::new(modules)).collect();
    let courses: Vec<_> = indices.iter().map(|it| Course::new(it, &lists)).collect();
    let mut found = Vec::from_iter(stop(tasks, &courses));
    for wait in courses.iter().take(1).flat_map(|it| &it.waits) {
        for name in wait.tasks {
            let named = tasks.iter().zip(&courses);
            let mut named = named.filter(|((it, _), _)| it.eq_ignore_ascii_case(name)).peekable();
            let wrong = match named.peek() {
                None => "is no task of the controller",
                Some(_) => "never waits there",
            };
            if named.all(|(_, it)| it.is_whole && !it.uses.contains_key(&wait.point)) {
                found.push((wait, format!("{name} of its list {wrong}")));
            }
        }
    }
    let is_whole = is_whole == Some(true) && courses.iter().all(|it| it.is_whole);
    let finding = |(wait, words): (&Wait<'_>, String)| {
        let is_sure = is_whole && wait.is_certain;
        let assumed = (!is_sure).then(|| "all files loaded, and a run that gets here".to_string());
        let finding = Finding { assumed, ..Finding::new(Code::SyncDeadlock, words) };
        finding.at_statement(wait.statement, 0).in_module(wait.module)
    };
    found.into_iter().map(finding).collect()
}

/// The wait at which the first task stays, since tasks wait for each other, and why.
fn stop<'c, 'm>(tasks: &[Task<'_>], courses: &'c [Course<'m>]) -> Option<(&'c Wait<'m>, String)> {
    // The points at which a task certainly waits, once.
    let queues = tasks.iter().zip(courses).map(|((task, _), course)| {
        let is_met = |it: &&Wait<'_>| {
            let is_once = it.is_certain && course.uses.get(&it.point) == Some(&1);
            is_once && course.is_whole && it.tasks.iter().any(|it| it.eq_ignore_ascii_case(task))
        };
        course.waits.iter().filter(is_met).take(MOST).collect()
    });
    let mut queues: Vec<VecDeque<&Wait<'_>>> = queues.collect();
    let is_same = |a: &Wait<'_>, b: &Wait<'_>| a.point == b.point && a.tasks == b.tasks;
    // The task that has another point before this one.
    let late = |queues: &[VecDeque<&Wait<'_>>], wait: &Wait<'_>| {
        queues.iter().position(|it| it.iter().skip(1).any(|other| is_same(other, wait)))
    };
    loop {
        let mut fronts = queues.iter().filter_map(|it| it.front().copied());
        let Some(met) = fronts.find(|it| late(&queues, it).is_none()) else { break };
        for queue in &mut queues {
            if queue.front().is_some_and(|it| is_same(it, met)) {
                queue.pop_front();
            }
        }
    }
    let wait = *queues.first()?.front()?;
    let other = late(&queues, wait)?;
    let (task, modules) = &tasks[other];
    let before = queues[other].front()?;
    let line = before.statement.line;
    let module = modules[before.module].name().unwrap_or_default();
    Some((wait, format!("{task} waits for others before, in line {line} of {module}")))
}
