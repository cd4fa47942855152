//! The arguments of a call compared with the parameters of a routine.

use crate::prelude::*;
use crate::rapid::text::place::excerpt;

/// The parts of arguments as the header of a routine has them, each behind a comma, a backslash or
/// a bar.
pub(crate) fn parts(arguments: &str) -> impl Iterator<Item = (u8, &str)> + Clone {
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

/// The fault of the arguments of a call of a routine with a name and parameters: the number of the
/// required ones, and the optional ones with whether each has a value.
pub(crate) fn misfit<'o>(
    routine: (&str, &str),
    required: usize,
    optional: impl Iterator<Item = (&'o str, bool)>,
) -> Option<String> {
    let shown = || format!("{} {}", routine.0, excerpt(routine.1));
    // A bit for each optional parameter with its alternatives.
    let mut given = 0_u64;
    for (name, has_value) in optional {
        let mut group = 0;
        let mut all = parts(routine.1).map(|(sign, part)| {
            group += u32::from(sign == b'\\');
            (sign, group, part)
        });
        let found = all.find_map(|(sign, group, part)| {
            let part = part.split('{').next().unwrap_or(part);
            let mut words = part.split_ascii_whitespace();
            let data_type = words.next().unwrap_or_default();
            let own = words.next_back().unwrap_or(part);
            let is_it = own == "..." || sign != b',' && own.eq_ignore_ascii_case(name);
            is_it.then_some((group, data_type, own))
        });
        let Some((group, data_type, own)) = found else {
            return Some(format!("it has no argument \\{name}: {}", shown()));
        };
        if own == "..." {
            continue;
        }
        let bit = 1_u64.checked_shl(group).unwrap_or(0);
        if given & bit > 0 {
            return Some(format!("\\{own} is given twice, or with an alternative of it"));
        }
        if !has_value && !data_type.eq_ignore_ascii_case("switch") {
            return Some(format!("\\{own} has no value, it must be \\{own}:=.."));
        }
        given |= bit;
    }
    let wanted = parts(routine.1).filter(|(sign, _)| *sign == b',');
    let is_open = wanted.clone().any(|(_, part)| part == "...");
    let wanted = wanted.count();
    if is_open || required == wanted {
        return None;
    }
    let of = if required == 1 { "" } else { "s" };
    Some(format!("{required} required argument{of}, it must have {wanted}: {}", shown()))
}
