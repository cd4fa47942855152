//! A program for another arm: its confdata are solved anew along its moves (docs/guide/replace.md).

use crate::Error;
use crate::prelude::*;
use crate::rapid::calc::confdata::over_quarters;
use crate::rapid::calc::target::{converter, with_flange};
use crate::rapid::calc::units::Units;
use crate::rapid::check::checker::CheckOptions;
use crate::rapid::data::finding::Code;
use crate::rapid::data::module::Module;
use crate::rapid::data::moves::Target;
use crate::rapid::motion::drive::{Drive, Made, MotionOptions};
use crate::rapid::motion::goal::{Conf, Goal, Place};
use crate::rapid::motion::routine::{Followed, goals};
use crate::rapid::motion::thresholds::NEAR_CONFDATA;
use crate::rapid::program::walk::runs;
use crate::rapid::program::walker::{Run, Step};
use crate::rapid::program::whole::Program;
use irbkin::thresholds::CONFIGURATION_EDGE;
use irbkin::{Configuration, Interrupt, Robot};

/// The cf1 of the first tag.
pub const FIRST_TAG: i32 = 1_000_000;

/// Solve the confdata of a program anew for another arm: those that change, by their numbers.
///
/// `tagged` is the program with the number of each confdata that is written, and [`FIRST_TAG`] more,
/// as its cf1: so it is known which one a move has in the end, through names, arrays, `Offs` and
/// arguments. Along the moves of each run the postures are chosen that are nearest, in the sum of
/// squares, to those of `source` at the same targets; without it, to those at the targets before. A
/// line or an arc ends with the posture that follows from the one at its start. Of several confdata
/// that moves to one target would have, it gets the one with which all cost least. Of the options
/// `units`, `takes_last`, `tools` and `interrupt` count.
///
/// # Errors
///
/// As [`check`](crate::rapid::check), of either arm.
pub fn port<const N: usize>(
    arm: &Robot<N>,
    source: Option<&Robot<N>>,
    [modules, tagged]: [&[&Module]; 2],
    options: &CheckOptions<'_, N>,
) -> Result<Vec<(usize, Configuration)>, Error> {
    arm.configuration_rule()?;
    let units = options.units.unwrap_or(const { &Units(Vec::new()) });
    let flange = with_flange(arm)?;
    let convert = converter(&flange, units);
    let CheckOptions { takes_last, tools, interrupt, .. } = *options;
    let program = Program::new(modules, &convert);
    let (own_runs, _) = runs(&program, takes_last, tools, interrupt)?;
    let tagged = Program::new(tagged, &convert);
    let (tagged_runs, _) = runs(&tagged, takes_last, tools, interrupt)?;
    let old = source.map(|it| made_before(it, &own_runs, units, interrupt)).transpose()?;
    let mut porter = Porter {
        arms: [arm, &flange],
        interrupt,
        runs: Vec::new(),
        count: 0,
        pinned: Vec::new(),
        has_source: source.is_some(),
    };
    let mut old = old.into_iter().flatten();
    let mut tags = tagged_runs.iter().map(tags_of);
    for run in &own_runs {
        let tags = tags.next().unwrap_or_default();
        porter.add(run, units, tags, old.next().unwrap_or_default())?;
    }
    porter.solve()
}

/// The numbers of the confdata of the moves of a run; `None` of joint angles, and where it is
/// calculated from joints.
fn tags_of(run: &Run<'_>) -> Vec<Option<usize>> {
    let tag = |step: &Step<'_>| match step {
        Step::Move(stepped) => Some(match &stepped.step.target.value {
            Ok(Target::RobTarget(own)) => {
                usize::try_from(own.robconf.cf1.saturating_sub(FIRST_TAG)).ok()
            }
            _ => None,
        }),
        Step::NotFollowed { .. } => None,
    };
    run.steps.iter().filter_map(tag).collect()
}

/// How the arm before made a move.
#[derive(Clone, Copy, Default)]
struct Before<const N: usize> {
    /// The joints at its target.
    q: Option<[f64; N]>,
    /// Whether it could not follow its line or arc.
    is_blocked: bool,
    /// Whether it did not have the confdata of its target.
    is_other: bool,
}

/// How the arm before made each move of each run.
fn made_before<const N: usize>(
    robot: &Robot<N>,
    runs: &[Run<'_>],
    units: &Units,
    interrupt: Interrupt<'_>,
) -> Result<Vec<Vec<Before<N>>>, Error> {
    robot.configuration_rule()?;
    let flange = with_flange(robot)?;
    let mut all: Vec<Vec<Before<N>>> = Vec::with_capacity(runs.len());
    for run in runs {
        let start = start_of(run.from, &all).and_then(|it| it.q);
        let motion = MotionOptions { start, ..MotionOptions::default() };
        let mut forget = |drive: &mut Drive<'_, '_, N>, index: usize| {
            drive.samples.forget_before(index + 1);
            Ok(())
        };
        let robots = [robot, &flange];
        let followed =
            Followed::new(robots, &run.steps, &motion, Some(units), interrupt, &mut forget)?;
        let before = |made: &Made<N>| Before {
            q: made.q,
            is_blocked: !made.as_programmed,
            is_other: !made.as_programmed,
        };
        let mut own: Vec<Before<N>> = followed.made.iter().map(before).collect();
        for finding in &followed.findings {
            if matches!(finding.code, Code::WrongConfdata | Code::OtherConfiguration) {
                own[finding.move_index].is_other = true;
            }
        }
        all.push(own);
    }
    Ok(all)
}

/// Where a run begins: after so many moves of an earlier one.
fn start_of<T: Copy>(from: Option<(usize, usize)>, ends: &[Vec<T>]) -> Option<T> {
    let (run, moves) = from?;
    ends.get(run)?.get(moves.checked_sub(1)?).copied()
}

struct PortedRun<'m, const N: usize> {
    from: Option<(usize, usize)>,
    goals: Vec<Goal<'m, N>>,
    /// The number of the confdata of each target.
    tags: Vec<Option<usize>>,
    old: Vec<Before<N>>,
    /// The joints that meet each target inside the limits, those nearest to the old ones.
    candidates: Vec<Vec<[f64; N]>>,
    /// The ends of each line or arc that has been followed.
    ends: Vec<Vec<LineEnd<N>>>,
}

/// The joints at the end of a line or an arc, by the bits of those at its start; `None` if it cannot
/// be followed.
type LineEnd<const N: usize> = ([u64; N], Option<[f64; N]>);

/// A posture at a target, with the best way to it.
#[derive(Clone, Copy)]
struct Posture<const N: usize> {
    q: [f64; N],
    /// The cost of the way [rad^2].
    cost: f64,
    /// The posture on it at the last target that has one.
    before: usize,
    /// Whether it cannot be made so: a line that cannot be followed, another confdata.
    is_broken: bool,
}

impl<const N: usize> Posture<N> {
    fn at(q: [f64; N]) -> Self {
        Self { q, cost: 0.0, before: 0, is_broken: false }
    }
}

/// Confdata by their numbers, where they are known.
type Pinned = Vec<Option<Configuration>>;

/// The postures at the targets of all runs; `None` where there is none.
type Chosen<const N: usize> = Vec<Vec<Option<Posture<N>>>>;

/// How many moves are chosen anew, at most, for targets of which moves do not have the confdata.
const MOST_TRIED: usize = 1_000_000;

/// The most postures of a target that are compared.
const MOST_POSTURES: usize = 16;

/// The most of them while no confdata are given.
const MOST_FREE: usize = 6;

/// The cost of a line that cannot be followed, and of a move that cannot have the confdata of its
/// target [rad^2]: more than all other moves of a program.
const BROKEN: f64 = 1e9;

struct Porter<'a, const N: usize> {
    /// The arm, and the same with the flange as its tool.
    arms: [&'a Robot<N>; 2],
    interrupt: Interrupt<'a>,
    runs: Vec<PortedRun<'a, N>>,
    /// How many confdata there are.
    count: usize,
    /// The confdata that targets have; empty while each move has its own.
    pinned: Pinned,
    /// Whether the arm before is known.
    has_source: bool,
}

impl<'a, const N: usize> Porter<'a, N> {
    fn add(
        &mut self,
        run: &'a Run<'a>,
        units: &Units,
        mut tags: Vec<Option<usize>>,
        mut old: Vec<Before<N>>,
    ) -> Result<(), Error> {
        let mut findings = [Vec::new(), Vec::new()];
        let goals = goals(self.arms[0], &run.steps, Some(units), findings.each_mut());
        // Where confdata decide on moves, the copy may have others.
        if tags.len() != goals.len() {
            tags = vec![None; goals.len()];
        }
        old.resize(goals.len(), Before::default());
        let mut candidates = Vec::with_capacity(goals.len());
        for (index, (goal, old)) in goals.iter().zip(&old).enumerate() {
            self.interrupt.check(index)?;
            candidates.push(self.candidates(goal, old.q));
        }
        self.count = tags.iter().flatten().fold(self.count, |count, tag| count.max(tag + 1));
        let ends = vec![Vec::new(); goals.len()];
        self.runs.push(PortedRun { from: run.from, goals, tags, old, candidates, ends });
        Ok(())
    }

    fn candidates(&self, goal: &Goal<'_, N>, old: Option<[f64; N]>) -> Vec<[f64; N]> {
        let (pose, arm_angle) = match goal.place {
            None => return Vec::new(),
            Some(Place::Joints(q)) => return Vec::from([q]),
            Some(Place::Tool(pose, wanted)) => (goal.frames.flange(&pose), wanted.arm_angle),
        };
        let seed = old.unwrap_or([0.0; N]);
        let mut all = self.arms[1].ik_inside_at(&pose, arm_angle).unwrap_or_default();
        // Next to a singularity, the free joint of the old ones.
        all.extend(self.arms[1].ik_nearest_at(&pose, &seed, arm_angle));
        all.sort_by(|a, b| apart(&seed, a).total_cmp(&apart(&seed, b)));
        all.truncate(MOST_POSTURES);
        all
    }

    /// The confdata that change: beginning with the postures nearest to the old ones and, if moves
    /// cannot have these, with the postures that each move would have by itself.
    fn solve(mut self) -> Result<Vec<(usize, Configuration)>, Error> {
        let mut best = (f64::INFINITY, Vec::new());
        if self.has_source {
            let nearest = |run: &PortedRun<N>| {
                let first = |all: &Vec<[f64; N]>| all.first().map(|q| Posture::at(*q));
                run.candidates.iter().map(first).collect()
            };
            let nearest: Chosen<N> = self.runs.iter().map(nearest).collect();
            best = self.improve(&nearest)?;
        }
        if best.0 >= BROKEN {
            self.pinned.clear();
            let (free, _) = self.choose()?;
            let other = self.improve(&free)?;
            if other.0 < best.0 {
                best = other;
            }
        }
        self.pinned = best.1;
        Ok(self.changes())
    }

    /// The confdata of postures, others in place of those that moves cannot have, and what all cost.
    fn improve(&mut self, first: &Chosen<N>) -> Result<(f64, Pinned), Error> {
        self.pinned = self.first_confdata(first)?;
        let (mut chosen, mut cost) = self.choose()?;
        let moves: usize = self.runs.iter().map(|run| run.goals.len()).sum();
        let mut tried = 0;
        let mut before = f64::INFINITY;
        while cost < before && tried < MOST_TRIED {
            before = cost;
            for tag in self.unmet(&chosen) {
                let mut best = self.pinned[tag];
                for other in self.others(tag)? {
                    self.pinned[tag] = Some(other);
                    let (_, own) = self.choose()?;
                    if own < cost {
                        (best, cost) = (Some(other), own);
                    }
                    tried += moves;
                }
                self.pinned[tag] = best;
                if tried >= MOST_TRIED {
                    break;
                }
            }
            chosen = self.choose()?.0;
        }
        Ok((cost, self.pinned.clone()))
    }

    /// The confdata that a target may have in any of its moves.
    fn others(&self, tag: usize) -> Result<Vec<Configuration>, Error> {
        let mut others = Vec::new();
        for run in &self.runs {
            let own = run.tags.iter().zip(&run.candidates).filter(|(it, _)| **it == Some(tag));
            for q in own.flat_map(|(_, candidates)| candidates) {
                let configuration = self.arms[1].configuration(q)?;
                if !others.contains(&configuration) {
                    others.push(configuration);
                }
            }
        }
        Ok(others)
    }

    /// The numbers of confdata that moves do not have, or with which lines cannot be followed.
    fn unmet(&self, chosen: &Chosen<N>) -> Vec<usize> {
        let mut unmet = Vec::new();
        for (run, chosen) in self.runs.iter().zip(chosen) {
            for (index, posture) in chosen.iter().enumerate() {
                let Some(posture) = posture else { continue };
                if posture.is_broken {
                    unmet.extend(run.tags[index]);
                    unmet.extend(index.checked_sub(1).and_then(|before| run.tags[before]));
                }
            }
        }
        unmet.sort_unstable();
        unmet.dedup();
        unmet
    }

    /// Pinned confdata that are not as they are written.
    fn changes(&self) -> Vec<(usize, Configuration)> {
        let mut changes = Vec::new();
        for run in &self.runs {
            for (goal, tag) in run.goals.iter().zip(&run.tags) {
                if let (Some(Place::Tool(_, wanted)), Some(tag)) = (goal.place, *tag)
                    && let Some(pinned) = self.pinned[tag]
                    && pinned != wanted.configuration
                {
                    changes.push((tag, pinned));
                }
            }
        }
        changes.sort_unstable_by_key(|(tag, _)| *tag);
        changes.dedup_by_key(|(tag, _)| *tag);
        changes
    }

    /// The confdata of each target: what the posture of its first move has, or as it is written if
    /// that one nearly has it and any other has it. Moves that the arm before did not make with the confdata of their targets
    /// count only where no others do.
    fn first_confdata(&self, chosen: &Chosen<N>) -> Result<Pinned, Error> {
        let mut made: Vec<Option<(Configuration, bool)>> = vec![None; self.count];
        let mut others = made.clone();
        for (run, chosen) in self.runs.iter().zip(chosen) {
            for (index, posture) in chosen.iter().enumerate() {
                let goal = &run.goals[index];
                let (Some(tag), Some(posture)) = (run.tags[index], posture) else { continue };
                let Some(Place::Tool(_, request)) = goal.place else { continue };
                // Without a start, the first move is made by its confdata all the same.
                if goal.conf() == Conf::Off && index > 0 {
                    continue;
                }
                let known = if run.old[index].is_other { &mut others } else { &mut made };
                let written = request.configuration;
                let has = |over| self.has(&posture.q, written, over);
                if has(CONFIGURATION_EDGE) && known[tag].is_none_or(|(_, is_near)| is_near) {
                    known[tag] = Some((written, true));
                } else if known[tag].is_none() {
                    let own = self.arms[1].configuration(&posture.q)?;
                    known[tag] = Some((own, has(NEAR_CONFDATA)));
                }
            }
        }
        let known = made.into_iter().zip(others).map(|(own, other)| own.or(other));
        Ok(known.map(|it| it.map(|(configuration, _)| configuration)).collect())
    }

    /// Whether joints have a configuration, some of their axes by so much over their quarters [rad].
    fn has(&self, q: &[f64; N], configuration: Configuration, over: f64) -> bool {
        over_quarters(self.arms[1], q, configuration).is_some_and(|it| it.by <= over)
    }

    /// The posture at the target of each move of each run, and what they cost together [rad^2].
    fn choose(&mut self) -> Result<(Chosen<N>, f64), Error> {
        let mut chosen: Chosen<N> = Vec::with_capacity(self.runs.len());
        let mut total = 0.0;
        for run in 0..self.runs.len() {
            let start = start_of(self.runs[run].from, &chosen).flatten();
            let (own, cost) = self.along(run, start)?;
            chosen.push(own);
            total += cost;
        }
        Ok((chosen, total))
    }

    /// The postures along a run from its start, whose cost together is least.
    fn along(
        &mut self,
        run: usize,
        start: Option<Posture<N>>,
    ) -> Result<(Vec<Option<Posture<N>>>, f64), Error> {
        let count = self.runs[run].goals.len();
        let mut layers: Vec<Vec<Posture<N>>> = Vec::with_capacity(count + 1);
        layers.push(start.map(|it| Posture { cost: 0.0, ..it }).into_iter().collect());
        let mut last = 0;
        for index in 0..count {
            self.interrupt.check(index)?;
            let own = self.postures((run, index), &layers[last], last == index)?;
            if !own.is_empty() {
                last = index + 1;
            }
            layers.push(own);
        }
        let least = |layer: &[Posture<N>]| {
            (0..layer.len()).min_by(|a, b| layer[*a].cost.total_cmp(&layer[*b].cost))
        };
        let mut at = least(&layers[last]);
        let cost = at.map_or(0.0, |at| layers[last][at].cost);
        let mut chosen = Vec::with_capacity(count);
        for layer in layers[1..].iter().rev() {
            let posture = at.and_then(|at| layer.get(at)).copied();
            at = posture.map(|it| it.before).or(at);
            chosen.push(posture);
        }
        chosen.reverse();
        Ok((chosen, cost))
    }

    /// The postures at the target of a move, each with the best way from those at the last target
    /// that has any, which is the one before or not.
    fn postures(
        &mut self,
        (run, index): (usize, usize),
        before: &[Posture<N>],
        is_next: bool,
    ) -> Result<Vec<Posture<N>>, Error> {
        let goal = &self.runs[run].goals[index];
        let old = self.runs[run].old[index];
        let is_known = is_next && !goal.from_unknown && goal.place.is_some();
        let is_line = goal.is_cartesian() && is_known;
        let is_led = is_line || goal.conf() == Conf::Off && !goal.is_cartesian();
        let mut found: Vec<Posture<N>> = Vec::new();
        // The postures before from which any one can follow, and what that costs.
        let mut free: Vec<(usize, f64)> = Vec::new();
        let broken = if is_line && !old.is_blocked { BROKEN } else { 0.0 };
        for (from, posture) in before.iter().enumerate() {
            let end = match (is_line, is_led) {
                (true, _) => self.end((run, index), &posture.q)?,
                (false, true) => self.nearest((run, index), &posture.q),
                (false, false) => None,
            };
            if let Some(q) = end {
                found.push(self.posture((run, index), &q, (from, posture.cost)));
            } else {
                free.push((from, posture.cost + broken));
            }
        }
        if before.is_empty() || !free.is_empty() {
            let step = |from: &[f64; N], q: &[f64; N]| old.q.map_or(apart(from, q), |_| 0.0);
            found.extend(self.runs[run].candidates[index].iter().map(|q| {
                let ways =
                    free.iter().map(|(from, cost)| (*from, cost + step(&before[*from].q, q)));
                // Without one before it, the nearest to zero.
                let best = ways.min_by(|a, b| a.1.total_cmp(&b.1));
                let way = best.unwrap_or((0, step(&[0.0; N], q)));
                let mut posture = self.posture((run, index), q, way);
                posture.is_broken |= broken > 0.0 && !before.is_empty();
                posture
            }));
        }
        found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        found.truncate(if self.pinned.is_empty() { MOST_FREE } else { MOST_POSTURES });
        // Anything that costs more is never better: all follow from the best by a break.
        let most = found.first().map_or(0.0, |it| it.cost + BROKEN);
        found.retain(|it| it.cost < most);
        Ok(found)
    }

    /// A posture behind another one, which a way of some cost leads to: it costs how far it is from
    /// the old one, and breaks where it does not have the confdata that are pinned.
    fn posture(
        &self,
        (run, index): (usize, usize),
        q: &[f64; N],
        (before, way): (usize, f64),
    ) -> Posture<N> {
        let PortedRun { goals, tags, old, .. } = &self.runs[run];
        let pinned = tags[index].and_then(|tag| *self.pinned.get(tag)?);
        let is_any = goals[index].conf() == Conf::Off || old[index].is_other;
        let is_broken = !is_any && pinned.is_some_and(|it| !self.has(q, it, NEAR_CONFDATA));
        let off = old[index].q.map_or(0.0, |old| apart(&old, q));
        let cost = way + off + if is_broken { BROKEN } else { 0.0 };
        Posture { q: *q, cost, before, is_broken }
    }

    /// The joints at the end of a line or an arc; `None` if it cannot be followed.
    fn end(
        &mut self,
        (run, index): (usize, usize),
        from: &[f64; N],
    ) -> Result<Option<[f64; N]>, Error> {
        let own = &self.runs[run];
        let bits = from.map(f64::to_bits);
        if let Some((_, known)) = own.ends[index].iter().find(|(start, _)| *start == bits) {
            return Ok(*known);
        }
        let motion = MotionOptions::default();
        let end = Drive::end_of(self.arms, &own.goals, index, from, &motion, self.interrupt)?;
        self.runs[run].ends[index].push((bits, end));
        Ok(end)
    }

    /// The joints at a target that are nearest to those before, as `ConfJ\Off` has it.
    fn nearest(&self, (run, index): (usize, usize), from: &[f64; N]) -> Option<[f64; N]> {
        let goal = &self.runs[run].goals[index];
        let Some(Place::Tool(pose, wanted)) = goal.place else { return None };
        let pose = goal.frames.flange(&pose);
        self.arms[1].ik_nearest_at(&pose, from, wanted.arm_angle).ok()
    }
}

/// How far joints are apart [rad^2].
fn apart<const N: usize>(from: &[f64; N], to: &[f64; N]) -> f64 {
    from.iter().zip(to).map(|(a, b)| (b - a) * (b - a)).sum()
}
