//! Solutions as a table of text, in degrees.

use irbkin::thresholds::{NEAR_ANGLE, NEAR_LENGTH};
use irbkin::{Configuration, JointLimits, Robot, Solution};

/// Most rows that are shown: turns may be a million.
const MOST_ROWS: usize = 48;

/// The cells of a solution: slot, angles [deg], limits, margin [deg], confdata, singularities.
fn cells<const N: usize>(solution: &Solution<N>, robot: &Robot<N>) -> Vec<String> {
    let angles = solution.q.iter().map(|&angle| format!("{:.3}", rounded(angle.to_degrees(), 1e3)));
    let mut cells = vec![solution.slot.to_string()];
    cells.extend(angles);
    cells.push(outside(solution, robot.limits()));
    cells.push(margin(&solution.q, robot.limits()));
    if robot.configuration_rule().is_ok() {
        let confdata = robot.configuration(&solution.q);
        cells.push(confdata.map_or_else(
            |_| String::new(),
            |confdata| {
                let Configuration { cf1, cf4, cf6, cfx } = confdata;
                format!("[{cf1},{cf4},{cf6},{cfx}]")
            },
        ));
    }
    cells.push(singularities(solution, robot));
    cells
}

/// A number to so many parts of 1. Adding 0 takes the sign of -0 away.
fn rounded(number: f64, parts: f64) -> f64 {
    (number * parts).round() / parts + 0.0
}

/// The angle to the nearest limit [deg], negative outside, and whose limit it is; empty without
/// limits.
fn margin<const N: usize>(q: &[f64; N], limits: &JointLimits<N>) -> String {
    let joint = limits.nearest(q).map(|(joint, room)| (room, format!("J{joint}")));
    let linkage = limits.linkage().map(|_| (-limits.linkage_overrun(q), "linkage".to_owned()));
    let least =
        joint.into_iter().chain(linkage).min_by(|(one, _), (other, _)| one.total_cmp(other));
    least.filter(|(room, _)| room.is_finite()).map_or_else(String::new, |(room, name)| {
        format!("{:>6.1} {name}", rounded(room.to_degrees(), 1e1))
    })
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

/// The singularities that a solution is at, then those that it is near.
fn singularities<const N: usize>(solution: &Solution<N>, robot: &Robot<N>) -> String {
    let at = solution.singularities();
    let near = robot.singularity(&solution.q).near(NEAR_ANGLE, NEAR_LENGTH) - at;
    let mut words: Vec<String> = at.words().map(str::to_owned).collect();
    words.extend(near.words().map(|word| format!("near {word}")));
    if let Some(free) = solution.free_joint {
        words.push(format!("J{} free ({} fixed)", free.joint(), free.fixed()));
    }
    words.join(", ")
}

/// The head and the rows that are shown.
fn rows<const N: usize>(solutions: &[Solution<N>], robot: &Robot<N>) -> Vec<Vec<String>> {
    let mut head = vec!["slot".to_owned()];
    // The unit of all, once: the table is wide.
    head.push("q1 [deg]".to_owned());
    head.extend((2..=N).map(|joint| format!("q{joint}")));
    head.extend(["limits", "margin"].map(str::to_owned));
    head.extend(robot.configuration_rule().ok().map(|_| "confdata".to_owned()));
    head.push("singularities".to_owned());
    let shown = solutions.iter().take(MOST_ROWS).map(|solution| cells(solution, robot));
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
    robot: &Robot<N>,
) -> String {
    let mut lines = vec![outcome.to_owned()];
    if !solutions.is_empty() {
        let rows = rows(solutions, robot);
        let widest = |column: usize| rows.iter().map(|row| row[column].len()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..rows[0].len()).map(widest).collect();
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
