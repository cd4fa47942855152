//! Zones against the distances to the targets next to them.

use alloc::format;
use alloc::string::String;

use crate::kinematics::Pose;
use crate::kinematics::Robot;
use crate::kinematics::thresholds::LEAST_WAY;
use crate::paths::ArcOrientation;
use crate::paths::leg::Leg;
use crate::rapid::motion::drive::Made;
use crate::rapid::motion::goal::{Goal, Place};

/// How far a zone may exceed half of a distance [1]: rounding.
const ROUNDING: f64 = 1e-6;

/// Goals that follow one another, and what became of them.
pub(super) struct Zones<'a, 'm> {
    /// The robot with the flange as its tool.
    pub(super) flange: &'a Robot<6>,
    pub(super) goals: &'a [Goal<'m>],
    pub(super) made: &'a [Made],
}

impl Zones<'_, '_> {
    /// What is wrong with the zone of a move, if it is too large.
    pub(super) fn checked(&self, index: usize) -> Option<String> {
        let goal = &self.goals[index];
        let zone = goal.zone?;
        let before = index.checked_sub(1).and_then(|_| self.way(index));
        let after = self.goals.get(index + 1).and_then(|_| self.way(index + 1));
        let sides = [(before, "the target before it"), (after, "the next target")];
        let known = sides.into_iter().filter_map(|(way, side)| way.map(|way| (way, side)));
        let (way, side) = known.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let bound = 0.5 * way;
        (zone.position > bound * (1.0 + ROUNDING)).then(|| {
            format!(
                "zone {} ({:.1} mm) is over half of the {:.1} mm to {side}: the controller reduces \
                 it to {:.1} mm",
                goal.step.zone,
                zone.position * 1e3,
                way * 1e3,
                bound * 1e3
            )
        })
    }

    /// The length of the way to a move's target from the one before it [m]; `None` if either is
    /// unknown or the tool only turns.
    fn way(&self, index: usize) -> Option<f64> {
        let goal = &self.goals[index];
        if goal.from_unknown {
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
    fn tool(&self, index: usize, within: &Goal<'_>) -> Option<Pose> {
        let goal = &self.goals[index];
        match goal.place? {
            Place::Tool(pose, _) if goal.frames == within.frames => Some(pose),
            _ => Some(within.frames.tool(&self.flange.fk(&self.made[index].q?))),
        }
    }
}
