//! Solutions as a table of text, in degrees.

use crate::kinematics::{JointLimits, SingularityKind, Solution};

/// Most rows that are shown: turns may be a million.
const MOST_ROWS: usize = 48;

/// The cells of a solution: slot, angles [deg], limits, singularities.
fn cells<const N: usize>(solution: &Solution<N>, limits: &JointLimits<N>) -> Vec<String> {
    // Adding 0 takes the sign of -0 away.
    let degrees = |angle: f64| (angle.to_degrees() * 1e3).round() / 1e3 + 0.0;
    let angles = solution.q.iter().map(|&angle| format!("{:.3}", degrees(angle)));
    let mut cells = vec![solution.slot.to_string()];
    cells.extend(angles);
    cells.push(outside(solution, limits));
    cells.push(singularities(solution));
    cells
}

/// "inside", or the joints that are outside.
fn outside<const N: usize>(solution: &Solution<N>, limits: &JointLimits<N>) -> String {
    if solution.is_within_limits() {
        return "inside".to_owned();
    }
    let beyond = (0..N).filter(|&joint| limits.excess(joint, solution.q[joint]) > 0.0);
    let mut names: Vec<String> = beyond.map(|joint| format!("J{}", joint + 1)).collect();
    if limits.linkage_excess(&solution.q) > 0.0 {
        names.push("linkage".to_owned());
    }
    format!("{} outside", names.join(", ")).trim_start().to_owned()
}

fn singularities<const N: usize>(solution: &Solution<N>) -> String {
    let kinds = [
        (SingularityKind::WRIST, "wrist"),
        (SingularityKind::ELBOW, "elbow"),
        (SingularityKind::SHOULDER, "shoulder"),
    ];
    let mut words: Vec<String> = kinds
        .into_iter()
        .filter(|(kind, _)| solution.singularities().contains(*kind))
        .map(|(_, word)| word.to_owned())
        .collect();
    if let Some(free) = solution.free_joint {
        words.push(format!("J{} free ({} fixed)", free.joint(), free.fixed()));
    }
    words.join(", ")
}

/// The head and the rows that are shown.
fn rows<const N: usize>(solutions: &[Solution<N>], limits: &JointLimits<N>) -> Vec<Vec<String>> {
    let mut head = vec!["slot".to_owned()];
    head.extend((1..=N).map(|joint| format!("q{joint} [deg]")));
    head.extend(["limits".to_owned(), "singularities".to_owned()]);
    let shown = solutions.iter().take(MOST_ROWS).map(|solution| cells(solution, limits));
    [head].into_iter().chain(shown).collect()
}

/// How many rows are not shown, in words.
fn rest(count: usize) -> Option<String> {
    (count > MOST_ROWS).then(|| format!("... {} more", count - MOST_ROWS))
}

/// A line on the outcome, then a row for each solution.
pub(super) fn text<const N: usize>(
    outcome: &str,
    solutions: &[Solution<N>],
    limits: &JointLimits<N>,
) -> String {
    let mut lines = vec![outcome.to_owned()];
    if !solutions.is_empty() {
        let rows = rows(solutions, limits);
        let widest = |column: usize| rows.iter().map(|row| row[column].len()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..N + 3).map(widest).collect();
        lines.extend(rows.iter().map(|row| {
            let padded = row.iter().zip(&widths).enumerate().map(|(column, (cell, &width))| {
                // Numbers end, words begin at one place.
                if column <= N { format!("{cell:>width$}") } else { format!("{cell:<width$}") }
            });
            padded.collect::<Vec<_>>().join("  ").trim_end().to_owned()
        }));
        lines.extend(rest(solutions.len()));
    }
    lines.join("\n")
}
