//! A program for another arm: the confdata of its targets are solved anew along its moves, and
//! nothing else changes (docs/guide/replace.md).

use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use crate::Error;
use crate::rapid::calc::table::target_of;
use crate::rapid::calc::target::{converter, with_flange};
use crate::rapid::calc::units::Units;
use crate::rapid::calc::wrong::not_solved;
use crate::rapid::check::checker::{CheckOptions, check_texts};
use crate::rapid::check::fixes::{Finder, Written};
use crate::rapid::data::finding::{Code, Edit, Finding};
use crate::rapid::data::module::Module;
use crate::rapid::data::moves::{Move, Target};
use crate::rapid::motion::drive::{Drive, MotionOptions};
use crate::rapid::motion::goal::{Goal, Place};
use crate::rapid::motion::routine::{Followed, check as check_options, goals};
use crate::rapid::motion::thresholds::JOINED_MOVES;
use crate::rapid::program::walk::runs;
use crate::rapid::program::walker::Run;
use crate::rapid::program::whole::Program;
use irbkin::internal::largest_step;
use irbkin::{Configuration, Interrupt, Robot};

/// A program for another arm.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ported {
    /// The numbers of confdata that change, in the order of the modules and of their texts.
    pub edits: Vec<Edit>,
    /// How many confdata have them.
    pub changed: usize,
    /// The moves that are not ported, in the same order.
    pub left: Vec<LeftMove>,
}

/// A move that stays as it is, although it belongs to the arm before.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct LeftMove {
    /// The module, from 0.
    pub module: usize,
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1, in characters.
    pub column: usize,
    /// The instruction, and why it is not ported.
    pub message: String,
}

/// Solve the confdata of a program anew for another arm.
///
/// Along the moves of each run the postures are chosen that are nearest, in the sum of squares, to
/// those of `source` at the same targets; without it, to those at the targets before. A line or an
/// arc ends with the posture that follows from the one at its start. Moves to one target share its
/// confdata. Of the options `units`, `takes_last`, `tools`, `motion` and `interrupt` count.
///
/// # Errors
///
/// As [`check`](crate::rapid::check), of both arms.
pub fn port<const N: usize>(
    arm: &Robot<N>,
    source: Option<&Robot<N>>,
    modules: &[(&Module, &str)],
    options: &CheckOptions<'_, N>,
) -> Result<Ported, Error> {
    arm.configuration_rule()?;
    check_options(&options.motion)?;
    check_texts(modules)?;
    let (modules, sources): (Vec<&Module>, Vec<&str>) = modules.iter().copied().unzip();
    let units = options.units.unwrap_or(const { &Units(Vec::new()) });
    let flange = with_flange(arm)?;
    let convert = converter(&flange, units);
    let program = Program::new(&modules, &convert);
    let (runs, _) = runs(&program, options.takes_last, options.tools, options.interrupt)?;
    let old = source.map(|robot| joints_at_targets(robot, &runs, units, options)).transpose()?;
    let mut porter = Porter {
        arms: [arm, &flange],
        motion: options.motion,
        interrupt: options.interrupt,
        finder: Finder { program: &program, sources: &sources },
        runs: Vec::new(),
        shared: BTreeMap::new(),
        left: Vec::new(),
    };
    let mut old = old.into_iter().flatten();
    for run in &runs {
        porter.add(run, units, old.next());
    }
    porter.ported()
}

/// The joints of a robot at the target of each move of each run; `None` where it has none.
fn joints_at_targets<const N: usize>(
    robot: &Robot<N>,
    runs: &[Run<'_>],
    units: &Units,
    options: &CheckOptions<'_, N>,
) -> Result<Vec<Vec<Option<[f64; N]>>>, Error> {
    robot.configuration_rule()?;
    let flange = with_flange(robot)?;
    let mut all: Vec<Vec<Option<[f64; N]>>> = Vec::with_capacity(runs.len());
    for run in runs {
        let motion = MotionOptions { start: start_of(run.from, &all), ..options.motion };
        let mut forget = |drive: &mut Drive<'_, '_, N>, index: usize| {
            drive.samples.forget_before(index + 1);
            Ok(())
        };
        let robots = [robot, &flange];
        let followed = Followed::new(
            robots,
            &run.steps,
            &motion,
            Some(units),
            options.interrupt,
            &mut forget,
        )?;
        all.push(followed.made.iter().map(|made| made.q).collect());
    }
    Ok(all)
}

/// Where a run begins: after so many moves of an earlier one.
fn start_of<T: Copy>(from: Option<(usize, usize)>, ends: &[Vec<Option<T>>]) -> Option<T> {
    let (run, moves) = from?;
    *ends.get(run)?.get(moves.checked_sub(1)?)?
}

/// A run whose confdata are solved anew.
struct PortedRun<'m, const N: usize> {
    from: Option<(usize, usize)>,
    goals: Vec<Goal<'m, N>>,
    /// Where the confdata of each target is written; `None` if it is calculated.
    written: Vec<Option<Written>>,
    /// The joints of the arm before at each target; none if the arm is not known.
    old: Vec<Option<[f64; N]>>,
}

/// A posture at a target, with the best way to it.
#[derive(Clone, Copy)]
struct Posture<const N: usize> {
    q: [f64; N],
    /// The cost of the way [rad^2].
    cost: f64,
    /// The posture on it at the last target that has one.
    before: usize,
    /// Whether the way ends with a line or an arc that cannot be followed.
    is_broken: bool,
}

/// The most postures of a target that are compared: those nearest to the old one.
const MOST_POSTURES: usize = 16;

/// The cost of a line that cannot be followed [rad^2]: more than all other moves of a program.
const BROKEN: f64 = 1e9;

struct Porter<'a, 'm, const N: usize> {
    /// The arm, and the same with the flange as its tool.
    arms: [&'a Robot<N>; 2],
    motion: MotionOptions<N>,
    interrupt: Interrupt<'a>,
    finder: Finder<'a, 'm>,
    runs: Vec<PortedRun<'a, N>>,
    /// The confdata of targets whose moves would have several, by where it is written.
    shared: BTreeMap<(usize, usize), Configuration>,
    left: Vec<LeftMove>,
}

impl<'a, const N: usize> Porter<'a, '_, N> {
    fn add(&mut self, run: &'a Run<'a>, units: &Units, old: Option<Vec<Option<[f64; N]>>>) {
        let (mut findings, mut unfollowed) = (Vec::new(), Vec::new());
        let goals = goals(self.arms[0], &run.steps, Some(units), [&mut findings, &mut unfollowed]);
        self.left.extend(unfollowed.iter().map(|it| left(it.module, it)));
        for (index, goal) in goals.iter().enumerate() {
            let wrong = findings.iter().find(|it| it.move_index == index);
            match (goal.place, wrong) {
                (Some(Place::Tool(..)), _) => {}
                (_, Some(finding)) => self.left.push(left(goal.stepped.module, finding)),
                (Some(Place::Joints(_)), None) => {
                    let words = "joint angles of the arm before, teach them again";
                    self.left.push(left_at(goal, words));
                }
                (None, None) => self.left.push(left_at(goal, "its target is not known")),
            }
        }
        let written = goals.iter().map(|it| self.finder.of(it.stepped.module, it.step)).collect();
        let old = old.unwrap_or_default();
        self.runs.push(PortedRun { from: run.from, goals, written, old });
    }

    fn ported(mut self) -> Result<Ported, Error> {
        let mut chosen = self.chosen()?;
        while self.share(&chosen)? {
            chosen = self.chosen()?;
        }
        let flange = self.arms[1];
        let mut edits = BTreeMap::new();
        for (run, chosen) in self.runs.iter().zip(&chosen) {
            for (index, goal) in run.goals.iter().enumerate() {
                let Some(Place::Tool(pose, wanted)) = goal.place else { continue };
                let Some(posture) = chosen[index] else {
                    let pose = goal.frames.flange(&pose);
                    if let Err(error) = flange.ik_nearest_at(&pose, &[0.0; N], wanted.arm_angle) {
                        let finding = not_solved(&error.into()).at(goal.step, index);
                        self.left.push(left(goal.stepped.module, &finding));
                    }
                    continue;
                };
                if posture.is_broken {
                    let words = "no posture at its start leads to its end";
                    self.left.push(left_at(goal, words));
                }
                let from = written_configuration(goal.step);
                let to = flange.configuration(&posture.q)?;
                let Some(written) = &run.written[index] else {
                    if from != Some(to) {
                        let words = format!("its confdata is calculated, {to} is needed");
                        self.left.push(left_at(goal, &words));
                    }
                    continue;
                };
                let shared = self.shared.get(&written.begin()).copied().unwrap_or(to);
                if shared != to {
                    let words = format!("other moves to its target need {shared}, it needs {to}");
                    self.left.push(left_at(goal, &words));
                }
                if let Some(from) = from.filter(|from| *from != shared) {
                    edits.insert(written.begin(), written.edits(from, shared));
                }
            }
        }
        self.left.sort_unstable();
        self.left.dedup();
        let changed = edits.len();
        Ok(Ported { edits: edits.into_values().flatten().collect(), changed, left: self.left })
    }

    /// Give each target one confdata, the one that most of its moves have; return whether postures
    /// must be chosen anew.
    fn share(&mut self, chosen: &[Vec<Option<Posture<N>>>]) -> Result<bool, Error> {
        let mut counts: BTreeMap<_, BTreeMap<[i32; 4], usize>> = BTreeMap::new();
        for (run, chosen) in self.runs.iter().zip(chosen) {
            for (written, posture) in run.written.iter().zip(chosen) {
                if let (Some(written), Some(posture)) = (written, posture) {
                    let own = self.arms[1].configuration(&posture.q)?.into();
                    *counts.entry(written.begin()).or_default().entry(own).or_default() += 1;
                }
            }
        }
        let before = self.shared.len();
        for (begin, counts) in counts.into_iter().filter(|(_, counts)| counts.len() > 1) {
            let most = counts.into_iter().max_by_key(|(_, count)| *count);
            if let Some(([cf1, cf4, cf6, cfx], _)) = most {
                let configuration = Configuration { cf1, cf4, cf6, cfx };
                self.shared.entry(begin).or_insert(configuration);
            }
        }
        Ok(self.shared.len() > before)
    }

    /// The posture at the target of each move of each run; `None` where there is none.
    fn chosen(&self) -> Result<Vec<Vec<Option<Posture<N>>>>, Error> {
        let mut all = Vec::with_capacity(self.runs.len());
        for run in &self.runs {
            all.push(self.along(run, start_of(run.from, &all))?);
        }
        Ok(all)
    }

    /// The postures along a run from its start, whose cost together is least.
    fn along(
        &self,
        run: &PortedRun<'_, N>,
        start: Option<Posture<N>>,
    ) -> Result<Vec<Option<Posture<N>>>, Error> {
        let start = start.map(|it| Posture { cost: 0.0, ..it });
        let mut layers: Vec<Vec<Posture<N>>> = Vec::with_capacity(run.goals.len() + 1);
        layers.push(start.into_iter().collect());
        let mut last = 0;
        for index in 0..run.goals.len() {
            self.interrupt.check(index)?;
            let own = self.postures(run, index, &layers[last], last == index)?;
            if !own.is_empty() {
                last = index + 1;
            }
            layers.push(own);
        }
        let mut chosen = Vec::with_capacity(run.goals.len());
        let mut at = None;
        for layer in layers[1..].iter().rev() {
            let best = || (0..layer.len()).min_by(|a, b| layer[*a].cost.total_cmp(&layer[*b].cost));
            let posture = at.or_else(best).and_then(|at: usize| layer.get(at)).copied();
            at = posture.map(|it| it.before).or(at);
            chosen.push(posture);
        }
        chosen.reverse();
        Ok(chosen)
    }

    /// The postures at the target of a move, each with the best way from those at the last target
    /// that has any, which is the one before or not.
    fn postures(
        &self,
        run: &PortedRun<'_, N>,
        index: usize,
        before: &[Posture<N>],
        is_next: bool,
    ) -> Result<Vec<Posture<N>>, Error> {
        let goal = &run.goals[index];
        let old = run.old.get(index).copied().flatten();
        let mut ends = Vec::new();
        if goal.is_cartesian() && is_next && !goal.from_unknown {
            for from in before {
                let (arms, motion) = (self.arms, &self.motion);
                let end = Drive::end_of(arms, &run.goals, index, &from.q, motion, self.interrupt)?;
                ends.push(end);
            }
        }
        let step = |from: usize, q: &[f64; N]| match (ends.get(from), old) {
            (Some(Some(end)), _) if largest_step(end, q).1.abs() <= JOINED_MOVES => 0.0,
            (Some(_), _) => BROKEN,
            (None, Some(_)) => 0.0,
            (None, None) => apart(&before[from].q, q),
        };
        let posture = |q: [f64; N]| {
            let ways = (0..before.len()).map(|from| {
                let step = step(from, &q);
                let (cost, is_broken) = (before[from].cost + step, step >= BROKEN);
                Posture { q, cost, before: from, is_broken }
            });
            // Without one before it, the nearest to zero.
            let cost = if old.is_none() { apart(&[0.0; N], &q) } else { 0.0 };
            let first = Posture { q, cost, before: 0, is_broken: false };
            let best = ways.min_by(|a, b| a.cost.total_cmp(&b.cost)).unwrap_or(first);
            Posture { cost: best.cost + old.map_or(0.0, |old| apart(&old, &q)), ..best }
        };
        Ok(self.candidates(run, index, old).into_iter().map(posture).collect())
    }

    /// The joints that meet the target of a move inside the limits, those nearest to the old ones.
    fn candidates(
        &self,
        run: &PortedRun<'_, N>,
        index: usize,
        old: Option<[f64; N]>,
    ) -> Vec<[f64; N]> {
        let flange = self.arms[1];
        let goal = &run.goals[index];
        let (pose, wanted) = match goal.place {
            None => return Vec::new(),
            Some(Place::Joints(q)) => return Vec::from([q]),
            Some(Place::Tool(pose, wanted)) => (goal.frames.flange(&pose), wanted),
        };
        let seed = old.unwrap_or([0.0; N]);
        let mut all = flange.ik_inside_at(&pose, wanted.arm_angle).unwrap_or_default();
        // Next to a singularity, the free joint of the old ones.
        all.extend(flange.ik_nearest_at(&pose, &seed, wanted.arm_angle));
        all.sort_by(|a, b| apart(&seed, a).total_cmp(&apart(&seed, b)));
        let shared = run.written[index].as_ref().and_then(|it| self.shared.get(&it.begin()));
        let is_shared = |q: &[f64; N]| flange.configuration(q).ok().as_ref() == shared;
        if all.iter().any(is_shared) {
            all.retain(is_shared);
        }
        all.truncate(MOST_POSTURES);
        all
    }
}

/// How far joints are apart [rad^2].
fn apart<const N: usize>(from: &[f64; N], to: &[f64; N]) -> f64 {
    from.iter().zip(to).map(|(a, b)| (b - a) * (b - a)).sum()
}

/// The confdata of a target as it is written.
fn written_configuration(step: &Move) -> Option<Configuration> {
    match target_of(&step.target) {
        Ok(Target::RobTarget(target)) => Some(target.robconf),
        _ => None,
    }
}

fn left(module: usize, finding: &Finding) -> LeftMove {
    let Finding { line, column, message, .. } = finding;
    LeftMove { module, line: *line, column: *column, message: message.clone() }
}

fn left_at<const N: usize>(goal: &Goal<'_, N>, words: &str) -> LeftMove {
    let finding = Finding::new(Code::NotFollowed, words).at(goal.step, 0);
    left(goal.stepped.module, &finding)
}
