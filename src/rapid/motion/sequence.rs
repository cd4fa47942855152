//! The moves of a routine in the order in which they are made.

use alloc::borrow::Cow;
use alloc::boxed::Box;
use alloc::collections::BTreeSet;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use crate::error::{Error, RapidFault, RapidFaultKind, RoutineFault};
use crate::rapid::data::instructions::Effect;
use crate::rapid::data::module::Module;
use crate::rapid::data::moves::{Move, MoveKind};
use crate::rapid::data::unread::{NotRead, Skipped};
use crate::rapid::program::walk::{Step, Stepped};

/// An item of a routine, for its place in the text.
#[derive(Clone, Copy)]
pub(in crate::rapid) enum Item<'m> {
    Move(usize, &'m Move),
    Skipped(&'m Skipped),
    Setting,
}

/// The steps of a routine, and its name; `None` for moves outside routines.
pub(super) fn sequence<'m>(
    module: &'m Module,
    routine: Option<&str>,
) -> Result<(Option<String>, Vec<Step<'m>>), Error> {
    let name = chosen(module, routine)?;
    let steps = Walk::default().through(module, items(module, name.as_deref()))?;
    if steps.iter().any(|step| matches!(step, Step::Move(_))) {
        return Ok((name, steps));
    }
    let routine = name.unwrap_or_else(|| "the text".to_string());
    Err(fault(0, RoutineFault::NoMoves { routine }))
}

fn fault(line: usize, fault: RoutineFault) -> Error {
    let kind = RapidFaultKind::Routine(fault);
    RapidFault { line, column: usize::from(line > 0), kind }.into()
}

/// The routine of a name; without one main, or the only one that moves.
fn chosen(module: &Module, wanted: Option<&str>) -> Result<Option<String>, Error> {
    let names = || module.routines().iter().map(|routine| routine.name.as_str());
    if let Some(wanted) = wanted {
        let found = names().find(|name| name.eq_ignore_ascii_case(wanted));
        let kind = || RoutineFault::Unknown { name: wanted.into(), known: names().collect() };
        return found.map(|name| Some(name.into())).ok_or_else(|| fault(0, kind()));
    }
    if let Some(main) = names().find(|name| name.eq_ignore_ascii_case("main")) {
        return Ok(Some(main.into()));
    }
    let moving: BTreeSet<Option<&str>> =
        module.moves().iter().map(|step| step.routine.as_deref()).collect();
    if moving.is_empty() {
        return Err(fault(0, RoutineFault::NoMoves { routine: "the module".into() }));
    }
    if let (Some(only), 1) = (moving.first(), moving.len()) {
        return Ok(only.map(String::from));
    }
    Err(fault(0, RoutineFault::Which { moving: moving.into_iter().flatten().collect() }))
}

/// The items of a routine in the order of the text.
fn items<'m>(module: &'m Module, name: Option<&str>) -> Vec<(usize, usize, Item<'m>)> {
    items_where(module, |routine| match (routine, name) {
        (Some(routine), Some(name)) => routine.eq_ignore_ascii_case(name),
        (None, None) => true,
        _ => false,
    })
}

/// The items of the routines that are wanted, in the order of the text, with lines and columns.
pub(in crate::rapid) fn items_where(
    module: &Module,
    is_wanted: impl Fn(Option<&str>) -> bool,
) -> Vec<(usize, usize, Item<'_>)> {
    let is_here = |routine: &Option<String>| is_wanted(routine.as_deref());
    let moves = module.moves().iter().enumerate();
    let moves = moves.filter(|(_, step)| is_here(&step.routine));
    let moves = moves.map(|(index, step)| {
        // The robot stays.
        let is_external = step.kind == MoveKind::MoveExtJ;
        let item = if is_external { Item::Setting } else { Item::Move(index, step) };
        (step.line, step.column, item)
    });
    let skipped = module.skipped().iter().filter(|skipped| is_here(&skipped.routine));
    let skipped = skipped.map(|it| (it.line, it.column, Item::Skipped(it)));
    let settings = module.settings.iter().filter(|setting| is_here(&setting.routine));
    let settings = settings.map(|it| (it.line, it.column, Item::Setting));
    let mut items: Vec<_> = moves.chain(skipped).chain(settings).collect();
    items.sort_by_key(|(line, column, _)| (*line, *column));
    items
}

fn move_of(index: usize, step: &Move) -> Step<'_> {
    let step = Cow::Borrowed(step);
    let stepped = Stepped {
        module: 0,
        instruction: (0, index),
        step,
        takes_last: false,
        halt: None,
        displaced_on: None,
    };
    Step::Move(Box::new(stepped))
}

fn not_followed(skipped: &Skipped, words: String) -> Step<'_> {
    Step::NotFollowed { module: 0, skipped, words }
}

/// The blocks that are open.
#[derive(Default)]
struct Walk<'m> {
    /// Line and word of the beginning of each.
    open: Vec<(usize, &'m str)>,
    /// Line of an IF without THEN, which the next item belongs to.
    single: Option<usize>,
}

impl<'m> Walk<'m> {
    fn through(
        mut self,
        module: &'m Module,
        items: Vec<(usize, usize, Item<'m>)>,
    ) -> Result<Vec<Step<'m>>, Error> {
        let moving = moving(module);
        let mut steps = Vec::with_capacity(items.len());
        for (_, _, item) in items {
            let skipped = match item {
                Item::Move(index, step) => {
                    self.check_certain()?;
                    steps.push(move_of(index, step));
                    continue;
                }
                Item::Setting => {
                    self.check_certain()?;
                    continue;
                }
                Item::Skipped(skipped) => skipped,
            };
            match &skipped.what {
                NotRead::Flow { word } => {
                    if !self.flow(skipped, word) {
                        break;
                    }
                    continue;
                }
                NotRead::Motion { .. } | NotRead::Unfinished { .. } | NotRead::Invalid { .. } => {
                    self.check_certain()?;
                    steps.push(not_followed(skipped, skipped.what.to_string()));
                }
                NotRead::Instruction { name } if Effect::Jumps.is_of(name) => {
                    let kind = RoutineFault::Branch { word: "GOTO".into() };
                    return Err(fault(skipped.line, kind));
                }
                NotRead::Instruction { name }
                    if Effect::Leaves.is_of(name) || Effect::Stops.is_of(name) =>
                {
                    self.check_certain()?;
                    break;
                }
                NotRead::Instruction { name } if Effect::Sets.is_of(name) => {
                    self.check_certain()?;
                    steps.push(not_followed(skipped, skipped.what.to_string()));
                }
                NotRead::Instruction { name } if moving.contains(&name.to_lowercase()) => {
                    self.check_certain()?;
                    let words =
                        format!("{name} is a routine of the module, its moves are not followed");
                    steps.push(not_followed(skipped, words));
                }
                _ => {}
            }
            self.single = None;
        }
        Ok(steps)
    }

    /// Refuse what a branch or a loop decides on.
    fn check_certain(&self) -> Result<(), Error> {
        let single = self.single.map(|line| (line, "IF"));
        match single.or_else(|| self.open.last().copied()) {
            None => Ok(()),
            Some((line, word)) => Err(fault(line, RoutineFault::Branch { word: word.into() })),
        }
    }

    /// Open or close a block; false where a handler begins, which is not part of the motion.
    fn flow(&mut self, skipped: &'m Skipped, word: &'m str) -> bool {
        self.single = None;
        match word {
            "IF" if !ends_with_then(&skipped.text) => self.single = Some(skipped.line),
            "IF" | "FOR" | "WHILE" | "TEST" => self.open.push((skipped.line, word)),
            "ENDIF" | "ENDFOR" | "ENDWHILE" | "ENDTEST" => {
                self.open.pop();
            }
            "ERROR" | "UNDO" | "BACKWARD" => return false,
            _ => {}
        }
        true
    }
}

pub(in crate::rapid) fn ends_with_then(text: &str) -> bool {
    let start = text.len().saturating_sub("THEN".len());
    text.get(start..).is_some_and(|end| end.eq_ignore_ascii_case("THEN"))
}

/// The names in lower case of routines with moves, or with calls or instructions that may move.
pub(in crate::rapid) fn moving(module: &Module) -> BTreeSet<String> {
    let of_moves = module.moves().iter().filter_map(|step| step.routine.as_deref());
    let mut moving: BTreeSet<&str> = of_moves.collect();
    let routines: BTreeSet<String> =
        module.routines().iter().map(|routine| routine.name.to_lowercase()).collect();
    moving.extend(module.skipped().iter().filter_map(|skipped| {
        let may_move = match &skipped.what {
            NotRead::Motion { .. } | NotRead::Unfinished { .. } | NotRead::Invalid { .. } => true,
            NotRead::Instruction { name } => routines.contains(&name.to_lowercase()),
            _ => false,
        };
        skipped.routine.as_deref().filter(|_| may_move)
    }));
    moving.into_iter().map(str::to_lowercase).collect()
}
