//! Arms that have a public table, or a well-known name, and are not in the catalog: which, and why.

use alloc::string::String;
use alloc::vec::Vec;

use crate::catalog::fault::LeftOut;

/// An arm, and the words of a name that mean it.
struct Entry {
    arm: LeftOut,
    words: &'static [&'static str],
}

const fn entry(name: &'static str, words: &'static [&'static str], reason: &'static str) -> Entry {
    Entry { arm: LeftOut { name, reason }, words }
}

const ENTRIES: &[Entry] = &[
    entry(
        "IRB 6700-245/3.0, 6700-300/2.7",
        &["IRB 6700-245", "IRB 6700-300"],
        "unsettled: RobotComponents has a1 320 and c4 250, robotkinematicscatalogue a1 350 and c4 \
         220. The reach of the name, 3.0 and 2.7 m, does not decide: the lengths give 2.94 or 2.97 \
         m and 2.69 or 2.72 m",
    ),
    entry(
        "IRB 6700-245/3.0 (SpotPack)",
        &["IRB 6700-245/3.0 SpotPack", "SpotPack"],
        "the same arm with another wrist (a1 350, c4 380), one source",
    ),
    entry(
        "IRB 6400/2.8-120",
        &["IRB 6400/2.8-120"],
        "unsettled: its one source has a forearm of 1705 mm, which reaches 3.01 m and not 2.8",
    ),
    entry(
        "IRB 1090-3.5/0.58",
        &["IRB 1090"],
        "one source, without limits: a program with the lengths of the IRB 1100-4/0.58",
    ),
    entry(
        "IRB 1300-12/1.4",
        &["IRB 1300-12"],
        "no source has its limits; work-r-labs/robots has the lengths of the IRB 1300-7/1.4, but \
         for c4",
    ),
    entry(
        "IRB 6710-210/2.65",
        &["IRB 6710"],
        "one source, a student's: a1 320, a2 -200, c1 780, c2 1185, c3 1142, c4 180, limits of the \
         IRB 6760-200/3.2",
    ),
    entry(
        "IRB 6730S-150/4.0",
        &["IRB 6730S"],
        "no source has its lengths. RobotStudio has +-170, -40..160, -180..70, +-300, +-130, +-360 \
         deg; axis 3 depends on axis 2: from -145 deg at -40, from -180 deg at -17 and above",
    ),
    entry(
        "IRB 6740-230/3.0 LID, 6740-220/3.2 LID",
        &["IRB 6740"],
        "no source has a2, c1 and limits. ABB's manual 3HAC085701 has a1 350, c2 1225, c3 1412.5 \
         and 1592.5, c4 380 and 350",
    ),
    entry(
        "IRB 6750S-185/3.9 LID",
        &["IRB 6750S"],
        "one source, work-r-labs/robots, without the flange: a1 690, a2 -200, c1 530, c2 1280, c3 \
         1922.5",
    ),
    entry(
        "IRB 7710, 7720",
        &["IRB 7710", "IRB 7720"],
        "no source has their lengths. ABB's data sheet has +-170, -65..85.2, -27..130 (from the \
         base), +-300, +-130, +-360 deg",
    ),
    entry(
        "CRX-5iA, 20iA/L, 30iA",
        &["CRX-5iA", "CRX-20iA/L", "CRX-30iA"],
        "one source, the maker's URDF: `from_urdf` takes it",
    ),
    entry(
        "HC10, HC10DT",
        &["HC10", "HC10DT"],
        "one source, the URDF of ros-industrial: `from_urdf` takes it",
    ),
    entry(
        "xMate SR3, SR4, CR7",
        &["xMate"],
        "one source for the CR7, none that was read for the others",
    ),
    entry(
        "JACO2 (j2n6)",
        &["JACO2", "JACO 2", "j2n6"],
        "one source, the maker's URDF: `from_urdf` takes it",
    ),
    entry(
        "Gen3 lite",
        &["Gen3 lite"],
        "unsettled: the maker's URDF and robotkinematicscatalogue agree on the lengths, not on the \
         limits nor on the zeros of the joints",
    ),
    entry(
        "IRB 5400-22, 5500-23, 5500-27, 580-12S, 580-16 (painters)",
        &["IRB 5400", "IRB 5500", "IRB 580"],
        "no spherical wrist: hollow, with bends of 35 deg",
    ),
    entry(
        "IRB 260, 460, 660-180, 660-250, 760 (palletizers)",
        &["IRB 260", "IRB 460", "IRB 660", "IRB 760"],
        "four axes, a second linkage keeps the flange level",
    ),
    entry(
        "IRB 910SC-3, 920T-6-0.55, 920T-6-0.65 (SCARA)",
        &["IRB 910SC", "IRB 920T", "SCARA"],
        "four axes, one of them prismatic",
    ),
    entry(
        "IRB 360 (FlexPicker)",
        &["IRB 360", "FlexPicker"],
        "a delta: no serial chain, and no table was found",
    ),
    entry(
        "CRB 1100, IRB 1400",
        &["CRB 1100", "IRB 1400"],
        "no table was found; the 1100 and the 1410 are likely to be the same arms",
    ),
];

/// The arms that are left out of the catalog.
pub fn left_out() -> impl Iterator<Item = LeftOut> {
    ENTRIES.iter().map(|entry| entry.arm)
}

/// The arm that a name means, if it is one of these: the one with the most words in the name.
pub(super) fn meant(name: &str) -> Option<LeftOut> {
    let wanted = words_of(name);
    let length = |entry: &Entry| {
        let held = entry
            .words
            .iter()
            .map(|words| words_of(words))
            .filter(|words| wanted.windows(words.len()).any(|part| part == &words[..]));
        held.map(|words| words.len()).max()
    };
    let meant = ENTRIES.iter().filter_map(|entry| Some((length(entry)?, entry.arm)));
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
