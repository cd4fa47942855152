//! Declarations of data and the names of a scope.

use core::ops::Range;

use alloc::boxed::Box;
use alloc::collections::BTreeMap;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::expression::{Expression, ExpressionReader};
use super::kind::DataType;
use super::module::{Content, Scope, Storage};
use super::skipping::skip_balanced;
use super::tokens::{TokenKind, Tokens};
use super::words::is_name;
use crate::error::{RapidFault, RapidFaultKind};

/// A declaration of a type that is read, before its names are looked up.
pub(super) struct Declared<'a> {
    pub(super) name: &'a str,
    pub(super) data_type: DataType,
    pub(super) scope: Scope,
    pub(super) storage: Storage,
    /// Index of the routine, from 1; 0 for the module.
    pub(super) routine: usize,
    pub(super) sizes: Vec<Expression<'a>>,
    pub(super) value: Option<Expression<'a>>,
    /// Names that its sizes and its value refer to.
    pub(super) names: Vec<&'a str>,
    /// How many of the names, the first, are those of the sizes.
    pub(super) size_names: usize,
    /// Bytes of the statement with its semicolon.
    pub(super) start: usize,
    pub(super) end: usize,
    /// Where a value would stand, if there is none.
    pub(super) value_place: usize,
    pub(super) line: usize,
    pub(super) column: usize,
    /// What it holds, where that was known without any name.
    pub(super) content: Option<Box<Placed>>,
}

/// A content with the bytes of its value and of its elements.
pub(super) type Placed = (Content, Range<usize>, Vec<Range<usize>>);

/// What was declared.
pub(super) enum Declaration<'a> {
    Read(Declared<'a>),
    /// Of a type that is not read.
    Unread {
        name: &'a str,
        type_name: &'a str,
    },
    /// With a placeholder, perhaps for its name.
    Unfinished {
        name: &'a str,
    },
}

/// Storage of the next token, where it is one's word.
pub(super) fn storage_at(tokens: &Tokens<'_>) -> Option<Storage> {
    let words = [("CONST", Storage::Const), ("PERS", Storage::Pers), ("VAR", Storage::Var)];
    words.into_iter().find(|(word, _)| tokens.at_word(word)).map(|(_, storage)| storage)
}

/// A name of something declared, or the placeholder of one, which is the next token.
pub(super) fn read_name<'a>(tokens: &mut Tokens<'a>, wanted: &str) -> Result<&'a str, RapidFault> {
    let token = tokens.peek();
    let may = match token.kind {
        TokenKind::Name => is_name(tokens.text_of(token)),
        kind => kind == TokenKind::Placeholder,
    };
    if !may {
        return Err(tokens.unexpected(wanted));
    }
    tokens.take()?;
    Ok(tokens.text_of(token))
}

/// Whether it stands for a name that the program does not have yet.
pub(super) fn is_placeholder(name: &str) -> bool {
    name.starts_with('<')
}

/// Reads a declaration from its storage to its semicolon; it begins, perhaps with LOCAL or TASK, at byte `start`.
pub(super) fn read_declaration<'a>(
    tokens: &mut Tokens<'a>,
    start: usize,
    scope: Scope,
    storage: Storage,
) -> Result<Declaration<'a>, RapidFault> {
    let from = tokens.take()?.start;
    let type_name = read_name(tokens, "a type")?;
    let name = read_name(tokens, "a name")?;
    let Some(data_type) = DataType::named(type_name) else {
        skip_balanced(tokens, |_, _| false)?;
        tokens.demand(b';', "a semicolon")?;
        let unfinished = tokens.unfinished_since(from);
        return Ok(if unfinished {
            Declaration::Unfinished { name }
        } else {
            Declaration::Unread { name, type_name }
        });
    };
    let (line, column) = tokens.line_and_column(start);
    let (sizes, names) = ExpressionReader::new(tokens).sizes()?;
    let value_place = tokens.last_end;
    let mut declared = Declared {
        name,
        data_type,
        scope,
        storage,
        routine: 0,
        sizes,
        value: None,
        size_names: names.len(),
        names,
        start,
        end: start,
        value_place,
        line,
        column,
        content: None,
    };
    if tokens.peek().kind == TokenKind::Assign {
        tokens.take()?;
        let mut reader = ExpressionReader::new(tokens);
        declared.value = Some(reader.expression()?);
        declared.names.append(&mut reader.names);
    }
    tokens.demand(b';', "a semicolon")?;
    declared.end = tokens.last_end;
    if tokens.unfinished_since(from) {
        return Ok(Declaration::Unfinished { name });
    }
    Ok(Declaration::Read(declared))
}

/// What a name stands for.
#[derive(Clone)]
pub(super) enum Named {
    /// Data, by their index.
    Datum(usize),
    /// Something that has no value here, in words.
    Other(String),
}

/// The names of the module and of each routine.
pub(super) struct Scopes {
    /// By the index of the routine, from 1; 0 for the module. Names are in lower case.
    names: Vec<BTreeMap<String, Named>>,
}

impl Scopes {
    pub(super) fn new() -> Self {
        Self { names: Vec::from([BTreeMap::new()]) }
    }

    /// Begins the scope of the next routine.
    pub(super) fn add_routine(&mut self) {
        self.names.push(BTreeMap::new());
    }

    /// Declares a name, which must not be there yet; `routine_name` is for the message. A placeholder declares nothing.
    pub(super) fn declare(
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

    /// What a name in lower case stands for, in a routine or else in the module.
    pub(super) fn find(&self, routine: usize, lower: &str) -> Option<&Named> {
        let local = if routine > 0 {
            self.names.get(routine).and_then(|scope| scope.get(lower))
        } else {
            None
        };
        local.or_else(|| self.names.first().and_then(|scope| scope.get(lower)))
    }

    /// Data of the module by their names in lower case.
    pub(super) fn module_data(self) -> impl Iterator<Item = (String, usize)> {
        let module = self.names.into_iter().next().unwrap_or_default();
        module.into_iter().filter_map(|(name, named)| match named {
            Named::Datum(index) => Some((name, index)),
            Named::Other(_) => None,
        })
    }
}
