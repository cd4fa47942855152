//! Paths of poses: followed from a seed, or planned over all branches.

use irbkin::follow::{Break, Follower};
use irbkin::{Pose, Robot, on, pose};
use irbkin_motion::plan::{Plan, PlanError, PlanOptions, ToolAxis, ToolRotation};

use crate::arguments::{array_mut, check_length, given, joints, reference, slice, slice_mut};
use crate::fault::{Fault, IrbkinCode, guarded};
use crate::handle::{IrbkinCell, IrbkinRobot, handle};

/// The freedoms of a plan and its conditions. All zeros: nothing is free, nothing is kept.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct IrbkinPlanOptions {
    /// Number of angles about its z axis that the tool may take; 0: the tool does not turn.
    pub rotation_steps: usize,
    /// Lowest of these angles [rad].
    pub rotation_lower: f64,
    /// Largest of these angles [rad]; both 0: a full turn.
    pub rotation_upper: f64,
    /// Time of each pose [s]: no joint is faster than its limit. NULL: even pace.
    pub times: *const f64,
    /// The dof joint angles at the first pose [rad], or NULL.
    pub start: *const f64,
    /// The dof joint angles at the last pose [rad], or NULL.
    pub end: *const f64,
    /// Not 0: the joints end where they start.
    pub closed: i32,
    /// Obstacles that the arm stays out of, between the poses too; or NULL.
    pub cell: *const IrbkinCell,
}

/// The figures of a plan.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct IrbkinPlanReport {
    /// Weighted sum of the squares of all joint steps [rad^2].
    pub cost: f64,
    /// Largest velocity of a joint as a part of its limit; without times, the least time [s] at an
    /// even pace.
    pub bottleneck: f64,
    /// Number of places where the joints cannot follow.
    pub breaks: usize,
    /// 1 if every step was shown to be continuous between its two poses, else 0.
    pub certified: i32,
}

/// The poses of a path.
///
/// # Safety
///
/// As of [`slice`].
unsafe fn path(poses: *const f64, count: usize) -> Result<Vec<Pose>, Fault> {
    // SAFETY: as of the caller.
    let rows = unsafe { slice("poses", poses, count.saturating_mul(16)) }?;
    let of = |(index, rows)| pose::from_rows(rows).map_err(Fault::item("poses", index));
    rows.as_chunks::<16>().0.iter().enumerate().map(of).collect()
}

/// Write one continuous joint path inside the limits along `count` poses, from the solution that is
/// nearest to `seed` [rad].
///
/// `seed` has dof angles, `q` has `count` rows of dof, NaN where a pose is not reached. `is_break`
/// has `count` elements or is NULL: true where a pose is not reached, or by a jump only.
/// IRBKIN_CODE_BROKEN_PATH if there is one: the message has the first and its reason.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_follow(
    robot: *const IrbkinRobot,
    poses: *const f64,
    count: usize,
    seed: *const f64,
    seed_len: usize,
    q: *mut f64,
    q_len: usize,
    is_break: *mut bool,
) -> IrbkinCode {
    fn follow<const N: usize>(
        robot: &Robot<N>,
        path: &[Pose],
        seed: &[f64],
        q: &mut [f64],
        mut is_break: Option<&mut [u8]>,
    ) -> Result<(), Fault> {
        let mut follower = Follower::new(robot, joints("seed", seed)?, &[1.0; N])?;
        let mut first = None;
        for (pose_index, (pose, q)) in path.iter().zip(q.as_chunks_mut::<N>().0).enumerate() {
            let (solution, reason) = follower.step(pose)?;
            *q = solution.map_or([f64::NAN; N], |solution| solution.q);
            if let Some(is_break) = is_break.as_mut().and_then(|all| all.get_mut(pose_index)) {
                *is_break = reason.is_some().into();
            }
            first = first.or(reason.map(|reason| Break { pose_index, reason }));
        }
        first.map_or(Ok(()), |first| Err(Fault::Broken(first.to_string())))
    }
    guarded(|| {
        // SAFETY: the pointers are as the header says.
        let (robot, path) = unsafe { (handle("robot", robot)?, path(poses, count)?) };
        // SAFETY: as above.
        let seed = unsafe { slice("seed", seed, seed_len) }?.to_vec();
        check_length("q", q_len, path.len() * robot.robot().dof())?;
        // SAFETY: as above, and all that is read is copied. 0 and 1 are the bytes of `bool`.
        let q = unsafe { slice_mut("q", q, q_len) }?;
        let is_break: *mut u8 = is_break.cast();
        // SAFETY: as above.
        let is_break = given(is_break, || unsafe { slice_mut("is_break", is_break, path.len()) })?;
        on!(robot.robot(), robot => follow(robot, &path, &seed, q, is_break))
    })
}

/// Write the best joint path along `count` poses, over all branches, turns and what is free.
///
/// `options` may be NULL. `q` has `count` rows of dof angles [rad]. `tool_angle` [rad] and `slot`
/// have `count` elements, or are NULL, and so is `report`. IRBKIN_CODE_BROKEN_PATH if no path is
/// without breaks: the message has the reason of each branch, and the path with the fewest breaks
/// is written, NaN and slot -1 where it has none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_plan(
    robot: *const IrbkinRobot,
    poses: *const f64,
    count: usize,
    options: *const IrbkinPlanOptions,
    q: *mut f64,
    q_len: usize,
    tool_angle: *mut f64,
    slot: *mut i32,
    report: *mut IrbkinPlanReport,
) -> IrbkinCode {
    guarded(|| {
        // SAFETY: the pointers are as the header says.
        let (robot, path) = unsafe { (handle("robot", robot)?, path(poses, count)?) };
        check_length("q", q_len, path.len() * robot.robot().dof())?;
        // SAFETY: as above; all that is read is copied before anything is written.
        on!(robot.robot(), robot => unsafe {
            let options = self::options(options, count)?;
            let out = Out {
                q: slice_mut("q", q, q_len)?.as_chunks_mut().0,
                tool_angle: given(tool_angle, || slice_mut("tool_angle", tool_angle, count))?,
                slot: given(slot, || slice_mut("slot", slot, count))?,
                report: given(report, || array_mut("report", report))?,
            };
            out.write_result(robot.plan(&path, &options))
        })
    })
}

/// The options of a plan of `count` poses.
///
/// # Safety
///
/// As of the header.
unsafe fn options<const N: usize>(
    options: *const IrbkinPlanOptions,
    count: usize,
) -> Result<PlanOptions<N>, Fault> {
    // SAFETY: as of the caller.
    let Some(own) = given(options, || unsafe { reference("options", options) })? else {
        return Ok(PlanOptions::default());
    };
    let (lower, upper) = (own.rotation_lower, own.rotation_upper);
    let rotation = match own.rotation_steps {
        0 => None,
        steps if lower == 0.0 && upper == 0.0 => Some(ToolRotation::full(steps)?),
        steps => Some(ToolRotation::new(steps, lower, upper, ToolAxis::Z)?),
    };
    // SAFETY: as of the caller.
    let numbers =
        |argument, numbers, len| given(numbers, || unsafe { slice(argument, numbers, len) });
    let angles = |argument, angles| -> Result<Option<[f64; N]>, Fault> {
        Ok(numbers(argument, angles, N)?.map(|q| joints(argument, q)).transpose()?.copied())
    };
    // SAFETY: as of the caller.
    let cell = given(own.cell, || unsafe { handle("cell", own.cell) })?;
    Ok(PlanOptions {
        rotation,
        times: numbers("times", own.times, count)?.map(<[f64]>::to_vec),
        start: angles("start", own.start)?,
        end: angles("end", own.end)?,
        closed: own.closed != 0,
        cell: cell.map(|cell| cell.cell().clone()),
        ..PlanOptions::default()
    })
}

/// Where a plan is written.
struct Out<'a, const N: usize> {
    q: &'a mut [[f64; N]],
    tool_angle: Option<&'a mut [f64]>,
    slot: Option<&'a mut [i32]>,
    report: Option<&'a mut [IrbkinPlanReport; 1]>,
}

impl<const N: usize> Out<'_, N> {
    fn write_result(self, planned: Result<Plan<N>, PlanError<N>>) -> Result<(), Fault> {
        match planned {
            Ok(plan) => {
                self.write(&plan);
                Ok(())
            }
            Err(PlanError::Invalid(error)) => Err(error.into()),
            Err(PlanError::NoPlan(gap)) => {
                self.write(&gap.plan);
                Err(Fault::Broken(gap.to_string()))
            }
            Err(other) => Err(Fault::Broken(other.to_string())),
        }
    }

    fn write(self, plan: &Plan<N>) {
        let absent = [f64::NAN; N];
        self.q.iter_mut().zip(&plan.q).for_each(|(to, from)| *to = from.unwrap_or(absent));
        if let Some(tool_angle) = self.tool_angle {
            tool_angle.iter_mut().zip(&plan.tool_angle).for_each(|(to, from)| *to = *from);
        }
        if let Some(slot) = self.slot {
            let number = |slot: Option<usize>| slot.and_then(|slot| slot.try_into().ok());
            slot.iter_mut()
                .zip(&plan.slot)
                .for_each(|(to, from)| *to = number(*from).unwrap_or(-1));
        }
        if let Some([report]) = self.report {
            *report = IrbkinPlanReport {
                cost: plan.cost,
                bottleneck: plan.bottleneck,
                breaks: plan.breaks.len(),
                certified: plan.certified.into(),
            };
        }
    }
}
