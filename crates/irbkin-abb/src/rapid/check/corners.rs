//! Corners of moves that follow one another: zones, targets next to each other, circles.

use crate::prelude::*;
use crate::rapid::calc::table::external_axes;
use crate::rapid::calc::units::{EXTERNAL_AXES, MOST_DEGREES};
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::data::value::Value;
use crate::rapid::motion::drive::Made;
use crate::rapid::motion::goal::{Goal, Place};
use crate::rapid::motion::joints::way;
use crate::rapid::program::walker::END_OF_MAIN;
use irbkin::internal::angle_between;
use irbkin::{Pose, Robot};
use irbkin_motion::internal::{LEAST_WAY, Leg};
use irbkin_motion::paths::ArcOrientation;

/// Targets nearer to one another are passed as one [m].
const CLOSE_TARGETS: f64 = 1e-4;

/// And the turn of the tool between them [rad].
const CLOSE_TURN: f64 = 1e-3;

/// Least distance of a circle's points from its start [m], and least angle between them, seen from
/// there [rad]. Source: MoveC in the RAPID reference manual, Limitations.
const LEAST_CHORD: f64 = 1e-4;
const LEAST_ARC_TURN: f64 = core::f64::consts::PI / 180.0;

/// Longest arc [rad]. Source: the same.
const MOST_ARC: f64 = 240.0 * core::f64::consts::PI / 180.0;

/// How far a zone may exceed half of a distance [1]: rounding.
const ROUNDING: f64 = 1e-6;

/// Goals that follow one another, and what became of them.
pub(super) struct Zones<'a, 'm, const N: usize> {
    /// The robot with the flange as its tool.
    pub(super) flange: &'a Robot<N>,
    pub(super) goals: &'a [Goal<'m, N>],
    pub(super) made: &'a [Made<N>],
}

impl<const N: usize> Zones<'_, '_, N> {
    /// The findings on a move and its neighbors.
    pub(super) fn checked(&self, index: usize) -> impl Iterator<Item = Finding> {
        [
            self.too_large(index),
            self.halted(index),
            self.close(index),
            self.circle(index),
            self.external(index),
        ]
        .into_iter()
        .flatten()
    }

    /// A zone behind which the program waits.
    fn halted(&self, index: usize) -> Option<Finding> {
        let goal = &self.goals[index];
        let (zone, halt) = (goal.zone?, goal.stepped.halt.as_deref()?);
        let words = format!(
            "zone {} ({:.1} mm) is followed by {halt}: a controller stops at the target (event \
             50024, corner path failure); program fine",
            goal.step.zone.text,
            zone.position * 1e3,
        );
        let routine = goal.step.routine.as_deref().unwrap_or_default();
        let cause = format!("{} {routine}", goal.stepped.module);
        let assumed = (halt == END_OF_MAIN).then(|| "the run mode single cycle".to_string());
        let finding = Finding { assumed, ..Finding::new(Code::CornerPath, words) };
        Some(finding.with_value(zone.position, 0.0).caused_by(cause))
    }

    /// An external axis that the target before has and this one has not, or the reverse.
    fn external(&self, index: usize) -> Option<Finding> {
        let goal = &self.goals[index];
        let before = self.goals.get(index.checked_sub(1)?)?;
        if goal.from_unknown || goal.place.is_none() || before.place.is_none() {
            return None;
        }
        let [own, other] = [goal.step, before.step]
            .map(|step| external_axes::<N>(step).map(|it| it < MOST_DEGREES));
        let axis = own.iter().zip(other).position(|(own, other)| *own != other)?;
        let name = EXTERNAL_AXES[axis];
        let (has, has_not) = if own[axis] {
            ("its target has", "the one before it has 9E9")
        } else {
            ("the target before it has", "its own has 9E9")
        };
        let words = format!("{has} {name} and {has_not}: the axis stays, or the move stops");
        Some(Finding::new(Code::ExternalAxes, words))
    }

    /// A target next to the one before it, which is passed in a zone.
    fn close(&self, index: usize) -> Option<Finding> {
        let goal = &self.goals[index];
        let before = self.goals.get(index.checked_sub(1)?)?;
        if !goal.is_cartesian() || goal.from_unknown || goal.is_carried || before.zone.is_none() {
            return None;
        }
        let (start, end) = (self.tool(index - 1, goal)?, self.tool(index, goal)?);
        let [length, angle] = way(&start, &end);
        if length >= CLOSE_TARGETS || angle >= CLOSE_TURN {
            return None;
        }
        let words = format!(
            "its target is {:.3} mm and {:.3} deg from the one before it, less than {:.1} mm and \
             {:.1} deg: a controller stops there (event 50024, corner path failure); leave one out",
            length * 1e3,
            angle.to_degrees(),
            CLOSE_TARGETS * 1e3,
            CLOSE_TURN.to_degrees(),
        );
        Some(Finding::new(Code::CornerPath, words).with_value(length, CLOSE_TARGETS))
    }

    /// A circle that its points hardly determine, or one that is too long.
    fn circle(&self, index: usize) -> Option<Finding> {
        let goal = &self.goals[index];
        let via = goal.via.as_deref()?;
        if index == 0 || goal.from_unknown || goal.is_carried {
            return None;
        }
        let (start, end) = (self.tool(index - 1, goal)?, self.tool(index, goal)?);
        let [to_via, to_end] =
            [via, &end].map(|pose| pose.translation.vector - start.translation.vector);
        let least = to_via.norm().min(to_end.norm());
        let angle = angle_between(&to_via, &to_end);
        let found = |words| Some(Finding::new(Code::UncertainCircle, words));
        if least < LEAST_CHORD {
            return found(format!(
                "its points are {:.3} mm from the start, a controller needs {:.1} mm",
                least * 1e3,
                LEAST_CHORD * 1e3
            ));
        }
        if angle < LEAST_ARC_TURN {
            return found(format!(
                "seen from the start, its points are {:.2} deg apart, a controller needs {:.0} deg",
                angle.to_degrees(),
                LEAST_ARC_TURN.to_degrees()
            ));
        }
        // An arc is twice the angle that it is seen under from the third point.
        let turn = 2.0 * (angle + angle_between(&-to_end, &(to_via - to_end)));
        (turn > MOST_ARC).then(|| {
            let words = format!(
                "its arc is {:.0} deg long, more than {:.0} deg: program two",
                turn.to_degrees(),
                MOST_ARC.to_degrees()
            );
            Finding::new(Code::UncertainCircle, words).with_value(turn, MOST_ARC)
        })
    }

    fn too_large(&self, index: usize) -> Option<Finding> {
        let goal = &self.goals[index];
        let zone = goal.zone?;
        let before = index.checked_sub(1).and_then(|_| self.way(index));
        let after = self.goals.get(index + 1).and_then(|_| self.way(index + 1));
        let sides = [(before, "the target before it"), (after, "the next target")];
        let known = sides.into_iter().filter_map(|(way, side)| way.map(|way| (way, side)));
        let (way, side) = known.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let bound = 0.5 * way;
        if zone.position <= bound * (1.0 + ROUNDING) {
            return None;
        }
        let [zone_mm, way_mm, bound_mm] =
            [zone.position, way, bound].map(|m| Value::Num((m * 1e6).round() / 1e3));
        let words = format!(
            "zone {} ({zone_mm} mm) is over half of the {way_mm} mm to {side}: the controller \
             reduces it to {bound_mm} mm",
            goal.step.zone.text,
        );
        let finding = Finding::new(Code::ZoneTooLarge, words);
        Some(finding.with_value(zone.position, bound))
    }

    /// The length of the way to a move's target from the one before it [m]; `None` if either is
    /// unknown or the tool only turns.
    fn way(&self, index: usize) -> Option<f64> {
        let goal = &self.goals[index];
        if goal.from_unknown || goal.is_carried {
            return None;
        }
        let (start, end) = (self.tool(index - 1, goal)?, self.tool(index, goal)?);
        let line = (end.translation.vector - start.translation.vector).norm();
        let arc = goal.via.as_ref().and_then(|via| {
            Leg::arc([&start, via, &end], ArcOrientation::Path).ok().map(|arc| arc.length())
        });
        Some(arc.unwrap_or(line)).filter(|way| *way > LEAST_WAY)
    }

    /// The tool at the target of a move, in the work object of another one.
    fn tool(&self, index: usize, within: &Goal<'_, N>) -> Option<Pose> {
        let goal = &self.goals[index];
        match goal.place? {
            Place::Tool(pose, _) if goal.frames == within.frames => Some(pose),
            _ => Some(within.frames.tool(&self.flange.fk(&self.made[index].q?))),
        }
    }
}
