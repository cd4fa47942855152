//! Finds arms by name: normalizes spelling, and lists the names closest to an unknown one.

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::iter;

use super::designation::{self, Designation, trim_decimals};
use super::rows::{Row, rows};
use super::{CatalogArm, left_out};
use crate::catalog::fault::UnknownRobot;
use crate::error::Error;
#[cfg(feature = "std")]
use crate::spelling::similar;

/// Number of close names in the message for an unknown one.
const MOST_CLOSE: usize = 6;

/// Bytes of the longest name that is looked up: three times the longest designation.
const LONGEST: usize = 200;

/// Other names of arms.
const ALIASES: &[(&str, &str)] = &[
    ("Franka Emika Panda", "Panda"),
    ("Franka Emika Robot", "Panda"),
    ("FER", "Panda"),
    ("Franka Research 3", "FR3"),
    ("IRB 14050", "IRB 14050-0.5/0.5"),
    ("YuMi left", "IRB 14000-0.5/0.5 (left)"),
    ("YuMi right", "IRB 14000-0.5/0.5 (right)"),
    ("IRB 14000 left", "IRB 14000-0.5/0.5 (left)"),
    ("IRB 14000 right", "IRB 14000-0.5/0.5 (right)"),
    ("GoFa 5", "CRB 15000-5/0.95"),
    ("GoFa 10", "CRB 15000-10/1.52"),
    ("GoFa 12", "CRB 15000-12/1.27"),
    ("UFACTORY xArm 6", "xArm6"),
    ("SO-ARM101", "SO-101"),
    ("VX300", "ViperX 300"),
];

pub(super) fn aliases(name: &'static str) -> impl Iterator<Item = &'static str> {
    ALIASES.iter().filter(move |(_, of)| *of == name).map(|(alias, _)| *alias)
}

/// Finds an arm by its name or an alias, the maker's name before it or not; case, blanks, dashes,
/// `_`, `/`, `,`, parentheses and the last zeros of a decimal (2.50, 2,5) do not matter.
///
/// An ABB arm is also found by the type string of a controller's configuration
/// (`ROB1_4600_2.55_40`, `ROB_L_14000_05_05`) and by the wording of a backup (`6600/2.55-175`,
/// `IRB 4600-40/2.55 Type C`): series, payload and reach in either order, with or without `IRB`.
/// The drive generation (`Type C`) and Foundry (`1300F`) do not matter.
///
/// Names are not guessed: a name that lacks a figure is unknown, even if only one arm has it; so is
/// one of more than 200 bytes.
///
/// # Errors
///
/// [`Error::UnknownRobot`] with the reason for which the arm is left out, or with up to six names
/// that are close, the closest first.
pub fn find(name: &str) -> Result<CatalogArm, Error> {
    if name.len() > LONGEST {
        let name = format!("{name:.20}..");
        return Err(UnknownRobot { name, close: Vec::new(), left_out: None }.into());
    }
    let alias = ALIASES.iter().find(|(alias, _)| *alias == name);
    let exact = alias.map_or(name, |(_, name)| name);
    if let Some(arm) = rows().find(|row| row.name == exact).and_then(Row::arm) {
        return Ok(arm);
    }
    let wanted = squeezed(name);
    let is_meant = |row: &Row| {
        let own = squeezed(row.name);
        let after_maker = wanted.strip_prefix(squeezed(row.maker).as_str());
        own == wanted
            || after_maker.is_some_and(|rest| rest == own)
            || aliases(row.name).any(|alias| squeezed(alias) == wanted)
    };
    let designation = Designation::of(name);
    let designated = || designation.as_ref().and_then(designation::arm_of);
    rows().find(is_meant).or_else(designated).and_then(Row::arm).ok_or_else(|| {
        let left_out = left_out::meant(name).or_else(|| designation::left_out(name));
        let mut close = Vec::new();
        if left_out.is_none() {
            let of_series = designation.iter().flat_map(designation::close_to);
            close.extend(of_series.take(MOST_CLOSE));
            if close.is_empty() {
                close = close_to(&wanted);
            }
        }
        Error::UnknownRobot(UnknownRobot { name: name.to_owned(), close, left_out })
    })
}

/// A name without the characters that do not matter.
fn squeezed(name: &str) -> String {
    let mut squeezed = String::new();
    let mut point = None;
    let mut before = ' ';
    let mut characters = name.chars().peekable();
    while let Some(c) = characters.next() {
        // A decimal comma.
        let c = if c == ','
            && before.is_ascii_digit()
            && characters.peek().is_some_and(char::is_ascii_digit)
        {
            '.'
        } else {
            c
        };
        before = c;
        if !c.is_ascii_digit() {
            trim_decimals(&mut squeezed, point.take());
        }
        if c == '.' {
            point = Some(squeezed.len());
        }
        if !c.is_whitespace()
            && !matches!(
                c,
                '-' | '\u{2010}'..='\u{2015}' | '\u{2212}' | '_' | '/' | ',' | '(' | ')'
            )
        {
            squeezed.extend(c.to_lowercase());
        }
    }
    trim_decimals(&mut squeezed, point);
    squeezed
}

/// Names and aliases that contain the wanted one, one of an arm, the earlier in the name the closer;
/// if there are none, those with a similar spelling.
fn close_to(wanted: &str) -> Vec<&'static str> {
    if wanted.is_empty() {
        return Vec::new();
    }
    let of_maker = rows().filter(|row| squeezed(row.maker) == wanted);
    let of_maker: Vec<_> = of_maker.map(|row| row.name).take(MOST_CLOSE).collect();
    if !of_maker.is_empty() {
        return of_maker;
    }
    let place = |name: &'static str| Some((squeezed(name).find(wanted)?, name));
    let mut holding: Vec<_> = rows().filter_map(|row| names_of(row).find_map(place)).collect();
    if holding.is_empty() {
        return spelled_like(wanted);
    }
    holding.sort_by_key(|&(place, _)| place);
    holding.into_iter().map(|(_, name)| name).take(MOST_CLOSE).collect()
}

/// The name of an arm and its aliases.
fn names_of(row: Row) -> impl Iterator<Item = &'static str> {
    iter::once(row.name).chain(aliases(row.name))
}

/// Names with a spelling similar to the wanted one, or with the same beginning.
#[cfg(feature = "std")]
fn spelled_like(wanted: &str) -> Vec<&'static str> {
    /// Fraction of the letters that must match [1]: with a smaller one, an arm of another series
    /// and maker would be close.
    const LEAST_SIMILARITY: f64 = 0.7;
    let similarity = |name: &str| {
        let name = squeezed(name);
        let start: String = name.chars().take(wanted.chars().count()).collect();
        let [whole, start] =
            [name, start].map(|name| strsim::normalized_damerau_levenshtein(&name, wanted));
        whole.max(start)
    };
    let mut close = similar(rows().flat_map(names_of), similarity, LEAST_SIMILARITY);
    close.truncate(MOST_CLOSE);
    close
}

#[cfg(not(feature = "std"))]
fn spelled_like(_: &str) -> Vec<&'static str> {
    Vec::new()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::catalog;

    #[test]
    fn irrelevant_characters_are_removed_from_names() {
        for (name, wanted) in [
            ("IRB 2600-12/1.65", "irb2600121.65"),
            ("IRB 4600-20/2.50", "irb4600202.5"),
            ("IRB5720-90/3.00LID", "irb5720903lid"),
            ("irb 6700-220/2.65 (MH6, LeanID)", "irb67002202.65mh6leanid"),
            ("IRB 100", "irb100"),
            ("0.0", "0"),
            ("1.0.0", "1"),
            (".", ""),
            (" ", ""),
        ] {
            assert_eq!(squeezed(name), wanted, "{name}");
        }
    }

    #[test]
    fn aliases_and_makers_are_found() {
        for (alias, name) in ALIASES {
            assert_eq!(find(alias).unwrap().name, *name);
        }
        for arm in catalog() {
            assert_eq!(find(&format!("{} {}", arm.maker, arm.name)).unwrap().name, arm.name);
        }
        assert!(find("ABB UR5e").is_err());
    }

    #[test]
    fn no_two_arms_have_the_same_name() {
        let mut names: Vec<_> = catalog().map(|arm| squeezed(arm.name)).collect();
        names.extend(ALIASES.iter().map(|(alias, _)| squeezed(alias)));
        let count = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count);
    }
}
