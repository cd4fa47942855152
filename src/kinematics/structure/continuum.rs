//! The walk along a curve of joint vectors of one pose, by steps that adapt to it.
//!
//! Reference: Allgower and Georg, Introduction to Numerical Continuation Methods, 2003, chapter 6.

use core::ops::ControlFlow;

/// Lengths of steps along a curve.
#[derive(Clone, Copy)]
pub(crate) struct Steps {
    pub(crate) first: f64,
    pub(crate) least: f64,
    pub(crate) longest: f64,
    /// Factor of one that is too long.
    pub(crate) shorter: f64,
    /// Steps at most, those that are tried in vain too.
    pub(crate) most: u32,
}

/// Walk along a curve until the goal, which is answered, or until not even the least step leads on.
///
/// `ahead` predicts the member a step ahead, corrects it onto the curve and returns it with what the
/// step may grow by; it breaks at its goal. `None`: too long a step to know what it passes over.
pub(crate) fn walk<M>(
    start: M,
    steps: Steps,
    mut ahead: impl FnMut(&M, f64) -> Option<ControlFlow<(), (M, f64)>>,
) -> bool {
    let (mut here, mut step) = (start, steps.first);
    for _ in 0..steps.most {
        match ahead(&here, step) {
            Some(ControlFlow::Continue((next, growth))) => {
                (here, step) = (next, (growth * step).min(steps.longest));
            }
            None if steps.shorter * step >= steps.least => step *= steps.shorter,
            Some(ControlFlow::Break(())) => return true,
            None => break,
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use core::ops::ControlFlow::{Break, Continue};
    use std::vec::Vec;

    use super::{Steps, walk};

    const STEPS: Steps = Steps { first: 0.5, least: 1e-3, longest: 0.5, shorter: 0.5, most: 60 };

    /// The members of a walk along the line x >= 0, on which a step across 1 is refused if it is
    /// longer than `narrow`.
    fn passed(narrow: f64, goal: f64) -> (Vec<f64>, usize) {
        let (mut all, mut tried) = (Vec::new(), 0);
        walk(0.0, STEPS, |x, step| {
            tried += 1;
            let next = x + step;
            if *x <= 1.0 && next > 1.0 && step > narrow {
                return None;
            }
            all.push(next);
            Some(if next < goal { Continue((next, 2.0)) } else { Break(()) })
        });
        (all, tried)
    }

    #[test]
    fn a_step_is_shortened_where_it_must_be_and_grows_again() {
        let (all, _) = passed(0.1, 3.0);
        assert_eq!(all[..3], [0.5, 1.0, 1.0625]);
        assert!(all[3..].windows(2).any(|pair| pair[1] - pair[0] == STEPS.longest), "{all:?}");
        assert!(all[all.len() - 2] < 3.0 && all[all.len() - 1] >= 3.0, "{all:?}");
    }

    #[test]
    fn a_walk_ends_where_the_least_step_does_not_lead_on_or_steps_run_out() {
        let (all, tried) = passed(0.0, 3.0);
        // Eight halvings stay above the least step.
        assert_eq!((&all[..], tried), (&[0.5, 1.0][..], 2 + 9));
        let (all, tried) = passed(1.0, f64::INFINITY);
        assert_eq!((all.len(), tried), (60, 60));
    }
}
