//! `Robot.plan`: the best joint path along a path of poses.

use std::sync::Arc;

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::arguments::{ORDERS, one_of};
use super::arm::{SharedArm, on};
use super::arrays::numbers;
use super::cell::PyCell;
use super::errors::{Fault, exception, raised, shape_text, with_attributes};
use super::freedoms::{read_carrier, read_end, read_redundancy, read_rotation, read_tolerance};
use super::outputs::{array, column, matrix};
use super::records;
use super::robot::PyRobot;
use super::signals::watched;
use super::targets::{read_path_poses, read_weights};
use super::trajectories::read_each;
use irbkin::pose::to_rows as pose_to_rows;
use irbkin::{Interrupt, Robot};
use irbkin_motion::plan::{Accept, NoPlan, Plan, PlanError, PlanOptions};

#[pymethods]
impl PyRobot {
    /// The best joint path along a path of poses, over every branch, every turn of the joints and,
    /// with `rotation`, every angle of the tool.
    ///
    /// Of all continuous joint paths inside the limits, that with the smallest bottleneck: the
    /// largest joint velocity relative to `max_velocity` (1 rad/s where that is not known). Of
    /// those, that with the smallest weighted sum of squared joint steps and of what being near
    /// limits and singularities costs; `order` makes the sum come first. Both are exact over the
    /// tool angles of `rotation`, which are then refined around the best ones, to half a degree. A
    /// path of 64 poses or more with free axes is planned along some of its poses first, then in
    /// bands around that plan. At last, free axes leave their grid: they are smoothed, so that
    /// joints accelerate little; that raises the bottleneck by at most 3 %, never above the one
    /// with nothing free, and never the sum if it comes first. Every step of the answer is shown
    /// to be continuous between its two poses.
    ///
    /// Of seven joints, joint 7 is one more external axis, or joint 1 if that makes the better
    /// plan. Where neither leads through, since the other six are singular on the way, the plan is
    /// a path of `follow`. Costs of limits and singularities are of the other six.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (m, 4, 4), translation [m].
    ///     rotation: The angles by which the tool may be turned about its own axis: an
    ///         `irbkin.ToolRotation`, or the number of angles all around z. None where the poses
    ///         fix the orientation.
    ///     times: Time of each pose [s], shape (m,), increasing. Then no joint may exceed its
    ///         `max_velocity`, if that is known.
    ///     start: Joint vector at the first pose [rad], shape (n,), with the values of the external
    ///         axes behind it, if there are any, shape (n + k,); any when not given.
    ///     end: The same at the last pose.
    ///     closed: Whether the joints must end where they start, turns included. The last pose
    ///         repeats the first.
    ///     weights: Cost of moving each joint, shape (n,); ones when not given.
    ///     accept: Your own test, of collisions for instance: called with joint vectors of shape
    ///         (k, n), it returns k truth values. It is asked only for joint vectors near the best
    ///         path, and once for those that differ by full turns.
    ///     cell: An `irbkin.Cell` in which the plan is proven free (`Cell.check_path`): at the
    ///         poses and between them, each joint moving evenly from one to the next; not with a
    ///         carrier, which moves the base.
    ///     carrier: External axes: an `irbkin.Track`, an `irbkin.Positioner`, or up to three of
    ///         them. Their steps count for bottleneck and cost as steps of joints do.
    ///     tolerance: How far the tool may be tilted from the poses: an `irbkin.ToolCone`.
    ///     redundancy: Number of angles of joint 7 or 1 that are searched first, of an arm of seven
    ///         joints none of which is locked; 36 when not given. The joint is one of at most three
    ///         external axes.
    ///     order: What of two paths makes the better one: "bottleneck", then the sum; or "sum"
    ///         alone.
    ///     limit_cost: What a joint at its limit costs [rad^2/s^2], added to the sum: as much as
    ///         one of weight 1 that moves with the root of it [rad/s]. Half way from the middle to
    ///         the limit it costs a quarter. Without `times` the path takes one second.
    ///     singularity_cost: The same of each singularity that `Margin` counts.
    ///         Nothing for arms without a closed form.
    ///     objective: "time": of the best paths in either order from each branch of the first pose,
    ///         the one whose motion `irbkin.trajectory.retime` makes the shortest, everything that
    ///         is free smoothed for that. None: the pace is even, or given by `times`.
    ///     max_acceleration: Limits of that motion [rad/s^2]: a number, or one for each joint and
    ///         external axis, shape (n + k,).
    ///     progress: Called with how much work is done, and with all that is known of so far, which
    ///         grows while the plan is refined; or a bar as `tqdm.tqdm()`.
    ///
    /// Returns:
    ///     Plan: joints [rad], shape (m, n); tool angles; slots; external axes, shape (m, k);
    ///         tolerances; cost; bottleneck; no breaks.
    ///
    /// Raises:
    ///     PathError: No continuous joint path: `index` is the first pose that no branch reaches
    ///         from the start, `end_index` the last one from which none reaches the end, `reasons`
    ///         says where and why each branch ends, `plan` is the plan with the fewest breaks.
    ///     InvalidPoseError: T has a wrong shape or holds an invalid pose; the message has its
    ///         index.
    ///     InvalidJointsError: A start, end or weight that is not finite, or a start or end that
    ///         does not fit its pose or the limits.
    ///     InvalidMotionError: No poses, two poses half a turn apart, times that do not increase, a
    ///         rotation, carrier or tolerance that is empty, an open path with `closed`, a cost
    ///         that is negative or not finite.
    ///     ValueError: Another `order`.
    ///     TypeError: redundancy of an arm of six joints.
    ///     Exception: Whatever `accept` raises.
    #[pyo3(signature = (T, *, rotation=None, times=None, start=None, end=None, closed=false, weights=None, accept=None, cell=None, carrier=None, tolerance=None, redundancy=None, order="bottleneck", limit_cost=0.0, singularity_cost=0.0, objective=None, max_acceleration=None, progress=None))]
    fn plan<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        rotation: Option<&Bound<'py, PyAny>>,
        times: Option<&Bound<'py, PyAny>>,
        start: Option<&Bound<'py, PyAny>>,
        end: Option<&Bound<'py, PyAny>>,
        closed: bool,
        weights: Option<&Bound<'py, PyAny>>,
        accept: Option<&Bound<'py, PyAny>>,
        cell: Option<&Bound<'py, PyCell>>,
        carrier: Option<&Bound<'py, PyAny>>,
        tolerance: Option<&Bound<'py, PyAny>>,
        redundancy: Option<&Bound<'py, PyAny>>,
        order: &str,
        limit_cost: f64,
        singularity_cost: f64,
        objective: Option<&str>,
        max_acceleration: Option<&Bound<'py, PyAny>>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<records::Plan> {
        if redundancy.is_some() && !matches!(self.arm(), SharedArm::Seven(_)) {
            return Err(PyTypeError::new_err(
                "redundancy is for arms of seven joints: the pose alone determines those of this \
                 one",
            ));
        }
        let external = carrier.map(read_carrier).transpose()?.unwrap_or_default();
        let dof = self.arm().dof() + external.len();
        let read_times = |times| numbers(times, "(m,)", "times", Fault::Motion);
        on!(self.arm(), robot => {
            let (start, start_external) = read_end(start, "start", external.len())?;
            let (end, end_external) = read_end(end, "end", external.len())?;
            let redundancy = redundancy.map(read_redundancy).transpose()?;
            let mut options = PlanOptions {
                rotation: rotation.map(read_rotation).transpose()?,
                times: times.map(read_times).transpose()?,
                start,
                end,
                start_external,
                end_external,
                cone: tolerance.map(read_tolerance).transpose()?,
                closed,
                weights: read_weights(weights)?,
                order: one_of("order", order, &ORDERS)?,
                limit_cost,
                singularity_cost,
                max_acceleration: read_objective(objective, max_acceleration, dof)?,
                external,
                cell: cell.map(|cell| Arc::clone(&cell.get().cell)),
                ..PlanOptions::default()
            };
            options.redundancy = redundancy.unwrap_or(options.redundancy);
            let path = read_path_poses(T)?;
            planned(T.py(), robot, accept, progress, |accept, interrupt| {
                robot.planned(&path, &options, accept, interrupt)
            })
        })
    }
}

/// Plan without the interpreter's lock.
fn planned<const N: usize>(
    py: Python<'_>,
    robot: &Robot<N>,
    accept: Option<&Bound<'_, PyAny>>,
    progress: Option<&Bound<'_, PyAny>>,
    plan: impl FnOnce(Option<&mut Accept<'_, N>>, Interrupt<'_>) -> Result<Plan<N>, PlanError<N>> + Send,
) -> PyResult<records::Plan> {
    let accept = accept.map(|accept| accept.clone().unbind());
    let (planned, failure) = watched(py, progress, |interrupt| {
        let mut failure = None;
        let mut ask = |q: &[[f64; N]]| {
            let accept = accept.as_ref()?;
            let accepted = Python::attach(|py| asked(accept.bind(py), q));
            accepted.map_err(|error| failure = Some(error)).ok()
        };
        let ask = accept.is_some().then_some(&mut ask as &mut Accept<'_, N>);
        let planned = plan(ask, interrupt);
        (planned, failure)
    })?;
    if let Some(failure) = failure {
        return Err(failure);
    }
    match planned {
        Ok(plan) => plan_record(py, robot, &plan),
        Err(PlanError::Invalid(error)) => Err(exception(error)),
        Err(PlanError::NoPlan(gap)) => Err(path_error(robot, &gap)),
        Err(PlanError::Stopped) => Err(PyValueError::new_err("the plan was stopped")),
    }
}

/// The limits of accelerations that `objective="time"` needs.
fn read_objective(
    objective: Option<&str>,
    max_acceleration: Option<&Bound<'_, PyAny>>,
    dof: usize,
) -> PyResult<Option<Vec<f64>>> {
    let refused = |why: &str| Err(PyValueError::new_err(why.to_owned()));
    match (objective, max_acceleration) {
        (None, None) => Ok(None),
        (Some("time"), Some(limits)) => {
            read_each(Some(limits), "max_acceleration", dof, f64::INFINITY).map(Some)
        }
        (Some("time"), None) => refused(
            "objective \"time\" needs max_acceleration, limits of the joints [rad/s^2]: a number, or \
             one for each joint and external axis",
        ),
        (None, Some(_)) => refused(
            "max_acceleration counts with objective=\"time\" alone: pass that, or time the plan with \
             irbkin.trajectory.retime",
        ),
        (Some(other), _) => refused(&format!("objective must be \"time\" or None, got {other:?}")),
    }
}

/// Ask the caller's test of joint vectors.
fn asked<const N: usize>(accept: &Bound<'_, PyAny>, q: &[[f64; N]]) -> PyResult<Vec<bool>> {
    let py = accept.py();
    let answers =
        py.import("numpy")?.call_method1("asarray", (accept.call1((matrix(py, q),))?,))?;
    let (found, dtype): (Vec<usize>, _) =
        (answers.getattr("shape")?.extract()?, answers.getattr("dtype")?);
    if found != [q.len()] || dtype.getattr("kind")?.extract::<String>()? != "b" {
        return Err(PyValueError::new_err(format!(
            "accept must return {} truth values, one for each row of q; it returned an array of \
             shape {} and dtype {dtype}",
            q.len(),
            shape_text(&found),
        )));
    }
    answers.call_method0("tolist")?.extract()
}

fn plan_record<const N: usize>(
    py: Python<'_>,
    robot: &Robot<N>,
    plan: &Plan<N>,
) -> PyResult<records::Plan> {
    let rows = plan.q.iter().flat_map(|q| q.unwrap_or([f64::NAN; N]));
    let pose = |q: &Option<[f64; N]>| q.map_or([f64::NAN; 16], |q| pose_to_rows(&robot.fk(&q)));
    let slot = |slot: &Option<usize>| slot.map_or(-1, |slot| i64::try_from(slot).unwrap_or(-1));
    let breaks = plan.breaks.iter();
    let breaks = breaks.map(|gap| records::PlanBreak { leave: gap.leave, enter: gap.enter });
    Ok(records::Plan {
        q: array(py, rows, &[plan.q.len(), N])?,
        tool_angle: column(py, plan.tool_angle.iter().copied()),
        slot: column(py, plan.slot.iter().map(slot)),
        external: rows_of(py, &plan.external)?,
        tolerance: rows_of(py, &plan.tolerance)?,
        cost: plan.cost,
        bottleneck: plan.bottleneck,
        breaks: PyTuple::new(py, breaks.collect::<Vec<_>>())?.unbind(),
        certified: plan.certified,
        T: array(py, plan.q.iter().flat_map(pose), &[plan.q.len(), 4, 4])?,
    })
}

/// Rows of equal length; NaN for one that is empty where others are not.
fn rows_of(py: Python<'_>, rows: &[Vec<f64>]) -> PyResult<Py<PyAny>> {
    let width = rows.iter().map(Vec::len).max().unwrap_or_default();
    let filled = rows
        .iter()
        .flat_map(|row| (0..width).map(|column| row.get(column).copied().unwrap_or(f64::NAN)));
    array(py, filled, &[rows.len(), width])
}

fn path_error<const N: usize>(robot: &Robot<N>, gap: &NoPlan<N>) -> PyErr {
    with_attributes(raised("PathError", gap), |value| {
        let py = value.py();
        value.setattr("index", gap.pose_index)?;
        value.setattr("end_index", gap.end_index)?;
        let ends = gap.ends.iter().map(|end| records::StrandEnd {
            slot: end.slot,
            pose_index: end.pose_index,
            reason: end.reason.to_string(),
        });
        value.setattr("reasons", PyTuple::new(py, ends.collect::<Vec<_>>())?)?;
        value.setattr("plan", plan_record(py, robot, &gap.plan)?)
    })
}
