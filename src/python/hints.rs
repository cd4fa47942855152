//! Names that `irbkin.Robot` does not have but other packages do, each answered with irbkin's; and
//! attributes that they set.
//!
//! They are attributes that raise: with a `__getattr__`, Python would look up every method of a
//! robot the long way, which adds 0.1 us to a call.

use pyo3::exceptions::PyAttributeError;
use pyo3::prelude::*;

use super::robot::PyRobot;

/// Define names that raise, and hide them from `dir`.
macro_rules! hints {
    ($($other:ident: $own:literal,)+) => {
        const OTHERS: &[&str] = &[$(stringify!($other)),+];

        #[pymethods]
        impl PyRobot {
            $(
                #[doc = concat!("Another package's name: use `", $own, "`.")]
                #[getter]
                #[allow(non_snake_case, reason = "the name of another package")]
                fn $other(&self) -> PyResult<()> {
                    Err(PyAttributeError::new_err(concat!(
                        "Robot has no attribute '", stringify!($other), "': use ", $own
                    )))
                }
            )+

            fn __dir__(slf: &Bound<'_, Self>) -> PyResult<Vec<String>> {
                let object = slf.py().get_type::<PyAny>();
                let names: Vec<String> = object.call_method1("__dir__", (slf,))?.extract()?;
                Ok(names.into_iter().filter(|name| !OTHERS.contains(&name.as_str())).collect())
            }
        }
    };
}

hints! {
    set_tool: "with_tool",
    set_base: "with_base",
    set_limits: "with_limits",
    joint_limits: "limits",
    n: "dof",
    ikine: "ik",
    inverse: "ik",
    fkine: "fk",
    forward: "fk",
    forward_kinematics: "fk",
    inverse_kinematics: "ik_nearest",
    ikine_LM: "ik_nearest",
    jacob0: "jacobian",
    manipulability: "singularity",
    qlim: "limits",
    random_q: "random",
    plot: "irbkin.plot.arm",
    teach: "irbkin.scene.of(robot).view",
    iscollided: "irbkin.Cell.collides",
    ComputeFk: "fk",
    ComputeIk: "ik",
    SolveFK: "fk",
    SolveIK: "ik_nearest",
    SolveIK_All: "ik",
    JointsConfig: "configuration",
    JointLimits: "limits",
    setPoseTool: "with_tool",
    setPoseFrame: "with_base",
    MoveL: "irbkin.paths.line and follow",
    Collisions: "irbkin.Cell.collides",
    Update: "irbkin.rapid.check",
    CalcRobT: "irbkin.rapid.calc_rob_t",
    CalcJointT: "irbkin.rapid.calc_joint_t",
}

#[pymethods]
impl PyRobot {
    #[expect(clippy::unused_self, reason = "the arguments of Python's slot")]
    fn __setattr__(&self, name: &str, _value: &Bound<'_, PyAny>) -> PyResult<()> {
        let own = match name {
            "tool" | "base" | "limits" | "body" => format!("with_{name}"),
            "name" | "max_velocity" => "from_mdh or from_urdf".to_owned(),
            _ => "a name of your own".to_owned(),
        };
        let message = format!("a Robot is frozen, '{name}' cannot be set: use {own}");
        Err(PyAttributeError::new_err(message))
    }
}
