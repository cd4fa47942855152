//! Arms that have a public table, or a well-known name, and are not in the catalog: which, and why.

use alloc::string::String;
use alloc::vec::Vec;

use crate::catalog::fault::LeftOut;

/// Three lines an arm: its name, the words of a name that mean it, and why it is left out.
const ARMS: &str = include_str!("left_out.txt");

/// The arms, and the words of a name that mean them.
fn entries() -> impl Iterator<Item = (LeftOut, &'static str)> {
    ARMS.split("\n\n").filter_map(|lines| {
        let mut lines = lines.lines();
        let (name, words, reason) = (lines.next()?, lines.next()?, lines.next()?);
        Some((LeftOut { name, reason }, words))
    })
}

/// The arms that are left out of the catalog.
pub fn left_out() -> impl Iterator<Item = LeftOut> {
    entries().map(|(arm, _)| arm)
}

/// The arm that a name means, if it is one of these: the one with the most words in the name.
pub(super) fn meant(name: &str) -> Option<LeftOut> {
    let wanted = words_of(name);
    let length = |words: &str| {
        let held = words
            .split("; ")
            .map(words_of)
            .filter(|words| wanted.windows(words.len()).any(|part| part == &words[..]));
        held.map(|words| words.len()).max()
    };
    let meant = entries().filter_map(|(arm, words)| Some((length(words)?, arm)));
    meant.max_by_key(|&(length, _)| length).map(|(_, arm)| arm)
}

/// Runs of letters, in lower case, and numbers: "IRB 910SC-3" is irb, 910, sc, 3.
fn words_of(name: &str) -> Vec<String> {
    let kind = |c: char| match c {
        '0'..='9' | '.' => Some(true),
        c if c.is_alphabetic() => Some(false),
        _ => None,
    };
    let mut words: Vec<String> = Vec::new();
    let mut before = None;
    for c in name.chars() {
        let now = kind(c);
        if now.is_some() {
            match words.last_mut() {
                Some(word) if now == before => word.extend(c.to_lowercase()),
                _ => words.push(c.to_lowercase().collect()),
            }
        }
        before = now;
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_means_the_arm_with_the_most_of_its_words() {
        for (name, arm) in [
            ("CRX-30iA", Some("CRX-5iA")),
            ("fanuc crx 20ia/l", Some("CRX-5iA")),
            ("CRX-10iA/L", None),
            ("GoFa", None),
            ("Kinova Gen3 lite", Some("Gen3 lite")),
            ("IRB 260", Some("IRB 260")),
            ("irb_460", Some("IRB 260")),
            ("IRB 4600", None),
            ("IRB 2600", None),
            ("IRB 910SC-3/0.45", Some("IRB 910SC")),
            ("IRB 6700-245/3.0", Some("IRB 6700-245/3.0, ")),
            ("IRB 6700-245/3.0 (SpotPack)", Some("IRB 6700-245/3.0 (SpotPack)")),
            ("IRB 6400/2.8-120", Some("IRB 6400/2.8-120")),
            ("IRB 6730S-150/4.0", Some("IRB 6730S")),
            ("IRB 1300-12/1.4", Some("IRB 1300-12")),
            ("IRB 6400", None),
            ("", None),
        ] {
            let meant = meant(name).map(|meant| meant.name);
            match (meant, arm) {
                (Some(meant), Some(arm)) => assert!(meant.starts_with(arm), "{name}: {meant}"),
                (meant, arm) => assert_eq!(meant, arm, "{name}"),
            }
        }
    }

    #[test]
    fn no_arm_of_the_catalog_is_left_out() {
        for arm in super::super::catalog() {
            assert_eq!(meant(arm.name), None, "{}", arm.name);
        }
    }
}
