//! Records of what a module declares and moves, and of what is wrong with it.

use pyo3::IntoPyObjectExt;
use pyo3::basic::CompareOp;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::class;
use super::values::content;
use crate::record;
use crate::record::{record, record_methods};
use crate::records::Array;
use irbkin_abb::rapid;
use irbkin_abb::rapid::{Datum, Target};

record! {
    "irbkin.rapid";
    /// A data declaration. Values are as declared: assignments of a program are not followed.
    Declaration {
        /// Its name, as it is written.
        name: String,
        /// RAPID's name of its type.
        data_type: String,
        /// Its scope: "LOCAL", "TASK" or "".
        scope: String,
        /// Its storage class: "CONST", "PERS" or "VAR".
        storage: String,
        /// The routine that declares it; None for the module.
        routine: Option<String>,
        /// A record; nested lists of records for an array; None without a value.
        value: Py<PyAny>,
        /// Line of the text, from 1.
        line: usize,
        /// Column of the text, from 1.
        column: usize,
    }

    /// A routine of a module.
    Routine {
        /// Its kind: "PROC", "FUNC" or "TRAP".
        kind: String,
        /// Its name, as it is written.
        name: String,
        /// Its first line, from `LOCAL` or `PROC` to the parameters.
        header: String,
        /// Line of the text, from 1.
        line: usize,
        /// Column of the text, from 1.
        column: usize,
    }

    /// An argument as it is written, without its name, and its value by the declarations.
    ///
    /// Data that the module assigns have no value.
    Argument {
        /// The argument as it is written.
        text: String,
        /// Its value; None if the declarations do not give it.
        value: Py<PyAny>,
        /// Why the value is unknown; None if it is known.
        reason: Option<String>,
    }

    /// How a move is made: by the instructions before it in its routine, or else by the settings
    /// that a program starts with.
    MotionSettings {
        /// ConfL: whether MoveL and MoveC must arrive with the configuration of the target.
        conf_l: bool,
        /// ConfJ: whether MoveJ must arrive with the configuration of the target.
        conf_j: bool,
        /// SingArea, near the wrist singularity: "Off", "Wrist" or "LockAxis4".
        sing_area: String,
        /// CirPathMode, the orientation in a MoveC: "PathFrame", "ObjectFrame", "CirPointOri",
        /// "Wrist45", "Wrist46" or "Wrist56".
        cir_path_mode: String,
    }

    /// A move instruction.
    Move {
        /// How it moves: "MoveJ", "MoveL", "MoveC", "MoveAbsJ", or "MoveExtJ" for external axes
        /// only.
        kind: String,
        /// The routine that contains it.
        routine: Option<String>,
        /// The target: an `Argument` with a RobTarget, of MoveAbsJ and MoveExtJ with a JointTarget.
        target: Py<Argument>,
        /// The point on the circle of a MoveC.
        via: Option<Py<Argument>>,
        /// The speed as it is written, such as "v1000".
        speed: String,
        /// The zone as it is written, such as "z50"; empty for an instruction without one, which
        /// meets its target.
        zone: String,
        /// The tool: a ToolData.
        tool: Py<Argument>,
        /// The work object of \WObj; without it wobj0.
        wobj: Option<Py<Argument>>,
        /// The other optional arguments: name and text; no text for a switch.
        options: Py<PyTuple>,
        /// Line of the text, from 1.
        line: usize,
        /// Column of the text, from 1.
        column: usize,
        /// Line of the PDispOn or PDispSet that displaces it, which is not followed.
        displaced: Option<usize>,
        /// The data of `speed`: a SpeedData, with the speed of \V.
        speed_data: Py<Argument>,
        /// The data of `zone`: a ZoneData, with the radius of \Z.
        zone_data: Py<Argument>,
        /// The duration of \T, which replaces the speed [s].
        time: Option<Py<Argument>>,
        /// The settings of ConfL, ConfJ, SingArea and CirPathMode before it.
        settings: Py<MotionSettings>,
        /// The instruction as it is written, such as "MoveL" or "ArcLStart".
        instruction: String,
        /// The other required arguments, of a process: the number of required arguments before
        /// each, and its text.
        extra: Py<PyTuple>,
    }

    /// A move of a motion.
    MotionMove {
        /// The instruction: "MoveJ", "MoveL", "MoveC" or "MoveAbsJ".
        kind: String,
        /// Index of its module: 0 for the module itself, from 1 for modules of its context.
        module: usize,
        /// Its index in `Module.moves`.
        module_index: usize,
        /// Line of the instruction.
        line: usize,
        /// When it begins [s], halfway through the corner before it.
        start: f64,
        /// When it ends [s], halfway through the corner behind it.
        end: f64,
        /// The length of the tool's way in the work object [m].
        length: f64,
        /// The joints at its target [rad], shape (6,), which is met or passed; None if the move is
        /// left out.
        q: Option<Array>,
        /// Whether it is made as it is programmed. Otherwise the joints go straight to its target
        /// at their limits or, without `q`, it is left out.
        as_programmed: bool,
        /// The tool in the flange frame, shape (4, 4); of a stationary tool, the work object that
        /// the robot carries.
        tool: Array,
    }

    /// A part of the text that is not read.
    Skipped {
        /// Line of the text, from 1.
        line: usize,
        /// Column of the text, from 1.
        column: usize,
        /// The routine that contains it; None for the module.
        routine: Option<String>,
        /// Its kind and, of a datum, why it is not read.
        what: String,
        /// The part as it is written.
        text: String,
    }

    /// A fault of a text that was read in spite of it. `str` has the place, too.
    TextFault {
        /// Line of the text, from 1.
        line: usize,
        /// Column of the text, from 1.
        column: usize,
        /// The fault in words, without the place.
        message: String,
    }

    /// The joint angles of m targets.
    TargetTable {
        /// The instruction of each target, or "robtarget".
        kinds: Py<PyTuple>,
        /// Each target as it is written, or the name of its declaration.
        names: Py<PyTuple>,
        /// Line of the instruction or of the declaration, shape (m,).
        lines: Array,
        /// Joint angles [rad], shape (m, n), NaN if there are none.
        q: Array,
        /// The configuration of the joint angles, int32 arrays of shape (m,); without joint angles
        /// the configuration of the target.
        configuration: Py<PyAny>,
        /// Angle of joint 5 from 0 or 180 deg [rad], shape (m,).
        wrist: Array,
        /// Angle between upper arm and forearm from stretched or folded [rad], shape (m,).
        elbow: Array,
        /// Distance of the wrist center from axis 1 [m], shape (m,).
        shoulder: Array,
        /// For each target a `Finding`, if there are no joint angles, or others than the target
        /// requests.
        findings: Py<PyTuple>,
    }
}

#[pymethods]
impl TextFault {
    fn __str__(&self) -> String {
        format!("line {}, column {}: {}", self.line, self.column, self.message)
    }
}

impl From<&rapid::RapidFault> for TextFault {
    fn from(fault: &rapid::RapidFault) -> Self {
        let (line, column) = (fault.line, fault.column);
        Self { line, column, message: fault.kind.to_string() }
    }
}

impl From<&rapid::Routine> for Routine {
    fn from(routine: &rapid::Routine) -> Self {
        let rapid::Routine { kind, name, header, line, column, .. } = routine.clone();
        Self { kind: kind.name().into(), name, header, line, column }
    }
}

impl From<&rapid::Statement> for Skipped {
    fn from(part: &rapid::Statement) -> Self {
        let (what, text) = (part.what(), part.text.clone());
        let routine = part.routine.as_deref().map(String::from);
        Self { line: part.line, column: part.column, routine, what, text }
    }
}

impl Declaration {
    pub(super) fn of(py: Python<'_>, datum: &Datum) -> PyResult<Self> {
        Ok(Self {
            name: datum.name.clone(),
            data_type: datum.data_type.name().into(),
            scope: datum.scope.name().into(),
            storage: datum.storage.name().into(),
            routine: datum.routine.clone(),
            value: content(py, &datum.content)?.unbind(),
            line: datum.line,
            column: datum.column,
        })
    }
}

/// An argument as it is written, with its value or the reason why that is unknown.
fn argument<'py, T: IntoPyObject<'py>>(
    py: Python<'py>,
    text: &str,
    value: Result<T, &impl ToString>,
) -> PyResult<Py<Argument>> {
    let (value, reason) = match value {
        Ok(value) => (value.into_py_any(py)?, None),
        Err(reason) => (py.None(), Some(reason.to_string())),
    };
    Py::new(py, Argument { text: text.to_owned(), value, reason })
}

impl Move {
    pub(super) fn of(py: Python<'_>, step: &rapid::Move) -> PyResult<Self> {
        let rapid::Argument { text, value, .. } = &step.target;
        let target = match value {
            Ok(Target::RobTarget(target)) => {
                argument(py, text, Ok::<_, &String>(class::RobTarget(*target)))
            }
            Ok(Target::JointTarget(target)) => {
                argument(py, text, Ok::<_, &String>(class::JointTarget(*target)))
            }
            Err(reason) => argument(py, text, Err::<f64, _>(reason)),
        };
        let rapid::Argument { text: speed, value: speed_data } = &*step.speed;
        let rapid::Argument { text: zone, value: zone_data } = &*step.zone;
        let via = step
            .via
            .as_ref()
            .map(|via| argument(py, &via.text, via.value.as_ref().map(|it| class::RobTarget(*it))));
        let wobj = step.wobj.as_ref().map(|wobj| {
            argument(py, &wobj.text, wobj.value.as_ref().map(|it| class::WobjData(it.clone())))
        });
        let time = step.time.as_ref().map(|time| {
            let is_time = |option: &&rapid::MoveOption| option.name.eq_ignore_ascii_case("T");
            let text = step.options.iter().find(is_time).and_then(|option| option.text.as_deref());
            argument(py, text.unwrap_or_default(), time.as_ref().as_ref().copied())
        });
        let options = step.options.iter().map(|option| (&option.name, &option.text));
        let rapid::MotionSettings { conf_l, conf_j, sing_area, cir_path_mode } = step.settings;
        let (sing_area, cir_path_mode) = (sing_area.name().into(), cir_path_mode.name().into());
        Ok(Self {
            kind: step.kind.name().into(),
            routine: step.routine.as_deref().map(Into::into),
            target: target?,
            via: via.transpose()?,
            speed: speed.to_string(),
            zone: zone.to_string(),
            tool: argument(
                py,
                &step.tool.text,
                step.tool.value.as_ref().map(|it| class::ToolData(*it)),
            )?,
            wobj: wobj.transpose()?,
            options: PyTuple::new(py, options)?.unbind(),
            line: step.line,
            column: step.column,
            displaced: step.displaced,
            speed_data: argument(py, speed, speed_data.as_ref().map(|it| class::SpeedData(*it)))?,
            zone_data: argument(py, zone, zone_data.as_ref().map(|it| class::ZoneData(*it)))?,
            time: time.transpose()?,
            settings: Py::new(py, MotionSettings { conf_l, conf_j, sing_area, cir_path_mode })?,
            instruction: step.instruction.to_string(),
            extra: PyTuple::new(py, step.extra.iter().map(|it| (it.place, &it.text)))?.unbind(),
        })
    }
}
