//! The arguments of a call compared with the parameters of a routine.

use alloc::format;
use alloc::string::String;

use super::table::Entry;
use crate::rapid::text::place::excerpt;

/// The parts of arguments as the header of a routine has them, each behind a comma, a backslash or
/// a bar.
pub(crate) fn parts(arguments: &str) -> impl Iterator<Item = (u8, &str)> {
    let (mut rest, mut sign) = (Some(arguments), b',');
    core::iter::from_fn(move || {
        loop {
            let (all, mut is_array) = (rest?, false);
            let end = all.bytes().position(|it| {
                is_array = it == b'{' || is_array && it != b'}';
                matches!(it, b',' | b'\\' | b'|') && !is_array
            });
            let (part, own) = (all[..end.unwrap_or(all.len())].trim_ascii(), sign);
            sign = end.map_or(b',', |end| all.as_bytes()[end]);
            rest = end.map(|end| &all[end + 1..]);
            if !part.is_empty() {
                return Some((own, part));
            }
        }
    })
}

/// The arguments of a call while they are read.
pub(crate) struct Fit<'s> {
    name: &'s str,
    /// The parameters of the routine; `None` if it is not known.
    pub(crate) arguments: Option<&'s str>,
    required: usize,
    /// The optional arguments that were given, by a bit for each with its alternatives.
    given: u64,
    /// What is wrong with an optional argument.
    pub(crate) wrong: Option<String>,
}

impl<'s> Fit<'s> {
    /// Of an instruction or a function of RAPID.
    pub(crate) fn of(entry: Option<&'static Entry>) -> Self {
        match entry {
            Some(entry) => Self::with(entry.name, Some(entry.arguments)),
            None => Self::with("", None),
        }
    }

    pub(crate) fn with(name: &'s str, arguments: Option<&'s str>) -> Self {
        Self { name, arguments, required: 0, given: 0, wrong: None }
    }

    /// Take a required argument; its number.
    pub(crate) fn required(&mut self) -> usize {
        self.required += 1;
        self.required
    }

    /// Take an optional argument.
    pub(crate) fn optional(&mut self, name: &str, has_value: bool) {
        let (Some(arguments), None) = (self.arguments, &self.wrong) else { return };
        let mut group = 0;
        for (sign, part) in parts(arguments) {
            group += u32::from(sign == b'\\');
            let part = part.split('{').next().unwrap_or(part);
            let mut words = part.split_ascii_whitespace();
            let (of, own) = (words.next().unwrap_or_default(), words.next_back().unwrap_or(part));
            if own == "..." {
                return;
            }
            if sign == b',' || !own.eq_ignore_ascii_case(name) {
                continue;
            }
            let bit = 1_u64.checked_shl(group).unwrap_or(0);
            if self.given & bit > 0 {
                self.wrong = Some(format!("\\{own} is given twice, or with an alternative of it"));
            } else if !has_value && !of.eq_ignore_ascii_case("switch") {
                self.wrong = Some(format!("\\{own} has no value, it must be \\{own}:=.."));
            }
            self.given |= bit;
            return;
        }
        self.wrong = Some(format!("it has no argument \\{name}: {}", self.shown()));
    }

    /// The fault of the arguments that were taken.
    pub(crate) fn finished(self) -> Option<String> {
        let arguments = self.arguments?;
        let (mut wanted, mut is_open) = (0, false);
        for (sign, part) in parts(arguments) {
            wanted += usize::from(sign == b',');
            is_open |= sign == b',' && part == "...";
        }
        if self.wrong.is_none() && !is_open && self.required != wanted {
            let (found, of) = (self.required, if self.required == 1 { "" } else { "s" });
            let shown = self.shown();
            return Some(format!("{found} required argument{of}, it must have {wanted}: {shown}"));
        }
        self.wrong
    }

    /// The routine with its arguments.
    fn shown(&self) -> String {
        let arguments = self.arguments.unwrap_or_default();
        format!("{} {}", self.name, excerpt(arguments))
    }
}
