//! Go through the moves of a routine in order and follow each of them.

use super::goal::{Conf, Goal, Place};
use super::joints::{Path, Samples, joint_line, nearest_written, round_joints, solved, way};
use crate::Error;
use crate::prelude::*;
use crate::rapid::calc::confdata::{near, over_quarters};
use crate::rapid::calc::frames::Frames;
use crate::rapid::calc::wrong::{OrFinding, broken, no_path, passes};
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::data::settings::{CirPathMode, SingArea};
use crate::rapid::motion::thresholds::{
    ELBOW_ZONE, JOINED_MOVES, NEAR_CONFDATA, NEAR_CONFDATA_OF_LINE, SHOULDER_ZONE,
};
use irbkin::follow::{BreakReason, SingularityMode};
use irbkin::internal::largest_step;
use irbkin::thresholds::{CONFIGURATION_EDGE, MOST_REACH, WRIST_ZONE};
use irbkin::{Configuration, Interrupt, Pose, Robot, SingularityKind, Slot};
use irbkin_motion::Error as MotionError;
use irbkin_motion::internal::{Corner, Leg, MOST_SAMPLES, Rounded, part};
use irbkin_motion::paths::{ArcOrientation, Spacing};

/// The bit of cfx that is the side of the wrist.
const WRIST_SIDE: i32 = 1;

/// Least number of steps of a line or an arc with a rounded corner.
const LEAST_STEPS: usize = 4;

/// Options of [`motion`](crate::rapid::motion).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionOptions<const N: usize = 6> {
    /// Joint angles from which the first move begins [rad]; without them the motion begins at the
    /// first target.
    pub start: Option<[f64; N]>,
    /// Limits of the joints [rad/s]; by default the robot's.
    pub max_velocity: Option<[f64; N]>,
    /// Accelerations that the joints may have [rad/s^2]; no catalog has them. Without them the
    /// duration is a kinematic lower bound: speeds change at once.
    pub max_acceleration: Option<[f64; N]>,
    /// Largest distance of the tool between two samples [m].
    pub step: f64,
    /// Largest turn of the tool, and of a joint of a `MoveJ` or `MoveAbsJ`, between two samples
    /// [rad].
    pub turn: f64,
}

impl<const N: usize> Default for MotionOptions<N> {
    fn default() -> Self {
        Self {
            start: None,
            max_velocity: None,
            max_acceleration: None,
            step: 5e-3,
            turn: 5_f64.to_radians(),
        }
    }
}

/// The outcome of a move.
#[derive(Clone, Copy, Default)]
pub(in crate::rapid) struct Made<const N: usize> {
    /// The joints at its target, if it is met or passed.
    pub(in crate::rapid) q: Option<[f64; N]>,
    pub(in crate::rapid) as_programmed: bool,
    /// Whether the corner at its end is rounded.
    pub(in crate::rapid) is_rounded: bool,
}

/// The next line or arc, with the corner that leads to it.
struct Entry {
    before: Leg,
    corner: Corner,
    leg: Leg,
}

pub(super) struct Here<const N: usize> {
    pub(super) q: [f64; N],
    flange: Pose,
}

pub(in crate::rapid) struct Drive<'a, 'm, const N: usize> {
    pub(super) robot: &'a Robot<N>,
    /// The robot with the flange as its tool.
    pub(super) flange: &'a Robot<N>,
    pub(in crate::rapid) goals: &'a [Goal<'m, N>],
    spacing: Spacing,
    pub(super) findings: &'a mut Vec<Finding>,
    pub(in crate::rapid) samples: Samples<N>,
    pub(in crate::rapid) made: Vec<Made<N>>,
    here: Option<Here<N>>,
    entry: Option<Entry>,
    /// Whether the last target was not reached.
    is_lost: bool,
    /// The configuration that the last target has, the other one that it is met with, and the move
    /// from which on it is so.
    pub(super) other: Option<(Configuration, Configuration, usize)>,
    pub(super) interrupt: Interrupt<'a>,
}

impl<'a, 'm, const N: usize> Drive<'a, 'm, N> {
    /// Go through the moves; `finish` gets each when its samples are final.
    pub(super) fn through(
        [robot, flange]: [&'a Robot<N>; 2],
        goals: &'a [Goal<'m, N>],
        options: &MotionOptions<N>,
        findings: &'a mut Vec<Finding>,
        interrupt: Interrupt<'a>,
        finish: &mut dyn FnMut(&mut Self, usize) -> Result<(), Error>,
    ) -> Result<(Samples<N>, Vec<Made<N>>), Error> {
        let mut drive = Self::new([robot, flange], goals, options, findings, interrupt)?;
        if let Some(start) = options.start {
            drive.samples.path.push(start, [0.0; 2]);
            drive.samples.first = 1;
            drive.here = Some(Here { q: start, flange: flange.fk(&start) });
        }
        for index in 0..goals.len() {
            interrupt.check(index)?;
            let made = drive.make(index)?;
            drive.made.push(made);
            drive.samples.ends.push(drive.samples.path.q.len());
            let found = drive.samples.forgotten + drive.samples.path.q.len();
            if found > MOST_SAMPLES {
                #[expect(clippy::cast_precision_loss, reason = "some 1e7")]
                let [found, most] = [found, MOST_SAMPLES].map(|count| count as f64);
                return Err(irbkin_motion::internal::MotionFault::TooMany { found, most }.into());
            }
            // The corner between two moves belongs to both.
            if let Some(before) = index.checked_sub(1) {
                finish(&mut drive, before)?;
            }
        }
        if let Some(last) = goals.len().checked_sub(1) {
            finish(&mut drive, last)?;
        }
        Ok((drive.samples, drive.made))
    }

    fn new(
        [robot, flange]: [&'a Robot<N>; 2],
        goals: &'a [Goal<'m, N>],
        options: &MotionOptions<N>,
        findings: &'a mut Vec<Finding>,
        interrupt: Interrupt<'a>,
    ) -> Result<Self, Error> {
        Ok(Self {
            robot,
            flange,
            goals,
            spacing: Spacing::step(options.step, options.turn)?,
            findings,
            samples: Samples::default(),
            made: Vec::new(),
            here: None,
            entry: None,
            is_lost: false,
            other: None,
            interrupt,
        })
    }

    /// The joints at the end of a line or an arc from the joints at its start; `None` if it cannot
    /// be followed.
    pub(in crate::rapid) fn end_of(
        robots: [&'a Robot<N>; 2],
        goals: &'a [Goal<'m, N>],
        index: usize,
        from: &[f64; N],
        options: &MotionOptions<N>,
        interrupt: Interrupt<'a>,
    ) -> Result<Option<[f64; N]>, Error> {
        let Some(Place::Tool(end, _)) = goals[index].place else { return Ok(None) };
        let mut findings = Vec::new();
        let mut drive = Drive::new(robots, goals, options, &mut findings, interrupt)?;
        let here = Here { q: *from, flange: robots[1].fk(from) };
        Ok(drive.follow(index, &end, &here, None)?.ok().and_then(|made| made.q))
    }

    pub(super) fn found(&mut self, index: usize, finding: Finding) {
        self.findings.push(finding.at(self.goals[index].step, index));
    }

    /// The joints at the target of a move; what is wrong with them is found.
    fn solved(&mut self, index: usize, seed: Option<&[f64; N]>, conf: Conf) -> Option<[f64; N]> {
        let (q, finding) = solved(self.flange, &self.goals[index], seed, conf);
        if let Some(finding) = finding {
            self.found(index, finding);
        }
        q
    }

    fn make(&mut self, index: usize) -> Result<Made<N>, Error> {
        let goal = &self.goals[index];
        let entry = self.entry.take();
        let is_lost = core::mem::replace(&mut self.is_lost, false) || goal.from_unknown;
        if !goal.is_cartesian() {
            self.other = None;
        }
        let Some(here) = self.here.take() else { return Ok(self.begin(index)) };
        if let (true, false, Some(Place::Tool(end, _))) = (goal.is_cartesian(), is_lost, goal.place)
        {
            match self.follow(index, &end, &here, entry)? {
                Ok(made) => return Ok(made),
                Err(finding) => self.found(index, *finding),
            }
        }
        let is_replaced = goal.is_cartesian() || is_lost;
        // A broken way is reported already.
        let is_broken = goal.is_cartesian() && !goal.from_unknown;
        let conf = if is_broken { Conf::Quiet } else { goal.conf() };
        let Some(to) = self.solved(index, Some(&here.q), conf) else {
            (self.here, self.is_lost) = (Some(here), true);
            return Ok(Made::default());
        };
        let path = joint_line(self.flange, self.spacing, &goal.frames, [&here.q, &to])?;
        let q = path.q.last().copied().unwrap_or(here.q);
        self.append(index, path, !is_replaced);
        self.here = Some(Here { q, flange: self.flange.fk(&q) });
        Ok(Made { q: Some(q), as_programmed: !is_replaced, is_rounded: false })
    }

    /// The motion begins at the target of a move.
    fn begin(&mut self, index: usize) -> Made<N> {
        let conf = match self.goals[index].conf() {
            Conf::Off => Conf::Quiet,
            conf => conf,
        };
        let Some(q) = self.solved(index, None, conf) else {
            return Made::default();
        };
        self.samples.path.push(q, [0.0; 2]);
        self.here = Some(Here { q, flange: self.flange.fk(&q) });
        Made { q: Some(q), as_programmed: true, is_rounded: false }
    }

    /// Add the samples of a move, with the corner before it rounded in joint space if the last move
    /// has a zone and its corner is not rounded yet.
    fn append(&mut self, index: usize, mut path: Path<N>, as_programmed: bool) {
        if let Some(before) = index.checked_sub(1)
            && let Some(last) = self.made.get(before).copied()
            && as_programmed
            && last.as_programmed
            && !last.is_rounded
            && let Some(zone) = self.goals[before].zone
        {
            let frames: [&Frames; 2] = [&self.goals[before].frames, &self.goals[index].frames];
            let is_rounded =
                round_joints(self.flange, &mut self.samples, zone.position, frames, &mut path);
            self.made[before].is_rounded = is_rounded;
        }
        self.samples.path.append(path);
    }

    /// The line or the arc of a move between two poses of the tool.
    fn leg(&self, index: usize, start: &Pose, end: &Pose) -> Result<Leg, MotionError> {
        let goal = &self.goals[index];
        let orientation = match goal.step.settings.cir_path_mode {
            CirPathMode::ObjectFrame => ArcOrientation::Object,
            CirPathMode::CirPointOri => ArcOrientation::Via,
            _ => ArcOrientation::Path,
        };
        match &goal.via {
            Some(via) => Leg::arc([start, via, end], orientation),
            None => Leg::line([start, end], index),
        }
    }

    /// The line or the arc after a move, with its rounded corner.
    fn exit(&self, index: usize, leg: &Leg) -> Option<(Leg, Corner)> {
        let (goal, next) = (&self.goals[index], self.goals.get(index + 1)?);
        let zone = goal.zone?;
        let (Some(Place::Tool(start, _)), Some(Place::Tool(end, _))) = (&goal.place, &next.place)
        else {
            return None;
        };
        if !next.is_cartesian() || next.from_unknown || next.frames != goal.frames {
            return None;
        }
        let after = self.leg(index + 1, start, end).ok()?;
        let corner = Corner::new(&zone, leg, &after);
        (!corner.is_met()).then_some((after, corner))
    }

    /// Follow a line or an arc; a finding if that is not possible.
    fn follow(
        &mut self,
        index: usize,
        end: &Pose,
        here: &Here<N>,
        entry: Option<Entry>,
    ) -> Result<OrFinding<Made<N>>, Error> {
        let goal = &self.goals[index];
        let (before, leg) = match entry {
            Some(Entry { before, corner, leg }) => (Some((before, corner)), leg),
            None => match self.leg(index, &goal.frames.tool(&here.flange), end) {
                Ok(leg) => (None, leg),
                Err(error) => return Ok(Err(no_path(&error))),
            },
        };
        let exit = self.exit(index, &leg);
        let mut steps = match self.spacing.steps_of_one([leg.length(), leg.angle()]) {
            Ok(steps) => steps,
            // No robot reaches both of its ends.
            Err(error) if leg.length() > 2.0 * MOST_REACH => {
                return Ok(Err(no_path(&error)));
            }
            Err(error) => return Err(error.into()),
        };
        if before.is_some() || exit.is_some() {
            steps = steps.max(LEAST_STEPS);
        }
        let rounded = Rounded {
            before: before.as_ref().map(|(before, corner)| (before, *corner)),
            leg: &leg,
            after: exit.as_ref().map(|(after, corner)| (after, *corner)),
            index,
        };
        let mut poses = Vec::with_capacity(steps + 1);
        for step in 0..=steps {
            self.interrupt.check(step)?;
            match rounded.at(part(step, steps.max(1))) {
                Ok(_) if step == steps && exit.is_none() => poses.push(*end),
                Ok(pose) => poses.push(pose),
                Err(error) => return Ok(Err(no_path(&error))),
            }
        }
        let path = match self.followed(index, here, &poses)? {
            Ok(path) => path,
            Err(finding) => return Ok(Err(finding)),
        };
        let end = path.q.last().copied().unwrap_or(here.q);
        let q = self.arrived(index, &end, exit.is_some());
        let is_rounded = exit.is_some();
        self.append(index, path, true);
        let flange = poses.last().map_or(here.flange, |pose| goal.frames.flange(pose));
        self.here = Some(Here { q: end, flange });
        self.entry = exit.map(|(after, corner)| Entry { before: leg, corner, leg: after });
        Ok(Ok(Made { q: Some(q), as_programmed: true, is_rounded }))
    }

    /// The joints along poses of the tool in the work object, checked.
    fn followed(
        &mut self,
        index: usize,
        here: &Here<N>,
        poses: &[Pose],
    ) -> Result<OrFinding<Path<N>>, Error> {
        let goal = &self.goals[index];
        if poses.len() < 2 {
            return Ok(Ok(Path::default()));
        }
        let flanges: Vec<Pose> = poses.iter().map(|pose| goal.frames.flange(pose)).collect();
        let singularity_mode = match goal.step.settings.sing_area {
            SingArea::Off => SingularityMode::Through,
            SingArea::Wrist => SingularityMode::Wrist,
            SingArea::LockAxis4 => SingularityMode::LockAxis4,
        };
        let arm_angle = goal.arm_angle();
        if singularity_mode == SingularityMode::Wrist
            && let Some(q) = self.turned_over(goal, &flanges, &here.q)
        {
            let mut path = Path::default();
            for (sample, q) in q.into_iter().enumerate().skip(1) {
                path.push(q, way(&poses[sample - 1], &poses[sample]));
            }
            return Ok(Ok(path));
        }
        let followed = self.flange.follow_at(
            &flanges,
            &here.q,
            arm_angle,
            singularity_mode,
            self.interrupt,
        )?;
        self.interrupt.check(0)?;
        let steps = poses.len() - 1;
        if let Some(first) = followed.breaks.first() {
            return Ok(Err(broken(part(first.pose_index, steps), first.reason)));
        }
        let mut path = Path::default();
        for (sample, q) in followed.q.into_iter().enumerate() {
            let Some(q) = q else {
                return Ok(Err(broken(part(sample, steps), BreakReason::Locked)));
            };
            if sample > 0 {
                path.push(q, way(&poses[sample - 1], &poses[sample]));
            } else if let Some(reason) = apart(&here.q, &q, singularity_mode) {
                return Ok(Err(broken(0.0, reason)));
            }
        }
        self.check_singularities(index, here, &path);
        Ok(Ok(path))
    }

    /// The joints at the target of a line or an arc, and whether they have its configuration.
    pub(super) fn arrived(&mut self, index: usize, end: &[f64; N], is_rounded: bool) -> [f64; N] {
        let goal = &self.goals[index];
        let Some(Place::Tool(pose, wanted)) = goal.place else { return *end };
        let pose = goal.frames.flange(&pose);
        let mut q = *end;
        if is_rounded && let Ok(nearest) = self.flange.ik_nearest_at(&pose, end, wanted.arm_angle) {
            q = nearest;
        }
        if !goal.step.settings.conf_l {
            return q;
        }
        let found = self.flange.configuration(&q).unwrap_or_default();
        let confdata = wanted.configuration;
        let before = self.other.take();
        let is_met = || {
            self.flange
                .ik_configured(&pose, wanted.near(q))
                .is_ok_and(|solution| apart(&solution.q, &q, SingularityMode::Through).is_none())
        };
        if found == confdata || is_met() {
            return q;
        }
        let is_nearest = |by: f64| {
            nearest_written(self.flange, &pose, &wanted)
                .is_none_or(|(_, least)| by <= least.by + CONFIGURATION_EDGE)
        };
        let over = over_quarters(self.flange, &q, confdata).filter(|over| {
            over.by <= NEAR_CONFDATA || over.by <= NEAR_CONFDATA_OF_LINE && is_nearest(over.by)
        });
        if let Some(over) = over {
            self.found(index, near(&over, confdata, found));
        } else {
            let words = format!(
                "arrives with the configuration {found}, its target has {confdata}: correct its \
                 confdata, or program ConfL\\Off"
            );
            // As of the move before: the branch is the cause, not each target.
            let is_same = |it: &(_, _, usize)| (it.0, it.1) == (confdata, found);
            let since = before.filter(is_same).map_or(index, |it| it.2);
            self.other = Some((confdata, found, since));
            let finding = Finding::new(Code::OtherConfiguration, words);
            self.found(index, finding.caused_by(format!("{since}")));
        }
        q
    }

    /// Report the singularities that a line or an arc passes: of each kind the nearest place.
    pub(super) fn check_singularities(&mut self, index: usize, here: &Here<N>, path: &Path<N>) {
        let is_off = self.goals[index].step.settings.sing_area == SingArea::Off;
        let kinds = [
            (SingularityKind::WRIST, 1, WRIST_ZONE),
            (SingularityKind::ELBOW, 2, ELBOW_ZONE),
            (SingularityKind::SHOULDER, 4, SHOULDER_ZONE),
        ];
        let mut nearest = [(f64::INFINITY, 0); 3];
        let mut last = self.robot.slot_of(&here.q).map(Slot::index);
        for (sample, q) in path.q.iter().enumerate() {
            let Some(at) = self.robot.singular_distances(q) else { return };
            let slot = self.robot.slot_of(q).map(Slot::index);
            let crossed = slot.zip(last).map_or(0, |(slot, last)| slot ^ last);
            last = slot;
            let distances = [at.wrist, at.elbow, at.shoulder];
            for ((kind, distance), near) in kinds.iter().zip(distances).zip(&mut nearest) {
                let distance = if crossed & kind.1 == 0 { distance } else { 0.0 };
                if distance < near.0 {
                    *near = (distance, sample + 1);
                }
            }
        }
        for ((kind, _, bound), (distance, sample)) in kinds.into_iter().zip(nearest) {
            if distance < bound && (is_off || kind != SingularityKind::WRIST) {
                let part = part(sample, path.q.len());
                self.found(index, passes(kind, part, distance).with_value(distance, bound));
            }
        }
    }

    /// The joints along poses of the flange at whose end the wrist is on the other side: its axes
    /// go evenly to the programmed configuration.
    pub(super) fn turned_over(
        &self,
        goal: &Goal<'_, N>,
        flanges: &[Pose],
        from: &[f64; N],
    ) -> Option<Vec<[f64; N]>> {
        let (Some(Place::Tool(_, wanted)), true) = (goal.place, goal.step.settings.conf_l) else {
            return None;
        };
        if self.flange.configuration(from).ok()?.cfx ^ wanted.configuration.cfx != WRIST_SIDE {
            return None;
        }
        let to = self.flange.ik_configured(flanges.last()?, wanted.near(*from)).ok()?;
        self.flange.with_even_wrist(flanges, [from, &to.q], self.interrupt)
    }
}

/// The reason if a path does not begin with the joints that the robot has.
pub(super) fn apart<const N: usize>(
    from: &[f64; N],
    to: &[f64; N],
    mode: SingularityMode,
) -> Option<BreakReason> {
    let (joint, by) = largest_step(from, to);
    if by.abs() <= JOINED_MOVES {
        return None;
    }
    Some(match mode {
        SingularityMode::LockAxis4 => BreakReason::Locked,
        _ => BreakReason::Jump { joint, by, kinds: SingularityKind::empty() },
    })
}
