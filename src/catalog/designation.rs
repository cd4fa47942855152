//! ABB's type designations, as they are printed, as controllers configure them and as backups list
//! them: "IRB 4600-40/2.55", "ROB1_4600_2.55_40", "4600_2.55_40", "IRB 4600-40/2.55 Type C".

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::rows::{Row, rows};
use crate::catalog::fault::LeftOut;

/// Words of a designation that do not change the kinematics: Foundry, the hose package of a LeanID.
const WITHOUT_KINEMATICS: [&str; 3] = ["F", "MH6", "TYPE"];

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Designation {
    /// "IRB" or "CRB", if it is given.
    family: Option<String>,
    /// "4600", "2600ID".
    series: String,
    /// Payload [kg] and reach [m], in either order, without last zeros of decimals.
    figures: [String; 2],
    /// Other words that distinguish an arm, sorted: "LID", "LEFT".
    words: Vec<String>,
}

/// A run of digits with a point, or of letters in upper case; whether it follows the one before it
/// directly.
struct Run {
    text: String,
    is_number: bool,
    is_joined: bool,
}

impl Designation {
    /// The parts of a name; `None` if it has no series and two figures.
    pub(super) fn of(name: &str) -> Option<Self> {
        let runs = runs_of(name);
        let mut rest = &runs[..];
        let mut words = Vec::new();
        rest = after_robot(rest, &mut words);
        if let [maker, after @ ..] = rest
            && maker.text == "ABB"
        {
            rest = after;
        }
        let mut family = None;
        if let [first, after @ ..] = rest
            && matches!(first.text.as_str(), "IRB" | "CRB")
        {
            family = Some(first.text.clone());
            rest = after;
        }
        let (series, rest) = series_of(rest)?;
        let mut figures = Vec::new();
        for run in rest {
            if run.is_number && figures.len() < 2 {
                figures.push(figure(&run.text));
            } else if run.is_number && run.is_joined {
                // The number of a word: MH6.
                words.last_mut()?.push_str(&run.text);
            } else if run.is_number {
                return None;
            } else {
                words.push(run.text.clone());
            }
        }
        let figures = figures.try_into().ok()?;
        Some(Self { family, series, figures, words: distinguishing(&words) })
    }

    /// Whether an arm of the catalog has this designation. A final F of the series (Foundry) does
    /// not matter, nor does the family if it is not given.
    fn is_of(&self, arm: &Self) -> bool {
        self.is_of_series(arm)
            && self.shared_figures(arm) == 2
            && arm.shared_figures(self) == 2
            && self.words == arm.words
    }

    fn is_of_series(&self, arm: &Self) -> bool {
        (self.series == arm.series || self.series.strip_suffix('F') == Some(&arm.series))
            && (self.family.is_none() || self.family == arm.family)
    }

    /// Figures that an arm shares, in either order.
    fn shared_figures(&self, arm: &Self) -> usize {
        self.figures.iter().filter(|figure| arm.figures.contains(figure)).count()
    }
}

/// The runs behind `ROB1_`, `ROB_L_` or `ROB_R_`; the last two add the word LEFT or RIGHT.
fn after_robot<'a>(runs: &'a [Run], words: &mut Vec<String>) -> &'a [Run] {
    let [robot, rest @ ..] = runs else { return runs };
    if robot.text != "ROB" {
        return runs;
    }
    match rest {
        [number, rest @ ..] if number.is_number && number.is_joined => rest,
        [side, rest @ ..] if side.text == "L" || side.text == "R" => {
            words.push(if side.text == "L" { "LEFT".into() } else { "RIGHT".into() });
            rest
        }
        _ => rest,
    }
}

/// The series, a number and the letters joined to it, and the runs after it.
fn series_of(runs: &[Run]) -> Option<(String, &[Run])> {
    let [number, rest @ ..] = runs else { return None };
    if !number.is_number {
        return None;
    }
    match rest {
        [letters, rest @ ..] if letters.is_joined => {
            Some((format!("{}{}", number.text, letters.text), rest))
        }
        _ => Some((number.text.clone(), rest)),
    }
}

/// A figure without last zeros of its decimals; "05" is 0.5.
fn figure(text: &str) -> String {
    let mut figure = match text.strip_prefix('0') {
        Some(decimals) if decimals.starts_with(|c: char| c.is_ascii_digit()) => {
            format!("0.{decimals}")
        }
        _ => text.to_string(),
    };
    let point = figure.find('.');
    trim_decimals(&mut figure, point);
    figure
}

/// Remove the trailing zeros of a number, and its decimal point if nothing follows it.
pub(super) fn trim_decimals(text: &mut String, point: Option<usize>) {
    if let Some(point) = point {
        let zeros = text[point..].len() - text[point..].trim_end_matches('0').len();
        text.truncate(text.len() - zeros);
        if text.len() == point + 1 {
            text.truncate(point);
        }
    }
}

/// The words that distinguish an arm, sorted. The drive generation, TypeB or Type C, does not.
fn distinguishing(words: &[String]) -> Vec<String> {
    let mut kept = Vec::new();
    let mut before = "";
    for word in words {
        let generation = before == "TYPE" && word.len() == 1;
        let type_b = word.len() == 5 && word.starts_with("TYPE");
        before = word;
        match word.as_str() {
            "LEANID" => kept.push("LID".to_string()),
            other if generation || type_b || WITHOUT_KINEMATICS.contains(&other) => {}
            _ => kept.push(word.clone()),
        }
    }
    kept.sort();
    kept.dedup();
    kept
}

/// Runs of digits and of letters; a comma between digits is a decimal one.
fn runs_of(name: &str) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    let mut is_joined = false;
    let mut characters = name.chars().peekable();
    while let Some(c) = characters.next() {
        let in_number = runs.last().is_some_and(|run| run.is_number) && is_joined;
        let is_point = matches!(c, '.' | ',')
            && in_number
            && characters.peek().is_some_and(char::is_ascii_digit);
        if !is_point && !c.is_alphanumeric() {
            is_joined = false;
            continue;
        }
        let c = if is_point { '.' } else { c };
        let is_number = is_point || c.is_ascii_digit();
        match runs.last_mut() {
            Some(run) if is_joined && run.is_number == is_number => {
                run.text.extend(c.to_uppercase());
            }
            _ => runs.push(Run { text: c.to_uppercase().collect(), is_number, is_joined }),
        }
        is_joined = true;
    }
    runs
}

/// ABB's arms with their designations.
fn designated() -> impl Iterator<Item = (Row, Designation)> {
    let of_abb = rows().filter(|row| row.maker == "ABB");
    of_abb.filter_map(|row| Some((row, Designation::of(row.name)?)))
}

pub(super) fn arm_of(wanted: &Designation) -> Option<Row> {
    designated().find(|(_, arm)| wanted.is_of(arm)).map(|(row, _)| row)
}

/// Names of arms of this series: the ones with most of its figures, the same words first.
pub(super) fn close_to(wanted: &Designation) -> Vec<&'static str> {
    let of_series = || designated().filter(|(_, arm)| wanted.is_of_series(arm));
    let most = of_series().map(|(_, arm)| wanted.shared_figures(&arm)).max();
    let mut close: Vec<_> =
        of_series().filter(|(_, arm)| Some(wanted.shared_figures(arm)) == most).collect();
    close.sort_by_key(|(_, arm)| wanted.words != arm.words);
    close.into_iter().map(|(row, _)| row.name).collect()
}

/// The arm that is left out of the catalog with this name, as printed or as a controller
/// configures it.
pub(super) fn left_out(name: &str) -> Option<LeftOut> {
    let runs = runs_of(name);
    let rest = after_robot(&runs, &mut Vec::new());
    let (series, rest) = series_of(rest)?;
    let figures: Vec<_> = rest.iter().map(|run| run.text.as_str()).collect();
    let turned: Vec<_> = figures.iter().rev().copied().collect();
    // A palletizer's has one figure, others payload and reach in either order.
    [figures, turned]
        .iter()
        .find_map(|order| super::left_out::meant(&format!("IRB {series} {}", order.join(" "))))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(name: &str) -> Option<&'static str> {
        arm_of(&Designation::of(name)?).map(|arm| arm.name)
    }

    #[test]
    fn every_spelling_of_controllers_and_backups_is_found() {
        for (name, arm) in [
            ("ROB1_120_0.58_3", "IRB 120-3/0.58"),
            ("ROB1_140_0.81_6", "IRB 140-6/0.81"),
            ("ROB1_1200_0.9_5_TypeB", "IRB 1200-5/0.9"),
            ("1300_0.9_11", "IRB 1300-11/0.9"),
            ("CRB 1300-11/0.9 Type A", "CRB 1300-11/0.9"),
            ("1300F_1.4_7", "IRB 1300-7/1.4"),
            ("ROB1_1660ID_1.55_4", "IRB 1660ID-4/1.55"),
            ("2600_1.65_12", "IRB 2600-12/1.65"),
            ("ROB1_2600ID_2.00_8", "IRB 2600ID-8/2.0"),
            ("2600ID-8/2.00", "IRB 2600ID-8/2.0"),
            ("ROB12_4600_2.05_60", "IRB 4600-60/2.05"),
            ("rob2_4600_2.55_40", "IRB 4600-40/2.55"),
            ("IRB 4600-40/2.55 Type C", "IRB 4600-40/2.55"),
            ("ABB IRB4600-40/2,55 TypeC", "IRB 4600-40/2.55"),
            ("5720_90_3.00_LID", "IRB 5720-90/3.0 LID"),
            ("6600_2.55_175", "IRB 6600-175/2.55"),
            ("IRB 6600/2.55-175", "IRB 6600-175/2.55"),
            ("ROB1_6650S_3.90_90", "IRB 6650S-90/3.9"),
            ("ROB1_6660_1.90_205", "IRB 6660-205/1.9"),
            ("ROB1_6700_LeanID_2.65_220", "IRB 6700-220/2.65 (MH6, LeanID)"),
            ("ROB1_6700_3.20_150", "IRB 6700-150/3.2"),
            ("ROB1_6700_3.20_150_LID", "IRB 6700-150/3.2 (LeanID)"),
            ("ROB_L_14000_05_05", "IRB 14000-0.5/0.5 (left)"),
            ("ROB_R_14000_05_05_TYPEA", "IRB 14000-0.5/0.5 (right)"),
            ("ROB1_14050_0.5_0.5", "IRB 14050-0.5/0.5"),
        ] {
            assert_eq!(found(name), Some(arm), "{name}");
        }
    }

    #[test]
    fn parts_are_not_guessed() {
        for name in [
            "",
            "ROB1",
            "4600",
            "IRB 4600-40",
            "4600_2.55_41",
            "CRB 4600-40/2.55",
            "4600_2.55_40_LID",
            "4600_2.55_40_7",
            "5720_90_3.00",
            "14000_05_05",
            "4600F",
        ] {
            assert_eq!(found(name), None, "{name}");
        }
    }

    #[test]
    fn every_arm_is_found_by_its_own_name_with_figures_in_either_order() {
        for (arm, designation) in designated() {
            assert_eq!(arm_of(&designation).unwrap().name, arm.name);
            let [first, second] = designation.figures.clone();
            let turned = Designation { figures: [second, first], ..designation };
            assert_eq!(arm_of(&turned).unwrap().name, arm.name);
        }
    }

    #[test]
    fn arms_that_are_left_out_are_known_by_their_type_strings() {
        for (name, arm) in [
            ("ROB1_660_180", "IRB 260"),
            ("ROB3_760_3.2_450", "IRB 260"),
            ("360_1.6_6", "IRB 360"),
            ("ROB1_910SC_0.55_3", "IRB 910SC"),
            ("ROB1_6700_3.00_245", "IRB 6700-245/3.0, "),
        ] {
            assert!(left_out(name).unwrap().name.starts_with(arm), "{name}");
        }
        assert_eq!(left_out("ROB1_4600_2.55_40"), None);
        assert_eq!(left_out(""), None);
    }
}
