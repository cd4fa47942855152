//! Cells: whether an arm touches what is around it.

use std::sync::{Arc, Mutex, PoisonError};

use numpy::PyArray;
use numpy::ndarray::aview0;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use super::arguments::{read_threads, thread_count};
use super::arm::{SharedArm, joints, on};
use super::arrays::{Rows, copied_pair, vector};
use super::errors::{Fault, exception};
use super::outputs::{Output, array};
use super::queries::plain_joints;
use super::records::{CellContact, CellDistance};
use super::robot::PyRobot;
use super::shapes::PyShape;
use super::signals::{detached, detached_until};
use super::state::{Reduced, reduced};
use super::targets::checked_joints;
use super::trajectory::PyTrajectory;
use irbkin_motion::cell::{Cell, Checker, Contact, Nearest};
use irbkin_motion::internal::{Memory, Motion, check_most_near};
use irbkin_motion::{Arm, Error};

/// Obstacles around an arm: whether it touches them or itself.
///
/// Args:
///     obstacles: The `Shape` of each by its name, in the world; none when not given.
///     margin: How far the arm is to stay from them [m].
///     may_touch: Pairs of an obstacle's name and a link that are not compared, as
///         ("table", 1); none when not given.
///
/// Raises:
///     InvalidModelError: A margin that is negative or not finite, a name that no obstacle has, a
///         link other than 1 to 7.
#[pyclass(name = "Cell", module = "irbkin", frozen, eq)]
pub(super) struct PyCell {
    pub(super) cell: Arc<Cell>,
    /// What single joint vectors are looked at with.
    memory: Mutex<Option<Memory>>,
}

impl From<Cell> for PyCell {
    fn from(cell: Cell) -> Self {
        Self { cell: Arc::new(cell), memory: Mutex::default() }
    }
}

impl PartialEq for PyCell {
    fn eq(&self, other: &Self) -> bool {
        self.cell == other.cell
    }
}

#[pymethods]
impl PyCell {
    #[new]
    #[pyo3(signature = (obstacles=None, margin=0.0, may_touch=None))]
    fn new(
        obstacles: Option<&Bound<'_, PyDict>>,
        margin: f64,
        may_touch: Option<Vec<(String, usize)>>,
    ) -> PyResult<Self> {
        let mut read = Vec::new();
        for (name, shape) in obstacles.into_iter().flatten() {
            let name: String = name.extract()?;
            let shape = shape.cast::<PyShape>().map_err(|_| {
                PyTypeError::new_err(format!(
                    "obstacle {name:?} must be an irbkin.body.Shape, as Shape.box([1, 1, 0.1])"
                ))
            })?;
            read.push((name, shape.get().0.clone()));
        }
        let may_touch = may_touch.unwrap_or_default();
        let cell = Cell::new(read, margin).and_then(|cell| cell.with_may_touch(&may_touch));
        Ok(cell.map_err(exception)?.into())
    }

    /// Read a cell of TOML, of URDF or of MoveIt, as described in docs/guide/cell.md.
    ///
    /// Args:
    ///     path: A file in .toml, .urdf or .xml, or a PlanningScene or its dict.
    ///     joints: Where the joints of a URDF are that are of no arm, by name [rad or m].
    ///     solid: False to take open meshes by their surface alone, inside of which is free.
    ///
    /// Raises:
    ///     InvalidModelError: An unknown key or frame, a shape that cannot be; the message names
    ///         the entry and, where there is one, the line.
    ///     ImportError: A mesh is in the file and trimesh is not installed.
    ///     OSError: The file cannot be read.
    #[staticmethod]
    #[pyo3(signature = (path, *, joints=None, solid=true))]
    fn load(
        path: &Bound<'_, PyAny>,
        joints: Option<&Bound<'_, PyAny>>,
        solid: bool,
    ) -> PyResult<Py<Self>> {
        let module = path.py().import("irbkin._cell")?;
        Ok(module.call_method1("load", (path, solid, joints))?.extract()?)
    }

    /// Return the cell with another arm in it, which stands still.
    ///
    /// Args:
    ///     name: The arm's name: its link 3 is the obstacle "left, link 3" if the name is "left".
    ///     robot: The arm, at its base (`Robot.with_base`).
    ///     q: Its joint angles [rad], shape (n,).
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or joints that are not finite.
    ///     InvalidModelError: The robot has no body, or an obstacle has one of these names.
    fn with_robot(&self, name: &str, robot: &PyRobot, q: &Bound<'_, PyAny>) -> PyResult<Self> {
        let cell = Cell::clone(&self.cell);
        let cell = on!(robot.arm(), robot => {
            cell.with_robot(name, robot, &vector(q, "q", Fault::Joints)?).map_err(exception)?
        });
        Ok(cell.into())
    }

    /// The `Shape` of each obstacle, by its name.
    #[getter]
    fn obstacles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let obstacles = PyDict::new(py);
        for (name, shape) in self.cell.obstacles() {
            obstacles.set_item(name, PyShape(shape.clone()))?;
        }
        Ok(obstacles)
    }

    /// The pairs of an obstacle's name and a link that are not compared.
    #[getter]
    fn may_touch(&self) -> Vec<(&str, usize)> {
        self.cell.may_touch().collect()
    }

    /// How far the arm is to stay from the obstacles [m].
    #[getter]
    fn margin(&self) -> f64 {
        self.cell.margin()
    }

    /// Whether an arm touches itself, or comes nearer to an obstacle than the margin.
    ///
    /// The links are inside the capsules of `robot.body`: what does not collide is free, what
    /// collides may be free by as much as `robot.body.excess`. The base, link 0, is not compared
    /// with obstacles: it stands on one.
    ///
    /// Args:
    ///     robot: The arm.
    ///     q: Joint angles [rad], shape (..., n).
    ///     out: Array to write to, shape (...), bool.
    ///     threads: Number of threads; 0 for one a core.
    ///
    /// Returns:
    ///     Truth values, shape (...).
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or joints that are not finite.
    ///     InvalidModelError: The robot has no body.
    #[pyo3(signature = (robot, q, out=None, *, threads=1))]
    fn collides<'py>(
        &self,
        robot: &PyRobot,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        #[pyo3(from_py_with = read_threads)] threads: isize,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (py, threads) = (q.py(), thread_count(threads)?);
        if out.is_none() {
            let one = on!(robot.arm(), arm => self.at_plain(arm, q)?);
            if let Some(collides) = one {
                return Ok(PyArray::from_array(py, &aview0(&collides)).into_any());
            }
        }
        let rows = joints(robot.arm(), q)?;
        let mut answer = Output::<bool>::new(py, out, &rows.lead, &[rows.addresses()])?;
        match robot.arm() {
            SharedArm::Five(_) => checked_joints::<5>("q", &rows).map(drop)?,
            SharedArm::Six(_) => checked_joints::<6>("q", &rows).map(drop)?,
            SharedArm::Seven(_) => checked_joints::<7>("q", &rows).map(drop)?,
        }
        let (q, to) = (rows.data()?, answer.slice()?);
        on!(robot.arm(), robot => {
            detached(py, threads, |batch| self.cell.collides_batch(batch, robot, q, to))?;
        });
        Ok(answer.bound())
    }

    /// How far the nearest two are apart: two links of the arm, or a link and an obstacle.
    ///
    /// Args:
    ///     robot: The arm.
    ///     q: Joint angles [rad], shape (..., n).
    ///
    /// Returns:
    ///     CellDistance: distances [m], names of the pairs, nearest points [m], gradients [m/rad].
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or joints that are not finite.
    ///     InvalidModelError: The robot has no body.
    fn distance(&self, robot: &PyRobot, q: &Bound<'_, PyAny>) -> PyResult<CellDistance> {
        let py = q.py();
        let rows = joints(robot.arm(), q)?;
        let (nearest, gradient) = on!(robot.arm(), robot => self.nearest(py, robot, &rows)?);
        let distance =
            nearest.iter().map(|one| one.as_ref().map_or(f64::INFINITY, |one| one.distance));
        let points = nearest.iter().flat_map(|one| {
            one.as_ref().map_or([f64::NAN; 6], |one| {
                let [[ax, ay, az], [bx, by, bz]] = one.points;
                [ax, ay, az, bx, by, bz]
            })
        });
        Ok(CellDistance {
            distance: array(py, distance, &rows.lead)?,
            pair: PyTuple::new(py, nearest.iter().map(|one| names(one.as_ref())))?.unbind(),
            points: array(py, points, &[&rows.lead[..], &[2, 3]].concat())?,
            gradient: array(py, gradient, &[&rows.lead[..], &[robot.arm().dof()]].concat())?,
        })
    }

    /// Where a motion first touches something, between its samples too: `None` if it is proven
    /// that it never does.
    ///
    /// Between two rows each joint moves evenly. Parts of the motion are proven by bounds of how
    /// far the links move, and halved where that fails; what comes nearer than 0.1 mm to a
    /// collision counts as one.
    ///
    /// Args:
    ///     robot: The arm.
    ///     motion: Joint angles [rad], shape (m, n), or a `Trajectory`.
    ///
    /// Returns:
    ///     CellContact: the first instant, the joint angles, the two that touch, the depth; or
    ///     None.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or joints that are not finite.
    ///     InvalidModelError: The robot has no body.
    ///     ValueError: A trajectory of another number of joints.
    fn check_path(
        &self,
        robot: &PyRobot,
        motion: &Bound<'_, PyAny>,
    ) -> PyResult<Option<CellContact>> {
        let py = motion.py();
        if let Ok(trajectory) = motion.cast::<PyTrajectory>() {
            let trajectory = &trajectory.get().motion;
            return on!(robot.arm(), robot => self.contact(py, robot, &**trajectory));
        }
        on!(robot.arm(), robot => {
            if let Some(pair) = copied_pair(motion) {
                check_most_near("q", &pair, robot.limits(), &[1.0; _]).map_err(exception)?;
                return self.contact(py, robot, &pair[..]);
            }
        });
        let rows = joints(robot.arm(), motion)?;
        on!(robot.arm(), robot => self.contact(py, robot, checked_joints("motion", &rows)?))
    }

    fn __repr__(&self) -> String {
        let names: Vec<_> = self.cell.obstacles().iter().map(|(name, _)| name.as_str()).collect();
        format!("<Cell: {} obstacles {names:?}, margin {} m>", names.len(), self.cell.margin())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced(py, "Cell", &*self.cell)
    }
}

impl PyCell {
    /// Whether an arm collides at a plain joint vector, with the interpreter's lock.
    fn at_plain<const N: usize>(
        &self,
        arm: &Arm<N>,
        q: &Bound<'_, PyAny>,
    ) -> PyResult<Option<bool>> {
        let Some(q) = plain_joints(q, arm.limits())? else { return Ok(None) };
        let memory = || self.memory.lock().unwrap_or_else(PoisonError::into_inner);
        // Another thread meanwhile makes its own.
        let kept = memory().take();
        let mut checker = Checker::with_memory(&self.cell, arm, kept).map_err(exception)?;
        let collides = checker.collides(&q).map_err(exception)?;
        *memory() = Some(checker.into_memory());
        Ok(Some(collides))
    }

    fn contact<const N: usize, M: Motion<N> + Sync + ?Sized>(
        &self,
        py: Python<'_>,
        robot: &Arm<N>,
        motion: &M,
    ) -> PyResult<Option<CellContact>> {
        let found =
            detached_until(py, |it| self.cell.checker(robot)?.until(it).check_motion(motion))?
                .map_err(exception)?;
        let record = |Contact { at, q, nearest, depth }: Contact<N>| {
            Ok(CellContact { at, q: array(py, q, &[N])?, pair: names(Some(&nearest)), depth })
        };
        found.map(record).transpose()
    }

    /// The nearest pair at each row of joint angles, and the gradients of the distances.
    fn nearest<const N: usize>(
        &self,
        py: Python<'_>,
        robot: &Arm<N>,
        rows: &Rows<'_>,
    ) -> PyResult<(Vec<Option<Nearest>>, Vec<f64>)> {
        let rows = checked_joints("q", rows)?;
        detached_until(py, |interrupt| {
            let checker = self.cell.checker(robot)?;
            let (mut all, mut gradients) = (Vec::new(), Vec::new());
            for q in rows {
                interrupt.check(0)?;
                let nearest = checker.nearest(q)?;
                let gradient = nearest.as_ref().map_or([f64::NAN; N], |one| one.gradient(robot, q));
                gradients.extend(gradient);
                all.push(nearest);
            }
            Ok::<_, Error>((all, gradients))
        })?
        .map_err(exception)
    }
}

/// The names of a pair; empty ones without a pair.
fn names(nearest: Option<&Nearest>) -> (String, String) {
    nearest.map_or_else(Default::default, |nearest| {
        (format!("link {}", nearest.link), nearest.near.to_string())
    })
}
